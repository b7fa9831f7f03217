//! Section "Solids": closed cages as parts, by their own reports.

use std::collections::BTreeMap;

use anyhow::Result;
use ogee::convert::{Method, Options, Packing, Part, to_part};
use ogee::nurbs::{FaceAddress, ShellFace};

use super::cages::cages;
use crate::bench::report::Table;

/// Faces, those that are sectors of caps, the largest angle in degrees and the largest jump of curvature times the diagonal, as they
/// were first, in the order of the cages.
const FIRST: [(usize, usize, f64, f64); 13] = [
    (24, 24, 1e-12, 1e-12),
    (40, 40, 2e-12, 5e-12),
    (48, 48, 2e-12, 9e-12),
    (56, 56, 2e-12, 7e-12),
    (64, 64, 2e-12, 1e-11),
    (80, 80, 2e-12, 2e-11),
    (96, 96, 3e-12, 5e-11),
    (84, 24, 4e-12, 4e-11),
    (140, 40, 4e-12, 3e-11),
    (224, 64, 8e-12, 1.4e-10),
    (87, 48, 3e-12, 1e-11),
    (176, 104, 6e-12, 5e-11),
    (120, 120, 4e-12, 3e-11),
];

/// How much larger than first figures that are rounding may be.
#[cfg(test)]
const ROUNDING: f64 = 20.0;

pub(super) fn part(mesh: &ogee::ControlMesh, method: Method) -> Result<Part> {
    Ok(to_part(mesh, &Options { method, packing: Packing::Unpacked, ..Options::default() })?)
}

fn faces(part: &Part) -> impl Iterator<Item = &ShellFace> {
    part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces)
}

/// Refinements that lead from a cage of quads to a piece of it.
fn level(piece: &FaceAddress) -> u32 {
    piece.corner.map_or(0, |_| 1 + piece.quarters.depth())
}

/// Faces of degree seven.
fn sectors(part: &Part) -> usize {
    faces(part).filter(|face| face.surface.u.degree() == 7).count()
}

/// `18 + 60`: faces of level 0, of level 1, and so on.
fn by_level(part: &Part) -> String {
    let mut counts = BTreeMap::new();
    for face in faces(part) {
        *counts.entry(level(&face.address())).or_insert(0) += 1;
    }
    let words: Vec<String> =
        counts.iter().map(|(level, count)| format!("{count} of level {level}")).collect();
    words.join(", ")
}

/// A row for each cage.
pub(super) fn table() -> Result<Table> {
    let mut table = Table::new(&[
        "cage",
        "faces (of caps)",
        "first",
        "levels",
        "angle, deg",
        "first",
        "jump x diagonal",
        "first",
        "PCCM: jump x diagonal",
    ]);
    for (cage, first) in cages().iter().zip(FIRST) {
        let (caps, pccm) = (part(&cage.mesh, Method::G2)?, part(&cage.mesh, Method::Pccm)?);
        let (faces, sectors, angle, jump) = first;
        table.row(&[
            cage.name.clone(),
            format!("{} ({})", caps.report.faces_written, self::sectors(&caps)),
            format!("{faces} ({sectors})"),
            by_level(&caps),
            format!("{:.0e}", caps.report.max_normal_angle_deg),
            format!("{angle:.0e}"),
            format!("{:.0e}", caps.report.max_curvature_jump),
            format!("{jump:.1e}"),
            format!("{:.2}", pccm.report.max_curvature_jump),
        ]);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_have_the_faces_they_had_first_and_no_jumps() {
        for (cage, (faces, sectors, angle, jump)) in cages().iter().zip(FIRST) {
            let part = part(&cage.mesh, Method::G2).unwrap();
            let report = &part.report;
            let found = (report.solids, report.faces_written, self::sectors(&part));
            assert_eq!(found, (1, faces, sectors), "{}", cage.name);
            assert!(report.max_normal_angle_deg < ROUNDING * angle, "{}: {report:?}", cage.name);
            assert!(report.max_curvature_jump < ROUNDING * jump, "{}: {report:?}", cage.name);
        }
    }
}
