//! The limit surface: where refinement leads.

pub(crate) mod masks;
mod vertices;

pub(crate) use vertices::limit_vertex;
pub use vertices::{LimitVertex, limit_vertices};
