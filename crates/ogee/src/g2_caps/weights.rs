//! `Weights`: how the coefficients of a cap follow from its points.

use super::{CapClass, INNER};
use crate::math::Grid;

/// The weights of one class of caps.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights {
    /// The class.
    pub class: CapClass,
    /// For each sector a row for every inner coefficient `(i, j)`, number `10 i + j`, `i` along the sector's first edge, and a
    /// column for every point. An interior vertex has those of sector 0 only: the others see the same with their points first.
    pub sectors: Vec<Grid<f64>>,
}

impl Weights {
    /// The weights of an inner coefficient of a sector.
    pub fn row(&self, sector: usize, i: usize, j: usize) -> &[f64] {
        self.sectors[sector].row(INNER * i + j)
    }
}
