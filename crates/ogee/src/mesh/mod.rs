//! Control meshes and their connectivity.

mod adjacency;
mod check;
pub(crate) mod connectivity;
mod control_mesh;
pub(crate) mod cycles;
mod ids;
mod meetings;
#[cfg(test)]
mod plain_adjacency;
pub mod shapes;
mod statistics;
pub(crate) mod topology;

pub(crate) use check::check_tags;
pub use check::{Defect, Note, Place, TopologyError, check, notes};
pub use control_mesh::{
    Boundary, ControlMesh, Corner, Crease, Creasing, FaceList, FaceVarying, FaceVaryingRule, LensShape,
    Meeting, Scheme, Sharpness,
};
pub use ids::{EdgeId, FaceId, HalfedgeId, VertexId};
pub use statistics::{Component, Statistics};
pub use topology::{Topology, Valence};
