//! `convert --method g2`: caps of the coarsest level around every irregular vertex, one closed shell, and no jump of curvature
//! anywhere that a cap can be.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use std::collections::BTreeMap;

use cages::{creased, noise, sharp_at, voxels, with_boundary};
use ogee::convert::{ConvertError, Method, NodeKind, Options, Packing, Part, to_part};
use ogee::g2_caps::CapClass;
use ogee::{Boundary, ControlMesh, FaceList, Vec3, shapes};
use serde_json::Value;

fn g2() -> Options {
    Options { method: Method::G2, packing: Packing::Unpacked, ..Options::default() }
}

fn convert(mesh: &ControlMesh) -> Part {
    to_part(mesh, &g2()).unwrap()
}

/// True if every irregular vertex has a cap, so that nothing excuses a jump.
fn is_capped(part: &Part) -> bool {
    part.report.nodes.iter().all(|node| matches!(node.kind, NodeKind::Cap(_)))
}

#[test]
fn golden_cages() {
    let text = std::fs::read("../../testdata/g2_caps/meshes.json").unwrap();
    let golden: Value = serde_json::from_slice(&text).unwrap();
    for cage in golden["meshes"].as_array().unwrap() {
        let point = |p: &Value| Vec3::from([0, 1, 2].map(|k| p[k].as_f64().unwrap()));
        let list = |name: &str| cage[name].as_array().unwrap();
        let points: Vec<Vec3> = list("vertices").iter().map(point).collect();
        let mut faces = FaceList::new();
        for quad in list("quads") {
            faces.push(&[0, 1, 2, 3].map(|k| quad[k].as_u64().unwrap() as u32));
        }
        let part = convert(&ControlMesh::new(points, faces));
        let report = &part.report;
        let name = cage["name"].as_str().unwrap();
        assert_eq!(report.faces_written, cage["faces"].as_u64().unwrap() as usize, "{name}");
        assert_eq!(report.solids, 1, "{name}");

        let mut caps: BTreeMap<String, u64> = BTreeMap::new();
        for node in &report.nodes {
            let NodeKind::Cap(CapClass::Interior { valence }) = node.kind else { panic!("{name}: {node:?}") };
            *caps.entry(format!("n={valence} level {}", node.level)).or_default() += 1;
        }
        let expected: BTreeMap<String, u64> = serde_json::from_value(cage["caps"].clone()).unwrap();
        assert_eq!(caps, expected, "{name}");

        // Volumes are exact; areas are sums over points, here others than there.
        for (figure, wanted, tolerance) in
            [(report.volume.unwrap(), "volume", 1e-11), (report.area, "area", 1e-9)]
        {
            let wanted = cage[wanted].as_f64().unwrap();
            assert!((figure - wanted).abs() < tolerance * wanted, "{name}: {figure} and {wanted}");
        }
        let mut centres: Vec<[f64; 3]> = Vec::new();
        for face in part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces) {
            if face.surface.u.degree() == 7 {
                centres.push(face.surface.net[(0, 0)].into());
            }
        }
        for wanted in list("cap_centres").iter().map(point) {
            let sectors = centres.iter().filter(|&&c| Vec3::from(c).distance(wanted) < 1e-11).count();
            assert!(sectors >= 3, "{name}: no cap at {wanted:?}");
        }
    }
}

/// `2 x n` quads between two poles of valence `n`.
fn trapezohedron(n: u32) -> ControlMesh {
    let mut points = vec![Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -1.0)];
    for k in 0..2 * n {
        let angle = std::f64::consts::PI * f64::from(k) / f64::from(n);
        points.push(Vec3::new(angle.cos(), angle.sin(), if k % 2 == 0 { 0.25 } else { -0.25 }));
    }
    let at = |k: u32| 2 + k % (2 * n);
    let mut faces = FaceList::new();
    for k in 0..n {
        faces.push(&[0, at(2 * k), at(2 * k + 1), at(2 * k + 2)]);
        faces.push(&[1, at(2 * k + 3), at(2 * k + 2), at(2 * k + 1)]);
    }
    ControlMesh::new(points, faces)
}

#[test]
fn closed_cages_have_no_jump() {
    let jack = [[0, 0, 0], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let plate: Vec<[i32; 3]> = (0..7)
        .flat_map(|x| (0..5).map(move |y| [x, y, 0]))
        .filter(|&[x, y, _]| !((y == 2) && (x == 2 || x == 4)))
        .collect();
    let mut all = vec![("jack".to_owned(), voxels(&jack)), ("plate of genus 2".to_owned(), voxels(&plate))];
    all.extend([5, 6, 7, 8, 10, 12, 11, 17].map(|n| (format!("trapezohedron {n}"), trapezohedron(n))));
    for (name, cage) in all {
        for packing in [Packing::Unpacked, Packing::Packed] {
            let part = to_part(&cage, &Options { packing, ..g2() }).unwrap();
            let report = &part.report;
            assert!(is_capped(&part) && report.solids == 1, "{name}");
            assert!(report.max_curvature_jump <= 1e-9, "{name}: {}", report.max_curvature_jump);
            assert!(report.max_normal_angle_deg <= 1e-9, "{name}: {}", report.max_normal_angle_deg);
            assert!(report.max_gap <= 1e-14, "{name}: {}", report.max_gap);
        }
    }
}

/// Tangent-continuous parts fail the claim on jumps by ten orders of magnitude.
#[test]
fn jumps_are_found_where_there_are_some() {
    let cage = trapezohedron(5);
    let part = to_part(&cage, &Options { method: Method::Pccm, ..g2() }).unwrap();
    assert!(part.report.max_curvature_jump > 0.1, "{}", part.report.max_curvature_jump);
}

#[test]
fn any_cage_becomes_a_part() {
    for (name, cage) in cages::all() {
        let part = match to_part(&cage, &g2()) {
            Ok(part) => part,
            Err(ConvertError::NoSurface | ConvertError::Pccm(_) | ConvertError::Lens(_)) => continue,
            Err(error) => panic!("{name}: {error}"),
        };
        let report = &part.report;
        let pccm = to_part(&cage, &Options { method: Method::Pccm, ..g2() });
        if let Ok(pccm) = &pccm {
            assert_eq!((report.solids, report.shells), (pccm.report.solids, pccm.report.shells), "{name}");
            assert_eq!(report.closed, pccm.report.closed, "{name}");
        }
        assert!(report.max_gap <= 1e-12, "{name}: {}", report.max_gap);
        let notes = report.notes.iter().filter(|note| note.code == "no_cap").count();
        let smoothed = report.nodes.iter().filter(|node| node.kind == NodeKind::Smoothed).count();
        assert_eq!(notes, smoothed, "{name}: what has no cap is named");
        if is_capped(&part) {
            assert!(report.max_normal_angle_deg <= 1e-8, "{name}: {}", report.max_normal_angle_deg);
            assert!(report.max_curvature_jump <= 1e-8, "{name}: {}", report.max_curvature_jump);
        } else {
            println!(
                "{name}: {:?} {} {}",
                report
                    .nodes
                    .iter()
                    .filter(|n| n.kind == NodeKind::Smoothed)
                    .map(|n| n.place)
                    .collect::<Vec<_>>(),
                report.max_normal_angle_deg,
                report.max_curvature_jump
            );
        }
        let packed = to_part(&cage, &Options { packing: Packing::Packed, ..g2() }).unwrap().report;
        assert!(packed.faces_written <= report.faces_written, "{name}");
        assert!((packed.area - report.area).abs() <= 1e-8 * report.area, "{name}");
        assert_eq!(packed.faces_by_level, report.faces_by_level, "{name}");
    }
}

#[test]
fn only_what_deviates_goes_deeper() {
    let cage = trapezohedron(7);
    let first = convert(&cage).report;
    let least = first.nodes.iter().map(|node| node.deviation).fold(f64::MAX, f64::min);
    assert!(first.max_deviation > 3.0 * least);
    let wanted = first.max_deviation / 3.0;
    let report = to_part(&cage, &Options { max_deviation: Some(wanted), ..g2() }).unwrap().report;
    assert!(report.max_deviation < wanted);
    assert!(report.max_curvature_jump <= 1e-9, "{}", report.max_curvature_jump);
    for (before, node) in first
        .nodes
        .iter()
        .map(|before| (before, report.nodes.iter().find(|n| n.place == before.place).unwrap()))
    {
        assert_eq!(node.level > before.level, before.deviation >= wanted, "{before:?} {node:?}");
    }
    let fixed = to_part(&cage, &Options { max_deviation: Some(wanted), level: Some(1), ..g2() });
    assert!(matches!(fixed, Err(ConvertError::Deviation { .. })));
    for nothing in [f64::NAN, 0.0] {
        let refused = to_part(&shapes::torus(8, 6), &Options { max_deviation: Some(nothing), ..g2() });
        assert!(matches!(refused, Err(ConvertError::Deviation { .. })), "{nothing}");
    }
    let hopeless = to_part(&cage, &Options { max_deviation: Some(1e-12), ..g2() });
    assert!(matches!(hopeless, Err(ConvertError::Deviation { level: 6, .. })));
}

#[test]
fn deviations_are_those_of_the_page() {
    let relative = |mesh: &ControlMesh| convert(mesh).report.max_deviation_relative;
    for (cage, wanted) in [
        (shapes::cube(), 2.9e-3),
        (trapezohedron(6), 3.0e-3),
        (trapezohedron(8), 6.4e-3),
        (trapezohedron(12), 1.3e-2),
    ] {
        let found = relative(&cage);
        assert!((found - wanted).abs() < 0.05 * wanted, "{found} and {wanted}");
    }
}

/// A sheet of `n` quads a side with hills.
fn sheet(n: u32) -> ControlMesh {
    let mut random = noise(7);
    let mut mesh = cages::grid(n, n);
    mesh.points.iter_mut().for_each(|p| p.z += 0.3 * random());
    mesh
}

#[test]
fn one_triangle_costs_only_its_neighbourhood() {
    let mut mesh = sheet(20);
    let corner = mesh.faces.iter().next().unwrap().to_vec();
    // A corner of the sheet cut off.
    let mut faces = FaceList::new();
    faces.push(&[corner[1], corner[2], corner[3]]);
    mesh.faces.iter().skip(1).for_each(|face| faces.push(face));
    mesh.faces = faces;
    let (mesh, _) = without_loose(mesh);
    let report = convert(&mesh).report;
    assert!(report.patches <= 400 + 60, "{}", report.patches);
    assert!(report.max_curvature_jump <= 1e-8);
}

/// A cage without the vertices that no face uses.
fn without_loose(mesh: ControlMesh) -> (ControlMesh, usize) {
    let mut used = vec![false; mesh.points.len()];
    mesh.faces.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut number = 0;
    let numbers: Vec<u32> = used
        .iter()
        .map(|&used| {
            let own = number;
            number += u32::from(used);
            own
        })
        .collect();
    let points = mesh.points.iter().zip(&used).filter(|(_, used)| **used).map(|(&p, _)| p).collect();
    let mut faces = FaceList::new();
    for face in mesh.faces.iter() {
        faces.push(&face.iter().map(|&v| numbers[v as usize]).collect::<Vec<_>>());
    }
    (ControlMesh::new(points, faces), number as usize)
}

#[test]
fn semi_sharp_creases_are_refined_until_they_fade() {
    let mesh = creased(sheet(8), &[[30, 31], [31, 32]], 2.5);
    let report = convert(&mesh).report;
    let levels = &report.faces_by_level;
    assert_eq!(report.level, 3);
    assert!(levels[0].steps == 0 && levels[0].faces > 30, "{levels:?}");
    assert!(report.max_curvature_jump <= 1e-8 && report.max_gap <= 1e-14);
}

#[test]
fn what_has_no_cap_is_named() {
    // One face at each corner of a boundary that has no corners.
    let mesh = with_boundary(sheet(4), Boundary::EdgeOnly);
    let report = convert(&mesh).report;
    let notes: Vec<&str> = report.notes.iter().map(|note| note.code).collect();
    assert_eq!(notes, ["no_cap"; 4]);
    for note in &report.notes {
        assert!(note.message.contains(&note.place.unwrap().to_string()), "{note:?}");
    }
    // A cone.
    let mesh = sharp_at(sheet(4), &[12], f64::INFINITY);
    let report = convert(&mesh).report;
    let [note] = &report.notes[..] else { panic!("{:?}", report.notes) };
    assert!(note.message.contains("vertex 12 "), "{note:?}");
}

#[test]
fn folded_caps_are_named() {
    let mut mesh = trapezohedron(6);
    // A pole drawn over the rim, so that the quads behind it lie on those before it.
    mesh.points[0] = Vec3::new(4.0, 0.0, 0.0);
    let report = convert(&mesh).report;
    let folded: Vec<_> = report.notes.iter().filter(|note| note.code == "folded_cap").collect();
    assert!(!folded.is_empty(), "{:?}", report.nodes);
    let sound = convert(&trapezohedron(6)).report;
    assert!(sound.notes.is_empty());
    assert!(sound.nodes.iter().all(|node| node.regularity.unwrap() > 0.05), "{:?}", sound.nodes);
}

#[test]
fn what_does_not_fit_is_refused() {
    let refused = to_part(&trapezohedron(6), &Options { memory: Some(100_000), ..g2() });
    assert!(matches!(refused, Err(ConvertError::Memory { patches: 48, .. })), "{refused:?}");
}

#[test]
fn numbers_change_nothing() {
    let cage = voxels(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1]]);
    let count = cage.points.len();
    let points = cage.points.iter().rev().copied().collect();
    let mut faces = FaceList::new();
    let mut all: Vec<Vec<u32>> =
        cage.faces.iter().map(|face| face.iter().map(|&v| count as u32 - 1 - v).collect()).collect();
    all.rotate_left(5);
    for (k, face) in all.iter_mut().enumerate() {
        face.rotate_left(k % 4);
        faces.push(face);
    }
    let (one, other) = (convert(&cage).report, convert(&ControlMesh::new(points, faces)).report);
    assert_eq!(
        (one.faces_by_level, one.faces_written, one.nodes.len()),
        (other.faces_by_level.clone(), other.faces_written, other.nodes.len())
    );
    assert!((one.volume.unwrap() - other.volume.unwrap()).abs() < 1e-12);
    assert!((one.max_deviation - other.max_deviation).abs() < 1e-9);
}
