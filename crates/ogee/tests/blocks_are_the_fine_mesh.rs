//! A mesh that comes block by block is the mesh that comes at once: the same points, bit for bit, and the same quads, in the same order.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use std::convert::Infallible;

use ogee::{ControlMesh, FineMesh, Level, Vec3, shapes};

/// The mesh from its blocks.
fn in_blocks(mesh: &ControlMesh, depth: u32) -> FineMesh {
    let level = Level::new(mesh).unwrap();
    let dense = level.dense(depth, u64::MAX).unwrap();
    let mut fine = FineMesh { points: Vec::new(), faces: Vec::new() };
    let Ok(()) = dense.visit_points(&mesh.points, |points| {
        fine.points.extend_from_slice(points);
        Ok::<_, Infallible>(())
    });
    let Ok(()) = dense.visit_quads(|quads| {
        fine.faces.extend_from_slice(quads);
        Ok::<_, Infallible>(())
    });
    assert_eq!((fine.points.len(), fine.faces.len()), (dense.vertex_count(), dense.face_count()));
    fine
}

fn bits(points: &[Vec3]) -> Vec<[u64; 3]> {
    points.iter().map(|p| <[f64; 3]>::from(*p).map(f64::to_bits)).collect()
}

fn assert_same(name: &str, mesh: &ControlMesh, depth: u32) {
    let whole = Level::new(mesh).unwrap().fine_mesh(&mesh.points, depth, u64::MAX).unwrap();
    let made = in_blocks(mesh, depth);
    assert_eq!(made.faces, whole.faces, "{name} at depth {depth}");
    assert!(bits(&made.points) == bits(&whole.points), "{name} at depth {depth}");
}

#[test]
fn on_every_cage() {
    for (name, mesh) in cages::all() {
        for depth in 1..=3 {
            assert_same(&name, &mesh, depth);
        }
    }
}

#[test]
fn where_there_are_many_blocks() {
    let torus = cages::shaken(shapes::studded_torus(60, 48, 6), 0.2);
    let creased = cages::creased(torus.clone(), &[[0, 1], [1, 2], [200, 201]], 2.4);
    for mesh in [torus, cages::with_holes(creased, &[3, 700, 701])] {
        for depth in [4, 5] {
            assert_same("a torus with studs", &mesh, depth);
        }
    }
}

#[test]
fn an_error_ends_it() {
    let mesh = shapes::torus(100, 80);
    let level = Level::new(&mesh).unwrap();
    let dense = level.dense(4, u64::MAX).unwrap();
    for good in [0, 1, 3] {
        let mut calls = 0;
        let mut take = || {
            calls += 1;
            if calls > good { Err("full") } else { Ok(()) }
        };
        assert_eq!(dense.visit_points(&mesh.points, |_| take()), Err("full"));
        assert_eq!(calls, good + 1);
        let mut calls = 0;
        let mut take = || {
            calls += 1;
            if calls > good { Err("full") } else { Ok(()) }
        };
        assert_eq!(dense.visit_quads(|_| take()), Err("full"));
        assert_eq!(calls, good + 1);
    }
}

#[test]
fn less_is_held_and_more_is_refused() {
    let mesh = shapes::torus(300, 300);
    let level = Level::new(&mesh).unwrap();
    for depth in [2, 3, 4] {
        let needed = level.streaming_bytes(depth);
        // In two steps what is held besides a quarter of the points, sides and blocks, weighs as much as is spared.
        let spared = if depth == 2 {
            needed < level.fine_mesh_bytes(depth)
        } else {
            3 * needed < 2 * level.fine_mesh_bytes(depth)
        };
        assert!(spared, "depth {depth}");
        let needed = u64::try_from(needed).unwrap();
        assert!(level.check_streaming(depth, needed).is_ok());
        let refused = level.check_streaming(depth + 1, needed).unwrap_err();
        assert_eq!((refused.depth, refused.deepest), (depth + 1, depth));
    }
    let refused = level.check_streaming(20, u64::MAX).unwrap_err();
    assert_eq!(refused.deepest, 7, "ids end before memory does");
}
