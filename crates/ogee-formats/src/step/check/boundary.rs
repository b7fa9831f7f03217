//! Which loop goes around the parameter rectangle of a surface, and how far it strays.
//!
//! Every edge of a loop is tried on every side of the rectangle; of all the ways to string the places together
//! head to tail, the one that strays least is taken. So seams (two sides on one edge), sides cut by T's, and
//! sides without length find their place without special cases.

use ogee::Vec3;

use super::edges::Path;
use super::spline::{Curve, Surface};

/// Ends of edges this far from a row, as a share of the surface's size, still belong to it: a file with a
/// moved pole is to be recognised before it is refused.
const NEAR: f64 = 5e-2;

/// A loop of more than four edges that strays so far from the boundary, as a share of the surface's size, was
/// meant to follow it; one that strays further is trimmed.
const SLIGHT: f64 = 1e-3;

/// A use of an edge: its path, and whether it is followed.
pub(super) struct Step<'p, 's> {
    pub(super) path: &'p Path<'s>,
    pub(super) forward: bool,
}

impl Step<'_, '_> {
    /// The point at the share `s` of the way.
    pub(super) fn at(&self, s: f64) -> Vec3 {
        self.path.at(if self.forward { s } else { 1.0 - s })
    }
}

/// An edge on a side.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    side: usize,
    /// Parameter points in [0, 1] x [0, 1] where it is entered and left.
    from: [f64; 2],
    to: [f64; 2],
    /// The largest distance from the row.
    stray: f64,
}

/// A loop that goes around a surface.
#[derive(Debug)]
pub(super) struct Round {
    /// Twice the area that it encloses in the unit square: 2 counter-clockwise, -2 clockwise.
    pub(super) area: f64,
    /// How far each edge strays from the boundary.
    pub(super) strays: Vec<f64>,
    /// True if the corners of the surface are met, but for one that was moved perhaps: a loop that strays was
    /// meant to follow the boundary nevertheless.
    pub(super) cornered: bool,
}

/// The length that measures a surface: the diagonal of the box of its coefficients.
pub(super) fn size(surface: &Surface) -> f64 {
    let cells = surface.net.cells();
    let least = cells.iter().copied().fold(cells[0], Vec3::min);
    let greatest = cells.iter().copied().fold(cells[0], Vec3::max);
    least.distance(greatest)
}

/// Lays a loop around the surface; `None` if it does not follow the boundary: the face is trimmed.
pub(super) fn lay(surface: &Surface, steps: &[Step<'_, '_>], tolerance: f64) -> Option<Round> {
    let rows = surface.rows();
    let near = NEAR * size(surface);
    let collapsed: Vec<bool> = rows.iter().map(|row| row.is_a_point(tolerance)).collect();
    let mut candidates = Vec::with_capacity(steps.len());
    for step in steps {
        let mut places = Vec::new();
        for (side, row) in rows.iter().enumerate().filter(|&(side, _)| !collapsed[side]) {
            try_side(step, side, row, near, tolerance, &mut places);
        }
        if places.is_empty() {
            return None;
        }
        candidates.push(places);
    }
    let chosen = string_together(&candidates, &collapsed, tolerance)?;
    let area: f64 = (0..chosen.len())
        .map(|k| {
            let (a, b, c) = (chosen[k].from, chosen[k].to, chosen[(k + 1) % chosen.len()].from);
            a[0] * b[1] - a[1] * b[0] + b[0] * c[1] - b[1] * c[0]
        })
        .sum();
    if area.abs() < 1.5 {
        return None;
    }
    let strays: Vec<f64> = chosen.iter().map(|place| place.stray).collect();
    let [[a, b], [d, c]] = [rows[0].ends(), rows[2].ends()];
    let meeting = |corner: Vec3, within: f64| {
        steps.iter().filter(|step| step.at(0.0).distance(corner) <= within).count()
    };
    let missed: Vec<Vec3> =
        [a, b, c, d].into_iter().filter(|&corner| meeting(corner, tolerance) == 0).collect();
    // With a side for each edge nothing but the boundary can be meant.
    let square = steps.len() == 4 && (0..4).all(|side| chosen.iter().any(|place| place.side == side));
    let slight = SLIGHT * size(surface);
    let cornered = match missed[..] {
        [] => true,
        // A corner that was moved has one vertex beside it, one that was cut off has two.
        [corner] => square || meeting(corner, slight) == 1,
        _ => false,
    };
    let followed = strays.iter().all(|&stray| stray <= slight) || (square && cornered);
    followed.then_some(Round { area, strays, cornered })
}

/// The ways in which an edge can lie on a side.
fn try_side(
    step: &Step<'_, '_>,
    side: usize,
    row: &Curve,
    near: f64,
    tolerance: f64,
    places: &mut Vec<Candidate>,
) {
    let entered = parameters(row, step.at(0.0), near, tolerance);
    if entered.is_empty() {
        return;
    }
    let left = parameters(row, step.at(1.0), near, tolerance);
    let [a, b] = row.knots.domain();
    for &from in &entered {
        for &to in left.iter().filter(|&&to| to != from) {
            let square = |t: f64| {
                let t = (t - a) / (b - a);
                [[t, 0.0], [1.0, t], [t, 1.0], [0.0, t]][side]
            };
            let stray = stray(step, row, [from, to], tolerance);
            places.push(Candidate { side, from: square(from), to: square(to), stray });
        }
    }
}

/// The parameters of a row at which it meets a point: both ends where it is closed.
fn parameters(row: &Curve, point: Vec3, near: f64, tolerance: f64) -> Vec<f64> {
    let domain = row.knots.domain();
    let ends = row.ends();
    let mut found: Vec<f64> =
        (0..2).filter(|&k| ends[k].distance(point) <= tolerance).map(|k| domain[k]).collect();
    if found.is_empty() {
        // The row lies in the box of its coefficients.
        let outside = |axis: usize| {
            let along = row.points.iter().map(|p| p[axis]);
            let least = along.clone().fold(f64::INFINITY, f64::min);
            point[axis] < least - near || point[axis] > along.fold(f64::NEG_INFINITY, f64::max) + near
        };
        if (0..3).any(outside) {
            return found;
        }
        let (t, distance) = row.closest(point, domain);
        if distance <= near {
            found.push(t);
        }
    }
    found
}

/// The largest distance of an edge from a piece of a row. Two curves of one form are compared as they are;
/// others as sets of points, since they may run at different speeds.
fn stray(step: &Step<'_, '_>, row: &Curve, [from, to]: [f64; 2], tolerance: f64) -> f64 {
    let spans = step.path.curve.knots.breaks().len() + row.knots.breaks().len();
    let degree = row.knots.degree.max(step.path.curve.knots.degree);
    let count = (2 * spans * degree).clamp(8, 400);
    let samples = || {
        (0..=count).map(|k| {
            let s = k as f64 / count as f64;
            (step.at(s), from * (1.0 - s) + to * s)
        })
    };
    let apart = samples().map(|(point, t)| row.at(t).distance(point)).fold(0.0, f64::max);
    if apart <= tolerance || same_form(step, row, [from, to]) {
        return apart;
    }
    samples()
        .map(|(point, t)| {
            let guess = row.newton(point, (t, row.at(t).distance(point)), [from, to]);
            if guess.1 <= tolerance { guess.1 } else { guess.1.min(row.closest(point, [from, to]).1) }
        })
        .fold(0.0, f64::max)
}

/// True if edge and row are whole splines of the same degree and, but for scale and direction, the same knots.
fn same_form(step: &Step<'_, '_>, row: &Curve, [from, to]: [f64; 2]) -> bool {
    let [a, b] = row.knots.domain();
    let (one, other) = (&step.path.curve.knots, &row.knots);
    let whole = step.path.whole && from.min(to) == a && from.max(to) == b;
    if !whole || one.degree != other.degree || one.knots.len() != other.knots.len() || one.degree < 2 {
        return false;
    }
    let [c, d] = step.path.range;
    let [c, d] = if step.forward { [c, d] } else { [d, c] };
    // The affine map from the edge's parameters to the row's.
    let image = |t: f64| from + (to - from) * (t - c) / (d - c);
    let mut images: Vec<f64> = one.knots.iter().map(|&knot| image(knot)).collect();
    images.sort_by(f64::total_cmp);
    images.iter().zip(&other.knots).all(|(x, y)| (x - y).abs() <= 1e-9 * (b - a))
}

/// One candidate for every edge, so that each begins where the one before it ends, with the least sum of
/// strays.
fn string_together(
    candidates: &[Vec<Candidate>],
    collapsed: &[bool],
    tolerance: f64,
) -> Option<Vec<Candidate>> {
    let jump = |one: &Candidate, other: &Candidate| {
        let jumps = [0, 1].map(|axis| (one.to[axis] - other.from[axis]).abs());
        let on_one_collapsed = (0..4).any(|side| {
            let on = |place: [f64; 2]| place[[1, 0, 1, 0][side]] == [0.0, 1.0, 1.0, 0.0][side];
            collapsed[side] && on(one.to) && on(other.from)
        });
        if on_one_collapsed {
            Some(0.0)
        } else if jumps.iter().all(|&jump| jump <= NEAR) {
            Some((jumps[0] + jumps[1]) * tolerance)
        } else {
            None
        }
    };
    let mut best: Option<(f64, Vec<usize>)> = None;
    for first in 0..candidates[0].len() {
        // The least cost of reaching each candidate, and from where.
        let mut costs: Vec<Option<f64>> = vec![None; candidates[0].len()];
        costs[first] = Some(candidates[0][first].stray);
        let mut origins: Vec<Vec<usize>> = vec![vec![first; candidates[0].len()]];
        for pair in candidates.windows(2) {
            let step = pair[1].iter().map(|next| {
                let reach =
                    |(i, one): (usize, &Candidate)| Some((costs[i]? + jump(one, next)? + next.stray, i));
                pair[0].iter().enumerate().filter_map(reach).min_by(|a, b| a.0.total_cmp(&b.0))
            });
            let step: Vec<Option<(f64, usize)>> = step.collect();
            origins.push(step.iter().map(|reached| reached.map_or(0, |(_, origin)| origin)).collect());
            costs = step.iter().map(|reached| reached.map(|(cost, _)| cost)).collect();
        }
        let lasts = candidates.last()?;
        let closing =
            |(i, last): (usize, &Candidate)| Some((costs[i]? + jump(last, &candidates[0][first])?, i));
        let end = lasts.iter().enumerate().filter_map(closing).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((cost, mut at)) = end else { continue };
        if best.as_ref().is_none_or(|(least, _)| cost < *least) {
            let mut chain = vec![at; candidates.len()];
            for k in (1..candidates.len()).rev() {
                at = origins[k][at];
                chain[k - 1] = at;
            }
            best = Some((cost, chain));
        }
    }
    let (_, chain) = best?;
    Some(chain.into_iter().zip(candidates).map(|(i, places)| places[i]).collect())
}
