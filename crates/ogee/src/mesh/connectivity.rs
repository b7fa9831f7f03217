//! `Connectivity`: who meets whom, stored or not.

use super::{EdgeId, FaceId, HalfedgeId, Topology, VertexId};

/// What refinement asks of a mesh of halfedges. [`Topology`] has it in arrays; a level one step on follows from them by
/// index arithmetic (`refine/split.rs`) and need not be stored to be asked.
pub(crate) trait Connectivity: Sync {
    fn vertex_count(&self) -> usize;
    fn edge_count(&self) -> usize;
    fn face_count(&self) -> usize;
    fn halfedge_count(&self) -> usize;
    fn face_size(&self, f: FaceId) -> u32;
    fn first(&self, f: FaceId) -> HalfedgeId;
    fn next(&self, h: HalfedgeId) -> HalfedgeId;
    fn prev(&self, h: HalfedgeId) -> HalfedgeId;
    fn face(&self, h: HalfedgeId) -> FaceId;
    fn origin(&self, h: HalfedgeId) -> VertexId;
    fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId>;
    fn edge(&self, h: HalfedgeId) -> EdgeId;
    fn side(&self, e: EdgeId) -> HalfedgeId;
    fn outgoing(&self, v: VertexId) -> Option<HalfedgeId>;

    #[inline]
    fn target(&self, h: HalfedgeId) -> VertexId {
        self.origin(self.next(h))
    }
}

impl Connectivity for Topology {
    #[inline]
    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }
    #[inline]
    fn edge_count(&self) -> usize {
        self.edge_count()
    }
    #[inline]
    fn face_count(&self) -> usize {
        self.face_count()
    }
    #[inline]
    fn halfedge_count(&self) -> usize {
        self.halfedge_count()
    }
    #[inline]
    fn face_size(&self, f: FaceId) -> u32 {
        self.face_size(f)
    }
    #[inline]
    fn first(&self, f: FaceId) -> HalfedgeId {
        self.first(f)
    }
    #[inline]
    fn next(&self, h: HalfedgeId) -> HalfedgeId {
        self.next(h)
    }
    #[inline]
    fn prev(&self, h: HalfedgeId) -> HalfedgeId {
        self.prev(h)
    }
    #[inline]
    fn face(&self, h: HalfedgeId) -> FaceId {
        self.face(h)
    }
    #[inline]
    fn origin(&self, h: HalfedgeId) -> VertexId {
        self.origin(h)
    }
    #[inline]
    fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        self.twin(h)
    }
    #[inline]
    fn edge(&self, h: HalfedgeId) -> EdgeId {
        self.edge(h)
    }
    #[inline]
    fn side(&self, e: EdgeId) -> HalfedgeId {
        self.side(e)
    }
    #[inline]
    fn outgoing(&self, v: VertexId) -> Option<HalfedgeId> {
        self.outgoing(v)
    }
}
