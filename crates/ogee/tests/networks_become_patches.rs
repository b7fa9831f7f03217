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
use networks::{any_network, cases, mesh, prepared, walks};
use ogee::convert::{
    Body, Method, Options, Packing, Part, UpAxis, largest_distance_to_edges, to_part,
};
use ogee::curve_network::{CurveNetwork, TargetCurve, embed};
use ogee::ControlMesh;
use proptest::prelude::*;

const METHODS: [Method; 2] = [Method::Pccm, Method::PccmFirst];

/// The least of `|S_u x S_v|` over the greatest, in the worst face: samples on every span.
fn regularity(part: &Part) -> f64 {
    let mut worst = f64::INFINITY;
    for face in part.bodies.iter().flat_map(Body::shells).flat_map(|shell| &shell.faces) {
        let stations = |knots: &ogee::nurbs::KnotVector| -> Vec<f64> {
            let breaks = knots.breaks();
            let spans = breaks.windows(2);
            spans.flat_map(|w| [0.0, 0.07, 0.3, 0.6, 1.0].map(|t| w[0] + t * (w[1] - w[0]))).collect()
        };
        let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
        for &u in &stations(&face.surface.u) {
            for &v in &stations(&face.surface.v) {
                let jet = face.surface.jet(u, v);
                let area = jet.du.cross(jet.dv).length();
                (least, greatest) = (least.min(area), greatest.max(area));
            }
        }
        worst = worst.min(least / greatest);
    }
    worst
}

/// Gaps, tangent planes and, where there are any, curves.
fn check(name: &str, mesh: &ControlMesh, part: &Part, curves: &[TargetCurve]) {
    let (report, size) = (&part.report, mesh.size());
    let off = largest_distance_to_edges(part, curves, UpAxis::Z) / size;
    println!(
        "{name}: level {}, {} faces, gap {:.1e}, angle {:.1e} deg, curves {off:.1e}, deviation {:.2e}, regularity {:.3}, {:?}",
        report.level,
        report.faces_written,
        report.max_gap / size,
        report.max_normal_angle_deg,
        report.max_deviation_relative,
        regularity(part),
        report.notes.iter().map(|note| note.code).collect::<Vec<_>>(),
    );
    assert!(report.max_gap <= 1e-13 * size, "{name}: gap {:e}", report.max_gap);
    assert!(report.max_normal_angle_deg <= 1e-9, "{name}: {:e} degrees", report.max_normal_angle_deg);
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
                check(&format!("{name} {method:?} {packing:?}"), &mesh, &part, &curves);
                let plane = !["crossing-pinned", "cube-wireframe", "x3-not-coplanar"].contains(&&name[..]);
                assert_eq!(plane, part.report.notes.iter().all(|note| note.code != "meeting_not_smooth"));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]
    #[test]
    fn random_networks_convert((kind, seeds, forced) in any_network()) {
        let cage = mesh(kind);
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
        for packing in [Packing::Unpacked, Packing::Packed] {
            let options = Options { method, packing, seams: seams.clone(), ..Options::default() };
            let part = to_part(&embedding.mesh, &options).unwrap();
            check(&name, &embedding.mesh, &part, &curves);
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
            check(&format!("{name} {method:?}"), &mesh, &part, &[]);
        }
    }
}
