//! STEP (ISO 10303-21): parts out, and a lint that reads the text back.
//!
//! | file | holds |
//! | --- | --- |
//! | `options` | unit, schema, names |
//! | `syntax` | how numbers, strings and lists are spelt |
//! | `emitter` | numbered lines, points shared |
//! | `context` | header, product, units: what stands around a shape |
//! | `write` | shells, solids, sheets |
//! | `curves` | wireframes |
//! | `check` | the lint |

mod check;
mod context;
mod curves;
mod emitter;
mod options;
mod syntax;
mod write;

pub use check::{CheckReport, Counts, Fault, check};
pub use curves::write_curves;
pub use options::{Options, Schema, Unit};
pub use write::write;
