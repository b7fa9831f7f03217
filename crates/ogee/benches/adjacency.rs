//! The first level of a cage of 1.1 million quads from its list of faces, in several orders of faces and vertices, by one
//! thread and by two. `cargo bench -p ogee --bench adjacency` prints faces a second.
#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use divan::Bencher;
use divan::counter::ItemsCount;
use ogee::{ControlMesh, Level, shapes};

fn main() {
    divan::main();
}

#[derive(Clone, Copy, Debug)]
enum Order {
    /// Faces row by row, and vertices as they meet them.
    Rows,
    /// As two steps of refinement number them.
    Refined,
    /// The same, a thousand faces here and a thousand there.
    Blocks,
    /// None at all.
    Chance,
}

fn cage(order: Order) -> ControlMesh {
    let mut next = numbers();
    match order {
        Order::Rows => shapes::studded_torus(1320, 816, 12),
        Order::Refined => refined(),
        Order::Blocks => {
            let mesh = refined();
            let faces: Vec<&[u32]> = mesh.faces.iter().collect();
            let mut blocks: Vec<&[&[u32]]> = faces.chunks(1000).collect();
            shuffle(&mut blocks, &mut next);
            let faces = blocks.concat().into_iter().map(quad).collect();
            ControlMesh::new(mesh.points, faces)
        }
        Order::Chance => {
            let mesh = cage(Order::Rows);
            let mut faces: Vec<&[u32]> = mesh.faces.iter().collect();
            shuffle(&mut faces, &mut next);
            let mut number: Vec<u32> = (0..mesh.points.len() as u32).collect();
            shuffle(&mut number, &mut next);
            let renumbered = |face: &[u32]| quad(face).map(|v| number[v as usize]);
            let faces = faces.into_iter().map(renumbered).collect();
            ControlMesh::new(mesh.points, faces)
        }
    }
}

fn refined() -> ControlMesh {
    let mesh = shapes::studded_torus(336, 204, 12);
    let fine = Level::new(&mesh).unwrap().fine_mesh(&mesh.points, 2, u64::MAX).unwrap();
    ControlMesh::new(fine.points, fine.faces.into_iter().collect())
}

fn quad(face: &[u32]) -> [u32; 4] {
    face.try_into().unwrap()
}

/// Numbers of no order, the same every time.
fn numbers() -> impl FnMut() -> usize {
    let mut state = 7u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    }
}

fn shuffle<T>(values: &mut [T], next: &mut impl FnMut() -> usize) {
    for k in (1..values.len()).rev() {
        values.swap(k, next() % (k + 1));
    }
}

#[divan::bench(
    args = [Order::Rows, Order::Refined, Order::Blocks, Order::Chance],
    consts = [1, 2],
    sample_count = 10
)]
fn first_level<const THREADS: usize>(bencher: Bencher<'_, '_>, order: Order) {
    let mesh = cage(order);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().unwrap();
    bencher
        .counter(ItemsCount::new(mesh.faces.len()))
        .bench_local(|| pool.install(|| Level::new(&mesh).unwrap()));
}
