//! The shipped weights of G2 caps, made again.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result};
use ogee::g2_caps::{Weights, encode, generate, residuals, shipped_classes, table_name, weights};

/// Where the tables are that the library ships.
pub(crate) fn folder(root: &Path) -> PathBuf {
    root.join("crates/ogee/src/g2_caps/tables")
}

/// Writes the tables of all shipped classes into a folder, and tells of each how well it holds, how long it took, and how far it is
/// from the one that this program was built with.
pub(crate) fn write_all(folder: &Path, out: &mut impl Write) -> Result<()> {
    writeln!(
        out,
        "{:<18} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9}",
        "table", "values", "tangents", "curvature", "row sum", "seconds", "moved by"
    )?;
    for class in shipped_classes() {
        let name = table_name(class);
        let began = Instant::now();
        let made = generate(class).with_context(|| format!("{name}: there are no such weights"))?;
        let seconds = began.elapsed().as_secs_f64();
        let shipped = weights(class).with_context(|| format!("{name}: the shipped table cannot be read"))?;
        let [values, tangents, curvatures] = residuals(&made);
        writeln!(
            out,
            "{name:<18} {values:8.0e} {tangents:8.0e} {curvatures:9.0e} {:8.3} {seconds:8.2} {:9.0e}",
            largest_row_sum(&made),
            distance(&made, &shipped)
        )?;
        let path = folder.join(format!("{name}.bin"));
        std::fs::write(&path, encode(&made))
            .with_context(|| format!("{} cannot be written", path.display()))?;
    }
    Ok(())
}

/// The largest sum of the absolute weights of a row: what an error of the points grows by.
fn largest_row_sum(weights: &Weights) -> f64 {
    let rows = weights.sectors.iter().flat_map(|sector| sector.cells().chunks(sector.cols()));
    rows.map(|row| row.iter().map(|weight| weight.abs()).sum()).fold(0.0, f64::max)
}

/// The largest difference of two weights.
fn distance(one: &Weights, other: &Weights) -> f64 {
    let cells =
        |weights: &Weights| weights.sectors.iter().flat_map(|grid| grid.cells().to_vec()).collect::<Vec<_>>();
    cells(one).iter().zip(cells(other)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
