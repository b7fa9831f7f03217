//! The functions of one direction: the thirteen B-splines of degree 7 with the knots 0 (eight times), 1/2 (five times), 1
//! (eight times), and what a uniform cubic is among them.

use super::apply::{DENOMINATOR, OUTER, SIDE};
use super::{COEFFICIENTS, DEGREE};

/// A number for each function of one direction.
pub(super) type Functions = [f64; COEFFICIENTS];

/// The ends of the polynomial pieces.
pub(super) const BREAKS: [f64; 3] = [0.0, 0.5, 1.0];

/// Derivative number `order` of every function at `t` in `[0, 1]`; at the knot that of the second piece.
pub(super) fn functions(order: usize, t: f64) -> Functions {
    let second = t >= BREAKS[1];
    let x = if second { 2.0 * t - 1.0 } else { 2.0 * t };
    let rest = DEGREE - order;
    // Bernstein polynomials of what is left of the degree, by the differences that derivatives are.
    let mut bernstein = [0.0; DEGREE + 1];
    bernstein[0] = 1.0;
    for degree in 1..=rest {
        for k in (0..=degree).rev() {
            let from_before = if k > 0 { x * bernstein[k - 1] } else { 0.0 };
            bernstein[k] = from_before + (1.0 - x) * bernstein[k];
        }
    }
    for degree in rest + 1..=DEGREE {
        for k in (0..=degree).rev() {
            let before = if k > 0 { bernstein[k - 1] } else { 0.0 };
            bernstein[k] = 2.0 * degree as f64 * (before - bernstein[k]);
        }
    }
    // The Bezier points of a piece in terms of the coefficients: its own six, and two at the knot, which lies in the middle.
    let mut out = [0.0; COEFFICIENTS];
    let [last, before_last] = if second { [0, 1] } else { [DEGREE, DEGREE - 1] };
    out[5] += bernstein[last] / 4.0;
    out[6] += bernstein[last] / 2.0;
    out[7] += bernstein[last] / 4.0;
    let outer = if second { 7 } else { 5 };
    out[6] += bernstein[before_last] / 2.0;
    out[outer] += bernstein[before_last] / 2.0;
    let first = if second { 7 } else { 0 };
    for k in 0..DEGREE - 1 {
        out[first + k] += bernstein[if second { k + 2 } else { k }];
    }
    out
}

/// The cell between nodes 0 and 1 of a uniform cubic B-spline with the nodes -1, 0, 1, 2: the weights of coefficient `j`.
pub(super) fn cubic(j: usize) -> [f64; 4] {
    let half = COEFFICIENTS / 2;
    let mut weights = SIDE[j.min(COEFFICIENTS - 1 - j)];
    if j > half {
        weights.reverse();
    }
    weights.map(|weight| weight / DENOMINATOR)
}

/// The last three coefficients of a direction for the value, slope and second derivative that a uniform cubic B-spline has at node 1:
/// the weights of the nodes 0, 1, 2 in coefficient `10 + r`.
pub(super) fn jet(r: usize) -> [f64; 3] {
    OUTER[r].map(|weight| weight / DENOMINATOR)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;

    fn knots() -> KnotVector {
        let [first, middle, last] = BREAKS;
        KnotVector::from_multiplicities(
            DEGREE,
            [(first, DEGREE + 1), (middle, DEGREE - 2), (last, DEGREE + 1)],
        )
    }

    #[test]
    fn functions_are_the_b_splines_of_the_knots() {
        let knots = knots();
        assert_eq!(knots.coefficients(), COEFFICIENTS);
        for t in [0.0, 0.1, 0.3, 0.5, 0.6, 0.9, 1.0] {
            let basis = knots.basis(t);
            for order in 0..3 {
                let mut wanted = [0.0; COEFFICIENTS];
                wanted[basis.first..=basis.first + DEGREE].copy_from_slice(&basis.values[order]);
                for (value, wanted) in functions(order, t).into_iter().zip(wanted) {
                    assert!(
                        (value - wanted).abs() < 1e-11,
                        "derivative {order} at {t}: {value} for {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn higher_derivatives_agree_with_differences() {
        let h = 1e-5;
        for order in 3..5 {
            for t in [0.2, 0.7] {
                let (before, after) = (functions(order - 1, t - h), functions(order - 1, t + h));
                for (k, value) in functions(order, t).into_iter().enumerate() {
                    let difference = (after[k] - before[k]) / (2.0 * h);
                    assert!((value - difference).abs() < 1e-4 * value.abs().max(1.0), "{order} {t} {k}");
                }
            }
        }
    }

    #[test]
    fn cubics_are_in_the_space() {
        // The cubic B-spline of each node over the cell between nodes 0 and 1.
        let cell = |t: f64| {
            let s = 1.0 - t;
            let inner = |t: f64| (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
            [s * s * s / 6.0, inner(t), inner(s), t * t * t / 6.0]
        };
        for t in [0.0, 0.2, 0.5, 0.8, 1.0] {
            let values = functions(0, t);
            for node in 0..4 {
                let sum: f64 = (0..COEFFICIENTS).map(|j| values[j] * cubic(j)[node]).sum();
                assert!((sum - cell(t)[node]).abs() < 1e-14, "node {node} at {t}");
            }
        }
        for r in 0..3 {
            let [outside, weights @ ..] = cubic(10 + r);
            assert_eq!((outside, weights), (0.0, jet(r)));
        }
    }
}
