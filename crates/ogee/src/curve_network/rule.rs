//! The virtual face: what makes the face point of a quad at a meeting of curves.

use crate::mesh::connectivity::Connectivity;
use crate::mesh::{HalfedgeId, VertexId};
use crate::stencil::Row;

/// A quad at a meeting, an X-slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slice {
    /// Leaves the meeting, in this quad.
    pub(crate) halfedge: HalfedgeId,
    /// True if a curve arrives along that halfedge, false if one does along the other side of the quad.
    pub(crate) port_first: bool,
    /// The parameter of the meeting.
    pub(crate) t: f64,
}

impl Slice {
    /// The other quad's side of the edge along which the curve arrives; `None` where that quad is not there.
    pub(crate) fn port_side(self, mesh: &impl Connectivity) -> Option<HalfedgeId> {
        mesh.twin(if self.port_first { self.halfedge } else { mesh.prev(self.halfedge) })
    }
}

/// `(2 A + t (D - O) + E + C) / 4` in the quad `(A, E, C, D)`: of the meeting, the port, the corner across, the free spoke;
/// `O` is the free spoke on the other side of the port.
pub(crate) fn slice_point(mesh: &impl Connectivity, slice: Slice, weight: f64, row: &mut Row) {
    let Slice { halfedge, port_first, t } = slice;
    let side = slice.port_side(mesh).expect("a meeting lies inside");
    let last = mesh.prev(halfedge);
    let (first, second) = (mesh.target(halfedge), mesh.origin(last));
    let (port, free, other) = match port_first {
        // That side arrives at the meeting, or leaves it.
        true => (first, second, mesh.target(mesh.next(side))),
        false => (second, first, mesh.origin(mesh.prev(side))),
    };
    let quarter = weight / 4.0;
    let mut add = |vertex: VertexId, share: f64| row.add(vertex, share * quarter);
    add(mesh.origin(halfedge), 2.0);
    add(port, 1.0);
    add(mesh.origin(mesh.prev(last)), 1.0);
    add(free, t);
    add(other, -t);
}
