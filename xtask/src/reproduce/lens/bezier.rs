//! Bezier patches to third order: mean curvature, and how fast it changes along the surface.

use ogee::nurbs::{KnotVector, NurbsSurface};
use ogee::{Grid, Vec3};

/// The highest derivative.
const ORDER: usize = 3;

/// Tangents that span less than this share of the square of their lengths are those of a singular point, which rounding has moved.
const SINGULAR: f64 = 1e-9;

/// A Bezier patch over the unit square.
pub(super) fn bezier(net: Grid<Vec3>) -> NurbsSurface {
    let knots = |points: usize| KnotVector::from_multiplicities(points - 1, [(0.0, points), (1.0, points)]);
    NurbsSurface { u: knots(net.rows()), v: knots(net.cols()), net }
}

/// The patch that a uniform bicubic B-spline has over the inner cell of a grid of `4 x 4` points.
pub(super) fn from_cubic(point: impl Fn(usize, usize) -> Vec3) -> NurbsSurface {
    const WEIGHTS: [[f64; 4]; 4] =
        [[1.0, 4.0, 1.0, 0.0], [0.0, 4.0, 2.0, 0.0], [0.0, 2.0, 4.0, 0.0], [0.0, 1.0, 4.0, 1.0]];
    bezier(Grid::from_fn(4, 4, |a, b| {
        let mut sum = Vec3::ZERO;
        for i in 0..4 {
            for j in 0..4 {
                sum += WEIGHTS[a][i] * WEIGHTS[b][j] / 36.0 * point(i, j);
            }
        }
        sum
    }))
}

/// What is measured at a point.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) position: Vec3,
    /// Mean curvature, with the sign of the normal `du x dv`.
    pub(super) mean: f64,
    /// The square of its gradient on the surface.
    pub(super) gradient_squared: f64,
    /// The area that a unit square of parameters covers here.
    pub(super) area: f64,
}

/// Samples of a Bezier patch of any degrees at `count x count` parameters, borders included, those along `v` fastest. `None` where the
/// patch is singular.
pub(super) fn samples(patch: &NurbsSurface, count: usize) -> Vec<Option<Sample>> {
    let parameters = (0..count).map(|i| i as f64 / (count - 1) as f64);
    let basis = |points: usize| parameters.clone().map(|t| derivatives(points - 1, t)).collect::<Vec<_>>();
    let (along_u, along_v) = (basis(patch.net.rows()), basis(patch.net.cols()));
    along_u.iter().flat_map(|u| along_v.iter().map(|v| Jet::new(&patch.net, u, v).sample())).collect()
}

/// Bernstein polynomials of a degree at a parameter, and their derivatives: `[order][number]`.
fn derivatives(degree: usize, t: f64) -> [Vec<f64>; ORDER + 1] {
    std::array::from_fn(|order| {
        if order > degree {
            return vec![0.0; degree + 1];
        }
        let mut values = bernstein(degree - order, t);
        for raised in degree - order + 1..=degree {
            let before = |i: usize| if i == 0 { 0.0 } else { values[i - 1] };
            let own = |i: usize| values.get(i).copied().unwrap_or(0.0);
            values = (0..=raised).map(|i| raised as f64 * (before(i) - own(i))).collect();
        }
        values
    })
}

/// Bernstein polynomials of a degree at a parameter, each degree from the one below.
fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![0.0; degree + 1];
    values[0] = 1.0;
    for raised in 1..=degree {
        for i in (1..=raised).rev() {
            values[i] = (1.0 - t) * values[i] + t * values[i - 1];
        }
        values[0] *= 1.0 - t;
    }
    values
}

/// `[i][j]`: the derivative of order `i` along `u` and `j` along `v`.
struct Jet([[Vec3; ORDER + 1]; ORDER + 1]);

impl Jet {
    fn new(net: &Grid<Vec3>, u: &[Vec<f64>; ORDER + 1], v: &[Vec<f64>; ORDER + 1]) -> Jet {
        let mut jet = [[Vec3::ZERO; ORDER + 1]; ORDER + 1];
        for (i, u) in u.iter().enumerate() {
            for (j, v) in v.iter().enumerate().take(ORDER + 1 - i) {
                for (row, u) in u.iter().enumerate() {
                    let points = net.row(row).iter().zip(v);
                    jet[i][j] += *u * points.fold(Vec3::ZERO, |sum, (&point, &v)| sum + v * point);
                }
            }
        }
        Jet(jet)
    }

    /// `H = A / (2 w^3)` with `A = E N - 2 F M + G L`, where `L`, `M` and `N` are taken with the normal `du x dv` of length `w`.
    fn sample(&self) -> Option<Sample> {
        let s = &self.0;
        let (du, dv) = (s[1][0], s[0][1]);
        let normal = du.cross(dv);
        let [e, f, g] = [du.dot(du), du.dot(dv), dv.dot(dv)];
        let [l, m, n] = [s[2][0], s[1][1], s[0][2]].map(|second| second.dot(normal));
        let square = e * g - f * f;
        let a = e * n - 2.0 * f * m + g * l;
        let mean = a / (2.0 * square.powf(1.5));
        let along = |i: usize, j: usize| {
            let normal_along = s[1 + i][j].cross(dv) + du.cross(s[i][1 + j]);
            let e_along = 2.0 * s[1 + i][j].dot(du);
            let f_along = s[1 + i][j].dot(dv) + du.dot(s[i][1 + j]);
            let g_along = 2.0 * s[i][1 + j].dot(dv);
            let second = |p: usize, q: usize| s[p + i][q + j].dot(normal) + s[p][q].dot(normal_along);
            let a_along = e_along * n + e * second(0, 2) - 2.0 * (f_along * m + f * second(1, 1))
                + g_along * l
                + g * second(2, 0);
            let square_along = e_along * g + e * g_along - 2.0 * f * f_along;
            a_along / (2.0 * square.powf(1.5)) - 1.5 * mean * square_along / square
        };
        let (u, v) = (along(1, 0), along(0, 1));
        let gradient_squared = (g * u * u - 2.0 * f * u * v + e * v * v) / square;
        let sample = Sample { position: s[0][0], mean, gradient_squared, area: square.sqrt() };
        let is_regular = square.sqrt() > SINGULAR * (e + g);
        (is_regular && mean.is_finite() && gradient_squared.is_finite()).then_some(sample)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bicubic patch in general position, moved along `u` and `v`: differences of the mean curvature give its gradient.
    #[test]
    fn gradients_are_those_of_differences() {
        let net = Grid::from_fn(4, 5, |i, j| {
            let (x, y) = (i as f64, j as f64);
            Vec3::new(x + 0.1 * y * y, y - 0.07 * x * x, 0.3 * x * y + 0.2 * (x * 1.3 + y * y * 0.4).sin())
        });
        let patch = bezier(net);
        let mean = |u: f64, v: f64| patch.jet(u, v).curvature().unwrap().mean;
        let step = 1e-5;
        let (u, v) = (0.5, 0.25);
        let found = samples(&patch, 5)[5 * 2 + 1].unwrap();
        let jet = patch.jet(u, v);
        let along_u = (mean(u + step, v) - mean(u - step, v)) / (2.0 * step);
        let along_v = (mean(u, v + step) - mean(u, v - step)) / (2.0 * step);
        let [e, f, g] = [jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv)];
        let squared =
            (g * along_u * along_u - 2.0 * f * along_u * along_v + e * along_v * along_v) / (e * g - f * f);
        assert!((found.mean - mean(u, v)).abs() < 1e-12);
        assert!((found.gradient_squared - squared).abs() < 1e-7 * squared);
    }
}
