//! The step of a chain around a smooth vertex, written out: what most chains are.
//!
//! The same sums as the general step of [`super::chain`] makes from the rule table, without indices to look up; the test
//! `the_quick_step_is_the_general_step` holds the two together. Points are numbered as there.

use super::chain::Wide;

/// The fine points around a smooth vertex of valence `n`: the next ring, then the other points of the tiles. `ring` has
/// room behind it for the face points around the vertex.
#[inline(always)]
pub(super) fn step(n: usize, ring: &mut [Wide], fine: &mut [Wide]) {
    let count = 2 * n + 8;
    let (ring, face_points) = ring.split_at_mut(count);
    let face_points = &mut face_points[..n];
    let fine = &mut fine[..count + 9];
    let vertex = ring[0];

    // Face points are the next diagonals.
    let mut edges = [0.0; 4];
    let mut faces = [0.0; 4];
    for i in 0..n {
        let (edge, diagonal) = (ring[1 + 2 * i], ring[2 + 2 * i]);
        let next = ring[if i + 1 == n { 1 } else { 3 + 2 * i }];
        let face = scaled(1.0 / 4.0, add(add(vertex, edge), add(diagonal, next)));
        face_points[i] = face;
        fine[2 + 2 * i] = face;
        edges = add(edges, edge);
        faces = add(faces, face);
    }
    let mut before = face_points[n - 1];
    for i in 0..n {
        let face = face_points[i];
        fine[1 + 2 * i] = scaled(1.0 / 4.0, add(add(vertex, ring[1 + 2 * i]), add(face, before)));
        before = face;
    }
    let valence = n as f64;
    fine[0] =
        add(scaled((valence - 2.0) / valence, vertex), scaled(1.0 / (valence * valence), add(edges, faces)));

    // The grid of the quad: (1, 0), (1, 1), (0, 1), then those on its rim.
    let (e0, d0, e1) = (ring[1], ring[2], ring[3]);
    let (before, after) = (ring[2 * n], ring[4]);
    let outer = &ring[2 * n + 1..];
    let [p2m, p20, p21, p22, p12, p02, pm2] =
        [outer[0], outer[1], outer[2], outer[3], outer[4], outer[5], outer[6]];
    let cell = |a, b, c, d| scaled(1.0 / 4.0, add(add(a, b), add(c, d)));
    let own = face_points[0];
    let below = face_points[n - 1];
    let left = face_points[1];
    let right_below = cell(before, p2m, p20, e0);
    let right = cell(e0, p20, p21, d0);
    let corner = cell(d0, p21, p22, p12);
    let above = cell(e1, d0, p12, p02);
    let above_left = cell(after, e1, p02, pm2);
    let out = &mut fine[2 * n + 1..];
    out[0] = cell(before, e0, below, right_below);
    out[1] = regular(e0, [vertex, before, p20, d0], [own, below, right_below, right]);
    out[2] = cell(e0, d0, own, right);
    out[3] = regular(d0, [e0, p21, p12, e1], [own, right, corner, above]);
    out[4] = cell(d0, e1, own, above);
    out[5] = regular(e1, [vertex, d0, p02, after], [own, above, above_left, left]);
    out[6] = cell(e1, after, left, above_left);
    // Nine more for the tiles: (3,-1) (3,0) (3,1) (3,2), (0,3) (1,3) (2,3) (3,3), (-1,3).
    out[7] = right_below;
    out[8] = cell(e0, p20, right_below, right);
    out[9] = right;
    out[10] = cell(d0, p21, right, corner);
    out[11] = cell(e1, p02, above_left, above);
    out[12] = above;
    out[13] = cell(d0, p12, corner, above);
    out[14] = corner;
    out[15] = above_left;
}

/// A vertex of valence 4 from its neighbours and the face points around it.
#[inline(always)]
fn regular(vertex: Wide, neighbours: [Wide; 4], faces: [Wide; 4]) -> Wide {
    let [a, b, c, d] = neighbours;
    let [e, f, g, h] = faces;
    let around = add(add(add(a, b), add(c, d)), add(add(e, f), add(g, h)));
    add(scaled(1.0 / 2.0, vertex), scaled(1.0 / 16.0, around))
}

#[inline(always)]
fn add(a: Wide, b: Wide) -> Wide {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}

#[inline(always)]
fn scaled(s: f64, a: Wide) -> Wide {
    [s * a[0], s * a[1], s * a[2], s * a[3]]
}
