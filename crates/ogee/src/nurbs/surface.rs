//! `NurbsSurface`: a polynomial tensor-product B-spline surface; the two degrees may differ.

use super::KnotVector;
use crate::math::{Grid, Vec3};

/// A polynomial tensor-product B-spline surface.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsSurface {
    /// Degree and knots along `u`.
    pub u: KnotVector,
    /// Degree and knots along `v`.
    pub v: KnotVector,
    /// `net[(i, j)]`: `i` along `u`, `j` along `v`; `u.coefficients()` x `v.coefficients()`.
    pub net: Grid<Vec3>,
}
