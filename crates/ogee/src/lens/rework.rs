//! A cage on its way through refinement, re-meshing and caps, and what is remembered of where its parts came from.

use std::collections::BTreeSet;

use super::cap::{Cap, CapVertex};
use super::origins::Origins;
use super::piece::Piece;
use super::remesh::Remeshed;
use crate::mesh::{
    ControlMesh, Crease, FaceId, FaceList, FaceVarying, HalfedgeId, Meeting, Topology, VertexId,
};
use crate::nurbs::FaceAddress;
use crate::rules::Level;

/// A cage, and its history.
#[derive(Clone, Debug)]
pub(super) struct Rework {
    pub(super) mesh: ControlMesh,
    /// For each face the piece of the first cage that it is, or stands for.
    pub(super) addresses: Vec<FaceAddress>,
    /// For each face the piece of the first cage that it is exactly; faces that re-meshing made are none.
    pub(super) pieces: Vec<Option<Piece>>,
    /// In terms of `mesh`.
    pub(super) caps: Vec<Cap>,
    /// Edges of the first cage, as far as they are left: each a path of edges of `mesh`.
    pub(super) edges: Vec<Vec<[u32; 2]>>,
    /// For each vertex that of the first cage that it is, if it is one.
    pub(super) vertices: Vec<Option<u32>>,
    pub(super) origins: Origins,
    /// Refinements so far.
    pub(super) steps: u32,
}

impl Rework {
    /// A cage as it is; `edges` are to be followed.
    pub(super) fn new(mesh: &ControlMesh, edges: &[[u32; 2]]) -> Rework {
        let faces = (0..mesh.faces.len() as u32).map(FaceId);
        Rework {
            addresses: faces.clone().map(FaceAddress::whole).collect(),
            pieces: faces.map(|face| Some(Piece::whole(face))).collect(),
            caps: Vec::new(),
            edges: edges.iter().map(|&edge| vec![edge]).collect(),
            vertices: (0..mesh.points.len() as u32).map(Some).collect(),
            origins: Origins::new(mesh.points.len()),
            steps: 0,
            mesh: mesh.clone(),
        }
    }

    /// One refinement; `level` is that of the cage.
    pub(super) fn refine(&mut self, level: &Level) {
        let topology = level.topology();
        let first_edge_point = (topology.vertex_count() + topology.face_count()) as u32;
        let middle = |a: u32, b: u32| {
            find_halfedge(topology, a, b).map_or(a, |h| first_edge_point + topology.edge(h).0)
        };
        for cap in &mut self.caps {
            cap.split_cage_edges(|a, b| VertexId(middle(a.0, b.0)));
        }
        let halved = |[a, b]: [u32; 2]| [[a, middle(a, b)], [middle(a, b), b]];
        for path in &mut self.edges {
            *path = path.iter().copied().flat_map(halved).collect();
        }
        let port = |meeting: &Meeting, port: u32| middle(meeting.vertex, port);
        let meetings = self.mesh.meetings.iter().map(|meeting| Meeting {
            ports: meeting.ports.iter().map(|&end| port(meeting, end)).collect(),
            ..*meeting
        });
        let meetings = meetings.collect();
        let addresses = (0..topology.halfedge_count() as u32).map(HalfedgeId).map(|h| {
            let face = topology.face(h);
            let whole = self.addresses[face.index()];
            whole.quarter(h.0 - topology.first(face).0)
        });
        self.addresses = addresses.collect();
        let pieces = (0..topology.halfedge_count() as u32).map(HalfedgeId).map(|h| {
            let face = topology.face(h);
            let corner = h.0 - topology.first(face).0;
            Some(self.pieces[face.index()]?.child(corner, topology.face_size(face)))
        });
        self.pieces = pieces.collect();
        let uv = self.mesh.uv.as_ref().map(|uv| {
            let (values_level, values) = level.face_varying(uv);
            let (values_level, values) = values_level.refine_points(&values);
            FaceVarying { values, indices: values_level.topology().origin.to_vec(), rule: uv.rule }
        });
        let (child, points) = level.refine_points(&self.mesh.points);
        self.vertices.resize(points.len(), None);
        self.origins = self.origins.refined(topology);
        self.mesh = ControlMesh { meetings, uv, ..child.to_cage(points) };
        self.steps += 1;
    }

    /// Takes faces out and puts caps in their place. Faces in `support`, between the cap and the rest, stay as holes: what
    /// lies outside them is decided by their corners too.
    pub(super) fn cut(&mut self, inside: &[FaceId], support: &[FaceId], caps: Vec<Cap>) {
        let mut gone = vec![false; self.mesh.faces.len()];
        inside.iter().for_each(|face| gone[face.index()] = true);
        let mut number = Vec::with_capacity(gone.len());
        let mut faces = FaceList::with_capacity(gone.len(), self.mesh.faces.corners().len());
        let mut uv_indices = Vec::new();
        let mut addresses = Vec::with_capacity(gone.len());
        let mut pieces = Vec::with_capacity(gone.len());
        let mut corner = 0;
        for (face, vertices) in self.mesh.faces.iter().enumerate() {
            let corners = corner..corner + vertices.len();
            corner = corners.end;
            number.push(faces.len() as u32);
            if !gone[face] {
                faces.push(vertices);
                addresses.push(self.addresses[face]);
                pieces.push(self.pieces[face]);
                if let Some(uv) = &self.mesh.uv {
                    uv_indices.extend_from_slice(&uv.indices[corners]);
                }
            }
        }
        let support = support.iter().map(|face| face.0);
        let holes = self.mesh.holes.iter().copied().chain(support).filter(|&face| !gone[face as usize]);
        self.mesh.holes = holes.map(|face| number[face as usize]).collect();
        self.mesh.faces = faces;
        self.addresses = addresses;
        self.pieces = pieces;
        if let Some(uv) = &mut self.mesh.uv {
            uv.indices = uv_indices;
        }
        let mut used = vec![false; self.mesh.points.len()];
        self.mesh.faces.corners().iter().for_each(|&v| used[v as usize] = true);
        self.mesh.corners.retain(|tag| used[tag.vertex as usize]);
        self.drop_lost_creases();
        self.caps.extend(caps);
    }

    /// Creases without sharpness may stand on edges that are gone.
    fn drop_lost_creases(&mut self) {
        if self.mesh.creases.is_empty() {
            return;
        }
        let edge = |a: u32, b: u32| [a.min(b), a.max(b)];
        let mut edges = BTreeSet::new();
        for face in self.mesh.faces.iter() {
            edges.extend((0..face.len()).map(|k| edge(face[k], face[(k + 1) % face.len()])));
        }
        self.mesh.creases.retain(|&Crease { vertices: [a, b], .. }| edges.contains(&edge(a, b)));
    }

    /// Takes over a cage that some lenses were taken from.
    pub(super) fn adopt(&mut self, remeshed: Remeshed) {
        let number = |v: u32| remeshed.vertices[v as usize].map(|v| v.0);
        self.caps.iter_mut().for_each(|cap| {
            // Vertices beside a cap stay.
            cap.renumber(|v| number(v.0).map_or(v, VertexId));
        });
        for path in &mut self.edges {
            let moved = path.iter().filter_map(|&[a, b]| Some([number(a)?, number(b)?]));
            *path = moved.filter(|[a, b]| a != b).collect();
        }
        let mut vertices = vec![None; remeshed.mesh.points.len()];
        for (old, new) in remeshed.vertices.iter().enumerate().rev() {
            if let Some(new) = new {
                vertices[new.index()] = self.vertices[old];
            }
        }
        let mut addresses = vec![None; remeshed.mesh.faces.len()];
        let mut pieces = vec![None; remeshed.mesh.faces.len()];
        for (old, new) in remeshed.faces.iter().enumerate().rev() {
            if let Some(new) = new {
                addresses[new.index()] = Some(self.addresses[old]);
                pieces[new.index()] = self.pieces[old];
            }
        }
        let own = |(face, address): (usize, Option<FaceAddress>)| {
            address.unwrap_or(FaceAddress::whole(FaceId(face as u32)))
        };
        self.addresses = addresses.into_iter().enumerate().map(own).collect();
        self.pieces = pieces;
        self.origins = self.origins.renumbered(vertices.len(), &remeshed.vertices);
        self.vertices = vertices;
        self.mesh = remeshed.mesh;
    }
}

/// The halfedge between two vertices, in either direction.
fn find_halfedge(topology: &Topology, a: u32, b: u32) -> Option<HalfedgeId> {
    let leaves =
        |from: u32, to: u32| topology.ring(VertexId(from)).find(|&h| topology.target(h) == VertexId(to));
    leaves(a, b).or_else(|| leaves(b, a))
}

impl Cap {
    /// The same cap on the refined cage: edges of the cage fall into two at the vertex that `middle` tells.
    fn split_cage_edges(&mut self, middle: impl Fn(VertexId, VertexId) -> VertexId) {
        for face in &mut self.faces {
            face.boundary = std::mem::take(&mut face.boundary)
                .into_iter()
                .flat_map(|edge| match (edge.from, edge.to) {
                    (CapVertex::Cage(a), CapVertex::Cage(b)) => {
                        let halfway = CapVertex::Cage(middle(a, b));
                        let at = (edge.range[0] + edge.range[1]) / 2.0;
                        let mut halves = [edge; 2];
                        (halves[0].to, halves[0].range[1]) = (halfway, at);
                        (halves[1].from, halves[1].range[0]) = (halfway, at);
                        halves.to_vec()
                    }
                    _ => vec![edge],
                })
                .collect();
        }
    }

    /// The vertices of the cage along it, some of them more than once.
    pub(super) fn cage_vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        let edges = self.faces.iter().flat_map(|face| &face.boundary);
        edges.flat_map(|edge| [edge.from, edge.to]).filter_map(|end| match end {
            CapVertex::Cage(v) => Some(v),
            CapVertex::Own(_) => None,
        })
    }

    /// The same cap with other numbers for the vertices of the cage.
    pub(super) fn renumber(&mut self, number: impl Fn(VertexId) -> VertexId) {
        for edge in self.faces.iter_mut().flat_map(|face| &mut face.boundary) {
            for end in [&mut edge.from, &mut edge.to] {
                if let CapVertex::Cage(v) = end {
                    *end = CapVertex::Cage(number(*v));
                }
            }
        }
    }
}
