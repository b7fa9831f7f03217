//! `ogee convert`: a cage to smooth NURBS.

use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::curve_network::NetworkCurve;
use ogee_formats::CageFormat;
use ogee_formats::network::{self, NetworkFormat};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::CageArguments;
use crate::error::{Failure, Finding};
use crate::names::{Format, formats};
use crate::part::{Conversion, PartArguments, PartFormat, PartReport};
use crate::report::{Console, Table, bytes};
use crate::{system, timestamp};

/// Convert a cage to solids and sheets of smooth NURBS
#[derive(Debug, Args)]
pub(crate) struct Convert {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    /// The format of the output, where its name does not tell
    #[arg(long, value_name = "FORMAT", value_parser = formats::<PartFormat>())]
    output_format: Option<PartFormat>,
    #[command(flatten)]
    part: PartArguments,
}

impl Format for PartFormat {
    const NAMES: &'static [(&'static str, PartFormat)] = &[
        ("step", PartFormat::Step),
        ("stp", PartFormat::Step),
        ("bv", PartFormat::BezierView),
        ("json", PartFormat::Json),
    ];
    const ELSEWHERE: &'static [&'static str] = &["iges", "igs", "obj"];
    const OPTION: &'static str = "--output-format";
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    part: PartReport,
    seconds: Seconds,
    file_bytes: u64,
    /// The most memory held.
    peak_bytes: Option<u64>,
    /// The most that it would be, as known from counts before patches were made.
    memory_stated: u64,
    notes: &'a [Finding],
}

#[derive(Clone, Copy, Serialize)]
struct Seconds {
    read: f64,
    convert: f64,
    write: f64,
}

impl Convert {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = PartFormat::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let timestamp = timestamp::from_environment()?;
        let progress = console.progress();
        progress.step("reading");
        let (name, cage_format, bytes) = self.cage.load()?;
        let cage = self.cage.parse(name, cage_format, &bytes)?;
        let curves = curves(cage_format, &bytes);
        drop(bytes);
        destination.check()?;

        progress.step("converting");
        let conversion = self.part.convert(&cage, cage.mesh(), &curves, format)?;
        let Conversion { part, seconds: convert, memory_stated } = conversion;

        progress.step("writing");
        let start = Instant::now();
        let stem = self.cage.stem();
        let file_bytes =
            destination.write(|out| self.part.write(&part, format, &destination, &stem, timestamp, out))?;
        let seconds = Seconds { read: cage.seconds, convert, write: start.elapsed().as_secs_f64() };
        drop(progress);

        let mut notes = cage.warnings();
        notes.extend(self.part.notes(&part, &cage.name));
        let report = Report {
            part: self.part.report(&part),
            seconds,
            file_bytes,
            peak_bytes: system::peak_memory(),
            memory_stated,
            notes: &notes,
        };
        let title = format!("{} -> {}", cage.name, destination.name());
        console.table(&title, &table(&report, console.is_verbose()), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The curves that `ogee network` wrote beside a cage.
fn curves(format: CageFormat, bytes: &[u8]) -> Vec<NetworkCurve> {
    // A file without curves is refused, which is no fault here.
    let file = (format == CageFormat::Json).then(|| network::read(bytes, NetworkFormat::Json).ok()).flatten();
    file.map(|file| file.network.curves).unwrap_or_default()
}

fn table(report: &Report<'_>, verbose: bool) -> Table {
    let mut table = Table::default();
    report.part.rows(&mut table, verbose);
    let Seconds { read, convert, write } = report.seconds;
    let total = read + convert + write;
    table.row("seconds", format!("{total:.3} (read {read:.3}, convert {convert:.3}, write {write:.3})"));
    table.row("file", bytes(report.file_bytes));
    table
}
