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

/// [`smooth_edge`] and the masks of its face points at once, which names the ends once: several times as fast.
pub(crate) fn edge_point(mesh: &impl Connectivity, h: HalfedgeId, twin: HalfedgeId, row: &mut Row) {
    let mut end = 1.0 / 4.0;
    for side in [h, twin] {
        let size = mesh.face_size(mesh.face(side));
        let share = 1.0 / 4.0 / f64::from(size);
        let mut g = mesh.next(side);
        for _ in 2..size {
            g = mesh.next(g);
            row.add(mesh.origin(g), share);
        }
        end += share;
    }
    row.add(mesh.origin(h), end);
    row.add(mesh.origin(twin), end);
}

/// [`smooth_vertex`] and the masks of its face points at once, which names each neighbour once.
pub(crate) fn vertex_point(mesh: &impl Connectivity, v: VertexId, row: &mut Row) {
    let n = mesh.ring(v).count() as f64;
    let mut own = (n - 2.0) / n;
    for h in mesh.ring(v) {
        let size = mesh.face_size(mesh.face(h));
        let share = 1.0 / (n * n) / f64::from(size);
        own += share;
        let twin = mesh.twin(h).expect("no boundary is near");
        let other_share = 1.0 / (n * n) / f64::from(mesh.face_size(mesh.face(twin)));
        row.add(mesh.target(h), 1.0 / (n * n) + share + other_share);
        let mut g = mesh.next(h);
        for _ in 3..size {
            g = mesh.next(g);
            row.add(mesh.origin(g), share);
        }
    }
    row.add(v, own);
}

/// What makes a vertex of the next level, by its number there, where no tag and no boundary is near.
pub(crate) fn smooth_child(mesh: &impl Connectivity, child: u32, row: &mut Row) {
    let (vertices, faces) = (mesh.vertex_count() as u32, mesh.face_count() as u32);
    if child < vertices {
        vertex_point(mesh, VertexId(child), row);
    } else if child < vertices + faces {
        face_point(mesh, FaceId(child - vertices), 1.0, row);
    } else {
        let h = mesh.side(EdgeId(child - vertices - faces));
        edge_point(mesh, h, mesh.twin(h).expect("no boundary is near"), row);
    }
    row.expand_face_points(|_, _, _| ());
}
