//! What a network became, measured on the surface itself and not taken from the construction.

use super::embed::{Embedding, XConfiguration};
use super::plan::Segment;
use super::tangent_plane::TangentPlane;
use crate::limit::{Derivatives, LimitSurface};
use crate::math::Vec3;
use crate::mesh::{HalfedgeId, Topology, VertexId};
use crate::patch::{Location, PatchTable};
use crate::rules::Level;

/// Places on each edge of a curve where the surface is compared with it, both ends among them.
const PLACES: usize = 9;

/// How near to a meeting point normals are taken, in parameters: the ring of the eighth step.
const NEAR: f64 = 1.0 / 256.0;

/// Parameters of these places in a slice, along its two spokes, in units of [`NEAR`].
const AROUND: [[f64; 2]; 4] = [[1.0, 0.0], [1.0, 0.5], [1.0, 1.0], [0.5, 1.0]];

/// How well a surface keeps to its network.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetworkFigures {
    /// For each segment the largest distance found between the surface along its path and its curve.
    pub errors: Vec<f64>,
    /// For each X-configuration what its surrounding is like.
    pub meetings: Vec<MeetingFigures>,
}

/// The surface at a meeting point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeetingFigures {
    /// The largest angle between the tangent of a port and the plane of all, in degrees; `None` if one has no direction.
    pub coplanarity_deg: Option<f64>,
    /// The largest angle between a normal of the surface 1/256 of a face away and the mean of all these, in degrees. It falls by
    /// about four with each halving of the distance where there is a tangent plane. `None` if a normal is missing.
    pub normal_spread_deg: Option<f64>,
}

impl Embedding {
    /// Measures the limit surface along the curves and around the meeting points.
    ///
    /// # Errors
    /// `None` if the mesh is not a sound cage any more: it was changed after [`embed`](super::embed).
    pub fn measure(&self) -> Option<NetworkFigures> {
        let level = Level::new(&self.mesh).ok()?;
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &self.mesh.points);
        let errors = self.segments.iter().map(|segment| error(&level, &table, &surface, segment)).collect();
        let of_meeting = |meeting: &XConfiguration| MeetingFigures {
            coplanarity_deg: coplanarity(level.topology(), &self.mesh.points, meeting),
            normal_spread_deg: spread(&level, &table, &surface, meeting),
        };
        let meetings = self.x_configurations.iter().map(of_meeting).collect();
        Some(NetworkFigures { errors, meetings })
    }
}

/// The largest distance along a path.
fn error(level: &Level, table: &PatchTable, surface: &LimitSurface<'_>, segment: &Segment) -> f64 {
    let mut places = Vec::new();
    let mut points = Vec::new();
    let count = segment.vertices.len();
    for span in 0..segment.target.spans() {
        let ends = [segment.vertices[span], segment.vertices[(span + 1) % count]];
        for k in 0..PLACES {
            let t = k as f64 / (PLACES - 1) as f64;
            places.extend(on_edge(level, table, ends, t));
            points.push(segment.target.point(span as f64 + t));
        }
    }
    if places.len() < points.len() {
        return f64::INFINITY;
    }
    let samples = surface.eval_batch(&places, Derivatives::None);
    samples.position.iter().zip(&points).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// A place on a quad beside the edge, `t` along it.
fn on_edge(level: &Level, table: &PatchTable, [a, b]: [u32; 2], t: f64) -> Option<Location> {
    let topology = level.topology();
    let between = |a: u32, b: u32| topology.ring(VertexId(a)).find(|&h| topology.target(h).0 == b);
    let (h, t) = between(a, b).map(|h| (h, t)).or_else(|| Some((between(b, a)?, 1.0 - t)))?;
    on_halfedge(topology, table, h, [t, 0.0])
}

/// A place in the face of a halfedge: `s` along it, `t` along the one before it, from their common vertex. In a face that is no
/// quad `t` is at most 1/2.
fn on_halfedge(topology: &Topology, table: &PatchTable, h: HalfedgeId, [s, t]: [f64; 2]) -> Option<Location> {
    let face = topology.face(h);
    let (size, side) = (topology.face_size(face), h.0 - topology.first(face).0);
    let (corner, u, v) = match (size, side) {
        (4, 0) => (None, s, t),
        (4, 1) => (None, 1.0 - t, s),
        (4, 2) => (None, 1.0 - s, 1.0 - t),
        (4, _) => (None, t, 1.0 - s),
        _ if s <= 0.5 => (Some(side), 2.0 * s, 2.0 * t),
        _ => (Some((side + 1) % size), 2.0 * t, 2.0 * (1.0 - s)),
    };
    table.locate(face, corner, u, v).ok()
}

/// The largest angle of a port out of the plane of all.
fn coplanarity(topology: &Topology, points: &[Vec3], meeting: &XConfiguration) -> Option<f64> {
    let center = points[meeting.center as usize];
    let corner = |spoke: u32, turn: fn(&Topology, HalfedgeId) -> HalfedgeId| {
        let h = topology.ring(VertexId(meeting.center)).find(|&h| topology.target(h).0 == spoke)?;
        Some(points[topology.target(turn(topology, h)).index()])
    };
    let tangents: Option<Vec<Vec3>> = meeting
        .ring
        .iter()
        .step_by(2)
        .map(|&port| {
            let left = corner(port, |topology, h| topology.next(h))?;
            let right =
                corner(port, |topology, h| topology.prev(topology.prev(topology.twin(h).unwrap_or(h))))?;
            Some((left + 4.0 * points[port as usize] + right) / 6.0 - center)
        })
        .collect();
    let tangents = tangents?;
    let normal = super::plan::ring_normal(topology, points, meeting.center);
    Some(TangentPlane::new(&tangents, normal, None)?.deviation_deg)
}

/// The largest angle between normals near a meeting point.
fn spread(
    level: &Level,
    table: &PatchTable,
    surface: &LimitSurface<'_>,
    meeting: &XConfiguration,
) -> Option<f64> {
    let topology = level.topology();
    let slices = topology.ring(VertexId(meeting.center));
    let places: Option<Vec<Location>> = slices
        .flat_map(|h| AROUND.map(|[s, t]| on_halfedge(topology, table, h, [s * NEAR, t * NEAR])))
        .collect();
    let normals = surface.eval_batch(&places?, Derivatives::First).normal;
    if normals.contains(&Vec3::ZERO) {
        return None;
    }
    let mean = normals.iter().fold(Vec3::ZERO, |sum, &normal| sum + normal).normalized()?;
    let angle = |normal: &Vec3| mean.cross(*normal).length().atan2(mean.dot(*normal));
    Some(normals.iter().map(angle).fold(0.0, f64::max).to_degrees())
}
