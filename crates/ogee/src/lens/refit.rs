//! Figure 10: the bi-4 net whose next ring is nearest to a bi-3 surface.
//!
//! Points of the layers 3 to 5 are those of the bi-3 surface, which is met outside. The 24 points inside come from points `q` that, taken one step
//! further, give these with the least sum of squares: `min || R q - D p ||`, where `R` has the rows 13 to 60 of a bi-4 step and
//! `D` those of degree raising.

use super::biquartic::{Biquartic, combined};
use super::biquartic_matrix::{BIQUARTIC_POINTS, MATRIX, RAISING};
use super::layout::BICUBIC_POINTS;
use crate::math::{Grid, Vec3};
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use std::sync::LazyLock;

/// Unknown points of figure 10, and points of a bi-3 net that they depend on: numbers 1 to 24 of both.
const INNER: usize = 24;

/// Points that layers 1 and 2 hold.
const SPECIAL: usize = 12;

/// The operator of figure 10, `Q = (R^T R)^-1 R^T D`: 24 x 24, from the points 1 to 24 of a bi-3 net to `q`.
pub fn refit_operator() -> &'static Grid<f64> {
    static OPERATOR: LazyLock<Grid<f64>> = LazyLock::new(solve);
    &OPERATOR
}

fn solve() -> Grid<f64> {
    let dense = |row: fn(usize) -> &'static [(usize, f64)]| {
        let mut matrix = Mat::<f64>::zeros(BIQUARTIC_POINTS - SPECIAL, INNER);
        for k in 0..BIQUARTIC_POINTS - SPECIAL {
            for &(number, weight) in row(SPECIAL + 1 + k) {
                matrix[(k, number - 1)] = weight;
            }
        }
        matrix
    };
    let (step, raise) = (dense(|number| MATRIX.row(number)), dense(|number| RAISING.row(number)));
    let normal = step.transpose() * &step;
    let right = step.transpose() * &raise;
    let factors = normal.llt(Side::Lower).expect("the rows of a bi-4 step have full rank");
    let operator = factors.solve(&right);
    Grid::from_fn(INNER, INNER, |i, j| operator[(i, j)])
}

/// The net of figure 10; `raised` is that of plain degree raising.
pub(super) fn refitted(net: &[Vec3; BICUBIC_POINTS], raised: Biquartic) -> Biquartic {
    let operator = refit_operator();
    // Relative to a point of the net: the rows sum to 1 but for rounding.
    let base = net[1];
    let unknowns: [Vec3; INNER] =
        std::array::from_fn(|i| (0..INNER).fold(base, |sum, j| sum + operator[(i, j)] * (net[j + 1] - base)));
    let mut points = raised.points;
    for (k, point) in points.iter_mut().enumerate().take(SPECIAL) {
        *point = combined(MATRIX.row(k + 1), |number| unknowns[number - 1]);
    }
    Biquartic { points }
}
