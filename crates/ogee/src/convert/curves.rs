//! How far curves are from the edges of a part.

use super::{Part, UpAxis};
use crate::curve_network::TargetCurve;
use crate::math::{Vec3, par};
use crate::nurbs::NurbsCurve;

/// Samples on each span of a curve.
const PER_SPAN: usize = 16;

/// The largest distance, in the unit of the cage, of sampled points of curves from the nearest edge of a part: 0 without
/// curves, infinite without edges. Curves are in the coordinates of the cage; `up` is what the part was made with.
///
/// A network that was embedded has its curves in `Embedding::segments`. Costs some microseconds a sample, of which there are
/// 16 on each span, and a box test for each edge.
pub fn largest_distance_to_edges(part: &Part, curves: &[TargetCurve], up: UpAxis) -> f64 {
    let shells = part.bodies.iter().flat_map(super::Body::shells);
    let edges: Vec<Edge> = shells.flat_map(|shell| &shell.edges).map(|edge| Edge::new(&edge.curve)).collect();
    let samples: Vec<Vec3> = curves
        .iter()
        .flat_map(|curve| {
            let count = curve.spans() * PER_SPAN;
            (0..=count).map(move |k| up.turn(curve.point(k as f64 / PER_SPAN as f64)))
        })
        .collect();
    let distances = par::map(samples.len(), |k| nearest(&edges, samples[k]));
    distances.into_iter().fold(0.0, f64::max)
}

fn nearest(edges: &[Edge], point: Vec3) -> f64 {
    let mut near: Vec<(f64, &Edge)> = edges.iter().map(|edge| (edge.least_distance(point), edge)).collect();
    near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut best = f64::INFINITY;
    for (least, edge) in near {
        if least >= best {
            break;
        }
        best = best.min(edge.distance(point));
    }
    best
}

/// A curve with the box of its coefficients.
struct Edge<'a> {
    curve: &'a NurbsCurve,
    low: Vec3,
    high: Vec3,
}

impl<'a> Edge<'a> {
    fn new(curve: &'a NurbsCurve) -> Edge<'a> {
        let first = curve.points[0];
        let (low, high) =
            curve.points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
        Edge { curve, low, high }
    }

    /// The distance from the box.
    fn least_distance(&self, point: Vec3) -> f64 {
        point.distance(point.max(self.low).min(self.high))
    }

    /// The distance from the curve: Newton's method from the nearest of some points on every span. A closed curve is near
    /// its end from both sides, so one start is not enough.
    fn distance(&self, point: Vec3) -> f64 {
        const STARTS: usize = 8;
        let knots = &self.curve.knots;
        let starts = knots.spans().map(|span| {
            let (low, high) = (knots.knots()[span], knots.knots()[span + 1]);
            let on_span = (0..=STARTS).map(|k| low + (high - low) * k as f64 / STARTS as f64);
            let measured = on_span.map(|t| (self.curve.point(t).distance(point), t));
            measured.fold((f64::INFINITY, low), |a, b| if b.0 < a.0 { b } else { a })
        });
        let starts: Vec<(f64, f64)> = starts.collect();
        let nearest = starts.iter().map(|start| start.0).fold(f64::INFINITY, f64::min);
        let near = starts.into_iter().filter(|start| start.0 <= 2.0 * nearest);
        near.map(|(distance, t)| distance.min(self.foot(point, t))).fold(f64::INFINITY, f64::min)
    }

    /// The least distance that Newton's method passes through.
    fn foot(&self, point: Vec3, mut t: f64) -> f64 {
        const STEPS: usize = 12;
        let [start, end] = self.curve.knots.domain();
        let mut best = f64::INFINITY;
        for _ in 0..STEPS {
            let [position, slope, bend] = self.curve.jet(t);
            let offset = position - point;
            best = best.min(offset.length());
            let curvature = slope.dot(slope) + offset.dot(bend);
            // Gauss and Newton's step where the other one would lead away.
            let under = if curvature > 0.0 { curvature } else { slope.dot(slope) };
            if under <= 0.0 {
                break;
            }
            t = (t - offset.dot(slope) / under).clamp(start, end);
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_curve_are_on_it() {
        for closed in [false, true] {
            let at =
                |k: i32| Vec3::new(f64::cos(f64::from(k)), f64::sin(1.1 * f64::from(k)), 0.1 * f64::from(k));
            let curve = TargetCurve::new((0..7).map(at).collect(), closed).unwrap();
            let nurbs = curve.to_nurbs();
            let edge = Edge::new(&nurbs);
            for k in 0..=100 {
                let point = curve.point(f64::from(k) / 100.0 * curve.spans() as f64);
                assert!(
                    edge.least_distance(point) == 0.0 && edge.distance(point) < 1e-14,
                    "{closed} {k} {}",
                    edge.distance(point)
                );
            }
            let aside = Vec3::new(0.0, 0.0, -2.0);
            assert!((edge.distance(curve.point(0.0) + aside) - 2.0).abs() < 0.2);
        }
    }
}
