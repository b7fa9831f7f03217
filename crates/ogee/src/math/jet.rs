//! `SurfaceJet`: a surface at a point to second order, and what follows from it.
//!
//! Curvatures are those of a symmetric 2x2 matrix, the second fundamental form in an orthonormal basis of the tangent
//! plane. The formulas with `E F G` and `L M N` are the same in other words, but their `H^2 - K` cancels near
//! umbilics, and their products leave the range of numbers on surfaces that are very small or very large.

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
    /// Gauss curvature, `k1 k2`; infinite where it is larger than any number, as on a surface of size 1e-160.
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

    /// Principal curvatures and their directions. `None` where the surface is singular, or bends more than numbers
    /// can say.
    pub fn curvature(&self) -> Option<Curvature> {
        let frame = Frame::new(self)?;
        let [a, b, c] = frame.bending();
        let size = a.abs().max(b.abs()).max(c.abs());
        if size == 0.0 {
            let [t1, t2] = frame.tangents;
            return Some(Curvature { gauss: 0.0, mean: 0.0, k1: 0.0, k2: 0.0, directions: [t1, t2] });
        }
        // Scaled first: squares would vanish or overflow.
        let [a, b, c] = [a / size, b / size, c / size];
        let (mean, half, determinant) = ((a + c) / 2.0, (a - c) / 2.0, a * c - b * b);
        let radius = half.hypot(b);
        // The larger one by addition, so that nothing cancels; the other one from the product of both.
        let large = mean + radius.copysign(mean);
        let small = determinant / large;
        let (k1, k2) = (size * large.max(small), size * large.min(small));
        let is_umbilic = radius <= UMBILIC;
        let (sine, cosine) = if is_umbilic { (0.0, 1.0) } else { (b.atan2(half) / 2.0).sin_cos() };
        let [t1, t2] = frame.tangents;
        let directions = [cosine * t1 + sine * t2, cosine * t2 - sine * t1];
        (k1.is_finite() && k2.is_finite()).then_some(Curvature {
            gauss: size * (size * determinant),
            mean: size * mean,
            k1,
            k2,
            directions,
        })
    }

    /// Derivatives along `u` and along `v` of the unit normal `du x dv`. `None` where the surface is singular, or
    /// bends more than numbers can say.
    pub fn normal_derivatives(&self) -> Option<[Vec3; 2]> {
        let frame = Frame::new(self)?;
        let Frame { tangents: [t1, t2], lengths: [along_u, along_v], cosine, sine, uu, uv, vv } = frame;
        // The normal turns against the direction in which the surface bends.
        let du = -along_u * (uu * t1 + (uv - cosine * uu) / sine * t2);
        let dv = -along_v * (uv * t1 + (vv - cosine * uv) / sine * t2);
        (du.is_finite() && dv.is_finite()).then_some([du, dv])
    }
}

/// Sines of the angle between tangents below this are rounding: tangents that ought to be parallel would have a normal.
const PARALLEL: f64 = 8.0 * f64::EPSILON;

/// Half the difference of principal curvatures, as a share of them, below which their directions are rounding.
const UMBILIC: f64 = 8.0 * f64::EPSILON;

/// An orthonormal basis of the tangent plane, and how the surface bends in it.
struct Frame {
    /// The first along `du`, the second towards `dv`.
    tangents: [Vec3; 2],
    /// Those of `du` and of `dv`.
    lengths: [f64; 2],
    /// Of the angle from `du` to `dv`.
    cosine: f64,
    sine: f64,
    /// The second fundamental form on the unit vectors of `du` and `dv`.
    uu: f64,
    uv: f64,
    vv: f64,
}

impl Frame {
    /// `None` where the surface is singular or something is not finite.
    fn new(jet: &SurfaceJet) -> Option<Frame> {
        let (t1, d2) = (jet.du.normalized()?, jet.dv.normalized()?);
        let cross = t1.cross(d2);
        let (sine, cosine) = (cross.length(), t1.dot(d2));
        if sine.is_nan() || sine <= PARALLEL {
            return None;
        }
        let normal = cross / sine;
        let [along_u, along_v] = [jet.du.dot(t1), jet.dv.dot(d2)];
        // One length after the other: their product may be no number.
        let uu = (jet.duu / along_u / along_u).dot(normal);
        let uv = (jet.duv / along_u / along_v).dot(normal);
        let vv = (jet.dvv / along_v / along_v).dot(normal);
        let t2 = normal.cross(t1);
        (uu.is_finite() && uv.is_finite() && vv.is_finite()).then_some(Frame {
            tangents: [t1, t2],
            lengths: [along_u, along_v],
            cosine,
            sine,
            uu,
            uv,
            vv,
        })
    }

    /// The second fundamental form in the orthonormal basis: on the first vector, on both, on the second.
    fn bending(&self) -> [f64; 3] {
        let Frame { cosine, sine, uu, uv, vv, .. } = *self;
        let mixed = (uv - cosine * uu) / sine;
        let across = ((vv - cosine * uv) / sine - cosine * mixed) / sine;
        [uu, mixed, across]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jet(derivatives: [[f64; 3]; 5]) -> SurfaceJet {
        let [du, dv, duu, duv, dvv] = derivatives.map(Vec3::from);
        SurfaceJet { position: Vec3::ZERO, du, dv, duu, duv, dvv }
    }

    /// The graph of `(a x^2 + 2 b x y + c y^2) / 2` at the origin.
    fn graph(a: f64, b: f64, c: f64) -> SurfaceJet {
        jet([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, a], [0.0, 0.0, b], [0.0, 0.0, c]])
    }

    /// The same surface in parameters `(s, t)` with `u = m0 s + m1 t`, `v = m2 s + m3 t`.
    fn in_other_parameters(jet: &SurfaceJet, [m0, m1, m2, m3]: [f64; 4]) -> SurfaceJet {
        let mixed =
            |a: f64, b: f64, c: f64, d: f64| a * c * jet.duu + (a * d + b * c) * jet.duv + b * d * jet.dvv;
        SurfaceJet {
            position: jet.position,
            du: m0 * jet.du + m2 * jet.dv,
            dv: m1 * jet.du + m3 * jet.dv,
            duu: mixed(m0, m2, m0, m2),
            duv: mixed(m0, m2, m1, m3),
            dvv: mixed(m1, m3, m1, m3),
        }
    }

    fn sphere(radius: f64, u: f64, v: f64) -> SurfaceJet {
        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
        let scaled = |x: f64, y: f64, z: f64| radius * Vec3::new(x, y, z);
        SurfaceJet {
            position: scaled(cu * cv, su * cv, sv),
            du: scaled(-su * cv, cu * cv, 0.0),
            dv: scaled(-cu * sv, -su * sv, cv),
            duu: scaled(-cu * cv, -su * cv, 0.0),
            duv: scaled(su * sv, -cu * sv, 0.0),
            dvv: scaled(-cu * cv, -su * cv, -sv),
        }
    }

    fn torus(u: f64, v: f64) -> SurfaceJet {
        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
        let r = 2.0 + cv;
        SurfaceJet {
            position: Vec3::new(r * cu, r * su, sv),
            du: Vec3::new(-r * su, r * cu, 0.0),
            dv: Vec3::new(-sv * cu, -sv * su, cv),
            duu: Vec3::new(-r * cu, -r * su, 0.0),
            duv: Vec3::new(sv * su, -sv * cu, 0.0),
            dvv: Vec3::new(-cv * cu, -cv * su, -sv),
        }
    }

    fn assert_near(a: f64, b: f64, what: &str) {
        assert!((a - b).abs() <= 1e-13 * (1.0 + a.abs().max(b.abs())), "{what}: {a} is not {b}");
    }

    fn assert_directions(jet: &SurfaceJet, curvature: &Curvature) {
        let (normal, [first, second]) = (jet.normal().unwrap(), curvature.directions);
        for direction in [first, second] {
            assert_near(direction.length(), 1.0, "length");
            assert_near(direction.dot(normal), 0.0, "out of the tangent plane");
        }
        assert_near(first.dot(second), 0.0, "angle");
        for (direction, k) in [(first, curvature.k1), (second, curvature.k2)] {
            assert_near(jet.normal_curvature(normal, direction).unwrap(), k, "bends along its direction");
        }
    }

    #[test]
    fn a_sphere_is_all_umbilics_of_negative_mean() {
        for (u, v) in [(0.3, 0.2), (2.0, -1.1), (-3.0, 1.5)] {
            for radius in [0.1, 1.0, 70.0] {
                let jet = sphere(radius, u, v);
                let curvature = jet.curvature().unwrap();
                for k in [curvature.k1, curvature.k2, curvature.mean] {
                    assert_near(k * radius, -1.0, "sphere");
                }
                assert_near(curvature.gauss * radius * radius, 1.0, "sphere");
                assert!(curvature.k1 >= curvature.k2);
            }
        }
        let curvature = graph(3.0, 0.0, 3.0).curvature().unwrap();
        assert_eq!((curvature.k1, curvature.k2), (3.0, 3.0));
        assert_eq!(curvature.directions, [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)]);
    }

    #[test]
    fn saddles_cylinders_and_bowls_in_any_parameters() {
        let changes = [
            [1.0, 0.0, 0.0, 1.0],
            [0.0, -1.0, 1.0, 0.0],
            [2.0, 0.5, -1.0, 3.0],
            [1.0, 0.99, 0.0, 0.1],
            [300.0, 0.0, 0.0, 0.01],
        ];
        let cases = [
            ([0.0, 1.0, 0.0], [1.0, -1.0]),
            ([0.0, 0.0, 0.0], [0.0, 0.0]),
            ([2.0, 0.0, 0.0], [2.0, 0.0]),
            ([-2.0, 0.0, 0.0], [0.0, -2.0]),
            ([1.0, 1.0, 1.0], [2.0, 0.0]),
            ([2.0, 0.0, 4.0], [4.0, 2.0]),
            ([-2.0, 0.0, -4.0], [-2.0, -4.0]),
        ];
        for ([a, b, c], [k1, k2]) in cases {
            for change in changes {
                let jet = in_other_parameters(&graph(a, b, c), change);
                let curvature = jet.curvature().unwrap();
                let what = format!("{a} {b} {c} in {change:?}");
                assert!((curvature.k1 - k1).abs() < 1e-11 && (curvature.k2 - k2).abs() < 1e-11, "{what}");
                assert!((curvature.gauss - k1 * k2).abs() < 1e-11, "{what}");
                assert!((curvature.mean - (k1 + k2) / 2.0).abs() < 1e-11, "{what}");
                let [first, second] = curvature.directions;
                assert!(first.dot(second).abs() < 1e-14 && (first.length() - 1.0).abs() < 1e-14, "{what}");
            }
        }
        let curvature = graph(0.0, 1.0, 0.0).curvature().unwrap();
        let diagonal = Vec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
        assert!((curvature.directions[0] - diagonal).length() < 1e-15);
    }

    #[test]
    fn a_torus_has_both_signs() {
        for v in [0.0, 1.0, 1.6, 2.5, std::f64::consts::PI, -2.0] {
            let jet = torus(0.7, v);
            let curvature = jet.curvature().unwrap();
            let round = -v.cos() / (2.0 + v.cos());
            assert_near(curvature.k1, round, "round the axis");
            assert_near(curvature.k2, -1.0, "round the tube");
            assert_directions(&jet, &curvature);
            assert_directions(&jet, &in_other_parameters(&jet, [1.0, 0.4, -0.2, 2.0]).curvature().unwrap());
        }
    }

    #[test]
    fn nothing_cancels() {
        // H^2 - K of this is 1e-20 from numbers of size 1.
        let curvature = graph(1.0, 1e-10, 1.0).curvature().unwrap();
        assert!(((curvature.k1 - curvature.k2) - 2e-10).abs() < 1e-15);
        let curvature = graph(1.0, 0.0, 1e-12).curvature().unwrap();
        assert!((curvature.k2 / 1e-12 - 1.0).abs() < 1e-14 && (curvature.gauss / 1e-12 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn size_does_not_matter() {
        for size in [1e-200, 1e-100, 1e100, 1e150] {
            let torus = torus(0.7, 1.0);
            let [du, dv, duu, duv, dvv] =
                [torus.du, torus.dv, torus.duu, torus.duv, torus.dvv].map(|d| size * d);
            let curvature = SurfaceJet { position: Vec3::ZERO, du, dv, duu, duv, dvv }.curvature().unwrap();
            let expected = torus.curvature().unwrap();
            assert_near(curvature.k1 * size, expected.k1, "k1");
            assert_near(curvature.k2 * size, expected.k2, "k2");
            assert_near(curvature.directions[0].dot(expected.directions[0]), 1.0, "direction");
            assert!(!curvature.gauss.is_nan());
        }
    }

    #[test]
    fn singular_points_have_no_curvature() {
        let flat = graph(1.0, 0.0, 2.0);
        let third = Vec3::new(1.0, 2.0, -3.0) / 7.0;
        for jet in [
            SurfaceJet::default(),
            SurfaceJet { du: Vec3::ZERO, ..flat },
            SurfaceJet { du: third, dv: third * 3.3, ..flat },
            SurfaceJet { du: third, dv: -third, ..flat },
            SurfaceJet { dv: Vec3::new(f64::NAN, 1.0, 0.0), ..flat },
            SurfaceJet { duv: Vec3::new(0.0, 0.0, f64::NAN), ..flat },
            SurfaceJet { duu: Vec3::new(0.0, 0.0, f64::INFINITY), ..flat },
            SurfaceJet { du: Vec3::new(1e-200, 0.0, 0.0), ..flat },
        ] {
            assert_eq!(jet.curvature(), None, "{jet:?}");
            assert_eq!(jet.normal_derivatives(), None, "{jet:?}");
        }
    }

    #[test]
    fn the_normal_turns_as_it_says() {
        const STEP: f64 = 1e-5;
        let surfaces: [fn(f64, f64) -> SurfaceJet; 2] = [torus, |u, v| sphere(3.0, u, v)];
        for surface in surfaces {
            for (u, v) in [(0.2, 0.3), (1.0, -0.7), (-2.0, 1.2)] {
                let normal = |u: f64, v: f64| surface(u, v).normal().unwrap();
                let [along_u, along_v] = surface(u, v).normal_derivatives().unwrap();
                let measured_u = (normal(u + STEP, v) - normal(u - STEP, v)) / (2.0 * STEP);
                let measured_v = (normal(u, v + STEP) - normal(u, v - STEP)) / (2.0 * STEP);
                assert!((along_u - measured_u).length() < 1e-9, "{along_u:?} {measured_u:?}");
                assert!((along_v - measured_v).length() < 1e-9, "{along_v:?} {measured_v:?}");
                // Parameters that are askew: the chain rule.
                let askew = in_other_parameters(&surface(u, v), [1.0, 0.9, 0.0, 0.2]);
                let [first, second] = askew.normal_derivatives().unwrap();
                assert!((first - along_u).length() < 1e-13);
                assert!((second - (0.9 * along_u + 0.2 * along_v)).length() < 1e-13);
            }
        }
    }
}
