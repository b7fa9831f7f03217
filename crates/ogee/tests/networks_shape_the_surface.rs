//! Normals and cross curvatures wanted along curves are met, wherever the cage is split, and the curves stay exact.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use networks::along;
use ogee::curve_network::{Crossing, CurveNetwork, Embedding, NetworkCurve, NetworkWarning, PreSplit, embed};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Vec3, limit_vertices, shapes};

/// A sheet with hills.
fn hills(columns: u32, rows: u32) -> ControlMesh {
    let mut mesh = shapes::grid(columns, rows);
    for p in &mut mesh.points {
        p.z = 0.4 * (0.9 * p.x + 0.3).sin() + 0.3 * (0.7 * p.y * p.x).cos();
    }
    mesh
}

fn bumpy_torus() -> ControlMesh {
    let mut mesh = shapes::torus(7, 6);
    for p in &mut mesh.points {
        *p = (1.0 + 0.05 * (3.0 * p.x + 2.0 * p.y).sin()) * *p;
    }
    mesh
}

/// A curve with a wanted normal near that of the mesh and a curvature at every vertex, or at every second one.
fn wanting(mesh: &ControlMesh, vertices: Vec<u32>, closed: bool, every: usize) -> NetworkCurve {
    let level = Level::new(mesh).unwrap();
    let limits = limit_vertices(&level, &mesh.points);
    let normals = vertices.iter().enumerate().map(|(i, &v)| {
        let tilt = 0.3 * Vec3::new((2.0 * i as f64).sin(), (3.0 * i as f64).cos(), (1.1 * i as f64).sin());
        (i % every == 0).then(|| 3.0 * (limits[v as usize].normal.unwrap() + tilt))
    });
    let curvatures =
        (0..vertices.len()).map(|i| (i % every == 0).then(|| 0.5 - 0.3 * (1.3 * i as f64).sin()));
    NetworkCurve {
        name: format!("{vertices:?}"),
        normals: normals.collect(),
        cross_curvatures: curvatures.collect(),
        vertices,
        closed,
        ..NetworkCurve::default()
    }
}

/// How many vertices met what was wanted; those of warnings are left out.
fn check(name: &str, mesh: &ControlMesh, network: &CurveNetwork) -> (Embedding, usize) {
    let embedding = embed(network, mesh).unwrap();
    let level = Level::new(&embedding.mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &embedding.mesh.points);
    let limits = limit_vertices(&level, &embedding.mesh.points);
    let told = |code: &str, v: u32| embedding.warnings.iter().any(|w| w.code() == code && w.vertex() == v);
    let mut met = 0;
    for segment in &embedding.segments {
        let path = &segment.vertices;
        for k in 0..segment.target.spans() {
            for t in [0.004, 0.37, 0.8] {
                let at = along(&level, &table, [path[k], path[(k + 1) % path.len()]], t);
                let distance = surface.eval(at).position.distance(segment.target.point(k as f64 + t));
                assert!(distance < 1e-12 * mesh.size(), "{name}: the curve is {distance:e} off");
            }
        }
        let curve = &network.curves[segment.curve];
        for (k, &v) in path.iter().enumerate() {
            let Some(i) = curve.vertices.iter().position(|&u| u == v) else { continue };
            let tangent = segment.target.tangent(k);
            let next = if k + 1 < path.len() || segment.target.is_closed() {
                ([v, path[(k + 1) % path.len()]], 0.0)
            } else {
                ([path[k - 1], v], 1.0)
            };
            let jet = surface.jet(along(&level, &table, next.0, next.1));
            if let Some(wanted) = curve.normals.get(i).copied().flatten() {
                let g = tangent.normalized().unwrap();
                let normal = (wanted - g.dot(wanted) * g).normalized().unwrap();
                if !told("W_NORMAL_MISSED", v) {
                    let off = limits[v as usize].normal.unwrap().distance(normal);
                    assert!(off < 1e-10, "{name}: the normal at {v} is {off:e} off");
                    assert!(jet.normal.distance(normal) < 1e-10, "{name}: vertex {v}");
                    met += 1;
                }
            }
            if let Some(wanted) = curve.cross_curvatures.get(i).copied().flatten()
                && !told("W_CROSS_CURVATURE_MISSED", v)
            {
                let found = jet.jet.normal_curvature(jet.normal, jet.normal.cross(tangent)).unwrap();
                assert!((found - wanted).abs() < 1e-9, "{name}: {found} for {wanted} at {v}");
                met += 1;
            }
        }
    }
    (embedding, met)
}

fn network(curves: Vec<NetworkCurve>) -> CurveNetwork {
    CurveNetwork { curves, ..CurveNetwork::default() }
}

#[test]
fn closed_and_open_curves_get_their_normals_and_curvatures() {
    for splits in 0..3 {
        for every in [1, 2] {
            let torus = bumpy_torus();
            let around = wanting(&torus, (0..7).map(|i| 6 * i + 2).collect(), true, every);
            let mut one = network(vec![around]);
            one.options.pre_split = PreSplit::Fixed(splits);
            let (embedding, met) = check("torus", &torus, &one);
            assert_eq!((met, embedding.splits), (if every == 1 { 14 } else { 8 }, splits));
            let sheet = hills(6, 5);
            let across = wanting(&sheet, (0..7).map(|i| 14 + i).collect(), false, every);
            let mut one = network(vec![across]);
            one.options.pre_split = PreSplit::Fixed(splits);
            let (embedding, met) = check("sheet", &sheet, &one);
            assert_eq!(met, if every == 1 { 14 } else { 8 });
            // All of them leaned along the curve.
            let tilted = embedding.warnings.iter().filter(|w| w.code() == "W_NORMAL_TILTED");
            assert_eq!(tilted.count(), if every == 1 { 7 } else { 4 });
        }
    }
}

#[test]
fn around_meeting_points_and_crossings_there_is_a_split_more() {
    // A curve that ends inside, with a normal wanted at the vertex before its end.
    let sheet = hills(7, 6);
    let dangling = wanting(&sheet, vec![3, 11, 19, 27], false, 1);
    let (embedding, met) = check("dangling", &sheet, &network(vec![dangling]));
    assert_eq!(embedding.splits, 1);
    // The end itself takes the normal, and is flat there.
    assert_eq!(met, 7, "{:?}", embedding.warnings);
    let told: Vec<_> = embedding.warnings.iter().filter(|w| w.code() == "W_CROSS_CURVATURE_MISSED").collect();
    assert!(told.len() == 1 && told[0].vertex() == 27 && told[0].value().unwrap() > 1e-3);
    // A crossing of two.
    for crossing in [Crossing::Pin, Crossing::Smooth] {
        let row = wanting(&sheet, (0..8).map(|i| 24 + i).collect(), false, 1);
        let column = wanting(&sheet, (0..7).map(|i| 8 * i + 3).collect(), false, 1);
        let mut both = network(vec![row, column]);
        both.options.crossing = crossing;
        let (embedding, met) = check("crossing", &sheet, &both);
        assert_eq!((embedding.splits, met), (1, 2 * (7 + 6)), "{crossing:?}: {:?}", embedding.warnings);
        let missed = embedding.warnings.iter().filter(|w| w.code() == "W_NORMAL_MISSED" && w.vertex() == 27);
        assert_eq!(missed.count(), 2);
    }
}

#[test]
fn curves_side_by_side_get_a_split_between_them() {
    let sheet = hills(7, 6);
    let rows = [2, 4].map(|j| wanting(&sheet, (0..8).map(|i| 8 * j + i).collect(), false, 1));
    let (embedding, met) = check("side by side", &sheet, &network(rows.to_vec()));
    assert_eq!((embedding.splits, met), (1, 32));
    let mut fixed = network(rows.to_vec());
    fixed.options.pre_split = PreSplit::Fixed(0);
    let (embedding, met) = check("no room", &sheet, &fixed);
    assert!(met < 32, "shared rows are kept");
    let missed = |w: &&NetworkWarning| matches!(w.code(), "W_NORMAL_MISSED" | "W_CROSS_CURVATURE_MISSED");
    assert_eq!(embedding.warnings.iter().filter(missed).count() + met, 32);
}

#[test]
fn border_curves_keep_their_points() {
    let sheet = hills(6, 5);
    let rim = NetworkCurve { name: "rim".into(), vertices: (0..7).collect(), ..NetworkCurve::default() };
    let inner = wanting(&sheet, (0..6).map(|i| 7 * i + 3).collect(), false, 1);
    let (embedding, met) = check("rim", &sheet, &network(vec![rim, inner]));
    let border = embedding.segments.iter().find(|segment| segment.along_border).unwrap();
    for (&v, &point) in border.vertices.iter().zip(border.target.control()) {
        let off = embedding.mesh.points[v as usize].distance(point);
        assert!(off < 1e-15 * sheet.size(), "the border is its curve: vertex {v} is {off:e} off");
    }
    assert_eq!((met, embedding.splits), (10, 0), "{:?}", embedding.warnings);
}

#[test]
fn ribbons_and_polygons_take_normals_too() {
    let mut cube = shapes::cube();
    cube.points.iter_mut().for_each(|p| p.x *= 1.3);
    let mut around = wanting(&cube, vec![0, 1, 3, 2], true, 1);
    around.cross_curvatures.clear();
    let (_, met) = check("cube", &cube, &network(vec![around]));
    assert_eq!(met, 4);
}
