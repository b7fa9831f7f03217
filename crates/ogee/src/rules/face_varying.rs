//! Face-varying data: one more level over the same halfedges, whose vertices are the values.
//!
//! Its twins are cut on seams, so seams obey the boundary rules; creases and sharp vertices are those of the mesh. The
//! linear-interpolation rule says which values never move (`docs/methods/catmull_clark.md`, Theory).

use super::{Level, SharpEdge, Sparse};
use crate::mesh::{Boundary, FaceVarying, FaceVaryingRule, HalfedgeId, Scheme, Topology, VertexId};

impl Level {
    /// The level of face-varying values, and the values of its vertices. Faces, halfedges and grids are those of this
    /// level; a value that two fans of faces hold apart from one another is two vertices.
    ///
    /// # Panics
    /// If `data` does not fit this level: [`Level::new`] on the mesh that holds it has made sure.
    pub fn face_varying(&self, data: &FaceVarying) -> (Level, Vec<[f64; 2]>) {
        let mesh = self.topology();
        let seam = |h: HalfedgeId| {
            mesh.twin(h).is_none_or(|twin| {
                data.indices[h.index()] != data.indices[mesh.next(twin).index()]
                    || data.indices[mesh.next(h).index()] != data.indices[twin.index()]
            })
        };
        let (origin, values) = fans(mesh, data, seam);
        let topology = mesh.with_seams(origin, values.len(), seam);

        let all = data.rule == FaceVaryingRule::All;
        let edges = (0..topology.halfedge_count() as u32).map(HalfedgeId).filter_map(|halfedge| {
            let is_first = topology.twin(halfedge).is_some_and(|twin| halfedge < twin);
            let sharpness = if all { f64::INFINITY } else { self.edge_sharpness(halfedge) };
            (is_first && sharpness > 0.0)
                .then(|| (topology.edge(halfedge).0, SharpEdge { halfedge, sharpness }))
        });
        let edges = Sparse::new(edges.collect());
        let mut fixed = Vec::new();
        for v in (0..mesh.vertex_count() as u32).map(VertexId) {
            let sharpness = self.vertex_sharpness(v);
            let around: Vec<HalfedgeId> = mesh.ring(v).collect();
            let held = FixedValues::new(&topology, data, &around, mesh.is_boundary(v));
            for value in around.iter().map(|&h| topology.origin(h)) {
                let sharpness =
                    if held.is_fixed(data.rule, &topology, value) { f64::INFINITY } else { sharpness };
                if sharpness > 0.0 {
                    fixed.push((value.0, sharpness));
                }
            }
        }
        // Which values stay is settled here: no further corners at the boundary.
        let scheme = Scheme { boundary: Boundary::EdgeOnly, ..self.scheme() };
        let hidden = self.hidden_faces().to_vec();
        let level = Level::with_sharpness(topology, scheme, edges, Sparse::new(fixed), hidden);
        (level, values.into_iter().map(|value| data.values[value as usize]).collect())
    }
}

/// One vertex for each fan of faces that hold the same value: for each halfedge the vertex at its origin, and for each
/// vertex the value.
fn fans(mesh: &Topology, data: &FaceVarying, seam: impl Fn(HalfedgeId) -> bool) -> (Vec<u32>, Vec<u32>) {
    let mut origin = vec![u32::MAX; mesh.halfedge_count()];
    let mut values = Vec::new();
    for v in (0..mesh.vertex_count() as u32).map(VertexId) {
        let mut ring: Vec<HalfedgeId> = mesh.ring(v).collect();
        // Begin behind a seam, if there is one.
        let start = ring.iter().position(|&h| seam(h)).unwrap_or(0);
        ring.rotate_left(start);
        for (k, &h) in ring.iter().enumerate() {
            if k == 0 || seam(h) {
                values.push(data.indices[h.index()]);
            }
            origin[h.index()] = values.len() as u32 - 1;
        }
    }
    (origin, values)
}

/// What the values around one vertex of the cage have to do with one another.
struct FixedValues {
    /// Different values.
    count: usize,
    /// Some value is held by faces that are not consecutive.
    scattered: bool,
    /// Some value is held by one face.
    single: bool,
    /// One value inside the mesh, with a seam that ends here.
    seam_ends: bool,
}

impl FixedValues {
    fn new(topology: &Topology, data: &FaceVarying, around: &[HalfedgeId], boundary: bool) -> FixedValues {
        let mut values: Vec<u32> = around.iter().map(|h| data.indices[h.index()]).collect();
        values.sort_unstable();
        values.dedup();
        let mut fans: Vec<VertexId> = around.iter().map(|&h| topology.origin(h)).collect();
        fans.sort_unstable();
        fans.dedup();
        let single = fans.iter().any(|&fan| topology.ring(fan).count() == 1);
        let has_seam = around.iter().any(|&h| topology.twin(h).is_none());
        FixedValues {
            count: values.len(),
            scattered: fans.len() > values.len(),
            single,
            seam_ends: values.len() == 1 && has_seam && !boundary,
        }
    }

    fn is_fixed(&self, rule: FaceVaryingRule, topology: &Topology, value: VertexId) -> bool {
        let alone = topology.ring(value).count() == 1;
        let plus1 = self.count > 2 || self.count == 2 && self.scattered;
        match rule {
            FaceVaryingRule::None => false,
            FaceVaryingRule::CornersOnly => alone,
            FaceVaryingRule::CornersPlus1 => alone || plus1,
            FaceVaryingRule::CornersPlus2 => {
                alone || plus1 || self.seam_ends || self.count == 2 && self.single
            }
            FaceVaryingRule::Boundaries => topology.is_boundary(value),
            FaceVaryingRule::All => true,
        }
    }
}
