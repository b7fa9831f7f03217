//! Catmull-Clark control meshes to exact, smooth, measurable surfaces.

mod catmull_clark;
pub mod convert;
mod crease;
mod limit;
pub mod math;
pub mod mesh;
pub mod nurbs;
mod patch;
pub mod pccm;
mod refine;
mod rules;
mod stencil;

pub use limit::{LimitVertex, limit_vertices};
pub use math::{Grid, Interpolate, Vec3};
pub use mesh::{
    Boundary, ControlMesh, Corner, Crease, Creasing, Defect, EdgeId, FaceId, FaceList, FaceVarying,
    FaceVaryingRule, HalfedgeId, Note, Place, Scheme, Sharpness, Statistics, Topology, TopologyError,
    Valence, VertexId, shapes,
};
pub use refine::{FineMesh, Refinement, Step, TooDeep};
pub use rules::{EdgeRule, Level, Sector, VertexMask, VertexRule};
pub use stencil::{Row, StencilTable};
