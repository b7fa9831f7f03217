//! Crease masks, and how sharpness fades.

use crate::mesh::VertexId;
use crate::stencil::Row;

/// Three quarters of the vertex, an eighth of each neighbour along the crease.
pub(crate) fn crease_vertex(v: VertexId, ends: [VertexId; 2], weight: f64, row: &mut Row) {
    row.add(v, weight * 6.0 / 8.0);
    row.add(ends[0], weight / 8.0);
    row.add(ends[1], weight / 8.0);
}

/// The middle of the edge.
pub(crate) fn crease_edge(ends: [VertexId; 2], weight: f64, row: &mut Row) {
    row.add(ends[0], weight / 2.0);
    row.add(ends[1], weight / 2.0);
}

/// Sharpness one level on: one less, never below zero; infinity stays.
pub(crate) fn fade(sharpness: f64) -> f64 {
    (sharpness - 1.0).max(0.0)
}

/// Chaikin's rule: what an edge of sharpness `s` passes on to its half at a vertex where the other semi-sharp
/// edges have the given sum and count.
pub(crate) fn fade_chaikin(s: f64, others_sum: f64, others: u32) -> f64 {
    if s.is_infinite() || others == 0 {
        return fade(s);
    }
    fade(0.75 * s + 0.25 * others_sum / f64::from(others))
}

/// The weight of the parent's mask where parent and child obey different ones: the mean of the sharpnesses that
/// reach zero in this step, at most 1.
pub(crate) fn blend_weight(vanishing: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = vanishing.fold((0.0, 0u32), |(sum, count), s| (sum + s, count + 1));
    if count == 0 { 0.0 } else { (sum / f64::from(count)).min(1.0) }
}
