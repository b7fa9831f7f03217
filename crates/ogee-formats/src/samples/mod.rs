//! Samples of a surface, as JSON lines or as CSV: where to evaluate, one address to a line, and what came of it.
//!
//! ```text
//! {"face": 0, "u": 0.5, "v": 0.25}                  face,corner,u,v
//! {"face": 7, "corner": 2, "u": 0.0, "v": 1.0}      0,,0.5,0.25
//!                                                   7,2,0,1
//! ```
//!
//! Both directions stream: neither the reader nor the writer holds more than a line, so the number of samples is
//! bounded by nothing but time.

mod lines;
mod read;
mod write;

pub use read::{AddressReader, AddressesError};
pub use write::{Sample, write_header, write_sample};

/// How samples are written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleFormat {
    /// One JSON object to a line.
    JsonLines,
    /// Fields between commas, below a line with their names.
    Csv,
}

/// A point of a surface, as files name it. Whether a surface has it is for [`ogee::PatchTable::locate`] to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Address {
    /// The face of the cage, from 0.
    pub face: u32,
    /// The corner, on faces that are no quads.
    pub corner: Option<u32>,
    /// The first parameter, finite.
    pub u: f64,
    /// The second parameter, finite.
    pub v: f64,
}

/// The names of what an address is made of.
const ADDRESS: [&str; 4] = ["face", "corner", "u", "v"];
