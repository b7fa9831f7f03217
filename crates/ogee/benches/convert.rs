//! Cage to part, figures included: `cargo bench -p ogee --bench convert` prints cage faces a second.

use divan::Bencher;
use divan::counter::ItemsCount;
use ogee::convert::{Method, Options, Packing, to_part};
use ogee::{ControlMesh, shapes};

fn main() {
    divan::main();
}

/// Studded tori: one vertex in twenty is extraordinary.
fn cage(faces: u32) -> ControlMesh {
    match faces {
        1_000 => shapes::studded_torus(36, 28, 12),
        10_000 => shapes::studded_torus(120, 84, 12),
        _ => shapes::studded_torus(384, 264, 12),
    }
}

fn run(bencher: Bencher<'_, '_>, faces: u32, options: Options) {
    let mesh = cage(faces);
    bencher.counter(ItemsCount::new(mesh.faces.len())).bench_local(|| to_part(&mesh, &options).unwrap());
}

#[divan::bench(args = [1_000, 10_000, 100_000], sample_count = 3)]
fn packed(bencher: Bencher<'_, '_>, faces: u32) {
    run(bencher, faces, Options::default());
}

#[divan::bench(args = [1_000, 10_000], sample_count = 3)]
fn one_face_a_quad(bencher: Bencher<'_, '_>, faces: u32) {
    run(bencher, faces, Options { packing: Packing::Unpacked, ..Options::default() });
}

#[divan::bench(args = [1_000, 10_000], sample_count = 3)]
fn quintic(bencher: Bencher<'_, '_>, faces: u32) {
    run(bencher, faces, Options { method: Method::Bi5, ..Options::default() });
}
