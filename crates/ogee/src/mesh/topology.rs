//! `Topology`: who meets whom, as flat arrays of halfedges.
//!
//! Halfedges of a face are consecutive. Edges of a cage are numbered in the order of first meeting them while
//! walking its halfedges. A boundary has no outer halfedges: a halfedge there has no twin. Refinement follows the
//! rule of Dupuy and Vanhoey, A Halfedge Refinement Rule for Parallel Catmull-Clark Subdivision (2021); see
//! `refine/split.rs`.

use super::check::{TopologyError, check};
use super::{ControlMesh, EdgeId, FaceId, FaceList, HalfedgeId, VertexId};

/// Stored where there is no twin, no halfedge: never a valid id.
pub(crate) const NONE: u32 = u32::MAX;

/// Connectivity of an oriented manifold mesh, with or without boundary.
///
/// Functions that take an id panic if it is out of range.
#[derive(Clone, Debug)]
pub struct Topology {
    pub(crate) origin: Vec<u32>,
    pub(crate) twin: Vec<u32>,
    pub(crate) edge: Vec<u32>,
    /// For each edge its halfedge with the smaller number.
    pub(crate) first_side: Vec<u32>,
    /// For each vertex a halfedge that leaves it: on a boundary the one without twin; `NONE` if isolated.
    pub(crate) outgoing: Vec<u32>,
    /// The interior vertices of two faces, in order. A step of refinement brings no new ones.
    pub(crate) lenses: Vec<u32>,
    pub(crate) layout: Layout,
}

/// How halfedges belong to faces.
#[derive(Clone, Debug)]
pub(crate) enum Layout {
    /// Halfedges `starts[f] .. starts[f + 1]` are those of face `f`; `face[h]` the other way.
    Polygons { starts: Vec<u32>, face: Vec<u32> },
    /// Halfedges `4f .. 4f + 4` are those of face `f`.
    Quads,
}

/// How many faces meet at a vertex, and whether all the way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Valence {
    /// Faces all the way round; 0 at an isolated vertex.
    Interior(u32),
    /// So many faces between two boundary edges.
    Boundary(u32),
}

impl Valence {
    /// True for 4 faces inside, 2 on the boundary.
    pub fn is_regular(self) -> bool {
        matches!(self, Valence::Interior(4) | Valence::Boundary(2))
    }

    /// Number of faces.
    pub fn faces(self) -> u32 {
        match self {
            Valence::Interior(n) | Valence::Boundary(n) => n,
        }
    }

    /// Number of edges.
    pub fn edges(self) -> u32 {
        match self {
            Valence::Interior(n) => n,
            Valence::Boundary(n) => n + 1,
        }
    }
}

impl Topology {
    /// The connectivity of a mesh.
    ///
    /// Costs one pass over the corners and one bucket sort.
    ///
    /// # Errors
    /// If the mesh has any defect; then all of them are named.
    pub fn new(mesh: &ControlMesh) -> Result<Topology, TopologyError> {
        Topology::pair(mesh).ok_or_else(|| TopologyError { defects: check(mesh) })
    }

    /// The arrays, or nothing at the first sign of a defect.
    fn pair(mesh: &ControlMesh) -> Option<Topology> {
        let faces = &mesh.faces;
        let vertices = mesh.points.len();
        let sound = !faces.is_empty()
            && faces.corners().len() < NONE as usize
            && faces.corners().iter().all(|&v| (v as usize) < vertices)
            && faces.iter().all(has_distinct_corners)
            && mesh.points.iter().all(|p| p.is_finite());
        if !sound {
            return None;
        }
        let pairs = pair_halfedges(faces, vertices);
        if !pairs.manifold {
            return None;
        }
        let mut topology = Topology::unchecked(faces, vertices, pairs);
        topology.choose_outgoing().then_some(topology)
    }

    /// The connectivity of faces taken out of a sound mesh. On the rim a vertex may belong to several fans; its ring
    /// is then one of them.
    pub(crate) fn of_part(faces: &FaceList, vertices: usize) -> Topology {
        let mut topology = Topology::unchecked(faces, vertices, pair_halfedges(faces, vertices));
        topology.choose_outgoing();
        topology
    }

    /// The same faces over other vertices, cut along some edges.
    pub(crate) fn with_seams(
        &self,
        origin: Vec<u32>,
        vertices: usize,
        seam: impl Fn(HalfedgeId) -> bool,
    ) -> Topology {
        let twin = |h: usize| if seam(HalfedgeId(h as u32)) { NONE } else { self.twin[h] };
        let mut topology = Topology {
            origin,
            twin: (0..self.twin.len()).map(twin).collect(),
            edge: Vec::new(),
            first_side: Vec::new(),
            outgoing: vec![NONE; vertices],
            lenses: Vec::new(),
            layout: self.layout.clone(),
        };
        topology.number_edges();
        topology.choose_outgoing();
        topology
    }

    /// All arrays but `outgoing`.
    fn unchecked(faces: &FaceList, vertices: usize, pairs: Pairing) -> Topology {
        let layout = if faces.iter().all(|face| face.len() == 4) {
            Layout::Quads
        } else {
            let face =
                faces.iter().enumerate().flat_map(|(f, corners)| corners.iter().map(move |_| f as u32));
            Layout::Polygons { starts: faces.starts().to_vec(), face: face.collect() }
        };
        let mut topology = Topology {
            origin: faces.corners().to_vec(),
            twin: pairs.twin,
            edge: Vec::new(),
            first_side: Vec::new(),
            outgoing: vec![NONE; vertices],
            lenses: Vec::new(),
            layout,
        };
        topology.number_edges();
        topology
    }

    fn number_edges(&mut self) {
        let mut edge = vec![NONE; self.twin.len()];
        let mut first_side = Vec::new();
        for (h, &twin) in self.twin.iter().enumerate() {
            // A twin with a smaller number was met first; `NONE` is greater than all.
            if (twin as usize) < h {
                edge[h] = edge[twin as usize];
            } else {
                edge[h] = first_side.len() as u32;
                first_side.push(h as u32);
            }
        }
        self.edge = edge;
        self.first_side = first_side;
    }

    /// Fills `outgoing` and `lenses`; false if the faces of some vertex form more than one fan.
    fn choose_outgoing(&mut self) -> bool {
        let mut degree = vec![0u32; self.outgoing.len()];
        for (h, &v) in self.origin.iter().enumerate() {
            let v = v as usize;
            degree[v] += 1;
            if self.outgoing[v] == NONE || self.twin[h] == NONE {
                self.outgoing[v] = h as u32;
            }
        }
        let is_lens = |&v: &u32| degree[v as usize] == 2 && !self.is_boundary(VertexId(v));
        self.lenses = (0..self.outgoing.len() as u32).filter(is_lens).collect();
        (0..self.outgoing.len())
            .all(|v| self.outgoing[v] == NONE || self.ring(VertexId(v as u32)).count() == degree[v] as usize)
    }

    /// Number of vertices, isolated ones included.
    pub fn vertex_count(&self) -> usize {
        self.outgoing.len()
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.first_side.len()
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        match &self.layout {
            Layout::Polygons { starts, .. } => starts.len() - 1,
            Layout::Quads => self.origin.len() / 4,
        }
    }

    /// Number of halfedges, which is the number of face corners.
    pub fn halfedge_count(&self) -> usize {
        self.origin.len()
    }

    /// True if every face has four corners.
    pub fn is_quads(&self) -> bool {
        matches!(self.layout, Layout::Quads)
    }

    /// Number of corners of a face.
    #[inline]
    pub fn face_size(&self, f: FaceId) -> u32 {
        match &self.layout {
            Layout::Polygons { starts, .. } => starts[f.index() + 1] - starts[f.index()],
            Layout::Quads => 4,
        }
    }

    /// The halfedge that leaves the first corner of a face.
    #[inline]
    pub fn first(&self, f: FaceId) -> HalfedgeId {
        match &self.layout {
            Layout::Polygons { starts, .. } => HalfedgeId(starts[f.index()]),
            Layout::Quads => HalfedgeId(4 * f.0),
        }
    }

    /// The halfedges of a face, in order.
    #[inline]
    pub fn halfedges(&self, f: FaceId) -> impl ExactSizeIterator<Item = HalfedgeId> + use<> {
        let first = self.first(f).0;
        (first..first + self.face_size(f)).map(HalfedgeId)
    }

    /// The other side of the edge; `None` on the boundary.
    #[inline]
    pub fn twin(&self, h: HalfedgeId) -> Option<HalfedgeId> {
        let twin = self.twin[h.index()];
        (twin != NONE).then_some(HalfedgeId(twin))
    }

    /// The next halfedge of the same face.
    #[inline]
    pub fn next(&self, h: HalfedgeId) -> HalfedgeId {
        match &self.layout {
            Layout::Quads => HalfedgeId((h.0 & !3) | ((h.0 + 1) & 3)),
            Layout::Polygons { starts, face } => {
                let f = face[h.index()] as usize;
                HalfedgeId(if h.0 + 1 == starts[f + 1] { starts[f] } else { h.0 + 1 })
            }
        }
    }

    /// The previous halfedge of the same face.
    #[inline]
    pub fn prev(&self, h: HalfedgeId) -> HalfedgeId {
        match &self.layout {
            Layout::Quads => HalfedgeId((h.0 & !3) | (h.0.wrapping_sub(1) & 3)),
            Layout::Polygons { starts, face } => {
                let f = face[h.index()] as usize;
                HalfedgeId(if h.0 == starts[f] { starts[f + 1] - 1 } else { h.0 - 1 })
            }
        }
    }

    /// The face on the left of a halfedge.
    #[inline]
    pub fn face(&self, h: HalfedgeId) -> FaceId {
        match &self.layout {
            Layout::Quads => FaceId(h.0 / 4),
            Layout::Polygons { face, .. } => FaceId(face[h.index()]),
        }
    }

    /// The edge of a halfedge.
    #[inline]
    pub fn edge(&self, h: HalfedgeId) -> EdgeId {
        EdgeId(self.edge[h.index()])
    }

    /// The vertex that a halfedge leaves.
    #[inline]
    pub fn origin(&self, h: HalfedgeId) -> VertexId {
        VertexId(self.origin[h.index()])
    }

    /// The vertex that a halfedge reaches.
    #[inline]
    pub fn target(&self, h: HalfedgeId) -> VertexId {
        self.origin(self.next(h))
    }

    /// A halfedge that leaves the vertex; on a boundary the one with nothing on its right. `None` if isolated.
    #[inline]
    pub fn outgoing(&self, v: VertexId) -> Option<HalfedgeId> {
        let h = self.outgoing[v.index()];
        (h != NONE).then_some(HalfedgeId(h))
    }

    /// The halfedges that leave a vertex, counter-clockwise, one per face. At a boundary vertex the first runs
    /// along the boundary; the last boundary edge is the previous one of the last.
    #[inline]
    pub fn ring(&self, v: VertexId) -> impl Iterator<Item = HalfedgeId> + '_ {
        let first = self.outgoing(v);
        std::iter::successors(first, move |&h| self.twin(self.prev(h)).filter(|&next| Some(next) != first))
    }

    /// True if the vertex lies on a boundary.
    #[inline]
    pub fn is_boundary(&self, v: VertexId) -> bool {
        self.outgoing(v).is_some_and(|h| self.twin(h).is_none())
    }

    /// The interior vertices of valence 2, in order.
    pub fn lenses(&self) -> impl ExactSizeIterator<Item = VertexId> + '_ {
        self.lenses.iter().map(|&v| VertexId(v))
    }

    /// True if the vertex is an interior one of valence 2.
    pub fn is_lens(&self, v: VertexId) -> bool {
        self.lenses.binary_search(&v.0).is_ok()
    }

    /// How many faces meet at the vertex.
    pub fn valence(&self, v: VertexId) -> Valence {
        let faces = self.ring(v).count() as u32;
        if self.is_boundary(v) { Valence::Boundary(faces) } else { Valence::Interior(faces) }
    }

    /// The halfedge of an edge that has the smaller number.
    #[inline]
    pub fn side(&self, e: EdgeId) -> HalfedgeId {
        HalfedgeId(self.first_side[e.index()])
    }

    /// One halfedge of each edge, in the order of the edges: the one with the smaller number.
    pub fn edge_halfedges(&self) -> impl ExactSizeIterator<Item = HalfedgeId> + '_ {
        self.first_side.iter().map(|&h| HalfedgeId(h))
    }
}

fn has_distinct_corners(face: &[u32]) -> bool {
    match *face {
        [a, b, c, d] => a != b && a != c && a != d && b != c && b != d && c != d,
        [a, b, c] => a != b && a != c && b != c,
        [] | [_] | [_, _] => false,
        _ => {
            let mut sorted = face.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).all(|pair| pair[0] != pair[1])
        }
    }
}

/// What pairing finds: twins, and whether every edge had one side or two opposite ones.
pub(crate) struct Pairing {
    pub(crate) twin: Vec<u32>,
    pub(crate) manifold: bool,
}

impl Pairing {
    /// For each halfedge the next one counter-clockwise around its origin; `NONE` at the end of an open fan.
    pub(crate) fn previous_twins(&self, faces: &FaceList) -> Vec<u32> {
        let mut out = vec![NONE; self.twin.len()];
        for f in 0..faces.len() {
            let (start, end) = (faces.starts()[f], faces.starts()[f + 1]);
            for h in start..end {
                let prev = if h == start { end - 1 } else { h - 1 };
                out[h as usize] = self.twin[prev as usize];
            }
        }
        out
    }
}

/// Finds the twin of every halfedge: halfedges are put into one bucket per smaller end, and matched inside it.
pub(crate) fn pair_halfedges(faces: &FaceList, vertices: usize) -> Pairing {
    let origin = faces.corners();
    let mut target = vec![0u32; origin.len()];
    for f in 0..faces.len() {
        let (start, end) = (faces.starts()[f] as usize, faces.starts()[f + 1] as usize);
        for h in start..end {
            target[h] = origin[if h + 1 == end { start } else { h + 1 }];
        }
    }
    let mut starts = vec![0u32; vertices + 1];
    for (&a, &b) in origin.iter().zip(&target) {
        starts[a.min(b) as usize + 1] += 1;
    }
    for v in 0..vertices {
        starts[v + 1] += starts[v];
    }
    // (greater end, halfedge), by smaller end.
    let mut cursor = starts.clone();
    let mut bucket = vec![(0u32, 0u32); origin.len()];
    for h in 0..origin.len() {
        let (a, b) = (origin[h], target[h]);
        let slot = &mut cursor[a.min(b) as usize];
        bucket[*slot as usize] = (a.max(b), h as u32);
        *slot += 1;
    }
    let mut twin = vec![NONE; origin.len()];
    let mut manifold = true;
    for v in 0..vertices {
        let sides = &mut bucket[starts[v] as usize..starts[v + 1] as usize];
        sides.sort_unstable();
        for edge in sides.chunk_by(|x, y| x.0 == y.0) {
            match *edge {
                [_] => {}
                [(_, g), (_, h)] if origin[g as usize] != origin[h as usize] => {
                    twin[g as usize] = h;
                    twin[h as usize] = g;
                }
                _ => manifold = false,
            }
        }
    }
    Pairing { twin, manifold }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Defect, shapes};

    #[test]
    fn a_cube_is_what_it_is() {
        let t = Topology::new(&shapes::cube()).unwrap();
        assert_eq!((t.vertex_count(), t.edge_count(), t.face_count()), (8, 12, 6));
        assert!(t.is_quads());
        assert!((0..8).all(|v| t.valence(VertexId(v)) == Valence::Interior(3)));
        for h in (0..24).map(HalfedgeId) {
            let twin = t.twin(h).unwrap();
            assert_eq!(t.twin(twin), Some(h));
            assert_eq!(t.origin(twin), t.target(h));
            assert_eq!(t.edge(twin), t.edge(h));
            assert_eq!(t.prev(t.next(h)), h);
        }
    }

    #[test]
    fn rings_are_counter_clockwise_and_open_at_the_boundary() {
        let t = Topology::new(&shapes::grid(2, 2)).unwrap();
        let middle = VertexId(4);
        assert_eq!(t.valence(middle), Valence::Interior(4));
        let ends: Vec<u32> = t.ring(middle).map(|h| t.target(h).0).collect();
        let start = ends.iter().position(|&v| v == 5).unwrap();
        let turned: Vec<u32> = (0..4).map(|i| ends[(start + i) % 4]).collect();
        assert_eq!(turned, [5, 7, 3, 1]);
        assert_eq!(t.valence(VertexId(0)), Valence::Boundary(1));
        assert_eq!(t.valence(VertexId(1)), Valence::Boundary(2));
        let first = t.ring(VertexId(1)).next().unwrap();
        assert_eq!((t.target(first), t.twin(first)), (VertexId(2), None));
    }

    #[test]
    fn every_defect_is_reported() {
        let mut mesh = shapes::grid(2, 1);
        mesh.faces.push(&[0, 1, 9]);
        mesh.faces.push(&[0, 1, 1]);
        mesh.faces.push(&[0, 1]);
        mesh.points[5].y = f64::NAN;
        mesh.creases.push(crate::Crease { vertices: [0, 5], sharpness: crate::Sharpness::Infinite });
        let codes: Vec<&str> = Topology::new(&mesh).unwrap_err().defects.iter().map(Defect::code).collect();
        assert_eq!(
            codes,
            ["missing_vertex", "repeated_vertex", "face_too_small", "not_finite", "crease_off_edge"]
        );
    }

    #[test]
    fn non_manifold_meshes_are_refused_precisely() {
        let points = vec![crate::Vec3::ZERO; 8];
        let defects = |faces: &[[u32; 3]]| {
            let mesh = ControlMesh::new(points.clone(), faces.iter().copied().collect());
            Topology::new(&mesh).unwrap_err().defects
        };
        let (a, b) = (VertexId(0), VertexId(1));
        assert_eq!(defects(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), [Defect::NonManifoldEdge { a, b, faces: 3 }]);
        assert_eq!(
            defects(&[[0, 1, 2], [0, 1, 3]]),
            [Defect::FlippedFace { face: FaceId(1), neighbour: FaceId(0), a, b }]
        );
        assert_eq!(
            defects(&[[0, 1, 2], [0, 3, 4], [0, 5, 6]]),
            [Defect::NonManifoldVertex { vertex: a, fans: 3 }]
        );
    }
}
