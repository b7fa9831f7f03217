//! What vertices of a cage that was refined and re-meshed were in the first one, so that messages speak of the cage that was given.

use crate::mesh::{FaceId, Topology, VertexId};

/// Where the vertices of a cage come from.
#[derive(Clone, Debug)]
pub(crate) struct Origins {
    /// For each vertex two of the first cage between which it lies: the ends of the edge that it lies on, or the same one twice.
    between: Vec<[u32; 2]>,
}

impl Origins {
    /// Those of the first cage itself.
    pub(super) fn new(vertices: usize) -> Origins {
        Origins { between: (0..vertices as u32).map(|v| [v, v]).collect() }
    }

    /// Those of the next refinement: vertex points, face points, edge points.
    pub(crate) fn refined(&self, topology: &Topology) -> Origins {
        let mut between = self.between.clone();
        between.extend((0..topology.face_count() as u32).map(FaceId).map(|face| {
            let corner = topology.origin(topology.first(face));
            [self.nearest(corner).0; 2]
        }));
        between.extend(topology.edge_halfedges().map(|h| {
            let (a, b) = (topology.origin(h), topology.target(h));
            self.edge(a, b).unwrap_or([self.nearest(a); 2]).map(|v| v.0)
        }));
        Origins { between }
    }

    /// Those of a cage that some vertices have left; of two that became one the first counts.
    pub(super) fn renumbered(&self, count: usize, number: &[Option<VertexId>]) -> Origins {
        let mut between = vec![[0; 2]; count];
        for (old, new) in number.iter().enumerate().rev() {
            if let Some(new) = new {
                between[new.index()] = self.between[old];
            }
        }
        Origins { between }
    }

    /// The vertex of the first cage that a vertex is, or one that it is near to.
    pub(crate) fn nearest(&self, v: VertexId) -> VertexId {
        VertexId(self.between[v.index()][0])
    }

    /// The edge of the first cage that an edge is a part of; `None` if it is none's. Edges that cross a face of the first cage may
    /// be taken for one beside them.
    pub(crate) fn edge(&self, a: VertexId, b: VertexId) -> Option<[VertexId; 2]> {
        let mut ends = [self.between[a.index()], self.between[b.index()]].concat();
        ends.sort_unstable();
        ends.dedup();
        match ends[..] {
            [first, second] => Some([VertexId(first), VertexId(second)]),
            _ => None,
        }
    }
}
