//! The limit surface: where refinement leads.

mod batch;
mod bernstein;
mod bicubic;
mod closest;
mod corner;
mod evaluate;
mod evaluator;
mod faces;
mod grids;
mod normals;
mod out;
mod pattern;
mod pieces;
mod place;
mod point;
mod stencils;
mod surface;
mod vertices;
mod walk;
mod weights;

pub use closest::{Closest, ClosestPoints};
pub use evaluator::Evaluator;
pub use pattern::Pattern;
pub use pieces::{FacePiece, PatchNet, TailPiece};
pub use point::{Derivatives, Flags, LimitJet, Samples, SurfacePoint};
pub use surface::LimitSurface;
pub(crate) use vertices::limit_vertex;
pub use vertices::{LimitVertex, limit_vertices};
