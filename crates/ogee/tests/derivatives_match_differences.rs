//! Derivatives against differences of positions, and normals against derivatives.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{at_corner, locate, turned, visible};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, SurfaceJet, Vec3, VertexId, shapes};

const STEP: f64 = 1e-4;
const FIRST: f64 = 1e-6;
const SECOND: f64 = 1e-5;

/// Derivatives by central differences; `step` both ways.
fn differences(at: impl Fn(f64, f64) -> Vec3, step: f64) -> SurfaceJet {
    let position = at(0.0, 0.0);
    let [east, west, north, south] =
        [at(step, 0.0), at(-step, 0.0), at(0.0, step), at(0.0, -step)].map(|p| p - position);
    let twist = (at(step, step) - at(-step, step)) - (at(step, -step) - at(-step, -step));
    SurfaceJet {
        position,
        du: (east - west) / (2.0 * step),
        dv: (north - south) / (2.0 * step),
        duu: (east + west) / (step * step),
        duv: twist / (4.0 * step * step),
        dvv: (north + south) / (step * step),
    }
}

/// The largest difference of first and of second derivatives, each of the longest of its order; second ones that are
/// small beside the first are measured by those.
fn gaps(ours: &SurfaceJet, wanted: &SurfaceJet) -> [f64; 2] {
    let longest = |all: &[Vec3]| all.iter().map(|d| d.length()).fold(0.0, f64::max);
    let first = longest(&[ours.du, ours.dv]);
    let second = longest(&[ours.duu, ours.duv, ours.dvv, ours.du, ours.dv]);
    [
        longest(&[ours.du - wanted.du, ours.dv - wanted.dv]) / first,
        longest(&[ours.duu - wanted.duu, ours.duv - wanted.duv, ours.dvv - wanted.dvv]) / second,
    ]
}

fn assert_normal(name: &str, jet: &SurfaceJet, normal: Vec3) {
    let wanted = jet.du.cross(jet.dv).normalized().unwrap();
    assert!(normal.distance(wanted) <= 1e-14, "{name}: {normal:?}, not {wanted:?}");
}

#[test]
fn derivatives_are_those_of_the_surface() {
    // Half way between lines of the tenth level, where pieces may meet with a jump of the third derivative.
    let samples = [(90, 70), (300, 700), (512, 100), (771, 950), (930, 515), (130, 125)]
        .map(|(i, j)| ((f64::from(i) + 0.5) / 1024.0, (f64::from(j) + 0.5) / 1024.0));
    let mut cages = cages::all();
    cages.push(("body".into(), cages::body()));
    for (name, mesh) in cages {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let mut worst = [0.0f64; 2];
        for number in visible(&table) {
            for (u, v) in samples {
                let at = |du: f64, dv: f64| surface.eval(locate(&table, number, u + du, v + dv)).position;
                let place = || format!("{name}, {:?} ({u}, {v})", table.parametric_face(number));
                let got = surface.jet(locate(&table, number, u, v));
                let [first, second] = gaps(&got.jet, &differences(at, STEP));
                assert!(first <= FIRST, "{}: {first:e}", place());
                assert!(second <= SECOND, "{}: second {second:e}", place());
                assert_normal(&place(), &got.jet, got.normal);
                // The short answer is the long one's beginning.
                let point = surface.eval(locate(&table, number, u, v));
                assert_eq!((point.du, point.dv, point.normal), (got.jet.du, got.jet.dv, got.normal));
                worst = [worst[0].max(first), worst[1].max(second)];
            }
        }
        println!("{name}: first {:.1e}, second {:.1e}", worst[0], worst[1]);
    }
}

/// Second derivatives near a vertex by differences of first ones: those of positions drown in rounding there.
#[test]
fn derivatives_hold_towards_a_vertex() {
    let creased = |n: u32, which: &[u32]| cages::creased(cages::disk(n), &cages::spokes(which, 2), 10.0);
    let mut cases: Vec<(String, ControlMesh)> =
        [3, 5, 6, 8, 12, 20].map(|n| (format!("disk {n}"), cages::disk(n))).to_vec();
    cases.push(("dart".into(), creased(5, &[1])));
    cases.push(("crease".into(), creased(7, &[0, 3])));
    cases.push(("corner".into(), creased(7, &[0, 2, 5])));
    cases.push(("cone".into(), cages::sharp_at(cages::disk(5), &[0], 10.0)));
    cases.push(("boundary".into(), cages::fan(3)));
    cases.push(("valence 50".into(), shapes::disk(50, 1)));
    for (name, mut mesh) in cases {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        // The vertex into the origin, so that differences of positions near it keep their digits.
        let (face, corner) = cages::faces_at(&level, VertexId(0))[0];
        for _ in 0..3 {
            let middle = LimitSurface::new(&table, &mesh.points)
                .eval(at_corner(&level, &table, face, corner, 0.0, 0.0))
                .position;
            mesh.points.iter_mut().for_each(|p| *p -= middle);
        }
        let surface = LimitSurface::new(&table, &mesh.points);
        let mut worst = [0.0f64; 2];
        for (face, corner) in cages::faces_at(&level, VertexId(0)) {
            for depth in 1..=24 {
                let size = 0.5f64.powi(depth);
                for (x, y) in [(0.7, 0.3), (0.8, 0.6), (0.2, 0.9)].map(|(x, y)| (x * size, y * size)) {
                    let address = |dx: f64, dy: f64| at_corner(&level, &table, face, corner, x + dx, y + dy);
                    let got = surface.jet(address(0.0, 0.0)).jet;
                    let place = format!("{name} {face}, {depth} down, ({x}, {y})");
                    // Derivatives are along the face's own parameters, differences along the corner's.
                    let frame = turned(&got, corner);
                    let step = STEP * size;
                    let wanted = differences(|dx, dy| surface.eval(address(dx, dy)).position, step);
                    let [first, _] = gaps(&frame, &wanted);
                    // Beside corners other than the first the parameters themselves are rounded.
                    let rounding = if corner == 0 { 0.0 } else { 2.0 * f64::EPSILON / step };
                    assert!(first <= FIRST + rounding, "{place}: {first:e}");
                    let tangent = |dx: f64, dy: f64| {
                        let point = surface.eval(address(dx, dy));
                        let jet = SurfaceJet { du: point.du, dv: point.dv, ..SurfaceJet::default() };
                        let jet = turned(&jet, corner);
                        [jet.du, jet.dv]
                    };
                    let [east, west, north, south] =
                        [tangent(step, 0.0), tangent(-step, 0.0), tangent(0.0, step), tangent(0.0, -step)];
                    let slope = |a: Vec3, b: Vec3| (a - b) / (2.0 * step);
                    let wanted = SurfaceJet {
                        duu: slope(east[0], west[0]),
                        duv: slope(east[1], west[1]),
                        dvv: slope(north[1], south[1]),
                        ..wanted
                    };
                    let twist = slope(north[0], south[0]);
                    // First derivatives over the cell, as a measure where second ones nearly vanish.
                    let measure = frame.du.length().max(frame.dv.length()) / size;
                    let all = [
                        frame.duu - wanted.duu,
                        frame.duv - wanted.duv,
                        frame.duv - twist,
                        frame.dvv - wanted.dvv,
                    ];
                    let second = all.iter().map(|d| d.length()).fold(0.0, f64::max) / measure;
                    assert!(second <= FIRST + rounding, "{place}: second {second:e}");
                    worst = [worst[0].max(first), worst[1].max(second)];
                }
            }
        }
        println!("{name}: first {:.1e}, second {:.1e}", worst[0], worst[1]);
    }
}
