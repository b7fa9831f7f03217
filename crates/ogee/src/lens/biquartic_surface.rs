//! The limit of bi-4 subdivision at any point of a lens.

use super::biquartic::{Biquartic, QuadraticExpansion};
use super::layout::Quadrant;
use crate::math::{Curvature, SurfaceJet, Vec3};
use crate::nurbs::{KnotVector, NurbsSurface};

/// Rings that are evaluated as such. Inside them the quadratic expansion is nearer than rounding, to second derivatives: what it
/// leaves out falls by the eigenvalue 0.0204 a ring, and second derivatives grow by 4.
const RINGS: usize = 14;

/// The limit surface of a bi-4 net, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct BiquarticSurface {
    /// Relative to the lens, so that small rings keep their digits.
    rings: Vec<[NurbsSurface; 6]>,
    expansion: QuadraticExpansion,
}

impl BiquarticSurface {
    /// The surface of a net.
    pub fn new(net: &Biquartic) -> BiquarticSurface {
        let expansion = net.expansion();
        let relative = Biquartic { points: net.points.map(|point| point - expansion.position) };
        let nets = std::iter::successors(Some(relative), |net| Some(net.step())).take(RINGS);
        let ring = |net: Biquartic| net.ring_patches().map(|patch| bezier(patch.net));
        BiquarticSurface { rings: nets.map(ring).collect(), expansion }
    }

    /// The surface near the lens, in `x + i y = w^2`: there it is regular, while `u` and `v` are not.
    pub fn expansion(&self) -> &QuadraticExpansion {
        &self.expansion
    }

    /// Position and derivatives with respect to `u` and `v`, both in `[0, 2]`. Where they are both 0 derivatives vanish, but for
    /// the second: [`BiquarticSurface::expansion`] has normal and curvature.
    pub fn jet(&self, quadrant: Quadrant, u: f64, v: f64) -> SurfaceJet {
        let (mut scale, mut k) = (1.0, 0);
        while k < RINGS && (scale * u).max(scale * v) < 1.0 {
            scale *= 2.0;
            k += 1;
        }
        let Some(ring) = self.rings.get(k) else { return self.near(quadrant, u, v) };
        let (u, v) = (scale * u, scale * v);
        let cell = if v < 1.0 {
            0
        } else if u < 1.0 {
            2
        } else {
            1
        };
        let [a, b] = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][cell];
        let patch = &ring[cell + if quadrant == Quadrant::First { 0 } else { 3 }];
        let jet = patch.jet(u - a, v - b);
        let square = scale * scale;
        SurfaceJet {
            position: self.expansion.position + jet.position,
            du: scale * jet.du,
            dv: scale * jet.dv,
            duu: square * jet.duu,
            duv: square * jet.duv,
            dvv: square * jet.dvv,
        }
    }

    /// Curvatures, at the lens too; `None` where the surface is singular. Near the lens they follow from derivatives in
    /// `x` and `y`: those in `u` and `v` have next to no digits left for them.
    pub fn curvature(&self, quadrant: Quadrant, u: f64, v: f64) -> Option<Curvature> {
        if u.max(v) * (1 << (RINGS - 1)) as f64 >= 1.0 {
            return self.jet(quadrant, u, v).curvature();
        }
        self.expanded(quadrant, u, v).curvature()
    }

    /// The quadratic expansion in `x` and `y`.
    fn expanded(&self, quadrant: Quadrant, u: f64, v: f64) -> SurfaceJet {
        let sign = if quadrant == Quadrant::First { 1.0 } else { -1.0 };
        self.expansion.at(sign * (u * u - v * v), sign * 2.0 * u * v)
    }

    /// The same, by the chain rule of `x = u^2 - v^2` and `y = 2 u v`, with the sign of the quadrant.
    fn near(&self, quadrant: Quadrant, u: f64, v: f64) -> SurfaceJet {
        let sign = if quadrant == Quadrant::First { 1.0 } else { -1.0 };
        let jet = self.expanded(quadrant, u, v);
        let (along_u, along_v) = ([sign * 2.0 * u, sign * 2.0 * v], [-sign * 2.0 * v, sign * 2.0 * u]);
        let first = |[x, y]: [f64; 2]| x * jet.du + y * jet.dv;
        let second = |[a, b]: [f64; 2], [c, d]: [f64; 2]| -> Vec3 {
            a * c * jet.duu + (a * d + b * c) * jet.duv + b * d * jet.dvv
        };
        SurfaceJet {
            position: jet.position,
            du: first(along_u),
            dv: first(along_v),
            duu: second(along_u, along_u) + 2.0 * sign * jet.du,
            duv: second(along_u, along_v) + 2.0 * sign * jet.dv,
            dvv: second(along_v, along_v) - 2.0 * sign * jet.du,
        }
    }
}

/// A Bezier patch of degree (4, 4) over the unit square.
pub(super) fn bezier(net: crate::math::Grid<Vec3>) -> NurbsSurface {
    let knots = || KnotVector::from_multiplicities(4, [(0.0, 5), (1.0, 5)]);
    NurbsSurface { u: knots(), v: knots(), net }
}
