//! Tables 1 and 2: how long the passes of a picture take, on the processor and on graphics adapters.

use anyhow::Result;
use ogee::quality::{LimitView, Surface};
use ogee_render::{Sampling, Scene, Stages, render};

#[cfg(feature = "gpu")]
use super::adapters::adapters;
use super::interrogation::covering;
use crate::bench::report::Table;

/// Levels of the mesh in table 1.
pub(super) const LEVELS: [u32; 4] = [1, 2, 3, 4];

/// Pixels along a side of the picture there.
pub(super) const SMALL_AND_LARGE: [u32; 2] = [300, 700];

/// Pixels along a side of the picture in table 2; the surface covers all.
pub(super) const SIDES: [u32; 3] = [300, 500, 700];

/// A column of a table.
pub(super) struct Column {
    pub(super) heading: String,
    pub(super) cells: Vec<String>,
}

/// What one device adds to both tables.
pub(super) struct Columns {
    /// What the headings mean by the device.
    pub(super) device: String,
    /// Over [`LEVELS`].
    pub(super) first: Vec<Column>,
    /// Over [`SIDES`].
    pub(super) second: Vec<Column>,
}

const ABOUT: &str = "\
## Tables 1 and 2: time

Best and median of ten after one to warm up, milliseconds of wall time. On the CPU, all cores: \"ids\" is the parameter pass with the
points of its mesh; \"position\" is a step of Newton's method, more where it is not enough, and the point with second derivatives;
\"colour\" is the reflection with its filter. On graphics adapters, each pass from its call until the device is done: \"upload\" makes the
surface's arrays and the mesh, and sends both; \"position\" and \"colour\" are the paper's passes, at the parameters of the mesh;
\"fused\" is both at once, with Newton's method. The paper, on hardware of 2003: ids 0.8, 3 and 12 ms for 300, 1200 and 4800
faces; position 30, 70 and 130 ms, colour 100, 270 and 520 ms for as many pixels as here.

";

/// Measures, writes both tables, and tells which columns they lack.
pub(super) fn tables(page: &mut String, surface: &LimitView<'_>) -> Result<Vec<String>> {
    let (others, lacks) = adapters(surface)?;
    let all: Vec<Columns> = [processor(surface)?].into_iter().chain(others).collect();
    *page += ABOUT;
    *page += &section(surface.layout().squares().len(), &all, &lacks);
    Ok(lacks.into_iter().map(|lack| format!("tables 1 and 2 are without {lack}")).collect())
}

/// Both tables, for a cage of so many quads.
fn section(quads: usize, all: &[Columns], lacks: &[String]) -> String {
    let faces = LEVELS.map(|level| (quads << (2 * level)).to_string());
    let faces = Column { heading: "faces drawn (table 1)".to_owned(), cells: faces.into() };
    let pixels = SIDES.map(|side| (side * side).to_string());
    let pixels = Column { heading: "covered pixels (table 2)".to_owned(), cells: pixels.into() };
    let devices: Vec<&str> = all.iter().map(|columns| columns.device.as_str()).collect();
    let lacks: String = lacks.iter().map(|lack| format!("\n**Not here:** {lack}.\n")).collect();
    format!(
        "{}\n{}\n{}. [The page on performance](../performance.md) says which machine.\n{lacks}",
        table(&faces, all.iter().flat_map(|columns| &columns.first)),
        table(&pixels, all.iter().flat_map(|columns| &columns.second)),
        devices.join("; ")
    )
}

fn table<'a>(first: &'a Column, rest: impl Iterator<Item = &'a Column>) -> Table {
    let columns: Vec<&Column> = [first].into_iter().chain(rest).collect();
    let headings: Vec<&str> = columns.iter().map(|column| column.heading.as_str()).collect();
    let mut table = Table::new(&headings);
    for row in 0..first.cells.len() {
        let cells: Vec<&str> = columns.iter().map(|column| column.cells[row].as_str()).collect();
        table.row(&cells);
    }
    table
}

#[cfg(not(feature = "gpu"))]
fn adapters(_surface: &LimitView<'_>) -> Result<(Vec<Columns>, Vec<String>)> {
    let lack = "the columns of graphics adapters, which `cargo xtask-gpu reproduce interrogation` makes";
    Ok((Vec::new(), vec![lack.to_owned()]))
}

fn processor(surface: &LimitView<'_>) -> Result<Columns> {
    let mut first = Vec::new();
    for side in SMALL_AND_LARGE {
        let cells = LEVELS.iter().map(|&level| {
            let scene = Scene { sampling: Sampling::Parameters(level), ..covering(surface, side) };
            Ok(spread(&stages(surface, &scene)?, |stages| stages.ids))
        });
        let cells = cells.collect::<Result<_>>()?;
        first.push(Column { heading: format!("CPU: ids, {side} x {side}"), cells });
    }
    let runs = SIDES.map(|side| stages(surface, &covering(surface, side)));
    let runs = runs.into_iter().collect::<Result<Vec<_>>>()?;
    let column = |name: &str, stage: fn(&Stages) -> f64| Column {
        heading: format!("CPU: {name}"),
        cells: runs.iter().map(|runs| spread(runs, stage)).collect(),
    };
    let second = vec![
        column("position", |stages| stages.position),
        column("colour", |stages| stages.colour),
        column("all", |stages| stages.ids + stages.position + stages.colour),
    ];
    let device = format!("CPU: {} cores", rayon::current_num_threads());
    Ok(Columns { device, first, second })
}

/// Ten pictures, after one; all pixels show the surface.
fn stages(surface: &dyn Surface, scene: &Scene) -> Result<Vec<Stages>> {
    let pixels = scene.size[0] as usize * scene.size[1] as usize;
    anyhow::ensure!(render(surface, scene)?.fragments == pixels, "the surface does not cover the picture");
    (0..10).map(|_| Ok(render(surface, scene)?.seconds)).collect()
}

/// Best and median in milliseconds.
pub(super) fn spread<T>(runs: &[T], seconds: impl Fn(&T) -> f64) -> String {
    let mut times: Vec<f64> = runs.iter().map(|run| 1e3 * seconds(run)).collect();
    times.sort_unstable_by(f64::total_cmp);
    format!("{:.1} / {:.1}", times[0], times[times.len() / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_beside_each_other_and_what_lacks_is_said() {
        let column = |heading: &str, cells: &[&str]| Column {
            heading: heading.to_owned(),
            cells: cells.iter().map(|&cell| cell.to_owned()).collect(),
        };
        let device = |name: &str| Columns {
            device: format!("{name}: of wood"),
            first: vec![column(&format!("{name}: ids"), &["a", "b", "c", "d"])],
            second: vec![column(&format!("{name}: fused"), &["x", "y", "z"])],
        };
        let page = section(10, &[device("abacus"), device("loom")], &["the columns of a mill".to_owned()]);
        for line in [
            "| faces drawn (table 1) | abacus: ids | loom: ids |",
            "| 2560 | d | d |",
            "| 490000 | z | z |",
            "**Not here:** the columns of a mill.",
        ] {
            assert!(page.lines().any(|found| found.trim() == line), "{line} in {page}");
        }
        assert!(page.contains("abacus: of wood; loom: of wood."));
        assert_eq!(spread(&[0.003, 0.001, 0.002], |&seconds| seconds), "1.0 / 2.0");
    }
}
