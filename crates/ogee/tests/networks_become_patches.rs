//! Cages where curves meet become parts: tangent-continuous, closed where the cage is, with the curves on edges.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and says what it saw"
)]

mod cages;
mod golden;
mod networks;

use golden::{index, list, points};
use networks::{any_network, cases, prepared, walks};
use ogee::convert::{Method, Options, Packing, Part, UpAxis, largest_distance_to_edges, to_part};
use ogee::curve_network::{CurveNetwork, TargetCurve, default_parameter, embed};
use ogee::nurbs::NurbsSurface;
use ogee::pccm::{self, Cap};
use ogee::{ControlMesh, Corner, FaceId, Level, LimitSurface, PatchTable, Sharpness, Vec3, shapes};
use proptest::prelude::*;

const METHODS: [Method; 2] = [Method::Pccm, Method::PccmFirst];

/// Degrees between normals where tangents are in a plane but for rounding.
const ROUNDING: f64 = 1e-9;

/// The same where they may be out of it by as much as counts as lying in it.
const FLAT: f64 = 1e-7;

/// Gaps, angles up to so many degrees and, where there are any, curves.
fn check(name: &str, mesh: &ControlMesh, part: &Part, curves: &[TargetCurve], angle: f64) {
    let (report, size) = (&part.report, mesh.size());
    let off = largest_distance_to_edges(part, curves, UpAxis::Z) / size;
    println!(
        "{name}: level {}, {} faces, gap {:.1e}, angle {:.1e} deg, curves {off:.1e}, deviation {:.2e}, {:?}",
        report.level,
        report.faces_written,
        report.max_gap / size,
        report.max_normal_angle_deg,
        report.max_deviation_relative,
        report.notes.iter().map(|note| note.code).collect::<Vec<_>>(),
    );
    assert!(report.max_gap <= 1e-13 * size, "{name}: gap {:e}", report.max_gap);
    assert!(report.max_normal_angle_deg <= angle, "{name}: {:e} degrees", report.max_normal_angle_deg);
    assert!(off <= 1e-12, "{name}: curves are {off:e} off the edges");
}

fn golden_curves(prepared: &serde_json::Value) -> Vec<TargetCurve> {
    let segments = list(&prepared["segments"]).iter();
    segments
        .map(|segment| {
            TargetCurve::new(points(&segment["control"]), segment["closed"].as_bool().unwrap()).unwrap()
        })
        .collect()
}

/// Edges of the paths of a golden case.
fn golden_edges(prepared: &serde_json::Value) -> Vec<[u32; 2]> {
    let mut edges = Vec::new();
    for segment in list(&prepared["segments"]) {
        let path: Vec<u32> = list(&segment["vertices"]).iter().map(index).collect();
        edges.extend(path.windows(2).map(|pair| [pair[0], pair[1]]));
        if segment["closed"].as_bool().unwrap() {
            edges.push([path[path.len() - 1], path[0]]);
        }
    }
    edges
}

#[test]
fn golden_networks_convert() {
    for (name, document) in cases() {
        let mesh = prepared(&document["prepared"]);
        let curves = golden_curves(&document["prepared"]);
        let seams = golden_edges(&document["prepared"]);
        for method in METHODS {
            for packing in [Packing::Unpacked, Packing::Packed] {
                let options = Options { method, packing, seams: seams.clone(), ..Options::default() };
                let part = to_part(&mesh, &options).unwrap();
                check(&format!("{name} {method:?} {packing:?}"), &mesh, &part, &curves, ROUNDING);
                let plane = !["crossing-pinned", "cube-wireframe", "x3-not-coplanar"].contains(&&name[..]);
                assert_eq!(plane, part.report.notes.iter().all(|note| note.code != "meeting_not_smooth"));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]
    #[test]
    fn random_networks_convert((kind, seeds, forced) in any_network(3)) {
        let cage = networks::cages(kind);
        let mut network = CurveNetwork { curves: walks(&cage, &seeds), ..CurveNetwork::default() };
        network.options.force_ribbons = forced;
        let embedding = embed(&network, &cage).unwrap();
        let name = format!("{kind}: {:?}", network.curves.iter().map(|c| c.vertices.clone()).collect::<Vec<_>>());
        let curves: Vec<TargetCurve> =
            embedding.segments.iter().map(|segment| segment.target.clone()).collect();
        let mut seams = Vec::new();
        for segment in &embedding.segments {
            seams.extend(segment.vertices.windows(2).map(|pair| [pair[0], pair[1]]));
        }
        let method = METHODS[kind % 2];
        let all = [Packing::Packed, Packing::Unpacked];
        // Large cages are slow unpacked.
        let some = if embedding.mesh.faces.len() < 300 { &all[..] } else { &all[..1] };
        for &packing in some {
            let options = Options { method, packing, seams: seams.clone(), ..Options::default() };
            let part = to_part(&embedding.mesh, &options).unwrap();
            check(&name, &embedding.mesh, &part, &curves, FLAT);
        }
    }
}

#[test]
fn any_cage_with_meetings_converts() {
    for (name, mesh) in cages::all() {
        if mesh.meetings.is_empty() {
            continue;
        }
        for method in METHODS {
            let part = to_part(&mesh, &Options { method, ..Options::default() }).unwrap();
            check(&format!("{name} {method:?}"), &mesh, &part, &[], ROUNDING);
        }
    }
}

/// Of a cap and of the limit surface over the same cells: the least of `(S_u x S_v) . n` over the greatest, `n` the normal at
/// the meeting. Below zero it is folded.
fn regularity(mesh: &ControlMesh, level: u32) -> Option<[f64; 2]> {
    let base = Level::new(mesh).unwrap();
    if !base.topology().is_quads() {
        return None;
    }
    let options = pccm::Options { level, ..pccm::Options::default() };
    let patches = pccm::to_patches(&base, &mesh.points, &options).unwrap();
    if patches.notes.iter().any(|note| note.code == "meeting_not_smooth") || patches.caps.is_empty() {
        return None;
    }
    let table = PatchTable::new(&base);
    let limit = LimitSurface::new(&table, &mesh.points);
    let mut worst = [f64::INFINITY; 2];
    for cap in &patches.caps {
        let surface = NurbsSurface { u: Cap::knots(), v: Cap::knots(), net: cap.net.clone() };
        let at = |a: f64, b: f64| {
            let jet = surface.jet(a, b);
            jet.du.cross(jet.dv)
        };
        let of_limit = |a: f64, b: f64| {
            let m = f64::from(1u32 << level);
            let at = cages::at_corner(&base, &table, FaceId(cap.quad), cap.corner, a / m, b / m);
            let jet = limit.eval(at);
            jet.du.cross(jet.dv) / (m * m)
        };
        let normal = at(0.0, 0.0).normalized().unwrap();
        let places = || (0..256).map(|k| (f64::from(k / 16) / 7.5, f64::from(k % 16) / 7.5));
        let ratio = |areas: Vec<f64>| {
            let least = areas.iter().copied().fold(f64::INFINITY, f64::min);
            least / areas.iter().copied().fold(0.0, f64::max)
        };
        let own = ratio(places().map(|(a, b)| at(a, b).dot(normal)).collect());
        let limits = ratio(places().skip(1).map(|(a, b)| of_limit(a, b).dot(normal)).collect());
        worst = [worst[0].min(own), worst[1].min(limits)];
    }
    Some(worst)
}

/// A meeting of unequal curves in one plane, the same every time; what is not theirs lies anywhere.
fn star(seed: u64) -> ControlMesh {
    let ports = 2 + (seed % 5) as u32;
    let mut next = cages::noise(seed);
    let t = [default_parameter(ports as usize), 0.5 * (next() + 0.5).max(0.1)]
        [usize::from(seed % 3 == 2 && ports > 2)];
    let mut mesh = cages::meeting(shapes::disk(2 * ports, 3), 0, 1, t);
    let faces: Vec<Vec<u32>> =
        mesh.faces.iter().filter(|face| face.contains(&0)).map(<[u32]>::to_vec).collect();
    let own = &mesh.meetings[0].ports;
    let is_free = |v: u32| faces.iter().any(|face| face[1] == v || face[3] == v) && !own.contains(&v);
    let slices: Vec<u32> = faces.concat();
    for (v, p) in (0..).zip(&mut mesh.points) {
        let by = Vec3::new(next(), next(), next());
        let flat = v == 0 || slices.contains(&v) && (ports == 2 || !is_free(v));
        *p += 0.6 * by;
        if flat {
            p.z = 0.0;
        }
    }
    mesh
}

#[test]
fn caps_are_as_regular_as_the_limit() {
    let mut seen = 0;
    for seed in 0..120 {
        let mesh = star(seed);
        for level in [2, 4] {
            let Some([own, limit]) = regularity(&mesh, level) else { continue };
            seen += 1;
            println!("{seed}: {} curves, level {level}: {own:.3}, limit {limit:.3}", 2 + seed % 5);
            assert!(own > 0.3 * limit.min(0.5), "{seed}: {own} {limit}");
        }
        let part = to_part(&mesh, &Options::default()).unwrap();
        check(&format!("star {seed}"), &mesh, &part, &[], ROUNDING);
    }
    assert!(seen > 200, "{seen}");
    for (name, document) in cases() {
        let mesh = prepared(&document["prepared"]);
        if let Some([own, limit]) = regularity(&mesh, 3) {
            println!("{name}: {own:.3}, limit {limit:.3}");
            assert!(own > 0.3 * limit.min(0.5), "{name}: {own} {limit}");
        }
    }
}

#[test]
fn deviation_falls_with_the_level() {
    let golden = cases().into_iter().map(|(name, document)| (name, prepared(&document["prepared"])));
    let stars = [3, 4, 5, 6, 7].into_iter().map(|seed| (format!("star {seed}"), star(seed)));
    let small = golden.filter(|(_, mesh)| !mesh.meetings.is_empty() && mesh.faces.len() < 40);
    for (name, mesh) in small.chain(stars) {
        let at = |level: u32| {
            let options = Options { level: Some(level), packing: Packing::Unpacked, ..Options::default() };
            let report = to_part(&mesh, &options).unwrap().report;
            assert!(
                report.max_normal_angle_deg < 1e-8,
                "{name}, level {level}: {:e}",
                report.max_normal_angle_deg
            );
            report.max_deviation_relative
        };
        let least = to_part(&mesh, &Options::default()).unwrap().report.level;
        let figures: Vec<f64> = (least..=5).map(at).collect();
        println!("{name}: {figures:?}");
        for pair in figures.windows(2) {
            assert!(pair[1] < 0.75 * pair[0] || pair[1] < 1e-10, "{name}: {figures:?}");
        }
    }
}

#[test]
fn what_cannot_be_converted_is_refused_by_name() {
    let mesh = star(1);
    let code = |mesh: &ControlMesh, options: Options| to_part(mesh, &options).unwrap_err().code();
    assert_eq!(code(&mesh, Options { level: Some(1), ..Options::default() }), "level_too_low");
    assert_eq!(code(&mesh, Options { seams: vec![[0, 1], [1, 9999]], ..Options::default() }), "seam");
    assert_eq!(code(&mesh, Options { method: Method::Bi5, ..Options::default() }), "meeting");
    // An irregular vertex at the other end of an edge wants a level more: here a corner inside the surface.
    let mut crowded = mesh.clone();
    crowded.corners.push(Corner { vertex: mesh.meetings[0].ports[0], sharpness: Sharpness::Infinite });
    assert_eq!(to_part(&crowded, &Options::default()).unwrap().report.level, 3);
    assert_eq!(code(&crowded, Options { level: Some(2), ..Options::default() }), "level_too_low");
}

/// A star as the lid of a closed box; its bottom has no meeting.
fn lid(seed: u64) -> ControlMesh {
    let mut mesh = star(seed);
    let count = mesh.points.len() as u32;
    let top: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
    let below = mesh.points.iter().map(|p| Vec3::new(p.x, p.y, 0.3 * p.z - 4.0)).collect::<Vec<_>>();
    mesh.points.extend(below);
    let edges: Vec<[u32; 2]> = top
        .iter()
        .flat_map(|face| (0..face.len()).map(move |k| [face[k], face[(k + 1) % face.len()]]))
        .collect();
    for &[a, b] in edges.iter().filter(|&&[a, b]| !edges.contains(&[b, a])) {
        mesh.faces.push(&[b, a, a + count, b + count]);
    }
    for face in &top {
        mesh.faces.push(&face.iter().rev().map(|v| v + count).collect::<Vec<_>>());
    }
    mesh
}

#[test]
fn closed_cages_become_solids() {
    for seed in 0..10 {
        let mesh = lid(seed);
        for method in METHODS {
            let volumes = [Packing::Packed, Packing::Unpacked].map(|packing| {
                let part = to_part(&mesh, &Options { method, packing, ..Options::default() }).unwrap();
                check(&format!("lid {seed} {method:?} {packing:?}"), &mesh, &part, &[], ROUNDING);
                let report = &part.report;
                assert_eq!(
                    (report.solids, report.shells, report.closed, report.sharp_edges),
                    (1, 1, true, 0)
                );
                report.volume.unwrap()
            });
            assert!((volumes[0] - volumes[1]).abs() < 1e-12 * volumes[0]);
        }
    }
}

#[test]
fn irregular_vertices_next_to_a_meeting_are_given_room() {
    // Two cubes side by side: in the middle of an edge of theirs four faces meet, at its ends three.
    let mesh = cages::voxels(&[[0, 0, 0], [1, 0, 0]]);
    let at = |p: [f64; 3]| mesh.points.iter().position(|&q| q == Vec3::from(p)).unwrap() as u32;
    let (centre, port) = (at([1.0, 0.0, 0.0]), at([0.0, 0.0, 0.0]));
    let mut mesh = cages::meeting(mesh.clone(), centre, port, 0.5);
    // So that both tangents are in one line, and unequal.
    mesh.points[centre as usize] = Vec3::new(0.8, 1.0 / 6.0, 1.0 / 6.0);
    for level in [3, 4] {
        for method in METHODS {
            for packing in [Packing::Packed, Packing::Unpacked] {
                let wanted = (level > 3).then_some(level);
                let part = to_part(&mesh, &Options { method, packing, level: wanted, ..Options::default() })
                    .unwrap();
                check(&format!("two cubes {method:?} {packing:?}"), &mesh, &part, &[], ROUNDING);
                let report = &part.report;
                assert_eq!((report.level, report.solids, report.sharp_edges), (level, 1, 0));
            }
        }
    }
}
