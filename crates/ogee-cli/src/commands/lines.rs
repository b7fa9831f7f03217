//! `ogee lines`: reflection lines, highlight lines and isophotes as curves on the limit surface.

use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::Vec3;
use ogee::quality::{
    Fairness, Field, LevelLine, LevelLines, Levels, LineOptions, LinesError, Ray, Surface, Viewer,
    level_lines,
};
use ogee_formats::lines::{Drawing, LineFormat, Path, write_json, write_obj, write_svg};
use ogee_render::{DepthImage, View, outline};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::CageArguments;
use crate::drawing::{self, projected};
use crate::error::{Failure, Finding};
use crate::names::{Format, formats};
use crate::output::Destination;
use crate::report::{Console, Table, bytes, figure};
use crate::subject::{Subject, or_part};
use crate::system;
use crate::view::{LightArguments, ViewArguments, positive};

const EXAMPLES: &str = "\
Examples:
  ogee lines cage.obj --style reflection -o lines.svg             a drawing of what is in sight
  ogee lines cage.obj --style highlight --lines 40 -o lines.obj   curves in space, whoever looks
  ogee lines cage.obj --style isophote --step 5 -o lines.json     with faces and parameters";

/// Trace reflection lines, highlight lines or isophotes as curves on the limit surface
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, mut_arg("cage", or_part))]
pub(crate) struct Lines {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    /// Which lines
    #[arg(long, value_name = "STYLE", default_value = "reflection", value_parser = formats::<LineStyle>())]
    style: LineStyle,
    /// How far chords may be from the curve, in units of the cage [default: 1e-4 of the diagonal]
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    tolerance: Option<f64>,
    /// Only where the surface faces the eye
    #[arg(long)]
    front: bool,
    /// Only what is in sight, as a drawing (SVG) has it anyway
    #[arg(long)]
    visible: bool,
    /// In a drawing as well what is out of sight
    #[arg(long, conflicts_with = "visible")]
    hidden: bool,
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

impl Format for LineStyle {
    const NAMES: &'static [(&'static str, LineStyle)] = &[
        ("reflection", LineStyle::Reflection),
        ("highlight", LineStyle::Highlight),
        ("isophote", LineStyle::Isophote),
    ];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--style";
}

impl Format for LineFormat {
    const NAMES: &'static [(&'static str, LineFormat)] =
        &[("svg", LineFormat::Svg), ("obj", LineFormat::Obj), ("json", LineFormat::Json)];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--output-format";
}

/// Diagonals from the middle of a light plane to where its lines end, if nothing else was said: from farther out they
/// crowd together where rays run along the plane.
const REACH: f64 = 1.0;

/// Of the diagonal: how long chords may be where they are looked at for what is in sight.
const LONGEST: f64 = 5e-3;

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

/// Lines as they are written, with what a report wants to know.
struct Found {
    lines: LevelLines,
    fairness: Vec<Fairness>,
    tolerance: f64,
    file_bytes: u64,
    seconds: Seconds,
}

impl Lines {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = LineFormat::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let progress = console.progress();
        progress.step("reading");
        let subject = Subject::read(&self.cage)?;
        subject.check_rules(&self.cage)?;
        destination.check()?;
        progress.step("tracing");
        let found = subject.look(|surface| self.found(&subject, surface, format, &destination))?;
        drop(progress);

        let notes = subject.notes();
        let Found { lines: LevelLines { lines, crossings, max_residual, straight, .. }, fairness, .. } =
            &found;
        let mut values: Vec<f64> = lines.iter().map(|line| line.value).collect();
        values.dedup();
        let report = Report {
            style: LineStyle::NAMES
                .iter()
                .find(|(_, style)| *style == self.style)
                .map_or("", |(name, _)| name),
            lines: lines.len(),
            values: values.len(),
            points: lines.iter().map(|line| line.points.len()).sum(),
            closed: lines.iter().filter(|line| line.closed).count(),
            crossings: *crossings,
            tolerance: found.tolerance,
            max_residual: *max_residual,
            straight: *straight,
            length: fairness.iter().map(|one| one.length).sum(),
            turning_deg: fairness.iter().map(|one| one.turning).sum::<f64>().to_degrees(),
            inflections: fairness.iter().map(|one| one.inflections).sum(),
            max_curvature_change: fairness.iter().map(|one| one.curvature_change).fold(0.0, f64::max),
            seconds: found.seconds,
            peak_bytes: system::peak_memory(),
            file_bytes: found.file_bytes,
            notes: &notes,
        };
        console.table(&format!("{} -> {}", subject.name, destination.name()), &table(&report), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Traces lines and writes them.
    fn found(
        &self,
        subject: &Subject,
        surface: &dyn Surface,
        format: LineFormat,
        destination: &Destination,
    ) -> Result<Found, Failure> {
        let start = Instant::now();
        let bounds = subject.bounds(surface)?;
        let diagonal = bounds[1].distance(bounds[0]);
        let camera = self.view.camera(&outline(surface))?;
        let view = |scale: u32| camera.view(self.view.size.map(|side| scale * side));
        let (Some(screen), Some(fine)) = (view(1), view(2)) else {
            return Err(Failure::usage("the camera shows nothing"));
        };
        let in_sight = self.visible || (format == LineFormat::Svg && !self.hidden);
        let depths = in_sight.then(|| DepthImage::new(surface, &fine));
        let shows = |point: Vec3| depths.as_ref().is_none_or(|depths| depths.shows(point));
        let tolerance = self.tolerance.unwrap_or(TOLERANCE * diagonal);
        let mut options = LineOptions::new(tolerance);
        options.front = self.front.then(|| screen.viewer());
        if in_sight {
            options.visible = Some(&shows);
            options.longest = LONGEST * diagonal;
        }
        let prepare = subject.prepare_seconds + start.elapsed().as_secs_f64();

        let start = Instant::now();
        let (field, levels) = self.field(screen.viewer(), bounds);
        let all = levels.iter().map(|levels| level_lines(surface, &field, levels, &options));
        let all = all.collect::<Result<Vec<_>, _>>();
        let refused = |error: LinesError| subject.failure(error.code(), error.to_string());
        let lines = merged(all.map_err(refused)?);
        if lines.lines.is_empty() {
            return Err(subject.failure("no_lines", self.why_none(&lines, &options)));
        }
        let fairness = Fairness::of_all(&lines.lines, surface, &field);
        let mut edges = Vec::new();
        if format == LineFormat::Svg {
            edges = drawing::edges(surface, &screen, &options);
            edges.extend(drawing::outline(surface, &screen, &options).map_err(refused)?);
        }
        let trace = start.elapsed().as_secs_f64();

        let start = Instant::now();
        let file_bytes = destination.write(|out| match format {
            LineFormat::Obj => write_obj(&lines.lines, out),
            LineFormat::Json => {
                let lines = lines.lines.iter().zip(fairness.iter().copied());
                write_json(lines, |at| surface.address(at), out)
            }
            LineFormat::Svg => self.draw(&screen, &edges, &lines.lines, out),
        })?;
        let write = start.elapsed().as_secs_f64();
        let seconds = Seconds { read: subject.read_seconds, prepare, trace, write };
        Ok(Found { lines, fairness, tolerance, file_bytes, seconds })
    }

    fn draw(&self, view: &View, edges: &[Path], lines: &[LevelLine], out: impl Write) -> io::Result<()> {
        let title = match self.style {
            LineStyle::Reflection => "Reflection lines of",
            LineStyle::Highlight => "Highlight lines of",
            LineStyle::Isophote => "Isophotes of",
        };
        let title = format!("{title} {}", self.cage.stem());
        write_svg(
            &Drawing { size: self.view.size, title: &title, edges, lines: &projected(lines, view) },
            out,
        )
    }

    /// The field, and which lines of it: one set, or both sides of stripes.
    fn field(&self, viewer: Viewer, bounds: [Vec3; 2]) -> (Field, Vec<Levels>) {
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
        let mut light = self.light.plane(bounds);
        let reach = REACH * bounds[1].distance(bounds[0]);
        light.half = light.half.map(|half| if half.is_finite() { half } else { reach });
        let period = self.light.period(bounds);
        let sides = std::iter::once(0.0).chain(self.light.width.map(|width| width * period));
        let levels = sides.map(|first| Levels::Every { first, period }).collect();
        (Field::Plane { light, viewer, ray, axis: 0 }, levels)
    }

    /// Why there are no lines.
    fn why_none(&self, traced: &LevelLines, options: &LineOptions<'_>) -> String {
        match (traced.range, self.style) {
            (None, LineStyle::Highlight) => {
                "no normal of the surface meets the light plane: move it to the side that they point to"
                    .to_owned()
            }
            (None, _) => {
                "no ray from the surface meets the light plane: raise it, or look from elsewhere".to_owned()
            }
            (Some(_), _) if traced.crossings > 0 || options.front.is_some() => {
                "no line is where it was asked for: in sight, facing the eye, on the light".to_owned()
            }
            (Some(range), LineStyle::Isophote) => {
                let [most, least] = range.map(|cosine| figure(cosine.clamp(-1.0, 1.0).acos().to_degrees()));
                format!(
                    "no line meets the surface, which is turned from the light by {least} to {most} degrees: its faces \
                     are flat, or ask for a smaller --step"
                )
            }
            (Some(range), _) => {
                let [low, high] = range.map(figure);
                format!(
                    "no line meets the surface, which sees the light from {low} to {high}: ask for more lines"
                )
            }
        }
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
