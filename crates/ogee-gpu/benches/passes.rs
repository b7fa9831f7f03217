//! The passes of a picture, one by one: `cargo bench -p ogee-gpu`. The fastest of ten runs and the median, after one that
//! compiles the shaders.
//!
//! The surface, a bump around a vertex of valence five, fills the picture, so that as many pixels are covered as it has.

use divan::Bencher;
use ogee::quality::{LimitView, bounding_box};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Vec3, shapes};
use ogee_gpu::{Device, DeviceOptions, GpuSurface, Pass, Renderer, Storage};
use ogee_render::{Camera, Pattern, Projection, Sampling, Scene, Style, default_light};

fn main() {
    divan::main();
}

const SIDES: [u32; 3] = [300, 500, 700];

/// Faces of the cages that the first pass and the upload are timed with.
const RINGS: [u32; 3] = [8, 16, 32];

fn bump(rings: u32) -> ControlMesh {
    let mut mesh = shapes::disk(5, rings);
    let size = mesh.points.iter().map(|point| point.length()).fold(0.0, f64::max);
    for point in &mut mesh.points {
        let [x, y, _] = <[f64; 3]>::from(*point).map(|x| x / size);
        *point = Vec3::new(x, y, 0.4 * (1.0 - x * x - y * y) + 0.02 * (9.0 * x).sin());
    }
    mesh
}

fn scene(view: &LimitView<'_>, side: u32, sampling: Sampling) -> Scene {
    let bounds = bounding_box(view).expect("a bump has a size");
    let pattern = Pattern::Lines { period: 0.15, width: 0.3, phase: 0.0 };
    let camera = Camera {
        eye: Vec3::new(0.0, -1.0, 4.0),
        at: Vec3::new(0.0, 0.0, 0.3),
        up: Vec3::new(0.0, 1.0, 0.0),
        projection: Projection::Parallel { height: 0.8 },
    };
    let style = Style::Reflection { light: default_light(bounds), pattern };
    Scene { camera, size: [side; 2], style, sampling }
}

/// Hands a surface and a device on, if there is one.
fn with_view(rings: u32, storage: Option<Storage>, then: impl FnOnce(&Device, &LimitView<'_>)) {
    let options = DeviceOptions { storage, ..DeviceOptions::default() };
    let Ok(device) = Device::new(&options) else { return };
    let mesh = bump(rings);
    let level = Level::new(&mesh).expect("a bump is a surface");
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    then(&device, &LimitView::new(&level, &surface));
}

fn pass(bencher: Bencher<'_, '_>, rings: u32, side: u32, sampling: Sampling, pass: Pass) {
    pass_from(None, bencher, rings, side, sampling, pass);
}

fn pass_from(
    storage: Option<Storage>,
    bencher: Bencher<'_, '_>,
    rings: u32,
    side: u32,
    sampling: Sampling,
    pass: Pass,
) {
    with_view(rings, storage, |device, view| {
        let scene = scene(view, side, sampling);
        let renderer = Renderer::new(device).expect("a renderer");
        let surface = GpuSurface::new(device, view).expect("room for the surface");
        let prepared = renderer.prepare(&surface, &scene).expect("a picture");
        prepared.set_limit(None);
        // What the pass reads, and its shader.
        for pass in [Pass::Parameter, Pass::Position, pass] {
            prepared.run(pass);
        }
        device.finish().expect("the device answers");
        bencher.bench_local(|| {
            prepared.run(pass);
            device.finish().expect("the device answers");
        });
    });
}

#[divan::bench(args = RINGS, sample_count = 10, sample_size = 1)]
fn upload(bencher: Bencher<'_, '_>, rings: u32) {
    with_view(rings, None, |device, view| {
        bencher.bench_local(|| {
            let surface = GpuSurface::new(device, view).expect("room for the surface");
            device.finish().expect("the device answers");
            surface
        });
    });
}

#[divan::bench(args = RINGS, sample_count = 10, sample_size = 1)]
fn parameter_faces(bencher: Bencher<'_, '_>, rings: u32) {
    pass(bencher, rings, 300, Sampling::Parameters(2), Pass::Parameter);
}

#[divan::bench(args = SIDES, sample_count = 10, sample_size = 1)]
fn parameter(bencher: Bencher<'_, '_>, side: u32) {
    pass(bencher, 8, side, Sampling::Parameters(2), Pass::Parameter);
}

#[divan::bench(args = SIDES, sample_count = 10, sample_size = 1)]
fn position(bencher: Bencher<'_, '_>, side: u32) {
    pass(bencher, 8, side, Sampling::Parameters(2), Pass::Position);
}

#[divan::bench(args = SIDES, sample_count = 10, sample_size = 1)]
fn colour(bencher: Bencher<'_, '_>, side: u32) {
    pass(bencher, 8, side, Sampling::Parameters(2), Pass::Colour);
}

#[divan::bench(args = SIDES, sample_count = 10, sample_size = 1)]
fn fused(bencher: Bencher<'_, '_>, side: u32) {
    pass(bencher, 8, side, Sampling::Exact, Pass::Fused);
}

#[divan::bench(args = SIDES, sample_count = 10, sample_size = 1)]
fn fused_without_newton(bencher: Bencher<'_, '_>, side: u32) {
    pass(bencher, 8, side, Sampling::Parameters(2), Pass::Fused);
}

#[divan::bench(args = SIDES, sample_count = 10, sample_size = 1)]
fn fused_from_buffers(bencher: Bencher<'_, '_>, side: u32) {
    pass_from(Some(Storage::Buffers), bencher, 8, side, Sampling::Exact, Pass::Fused);
}
