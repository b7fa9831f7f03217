//! `TargetCurve`: the curves a surface is made to contain: uniform cubic B-splines, closed or with natural ends.
//!
//! These, and no others, are the curves of Catmull-Clark surfaces along their paths (Abbas and Nasri 2004), so these can
//! be met exactly. An open curve begins at its first control point, in the direction of the second, without curvature:
//! it goes on as if its polygon did, `Q_{-1} = 2 Q_0 - Q_1`. Any other curve is fitted, and [`Fit`] says how well.

use super::tridiagonal::{solve_between, solve_cyclic};
use crate::math::Vec3;
use crate::nurbs::{KnotVector, NurbsCurve};

/// Where [`TargetCurve::fit`] looks at the distance, per span.
const SAMPLES_PER_SPAN: usize = 16;

/// How many midpoint refinements [`TargetCurve::with_points`] tries before it fits.
const MOST_REFINEMENTS: u32 = 3;

/// A uniform cubic B-spline curve; the parameter is in spans, knots at the integers.
///
/// ```
/// use ogee::{Vec3, curve_network::TargetCurve};
///
/// let points = [[0.0, 0.0], [1.0, 2.0], [3.0, 2.0], [4.0, 0.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
/// let curve = TargetCurve::open(points.to_vec())?;
/// let start = curve.jet(0.0);
/// assert_eq!((start.position, start.first), (points[0], points[1] - points[0]));
/// assert_eq!(start.second, Vec3::ZERO);
/// // Refinement gives more control points for the same curve, at half the parameter.
/// assert!(curve.refined().point(2.5).distance(curve.point(1.25)) < 1e-15);
/// # Ok::<(), ogee::curve_network::CurveError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TargetCurve {
    control: Vec<Vec3>,
    closed: bool,
}

/// A point of a curve with its derivatives by the parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveJet {
    /// The point.
    pub position: Vec3,
    /// First derivative, per span.
    pub first: Vec3,
    /// Second derivative, per span squared.
    pub second: Vec3,
}

/// A curve that stands for another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The curve; it meets the other one at its knots.
    pub curve: TargetCurve,
    /// The largest distance found between the two at equal parameters, sixteen places a span; 0 if they are one.
    pub deviation: f64,
}

/// Why points make no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CurveError {
    /// Too few points.
    #[error("{points} points make no curve; {least} is the least")]
    TooFewPoints {
        /// How many were given.
        points: usize,
        /// 2 for an open curve, 3 for a closed one.
        least: usize,
    },
    /// A coordinate is infinite or NaN.
    #[error("point {index} has a coordinate that is no finite number")]
    NotFinite {
        /// Which point, from 0.
        index: usize,
    },
}

impl TargetCurve {
    /// The curve of a control polygon with two free ends.
    ///
    /// # Errors
    /// If there are fewer than two points, or one is not finite.
    pub fn open(control: Vec<Vec3>) -> Result<TargetCurve, CurveError> {
        TargetCurve::new(control, false)
    }

    /// The periodic curve of a closed control polygon; the first point is not repeated at the end.
    ///
    /// # Errors
    /// If there are fewer than three points, or one is not finite.
    pub fn closed(control: Vec<Vec3>) -> Result<TargetCurve, CurveError> {
        TargetCurve::new(control, true)
    }

    /// [`TargetCurve::closed`] or [`TargetCurve::open`].
    ///
    /// # Errors
    /// As these do.
    pub fn new(control: Vec<Vec3>, closed: bool) -> Result<TargetCurve, CurveError> {
        check_points(&control, closed)?;
        Ok(TargetCurve { control, closed })
    }

    /// The curve with knots at given points: point `i` at parameter `i`. An open one has natural ends.
    ///
    /// # Errors
    /// As [`TargetCurve::new`].
    pub fn through(points: &[Vec3], closed: bool) -> Result<TargetCurve, CurveError> {
        check_points(points, closed)?;
        let control = match points {
            _ if closed => solve_cyclic(points),
            [first, inner @ .., last] => {
                let mut control = vec![*first];
                control.extend(solve_between(*first, inner, *last));
                control.push(*last);
                control
            }
            _ => Vec::new(),
        };
        Ok(TargetCurve { control, closed })
    }

    /// The curve of `count` control points that meets another at its knots, and how far apart the two are. `shape` is
    /// the other curve over `[0, 1]`; of a closed one 0 and 1 are the same place.
    ///
    /// # Errors
    /// As [`TargetCurve::new`], for points of `shape`.
    pub fn fit(shape: impl Fn(f64) -> Vec3, count: usize, closed: bool) -> Result<Fit, CurveError> {
        let spans = if closed { count } else { count.saturating_sub(1) };
        let at = |i: usize, parts: usize| i as f64 / (parts.max(1)) as f64;
        let points: Vec<Vec3> = (0..count).map(|i| shape(at(i, spans))).collect();
        let curve = TargetCurve::through(&points, closed)?;
        let samples = SAMPLES_PER_SPAN * spans;
        let distances = (0..=samples).map(|i| {
            let s = at(i, samples);
            curve.point(s * spans as f64).distance(shape(s))
        });
        let deviation = distances.fold(0.0, f64::max);
        Ok(Fit { curve, deviation })
    }

    /// The curve with another number of control points: the same one where up to three refinements lead there, else
    /// fitted.
    ///
    /// # Errors
    /// If `count` points make no curve.
    pub fn with_points(&self, count: usize) -> Result<Fit, CurveError> {
        let mut refined = self.clone();
        for _ in 0..=MOST_REFINEMENTS {
            if refined.control.len() == count {
                return Ok(Fit { curve: refined, deviation: 0.0 });
            }
            refined = refined.refined();
        }
        TargetCurve::fit(|s| self.point(s * self.spans() as f64), count, self.closed)
    }

    /// The control points.
    pub fn control(&self) -> &[Vec3] {
        &self.control
    }

    /// True if it has no ends.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Number of polynomial pieces: the parameter runs from 0 to it.
    pub fn spans(&self) -> usize {
        if self.closed { self.control.len() } else { self.control.len() - 1 }
    }

    /// The same curve with twice as many spans: control point `2 i` belongs to control point `i`, and `2 i + 1` is the
    /// middle of a leg.
    pub fn refined(&self) -> TargetCurve {
        let count = self.control.len();
        let mut control = Vec::with_capacity(2 * count);
        for i in 0..count {
            control.push((self.at(i, -1) + 6.0 * self.at(i, 0) + self.at(i, 1)) / 8.0);
            control.push((self.at(i, 0) + self.at(i, 1)) / 2.0);
        }
        if !self.closed {
            control.pop();
            // Equal but for rounding; an end stays where it is, bit for bit.
            (control[0], control[2 * count - 2]) = (self.control[0], self.control[count - 1]);
        }
        TargetCurve { control, closed: self.closed }
    }

    /// Where the curve is when its parameter is `u`. A closed curve takes any number, an open one what lies in
    /// `[0, spans]` and the nearest of these for others.
    pub fn point(&self, u: f64) -> Vec3 {
        self.jet(u).position
    }

    /// Point and derivatives at `u`, which is understood as by [`TargetCurve::point`].
    pub fn jet(&self, u: f64) -> CurveJet {
        let spans = self.spans() as f64;
        let u = if self.closed { u.rem_euclid(spans) } else { u.clamp(0.0, spans) };
        let span = (u as usize).min(self.spans() - 1);
        let s = u - span as f64;
        let r = 1.0 - s;
        let weights = [
            [r * r * r / 6.0, -r * r / 2.0, r],
            [(4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0, (-4.0 * s + 3.0 * s * s) / 2.0, 3.0 * s - 2.0],
            [(4.0 - 6.0 * r * r + 3.0 * r * r * r) / 6.0, (4.0 * r - 3.0 * r * r) / 2.0, 3.0 * r - 2.0],
            [s * s * s / 6.0, s * s / 2.0, s],
        ];
        // Relative to a control point: derivatives keep their digits far from the origin.
        let base = self.at(span, 0);
        let mut jet = CurveJet { position: base, ..CurveJet::default() };
        for (offset, [value, first, second]) in (-1..).zip(weights) {
            let leg = self.at(span, offset) - base;
            jet.position += value * leg;
            jet.first += first * leg;
            jet.second += second * leg;
        }
        jet
    }

    /// The point at knot `i`, to which control point `i` converges.
    ///
    /// # Panics
    /// If there is no such control point.
    pub fn limit(&self, i: usize) -> Vec3 {
        if self.is_end(i) {
            return self.control[i];
        }
        (self.at(i, -1) + 4.0 * self.at(i, 0) + self.at(i, 1)) / 6.0
    }

    /// The derivative at knot `i`.
    ///
    /// # Panics
    /// If there is no such control point.
    pub fn tangent(&self, i: usize) -> Vec3 {
        (self.at(i, 1) - self.at(i, -1)) / 2.0
    }

    /// The same curve, over the same parameters, with clamped knots: `0, 0, 0, 0, 1, 2, ...`. A closed one begins and
    /// ends at knot 0.
    pub fn to_nurbs(&self) -> NurbsCurve {
        let spans = self.spans();
        let inner = (1..spans).map(|knot| (knot as f64, 1));
        let ends = [(0.0, 4), (spans as f64, 4)];
        let knots = ends[..1].iter().copied().chain(inner).chain(ends[1..].iter().copied());
        let last = if self.closed { 0 } else { spans };
        // Polar forms at (0, 0, 0), (0, 0, 1), (0, 1, 2), .. (Ramshaw).
        let mut points = vec![self.limit(0), (2.0 * self.at(0, 0) + self.at(0, 1)) / 3.0];
        points.extend_from_slice(&self.control[1..spans]);
        points.push((self.at(last, -1) + 2.0 * self.at(last, 0)) / 3.0);
        points.push(self.limit(last));
        NurbsCurve { knots: KnotVector::from_multiplicities(3, knots), points }
    }

    /// The control points from number `from`, `count` legs further: a curve of its own, with natural ends. A closed
    /// polygon is walked round.
    pub(super) fn cut(&self, from: usize, legs: usize) -> TargetCurve {
        let count = self.control.len();
        TargetCurve { control: (0..=legs).map(|k| self.control[(from + k) % count]).collect(), closed: false }
    }

    fn is_end(&self, i: usize) -> bool {
        !self.closed && (i == 0 || i + 1 == self.control.len())
    }

    /// Control point `i + offset`, beyond an end too; `offset` from -1 to 2, `i` a control point.
    fn at(&self, i: usize, offset: isize) -> Vec3 {
        let count = self.control.len() as isize;
        let k = i as isize + offset;
        if self.closed {
            self.control[k.rem_euclid(count) as usize]
        } else if k < 0 {
            2.0 * self.control[0] - self.control[1]
        } else if k >= count {
            let last = self.control.len() - 1;
            2.0 * self.control[last] - self.control[last - 1]
        } else {
            self.control[k as usize]
        }
    }
}

fn check_points(points: &[Vec3], closed: bool) -> Result<(), CurveError> {
    let least = if closed { 3 } else { 2 };
    if points.len() < least {
        return Err(CurveError::TooFewPoints { points: points.len(), least });
    }
    match points.iter().position(|p| !p.is_finite()) {
        Some(index) => Err(CurveError::NotFinite { index }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wobbly(count: usize, closed: bool) -> TargetCurve {
        let points = (0..count).map(|i| {
            let a = i as f64;
            Vec3::new((1.7 * a).sin() * 3.0, (2.3 * a).cos() * 2.0, 0.3 * a - (0.4 * a * a).sin())
        });
        TargetCurve::new(points.collect(), closed).unwrap()
    }

    fn curves() -> impl Iterator<Item = TargetCurve> {
        let counts = |closed: bool| (if closed { 3 } else { 2 }..9).map(move |count| (count, closed));
        counts(true).chain(counts(false)).map(|(count, closed)| wobbly(count, closed))
    }

    #[test]
    fn refinement_keeps_every_point() {
        for curve in curves() {
            let fine = curve.refined();
            for i in 0..=40 {
                let u = curve.spans() as f64 * f64::from(i) / 40.0;
                let (coarse, fine) = (curve.jet(u), fine.jet(2.0 * u));
                assert!(coarse.position.distance(fine.position) < 1e-14, "{curve:?} at {u}");
                assert!(coarse.first.distance(2.0 * fine.first) < 1e-13);
                assert!(coarse.second.distance(4.0 * fine.second) < 1e-12);
            }
        }
    }

    #[test]
    fn knots_have_their_limits_and_tangents() {
        for curve in curves() {
            for i in 0..curve.control().len() {
                let jet = curve.jet(i as f64);
                assert!(jet.position.distance(curve.limit(i)) < 1e-15 * 8.0);
                assert!(jet.first.distance(curve.tangent(i)) < 1e-15 * 8.0);
                if curve.is_end(i) {
                    assert_eq!(curve.limit(i), curve.control()[i]);
                    assert!(jet.second.length() < 1e-14, "natural ends");
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_points() {
        for curve in curves() {
            let (u, h) = (0.6, 1e-5);
            let (before, at, after) = (curve.point(u - h), curve.jet(u), curve.point(u + h));
            assert!(((after - before) / (2.0 * h)).distance(at.first) < 1e-8);
            assert!((((after - at.position) - (at.position - before)) / (h * h)).distance(at.second) < 1e-4);
        }
    }

    #[test]
    fn clamped_knots_give_the_same_curve() {
        for curve in curves() {
            let nurbs = curve.to_nurbs();
            for i in 0..=50 {
                let u = curve.spans() as f64 * f64::from(i) / 50.0;
                assert!(nurbs.point(u).distance(curve.point(u)) < 1e-14, "{curve:?} at {u}");
            }
        }
    }

    #[test]
    fn curves_go_through_points() {
        for wanted in curves() {
            let points: Vec<Vec3> = (0..wanted.control().len()).map(|i| wanted.limit(i)).collect();
            let found = TargetCurve::through(&points, wanted.is_closed()).unwrap();
            for (a, b) in found.control().iter().zip(wanted.control()) {
                assert!(a.distance(*b) < 1e-13, "{wanted:?}");
            }
        }
    }

    #[test]
    fn fits_converge_and_say_how_far_they_are() {
        let circle =
            |s: f64| Vec3::new((std::f64::consts::TAU * s).cos(), (std::f64::consts::TAU * s).sin(), 0.0);
        let deviation = |count| TargetCurve::fit(circle, count, true).unwrap().deviation;
        let (coarse, fine) = (deviation(8), deviation(16));
        // Fourth order.
        assert!(coarse < 5e-3 && (14.0..18.0).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
    }

    #[test]
    fn other_numbers_of_points_are_exact_where_refinement_leads_there() {
        for curve in curves() {
            let twice = curve.refined().refined();
            let fit = curve.with_points(twice.control().len()).unwrap();
            assert_eq!((fit.curve, fit.deviation), (twice, 0.0));
            let fit = curve.with_points(curve.control().len() + 40).unwrap();
            assert!(fit.deviation > 0.0 && fit.deviation < 0.02, "{}", fit.deviation);
        }
    }

    #[test]
    fn bad_points_are_refused() {
        let points = vec![Vec3::ZERO; 2];
        assert_eq!(
            TargetCurve::closed(points.clone()),
            Err(CurveError::TooFewPoints { points: 2, least: 3 })
        );
        assert_eq!(
            TargetCurve::through(&points[..1], false),
            Err(CurveError::TooFewPoints { points: 1, least: 2 })
        );
        let bad = vec![Vec3::ZERO, Vec3::new(f64::NAN, 0.0, 0.0)];
        assert_eq!(TargetCurve::open(bad), Err(CurveError::NotFinite { index: 1 }));
        assert!(TargetCurve::fit(|_| Vec3::ZERO, 0, false).is_err());
    }
}
