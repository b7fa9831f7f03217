//! Refined positions of every cage of `testdata/opensubdiv`, levels 1 to 3, by tables and by the fast path.

mod golden;

use golden::{cage, documents, index, list, number, points};
use ogee::{FaceId, FaceVarying, FaceVaryingRule, Level, Refinement, Vec3};

/// OpenSubdiv averages sharpness in binary32 where creases of different fractional sharpness fade at one vertex.
const TOLERANCE: f64 = 1e-13;
const TOLERANCE_WHERE_CREASES_FADE: f64 = 1e-7;

#[test]
fn refined_positions_match() {
    let mut worst_of_all: f64 = 0.0;
    for (name, document) in documents("opensubdiv") {
        let mesh = cage(&document["cage"], &document["options"]);
        let level = Level::new(&mesh).unwrap();
        let fractional = list(&document["cage"]["creases"])
            .iter()
            .chain(list(&document["cage"]["corners"]))
            .any(|tag| number(&tag["sharpness"]).fract() != 0.0);
        let tolerance = if fractional { TOLERANCE_WHERE_CREASES_FADE } else { TOLERANCE };
        for refined in list(&document["refined"]) {
            let depth = index(&refined["level"]);
            let refinement = Refinement::uniform(&level, depth).unwrap();
            let ours = refinement.apply(&mesh.points);
            let topology = refinement.finest().topology();
            assert_eq!(topology.vertex_count() as u64, refined["vertex_count"].as_u64().unwrap(), "{name}");
            assert_eq!(topology.edge_count() as u64, refined["edge_count"].as_u64().unwrap(), "{name}");
            let theirs = points(&refined["positions"]);
            for (ptex, grid) in list(&document["ptex_faces"]).iter().zip(list(&refined["grids"])) {
                let corner = ptex[1].as_i64().unwrap();
                let corner = (corner >= 0).then_some(corner as u32);
                let vertices = refinement.grid(FaceId(index(&ptex[0])), corner);
                let side = vertices.rows();
                for j in 0..side {
                    for i in 0..side {
                        let gap = ours[vertices[(i, j)].index()]
                            .distance(theirs[index(&grid[j * side + i]) as usize]);
                        assert!(gap <= tolerance, "{name} level {depth}, {ptex}, ({i}, {j}): {gap:e}");
                        if !fractional {
                            worst_of_all = worst_of_all.max(gap);
                        }
                    }
                }
            }
        }
    }
    println!("largest difference from OpenSubdiv without fractional sharpness: {worst_of_all:e}");
}

#[test]
fn fast_path_equals_the_table() {
    for (name, document) in documents("opensubdiv") {
        let mesh = cage(&document["cage"], &document["options"]);
        let mut level = Level::new(&mesh).unwrap();
        let mut points: Vec<Vec3> = mesh.points.clone();
        for depth in 1..=3 {
            let step = level.refine();
            let by_table = step.stencils.apply(&points);
            let (next, by_fast_path) = level.refine_points(&points);
            for (a, b) in by_table.iter().zip(&by_fast_path) {
                assert!(a.distance(*b) < 1e-14, "{name} level {depth}: {a:?} {b:?}");
            }
            assert_eq!(by_table.len(), by_fast_path.len());
            (level, points) = (next, by_fast_path);
        }
    }
}

#[test]
fn face_varying_values_match() {
    let mut compared = 0;
    for (name, document) in documents("opensubdiv") {
        let mesh = cage(&document["cage"], &document["options"]);
        let Some(uv) = &mesh.uv else { continue };
        let level = Level::new(&mesh).unwrap();
        let (uv_level, values) = level.face_varying(uv);
        for refined in list(&document["refined"]) {
            let depth = index(&refined["level"]);
            let refinement = Refinement::uniform(&uv_level, depth).unwrap();
            let ours = refinement.apply(&values);
            let theirs = list(&refined["uvs"]);
            for (ptex, grid) in list(&document["ptex_faces"]).iter().zip(list(&refined["uv_grids"])) {
                let corner = ptex[1].as_i64().unwrap();
                let vertices =
                    refinement.grid(FaceId(index(&ptex[0])), (corner >= 0).then_some(corner as u32));
                let side = vertices.rows();
                for j in 0..side {
                    for i in 0..side {
                        let ours = ours[vertices[(i, j)].index()];
                        let theirs = &theirs[index(&grid[j * side + i]) as usize];
                        for k in 0..2 {
                            let gap = (ours[k] - number(&theirs[k])).abs();
                            assert!(gap <= TOLERANCE, "{name} level {depth}, {ptex}, ({i}, {j}): {gap:e}");
                        }
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

#[test]
fn linear_face_varying_rules_hold_what_they_name() {
    // Two charts side by side on a 2 x 2 grid: the left and the right column have values of their own.
    let moved = |rule: FaceVaryingRule| {
        let mut mesh = ogee::shapes::grid(2, 2);
        let of = |v: u32, face: &[u32]| if face[0].is_multiple_of(3) { v } else { v + 9 };
        let indices = mesh
            .faces
            .iter()
            .flat_map(|face| face.iter().map(|&v| of(v, face)).collect::<Vec<_>>())
            .collect();
        let bent = |v: u32| [f64::from(v % 3) + 0.1 * f64::from(v / 3 * (v / 3)), f64::from(v / 3)];
        let values: Vec<[f64; 2]> = (0..18).map(|v| bent(v % 9)).collect();
        let data = FaceVarying { values: values.clone(), indices, rule };
        mesh.uv = Some(data.clone());
        // The mesh itself keeps no corners.
        mesh.scheme.boundary = ogee::Boundary::EdgeOnly;
        let (level, start) = Level::new(&mesh).unwrap().face_varying(&data);
        let (_, fine) = level.refine_points(&start);
        // Held by one face; in the middle of the outer side; in the middle of the seam.
        [0, 3, 4].map(|v| {
            let at = start.iter().position(|&value| value == values[v]).unwrap();
            fine[at] != start[at]
        })
    };
    assert_eq!(moved(FaceVaryingRule::None), [true, true, true]);
    assert_eq!(moved(FaceVaryingRule::CornersOnly), [false, true, true]);
    assert_eq!(moved(FaceVaryingRule::CornersPlus1), [false, true, true]);
    assert_eq!(moved(FaceVaryingRule::CornersPlus2), [false, true, true]);
    assert_eq!(moved(FaceVaryingRule::Boundaries), [false, false, false]);
    assert_eq!(moved(FaceVaryingRule::All), [false, false, false]);
}
