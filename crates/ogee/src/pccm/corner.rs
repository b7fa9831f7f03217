//! Limit points and tangents at a corner: `Q_00` and `Q_10` of every edge of a fan.

use super::constants::Constants;
use super::fan::{Arrays, CornerClass, Fan};
use super::net::view;
use super::{Options, Tangents};
use crate::math::circulant::first_mode;
use crate::math::{Grid, Vec3};
use std::f64::consts::{PI, TAU};

/// Below this opening angle, or this close to a straight angle, the plane of the two sharp edges at a corner does
/// not carry a fan of tangents: `docs/methods/pccm.md`, Practice, has the figures.
const CORNER_ANGLE_MARGIN: f64 = 0.05;

/// Nodes of the refined mesh around a fan: the vertex, the far nodes of the edges, the diagonals of the patches.
struct Ring {
    vertex: Vec3,
    edges: Vec<Vec3>,
    diagonals: Vec<Vec3>,
}

impl Ring {
    fn new(fan: &Fan, nets: &[Grid<Vec3>]) -> Ring {
        let node = |i: usize, a: usize, b: usize| {
            let (patch, k) = fan.patch(i);
            // Node (a, b) stands at (a + 1, b + 1) of the layered net.
            nets[patch][view(k, a + 1, b + 1, nets[patch].rows() - 1)]
        };
        let patches = fan.halfedges.len();
        let mut edges: Vec<Vec3> = (0..patches).map(|i| node(i, 1, 0)).collect();
        if !fan.closed {
            edges.push(node(patches - 1, 0, 1));
        }
        Ring { vertex: node(0, 0, 0), edges, diagonals: (0..patches).map(|i| node(i, 1, 1)).collect() }
    }
}

/// Decides angle, apex and tangents of a fan; `inserted` are the coefficients before smoothing.
pub(crate) fn place(fan: &mut Fan, nets: &[Grid<Vec3>], inserted: &Arrays, options: &Options) {
    let ring = Ring::new(fan, nets);
    match fan.class {
        CornerClass::Regular | CornerClass::Meeting => {}
        CornerClass::Interior | CornerClass::Dart => place_smooth(fan, &ring, inserted, options),
        CornerClass::Crease => place_on_crease(fan, &ring, inserted),
        CornerClass::Corner => place_at_corner(fan, &ring),
        CornerClass::Cone => fan.apex = ring.vertex,
    }
}

/// Limit point and limit tangents of the smooth rule; at a dart the ring begins at the crease and closes on it.
fn place_smooth(fan: &mut Fan, ring: &Ring, inserted: &Arrays, options: &Options) {
    let n = fan.halfedges.len();
    let valence = n as f64;
    let edges = &ring.edges[..n];
    let sum = |points: &[Vec3]| points.iter().fold(Vec3::ZERO, |sum, &p| sum + p);
    fan.apex = (valence * valence * ring.vertex + 4.0 * sum(edges) + sum(&ring.diagonals))
        / (valence * (valence + 5.0));
    let constants = Constants::new(n as u32);
    let directions: Vec<Vec3> = match options.tangents {
        Tangents::Slides => first_mode(&(0..n).map(|i| inserted.edge(fan, i, 1)).collect::<Vec<_>>()),
        Tangents::Clamp | Tangents::Project => {
            let length = match options.tangents {
                Tangents::Project => constants.length_project,
                _ => constants.length_clamp,
            };
            let (alpha, beta) = constants.weights(length);
            let pairs: Vec<Vec3> =
                (0..n).map(|i| ring.diagonals[i] + ring.diagonals[(i + n - 1) % n]).collect();
            let both = first_mode(edges).into_iter().zip(first_mode(&pairs));
            both.map(|(edge, pair)| alpha * edge + beta * pair).collect()
        }
    };
    fan.c = (TAU / valence).cos();
    fan.tangents = (0..fan.edge_count()).map(|i| fan.apex + directions[i % n]).collect();
    fan.smoothed = true;
}

/// Along a crease the tangent of its curve, across it that of the limit surface, with the length that fits the
/// inserted tangents best.
fn place_on_crease(fan: &mut Fan, ring: &Ring, inserted: &Arrays) {
    let s = fan.halfedges.len();
    let (first, last) = (ring.edges[0], ring.edges[s]);
    fan.apex = (first + 4.0 * ring.vertex + last) / 6.0;
    if s == 1 {
        // The patch corner is singular, as it is in the limit surface: nothing to smooth.
        return;
    }
    let angle = PI / s as f64;
    let along = (first - last) / 6.0;
    let across = cross_tangent(ring);
    let across_squared = across.dot(across);
    let (mut fit, mut weight) = (0.0, 0.0);
    for i in 1..s {
        let (sin, cos) = (i as f64 * angle).sin_cos();
        fit += sin * (inserted.edge(fan, i, 1) - fan.apex - cos * along).dot(across);
        weight += sin * sin;
    }
    let length = if across_squared > 0.0 { fit / (across_squared * weight) } else { 0.0 };
    fan.c = angle.cos();
    fan.tangents = (0..=s)
        .map(|i| {
            let (sin, cos) = (i as f64 * angle).sin_cos();
            fan.apex + cos * along + sin * length * across
        })
        .collect();
    fan.smoothed = true;
}

/// Direction of the limit tangent across a crease: the left eigenvector of the sector's matrix for the eigenvalue of
/// valence `2 s`. The commonly printed mask belongs to other boundary rules (`docs/methods/catmull_clark.md`, Changes
/// from the paper).
fn cross_tangent(ring: &Ring) -> Vec3 {
    let s = ring.diagonals.len();
    let theta = PI / s as f64;
    let kappa = Constants::new(2 * s as u32).kappa;
    let end = (theta.sin() * (4.0 + kappa) - 2.0 * (kappa + 2.0) / (theta / 2.0).tan()) / kappa;
    let mut sum = Vec3::ZERO;
    let mut total = 0.0;
    let mut add = |weight: f64, p: Vec3| {
        sum += weight * p;
        total += weight;
    };
    add(end, ring.edges[0]);
    add(end, ring.edges[s]);
    for i in 1..s {
        add(kappa * (i as f64 * theta).sin(), ring.edges[i]);
    }
    for (i, &diagonal) in ring.diagonals.iter().enumerate() {
        add((i as f64 * theta).sin() + ((i + 1) as f64 * theta).sin(), diagonal);
    }
    sum - total * ring.vertex
}

/// A corner keeps its place; tangents fan out evenly in the plane of the two sharp edges.
fn place_at_corner(fan: &mut Fan, ring: &Ring) {
    let s = fan.halfedges.len();
    fan.apex = ring.vertex;
    let (first, last) = ((ring.edges[0] - ring.vertex) / 3.0, (ring.edges[s] - ring.vertex) / 3.0);
    let inside = ring.edges[1..s].iter().fold(Vec3::ZERO, |sum, &e| sum + (e - ring.vertex));
    let mut opening = first.angle(last);
    if inside.dot(first + last) < 0.0 {
        opening = TAU - opening;
    }
    let [full, straight, folded] = [TAU, PI, 0.0].map(|angle| (opening - angle).abs() < CORNER_ANGLE_MARGIN);
    if full || straight || folded {
        return;
    }
    let angle = opening / s as f64;
    fan.c = angle.cos();
    fan.tangents = (0..=s)
        .map(|i| {
            let (from_last, from_first) = ((s - i) as f64 * angle, i as f64 * angle);
            fan.apex + (from_last.sin() * first + from_first.sin() * last) / opening.sin()
        })
        .collect();
    fan.smoothed = true;
}

/// Writes apex and tangents into the patches. Tangents of sharp edges stay as inserted but at a dart, where the
/// crease has to open in the common tangent plane.
pub(crate) fn write(fan: &Fan, arrays: &mut Arrays) {
    for i in 0..fan.halfedges.len() {
        arrays.set(fan, i, 0, 0, fan.apex);
    }
    if !fan.smoothed {
        return;
    }
    let edges = if fan.class == CornerClass::Dart { 0..fan.edge_count() } else { fan.smooth_edges() };
    for i in edges {
        arrays.set_edge(fan, i, 1, fan.tangents[i]);
    }
}
