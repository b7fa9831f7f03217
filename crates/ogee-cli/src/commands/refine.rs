//! `ogee refine`: a finer mesh of quads.

use std::io;
use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use ogee::convert::UpAxis;
use ogee::{ControlMesh, DenseRefinement, FaceList, Level, LimitVertex, TooDeep, Vec3, limit_vertices};
use ogee_formats::step::Unit;
use ogee_formats::{Faces, MeshBlocks, MeshFormat, MeshView, Placement, write_mesh, write_mesh_blocks};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{Cage, CageArguments};
use crate::error::{Failure, Finding};
use crate::memory::MemoryArguments;
use crate::names::{Format, UNITS, UP_AXES, formats};
use crate::output::{Counter, Destination};
use crate::progress::Progress;
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
    /// Write the mesh while it is made, in less memory than it takes: obj, ply and off
    #[arg(long)]
    stream: bool,
    /// What a unit of the cage is, for GLB, which is in metres
    #[arg(long, default_value = "mm", value_parser = UNITS)]
    unit: Unit,
    /// The axis of the cage that points up, for GLB, where y does [default: axes stay as they are]
    #[arg(long, value_name = "AXIS", value_parser = UP_AXES)]
    up_axis: Option<UpAxis>,
    #[command(flatten)]
    memory: MemoryArguments,
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
    /// The most memory held until the last level was there, or the file where it is streamed.
    peak_bytes: Option<u64>,
    /// The most that it would be, as known from the counts of the cage.
    memory_stated: u64,
    file_bytes: u64,
    notes: &'a [Finding],
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    refine: f64,
    write: f64,
}

/// Where the mesh goes.
struct Output<'a> {
    destination: &'a Destination,
    format: MeshFormat,
    name: String,
}

/// What became of it.
struct Made {
    vertices: usize,
    faces: usize,
    refine: f64,
    write: f64,
    peak_bytes: Option<u64>,
    memory_stated: u64,
    file_bytes: u64,
}

/// A mesh that is never there as a whole.
struct Blocks<'a> {
    refinement: DenseRefinement<'a>,
    /// Of the cage.
    points: &'a [Vec3],
}

impl MeshBlocks for Blocks<'_> {
    fn vertex_count(&self) -> usize {
        self.refinement.vertex_count()
    }

    fn face_count(&self) -> usize {
        self.refinement.face_count()
    }

    fn points(&self, take: &mut dyn FnMut(&[Vec3]) -> io::Result<()>) -> io::Result<()> {
        self.refinement.visit_points(self.points, take)
    }

    fn quads(&self, take: &mut dyn FnMut(&[[u32; 4]]) -> io::Result<()>) -> io::Result<()> {
        self.refinement.visit_quads(take)
    }
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
        self.check_stream(format)?;
        let progress = console.progress();
        progress.step("reading");
        let cage = self.cage.read()?;
        destination.check()?;

        progress.step("refining");
        let start = Instant::now();
        let level = Level::new(cage.mesh()).map_err(|error| cage.refused(&error.defects))?;
        let plan = start.elapsed().as_secs_f64();
        let output = Output { destination: &destination, format, name: self.cage.stem() };
        let made = match self.stream && self.level > 0 {
            true => self.stream(&cage, &level, &output, &progress)?,
            false => self.whole(&cage, level, &output, &progress)?,
        };
        drop(progress);

        let mut notes = cage.warnings();
        notes.extend(ogee::mesh::notes(cage.mesh()).iter().map(Finding::of_note));
        let report = Report {
            level: self.level,
            vertices: made.vertices,
            faces: made.faces,
            seconds: Seconds { read: cage.seconds, refine: plan + made.refine, write: made.write },
            peak_bytes: made.peak_bytes,
            memory_stated: made.memory_stated,
            file_bytes: made.file_bytes,
            notes: &notes,
        };
        console.table(&format!("{} -> {}", cage.name, destination.name()), &table(&report), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Refuses what cannot be written while it is made.
    fn check_stream(&self, format: MeshFormat) -> Result<(), Failure> {
        if !self.stream {
            return Ok(());
        }
        if self.limit {
            return Err(Failure::usage(
                "--stream has no --limit: the limit of a vertex wants what is around it",
            ));
        }
        if !format.takes_blocks() {
            let name = format.name();
            return Err(Failure::usage(format!("--stream writes obj, ply and off, not {name}")));
        }
        Ok(())
    }

    /// All of the mesh, then all of the file.
    fn whole(
        &self,
        cage: &Cage,
        level: Level,
        output: &Output<'_>,
        progress: &Progress,
    ) -> Result<Made, Failure> {
        let start = Instant::now();
        let budget = self.memory.budget();
        let copies = self.copies(cage.mesh());
        let fits = level.check_fine_mesh(self.level, budget.allowed / copies);
        let memory_stated = budget.stated(u128::from(copies) * level.fine_mesh_bytes(self.level));
        let fine = fits.and_then(|()| self.refine(cage, level));
        let fine = fine.map_err(|error| self.memory.refusal(cage, &error))?;
        let refine = start.elapsed().as_secs_f64();
        let peak_bytes = system::peak_memory();

        progress.step("writing");
        let start = Instant::now();
        let placement = Placement {
            unit_in_metres: self.unit.in_millimetres() / 1000.0,
            z_up: self.up_axis == Some(UpAxis::Z),
        };
        let view = fine.view(&output.name);
        let file_bytes = output.destination.write(|out| write_mesh(&view, output.format, placement, out))?;
        let write = start.elapsed().as_secs_f64();
        let (vertices, faces) = (view.points.len(), view.faces.len());
        Ok(Made { vertices, faces, refine, write, peak_bytes, memory_stated, file_bytes })
    }

    /// The file while the mesh is made.
    fn stream(
        &self,
        cage: &Cage,
        level: &Level,
        output: &Output<'_>,
        progress: &Progress,
    ) -> Result<Made, Failure> {
        let mesh = cage.mesh();
        if mesh.uv.is_some() && output.format == MeshFormat::Obj {
            let message = "--stream writes no texture coordinates, and obj would have them; write ply or off";
            return Err(Failure::usage(message));
        }
        let start = Instant::now();
        let budget = self.memory.budget();
        let fits = level.check_streaming(self.level, budget.allowed);
        let memory_stated = budget.stated(level.streaming_bytes(self.level));
        let refinement = fits.and_then(|()| level.dense(self.level, u64::MAX));
        let refinement = refinement.map_err(|error| self.memory.refusal(cage, &error))?;
        let refine = start.elapsed().as_secs_f64();

        progress.step("refining and writing");
        let start = Instant::now();
        let blocks = Blocks { refinement, points: &mesh.points };
        let write = |out: &mut Counter| write_mesh_blocks(&blocks, &output.name, output.format, out);
        let file_bytes = output.destination.write(write)?;
        Ok(Made {
            vertices: blocks.vertex_count(),
            faces: blocks.face_count(),
            refine,
            write: start.elapsed().as_secs_f64(),
            peak_bytes: system::peak_memory(),
            memory_stated,
            file_bytes,
        })
    }

    /// How many plain meshes there would be room for in the memory that is taken.
    fn copies(&self, mesh: &ControlMesh) -> u64 {
        let limit = if self.limit { LIMIT_COSTS } else { 1 };
        let texture = if mesh.uv.is_some() { 2 } else { 1 };
        limit * texture
    }

    fn refine(&self, cage: &Cage, level: Level) -> Result<Fine, TooDeep> {
        let mesh = cage.mesh();
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
            let fine = level.fine_mesh(&mesh.points, self.level, u64::MAX)?;
            let uv = match mesh.uv {
                Some(_) => Some(uv_level.fine_mesh(&values, self.level, u64::MAX)?),
                None => None,
            };
            let uv = uv.map(|uv| (uv.points, uv.faces.into_flattened()));
            return Ok(Fine { points: fine.points, faces: FineFaces::Quads(fine.faces), normals: None, uv });
        }
        let limits = |level: &Level, points: &[Vec3]| {
            let refinement = level.dense(self.level, u64::MAX)?;
            let (mut positions, mut normals, mut quads) = (Vec::new(), Vec::new(), Vec::new());
            refinement.limit(points, &mut positions, &mut normals);
            refinement.quads(&mut quads);
            Ok::<_, TooDeep>((positions, normals, quads))
        };
        let mut uv = None;
        if mesh.uv.is_some() {
            // A value is a point of the plane, and has a limit as any other.
            let values: Vec<Vec3> = values.iter().map(|&[u, v]| Vec3::new(u, v, 0.0)).collect();
            let (values, _, quads) = limits(&uv_level, &values)?;
            uv = Some((values.iter().map(|value| [value.x, value.y]).collect(), quads.into_flattened()));
        }
        let (points, normals, quads) = limits(&level, &mesh.points)?;
        Ok(Fine { points, faces: FineFaces::Quads(quads), normals: Some(normals), uv })
    }
}

/// Limits beside points, and levels where no grids serve, cost at most four times what a plain mesh does.
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
        table.row("memory", format!("{}, at most {} stated", bytes(peak), bytes(report.memory_stated)));
    }
    table.row("file", bytes(report.file_bytes));
    table
}
