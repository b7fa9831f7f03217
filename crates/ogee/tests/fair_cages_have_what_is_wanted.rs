//! Fair cages go through the points and have the normals that are wanted, to rounding; what follows from the rest is named,
//! what contradicts it is refused; and networks keep their curves.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use networks::surface_error;
use ogee::curve_network::{
    CurveNetwork, Embedding, NetworkCurve, NetworkOptions, PointConstraint, PreSplit, embed,
};
use ogee::fairing::{Constraint, FairingError, FairingOptions, fair};
use ogee::{ControlMesh, FaceList, Level, Vec3, VertexId, limit_vertices, shapes};
use std::f64::consts::{PI, TAU};

fn icosahedron() -> ControlMesh {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut points = Vec::new();
    for (a, b) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        points.extend([Vec3::new(0.0, a, b), Vec3::new(a, b, 0.0), Vec3::new(b, 0.0, a)]);
    }
    let mut faces = FaceList::new();
    for i in 0..12_u32 {
        for j in 0..12_u32 {
            for k in 0..12_u32 {
                let [p, q, r] = [i, j, k].map(|v| points[v as usize]);
                let near =
                    [p.distance(q), q.distance(r), r.distance(p)].iter().all(|d| (d - 2.0).abs() < 1e-9);
                if near && i < j && i < k && (q - p).cross(r - p).dot(p) > 0.0 {
                    faces.push(&[i, j, k]);
                }
            }
        }
    }
    ControlMesh::new(points, faces)
}

fn position(vertex: u32, at: Vec3) -> Constraint {
    Constraint::Position { vertex, at }
}

fn limits(mesh: &ControlMesh, points: &[Vec3]) -> Vec<ogee::LimitVertex> {
    limit_vertices(&Level::new(mesh).unwrap(), points)
}

#[test]
fn surfaces_go_through_the_points() {
    for mesh in [icosahedron(), shapes::torus(6, 5), shapes::disk(5, 3), shapes::grid(5, 4)] {
        let wobble = |v: u32| {
            0.1 * Vec3::new((2.0 * f64::from(v)).sin(), f64::from(v).cos(), (3.0 * f64::from(v)).sin())
        };
        let wanted: Vec<Constraint> =
            (0..mesh.points.len() as u32).map(|v| position(v, mesh.points[v as usize] + wobble(v))).collect();
        let faired = fair(&mesh, &wanted, &FairingOptions::default()).unwrap();
        assert!(faired.redundant.is_empty() && faired.residual < 1e-12);
        for (v, limit) in limits(&mesh, &faired.points).iter().enumerate() {
            let Constraint::Position { at, .. } = wanted[v] else { continue };
            assert!(limit.position.distance(at) < 1e-12 * mesh.size(), "vertex {v}");
        }
    }
}

#[test]
fn an_interpolating_icosahedron_is_round() {
    // As many rows as points, and a good system: its solution is the symmetric one, larger than what it goes through.
    let mesh = icosahedron();
    let wanted: Vec<Constraint> = (0..12).map(|v| position(v, mesh.points[v as usize])).collect();
    let faired = fair(&mesh, &wanted, &FairingOptions::default()).unwrap();
    let ratio = faired.points[0].length() / mesh.points[0].length();
    assert!(ratio > 1.2 && ratio < 3.0, "{ratio}");
    for (a, b) in faired.points.iter().zip(&mesh.points) {
        assert!(a.distance(ratio * *b) < 1e-12 * mesh.size());
    }
}

#[test]
fn a_cube_s_corners_depend_on_one_another() {
    // The alternating vector has the limit zero at every corner: eight rows, seven of which say something.
    let cube = shapes::cube();
    let all = |shift: Vec3| {
        let at = |v: u32| cube.points[v as usize] + if v == 7 { shift } else { Vec3::ZERO };
        (0..8).map(|v| position(v, at(v))).collect::<Vec<Constraint>>()
    };
    let faired = fair(&cube, &all(Vec3::ZERO), &FairingOptions::default()).unwrap();
    assert_eq!(faired.redundant, [7]);
    for (limit, corner) in limits(&cube, &faired.points).iter().zip(&cube.points) {
        assert!(limit.position.distance(*corner) < 1e-12 * cube.size());
    }
    let shift = Vec3::new(0.1, 0.0, 0.0);
    match fair(&cube, &all(shift), &FairingOptions::default()) {
        Err(FairingError::Contradiction { constraint: 7, vertex: 7, residual, .. }) => {
            assert!(residual > 1e-3, "{residual}");
        }
        other => panic!("{other:?}"),
    }
    // One fewer, and all is well.
    let faired = fair(&cube, &all(shift)[1..], &FairingOptions::default()).unwrap();
    assert!(faired.redundant.is_empty());
}

#[test]
fn normals_are_met() {
    let mesh = shapes::torus(6, 5);
    let before = limits(&mesh, &mesh.points);
    let wanted_normal = |v: usize| {
        before[v].normal.unwrap()
            + 0.1 * Vec3::new((v as f64).sin(), (2.0 * v as f64).cos(), (3.0 * v as f64).sin())
    };
    let mut wanted = Vec::new();
    for v in (0..mesh.points.len()).step_by(2) {
        wanted.push(position(v as u32, mesh.points[v]));
        wanted.push(Constraint::Normal { vertex: v as u32, normal: wanted_normal(v) });
    }
    for splits in [1, 2] {
        let options = FairingOptions { splits, ..FairingOptions::default() };
        let faired = fair(&mesh, &wanted, &options).unwrap();
        assert_eq!((&faired.redundant, &faired.turned_over), (&vec![], &vec![]));
        let after = limits(&mesh, &faired.points);
        for v in (0..mesh.points.len()).step_by(2) {
            assert!(after[v].position.distance(mesh.points[v]) < 1e-12 * mesh.size());
            let off = after[v].normal.unwrap().distance(wanted_normal(v).normalized().unwrap());
            assert!(off < 1e-10, "vertex {v}: {off:e}");
        }
    }
    let mut upside_down: Vec<Constraint> =
        (1..mesh.points.len()).map(|v| position(v as u32, before[v].position)).collect();
    upside_down.push(Constraint::Normal { vertex: 0, normal: -1.0 * before[0].normal.unwrap() });
    let faired = fair(&mesh, &upside_down, &FairingOptions::default()).unwrap();
    assert_eq!(faired.turned_over, [mesh.points.len() - 1], "rows of normals know no sign");
}

#[test]
fn rows_are_the_masks_of_the_limit() {
    // Inner vertices of valence n in quads: (n^2 v + 4 sum e + sum f) / (n (n + 5)), and tangents that the mask of cosines
    // and sines spans. A cage moved by what the masks say is zero keeps its limit.
    for n in [3_u32, 4, 5, 6, 7] {
        let disk = shapes::disk(n, 2);
        let level = Level::new(&disk).unwrap();
        let topology = level.topology();
        let ring: Vec<_> = topology.ring(VertexId(0)).collect();
        let edges: Vec<u32> = ring.iter().map(|&h| topology.target(h).0).collect();
        let faces: Vec<u32> = ring.iter().map(|&h| topology.target(topology.next(h)).0).collect();
        let m = f64::from(n);
        let sum = |list: &[u32]| list.iter().fold(Vec3::ZERO, |sum, &v| sum + disk.points[v as usize]);
        let limit = (m * m * disk.points[0] + 4.0 * sum(&edges) + sum(&faces)) / (m * (m + 5.0));
        let theta = TAU / m;
        let a = 1.0 + theta.cos() + (PI / m).cos() * (2.0 * (9.0 + theta.cos())).sqrt();
        let tangent = |wave: &dyn Fn(f64) -> f64| {
            (0..n as usize).fold(Vec3::ZERO, |sum, i| {
                let (here, next) = (wave(i as f64 * theta), wave((i + 1) as f64 * theta));
                sum + a * here * disk.points[edges[i] as usize]
                    + (here + next) * disk.points[faces[i] as usize]
            })
        };
        let normal = tangent(&f64::cos).cross(tangent(&f64::sin)).normalized().unwrap();
        // What holds already moves nothing when everything else is fixed, and all of it is redundant.
        let wanted = [position(0, limit), Constraint::Normal { vertex: 0, normal }];
        let fixed = (0..disk.points.len() as u32).collect();
        let faired = fair(&disk, &wanted, &FairingOptions { fixed, splits: 1 }).unwrap();
        assert_eq!((faired.redundant, faired.points), (vec![0, 1], disk.points.clone()), "valence {n}");
        // And a mask that is a little off is refused.
        let wanted = [position(0, limit + Vec3::new(0.0, 0.0, 1e-6))];
        let fixed = (0..disk.points.len() as u32).collect();
        let refused = fair(&disk, &wanted, &FairingOptions { fixed, splits: 1 });
        assert!(matches!(refused, Err(FairingError::Contradiction { vertex: 0, .. })), "{refused:?}");
    }
}

#[test]
fn what_nothing_asks_of_stays() {
    let mesh = shapes::grid(4, 4);
    let faired = fair(&mesh, &[], &FairingOptions::default()).unwrap();
    for (a, b) in faired.points.iter().zip(&mesh.points) {
        assert!(a.distance(*b) < 1e-9, "a plane bends nowhere: the nearest of all planes is itself");
    }
    let bad = [position(99, Vec3::ZERO)];
    assert!(matches!(
        fair(&mesh, &bad, &FairingOptions::default()),
        Err(FairingError::MissingVertex { vertex: 99, .. })
    ));
    let bad = [Constraint::Normal { vertex: 1, normal: Vec3::ZERO }];
    assert!(matches!(
        fair(&mesh, &bad, &FairingOptions::default()),
        Err(FairingError::NoSurface { vertex: 1 })
    ));
    let thrice = FairingOptions { splits: 3, ..FairingOptions::default() };
    assert!(matches!(fair(&mesh, &[], &thrice), Err(FairingError::Splits { splits: 3 })));
}

#[test]
fn networks_keep_their_curves_and_get_their_points() {
    let mut sheet = shapes::grid(8, 7);
    for p in &mut sheet.points {
        p.z = 0.3 * (1.3 * p.x).sin() * (1.1 * p.y).cos() + 0.2 * (7.0 * p.x + 5.0 * p.y).sin();
    }
    let curve = |name: &str, vertices: Vec<u32>| NetworkCurve {
        name: name.into(),
        vertices,
        ..NetworkCurve::default()
    };
    let row = curve("row", (0..9).map(|i| 27 + i).collect());
    let column = curve("column", (0..8).map(|i| 9 * i + 4).collect());
    let shaped = NetworkCurve {
        normals: vec![None, None, Some(Vec3::new(0.1, 0.3, 1.0)), None, None, None, None, None, None],
        ..curve("shaped", (0..9).map(|i| 54 + i).collect())
    };
    let options = NetworkOptions { fair: true, ..NetworkOptions::default() };
    let mut network = CurveNetwork { curves: vec![row, column], options, ..CurveNetwork::default() };
    let point = |vertex: u32, z: f64, normal: Option<Vec3>| PointConstraint {
        vertex,
        position: Some(Vec3::new(sheet.points[vertex as usize].x, sheet.points[vertex as usize].y, z)),
        normal,
    };
    network.points = vec![point(11, 0.8, None), point(51, -0.5, Some(Vec3::new(0.2, 0.1, 1.0)))];
    for splits in [0, 1] {
        network.options.pre_split = PreSplit::Fixed(splits);
        let embedding = embed(&network, &sheet).unwrap();
        assert!(surface_error(&embedding) < 1e-12 * sheet.size(), "{:e}", surface_error(&embedding));
        let found = limits(&embedding.mesh, &embedding.mesh.points);
        for wanted in &network.points {
            let limit = found[wanted.vertex as usize];
            assert!(limit.position.distance(wanted.position.unwrap()) < 1e-11 * sheet.size());
            if let Some(normal) = wanted.normal {
                assert!(limit.normal.unwrap().distance(normal.normalized().unwrap()) < 1e-10);
            }
        }
        let told = |code: &str| code.starts_with("W_CONSTRAINT") || code.starts_with("W_NORMAL");
        assert!(embedding.warnings.iter().all(|w| !told(w.code())), "{:?}", embedding.warnings);
    }
    network.curves[1].vertices.truncate(4);
    network.curves.push(shaped);
    let embedding = embed(&network, &sheet).unwrap();
    assert!(surface_error(&embedding) < 1e-12 * sheet.size());
    // A point on a curve: where the curve is, or nowhere.
    let (segment, at) = embedding
        .segments
        .iter()
        .find_map(|segment| Some((segment, segment.vertices.iter().position(|&v| v == 29)?)))
        .unwrap();
    let on_curve = segment.target.limit(at);
    network.points = vec![PointConstraint { vertex: 29, position: Some(on_curve), normal: None }];
    let told = embed(&network, &sheet).unwrap().warnings;
    assert!(told.iter().any(|w| w.code() == "W_CONSTRAINT_REDUNDANT" && w.vertex() == 29), "{told:?}");
    network.points[0].position = Some(on_curve + Vec3::new(0.0, 0.0, 0.1));
    let error = embed(&network, &sheet).unwrap_err();
    assert_eq!(error.code(), "E_CONTRADICTION");
    assert!(error.to_string().contains("vertex 29"), "{error}");
    network.options.fair = false;
    assert_eq!(embed(&network, &sheet).unwrap_err().code(), "E_POINTS_WITHOUT_FAIRING");
}

#[test]
fn faired_sheets_bend_less() {
    let mut sheet = shapes::grid(8, 8);
    for (i, p) in sheet.points.iter_mut().enumerate() {
        p.z = 0.3 * (17.0 * i as f64).sin();
    }
    let curve = NetworkCurve {
        name: "row".into(),
        vertices: (0..9).map(|i| 36 + i).collect(),
        ..NetworkCurve::default()
    };
    let mut network = CurveNetwork { curves: vec![curve], ..CurveNetwork::default() };
    let rough = |embedding: &Embedding| {
        let points = &embedding.mesh.points;
        let inner = (1..8).flat_map(|j| (1..8).map(move |i| 9 * j + i));
        inner.map(|v| (points[v - 1] + points[v + 1] - 2.0 * points[v]).length()).sum::<f64>()
    };
    let before = rough(&embed(&network, &sheet).unwrap());
    network.options.fair = true;
    let after = rough(&embed(&network, &sheet).unwrap());
    assert!(after < 0.5 * before, "{before} {after}");
}
