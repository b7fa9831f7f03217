//! At meetings of curves the surface is evaluated exactly: it contains the curves, and one step of refinement has the same
//! surface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use golden::{index, list, points};
use networks::{along, cases, prepared};
use ogee::{ControlMesh, FaceId, Flags, Level, LimitSurface, PatchTable, Vec3};

/// Points with no order in the meetings' rings, which any rule would forgive.
fn shaken(mesh: &ControlMesh) -> ControlMesh {
    let mut mesh = mesh.clone();
    let size = mesh.size();
    for (i, p) in mesh.points.iter_mut().enumerate() {
        let t = i as f64;
        *p += 0.02 * size * Vec3::new((3.7 * t).sin(), (1.9 * t + 1.0).sin(), (2.3 * t + 2.0).sin());
    }
    mesh
}

/// The natural uniform spline at `u`, periodic where it is closed.
fn spline(control: &[Vec3], closed: bool, u: f64) -> Vec3 {
    let n = control.len() as isize;
    let at = |i: isize| {
        if closed {
            control[i.rem_euclid(n) as usize]
        } else if i < 0 {
            2.0 * control[0] - control[1]
        } else if i >= n {
            2.0 * control[n as usize - 1] - control[n as usize - 2]
        } else {
            control[i as usize]
        }
    };
    let i = (u.floor() as isize).min(if closed { n - 1 } else { n - 2 });
    let t = u - i as f64;
    let s = 1.0 - t;
    (1.0 / 6.0)
        * (s * s * s * at(i - 1)
            + (3.0 * t * t * t - 6.0 * t * t + 4.0) * at(i)
            + (3.0 * s * s * s - 6.0 * s * s + 4.0) * at(i + 1)
            + t * t * t * at(i + 2))
}

#[test]
fn curves_lie_on_the_surface() {
    for (name, document) in cases() {
        let mesh = prepared(&document["prepared"]);
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        for segment in list(&document["prepared"]["segments"]) {
            let path: Vec<u32> = list(&segment["vertices"]).iter().map(index).collect();
            let closed = segment["closed"].as_bool().unwrap();
            let control = points(&segment["control"]);
            let edges = if closed { path.len() } else { path.len() - 1 };
            for k in 0..edges {
                for t in [0.0, 0.03, 0.25, 0.3, 0.5, 0.77, 0.999, 1.0] {
                    let at = along(&level, &table, [path[k], path[(k + 1) % path.len()]], t);
                    let wanted = spline(&control, closed, k as f64 + t);
                    let error = surface.eval(at).position.distance(wanted);
                    assert!(error <= 1e-12 * mesh.size(), "{name}, edge {k} at {t}: {error:e}");
                }
            }
        }
    }
}

/// Places on a square, some close to its corners.
fn places() -> Vec<[f64; 2]> {
    let mut places: Vec<[f64; 2]> =
        (0..49).map(|k| [f64::from(k % 7) / 6.0, f64::from(k / 7) / 6.0]).collect();
    for small in [0.1, 0.03, 1e-3, 1e-6] {
        for [x, y] in [[small, 0.4 * small], [0.7 * small, small], [small, small]] {
            places.extend([[x, y], [1.0 - x, y], [1.0 - x, 1.0 - y], [x, 1.0 - y]]);
        }
    }
    places
}

#[test]
fn one_step_has_the_same_surface() {
    let mut meetings = 0;
    for (name, document) in cases() {
        let mesh = shaken(&prepared(&document["prepared"]));
        meetings += mesh.meetings.len();
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let (child, child_points) = level.refine_points(&mesh.points);
        let child_table = PatchTable::new(&child);
        let child_surface = LimitSurface::new(&child_table, &child_points);
        let size = mesh.size();
        for f in 0..level.topology().face_count() as u32 {
            if level.topology().face_size(FaceId(f)) != 4 {
                continue;
            }
            let first = level.topology().first(FaceId(f)).0;
            for [x, y] in places() {
                for corner in 0..4 {
                    let [i, j] = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]][corner as usize];
                    let at = table.locate(FaceId(f), None, i + 0.5 * x, j + 0.5 * y).unwrap();
                    // The child at a corner is turned with it.
                    let (s, t) = match corner {
                        0 => (x, y),
                        1 => (y, 1.0 - x),
                        2 => (1.0 - x, 1.0 - y),
                        _ => (1.0 - y, x),
                    };
                    let below = child_table.locate(FaceId(first + corner), None, s, t).unwrap();
                    let (jet, other) = (surface.jet(at), child_surface.jet(below));
                    let distance = jet.jet.position.distance(other.jet.position);
                    assert!(distance <= 1e-13 * size, "{name}, face {f}, {at:?}: {distance:e}");
                    if jet.flags.contains(Flags::AT_EXTRAORDINARY)
                        || other.flags.contains(Flags::AT_EXTRAORDINARY)
                    {
                        continue;
                    }
                    let (du, dv) = match corner {
                        0 => (other.jet.du, other.jet.dv),
                        1 => (-1.0 * other.jet.dv, other.jet.du),
                        2 => (-1.0 * other.jet.du, -1.0 * other.jet.dv),
                        _ => (other.jet.dv, -1.0 * other.jet.du),
                    };
                    let longest = jet.jet.du.length().max(jet.jet.dv.length());
                    // Rounding of parameters turns directions seen from a corner, and derivatives with them.
                    let near = |x: f64| x.min(1.0 - x);
                    let tolerance = 1e-11 + 1e-15 / near(x).hypot(near(y));
                    for (one, two) in [(jet.jet.du, du), (jet.jet.dv, dv)] {
                        let error = one.distance(2.0 * two);
                        assert!(error <= tolerance * longest, "{name}, face {f}, {at:?}: {one:?} {two:?}");
                    }
                }
            }
        }
    }
    assert!(meetings > 10);
}
