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

/// The next level, asked but not stored.
pub(crate) struct Split<'a>(pub(crate) &'a Topology);

/// The corners of quad `h` of the next level, in its order `o, e, f, p`.
#[inline]
pub(crate) fn child_quad(parent: &impl Connectivity, h: HalfedgeId) -> [u32; 4] {
    let vertices = parent.vertex_count() as u32;
    let edge_points = vertices + parent.face_count() as u32;
    [
        parent.origin(h).0,
        edge_points + parent.edge(h).0,
        vertices + parent.face(h).0,
        edge_points + parent.edge(parent.prev(h)).0,
    ]
}

impl Split<'_> {
    /// The twin of halfedge `4h + k`.
    #[inline]
    fn child_twin(&self, h: HalfedgeId, k: u32) -> u32 {
        let parent = self.0;
        match k {
            0 => parent.twin(h).map_or(NONE, |twin| 4 * parent.next(twin).0 + 3),
            1 => 4 * parent.next(h).0 + 2,
            2 => 4 * parent.prev(h).0 + 1,
            _ => parent.twin(parent.prev(h)).map_or(NONE, |twin| 4 * twin.0),
        }
    }

    /// The edge of halfedge `4h + k`. The half at the origin of the smaller halfedge is `2e`, the other `2e + 1`.
    #[inline]
    fn child_edge(&self, h: HalfedgeId, k: u32) -> u32 {
        let parent = self.0;
        let inner = 2 * parent.edge_count() as u32;
        let prev = parent.prev(h);
        match k {
            // `NONE` is greater than all.
            0 => 2 * parent.edge(h).0 + u32::from(parent.twin[h.index()] < h.0),
            1 => inner + h.0,
            2 => inner + prev.0,
            _ => 2 * parent.edge(prev).0 + u32::from(parent.twin[prev.index()] > prev.0),
        }
    }

    /// The smaller halfedge of an edge.
    #[inline]
    fn child_side(&self, e: u32) -> u32 {
        let parent = self.0;
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

    /// A halfedge that leaves a vertex, on a boundary the one without twin.
    #[inline]
    fn child_outgoing(&self, v: u32) -> u32 {
        let parent = self.0;
        let (vertices, faces) = (parent.vertex_count() as u32, parent.face_count() as u32);
        if v < vertices {
            let h = parent.outgoing[v as usize];
            if h == NONE { NONE } else { 4 * h }
        } else if v < vertices + faces {
            4 * parent.first(FaceId(v - vertices)).0 + 2
        } else {
            // Where the edge is a boundary this halfedge has no twin either.
            4 * parent.next(parent.side(EdgeId(v - vertices - faces))).0 + 3
        }
    }
}

impl Connectivity for Split<'_> {
    #[inline]
    fn vertex_count(&self) -> usize {
        self.0.vertex_count() + self.0.face_count() + self.0.edge_count()
    }
    #[inline]
    fn edge_count(&self) -> usize {
        2 * self.0.edge_count() + self.0.halfedge_count()
    }
    #[inline]
    fn face_count(&self) -> usize {
        self.0.halfedge_count()
    }
    #[inline]
    fn halfedge_count(&self) -> usize {
        4 * self.0.halfedge_count()
    }
    #[inline]
    fn face_size(&self, _: FaceId) -> u32 {
        4
    }
    #[inline]
    fn first(&self, f: FaceId) -> HalfedgeId {
        HalfedgeId(4 * f.0)
    }
    #[inline]
    fn next(&self, h: HalfedgeId) -> HalfedgeId {
        HalfedgeId((h.0 & !3) | ((h.0 + 1) & 3))
    }
    #[inline]
    fn prev(&self, h: HalfedgeId) -> HalfedgeId {
        HalfedgeId((h.0 & !3) | (h.0.wrapping_sub(1) & 3))
    }
    #[inline]
    fn face(&self, h: HalfedgeId) -> FaceId {
        FaceId(h.0 / 4)
    }
    #[inline]
    fn origin(&self, h: HalfedgeId) -> VertexId {
        let parent = HalfedgeId(h.0 / 4);
        let vertices = self.0.vertex_count() as u32;
        let edge_points = vertices + self.0.face_count() as u32;
        VertexId(match h.0 & 3 {
            0 => self.0.origin(parent).0,
            1 => edge_points + self.0.edge(parent).0,
            2 => vertices + self.0.face(parent).0,
            _ => edge_points + self.0.edge(self.0.prev(parent)).0,
        })
    }
    #[inline]
    fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        let twin = self.child_twin(HalfedgeId(h.0 / 4), h.0 & 3);
        (twin != NONE).then_some(HalfedgeId(twin))
    }
    #[inline]
    fn edge(&self, h: HalfedgeId) -> EdgeId {
        EdgeId(self.child_edge(HalfedgeId(h.0 / 4), h.0 & 3))
    }
    #[inline]
    fn side(&self, e: EdgeId) -> HalfedgeId {
        HalfedgeId(self.child_side(e.0))
    }
    #[inline]
    fn outgoing(&self, v: VertexId) -> Option<HalfedgeId> {
        let h = self.child_outgoing(v.0);
        (h != NONE).then_some(HalfedgeId(h))
    }
}

impl Topology {
    /// The topology one step on, stored. The caller has made sure that `4H` fits.
    pub(crate) fn split(&self) -> Topology {
        let split = Split(self);
        let halfedges = self.halfedge_count();
        let of_quads = |of: &(dyn Fn(HalfedgeId) -> [u32; 4] + Sync)| -> Vec<u32> {
            par::collect(halfedges, |h| of(HalfedgeId(h as u32))).into_flattened()
        };
        Topology {
            origin: of_quads(&|h| child_quad(self, h)),
            twin: of_quads(&|h| std::array::from_fn(|k| split.child_twin(h, k as u32))),
            edge: of_quads(&|h| std::array::from_fn(|k| split.child_edge(h, k as u32))),
            first_side: par::collect(split.edge_count(), |e| split.child_side(e as u32)),
            outgoing: par::collect(split.vertex_count(), |v| split.child_outgoing(v as u32)),
            layout: Layout::Quads,
        }
    }
}
