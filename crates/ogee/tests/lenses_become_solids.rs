//! Cages with vertices of valence 2 and with poles are converted to one solid each, smooth across everything that was put
//! in their place.

mod lens_cages;

use lens_cages::{globe, pouch, with_doublets};
use ogee::convert::{Options, Packing, Part, to_part};
use ogee::lens::{self, Method};
use ogee::{ControlMesh, shapes};

fn convert(mesh: &ControlMesh, method: Method, packing: Packing) -> Part {
    let lens = lens::Options { method, ..lens::Options::default() };
    to_part(mesh, &Options { lens, packing, ..Options::default() }).expect("a part")
}

fn is_one_smooth_solid(name: &str, part: &Part) {
    let report = &part.report;
    assert_eq!((report.solids, report.shells, report.sharp_edges), (1, 1, 0), "{name}");
    assert!(report.closed && report.volume.is_some_and(|volume| volume > 0.0), "{name}");
    assert!(report.max_normal_angle_deg < 1e-6, "{name}: {}", report.max_normal_angle_deg);
    assert!(report.max_gap < 1e-13, "{name}: {}", report.max_gap);
}

/// The methods that see to every lens.
const METHODS: [Method; 6] =
    [Method::Auto, Method::Merge, Method::Identify, Method::Remove, Method::C2, Method::DegreeRaise];

fn cages() -> Vec<(&'static str, ControlMesh)> {
    vec![
        ("globe", globe(8, 7)),
        ("globe of three", globe(3, 4)),
        ("odd globe", globe(7, 5)),
        ("pouch", pouch(4, 8)),
        ("short pouch", pouch(2, 6)),
        ("odd pouch", pouch(5, 9)),
        ("wing", shapes::lens()),
        ("torus with doublets", with_doublets(&shapes::torus(8, 6), 11)),
        // Caps on the poles first, then refinement for the others.
        ("globe with doublets", with_doublets(&globe(8, 9), 15)),
    ]
}

#[test]
fn every_method_makes_one_smooth_solid() {
    for (name, mesh) in &cages() {
        for packing in [Packing::Packed, Packing::Unpacked] {
            for method in METHODS {
                let part = convert(mesh, method, packing);
                is_one_smooth_solid(&format!("{name}, {}, {packing:?}", method.name()), &part);
            }
        }
    }
}

#[test]
fn packing_loses_nothing_of_caps() {
    for (name, mesh) in &cages() {
        for method in METHODS {
            let [packed, single] =
                [Packing::Packed, Packing::Unpacked].map(|packing| convert(mesh, method, packing));
            let of = |part: &Part| part.report.volume.unwrap_or_default();
            assert!((of(&packed) - of(&single)).abs() < 1e-13 * of(&single), "{name}, {}", method.name());
            assert_eq!(packed.report.patches, single.report.patches, "{name}, {}", method.name());
        }
    }
}

#[test]
fn where_all_else_is_regular_caps_leave_no_jump_of_curvature() {
    for (name, mesh) in &cages()[..7] {
        let polar = convert(mesh, Method::Auto, Packing::Packed);
        assert!(polar.report.max_curvature_jump < 1e-9, "{name}: {}", polar.report.max_curvature_jump);
        // A cap is two faces, and a band goes between two of them.
        assert_eq!(polar.report.faces_written, 5, "{name}");
        assert!(polar.report.max_deviation < 1e-14, "{name}");
        let is_globe = name.contains("globe");
        for method in [Method::C2, Method::DegreeRaise] {
            let jump = convert(mesh, method, Packing::Packed).report.max_curvature_jump;
            // Patches at a lens are some hundredths of the cage: what is rounding of points is that of curvature, too.
            assert!(is_globe || jump < 1e-5, "{name}, {}: {jump}", method.name());
        }
        // What it is measured against: vertices of valence 3.
        let merged = convert(mesh, Method::Merge, Packing::Packed);
        assert!(merged.report.max_curvature_jump > 0.1, "{name}");
    }
}

#[test]
fn every_piece_of_the_cage_has_its_name() {
    use std::collections::BTreeSet;
    for (name, mesh) in &cages()[..7] {
        for packing in [Packing::Packed, Packing::Unpacked] {
            let part = convert(mesh, Method::Auto, packing);
            let faces = part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces);
            let named: BTreeSet<u32> =
                faces.flat_map(|face| face.quads.cells()).map(|piece| piece.face.0).collect();
            assert!(named.iter().copied().eq(0..mesh.faces.len() as u32), "{name}, {packing:?}");
        }
    }
}

#[test]
fn refinement_that_does_not_fit_is_refused() {
    let mesh = with_doublets(&shapes::torus(8, 6), 11);
    let fits = |memory: u64| to_part(&mesh, &Options { memory: Some(memory), ..Options::default() });
    let error = fits(10_000).expect_err("no room");
    assert_eq!(error.code(), "too_deep");
    assert!(error.to_string().contains("room around lenses"), "{error}");
    assert!(fits(1 << 30).is_ok());
}

#[test]
fn a_pole_is_one_point_of_its_faces() {
    let part = convert(&globe(8, 7), Method::Auto, Packing::Unpacked);
    let shell = part.bodies.iter().flat_map(|body| body.shells()).next().expect("a shell");
    let poles: Vec<_> = shell.faces.iter().filter(|face| face.boundary.len() == 3).collect();
    assert_eq!(poles.len(), 16);
    for face in poles {
        let net = &face.surface.net;
        assert!((1..net.cols()).all(|j| net[(0, j)] == net[(0, 0)]));
        assert!(shell.vertices.contains(&net[(0, 0)]));
    }
}
