//! Each display against a picture that somebody looked at. `cargo xtask bless` draws them again.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

use ogee::quality::{LimitView, bounding_box};
use ogee::{Level, LimitSurface, PatchTable, Vec3, shapes};
use ogee_render::{Image, Pattern, Quantity, Sampling, Scene, Style, default_light, render};

const SIZE: [u32; 2] = [300, 300];

/// Of all colour values, 0 to 255: how far they may be from the picture in the middle.
const MEAN: f64 = 0.25;

/// How many pixels may differ by more than a tenth of the range.
const MANY: usize = 30;

#[test]
fn every_display_is_the_picture_that_was_looked_at() {
    let mesh = shapes::body();
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let view = LimitView::new(&level, &surface);
    let [lower, upper] = bounding_box(&view).unwrap();
    let light = default_light([lower, upper]);
    let period = upper.distance(lower) / 12.0;
    let lines = Pattern::Lines { period, width: 0.3, phase: 0.0 };
    let up = Vec3::new(0.0, 0.0, 1.0);
    let reflection = |pattern: Pattern| Style::Reflection { light, pattern };
    let scenes = [
        ("shaded", Style::Shaded, Sampling::Exact),
        ("wireframe", Style::Wireframe, Sampling::Exact),
        ("stripes_of_polygon", reflection(lines.clone()), Sampling::Polygon(1)),
        ("stripes", reflection(lines.clone()), Sampling::Exact),
        ("lattice", reflection(Pattern::Lattice { period, width: 0.1 }), Sampling::Exact),
        ("circles", reflection(Pattern::Circles { period, radius: 0.3 }), Sampling::Exact),
        ("highlight", Style::Highlight { light, pattern: lines }, Sampling::Exact),
        ("isophote", Style::Isophote { light: up, step: 10.0 }, Sampling::Exact),
        ("zebra", Style::Zebra { axis: up, count: 12.0 }, Sampling::Exact),
        ("mean", Style::Curvature { quantity: Quantity::Mean, limit: None }, Sampling::Exact),
        ("gauss", Style::Curvature { quantity: Quantity::Gauss, limit: None }, Sampling::Exact),
        ("error", Style::Error { light, level: 2 }, Sampling::Exact),
        ("combs", Style::Combs { share: 0.05 }, Sampling::Exact),
    ];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../testdata/images");
    for (name, style, sampling) in scenes {
        let scene = Scene { style: style.clone(), sampling, ..Scene::of(&view, SIZE) };
        let picture = render(&view, &scene).unwrap();
        let mut image = picture.image();
        if let Some(limit) = picture.limit {
            image.add_legend(&style, limit);
        }
        let path = folder.join(format!("{name}.png"));
        if std::env::var_os("OGEE_BLESS").is_some() {
            let mut bytes = Vec::new();
            image.write_png(&mut bytes).unwrap();
            std::fs::write(&path, bytes).unwrap();
            continue;
        }
        let known = Image::read_png(&std::fs::read(&path).unwrap()).unwrap();
        assert_eq!(image.size, known.size, "{name}");
        let differences: Vec<u8> =
            image.pixels.iter().zip(&known.pixels).map(|(&a, &b)| a.abs_diff(b)).collect();
        let mean = differences.iter().map(|&d| f64::from(d)).sum::<f64>() / differences.len() as f64;
        let many = differences.chunks(4).filter(|pixel| pixel.iter().any(|&d| d > 25)).count();
        assert!(mean < MEAN && many < MANY, "{name}: {mean} in the mean, {many} pixels far off");
    }
}
