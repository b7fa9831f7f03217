//! Pieces of a level: taken out to be worked on alone, and what every face's surface is made of.

mod adaptive;
mod build;
mod chain;
pub(crate) mod dart;
mod kind;
pub(crate) mod lens;
mod location;
pub(crate) mod masks;
mod meeting;
mod neighbourhood;
mod plain;
mod points;
mod roots;
mod smooth;
mod surroundings;
mod table;
mod tree;
mod users;

pub(crate) use adaptive::{Adaptive, AdaptiveLevel};
pub(crate) use chain::{ChainBasis, Wide};
pub(crate) use kind::Kind;
pub use location::{Location, LocationError, ParametricFace};
pub(crate) use neighbourhood::{Neighbourhood, with_ring};
pub use table::{PatchStatistics, PatchTable};
pub(crate) use tree::{Node, Piece, TURNED, Tail, child, from_corner, to_corner};
