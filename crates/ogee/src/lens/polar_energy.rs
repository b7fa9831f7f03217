//! The least squares of a polar cap: from circles and pole to what is left open, as a matrix.
//!
//! Of all caps that join their surroundings C2, the one is taken whose derivatives of order `k` are least: the integrals of their
//! squares over the unit square of every patch, with binomial weights, summed over patches. The minimum is linear in the data,
//! and the matrix depends on the number of sectors alone.

use super::polar_error::{PolarDefect, PolarError};
use super::polar_sector::{EXPANSION, PolarVariant, SectorData, UnitLoop, around, binomial};
use crate::math::{Grid, Interpolate, Vec3};
use faer::linalg::solvers::Solve;

/// Weights a point of a patch of one sector can have: three unknown rings of four, the expansion, three circles of four, the
/// pole.
const LOCAL: usize = 12 + EXPANSION + 13;

/// The linear map from circles and pole to the unknowns of a polar cap.
///
/// It depends on the number of sectors and the variant alone: one operator serves every cap of as many sectors. Making one costs
/// as much as the Cholesky factors of a matrix of `3 n + 5` rows (`n + 5` for [`PolarVariant::SixSix`]).
#[derive(Clone, Debug, PartialEq)]
pub struct PolarOperator {
    sectors: usize,
    variant: PolarVariant,
    weights: Grid<f64>,
}

impl PolarOperator {
    /// The operator of `sectors` sectors.
    ///
    /// # Errors
    /// If there are fewer than three sectors.
    pub fn new(sectors: usize, variant: PolarVariant) -> Result<PolarOperator, PolarError> {
        if sectors < 3 {
            return Err(PolarDefect::TooFewSectors { sectors, least: 3 }.into());
        }
        let rings = variant.unknown_rings();
        let (unknowns, given) = (rings * sectors + EXPANSION, 3 * sectors + 1);
        let mut own = faer::Mat::<f64>::zeros(unknowns, unknowns);
        let mut right = faer::Mat::<f64>::zeros(unknowns, given);
        let unit = UnitLoop::new(sectors);
        for sector in 0..sectors {
            let energy = sector_energy(variant, &unit, sector);
            let place = places(sector, sectors, rings);
            for (a, &row) in place.iter().enumerate() {
                let Place::Unknown(i) = row else { continue };
                for (b, &column) in place.iter().enumerate() {
                    match column {
                        Place::Unknown(j) => own[(i, j)] += energy[(a, b)],
                        Place::Given(j) => right[(i, j)] -= energy[(a, b)],
                        Place::Unused => {}
                    }
                }
            }
        }
        // Sums of squares that vanish together only at zero are positive definite; where rounding says otherwise the numbers are
        // of no use.
        let factors = own.llt(faer::Side::Lower).map_err(|_| PolarDefect::NotFinite)?;
        let solution = factors.solve(&right);
        let weights = Grid::from_fn(unknowns, given, |i, j| solution[(i, j)]);
        Ok(PolarOperator { sectors, variant, weights })
    }

    /// Number of sectors `n`.
    pub fn sectors(&self) -> usize {
        self.sectors
    }

    /// The variant.
    pub fn variant(&self) -> PolarVariant {
        self.variant
    }

    /// The weights. Rows: the unknown rings `b0 b1 b2` (of 66 the ring `a3`), `n` control points each, then `t1 t2 h11 h12 h22`.
    /// Columns: the circles `c1 c2 c3`, then the pole. Rows of rings sum to one, the others to zero.
    pub fn weights(&self) -> &Grid<f64> {
        &self.weights
    }

    /// The unknowns of a cap whose pole is the origin.
    pub(super) fn unknowns(&self, circles: [&[Vec3]; 3]) -> Vec<Vec3> {
        let row = |i: usize| {
            let terms = self.weights.row(i).iter().zip(circles.into_iter().flatten());
            terms.fold(Vec3::ZERO, |sum, (&weight, &point)| sum + weight * point)
        };
        (0..self.weights.rows()).map(row).collect()
    }
}

/// Where a weight of a sector belongs in the whole system.
#[derive(Clone, Copy)]
enum Place {
    Unknown(usize),
    Given(usize),
    Unused,
}

/// The places of the weights of a sector, in the order of [`sector_energy`].
fn places(sector: usize, sectors: usize, rings: usize) -> Vec<Place> {
    let meridians = around(sector, sectors);
    let ring = |ring: usize| meridians.map(|meridian| ring * sectors + meridian);
    let mut places = Vec::with_capacity(LOCAL);
    for k in 0..3 {
        places.extend(ring(k).map(|i| if k < rings { Place::Unknown(i) } else { Place::Unused }));
    }
    places.extend((0..EXPANSION).map(|i| Place::Unknown(rings * sectors + i)));
    for k in 0..3 {
        places.extend(ring(k).map(Place::Given));
    }
    places.push(Place::Given(3 * sectors));
    places
}

/// The energy of a sector as a quadratic form of its data.
fn sector_energy(variant: PolarVariant, unit: &UnitLoop, sector: usize) -> Grid<f64> {
    let weight = |k: usize| {
        let mut weights = [0.0; LOCAL];
        weights[k] = 1.0;
        weights
    };
    let four = |first: usize| [0, 1, 2, 3].map(|k| weight(first + k));
    let data = SectorData {
        unknown: (0..variant.unknown_rings()).map(|ring| four(4 * ring)).collect(),
        expansion: [12, 13, 14, 15, 16].map(weight),
        circles: [17, 21, 25].map(four),
        pole: weight(LOCAL - 1),
    };
    let mut energy = Grid::from_fn(LOCAL, LOCAL, |_, _| 0.0);
    for patch in data.patches(variant, unit, sector) {
        for (weights, image) in derivatives(&patch, variant.energy_order()) {
            for (row, image) in weights.cells().iter().zip(image.cells()) {
                for (a, &weight) in row.iter().enumerate().filter(|term| *term.1 != 0.0) {
                    for (b, &value) in image.iter().enumerate() {
                        energy[(a, b)] += weight * value;
                    }
                }
            }
        }
    }
    energy
}

/// The energy of a patch: of the squares of its derivatives of order `order`, in its unit square, summed over coordinates.
pub(super) fn patch_energy(net: &Grid<Vec3>, order: usize) -> f64 {
    let squares = |(points, image): (Grid<Vec3>, Grid<Vec3>)| -> f64 {
        points.cells().iter().zip(image.cells()).map(|(point, image)| point.dot(*image)).sum()
    };
    derivatives(net, order).map(squares).sum()
}

/// The derivatives of order `order` of a patch, `i` times along `u` and `order - i` times along `v`, as Bezier points; beside each
/// its image: the products of both, summed, are `C(order, i)` times the integral of the derivative's square.
fn derivatives<T: Interpolate>(net: &Grid<T>, order: usize) -> impl Iterator<Item = (Grid<T>, Grid<T>)> + '_ {
    let (p, q) = (net.rows() - 1, net.cols() - 1);
    let both = move |i: usize| {
        let mut points = net.clone();
        for _ in 0..order - i {
            points = differentiated(&points);
        }
        points = points.transposed();
        for _ in 0..i {
            points = differentiated(&points);
        }
        points = points.transposed();
        let (along_u, along_v) = (products(p - i), products(q + i - order));
        let half = Grid::from_fn(points.rows(), points.cols(), |a, b| {
            let column = (0..points.rows()).map(|c| &points[(c, b)]);
            weighted(binomial(order, i), along_u.row(a), column)
        });
        let image =
            Grid::from_fn(points.rows(), points.cols(), |a, b| weighted(1.0, along_v.row(b), half.row(a)));
        (points, image)
    };
    (order.saturating_sub(q)..=order.min(p)).map(both)
}

fn weighted<'a, T: Interpolate + 'a>(
    factor: f64,
    weights: &[f64],
    terms: impl IntoIterator<Item = &'a T>,
) -> T {
    let mut sum = T::zero();
    weights.iter().zip(terms).for_each(|(&weight, term)| sum.add_scaled(factor * weight, term));
    sum
}

/// The derivative along `v` of a Bezier patch.
fn differentiated<T: Interpolate>(net: &Grid<T>) -> Grid<T> {
    let degree = (net.cols() - 1) as f64;
    Grid::from_fn(net.rows(), net.cols() - 1, |i, j| {
        weighted(degree, &[1.0, -1.0], [&net[(i, j + 1)], &net[(i, j)]])
    })
}

/// The integrals over `[0, 1]` of products of two Bernstein polynomials.
fn products(degree: usize) -> Grid<f64> {
    Grid::from_fn(degree + 1, degree + 1, |a, b| {
        binomial(degree, a) * binomial(degree, b) / ((2 * degree + 1) as f64 * binomial(2 * degree, a + b))
    })
}
