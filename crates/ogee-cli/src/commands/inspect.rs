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
use crate::error::{Exit, Failure, Finding};
use crate::inspection::{Figures, PICTURE, PageOf, Second, table};
use crate::output::Destination;
use crate::report::{Console, bytes, count, figure};
use crate::subject::{Subject, or_part};
use crate::system;

const EXAMPLES: &str = "\
Examples:
  ogee inspect cage.obj                            how smooth the limit of a cage is, and where not
  ogee convert cage.obj -o part.json               the patches of a part ..
  ogee inspect part.json --max-angle 0.01          .. exit code 1 if they meet at a larger angle
  ogee inspect cage.obj --html report.html         a page with pictures
  ogee inspect part.json --beside cage.obj --html report.html  the same, the limit beside the patches in each";

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
    /// Fail if two faces meet at a larger angle, in degrees, where there is no crease
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    max_angle: Option<f64>,
    /// Take joints that bend by this or more, in degrees, for creases [default: 10 for patches; a cage knows its own]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    crease_angle: Option<f64>,
}

/// Patches that meet at this angle or more, in degrees, are meant to: a fault is rarely as large, a crease rarely less.
const CREASE_ANGLE: f64 = 10.0;

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
