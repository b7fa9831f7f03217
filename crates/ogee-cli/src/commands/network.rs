//! `ogee network`: a cage whose surface contains given curves.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::convert::largest_distance_to_edges;
use ogee::curve_network::{
    BareNetwork, Crossing, CurveNetwork, Embedding, MeetingFigures, NetworkCurve, NetworkDefect,
    NetworkError, NetworkFigures, NetworkOptions, NetworkWarning, Placing, PreSplit, Segment, Skin,
    XConfiguration, embed, skin,
};
use ogee::{ControlMesh, Place};
use ogee_formats::curves::{self, NamedCurve};
use ogee_formats::network::{self, NetworkFile, NetworkFormat};
use ogee_formats::{CageFile, CageFormat};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{Cage, CageArguments, read_bytes};
use crate::error::{Failure, Finding, Where};
use crate::names::{CROSSINGS, Format, PLACINGS, SCHEMES, Scheme, formats};
use crate::output::{Counter, Destination};
use crate::part::{Conversion, PartArguments, PartFormat, PartReport};
use crate::report::{Console, Table, bytes, count, figure};
use crate::timestamp;

/// Make the surface of a cage contain curves exactly
#[derive(Debug, Args)]
pub(crate) struct Network {
    #[command(flatten)]
    cage: CageArguments,
    /// The curves: JSON, or OBJ with a line `l` for each [default: those in the file of the cage]
    #[arg(long, value_name = "NET")]
    curves: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArguments,
    /// The format of the output, where its name does not tell; a cage in obj or json, else a part
    #[arg(long, value_name = "FORMAT", value_parser = formats::<NetworkOutput>())]
    output_format: Option<NetworkOutput>,
    /// Write the curves themselves as B-splines into this file, STEP or OBJ
    #[arg(long, value_name = "FILE")]
    save_curves: Option<PathBuf>,
    #[command(flatten)]
    options: Laying,
    #[command(flatten, next_help_heading = "Part")]
    part: PartArguments,
}

/// How the network is laid.
#[derive(Debug, Args)]
#[command(next_help_heading = "Network")]
struct Laying {
    /// A paper's own form, in place of the options of the file: of 2004, which wants --t, or generalised, with t = 1/2
    #[arg(long, value_name = "SCHEME", value_parser = SCHEMES)]
    scheme: Option<Scheme>,
    /// How the quads around meeting points are placed [default: what the file says, else eigen]
    #[arg(long, value_name = "MODE", value_parser = PLACINGS)]
    x_mode: Option<Placing>,
    /// The parameter t of all meeting points, above 0 and at most 1/2 [default: chosen at each]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    t: Option<f64>,
    /// Whether curves that cross go through the control point, or smoothly through the mean of their limits
    #[arg(long, value_name = "HOW", value_parser = CROSSINGS)]
    crossing: Option<Crossing>,
    /// Splits of the cage before the network is laid [default: what the file says, else as many as needed]
    #[arg(long, value_name = "N")]
    pre_split: Option<u32>,
    /// Lay quads of like width along all curves
    #[arg(long)]
    force_ribbons: bool,
    /// The width of such quads, as a part of the faces they are cut from, between 0 and 1
    #[arg(long, value_name = "WIDTH", allow_negative_numbers = true)]
    theta: Option<f64>,
    /// Refuse the network where the mesh beside it would have to be changed
    #[arg(long)]
    no_repair: bool,
    /// Turn curves that meet into one plane where they do; the report says by how much
    #[arg(long)]
    flatten: bool,
    /// Turn a curve that goes through a meeting point until it has no kink there; the report says by how much
    #[arg(long)]
    straighten: bool,
    /// Make what curves leave open at meeting points as long as the mesh reaches there: for quads much longer than wide
    #[arg(long)]
    fit_mesh: bool,
    /// Move all points that curves do not hold to where the surface bends least
    #[arg(long)]
    fair: bool,
}

/// What can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NetworkOutput {
    CageObj,
    CageJson,
    Part(PartFormat),
}

impl Format for NetworkOutput {
    const NAMES: &'static [(&'static str, NetworkOutput)] = &[
        ("obj", NetworkOutput::CageObj),
        ("json", NetworkOutput::CageJson),
        ("step", NetworkOutput::Part(PartFormat::Step)),
        ("stp", NetworkOutput::Part(PartFormat::Step)),
        ("bv", NetworkOutput::Part(PartFormat::BezierView)),
    ];
    const ELSEWHERE: &'static [&'static str] = &["iges", "igs"];
    const OPTION: &'static str = "--output-format";
}

/// A file for the curves themselves.
struct Wireframe {
    format: WireframeFormat,
    destination: Destination,
}

/// A format of curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WireframeFormat {
    Step,
    Obj,
}

impl Format for WireframeFormat {
    const NAMES: &'static [(&'static str, WireframeFormat)] =
        &[("step", WireframeFormat::Step), ("stp", WireframeFormat::Step), ("obj", WireframeFormat::Obj)];
    const ELSEWHERE: &'static [&'static str] = &["iges", "igs"];
    const OPTION: &'static str = "--save-curves FILE with the extension";
}

impl Wireframe {
    fn new(path: &Path) -> Result<Wireframe, Failure> {
        let format = WireframeFormat::of(None, path).map_err(Failure::usage)?;
        match Destination::new(path) {
            Destination::Stdout => Err(Failure::usage("--save-curves wants the name of a file")),
            destination => Ok(Wireframe { format, destination }),
        }
    }
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    curves: Vec<CurveReport>,
    meetings: Vec<MeetingReport>,
    /// How often the cage was split.
    splits: u32,
    /// Vertices that repair put beside the curves.
    inserted_vertices: usize,
    vertices: usize,
    faces: usize,
    warnings: &'a [Finding],
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<PartReport>,
    /// The largest distance between the curves and the edges of the part.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_edge_error: Option<f64>,
    seconds: Seconds,
    file_bytes: u64,
    notes: &'a [Finding],
}

#[derive(Serialize)]
struct CurveReport {
    name: String,
    /// Its vertices in the cage that was made.
    vertices: Vec<u32>,
    closed: bool,
    /// The largest distance between the curve and the limit surface along it.
    max_error: f64,
}

#[derive(Serialize)]
struct MeetingReport {
    vertex: u32,
    ports: usize,
    t: f64,
    mode: &'static str,
    coplanarity_deg: Option<f64>,
    normal_spread_deg: Option<f64>,
}

#[derive(Clone, Copy, Serialize)]
struct Seconds {
    read: f64,
    embed: f64,
    measure: f64,
    convert: f64,
    write: f64,
}

impl Network {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = NetworkOutput::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let wireframe = self.save_curves.as_deref().map(Wireframe::new).transpose()?;
        let timestamp = timestamp::from_environment()?;
        let progress = console.progress();
        progress.step("reading");
        let (cage, file_name, file) = self.read()?;
        destination.check()?;
        if let Some(wireframe) = &wireframe {
            wireframe.destination.check()?;
        }

        progress.step("laying the network");
        let start = Instant::now();
        let network = self.options.applied(file.network.clone())?;
        let embedding = embed(&network, cage.mesh()).map_err(|error| refused(&error, &cage, &file_name))?;
        let embed = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let changed = || cage.failure("E_REPAIR", "the cage that was made is no sound mesh");
        let figures = embedding.measure().ok_or_else(changed)?;
        let measure = start.elapsed().as_secs_f64();

        let paths = paths(&network, &embedding);
        let (mut part, mut edge_error) = (None, None);
        if let NetworkOutput::Part(kind) = format {
            progress.step("converting");
            let Conversion { part: made, seconds, .. } =
                self.part.convert(&cage, &embedding.mesh, &paths, kind)?;
            let targets: Vec<_> = embedding.segments.iter().map(|segment| segment.target.clone()).collect();
            edge_error = Some(largest_distance_to_edges(&made, &targets, self.part.up()));
            part = Some((made, seconds));
        }
        let convert = part.as_ref().map_or(0.0, |(_, seconds)| *seconds);

        progress.step("writing");
        let start = Instant::now();
        if let Some(Wireframe { format, destination }) = &wireframe {
            let curves = named_curves(&network, &embedding);
            let options = self.part.step_options(destination, &self.cage.stem(), timestamp.clone());
            destination.write(|out| match format {
                WireframeFormat::Obj => curves::write_obj(&curves, out),
                WireframeFormat::Step => curves::write_step(&curves, &options, out),
            })?;
        }
        let file_bytes = destination.write(|out| match (format, &part) {
            (NetworkOutput::Part(kind), Some((part, _))) => {
                self.part.write(part, kind, &destination, &self.cage.stem(), timestamp, out)
            }
            _ => write_cage(format, &embedding, &paths, out),
        })?;
        let write = start.elapsed().as_secs_f64();
        let seconds = Seconds { read: cage.seconds, embed, measure, convert, write };
        drop(progress);

        let mut notes = cage.warnings();
        notes.extend(file.warnings.iter().map(|warning| Finding::of_warning(warning, &file_name)));
        if let Some((part, _)) = &part {
            notes.extend(self.part.notes(part, &cage.name));
        }
        let warnings: Vec<Finding> = embedding.warnings.iter().map(of_warning).collect();
        let report = Report {
            curves: curve_reports(&network, &embedding, &figures),
            meetings: meeting_reports(&network, &embedding, &figures),
            splits: embedding.splits,
            inserted_vertices: embedding.inserted_vertices,
            vertices: embedding.mesh.points.len(),
            faces: embedding.mesh.faces.len(),
            warnings: &warnings,
            part: part.as_ref().map(|(part, _)| self.part.report(part)),
            max_edge_error: edge_error,
            seconds,
            file_bytes,
            notes: &notes,
        };
        let title = format!("{} -> {}", cage.name, destination.name());
        let said: Vec<Finding> = warnings.iter().chain(&notes).cloned().collect();
        console.table(&title, &table(&report, console.is_verbose()), &said);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }
}

impl Network {
    /// The cage, and the curves with the name of their file.
    fn read(&self) -> Result<(Cage, String, NetworkFile), Failure> {
        let start = Instant::now();
        let (name, format, bytes) = self.cage.load()?;
        if let Some(bare) = self.bare(format, &bytes) {
            let (mesh, file) = skinned(bare, &name)?;
            let file_of_cage = CageFile { mesh, face_lines: Vec::new(), warnings: Vec::new() };
            let cage =
                Cage { name: name.clone(), file: file_of_cage, seconds: start.elapsed().as_secs_f64() };
            return Ok((cage, name, file));
        }
        let cage = self.cage.parse(name.clone(), format, &bytes)?;
        let (name, file) = match &self.curves {
            None => {
                let format = match format {
                    CageFormat::Json => NetworkFormat::Json,
                    CageFormat::Obj => NetworkFormat::Obj,
                    _ => {
                        return Err(Failure::usage(
                            "this format of cages has no curves; give them with --curves",
                        ));
                    }
                };
                let file = network::read(&bytes, format);
                (name.clone(), file.map_err(|error| Failure::of_reading(&error, &name))?)
            }
            Some(path) => {
                let format = NetworkFormat::from_path(path).ok_or_else(|| {
                    Failure::usage(format!("{}: curves are read from .json and .obj", path.display()))
                })?;
                let (name, bytes) = read_bytes(path)?;
                let file =
                    network::read(&bytes, format).map_err(|error| Failure::of_reading(&error, &name))?;
                (name, file)
            }
        };
        let (own, of_cage) = (file.points.len(), cage.mesh().points.len());
        if own != 0 && own != of_cage {
            let message = format!("the curves belong to {own} vertices, and the cage has {of_cage}");
            return Err(Failure::refused(vec![Finding::in_file("other_cage", message, &name)], 0));
        }
        Ok((Cage { seconds: start.elapsed().as_secs_f64(), ..cage }, name, file))
    }
}

impl Network {
    /// The network of a file that has curves and no faces.
    fn bare(&self, format: CageFormat, bytes: &[u8]) -> Option<NetworkFile> {
        let format = match format {
            CageFormat::Json => NetworkFormat::Json,
            CageFormat::Obj => NetworkFormat::Obj,
            _ => return None,
        };
        let is_bare = |file: &NetworkFile| !file.has_faces && !file.points.is_empty();
        // What is wrong with a file that has faces its readers say.
        network::read(bytes, format).ok().filter(|file| self.curves.is_none() && is_bare(file))
    }
}

/// A cage for a network that has none, and the network on it.
fn skinned(file: NetworkFile, name: &str) -> Result<(ControlMesh, NetworkFile), Failure> {
    let NetworkFile { network, points, loops, .. } = file;
    let bare = BareNetwork { points, curves: network.curves, loops };
    let Skin { mesh, curves } = skin(&bare).map_err(|error| {
        let of_defect = |defect: &NetworkDefect| {
            let mut finding = Finding::in_file(defect.code(), defect.to_string(), name);
            finding.location.place = defect.place();
            finding
        };
        Failure::refused(error.defects.iter().map(of_defect).collect(), 0)
    })?;
    let network = CurveNetwork { curves, ..network };
    Ok((mesh, NetworkFile { network, warnings: file.warnings, ..NetworkFile::default() }))
}

impl Laying {
    /// The network with the options that were typed.
    fn applied(&self, mut network: CurveNetwork) -> Result<CurveNetwork, Failure> {
        let options = &mut network.options;
        match (self.scheme, self.t) {
            (None, _) => {}
            (Some(Scheme::Generalised), _) => *options = NetworkOptions::generalised(),
            (Some(Scheme::AbbasNasri2004), Some(t)) => *options = NetworkOptions::abbas_nasri_2004(t),
            (Some(Scheme::AbbasNasri2004), None) => {
                return Err(Failure::usage("--scheme abbas-nasri-2004 has a parameter: say --t T"));
            }
        }
        *options = NetworkOptions {
            placing: self.x_mode.unwrap_or(options.placing),
            parameter: self.t.or(options.parameter),
            crossing: self.crossing.unwrap_or(options.crossing),
            pre_split: self.pre_split.map_or(options.pre_split, PreSplit::Fixed),
            force_ribbons: options.force_ribbons || self.force_ribbons,
            ribbon_width: self.theta.unwrap_or(options.ribbon_width),
            repair: options.repair && !self.no_repair,
            flatten: options.flatten || self.flatten,
            straighten: options.straighten || self.straighten,
            fit_mesh: options.fit_mesh || self.fit_mesh,
            fair: options.fair || self.fair,
        };
        Ok(network)
    }
}

/// Why the network was not laid, each defect with its place.
fn refused(error: &NetworkError, cage: &Cage, curves: &str) -> Failure {
    let finding = |defect: &NetworkDefect| match defect {
        NetworkDefect::Mesh(mesh) => {
            let mut found = cage.findings(std::slice::from_ref(mesh));
            let mut finding = found.swap_remove(0);
            finding.code = defect.code();
            finding
        }
        _ => {
            let mut finding = Finding::in_file(defect.code(), defect.to_string(), curves);
            finding.location.place = defect.place();
            finding
        }
    };
    Failure::refused(error.defects.iter().map(finding).collect(), 0)
}

fn of_warning(warning: &NetworkWarning) -> Finding {
    let place = Some(Place::Vertex(warning.vertex()));
    Finding {
        code: warning.code(),
        message: warning.to_string(),
        location: Where { place, ..Where::default() },
    }
}

fn write_cage(
    format: NetworkOutput,
    embedding: &Embedding,
    paths: &[NetworkCurve],
    out: &mut Counter,
) -> io::Result<()> {
    match format {
        NetworkOutput::CageObj => network::write_obj(&embedding.mesh, paths, "made by ogee network", out),
        _ => {
            let network = CurveNetwork { curves: paths.to_vec(), ..CurveNetwork::default() };
            network::write_json(&embedding.mesh, &network, out)
        }
    }
}

/// The name of a piece of a curve: its own, with a number if there are more.
fn piece_name(network: &CurveNetwork, embedding: &Embedding, segment: &Segment) -> String {
    let name = &network.curves[segment.curve].name;
    let pieces = embedding.segments.iter().filter(|other| other.curve == segment.curve).count();
    if pieces == 1 { name.clone() } else { format!("{name}.{}", segment.piece + 1) }
}

/// The curves as paths in the cage that was made, cut where they meet.
fn paths(network: &CurveNetwork, embedding: &Embedding) -> Vec<NetworkCurve> {
    let path = |segment: &Segment| NetworkCurve {
        name: piece_name(network, embedding, segment),
        vertices: segment.vertices.clone(),
        closed: segment.target.is_closed(),
        control: Some(segment.target.control().to_vec()),
        ..NetworkCurve::default()
    };
    embedding.segments.iter().map(path).collect()
}

/// The curves as B-splines.
fn named_curves(network: &CurveNetwork, embedding: &Embedding) -> Vec<NamedCurve> {
    let named = |segment: &Segment| NamedCurve {
        name: piece_name(network, embedding, segment),
        curve: segment.target.to_nurbs(),
    };
    embedding.segments.iter().map(named).collect()
}

fn curve_reports(
    network: &CurveNetwork,
    embedding: &Embedding,
    figures: &NetworkFigures,
) -> Vec<CurveReport> {
    let mut reports: Vec<CurveReport> = Vec::new();
    let mut last = None;
    for (segment, &error) in embedding.segments.iter().zip(&figures.errors) {
        match reports.last_mut().filter(|_| last == Some(segment.curve)) {
            Some(report) => {
                // A piece begins where the one before it ended.
                report.vertices.extend(&segment.vertices[1..]);
                report.max_error = report.max_error.max(error);
            }
            None => reports.push(CurveReport {
                name: network.curves[segment.curve].name.clone(),
                vertices: segment.vertices.clone(),
                closed: network.curves[segment.curve].closed,
                max_error: error,
            }),
        }
        last = Some(segment.curve);
    }
    for report in
        reports.iter_mut().filter(|report| report.closed && report.vertices.first() == report.vertices.last())
    {
        report.vertices.pop();
    }
    reports
}

fn meeting_reports(
    network: &CurveNetwork,
    embedding: &Embedding,
    figures: &NetworkFigures,
) -> Vec<MeetingReport> {
    let report = |(meeting, figures): (&XConfiguration, &MeetingFigures)| {
        let XConfiguration { center, ring, parameter } = meeting;
        MeetingReport {
            vertex: *center,
            ports: ring.len() / 2,
            t: *parameter,
            mode: match network.meeting(*center).placing.unwrap_or_default() {
                Placing::Eigen => "eigen",
                Placing::Parallelogram => "parallelogram",
                Placing::Symmetric => "symmetric",
                Placing::Keep => "keep",
            },
            coplanarity_deg: figures.coplanarity_deg,
            normal_spread_deg: figures.normal_spread_deg,
        }
    };
    embedding.x_configurations.iter().zip(&figures.meetings).map(report).collect()
}

fn table(report: &Report<'_>, verbose: bool) -> Table {
    let mut table = Table::default();
    let error = report.curves.iter().map(|curve| curve.max_error).fold(0.0, f64::max);
    table.row(
        "curves",
        format!("{}, at most {} off", count(report.curves.len(), "curve", "curves"), figure(error)),
    );
    let spread = report.meetings.iter().filter_map(|meeting| meeting.normal_spread_deg).fold(0.0, f64::max);
    if !report.meetings.is_empty() {
        let meetings = count(report.meetings.len(), "point", "points");
        table.row(
            "meetings",
            format!("{meetings}, normals within {} deg 1/256 of a face away", figure(spread)),
        );
    }
    let splits = count(report.splits as usize, "split", "splits");
    let inserted = count(report.inserted_vertices, "vertex", "vertices");
    table.row("changes", format!("{splits}, {inserted} inserted"));
    table.row("cage", format!("{} vertices, {} faces", report.vertices, report.faces));
    if verbose {
        for curve in &report.curves {
            table.row(
                "curve",
                format!(
                    "{}: {} vertices, at most {} off",
                    curve.name,
                    curve.vertices.len(),
                    figure(curve.max_error)
                ),
            );
        }
        for meeting in &report.meetings {
            let MeetingReport { vertex, ports, t, mode, .. } = meeting;
            table.row("meeting", format!("vertex {vertex}: {ports} ports, t = {}, {mode}", figure(*t)));
        }
    }
    if let Some(part) = &report.part {
        part.rows(&mut table, verbose);
    }
    if let Some(error) = report.max_edge_error {
        table.row("edges", format!("curves at most {} off edges of the part", figure(error)));
    }
    let Seconds { read, embed, measure, convert, write } = report.seconds;
    let total = read + embed + measure + convert + write;
    let parts = format!(
        "read {read:.3}, embed {embed:.3}, measure {measure:.3}, convert {convert:.3}, write {write:.3}"
    );
    table.row("seconds", format!("{total:.3} ({parts})"));
    table.row("file", bytes(report.file_bytes));
    table
}
