//! Reflection lines on a rounded cube, made on the graphics processor: writes stripes.png.

use ogee::quality::{LimitView, bounding_box};
use ogee::{Level, LimitSurface, PatchTable, shapes};
use ogee_gpu::{Device, DeviceOptions, GpuSurface, Renderer};
use ogee_render::{Pattern, Scene, Style, default_light};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = shapes::cube();
    let level = Level::new(&mesh)?;
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let view = LimitView::new(&level, &surface);

    let device = Device::new(&DeviceOptions::default())?;
    let renderer = Renderer::new(&device)?;
    let on_device = GpuSurface::new(&device, &view)?;

    let bounds = bounding_box(&view).expect("a cube has a size");
    let period = bounds[1].distance(bounds[0]) / 10.0;
    let pattern = Pattern::Lines { period, width: 0.3, phase: 0.0 };
    let style = Style::Reflection { light: default_light(bounds), pattern };
    let scene = Scene { style, ..Scene::of(&view, [700, 700]) };
    let picture = renderer.render(&on_device, &scene)?;
    picture.image().write_png(std::fs::File::create("stripes.png")?)?;
    Ok(())
}
