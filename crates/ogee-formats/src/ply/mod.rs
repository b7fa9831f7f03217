//! PLY: plain, binary little endian and binary big endian, polygons of any size.
//!
//! The vertices are the `x`, `y`, `z` of the element `vertex`, the faces the list `vertex_indices` or
//! `vertex_index` of the element `face`. Every other element and property is stepped over.

mod body;
mod header;
mod read;
mod write;

pub use read::read;
pub(crate) use write::{Layout, write_vector, write_view};
