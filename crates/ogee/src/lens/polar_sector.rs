//! One sector of a polar cap as Bezier patches, from what it is made of.
//!
//! Everything here is linear in the data, and written once for points and for rows of weights: the same lines that make patches
//! make the matrix of the least squares ([`super::polar_energy`]).

use crate::math::{Grid, Interpolate};
use std::f64::consts::TAU;

/// Which polynomials a polar cap is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PolarVariant {
    /// Per sector a central patch of degree 6 around and 5 across, and a transition of degree 3 and 5. C2 everywhere.
    #[default]
    SixFive,
    /// As [`PolarVariant::SixFive`] with central patches of degree 5 both ways: C2 but for the pole, where the second order
    /// misses by a term that falls with the number of sectors. For 8 sectors and more.
    FiveFive,
    /// Per sector a single patch of degree 6 both ways. C2 everywhere.
    SixSix,
}

impl PolarVariant {
    /// All of them.
    pub const ALL: [PolarVariant; 3] = [PolarVariant::SixFive, PolarVariant::FiveFive, PolarVariant::SixSix];

    /// The paper's name: `65`, `55` or `66`.
    pub fn name(self) -> &'static str {
        match self {
            PolarVariant::SixFive => "65",
            PolarVariant::FiveFive => "55",
            PolarVariant::SixSix => "66",
        }
    }

    /// Rings of unknown control points: `b0`, `b1`, `b2`, or `a3` alone.
    pub fn unknown_rings(self) -> usize {
        match self {
            PolarVariant::SixFive | PolarVariant::FiveFive => 3,
            PolarVariant::SixSix => 1,
        }
    }

    /// Order of the derivatives whose squares are least.
    pub(super) fn energy_order(self) -> usize {
        match self {
            PolarVariant::SixFive | PolarVariant::FiveFive => 3,
            PolarVariant::SixSix => 4,
        }
    }

    /// Degree of the central patches around the pole.
    pub(super) fn circular_degree(self) -> usize {
        match self {
            PolarVariant::SixFive | PolarVariant::SixSix => 6,
            PolarVariant::FiveFive => 5,
        }
    }

    /// Radii between which each patch of a sector lies, from the pole outwards; the circle `y = 2` has radius 2.
    pub(super) fn radii(self) -> &'static [[f64; 2]] {
        match self {
            PolarVariant::SixFive | PolarVariant::FiveFive => &[[0.0, 1.0], [1.0, 2.0]],
            PolarVariant::SixSix => &[[0.0, 2.0]],
        }
    }
}

/// The number of tangents and second coefficients at the pole: `t1 t2 h11 h12 h22`.
pub(super) const EXPANSION: usize = 5;

/// What one sector is made of. Of every ring the four control points of its piece of the uniform periodic cubic: those of the
/// meridians before, at both sides of, and after it.
pub(super) struct SectorData<T> {
    /// The unknown rings, from the pole outwards.
    pub(super) unknown: Vec<[T; 4]>,
    /// `t1 t2`, and `h11 h12 h22`, coefficients in `E1 E2` and in `E1 E1, E1 E2, E2 E2`.
    pub(super) expansion: [T; EXPANSION],
    /// The given circles, from the pole outwards.
    pub(super) circles: [[T; 4]; 3],
    /// The pole.
    pub(super) pole: T,
}

impl<T: Interpolate> SectorData<T> {
    /// The Bezier points of the sector's patches, from the pole outwards: `[(i, j)]`, `i` outwards and `j` around.
    pub(super) fn patches(&self, variant: PolarVariant, unit: &UnitLoop, sector: usize) -> Vec<Grid<T>> {
        let unknown: Vec<Vec<T>> = self.unknown.iter().map(cubic_piece).collect();
        match (variant, &unknown[..]) {
            (PolarVariant::SixSix, rings) => {
                let mut rows = self.pole_rows(variant, 6, unit, sector);
                rows.extend(rings.iter().map(|ring| raised(ring, 6)));
                rows.extend(self.outer_rows(6, 2.0).iter().map(|row| raised(row, 6)));
                vec![grid(&rows)]
            }
            (PolarVariant::SixFive | PolarVariant::FiveFive, rings) => {
                let joint = [&rings[0], &rings[1], &rings[2]];
                let mut transition = rings.to_vec();
                transition.extend(self.outer_rows(5, 1.0));
                let mut central = self.pole_rows(variant, 5, unit, sector);
                // The prolongation of the transition that is C2 at radius 1.
                for weights in [[4.0, -4.0, 1.0], [2.0, -1.0, 0.0], [1.0, 0.0, 0.0]] {
                    central.push(raised(&combined(weights, joint), variant.circular_degree()));
                }
                vec![grid(&central), grid(&transition)]
            }
        }
    }

    /// The three rows of a patch of radial degree `degree` at the pole: they expand to `p0 + l r + q r^2`.
    fn pole_rows(&self, variant: PolarVariant, degree: usize, unit: &UnitLoop, sector: usize) -> Vec<Vec<T>> {
        let around = variant.circular_degree();
        let [first, second] = unit.piece(sector);
        let linear = [raised(&first, around), raised(&second, around)];
        let quadratic = [product(&first, &first), product(&first, &second), product(&second, &second)]
            .map(|curve| if around == 5 { reduced(&curve) } else { curve });
        let p = degree as f64;
        let row = |linear_share: f64, quadratic_share: f64| {
            let point = |k: usize| {
                let mut point = self.pole.clone();
                for (curve, tangent) in linear.iter().zip(&self.expansion) {
                    point.add_scaled(linear_share * curve[k], tangent);
                }
                for (curve, second) in quadratic.iter().zip(&self.expansion[2..]) {
                    point.add_scaled(quadratic_share * curve[k], second);
                }
                point
            };
            (0..=around).map(point).collect()
        };
        vec![row(0.0, 0.0), row(1.0 / p, 0.0), row(2.0 / p, 2.0 / (p * (p - 1.0)))]
    }

    /// The three rows of a patch of radial degree `degree` and length `length` at the circle 2, which continue the cubic outside
    /// with its value `v = (c1 + 4 c2 + c3) / 6` and its derivatives `(c3 - c1) / 2` and `c1 - 2 c2 + c3`; cubics around.
    fn outer_rows(&self, degree: usize, length: f64) -> [Vec<T>; 3] {
        let circles = self.circles.each_ref().map(cubic_piece);
        let p = degree as f64;
        let row = |slope: f64, bend: f64| {
            let weights =
                [1.0 / 6.0 - slope / 2.0 + bend, 2.0 / 3.0 - 2.0 * bend, 1.0 / 6.0 + slope / 2.0 + bend];
            combined(weights, circles.each_ref())
        };
        let square = length * length;
        [row(-2.0 * length / p, square / (p * (p - 1.0))), row(-length / p, 0.0), row(0.0, 0.0)]
    }
}

/// The periodic cubic `E` with control points `(cos 2 pi i / n, sin 2 pi i / n)`: directions around the pole.
pub(super) struct UnitLoop {
    points: Vec<[f64; 2]>,
}

impl UnitLoop {
    pub(super) fn new(sectors: usize) -> UnitLoop {
        let point = |i: usize| {
            let (sine, cosine) = (TAU * i as f64 / sectors as f64).sin_cos();
            [cosine, sine]
        };
        UnitLoop { points: (0..sectors).map(point).collect() }
    }

    /// Bezier points of both coordinates in a sector.
    fn piece(&self, sector: usize) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| cubic_piece(&around(sector, self.points.len()).map(|i| self.points[i][axis])))
    }
}

/// The meridians whose control points act on a sector: the one before it, its own two, and the one after.
pub(super) fn around(sector: usize, sectors: usize) -> [usize; 4] {
    [sectors - 1, 0, 1, 2].map(|step| (sector + step) % sectors)
}

fn combined<T: Interpolate>(weights: [f64; 3], rows: [&Vec<T>; 3]) -> Vec<T> {
    let point = |k: usize| {
        let mut point = T::zero();
        for (&weight, row) in weights.iter().zip(rows) {
            point.add_scaled(weight, &row[k]);
        }
        point
    };
    (0..rows[0].len()).map(point).collect()
}

fn grid<T: Clone>(rows: &[Vec<T>]) -> Grid<T> {
    Grid::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j].clone())
}

/// The Bezier points of a piece of a uniform cubic B-spline.
fn cubic_piece<T: Interpolate>(control: &[T; 4]) -> Vec<T> {
    const WEIGHTS: [[f64; 4]; 4] =
        [[1.0, 4.0, 1.0, 0.0], [0.0, 4.0, 2.0, 0.0], [0.0, 2.0, 4.0, 0.0], [0.0, 1.0, 4.0, 1.0]];
    let point = |weights: &[f64; 4]| {
        let mut point = T::zero();
        for (weight, control) in weights.iter().zip(control) {
            point.add_scaled(weight / 6.0, control);
        }
        point
    };
    WEIGHTS.iter().map(point).collect()
}

/// Binomial coefficient.
pub(super) fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// The same Bezier curve with a higher degree; its ends keep their bits.
pub(super) fn raised<T: Interpolate>(points: &[T], degree: usize) -> Vec<T> {
    let own = points.len() - 1;
    let by = degree - own;
    let point = |k: usize| {
        let mut point = T::zero();
        for j in k.saturating_sub(by)..=k.min(own) {
            point.add_scaled(binomial(own, j) * binomial(by, k - j) / binomial(degree, k), &points[j]);
        }
        point
    };
    (0..=degree).map(point).collect()
}

/// The product of two Bezier cubics.
fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; 7];
    for i in 0..=3 {
        for j in 0..=3 {
            out[i + j] += binomial(3, i) * binomial(3, j) / binomial(6, i + j) * a[i] * b[j];
        }
    }
    out
}

/// The curve of degree 5 with value and two derivatives of a curve of degree 6 at both ends.
fn reduced(f: &[f64]) -> Vec<f64> {
    let half = |f: [f64; 3]| [f[0], (6.0 * f[1] - f[0]) / 5.0, (f[0] - 6.0 * f[1] + 15.0 * f[2]) / 10.0];
    let [a, b, c] = half([f[0], f[1], f[2]]);
    let [z, y, x] = half([f[6], f[5], f[4]]);
    vec![a, b, c, x, y, z]
}
