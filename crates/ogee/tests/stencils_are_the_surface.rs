//! Rows of weights over the cage evaluate the surface for any pose, at any depth.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{cloud, locate, visible};
use ogee::{ControlMesh, Derivatives, Flags, Level, LimitSurface, Location, PatchTable, StencilTable, Vec3};

/// Inside, on edges, at corners, and down the chains of all four corners.
fn places(table: &PatchTable) -> Vec<Location> {
    let deep = [1e-3, 1e-6, 1e-12];
    let mut parameters = vec![(0.5, 0.5), (0.31, 0.77), (0.0, 0.4), (0.6, 1.0)];
    parameters.extend([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    for t in deep {
        parameters.extend([(t, 0.3 * t), (1.0 - t, t), (1.0 - 0.2 * t, 1.0 - t), (0.7 * t, 1.0 - t)]);
    }
    // At most so many faces of a cage: every row is looked at.
    let faces = visible(table);
    let some = faces.iter().step_by(faces.len().div_ceil(12));
    some.flat_map(|&number| parameters.iter().map(move |&(u, v)| locate(table, number, u, v))).collect()
}

fn sum(rows: &StencilTable, row: usize) -> f64 {
    rows.row(row).map(|(_, weight)| weight).sum()
}

#[test]
fn rows_give_what_evaluation_gives() {
    for (name, mesh) in cages::all() {
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        let at = places(&table);
        let rows = table.stencils(&at, Derivatives::Second);
        assert_eq!(rows.len(), 6 * at.len());
        // Another pose of the same cage: rows know no points.
        for points in [mesh.points.clone(), cloud(mesh.points.len())] {
            let surface = LimitSurface::new(&table, &points);
            let values = rows.apply(&points);
            for (k, &place) in at.iter().enumerate() {
                let got = &values[6 * k..6 * k + 6];
                let wanted = surface.jet(place);
                let far = |a: Vec3, b: Vec3, size: f64| a.distance(b) / size.max(1.0);
                assert!(far(got[0], wanted.jet.position, 1.0) < 1e-13, "{name}: {place:?}");
                assert!((sum(&rows, 6 * k) - 1.0).abs() < 1e-13, "{name}: {place:?}");
                if wanted.flags.contains(Flags::AT_EXTRAORDINARY) {
                    continue;
                }
                let first = wanted.jet.du.length().max(wanted.jet.dv.length());
                // What cancels is as large as the weights.
                let weight =
                    |part: usize| rows.row(6 * k + part).map(|(_, weight)| weight.abs()).fold(0.0, f64::max);
                for (part, value) in [(1, wanted.jet.du), (2, wanted.jet.dv)] {
                    let size = first.max(weight(part));
                    assert!(far(got[part], value, size) < 1e-12, "{name}: {place:?} {part}");
                    assert!(sum(&rows, 6 * k + part).abs() < 1e-12 * size.max(1.0), "{name}: {place:?}");
                }
                // Second derivatives are what is left of first ones a step apart; ten splits cost another digit.
                let [u, v] = place.parameters().map(|t| t.min(1.0 - t));
                let steep = 1e-2 * first / u.max(v);
                for (part, value) in [(3, wanted.jet.duu), (4, wanted.jet.duv), (5, wanted.jet.dvv)] {
                    let size = weight(3).max(weight(4)).max(weight(5)).max(steep);
                    assert!(far(got[part], value, size) < 1e-11, "{name}: {place:?} {part}");
                }
            }
        }
    }
}

#[test]
fn tangents_at_extraordinary_vertices_span_the_tangent_plane() {
    for n in [3, 5, 8] {
        let mesh = cages::disk(n);
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        let at: Vec<Location> = (0..n)
            .map(|f| cages::at_corner(&Level::new(&mesh).unwrap(), &table, ogee::FaceId(f), 0, 0.0, 0.0))
            .collect();
        let rows = table.stencils(&at, Derivatives::First).apply(&mesh.points);
        let surface = LimitSurface::new(&table, &mesh.points);
        for (k, &place) in at.iter().enumerate() {
            let point = surface.eval(place);
            assert!(rows[3 * k].distance(point.position) < 1e-14);
            let normal = rows[3 * k + 1].cross(rows[3 * k + 2]).normalized().unwrap();
            assert!(normal.distance(point.normal) < 1e-13, "valence {n}: {normal:?} {:?}", point.normal);
        }
    }
}

/// Derivatives far down a chain keep their digits: their rows annihilate constants to the last digit.
#[test]
fn rows_keep_their_digits_at_depth() {
    let mesh = cages::disk(3);
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    for t in [1e-3, 1e-6, 1e-9] {
        let place = cages::at_corner(&level, &table, ogee::FaceId(0), 0, t, 0.4 * t);
        let rows = table.stencils(&[place], Derivatives::First).apply(&mesh.points);
        let wanted = surface.eval(place);
        for (got, wanted) in [(rows[1], wanted.du), (rows[2], wanted.dv)] {
            assert!(got.distance(wanted) < 1e-11 * wanted.length(), "{t}: {got:?} {wanted:?}");
        }
    }
}

#[test]
fn only_what_was_asked_for_has_rows() {
    let mesh = ControlMesh::clone(&cages::cube());
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let at = [locate(&table, 0, 0.2, 0.3), locate(&table, 5, 0.9, 0.1)];
    let count = |what: Derivatives| table.stencils(&at, what).len();
    assert_eq!([Derivatives::None, Derivatives::First, Derivatives::Second].map(count), [2, 6, 12]);
    assert!(table.stencils(&[], Derivatives::Second).is_empty());
}
