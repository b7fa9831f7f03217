//! Refinement: every halfedge becomes four.

mod ahead;
mod cage;
mod dense;
mod fine;
mod points;
pub(crate) mod split;
mod step;
mod uniform;

pub(crate) use ahead::Ahead;
pub use dense::DenseRefinement;
pub(crate) use dense::Grids;
pub use fine::{FineMesh, TooDeep};
pub use step::Step;
pub use uniform::Refinement;
pub(crate) use uniform::sub_grid;
