//! The rule table: which rule makes the child of which element.
//!
//! A mask sees connectivity and writes weights; it never sees a point.

use super::{EdgeRule, Level, VertexMask, VertexRule};
use crate::catmull_clark;
use crate::crease;
use crate::curve_network;
use crate::lens;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::stencil::Row;

/// The child of a vertex.
pub(crate) fn vertex_mask(level: &Level, v: VertexId, row: &mut Row) {
    vertex_terms(level, v, row);
    row.expand_face_points(|f, weight, row| face(level, f, weight, row));
}

/// The child of a vertex, face points left as they are.
pub(crate) fn vertex_terms(level: &Level, v: VertexId, row: &mut Row) {
    match level.vertex_rule(v) {
        VertexRule::Of(mask) => one(level, v, mask, 1.0, row),
        VertexRule::Blend { parent, child, weight } => {
            one(level, v, parent, weight, row);
            one(level, v, child, 1.0 - weight, row);
        }
    }
}

fn one(level: &Level, v: VertexId, mask: VertexMask, weight: f64, row: &mut Row) {
    match mask {
        VertexMask::Smooth => catmull_clark::rule::smooth_vertex(level.topology(), v, weight, row),
        VertexMask::Lens => lens::rule::centre(level.topology(), v, level.scheme().lens, weight, row),
        VertexMask::Crease { ends } => crease::rule::crease_vertex(v, ends, weight, row),
        VertexMask::Corner => row.add(v, weight),
    }
}

/// The child of an edge, by either of its halfedges.
pub(crate) fn edge_mask(level: &Level, h: HalfedgeId, row: &mut Row) {
    edge_terms(level, h, row);
    row.expand_face_points(|f, weight, row| face(level, f, weight, row));
}

/// The child of an edge, face points left as they are.
pub(crate) fn edge_terms(level: &Level, h: HalfedgeId, row: &mut Row) {
    let topology = level.topology();
    let ends = [topology.origin(h), topology.target(h)];
    let crease_share = match level.edge_rule(h) {
        EdgeRule::Smooth => 0.0,
        EdgeRule::Crease => 1.0,
        EdgeRule::Blend { weight } => weight,
    };
    if crease_share != 0.0 {
        crease::rule::crease_edge(ends, crease_share, row);
    }
    if let (true, Some(twin)) = (crease_share != 1.0, topology.twin(h)) {
        catmull_clark::rule::smooth_edge(topology, h, twin, 1.0 - crease_share, row);
    }
}

/// The child of a face.
pub(crate) fn face_mask(level: &Level, f: FaceId, row: &mut Row) {
    face(level, f, 1.0, row);
    row.expand_face_points(|_, _, _| ());
}

fn face(level: &Level, f: FaceId, weight: f64, row: &mut Row) {
    match level.slice(f) {
        None => catmull_clark::rule::face_point(level.topology(), f, weight, row),
        Some(slice) => curve_network::rule::slice_point(level.topology(), slice, weight, row),
    }
}
