//! B-spline basis functions and their derivatives: Cox and de Boor, as in Piegl and Tiller, The NURBS Book, A2.2
//! and A2.3.

use super::KnotVector;

/// Highest degree that is evaluated.
pub(crate) const MAX_DEGREE: usize = 7;

/// The basis functions that do not vanish at a parameter, with first and second derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Basis {
    /// Number of the first of the `degree + 1` functions.
    pub(crate) first: usize,
    /// `values[d][k]`: derivative `d` of function `first + k`.
    pub(crate) values: [[f64; MAX_DEGREE + 1]; 3],
}

impl KnotVector {
    /// The knot span `[knots[s], knots[s + 1])` that holds `t`, not empty; the last one at the end of the domain.
    /// Parameters outside belong to the first and last span.
    pub fn span(&self, t: f64) -> usize {
        let (p, knots) = (self.degree(), self.knots());
        let last = self.coefficients() - 1;
        let above = knots[p + 1..=last].partition_point(|&knot| knot <= t);
        p + above
    }

    /// Spans that are not empty, in order.
    pub fn spans(&self) -> impl Iterator<Item = usize> + '_ {
        (self.degree()..self.coefficients()).filter(|&s| self.knots()[s] < self.knots()[s + 1])
    }

    pub(crate) fn basis(&self, t: f64) -> Basis {
        self.basis_on(self.span(t), t)
    }

    /// The polynomials of one span, at any parameter.
    pub(crate) fn basis_on(&self, span: usize, t: f64) -> Basis {
        let (p, knots) = (self.degree(), self.knots());
        debug_assert!(p <= MAX_DEGREE);
        let mut values = [[0.0; MAX_DEGREE + 1]; 3];
        // Of the degrees p - 1 and p - 2: each function over the distance of the knots that it will be blended over.
        let (mut first_shares, mut second_shares) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
        let mut distances = [1.0; MAX_DEGREE + 1];
        let current = &mut values[0];
        current[0] = 1.0;
        for degree in 1..=p {
            let mut saved = 0.0;
            for r in 0..degree {
                let (low, high) = (knots[span + 1 + r - degree], knots[span + 1 + r]);
                let distance = high - low;
                let share = current[r] / distance;
                if degree == p {
                    first_shares[r] = share;
                    distances[r] = distance;
                } else if degree + 1 == p {
                    second_shares[r] = share;
                }
                current[r] = saved + (high - t) * share;
                saved = (t - low) * share;
            }
            current[degree] = saved;
        }
        // A derivative of a B-spline is the difference of two of the next lower degree, over their knots' distances.
        differences(p, &first_shares, &mut values[1]);
        if p >= 2 {
            let mut slopes = [0.0; MAX_DEGREE + 1];
            differences(p - 1, &second_shares, &mut slopes);
            for (slope, distance) in slopes.iter_mut().zip(distances).take(p) {
                *slope /= distance;
            }
            differences(p, &slopes, &mut values[2]);
        }
        Basis { first: span - p, values }
    }
}

/// `out[k] = degree (shares[k - 1] - shares[k])`, shares outside `0..degree` being zero.
fn differences(degree: usize, shares: &[f64; MAX_DEGREE + 1], out: &mut [f64; MAX_DEGREE + 1]) {
    let mut before = 0.0;
    for k in 0..degree {
        out[k] = degree as f64 * (before - shares[k]);
        before = shares[k];
    }
    out[degree] = degree as f64 * before;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn basis_sums_to_one_and_derivatives_to_zero() {
        for degree in 1..=7 {
            let ends = |t: f64| (t, degree + 1);
            let knots = KnotVector::from_multiplicities(
                degree,
                [ends(0.0), (1.0, 1), (1.5, degree.min(2)), ends(4.0)],
            );
            for t in [0.0, 0.3, 1.0, 1.2, 1.5, 3.9, 4.0] {
                let basis = knots.basis(t);
                let sum = |d: usize| basis.values[d].iter().sum::<f64>();
                assert!((sum(0) - 1.0).abs() < 1e-14, "degree {degree} at {t}");
                assert!(sum(1).abs() < 1e-12 && sum(2).abs() < 1e-11, "degree {degree} at {t}");
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let knots = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.5, 3.0, 3.0, 3.0, 3.0]);
        let h = 1e-5;
        for t in [0.4, 1.7, 2.6] {
            let (before, at, after) = (knots.basis(t - h), knots.basis(t), knots.basis(t + h));
            for k in 0..4 {
                let first = (after.values[0][k] - before.values[0][k]) / (2.0 * h);
                let second = (after.values[1][k] - before.values[1][k]) / (2.0 * h);
                assert!((first - at.values[1][k]).abs() < 1e-8, "{t} {k}");
                assert!((second - at.values[2][k]).abs() < 1e-7, "{t} {k}");
            }
        }
    }

    #[test]
    fn spans_are_found_at_both_ends_and_on_double_knots() {
        let knots = KnotVector::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
        assert_eq!([-1.0, 0.0, 0.5, 1.0, 1.5, 2.0, 3.0].map(|t| knots.span(t)), [2, 2, 2, 4, 4, 4, 4]);
        assert_eq!(knots.spans().collect::<Vec<_>>(), [2, 4]);
    }
}
