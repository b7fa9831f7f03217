//! The uniform cubic B-spline's refinement, along rows and from row to row.
//!
//! Between two points comes their mean; a point becomes three quarters of itself and an eighth of each neighbour.

use crate::math::Components;
use crate::math::simd::Four;

/// Along a row of at least three points, `COUNT` numbers each: what becomes of all of them and of the gaps between, the first and
/// the last point left out. After both the row and its results comes one number that is anything.
#[inline(always)]
pub(super) fn along<V: Four, T: Components>(row: &[f64], out: &mut [f64]) {
    let n = T::COUNT;
    let gaps = (row.len() - 1) / n - 1;
    if n == 3 {
        return along_vectors::<V>(gaps, row, out);
    }
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
    let near = &row[(gaps - 1) * n..];
    for c in 0..n {
        out[(2 * gaps - 2) * n + c] = edge(near[c], near[n + c]);
    }
}

/// Three numbers a point in registers of four: the fourth is the next point's first, and is written over by it.
#[inline(always)]
fn along_vectors<V: Four>(gaps: usize, row: &[f64], out: &mut [f64]) {
    let load = |m: usize| {
        let [x, y, z, w] = row[3 * m..3 * m + 4] else { unreachable!("four numbers") };
        V::load(&[x, y, z, w])
    };
    let mut put = |m: usize, value: V| out[3 * m..3 * m + 4].copy_from_slice(&value.store());
    let (half, eighth, most) = (V::splat(1.0 / 2.0), V::splat(1.0 / 8.0), V::splat(6.0 / 8.0));
    let (mut a, mut b) = (load(0), load(1));
    for m in 0..gaps - 1 {
        let c = load(m + 2);
        put(2 * m, a.plus(b).times(half));
        put(2 * m + 1, a.plus(c).times(eighth).plus(b.times(most)));
        (a, b) = (b, c);
    }
    put(2 * gaps - 2, a.plus(b).times(half));
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
