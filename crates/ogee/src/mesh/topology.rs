//! `Topology`: who meets whom, as flat arrays of halfedges.
//!
//! Halfedges of a face are consecutive. Edges of a cage are numbered in the order of first meeting them while
//! walking its halfedges. A boundary has no outer halfedges: a halfedge there has no twin. Refinement follows the
//! rule of Dupuy and Vanhoey, A Halfedge Refinement Rule for Parallel Catmull-Clark Subdivision (2021); see
//! `refine/split.rs`.

use super::adjacency::Adjacency;
use super::check::{TopologyError, check_all};
use super::cycles::{FaceCycles, PolygonCycles, QuadCycles};
use super::{ControlMesh, EdgeId, FaceId, FaceList, HalfedgeId, VertexId};
use crate::math::{Vec3, pages, par};

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
    /// Costs a few passes over the corners, on all cores, and hardly any memory beside the result.
    ///
    /// # Errors
    /// If the mesh has any defect; then all of them are named.
    pub fn new(mesh: &ControlMesh) -> Result<Topology, TopologyError> {
        Topology::pair(mesh).ok_or_else(|| TopologyError { defects: check_all(mesh) })
    }

    /// The connectivity of sound faces, or nothing at the first sign of a defect.
    pub(super) fn pair(mesh: &ControlMesh) -> Option<Topology> {
        let (faces, vertices) = (&mesh.faces, mesh.points.len());
        let countable = !faces.is_empty() && faces.corners().len() < NONE as usize;
        if !countable {
            return None;
        }
        par::stay(faces.corners().len(), || {
            if !(are_sound(faces, vertices) && are_finite(&mesh.points)) {
                return None;
            }
            let (layout, origin) = (Layout::new(faces), copy(faces.corners()));
            let adjacency = layout.adjacency(&origin, vertices)?;
            adjacency.single_fans.then(|| Topology::from_parts(origin, adjacency, layout))
        })
    }

    /// The connectivity of faces taken out of a sound mesh. On the rim a vertex may belong to several fans; its ring
    /// is then one of them.
    pub(crate) fn of_part(faces: &FaceList, vertices: usize) -> Topology {
        let (layout, origin) = (Layout::new(faces), copy(faces.corners()));
        let adjacency =
            layout.adjacency(&origin, vertices).expect("edges of a part of a sound mesh are sound");
        Topology::from_parts(origin, adjacency, layout)
    }

    /// The same faces over other vertices, cut along some edges.
    pub(crate) fn with_seams(
        &self,
        origin: Vec<u32>,
        vertices: usize,
        seam: impl Fn(HalfedgeId) -> bool + Sync + Send,
    ) -> Topology {
        let twin = |h: usize| if seam(HalfedgeId(h as u32)) { NONE } else { self.twin[h] };
        let twin = par::collect(self.twin.len(), twin);
        let layout = self.layout.clone();
        let adjacency = match &layout {
            Layout::Quads => Adjacency::with_twins(QuadCycles, &origin, vertices, twin),
            Layout::Polygons { starts, face } => {
                Adjacency::with_twins(PolygonCycles { starts, face }, &origin, vertices, twin)
            }
        };
        Topology::from_parts(origin, adjacency, layout)
    }

    fn from_parts(origin: Vec<u32>, adjacency: Adjacency, layout: Layout) -> Topology {
        let Adjacency { twin, edge, first_side, outgoing, lenses, single_fans: _ } = adjacency;
        Topology { origin, twin, edge, first_side, outgoing, lenses, layout }
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
        HalfedgeId(match &self.layout {
            Layout::Quads => QuadCycles.next(h.0),
            Layout::Polygons { starts, face } => PolygonCycles { starts, face }.next(h.0),
        })
    }

    /// The previous halfedge of the same face.
    #[inline]
    pub fn prev(&self, h: HalfedgeId) -> HalfedgeId {
        HalfedgeId(match &self.layout {
            Layout::Quads => QuadCycles.prev(h.0),
            Layout::Polygons { starts, face } => PolygonCycles { starts, face }.prev(h.0),
        })
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

    /// The halfedge between two vertices, in either direction.
    pub(crate) fn find_edge(&self, [a, b]: [VertexId; 2]) -> Option<HalfedgeId> {
        self.ring(a).find_map(|h| {
            let before = self.prev(h);
            let is_it = self.target(h) == b;
            is_it.then_some(h).or((self.origin(before) == b).then_some(before))
        })
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

impl Layout {
    fn new(faces: &FaceList) -> Layout {
        if faces.starts().iter().enumerate().all(|(f, &start)| start as usize == 4 * f) {
            return Layout::Quads;
        }
        let mut face = pages::vector(faces.corners().len());
        for (f, corners) in faces.iter().enumerate() {
            face.extend(corners.iter().map(|_| f as u32));
        }
        Layout::Polygons { starts: copy(faces.starts()), face }
    }

    fn adjacency(&self, origin: &[u32], vertices: usize) -> Option<Adjacency> {
        match self {
            Layout::Quads => Adjacency::new(QuadCycles, origin, vertices),
            Layout::Polygons { starts, face } => {
                Adjacency::new(PolygonCycles { starts, face }, origin, vertices)
            }
        }
    }
}

fn copy(numbers: &[u32]) -> Vec<u32> {
    let mut out = pages::vector(numbers.len());
    out.extend_from_slice(numbers);
    out
}

/// True if all corners name vertices, those of a face different ones, and there are three at least.
fn are_sound(faces: &FaceList, vertices: usize) -> bool {
    par::all(faces.len(), |f| {
        let face = faces.face(f);
        face.iter().all(|&v| (v as usize) < vertices) && has_distinct_corners(face)
    })
}

fn has_distinct_corners(face: &[u32]) -> bool {
    match *face {
        [a, b, c, d] => (a != b) & (a != c) & (a != d) & (b != c) & (b != d) & (c != d),
        [a, b, c] => (a != b) & (a != c) & (b != c),
        [] | [_] | [_, _] => false,
        _ => {
            let mut sorted = face.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).all(|pair| pair[0] != pair[1])
        }
    }
}

fn are_finite(points: &[Vec3]) -> bool {
    par::all(points.len(), |i| points[i].is_finite())
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
        let points = vec![Vec3::ZERO; 8];
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
