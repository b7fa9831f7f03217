//! Pieces of a level, taken out to be worked on alone.

mod neighbourhood;

pub(crate) use neighbourhood::{Neighbourhood, with_ring};
