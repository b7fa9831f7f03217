//! A football.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::direction;
use super::{Form, Model};

/// Of the seams, and of the panels between them.
const SEAM: f64 = 110.5;
const PANEL: f64 = 115.7;
/// How far the padded part of a panel reaches from its middle to its seams.
const PADDED: f64 = 0.86;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let (corners, triangles) = icosahedron();
    // Two seam points on each edge, one near either end.
    let mut near = vec![[u32::MAX; 12]; 12];
    for &[p, q, r] in &triangles {
        for [from, to] in [[p, q], [q, r], [r, p]] {
            let point = corners[from].lerp(corners[to], 1.0 / 3.0);
            near[from][to] = b.point(point.normalized().unwrap_or(point) * SEAM);
        }
    }
    for &[p, q, r] in &triangles {
        let seams = [near[p][q], near[q][p], near[q][r], near[r][q], near[r][p], near[p][r]];
        panel(&mut b, &seams);
        // Every second seam bounds a pentagon; the others are met again from the next hexagon.
        for k in 0..6 {
            let (v, w) = (seams[k], seams[(k + 1) % 6]);
            if k % 2 == 1 || v < w {
                b.crease_path(&[v, w], SHARP);
            }
        }
    }
    for p in 0..corners.len() {
        let seams: Vec<u32> = neighbours(p, &triangles).into_iter().map(|q| near[p][q]).collect();
        panel(&mut b, &seams);
    }
    Model {
        name: "ball",
        about: &[
            "A football, 220 across: 12 pentagons and 20 hexagons, padded, with sharp seams between them.",
            "Exercises polygons of five and six corners, and creases that meet in threes.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}

/// A panel inside its seams: a raised polygon and a strip of quads down to the seams.
fn panel(b: &mut Builder, seams: &[u32]) {
    let middle = b.centre(seams);
    let raised: Vec<Vec3> = seams
        .iter()
        .map(|&v| {
            let p = middle.lerp(b.at(v), PADDED);
            p.normalized().unwrap_or(p) * PANEL
        })
        .collect();
    let raised = b.points(raised);
    b.bridge(seams, &raised);
    b.face(&raised);
}

/// The corners around corner `p`, counter-clockwise.
fn neighbours(p: usize, triangles: &[[usize; 3]]) -> Vec<usize> {
    let around = triangles.iter().filter_map(|t| {
        let k = t.iter().position(|&v| v == p)?;
        Some((t[(k + 1) % 3], t[(k + 2) % 3]))
    });
    let around: Vec<(usize, usize)> = around.collect();
    let after = |&q: &usize| around.iter().find(|pair| pair.0 == q).map(|pair| pair.1);
    std::iter::successors(Some(around[0].0), after).take(around.len()).collect()
}

/// Unit corners, poles first and last, and triangles seen from outside.
fn icosahedron() -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let height = 1.0 / 5f64.sqrt();
    let up = Vec3::new(0.0, 0.0, 1.0);
    let ring = |phase: f64, z: f64| {
        (0..5).map(move |i| direction((f64::from(i) + phase) / 5.0) * (2.0 * height) + up * z)
    };
    let corners = [up].into_iter().chain(ring(0.0, height)).chain(ring(0.5, -height)).chain([-up]).collect();
    let mut triangles = Vec::new();
    for i in 0..5 {
        let j = (i + 1) % 5;
        triangles.extend([
            [0, 1 + i, 1 + j],
            [1 + i, 6 + i, 1 + j],
            [6 + i, 6 + j, 1 + j],
            [11, 6 + j, 6 + i],
        ]);
    }
    (corners, triangles)
}
