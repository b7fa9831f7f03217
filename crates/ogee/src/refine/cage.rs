//! A refined level as a cage of its own.

use crate::math::Vec3;
use crate::mesh::{Boundary, ControlMesh, Corner, Crease, FaceList, Sharpness, VertexId};
use crate::rules::Level;

impl Level {
    /// This level of quads as a cage, with what is left of its tags. Meetings of curves and texture coordinates are the
    /// caller's to add.
    pub(crate) fn to_cage(&self, points: Vec<Vec3>) -> ControlMesh {
        let topology = self.topology();
        let mut faces = FaceList::with_capacity(topology.face_count(), topology.halfedge_count());
        for quad in topology.origin.chunks_exact(4) {
            faces.push(quad);
        }
        let mut mesh = ControlMesh::new(points, faces);
        for h in topology.edge_halfedges().filter(|&h| topology.twin(h).is_some()) {
            let sharpness = self.edge_sharpness(h);
            if sharpness > 0.0 {
                let vertices = [topology.origin(h).0, topology.target(h).0];
                mesh.creases.push(Crease { vertices, sharpness: Sharpness::from_value(sharpness) });
            }
        }
        for vertex in 0..topology.vertex_count() as u32 {
            let sharpness = self.vertex_sharpness(VertexId(vertex));
            if sharpness > 0.0 {
                mesh.corners.push(Corner { vertex, sharpness: Sharpness::from_value(sharpness) });
            }
        }
        mesh.holes = self.hidden_faces().iter().map(|f| f.0).collect();
        mesh.scheme = self.scheme();
        if mesh.scheme.boundary == Boundary::None {
            // What it leaves out is a hole by now; said again it would leave out more.
            mesh.scheme.boundary = Boundary::EdgeOnly;
        }
        mesh
    }
}
