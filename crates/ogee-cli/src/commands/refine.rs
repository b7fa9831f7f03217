//! `ogee refine`: a finer mesh of quads.

use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::convert::UpAxis;
use ogee::{ControlMesh, FaceList, Level, LimitVertex, TooDeep, Vec3, limit_vertices};
use ogee_formats::step::Unit;
use ogee_formats::{Faces, MeshFormat, MeshView, Placement, write_mesh};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{Cage, CageArguments};
use crate::error::{Failure, Finding};
use crate::names::{Format, UNITS, UP_AXES, formats};
use crate::report::{Console, Table, bytes};
use crate::system;

/// Refine a cage
#[derive(Debug, Args)]
pub(crate) struct Refine {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    /// The format of the output, where its name does not tell
    #[arg(long, value_name = "FORMAT", value_parser = formats::<MeshFormat>())]
    output_format: Option<MeshFormat>,
    /// Steps of refinement; with 0 the cage's own polygons are written
    #[arg(short, long, value_name = "N", allow_negative_numbers = true)]
    level: u32,
    /// Move the vertices to the limit surface, and write its normals where the format has them
    #[arg(long)]
    limit: bool,
    /// What a unit of the cage is, for GLB, which is in metres
    #[arg(long, default_value = "mm", value_parser = UNITS)]
    unit: Unit,
    /// The axis of the cage that points up, for GLB, where y does [default: axes stay as they are]
    #[arg(long, value_name = "AXIS", value_parser = UP_AXES)]
    up_axis: Option<UpAxis>,
}

impl Format for MeshFormat {
    const NAMES: &'static [(&'static str, MeshFormat)] = &[
        ("obj", MeshFormat::Obj),
        ("ply", MeshFormat::Ply),
        ("off", MeshFormat::Off),
        ("stl", MeshFormat::Stl),
        ("glb", MeshFormat::Glb),
        ("json", MeshFormat::Json),
    ];
    const ELSEWHERE: &'static [&'static str] = &["3mf", "usd", "usda"];
    const OPTION: &'static str = "--output-format";
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    level: u32,
    vertices: usize,
    faces: usize,
    seconds: Seconds,
    /// The most memory held until the last level was there.
    peak_bytes: Option<u64>,
    file_bytes: u64,
    notes: &'a [Finding],
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    refine: f64,
    write: f64,
}

/// A mesh that is done.
struct Fine {
    points: Vec<Vec3>,
    faces: FineFaces,
    normals: Option<Vec<Vec3>>,
    uv: Option<(Vec<[f64; 2]>, Vec<u32>)>,
}

enum FineFaces {
    Quads(Vec<[u32; 4]>),
    Polygons(FaceList),
}

impl Refine {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let format = MeshFormat::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let progress = console.progress();
        progress.step("reading");
        let cage = self.cage.read()?;
        destination.check()?;

        progress.step("refining");
        let start = Instant::now();
        let level = Level::new(cage.mesh()).map_err(|error| cage.refused(&error.defects))?;
        let fine = self.refine(&cage, level).map_err(|error| cage.failure("too_deep", error.to_string()))?;
        let refine = start.elapsed().as_secs_f64();
        let peak_bytes = system::peak_memory();

        progress.step("writing");
        let start = Instant::now();
        let name = self.cage.stem();
        let placement = Placement {
            unit_in_metres: self.unit.in_millimetres() / 1000.0,
            z_up: self.up_axis == Some(UpAxis::Z),
        };
        let file_bytes = destination.write(|out| write_mesh(&fine.view(&name), format, placement, out))?;
        let seconds = Seconds { read: cage.seconds, refine, write: start.elapsed().as_secs_f64() };
        drop(progress);

        let mut notes = cage.warnings();
        notes.extend(ogee::mesh::notes(cage.mesh()).iter().map(Finding::of_note));
        let report = Report {
            level: self.level,
            vertices: fine.points.len(),
            faces: fine.view(&name).faces.len(),
            seconds,
            peak_bytes,
            file_bytes,
            notes: &notes,
        };
        console.table(&format!("{} -> {}", cage.name, destination.name()), &table(&report), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    fn refine(&self, cage: &Cage, level: Level) -> Result<Fine, TooDeep> {
        let mesh = cage.mesh();
        let memory = system::available_memory().unwrap_or(u64::MAX);
        let own_share = if self.limit { memory / LIMIT_COSTS } else { memory };
        level.check_depth(self.level, own_share)?;
        if self.level == 0 {
            let mut fine = visible(mesh, &level);
            if self.limit {
                fine.move_to_limit(&limit_vertices(&level, &mesh.points));
            }
            return Ok(fine);
        }
        let (uv_level, values) = match &mesh.uv {
            Some(data) => level.face_varying(data),
            None => (level.clone(), Vec::new()),
        };
        if !self.limit {
            let fine = level.fine_mesh(&mesh.points, self.level, memory)?;
            let uv = match mesh.uv {
                Some(_) => Some(uv_level.fine_mesh(&values, self.level, memory)?),
                None => None,
            };
            let uv = uv.map(|uv| (uv.points, uv.faces.into_flattened()));
            return Ok(Fine { points: fine.points, faces: FineFaces::Quads(fine.faces), normals: None, uv });
        }
        let finest = |mut level: Level, mut points: Vec<Vec3>| {
            for _ in 0..self.level {
                (level, points) = level.refine_points(&points);
            }
            let limits = limit_vertices(&level, &points);
            (level, limits)
        };
        let uv = mesh.uv.as_ref().map(|_| {
            // A value is a point of the plane, and has a limit as any other.
            let values = values.iter().map(|&[u, v]| Vec3::new(u, v, 0.0)).collect();
            let (level, limits) = finest(uv_level, values);
            let values = limits.iter().map(|limit| [limit.position.x, limit.position.y]);
            (values.collect(), level.quads().into_flattened())
        });
        let (level, limits) = finest(level, mesh.points.clone());
        let mut fine = Fine { points: Vec::new(), faces: FineFaces::Quads(level.quads()), normals: None, uv };
        fine.move_to_limit(&limits);
        Ok(fine)
    }
}

/// The last level with its connectivity, and limits beside points, cost four times what a plain mesh does.
const LIMIT_COSTS: u64 = 4;

/// The cage's own polygons, without those that are no part of the surface.
fn visible(mesh: &ControlMesh, level: &Level) -> Fine {
    let mut faces = FaceList::with_capacity(mesh.faces.len(), mesh.faces.corners().len());
    let mut indices = Vec::new();
    for (f, corners) in mesh.faces.iter().enumerate() {
        if level.is_visible(ogee::FaceId(f as u32)) {
            faces.push(corners);
            let start = mesh.faces.starts()[f] as usize;
            indices.extend(mesh.uv.iter().flat_map(|uv| &uv.indices[start..start + corners.len()]));
        }
    }
    let uv = mesh.uv.as_ref().map(|uv| (uv.values.clone(), indices));
    Fine { points: mesh.points.clone(), faces: FineFaces::Polygons(faces), normals: None, uv }
}

impl Fine {
    fn move_to_limit(&mut self, limits: &[LimitVertex]) {
        // No normal is written as one of length zero.
        self.normals = Some(limits.iter().map(|limit| limit.normal.unwrap_or(Vec3::ZERO)).collect());
        self.points = limits.iter().map(|limit| limit.position).collect();
    }

    fn view<'a>(&'a self, name: &'a str) -> MeshView<'a> {
        MeshView {
            points: &self.points,
            faces: match &self.faces {
                FineFaces::Quads(quads) => Faces::Quads(quads),
                FineFaces::Polygons(faces) => Faces::Polygons(faces),
            },
            normals: self.normals.as_deref(),
            uv: self.uv.as_ref().map(|(values, indices)| (&values[..], &indices[..])),
            name,
        }
    }
}

fn table(report: &Report<'_>) -> Table {
    let mut table = Table::default();
    table.row("level", report.level.to_string());
    table.row("vertices", report.vertices.to_string());
    table.row("faces", report.faces.to_string());
    let Seconds { read, refine, write } = report.seconds;
    let total = read + refine + write;
    table.row("seconds", format!("{total:.3} (read {read:.3}, refine {refine:.3}, write {write:.3})"));
    if let Some(peak) = report.peak_bytes {
        table.row("memory", bytes(peak));
    }
    table.row("file", bytes(report.file_bytes));
    table
}
