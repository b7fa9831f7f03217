//! `Incidence`: which edges of which curves end at a vertex, and what that makes of the vertex.

use super::network::{Crossing, CurveNetwork};
use crate::mesh::{EdgeId, HalfedgeId, Topology, Valence, VertexId};
use std::collections::BTreeMap;

/// An edge of a curve, seen from one of its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TaggedEdge {
    /// Which curve.
    pub(super) curve: usize,
    /// The number of the vertex in the curve.
    pub(super) position: usize,
    /// Whether the edge leads to the next vertex of the curve or to the previous one.
    pub(super) forward: bool,
    /// The vertex at its other end.
    pub(super) to: VertexId,
    /// True if it lies on the border.
    pub(super) border: bool,
}

/// The edges of curves at each vertex that has any.
#[derive(Clone, Debug, Default)]
pub(super) struct Incidence {
    pub(super) vertices: BTreeMap<VertexId, Vec<TaggedEdge>>,
}

/// What curves make of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// One curve goes through, or it lies on the border.
    Path,
    /// Curves end there, or cross.
    Meeting,
    /// Two curves cross with plain rules.
    SmoothCrossing,
}

impl Incidence {
    /// Of curves whose legs all are edges.
    pub(super) fn new(network: &CurveNetwork, topology: &Topology) -> Incidence {
        let mut incidence = Incidence::default();
        for (curve, data) in network.curves.iter().enumerate() {
            let count = data.vertices.len();
            for (leg, [from, to]) in data.legs().enumerate() {
                let (from, to) = (VertexId(from), VertexId(to));
                let border = edge_between(topology, from, to).is_some_and(|e| is_border(topology, e));
                let mut add = |at: VertexId, position: usize, forward: bool, to: VertexId| {
                    let edge = TaggedEdge { curve, position, forward, to, border };
                    incidence.vertices.entry(at).or_default().push(edge);
                };
                add(from, leg, true, to);
                add(to, (leg + 1) % count, false, from);
            }
        }
        incidence
    }

    /// The edges of curves at a vertex.
    pub(super) fn at(&self, v: VertexId) -> &[TaggedEdge] {
        self.vertices.get(&v).map_or(&[], Vec::as_slice)
    }

    /// Paths, meeting points and smooth crossings. What lies on the border is never more than a path.
    pub(super) fn role(&self, v: VertexId, topology: &Topology, crossing: Crossing) -> Role {
        let edges = self.at(v);
        if topology.is_boundary(v) {
            return Role::Path;
        }
        match (edges.len(), self.crossing_curves(v)) {
            (4, Some(_)) if crossing == Crossing::Smooth => Role::SmoothCrossing,
            (2, _) if edges[0].curve == edges[1].curve => Role::Path,
            _ => Role::Meeting,
        }
    }

    /// The two curves that go through a vertex with four tagged edges.
    pub(super) fn crossing_curves(&self, v: VertexId) -> Option<[usize; 2]> {
        let [first, rest @ ..] = self.at(v) else { return None };
        let second = rest.iter().find(|edge| edge.curve != first.curve)?;
        let edges_of = |curve: usize| self.at(v).iter().filter(|edge| edge.curve == curve).count();
        (edges_of(first.curve) == 2 && edges_of(second.curve) == 2 && rest.len() == 3)
            .then_some([first.curve, second.curve])
    }

    /// True if two curves that cross at a vertex have opposite edges each.
    pub(super) fn crosses_straight(&self, v: VertexId, topology: &Topology) -> bool {
        let curves: Vec<Option<usize>> = spokes(topology, v).map(|to| self.curve_to(v, to)).collect();
        topology.valence(v) == Valence::Interior(4) && curves[0] == curves[2] && curves[1] == curves[3]
    }

    /// True if a path needs no repair at a vertex: valence 4 and opposite edges; on the border, one inner edge.
    pub(super) fn runs_straight(&self, v: VertexId, topology: &Topology) -> bool {
        match topology.valence(v) {
            Valence::Interior(4) => {
                let tagged: Vec<bool> =
                    spokes(topology, v).map(|to| self.curve_to(v, to).is_some()).collect();
                tagged[0] == tagged[2] && tagged[1] == tagged[3]
            }
            Valence::Interior(_) => false,
            // Only curves that leave the border ask for something.
            Valence::Boundary(faces) => faces == 2 || self.at(v).iter().all(|edge| edge.border),
        }
    }

    fn curve_to(&self, v: VertexId, to: VertexId) -> Option<usize> {
        self.at(v).iter().find(|edge| edge.to == to).map(|edge| edge.curve)
    }
}

/// The neighbours of a vertex, counter-clockwise; on a border from one border edge to the other.
pub(super) fn spokes(topology: &Topology, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
    let last = topology.ring(v).last().map(|h| topology.prev(h)).filter(|&h| topology.twin(h).is_none());
    topology.ring(v).map(|h| topology.target(h)).chain(last.map(|h| topology.origin(h)))
}

/// The edge between two vertices, if there is one.
pub(super) fn edge_between(topology: &Topology, a: VertexId, b: VertexId) -> Option<EdgeId> {
    let side = |h: HalfedgeId| {
        let before = topology.prev(h);
        [(topology.target(h), h), (topology.origin(before), before)]
    };
    topology.ring(a).flat_map(side).find(|&(to, _)| to == b).map(|(_, h)| topology.edge(h))
}

/// True if an edge has one face.
pub(super) fn is_border(topology: &Topology, e: EdgeId) -> bool {
    topology.twin(topology.side(e)).is_none()
}
