//! Extraordinary points: how curvature behaves on smaller and smaller rings around them, how far it ranges over the faces that
//! meet there, and which have no tangent plane.
//!
//! Around a point where `n` squares meet, samples lie on quarters of circles of parameter radius `2^-j` in every square, in
//! eight directions. Beside an extraordinary vertex of a limit surface curvature neither settles nor stays bounded, so what
//! can be compared is how much it swings round a ring, and by what factor it grows from a ring to one of half the radius.

use std::collections::HashSet;

use super::continuity::jet;
use super::{Address, CurvatureRange, FLAT, Layout, Side, Square, Surface};
use crate::limit::{Derivatives, Flags, Samples};
use crate::math::{Vec3, par};
use crate::patch::Location;

/// Radii of rings are `2^-j` for these.
pub const LEVELS: [u32; 6] = [2, 4, 6, 8, 10, 12];

/// The ring by whose swing points are ranked, as an index into [`LEVELS`]: near enough that the point shows, and still of
/// a size that is seen and milled.
const RANKED: usize = 2;

/// The ring from which growth is measured, as an index into [`LEVELS`]: farther out the surroundings still have a say.
const SETTLED: usize = 3;

/// Directions in every square.
const DIRECTIONS: usize = 8;

/// What is known about extraordinary points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extraordinary {
    /// How many there are.
    pub found: usize,
    /// Those that were examined, the one around which curvature swings most first.
    pub points: Vec<ExtraordinaryPoint>,
    /// Those without a tangent plane, or with one that normals reach too slowly to be seen; in the order of the faces.
    pub without_plane: Vec<PointWithoutPlane>,
}

/// Faces around a point, between two creases or borders or all the way round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sector {
    /// The point, in the first of its faces.
    pub at: Address,
    /// The point in space.
    pub position: Vec3,
    /// How many squares meet.
    pub faces: usize,
    /// What they lie between.
    pub kind: SectorKind,
}

/// What bounds the faces around a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SectorKind {
    /// Nothing: they go all the way round.
    Interior,
    /// A crease that ends here.
    Dart,
    /// Two creases, or one and the border.
    Crease,
    /// The border of the surface.
    Border,
}

/// An extraordinary point with the rings around it.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtraordinaryPoint {
    /// Where.
    pub sector: Sector,
    /// One for each of [`LEVELS`].
    pub rings: [Ring; LEVELS.len()],
    /// How far curvature ranges over the faces around it.
    pub range: CurvatureRange,
    /// The factor by which the mean of `|H|` grows when the radius is halved, over the rings from `2^-8` inwards.
    pub growth: f64,
    /// What becomes of curvature.
    pub behaviour: Behaviour,
}

/// Curvature on a ring around a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ring {
    /// The mean of `|H|`, `H` the mean curvature.
    pub mean: f64,
    /// The swing of `H`: largest less smallest, over the mean of `|H|`; zero where the surface is flat.
    pub mean_swing: f64,
    /// The swing of the Gauss curvature `K`: largest less smallest, over the mean of `|K|`.
    pub gauss_swing: f64,
}

/// What becomes of curvature towards a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Behaviour {
    /// The surface is flat there, or has no curvature.
    Flat,
    /// It stays bounded.
    Bounded,
    /// It grows without bound, slowly.
    Growing,
}

/// A point without a tangent plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointWithoutPlane {
    /// Where.
    pub sector: Sector,
    /// Why.
    pub cause: Cause,
    /// The largest angle between the normals of two of its faces there, in degrees.
    pub spread: f64,
}

/// Why a point has no tangent plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The rules of subdivision give none: four or more faces at a crease or border, three or more at a corner, sharp
    /// vertices.
    Rules,
    /// A corner of two faces: normals reach its plane only as one over the number of steps.
    Slow,
    /// Its faces have different normals there.
    Measured,
}

/// Growth at each halving of the radius above which curvature counts as unbounded; the least of the rules is 1.07.
const GROWING: f64 = 1.02;

/// Faces whose normals differ by more than this at a common point, in degrees, have no tangent plane there.
const TORN: f64 = 0.5;

/// Points that are held in memory at once.
const BLOCK: usize = 256;

impl Extraordinary {
    /// Looks at the first `most` points, in the order of the faces; `size` is the diagonal of the surface, and `is_sharp`
    /// says of each joint whether it is a crease.
    pub(super) fn new(surface: &dyn Surface, is_sharp: &[bool], size: f64, most: usize) -> Extraordinary {
        let mut found = Extraordinary::default();
        let mut rings = Vec::new();
        let mut places = HashSet::new();
        let sectors = sectors(surface.layout(), is_sharp);
        let mut samples = Samples::default();
        for block in sectors.chunks(BLOCK) {
            let corners: Vec<Location> = block.iter().flat_map(|fan| fan.places(surface, 0.0, 0.0)).collect();
            surface.evaluate(&corners, Derivatives::First, &mut samples);
            let mut first = 0;
            for fan in block {
                let here = first..first + fan.corners.len();
                first = here.end;
                let flags = samples.flags[here.start];
                let is_flagged = flags.contains(Flags::AT_EXTRAORDINARY);
                if !is_flagged && fan.is_regular() {
                    continue;
                }
                found.found += 1;
                places.extend(corners[here.clone()].iter().map(|&corner| key(corner)));
                let at = surface.address(corners[here.start]);
                let position = samples.position[here.start];
                let sector = Sector { at, position, faces: fan.corners.len(), kind: fan.kind };
                let spread = spread(&samples.normal[here]);
                let is_corner = is_flagged && fan.corners.len() == 2 && fan.kind > SectorKind::Dart;
                let cause = if flags.contains(Flags::NORMAL_ONE_SIDED) {
                    Some(Cause::Rules)
                } else if is_corner {
                    Some(Cause::Slow)
                } else {
                    (spread > TORN).then_some(Cause::Measured)
                };
                found.without_plane.extend(cause.map(|cause| PointWithoutPlane { sector, cause, spread }));
                if rings.len() < most {
                    rings.push((fan, sector));
                }
            }
        }
        for block in rings.chunks(BLOCK) {
            found.points.extend(par::map(block.len(), |k| {
                let (fan, sector) = block[k];
                let is_alone = !fan.others(surface).any(|corner| places.contains(&key(corner)));
                examine(surface, fan, sector, size, if is_alone { 1.0 } else { 0.5 })
            }));
        }
        let swing = |point: &ExtraordinaryPoint| point.rings[RANKED].mean_swing;
        found.points.sort_by(|a, b| swing(b).total_cmp(&swing(a)));
        found
    }
}

/// The largest angle between normals, in degrees: from the one that is farthest from the first to that farthest from it.
fn spread(normals: &[Vec3]) -> f64 {
    let farthest = |from: Vec3| {
        let defined = normals.iter().filter(|normal| **normal != Vec3::ZERO);
        let angles = defined.map(|&normal| (from.angle(normal), normal));
        angles.fold((0.0, from), |best, next| if next.0 > best.0 { next } else { best })
    };
    let first = normals.iter().copied().find(|normal| *normal != Vec3::ZERO);
    first.map_or(0.0, |first| farthest(farthest(first).1).0.to_degrees())
}

/// A place as one of a set: parameters to nine digits.
fn key(at: Location) -> (usize, [i64; 2]) {
    (at.parametric_face(), at.parameters().map(|x| (x * f64::from(1 << 30)).round() as i64))
}

/// Rings, and the range over the faces as far as `reach`, a share of their sides.
fn examine(surface: &dyn Surface, fan: &Fan, sector: Sector, size: f64, reach: f64) -> ExtraordinaryPoint {
    let mut samples = Samples::default();
    let rings = LEVELS.map(|level| {
        let radius = 0.5_f64.powi(level as i32);
        let places: Vec<Location> = (0..DIRECTIONS)
            .flat_map(|k| {
                let angle = (k as f64 + 0.5) / DIRECTIONS as f64 * std::f64::consts::FRAC_PI_2;
                fan.places(surface, radius * angle.cos(), radius * angle.sin())
            })
            .collect();
        surface.evaluate(&places, Derivatives::Second, &mut samples);
        let curvatures: Vec<_> = (0..places.len())
            .filter_map(|i| jet(&samples, i).curvature())
            .map(|c| (c.mean, c.gauss))
            .collect();
        let (mean, mean_swing) = swing(curvatures.iter().map(|c| c.0), FLAT / size);
        let (_, gauss_swing) = swing(curvatures.iter().map(|c| c.1), (FLAT / size) * (FLAT / size));
        Ring { mean, mean_swing, gauss_swing }
    });
    let around = CurvatureRange::places(reach);
    let places: Vec<Location> = around.iter().flat_map(|&[x, y]| fan.places(surface, x, y)).collect();
    surface.evaluate(&places, Derivatives::Second, &mut samples);
    let range = CurvatureRange::of((0..places.len()).map(|i| jet(&samples, i)), reach);
    let (outer, inner) = (rings[SETTLED].mean, rings[LEVELS.len() - 1].mean);
    let halvings = LEVELS[LEVELS.len() - 1] - LEVELS[SETTLED];
    let is_flat = !(outer > FLAT / size && inner > FLAT / size);
    let growth = if is_flat { 1.0 } else { (inner / outer).powf(1.0 / f64::from(halvings)) };
    let behaviour = match growth {
        _ if is_flat => Behaviour::Flat,
        growth if growth > GROWING => Behaviour::Growing,
        _ => Behaviour::Bounded,
    };
    ExtraordinaryPoint { sector, rings, range, growth, behaviour }
}

/// The mean size of some numbers, and their range as a share of it; no range where they are all below `least`.
fn swing(values: impl Iterator<Item = f64> + Clone, least: f64) -> (f64, f64) {
    let values = values.filter(|x| x.is_finite());
    let count = values.clone().count();
    if count == 0 {
        return (0.0, 0.0);
    }
    let mean = values.clone().map(f64::abs).sum::<f64>() / count as f64;
    let [low, high] =
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    (mean, if mean > least { (high - low) / mean } else { 0.0 })
}

/// The corners of squares around a point, counter-clockwise.
struct Fan {
    /// Each a square and the number of its corner.
    corners: Vec<[u32; 2]>,
    kind: SectorKind,
}

impl Fan {
    /// True if a surface without extraordinary points of its own may look like this.
    fn is_regular(&self) -> bool {
        match self.kind {
            SectorKind::Interior => self.corners.len() == 4,
            SectorKind::Dart => false,
            SectorKind::Crease | SectorKind::Border => self.corners.len() < 3,
        }
    }

    /// The places at `(x, y)` in all its faces, `x` along the side that leaves the point.
    fn places<'a>(
        &'a self,
        surface: &'a dyn Surface,
        x: f64,
        y: f64,
    ) -> impl Iterator<Item = Location> + use<'a> {
        let squares = surface.layout().squares();
        self.corners.iter().map(move |&[square, corner]| inwards(&squares[square as usize], corner, [x, y]))
    }

    /// The other corners of all its faces.
    fn others<'a>(&'a self, surface: &'a dyn Surface) -> impl Iterator<Item = Location> + use<'a> {
        let corners = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        corners.into_iter().flat_map(|[x, y]| self.places(surface, x, y))
    }
}

/// The place at `(x, y)` in the piece that a square was cut from, seen from a corner that they share.
fn inwards(square: &Square, corner: u32, [x, y]: [f64; 2]) -> Location {
    let ([u, v], [width, height]) = (square.corner.parameters(), square.piece);
    let (right, top) = (u + square.size[0], v + square.size[1]);
    let (u, v) = match corner {
        0 => (u + x * width, v + y * height),
        1 => (right - y * width, v + x * height),
        2 => (right - x * width, top - y * height),
        _ => (u + y * width, top - x * height),
    };
    square.corner.clamped(u, v)
}

/// The faces around every point where squares meet, cut apart at creases.
fn sectors(layout: &Layout, is_sharp: &[bool]) -> Vec<Fan> {
    let crossed = |square: u32, side: u32| {
        let side = Side { square, side };
        layout.joint_of(side).filter(|&joint| !is_sharp[joint])?;
        layout.across(side)
    };
    // The side that arrives at a corner leads to the next square, the one that leaves it to the one before.
    let next = |[square, corner]: [u32; 2]| {
        crossed(square, (corner + 3) % 4).map(|Side { square, side }| [square, side])
    };
    let before = |[square, corner]: [u32; 2]| {
        crossed(square, corner).map(|Side { square, side }| [square, (side + 1) % 4])
    };
    let index = |[square, corner]: [u32; 2]| 4 * square as usize + corner as usize;
    let mut seen = vec![false; 4 * layout.squares().len()];
    let mut fans = Vec::new();
    for start in
        (0..layout.squares().len() as u32).flat_map(|square| (0..4).map(move |corner| [square, corner]))
    {
        if seen[index(start)] {
            continue;
        }
        let mut first = start;
        let mut is_closed = false;
        while let Some(previous) = before(first) {
            if previous == start {
                is_closed = true;
                break;
            }
            first = previous;
        }
        if is_closed {
            first = start;
        }
        let mut corners = vec![first];
        let mut last = first;
        while let Some(following) = next(last).filter(|&following| following != first) {
            corners.push(following);
            last = following;
        }
        for &corner in &corners {
            seen[index(corner)] = true;
        }
        let [leaving, arriving] = [(first[0], first[1]), (last[0], (last[1] + 3) % 4)]
            .map(|(square, side)| layout.joint_of(Side { square, side }));
        let kind = match (leaving, arriving) {
            _ if is_closed => SectorKind::Interior,
            (None, None) => SectorKind::Border,
            (Some(a), Some(b)) if a == b => SectorKind::Dart,
            _ => SectorKind::Crease,
        };
        fans.push(Fan { corners, kind });
    }
    fans
}
