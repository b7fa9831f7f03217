//! Figures of shells: continuity over edges, volume, area, extent.

use crate::math::{Vec3, par};
use crate::nurbs::{EdgeUse, KnotVector, Shell, ShellFace, Side, gauss};

/// Samples of position and normal along an edge: so many on each of its end quads, where smoothing was at work, ends
/// included, and fewer on each quad between.
const SAMPLES_AT_ENDS: usize = 33;
const SAMPLES_BETWEEN: usize = 4;

/// Sine of the angle between `du` and `dv` below which a corner counts as singular: its normal is noise.
const SINGULAR: f64 = 1e-9;

/// What is measured over the shared edges of a shell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Continuity {
    pub(super) max_gap: f64,
    /// Radians.
    pub(super) max_normal_angle: f64,
    pub(super) max_curvature_jump: f64,
    pub(super) smooth_edges: usize,
    pub(super) sharp_edges: usize,
}

impl Continuity {
    pub(super) fn join(self, other: Continuity) -> Continuity {
        Continuity {
            max_gap: self.max_gap.max(other.max_gap),
            max_normal_angle: self.max_normal_angle.max(other.max_normal_angle),
            max_curvature_jump: self.max_curvature_jump.max(other.max_curvature_jump),
            smooth_edges: self.smooth_edges + other.smooth_edges,
            sharp_edges: self.sharp_edges + other.sharp_edges,
        }
    }
}

/// Gaps, normal angles and curvature jumps over all shared edges.
pub(super) fn continuity(shell: &Shell) -> Continuity {
    let mut uses: Vec<Vec<(usize, EdgeUse)>> = vec![Vec::new(); shell.edges.len()];
    for (face, boundary) in shell.faces.iter().map(|face| &face.boundary).enumerate() {
        for used in boundary {
            uses[used.edge as usize].push((face, *used));
        }
    }
    let edges = par::map(uses.len(), |edge| match uses[edge][..] {
        [(a, first), (b, second)] => {
            let smooth = shell.edges[edge].smooth;
            across(&shell.faces[a], first, &shell.faces[b], second, smooth)
        }
        _ => Continuity::default(),
    });
    edges.into_iter().fold(Continuity::default(), Continuity::join)
}

fn across(a: &ShellFace, first: EdgeUse, b: &ShellFace, second: EdgeUse, smooth: bool) -> Continuity {
    let mut found = Continuity {
        smooth_edges: usize::from(smooth),
        sharp_edges: usize::from(!smooth),
        ..Continuity::default()
    };
    let at = |face: &ShellFace, used: EdgeUse, t: f64| {
        let t = if used.forward == first.forward { t } else { 1.0 - t };
        let [from, to] = used.range;
        let (u, v) = face.surface.on_side(used.side, from + t * (to - from));
        face.surface.jet(u, v)
    };
    let stations = stations((first.range[1] - first.range[0]).abs());
    for (k, &t) in stations.iter().enumerate() {
        let (here, there) = (at(a, first, t), at(b, second, t));
        found.max_gap = found.max_gap.max(here.position.distance(there.position));
        if !smooth {
            continue;
        }
        let (n, m) = (here.du.cross(here.dv), there.du.cross(there.dv));
        let regular = |n: Vec3, du: Vec3, dv: Vec3| n.length() > SINGULAR * du.length() * dv.length();
        if regular(n, here.du, here.dv) && regular(m, there.du, there.dv) {
            found.max_normal_angle = found.max_normal_angle.max(n.angle(m));
        }
        // Between samples, which are on knots: there the curvature along the edge has two values.
        let Some(&next) = stations.get(k + 1) else { break };
        let between = (t + next) / 2.0;
        let (here, there) = (at(a, first, between), at(b, second, between));
        let Some(normal) = here.normal() else { continue };
        let along = match first.side {
            Side::V0 | Side::V1 => here.du,
            Side::U0 | Side::U1 => here.dv,
        };
        let perpendicular = normal.cross(along);
        let curvatures =
            (here.normal_curvature(normal, perpendicular), there.normal_curvature(normal, perpendicular));
        if let (Some(p), Some(q)) = curvatures {
            found.max_curvature_jump = found.max_curvature_jump.max((p - q).abs());
        }
    }
    found
}

/// Where an edge of so many quads is sampled, in `[0, 1]`.
fn stations(quads: f64) -> Vec<f64> {
    let steps = (SAMPLES_AT_ENDS - 1) as f64;
    if quads <= 2.0 {
        let steps = (steps * quads).round();
        return (0..=steps as u32).map(|k| f64::from(k) / steps).collect();
    }
    let at_start = (0..SAMPLES_AT_ENDS - 1).map(|k| k as f64 / steps);
    let between = (SAMPLES_BETWEEN as f64 * (quads - 2.0)).round();
    let middle = (0..between as u32).map(|k| 1.0 + (quads - 2.0) * f64::from(k) / between);
    let at_end = (0..SAMPLES_AT_ENDS).map(|k| quads - 1.0 + k as f64 / steps);
    at_start.chain(middle).chain(at_end).map(|t| t / quads).collect()
}

/// Enclosed volume (meaningful for a closed shell) and area.
pub(super) fn volume_and_area(shell: &Shell) -> (f64, f64) {
    let faces = par::map(shell.faces.len(), |face| {
        let surface = &shell.faces[face].surface;
        // S . (Su x Sv) has degree 3 p - 1 along u: that many points are exact for the volume.
        let points = (3 * surface.u.degree().max(surface.v.degree())).div_ceil(2) + 1;
        let nodes = gauss(points);
        let stations = |knots: &KnotVector| {
            let mut out = Vec::new();
            for span in knots.spans() {
                let (low, high) = (knots.knots()[span], knots.knots()[span + 1]);
                for &(node, weight) in &nodes {
                    let t = (low + high) / 2.0 + (high - low) / 2.0 * node;
                    out.push((knots.basis_on(span, t), weight * (high - low) / 2.0));
                }
            }
            out
        };
        let (us, vs) = (stations(&surface.u), stations(&surface.v));
        let (mut volume, mut area) = (0.0, 0.0);
        for (u, wu) in &us {
            for (v, wv) in &vs {
                let [position, du, dv] = surface.tangents_from(u, v);
                let normal = du.cross(dv);
                volume += wu * wv * position.dot(normal) / 3.0;
                area += wu * wv * normal.length();
            }
        }
        (volume, area)
    });
    faces.into_iter().fold((0.0, 0.0), |sum, face| (sum.0 + face.0, sum.1 + face.1))
}

/// The bounding box of the surfaces themselves: extremes over samples, sharpened by Newton's method.
pub(super) fn bounding_box(shell: &Shell) -> Option<[Vec3; 2]> {
    let boxes = par::map(shell.faces.len(), |face| face_box(&shell.faces[face]));
    boxes.into_iter().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

fn face_box(face: &ShellFace) -> [Vec3; 2] {
    const PER_SPAN: usize = 4;
    let surface = &face.surface;
    let stations = |knots: &KnotVector| {
        let mut out = vec![knots.domain()[0]];
        for span in knots.spans() {
            let (low, high) = (knots.knots()[span], knots.knots()[span + 1]);
            out.extend((1..=PER_SPAN).map(|k| low + (high - low) * k as f64 / PER_SPAN as f64));
        }
        out
    };
    let (us, vs) = (stations(&surface.u), stations(&surface.v));
    let start = surface.jet(us[0], vs[0]).position;
    let mut extremes = [[(start, us[0], vs[0]); 3]; 2];
    for &u in &us {
        for &v in &vs {
            let p = surface.jet(u, v).position;
            for axis in 0..3 {
                if p[axis] < extremes[0][axis].0[axis] {
                    extremes[0][axis] = (p, u, v);
                }
                if p[axis] > extremes[1][axis].0[axis] {
                    extremes[1][axis] = (p, u, v);
                }
            }
        }
    }
    let sharpened = |side: usize, axis: usize| {
        let (p, u, v) = extremes[side][axis];
        let better = sharpen(face, u, v, axis);
        if side == 0 { better.min(p[axis]) } else { better.max(p[axis]) }
    };
    [0, 1].map(|side| Vec3::new(sharpened(side, 0), sharpened(side, 1), sharpened(side, 2)))
}

/// A few Newton steps towards the extreme of a coordinate near a sample.
fn sharpen(face: &ShellFace, mut u: f64, mut v: f64, axis: usize) -> f64 {
    let surface = &face.surface;
    let ([u0, u1], [v0, v1]) = (surface.u.domain(), surface.v.domain());
    let mut value = surface.jet(u, v).position[axis];
    for _ in 0..6 {
        let jet = surface.jet(u, v);
        let (gu, gv) = (jet.du[axis], jet.dv[axis]);
        let (a, b, c) = (jet.duu[axis], jet.duv[axis], jet.dvv[axis]);
        let determinant = a * c - b * b;
        if determinant <= 0.0 {
            break;
        }
        u = (u - (c * gu - b * gv) / determinant).clamp(u0, u1);
        v = (v - (a * gv - b * gu) / determinant).clamp(v0, v1);
        value = surface.jet(u, v).position[axis];
    }
    value
}
