//! Smooth face, edge and vertex masks. Each adds `weight` times the mask to the row.

use crate::mesh::connectivity::Connectivity;
use crate::mesh::{EdgeId, FaceId, HalfedgeId, VertexId};
use crate::stencil::Row;

/// The mean of the corners.
pub(crate) fn face_point(mesh: &impl Connectivity, f: FaceId, weight: f64, row: &mut Row) {
    let (first, size) = (mesh.first(f).0, mesh.face_size(f));
    let share = weight / f64::from(size);
    for h in first..first + size {
        row.add(mesh.origin(HalfedgeId(h)), share);
    }
}

/// A quarter of each end and of each face point. `h` is either side of an interior edge, `twin` the other.
pub(crate) fn smooth_edge(
    mesh: &impl Connectivity,
    h: HalfedgeId,
    twin: HalfedgeId,
    weight: f64,
    row: &mut Row,
) {
    row.add(mesh.origin(h), weight / 4.0);
    row.add(mesh.origin(twin), weight / 4.0);
    row.add_face_point(mesh.face(h), weight / 4.0);
    row.add_face_point(mesh.face(twin), weight / 4.0);
}

/// `(n - 2) / n` of the vertex, `1 / n^2` of each neighbour and each face point, at an interior vertex of
/// valence `n`.
pub(crate) fn smooth_vertex(mesh: &impl Connectivity, v: VertexId, weight: f64, row: &mut Row) {
    let n = mesh.ring(v).count() as f64;
    row.add(v, weight * (n - 2.0) / n);
    for h in mesh.ring(v) {
        row.add(mesh.target(h), weight / (n * n));
        row.add_face_point(mesh.face(h), weight / (n * n));
    }
}

/// What makes a vertex of the next level, by its number there, where no tag and no boundary is near.
pub(crate) fn smooth_child(mesh: &impl Connectivity, child: u32, row: &mut Row) {
    let (vertices, faces) = (mesh.vertex_count() as u32, mesh.face_count() as u32);
    if child < vertices {
        smooth_vertex(mesh, VertexId(child), 1.0, row);
    } else if child < vertices + faces {
        face_point(mesh, FaceId(child - vertices), 1.0, row);
    } else {
        let h = mesh.side(EdgeId(child - vertices - faces));
        let twin = mesh.twin(h).expect("no boundary is near");
        smooth_edge(mesh, h, twin, 1.0, row);
    }
    row.expand_face_points(|f, weight, row| face_point(mesh, f, weight, row));
}
