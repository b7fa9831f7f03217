//! `NurbsCurve`: a polynomial B-spline curve.

use super::KnotVector;
use crate::math::Vec3;

/// A polynomial B-spline curve.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsCurve {
    /// Degree and knots.
    pub knots: KnotVector,
    /// One coefficient per B-spline: `knots.coefficients()` of them.
    pub points: Vec<Vec3>,
}
