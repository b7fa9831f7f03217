//! Section "Distance": how far caps are from the limit surface, level by level.

use anyhow::Result;

use super::fan::Fan;
use super::surface::{Method, with_surface};
use crate::bench::report::Table;

/// Distances first, by valence and level.
const FIRST: [(usize, [f64; 4]); 3] = [
    (3, [2.1e-3, 3.2e-4, 4.6e-5, 6.8e-6]),
    (5, [3.9e-3, 1.4e-3, 4.6e-4, 1.6e-4]),
    (8, [1.8e-2, 8.9e-3, 4.5e-3, 2.2e-3]),
];

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
