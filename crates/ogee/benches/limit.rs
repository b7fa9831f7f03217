//! Evaluation of the limit surface of 100 000-quad cages: set-up, then points face by face and scattered.
//! `cargo bench -p ogee --bench limit` prints faces or points a second. `cargo xtask bench limit` sets it beside other
//! programs.
#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use divan::Bencher;
use divan::counter::ItemsCount;
use ogee::{ControlMesh, Derivatives, FaceId, Level, LimitSurface, Location, PatchTable, Samples, shapes};

/// Points along each side of a face.
const SIDE: u32 = 4;

/// Random places.
const SCATTERED: usize = 1_000_000;

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

#[derive(Clone, Copy, Debug)]
enum Order {
    /// Face after face, `SIDE` x `SIDE` cell centres in each.
    ByFaces,
    /// Faces and parameters at random.
    Scattered,
}

fn places(table: &PatchTable, order: Order) -> Vec<Location> {
    let faces = table.len() as u32;
    let at = |face: u32, u: f64, v: f64| table.locate(FaceId(face), None, u, v).unwrap();
    let centre = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    match order {
        Order::ByFaces => (0..faces * SIDE * SIDE)
            .map(|k| at(k / (SIDE * SIDE), centre(k % SIDE), centre(k / SIDE % SIDE)))
            .collect(),
        Order::Scattered => {
            // Fractions of multiples of irrational numbers spread like random ones.
            let fraction = |k: usize, step: f64| (k as f64 * step).fract();
            let face = |k: usize| (fraction(k, 0.618_033_988_749_894_9) * f64::from(faces)) as u32;
            (0..SCATTERED)
                .map(|k| {
                    at(face(k), fraction(k, 0.754_877_666_246_692_8), fraction(k, 0.569_840_290_998_053_3))
                })
                .collect()
        }
    }
}

/// Pieces of the faces; nothing of the points.
#[divan::bench(args = [Cage::Regular, Cage::Studded], consts = [1, 2], sample_count = 20)]
fn patch_table<const THREADS: usize>(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    let level = Level::new(&mesh).unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().unwrap();
    bencher
        .counter(ItemsCount::new(mesh.faces.len()))
        .bench_local(|| pool.install(|| PatchTable::new(&level)));
}

/// What a new pose of the cage costs.
#[divan::bench(args = [Cage::Regular, Cage::Studded], consts = [1, 2], sample_count = 20)]
fn limit_surface<const THREADS: usize>(bencher: Bencher<'_, '_>, kind: Cage) {
    let mesh = cage(kind);
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().unwrap();
    bencher
        .counter(ItemsCount::new(mesh.faces.len()))
        .bench_local(|| pool.install(|| LimitSurface::new(&table, &mesh.points)));
}

/// Points and normals.
#[divan::bench(args = cases(), consts = [1, 2], sample_count = 10)]
fn first_derivatives<const THREADS: usize>(bencher: Bencher<'_, '_>, case: (Cage, Order)) {
    evaluate::<THREADS>(bencher, case, Derivatives::First);
}

/// Second derivatives as well.
#[divan::bench(args = cases(), consts = [1, 2], sample_count = 10)]
fn second_derivatives<const THREADS: usize>(bencher: Bencher<'_, '_>, case: (Cage, Order)) {
    evaluate::<THREADS>(bencher, case, Derivatives::Second);
}

fn cases() -> impl Iterator<Item = (Cage, Order)> {
    [Cage::Regular, Cage::Studded]
        .into_iter()
        .flat_map(|kind| [Order::ByFaces, Order::Scattered].map(|order| (kind, order)))
}

/// Evaluation alone, into memory of the time before.
fn evaluate<const THREADS: usize>(bencher: Bencher<'_, '_>, (kind, order): (Cage, Order), what: Derivatives) {
    let mesh = cage(kind);
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let places = places(&table, order);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().unwrap();
    let mut samples = Samples::default();
    bencher
        .counter(ItemsCount::new(places.len()))
        .bench_local(|| pool.install(|| surface.eval_into(&places, what, &mut samples)));
}

/// One call a point, as a program does that follows a curve.
#[divan::bench(args = cases(), sample_count = 10)]
fn one_call_a_point(bencher: Bencher<'_, '_>, (kind, order): (Cage, Order)) {
    let mesh = cage(kind);
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let places = places(&table, order);
    bencher.counter(ItemsCount::new(places.len())).bench_local(|| {
        for &at in &places {
            divan::black_box(surface.eval(at));
        }
    });
}
