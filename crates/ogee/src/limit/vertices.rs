//! Limit position and normal of every vertex of a level.

use crate::curve_network::rule::Slice;
use crate::math::{Vec3, par};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::patch::dart::Dart;
use crate::patch::lens::Lens;
use crate::patch::masks::{self, Frame};
use crate::patch::{Kind, Neighbourhood, with_ring};
use crate::rules::Level;

/// Where a vertex ends up, and which way the surface faces there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitVertex {
    /// The limit position.
    pub position: Vec3,
    /// The unit normal; on a crease or at a corner the mean of the sides. `None` where the surface is singular, at a vertex of
    /// valence 2 without a tangent plane (sharp itself, or of an unusual shape with a crease that ends there), or at an
    /// isolated vertex.
    pub normal: Option<Vec3>,
}

/// Steps after which a neighbourhood has converged: the slowest mode shrinks by less than 0.66 a step.
const CONVERGED: u32 = 90;

/// The limit of every vertex.
///
/// Where the masks hold at once (quads, no finite sharpness) they are used; elsewhere the vertex's neighbourhood is
/// refined until they do, or, at a tagged vertex inside a smooth region, until it has converged. Costs
/// a few dozen nanoseconds a regular vertex, some microseconds the others.
///
/// # Panics
/// If there are fewer points than vertices.
pub fn limit_vertices(level: &Level, points: &[Vec3]) -> Vec<LimitVertex> {
    par::collect(level.topology().vertex_count(), |v| limit_vertex(level, points, VertexId(v as u32)))
}

/// The limit of one vertex.
pub(crate) fn limit_vertex(level: &Level, points: &[Vec3], v: VertexId) -> LimitVertex {
    if let Some(limit) = regular(level, points, v) {
        return limit;
    }
    if level.topology().outgoing(v).is_none() {
        return LimitVertex { position: points[v.index()], normal: None };
    }
    if level.has_slices()
        && let Some(slice) = level.topology().ring(v).find_map(|h| level.slice(level.topology().face(h)))
        && level.topology().origin(slice.halfedge) == v
    {
        return at_meeting(level, points, slice);
    }
    if masks_hold(level, v) {
        return by_masks(level, points, v);
    }
    let mut taken = around(level, points, v);
    for _ in 0..CONVERGED {
        let (level, points, v) = &taken;
        if masks_hold(level, *v) {
            return by_masks(level, points, *v);
        }
        let (finer, finer_points) = level.refine_points(points);
        taken = around(&finer, &finer_points, *v);
    }
    let (level, points, v) = &taken;
    let normal = level.topology().ring(*v).fold(Vec3::ZERO, |sum, h| {
        let at = |v: VertexId| points[v.index()] - points[taken.2.index()];
        let (edge, next) =
            (at(level.topology().target(h)), at(level.topology().origin(level.topology().prev(h))));
        sum + edge.cross(next).normalized().unwrap_or(Vec3::ZERO)
    });
    LimitVertex { position: points[v.index()], normal: normal.normalized() }
}

/// The common case, without lists: four quads around a vertex, and no tags anywhere.
fn regular(level: &Level, points: &[Vec3], v: VertexId) -> Option<LimitVertex> {
    let topology = level.topology();
    if level.has_tags() || !topology.is_quads() {
        return None;
    }
    let mut ring = topology.ring(v);
    let four = [ring.next()?, ring.next()?, ring.next()?, ring.next()?];
    if ring.next().is_some() || topology.is_boundary(v) {
        return None;
    }
    let edges = four.map(|h| points[topology.target(h).index()]);
    let diagonals = four.map(|h| points[topology.target(topology.next(h)).index()]);
    let frame = masks::regular(points[v.index()], edges, diagonals);
    let normal = frame.tangents[0].cross(frame.tangents[1]).normalized();
    Some(LimitVertex { position: frame.position, normal })
}

/// Where curves meet: the vertex itself, and the mean of the normals of the faces around it.
fn at_meeting(level: &Level, points: &[Vec3], slice: Slice) -> LimitVertex {
    let topology = level.topology();
    let v = topology.origin(slice.halfedge);
    let position = points[v.index()];
    let halfedges: Vec<HalfedgeId> = topology.ring(v).collect();
    let port_first = level.slice(topology.face(halfedges[0])).is_some_and(|slice| slice.port_first);
    let mut ring = Vec::with_capacity(2 * halfedges.len());
    for &h in &halfedges {
        ring.extend(
            [topology.target(h), topology.target(topology.next(h))].map(|v| points[v.index()] - position),
        );
    }
    let kind = Kind::Meeting { ports: halfedges.len() as u32 / 2, port_first, t: slice.t.to_bits() };
    let normal = kind.meeting_tangents(&ring).fold(Vec3::ZERO, |sum, [first, second]| {
        sum + first.cross(second).normalized().unwrap_or(Vec3::ZERO)
    });
    LimitVertex { position, normal: normal.normalized() }
}

/// The vertex with two rings of faces: creases look that far.
fn around(level: &Level, points: &[Vec3], v: VertexId) -> (Level, Vec<Vec3>, VertexId) {
    let faces: Vec<FaceId> = level.topology().ring(v).map(|h| level.topology().face(h)).collect();
    let part = Neighbourhood::new(level, &with_ring(level, &faces));
    let own = part.own(v).unwrap_or(VertexId(0));
    let points = part.take(points);
    (part.level, points, own)
}

pub(super) fn masks_hold(level: &Level, v: VertexId) -> bool {
    let topology = level.topology();
    let settled = |s: f64| s == 0.0 || s.is_infinite();
    if !settled(level.vertex_sharpness(v))
        || topology.ring(v).any(|h| level.slice(topology.face(h)).is_some())
    {
        return false;
    }
    let mut sharp = usize::from(topology.is_boundary(v));
    for h in topology.ring(v) {
        let s = level.edge_sharpness(h);
        if topology.face_size(topology.face(h)) != 4 || !settled(s) {
            return false;
        }
        sharp += usize::from(s > 0.0);
    }
    // A cone has no mask, and with some shapes a crease that ends at a lens has no plane.
    let has_plane =
        || sharp == 0 || !topology.is_lens(v) || Lens::new(level.scheme().lens, Some(0)).tangents.is_some();
    sharp > 1 || level.vertex_sharpness(v) == 0.0 && has_plane()
}

/// The points around a vertex, by the halfedges that leave it.
pub(super) trait Around {
    /// At the vertex itself.
    fn own(&self) -> Vec3;
    /// At the other end of the edge.
    fn neighbour(&self, h: HalfedgeId) -> Vec3;
    /// At the opposite corner of the quad on the left.
    fn diagonal(&self, h: HalfedgeId) -> Vec3;
    /// At the end of the quad's other edge.
    fn next_neighbour(&self, h: HalfedgeId) -> Vec3;
}

struct OnLevel<'a>(&'a Level, &'a [Vec3], VertexId);

impl OnLevel<'_> {
    fn at(&self, v: VertexId) -> Vec3 {
        self.1[v.index()]
    }
}

impl Around for OnLevel<'_> {
    fn own(&self) -> Vec3 {
        self.at(self.2)
    }
    fn neighbour(&self, h: HalfedgeId) -> Vec3 {
        self.at(self.0.topology().target(h))
    }
    fn diagonal(&self, h: HalfedgeId) -> Vec3 {
        self.at(self.0.topology().target(self.0.topology().next(h)))
    }
    fn next_neighbour(&self, h: HalfedgeId) -> Vec3 {
        self.at(self.0.topology().origin(self.0.topology().prev(h)))
    }
}

fn by_masks(level: &Level, points: &[Vec3], v: VertexId) -> LimitVertex {
    masks_of(level, v, &OnLevel(level, points, v))
}

/// The limit of a vertex whose masks hold, from the points around it; `level` says what kind of vertex it is.
pub(super) fn masks_of(level: &Level, v: VertexId, around: &impl Around) -> LimitVertex {
    let topology = level.topology();
    let own = around.own();
    let sectors = level.sectors(v);
    let is_corner =
        level.vertex_sharpness(v) > 0.0 || sectors.len() + usize::from(topology.is_boundary(v)) > 2;
    let is_dart = !is_corner && sectors.len() == 1 && !topology.is_boundary(v);
    let mut position = own;
    let mut normal = Vec3::ZERO;
    for sector in sectors {
        let halfedges: Vec<HalfedgeId> = level.sector_halfedges(sector).collect();
        let mut edges: Vec<Vec3> = halfedges.iter().map(|&h| around.neighbour(h)).collect();
        let diagonals: Vec<Vec3> = halfedges.iter().map(|&h| around.diagonal(h)).collect();
        let frame: Frame = if (sector.closed || is_dart) && topology.is_lens(v) {
            Lens::new(level.scheme().lens, (!sector.closed).then_some(0)).frame(own, &edges, &diagonals)
        } else if sector.closed {
            masks::smooth(own, &edges, &diagonals)
        } else if is_dart {
            Dart::new(edges.len()).frame(own, &edges, &diagonals)
        } else {
            edges.extend(halfedges.last().map(|&h| around.next_neighbour(h)));
            if is_corner { masks::corner(own, &edges) } else { masks::crease(own, &edges, &diagonals) }
        };
        position = frame.position;
        let side = frame.tangents[0].cross(frame.tangents[1]).normalized().unwrap_or(Vec3::ZERO);
        // The two sharp edges of a reflex corner span the plane the wrong way round.
        let is_reflex = is_corner && side.dot(newell(own, &edges)) < 0.0;
        normal += if is_reflex { -side } else { side };
    }
    LimitVertex { position, normal: normal.normalized() }
}

/// Twice the area vector of the fan of edges: roughly where the faces look.
fn newell(vertex: Vec3, edges: &[Vec3]) -> Vec3 {
    let around =
        edges.iter().zip(edges.iter().cycle().skip(1)).take(if edges.len() > 2 { edges.len() } else { 1 });
    around.fold(Vec3::ZERO, |sum, (&a, &b)| sum + (a - vertex).cross(b - vertex))
}
