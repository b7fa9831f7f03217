//! Bodies: closed shells become solids, closed shells inside them voids, open ones sheets.

use super::measure::{bounding_box, volume_and_area};
use super::part::Body;
use crate::math::Vec3;
use crate::mesh::{Note, Place};
use crate::nurbs::Shell;

/// Cells a side into which a quad is cut to ask whether a point is inside a shell.
const CELLS: usize = 6;

/// Sorts shells into bodies, and turns those round that face the wrong way. The order is that of the shells.
pub(super) fn bodies(shells: Vec<Shell>, notes: &mut Vec<Note>) -> Vec<Body> {
    let depths = nesting_depths(&shells);
    let oriented: Vec<(Shell, Option<usize>)> = shells
        .into_iter()
        .zip(depths)
        .map(|(shell, depth)| match depth {
            Some(depth) => (outward(shell, depth, notes), Some(depth)),
            None => (shell, None),
        })
        .collect();
    let outers: Vec<usize> =
        (0..oriented.len()).filter(|&i| matches!(oriented[i].1, Some(d) if d % 2 == 0)).collect();
    // A void belongs to the innermost solid around it.
    let owner = |inner: usize| {
        let depth = oriented[inner].1?;
        let around = outers.iter().copied().filter(|&o| oriented[o].1 == Some(depth - 1));
        around.into_iter().find(|&o| contains(&oriented[o].0, first_point(&oriented[inner].0)))
    };
    let owners: Vec<Option<usize>> =
        (0..oriented.len()).map(|i| if outers.contains(&i) { None } else { owner(i) }).collect();
    let mut out: Vec<(usize, Body)> = Vec::new();
    let mut voids: Vec<(usize, Shell)> = Vec::new();
    for (number, (shell, depth)) in oriented.into_iter().enumerate() {
        match (depth, owners[number]) {
            (None, _) => out.push((number, Body::Sheet(shell))),
            (Some(_), Some(owner)) => voids.push((owner, shell)),
            (Some(_), None) => out.push((number, Body::Solid { outer: shell, voids: Vec::new() })),
        }
    }
    for (owner, void) in voids {
        if let Some((_, Body::Solid { voids, .. })) = out.iter_mut().find(|(number, _)| *number == owner) {
            voids.push(void);
        }
    }
    out.into_iter().map(|(_, body)| body).collect()
}

/// A closed shell with positive volume.
fn outward(shell: Shell, depth: usize, notes: &mut Vec<Note>) -> Shell {
    let face = shell.faces[0].address().face.0;
    let inside_out = volume_and_area(&shell).0 < 0.0;
    let mut note = |code, message| notes.push(Note { code, message, place: Some(Place::Face(face)) });
    match (inside_out, depth % 2) {
        (true, 0) => {
            note("inside_out", format!("the faces connected with face {face} looked inward: turned round"))
        }
        (_, 1) => note("void", format!("the shell of face {face} lies inside another: taken as a hollow")),
        _ => {}
    }
    if inside_out { shell.reversed() } else { shell }
}

/// For each closed shell the number of closed shells around it; `None` for open ones.
fn nesting_depths(shells: &[Shell]) -> Vec<Option<usize>> {
    let closed: Vec<bool> = shells.iter().map(Shell::is_closed).collect();
    if closed.iter().filter(|&&closed| closed).count() < 2 {
        return closed.into_iter().map(|closed| closed.then_some(0)).collect();
    }
    let boxes: Vec<Option<[Vec3; 2]>> = shells.iter().map(bounding_box).collect();
    let is_inside = |inner: usize, outer: usize| {
        let (Some([a, b]), Some([low, high])) = (boxes[inner], boxes[outer]) else { return false };
        low.min(a) == low && high.max(b) == high && contains(&shells[outer], first_point(&shells[inner]))
    };
    (0..shells.len())
        .map(|i| {
            closed[i].then(|| (0..shells.len()).filter(|&o| o != i && closed[o] && is_inside(i, o)).count())
        })
        .collect()
}

fn first_point(shell: &Shell) -> Vec3 {
    shell.faces[0].surface.net[(0, 0)]
}

/// The winding number of a shell around a point, by the solid angles of a triangulation.
fn contains(shell: &Shell, point: Vec3) -> bool {
    let mut angle = 0.0;
    for face in &shell.faces {
        let surface = &face.surface;
        let steps = (face.quads.rows() * CELLS, face.quads.cols() * CELLS);
        let ([u0, u1], [v0, v1]) = (surface.u.domain(), surface.v.domain());
        let at = |i: usize, j: usize| {
            let (s, t) = (i as f64 / steps.0 as f64, j as f64 / steps.1 as f64);
            surface.jet(u0 + s * (u1 - u0), v0 + t * (v1 - v0)).position - point
        };
        for i in 0..steps.0 {
            for j in 0..steps.1 {
                let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                angle += solid_angle(a, b, c) + solid_angle(a, c, d);
            }
        }
    }
    angle.abs() > 2.0 * std::f64::consts::PI
}

/// Van Oosterom and Strackee, The solid angle of a plane triangle (1983).
fn solid_angle(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let (x, y, z) = (a.length(), b.length(), c.length());
    let numerator = a.dot(b.cross(c));
    let denominator = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    2.0 * numerator.atan2(denominator)
}
