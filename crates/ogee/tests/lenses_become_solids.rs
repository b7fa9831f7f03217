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

#[test]
fn every_method_makes_one_smooth_solid() {
    let cages = [
        ("globe", globe(8, 7)),
        ("globe of three", globe(3, 4)),
        ("odd globe", globe(7, 5)),
        ("pouch", pouch(4, 8)),
        ("short pouch", pouch(2, 6)),
        ("odd pouch", pouch(5, 9)),
        ("torus with doublets", with_doublets(&shapes::torus(8, 6), 11)),
    ];
    for (name, mesh) in &cages {
        for packing in [Packing::Packed, Packing::Unpacked] {
            for method in [
                Method::Auto,
                Method::Merge,
                Method::Identify,
                Method::Remove,
                Method::C2,
                Method::DegreeRaise,
            ] {
                let part = convert(mesh, method, packing);
                is_one_smooth_solid(&format!("{name}, {}, {packing:?}", method.name()), &part);
            }
        }
    }
}
