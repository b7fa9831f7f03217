//! Polynomial B-splines as they stand in a file: any knots, clamped or not.
//!
//! Of its own, so that what the lint finds does not lean on the code that made the file.

use ogee::{Grid, Vec3};

/// Degrees beyond this are passed over.
pub(super) const HIGHEST_DEGREE: usize = 24;

/// Degree and knots, repeated ones repeated; read from a file and found sound.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Knots {
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
}

impl Knots {
    /// The parameters where the spline is defined.
    pub(super) fn domain(&self) -> [f64; 2] {
        [self.knots[self.degree], self.knots[self.knots.len() - 1 - self.degree]]
    }

    /// The distinct knots inside the domain, ends included.
    pub(super) fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.knots[self.degree..self.knots.len() - self.degree].to_vec();
        breaks.dedup();
        breaks
    }

    /// The first coefficient that matters at `t`.
    fn first(&self, t: f64) -> usize {
        let last = self.knots.len() - self.degree - 2;
        (self.knots.partition_point(|&knot| knot <= t)).saturating_sub(1).clamp(self.degree, last)
            - self.degree
    }

    /// The point and the derivative at `t` of the spline with these coefficients.
    fn eval(&self, coefficient: impl Fn(usize) -> Vec3, t: f64) -> [Vec3; 2] {
        let p = self.degree;
        let first = self.first(t);
        let mut d = [Vec3::ZERO; HIGHEST_DEGREE + 1];
        for (j, d) in d[..=p].iter_mut().enumerate() {
            *d = coefficient(first + j);
        }
        let mut derivative = Vec3::ZERO;
        for round in 1..=p {
            if round == p {
                let span = self.knots[first + p + 1] - self.knots[first + p];
                derivative = (d[p] - d[p - 1]) * (p as f64 / span);
            }
            for j in (round..=p).rev() {
                let (low, high) = (self.knots[first + j], self.knots[first + j + p + 1 - round]);
                d[j] = d[j - 1].lerp(d[j], (t - low) / (high - low));
            }
        }
        [d[p], derivative]
    }
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    pub(super) knots: Knots,
    pub(super) points: Vec<Vec3>,
}

impl Curve {
    /// The straight line from one point to another, over [0, 1].
    pub(super) fn segment(from: Vec3, to: Vec3) -> Curve {
        Curve { knots: Knots { degree: 1, knots: vec![0.0, 0.0, 1.0, 1.0] }, points: vec![from, to] }
    }

    pub(super) fn at(&self, t: f64) -> Vec3 {
        self.knots.eval(|i| self.points[i], t)[0]
    }

    /// The ends of the domain, as points.
    pub(super) fn ends(&self) -> [Vec3; 2] {
        self.knots.domain().map(|t| self.at(t))
    }

    /// True if it has no length.
    pub(super) fn is_a_point(&self, tolerance: f64) -> bool {
        self.points.iter().all(|point| point.distance(self.points[0]) <= tolerance)
    }

    /// The parameter between `from` and `to` of the place closest to a point, and its distance.
    pub(super) fn closest(&self, point: Vec3, [from, to]: [f64; 2]) -> (f64, f64) {
        let count = (4 * self.knots.breaks().len() * self.knots.degree).min(500);
        let at = |k: usize| from + (to - from) * k as f64 / count as f64;
        let samples: Vec<(f64, f64)> = (0..=count).map(at).map(|t| (t, self.at(t).distance(point))).collect();
        // Every hollow is tried: a closed curve has one at either end.
        let hollows = (0..=count).filter(|&k| {
            let lower = |other: usize| samples.get(other).is_some_and(|other| other.1 < samples[k].1);
            !lower(k.wrapping_sub(1)) && !lower(k + 1)
        });
        let found = hollows.map(|k| self.newton(point, samples[k], [from, to]));
        found.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(samples[0])
    }

    /// Newton's steps for the closest place, from a guess; never worse than it.
    pub(super) fn newton(&self, point: Vec3, guess: (f64, f64), [from, to]: [f64; 2]) -> (f64, f64) {
        let mut best = guess;
        let mut t = guess.0;
        for _ in 0..12 {
            let [p, d] = self.knots.eval(|i| self.points[i], t);
            let speed = d.dot(d);
            if speed <= 0.0 {
                break;
            }
            t = (t + (point - p).dot(d) / speed).clamp(from.min(to), from.max(to));
            let distance = self.at(t).distance(point);
            // A number that is none is no improvement.
            if distance < best.1 {
                best = (t, distance);
            } else {
                break;
            }
        }
        best
    }
}

/// A surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surface {
    pub(super) u: Knots,
    pub(super) v: Knots,
    pub(super) net: Grid<Vec3>,
}

impl Surface {
    /// The curve along `v` at `u`, and the coefficients of its derivative across, by `u`.
    fn across_u(&self, u: f64) -> [Vec<Vec3>; 2] {
        let (points, derivatives) =
            (0..self.net.cols()).map(|j| self.u.eval(|i| self.net[(i, j)], u)).map(|[p, d]| (p, d)).unzip();
        [points, derivatives]
    }

    /// Position and both derivatives.
    pub(super) fn eval(&self, u: f64, v: f64) -> [Vec3; 3] {
        let first = self.v.first(v);
        let mut rows = [[Vec3::ZERO; 2]; HIGHEST_DEGREE + 1];
        for (j, row) in rows[..=self.v.degree].iter_mut().enumerate() {
            *row = self.u.eval(|i| self.net[(i, first + j)], u);
        }
        let [point, dv] = self.v.eval(|j| rows[j - first][0], v);
        let [du, _] = self.v.eval(|j| rows[j - first][1], v);
        [point, du, dv]
    }

    /// The four boundary rows in the order of the loop: v least, u greatest, v greatest, u least; each runs
    /// along its growing parameter.
    pub(super) fn rows(&self) -> [Curve; 4] {
        let ([u0, u1], [v0, v1]) = (self.u.domain(), self.v.domain());
        let along_u = |v: f64| Curve {
            knots: self.u.clone(),
            points: (0..self.net.rows()).map(|i| self.v.eval(|j| self.net[(i, j)], v)[0]).collect(),
        };
        let along_v = |u: f64| Curve { knots: self.v.clone(), points: self.across_u(u)[0].clone() };
        [along_u(v0), along_v(u1), along_u(v1), along_v(u0)]
    }

    /// One third of the flux through the surface of the position relative to `origin`, exact but for rounding, which
    /// grows with the distance from there.
    pub(super) fn flux(&self, origin: Vec3) -> f64 {
        let at_u = gauss(&self.u, 3 * self.u.degree);
        let at_v = gauss(&self.v, 3 * self.v.degree);
        let mut flux = 0.0;
        for &(u, weight_u) in &at_u {
            let [points, across] = self.across_u(u);
            for &(v, weight_v) in &at_v {
                let [point, dv] = self.v.eval(|j| points[j], v);
                let [du, _] = self.v.eval(|j| across[j], v);
                flux += weight_u * weight_v * (point - origin).dot(du.cross(dv));
            }
        }
        flux / 3.0
    }

    /// The distance of a point from the surface, by Newton's steps from the best of a lattice.
    pub(super) fn distance(&self, point: Vec3) -> f64 {
        let lattice = |knots: &Knots| {
            let count = (2 * knots.breaks().len() * knots.degree).min(40);
            let [a, b] = knots.domain();
            (0..=count).map(|k| a + (b - a) * k as f64 / count as f64).collect::<Vec<f64>>()
        };
        let (along_u, along_v) = (lattice(&self.u), lattice(&self.v));
        let (mut u, mut v, mut best) = (0.0, 0.0, f64::INFINITY);
        for &a in &along_u {
            for &b in &along_v {
                let distance = self.eval(a, b)[0].distance(point);
                if distance < best {
                    (u, v, best) = (a, b, distance);
                }
            }
        }
        let ([u0, u1], [v0, v1]) = (self.u.domain(), self.v.domain());
        for _ in 0..20 {
            let [at, du, dv] = self.eval(u, v);
            best = best.min(at.distance(point));
            let away = point - at;
            let (a, b, c) = (du.dot(du), du.dot(dv), dv.dot(dv));
            let determinant = a * c - b * b;
            if determinant <= 1e-14 * a * c {
                break;
            }
            let (x, y) = (away.dot(du), away.dot(dv));
            u = (u + (c * x - b * y) / determinant).clamp(u0, u1);
            v = (v + (a * y - b * x) / determinant).clamp(v0, v1);
        }
        best
    }
}

/// Places and weights that integrate polynomials of this degree exactly on every knot span.
fn gauss(knots: &Knots, degree: usize) -> Vec<(f64, f64)> {
    let rule = ogee::nurbs::gauss(degree / 2 + 1);
    let breaks = knots.breaks();
    breaks
        .windows(2)
        .flat_map(|span| {
            let (middle, half) = ((span[0] + span[1]) / 2.0, (span[1] - span[0]) / 2.0);
            rule.iter().map(move |&(x, weight)| (middle + half * x, half * weight))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_curve_is_searched_at_both_ends() {
        let knots = Knots { degree: 2, knots: vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0] };
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
        let curve = Curve { knots, points: corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec() };
        for t in [0.01, 1.5, 2.99] {
            let (found, distance) = curve.closest(curve.at(t), [0.0, 3.0]);
            assert!((found - t).abs() < 1e-9 && distance < 1e-9, "{t}: {found}");
        }
    }

    #[test]
    fn a_surface_knows_its_distance() {
        let knots = Knots { degree: 2, knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0] };
        let net = Grid::from_fn(3, 3, |i, j| Vec3::new(i as f64, j as f64, 0.0));
        let surface = Surface { u: knots.clone(), v: knots, net };
        assert!((surface.distance(Vec3::new(0.7, 1.1, 0.25)) - 0.25).abs() < 1e-12);
        assert!((surface.distance(Vec3::new(-3.0, 1.0, 4.0)) - 5.0).abs() < 1e-12);
        let rows = surface.rows();
        assert_eq!(rows[1].ends(), [Vec3::new(2.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 0.0)]);
        let (t, distance) = rows[2].closest(Vec3::new(0.5, 2.5, 0.0), [0.0, 1.0]);
        assert!((t - 0.25).abs() < 1e-12 && (distance - 0.5).abs() < 1e-12);
    }
}
