//! Surfaces under instruments, for the claims about lines.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::quality::{
    Field, LevelLines, Levels, LimitView, LineOptions, PlaneLight, Ray, Surface, Viewer, bounding_box,
    level_lines,
};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Vec3};

/// Of the size: what chords may be off by unless something else is said.
pub const TOLERANCE: f64 = 1e-4;

pub fn with_view<T>(mesh: &ControlMesh, f: impl FnOnce(&LimitView<'_>) -> T) -> T {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    f(&LimitView::new(&level, &surface))
}

pub fn size(view: &dyn Surface) -> f64 {
    let [lower, upper] = bounding_box(view).unwrap();
    upper.distance(lower)
}

/// A plane above a surface, cut off at one diagonal to each side.
pub fn ceiling(view: &dyn Surface) -> PlaneLight {
    let [lower, upper] = bounding_box(view).unwrap();
    let size = upper.distance(lower);
    PlaneLight {
        centre: 0.5 * (lower + upper) + Vec3::new(0.0, 0.0, 0.5 * (upper.z - lower.z) + 0.5 * size),
        axes: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        half: [size; 2],
    }
}

/// A field of every kind for a surface, with values.
pub fn every_field(view: &dyn Surface) -> Vec<(&'static str, Field, Levels)> {
    let light = ceiling(view);
    let size = size(view);
    let viewer = Viewer::Eye(light.centre + size * Vec3::new(1.1, -1.5, 0.3));
    let every = Levels::Every { first: 0.0, period: size / 11.0 };
    let cosines = (1..12).rev().map(|k| (15.0 * f64::from(k)).to_radians().cos()).collect();
    let zebra = Field::Zebra { viewer, axis: Vec3::new(0.0, 0.0, 1.0) };
    vec![
        ("reflection", Field::Plane { light, viewer, ray: Ray::Reflected, axis: 0 }, every.clone()),
        ("highlight", Field::Plane { light, viewer, ray: Ray::Normal, axis: 1 }, every),
        ("isophote", Field::Isophote { light: Vec3::new(0.36, 0.48, 0.8) }, Levels::Listed(cosines)),
        ("zebra", zebra, Levels::Every { first: 0.05, period: 0.17 }),
        ("facing", Field::Facing { viewer }, Levels::Listed(vec![0.0])),
    ]
}

pub fn trace(view: &dyn Surface, field: &Field, levels: &Levels) -> LevelLines {
    level_lines(view, field, levels, &LineOptions::new(TOLERANCE * size(view))).unwrap()
}
