//! Points that shaders evaluate in single precision against the golden samples and against evaluation in double precision.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a test fails by panicking, and prints figures")]

mod common;
#[path = "../../ogee/tests/golden/mod.rs"]
mod golden;

use common::{device, with_view};
use golden::{cage, documents, index, list, number, point};
use ogee::{FaceId, Location, Vec3, shapes};
use ogee_gpu::{DeviceOptions, GpuSurface, Renderer, Storage};
use serde_json::Value;

/// Of the size of the cage.
const POSITION: f64 = 1e-6;
const NORMAL: f64 = 1e-5;
/// Nearer to a corner than [`NEAR`] the surface is taken for its own limit shape.
const NORMAL_NEAR: f64 = 5e-4;
const NEAR: f64 = 2e-5;

fn compare(storage: Storage) {
    let options = DeviceOptions { storage: Some(storage), ..DeviceOptions::default() };
    let Some(device) = device(&options) else { return };
    let renderer = Renderer::new(&device).expect("a renderer");
    let mut count = 0;
    let golden = documents("evaluation").into_iter().map(|(name, document)| {
        let mesh = cage(&document["mesh"], &Value::Null);
        (name, mesh, list(&document["samples"]).to_vec())
    });
    // Lenses, whose chains shrink fastest, are too young for golden samples.
    let wing = ("wing".to_owned(), shapes::lens(), Vec::new());
    for (name, mesh, samples) in golden.chain([wing]) {
        with_view(&mesh, |view, table| {
            let surface = GpuSurface::new(&device, view).expect("room for the surface");
            let golden = samples.iter().map(|sample| {
                let corner = sample["subface"].as_u64().map(|corner| corner as u32);
                let (u, v) = (number(&sample["u"]), number(&sample["v"]));
                table.locate(FaceId(index(&sample["face"])), corner, u, v).expect("a place")
            });
            let mut places: Vec<Location> = golden.collect();
            let mut wanted: Vec<(Vec3, Vec3)> =
                samples.iter().map(|sample| (point(&sample["S"]), point(&sample["n"]))).collect();
            // And places that the golden samples leave out: other faces, all corners.
            for square in ogee::quality::Surface::layout(view).squares() {
                for [s, t] in [
                    [0.0, 0.3],
                    [0.7, 0.9],
                    [0.999, 0.9995],
                    [1e-4, 0.9999],
                    [4e-5, 3e-5],
                    [0.5, 0.5],
                    [1.0, 1.0],
                ] {
                    let place = square.at(s, t);
                    let exact = view.surface().eval(place);
                    places.push(place);
                    wanted.push((exact.position, exact.normal));
                }
            }
            let found = renderer.evaluate(&surface, &places).expect("points");
            let mut worst = [0.0f64; 3];
            for ((place, wanted), found) in places.iter().zip(&wanted).zip(&found) {
                let [u, v] = place.parameters();
                let is_near = u.min(1.0 - u).max(v.min(1.0 - v)) < NEAR;
                let gap = found.0.distance(wanted.0) / mesh.size();
                assert!(gap < POSITION, "{name} {place:?}: position {gap:e}");
                worst[0] = worst[0].max(gap);
                let turn = found.1.distance(wanted.1);
                let (which, tolerance) = if is_near { (2, NORMAL_NEAR) } else { (1, NORMAL) };
                assert!(turn < tolerance, "{name} {place:?}: normal {turn:e}");
                worst[which] = worst[which].max(turn);
            }
            count += found.len();
            let worst = worst.map(|gap| format!("{gap:.1e}"));
            println!("{name}: position, normals, near: {}", worst.join(" "));
        });
    }
    assert!(count > 250, "{count}");
}

#[test]
fn points_from_buffers_match() {
    compare(Storage::Buffers);
}

#[test]
fn points_from_textures_match() {
    compare(Storage::Textures);
}
