//! Constants of an interior extraordinary vertex of valence `n`: eigenvalue, eigenvector ring, tangent length.

use std::f64::consts::{PI, TAU};

/// Constants of the natural configuration, the subdominant eigenvector of Catmull-Clark at valence `n`, with
/// neighbours at distance one. `docs/methods/pccm.md`, Notation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constants {
    /// `cos(2 pi / n)`.
    pub(crate) c: f64,
    /// Ratio of the weights on neighbours and on diagonals in the limit tangent mask.
    pub(crate) kappa: f64,
    /// Length of the tangent that keeps the length of the projected knot-insertion tangents.
    pub(crate) length_project: f64,
    /// Length of the tangent for which nothing moves beyond the first cell, to first order.
    pub(crate) length_clamp: f64,
}

impl Constants {
    pub(crate) fn new(n: u32) -> Constants {
        let n = f64::from(n);
        let c = (TAU / n).cos();
        let half = (PI / n).cos();
        let kappa = 1.0 + c + half * (2.0 * (9.0 + c)).sqrt();
        let lambda = (kappa + 4.0) / 16.0;
        // Real part of the first ring's diagonal f = (8 cos(pi/n) / kappa) w with w = e^{i pi/n}.
        let f_re = 8.0 * half / kappa * half;
        // Second ring relative to its spoke, x real, y complex, of which only the real part enters the lengths:
        //   64 lambda x = 36 + 6 x + 12 Re f + 2 Re y + 2 c
        //   16 lambda y = 6 (1 + f) + w^2 + x + y, Re w^2 = c
        let a = 64.0 * lambda - 6.0;
        let b = 16.0 * lambda - 1.0;
        let right_x = 36.0 + 12.0 * f_re + 2.0 * c;
        let right_y = 6.0 * (1.0 + f_re) + c;
        // a x - 2 y = right_x,  -x + b y = right_y
        let determinant = a * b - 2.0;
        let x = (right_x * b + 2.0 * right_y) / determinant;
        let y_re = (a * right_y + right_x) / determinant;
        let length_project = 2.0 / 3.0 * (c / 3.0) + (2.0 + f_re) / 9.0;
        let b_20 = c / 9.0 + 2.0 / 3.0 * (2.0 + f_re) / 3.0;
        let b_40 = 2.0 / 3.0 * (2.0 + f_re) / 3.0 + (2.0 * x + y_re) / 9.0;
        Constants { c, kappa, length_project, length_clamp: (5.0 * b_20 - b_40) / 6.0 }
    }

    /// Weights `(alpha, beta)` of neighbours and diagonals in the tangent, for a tangent length.
    pub(crate) fn weights(&self, length: f64) -> (f64, f64) {
        let beta = length / (self.kappa + 8.0 * (1.0 + self.c) / self.kappa);
        (self.kappa * beta, beta)
    }
}
