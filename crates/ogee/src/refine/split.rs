//! The one-to-four split, by index arithmetic alone.
//!
//! With the counts `V, E, F, H` of a level its child has
//!
//! ```text
//! vertices   [0, V) vertex points | [V, V + F) face points | [V + F, V + F + E) edge points
//! edges      [0, 2E) halves of old edges | [2E, 2E + H) from edge point to face point
//! faces      the quad at the corner of halfedge h is face h
//! halfedges  4h .. 4h + 4 are the sides of quad h:
//!
//!     p <----- 4h+2 ----- f            o = origin(h)             4h   : o -> e
//!     |                   ^            e = edge point of h       4h+1 : e -> f
//!    4h+3     quad h     4h+1          f = face point            4h+2 : f -> p
//!     v                   |            p = edge point of prev h  4h+3 : p -> o
//!     o ------- 4h -----> e
//! ```
//!
//! after Dupuy and Vanhoey (2021). Two steps on, the only vertex of a quad that can be extraordinary is its
//! corner 0.

use crate::math::par;
use crate::mesh::connectivity::Connectivity;
use crate::mesh::topology::{Layout, NONE};
use crate::mesh::{EdgeId, FaceId, HalfedgeId, Topology, VertexId};

/// The corners of quad `h` of the next level, in its order `o, e, f, p`.
#[inline]
pub(crate) fn child_quad(parent: &impl Connectivity, h: HalfedgeId) -> [u32; 4] {
    [0, 1, 2, 3].map(|k| child_origin(parent, h, k))
}

/// Corner `k` of quad `h` of the next level.
#[inline(always)]
pub(super) fn child_origin(parent: &impl Connectivity, h: HalfedgeId, k: u32) -> u32 {
    let vertices = parent.vertex_count() as u32;
    let edge_points = vertices + parent.face_count() as u32;
    match k {
        0 => parent.origin(h).0,
        1 => edge_points + parent.edge(h).0,
        2 => vertices + parent.face(h).0,
        _ => edge_points + parent.edge(parent.prev(h)).0,
    }
}

/// The twin of halfedge `4h + k` of the next level.
#[inline(always)]
pub(super) fn child_twin(parent: &impl Connectivity, h: HalfedgeId, k: u32) -> u32 {
    match k {
        0 => parent.twin(h).map_or(NONE, |twin| 4 * parent.next(twin).0 + 3),
        1 => 4 * parent.next(h).0 + 2,
        2 => 4 * parent.prev(h).0 + 1,
        _ => parent.twin(parent.prev(h)).map_or(NONE, |twin| 4 * twin.0),
    }
}

/// The edge of halfedge `4h + k` of the next level. The half at the origin of the smaller halfedge is `2e`, the other
/// `2e + 1`.
#[inline(always)]
pub(super) fn child_edge(parent: &impl Connectivity, h: HalfedgeId, k: u32) -> u32 {
    let inner = 2 * parent.edge_count() as u32;
    let prev = parent.prev(h);
    let is_larger = |h: HalfedgeId| u32::from(parent.twin(h).is_some_and(|twin| twin < h));
    match k {
        0 => 2 * parent.edge(h).0 + is_larger(h),
        1 => inner + h.0,
        2 => inner + prev.0,
        _ => 2 * parent.edge(prev).0 + 1 - is_larger(prev),
    }
}

/// The smaller halfedge of an edge of the next level.
#[inline]
pub(super) fn child_side(parent: &impl Connectivity, e: u32) -> u32 {
    let halves = 2 * parent.edge_count() as u32;
    if e >= halves {
        let h = HalfedgeId(e - halves);
        return (4 * h.0 + 1).min(4 * parent.next(h).0 + 2);
    }
    let h = parent.side(EdgeId(e / 2));
    let twin = parent.twin(h);
    if e.is_multiple_of(2) {
        twin.map_or(4 * h.0, |twin| (4 * h.0).min(4 * parent.next(twin).0 + 3))
    } else {
        let far = 4 * parent.next(h).0 + 3;
        twin.map_or(far, |twin| far.min(4 * twin.0))
    }
}

/// A halfedge that leaves a vertex of the next level, on a boundary the one without twin.
#[inline]
pub(super) fn child_outgoing(parent: &impl Connectivity, v: u32) -> u32 {
    let (vertices, faces) = (parent.vertex_count() as u32, parent.face_count() as u32);
    if v < vertices {
        parent.outgoing(VertexId(v)).map_or(NONE, |h| 4 * h.0)
    } else if v < vertices + faces {
        4 * parent.first(FaceId(v - vertices)).0 + 2
    } else {
        // Where the edge is a boundary this halfedge has no twin either.
        4 * parent.next(parent.side(EdgeId(v - vertices - faces))).0 + 3
    }
}

impl Topology {
    /// The topology one step on. The caller has made sure that `4H` fits.
    pub(crate) fn split(&self) -> Topology {
        match self.as_quads() {
            Some(quads) => split(&quads, self.lenses.clone()),
            None => split(self, self.lenses.clone()),
        }
    }
}

fn split(parent: &impl Connectivity, lenses: Vec<u32>) -> Topology {
    let (vertices, edges) = (parent.vertex_count(), parent.edge_count());
    let (faces, halfedges) = (parent.face_count(), parent.halfedge_count());
    let half = |h: usize| HalfedgeId(h as u32);
    Topology {
        origin: par::collect(halfedges, |h| child_quad(parent, half(h))).into_flattened(),
        twin: par::collect(halfedges, |h| [0, 1, 2, 3].map(|k| child_twin(parent, half(h), k)))
            .into_flattened(),
        edge: par::collect(halfedges, |h| [0, 1, 2, 3].map(|k| child_edge(parent, half(h), k)))
            .into_flattened(),
        first_side: par::collect(2 * edges + halfedges, |e| child_side(parent, e as u32)),
        outgoing: par::collect(vertices + faces + edges, |v| child_outgoing(parent, v as u32)),
        lenses,
        layout: Layout::Quads,
    }
}
