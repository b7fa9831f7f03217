//! The limit surface: where refinement leads.

pub(crate) mod masks;
mod point;
mod surface;
mod vertices;

pub use point::{Derivatives, Flags, LimitJet, Samples, SurfacePoint};
pub use surface::LimitSurface;
pub(crate) use vertices::limit_vertex;
pub use vertices::{LimitVertex, limit_vertices};
