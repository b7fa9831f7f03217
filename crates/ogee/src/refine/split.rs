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
use crate::mesh::topology::{Layout, NONE};
use crate::mesh::{EdgeId, FaceId, HalfedgeId, Topology};

impl Topology {
    /// The corners of quad `h` of the next level, in its order `o, e, f, p`.
    #[inline]
    pub(crate) fn child_quad(&self, h: HalfedgeId) -> [u32; 4] {
        let vertices = self.vertex_count() as u32;
        let edge_points = vertices + self.face_count() as u32;
        [
            self.origin(h).0,
            edge_points + self.edge(h).0,
            vertices + self.face(h).0,
            edge_points + self.edge(self.prev(h)).0,
        ]
    }

    /// The topology one step on. The caller has made sure that `4H` fits.
    pub(crate) fn split(&self) -> Topology {
        let halfedges = self.halfedge_count();
        let origin = par::collect(halfedges, |h| self.child_quad(HalfedgeId(h as u32)));
        let twin = par::collect(halfedges, |h| {
            let h = HalfedgeId(h as u32);
            let prev = self.prev(h);
            [
                self.twin(h).map_or(NONE, |twin| 4 * self.next(twin).0 + 3),
                4 * self.next(h).0 + 2,
                4 * prev.0 + 1,
                self.twin(prev).map_or(NONE, |twin| 4 * twin.0),
            ]
        });
        let edges = self.edge_count();
        let inner = 2 * edges as u32;
        let edge = par::collect(halfedges, |h| {
            let h = HalfedgeId(h as u32);
            let prev = self.prev(h);
            // The half at the origin of the smaller halfedge is `2e`, the other `2e + 1`; `NONE` is greater than all.
            let half_at_origin = u32::from(self.twin[h.index()] < h.0);
            let half_at_target = u32::from(self.twin[prev.index()] > prev.0);
            [
                2 * self.edge(h).0 + half_at_origin,
                inner + h.0,
                inner + prev.0,
                2 * self.edge(prev).0 + half_at_target,
            ]
        });
        let first_side = par::collect(2 * edges + halfedges, |e| {
            if e >= 2 * edges {
                let h = HalfedgeId((e - 2 * edges) as u32);
                return (4 * h.0 + 1).min(4 * self.next(h).0 + 2);
            }
            let h = self.side(EdgeId(e as u32 / 2));
            let twin = self.twin(h);
            if e % 2 == 0 {
                twin.map_or(4 * h.0, |twin| (4 * h.0).min(4 * self.next(twin).0 + 3))
            } else {
                let far = 4 * self.next(h).0 + 3;
                twin.map_or(far, |twin| far.min(4 * twin.0))
            }
        });
        Topology {
            outgoing: self.split_outgoing(),
            origin: origin.into_flattened(),
            twin: twin.into_flattened(),
            edge: edge.into_flattened(),
            first_side,
            layout: Layout::Quads,
        }
    }

    fn split_outgoing(&self) -> Vec<u32> {
        let (vertices, faces) = (self.vertex_count(), self.face_count());
        par::collect(vertices + faces + self.edge_count(), |v| {
            if v < vertices {
                let h = self.outgoing[v];
                if h == NONE { NONE } else { 4 * h }
            } else if v < vertices + faces {
                4 * self.first(FaceId((v - vertices) as u32)).0 + 2
            } else {
                // Where the edge is a boundary this halfedge has no twin either.
                4 * self.next(self.side(EdgeId((v - vertices - faces) as u32))).0 + 3
            }
        })
    }
}
