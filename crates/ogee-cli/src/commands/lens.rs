//! `ogee lens`: vertices of valence 2 by a construction that was asked for.

use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::convert::Part;
use ogee::lens::{self, LensError, Method, Treated, treat};
use ogee_formats::{json, obj};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{Cage, CageArguments};
use crate::error::{Failure, Finding};
use crate::lenses::{LensReport, lens_counts};
use crate::names::{Format, formats};
use crate::part::{PartArguments, PartFormat, PartReport};
use crate::report::{Console, Table, bytes, count};
use crate::timestamp;

const EXAMPLES: &str = "\
Examples:
  ogee lens wing.obj -o wing.step                   by what neighbourhoods allow, with the reason
  ogee lens wing.obj --method merge -o wing.obj     another cage, without vertices of valence 2
  ogee lens wing.obj --method c2 -o wing.json       patches, curvature-continuous at the lens";

/// Treat vertices of valence 2, and poles: another cage, or a part
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, mut_arg("lens", as_method), mut_arg("method", as_patches))]
pub(crate) struct Lens {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    /// The format of the output, where its name does not tell
    #[arg(long, value_name = "FORMAT", value_parser = formats::<LensOutput>())]
    output_format: Option<LensOutput>,
    #[command(flatten)]
    part: PartArguments,
}

/// What can be written. JSON is a cage where the method makes one, and the patches of a part where it makes caps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LensOutput {
    Obj,
    Json,
    Part(PartFormat),
}

impl Format for LensOutput {
    const NAMES: &'static [(&'static str, LensOutput)] = &[
        ("obj", LensOutput::Obj),
        ("json", LensOutput::Json),
        ("step", LensOutput::Part(PartFormat::Step)),
        ("stp", LensOutput::Part(PartFormat::Step)),
        ("bv", LensOutput::Part(PartFormat::BezierView)),
    ];
    const ELSEWHERE: &'static [&'static str] = &["iges", "igs"];
    const OPTION: &'static str = "--output-format";
}

/// `--lens` of `convert` is `--method` here.
fn as_method(lens: clap::Arg) -> clap::Arg {
    lens.long("method").visible_alias("lens").help(
        "The construction [default: auto, which for a part is polar where circles go around, else merge, and for a cage c1]",
    )
}

/// What makes patches goes by another name here.
fn as_patches(method: clap::Arg) -> clap::Arg {
    method.long("patches")
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    lenses: Vec<LensReport>,
    /// How often the cage was refined first.
    refined: u32,
    /// Of the cage that was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    vertices: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    faces: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<PartReport>,
    seconds: Seconds,
    file_bytes: u64,
    notes: &'a [Finding],
}

#[derive(Clone, Copy, Serialize)]
struct Seconds {
    read: f64,
    treat: f64,
    write: f64,
}

/// What was made.
enum Made {
    Cage(Box<Treated>),
    Part(Box<Part>, PartFormat),
}

impl Lens {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = LensOutput::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let timestamp = timestamp::from_environment()?;
        let progress = console.progress();
        progress.step("reading");
        let cage = self.cage.read()?;
        destination.check()?;

        progress.step("treating");
        let start = Instant::now();
        let made = self.make(&cage, format)?;
        let treat = start.elapsed().as_secs_f64();

        progress.step("writing");
        let start = Instant::now();
        let stem = self.cage.stem();
        let file_bytes = destination.write(|out| match &made {
            Made::Part(part, format) => self.part.write(part, *format, &destination, &stem, timestamp, out),
            Made::Cage(treated) if format == LensOutput::Obj => {
                let comment = format!("{} after ogee lens", cage.name);
                obj::write_cage(&treated.mesh, &comment, out)
            }
            Made::Cage(treated) => json::write_cage(&treated.mesh, out),
        })?;
        let seconds = Seconds { read: cage.seconds, treat, write: start.elapsed().as_secs_f64() };
        drop(progress);

        let mut notes = cage.warnings();
        let (lenses, refined) = match &made {
            Made::Part(part, _) => {
                notes.extend(self.part.notes(part, &cage.name));
                (&part.report.lenses, part.report.lens_steps)
            }
            Made::Cage(treated) => {
                notes.extend(ogee::mesh::notes(cage.mesh()).iter().map(Finding::of_note));
                (&treated.lenses, treated.steps)
            }
        };
        let counts = |count: fn(&Treated) -> usize| match &made {
            Made::Cage(treated) => Some(count(treated)),
            Made::Part(..) => None,
        };
        let report = Report {
            lenses: lenses.iter().map(LensReport::new).collect(),
            refined,
            vertices: counts(|treated| treated.mesh.points.len()),
            faces: counts(|treated| treated.mesh.faces.len()),
            part: match &made {
                Made::Part(part, _) => Some(self.part.report(part)),
                Made::Cage(_) => None,
            },
            seconds,
            file_bytes,
            notes: &notes,
        };
        let title = format!("{} -> {}", cage.name, destination.name());
        console.table(&title, &table(&report, console.is_verbose()), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    /// A cage where the method makes one and the format has them, else a part.
    fn make(&self, cage: &Cage, format: LensOutput) -> Result<Made, Failure> {
        let method = self.part.lens;
        let format = match (format, method) {
            (LensOutput::Part(format), _) => format,
            (LensOutput::Json, Method::C2 | Method::DegreeRaise | Method::Polar) => PartFormat::Json,
            (LensOutput::Obj, Method::C2 | Method::DegreeRaise | Method::Polar) => {
                let name = method.name();
                return Err(Failure::usage(format!(
                    "{name} makes patches, which OBJ does not hold here; write .step, .bv or .json"
                )));
            }
            (LensOutput::Json | LensOutput::Obj, _) => {
                // The rule of every level needs no other cage.
                let method = if method == Method::Auto { Method::C1 } else { method };
                let options = lens::Options { method, ..lens::Options::default() };
                let treated = treat(cage.mesh(), &options).map_err(|error| refusal(cage, &error))?;
                return Ok(Made::Cage(Box::new(treated)));
            }
        };
        let part = self.part.convert(cage, cage.mesh(), &[], format)?.part;
        Ok(Made::Part(Box::new(part), format))
    }
}

/// What a refused treatment means.
pub(crate) fn refusal(cage: &Cage, error: &LensError) -> Failure {
    match error {
        LensError::Mesh(error) => cage.refused(&error.defects),
        _ => cage.failure(error.code(), error.to_string()),
    }
}

fn table(report: &Report<'_>, verbose: bool) -> Table {
    let mut table = Table::default();
    if report.lenses.is_empty() {
        table.row("lenses, poles", "none");
    } else if report.part.is_none() {
        table.row("lenses, poles", lens_counts(&report.lenses));
    }
    if verbose {
        for lens in &report.lenses {
            table.row("", lens.described());
        }
    }
    if report.refined > 0 {
        table.row("refined first", count(report.refined as usize, "time", "times"));
    }
    if let (Some(vertices), Some(faces)) = (report.vertices, report.faces) {
        table.row("cage", format!("{vertices} vertices, {faces} faces"));
    }
    if let Some(part) = &report.part {
        part.rows(&mut table, verbose);
    }
    let Seconds { read, treat, write } = report.seconds;
    let total = read + treat + write;
    table.row("seconds", format!("{total:.3} (read {read:.3}, treat {treat:.3}, write {write:.3})"));
    table.row("file", bytes(report.file_bytes));
    table
}
