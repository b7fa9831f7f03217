//! The fairest coefficients that fulfil the conditions: least squares in the null space of the conditions.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

use super::fan::SECTOR;
use super::system::System;

/// Pivots below this share of the greatest are zero. They lie above 1e-6 or at rounding, with nothing between.
const RANK: f64 = 1e-10;

/// The largest residual of conditions that count as solvable.
const SOLVABLE: f64 = 1e-9;

/// All coefficients of a system in terms of its columns.
pub(super) struct Solution {
    /// A row for each coefficient.
    pub(super) coefficients: Mat<f64>,
    /// How many independent conditions there are.
    #[cfg(test)]
    pub(super) rank: usize,
}

/// The coefficients for which the energy is least. It is given as a factor for each sector, or one for all. `None` where the conditions
/// contradict what is given.
pub(super) fn solve(system: &System, energies: &[Mat<f64>]) -> Option<Solution> {
    let System { given, free, conditions } = system;
    let right = -(conditions * given);
    // Transposed: the first columns of Q are what the conditions see, the others their null space.
    let seen = Mat::from_fn(free.len(), conditions.nrows(), |i, j| conditions[(j, free[i])]);
    let factors = seen.col_piv_qr();
    let pivots =
        factors.thin_R().diagonal().column_vector().iter().map(|pivot| pivot.abs()).collect::<Vec<_>>();
    let greatest = pivots.first().copied()?;
    let rank = pivots.iter().take_while(|&&pivot| pivot > RANK * greatest).count();
    let basis = factors.compute_Q();
    let (range, kernel) = (basis.get(.., ..rank), basis.get(.., rank..));
    let order = factors.P().arrays().0;
    let least_norm = |right: &Mat<f64>| {
        let mut parts = Mat::from_fn(rank, right.ncols(), |i, j| right[(order[i], j)]);
        factors.thin_R().get(..rank, ..rank).transpose().solve_lower_triangular_in_place(&mut parts);
        range * parts
    };
    let residual = |particular: &Mat<f64>| &right - seen.transpose() * particular;
    let mut particular = least_norm(&right);
    particular += least_norm(&residual(&particular));
    // Written so that what is not a number is no solution either.
    if !residual(&particular).norm_max().le(&SOLVABLE) {
        return None;
    }

    let spread = |part: &Mat<f64>| {
        let mut all = Mat::zeros(given.nrows(), part.ncols());
        for (i, &row) in free.iter().enumerate() {
            all.row_mut(row).copy_from(part.row(i));
        }
        all
    };
    let weigh = |all: &Mat<f64>| {
        let mut weighed = Mat::zeros(all.nrows(), all.ncols());
        for rows in (0..all.nrows()).step_by(SECTOR) {
            let sector = &energies[rows / SECTOR % energies.len()] * all.get(rows..rows + SECTOR, ..);
            weighed.get_mut(rows..rows + SECTOR, ..).copy_from(sector);
        }
        weighed
    };
    let start = given + spread(&particular);
    let amounts = weigh(&spread(&kernel.to_owned())).qr().solve_lstsq(weigh(&start));
    let fair = start - spread(&(kernel * amounts));
    // Rounding has left something of the conditions.
    let coefficients = &fair + spread(&least_norm(&-(conditions * &fair)));
    Some(Solution {
        coefficients,
        #[cfg(test)]
        rank,
    })
}
