//! `Connectivity`: who meets whom, whatever the layout.

use super::cycles::{FaceCycles, QuadCycles};
use super::topology::{Layout, NONE};
use super::{EdgeId, FaceId, HalfedgeId, Topology, VertexId};

/// What refinement asks of a mesh of halfedges. [`Topology`] asks its layout at every step; [`Quads`] knows that there
/// are four halfedges a face, which the inner loops are compiled for a second time.
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

    /// The halfedges that leave a vertex, counter-clockwise, one per face, as [`Topology::ring`] has them.
    #[inline]
    fn ring(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> {
        let first = self.outgoing(v);
        std::iter::successors(first, move |&h| self.twin(self.prev(h)).filter(|&next| Some(next) != first))
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

/// A topology of quads.
#[derive(Clone, Copy)]
pub(crate) struct Quads<'a> {
    origin: &'a [u32],
    twin: &'a [u32],
    edge: &'a [u32],
    first_side: &'a [u32],
    outgoing: &'a [u32],
}

impl Topology {
    /// This topology, if all faces are quads.
    pub(crate) fn as_quads(&self) -> Option<Quads<'_>> {
        match self.layout {
            Layout::Polygons { .. } => None,
            Layout::Quads => Some(Quads {
                origin: &self.origin,
                twin: &self.twin,
                edge: &self.edge,
                first_side: &self.first_side,
                outgoing: &self.outgoing,
            }),
        }
    }
}

impl Connectivity for Quads<'_> {
    #[inline]
    fn vertex_count(&self) -> usize {
        self.outgoing.len()
    }
    #[inline]
    fn edge_count(&self) -> usize {
        self.first_side.len()
    }
    #[inline]
    fn face_count(&self) -> usize {
        self.origin.len() / 4
    }
    #[inline]
    fn halfedge_count(&self) -> usize {
        self.origin.len()
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
        HalfedgeId(QuadCycles.next(h.0))
    }
    #[inline]
    fn prev(&self, h: HalfedgeId) -> HalfedgeId {
        HalfedgeId(QuadCycles.prev(h.0))
    }
    #[inline]
    fn face(&self, h: HalfedgeId) -> FaceId {
        FaceId(h.0 / 4)
    }
    #[inline]
    fn origin(&self, h: HalfedgeId) -> VertexId {
        VertexId(self.origin[h.index()])
    }
    #[inline]
    fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        let twin = self.twin[h.index()];
        (twin != NONE).then_some(HalfedgeId(twin))
    }
    #[inline]
    fn edge(&self, h: HalfedgeId) -> EdgeId {
        EdgeId(self.edge[h.index()])
    }
    #[inline]
    fn side(&self, e: EdgeId) -> HalfedgeId {
        HalfedgeId(self.first_side[e.index()])
    }
    #[inline]
    fn outgoing(&self, v: VertexId) -> Option<HalfedgeId> {
        let h = self.outgoing[v.index()];
        (h != NONE).then_some(HalfedgeId(h))
    }
}
