//! Exact evaluation with the eigenbasis of the subdivision matrix, at smooth interior vertices.
//!
//! Stam's way (1998): a face with one extraordinary vertex is decided by a ring of `2n + 8` points. Written in
//! eigenvectors of the matrix that makes the next ring, a step only multiplies each coefficient by its eigenvalue, so a
//! point costs the same at any depth. [`crate::LimitSurface`] evaluates every face by another road; this room is there
//! to disagree with it if either is wrong, so the two share nothing but [`crate::math`].
//!
//! Stam tabulated the outcome of a numerical eigen-solver. Here everything has a closed form (`modes.rs`), because the
//! modes with their diagonals turned by half a step make symmetric blocks, and because a face sees its vertex through
//! eight points only, so that what must be solved for the outer points is the same at every valence. Formulas:
//! `docs/methods/exact_evaluation.md`.

mod modes;
mod ring;
mod spline;

use crate::math::{SurfaceJet, Vec3};
use modes::{Modes, RingCoefficients};

/// Eigenvectors and eigenvalues of refinement around a smooth interior vertex, and the surface that belongs to each.
///
/// ```
/// use ogee::{Vec3, stam::Eigenbasis};
///
/// // Valence 4 is the regular case: points on a plane in the order of the ring give that plane.
/// let grid = [
///     (0, 0), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1),
///     (2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2),
/// ];
/// let ring = grid.map(|(x, y)| Vec3::new(f64::from(x), f64::from(y), 1.0));
/// let basis = Eigenbasis::new(4);
/// let surface = basis.project(&ring);
/// let jet = surface.eval(1e-9, 0.25);
/// assert!(jet.position.distance(Vec3::new(1e-9, 0.25, 1.0)) < 1e-15);
/// assert!(jet.du.distance(Vec3::new(1.0, 0.0, 0.0)) < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Eigenbasis {
    modes: Modes,
    /// Per mode but the constant one, the 16 points of each of the three tiles of the first step.
    tiles: Vec<[[f64; 16]; 3]>,
}

/// A ring of points in the eigenbasis: the surface of one face, ready to be evaluated anywhere.
#[derive(Clone, Debug)]
pub struct Projected<'a> {
    basis: &'a Eigenbasis,
    coefficients: RingCoefficients,
}

impl Eigenbasis {
    /// The largest valence that [`Eigenbasis::new`] takes.
    pub const MAX_VALENCE: usize = 1000;

    /// The smallest `max(u, v)` at which the surface can be evaluated: beyond it second derivatives leave the range of
    /// numbers.
    pub const MIN_PARAMETER: f64 = 1e-100;

    /// The eigenbasis at valence `n`. Costs about `60 n^2` operations.
    ///
    /// # Panics
    /// If the valence is below 3 or above [`Eigenbasis::MAX_VALENCE`].
    pub fn new(valence: usize) -> Eigenbasis {
        assert!(
            (3..=Eigenbasis::MAX_VALENCE).contains(&valence),
            "valence {valence} is not in 3..={}",
            Eigenbasis::MAX_VALENCE
        );
        let modes = Modes::new(valence);
        let tiles = modes.vectors().map(|vector| ring::tiles(&ring::extended(valence, &vector))).collect();
        Eigenbasis { modes, tiles }
    }

    /// The valence it was made for.
    pub fn valence(&self) -> usize {
        self.modes.valence()
    }

    /// All eigenvalues of the matrix of one step but the first, which is 1: `2 n + 7` of them, in no particular order.
    pub fn eigenvalues(&self) -> &[f64] {
        self.modes.values()
    }

    /// Writes a ring in the eigenbasis. Costs about `12 n^2` operations.
    ///
    /// The ring is the vertex; then, `n` times, a neighbour and the diagonal between it and the next neighbour,
    /// counter-clockwise, the face being (vertex, neighbour 0, diagonal 0, neighbour 1); then the seven points around
    /// the far side of the face, at (2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2) when the face is the unit
    /// square.
    ///
    /// # Panics
    /// If there are not `2 n + 8` points.
    pub fn project(&self, ring: &[Vec3]) -> Projected<'_> {
        let wanted = 2 * self.valence() + 8;
        assert_eq!(ring.len(), wanted, "a ring of valence {} has {wanted} points", self.valence());
        Projected { basis: self, coefficients: self.modes.project(ring) }
    }

    /// One point of one ring: [`Eigenbasis::project`] and [`Projected::eval`].
    ///
    /// # Panics
    /// As these two do.
    pub fn eval(&self, ring: &[Vec3], u: f64, v: f64) -> SurfaceJet {
        self.project(ring).eval(u, v)
    }
}

impl Projected<'_> {
    /// The limit of the vertex itself: the surface at (0, 0).
    pub fn limit(&self) -> Vec3 {
        self.coefficients.limit
    }

    /// Position and derivatives at `(u, v)`, `u` along the edge to neighbour 0 and `v` along that to neighbour 1. The
    /// cost depends on the valence, not on how close to the vertex the point is.
    ///
    /// # Panics
    /// If `u` or `v` is not in `[0, 1]`, or both are below [`Eigenbasis::MIN_PARAMETER`]: derivatives at the vertex
    /// itself do not exist.
    pub fn eval(&self, u: f64, v: f64) -> SurfaceJet {
        let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        assert!(
            inside && u.max(v) >= Eigenbasis::MIN_PARAMETER,
            "({u}, {v}) is outside the face or at its vertex"
        );
        let cell = ring::Cell::new(u, v);
        let mut points = [Vec3::ZERO; 16];
        let all = self.basis.eigenvalues().iter().zip(&self.coefficients.modes).zip(&self.basis.tiles);
        for ((value, &coefficient), tiles) in all {
            // Equations (5) and (14) of the paper: the step enters as a power.
            let scaled = value.powi(cell.step - 1) * coefficient;
            for (point, &weight) in points.iter_mut().zip(&tiles[cell.tile]) {
                *point += weight * scaled;
            }
        }
        let mut jet = spline::jet(&points, cell.s, cell.t, cell.scale);
        jet.position += self.coefficients.limit;
        jet
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ring::tests::wobbly_ring;

    /// The same surface by multiplying with the matrix of one step.
    fn by_multiplication(valence: usize, ring: &[Vec3], u: f64, v: f64) -> SurfaceJet {
        let cell = ring::Cell::new(u, v);
        let mut ring = ring.to_vec();
        for _ in 1..cell.step {
            ring = ring::extended(valence, &ring);
            ring.truncate(2 * valence + 8);
        }
        spline::jet(&ring::tiles(&ring::extended(valence, &ring))[cell.tile], cell.s, cell.t, cell.scale)
    }

    #[test]
    fn agrees_with_repeated_multiplication() {
        for valence in (3..=50).chain([100, 200, 1000]) {
            let ring = wobbly_ring(valence);
            let basis = Eigenbasis::new(valence);
            let surface = basis.project(&ring);
            for (a, b) in [(1.0, 1.0), (0.7, 0.2), (0.0, 0.9), (0.3, 0.8), (1.0, 0.0)] {
                for depth in [0, 1, 2, 5, 9] {
                    let scale = 0.5_f64.powi(depth);
                    let (u, v) = (scale * a, scale * b);
                    let (found, wanted) = (surface.eval(u, v), by_multiplication(valence, &ring, u, v));
                    let pairs = [
                        (found.position, wanted.position, 1e-14),
                        (found.du, wanted.du, 1e-12 / scale),
                        (found.dv, wanted.dv, 1e-12 / scale),
                        (found.duu, wanted.duu, 1e-12 / scale / scale),
                        (found.duv, wanted.duv, 1e-12 / scale / scale),
                        (found.dvv, wanted.dvv, 1e-12 / scale / scale),
                    ];
                    for (found, wanted, tolerance) in pairs {
                        let error = found.distance(wanted);
                        assert!(error < tolerance, "valence {valence} at ({u}, {v}): {error}");
                    }
                }
            }
        }
    }

    #[test]
    fn valence_four_is_one_bicubic() {
        let ring = wobbly_ring(4);
        let coarse = ring::tests::regular_patch(&ring);
        let basis = Eigenbasis::new(4);
        let surface = basis.project(&ring);
        for (u, v) in [(1.0, 1.0), (0.5, 0.25), (0.1, 0.9), (0.0, 1e-3), (1e-5, 1e-6)] {
            let (found, wanted) = (surface.eval(u, v), spline::jet(&coarse, u, v, 1.0));
            assert!(found.position.distance(wanted.position) < 1e-15 * 4.0);
            for (found, wanted) in [(found.du, wanted.du), (found.dv, wanted.dv)] {
                assert!(found.distance(wanted) < 1e-14, "first derivative off by {}", found.distance(wanted));
            }
            for (found, wanted) in [(found.duu, wanted.duu), (found.duv, wanted.duv), (found.dvv, wanted.dvv)]
            {
                // Modes that would grow cancel, but only to rounding.
                let tolerance = 1e-14 + 1e-15 / u.max(v);
                assert!(
                    found.distance(wanted) < tolerance,
                    "second derivative off by {}",
                    found.distance(wanted)
                );
            }
        }
    }

    #[test]
    fn shrinks_towards_the_limit_by_the_largest_eigenvalue() {
        for valence in [3, 5, 8] {
            let basis = Eigenbasis::new(valence);
            let ring = wobbly_ring(valence);
            let surface = basis.project(&ring);
            let largest = basis.eigenvalues().iter().fold(0.0_f64, |a, &b| a.max(b));
            // Deep enough for all other modes to have gone.
            let at = |depth: i32| surface.eval(0.5_f64.powi(depth), 0.0).du;
            let ratio = at(201).length() / at(200).length();
            assert!((ratio - 2.0 * largest).abs() < 1e-12, "valence {valence}: {ratio} and {largest}");
        }
    }

    #[test]
    fn the_largest_eigenvalue_is_that_of_the_scheme() {
        for (valence, lambda) in [(3, 0.4101), (5, 0.5500), (6, 0.5797), (8, 0.6111), (20, 0.6473)] {
            let basis = Eigenbasis::new(valence);
            let largest = basis.eigenvalues().iter().fold(0.0_f64, |a, &b| a.max(b));
            assert!((largest - lambda).abs() < 5e-5, "valence {valence}: {largest}");
        }
    }
}
