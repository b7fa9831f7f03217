//! On the exact limit everything that the report measures over joints vanishes away from creases.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use ogee::quality::{Field, LimitView, PlaneLight, Ray, Report, ReportOptions, Viewer};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Vec3};

/// Lines of light above a cage, seen from the front, the right and above.
fn light(mesh: &ControlMesh) -> Field {
    let first = mesh.points[0];
    let (low, high) = mesh.points.iter().fold((first, first), |(a, b), p| (a.min(*p), b.max(*p)));
    let (middle, size) = (0.5 * (low + high), mesh.size());
    let centre = Vec3::new(middle.x, middle.y, high.z + 0.5 * size);
    let axes = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    Field::Plane {
        light: PlaneLight { centre, axes, half: [f64::INFINITY; 2] },
        viewer: Viewer::Eye(middle + size * Vec3::new(1.1, -1.4, 0.9)),
        ray: Ray::Reflected,
        axis: 0,
    }
}

fn report(mesh: &ControlMesh) -> Report {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let view = LimitView::new(&level, &surface);
    Report::new(&view, &ReportOptions::new(light(mesh))).unwrap()
}

#[test]
fn print() {
    for (name, mesh) in cages::all() {
        let report = report(&mesh);
        let j = &report.continuity.smooth;
        println!("{name}: {} joints gap {:.1e} angle {:.1e} curv {:.1e} kink {:.1e} ({} of {}) area {} sharp {} {:.3} border {}", j.count, j.gap.max / mesh.size(), j.angle.max, j.curvature.max, j.kink.max, j.kink.samples, j.angle.samples,
            report.curvature.area, report.continuity.sharp.count, report.continuity.sharp.angle.max, report.continuity.border);
        for p in report.extraordinary.points.iter().take(3) {
            println!("    {:?} {} {:?} growth {:.3} mean {:?} swing {:?} gswing {:?}", p.sector.kind, p.sector.faces, p.behaviour, p.growth, p.rings.map(|r| (r.mean * 1e3).round() / 1e3), p.rings.map(|r| (r.mean_swing * 1e2).round() / 1e2), p.rings.map(|r| (r.gauss_swing * 1e2).round() / 1e2));
        }
        for p in report.extraordinary.without_plane.iter().take(3) {
            println!("    PLANE {:?} {} {:?} {}", p.sector.kind, p.sector.faces, p.cause, p.spread);
        }
    }
}
