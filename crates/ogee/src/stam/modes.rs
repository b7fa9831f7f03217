//! Eigenvectors of the matrix of one step, and coefficients in them, in closed form.
//!
//! The inner part, the vertex with its neighbours and diagonals, is invariant under turning by one face, so its
//! eigenvectors are cosine and sine waves around the vertex. The outer part, seven points beyond, follows.

use super::ring;
use crate::math::{Interpolate, Vec3};
use std::f64::consts::PI;

/// One wave around the vertex: at neighbour `i` `edge cos(w theta i)`, at diagonal `i` `diagonal cos(w theta (i + 1/2))`,
/// or the same with sines, `theta = 2 pi / n`.
#[derive(Clone, Debug)]
struct Wave {
    frequency: usize,
    sine: bool,
    /// Value at the vertex, which only constant waves move.
    vertex: f64,
    edge: f64,
    diagonal: f64,
    /// The left eigenvector, for points relative to the vertex: the same wave with these heights.
    dual_edge: f64,
    dual_diagonal: f64,
}

/// All eigenvectors but the constant one: waves first, then the seven that live on the outer points alone.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    valence: usize,
    values: Vec<f64>,
    waves: Vec<Wave>,
    /// What each wave is on the outer points.
    outer: Vec<[f64; 7]>,
    /// `cos(pi j / n)` and `sin(pi j / n)`.
    turns: Vec<[f64; 2]>,
}

/// A ring of points in the eigenbasis.
#[derive(Clone, Debug)]
pub(super) struct RingCoefficients {
    /// The coefficient of the constant eigenvector.
    pub(super) limit: Vec3,
    /// The others, in the order of [`Modes`].
    pub(super) modes: Vec<Vec3>,
}

/// Eigenvalues of the block that takes outer points to outer points.
const OUTER_VALUES: [f64; 7] =
    [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0];

/// Its eigenvectors: three along each side, with what they do to the far corner, and the far corner itself.
const OUTER_VECTORS: [[f64; 7]; 7] = [
    [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 0.0, -1.0, -2.0, 0.0, 0.0, 0.0],
    [2.0, -1.0, 2.0, 11.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
    [0.0, 0.0, 0.0, -2.0, -1.0, 0.0, 1.0],
    [0.0, 0.0, 0.0, 11.0, 2.0, -1.0, 2.0],
    [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
];

/// The inverse of the matrix whose columns these are.
const OUTER_DUALS: [[f64; 7]; 7] = [
    [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 2.0, 0.0, -1.0 / 2.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 6.0, -2.0 / 6.0, 1.0 / 6.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0],
    [0.0, 0.0, 0.0, 0.0, -1.0 / 2.0, 0.0, 1.0 / 2.0],
    [0.0, 0.0, 0.0, 0.0, 1.0 / 6.0, -2.0 / 6.0, 1.0 / 6.0],
    [-1.0, 3.0, -3.0, 1.0, -3.0, 3.0, -1.0],
];

/// Two eigenvalues closer than this are the same: those that differ do so by more than 1e-4 up to valence 1000.
const SAME: f64 = 1e-9;

/// The sum of `weights[i] values[i]`.
fn combine<T: Interpolate>(weights: &[f64], values: &[T]) -> T {
    weights.iter().zip(values).fold(T::zero(), |mut sum, (&weight, value)| {
        sum.add_scaled(weight, value);
        sum
    })
}

impl Modes {
    pub(super) fn new(valence: usize) -> Modes {
        let n = valence as f64;
        let turns = (0..2 * valence).map(|j| PI * j as f64 / n).map(|a| [a.cos(), a.sin()]).collect();
        let (mut values, mut waves) = (Vec::with_capacity(2 * valence + 7), Vec::with_capacity(2 * valence));
        for (value, wave) in constant_waves(n) {
            values.push(value);
            waves.push(wave);
        }
        for frequency in 1..valence.div_ceil(2) {
            for (value, wave) in turning_waves(n, frequency) {
                values.extend([value; 2]);
                waves.extend([wave.clone(), Wave { sine: true, ..wave }]);
            }
        }
        if valence.is_multiple_of(2) {
            let wave = Wave {
                frequency: valence / 2,
                sine: false,
                vertex: 0.0,
                edge: 1.0,
                diagonal: 0.0,
                dual_edge: 1.0 / n,
                dual_diagonal: 0.0,
            };
            let turned =
                Wave { sine: true, edge: 0.0, diagonal: 1.0, dual_edge: 0.0, dual_diagonal: 1.0 / n, ..wave };
            values.extend([0.25; 2]);
            waves.extend([wave, turned]);
        }
        let mut modes = Modes { valence, values, waves, outer: Vec::with_capacity(2 * valence), turns };
        for index in 0..modes.waves.len() {
            modes.outer.push(modes.outer_part(index));
        }
        modes.values.extend(OUTER_VALUES);
        modes
    }

    pub(super) fn valence(&self) -> usize {
        self.valence
    }

    /// Eigenvalues, in order.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Eigenvectors, in order, `2 n + 8` long.
    pub(super) fn vectors(&self) -> impl Iterator<Item = Vec<f64>> {
        let waves = self.waves.iter().zip(&self.outer).map(|(wave, outer)| {
            let mut vector = self.inner_part(wave);
            vector.extend(outer);
            vector
        });
        let inner = 2 * self.valence + 1;
        let rest = OUTER_VECTORS.iter().map(move |outer| {
            let mut vector = vec![0.0; inner];
            vector.extend(outer);
            vector
        });
        waves.chain(rest)
    }

    /// Coefficients of a ring of `2 n + 8` points.
    pub(super) fn project(&self, ring: &[Vec3]) -> RingCoefficients {
        let n = self.valence as f64;
        // Relative to the vertex, so that the size of what is computed is that of the ring, wherever it lies.
        let relative: Vec<Vec3> = ring.iter().map(|&p| p - ring[0]).collect();
        let (inner, beyond) = relative[1..].split_at(2 * self.valence);
        let weighted = inner.chunks_exact(2).fold(Vec3::ZERO, |sum, pair| sum + 4.0 * pair[0] + pair[1]);
        let limit = weighted / (n * (n + 5.0));
        let mut modes = Vec::with_capacity(2 * self.valence + 7);
        let mut rest: [Vec3; 7] = std::array::from_fn(|i| beyond[i] - limit);
        for (wave, outer) in self.waves.iter().zip(&self.outer) {
            let mut coefficient = Vec3::ZERO;
            for (i, pair) in inner.chunks_exact(2).enumerate() {
                coefficient += wave.dual_edge * self.turn(wave, 2 * i) * pair[0]
                    + wave.dual_diagonal * self.turn(wave, 2 * i + 1) * pair[1];
            }
            for (rest, &outer) in rest.iter_mut().zip(outer) {
                *rest -= outer * coefficient;
            }
            modes.push(coefficient);
        }
        modes.extend(OUTER_DUALS.iter().map(|dual| combine(dual, &rest)));
        RingCoefficients { limit: ring[0] + limit, modes }
    }

    /// The wave of height 1, `half_steps` half faces from neighbour 0.
    fn turn(&self, wave: &Wave, half_steps: usize) -> f64 {
        let [cosine, sine] = self.turns[wave.frequency * half_steps % (2 * self.valence)];
        if wave.sine { sine } else { cosine }
    }

    fn inner_part(&self, wave: &Wave) -> Vec<f64> {
        let mut vector = Vec::with_capacity(2 * self.valence + 8);
        vector.push(wave.vertex);
        for i in 0..self.valence {
            vector.push(wave.edge * self.turn(wave, 2 * i));
            vector.push(wave.diagonal * self.turn(wave, 2 * i + 1));
        }
        vector
    }

    /// Outer points that make a wave an eigenvector of the whole matrix: `(value - S12) outer = S11 inner`, in the
    /// eigenvectors of `S12`.
    ///
    /// Values meet at valence 4 k, frequency k, and at valence 4, frequency 0. The right side then has no part along
    /// that eigenvector, since the face sees the wave as it sees one at valence 4, where all eigenvectors are known to
    /// exist: monomials. Any part will do, and none is the simplest.
    fn outer_part(&self, index: usize) -> [f64; 7] {
        let mut vector = self.inner_part(&self.waves[index]);
        vector.extend([0.0; 7]);
        let next = ring::extended(self.valence, &vector);
        let reached = &next[2 * self.valence + 1..][..7];
        let parts: [f64; 7] = std::array::from_fn(|j| {
            let gap = self.values[index] - OUTER_VALUES[j];
            if gap.abs() < SAME { 0.0 } else { combine(&OUTER_DUALS[j], reached) / gap }
        });
        let mut outer = [0.0; 7];
        for (part, vector) in parts.iter().zip(OUTER_VECTORS) {
            outer.add_scaled(*part, &vector);
        }
        outer
    }
}

/// Frequency 0: neighbours alike, diagonals alike. Relative to the vertex they obey the matrix
/// `((p, q), (p, q + 1/8))`, whose eigenvectors are `(q, value - p)`.
fn constant_waves(n: f64) -> [(f64, Wave); 2] {
    let (p, q) = ((n - 3.0) / (2.0 * n), (n - 2.0) / (8.0 * n));
    let larger = (3.0 * n - 7.0 + ((5.0 * n - 30.0) * n + 49.0).sqrt()) / (8.0 * n);
    // From the determinant p / 8: the difference of the two roots would cancel.
    let smaller = p / (8.0 * larger);
    [(larger, smaller), (smaller, larger)].map(|(value, other)| {
        let (edge, diagonal) = (q, value - p);
        // The limit of an eigenvector that shrinks is 0, which says where its vertex is.
        let vertex = -(4.0 * edge + diagonal) / (n + 5.0);
        let determinant = q * (other - value);
        let wave = Wave {
            frequency: 0,
            sine: false,
            vertex,
            edge: vertex + edge,
            diagonal: vertex + diagonal,
            dual_edge: (other - p) / determinant / n,
            dual_diagonal: -q / determinant / n,
        };
        (value, wave)
    })
}

/// A frequency between 0 and `n / 2`. With diagonals halved the matrix is `1/4 + c/4 ((c, 1), (1, 0))`,
/// `c = cos(w theta / 2)`: symmetric, so its eigenvectors `(slope, 1)` are at right angles.
fn turning_waves(n: f64, frequency: usize) -> [(f64, Wave); 2] {
    let c = (PI * frequency as f64 / n).cos();
    let slope = (c + (c * c + 4.0).sqrt()) / 2.0;
    [slope, -1.0 / slope].map(|slope| {
        let length = slope.hypot(1.0);
        let wave = Wave {
            frequency,
            sine: false,
            vertex: 0.0,
            edge: slope / length,
            diagonal: 2.0 / length,
            dual_edge: 2.0 / n * slope / length,
            dual_diagonal: 1.0 / n / length,
        };
        ((1.0 + c * slope) / 4.0, wave)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn valences() -> impl Iterator<Item = usize> {
        (3..=50).chain([100, 200])
    }

    /// `A x` for `x` of any kind.
    fn step<T: Interpolate>(valence: usize, x: &[T]) -> Vec<T> {
        let mut next = ring::extended(valence, x);
        next.truncate(2 * valence + 8);
        next
    }

    #[test]
    fn vectors_are_eigenvectors() {
        for valence in valences().chain([1000]) {
            let modes = Modes::new(valence);
            assert_eq!(modes.values.len(), 2 * valence + 7);
            for (value, vector) in modes.values().iter().zip(modes.vectors()) {
                let size = vector.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
                for (image, own) in step(valence, &vector).iter().zip(&vector) {
                    assert!(
                        (image - value * own).abs() < 1e-13 * size,
                        "valence {valence}, eigenvalue {value}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_basis_reproduces_the_matrix() {
        for valence in valences() {
            let modes = Modes::new(valence);
            let vectors: Vec<Vec<f64>> = modes.vectors().collect();
            let size = 2 * valence + 8;
            // Three columns of the matrix at a time, as coordinates of points.
            for first in (0..size).step_by(3) {
                let axis =
                    |k: usize| Vec3::from(std::array::from_fn(|j| f64::from(u8::from(k == first + j))));
                let unit: Vec<Vec3> = (0..size).map(axis).collect();
                let RingCoefficients { limit, modes: coefficients } = modes.project(&unit);
                let (mut same, mut image) = (vec![limit; size], vec![limit; size]);
                for ((value, &coefficient), vector) in modes.values().iter().zip(&coefficients).zip(&vectors)
                {
                    for (k, entry) in vector.iter().enumerate() {
                        same[k] += *entry * coefficient;
                        image[k] += *entry * *value * coefficient;
                    }
                }
                for (k, wanted) in step(valence, &unit).into_iter().enumerate() {
                    assert!(same[k].distance(unit[k]) < 1e-12, "valence {valence}: V V^-1, row {k}");
                    assert!(image[k].distance(wanted) < 1e-12, "valence {valence}: V L V^-1, row {k}");
                }
            }
        }
    }

    #[test]
    fn no_eigenvector_is_missing_where_eigenvalues_meet() {
        // At valence 8 and frequency 2 the smaller eigenvalue is that of two outer vectors.
        let modes = Modes::new(8);
        let eighths = modes.values().iter().filter(|&value| (value - 0.125).abs() < SAME).count();
        assert_eq!(eighths, 4);
        // At valence 4 they are those of the B-spline: 2^-(i + j) for degrees i and j from 0 to 3.
        let mut values = Modes::new(4).values().to_vec();
        values.sort_by(f64::total_cmp);
        let mut wanted: Vec<f64> = (0..4)
            .flat_map(|i| (0..4).map(move |j| 0.5_f64.powi(i + j)))
            .filter(|&value| value < 1.0)
            .collect();
        wanted.sort_by(f64::total_cmp);
        for (value, wanted) in values.iter().zip(wanted) {
            assert!((value - wanted).abs() < 1e-15);
        }
    }
}
