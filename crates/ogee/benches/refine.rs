//! Refinement of a 100 000-quad cage by three levels: from the face list in memory to points and quads of the last
//! level, adjacency included. `cargo bench -p ogee --bench refine` prints output faces a second.
#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use divan::Bencher;
use divan::counter::ItemsCount;
use ogee::{ControlMesh, FineMesh, Level, shapes};

const LEVELS: u32 = 3;

fn main() {
    divan::main();
}

#[derive(Clone, Copy, Debug)]
enum Cage {
    /// All valences 4.
    Regular,
    /// One vertex in twenty is extraordinary.
    Studded,
}

fn cage(kind: Cage) -> ControlMesh {
    match kind {
        Cage::Regular => shapes::torus(400, 250),
        Cage::Studded => shapes::studded_torus(380, 260, 12),
    }
}

/// Points alone: no table, no connectivity of the last level.
#[divan::bench(args = [Cage::Regular, Cage::Studded], consts = [1, 2], sample_count = 10)]
fn straight_from_points<const THREADS: usize>(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    let faces = mesh.faces.corners().len() << (2 * (LEVELS - 1));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().unwrap();
    bencher.counter(ItemsCount::new(faces)).bench_local(|| {
        pool.install(|| {
            let level = Level::new(&mesh).unwrap();
            level.fine_mesh(&mesh.points, LEVELS, u64::MAX).unwrap()
        })
    });
}

/// The same into the memory of the mesh before.
#[divan::bench(args = [Cage::Regular, Cage::Studded], consts = [1, 2], sample_count = 10)]
fn straight_from_points_reusing_memory<const THREADS: usize>(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    let faces = mesh.faces.corners().len() << (2 * (LEVELS - 1));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().unwrap();
    let mut fine = FineMesh { points: Vec::new(), faces: Vec::new() };
    bencher.counter(ItemsCount::new(faces)).bench_local(|| {
        pool.install(|| {
            let level = Level::new(&mesh).unwrap();
            level.fine_mesh_into(&mesh.points, LEVELS, u64::MAX, &mut fine).unwrap();
        });
    });
}

/// Adjacency of the cage alone.
#[divan::bench(args = [Cage::Regular, Cage::Studded], sample_count = 20)]
fn adjacency(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    bencher.counter(ItemsCount::new(mesh.faces.len())).bench_local(|| Level::new(&mesh).unwrap());
}

/// The tables of one step, and their application to one pose: what an animated cage costs.
#[divan::bench(args = [Cage::Regular, Cage::Studded], sample_count = 10)]
fn table(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    let level = Level::new(&mesh).unwrap();
    bencher.counter(ItemsCount::new(mesh.faces.corners().len())).bench_local(|| level.refine());
}

#[divan::bench(args = [Cage::Regular, Cage::Studded], sample_count = 20)]
fn apply(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    let step = Level::new(&mesh).unwrap().refine();
    bencher
        .counter(ItemsCount::new(mesh.faces.corners().len()))
        .bench_local(|| step.stencils.apply(&mesh.points));
}
