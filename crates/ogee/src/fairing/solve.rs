//! The least of a quadratic energy subject to linear rows: a sparse system with multipliers, symmetric and indefinite. It is
//! factored once with pivots (`faer`), and refined until only rounding is left.

use super::energy::Rows;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

/// What keeps the system regular where energy and rows leave something open: of all solutions, the nearest. A part of the
/// energy's mean diagonal.
const NEAREST: f64 = 1e-10;

/// Relative residuals below this are rounding.
const ROUNDING: f64 = 1e-15;

/// Rounds of refinement.
const MOST_ROUNDS: usize = 12;

/// A solution, and how well it solves.
pub(super) struct Solution {
    /// What to add to the unknowns.
    pub(super) change: Vec<f64>,
    /// What is left of the stationarity of the energy, relative to its terms.
    pub(super) stationarity: f64,
}

/// The change of unknowns that gives rows the values they lack and leaves the least energy. `energy` is the energy's matrix,
/// `slope` its gradient at the start, `steepness` the size of the terms which that is a sum of. `None` if the matrix cannot be
/// factored.
pub(super) fn solve(
    energy: &Rows,
    slope: &[f64],
    steepness: f64,
    rows: &Rows,
    lacking: &[f64],
) -> Option<Solution> {
    let (unknowns, count) = (slope.len(), slope.len() + rows.len());
    let diagonal = |i: usize| energy[i].iter().find(|term| term.0 as usize == i).map_or(0.0, |term| term.1);
    let mean = (0..unknowns).map(diagonal).sum::<f64>() / unknowns.max(1) as f64;
    let scale = if mean > 0.0 { 1.0 / mean } else { 1.0 };
    let mut triplets = Vec::new();
    for (i, row) in energy.iter().enumerate() {
        triplets.extend(row.iter().map(|&(j, value)| Triplet::new(i, j as usize, scale * value)));
        triplets.push(Triplet::new(i, i, NEAREST));
    }
    for (k, row) in (unknowns..).zip(rows) {
        for &(j, weight) in row {
            triplets.push(Triplet::new(k, j as usize, weight));
            triplets.push(Triplet::new(j as usize, k, weight));
        }
    }
    let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(count, count, &triplets).ok()?;
    let factors = matrix.sp_lu().ok()?;
    let mut change = vec![0.0; unknowns];
    let mut multipliers = vec![0.0; rows.len()];
    let mut best: Option<Solution> = None;
    let mut before = f64::INFINITY;
    for _ in 0..=MOST_ROUNDS {
        // Residuals of the system without what keeps it regular.
        let mut residual = vec![0.0; count];
        for (i, row) in energy.iter().enumerate() {
            let slope = row.iter().fold(slope[i], |sum, &(j, value)| sum + value * change[j as usize]);
            residual[i] -= scale * slope;
        }
        for (k, row) in rows.iter().enumerate() {
            residual[unknowns + k] += lacking[k];
            for &(j, weight) in row {
                let j = j as usize;
                residual[j] -= weight * multipliers[k];
                residual[unknowns + k] -= weight * change[j];
            }
        }
        let largest = |list: &[f64]| list.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let stationarity = largest(&residual[..unknowns]) / (scale * steepness).max(f64::MIN_POSITIVE);
        let size = largest(lacking).max(largest(&change)).max(f64::MIN_POSITIVE);
        let left = stationarity.max(largest(&residual[unknowns..]) / size);
        if !left.is_finite() {
            return None;
        }
        if left < before {
            best = Some(Solution { change: change.clone(), stationarity });
        }
        // Half as much or better, or there is only rounding left.
        if left <= ROUNDING || left > 0.5 * before {
            break;
        }
        before = left;
        let right = faer::Mat::from_fn(count, 1, |i, _| residual[i]);
        let step = factors.solve(&right);
        change.iter_mut().enumerate().for_each(|(i, change)| *change += step[(i, 0)]);
        multipliers.iter_mut().enumerate().for_each(|(k, multiplier)| *multiplier += step[(unknowns + k, 0)]);
    }
    best
}
