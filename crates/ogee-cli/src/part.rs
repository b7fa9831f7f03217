//! Making and writing parts: what `convert` and every other command that ends in CAD have in common.

use std::io;
use std::time::Instant;

use clap::Args;
use ogee::convert::{ConvertError, LevelFaces, Method, Options, Packing, Part, UpAxis, to_part};
use ogee::curve_network::NetworkCurve;
use ogee::lens;
use ogee::pccm::PccmError;
use ogee::{ControlMesh, Vec3};
use ogee_formats::step::{Schema, Unit};
use ogee_formats::{bv, patches, step};
use serde::Serialize;

use crate::cage::Cage;
use crate::error::{Exit, Failure, Finding};
use crate::lenses::{LensReport, lens_counts};
use crate::memory::MemoryArguments;
use crate::names::{LENS_METHODS, METHODS, SCHEMAS, UNITS, UP_AXES};
use crate::nodes::NodeReport;
use crate::output::{Counter, Destination};
use crate::report::{Table, count, figure};

/// The options of a conversion.
#[derive(Debug, Args)]
pub(crate) struct PartArguments {
    /// The construction: pccm and pccm-first are bicubic and bi5 is biquintic, all tangent-continuous; g2 is curvature-continuous,
    /// with caps of degree 7 around irregular vertices and bicubic elsewhere
    #[arg(long, default_value = "pccm", value_parser = METHODS)]
    pub(crate) method: Method,
    /// Raise the level, where it is needed, until patches and limit surface differ by less than this, in the unit of the file
    #[arg(long, value_name = "D", value_parser = length, allow_negative_numbers = true)]
    max_deviation: Option<f64>,
    /// Steps of refinement before the conversion; of g2 before a cap [default: the least that is right, face by face]
    #[arg(short, long, value_name = "L")]
    level: Option<u32>,
    /// Join quads into large faces [default for STEP]
    #[arg(long, overrides_with = "no_pack")]
    pack: bool,
    /// Write one face per quad [default for BezierView and JSON]
    #[arg(long)]
    no_pack: bool,
    /// What to do at vertices of valence 2 and at poles; auto is polar where circles go around, else merge
    #[arg(long, value_name = "METHOD", default_value = "auto", value_parser = LENS_METHODS)]
    pub(crate) lens: lens::Method,
    /// What a unit of the cage is
    #[arg(long, default_value = "mm", value_parser = UNITS)]
    pub(crate) unit: Unit,
    /// The application protocol of STEP
    #[arg(long, default_value = "214", value_parser = SCHEMAS)]
    ap: Schema,
    /// The name of the part [default: that of the output file]
    #[arg(long)]
    name: Option<String>,
    /// The axis of the cage that points up; with y the part is turned so that z does
    #[arg(long, value_name = "AXIS", value_parser = UP_AXES)]
    up_axis: Option<UpAxis>,
    #[command(flatten)]
    memory: MemoryArguments,
}

/// A part and what it cost.
pub(crate) struct Conversion {
    pub(crate) part: Part,
    /// How long it took.
    pub(crate) seconds: f64,
    /// The most memory that it would take, as known beforehand.
    pub(crate) memory_stated: u64,
}

/// A format of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartFormat {
    Step,
    BezierView,
    Json,
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

/// The figures of a part, for programs.
#[derive(Serialize)]
pub(crate) struct PartReport {
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
    max_curvature_jump_absolute: f64,
    smooth_edges: usize,
    sharp_edges: usize,
    levels: Vec<LevelReport>,
    caps: usize,
    cap_degree: Option<usize>,
    nodes: Vec<NodeReport>,
    lenses: Vec<LensReport>,
}

/// How many faces were converted on a level, for programs.
#[derive(Serialize)]
pub(crate) struct LevelReport {
    steps: u32,
    level: u32,
    faces: usize,
}

impl LevelReport {
    fn new(of: &LevelFaces) -> LevelReport {
        let LevelFaces { steps, level, faces } = *of;
        LevelReport { steps, level, faces }
    }

    fn described(&self) -> String {
        let faces = count(self.faces, "face", "faces");
        let split = match self.steps {
            0 => "of the cage".to_owned(),
            1 => "refined once".to_owned(),
            2 => "refined twice".to_owned(),
            steps => format!("refined {steps} times"),
        };
        match self.level {
            0 => format!("{faces} {split}"),
            level => format!("{faces} {split} at level {level}"),
        }
    }
}

impl PartArguments {
    /// Converts the cage `mesh`, which came from `cage`; `curves` lie on it and stay on edges of faces.
    pub(crate) fn convert(
        &self,
        cage: &Cage,
        mesh: &ControlMesh,
        curves: &[NetworkCurve],
        format: PartFormat,
    ) -> Result<Conversion, Failure> {
        let start = Instant::now();
        let budget = self.memory.budget();
        let seams = curves.iter().flat_map(NetworkCurve::legs).collect();
        let options = Options { seams, memory: Some(budget.allowed), ..self.options(format) };
        let part = to_part(mesh, &options).map_err(|error| match &error {
            ConvertError::TooDeep(error) => self.memory.refusal(cage, error),
            _ => refusal(cage, &error),
        })?;
        let memory_stated = budget.stated(u128::from(part.report.memory));
        Ok(Conversion { part, seconds: start.elapsed().as_secs_f64(), memory_stated })
    }

    /// All but what depends on the cage.
    fn options(&self, format: PartFormat) -> Options {
        let pack = self.pack || (format == PartFormat::Step && !self.no_pack);
        Options {
            method: self.method,
            level: self.level,
            max_deviation: self.max_deviation,
            packing: if pack { Packing::Packed } else { Packing::Unpacked },
            seams: Vec::new(),
            lens: lens::Options { method: self.lens, ..lens::Options::default() },
            up: self.up(),
            memory: None,
        }
    }

    /// The axis that points up.
    pub(crate) fn up(&self) -> UpAxis {
        self.up_axis.unwrap_or_default()
    }

    /// Writes a part; its name is that of the destination, or `stem` where that has none.
    pub(crate) fn write(
        &self,
        part: &Part,
        format: PartFormat,
        destination: &Destination,
        stem: &str,
        timestamp: String,
        out: &mut Counter,
    ) -> io::Result<()> {
        match format {
            PartFormat::BezierView => bv::write(part, out),
            PartFormat::Json => patches::write(part, out),
            PartFormat::Step => step::write(part, &self.step_options(destination, stem, timestamp), out),
        }
    }

    /// What a STEP file says about itself.
    pub(crate) fn step_options(
        &self,
        destination: &Destination,
        stem: &str,
        timestamp: String,
    ) -> step::Options {
        let stem = destination.stem().unwrap_or_else(|| stem.to_owned());
        let file_name = match destination {
            Destination::Stdout => format!("{stem}.step"),
            Destination::File(path) => {
                path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
            }
        };
        step::Options {
            unit: self.unit,
            schema: self.ap,
            name: self.name.clone().unwrap_or(stem),
            file_name,
            timestamp,
            originating_system: concat!("ogee ", env!("CARGO_PKG_VERSION")).to_owned(),
        }
    }

    /// What is worth saying about a part that came from the file `name`.
    pub(crate) fn notes(&self, part: &Part, name: &str) -> Vec<Finding> {
        let mut notes: Vec<Finding> = part.report.notes.iter().map(Finding::of_note).collect();
        let [low, high] = part.report.bounding_box;
        let across = low.distance(high) * self.unit.in_millimetres();
        if across < SMALLEST_PART {
            let message = format!(
                "the part is {across:.1e} mm across, and CAD kernels join points 1e-6 mm apart: is the unit right?"
            );
            notes.push(Finding::in_file("tiny", message, name));
        }
        notes
    }

    /// The figures of a part.
    pub(crate) fn report(&self, part: &Part) -> PartReport {
        let figures = &part.report;
        let nodes: Vec<NodeReport> = figures.nodes.iter().map(NodeReport::new).collect();
        let caps = nodes.iter().filter(|node| node.is_cap()).count();
        PartReport {
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
            max_curvature_jump_absolute: figures.max_curvature_jump_absolute,
            smooth_edges: figures.smooth_edges,
            sharp_edges: figures.sharp_edges,
            levels: figures.faces_by_level.iter().map(LevelReport::new).collect(),
            caps,
            cap_degree: (caps > 0).then_some(ogee::g2_caps::DEGREE),
            nodes,
            lenses: figures.lenses.iter().map(LensReport::new).collect(),
        }
    }
}

/// What a refused conversion means: a bad cage, a wrong level, or a wish that was not fulfilled.
pub(crate) fn refusal(cage: &Cage, error: &ConvertError) -> Failure {
    let mut failure = match error {
        ConvertError::Topology(error) => return cage.refused(&error.defects),
        ConvertError::Lens(error) => return crate::commands::lens::refusal(cage, error),
        _ => cage.failure(error.code(), error.to_string()),
    };
    failure.exit = match error {
        ConvertError::Deviation { .. } => Exit::Check,
        ConvertError::LevelTooHigh { .. } | ConvertError::Pccm(PccmError::LevelTooLow { .. }) => Exit::Usage,
        _ => Exit::Input,
    };
    failure
}

impl PartReport {
    /// Adds the figures to a table, more of them if `verbose`.
    pub(crate) fn rows(&self, table: &mut Table, verbose: bool) {
        let (report, unit) = (self, self.unit);
        table.row("cage", count(report.cage_faces, "face", "faces"));
        table.row("method", format!("{} at level {}", report.method, report.level));
        let written = count(report.faces_written, "face", "faces");
        table.row("patches", format!("{}, written as {written}", report.patches));
        if report.levels.len() > 1 {
            let words: Vec<String> = report.levels.iter().map(LevelReport::described).collect();
            table.row("levels", words.join(", "));
        }
        if let Some(degree) = report.cap_degree {
            let left = report.nodes.len() - report.caps;
            let without = if left > 0 { format!(", {left} without") } else { String::new() };
            table.row("caps", format!("{} of degree {degree}{without}", report.caps));
        }
        let shells = count(report.shells, "shell", "shells");
        let closed = if report.closed { "closed" } else { "open" };
        table.row("part", format!("{} of {shells}, {closed}", count(report.solids, "solid", "solids")));
        table.row("unit", unit);
        if !report.lenses.is_empty() {
            table.row("lenses, poles", lens_counts(&report.lenses));
        }
        if let Some(volume) = report.volume {
            table.row("volume", format!("{} {unit}^3", figure(volume)));
        }
        table.row("area", format!("{} {unit}^2", figure(report.area)));
        let [low, high] = report.bbox.map(Vec3::from);
        let size = <[f64; 3]>::from(high - low).map(figure).join(" x ");
        table.row("size", format!("{size} {unit}"));
        table.row("largest angle", format!("{} deg over smooth edges", figure(report.max_normal_angle_deg)));
        if verbose || report.method == Method::G2.name() {
            let jump = figure(report.max_curvature_jump);
            table.row("curvature jump", format!("{jump} at most, times the size"));
        }
        table.row("largest gap", format!("{} {unit}", figure(report.max_gap)));
        let relative = figure(report.max_deviation_relative);
        table.row("deviation", format!("{} {unit}, {relative} of the size", figure(report.max_deviation)));
        if verbose {
            let [low, high] = report.bbox.map(|corner| corner.map(figure).join(" "));
            table.row("bounding box", format!("({low}) to ({high})"));
            table.row("edges", format!("{} smooth, {} sharp", report.smooth_edges, report.sharp_edges));
            table.row("vertices", report.vertices.to_string());
        }
    }
}
