//! Lenses: regions around a vertex of valence 2, and poles, with every construction of Karciauskas and Peters,
//! *Lens-shaped surfaces and C2 subdivision* (`docs/methods/lens.md`).

mod biquartic;
mod biquartic_tables;
mod cap;
mod detect;
mod fan;
mod layout;
mod polar;
mod remesh;
pub(crate) mod rule;
mod treat;

pub use cap::{Cap, CapEdge, CapFace, CapVertex};
