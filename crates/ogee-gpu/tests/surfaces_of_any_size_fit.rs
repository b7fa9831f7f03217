//! Surfaces are spread over several bindings, or refused with a reason; how they are stored does not change the picture.

mod common;

use common::{device, with_view};
use ogee::quality::{LimitView, bounding_box};
use ogee::shapes;
use ogee_gpu::{Device, DeviceOptions, GpuSurface, Renderer, Storage};
use ogee_render::{Pattern, Picture, Scene, Style, default_light, render};

fn stripes(view: &LimitView<'_>) -> Scene {
    let bounds = bounding_box(view).expect("a surface");
    let period = bounds[1].distance(bounds[0]) / 12.0;
    let pattern = Pattern::Lines { period, width: 0.3, phase: 0.0 };
    let style = Style::Reflection { light: default_light(bounds), pattern };
    Scene { style, ..Scene::of(view, [300, 300]) }
}

fn picture(device: &Device, view: &LimitView<'_>) -> Picture {
    let surface = GpuSurface::new(device, view).expect("room for the surface");
    Renderer::new(device).and_then(|renderer| renderer.render(&surface, &stripes(view))).expect("a picture")
}

#[test]
fn parts_and_textures_give_the_same_picture() {
    let with =
        |storage, most_bytes| DeviceOptions { storage: Some(storage), most_bytes, ..Default::default() };
    with_view(&shapes::disk(12, 1), |view, _| {
        let Some(whole) = device(&with(Storage::Buffers, None)) else { return };
        let wanted = picture(&whole, view);
        // Its points take 210 kilobytes: four parts of 64.
        for (storage, most) in
            [(Storage::Buffers, Some(1 << 16)), (Storage::Textures, None), (Storage::Textures, Some(1 << 16))]
        {
            let Some(other) = device(&with(storage, most)) else { return };
            let found = picture(&other, view);
            let pairs = wanted.colours.iter().flatten().zip(found.colours.iter().flatten());
            let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(worst < 1e-3, "{storage:?} {most:?}: {worst}");
        }
    });
}

#[test]
fn what_does_not_fit_is_refused() {
    with_view(&shapes::cube(), |view, _| {
        let storage = Some(Storage::Buffers);
        let options = DeviceOptions { storage, most_bytes: Some(1 << 14), ..Default::default() };
        let Some(small) = device(&options) else { return };
        let error = GpuSurface::new(&small, view).expect_err("four parts of 16 kilobytes are too few");
        assert_eq!(error.code(), "too_large_for_device");
        let Some(device) = device(&DeviceOptions::default()) else { return };
        let surface = GpuSurface::new(&device, view).expect("room for the surface");
        let renderer = Renderer::new(&device).expect("a renderer");
        let scene = Scene { size: [1 << 17, 4], ..stripes(view) };
        let error = renderer.render(&surface, &scene).expect_err("no texture is so wide");
        assert_eq!(error.code(), "too_large_for_device");
    });
}

#[test]
fn a_hundred_thousand_faces_are_rendered() {
    let mesh = shapes::torus(400, 256);
    with_view(&mesh, |view, table| {
        assert!(table.len() > 100_000);
        let Some(device) = device(&DeviceOptions::default()) else { return };
        let found = picture(&device, view);
        let wanted = render(view, &stripes(view)).expect("a picture");
        let pairs = wanted.colours.iter().flatten().zip(found.colours.iter().flatten());
        let mean =
            pairs.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / (3 * wanted.colours.len()) as f64;
        assert!(mean < 1.0 / 255.0, "{mean}");
    });
}
