//! `ogee inspect`: figures on the quality of a limit surface or of patches.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::quality::{Field, LimitView, PatchView, Ray, Report as Measured, ReportOptions, Surface};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable};
use ogee_formats::{CageFormat, patches};
use ogee_render::{Camera, bounding_box, default_light};
use serde::Serialize;

use crate::cage::{CageArguments, Opened};
use crate::error::{Exit, Failure, Finding};
use crate::inspection::{Figures, table};
use crate::output::Destination;
use crate::report::{Console, bytes, count, figure};
use crate::system;

const EXAMPLES: &str = "\
Examples:
  ogee inspect cage.obj                            how smooth the limit of a cage is, and where not
  ogee convert cage.obj -o part.json               the patches of a part ..
  ogee inspect part.json --max-angle 0.01          .. exit code 1 if they meet at a larger angle
  ogee inspect cage.obj --html report.html         a page with pictures";

/// Measure the quality of a limit surface or of patches: gaps, angles, curvature, kinks of reflection lines
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Inspect {
    #[command(flatten)]
    cage: CageArguments,
    /// Write a page with figures and pictures that opens without a network; - for stdout
    #[arg(long, value_name = "REPORT.html")]
    html: Option<PathBuf>,
    /// Fail if two faces meet at a larger angle, in degrees, where there is no crease
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    max_angle: Option<f64>,
    /// Take joints that bend by this or more, in degrees, for creases [default: 10 for patches; a cage knows its own]
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true)]
    crease_angle: Option<f64>,
}

/// Patches that meet at this angle or more, in degrees, are meant to: a fault is rarely as large, a crease rarely less.
const CREASE_ANGLE: f64 = 10.0;

/// Width and height of the view whose eye sees the reflection lines.
const VIEW: [u32; 2] = [800, 600];

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
}

/// What is measured, and how long it took to have it.
struct Subject<'a> {
    surface: &'a dyn Surface,
    name: &'a str,
    /// Faces of the cage, or patches.
    faces: usize,
    /// The cage, if it is the limit of one.
    mesh: Option<&'a ControlMesh>,
    notes: Vec<Finding>,
    read: f64,
    prepare: f64,
}

impl Inspect {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let html = self.html.as_deref().map(Destination::new);
        if console.json && html == Some(Destination::Stdout) {
            return Err(Failure::usage("--html - and --json both want stdout; give the page a name"));
        }
        let opened = self.cage.open()?;
        if let Some(html) = &html {
            html.check()?;
        }
        if opened.format == CageFormat::Json && patches::is_patches(&opened.bytes) {
            self.patches(opened, console)
        } else {
            self.limit(opened, console)
        }
    }

    /// The limit of a cage.
    fn limit(&self, opened: Opened<'_>, console: &Console) -> Result<ExitCode, Failure> {
        let cage = opened.cage()?;
        let start = Instant::now();
        let mesh = cage.mesh();
        let level = Level::new(mesh).map_err(|error| cage.refused(&error.defects))?;
        let table = PatchTable::new(&level);
        let limit = LimitSurface::new(&table, &mesh.points);
        let view = LimitView::new(&level, &limit);
        let mut notes = cage.warnings();
        notes.extend(ogee::mesh::notes(mesh).iter().map(Finding::of_note));
        self.measure(
            Subject {
                surface: &view,
                name: &cage.name,
                faces: mesh.faces.len(),
                mesh: Some(mesh),
                notes,
                read: cage.seconds,
                prepare: start.elapsed().as_secs_f64(),
            },
            console,
        )
    }

    /// The patches of a part.
    fn patches(&self, opened: Opened<'_>, console: &Console) -> Result<ExitCode, Failure> {
        let Opened { name, bytes, start, .. } = opened;
        if self.cage.boundary.is_some() || self.cage.creasing.is_some() {
            return Err(Failure::usage(format!("{name} has patches: --boundary and --creasing are for cages")));
        }
        let refused = |code, message: String| Failure::refused(vec![Finding::in_file(code, message, &name)], 0);
        let patches = patches::read(&bytes).map_err(|error| refused(error.code(), error.to_string()))?;
        let (read, start) = (start.elapsed().as_secs_f64(), Instant::now());
        let faces = patches.len();
        let pieces = patches.into_iter().map(|patch| (patch.surface, patch.quads)).collect();
        let view = PatchView::new(pieces).map_err(|error| refused("bad_patch", error.to_string()))?;
        let prepare = start.elapsed().as_secs_f64();
        let subject =
            Subject { surface: &view, name: &name, faces, mesh: None, notes: Vec::new(), read, prepare };
        self.measure(subject, console)
    }

    fn measure(&self, subject: Subject<'_>, console: &Console) -> Result<ExitCode, Failure> {
        let Subject { surface, name, faces, mesh, mut notes, read, prepare } = subject;
        let crease_angle = self.crease_angle.or(mesh.is_none().then_some(CREASE_ANGLE));
        if let (Some(crease), Some(max)) = (crease_angle, self.max_angle)
            && max >= crease
        {
            return Err(Failure::usage(format!(
                "--max-angle {max} would never fail: joints that bend by {crease} degrees or more count as creases; say \
                 --crease-angle"
            )));
        }
        let progress = console.progress();
        progress.step("measuring");
        let start = Instant::now();
        let box_of_all = bounding_box(surface);
        let (camera, light) = (Camera::fit(box_of_all, VIEW), default_light(box_of_all));
        let viewer = ogee::quality::Viewer::Eye(camera.eye);
        let field = Field::Plane { light, viewer, ray: Ray::Reflected, axis: 0 };
        let options = ReportOptions { crease_angle, ..ReportOptions::new(field) };
        let measured = Measured::new(surface, &options).ok_or_else(|| {
            let message = "there is no face whose points are finite";
            Failure::refused(vec![Finding::in_file("no_surface", message, name)], 0)
        })?;
        let figures = Figures::new(&measured, faces, mesh);
        let seconds = Seconds { read, prepare, measure: start.elapsed().as_secs_f64() };
        drop(progress);

        let creases = figures.continuity.sharp.joints;
        if let Some(angle) = crease_angle.filter(|_| creases > 0) {
            let joints = count(creases, "joint bends", "joints bend");
            let message = format!("{joints} by {} degrees or more, and counts as a crease", figure(angle));
            notes.push(Finding::in_file("creases_by_angle", message, name));
        }
        let smooth = &figures.continuity.smooth.angle_deg;
        let passed = self.max_angle.map(|limit| smooth.max <= limit);
        let report = Report {
            figures: &figures,
            lines: Lines {
                eye: camera.eye.into(),
                light_centre: light.centre.into(),
                light_axis: light.axes[0].into(),
            },
            max_angle_deg: self.max_angle,
            passed,
            seconds,
            peak_bytes: system::peak_memory(),
            notes: &notes,
        };
        let mut rows = table(&figures, console.is_verbose());
        let Seconds { read, prepare, measure } = seconds;
        let parts = format!("read {read:.3}, prepare {prepare:.3}, measure {measure:.3}");
        rows.row("seconds", format!("{:.3} ({parts})", read + prepare + measure));
        if let Some(peak) = report.peak_bytes.filter(|_| console.is_verbose()) {
            rows.row("memory", bytes(peak));
        }
        console.table(name, &rows, &notes);
        console.json(&report)?;
        match (passed, self.max_angle) {
            (Some(false), Some(limit)) => {
                let (found, limit) = (figure(smooth.max), figure(limit));
                let message = format!("two faces meet at {found} degrees where there is no crease; {limit} is allowed");
                console.findings(&[Finding::in_file("angle_too_large", message, name)]);
                Ok(ExitCode::from(Exit::Check as u8))
            }
            _ => Ok(ExitCode::SUCCESS),
        }
    }
}
