//! `Level`: a topology with its rules; one rung of refinement.

use std::sync::Arc;

use super::classify::{classify_edges, classify_vertices, hidden_faces};
use super::{EdgeRule, Sparse, VertexMask, VertexRule};
use crate::crease::rule::fade;
use crate::curve_network::rule::Slice;
use crate::mesh::{
    Boundary, ControlMesh, Creasing, FaceId, HalfedgeId, LensShape, Meeting, Scheme, Topology, TopologyError,
    VertexId, check_tags,
};

/// An edge with sharpness above zero, by one of its halfedges.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharpEdge {
    pub(crate) halfedge: HalfedgeId,
    pub(crate) sharpness: f64,
}

/// Connectivity and the rule of each element. A level stands alone: any level can be the base of a hierarchy.
/// Points are never inside it: one level serves every pose of an animated cage.
///
/// Functions that take an id panic if it is out of range.
#[derive(Clone, Debug)]
pub struct Level {
    /// Shared: a level one step on may stand on the same connectivity, see [`Level::faded`].
    pub(super) topology: Arc<Topology>,
    pub(super) scheme: Scheme,
    /// Edges with sharpness above zero that are no boundary edges (those are always infinitely sharp).
    pub(super) sharp_edges: Sparse<SharpEdge>,
    /// Vertices with sharpness above zero.
    pub(super) vertex_sharpness: Sparse<f64>,
    /// Faces around vertices where curves meet.
    slices: Sparse<Slice>,
    /// Rules other than smooth, or crease on the boundary.
    edge_rules: Sparse<EdgeRule>,
    /// Rules other than smooth inside, and those of the scheme on the boundary; lenses are always among them.
    vertex_rules: Sparse<VertexRule>,
    /// Faces that are no part of the surface, in order.
    hidden: Vec<FaceId>,
}

impl Level {
    /// The first level of a cage: the only place where a bad mesh is refused.
    ///
    /// # Errors
    /// If the mesh has any defect; then all of them are named.
    pub fn new(mesh: &ControlMesh) -> Result<Level, TopologyError> {
        let topology = Topology::new(mesh)?;
        let tagged = !(mesh.creases.is_empty()
            && mesh.corners.is_empty()
            && mesh.holes.is_empty()
            && mesh.meetings.is_empty());
        if tagged || mesh.uv.is_some() || mesh.scheme.lens != LensShape::default() {
            let defects = check_tags(mesh, &topology);
            if !defects.is_empty() {
                return Err(TopologyError { defects });
            }
        }
        let edges = mesh.creases.iter().filter_map(|crease| {
            let halfedge = topology.find_edge(crease.vertices.map(VertexId))?;
            topology.twin(halfedge)?;
            Some((topology.edge(halfedge).0, SharpEdge { halfedge, sharpness: crease.sharpness.value() }))
        });
        let vertices = mesh.corners.iter().map(|corner| (corner.vertex, corner.sharpness.value()));
        // The last tag of an edge counts, even where it takes an earlier one back.
        let edges = Sparse::new(edges.collect()).filter(|edge: SharpEdge| edge.sharpness > 0.0);
        let vertices = Sparse::new(vertices.collect()).filter(|sharpness| sharpness > 0.0);
        let hidden = hidden_faces(&topology, mesh.scheme, &mesh.holes);
        let slices = mesh.meetings.iter().flat_map(|meeting| slices_of(&topology, meeting));
        let slices = Sparse::new(slices.collect());
        Ok(Level::with_sharpness(topology, mesh.scheme, edges, vertices, hidden).with_slices(slices))
    }

    /// A level from checked parts.
    pub(crate) fn with_sharpness(
        topology: impl Into<Arc<Topology>>,
        scheme: Scheme,
        sharp_edges: Sparse<SharpEdge>,
        vertex_sharpness: Sparse<f64>,
        hidden: Vec<FaceId>,
    ) -> Level {
        let (slices, edge_rules, vertex_rules) = (Sparse::default(), Sparse::default(), Sparse::default());
        let mut level = Level {
            topology: topology.into(),
            scheme,
            sharp_edges,
            vertex_sharpness,
            slices,
            edge_rules,
            vertex_rules,
            hidden,
        };
        level.edge_rules = classify_edges(&level);
        level.vertex_rules = classify_vertices(&level);
        level
    }

    /// The level with rules where curves meet.
    pub(crate) fn with_slices(mut self, slices: Sparse<Slice>) -> Level {
        let centre = |slice: Slice| self.topology.origin(slice.halfedge).0;
        let stay = slices.iter().map(|(_, slice)| (centre(slice), VertexRule::Of(VertexMask::Corner)));
        self.vertex_rules = Sparse::new(self.vertex_rules.iter().chain(stay).collect());
        self.slices = slices;
        self
    }

    /// The level whose rules at vertices and edges are those which `steps` of refinement leave there, over the same
    /// connectivity. Creasing is to be uniform, so that both halves of an edge have the same sharpness.
    pub(crate) fn faded(&self, steps: u32) -> Level {
        let fade = |s: f64| (0..steps).fold(s, |s, _| fade(s));
        let edges = self
            .sharp_edges
            .iter()
            .map(|(e, edge)| (e, SharpEdge { sharpness: fade(edge.sharpness), ..edge }));
        let vertices = self.vertex_sharpness.iter().map(|(v, s)| (v, fade(s)));
        Level::with_sharpness(
            self.topology.clone(),
            self.scheme,
            Sparse::new(edges.collect()).filter(|edge| edge.sharpness > 0.0),
            Sparse::new(vertices.collect()).filter(|s| s > 0.0),
            self.hidden.clone(),
        )
    }

    /// The level with other hidden faces, given in order.
    pub(crate) fn with_hidden(mut self, hidden: Vec<FaceId>) -> Level {
        self.hidden = hidden;
        self
    }

    /// True if curves meet somewhere.
    pub(crate) fn has_slices(&self) -> bool {
        !self.slices.is_empty()
    }

    /// The rule of a face at a meeting.
    pub(crate) fn slice(&self, f: FaceId) -> Option<Slice> {
        self.slices.get(f.0)
    }

    /// The faces at meetings, and their rules.
    pub(crate) fn slices(&self) -> impl Iterator<Item = (FaceId, Slice)> + '_ {
        self.slices.iter().map(|(f, slice)| (FaceId(f), slice))
    }

    /// Who meets whom.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// Choices of the scheme.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Sharpness of an edge; infinite on the boundary.
    pub fn edge_sharpness(&self, h: HalfedgeId) -> f64 {
        if self.topology.twin(h).is_none() {
            return f64::INFINITY;
        }
        self.sharp_edges.get(self.topology.edge(h).0).map_or(0.0, |edge| edge.sharpness)
    }

    /// Sharpness of a vertex; infinite at a boundary vertex with one face where the scheme says so.
    pub fn vertex_sharpness(&self, v: VertexId) -> f64 {
        if self.scheme.boundary == Boundary::EdgeAndCorner
            && self.topology.is_boundary(v)
            && self.topology.ring(v).nth(1).is_none()
        {
            return f64::INFINITY;
        }
        self.vertex_sharpness.get(v.0).unwrap_or(0.0)
    }

    /// True if an edge or vertex is sharp by a tag, or curves meet.
    pub(crate) fn has_tags(&self) -> bool {
        !self.sharp_edges.is_empty() || !self.vertex_sharpness.is_empty() || self.has_slices()
    }

    /// The edges with finite sharpness above zero, by one halfedge each.
    pub fn semi_sharp_edges(&self) -> impl Iterator<Item = (HalfedgeId, f64)> + '_ {
        self.sharp_edges
            .iter()
            .map(|(_, edge)| (edge.halfedge, edge.sharpness))
            .filter(|(_, s)| s.is_finite())
    }

    /// The vertices with finite sharpness above zero.
    pub fn semi_sharp_vertices(&self) -> impl Iterator<Item = (VertexId, f64)> + '_ {
        self.vertex_sharpness.iter().filter(|(_, s)| s.is_finite()).map(|(v, s)| (VertexId(v), s))
    }

    /// The rule of an edge, by either of its halfedges.
    pub fn edge_rule(&self, h: HalfedgeId) -> EdgeRule {
        match self.topology.twin(h) {
            None => EdgeRule::Crease,
            Some(_) => self.edge_rules.get(self.topology.edge(h).0).unwrap_or(EdgeRule::Smooth),
        }
    }

    /// The rule of a vertex.
    pub fn vertex_rule(&self, v: VertexId) -> VertexRule {
        self.vertex_rules.get(v.0).unwrap_or_else(|| VertexRule::Of(self.untagged_mask(v)))
    }

    /// The mask of a vertex that has no rule of its own: no tag touches it, and it is no lens.
    fn untagged_mask(&self, v: VertexId) -> VertexMask {
        match self.topology.outgoing(v) {
            None => VertexMask::Corner,
            Some(h) if self.topology.twin(h).is_some() => VertexMask::Smooth,
            Some(first) => {
                let last = self.topology.ring(v).last().unwrap_or(first);
                if first == last && self.scheme.boundary == Boundary::EdgeAndCorner {
                    return VertexMask::Corner;
                }
                let ends = [self.topology.target(first), self.topology.origin(self.topology.prev(last))];
                VertexMask::Crease { ends }
            }
        }
    }

    /// Rules of edges and vertices that tags touch, and of lenses, for the fast path of refinement.
    pub(crate) fn tagged_rules(&self) -> (&Sparse<EdgeRule>, &Sparse<VertexRule>) {
        (&self.edge_rules, &self.vertex_rules)
    }

    pub(crate) fn sharp_vertices(&self) -> &Sparse<f64> {
        &self.vertex_sharpness
    }

    /// Faces that take part in refinement but are no part of the surface, in order.
    pub fn hidden_faces(&self) -> &[FaceId] {
        &self.hidden
    }

    /// True if the face is part of the surface.
    pub fn is_visible(&self, f: FaceId) -> bool {
        self.hidden.binary_search(&f).is_err()
    }

    /// Chaikin's rule looks further than one edge; uniform creasing does not.
    pub(crate) fn is_chaikin(&self) -> bool {
        self.scheme.creasing == Creasing::Chaikin
    }
}

/// The faces around a meeting, and their rules.
fn slices_of(topology: &Topology, meeting: &Meeting) -> Vec<(u32, Slice)> {
    let slice = |halfedge: HalfedgeId| {
        let port_first = meeting.ports.contains(&topology.target(halfedge).0);
        (topology.face(halfedge).0, Slice { halfedge, port_first, t: meeting.t })
    };
    topology.ring(VertexId(meeting.vertex)).map(slice).collect()
}
