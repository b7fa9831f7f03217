//! Dense refinement gives the points and quads that tables give level by level, in the numbering it says.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;
mod golden;

use golden::{cage, documents};
use ogee::{
    ControlMesh, DenseRefinement, FaceId, FineMesh, Grid, Level, Refinement, Vec3, VertexId, limit_vertices,
};
use proptest::prelude::*;

/// Relative to the size of the cage.
const TOLERANCE: f64 = 1e-14;

/// Compares with tables, a face of the cage at a time; returns the largest distance relative to the cage's size.
fn compare(name: &str, mesh: &ControlMesh, depth: u32) -> f64 {
    let level = Level::new(mesh).unwrap();
    let refinement = Refinement::uniform(&level, depth).unwrap();
    let wanted = refinement.apply(&mesh.points);
    let dense = level.dense(depth, u64::MAX).unwrap();
    let (mut points, mut quads) = (Vec::new(), Vec::new());
    dense.points(&mesh.points, &mut points);
    dense.quads(&mut quads);
    assert_eq!((points.len(), quads.len()), (dense.vertex_count(), dense.face_count()), "{name}");
    assert_eq!(points.len(), wanted.len(), "{name}");
    let in_order = dense.from_levels(refinement.finest(), &wanted);
    let gap = in_order.iter().zip(&points).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(
        in_order.len() == points.len() && gap <= TOLERANCE * mesh.size(),
        "{name}, {depth} steps: {gap:e}"
    );
    let visible: Vec<[u32; 4]> = refinement.finest().quads();
    assert_eq!(quads.len(), visible.len(), "{name}");

    let topology = level.topology();
    let mut quads = quads.iter();
    // The table's vertex for each of ours: the same wherever quads share it.
    let mut same = vec![None; points.len()];
    let mut worst: f64 = 0.0;
    for f in (0..topology.face_count() as u32).map(FaceId).filter(|&f| level.is_visible(f)) {
        let corners = match topology.face_size(f) {
            4 if topology.is_quads() => vec![None],
            4 => [0, 1, 2, 3].map(Some).to_vec(),
            n => (0..n).map(Some).collect(),
        };
        for corner in corners {
            let grid = match (corner, topology.face_size(f)) {
                (Some(corner), 4) => quarter(&refinement.grid(f, None), corner),
                _ => refinement.grid(f, corner),
            };
            for i in 0..grid.rows() - 1 {
                for j in 0..grid.cols() - 1 {
                    let cell = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|at| grid[at]);
                    let own = quads.next().unwrap();
                    for (own, theirs) in own.iter().zip(cell) {
                        let known = same[*own as usize].get_or_insert(theirs);
                        assert_eq!(*known, theirs, "{name}: vertex {own}");
                        let gap = points[*own as usize].distance(wanted[theirs.index()]);
                        worst = worst.max(gap / mesh.size());
                    }
                }
            }
        }
    }
    assert!(quads.next().is_none());
    // Every vertex of a visible face once, and by another number.
    let mut theirs: Vec<VertexId> = same.iter().flatten().copied().collect();
    let count = theirs.len();
    theirs.sort_unstable();
    theirs.dedup();
    assert_eq!(theirs.len(), count, "{name}");
    assert!(worst <= TOLERANCE, "{name}, {depth} steps: {worst:e}");
    worst
}

/// The part of a quad's grid at one corner, in that corner's own frame.
fn quarter(grid: &Grid<VertexId>, corner: u32) -> Grid<VertexId> {
    let n = grid.rows() - 1;
    Grid::from_fn(n / 2 + 1, n / 2 + 1, |i, j| match corner {
        0 => grid[(i, j)],
        1 => grid[(n - j, i)],
        2 => grid[(n - i, n - j)],
        _ => grid[(j, n - i)],
    })
}

#[test]
fn every_kind_of_cage() {
    let mut worst: f64 = 0.0;
    for (name, mesh) in cages::all() {
        for depth in 1..=4 {
            worst = worst.max(compare(&name, &mesh, depth));
        }
    }
    println!("largest distance from the tables, relative: {worst:e}");
}

#[test]
fn golden_cages() {
    for (name, document) in documents("opensubdiv") {
        let mesh = cage(&document["cage"], &document["options"]);
        for depth in 1..=5 {
            compare(&name, &mesh, depth);
        }
    }
}

/// The numbering is a promise: `V` corners, then insides of quads, then insides of edges.
#[test]
fn numbers_follow_their_formula() {
    let mesh = cages::body();
    let level = Level::new(&mesh).unwrap();
    let topology = level.topology();
    let fine = level.fine_mesh(&mesh.points, 3, u64::MAX).unwrap();
    let (vertices, faces, side) = (topology.vertex_count(), topology.face_count(), 8);
    let inside = side - 1;
    for f in (0..faces as u32).map(FaceId) {
        let cell = |i: usize, j: usize| fine.faces[f.index() * side * side + i * side + j];
        for i in 1..side {
            for j in 1..side {
                let number = vertices + f.index() * inside * inside + (i - 1) * inside + j - 1;
                assert_eq!(cell(i, j)[0] as usize, number);
            }
        }
        for (k, h) in topology.halfedges(f).enumerate() {
            let corner =
                [cell(0, 0)[0], cell(side - 1, 0)[1], cell(side - 1, side - 1)[2], cell(0, side - 1)[3]][k];
            assert_eq!(corner, topology.origin(h).0);
            let edge = topology.edge(h);
            for t in 1..side {
                let along = if topology.side(edge) == h { t } else { side - t };
                let number = vertices + faces * inside * inside + edge.index() * inside + along - 1;
                let found = [
                    cell(t.min(side - 1), 0)[0],
                    cell(side - 1, t - 1)[2],
                    cell(side - t, side - 1)[3],
                    cell(0, side - t)[0],
                ][k];
                assert_eq!(found as usize, number, "{f:?} {k} {t}");
            }
        }
    }
}

#[test]
fn an_animated_cage_is_planned_once() {
    let mesh = cages::creased(cages::body(), &[[0, 1], [1, 2]], 2.5);
    let level = Level::new(&mesh).unwrap();
    let dense: DenseRefinement<'_> = level.dense(3, u64::MAX).unwrap();
    let mut points: Vec<Vec3> = Vec::new();
    for frame in 0..3 {
        let pose: Vec<Vec3> =
            mesh.points.iter().map(|&p| p + f64::from(frame) * p.cross(Vec3::new(0.1, 0.2, 0.3))).collect();
        dense.points(&pose, &mut points);
        assert_eq!(points, level.fine_mesh(&pose, 3, u64::MAX).unwrap().points);
    }
}

/// Memory of a larger mesh, of a smaller one and none at all.
#[test]
fn memory_that_was_used_before_changes_nothing() {
    let mut memory = FineMesh { points: Vec::new(), faces: Vec::new() };
    for (name, mesh) in cages::all() {
        let level = Level::new(&mesh).unwrap();
        for depth in [3, 1, 2] {
            let fresh = level.fine_mesh(&mesh.points, depth, u64::MAX).unwrap();
            level.fine_mesh_into(&mesh.points, depth, u64::MAX, &mut memory).unwrap();
            assert_eq!(fresh, memory, "{name}");
        }
    }
}

/// One, two and four numbers a vertex are refined as three are.
#[test]
fn data_of_any_width() {
    let mesh = cages::creased(cages::body(), &[[0, 1], [1, 2]], 1.5);
    let level = Level::new(&mesh).unwrap();
    let fine = level.fine_mesh(&mesh.points, 3, u64::MAX).unwrap().points;
    let of = |f: fn(&Vec3) -> f64| mesh.points.iter().map(f).collect::<Vec<f64>>();
    let x = level.fine_mesh(&of(|p| p.x), 3, u64::MAX).unwrap().points;
    let yz: Vec<[f64; 2]> = mesh.points.iter().map(|p| [p.y, p.z]).collect();
    let yz = level.fine_mesh(&yz, 3, u64::MAX).unwrap().points;
    let four: Vec<[f64; 4]> = mesh.points.iter().map(|p| [p.z, p.x, p.y, p.x]).collect();
    let four = level.fine_mesh(&four, 3, u64::MAX).unwrap().points;
    for (k, p) in fine.iter().enumerate() {
        assert_eq!([p.x, p.y, p.z], [x[k], yz[k][0], yz[k][1]]);
        assert_eq!([p.z, p.x, p.y, p.x], four[k]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn any_cage(mesh in cages::tagged(Just(cages::cloud(60))), depth in 1..5_u32) {
        prop_assume!(Level::new(&mesh).is_ok());
        compare("any", &mesh, depth);
    }
}

/// What would not fit is refused before anything is made, with the greatest depth that fits.
#[test]
fn too_deep_is_said_beforehand() {
    let polygons = cages::prism(5);
    for mesh in [cages::body(), polygons] {
        let level = Level::new(&mesh).unwrap();
        let mut last = 0;
        for depth in 1..=8 {
            let bytes = u64::try_from(level.fine_mesh_bytes(depth)).unwrap();
            assert!(bytes > last, "{depth}: {bytes}");
            last = bytes;
            assert!(level.dense(depth, bytes).is_ok());
            let error = level.dense(depth, bytes - 1).unwrap_err();
            assert_eq!((error.depth, error.deepest), (depth, depth - 1));
        }
        let points = |depth: u32| (mesh.faces.corners().len() as u64) << (2 * (depth - 1));
        let deepest = (1..20).rev().find(|&depth| points(depth) < u64::from(u32::MAX) * 9 / 10).unwrap();
        for depth in [deepest + 2, 46, u32::MAX] {
            let error = level.dense(depth, u64::MAX).unwrap_err();
            assert_eq!(error.depth, depth);
            assert!(error.deepest.abs_diff(deepest) <= 1, "{error}");
        }
    }
}

/// Memory that is stated is enough: points and quads as they come to stand, and the level before.
#[test]
fn stated_memory_holds_the_result() {
    for (name, mesh) in cages::all() {
        let level = Level::new(&mesh).unwrap();
        for depth in 1..=4 {
            let fine = level.fine_mesh(&mesh.points, depth, u64::MAX).unwrap();
            let held = size_of_val(&fine.points[..]) + size_of_val(&fine.faces[..]);
            assert!(level.fine_mesh_bytes(depth) >= held as u128, "{name}");
        }
    }
}

/// Limits of all vertices, grid by grid, are those that a level gives.
#[test]
fn limits_are_those_of_the_levels() {
    for (name, mesh) in cages::all() {
        for depth in 1..=3 {
            compare_limits(&name, &mesh, depth);
        }
    }
}

fn compare_limits(name: &str, mesh: &ControlMesh, depth: u32) {
    let level = Level::new(mesh).unwrap();
    let dense = level.dense(depth, u64::MAX).unwrap();
    let (mut finest, mut points) = level.refine_points(&mesh.points);
    for _ in 1..depth {
        (finest, points) = finest.refine_points(&points);
    }
    let wanted = dense.from_levels(&finest, &limit_vertices(&finest, &points));
    // The same of a cage moved by rounding errors, to see which normals mean something.
    let mut noise = cages::noise(5);
    let moved: Vec<Vec3> =
        points.iter().map(|&p| p + 1e-14 * mesh.size() * Vec3::new(noise(), noise(), noise())).collect();
    let trembling = dense.from_levels(&finest, &limit_vertices(&finest, &moved));
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    dense.limit(&mesh.points, &mut positions, &mut normals);
    assert_eq!((positions.len(), normals.len()), (wanted.len(), wanted.len()));
    for (v, wanted) in wanted.iter().enumerate() {
        let gap = positions[v].distance(wanted.position) / mesh.size();
        assert!(gap <= TOLERANCE, "{name}, {depth} steps, vertex {v}: {gap:e}");
        let normal = wanted.normal.unwrap_or(Vec3::ZERO);
        if trembling[v].normal.unwrap_or(Vec3::ZERO).distance(normal) > 1e-3 {
            // The two sides are one, as those of a pillow: the normal is a difference of rounding errors.
            continue;
        }
        assert!(
            normals[v].distance(normal) <= 1e-9,
            "{name}, {depth} steps, vertex {v}: {normal:?} {:?}",
            normals[v]
        );
    }
}
