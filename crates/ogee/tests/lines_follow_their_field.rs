//! Lines of a field: every point has the line's value, chords are as close as asked, faces share crossings to the bit.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use ogee::quality::{
    Field, LevelLine, LevelLines, Levels, LimitView, LineOptions, PlaneLight, Ray, Surface, Viewer,
    bounding_box, level_lines,
};
use ogee::{ControlMesh, Derivatives, Flags, Level, LimitSurface, PatchTable, Samples, Vec3, shapes};

/// Of the size of the surface, or of the field where it is a cosine.
const RESIDUAL: f64 = 1e-12;

fn with_view<T>(mesh: &ControlMesh, f: impl FnOnce(&LimitView<'_>) -> T) -> T {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    f(&LimitView::new(&level, &surface))
}

fn size(view: &dyn Surface) -> f64 {
    let [lower, upper] = bounding_box(view).unwrap();
    upper.distance(lower)
}

/// The plane above a surface that pictures have, cut off at two diagonals.
fn ceiling(view: &dyn Surface) -> PlaneLight {
    let [lower, upper] = bounding_box(view).unwrap();
    let size = upper.distance(lower);
    PlaneLight {
        centre: 0.5 * (lower + upper) + Vec3::new(0.0, 0.0, 0.5 * (upper.z - lower.z) + 0.5 * size),
        axes: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        half: [2.0 * size; 2],
    }
}

fn every_field(view: &dyn Surface) -> Vec<(&'static str, Field, Levels)> {
    let light = ceiling(view);
    let size = size(view);
    let viewer = Viewer::Eye(light.centre + size * Vec3::new(1.1, -1.5, 0.3));
    let every = Levels::Every { first: 0.0, period: size / 11.0 };
    let cosines = (1..12).rev().map(|k| (15.0 * f64::from(k)).to_radians().cos()).collect();
    vec![
        ("reflection", Field::Plane { light, viewer, ray: Ray::Reflected, axis: 0 }, every.clone()),
        ("highlight", Field::Plane { light, viewer, ray: Ray::Normal, axis: 1 }, every),
        ("isophote", Field::Isophote { light: Vec3::new(0.36, 0.48, 0.8) }, Levels::Listed(cosines)),
        (
            "zebra",
            Field::Zebra { viewer, axis: Vec3::new(0.0, 0.0, 1.0) },
            Levels::Every { first: 0.05, period: 0.17 },
        ),
    ]
}

fn trace(view: &dyn Surface, field: &Field, levels: &Levels) -> LevelLines {
    level_lines(view, field, levels, &LineOptions::new(1e-4 * size(view))).unwrap()
}

fn field_size(field: &Field, view: &dyn Surface) -> f64 {
    if matches!(field, Field::Plane { .. }) { size(view) } else { 1.0 }
}

/// How far the field is from the value of the line at its points.
fn residual(view: &dyn Surface, field: &Field, line: &LevelLine) -> f64 {
    // Where the plane ends, rounding may put a point beyond.
    let mut field = *field;
    if let Field::Plane { light, .. } = &mut field {
        light.half = [f64::INFINITY; 2];
    }
    let at: Vec<_> = line.points.iter().map(|point| point.at).collect();
    let mut samples = Samples::default();
    view.evaluate(&at, Derivatives::First, &mut samples);
    let rest = |k: usize| {
        assert_eq!(samples.position[k], line.points[k].position);
        assert!(!samples.flags[k].contains(Flags::NORMAL_UNDEFINED));
        (field.value(samples.position[k], samples.normal[k]).unwrap() - line.value).abs()
    };
    (0..at.len()).map(rest).fold(0.0, f64::max)
}

#[test]
fn every_point_has_the_value_of_its_line() {
    let mut most = 0.0_f64;
    for (name, mesh) in cages::all() {
        with_view(&mesh, |view| {
            for (kind, field, levels) in every_field(view) {
                let found = trace(view, &field, &levels);
                for line in &found.lines {
                    let rest = residual(view, &field, line) / field_size(&field, view);
                    assert!(rest <= RESIDUAL, "{name}, {kind}: {rest:e}");
                    most = most.max(rest);
                    assert!(line.points.len() > 1);
                }
                println!(
                    "{name} {kind}: {} lines {} crossings straight {}",
                    found.lines.len(),
                    found.crossings,
                    found.straight
                );
                assert!(found.max_residual <= RESIDUAL * field_size(&field, view));
            }
        });
    }
    println!("largest residual {most:e}");
}

#[test]
fn times() {
    let mesh = shapes::studded_torus(40, 24, 8);
    with_view(&mesh, |view| {
        for (kind, field, levels) in every_field(view) {
            let start = std::time::Instant::now();
            let found = trace(view, &field, &levels);
            println!(
                "{} faces {kind}: {:?} lines {} points {} crossings {} straight {}",
                mesh.faces.len(),
                start.elapsed(),
                found.lines.len(),
                found.lines.iter().map(|l| l.points.len()).sum::<usize>(),
                found.crossings,
                found.straight
            );
        }
    });
}
