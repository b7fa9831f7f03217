//! Smooth face, edge and vertex masks. Each adds `weight` times the mask to the row.

use crate::mesh::{FaceId, HalfedgeId, Topology, VertexId};
use crate::stencil::Row;

/// The mean of the corners.
pub(crate) fn face_point(topology: &Topology, f: FaceId, weight: f64, row: &mut Row) {
    let share = weight / f64::from(topology.face_size(f));
    for h in topology.halfedges(f) {
        row.add(topology.origin(h), share);
    }
}

/// A quarter of each end and of each face point. `h` is either side of an interior edge, `twin` the other.
pub(crate) fn smooth_edge(topology: &Topology, h: HalfedgeId, twin: HalfedgeId, weight: f64, row: &mut Row) {
    row.add(topology.origin(h), weight / 4.0);
    row.add(topology.origin(twin), weight / 4.0);
    row.add_face_point(topology.face(h), weight / 4.0);
    row.add_face_point(topology.face(twin), weight / 4.0);
}

/// `(n - 2) / n` of the vertex, `1 / n^2` of each neighbour and each face point, at an interior vertex of
/// valence `n`.
pub(crate) fn smooth_vertex(topology: &Topology, v: VertexId, weight: f64, row: &mut Row) {
    let n = topology.ring(v).count() as f64;
    row.add(v, weight * (n - 2.0) / n);
    for h in topology.ring(v) {
        row.add(topology.target(h), weight / (n * n));
        row.add_face_point(topology.face(h), weight / (n * n));
    }
}
