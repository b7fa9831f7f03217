//! Weights made from nothing but their class.

use faer::Mat;

use super::fan::{Fan, SECTOR};
use super::solve::solve;
use super::{COEFFICIENTS, CapClass, INNER, Weights, energy, is_solvable, planar_map};
use crate::math::{Grid, par};

/// The weights of a class, as `docs/methods/g2_caps.md` derives them: of all coefficients that fulfil the conditions those with the
/// least third derivatives in the plane of [`planar_map`](super::planar_map()).
///
/// `None` if [`is_solvable`] says no. Nothing is kept: [`weights`](super::weights()) is what one usually wants.
pub fn generate(class: CapClass) -> Option<Weights> {
    if !is_solvable(class) {
        return None;
    }
    let angle = class.sector_angle();
    let energies =
        planar_map::of_class(class)?.iter().map(|map| energy::planar(map)).collect::<Option<Vec<_>>>()?;
    let sectors = if class.is_closed() {
        let mode = |k| Some(solve(&Fan::mode(angle, angle * k as f64).system(), &energies)?.coefficients);
        let modes = par::map(class.sectors() / 2 + 1, mode);
        vec![interior(class, &modes.into_iter().collect::<Option<Vec<_>>>()?)]
    } else {
        open(class, &solve(&Fan::whole(class).system(), &energies)?.coefficients)
    };
    Some(cleaned(class, &sectors))
}

/// The number among all coefficients of a sector of an inner one.
fn inner(row: usize) -> usize {
    COEFFICIENTS * (row / INNER) + row % INNER
}

/// The weights of all sectors of an open fan: its coefficients as they are.
fn open(class: CapClass, coefficients: &Mat<f64>) -> Vec<Grid<f64>> {
    let weight = |sector: usize, row, column| coefficients[(SECTOR * sector + inner(row), column)];
    let weights =
        |sector| Grid::from_fn(INNER * INNER, class.columns(), |row, column| weight(sector, row, column));
    (0..class.sectors()).map(weights).collect()
}

/// The weights of sector 0 from the coefficients of all Fourier modes, real parts above imaginary ones; mode `k` stands for
/// `n - k` too.
fn interior(class: CapClass, modes: &[Mat<f64>]) -> Grid<f64> {
    /// Columns of a mode, `E P10 P20 P11 P21 P12 P22`, in the order of an interior vertex, `P10 P11 P20 P21 P12 P22`.
    const ORDER: [usize; 6] = [1, 3, 2, 4, 5, 6];
    let n = class.sectors();
    Grid::from_fn(INNER * INNER, class.columns(), |row, column| {
        let row = inner(row);
        let Some(place) = column.checked_sub(1) else { return modes[0][(row, 0)] };
        let (sector, number) = (place / 6, ORDER[place % 6]);
        let part = |(k, mode): (usize, &Mat<f64>)| {
            let times = if k == 0 || 2 * k == n { 1.0 } else { 2.0 };
            let angle = std::f64::consts::TAU * (k * sector % n) as f64 / n as f64;
            times * (mode[(row, number)] * angle.cos() + mode[(SECTOR + row, number)] * angle.sin())
        };
        modes.iter().enumerate().map(part).sum::<f64>() / n as f64
    })
}

/// Exactly symmetric, and with rows that sum to one: what rounding has left over goes to the vertex itself.
fn cleaned(class: CapClass, sectors: &[Grid<f64>]) -> Weights {
    let mirror = class.mirrored_columns();
    let symmetric = |(sector, weights): (usize, &Grid<f64>)| {
        let image = &sectors[class.mirrored_sector(sector)];
        let mut mean = Grid::from_fn(weights.rows(), weights.cols(), |row, column| {
            let transposed = INNER * (row % INNER) + row / INNER;
            (weights[(row, column)] + image[(transposed, mirror[column])]) / 2.0
        });
        for row in 0..mean.rows() {
            mean[(row, 0)] += 1.0 - mean.row(row).iter().sum::<f64>();
        }
        mean
    };
    Weights { class, sectors: sectors.iter().enumerate().map(symmetric).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::g2_caps::CornerAngle;
    use crate::g2_caps::system::System;

    /// The rank of the conditions, and how many coefficients they leave free. Any energy will do.
    fn rank(system: &System) -> (usize, usize) {
        let rank =
            solve(system, &[Mat::identity(SECTOR, SECTOR)]).expect("the conditions can be fulfilled").rank;
        (rank, system.free.len() - rank)
    }

    #[test]
    fn modes_have_their_rank() {
        for valence in [3_u32, 5, 6, 7, 8, 9, 12] {
            let angle = CapClass::Interior { valence }.sector_angle();
            for k in 0..=valence / 2 {
                let wanted = match (valence, k) {
                    (3, 0) => 63,
                    (3, 1) | (_, 0) => 62,
                    (_, 1 | 2) | (6, 3) => 61,
                    _ => 60,
                };
                // Real and imaginary parts count each.
                let found = rank(&Fan::mode(angle, angle * f64::from(k)).system());
                assert_eq!(found, (200 - 2 * wanted, 2 * wanted), "mode {k} of {valence}");
            }
        }
    }

    #[test]
    fn open_fans_have_their_rank() {
        use CornerAngle::{Concave, Convex};
        let boundary = |faces| CapClass::Boundary { faces };
        let corner = |faces, angle| CapClass::Corner { faces, angle };
        let dart = |valence| CapClass::Dart { valence };
        let cases = [
            (boundary(3), 280, 77),
            (boundary(4), 380, 117),
            (corner(2, Convex), 180, 39),
            (corner(2, Concave), 180, 39),
            (corner(3, Convex), 280, 79),
            (corner(3, Concave), 280, 59),
            (dart(3), 300, 87),
            (dart(4), 400, 97),
        ];
        for (class, free, wanted) in cases {
            let system = Fan::whole(class).system();
            assert_eq!(rank(&system), (wanted, free - wanted), "{class:?}");
        }
    }

    #[test]
    fn what_has_no_cap_has_no_weights() {
        let interior = [0, 1, 2, 4, 65, u32::MAX].map(|valence| CapClass::Interior { valence });
        let boundary = [0, 1, 2, 13, u32::MAX].map(|faces| CapClass::Boundary { faces });
        let corner = [0, 1, 13, u32::MAX].map(|faces| CapClass::Corner { faces, angle: CornerAngle::Convex });
        let dart = [0, 1, 2, 13, u32::MAX].map(|valence| CapClass::Dart { valence });
        for class in interior.into_iter().chain(boundary).chain(corner).chain(dart) {
            assert!(generate(class).is_none(), "{class:?}");
            assert!(planar_map(class).is_none(), "{class:?}");
        }
    }
}
