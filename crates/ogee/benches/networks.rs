//! Laying networks of curves: cages of 10 000 faces, 100 curves.
#![allow(missing_docs, reason = "divan makes functions")]
#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use ogee::ControlMesh;
use ogee::curve_network::{Crossing, CurveNetwork, NetworkCurve, embed};
use ogee::shapes;

fn main() {
    divan::main();
}

fn curve(number: usize, vertices: Vec<u32>, closed: bool) -> NetworkCurve {
    NetworkCurve { name: format!("c{number}"), vertices, closed, ..NetworkCurve::default() }
}

/// A sheet of 100 by 100 quads.
fn sheet() -> ControlMesh {
    let mut mesh = shapes::grid(100, 100);
    for p in &mut mesh.points {
        p.z = 3.0 * (0.1 * p.x).sin() * (0.13 * p.y).cos();
    }
    mesh
}

/// Lines of the sheet from border to border, `step` edges apart, along both directions.
fn lines(step: u32, both: bool) -> CurveNetwork {
    let row = |k: u32| (0..=100).map(|i| 101 * step * k + i).collect();
    let column = |k: u32| (0..=100).map(|i| 101 * i + step * k).collect();
    let count = if both { 50 } else { 100 / step - 1 };
    let mut curves: Vec<NetworkCurve> =
        (1..=count).filter(|&k| step * k < 100).map(|k| curve(k as usize, row(k), false)).collect();
    if both {
        curves.extend((1..50).map(|k| curve(100 + k as usize, column(k), false)));
    }
    CurveNetwork { curves, ..CurveNetwork::default() }
}

/// 98 curves from border to border that cross in 2401 points.
#[divan::bench]
fn crossing_lines(bencher: divan::Bencher<'_, '_>) {
    let (mesh, network) = (sheet(), lines(2, true));
    bencher.bench_local(|| embed(&network, &mesh).unwrap());
}

/// The same, with plain rules where they cross.
#[divan::bench]
fn smooth_crossings(bencher: divan::Bencher<'_, '_>) {
    let (mesh, mut network) = (sheet(), lines(2, true));
    network.options.crossing = Crossing::Smooth;
    bencher.bench_local(|| embed(&network, &mesh).unwrap());
}

/// 99 curves side by side, a ribbon between any two.
#[divan::bench]
fn lines_side_by_side(bencher: divan::Bencher<'_, '_>) {
    let (mesh, network) = (sheet(), lines(1, false));
    bencher.bench_local(|| embed(&network, &mesh).unwrap());
}

/// 100 curves that end inside.
#[divan::bench]
fn short_lines(bencher: divan::Bencher<'_, '_>) {
    let path = |k: u32| (0..5).map(|i| 101 * (5 + 10 * (k / 10)) + 3 + 10 * (k % 10) + i).collect();
    let curves = (0..100).map(|k| curve(k as usize, path(k), false)).collect();
    let (mesh, network) = (sheet(), CurveNetwork { curves, ..CurveNetwork::default() });
    bencher.bench_local(|| embed(&network, &mesh).unwrap());
}
