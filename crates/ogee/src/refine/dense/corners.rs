//! The corners of grids: around a corner all levels look alike, so the base level's rules say what becomes of it.

use super::grids::Grids;
use super::numbering::{Spoke, spoke};
use crate::math::{Components, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::rules::{Level, masks};
use crate::stencil::Row;

/// Refines all corners into `out`.
pub(super) fn refine<C: Connectivity, T: Components>(rules: &Level, grids: &Grids<'_, C, T>, out: &mut [T]) {
    let (_, tagged) = rules.tagged_rules();
    par::fill(out, |v| {
        let v = VertexId(v as u32);
        let untagged = tagged.is_empty() || tagged.get(v.0).is_none();
        untagged.then(|| smooth(grids, v)).flatten().unwrap_or_else(|| by_rule(rules, grids, v))
    })
}

/// The smooth rule, if it holds: between quads, in terms of the points around the vertex.
#[inline]
fn smooth<C: Connectivity, T: Components>(grids: &Grids<'_, C, T>, v: VertexId) -> Option<T> {
    let base = grids.frame.base;
    let first = base.outgoing(v)?;
    let (mut edges, mut diagonals) = (T::zero(), T::zero());
    let mut n = 0.0;
    let mut h = first;
    loop {
        edges.add_scaled(1.0, &grids.frame.first(h));
        diagonals.add_scaled(1.0, &grids.beside(h));
        n += 1.0;
        h = base.twin(base.prev(h))?;
        if h == first {
            break;
        }
    }
    // A face point is a quarter of the vertex, of two neighbours and of the opposite point.
    let mut value = T::zero();
    value.add_scaled((n - 2.0) / n + 1.0 / (4.0 * n), &grids.frame.corner(v));
    value.add_scaled(3.0 / (2.0 * n * n), &edges);
    value.add_scaled(1.0 / (4.0 * n * n), &diagonals);
    Some(value)
}

/// Whatever the rule table says.
fn by_rule<C: Connectivity, T: Components>(rules: &Level, grids: &Grids<'_, C, T>, v: VertexId) -> T {
    let mut row = Row::new();
    masks::vertex_terms(rules, v, &mut row);
    let mut value = T::zero();
    let [vertices, faces] = row.terms();
    for &(source, weight) in vertices {
        let point = match spoke(grids.frame.base, v, VertexId(source)) {
            Some(Spoke::Leaving(h)) => grids.frame.first(h),
            Some(Spoke::Arriving(h)) => grids.frame.last(h),
            // The vertex itself.
            None => grids.frame.corner(v),
        };
        value.add_scaled(weight, &point);
    }
    for &(f, weight) in faces {
        if let Some(h) = grids.frame.base.ring(v).find(|&h| grids.frame.base.face(h) == FaceId(f)) {
            face_point(grids, h, weight, &mut value);
        }
    }
    value
}

/// Adds the mean of the cell at the origin of a halfedge, in its face.
fn face_point<C: Connectivity, T: Components>(
    grids: &Grids<'_, C, T>,
    h: HalfedgeId,
    weight: f64,
    value: &mut T,
) {
    let corners = [
        grids.frame.corner(grids.frame.base.origin(h)),
        grids.frame.first(h),
        grids.beside(h),
        grids.frame.last(grids.frame.base.prev(h)),
    ];
    for point in corners {
        value.add_scaled(weight / 4.0, &point);
    }
}
