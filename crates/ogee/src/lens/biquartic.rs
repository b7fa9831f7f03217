//! Bi-4 subdivision: the lens that is C2, from 60 points.
//!
//! The net is that of a spline of degree (4, 4) with double knots over the w-plane, which is C2 wherever the grid is regular; the
//! square `max(|u|, |v|) <= 2` is its domain, and `max(|u|, |v|) >= 1` the ring that a net says outright. One step halves the rest. The leading
//! eigenvalues of a step are 1, 1/4 twice and 1/16 three times, with `1`, `w^2` and its products for eigenfunctions, and the next
//! is 0.0204: so the limit has a quadratic expansion in `x + i y = w^2` at the lens.

use super::biquartic_matrix::{BIQUARTIC_POINTS, MATRIX, RAISING};
use super::biquartic_tables::{LIMIT_MASKS, LimitMask};
use super::layout::{BICUBIC_POINTS, Quadrant, lattice_index};
use super::quartic::BEZIER;
use super::refit::refitted;
use crate::math::{Grid, SurfaceJet, Vec3};

/// How a bi-3 net becomes a bi-4 one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Entry {
    /// The same ring, written with degree 4.
    DegreeRaise,
    /// Figure 10: the inner points of the ring are chosen anew, which makes curvature run more evenly. The outside is met with
    /// equal derivatives up to the second, as by the other entry; the lens vertex itself has no influence.
    #[default]
    Refit,
}

/// A bi-4 net around a lens.
#[derive(Clone, Debug, PartialEq)]
pub struct Biquartic {
    /// The points with the numbers 1 to 60; see [`lattice_index`], with grid points in half integers.
    pub points: [Vec3; BIQUARTIC_POINTS],
}

/// A patch of a ring, over a unit square of a quadrant of the w-plane.
#[derive(Clone, Debug, PartialEq)]
pub struct RingPatch {
    /// The quadrant.
    pub quadrant: Quadrant,
    /// The square `[a, a + 1] x [b, b + 1]`: `[1, 0]`, `[1, 1]` or `[0, 1]`.
    pub cell: [usize; 2],
    /// Bezier points of degree (4, 4): `net[(i, j)]`, `i` along `u`. `du x dv` points as the cage's faces do.
    pub net: Grid<Vec3>,
}

/// A surface near a lens to second order: `p + x d1 + y d2 + x^2 d11 + x y d12 + y^2 d22`, with `x + i y = w^2` and `w` in
/// parameters of the net that it was made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadraticExpansion {
    /// The limit point `p` of the lens vertex.
    pub position: Vec3,
    /// The first derivatives `d1` and `d2`.
    pub first: [Vec3; 2],
    /// The coefficients of second order `d11`, `d12` and `d22`: twice `d11` and `d22` are second derivatives.
    pub second: [Vec3; 3],
}

impl Biquartic {
    /// A bi-4 net that joins the bi-3 surface of `net`, points 0 to 24, at `max(|u|, |v|) = 2`.
    pub fn from_bicubic(net: &[Vec3; BICUBIC_POINTS], entry: Entry) -> Biquartic {
        let raised = Biquartic { points: std::array::from_fn(|k| combined(RAISING.row(k + 1), |n| net[n])) };
        match entry {
            Entry::DegreeRaise => raised,
            Entry::Refit => refitted(net, raised),
        }
    }

    /// A point by its number, 1 to 60.
    pub fn point(&self, number: usize) -> Vec3 {
        self.points[number - 1]
    }

    /// One step: the net of the same surface over the square of half the size.
    pub fn step(&self) -> Biquartic {
        Biquartic { points: std::array::from_fn(|k| combined(MATRIX.row(k + 1), |n| self.point(n))) }
    }

    /// The six patches of the ring: those of the first quadrant over `[1, 2] x [0, 1]`, `[1, 2] x [1, 2]` and `[0, 1] x [1, 2]`, then
    /// those of the second. Bezier points on common sides are the same bits.
    pub fn ring_patches(&self) -> [RingPatch; 6] {
        let cells = [[1, 0], [1, 1], [0, 1]];
        let patch = |k: usize| self.ring_patch(Quadrant::BOTH[k / 3], cells[k % 3]);
        let mut patches: [RingPatch; 6] = std::array::from_fn(patch);
        // The last patch of a quadrant begins where the first of the other does, read the other way: sums in another order.
        for (last, first) in [(2, 3), (5, 0)] {
            for i in 0..5 {
                patches[last].net[(0, i)] = patches[first].net[(i, 0)];
            }
        }
        patches
    }

    fn ring_patch(&self, quadrant: Quadrant, cell: [usize; 2]) -> RingPatch {
        RingPatch { quadrant, cell, net: bezier_net(quadrant, cell, |number| self.point(number)) }
    }

    /// The surface near the lens, by [`LIMIT_MASKS`].
    pub fn expansion(&self) -> QuadraticExpansion {
        // Relative to a point of the net, so that far from the origin no digits are lost.
        let base = self.points[0];
        let mask = |LimitMask { denominator, numerators }: &LimitMask| {
            let terms = (1..).zip(numerators);
            let sum =
                terms.fold(Vec3::ZERO, |sum, (n, &weight)| sum + weight as f64 * (self.point(n) - base));
            sum / *denominator as f64
        };
        let [position, d1, d2, d11, d12, d22] = LIMIT_MASKS.each_ref().map(mask);
        QuadraticExpansion { position: base + position, first: [d1, d2], second: [d11, d12, d22] }
    }
}

impl QuadraticExpansion {
    /// Position and derivatives in `x` and `y`, at the lens itself.
    pub fn jet(&self) -> SurfaceJet {
        self.at(0.0, 0.0)
    }

    /// Position and derivatives in `x` and `y`.
    pub fn at(&self, x: f64, y: f64) -> SurfaceJet {
        let ([d1, d2], [d11, d12, d22]) = (self.first, self.second);
        SurfaceJet {
            position: self.position + x * d1 + y * d2 + x * x * d11 + x * y * d12 + y * y * d22,
            du: d1 + 2.0 * x * d11 + y * d12,
            dv: d2 + x * d12 + 2.0 * y * d22,
            duu: 2.0 * d11,
            duv: d12,
            dvv: 2.0 * d22,
        }
    }
}

/// Bezier points over the square `[a, a + 1] x [b, b + 1]` of a quadrant. Coefficients are asked for by number; the centre has the
/// number 0 and counts over `[0, 1] x [0, 1]` alone.
pub(super) fn bezier_net(
    quadrant: Quadrant,
    cell: [usize; 2],
    coefficient: impl Fn(usize) -> Vec3,
) -> Grid<Vec3> {
    let first = cell.map(|at| 2 * at as i32 - 1);
    let coefficients = Grid::from_fn(5, 5, |m, n| {
        let (i, j) = quadrant.point(first[0] + m as i32, first[1] + n as i32);
        coefficient(lattice_index(i, j))
    });
    let sum = |weights: &[f64; 5], point: &dyn Fn(usize) -> Vec3| {
        (0..5).fold(Vec3::ZERO, |sum, k| sum + weights[k] * point(k))
    };
    let rows = Grid::from_fn(5, 5, |m, n| sum(&BEZIER[n], &|k| coefficients[(m, k)]));
    Grid::from_fn(5, 5, |m, n| sum(&BEZIER[m], &|k| rows[(k, n)]))
}

/// A weighted sum of points.
pub(super) fn combined(row: &[(usize, f64)], point: impl Fn(usize) -> Vec3) -> Vec3 {
    row.iter().fold(Vec3::ZERO, |sum, &(number, weight)| sum + weight * point(number))
}
