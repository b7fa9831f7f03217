//! Wavefront OBJ with the subdivision tags of OpenSubdiv's test shapes.
//!
//! A tag is a line `t <name> <ints>/<reals>/<names> <int ...> <real ...> <name ...>`. Its vertices and faces are
//! numbered from 0, those of `f` lines from 1. Free-form surfaces, lines, groups and materials are passed over.

mod careful;
mod chunks;
mod elements;
mod mesh;
mod quick;
mod read;
#[cfg(test)]
mod simple;
mod statements;
mod survey;
mod tags;
mod write;

pub(crate) use mesh::{write_corners, write_name, write_point, write_view};
pub use read::read;
pub use write::write_cage;
