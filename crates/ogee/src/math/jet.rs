//! `SurfaceJet`: a surface at a point to second order, and what follows from it.

use super::Vec3;

/// Position and derivatives at a point of a surface, with respect to its own parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceJet {
    /// Position.
    pub position: Vec3,
    /// First derivative along `u`.
    pub du: Vec3,
    /// First derivative along `v`.
    pub dv: Vec3,
    /// Second derivative along `u`.
    pub duu: Vec3,
    /// Mixed derivative.
    pub duv: Vec3,
    /// Second derivative along `v`.
    pub dvv: Vec3,
}

/// Curvatures of a surface at a point.
///
/// Signs follow the normal `du x dv`: where the surface bends towards it they are positive, so a sphere whose normals
/// point outward has `mean < 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    /// Gauss curvature, `k1 k2`.
    pub gauss: f64,
    /// Mean curvature, `(k1 + k2) / 2`.
    pub mean: f64,
    /// The larger principal curvature.
    pub k1: f64,
    /// The smaller principal curvature.
    pub k2: f64,
    /// Unit tangent vectors along which the surface bends by `k1` and by `k2`; at right angles. At an umbilic, where
    /// all directions are alike, the first is along `du`.
    pub directions: [Vec3; 2],
}

impl SurfaceJet {
    /// The unit normal `du x dv`; `None` where the surface is singular.
    pub fn normal(&self) -> Option<Vec3> {
        self.du.cross(self.dv).normalized()
    }

    /// Normal curvature in a tangent direction of any length, given as a vector in space. Positive where the surface
    /// bends towards `normal`. `None` where the surface is singular or the direction has no length.
    pub fn normal_curvature(&self, normal: Vec3, direction: Vec3) -> Option<f64> {
        let (e, f, g) = (self.du.dot(self.du), self.du.dot(self.dv), self.dv.dot(self.dv));
        let determinant = e * g - f * f;
        let length = direction.dot(direction);
        if determinant <= 0.0 || length <= 0.0 {
            return None;
        }
        let (x, y) = (direction.dot(self.du), direction.dot(self.dv));
        let (a, b) = ((x * g - y * f) / determinant, (y * e - x * f) / determinant);
        let bend =
            a * a * self.duu.dot(normal) + 2.0 * a * b * self.duv.dot(normal) + b * b * self.dvv.dot(normal);
        Some(bend / length)
    }
}
