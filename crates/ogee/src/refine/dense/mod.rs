//! Dense refinement: between irregular corners a cage is regular, and stays so; every quad becomes one grid.
//!
//! A step of refinement of a grid is the tensor product of the uniform cubic B-spline's: no connectivity, no numbers of
//! neighbours, memory read and written in order. Only the corners of the base quads ask the rule table, over the base level's
//! own connectivity: around a corner every level looks the same. Sides of quads are rows that two grids share.

mod corners;
mod grids;
mod interiors;
mod kernel;
mod levels;
mod memory;
mod numbering;
mod plan;
mod sides;
mod stream;

pub(crate) use grids::Grids;
pub use plan::DenseRefinement;
