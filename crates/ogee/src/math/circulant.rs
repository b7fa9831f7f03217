//! Lists with n-fold symmetry: the first Fourier mode, and alternating sums.

use super::Vec3;
use std::f64::consts::TAU;

/// Projection of a ring of points onto its first Fourier mode: the circulant with entries
/// `(2 / n) cos(2 pi (i - j) / n)`.
pub(crate) fn first_mode(ring: &[Vec3]) -> Vec<Vec3> {
    let n = ring.len() as f64;
    let angle = |i: usize| TAU * i as f64 / n;
    let (mut cosine, mut sine) = (Vec3::ZERO, Vec3::ZERO);
    for (i, &p) in ring.iter().enumerate() {
        cosine += angle(i).cos() * p;
        sine += angle(i).sin() * p;
    }
    (0..ring.len()).map(|i| 2.0 / n * (angle(i).cos() * cosine + angle(i).sin() * sine)).collect()
}

/// `(-1)^i`.
pub(crate) fn sign(i: usize) -> f64 {
    if i.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// The mean of `(-1)^i x_i`.
pub(crate) fn alternating_mean(ring: &[Vec3]) -> Vec3 {
    let sum = ring.iter().enumerate().fold(Vec3::ZERO, |sum, (i, &x)| sum + sign(i) * x);
    sum / ring.len() as f64
}

/// Solves `x_i + x_{i-1} = 2 right_i` around a closed ring. For even `n` the solution without alternating part, exact
/// where the alternating sum of the right sides vanishes.
pub(crate) fn solve_pair_sums(right: &[Vec3]) -> Vec<Vec3> {
    let n = right.len();
    let mut x = vec![Vec3::ZERO; n];
    if n % 2 == 1 {
        x[0] = (0..n).fold(Vec3::ZERO, |sum, k| sum + sign(k) * right[(n - k) % n]);
    }
    for i in 1..n {
        x[i] = 2.0 * right[i] - x[i - 1];
    }
    if n.is_multiple_of(2) {
        let mean = alternating_mean(&x);
        for (i, x) in x.iter_mut().enumerate() {
            *x -= sign(i) * mean;
        }
    }
    x
}

/// Solves `x_i + x_{i-1} = 2 right_i`, `0 < i < n`, on an open list of `n` unknowns: always solvable, with the one
/// free part chosen so that the alternating mean is that of `wanted`. `right[0]` is not used.
pub(crate) fn solve_pair_sums_open(right: &[Vec3], wanted: &[Vec3]) -> Vec<Vec3> {
    let n = wanted.len();
    let mut x = vec![Vec3::ZERO; n];
    for i in 1..n {
        x[i] = 2.0 * right[i] - x[i - 1];
    }
    let free = alternating_mean(wanted) - alternating_mean(&x);
    for (i, x) in x.iter_mut().enumerate() {
        *x += sign(i) * free;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(n: usize) -> Vec<Vec3> {
        (0..n).map(|i| Vec3::new((i * i % 7) as f64, (3 * i % 5) as f64, 1.0 / (1 + i) as f64)).collect()
    }

    #[test]
    fn first_mode_is_a_projection() {
        for n in 3..12 {
            let once = first_mode(&ring(n));
            for (a, b) in once.iter().zip(first_mode(&once)) {
                assert!(a.distance(b) < 1e-14 * n as f64, "n = {n}");
            }
        }
    }

    #[test]
    fn pair_sums_are_met() {
        for n in 3..12 {
            let mut right = ring(n);
            if n.is_multiple_of(2) {
                let mean = alternating_mean(&right);
                for (i, r) in right.iter_mut().enumerate() {
                    *r -= sign(i) * mean;
                }
            }
            let x = solve_pair_sums(&right);
            for i in 0..n {
                let gap = (x[i] + x[(i + n - 1) % n]) / 2.0 - right[i];
                assert!(gap.length() < 1e-14 * n as f64, "n = {n}, i = {i}: {gap:?}");
            }
        }
    }
}
