//! Coordinates of a cap as functions of parameters of the first cage, and the chain rule to second order.

use crate::math::SurfaceJet;

/// A number that depends on `u` and `v`, with derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scalar {
    pub(super) value: f64,
    pub(super) du: f64,
    pub(super) dv: f64,
    pub(super) duu: f64,
    pub(super) duv: f64,
    pub(super) dvv: f64,
}

impl Scalar {
    /// A multiple of it, and a constant.
    pub(super) fn scaled(self, factor: f64, plus: f64) -> Scalar {
        Scalar {
            value: factor * self.value + plus,
            du: factor * self.du,
            dv: factor * self.dv,
            duu: factor * self.duu,
            duv: factor * self.duv,
            dvv: factor * self.dvv,
        }
    }

    /// The sum of two.
    pub(super) fn plus(self, other: Scalar) -> Scalar {
        Scalar {
            value: self.value + other.value,
            du: self.du + other.du,
            dv: self.dv + other.dv,
            duu: self.duu + other.duu,
            duv: self.duv + other.duv,
            dvv: self.dvv + other.dvv,
        }
    }

    /// The product of two.
    pub(super) fn times(self, other: Scalar) -> Scalar {
        let (a, b) = (self, other);
        Scalar {
            value: a.value * b.value,
            du: a.du * b.value + a.value * b.du,
            dv: a.dv * b.value + a.value * b.dv,
            duu: a.duu * b.value + 2.0 * a.du * b.du + a.value * b.duu,
            duv: a.duv * b.value + a.du * b.dv + a.dv * b.du + a.value * b.duv,
            dvv: a.dvv * b.value + 2.0 * a.dv * b.dv + a.value * b.dvv,
        }
    }

    /// The quotient; `other` must not be zero.
    pub(super) fn over(self, other: Scalar) -> Scalar {
        let value = self.value / other.value;
        let du = (self.du - value * other.du) / other.value;
        let dv = (self.dv - value * other.dv) / other.value;
        Scalar {
            value,
            du,
            dv,
            duu: (self.duu - 2.0 * du * other.du - value * other.duu) / other.value,
            duv: (self.duv - du * other.dv - dv * other.du - value * other.duv) / other.value,
            dvv: (self.dvv - 2.0 * dv * other.dv - value * other.dvv) / other.value,
        }
    }
}

/// Two coordinates of a surface that depend on `u` and `v`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Chart {
    pub(super) x: Scalar,
    pub(super) y: Scalar,
}

impl Chart {
    /// The coordinates.
    pub(super) fn values(&self) -> [f64; 2] {
        [self.x.value, self.y.value]
    }

    /// What a surface is in `u` and `v` that is this in the coordinates.
    pub(super) fn applied_to(&self, jet: &SurfaceJet) -> SurfaceJet {
        let Chart { x, y } = self;
        let first = |x: f64, y: f64| x * jet.du + y * jet.dv;
        let second = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            a * c * jet.duu + (a * d + b * c) * jet.duv + b * d * jet.dvv
        };
        let (along_u, along_v) = ([x.du, y.du], [x.dv, y.dv]);
        SurfaceJet {
            position: jet.position,
            du: first(x.du, y.du),
            dv: first(x.dv, y.dv),
            duu: second(along_u, along_u) + first(x.duu, y.duu),
            duv: second(along_u, along_v) + first(x.duv, y.duv),
            dvv: second(along_v, along_v) + first(x.dvv, y.dvv),
        }
    }
}
