//! `Covered`: pieces of the first cage for which caps stand, and where in a cap their points are.

use super::biquartic::Biquartic;
use super::biquartic_surface::BiquarticSurface;
use super::chart::{Chart, Scalar};
use super::circles::PolarNeighbourhood;
use super::layout::{LensNet, Quadrant};
use super::piece::Piece;
use super::polar::PolarCap;
use crate::limit::{Flags, LimitJet};
use crate::math::{Curvature, SurfaceJet, Vec3};
use crate::mesh::{HalfedgeId, Topology};
use std::sync::Arc;

/// A piece of the first cage, and where in a cap it lies.
#[derive(Clone, Debug)]
pub(crate) struct Covered {
    pub(super) piece: Piece,
    pub(super) place: Place,
}

/// Where in a cap a piece lies.
#[derive(Clone, Debug)]
pub(super) enum Place {
    /// The square `[a, a + 1] x [b, b + 1]` of a quadrant, in whose frame the piece is.
    Cell { surface: Arc<BiquarticSurface>, quadrant: Quadrant, a: u32, b: u32 },
    /// The part of a sector between the radii `row` and `row + 1`. The piece begins at the outer circle: its `s` goes around
    /// and its `t` inwards.
    Row { cap: Arc<PolarCap>, sector: usize, row: u32 },
    /// A corner of the triangle that is the part of a sector inside radius 1. Of its corners, counted from this one, `start` is the
    /// one on the circle where the sector starts; the next is the other one on the circle, and then comes the pole.
    Triangle { cap: Arc<PolarCap>, sector: usize, start: u32 },
}

/// What the rings of a bi-4 net stand for; `pieces` has those of the faces, as far as they are any.
pub(super) fn by_rings(
    net: &LensNet,
    surface: &Biquartic,
    topology: &Topology,
    pieces: &[Option<Piece>],
) -> Vec<Covered> {
    let surface = Arc::new(BiquarticSurface::new(surface));
    let cells = [(0, 0), (1, 0), (1, 1), (0, 1)];
    let places = Quadrant::BOTH.into_iter().flat_map(|quadrant| cells.map(|(a, b)| (quadrant, a, b)));
    let covered = |(quadrant, a, b): (Quadrant, u32, u32)| {
        let h = net.cells[quadrant.index()][a as usize][b as usize];
        let place = Place::Cell { surface: surface.clone(), quadrant, a, b };
        Some(Covered { piece: seen_from(h, topology, pieces)?, place })
    };
    places.filter_map(covered).collect()
}

/// What a polar cap inside circles stands for; `pieces` has those of the faces, as far as they are any.
pub(super) fn by_polar_cap(
    circles: &PolarNeighbourhood,
    cap: PolarCap,
    topology: &Topology,
    pieces: &[Option<Piece>],
) -> Vec<Covered> {
    let cap = Arc::new(cap);
    let columns = circles.columns();
    let mut covered = Vec::with_capacity(circles.disk.len());
    for (number, &face) in circles.disk.iter().enumerate() {
        let (row, sector) = (number / columns, number % columns);
        let circle = &circles.circles[row];
        let ends = [circle[sector], circle[(sector + 1) % columns]];
        let is_outer = |&h: &HalfedgeId| [topology.origin(h), topology.target(h)] == ends;
        let Some(outer) = topology.halfedges(face).find(is_outer) else { continue };
        if topology.face_size(face) == 4 {
            let place = Place::Row { cap: cap.clone(), sector, row: row as u32 };
            covered.extend(seen_from(outer, topology, pieces).map(|piece| Covered { piece, place }));
        } else if let Some(whole) = pieces[face.index()] {
            let first = outer.0 - topology.first(face).0;
            covered.extend((0..3).map(|corner| Covered {
                piece: whole.child(corner, 3),
                place: Place::Triangle { cap: cap.clone(), sector, start: (first + 3 - corner) % 3 },
            }));
        }
    }
    covered
}

/// The piece that the face of a halfedge is, with the start of the halfedge for its `(0, 0)`.
fn seen_from(h: HalfedgeId, topology: &Topology, pieces: &[Option<Piece>]) -> Option<Piece> {
    let face = topology.face(h);
    pieces[face.index()].map(|piece| piece.seen_from(h.0 - topology.first(face).0))
}

impl Covered {
    /// The point of the cap at `(u, v)` of the piece's parametric face; `None` outside the piece.
    pub(super) fn point(&self, u: f64, v: f64) -> Option<CapPoint<'_>> {
        let Chart { x: s, y: t } = self.piece.chart(u, v)?;
        Some(match &self.place {
            Place::Cell { surface, quadrant, a, b } => {
                let chart = Chart { x: s.scaled(1.0, f64::from(*a)), y: t.scaled(1.0, f64::from(*b)) };
                CapPoint::Quadrant(surface, *quadrant, chart)
            }
            Place::Row { cap, sector, row } => {
                let radius = t.scaled(-1.0, f64::from(*row) + 1.0);
                CapPoint::Sector(cap, *sector, Chart { x: radius, y: s })
            }
            Place::Triangle { cap, sector, start } => {
                CapPoint::Sector(cap, *sector, in_triangle(*start, s, t))
            }
        })
    }
}

/// Radius and how far around at `(s, t)` of a corner of a triangle that is a sector.
///
/// Barycentric coordinates are bilinear on a corner. The radius is the share of the two corners on the circle, and how far around
/// the second's share of that, which is nothing at the pole.
fn in_triangle(start: u32, s: Scalar, t: Scalar) -> Chart {
    let lost = s.times(t).scaled(-1.0 / 6.0, 0.0);
    let (next, before) = (s.scaled(0.5, 0.0).plus(lost), t.scaled(0.5, 0.0).plus(lost));
    let own = next.plus(before).scaled(-1.0, 1.0);
    let shares = [own, next, before];
    let [first, second] = [0, 1].map(|k| shares[(start as usize + k) % 3]);
    let radius = first.plus(second);
    let around = if radius.value > 0.0 { second.over(radius) } else { Scalar::default() };
    Chart { x: radius, y: around }
}

/// A point of a cap, with its coordinates there.
pub(super) enum CapPoint<'a> {
    /// `u` and `v` of a quadrant; both are 0 at the lens itself.
    Quadrant(&'a BiquarticSurface, Quadrant, Chart),
    /// Radius, and how far around, in a sector; the radius is 0 at the pole itself.
    Sector(&'a PolarCap, usize, Chart),
}

impl CapPoint<'_> {
    /// Position, derivatives with respect to the parameters of the first cage, and normal; at a lens or a pole tangents that are
    /// no derivatives.
    pub(super) fn jet(&self) -> LimitJet {
        let at_centre = |jet: SurfaceJet| {
            let none = Vec3::ZERO;
            (SurfaceJet { duu: none, duv: none, dvv: none, ..jet }, Flags::AT_EXTRAORDINARY)
        };
        let (jet, flags) = match self {
            CapPoint::Quadrant(surface, quadrant, chart) => match chart.values() {
                [0.0, 0.0] => at_centre(surface.expansion().jet()),
                [u, v] => (chart.applied_to(&surface.jet(*quadrant, u, v)), Flags::NONE),
            },
            CapPoint::Sector(cap, sector, chart) => match chart.values() {
                [0.0, _] => at_centre(cap.pole()),
                [radius, around] => (chart.applied_to(&cap.jet(*sector, around, radius)), Flags::NONE),
            },
        };
        let normal = jet.normal();
        let flags = if normal.is_some() { flags } else { flags.with(Flags::NORMAL_UNDEFINED) };
        LimitJet { jet, normal: normal.unwrap_or(Vec3::ZERO), flags }
    }

    /// Curvatures, at a lens or a pole too.
    pub(super) fn curvature(&self) -> Option<Curvature> {
        match self {
            CapPoint::Quadrant(surface, quadrant, chart) => {
                let [u, v] = chart.values();
                surface.curvature(*quadrant, u, v)
            }
            CapPoint::Sector(cap, sector, chart) => match chart.values() {
                [0.0, _] => cap.pole().curvature(),
                [radius, around] => cap.jet(*sector, around, radius).curvature(),
            },
        }
    }
}
