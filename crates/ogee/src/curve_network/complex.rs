//! Simple complexes: a curve inside a mesh (Abbas and Nasri 2004).
//!
//! ```text
//!   t_0 ---- t_1 ---- t_2 ---- t_3      top row
//!    |        |        |        |
//!   m_0 ==== m_1 ==== m_2 ==== m_3      middle row: the path
//!    |        |        |        |
//!   b_0 ---- b_1 ---- b_2 ---- b_3      bottom row
//! ```
//!
//! Where all faces beside a path are quads and each inner vertex of the path has one edge to each side, the curve of the
//! surface is the B-spline with control points `P = (t + 4 m + b) / 6`. With half the sum `c` and half the difference `d` of
//! the side rows, `P` says nothing about either: `d` makes the tangent planes along the curve, `c` its cross curvature.

use super::tridiagonal::{solve_between, solve_cyclic};
use crate::math::Vec3;

/// The three rows of points along a path, each with one point per vertex of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Complex {
    /// Neighbours on the left of the path, seen from outside and walking along it.
    pub top: Vec<Vec3>,
    /// The vertices of the path.
    pub middle: Vec<Vec3>,
    /// Neighbours on the right.
    pub bottom: Vec<Vec3>,
    /// True if the path returns to its first vertex, which is not repeated.
    pub closed: bool,
}

/// Equation (1): control points of the curve that the surface has along a path.
pub fn control_point(top: Vec3, middle: Vec3, bottom: Vec3) -> Vec3 {
    (top + 4.0 * middle + bottom) / 6.0
}

/// Equation (2): where a vertex of the path must be for the curve to have a given control point.
pub fn reposition(target: Vec3, top: Vec3, bottom: Vec3) -> Vec3 {
    (6.0 * target - top - bottom) / 4.0
}

/// Where an inner curve begins on a curve along the border: at the limit of its control point `at`, between `before` and
/// `after`.
pub fn rim_start(before: Vec3, at: Vec3, after: Vec3) -> Vec3 {
    (before + 4.0 * at + after) / 6.0
}

/// Makes two curves pass through one point at a regular vertex, smoothly and with plain rules: the control points that
/// they get there. Each argument has the control points before, at and after the vertex; the common point is the mean of the
/// two limits.
pub fn smooth_crossing(one: [Vec3; 3], other: [Vec3; 3]) -> [Vec3; 2] {
    let limit = |[before, at, after]: [Vec3; 3]| (before + 4.0 * at + after) / 6.0;
    let common = (limit(one) + limit(other)) / 2.0;
    [one, other].map(|[before, _, after]| reposition(common, before, after))
}

impl Complex {
    /// Control points of the curve. Equation (1).
    pub fn curve(&self) -> Vec<Vec3> {
        (0..self.len()).map(|i| control_point(self.top[i], self.middle[i], self.bottom[i])).collect()
    }

    /// Moves the path so that the curve has these control points; the side rows stay. Equation (2).
    pub fn set_curve(&mut self, target: &[Vec3]) {
        for (i, &target) in target.iter().enumerate().take(self.len()) {
            self.middle[i] = reposition(target, self.top[i], self.bottom[i]);
        }
    }

    /// The derivative of the surface across the curve, towards the top row, at every vertex of the path.
    pub fn cross_derivatives(&self) -> Vec<Vec3> {
        self.at_knots(&self.differences())
    }

    /// The second derivative of the surface across the curve at every vertex of the path.
    pub fn second_cross_derivatives(&self) -> Vec<Vec3> {
        let bends: Vec<Vec3> =
            self.sums().iter().zip(self.curve()).map(|(&sum, point)| 3.0 * (sum - point)).collect();
        self.at_knots(&bends)
    }

    /// Gives the surface these derivatives across the curve at the vertices of the path; curve and second derivatives stay.
    /// The side points of the first `keep[0]` and the last `keep[1]` vertices of an open path do not move, and what is given
    /// for them is not read: two beside a meeting point, none at a border.
    pub fn set_cross_derivatives(&mut self, wanted: &[Vec3], keep: [usize; 2]) {
        let curve = self.curve();
        let differences = self.solved(self.differences(), wanted, keep);
        self.set_rows(&curve, &self.sums(), &differences);
    }

    /// Bends the surface beside the curve until it has the given second derivatives across it at the vertices of the path;
    /// curve and tangent planes stay. `keep` as in [`Complex::set_cross_derivatives`].
    pub fn set_second_cross_derivatives(&mut self, wanted: &[Vec3], keep: [usize; 2]) {
        let curve = self.curve();
        let bends: Vec<Vec3> =
            self.sums().iter().zip(&curve).map(|(&sum, &point)| 3.0 * (sum - point)).collect();
        let mut at_knots = self.at_knots(&bends);
        for i in self.free(keep) {
            if let Some(&wanted) = wanted.get(i) {
                at_knots[i] = wanted;
            }
        }
        let bends = self.solved(bends, &at_knots, keep);
        let sums: Vec<Vec3> = curve.iter().zip(bends).map(|(&point, bend)| point + bend / 3.0).collect();
        self.set_rows(&curve, &sums, &self.differences());
    }

    /// Number of vertices of the path that have all three points.
    pub(super) fn len(&self) -> usize {
        self.top.len().min(self.middle.len()).min(self.bottom.len())
    }

    /// `c = (t + b) / 2`.
    fn sums(&self) -> Vec<Vec3> {
        (0..self.len()).map(|i| (self.top[i] + self.bottom[i]) / 2.0).collect()
    }

    /// `d = (t - b) / 2`.
    pub(super) fn differences(&self) -> Vec<Vec3> {
        (0..self.len()).map(|i| (self.top[i] - self.bottom[i]) / 2.0).collect()
    }

    fn set_rows(&mut self, curve: &[Vec3], sums: &[Vec3], differences: &[Vec3]) {
        for i in 0..self.len() {
            self.top[i] = sums[i] + differences[i];
            self.bottom[i] = sums[i] - differences[i];
        }
        self.set_curve(curve);
    }

    /// The vertices whose side points may move.
    pub(super) fn free(&self, keep: [usize; 2]) -> std::ops::Range<usize> {
        if self.closed {
            return 0..self.len();
        }
        let end = self.len().saturating_sub(keep[1]);
        keep[0].min(end)..end
    }

    /// Coefficient `i - 1` or `i + 1`, beyond an end too.
    pub(super) fn neighbour(&self, row: &[Vec3], i: usize, offset: isize) -> Vec3 {
        let count = row.len();
        let next = |i: usize| row.get(i).copied();
        match offset {
            -1 if i > 0 => row[i - 1],
            -1 if self.closed => row[count - 1],
            -1 => 2.0 * row[0] - next(1).unwrap_or(row[0]),
            _ if i + 1 < count => row[i + 1],
            _ if self.closed => row[0],
            _ => 2.0 * row[i] - if i > 0 { row[i - 1] } else { row[i] },
        }
    }

    /// The spline with these coefficients at its knots.
    pub(super) fn at_knots(&self, row: &[Vec3]) -> Vec<Vec3> {
        (0..row.len())
            .map(|i| match i {
                _ if !self.closed && (i == 0 || i + 1 == row.len()) => row[i],
                _ => (self.neighbour(row, i, -1) + 4.0 * row[i] + self.neighbour(row, i, 1)) / 6.0,
            })
            .collect()
    }

    /// The coefficients with given values at the knots; those of kept vertices stay.
    fn solved(&self, mut row: Vec<Vec3>, at_knots: &[Vec3], keep: [usize; 2]) -> Vec<Vec3> {
        if self.closed && row.len() >= 3 {
            return solve_cyclic(at_knots);
        }
        // At a free end coefficient and value are the same.
        let free = self.free(keep);
        let (mut start, mut end) = (free.start, free.end);
        if start == 0 && start < end {
            row[0] = at_knots[0];
            start = 1;
        }
        if end == row.len() && start < end {
            row[end - 1] = at_knots[end - 1];
            end -= 1;
        }
        if start < end {
            let inner = solve_between(row[start - 1], &at_knots[start..end], row[end]);
            row[start..end].copy_from_slice(&inner);
        }
        row
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::curve_network::TargetCurve;

    pub(in super::super) fn wobbly(count: usize, closed: bool) -> Complex {
        let row = |height: f64| {
            (0..count)
                .map(|i| {
                    let a = i as f64;
                    Vec3::new(
                        a + 0.2 * (3.1 * a + height).sin(),
                        height + 0.1 * (2.0 * a).cos(),
                        (1.3 * a).sin() + 0.3 * height * height,
                    )
                })
                .collect()
        };
        Complex { top: row(1.0), middle: row(0.1), bottom: row(-0.9), closed }
    }

    /// One refinement, with further rows beyond top and bottom that have no influence on the three.
    fn refined(complex: &Complex) -> Complex {
        let count = complex.middle.len();
        let face = |side: &[Vec3], i: usize| {
            let j = (i + 1) % count;
            (side[i] + side[j] + complex.middle[i] + complex.middle[j]) / 4.0
        };
        let (mut top, mut middle, mut bottom) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..count {
            let (t, m, b) = (complex.top[i], complex.middle[i], complex.bottom[i]);
            if !complex.closed && (i == 0 || i + 1 == count) {
                // On a border.
                top.push((t + m) / 2.0);
                middle.push((t + 6.0 * m + b) / 8.0);
                bottom.push((m + b) / 2.0);
            } else {
                let before = (i + count - 1) % count;
                let (tl, tr) = (face(&complex.top, before), face(&complex.top, i));
                let (bl, br) = (face(&complex.bottom, before), face(&complex.bottom, i));
                let ends = complex.middle[before] + complex.middle[(i + 1) % count];
                top.push((t + m + tl + tr) / 4.0);
                middle.push((2.0 * m + (t + b + ends + tl + tr + bl + br) / 4.0) / 4.0);
                bottom.push((b + m + bl + br) / 4.0);
            }
            if complex.closed || i + 1 < count {
                let (above, below) = (face(&complex.top, i), face(&complex.bottom, i));
                let ends = complex.middle[i] + complex.middle[(i + 1) % count];
                top.push(above);
                middle.push((ends + above + below) / 4.0);
                bottom.push(below);
            }
        }
        Complex { top, middle, bottom, closed: complex.closed }
    }

    #[test]
    fn the_curve_of_a_refined_complex_is_the_refined_curve() {
        for (count, closed) in [(5, true), (8, true), (2, false), (6, false)] {
            let mut complex = wobbly(count, closed);
            let mut curve = TargetCurve::new(complex.curve(), closed).unwrap();
            for _ in 0..4 {
                (complex, curve) = (refined(&complex), curve.refined());
                for (a, b) in complex.curve().iter().zip(curve.control()) {
                    assert!(a.distance(*b) < 1e-14);
                }
            }
        }
    }

    #[test]
    fn repositioning_gives_the_wanted_curve() {
        let mut complex = wobbly(6, false);
        let target: Vec<Vec3> = (0..6).map(|i| Vec3::new(f64::from(i), f64::from(i * i), 2.0)).collect();
        complex.set_curve(&target);
        assert!(complex.curve().iter().zip(&target).all(|(a, b)| a.distance(*b) < 1e-14));
    }

    #[test]
    fn cross_curvature_is_met_and_nothing_else_moves() {
        for (closed, keep) in [(true, [0, 0]), (false, [0, 2])] {
            let mut complex = wobbly(7, closed);
            let (curve, across) = (complex.curve(), complex.cross_derivatives());
            let wanted: Vec<Vec3> = (0..7).map(|i| Vec3::new(0.0, 0.1 * f64::from(i), -1.0)).collect();
            complex.set_second_cross_derivatives(&wanted, keep);
            let bends = complex.second_cross_derivatives();
            for i in 0..7 {
                assert!(complex.curve()[i].distance(curve[i]) < 1e-14);
                assert!(complex.cross_derivatives()[i].distance(across[i]) < 1e-14);
                if closed || i < 5 {
                    assert!(bends[i].distance(wanted[i]) < 1e-13, "closed {closed}, vertex {i}");
                }
            }
        }
    }

    #[test]
    fn crossing_curves_get_one_limit() {
        let p = |i: u32| {
            let a = f64::from(i);
            Vec3::new((2.0 * a).sin(), (3.0 * a).cos(), a)
        };
        let (one, other) = ([p(0), p(1), p(2)], [p(3), p(4), p(5)]);
        let [a, b] = smooth_crossing(one, other);
        assert!(rim_start(one[0], a, one[2]).distance(rim_start(other[0], b, other[2])) < 1e-15 * 8.0);
    }
}
