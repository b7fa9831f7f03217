//! What the children of a level inherit: sharpness, and which faces are hidden.

use super::level::SharpEdge;
use super::{Level, Sparse};
use crate::crease::rule::{fade, fade_chaikin};
use crate::curve_network::rule::Slice;
use crate::mesh::{FaceId, HalfedgeId, Topology, VertexId};

/// The sharpness that the edge of `h` passes on to its half at the end `v`.
pub(super) fn half_sharpness(level: &Level, v: VertexId, h: HalfedgeId) -> f64 {
    let s = level.edge_sharpness(h);
    if !level.is_chaikin() || s.is_infinite() || s == 0.0 {
        return fade(s);
    }
    let topology = &level.topology;
    let (mut sum, mut others) = (0.0, 0);
    // Boundary edges are infinite, so the outgoing halfedges see every edge that matters.
    for other in topology.ring(v).filter(|&other| topology.edge(other) != topology.edge(h)) {
        let s = level.edge_sharpness(other);
        if s > 0.0 && s.is_finite() {
            sum += s;
            others += 1;
        }
    }
    fade_chaikin(s, sum, others)
}

impl Level {
    /// The level whose topology is this one's, split once.
    pub(crate) fn child(&self, topology: Topology) -> Level {
        let mut edges = Vec::with_capacity(2 * self.sharp_edges.iter().len());
        for (_, edge) in self.sharp_edges.iter() {
            let h = edge.halfedge;
            let halves = [
                (self.topology.origin(h), HalfedgeId(4 * h.0)),
                (self.topology.target(h), HalfedgeId(4 * self.topology.next(h).0 + 3)),
            ];
            for (end, halfedge) in halves {
                let sharpness = half_sharpness(self, end, h);
                if sharpness > 0.0 {
                    edges.push((topology.edge(halfedge).0, SharpEdge { halfedge, sharpness }));
                }
            }
        }
        let vertices = self.vertex_sharpness.iter().map(|(v, s)| (v, fade(s))).filter(|&(_, s)| s > 0.0);
        let vertices = Sparse::new(vertices.collect());
        let hidden =
            self.hidden_faces().iter().flat_map(|&f| self.topology.halfedges(f)).map(|h| FaceId(h.0));
        let slices = self.slices().map(|(_, slice)| {
            let h = slice.halfedge.0;
            (h, Slice { halfedge: HalfedgeId(4 * h), ..slice })
        });
        let slices = Sparse::new(slices.collect());
        Level::with_sharpness(topology, self.scheme, Sparse::new(edges), vertices, hidden.collect())
            .with_slices(slices)
    }
}
