//! `Statistics`: what is in a cage, counted; a faulty one as far as its faces can be understood.

use std::collections::{BTreeMap, HashMap};

use super::{ControlMesh, Defect, VertexId, check};
use crate::math::Vec3;

/// Counts of everything that decides what can be done with a cage.
///
/// A mesh with defects is described too. Corners of faces that name missing vertices are passed over, and what has no
/// meaning for it is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// All vertices, isolated ones included.
    pub vertices: usize,
    /// All faces.
    pub faces: usize,
    /// Pairs of vertices that follow each other in a face.
    pub edges: usize,
    /// Faces with four corners.
    pub quads: usize,
    /// Faces with three corners.
    pub triangles: usize,
    /// Faces with any other number of corners.
    pub other_polygons: usize,
    /// Edges of one face only.
    pub boundary_edges: usize,
    /// Closed loops of boundary edges; `None` if the mesh has defects.
    pub boundary_loops: Option<usize>,
    /// Pieces whose faces hang together by edges, in the order of their first faces.
    pub components: Vec<Component>,
    /// For each valence how many interior vertices have it.
    pub valences: BTreeMap<u32, usize>,
    /// Interior vertices of valence other than 4, and boundary vertices of more than two faces.
    pub extraordinary: usize,
    /// Edges that join two extraordinary vertices.
    pub extraordinary_edges: usize,
    /// Edges with a finite sharpness above zero.
    pub semi_sharp_creases: usize,
    /// Edges tagged as infinitely sharp.
    pub infinite_creases: usize,
    /// Vertices with a sharpness above zero.
    pub corners: usize,
    /// Faces tagged as holes.
    pub holes: usize,
    /// Interior vertices of valence 2.
    pub valence_two: Vec<VertexId>,
    /// Of all points, `[least, greatest]`; `None` without points.
    pub bounding_box: Option<[Vec3; 2]>,
    /// Why no [`crate::Level`] can be built from it.
    pub defects: Vec<Defect>,
}

/// A connected piece of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Component {
    /// Its faces.
    pub faces: usize,
    /// True if each of its edges has two faces or more.
    pub closed: bool,
    /// Handles, after all boundary loops have been filled with disks; `None` if the mesh has defects.
    pub genus: Option<usize>,
}

/// An edge, by its ends in order, and the faces at it.
struct Edge {
    ends: [u32; 2],
    first_face: u32,
    faces: u32,
}

impl Statistics {
    /// Describes a mesh. Costs some sorts of the edges.
    ///
    /// ```
    /// let statistics = ogee::Statistics::new(&ogee::shapes::torus(8, 4));
    /// assert_eq!((statistics.edges, statistics.extraordinary), (64, 0));
    /// assert_eq!(statistics.components[0].genus, Some(1));
    /// ```
    pub fn new(mesh: &ControlMesh) -> Statistics {
        let mut pieces = Sets::new(mesh.faces.len());
        let edges = edges(mesh, &mut pieces);
        let mut statistics = Statistics {
            vertices: mesh.points.len(),
            faces: mesh.faces.len(),
            edges: edges.len(),
            quads: mesh.faces.iter().filter(|face| face.len() == 4).count(),
            triangles: mesh.faces.iter().filter(|face| face.len() == 3).count(),
            boundary_edges: edges.iter().filter(|edge| edge.faces == 1).count(),
            bounding_box: mesh.bounding_box(),
            defects: check(mesh),
            ..Statistics::default()
        };
        statistics.other_polygons = statistics.faces - statistics.quads - statistics.triangles;
        statistics.count_components(mesh, &edges, &mut pieces);
        statistics.count_valences(mesh, &edges);
        statistics.count_tags(mesh);
        statistics
    }

    fn count_components(&mut self, mesh: &ControlMesh, edges: &[Edge], pieces: &mut Sets) {
        let mut numbers = HashMap::new();
        let piece_of: Vec<usize> = (0..mesh.faces.len() as u32)
            .map(|face| {
                let next = numbers.len();
                *numbers.entry(pieces.find(face)).or_insert(next)
            })
            .collect();
        // Euler's characteristic of each piece, and of its boundary loops.
        let mut euler = vec![0i64; numbers.len()];
        let mut loops = vec![0i64; numbers.len()];
        self.components = vec![Component { faces: 0, closed: true, genus: None }; numbers.len()];
        for &piece in &piece_of {
            self.components[piece].faces += 1;
            euler[piece] += 1;
        }
        let mut rims = Sets::new(mesh.points.len());
        for edge in edges {
            let piece = piece_of[edge.first_face as usize];
            euler[piece] -= 1;
            if edge.faces == 1 {
                self.components[piece].closed = false;
                // In a loop of n edges n - 1 join what was apart.
                loops[piece] += i64::from(!rims.join(edge.ends[0], edge.ends[1]));
            }
        }
        if !self.defects.is_empty() {
            return;
        }
        let mut seen = vec![false; mesh.points.len()];
        for (face, corners) in mesh.faces.iter().enumerate() {
            for &v in corners {
                euler[piece_of[face]] += i64::from(!std::mem::replace(&mut seen[v as usize], true));
            }
        }
        self.boundary_loops = Some(loops.iter().sum::<i64>() as usize);
        for (piece, component) in self.components.iter_mut().enumerate() {
            component.genus = Some(((2 - loops[piece] - euler[piece]) / 2) as usize);
        }
    }

    fn count_valences(&mut self, mesh: &ControlMesh, edges: &[Edge]) {
        let mut faces = vec![0u32; mesh.points.len()];
        for &v in mesh.faces.corners() {
            if let Some(count) = faces.get_mut(v as usize) {
                *count += 1;
            }
        }
        let mut on_boundary = vec![false; mesh.points.len()];
        for v in edges.iter().filter(|edge| edge.faces == 1).flat_map(|edge| edge.ends) {
            on_boundary[v as usize] = true;
        }
        let is_extraordinary = |v: usize| match (on_boundary[v], faces[v]) {
            (true, n) => n > 2,
            (false, n) => n != 0 && n != 4,
        };
        for v in (0..faces.len()).filter(|&v| faces[v] > 0) {
            self.extraordinary += usize::from(is_extraordinary(v));
            if !on_boundary[v] {
                *self.valences.entry(faces[v]).or_default() += 1;
                if faces[v] == 2 {
                    self.valence_two.push(VertexId(v as u32));
                }
            }
        }
        let joins = |edge: &&Edge| edge.ends.iter().all(|&v| is_extraordinary(v as usize));
        self.extraordinary_edges = edges.iter().filter(joins).count();
    }

    /// The last tag of an edge or vertex counts.
    fn count_tags(&mut self, mesh: &ControlMesh) {
        let creases = mesh.creases.iter().map(|crease| {
            let [a, b] = crease.vertices;
            ([a.min(b), a.max(b)], crease.sharpness.value())
        });
        let creases: HashMap<[u32; 2], f64> = creases.collect();
        self.infinite_creases = creases.values().filter(|s| s.is_infinite()).count();
        self.semi_sharp_creases = creases.values().filter(|s| s.is_finite() && **s > 0.0).count();
        let corners = mesh.corners.iter().map(|corner| (corner.vertex, corner.sharpness.value()));
        let corners: HashMap<u32, f64> = corners.collect();
        self.corners = corners.values().filter(|s| **s > 0.0).count();
        let mut holes = mesh.holes.clone();
        holes.sort_unstable();
        holes.dedup();
        self.holes = holes.len();
    }
}

/// All edges between vertices that exist; joins the faces at each.
fn edges(mesh: &ControlMesh, pieces: &mut Sets) -> Vec<Edge> {
    let count = mesh.points.len();
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(mesh.faces.corners().len());
    for (f, corners) in mesh.faces.iter().enumerate() {
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if a != b && (a.max(b) as usize) < count {
                sides.push(([a.min(b), a.max(b)], f as u32));
            }
        }
    }
    sides.sort_unstable();
    let edges = sides.chunk_by(|x, y| x.0 == y.0).map(|sides| {
        let (ends, first_face) = sides[0];
        for &(_, face) in &sides[1..] {
            pieces.join(first_face, face);
        }
        Edge { ends, first_face, faces: sides.len() as u32 }
    });
    edges.collect()
}

/// Disjoint sets of numbers.
struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    fn new(count: usize) -> Sets {
        Sets { parent: (0..count as u32).collect() }
    }

    fn find(&mut self, mut x: u32) -> u32 {
        while self.parent[x as usize] != x {
            self.parent[x as usize] = self.parent[self.parent[x as usize] as usize];
            x = self.parent[x as usize];
        }
        x
    }

    /// False if they were in one set already.
    fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Corner, Crease, Sharpness, shapes};

    #[test]
    fn a_cube_is_counted() {
        let cube = Statistics::new(&shapes::cube());
        assert_eq!((cube.vertices, cube.edges, cube.faces, cube.quads), (8, 12, 6, 6));
        assert_eq!(cube.components, [Component { faces: 6, closed: true, genus: Some(0) }]);
        assert_eq!(cube.valences, BTreeMap::from([(3, 8)]));
        assert_eq!((cube.extraordinary, cube.extraordinary_edges), (8, 12));
        assert_eq!((cube.boundary_edges, cube.boundary_loops), (0, Some(0)));
    }

    #[test]
    fn boundaries_have_loops_and_handles_are_found_beside_them() {
        let grid = Statistics::new(&shapes::grid(3, 2));
        assert_eq!((grid.boundary_edges, grid.boundary_loops, grid.extraordinary), (10, Some(1), 0));
        assert_eq!(grid.components, [Component { faces: 6, closed: false, genus: Some(0) }]);

        // A torus without two faces that do not touch.
        let torus = shapes::torus(8, 6);
        let kept = torus.faces.iter().enumerate().filter(|(f, _)| *f != 0 && *f != 20);
        let mut faces = crate::FaceList::new();
        kept.for_each(|(_, face)| faces.push(face));
        let open = Statistics::new(&ControlMesh::new(torus.points, faces));
        assert_eq!((open.boundary_edges, open.boundary_loops), (8, Some(2)));
        assert_eq!(open.components, [Component { faces: 46, closed: false, genus: Some(1) }]);
        // At each corner of a missing quad three faces are left.
        assert_eq!(open.extraordinary, 8);
    }

    #[test]
    fn pieces_are_told_apart() {
        let mut two = shapes::cube();
        let shift = two.points.len() as u32;
        two.points.extend(shapes::grid(1, 1).points);
        two.faces.push(&[shift, shift + 1, shift + 3, shift + 2]);
        let two = Statistics::new(&two);
        let closed: Vec<(usize, bool)> = two.components.iter().map(|c| (c.faces, c.closed)).collect();
        assert_eq!(closed, [(6, true), (1, false)]);
    }

    #[test]
    fn the_last_tag_counts() {
        let mut cube = shapes::cube();
        let crease = |vertices, value| Crease { vertices, sharpness: Sharpness::from_value(value) };
        cube.creases = vec![crease([0, 1], 10.0), crease([1, 0], 2.5), crease([1, 3], 10.0)];
        cube.creases.extend([crease([2, 3], 3.0), crease([2, 3], 0.0)]);
        cube.corners = vec![Corner { vertex: 4, sharpness: Sharpness::Infinite }];
        cube.holes = vec![3, 3];
        let cube = Statistics::new(&cube);
        assert_eq!((cube.semi_sharp_creases, cube.infinite_creases), (1, 1));
        assert_eq!((cube.corners, cube.holes), (1, 1));
    }

    #[test]
    fn a_faulty_mesh_is_described_as_far_as_it_goes() {
        let mut fin = shapes::cube();
        fin.points.push(Vec3::new(5.0, 0.0, 0.0));
        fin.faces.push(&[0, 1, 8]);
        fin.faces.push(&[0, 99, 8]);
        fin.faces.push(&[7, 7]);
        fin.faces.push(&[]);
        let fin = Statistics::new(&fin);
        assert_eq!((fin.faces, fin.triangles, fin.other_polygons), (10, 2, 2));
        assert_eq!((fin.boundary_loops, fin.components[0].genus), (None, None));
        assert!(fin.defects.iter().any(|defect| defect.code() == "non_manifold_edge"));
        assert_eq!(Statistics::new(&ControlMesh::default()).bounding_box, None);
    }

    #[test]
    fn valence_two_is_found() {
        let points =
            vec![Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(1.0, 1.0, 1.0)];
        let pillow = ControlMesh::new(points, [[0, 1, 3, 2], [2, 3, 1, 0]].into_iter().collect());
        let pillow = Statistics::new(&pillow);
        assert_eq!(pillow.valence_two, [VertexId(0), VertexId(1), VertexId(2), VertexId(3)]);
    }
}
