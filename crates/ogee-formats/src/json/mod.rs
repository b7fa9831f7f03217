//! The cage in JSON: one object with the keys
//!
//! ```json
//! { "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
//!   "faces": [[0, 1, 2]],
//!   "creases": [{"vertices": [0, 1], "sharpness": 2.5}],
//!   "corners": [{"vertex": 2, "sharpness": "infinite"}],
//!   "boundary": "edge-and-corner", "creasing": "uniform", "lens": {"beta": 0.5, "gamma": 0.125},
//!   "holes": [], "meetings": [],
//!   "uvs": [[0, 0], [1, 0], [0, 1]], "face_uvs": [[0, 1, 2]], "face_varying": "corners-plus1" }
//! ```
//!
//! of which only the first two have to be there. Everything is numbered from 0; a sharpness of 10 or more never
//! fades. A meeting of curves is `{"vertex": v, "ports": [a, b, ..], "t": 0.25}`, neighbours counter-clockwise. `lens` is
//! the shape of the rule at vertices of valence 2, written where it is not the usual one. The keys of a network of curves ([`crate::network`]) may stand beside
//! these; they are not for this reader.

mod names;
mod network;
mod parse;
mod read;
mod write;

pub(crate) use parse::once;
pub use read::read;
pub(crate) use read::syntax;
pub use write::write_cage;
pub(crate) use write::{write_cage_with, write_view};
