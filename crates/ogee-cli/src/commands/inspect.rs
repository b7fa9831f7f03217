//! `ogee inspect`: figures on the quality of a limit surface or of patches.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::quality::{Field, PlaneLight, Ray, Report as Measured, ReportOptions, Surface, Viewer};
use ogee_render::{ANGLE, Camera, THREE_QUARTER, default_light, outline};
use serde::Serialize;

use crate::cage::{Cage, CageArguments};
use crate::comparison::{CREASE_ANGLE, Comparison, Way, compare, views};
use crate::error::{Exit, Failure, Finding};
use crate::inspection::{Figures, PICTURE, PageOf, Second, compared_page, named, table};
use crate::names::WAYS;
use crate::output::Destination;
use crate::report::{Console, Table, bytes, count, figure};
use crate::subject::{Subject, or_part};
use crate::system;

const EXAMPLES: &str = "\
Examples:
  ogee inspect cage.obj                            how smooth the limit of a cage is, and where not
  ogee convert cage.obj -o part.json               the patches of a part ..
  ogee inspect part.json --max-angle 0.01          .. exit code 1 if they meet at a larger angle
  ogee inspect cage.obj --html report.html         a page with pictures
  ogee inspect part.json --beside cage.obj --html report.html  the same, the limit beside the patches in each
  ogee inspect cage.obj --methods limit,pccm,g2 --html report.html  one cage by several methods";

/// Measure the quality of a limit surface or of patches: gaps, angles, curvature, kinks of reflection lines
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, mut_arg("cage", or_part))]
pub(crate) struct Inspect {
    #[command(flatten)]
    cage: CageArguments,
    /// Write a page with figures and pictures that opens without a network; - for stdout
    #[arg(long, value_name = "REPORT.html")]
    html: Option<PathBuf>,
    /// A second cage or part, such as the cage that a part came from: drawn beside the first in each picture of the page,
    /// with the same camera, light and scale of colours
    #[arg(long, value_name = "CAGE|PART.json", requires = "html")]
    beside: Option<PathBuf>,
    /// The limit surface of a cage, and parts made from it by these methods, side by side: figures, how far curvature ranges
    /// around each point where not four faces meet, and in the page pictures
    #[arg(long, value_name = "METHOD,..", value_delimiter = ',', value_parser = WAYS, conflicts_with_all = ["beside", "max_angle", "crease_angle"])]
    methods: Vec<Way>,
    /// Fail if two faces meet at a larger angle, in degrees, where there is no crease
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    max_angle: Option<f64>,
    /// Take joints that bend by this or more, in degrees, for creases [default: 10 for patches; a cage knows its own]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    crease_angle: Option<f64>,
}

/// An angle that faces can have.
fn degrees(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(angle) if (0.0..=180.0).contains(&angle) => Ok(angle),
        _ => Err("not an angle from 0 to 180 degrees".to_owned()),
    }
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    figures: &'a Figures,
    lines: Lines,
    max_angle_deg: Option<f64>,
    /// Whether no smooth joint exceeds that angle.
    passed: Option<bool>,
    seconds: Seconds,
    peak_bytes: Option<u64>,
    notes: &'a [Finding],
}

/// The report of a comparison, for programs.
#[derive(Serialize)]
struct ComparisonReport<'a> {
    #[serde(flatten)]
    comparison: &'a Comparison,
    seconds: Seconds,
    notes: &'a [Finding],
}

/// Whose reflection lines kink.
#[derive(Clone, Copy, Serialize)]
struct Lines {
    eye: [f64; 3],
    light_centre: [f64; 3],
    light_axis: [f64; 3],
}

#[derive(Clone, Copy, Serialize)]
struct Seconds {
    read: f64,
    prepare: f64,
    measure: f64,
    /// If a page was made.
    draw: Option<f64>,
}

impl Inspect {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let html = self.html.as_deref().map(Destination::new);
        if console.json && html == Some(Destination::Stdout) {
            return Err(Failure::usage("--html - and --json both want stdout; give the page a name"));
        }
        let progress = console.progress();
        progress.step("reading");
        let subject = Subject::read(&self.cage)?;
        if !self.methods.is_empty() {
            drop(progress);
            return self.compare(&subject, html.as_ref(), console);
        }
        let other = match &self.beside {
            Some(file) => Some(Subject::read(&self.cage.for_file(file))?),
            None => None,
        };
        if other.as_ref().is_none_or(|other| other.cage().is_none()) {
            subject.check_rules(&self.cage)?;
        }
        let crease_angle = self.crease_angle(&subject)?;
        if let Some(html) = &html {
            html.check()?;
        }

        progress.step("measuring");
        let start = Instant::now();
        let (figures, light, lines) = subject.look(|surface| measure(&subject, surface, crease_angle))?;
        let measure = start.elapsed().as_secs_f64();
        let mut notes = subject.notes();
        let creases = figures.continuity.sharp.joints;
        if let Some(angle) = crease_angle.filter(|_| creases > 0) {
            let joints = count(creases, "joint bends", "joints bend");
            let message = format!("{joints} by {} degrees or more: taken for creases", figure(angle));
            notes.push(Finding::in_file("creases_by_angle", message, &subject.name));
        }
        let largest = figures.continuity.smooth.angle_deg.max;
        let excess = self.max_angle.filter(|&limit| largest > limit);
        let start = Instant::now();
        if let Some(html) = &html {
            progress.step("drawing");
            let page = PageOf {
                name: &subject.name,
                figures: &figures,
                max_angle: self.max_angle,
                light,
                notes: &notes,
            };
            let (text, fault) = subject.look(|surface| match &other {
                Some(other) => other.look(|second| {
                    let is_limit = other.cage().is_some();
                    page.html(surface, Some(&Second { surface: second, name: &other.name, is_limit }))
                }),
                None => page.html(surface, None),
            });
            html.write(|out| out.write_all(text.as_bytes()))?;
            notes.extend(fault);
        }
        let draw = html.is_some().then(|| start.elapsed().as_secs_f64());
        drop(progress);

        let seconds = Seconds { read: subject.read_seconds, prepare: subject.prepare_seconds, measure, draw };
        let report = Report {
            figures: &figures,
            lines,
            max_angle_deg: self.max_angle,
            passed: self.max_angle.map(|_| excess.is_none()),
            seconds,
            peak_bytes: system::peak_memory(),
            notes: &notes,
        };
        let mut rows = table(&figures, console.is_verbose());
        let Seconds { read, prepare, .. } = seconds;
        let drawing = draw.map(|draw| format!(", draw {draw:.3}")).unwrap_or_default();
        let parts = format!("read {read:.3}, prepare {prepare:.3}, measure {measure:.3}{drawing}");
        rows.row("seconds", format!("{:.3} ({parts})", read + prepare + measure + draw.unwrap_or_default()));
        if let Some(peak) = report.peak_bytes.filter(|_| console.is_verbose()) {
            rows.row("memory", bytes(peak));
        }
        console.table(&subject.name, &rows, &notes);
        console.json(&report)?;
        let Some(limit) = excess else { return Ok(ExitCode::SUCCESS) };
        let (found, limit) = (figure(largest), figure(limit));
        let message =
            format!("two faces meet at {found} degrees where there is no crease; {limit} is allowed");
        console.findings(&[Finding::in_file("angle_too_large", message, &subject.name)]);
        Ok(ExitCode::from(Exit::Check as u8))
    }

    /// One cage by several methods.
    fn compare(
        &self,
        subject: &Subject,
        html: Option<&Destination>,
        console: &Console,
    ) -> Result<ExitCode, Failure> {
        let Some(cage) = subject.cage() else {
            return Err(Failure::usage(format!("{} has patches: --methods is for cages", subject.name)));
        };
        if let Some(html) = html {
            html.check()?;
        }
        let progress = console.progress();
        progress.step("converting");
        let start = Instant::now();
        let parts = views(cage, &self.methods)?;
        let prepare = subject.prepare_seconds + start.elapsed().as_secs_f64();
        progress.step("measuring");
        let mut notes = subject.notes();
        let (comparison, page, measure) = subject.look(|limit| {
            let surfaces = parts.iter().map(|part| match part {
                Some(view) => view as &dyn Surface,
                None => limit,
            });
            let surfaces: Vec<&dyn Surface> = surfaces.collect();
            let start = Instant::now();
            let comparison = compare(subject, cage, &self.methods, &surfaces)?;
            let measure = start.elapsed().as_secs_f64();
            let page = html.map(|_| compared_page(&subject.name, &comparison, &surfaces, &notes));
            Ok::<_, Failure>((comparison, page, measure))
        })?;
        if let (Some(html), Some((text, fault))) = (html, page) {
            html.write(|out| out.write_all(text.as_bytes()))?;
            notes.extend(fault);
        }
        drop(progress);
        let seconds = Seconds { read: subject.read_seconds, prepare, measure, draw: None };
        console.table(&subject.name, &comparison_table(&comparison, console.is_verbose()), &notes);
        console.json(&ComparisonReport { comparison: &comparison, seconds, notes: &notes })?;
        Ok(ExitCode::SUCCESS)
    }

    /// From which angle on joints count as creases, where that is not for the cage to say.
    fn crease_angle(&self, subject: &Subject) -> Result<Option<f64>, Failure> {
        let crease_angle = self.crease_angle.or(subject.cage().is_none().then_some(CREASE_ANGLE));
        match (self.max_angle, crease_angle) {
            (Some(max), Some(crease)) if max >= crease => Err(Failure::usage(format!(
                "--max-angle {max} can never be exceeded: joints that bend by {crease} degrees or more count as \
                 creases; raise --crease-angle"
            ))),
            _ => Ok(crease_angle),
        }
    }
}

/// The figures of a surface, under the usual light seen by the usual eye.
fn measure(
    subject: &Subject,
    surface: &dyn Surface,
    crease_angle: Option<f64>,
) -> Result<(Figures, PlaneLight, Lines), Failure> {
    let bounds = subject.bounds(surface)?;
    let camera = Camera::fit_from(THREE_QUARTER, &outline(surface), ANGLE, PICTURE);
    let light = default_light(bounds);
    let field = Field::Plane { light, viewer: Viewer::Eye(camera.eye), ray: Ray::Reflected, axis: 0 };
    let options = ReportOptions { crease_angle, ..ReportOptions::new(field) };
    let measured = Measured::new(surface, &options)
        .ok_or_else(|| subject.failure("no_surface", "there is no face whose points are finite"))?;
    let mesh = subject.cage().map(Cage::mesh);
    let lines =
        Lines { eye: camera.eye.into(), light_centre: light.centre.into(), light_axis: light.axes[0].into() };
    Ok((Figures::new(&measured, subject.faces(), mesh), light, lines))
}

/// Points of a comparison that are listed without `--verbose`.
const FEW: usize = 8;

/// A comparison as people read it on a terminal.
fn comparison_table(comparison: &Comparison, verbose: bool) -> Table {
    let mut table = Table::default();
    table.row("cage", count(comparison.faces, "face", "faces"));
    for surface in &comparison.surfaces {
        let smooth = &surface.figures.continuity.smooth;
        let [angle, jump, kink] = [&smooth.angle_deg, &smooth.curvature_relative, &smooth.kink_deg]
            .map(|metric| figure(metric.max));
        table.row(
            "method",
            format!("{}: angle {angle} deg, curvature {jump}, kink {kink} deg", surface.method),
        );
    }
    let listed = if verbose { usize::MAX } else { FEW };
    for point in comparison.points.iter().take(listed) {
        let spans = comparison.surfaces.iter().zip(&point.ranges).filter_map(|(surface, range)| {
            let [low, high] = range.as_ref()?.mean;
            Some(format!("{} {}", surface.method, figure(high - low)))
        });
        let spans: Vec<String> = spans.collect();
        table.row("range", format!("{}: {}", named(&point.place), spans.join(", ")));
    }
    table
}
