//! Polar caps: few polynomial patches around a pole, joined C2 to circles of control points.
//!
//! Around the middle of a pair of lenses, the apex of a fan, or any ring of circles whose points have valence 4, a cap replaces
//! all that lies inside the second circle. It is C2 where it meets its surroundings and in itself, at the pole too: there it
//! agrees with a quadratic polynomial to second order. Karciauskas and Peters, *Lens-shaped surfaces and C2 subdivision*, section
//! on polar caps; `docs/methods/lens.md`.

use super::polar_energy::{PolarOperator, patch_energy};
use super::polar_error::{PolarDefect, PolarError};
use super::polar_sector::{PolarVariant, SectorData, UnitLoop, around};
use crate::math::{Grid, SurfaceJet, Vec3};
use crate::nurbs::{KnotVector, NurbsSurface};

/// The largest area that the tangents at the pole may span and count as parallel, relative to the square of the circles' size.
const PARALLEL: f64 = 1e-12;

/// A cap around a pole.
///
/// Sector `i` lies between the meridians of the points `i` and `i + 1` of the circles. The radius is 0 at the pole and 2 on the
/// circle 2; patches of radial degree 5 meet at radius 1.
#[derive(Clone, Debug, PartialEq)]
pub struct PolarCap {
    variant: PolarVariant,
    pole: Vec3,
    /// `t1 t2 h11 h12 h22` in the chart of radius times direction.
    expansion: [Vec3; 5],
    /// `patches[sector]`, from the pole outwards; `u` is the radius, `v` goes from 0 to 1 around. Relative to the pole, so that a
    /// cap far from the origin keeps its digits.
    patches: Vec<Vec<NurbsSurface>>,
}

impl PolarCap {
    /// The cap inside the second of three circles, whose points are counter-clockwise; `circles[0]` is the innermost. The points
    /// of the first two have valence 4.
    ///
    /// The pole is any point: the limit point of a fan ([`super::PolarNet::limit`]), the middle of a slit
    /// ([`pair_pole`](fn@super::pair_pole)).
    ///
    /// ```
    /// use ogee::Vec3;
    /// use ogee::lens::{PolarCap, PolarVariant};
    ///
    /// // Circles of radius 1, 2, 3 on a paraboloid.
    /// let circle = |radius: f64| -> Vec<Vec3> {
    ///     let angle = |i: i32| std::f64::consts::TAU * f64::from(i) / 8.0;
    ///     let point = |i| Vec3::new(radius * angle(i).cos(), radius * angle(i).sin(), radius * radius);
    ///     (0..8).map(point).collect()
    /// };
    /// let [c1, c2, c3] = [1.0, 2.0, 3.0].map(circle);
    /// let cap = PolarCap::new([&c1, &c2, &c3], Vec3::ZERO, PolarVariant::SixFive)?;
    /// let normal = cap.pole().normal().unwrap();
    /// assert!(normal.distance(Vec3::new(0.0, 0.0, 1.0)) < 1e-12);
    /// # Ok::<(), ogee::lens::PolarError>(())
    /// ```
    ///
    /// # Errors
    /// If circles differ in their number of points or have fewer than three, if a coordinate is not finite, or if the pole has no
    /// tangent plane.
    pub fn new(circles: [&[Vec3]; 3], pole: Vec3, variant: PolarVariant) -> Result<PolarCap, PolarError> {
        PolarCap::with(&PolarOperator::new(circles[0].len(), variant)?, circles, pole)
    }

    /// As [`PolarCap::new`] with an operator that is there already, whose sectors and variant are taken.
    ///
    /// # Errors
    /// As [`PolarCap::new`], where each circle has to have as many points as the operator has sectors.
    pub fn with(operator: &PolarOperator, circles: [&[Vec3]; 3], pole: Vec3) -> Result<PolarCap, PolarError> {
        let sectors = operator.sectors();
        for (k, circle) in circles.iter().enumerate() {
            if circle.len() != sectors {
                let points = circle.len();
                return Err(PolarDefect::UnequalCircles { circle: k + 1, points, sectors }.into());
            }
        }
        let circles = circles.map(|circle| circle.iter().map(|&point| point - pole).collect::<Vec<_>>());
        if !pole.is_finite() || !circles.iter().flatten().all(|point| point.is_finite()) {
            return Err(PolarDefect::NotFinite.into());
        }
        let unknowns = operator.unknowns(circles.each_ref().map(Vec::as_slice));
        let cap = PolarCap::from_unknowns(operator.variant(), &unknowns, &circles, pole);
        let size = circles.iter().flatten().fold(0.0_f64, |most, point| most.max(point.length()));
        let [t1, t2, ..] = cap.expansion;
        let (area, square) = (t1.cross(t2).length(), size * size);
        match area.is_finite() && square.is_finite() {
            false => Err(PolarDefect::NotFinite.into()),
            true if area <= PARALLEL * square => Err(PolarDefect::Singular.into()),
            true => Ok(cap),
        }
    }

    /// The cap with given rings and expansion; they and the circles relative to the pole.
    fn from_unknowns(
        variant: PolarVariant,
        unknowns: &[Vec3],
        circles: &[Vec<Vec3>; 3],
        pole: Vec3,
    ) -> PolarCap {
        let sectors = circles[0].len();
        let (rings, expansion) = unknowns.split_at(variant.unknown_rings() * sectors);
        let expansion = [0, 1, 2, 3, 4].map(|i| expansion[i]);
        let unit = UnitLoop::new(sectors);
        let patches = (0..sectors).map(|sector| {
            let meridians = around(sector, sectors);
            let data = SectorData {
                unknown: rings.chunks(sectors).map(|ring| meridians.map(|i| ring[i])).collect(),
                expansion,
                circles: circles.each_ref().map(|circle| meridians.map(|i| circle[i])),
                pole: Vec3::ZERO,
            };
            let nets = data.patches(variant, &unit, sector).into_iter();
            let surface = |(net, &radii): (_, &[f64; 2])| bezier(net, radii);
            nets.zip(variant.radii()).map(surface).collect()
        });
        // Patches are over unit squares; the chart at the pole is not.
        let length = variant.radii()[0][1];
        let [t1, t2, h11, h12, h22] = expansion;
        let square = length * length;
        let expansion = [t1 / length, t2 / length, h11 / square, h12 / square, h22 / square];
        PolarCap { variant, pole, expansion, patches: patches.collect() }
    }

    /// The variant.
    pub fn variant(&self) -> PolarVariant {
        self.variant
    }

    /// Number of sectors.
    pub fn sectors(&self) -> usize {
        self.patches.len()
    }

    /// The patches of a sector relative to the pole, from there outwards.
    pub(super) fn patches(&self, sector: usize) -> &[NurbsSurface] {
        &self.patches[sector]
    }

    /// Position, tangents, and second derivatives at the pole, in the chart `X = r E` where `E` is the periodic cubic with the
    /// control points `(cos 2 pi i / n, sin 2 pi i / n)` around: `du` and `dv` are `t1` and `t2`, `duu`, `duv`, `dvv` are `2 h11`, `h12`, `2
    /// h22`. Normal and curvature of the surface at the pole are those of the jet; of 55 the curvature is that of the quadratic
    /// which it comes near.
    pub fn pole(&self) -> SurfaceJet {
        let [du, dv, h11, h12, h22] = self.expansion;
        SurfaceJet { position: self.pole, du, dv, duu: 2.0 * h11, duv: h12, dvv: 2.0 * h22 }
    }

    /// Position and derivatives: `u` is the radius in `[0, 2]` and `v` goes from 0 to 1 around the sector, so that `du x dv` is the
    /// side on which circles are counter-clockwise. At radius 0 `dv` and `dvv` vanish: see [`PolarCap::pole`]. On radius 1 the
    /// values of the outer patch, which are those of the inner one.
    ///
    /// # Panics
    /// If there is no such sector.
    pub fn jet(&self, sector: usize, around: f64, radius: f64) -> SurfaceJet {
        let patches = &self.patches[sector];
        let inside = patches.iter().find(|patch| radius < patch.u.domain()[1]);
        let mut jet = inside.unwrap_or(&patches[patches.len() - 1]).jet(radius, around);
        jet.position += self.pole;
        jet
    }

    /// The energy that is least among all caps with these circles and this pole: over all patches, each in its unit square, the
    /// integral of the squares of third derivatives (of 66 fourth ones) with binomial weights, summed over coordinates.
    pub fn energy(&self) -> f64 {
        let patches = self.patches.iter().flatten();
        patches.map(|patch| patch_energy(&patch.net, self.variant.energy_order())).sum()
    }
}

/// A Bezier patch over an interval of radii and a unit around.
fn bezier(net: Grid<Vec3>, [from, to]: [f64; 2]) -> NurbsSurface {
    let (p, q) = (net.rows(), net.cols());
    NurbsSurface {
        u: KnotVector::from_multiplicities(p - 1, [(from, p), (to, p)]),
        v: KnotVector::from_multiplicities(q - 1, [(0.0, q), (1.0, q)]),
        net,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_other_cap_has_more_energy() {
        for (sectors, variant) in [3, 5, 8].into_iter().flat_map(|n| PolarVariant::ALL.map(|v| (n, v))) {
            let circles = [1.0, 2.0, 3.0].map(|radius: f64| {
                let point = |i: usize| {
                    let (sine, cosine) = (std::f64::consts::TAU * i as f64 / sectors as f64).sin_cos();
                    let shake = ((i * i + 3) % 7) as f64 / 10.0;
                    radius * Vec3::new(cosine - 0.3 * shake, sine, shake)
                };
                (0..sectors).map(point).collect::<Vec<_>>()
            });
            let operator = PolarOperator::new(sectors, variant).unwrap();
            let unknowns = operator.unknowns(circles.each_ref().map(Vec::as_slice));
            let energy =
                |unknowns: &[Vec3]| PolarCap::from_unknowns(variant, unknowns, &circles, Vec3::ZERO).energy();
            let least = energy(&unknowns);
            for k in 0..unknowns.len() {
                for axis in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)] {
                    let [less, more] = [-1e-3, 1e-3].map(|by| {
                        let mut other = unknowns.clone();
                        other[k] += by * axis;
                        energy(&other) - least
                    });
                    assert!(less > 0.0 && more > 0.0, "{}, n = {sectors}, unknown {k}", variant.name());
                    // At the bottom of a parabola both sides rise alike.
                    assert!((less - more).abs() < 1e-6 * (less + more), "{less} {more}");
                }
            }
        }
    }
}
