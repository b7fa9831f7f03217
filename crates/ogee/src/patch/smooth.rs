//! The step of a chain around a smooth vertex, written out: what most chains are.
//!
//! The same sums as the general step of [`super::chain`] makes from the rule table, without indices to look up; the test
//! `the_quick_step_is_the_general_step` holds the two together. Points are numbered as there.

use super::chain::Wide;
use crate::math::simd::Four;

/// The fine points around a smooth vertex of valence `n`: the next ring, then the other points of the tiles. `ring` has
/// room behind it for the face points around the vertex.
#[inline(always)]
pub(super) fn step<V: Four>(n: usize, ring: &mut [Wide], fine: &mut [Wide]) {
    let count = 2 * n + 8;
    let (ring, face_points) = ring.split_at_mut(count);
    let face_points = &mut face_points[..n];
    let fine = &mut fine[..count + 9];
    let vertex = V::load(&ring[0]);

    // Face points are the next diagonals.
    let first = V::load(&ring[1]);
    let (mut edges, mut faces) = (V::splat(0.0), V::splat(0.0));
    let mut edge = first;
    for i in 0..n {
        let next = if i + 1 == n { first } else { V::load(&ring[3 + 2 * i]) };
        let face = cell(vertex, edge, V::load(&ring[2 + 2 * i]), next);
        face_points[i] = face.store();
        fine[2 + 2 * i] = face.store();
        edges = edges.plus(edge);
        faces = faces.plus(face);
        edge = next;
    }
    let mut before = V::load(&face_points[n - 1]);
    for i in 0..n {
        let face = V::load(&face_points[i]);
        fine[1 + 2 * i] = cell(vertex, V::load(&ring[1 + 2 * i]), face, before).store();
        before = face;
    }
    let valence = n as f64;
    let (own, around) = (V::splat((valence - 2.0) / valence), V::splat(1.0 / (valence * valence)));
    fine[0] = own.times(vertex).plus(around.times(edges.plus(faces))).store();

    // The grid of the quad: (1, 0), (1, 1), (0, 1), then those on its rim.
    let (e0, d0, e1) = (V::load(&ring[1]), V::load(&ring[2]), V::load(&ring[3]));
    let (before, after) = (V::load(&ring[2 * n]), V::load(&ring[4]));
    let outer = 2 * n + 1;
    let [p2m, p20, p21, p22, p12, p02, pm2] = load(&ring[outer..]);
    let [own, below, left] =
        [V::load(&face_points[0]), V::load(&face_points[n - 1]), V::load(&face_points[1])];
    let right_below = cell(before, p2m, p20, e0);
    let right = cell(e0, p20, p21, d0);
    let corner = cell(d0, p21, p22, p12);
    let above = cell(e1, d0, p12, p02);
    let above_left = cell(after, e1, p02, pm2);
    let out = &mut fine[outer..outer + 16];
    out[0] = cell(before, e0, below, right_below).store();
    out[1] = regular(e0, [vertex, before, p20, d0], [own, below, right_below, right]).store();
    out[2] = cell(e0, d0, own, right).store();
    out[3] = regular(d0, [e0, p21, p12, e1], [own, right, corner, above]).store();
    out[4] = cell(d0, e1, own, above).store();
    out[5] = regular(e1, [vertex, d0, p02, after], [own, above, above_left, left]).store();
    out[6] = cell(e1, after, left, above_left).store();
    // Nine more for the tiles: (3,-1) (3,0) (3,1) (3,2), (0,3) (1,3) (2,3) (3,3), (-1,3).
    out[7] = right_below.store();
    out[8] = cell(e0, p20, right_below, right).store();
    out[9] = right.store();
    out[10] = cell(d0, p21, right, corner).store();
    out[11] = cell(e1, p02, above_left, above).store();
    out[12] = above.store();
    out[13] = cell(d0, p12, corner, above).store();
    out[14] = corner.store();
    out[15] = above_left.store();
}

/// The first seven.
#[inline(always)]
fn load<V: Four>(from: &[Wide]) -> [V; 7] {
    let mut out = [V::splat(0.0); 7];
    for (out, from) in out.iter_mut().zip(&from[..7]) {
        *out = V::load(from);
    }
    out
}

/// The mean of four: a face point, and an edge point of its ends and two face points.
#[inline(always)]
fn cell<V: Four>(a: V, b: V, c: V, d: V) -> V {
    a.plus(b).plus(c.plus(d)).times(V::splat(1.0 / 4.0))
}

/// A vertex of valence 4 from its neighbours and the face points around it.
#[inline(always)]
fn regular<V: Four>(vertex: V, neighbours: [V; 4], faces: [V; 4]) -> V {
    let [a, b, c, d] = neighbours;
    let [e, f, g, h] = faces;
    let around = a.plus(b).plus(c.plus(d)).plus(e.plus(f).plus(g.plus(h)));
    V::splat(1.0 / 2.0).times(vertex).plus(V::splat(1.0 / 16.0).times(around))
}
