//! Moving a vertex gives the surface of the cage with that vertex moved, bit for bit, and changes no face that does not
//! see it.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{locate, visible};
use ogee::{Derivatives, Level, LimitSurface, Location, PatchTable, Samples, Vec3, VertexId};

/// Some places on every visible face.
fn places(table: &PatchTable) -> Vec<Location> {
    let parameters = [(0.5, 0.5), (0.0, 0.0), (1.0, 0.3), (0.93, 0.97), (0.2, 0.9), (0.001, 0.002)];
    let at = |number: usize| parameters.map(|(u, v)| locate(table, number, u, v));
    visible(table).into_iter().flat_map(at).collect()
}

fn bits(samples: &Samples, k: usize) -> Vec<u64> {
    let arrays = [
        &samples.position,
        &samples.du,
        &samples.dv,
        &samples.normal,
        &samples.duu,
        &samples.duv,
        &samples.dvv,
    ];
    arrays.iter().flat_map(|array| <[f64; 3]>::from(array[k])).map(f64::to_bits).collect()
}

#[test]
fn a_moved_vertex_is_as_good_as_a_new_cage() {
    for (name, mesh) in cages::all() {
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        let at = places(&table);
        let mut surface = LimitSurface::new(&table, &mesh.points);
        let mut moved = mesh.points.clone();
        for v in (0..mesh.points.len()).step_by(mesh.points.len().div_ceil(7)) {
            let before = surface.eval_batch(&at, Derivatives::Second);
            moved[v] += Vec3::new(0.11, -0.07, 0.23);
            let vertex = VertexId(v as u32);
            surface.move_point(vertex, moved[v]);
            let after = surface.eval_batch(&at, Derivatives::Second);
            let fresh = LimitSurface::new(&table, &moved).eval_batch(&at, Derivatives::Second);
            let seen = table.seen_by(vertex);
            let mut changed = Vec::new();
            for (k, place) in at.iter().enumerate() {
                assert_eq!(bits(&after, k), bits(&fresh, k), "{name}: vertex {v}, {place:?}");
                if bits(&after, k) != bits(&before, k) {
                    changed.push(place.parametric_face());
                }
            }
            changed.dedup();
            assert!(changed.iter().all(|face| seen.contains(face)), "{name}: {v}: {changed:?} {seen:?}");
        }
    }
}

/// On a grid of quads the faces that see a vertex are those within two rings of it, no more.
#[test]
fn few_faces_see_a_vertex() {
    let mesh = cages::grid(9, 9);
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let seen = table.seen_by(VertexId(44));
    let wanted: Vec<usize> = (2..6).flat_map(|j| (2..6).map(move |i| 9 * j + i)).collect();
    assert_eq!(seen, wanted);
}

#[test]
fn hidden_faces_see_nothing() {
    let mesh = cages::with_holes(cages::grid(3, 3), &[4]);
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    assert!((0..16).all(|v| !table.seen_by(VertexId(v)).contains(&4)));
}
