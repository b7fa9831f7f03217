//! `Ahead`: who meets whom one step on, read off a level without making the next one.

use super::split::{child_edge, child_origin, child_outgoing, child_side, child_twin};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::topology::NONE;
use crate::mesh::{EdgeId, FaceId, HalfedgeId, VertexId};

/// The next level's connectivity, for those who ask for little of it. Every answer is a few look-ups in the level
/// itself; the caller has made sure that `4H` fits.
pub(crate) struct Ahead<'a, C>(pub(crate) &'a C);

impl<C: Connectivity> Connectivity for Ahead<'_, C> {
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
        VertexId(child_origin(self.0, HalfedgeId(h.0 / 4), h.0 % 4))
    }
    #[inline]
    fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        let twin = child_twin(self.0, HalfedgeId(h.0 / 4), h.0 % 4);
        (twin != NONE).then_some(HalfedgeId(twin))
    }
    #[inline]
    fn edge(&self, h: HalfedgeId) -> EdgeId {
        EdgeId(child_edge(self.0, HalfedgeId(h.0 / 4), h.0 % 4))
    }
    #[inline]
    fn side(&self, e: EdgeId) -> HalfedgeId {
        HalfedgeId(child_side(self.0, e.0))
    }
    #[inline]
    fn outgoing(&self, v: VertexId) -> Option<HalfedgeId> {
        let h = child_outgoing(self.0, v.0);
        (h != NONE).then_some(HalfedgeId(h))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Topology, shapes};

    #[test]
    fn looking_ahead_is_making_the_level() {
        let mut polygons = shapes::grid(2, 1);
        polygons.faces = [[0, 1, 4], [0, 4, 3]].into_iter().collect();
        polygons.faces.push(&[1, 2, 5, 4]);
        let meshes = [shapes::cube(), shapes::grid(3, 2), shapes::studded_torus(12, 8, 4), polygons];
        for mesh in meshes {
            let level = Topology::new(&mesh).unwrap();
            let made = level.split();
            same(&Ahead(&level), &made);
            same(&Ahead(&Ahead(&level)), &made.split());
        }
    }

    fn same(ahead: &impl Connectivity, made: &Topology) {
        assert_eq!((ahead.vertex_count(), ahead.edge_count()), (made.vertex_count(), made.edge_count()));
        assert_eq!((ahead.face_count(), ahead.halfedge_count()), (made.face_count(), made.halfedge_count()));
        for h in (0..made.halfedge_count() as u32).map(HalfedgeId) {
            assert_eq!((ahead.origin(h), ahead.twin(h)), (made.origin(h), made.twin(h)));
            assert_eq!((ahead.edge(h), ahead.face(h)), (made.edge(h), made.face(h)));
            assert_eq!((ahead.next(h), ahead.prev(h)), (made.next(h), made.prev(h)));
        }
        for f in (0..made.face_count() as u32).map(FaceId) {
            assert_eq!((ahead.first(f), ahead.face_size(f)), (made.first(f), made.face_size(f)));
        }
        for e in (0..made.edge_count() as u32).map(EdgeId) {
            assert_eq!(ahead.side(e), made.side(e));
        }
        for v in (0..made.vertex_count() as u32).map(VertexId) {
            assert_eq!(ahead.outgoing(v), made.outgoing(v));
        }
    }
}
