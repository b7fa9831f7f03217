//! `NurbsSurface`: a polynomial tensor-product B-spline surface; the two degrees may differ.

use super::basis::Basis;
use super::{KnotVector, NurbsCurve, Side};
use crate::math::{Grid, SurfaceJet, Vec3};

/// A polynomial tensor-product B-spline surface.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsSurface {
    /// Degree and knots along `u`.
    pub u: KnotVector,
    /// Degree and knots along `v`.
    pub v: KnotVector,
    /// `net[(i, j)]`: `i` along `u`, `j` along `v`; `u.coefficients()` x `v.coefficients()`.
    pub net: Grid<Vec3>,
}

impl NurbsSurface {
    /// Position and derivatives. On an inner knot the values of the span after it; on the last knot of the one
    /// before.
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet {
        self.jet_from(&self.u.basis(u), &self.v.basis(v))
    }

    pub(crate) fn jet_from(&self, u: &Basis, v: &Basis) -> SurfaceJet {
        let (p, q) = (self.u.degree(), self.v.degree());
        let mut jet = SurfaceJet::default();
        for i in 0..=p {
            let points = &self.net.row(u.first + i)[v.first..=v.first + q];
            let mut rows = [Vec3::ZERO; 3];
            for (k, &point) in points.iter().enumerate() {
                rows[0] += v.values[0][k] * point;
                rows[1] += v.values[1][k] * point;
                rows[2] += v.values[2][k] * point;
            }
            jet.position += u.values[0][i] * rows[0];
            jet.du += u.values[1][i] * rows[0];
            jet.dv += u.values[0][i] * rows[1];
            jet.duu += u.values[2][i] * rows[0];
            jet.duv += u.values[1][i] * rows[1];
            jet.dvv += u.values[0][i] * rows[2];
        }
        jet
    }

    /// Position, `du` and `dv` alone: half the work of a jet.
    pub(crate) fn tangents_from(&self, u: &Basis, v: &Basis) -> [Vec3; 3] {
        let (p, q) = (self.u.degree(), self.v.degree());
        let (mut position, mut du, mut dv) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
        for i in 0..=p {
            let points = &self.net.row(u.first + i)[v.first..=v.first + q];
            let (mut value, mut slope) = (Vec3::ZERO, Vec3::ZERO);
            for (k, &point) in points.iter().enumerate() {
                value += v.values[0][k] * point;
                slope += v.values[1][k] * point;
            }
            position += u.values[0][i] * value;
            du += u.values[1][i] * value;
            dv += u.values[0][i] * slope;
        }
        [position, du, dv]
    }

    /// The knots along a side.
    pub(crate) fn along(&self, side: Side) -> &KnotVector {
        match side {
            Side::V0 | Side::V1 => &self.u,
            Side::U0 | Side::U1 => &self.v,
        }
    }

    /// The boundary curve of a side, along growing parameter.
    pub fn side(&self, side: Side) -> NurbsCurve {
        let (rows, cols) = (self.net.rows(), self.net.cols());
        let knots = self.along(side).clone();
        let points = match side {
            Side::V0 => (0..rows).map(|i| self.net[(i, 0)]).collect(),
            Side::V1 => (0..rows).map(|i| self.net[(i, cols - 1)]).collect(),
            Side::U0 => self.net.row(0).to_vec(),
            Side::U1 => self.net.row(rows - 1).to_vec(),
        };
        NurbsCurve { knots, points }
    }

    /// The surface parameters of a point of a side.
    pub fn on_side(&self, side: Side, t: f64) -> (f64, f64) {
        match side {
            Side::V0 => (t, self.v.domain()[0]),
            Side::U1 => (self.u.domain()[1], t),
            Side::V1 => (t, self.v.domain()[1]),
            Side::U0 => (self.u.domain()[0], t),
        }
    }

    /// The same surface with `u` and `v` exchanged, which turns its normal round.
    pub fn transposed(&self) -> NurbsSurface {
        NurbsSurface { u: self.v.clone(), v: self.u.clone(), net: self.net.transposed() }
    }

    /// The same surface with its parameters turned by so many quarters, counter-clockwise: what was at `(0, 0)` is at corner
    /// `quarters`, corners counted counter-clockwise.
    pub fn turned(&self, quarters: u32) -> NurbsSurface {
        (0..quarters % 4).fold(self.clone(), |surface, _| {
            let (rows, columns) = (surface.net.cols(), surface.net.rows());
            let net = Grid::from_fn(rows, columns, |i, j| surface.net[(j, rows - 1 - i)]);
            NurbsSurface { u: surface.v.reversed(), v: surface.u, net }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface() -> NurbsSurface {
        let u = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]);
        let v = KnotVector::new(2, vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]);
        let net = Grid::from_fn(6, 4, |i, j| {
            let (x, y) = (i as f64, j as f64);
            Vec3::new(x + 0.1 * y * y, y - 0.2 * x, (x * 1.3).sin() + (y * 0.7).cos())
        });
        NurbsSurface { u, v, net }
    }

    #[test]
    fn turned_surfaces_are_the_same() {
        let surface = surface();
        for quarters in 0..4 {
            let turned = surface.turned(quarters);
            for (u, v) in [(0.0, 0.0), (0.3, 0.9), (1.7, 0.2)] {
                let (mut x, mut y, mut width, mut height) = (u, v, 2.0, 1.0);
                for _ in 0..quarters {
                    (x, y) = (height - y, x);
                    (width, height) = (height, width);
                }
                let (own, there) = (surface.jet(u, v), turned.jet(x, y));
                assert!(own.position.distance(there.position) < 1e-14, "{quarters}");
                let (normal, other) = (own.du.cross(own.dv), there.du.cross(there.dv));
                assert!(normal.distance(other) < 1e-12 * normal.length() + 1e-12, "{quarters}");
            }
        }
    }

    #[test]
    fn jets_agree_with_differences() {
        let s = surface();
        let h = 1e-5;
        for (u, v) in [(0.3, 0.2), (1.4, 0.7), (0.9, 0.9)] {
            let jet = s.jet(u, v);
            let along = |du: f64, dv: f64| (s.jet(u + du, v + dv), s.jet(u - du, v - dv));
            let (a, b) = along(h, 0.0);
            assert!(((a.position - b.position) / (2.0 * h) - jet.du).length() < 1e-8);
            assert!(((a.du - b.du) / (2.0 * h) - jet.duu).length() < 1e-7);
            assert!(((a.dv - b.dv) / (2.0 * h) - jet.duv).length() < 1e-7);
            let (a, b) = along(0.0, h);
            assert!(((a.position - b.position) / (2.0 * h) - jet.dv).length() < 1e-8);
            assert!(((a.dv - b.dv) / (2.0 * h) - jet.dvv).length() < 1e-7);
        }
    }

    #[test]
    fn sides_are_the_boundary() {
        let s = surface();
        for side in [Side::V0, Side::U1, Side::V1, Side::U0] {
            let curve = s.side(side);
            let [start, end] = curve.knots.domain();
            for i in 0..=4 {
                let t = start + (end - start) * f64::from(i) / 4.0;
                let (u, v) = s.on_side(side, t);
                assert!(curve.point(t).distance(s.jet(u, v).position) < 1e-14);
            }
        }
    }

    #[test]
    fn a_cylinder_bends_as_it_should() {
        // z = x^2 / 2 as a Bezier piece: curvature 1 along x at the origin, 0 along y, towards the normal (0, 0, 1).
        let u = KnotVector::new(2, vec![-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]);
        let v = KnotVector::new(1, vec![0.0, 0.0, 1.0, 1.0]);
        let net = Grid::from_fn(3, 2, |i, j| Vec3::new(i as f64 - 1.0, j as f64, [0.5, -0.5, 0.5][i]));
        let jet = NurbsSurface { u, v, net }.jet(0.0, 0.5);
        let normal = jet.normal().unwrap();
        let bend = |x: f64, y: f64| jet.normal_curvature(normal, Vec3::new(x, y, 0.0)).unwrap();
        assert!((bend(2.0, 0.0) - 1.0).abs() < 1e-14 && bend(0.0, 1.0).abs() < 1e-14);
    }
}
