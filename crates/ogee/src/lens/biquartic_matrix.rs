//! The matrix of a bi-4 step: rows of exact weights over the points of a net.

use super::biquartic_tables::{RECOVERY, STENCILS};
use super::layout::{lattice_index, lattice_point};
use super::quartic::{raised, refined};
use std::sync::LazyLock;

/// Points of a bi-4 net: layers 1 to 5 of the half integers.
pub const BIQUARTIC_POINTS: usize = 60;

/// What the numerators of [`biquartic_matrix`] are divided by.
pub const MATRIX_DENOMINATOR: i64 = 1 << 26;

/// What the numerators of [`degree_raising`] are divided by.
pub const RAISING_DENOMINATOR: i64 = 144;

/// Weights of one point: numbers of points, in order, and numerators.
pub type ExactRow = Vec<(usize, i64)>;

/// The matrix of a bi-4 step over [`MATRIX_DENOMINATOR`]. Row `k` makes point `k + 1` from the points whose numbers, 1 to 60, are in it;
/// none beyond 24 are.
///
/// Rows of the layers 3, 4 and 5 are the tensor products of refining a quartic spline with double knots; the others are the
/// paper's twelve stencils.
pub fn biquartic_matrix() -> Vec<ExactRow> {
    let special = RECOVERY.iter().map(|&(base, symmetry)| {
        let stencil = &STENCILS[base];
        let scale = MATRIX_DENOMINATOR / stencil.denominator;
        let terms = (1..).zip(&stencil.numerators).map(|(number, n)| (symmetry.image(number), scale * n));
        joined(terms.collect())
    });
    let regular = (special.len() + 1..=BIQUARTIC_POINTS).map(|number| {
        let scale = MATRIX_DENOMINATOR / 256;
        joined(tensor(number, refined).map(|(old, n)| (old, scale * n)).collect())
    });
    special.chain(regular).collect()
}

/// How a bi-3 net becomes a bi-4 net of the same surface, over [`RAISING_DENOMINATOR`]. Row `k` makes point `k + 1` from points with
/// numbers 0 to 24.
pub fn degree_raising() -> Vec<ExactRow> {
    (1..=BIQUARTIC_POINTS).map(|number| joined(tensor(number, raised).collect())).collect()
}

/// The product of the masks of both directions, on an even function.
fn tensor(number: usize, mask: fn(i32) -> [(i32, i64); 3]) -> impl Iterator<Item = (usize, i64)> {
    let (i, j) = lattice_point(number);
    let (along_i, along_j) = (mask(i), mask(j));
    along_i.into_iter().flat_map(move |(a, s)| along_j.map(|(b, t)| (lattice_index(a, b), s * t)))
}

/// Sorts terms by number, sums those on one number, drops zeros.
fn joined(mut terms: ExactRow) -> ExactRow {
    terms.sort_unstable();
    terms.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
    terms.retain(|term| term.1 != 0);
    terms
}

/// Rows of numbers for arithmetic.
pub(super) struct Rows(Vec<Vec<(usize, f64)>>);

impl Rows {
    fn new(exact: Vec<ExactRow>, denominator: i64) -> Rows {
        let weight = |(number, n): (usize, i64)| (number, n as f64 / denominator as f64);
        Rows(exact.into_iter().map(|row| row.into_iter().map(weight).collect()).collect())
    }

    /// The weights of point `number`.
    pub(super) fn row(&self, number: usize) -> &[(usize, f64)] {
        &self.0[number - 1]
    }
}

/// [`biquartic_matrix`] as numbers, none of which is rounded.
pub(super) static MATRIX: LazyLock<Rows> =
    LazyLock::new(|| Rows::new(biquartic_matrix(), MATRIX_DENOMINATOR));

/// [`degree_raising`] as numbers.
pub(super) static RAISING: LazyLock<Rows> =
    LazyLock::new(|| Rows::new(degree_raising(), RAISING_DENOMINATOR));
