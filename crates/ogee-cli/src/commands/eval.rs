//! `ogee eval`: the limit surface at given points, or on a grid over every face.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::{Derivatives, ParametricFace};
use ogee_formats::samples::SampleFormat;
use serde::Serialize;

use crate::addresses::{Grid, Points, PointsFormat, Source};
use crate::arguments::OutputArguments;
use crate::cage::CageArguments;
use crate::error::{Failure, Finding};
use crate::evaluation::{Evaluation, Figures, Special};
use crate::names::{DERIVATIVES, Format, formats};
use crate::output::Stopped;
use crate::report::{Console, Table, bytes};
use crate::system;
use crate::treatment::{CageSurface, LensArguments};

const EXAMPLES: &str = "\
Examples:
  ogee eval cage.obj --at points.csv -o samples.csv          rows of face,corner,u,v
  ogee eval cage.obj --uniform 8 --derivatives 2 -o all.jsonl
  ogee eval wing.obj --lens c2 --uniform 8 --derivatives 2 -o wing.csv  curvature at lenses too";

/// Evaluate the limit surface, with derivatives, normals and curvatures
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Eval {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    #[command(flatten)]
    lenses: LensArguments,
    /// Where to evaluate: face, corner, u and v in JSON lines or CSV; - for stdin
    #[arg(long, value_name = "POINTS", required_unless_present = "uniform", conflicts_with = "uniform")]
    at: Option<PathBuf>,
    /// Evaluate on a grid of K by K cells over every face
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..=FINEST_GRID))]
    uniform: Option<u32>,
    /// 0 is position alone, 1 first derivatives and the normal as well, 2 second derivatives and curvatures
    #[arg(long, value_name = "ORDER", default_value = "1", value_parser = DERIVATIVES)]
    derivatives: Derivatives,
    /// The format of the output, where its name does not tell
    #[arg(long, value_name = "FORMAT", visible_alias = "output-format", value_parser = formats::<SampleFormat>())]
    format: Option<SampleFormat>,
    /// The format of the points, where their name does not tell
    #[arg(long, value_name = "FORMAT", conflicts_with = "uniform", value_parser = formats::<PointsFormat>())]
    points_format: Option<PointsFormat>,
}

/// Cells along a side of a face; a hundred million points on each are more than files are good for.
const FINEST_GRID: i64 = 10_000;

impl Format for SampleFormat {
    const NAMES: &'static [(&'static str, SampleFormat)] = &[
        ("jsonl", SampleFormat::JsonLines),
        ("ndjson", SampleFormat::JsonLines),
        ("csv", SampleFormat::Csv),
    ];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--format";
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    samples: u64,
    /// Those that are part of the surface.
    parametric_faces: usize,
    derivatives: u32,
    #[serde(flatten)]
    special: Special,
    seconds: Seconds,
    /// The most memory held.
    peak_bytes: Option<u64>,
    file_bytes: u64,
    notes: &'a [Finding],
}

#[derive(Clone, Copy, Serialize)]
struct Seconds {
    read: f64,
    prepare: f64,
    evaluate: f64,
    write: f64,
}

impl Eval {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = SampleFormat::of(self.format, &self.output.output).map_err(Failure::usage)?;
        let points_format = self.at.as_deref().map(|path| self.points_format(path)).transpose()?;
        let progress = console.progress();
        progress.step("reading");
        let cage = self.cage.read()?;
        destination.check()?;
        let mut seconds = Seconds { read: cage.seconds, prepare: 0.0, evaluate: 0.0, write: 0.0 };
        let start = Instant::now();
        let points = match (&self.at, points_format) {
            (Some(path), Some(format)) => Some(Points::open(path, format)?),
            _ => None,
        };
        seconds.read += start.elapsed().as_secs_f64();

        progress.step("preparing");
        let start = Instant::now();
        let subject = CageSurface::new(cage, self.lenses.lens)?;
        let patches = subject.table();
        let visible: Vec<ParametricFace> = (0..patches.len())
            .filter(|&n| patches.is_visible(n))
            .map(|n| patches.parametric_face(n))
            .collect();
        seconds.prepare = start.elapsed().as_secs_f64();

        progress.step("evaluating");
        let grid = Grid::new(&visible, self.uniform.unwrap_or(1));
        let cage = &subject.cage().name;
        let source_name = points.as_ref().map_or(cage, |points| &points.name).clone();
        let source = points.map_or(Source::Grid(grid), Source::Points);
        let (file_bytes, figures, seconds) = subject.look(|surface| {
            let start = Instant::now();
            let mut evaluation = Evaluation::new(surface, format, self.derivatives);
            // Nothing in a grid can be refused, so nothing has to wait.
            let file_bytes = match source {
                Source::Grid(_) => destination.write(|out| {
                    evaluation.run(source, &source_name, out).map_err(|stopped| match stopped {
                        Stopped::Unwritten(error) => error,
                        Stopped::Refused(failure) => std::io::Error::other(failure.first().line()),
                    })
                }),
                Source::Points(_) => {
                    destination.write_unless_refused(|out| evaluation.run(source, &source_name, out))
                }
            }?;
            let Figures { read, evaluate, .. } = evaluation.figures;
            let write = start.elapsed().as_secs_f64() - read - evaluate;
            let seconds = Seconds { read: seconds.read + read, evaluate, write, ..seconds };
            Ok::<_, Failure>((file_bytes, evaluation.figures, seconds))
        })?;
        drop(progress);

        let notes = subject.notes();
        let report = Report {
            samples: figures.samples,
            parametric_faces: visible.len(),
            derivatives: match self.derivatives {
                Derivatives::None => 0,
                Derivatives::First => 1,
                Derivatives::Second => 2,
            },
            special: figures.special,
            seconds,
            peak_bytes: system::peak_memory(),
            file_bytes,
            notes: &notes,
        };
        console.table(&format!("{cage} -> {}", destination.name()), &table(&report), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    /// The format of the points; they and the cage cannot both come from stdin.
    fn points_format(&self, path: &Path) -> Result<SampleFormat, Failure> {
        if path == Path::new("-") {
            if self.cage.is_stdin() {
                return Err(Failure::usage("the cage and --at both want stdin; give one of them a name"));
            }
            if self.points_format.is_none() {
                return Err(Failure::usage("reading points from stdin wants --points-format"));
            }
        }
        let PointsFormat(format) = PointsFormat::of(self.points_format, path).map_err(Failure::usage)?;
        Ok(format)
    }
}

fn table(report: &Report<'_>) -> Table {
    let mut table = Table::default();
    table.row("samples", report.samples.to_string());
    table.row("parametric faces", report.parametric_faces.to_string());
    table.row("derivatives", report.derivatives.to_string());
    let Special { at_extraordinary, normals_undefined, normals_one_sided, curvature_unbounded } =
        report.special;
    let special = [
        ("at extraordinary vertices", at_extraordinary),
        ("normals undefined", normals_undefined),
        ("normals one-sided", normals_one_sided),
        ("curvature unbounded", curvature_unbounded),
    ];
    for (label, count) in special.into_iter().filter(|&(_, count)| count > 0) {
        table.row(label, count.to_string());
    }
    let Seconds { read, prepare, evaluate, write } = report.seconds;
    let total = read + prepare + evaluate + write;
    let parts = format!("read {read:.3}, prepare {prepare:.3}, evaluate {evaluate:.3}, write {write:.3}");
    table.row("seconds", format!("{total:.3} ({parts})"));
    if let Some(peak) = report.peak_bytes {
        table.row("memory", bytes(peak));
    }
    table.row("file", bytes(report.file_bytes));
    table
}
