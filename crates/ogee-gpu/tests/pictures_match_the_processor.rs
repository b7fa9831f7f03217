//! Every style, every sampling: the picture of the device is that of the processor, but for the rounding of 32 bits.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a test fails by panicking, and prints figures")]

mod common;

use std::process::Command;
use std::sync::Arc;

use common::{device, with_view};
use ogee::curve_network::{CurveNetwork, NetworkCurve, embed};
use ogee::quality::bounding_box;
use ogee::{ControlMesh, Crease, FaceList, Sharpness, Vec3, shapes};
use ogee_gpu::{Device, DeviceOptions, GpuSurface, Renderer, Storage};
use ogee_render::{
    Camera, Image, Light, Pattern, Projection, Quantity, Sampling, Scene, Style, default_light, render,
};

const SIZE: [u32; 2] = [300, 300];

/// How two pictures differ: the mean over all numbers, and the share of pixels that are off by more than 24, both of 255.
fn difference(a: &Image, b: &Image) -> (f64, f64) {
    let pairs = a.pixels.iter().zip(&b.pixels).map(|(a, b)| f64::from(a.abs_diff(*b)));
    let mean = pairs.sum::<f64>() / a.pixels.len() as f64;
    let far = a.pixels.chunks_exact(4).zip(b.pixels.chunks_exact(4));
    let far = far.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 24)).count();
    (mean, far as f64 / (a.pixels.len() / 4) as f64)
}

/// Squares with a gradient, so that every texel is another.
fn chart() -> Arc<Light> {
    let size = [96, 64];
    let mut image = Image::filled(size, [0, 0, 0, 255]);
    for y in 0..size[1] {
        for x in 0..size[0] {
            let first = 4 * (y * size[0] + x) as usize;
            let bright = if (x / 8 + y / 8) % 2 == 0 { 255 } else { 40 };
            image.pixels[first..first + 3].copy_from_slice(&[bright, (2 * x) as u8, (3 * y) as u8]);
        }
    }
    Arc::new(Light::new(&image))
}

fn styles(bounds: [Vec3; 2]) -> Vec<(&'static str, Style)> {
    let light = default_light(bounds);
    let diagonal = bounds[1].distance(bounds[0]);
    let period = diagonal / 12.0;
    let lines = Pattern::Lines { period, width: 0.3, phase: 0.1 };
    let reflected = |pattern: Pattern| Style::Reflection { light, pattern };
    let map = |quantity: Quantity, limit: Option<f64>| Style::Curvature { quantity, limit };
    vec![
        ("shaded", Style::Shaded),
        ("wireframe", Style::Wireframe),
        ("lines", reflected(lines.clone())),
        ("lattice", reflected(Pattern::Lattice { period, width: 0.15 })),
        ("circles", reflected(Pattern::Circles { period, radius: 0.3 })),
        ("image", reflected(Pattern::Image { image: chart(), half: 1.5 * diagonal })),
        ("highlight", Style::Highlight { light, pattern: lines }),
        ("isophotes", Style::Isophote { light: Vec3::new(0.48, -0.6, 0.64), step: 12.0 }),
        ("zebra", Style::Zebra { axis: Vec3::new(0.0, 0.6, 0.8), count: 12.0 }),
        ("gauss", map(Quantity::Gauss, None)),
        ("mean", map(Quantity::Mean, None)),
        ("k1", map(Quantity::K1, Some(8.0 / diagonal))),
        ("k2", map(Quantity::K2, None)),
        ("greatest", map(Quantity::Greatest, None)),
        ("sign", map(Quantity::GaussSign, None)),
        ("error", Style::Error { light, level: 1 }),
        ("combs", Style::Combs { share: 0.05 }),
    ]
}

/// Other polygons, a crease and a border.
fn pyramid() -> ControlMesh {
    let points = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut faces = FaceList::new();
    for [a, b] in [[0, 1], [1, 2], [2, 3]] {
        faces.push(&[a, b, 4]);
    }
    faces.push(&[3, 2, 1, 0]);
    let mut mesh = ControlMesh::new(points.map(Vec3::from).to_vec(), faces);
    mesh.creases.push(Crease { vertices: [1, 4], sharpness: Sharpness::Finite(2.5) });
    mesh.creases.push(Crease { vertices: [1, 2], sharpness: Sharpness::Infinite });
    mesh
}

/// Some styles of a cage, or all: exact points in perspective, and in turn one of some other ways.
fn compare(
    name: &str,
    mesh: &ControlMesh,
    options: &DeviceOptions,
    others: &[(bool, Sampling)],
    which: &[&str],
) {
    let Some(device) = device(options) else { return };
    let renderer = Renderer::new(&device).expect("a renderer");
    with_view(mesh, |view, _| {
        let on_device = GpuSurface::new(&device, view).expect("room for the surface");
        let bounds = bounding_box(view).expect("a surface");
        let camera = Scene::of(view, SIZE).camera;
        let wanted = styles(bounds).into_iter().filter(|(name, _)| which.is_empty() || which.contains(name));
        for ((style_name, style), &other) in wanted.zip(others.iter().cycle()) {
            for (is_parallel, sampling) in [(false, Sampling::Exact), other] {
                let is_map = matches!(style, Style::Curvature { .. });
                if is_map && matches!(sampling, Sampling::Polygon(_)) {
                    continue;
                }
                let camera = if is_parallel { parallel(camera, bounds) } else { camera };
                let scene = Scene { camera, size: SIZE, style: style.clone(), sampling };
                let wanted = render(view, &scene).expect("a picture");
                let found = renderer.render(&on_device, &scene).expect("a picture");
                let (mean, far) = difference(&wanted.image(), &found.image());
                if let Ok(folder) = std::env::var("OGEE_PICTURES") {
                    let write = |image: Image, by: &str| {
                        let path = format!("{folder}/{name}-{style_name}-{sampling:?}-{by}.png");
                        image.write_png(std::fs::File::create(path).unwrap()).unwrap();
                    };
                    write(wanted.image(), "processor");
                    write(found.image(), "device");
                }
                println!("{name} {style_name} {sampling:?}: mean {mean:.4}, far {:.4} %", 100.0 * far);
                if let (Some(a), Some(b)) = (wanted.limit, found.limit) {
                    // Pixels at outlines decide with the others.
                    assert!((a - b).abs() <= 1e-2 * a.abs(), "{name} {style_name}: limits {a} and {b}");
                }
                assert_eq!(wanted.level, found.level);
                assert!(mean < 1.0 && far < 1e-3, "{name} {style_name} {sampling:?}: {mean}, {far}");
            }
        }
    });
}

fn parallel(camera: Camera, bounds: [Vec3; 2]) -> Camera {
    Camera { projection: Projection::Parallel { height: 0.8 * bounds[1].distance(bounds[0]) }, ..camera }
}

#[test]
fn smooth_surfaces_look_the_same() {
    let others = [(true, Sampling::Exact), (false, Sampling::Parameters(2)), (false, Sampling::Polygon(2))];
    compare("studs", &shapes::studded_torus(8, 6, 3), &DeviceOptions::default(), &others, &[]);
}

#[test]
fn polygons_creases_and_borders_look_the_same() {
    let others = [(false, Sampling::Parameters(1)), (true, Sampling::Polygon(1))];
    compare("pyramid", &pyramid(), &DeviceOptions::default(), &others, &[]);
}

#[test]
fn meetings_of_curves_look_the_same() {
    // Two curves cross on a torus, and one ends.
    let torus = shapes::torus(8, 6);
    let row = |j: u32| (0..8).map(move |i| 6 * i + j).collect::<Vec<u32>>();
    let curve = |vertices: Vec<u32>, closed| NetworkCurve {
        name: "c".into(),
        vertices,
        closed,
        ..Default::default()
    };
    let curves =
        vec![curve(row(1), true), curve((0..6).collect(), true), curve(row(4)[2..6].to_vec(), false)];
    let network = CurveNetwork { curves, ..CurveNetwork::default() };
    let mesh = embed(&network, &torus).expect("room for three curves").mesh;
    assert!(mesh.meetings.len() >= 3);
    compare("meetings", &mesh, &DeviceOptions::default(), &[(false, Sampling::Polygon(2))], &FEW);
}

/// One style for each kind of shader.
const FEW: [&str; 4] = ["lines", "image", "mean", "error"];

#[test]
fn buffers_look_the_same() {
    let options = DeviceOptions { storage: Some(Storage::Buffers), ..DeviceOptions::default() };
    compare("cube", &shapes::cube(), &options, &[(true, Sampling::Polygon(2))], &FEW);
}

#[test]
fn opengl_looks_the_same() {
    let options = DeviceOptions { backends: wgpu::Backends::GL, ..DeviceOptions::default() };
    compare("cube", &shapes::cube(), &options, &[(false, Sampling::Parameters(2))], &FEW);
}

/// WebGL2 is OpenGL ES 3.0 with its least limits. Mesa offers that version and no other if it is told to while it is loaded, so
/// the test runs itself once more.
#[test]
fn webgl2_looks_the_same() {
    const NAME: &str = "webgl2_looks_the_same";
    const VERSIONS: [(&str, &str); 2] =
        [("MESA_GL_VERSION_OVERRIDE", "3.0"), ("MESA_GLES_VERSION_OVERRIDE", "3.0")];
    if std::env::var_os(VERSIONS[1].0).is_none() {
        let mut again = Command::new(std::env::current_exe().unwrap());
        again.args([NAME, "--exact", "--nocapture"]).envs(VERSIONS);
        assert!(again.status().unwrap().success());
        return;
    }
    let gl = DeviceOptions { backends: wgpu::Backends::GL, ..DeviceOptions::default() };
    let buffers = DeviceOptions { storage: Some(Storage::Buffers), ..gl.clone() };
    if Device::new(&buffers).is_ok() {
        println!("not OpenGL ES 3.0: it has storage buffers");
    }
    let options = DeviceOptions { limits: Some(wgpu::Limits::downlevel_webgl2_defaults()), ..gl };
    let others = [(true, Sampling::Parameters(2)), (false, Sampling::Polygon(2))];
    compare("studs", &shapes::studded_torus(8, 6, 3), &options, &others, &[]);
}
