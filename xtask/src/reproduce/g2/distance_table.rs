//! Section "Distance": how far caps are from the limit surface, level by level.

use anyhow::Result;

use super::cages::cages;
use super::fan::Fan;
use super::solid_table::part;
use super::surface::{Method, with_surface};
use crate::bench::report::Table;

/// Distances first, by valence and level.
const FIRST: [(usize, [f64; 4]); 3] = [
    (3, [2.1e-3, 3.2e-4, 4.6e-5, 6.8e-6]),
    (5, [3.9e-3, 1.4e-3, 4.6e-4, 1.6e-4]),
    (8, [1.8e-2, 8.9e-3, 4.5e-3, 2.2e-3]),
];

/// Distances of whole parts first, by the diagonal of the cage. The shapes of the plate's holes and of its first one may differ.
const FIRST_OF_SOLIDS: [(&str, f64); 9] = [
    ("cube", 2.9e-3),
    ("trapezohedron 5", 1.7e-3),
    ("trapezohedron 6", 3.0e-3),
    ("trapezohedron 7", 4.6e-3),
    ("trapezohedron 8", 6.4e-3),
    ("trapezohedron 10", 1.0e-2),
    ("trapezohedron 12", 1.3e-2),
    ("corner of 7 cells", 1.5e-2),
    ("plate with two holes", 8e-4),
];

/// A row for each closed cage.
pub(super) fn solids() -> Result<Table> {
    let mut table = Table::new(&["cage", "measured", "first", "apart", "PCCM"]);
    for cage in cages() {
        let Some((_, first)) = FIRST_OF_SOLIDS.iter().find(|(name, _)| *name == cage.name) else { continue };
        let caps = part(&cage.mesh, ogee::convert::Method::G2)?.report.max_deviation_relative;
        let pccm = part(&cage.mesh, ogee::convert::Method::Pccm)?.report.max_deviation_relative;
        let apart = 100.0 * (caps / first - 1.0).abs();
        table.row(&[
            cage.name.clone(),
            format!("{caps:.2e}"),
            format!("{first:.1e}"),
            format!("{apart:.0} %"),
            format!("{pccm:.2e}"),
        ]);
    }
    Ok(table)
}

/// On the saddle of the example, whose edges at the vertex are of length one.
fn distance(valence: usize, level: u32) -> Result<f64> {
    let fan = Fan::new(valence, |x, y| 0.3 * (x * x - y * y));
    with_surface(&fan, Method::Cap(level), |surface| surface.distance(valence))
}

/// A row for each valence and level.
pub(super) fn table() -> Result<Table> {
    let mut table = Table::new(&["n", "level", "measured", "first", "apart"]);
    for (valence, first) in FIRST {
        for (level, first) in (0..).zip(first) {
            let found = distance(valence, level)?;
            let apart = 100.0 * (found / first - 1.0).abs();
            table.row(&[
                valence.to_string(),
                level.to_string(),
                format!("{found:.2e}"),
                format!("{first:.1e}"),
                format!("{apart:.0} %"),
            ]);
        }
    }
    Ok(table)
}
