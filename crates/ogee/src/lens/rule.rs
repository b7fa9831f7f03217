//! The mask of a vertex of valence 2.
//!
//! Karciauskas and Peters repair Catmull and Clark's rule there: with their rule for the vertex itself, and all others
//! as they are, the limit has a tangent plane (`docs/methods/lens.md`, The rule).

use crate::mesh::connectivity::Connectivity;
use crate::mesh::{LensShape, VertexId};
use crate::stencil::Row;

/// `1 - beta - 2 gamma` of the vertex, `beta / 2 - gamma` of each neighbour and `2 gamma` of each face point, at an
/// interior vertex of valence 2. Between quads that is `1 - beta - gamma` of the vertex, `beta / 2` of each neighbour and
/// `gamma / 2` of each opposite corner.
pub(crate) fn centre(mesh: &impl Connectivity, v: VertexId, shape: LensShape, weight: f64, row: &mut Row) {
    let LensShape { beta, gamma } = shape;
    row.add(v, weight * (1.0 - beta - 2.0 * gamma));
    for h in mesh.ring(v) {
        row.add(mesh.target(h), weight * (beta / 2.0 - gamma));
        row.add_face_point(mesh.face(h), weight * 2.0 * gamma);
    }
}
