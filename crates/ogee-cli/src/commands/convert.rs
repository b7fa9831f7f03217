//! `ogee convert`: a cage to smooth NURBS.

use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::Vec3;
use ogee::convert::{ConvertError, Method, Options, Packing, Part, UpAxis, to_part};
use ogee::pccm::PccmError;
use ogee_formats::step::{Schema, Unit};
use ogee_formats::{bv, patches, step};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{Cage, CageArguments};
use crate::error::{Exit, Failure, Finding};
use crate::names::{Format, METHODS, SCHEMAS, UNITS, UP_AXES, formats};
use crate::output::{Counter, Destination};
use crate::report::{Console, Table, bytes, count, figure};
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
    /// The construction: pccm and pccm-first are bicubic, bi5 is biquintic; all are tangent-continuous
    #[arg(long, default_value = "pccm", value_parser = METHODS)]
    method: Method,
    /// Raise the level until patches and limit surface differ by less than this, in the unit of the file
    #[arg(long, value_name = "D", value_parser = length, allow_negative_numbers = true)]
    max_deviation: Option<f64>,
    /// Steps of refinement before the conversion [default: the least that is right for the cage]
    #[arg(short, long, value_name = "L")]
    level: Option<u32>,
    /// Join quads into large faces [default for STEP]
    #[arg(long, overrides_with = "no_pack")]
    pack: bool,
    /// Write one face per quad [default for BezierView and JSON]
    #[arg(long)]
    no_pack: bool,
    /// What a unit of the cage is
    #[arg(long, default_value = "mm", value_parser = UNITS)]
    unit: Unit,
    /// The application protocol of STEP
    #[arg(long, default_value = "214", value_parser = SCHEMAS)]
    ap: Schema,
    /// The name of the part [default: that of the output file]
    #[arg(long)]
    name: Option<String>,
    /// The axis of the cage that points up; with y the part is turned so that z does
    #[arg(long, value_name = "AXIS", value_parser = UP_AXES)]
    up_axis: Option<UpAxis>,
}

/// A format of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartFormat {
    Step,
    BezierView,
    Json,
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

/// A positive length.
fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length > 0.0 => Ok(length),
        _ => Err("not a positive length".to_owned()),
    }
}

/// Diagonal in millimetres below which the shape drowns in the tolerance of kernels.
const SMALLEST_PART: f64 = 1e-3;

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    method: &'static str,
    level: u32,
    cage_faces: usize,
    patches: usize,
    faces_written: usize,
    edges: usize,
    vertices: usize,
    solids: usize,
    shells: usize,
    closed: bool,
    unit: &'static str,
    volume: Option<f64>,
    area: f64,
    bbox: [[f64; 3]; 2],
    max_normal_angle_deg: f64,
    max_gap: f64,
    max_deviation: f64,
    max_deviation_relative: f64,
    max_curvature_jump: f64,
    smooth_edges: usize,
    sharp_edges: usize,
    seconds: Seconds,
    file_bytes: u64,
    /// The most memory held.
    peak_bytes: Option<u64>,
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
        let cage = self.cage.read()?;
        destination.check()?;

        progress.step("converting");
        let start = Instant::now();
        let part = to_part(cage.mesh(), &self.options(format)).map_err(|error| refusal(&cage, &error))?;
        let convert = start.elapsed().as_secs_f64();

        progress.step("writing");
        let start = Instant::now();
        let file_bytes = destination.write(|out| self.write(&part, format, &destination, timestamp, out))?;
        let seconds = Seconds { read: cage.seconds, convert, write: start.elapsed().as_secs_f64() };
        drop(progress);

        let mut notes = cage.warnings();
        notes.extend(part.report.notes.iter().map(Finding::of_note));
        let [low, high] = part.report.bounding_box;
        let across = low.distance(high) * self.unit.in_millimetres();
        if across < SMALLEST_PART {
            let message = format!(
                "the part is {across:.1e} mm across, and CAD kernels join points 1e-6 mm apart: is the unit right?"
            );
            notes.push(Finding::in_file("tiny", message, &cage.name));
        }
        let report = self.report(&part, seconds, file_bytes, &notes);
        let title = format!("{} -> {}", cage.name, destination.name());
        console.table(&title, &table(&report, console.is_verbose()), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    fn options(&self, format: PartFormat) -> Options {
        let pack = self.pack || (format == PartFormat::Step && !self.no_pack);
        Options {
            method: self.method,
            level: self.level,
            max_deviation: self.max_deviation,
            packing: if pack { Packing::Packed } else { Packing::Unpacked },
            seams: Vec::new(),
            up: self.up_axis.unwrap_or_default(),
            memory: system::available_memory(),
        }
    }

    fn write(
        &self,
        part: &Part,
        format: PartFormat,
        destination: &Destination,
        timestamp: String,
        out: &mut Counter,
    ) -> std::io::Result<()> {
        match format {
            PartFormat::BezierView => bv::write(part, out),
            PartFormat::Json => patches::write(part, out),
            PartFormat::Step => {
                let stem = destination.stem().unwrap_or_else(|| self.cage.stem());
                let name = self.name.clone().unwrap_or_else(|| stem.clone());
                let file_name = match destination {
                    Destination::Stdout => format!("{stem}.step"),
                    Destination::File(path) => {
                        path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
                    }
                };
                let originating_system = concat!("ogee ", env!("CARGO_PKG_VERSION")).to_owned();
                let options = step::Options {
                    unit: self.unit,
                    schema: self.ap,
                    name,
                    file_name,
                    timestamp,
                    originating_system,
                };
                step::write(part, &options, out)
            }
        }
    }

    fn report<'a>(&self, part: &Part, seconds: Seconds, file_bytes: u64, notes: &'a [Finding]) -> Report<'a> {
        let figures = &part.report;
        Report {
            method: figures.method.name(),
            level: figures.level,
            cage_faces: figures.cage_faces,
            patches: figures.patches,
            faces_written: figures.faces_written,
            edges: figures.edges,
            vertices: figures.vertices,
            solids: figures.solids,
            shells: figures.shells,
            closed: figures.closed,
            unit: self.unit.name(),
            volume: figures.volume,
            area: figures.area,
            bbox: figures.bounding_box.map(<[f64; 3]>::from),
            max_normal_angle_deg: figures.max_normal_angle_deg,
            max_gap: figures.max_gap,
            max_deviation: figures.max_deviation,
            max_deviation_relative: figures.max_deviation_relative,
            max_curvature_jump: figures.max_curvature_jump,
            smooth_edges: figures.smooth_edges,
            sharp_edges: figures.sharp_edges,
            seconds,
            file_bytes,
            peak_bytes: system::peak_memory(),
            notes,
        }
    }
}

/// What a refused conversion means: a bad cage, a wrong level, or a wish that was not fulfilled.
fn refusal(cage: &Cage, error: &ConvertError) -> Failure {
    let mut failure = match error {
        ConvertError::Topology(error) => return cage.refused(&error.defects),
        _ => cage.failure(error.code(), error.to_string()),
    };
    failure.exit = match error {
        ConvertError::Deviation { .. } => Exit::Check,
        ConvertError::LevelTooHigh { .. } | ConvertError::Pccm(PccmError::LevelTooLow { .. }) => Exit::Usage,
        _ => Exit::Input,
    };
    failure
}

fn table(report: &Report<'_>, verbose: bool) -> Table {
    let mut table = Table::default();
    let unit = report.unit;
    table.row("cage", count(report.cage_faces, "face", "faces"));
    table.row("method", format!("{} at level {}", report.method, report.level));
    let written = count(report.faces_written, "face", "faces");
    table.row("patches", format!("{}, written as {written}", report.patches));
    let shells = count(report.shells, "shell", "shells");
    let closed = if report.closed { "closed" } else { "open" };
    table.row("part", format!("{} of {shells}, {closed}", count(report.solids, "solid", "solids")));
    table.row("unit", unit);
    if let Some(volume) = report.volume {
        table.row("volume", format!("{} {unit}^3", figure(volume)));
    }
    table.row("area", format!("{} {unit}^2", figure(report.area)));
    let [low, high] = report.bbox.map(Vec3::from);
    let size = <[f64; 3]>::from(high - low).map(figure).join(" x ");
    table.row("size", format!("{size} {unit}"));
    table.row("largest angle", format!("{} deg over smooth edges", figure(report.max_normal_angle_deg)));
    table.row("largest gap", format!("{} {unit}", figure(report.max_gap)));
    let relative = figure(report.max_deviation_relative);
    table.row("deviation", format!("{} {unit}, {relative} of the size", figure(report.max_deviation)));
    if verbose {
        let [low, high] = report.bbox.map(|corner| corner.map(figure).join(" "));
        table.row("bounding box", format!("({low}) to ({high})"));
        table.row("edges", format!("{} smooth, {} sharp", report.smooth_edges, report.sharp_edges));
        table.row("vertices", report.vertices.to_string());
        table.row("curvature jump", figure(report.max_curvature_jump));
    }
    let Seconds { read, convert, write } = report.seconds;
    let total = read + convert + write;
    table.row("seconds", format!("{total:.3} (read {read:.3}, convert {convert:.3}, write {write:.3})"));
    table.row("file", bytes(report.file_bytes));
    table
}
