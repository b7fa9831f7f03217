//! Cages where curves meet become parts: tangent-continuous, closed where the cage is, with the curves on edges.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and says what it saw"
)]

mod golden;
mod networks;

use networks::{cases, prepared};
use ogee::convert::{Method, Options, Packing, to_part};

#[test]
fn golden_networks_convert() {
    for (name, document) in cases() {
        let mesh = prepared(&document["prepared"]);
        for method in [Method::Pccm, Method::PccmFirst] {
            for packing in [Packing::Unpacked, Packing::Packed] {
                let part = to_part(&mesh, &Options { method, packing, ..Options::default() }).unwrap();
                let report = &part.report;
                let size = mesh.size();
                println!(
                    "{name} {method:?} {packing:?}: level {}, {} faces, gap {:.1e}, angle {:.1e} deg, jump {:.1e}, deviation {:.2e} closed {} {:?}",
                    report.level,
                    report.faces_written,
                    report.max_gap / size,
                    report.max_normal_angle_deg,
                    report.max_curvature_jump,
                    report.max_deviation_relative,
                    report.closed,
                    report.notes.iter().map(|note| (note.code, &note.message)).collect::<Vec<_>>(),
                );
            }
        }
    }
}
