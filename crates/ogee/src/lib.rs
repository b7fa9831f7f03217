//! Catmull-Clark control meshes to exact, smooth, measurable surfaces.

pub mod convert;
pub mod math;
pub mod mesh;
pub mod nurbs;

pub use math::{Grid, Interpolate, Vec3};
pub use mesh::{
    Boundary, ControlMesh, Corner, Crease, Creasing, Defect, EdgeId, FaceId, FaceList, FaceVarying,
    FaceVaryingRule, HalfedgeId, Note, Place, Scheme, Sharpness, Topology, TopologyError, Valence, VertexId,
    shapes,
};
