//! `NurbsCurve`: a polynomial B-spline curve.

use super::KnotVector;
use super::basis::MAX_DEGREE;
use crate::math::Vec3;

/// A polynomial B-spline curve.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsCurve {
    /// Degree and knots.
    pub knots: KnotVector,
    /// One coefficient per B-spline: `knots.coefficients()` of them.
    pub points: Vec<Vec3>,
}

impl NurbsCurve {
    /// The point at a parameter.
    pub fn point(&self, t: f64) -> Vec3 {
        let basis = self.knots.basis(t);
        let points = &self.points[basis.first..=basis.first + self.knots.degree()];
        points.iter().zip(basis.values[0]).fold(Vec3::ZERO, |sum, (&p, weight)| sum + weight * p)
    }

    /// Position, first and second derivative at a parameter.
    pub(crate) fn jet(&self, t: f64) -> [Vec3; 3] {
        let basis = self.knots.basis(t);
        let points = &self.points[basis.first..=basis.first + self.knots.degree()];
        basis
            .values
            .map(|values| points.iter().zip(values).fold(Vec3::ZERO, |sum, (&p, weight)| sum + weight * p))
    }

    /// The same curve the other way, over the same domain.
    pub fn reversed(&self) -> NurbsCurve {
        NurbsCurve { knots: self.knots.reversed(), points: self.points.iter().rev().copied().collect() }
    }

    /// The piece between two parameters, exactly, with its own clamped knots; the parameter stays what it was.
    ///
    /// # Panics
    /// Unless `from < to` inside the domain.
    pub fn piece(&self, from: f64, to: f64) -> NurbsCurve {
        let [start, end] = self.knots.domain();
        assert!(start <= from && from < to && to <= end, "a piece lies inside the domain");
        let degree = self.knots.degree();
        let inner = self.knots.knots().iter().copied().filter(|&knot| from < knot && knot < to);
        let knots: Vec<f64> = std::iter::repeat_n(from, degree + 1)
            .chain(inner)
            .chain(std::iter::repeat_n(to, degree + 1))
            .collect();
        let knots = KnotVector::new(degree, knots);
        // A coefficient is the polar form at its inner knots, of any span inside its support.
        let points = (0..knots.coefficients()).map(|i| {
            let own = &knots.knots()[i..=i + degree + 1];
            let middle = (i..=i + degree).find(|&s| knots.knots()[s] < knots.knots()[s + 1]).unwrap_or(i);
            let at = (knots.knots()[middle] + knots.knots()[middle + 1]) / 2.0;
            polar(&self.knots, self.knots.span(at), &self.points, &own[1..=degree])
        });
        NurbsCurve { points: points.collect(), knots }
    }

    /// The same curve with every knot moved by `by`.
    pub fn shifted(mut self, by: f64) -> NurbsCurve {
        let knots = self.knots.knots().iter().map(|&knot| knot + by).collect();
        self.knots = KnotVector::new(self.knots.degree(), knots);
        self
    }
}

/// The polar form (blossom) of the polynomial of one span. Where the arguments are consecutive knots it returns that
/// coefficient, bit for bit.
pub(crate) fn polar(knots: &KnotVector, span: usize, points: &[Vec3], arguments: &[f64]) -> Vec3 {
    let degree = knots.degree();
    let mut work = [Vec3::ZERO; MAX_DEGREE + 1];
    work[..=degree].copy_from_slice(&points[span - degree..=span]);
    polar_of(&knots.knots()[span + 1 - degree..=span + degree], &mut work[..=degree], arguments)
}

/// The same from the `2 degree` knots around the span and its `degree + 1` coefficients: de Boor's recursion with a
/// different argument at each step.
pub(crate) fn polar_of(knots: &[f64], work: &mut [Vec3], arguments: &[f64]) -> Vec3 {
    let degree = work.len() - 1;
    for (step, &t) in arguments.iter().enumerate() {
        for k in (step + 1..=degree).rev() {
            let (low, high) = (knots[k - 1], knots[k - 1 + degree - step]);
            work[k] = work[k - 1].lerp(work[k], (t - low) / (high - low));
        }
    }
    work[degree]
}

/// Bezier coefficients of one degree more: `N` of them from `N - 1`.
pub(crate) fn raised<const N: usize>(points: &[Vec3]) -> [Vec3; N] {
    let degree = points.len();
    std::array::from_fn(|k| {
        let share = k as f64 / degree as f64;
        let before = if k > 0 { share * points[k - 1] } else { Vec3::ZERO };
        before + if k < degree { (1.0 - share) * points[k] } else { Vec3::ZERO }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> NurbsCurve {
        let knots = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0, 3.0]);
        let points =
            (0..7).map(|i| Vec3::new(f64::from(i), f64::from(i * i % 5), f64::from(3 * i % 4))).collect();
        NurbsCurve { knots, points }
    }

    #[test]
    fn pieces_are_exact() {
        let whole = curve();
        for (from, to) in [(0.0, 1.0), (0.25, 2.5), (1.0, 3.0), (1.0, 2.0), (0.0, 3.0)] {
            let piece = whole.piece(from, to);
            for i in 0..=10 {
                let t = from + (to - from) * f64::from(i) / 10.0;
                assert!(piece.point(t).distance(whole.point(t)) < 1e-14, "[{from}, {to}] at {t}");
            }
        }
        assert_eq!(whole.piece(0.0, 3.0), whole);
    }

    #[test]
    fn reversal_runs_backward() {
        let (whole, back) = (curve(), curve().reversed());
        for t in [0.0, 0.7, 1.0, 2.2, 3.0] {
            assert!(whole.point(t).distance(back.point(3.0 - t)) < 1e-14);
        }
    }
}
