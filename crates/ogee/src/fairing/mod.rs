//! Fairing: of all cages whose limit surface goes through given points with given normals, the one that bends least
//! (Halstead, Kass and DeRose, *Efficient, fair interpolation using Catmull-Clark surfaces*, 1993).
//!
//! The limit of a vertex and its tangents are weighted sums of points, so what is wanted is a row of a linear system each
//! (`rows`), and so is the energy: second differences of the split mesh, squared and summed (`energy`). Rows that follow from
//! others are found first (`dependence`); what is left is solved with multipliers (`solve`).

mod dependence;
mod energy;
mod fair;
mod rows;
mod solve;

pub use fair::{Faired, FairingError, FairingOptions, fair};
pub use rows::Constraint;
