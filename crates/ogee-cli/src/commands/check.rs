//! `ogee check`: the lint of STEP files.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use ogee_formats::step;
use serde::Serialize;

use crate::cage::read_bytes;
use crate::error::{Exit, Failure, Finding};
use crate::report::{Console, Table, count, figure};

/// Look for everything that is wrong in a STEP file
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The STEP file; - for stdin
    #[arg(value_name = "PART.step")]
    part: PathBuf,
}

/// The report. The `schema` of the file would be taken for that of the report.
#[derive(Serialize)]
struct Report<'a> {
    faults: &'a [Finding],
    entities: usize,
    solids: usize,
    shells: usize,
    faces: usize,
    edges: usize,
    vertices: usize,
    file_schema: &'a Option<String>,
    unit_in_millimetres: Option<f64>,
    uncertainty: Option<f64>,
    volume: Option<f64>,
}

impl Check {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let progress = console.progress();
        progress.step("checking");
        let (name, bytes) = read_bytes(&self.part)?;
        let lint = step::check(&bytes);
        drop(progress);
        let faults: Vec<Finding> = lint.faults.iter().map(|fault| finding(fault, &name)).collect();
        let counts = lint.counts;
        let report = Report {
            faults: &faults,
            entities: counts.entities,
            solids: counts.solids,
            shells: counts.shells,
            faces: counts.faces,
            edges: counts.edges,
            vertices: counts.vertices,
            file_schema: &lint.schema,
            unit_in_millimetres: lint.unit_in_millimetres,
            uncertainty: lint.uncertainty,
            volume: lint.volume,
        };
        console.findings(&faults);
        console.table(&name, &table(&report), &[]);
        console.json(&report)?;
        Ok(if lint.is_clean() { ExitCode::SUCCESS } else { ExitCode::from(Exit::Check as u8) })
    }
}

fn finding(fault: &step::Fault, file: &str) -> Finding {
    let mut finding = Finding::in_file(fault.code, &fault.message, file);
    finding.location.line = fault.line;
    finding.location.id = fault.id;
    finding
}

fn table(report: &Report<'_>) -> Table {
    let mut table = Table::default();
    table.row("faults", report.faults.len().to_string());
    let solids = count(report.solids, "solid", "solids");
    table.row("bodies", format!("{solids}, {}", count(report.shells, "shell", "shells")));
    let edges = count(report.edges, "edge", "edges");
    let vertices = count(report.vertices, "vertex", "vertices");
    table.row("faces", format!("{}, {edges}, {vertices}", report.faces));
    if let Some(schema) = report.file_schema {
        table.row("schema", schema);
    }
    if let Some(unit) = report.unit_in_millimetres {
        table.row("unit", format!("{} mm", figure(unit)));
    }
    if let Some(volume) = report.volume {
        table.row("volume", figure(volume));
    }
    table
}
