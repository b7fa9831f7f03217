//! No adapter, no answer, nothing to see: each is an error that says so, and none a hang.

mod common;

use std::time::Duration;

use common::{device, with_view};
use ogee::shapes;
use ogee_gpu::{Device, DeviceOptions, GpuSurface, Renderer};
use ogee_render::{Camera, Scene};

#[test]
fn a_missing_adapter_is_named() {
    let options = DeviceOptions { name: Some("abacus".into()), ..DeviceOptions::default() };
    let error = Device::new(&options).expect_err("no adapter is called so");
    assert_eq!(error.code(), "no_adapter");
    let text = error.to_string();
    assert!(text.contains("abacus") && text.contains("vulkan"), "{text}");
}

#[test]
fn software_is_told_from_hardware() {
    let open = |is_software| Device::new(&DeviceOptions { is_software, ..DeviceOptions::default() });
    for wanted in [true, false] {
        match open(Some(wanted)) {
            Ok(device) => assert_eq!(device.is_software(), wanted, "{}", device.name()),
            Err(error) => {
                assert_eq!(error.code(), "no_adapter");
                assert!(error.to_string().contains("software"), "{error}");
            }
        }
    }
    // Hardware comes first.
    if let Some(device) = device(&DeviceOptions::default()) {
        assert_eq!(device.is_software(), open(Some(false)).is_err());
    }
}

#[test]
fn a_device_that_cannot_do_what_is_asked_for_is_an_error() {
    if device(&DeviceOptions::default()).is_none() {
        return;
    }
    let limits = wgpu::Limits { max_texture_dimension_2d: 1 << 24, ..wgpu::Limits::default() };
    let options = DeviceOptions { limits: Some(limits), ..DeviceOptions::default() };
    let error = Device::new(&options).expect_err("no texture is so wide");
    assert_eq!(error.code(), "adapter_refused");
    assert!(error.to_string().contains("max_texture_dimension_2d"), "{error}");
}

#[test]
fn a_device_that_takes_too_long_is_an_error() {
    let Some(device) = device(&DeviceOptions { timeout: Duration::ZERO, ..DeviceOptions::default() }) else {
        return;
    };
    with_view(&shapes::cube(), |view, _| {
        let surface = GpuSurface::new(&device, view).expect("room for the surface");
        let renderer = Renderer::new(&device).expect("a renderer");
        // Whoever is kept waiting between asking and looking may find the work done, but not every time.
        let render = || renderer.render(&surface, &Scene::of(view, [800, 800])).err();
        let error = (0..50).find_map(|_| render()).expect("nobody is always that quick");
        assert_eq!(error.code(), "device_timeout");
    });
}

#[test]
fn a_scene_that_shows_nothing_is_an_error() {
    let Some(device) = device(&DeviceOptions::default()) else { return };
    with_view(&shapes::cube(), |view, _| {
        let surface = GpuSurface::new(&device, view).expect("room for the surface");
        let renderer = Renderer::new(&device).expect("a renderer");
        let scene = Scene::of(view, [64, 64]);
        let Camera { eye, at, .. } = scene.camera;
        let away = Scene { camera: Camera { at: 2.0 * eye - at, ..scene.camera }, ..scene };
        let error = renderer.render(&surface, &away).expect_err("the cube is behind");
        assert_eq!(error.code(), "empty_view");
    });
}
