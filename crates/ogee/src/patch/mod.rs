//! Pieces of a level: taken out to be worked on alone, and what every face's surface is made of.

mod location;
mod neighbourhood;
mod table;

pub use location::{Location, LocationError, ParametricFace};
pub(crate) use neighbourhood::{Neighbourhood, with_ring};
pub use table::PatchTable;
