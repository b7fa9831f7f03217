//! Symmetric systems known only by what their matrix does to a vector.

use super::Vec3;

/// Relative residual at which the iteration has done its work.
const TOLERANCE: f64 = 1e-16;

/// Solves `A x = right`, `A` symmetric and positive semi-definite and `right` in its range, by conjugate gradients;
/// the three coordinates share the matrix but have a step length of their own.
pub(crate) fn conjugate_gradients(right: &[Vec3], apply: impl Fn(&[Vec3]) -> Vec<Vec3>) -> Vec<Vec3> {
    let dot = |a: &[Vec3], b: &[Vec3]| {
        a.iter().zip(b).fold(Vec3::ZERO, |sum, (p, q)| sum + Vec3::new(p.x * q.x, p.y * q.y, p.z * q.z))
    };
    let ratio = |a: Vec3, b: Vec3| {
        let safe = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        Vec3::new(safe(a.x, b.x), safe(a.y, b.y), safe(a.z, b.z))
    };
    let scaled = |s: Vec3, p: Vec3| Vec3::new(s.x * p.x, s.y * p.y, s.z * p.z);
    let mut x = vec![Vec3::ZERO; right.len()];
    let mut residual = right.to_vec();
    let mut direction = residual.clone();
    let mut size = dot(&residual, &residual);
    let enough = TOLERANCE * TOLERANCE * size.x.max(size.y).max(size.z);
    // In exact arithmetic as many steps as unknowns; rounding asks for some more.
    for _ in 0..3 * right.len() + 10 {
        if size.x.max(size.y).max(size.z) <= enough {
            break;
        }
        let image = apply(&direction);
        let step = ratio(size, dot(&direction, &image));
        for i in 0..x.len() {
            x[i] += scaled(step, direction[i]);
            residual[i] -= scaled(step, image[i]);
        }
        let next = dot(&residual, &residual);
        let turn = ratio(next, size);
        for i in 0..x.len() {
            direction[i] = residual[i] + scaled(turn, direction[i]);
        }
        size = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_tridiagonal_system() {
        let apply = |x: &[Vec3]| {
            (0..x.len())
                .map(|i| {
                    let before = if i > 0 { x[i - 1] } else { Vec3::ZERO };
                    let after = x.get(i + 1).copied().unwrap_or(Vec3::ZERO);
                    4.0 * x[i] - before - after
                })
                .collect::<Vec<_>>()
        };
        let wanted: Vec<Vec3> =
            (0..20).map(|i| Vec3::new(f64::from(i), 1.0 / f64::from(i + 1), -3.0)).collect();
        let found = conjugate_gradients(&apply(&wanted), apply);
        for (a, b) in found.iter().zip(&wanted) {
            assert!(a.distance(*b) < 1e-13);
        }
    }
}
