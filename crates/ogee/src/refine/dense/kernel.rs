//! The uniform cubic B-spline's refinement, along rows and from row to row.
//!
//! Between two points comes their mean; a point becomes three quarters of itself and an eighth of each neighbour.

use bytemuck::{cast_slice, cast_slice_mut};

use crate::math::Components;

/// Along a row of at least three points: what becomes of all of them and of the gaps between, the first and the last point left
/// out.
#[inline(always)]
pub(super) fn along<T: Components>(row: &[T], out: &mut [T]) {
    let gaps = row.len() - 1;
    let n = T::COUNT;
    let (row, out) = (cast_slice(row), cast_slice_mut(out));
    for m in 0..gaps - 1 {
        let near = &row[m * n..(m + 3) * n];
        let made = &mut out[2 * m * n..(2 * m + 2) * n];
        for c in 0..n {
            made[c] = edge(near[c], near[n + c]);
        }
        for c in 0..n {
            made[n + c] = vertex(near[c], near[n + c], near[2 * n + c]);
        }
    }
    edge_row([&row[(gaps - 1) * n..gaps * n], &row[gaps * n..]], &mut out[(2 * gaps - 2) * n..]);
}

/// The row between two rows.
#[inline(always)]
pub(super) fn edge_row(rows: [&[f64]; 2], out: &mut [f64]) {
    let count = out.len();
    let [a, b] = [&rows[0][..count], &rows[1][..count]];
    for i in 0..count {
        out[i] = edge(a[i], b[i]);
    }
}

/// What becomes of the middle one of three rows.
#[inline(always)]
pub(super) fn vertex_row(rows: [&[f64]; 3], out: &mut [f64]) {
    let count = out.len();
    let [a, b, c] = [&rows[0][..count], &rows[1][..count], &rows[2][..count]];
    for i in 0..count {
        out[i] = vertex(a[i], b[i], c[i]);
    }
}

#[inline(always)]
fn edge(a: f64, b: f64) -> f64 {
    (a + b) * (1.0 / 2.0)
}

#[inline(always)]
fn vertex(a: f64, b: f64, c: f64) -> f64 {
    (a + c) * (1.0 / 8.0) + b * (6.0 / 8.0)
}
