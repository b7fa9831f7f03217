//! Bodies: closed shells become solids, closed shells inside them voids, open ones sheets.

use super::measure::{Moved, volume_and_area};
use super::part::Body;
use crate::math::{Grid, Vec3, par};
use crate::mesh::{Note, Place};
use crate::nurbs::Shell;

/// Cells a side into which a quad is cut to ask whether a point is inside a shell.
const CELLS: usize = 6;

/// Pairs of samples whose middle is tried as a point deep inside a shell.
const TRIALS: usize = 24;

/// Sorts shells into bodies, and turns those round that face the wrong way. The order is that of the shells.
pub(super) fn bodies(shells: Vec<Shell>, notes: &mut Vec<Note>) -> Vec<Body> {
    let around = shells_around(&shells);
    let depth = |i: usize| around[i].as_ref().map(Vec::len);
    // A void belongs to the innermost solid around it.
    let owner = |inner: usize| {
        let around = around[inner].as_ref().filter(|around| around.len() % 2 == 1)?;
        around.iter().copied().find(|&outer| depth(outer) == Some(around.len() - 1))
    };
    let mut out: Vec<(usize, Body)> = Vec::new();
    let mut voids: Vec<(usize, Shell)> = Vec::new();
    for (number, shell) in shells.into_iter().enumerate() {
        match (depth(number), owner(number)) {
            (None, _) => out.push((number, Body::Sheet(shell))),
            (Some(depth), Some(owner)) => voids.push((owner, outward(shell, depth, notes))),
            (Some(depth), None) => {
                out.push((number, Body::Solid { outer: outward(shell, depth, notes), voids: Vec::new() }));
            }
        }
    }
    for (owner, void) in voids {
        let found = out.binary_search_by_key(&owner, |(number, _)| *number).map(|at| &mut out[at].1);
        if let Ok(Body::Solid { voids, .. }) = found {
            voids.push(void);
        }
    }
    out.into_iter().map(|(_, body)| body).collect()
}

/// A closed shell with positive volume.
fn outward(mut shell: Shell, depth: usize, notes: &mut Vec<Note>) -> Shell {
    let face = shell.faces[0].address().face.0;
    let inside_out = volume_and_area(Moved { shell: &shell, by: Vec3::ZERO }).0 < 0.0;
    let mut note = |code, message| notes.push(Note { code, message, place: Some(Place::Face(face)) });
    match (inside_out, depth % 2) {
        (true, 0) => {
            note("inside_out", format!("the faces connected with face {face} looked inward: turned round"))
        }
        (_, 1) => note("void", format!("the shell of face {face} lies inside another: taken as a hollow")),
        _ => {}
    }
    if inside_out {
        shell.reverse();
    }
    shell
}

/// For each closed shell the closed shells around it; `None` for open ones.
fn shells_around(shells: &[Shell]) -> Vec<Option<Vec<usize>>> {
    let closed: Vec<usize> = (0..shells.len()).filter(|&i| shells[i].is_closed()).collect();
    let mut around: Vec<Option<Vec<usize>>> = vec![None; shells.len()];
    for &i in &closed {
        around[i] = Some(Vec::new());
    }
    if closed.len() < 2 {
        return around;
    }
    let solids = par::map(closed.len(), |i| Sampled::new(&shells[closed[i]]));
    let found = par::map(closed.len(), |i| {
        let inner = &solids[i];
        let candidates = (0..closed.len()).filter(|&o| o != i && solids[o].boxes_in(inner));
        let mut point = None;
        candidates
            .filter(|&o| solids[o].contains(*point.get_or_insert_with(|| inner.deep_point())))
            .map(|o| closed[o])
            .collect::<Vec<usize>>()
    });
    for (i, found) in closed.into_iter().zip(found) {
        around[i] = Some(found);
    }
    around
}

/// A closed shell as triangles.
struct Sampled {
    low: Vec3,
    high: Vec3,
    grids: Vec<Grid<Vec3>>,
}

impl Sampled {
    fn new(shell: &Shell) -> Sampled {
        let grids = shell.faces.iter().map(|face| {
            let surface = &face.surface;
            let steps = (face.quads.rows() * CELLS, face.quads.cols() * CELLS);
            let ([u0, u1], [v0, v1]) = (surface.u.domain(), surface.v.domain());
            Grid::from_fn(steps.0 + 1, steps.1 + 1, |i, j| {
                let (s, t) = (i as f64 / steps.0 as f64, j as f64 / steps.1 as f64);
                surface.jet(u0 + s * (u1 - u0), v0 + t * (v1 - v0)).position
            })
        });
        let grids: Vec<Grid<Vec3>> = grids.collect();
        let first = grids[0][(0, 0)];
        let points = grids.iter().flat_map(|grid| grid.cells());
        let (low, high) = points.fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
        Sampled { low, high, grids }
    }

    /// True if the box of `inner` lies inside that of this shell.
    fn boxes_in(&self, inner: &Sampled) -> bool {
        self.low.min(inner.low) == self.low && self.high.max(inner.high) == self.high
    }

    /// A point well inside: thin walls keep the shells apart there. Of the middles of some pairs of samples the one
    /// inside that is farthest from all samples; where none is inside, a sample.
    fn deep_point(&self) -> Vec3 {
        let samples: Vec<Vec3> = self.grids.iter().map(|grid| grid[(0, 0)]).collect();
        let count = samples.len();
        let mut best = (0.0, samples[0]);
        for trial in 0..TRIALS.min(count * count) {
            // Spread over the list, near and far partners alike.
            let (i, j) = (trial * count / TRIALS, (trial * count / TRIALS + count / 2 + trial % 3) % count);
            let middle = samples[i].lerp(samples[j], 0.5);
            let near = samples.iter().map(|&p| p.distance(middle)).fold(f64::INFINITY, f64::min);
            if near > best.0 && self.contains(middle) {
                best = (near, middle);
            }
        }
        best.1
    }

    /// The winding number around a point, by solid angles.
    fn contains(&self, point: Vec3) -> bool {
        let mut angle = 0.0;
        for grid in &self.grids {
            for i in 0..grid.rows() - 1 {
                for j in 0..grid.cols() - 1 {
                    let at = |i: usize, j: usize| grid[(i, j)] - point;
                    let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                    angle += solid_angle(a, b, c) + solid_angle(a, c, d);
                }
            }
        }
        angle.abs() > 2.0 * std::f64::consts::PI
    }
}

/// Van Oosterom and Strackee, The solid angle of a plane triangle (1983).
fn solid_angle(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let (x, y, z) = (a.length(), b.length(), c.length());
    let numerator = a.dot(b.cross(c));
    let denominator = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * numerator.atan2(denominator)
}
