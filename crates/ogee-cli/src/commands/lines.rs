//! `ogee lines`: reflection lines, highlight lines and isophotes as curves on the limit surface.

use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::quality::{
    Fairness, Field, LevelLine, LevelLines, Levels, LimitView, LineOptions, Ray, Surface, bounds, level_lines,
};
use ogee::{Level, LimitSurface, PatchTable, Vec3};
use ogee_formats::lines::{Drawing, LineFormat, write_json, write_obj, write_svg};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{Cage, CageArguments};
use crate::drawing::{edges, projected};
use crate::error::{Failure, Finding};
use crate::names::{Format, LINE_STYLES, formats};
use crate::report::{Console, Table, bytes, figure};
use crate::system;
use crate::view::{LightArguments, ViewArguments};

const EXAMPLES: &str = "\
Examples:
  ogee lines cage.obj --style reflection --front -o lines.svg     what the eye sees mirrored
  ogee lines cage.obj --style highlight --lines 40 -o lines.obj   curves in space, whoever looks
  ogee lines cage.obj --style isophote --step 5 -o lines.json     with faces and parameters";

/// Trace reflection lines, highlight lines or isophotes as curves on the limit surface
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Lines {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    /// Which lines
    #[arg(long, value_name = "STYLE", default_value = "reflection", value_parser = LINE_STYLES)]
    style: LineStyle,
    /// How far chords may be from the curve, in units of the cage [default: 1e-4 of the diagonal]
    #[arg(long, value_name = "LENGTH")]
    tolerance: Option<f64>,
    /// Only where the surface faces the eye
    #[arg(long)]
    front: bool,
    /// The format of the output, where its name does not tell
    #[arg(long, value_name = "FORMAT", value_parser = formats::<LineFormat>())]
    output_format: Option<LineFormat>,
    #[command(flatten)]
    view: ViewArguments,
    #[command(flatten)]
    light: LightArguments,
}

/// Which lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineStyle {
    Reflection,
    Highlight,
    Isophote,
}

impl Format for LineFormat {
    const NAMES: &'static [(&'static str, LineFormat)] =
        &[("svg", LineFormat::Svg), ("obj", LineFormat::Obj), ("json", LineFormat::Json)];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--output-format";
}

/// Diagonals from the middle of a light plane to where its lines end, if nothing else was said: farther out they crowd
/// together where rays run along the plane.
const REACH: f64 = 4.0;

/// Of the diagonal.
const TOLERANCE: f64 = 1e-4;

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    style: &'static str,
    /// Curves, each in one piece.
    lines: usize,
    /// Different values among them.
    values: usize,
    points: usize,
    /// Curves that come back to where they start.
    closed: usize,
    crossings: usize,
    tolerance: f64,
    /// By how much the field misses the line's value at a point of it at most.
    max_residual: f64,
    /// Pieces that could not be followed, and are straight.
    straight: usize,
    length: f64,
    turning_deg: f64,
    inflections: usize,
    max_curvature_change: f64,
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
    trace: f64,
    write: f64,
}

impl Lines {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = LineFormat::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let progress = console.progress();
        progress.step("reading");
        let cage = self.cage.read()?;
        destination.check()?;

        progress.step("preparing");
        let start = Instant::now();
        let level = Level::new(cage.mesh()).map_err(|error| cage.refused(&error.defects))?;
        let patches = PatchTable::new(&level);
        let surface = LimitSurface::new(&patches, &cage.mesh().points);
        let view = LimitView::new(&level, &surface);
        let extent = bounds(&view).ok_or_else(|| {
            cage.failure(
                "no_surface",
                "no face of the cage is part of the surface, or its points are too far out",
            )
        })?;
        let diagonal = extent[1].distance(extent[0]);
        if diagonal <= 0.0 {
            return Err(cage.failure("no_extent", "the surface is a single point"));
        }
        let camera = self.view.camera(extent)?;
        let screen = camera.view(self.view.size).ok_or_else(|| Failure::usage("nothing is in view"))?;
        let viewer = screen.viewer();
        let (field, levels) = self.field(viewer, extent, diagonal);
        let prepare = start.elapsed().as_secs_f64();

        progress.step("tracing");
        let start = Instant::now();
        let tolerance = self.tolerance.unwrap_or(TOLERANCE * diagonal);
        let mut options = LineOptions::new(tolerance);
        options.front = self.front.then_some(viewer);
        let all = levels.iter().map(|levels| {
            level_lines(&view, &field, levels, &options)
                .map_err(|error| cage.failure(error.code(), error.to_string()))
        });
        let traced = merged(all.collect::<Result<Vec<_>, _>>()?);
        if traced.lines.is_empty() {
            return Err(self.nothing(&cage, &traced));
        }
        let fairness: Vec<Fairness> =
            traced.lines.iter().map(|line| Fairness::of(line, &view, &field)).collect();
        let trace = start.elapsed().as_secs_f64();

        progress.step("writing");
        let start = Instant::now();
        let file_bytes = destination.write(|out| match format {
            LineFormat::Obj => write_obj(&traced.lines, out),
            LineFormat::Json => {
                let lines = traced.lines.iter().zip(fairness.iter().copied());
                write_json(lines, |at| view.address(at), out)
            }
            LineFormat::Svg => {
                let title = format!("{} lines of {}", self.name(), self.cage.stem());
                let lines = projected(&traced.lines, &screen);
                let edges = edges(&view, &screen, options.front);
                write_svg(&Drawing { size: self.view.size, title: &title, edges: &edges, lines: &lines }, out)
            }
        })?;
        let write = start.elapsed().as_secs_f64();
        drop(progress);

        let mut notes = cage.warnings();
        notes.extend(ogee::mesh::notes(cage.mesh()).iter().map(Finding::of_note));
        let mut values: Vec<f64> = traced.lines.iter().map(|line| line.value).collect();
        values.dedup();
        let report = Report {
            style: self.name(),
            lines: traced.lines.len(),
            values: values.len(),
            points: traced.lines.iter().map(|line| line.points.len()).sum(),
            closed: traced.lines.iter().filter(|line| line.closed).count(),
            crossings: traced.crossings,
            tolerance,
            max_residual: traced.max_residual,
            straight: traced.straight,
            length: fairness.iter().map(|one| one.length).sum(),
            turning_deg: fairness.iter().map(|one| one.turning).sum::<f64>().to_degrees(),
            inflections: fairness.iter().map(|one| one.inflections).sum(),
            max_curvature_change: fairness.iter().map(|one| one.curvature_change).fold(0.0, f64::max),
            seconds: Seconds { read: cage.seconds, prepare, trace, write },
            peak_bytes: system::peak_memory(),
            file_bytes,
            notes: &notes,
        };
        console.table(&format!("{} -> {}", cage.name, destination.name()), &table(&report), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    fn name(&self) -> &'static str {
        match self.style {
            LineStyle::Reflection => "reflection",
            LineStyle::Highlight => "highlight",
            LineStyle::Isophote => "isophote",
        }
    }

    /// The field, and which lines of it: one set, or both sides of stripes.
    fn field(&self, viewer: ogee::quality::Viewer, extent: [Vec3; 2], diagonal: f64) -> (Field, Vec<Levels>) {
        let ray = match self.style {
            LineStyle::Reflection => Ray::Reflected,
            LineStyle::Highlight => Ray::Normal,
            LineStyle::Isophote => {
                let step = self.light.step;
                let angles = (1..).map(|k| f64::from(k) * step).take_while(|angle| *angle < 180.0 - 1e-9);
                let mut cosines: Vec<f64> = angles.map(|angle| angle.to_radians().cos()).collect();
                cosines.reverse();
                return (
                    Field::Isophote { light: self.light.light_direction },
                    vec![Levels::Listed(cosines)],
                );
            }
        };
        let mut light = self.light.plane(extent);
        light.half = light.half.map(|half| if half.is_finite() { half } else { REACH * diagonal });
        let period = self.light.period(extent);
        let sides = std::iter::once(0.0).chain(self.light.width.map(|width| width * period));
        let levels = sides.map(|first| Levels::Every { first, period }).collect();
        (Field::Plane { light, viewer, ray, axis: 0 }, levels)
    }

    /// Why there are no lines.
    fn nothing(&self, cage: &Cage, traced: &LevelLines) -> Failure {
        let why = match traced.range {
            None => {
                "no ray from the surface meets the light plane: raise it, or look from elsewhere".to_owned()
            }
            Some(_) if self.front && traced.crossings > 0 => {
                "no line is on the side of the surface that faces the eye".to_owned()
            }
            Some([low, high]) => format!(
                "no line meets the surface: between {} and {} on the light there is none; ask for more of them",
                figure(low),
                figure(high)
            ),
        };
        cage.failure("no_lines", why)
    }
}

/// Lines of several sets as one.
fn merged(mut all: Vec<LevelLines>) -> LevelLines {
    let mut whole = all.remove(0);
    for other in all {
        whole.lines.extend(other.lines);
        whole.crossings += other.crossings;
        whole.max_residual = whole.max_residual.max(other.max_residual);
        whole.straight += other.straight;
    }
    // Stable: those of one value stay in their order.
    whole.lines.sort_by(|a: &LevelLine, b: &LevelLine| a.value.total_cmp(&b.value));
    whole
}

fn table(report: &Report<'_>) -> Table {
    let mut table = Table::default();
    table.row("lines", format!("{}, {} of them closed", report.lines, report.closed));
    table.row("values", report.values.to_string());
    table.row("points", report.points.to_string());
    table.row("crossings", report.crossings.to_string());
    table.row("tolerance", figure(report.tolerance));
    table.row("max residual", figure(report.max_residual));
    if report.straight > 0 {
        table.row("straight pieces", report.straight.to_string());
    }
    table.row("length", figure(report.length));
    table.row(
        "turning",
        format!("{} degrees, {} inflections", figure(report.turning_deg), report.inflections),
    );
    table.row("max curvature change", figure(report.max_curvature_change));
    let Seconds { read, prepare, trace, write } = report.seconds;
    let parts = format!("read {read:.3}, prepare {prepare:.3}, trace {trace:.3}, write {write:.3}");
    table.row("seconds", format!("{:.3} ({parts})", read + prepare + trace + write));
    if let Some(peak) = report.peak_bytes {
        table.row("memory", bytes(peak));
    }
    table.row("file", bytes(report.file_bytes));
    table
}
