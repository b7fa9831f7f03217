//! Limit masks at vertices, sector by sector: position and two tangents.
//!
//! They hold where all faces at the vertex are quads and no finite sharpness is left. Halstead, Kass and DeRose (1993)
//! and Biermann, Levin and Zorin (2000) have the smooth ones; the cross tangent on a boundary is ours, since the one
//! commonly printed belongs to other boundary rules (`docs/methods/catmull_clark.md`, Changes from the paper).

use crate::math::Vec3;
use std::f64::consts::{PI, TAU};

/// Position and two tangents that span the tangent plane, `tangents[0] x tangents[1]` outward.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) position: Vec3,
    pub(crate) tangents: [Vec3; 2],
}

/// The largest eigenvalue below one of a ring whose edges are `angle` apart: by it the ring shrinks in every step.
pub(crate) fn subdominant(angle: f64) -> f64 {
    let c = angle.cos();
    (5.0 + c + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0
}

/// Weight of the neighbours against the diagonals in a tangent mask.
pub(super) fn edge_weight(angle: f64) -> f64 {
    let c = angle.cos();
    1.0 + c + (angle / 2.0).cos() * (2.0 * (9.0 + c)).sqrt()
}

/// Weights of two tangents around a smooth vertex of valence `n`, for each `i` on neighbour and on diagonal.
pub(super) fn smooth_tangents(n: usize) -> impl Iterator<Item = [[f64; 2]; 2]> {
    let angle = TAU / n as f64;
    let weight = edge_weight(angle);
    (0..n).map(move |i| {
        let (here, next) = (i as f64 * angle, (i + 1) as f64 * angle);
        let edge = [weight * here.cos(), weight * here.sin()];
        [edge, [here.cos() + next.cos(), here.sin() + next.sin()]]
    })
}

/// At a smooth interior vertex: neighbours and diagonals counter-clockwise, diagonal `i` between neighbours `i` and
/// `i + 1`.
pub(crate) fn smooth(vertex: Vec3, edges: &[Vec3], diagonals: &[Vec3]) -> Frame {
    let n = edges.len() as f64;
    let mut position = n * n * vertex;
    let mut tangents = [Vec3::ZERO; 2];
    for ((&edge, &diagonal), [on_edge, on_diagonal]) in
        edges.iter().zip(diagonals).zip(smooth_tangents(edges.len()))
    {
        position += 4.0 * edge + diagonal;
        for which in 0..2 {
            tangents[which] += on_edge[which] * edge + on_diagonal[which] * diagonal;
        }
    }
    Frame { position: position / (n * (n + 5.0)), tangents }
}

/// [`smooth`] at valence 4, where the surface is a bicubic B-spline.
pub(crate) fn regular(vertex: Vec3, e: [Vec3; 4], d: [Vec3; 4]) -> Frame {
    let position = (16.0 * vertex + 4.0 * (e[0] + e[1] + e[2] + e[3]) + (d[0] + d[1] + d[2] + d[3])) / 36.0;
    let along = 4.0 * (e[0] - e[2]) + (d[0] - d[1]) + (d[3] - d[2]);
    let across = 4.0 * (e[1] - e[3]) + (d[0] - d[3]) + (d[1] - d[2]);
    Frame { position, tangents: [along, across] }
}

/// On a crease or boundary: neighbours from one sharp edge to the other, one more than diagonals.
pub(crate) fn crease(vertex: Vec3, edges: &[Vec3], diagonals: &[Vec3]) -> Frame {
    let k = diagonals.len();
    let (first, last) = (edges[0], edges[k]);
    let position = (4.0 * vertex + first + last) / 6.0;
    let along = (first - last) / 2.0;
    if k == 1 {
        return Frame { position, tangents: [along, first + last - 2.0 * vertex] };
    }
    let angle = PI / k as f64;
    let lambda = subdominant(angle);
    let weight = edge_weight(angle);
    let sines: Vec<f64> = (0..=k).map(|i| (i as f64 * angle).sin()).collect();
    let inner_sum: f64 = sines[1..k].iter().sum();
    let diagonal_sum: f64 = sines.windows(2).map(|pair| pair[0] + pair[1]).sum();
    // (lambda - 1/2) l0 - lv / 8 = weight sin / 16 + sin / 4,  (lambda - 3/4) lv - l0 = rest
    let right = weight * angle.sin() / 16.0 + angle.sin() / 4.0;
    let rest = 3.0 / 8.0 * weight * inner_sum + diagonal_sum / 4.0;
    let determinant = (lambda - 0.5) * (lambda - 0.75) - 1.0 / 8.0;
    let end = (right * (lambda - 0.75) + rest / 8.0) / determinant;
    let own = (right + (lambda - 0.5) * rest) / determinant;
    let mut across = own * vertex + end * (first + last);
    for i in 1..k {
        across += weight * sines[i] * edges[i];
    }
    for (pair, &diagonal) in sines.windows(2).zip(diagonals) {
        across += (pair[0] + pair[1]) * diagonal;
    }
    Frame { position, tangents: [along, across] }
}

/// At a corner, which stays: the plane of its two sharp edges.
pub(crate) fn corner(vertex: Vec3, edges: &[Vec3]) -> Frame {
    let [first, last] = [edges[0], edges[edges.len() - 1]].map(|edge| edge - vertex);
    Frame { position: vertex, tangents: [first, last] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_regular_mask_is_the_smooth_one_at_valence_four() {
        let point = |i: usize| Vec3::new((3 * i % 7) as f64, (i * i % 5) as f64, 1.0 / (i + 1) as f64);
        let (edges, diagonals) =
            (std::array::from_fn(|i| point(i + 1)), std::array::from_fn(|i| point(i + 5)));
        let (a, b) = (smooth(point(0), &edges, &diagonals), regular(point(0), edges, diagonals));
        assert!(a.position.distance(b.position) < 1e-15 * 10.0);
        // Directions only: the lengths differ by no factor either.
        for (s, t) in a.tangents.iter().zip(b.tangents) {
            assert!(s.distance(t) < 1e-13);
        }
    }

    #[test]
    fn two_faces_on_a_boundary_give_the_cross_tangent_of_the_spline() {
        let unit = |i: usize| {
            Vec3::new(
                if i == 0 { 1.0 } else { 0.0 },
                if i == 1 { 1.0 } else { 0.0 },
                if i == 2 { 1.0 } else { 0.0 },
            )
        };
        // Weights one by one: the mask is linear.
        let weight = |which: usize| {
            let pick = |index: usize| if index == which { unit(0) } else { Vec3::ZERO };
            crease(pick(0), &[pick(1), pick(2), pick(3)], &[pick(4), pick(5)]).tangents[1].x
        };
        let wanted = [-4.0, -1.0, 4.0, -1.0, 1.0, 1.0];
        let scale = weight(4);
        for (index, wanted) in wanted.into_iter().enumerate() {
            assert!((weight(index) / scale - wanted).abs() < 1e-14, "{index}: {}", weight(index) / scale);
        }
    }
}
