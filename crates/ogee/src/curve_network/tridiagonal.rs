//! The 1-4-1 systems of uniform cubic splines, open and cyclic: coefficients from what they make at the knots.

use crate::math::Vec3;

/// Solves `(x_{i-1} + 4 x_i + x_{i+1}) / 6 = right_i` for every `i`, where `x` goes on with `before` and `after`.
pub(super) fn solve_between(before: Vec3, right: &[Vec3], after: Vec3) -> Vec<Vec3> {
    let mut right: Vec<Vec3> = right.iter().map(|&r| 6.0 * r).collect();
    if let Some(first) = right.first_mut() {
        *first -= before;
    }
    if let Some(last) = right.last_mut() {
        *last -= after;
    }
    eliminate(4.0, 4.0, &mut right);
    right
}

/// Solves `(x_{i-1} + 4 x_i + x_{i+1}) / 6 = right_i` around a ring of three or more.
pub(super) fn solve_cyclic(right: &[Vec3]) -> Vec<Vec3> {
    // The corners of the matrix as a rank-one change of a tridiagonal one (Sherman and Morrison): u = (-4, 0 .. 0, 1),
    // v = (1, 0 .. 0, -1/4).
    let count = right.len();
    let (first, last) = (4.0 + 4.0, 4.0 + 0.25);
    let mut x: Vec<Vec3> = right.iter().map(|&r| 6.0 * r).collect();
    eliminate(first, last, &mut x);
    let mut change = vec![0.0; count];
    (change[0], change[count - 1]) = (-4.0, 1.0);
    eliminate(first, last, &mut change);
    let share = (x[0] - 0.25 * x[count - 1]) / (1.0 + change[0] - 0.25 * change[count - 1]);
    for (x, weight) in x.iter_mut().zip(change) {
        *x -= weight * share;
    }
    x
}

/// Replaces the right side by the solution of the tridiagonal system with ones beside the diagonal and fours on it,
/// but for its first and last entry. No pivots: the diagonal dominates.
fn eliminate<T>(first: f64, last: f64, x: &mut [T])
where
    T: Copy + std::ops::Sub<Output = T> + std::ops::Div<f64, Output = T>,
    f64: std::ops::Mul<T, Output = T>,
{
    let count = x.len();
    let mut above = Vec::with_capacity(count);
    for i in 0..count {
        let own = match i {
            0 => first,
            _ if i + 1 == count => last,
            _ => 4.0,
        };
        if i == 0 {
            above.push(1.0 / own);
            x[0] = x[0] / own;
        } else {
            let pivot = own - above[i - 1];
            above.push(1.0 / pivot);
            x[i] = (x[i] - x[i - 1]) / pivot;
        }
    }
    for i in (1..count).rev() {
        x[i - 1] = x[i - 1] - above[i - 1] * x[i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wobbly(count: usize) -> Vec<Vec3> {
        (0..count).map(|i| Vec3::new((i * i % 7) as f64, (3 * i % 5) as f64, 1.0 / (1 + i) as f64)).collect()
    }

    #[test]
    fn rings_are_solved() {
        for count in 3..20 {
            let right = wobbly(count);
            let x = solve_cyclic(&right);
            for i in 0..count {
                let made = (x[(i + count - 1) % count] + 4.0 * x[i] + x[(i + 1) % count]) / 6.0;
                assert!(made.distance(right[i]) < 1e-14, "{count} unknowns, row {i}");
            }
        }
    }

    #[test]
    fn lists_are_solved() {
        let (before, after) = (Vec3::new(1.0, -2.0, 3.0), Vec3::new(0.5, 7.0, 0.0));
        for count in 0..20 {
            let right = wobbly(count);
            let x = solve_between(before, &right, after);
            for i in 0..count {
                let left = if i == 0 { before } else { x[i - 1] };
                let made = (left + 4.0 * x[i] + x.get(i + 1).copied().unwrap_or(after)) / 6.0;
                assert!(made.distance(right[i]) < 1e-14, "{count} unknowns, row {i}");
            }
        }
    }
}
