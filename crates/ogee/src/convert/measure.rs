//! Figures of shells: continuity over edges, volume, area, extent.

use crate::math::{Grid, Vec3, par};
use crate::nurbs::{EdgeUse, KnotVector, NurbsSurface, Shell, Side, gauss};

/// Steps between two knots of either side, along an edge.
const STEPS_PER_SPAN: usize = 8;

/// Of the square of the longer one of `du` and `dv`, the area between them below which a point counts as singular: its
/// normal is noise. So it is where they are parallel, and where one of them vanishes, as at the cusp of a folded cage.
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

/// A shell that is measured as if it stood somewhere else, without a copy of it.
#[derive(Clone, Copy)]
pub(super) struct Moved<'a> {
    pub(super) shell: &'a Shell,
    pub(super) by: Vec3,
}

impl Moved<'_> {
    fn surface(self, face: usize) -> NurbsSurface {
        let mut surface = self.shell.faces[face].surface.clone();
        surface.net.cells_mut().iter_mut().for_each(|point| *point += self.by);
        surface
    }

    /// What is found on all faces or edges, a good number of them at a time.
    fn over<T: Send>(count: usize, of: impl Fn(usize) -> T + Sync + Send, mut take: impl FnMut(T)) {
        const AT_ONCE: usize = 1 << 16;
        for start in (0..count).step_by(AT_ONCE) {
            par::map(AT_ONCE.min(count - start), |i| of(start + i)).into_iter().for_each(&mut take);
        }
    }
}

/// A use of an edge: a face, and a place in its loop.
type Use = (u32, u32);

/// The two uses of each edge that has two.
fn uses(shell: &Shell) -> Vec<Option<[Use; 2]>> {
    const NONE: Use = (u32::MAX, 0);
    let mut uses = vec![([NONE; 2], 0u32); shell.edges.len()];
    for (number, face) in (0..).zip(&shell.faces) {
        for (place, used) in (0..).zip(&face.boundary) {
            let (of_edge, count) = &mut uses[used.edge as usize];
            if let Some(free) = of_edge.get_mut(*count as usize) {
                *free = (number, place);
            }
            *count += 1;
        }
    }
    uses.into_iter().map(|(of_edge, count)| (count == 2).then_some(of_edge)).collect()
}

/// Gaps, normal angles and curvature jumps over all shared edges.
pub(super) fn continuity(moved: Moved<'_>) -> Continuity {
    let shell = moved.shell;
    let uses = uses(shell);
    let of_edge = |edge: usize| {
        let Some(uses) = uses[edge] else { return Continuity::default() };
        let [(a, first), (b, second)] = uses.map(|(face, place)| {
            (moved.surface(face as usize), shell.faces[face as usize].boundary[place as usize])
        });
        across(&a, first, &b, second, shell.edges[edge].smooth)
    };
    let mut found = Continuity::default();
    Moved::over(uses.len(), of_edge, |edge| found = found.join(edge));
    found
}

fn across(a: &NurbsSurface, first: EdgeUse, b: &NurbsSurface, second: EdgeUse, smooth: bool) -> Continuity {
    let mut found = Continuity {
        smooth_edges: usize::from(smooth),
        sharp_edges: usize::from(!smooth),
        ..Continuity::default()
    };
    let at = |surface: &NurbsSurface, used: EdgeUse, t: f64| {
        let t = if used.forward == first.forward { t } else { 1.0 - t };
        let [from, to] = used.range;
        let (u, v) = surface.on_side(used.side, from + t * (to - from));
        surface.jet(u, v)
    };
    let stations = stations(a, first, b, second);
    for (k, &t) in stations.iter().enumerate() {
        let (here, there) = (at(a, first, t), at(b, second, t));
        found.max_gap = found.max_gap.max(here.position.distance(there.position));
        if !smooth {
            continue;
        }
        let (n, m) = (here.du.cross(here.dv), there.du.cross(there.dv));
        let regular = |n: Vec3, du: Vec3, dv: Vec3| n.length() > SINGULAR * du.dot(du).max(dv.dot(dv));
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

/// Where an edge is sampled, in `[0, 1]` along its first use: on all knots of both sides, and between them.
fn stations(a: &NurbsSurface, first: EdgeUse, b: &NurbsSurface, second: EdgeUse) -> Vec<f64> {
    let mut breaks = vec![0.0, 1.0];
    for (surface, used) in [(a, first), (b, second)] {
        let knots = surface.along(used.side).knots();
        let [from, to] = used.range;
        let inside = knots.iter().map(|knot| (knot - from) / (to - from)).filter(|t| (0.0..=1.0).contains(t));
        breaks.extend(inside.map(|t| if used.forward == first.forward { t } else { 1.0 - t }));
    }
    breaks.sort_by(f64::total_cmp);
    // Knots of both sides that differ by rounding are one.
    breaks.dedup_by(|next, kept| *next - *kept < 1e-9);
    let mut stations = vec![0.0];
    for span in breaks.windows(2) {
        let step = (span[1] - span[0]) / STEPS_PER_SPAN as f64;
        stations.extend((1..STEPS_PER_SPAN).map(|k| span[0] + k as f64 * step));
        stations.push(span[1]);
    }
    stations
}

/// Enclosed volume (meaningful for a closed shell) and area.
pub(super) fn volume_and_area(moved: Moved<'_>) -> (f64, f64) {
    let of_face = |face: usize| {
        let surface = moved.surface(face);
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
    };
    let mut sum = (0.0, 0.0);
    Moved::over(moved.shell.faces.len(), of_face, |face| sum = (sum.0 + face.0, sum.1 + face.1));
    sum
}

/// The bounding box of the surfaces themselves: extremes over samples, each climbed to its top.
pub(super) fn bounding_box(moved: Moved<'_>) -> Option<[Vec3; 2]> {
    let mut found: Option<[Vec3; 2]> = None;
    let of_face = |face: usize| surface_box(&moved.surface(face));
    Moved::over(moved.shell.faces.len(), of_face, |[low, high]| {
        found = Some(found.map_or([low, high], |[a, b]| [a.min(low), b.max(high)]));
    });
    found
}

fn surface_box(surface: &NurbsSurface) -> [Vec3; 2] {
    const PER_SPAN: usize = 3;
    let stations = |knots: &KnotVector| {
        let mut out = vec![knots.domain()[0]];
        for span in knots.spans() {
            let (low, high) = (knots.knots()[span], knots.knots()[span + 1]);
            out.extend((1..=PER_SPAN).map(|k| low + (high - low) * k as f64 / PER_SPAN as f64));
        }
        out
    };
    let (us, vs) = (stations(&surface.u), stations(&surface.v));
    let (bases_u, bases_v): (Vec<_>, Vec<_>) =
        (us.iter().map(|&u| surface.u.basis(u)).collect(), vs.iter().map(|&v| surface.v.basis(v)).collect());
    let samples =
        Grid::from_fn(us.len(), vs.len(), |i, j| surface.tangents_from(&bases_u[i], &bases_v[j])[0]);
    let [low, high] =
        samples.cells().iter().fold([samples[(0, 0)]; 2], |[low, high], &p| [low.min(p), high.max(p)]);
    // What a sample can be short of its hill: generous, since a wrong box is worse than a few steps more.
    let slack = low.distance(high) / 10.0;
    let mut found = [low, high];
    for (side, sign) in [(0, -1.0), (1, 1.0)] {
        let extreme = |axis: usize| {
            let value = |i: usize, j: usize| sign * samples[(i, j)][axis];
            let mut best = sign * found[side][axis];
            let least = best - slack;
            for i in 0..us.len() {
                for j in 0..vs.len() {
                    let around = [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)];
                    let is_top = around
                        .into_iter()
                        .filter(|&(i, j)| i < us.len() && j < vs.len())
                        .all(|(x, y)| value(x, y) <= value(i, j));
                    if is_top && value(i, j) >= least {
                        best = best.max(climb(surface, (us[i], vs[j]), axis, sign));
                    }
                }
            }
            sign * best
        };
        found[side] = Vec3::new(extreme(0), extreme(1), extreme(2));
    }
    found
}

/// The top of the hill of `sign` times a coordinate near given parameters, by Newton's steps where the hill is round
/// and steepest ascent where it is not; on a side of the patch along that side.
fn climb(surface: &NurbsSurface, start: (f64, f64), axis: usize, sign: f64) -> f64 {
    const STEPS: usize = 24;
    const HALVINGS: usize = 8;
    let ([u0, u1], [v0, v1]) = (surface.u.domain(), surface.v.domain());
    let (mut u, mut v) = start;
    let mut jet = surface.jet(u, v);
    for _ in 0..STEPS {
        let (mut gu, mut gv) = (sign * jet.du[axis], sign * jet.dv[axis]);
        let (a, b, c) = (sign * jet.duu[axis], sign * jet.duv[axis], sign * jet.dvv[axis]);
        let held_u = u == u0 && gu < 0.0 || u == u1 && gu > 0.0;
        let held_v = v == v0 && gv < 0.0 || v == v1 && gv > 0.0;
        if held_u {
            gu = 0.0;
        }
        if held_v {
            gv = 0.0;
        }
        if gu == 0.0 && gv == 0.0 {
            break;
        }
        let steepest = {
            // About a third of a quad at first.
            let length = gu.hypot(gv);
            (gu / length / 3.0, gv / length / 3.0)
        };
        let determinant = a * c - b * b;
        let (du, dv) = match (held_u, held_v) {
            (true, _) if c < 0.0 => (0.0, -gv / c),
            (_, true) if a < 0.0 => (-gu / a, 0.0),
            (false, false) if a < 0.0 && determinant > 0.0 => {
                (-(c * gu - b * gv) / determinant, -(a * gv - b * gu) / determinant)
            }
            _ => steepest,
        };
        let value = sign * jet.position[axis];
        let mut scale = 1.0;
        let mut gained = false;
        for _ in 0..HALVINGS {
            let (next_u, next_v) = ((u + scale * du).clamp(u0, u1), (v + scale * dv).clamp(v0, v1));
            let next = surface.jet(next_u, next_v);
            if sign * next.position[axis] > value {
                (u, v, jet, gained) = (next_u, next_v, next, true);
                break;
            }
            scale /= 2.0;
        }
        if !gained {
            break;
        }
    }
    sign * jet.position[axis]
}
