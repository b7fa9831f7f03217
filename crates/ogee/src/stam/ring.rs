//! One step of refinement at a face with one extraordinary vertex: the next ring, and the bicubics beside it.

use crate::math::Interpolate;

/// The nine points that a step makes beyond the next ring.
const BEYOND: [(i32, i32); 9] = [(3, -1), (3, 0), (3, 1), (3, 2), (3, 3), (2, 3), (1, 3), (0, 3), (-1, 3)];

/// The seven points of a ring that do not touch the vertex's faces.
pub(super) const OUTER: [(i32, i32); 7] = [(2, -1), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (-1, 2)];

/// Where the 4 x 4 points of each tile begin: beside the corner tile along `u`, diagonally, and along `v`.
const FIRST: [(i32, i32); 3] = [(0, -1), (0, 0), (-1, 0)];

/// Number of the point at grid coordinates that put the vertex at (0, 0) and the face on the unit square.
fn number(valence: usize, at: (i32, i32)) -> usize {
    let outer = 2 * valence + 1;
    match at {
        (0, 0) => 0,
        (1, 0) => 1,
        (1, 1) => 2,
        (0, 1) => 3,
        (-1, 1) => 4,
        (-1, 0) => 5,
        (0, -1) => 2 * valence - 1,
        (1, -1) => 2 * valence,
        _ => match OUTER.iter().position(|&p| p == at) {
            Some(index) => outer + index,
            None => {
                outer
                    + 7
                    + BEYOND.iter().position(|&p| p == at).expect("only points of the net are asked for")
            }
        },
    }
}

/// The next ring and the nine points beyond it: `2 n + 17` from `2 n + 8`.
pub(super) fn extended<T: Interpolate>(valence: usize, ring: &[T]) -> Vec<T> {
    let n = valence as f64;
    let mut next = Vec::with_capacity(2 * valence + 17);
    let edge = |i: usize| &ring[1 + 2 * (i % valence)];
    let face = |i: usize| {
        let i = i % valence;
        weighted([(0.25, &ring[0]), (0.25, edge(i)), (0.25, &ring[2 + 2 * i]), (0.25, edge(i + 1))])
    };
    let faces: Vec<T> = (0..valence).map(face).collect();
    let mut vertex = weighted([((n - 2.0) / n, &ring[0])]);
    for i in 0..valence {
        vertex.add_scaled(1.0 / (n * n), edge(i));
        vertex.add_scaled(1.0 / (n * n), &faces[i]);
    }
    next.push(vertex);
    for i in 0..valence {
        let before = &faces[(i + valence - 1) % valence];
        next.push(weighted([(0.25, &ring[0]), (0.25, edge(i)), (0.25, &faces[i]), (0.25, before)]));
        next.push(faces[i].clone());
    }
    next.extend(OUTER.iter().chain(&BEYOND).map(|&at| regular(valence, ring, at)));
    next
}

/// The point of the next step at even and odd coordinates, by the masks of the B-spline: the product of 1/8, 6/8, 1/8
/// at even ones and 1/2, 1/2 at odd ones.
fn regular<T: Interpolate>(valence: usize, ring: &[T], (x, y): (i32, i32)) -> T {
    let mask = |x: i32| -> &[(i32, f64)] {
        if x % 2 == 0 { &[(-1, 1.0 / 8.0), (0, 6.0 / 8.0), (1, 1.0 / 8.0)] } else { &[(0, 0.5), (1, 0.5)] }
    };
    let mut out = T::zero();
    for &(j, up) in mask(y) {
        for &(i, across) in mask(x) {
            let at = (x.div_euclid(2) + i, y.div_euclid(2) + j);
            out.add_scaled(across * up, &ring[number(valence, at)]);
        }
    }
    out
}

fn weighted<T: Interpolate, const N: usize>(terms: [(f64, &T); N]) -> T {
    terms.into_iter().fold(T::zero(), |mut sum, (weight, value)| {
        sum.add_scaled(weight, value);
        sum
    })
}

/// The points of the three tiles, column fastest, from what [`extended`] gives.
pub(super) fn tiles<T: Interpolate>(extended: &[T]) -> [[T; 16]; 3] {
    let valence = (extended.len() - 17) / 2;
    FIRST.map(|(x, y)| {
        std::array::from_fn(|k| extended[number(valence, (x + k as i32 % 4, y + k as i32 / 4))].clone())
    })
}

/// Step and tile that hold a point of the face, and where it lies in the tile.
pub(super) struct Cell {
    /// The step, from 1.
    pub(super) step: i32,
    /// The tile.
    pub(super) tile: usize,
    /// Parameter along `u` in the tile.
    pub(super) s: f64,
    /// Parameter along `v` in the tile.
    pub(super) t: f64,
    /// Derivatives of the tile times this are those of the face: `2^step`.
    pub(super) scale: f64,
}

impl Cell {
    /// For parameters in `[0, 1]` of which the larger is a normal number.
    pub(super) fn new(u: f64, v: f64) -> Cell {
        // The exponent of the larger parameter, rather than a logarithm, which could be off by one at powers of two.
        let exponent = (u.max(v).to_bits() >> 52) as i32 - 1023;
        let step = (-exponent).max(1);
        let scale = 2.0_f64.powi(step);
        let (s, t) = (scale * u, scale * v);
        let (tile, s, t) = match (s >= 1.0, t >= 1.0) {
            (true, false) => (0, s - 1.0, t),
            (true, true) => (1, s - 1.0, t - 1.0),
            (false, _) => (2, s, t - 1.0),
        };
        Cell { step, tile, s, t, scale }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::math::Vec3;

    /// Points around the unit square and its vertex, bumpy but always the same; size about 2.
    pub(crate) fn wobbly_ring(valence: usize) -> Vec<Vec3> {
        let wobble = |k: usize| {
            let noise = |k: usize| (k * 7919 % 1009) as f64 / 1009.0 - 0.5;
            0.4 * Vec3::new(noise(3 * k + 1), noise(3 * k + 2), noise(3 * k + 3))
        };
        let mut ring = vec![Vec3::ZERO];
        for i in 0..2 * valence {
            let angle = std::f64::consts::PI * i as f64 / valence as f64;
            ring.push(Vec3::new(angle.cos(), angle.sin(), 0.0));
        }
        ring.extend(OUTER.map(|(x, y)| 0.8 * Vec3::new(f64::from(x), f64::from(y), -0.3)));
        ring.iter().enumerate().map(|(k, &p)| p + wobble(k)).collect()
    }

    /// The 16 points of the whole face at valence 4.
    pub(crate) fn regular_patch(ring: &[Vec3]) -> [Vec3; 16] {
        std::array::from_fn(|k| match (k as i32 % 4 - 1, k as i32 / 4 - 1) {
            (-1, -1) => ring[6],
            at => ring[number(4, at)],
        })
    }

    #[test]
    fn weights_sum_to_one() {
        for valence in 3..12 {
            for value in extended(valence, &vec![1.0; 2 * valence + 8]) {
                assert!((value - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn at_valence_four_the_vertex_is_as_regular_as_the_others() {
        let ring: Vec<f64> = (0..16).map(|k| f64::from(k * k % 11)).collect();
        let next = extended(4, &ring);
        // (2, 1) at the far side, and (0, 1) beside the vertex, by the same mask.
        assert!((next[3] - regular(4, &ring, (0, 1))).abs() < 1e-15 * 16.0);
        assert!((next[2] - regular(4, &ring, (1, 1))).abs() < 1e-15 * 16.0);
    }

    #[test]
    fn cells_cover_the_face() {
        for (u, v, step, tile, s, t) in [
            (1.0, 1.0, 1, 1, 1.0, 1.0),
            (0.5, 0.0, 1, 0, 0.0, 0.0),
            (0.25, 0.75, 1, 2, 0.5, 0.5),
            (0.25, 0.25, 2, 1, 0.0, 0.0),
            (0.2, 0.05, 3, 0, 0.6, 0.4),
            (0.0, 1.0, 1, 2, 0.0, 1.0),
        ] {
            let cell = Cell::new(u, v);
            assert_eq!((cell.step, cell.tile), (step, tile), "({u}, {v})");
            assert!((cell.s - s).abs() < 1e-15 * 2.0 && (cell.t - t).abs() < 1e-15 * 2.0, "({u}, {v})");
        }
    }
}
