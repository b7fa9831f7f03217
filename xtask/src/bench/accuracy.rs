//! How exact everybody is: against `testdata/evaluation`, and Blender's vertices against the limit masks.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use ogee::{
    ControlMesh, Derivatives, FaceId, Level, LimitSurface, PatchTable, Refinement, Vec3, VertexId,
    limit_vertices,
};
use ogee_formats::{CageFormat, read_cage};
use serde_json::Value;

use super::peers::{Contestant, Found};
use super::report::Table;
use ogee_bench_cages::exchange::{self, Sample};

/// Blender's vertices are compared on so many quads along each side of a face.
const SIDE: u32 = 8;

/// A position and a normal, of any length.
#[derive(Clone, Copy)]
pub(crate) struct Point {
    position: Vec3,
    normal: Vec3,
}

/// The greatest errors of many points.
pub(crate) struct Error {
    /// Of positions, relative to the size of the cage.
    pub(crate) distance: f64,
    /// Of normals; 180 where there is none.
    pub(crate) degrees: f64,
}

/// Compares points that should be the same. A figure that is no number is the worst error of all.
pub(crate) fn greatest(pairs: impl Iterator<Item = (Point, Point)>, size: f64) -> Error {
    let worse = |a: f64, b: f64| if b.is_nan() { f64::INFINITY } else { a.max(b) };
    pairs.fold(Error { distance: 0.0, degrees: 0.0 }, |worst, (a, b)| {
        let degrees = match (a.normal.normalized(), b.normal.normalized()) {
            (Some(a), Some(b)) => a.angle(b).to_degrees(),
            _ => 180.0,
        };
        let distance = a.position.distance(b.position) / size;
        Error { distance: worse(worst.distance, distance), degrees: worse(worst.degrees, degrees) }
    })
}

/// Points from positions and first derivatives, nine numbers each.
pub(crate) fn points(values: &[f64]) -> Vec<Point> {
    let vector = |v: &[f64]| Vec3::new(v[0], v[1], v[2]);
    let point = |v: &[f64]| Point { position: vector(v), normal: vector(&v[3..]).cross(vector(&v[6..])) };
    values.chunks_exact(9).map(point).collect()
}

/// One row per cage of `testdata/evaluation`.
pub(crate) fn table(opensubdiv: Option<&Found>, blender: Option<&Found>, folder: &Path) -> Result<Table> {
    let peers: Vec<Contestant> = opensubdiv.map_or_else(Vec::new, |found| {
        vec![
            found.contestant("Bfr, default levels", "bfr", -1),
            found.contestant("Bfr, level 10", "bfr", 10),
            found.contestant("Far, isolation 3", "far", 3),
            found.contestant("Far, isolation 10, its default", "far", -1),
        ]
    });
    let blender = blender.map(|found| found.contestant("Blender, vertices", "blender", -1));
    let mut columns = vec!["error of position / size, of normal in degrees", "ogee"];
    columns.extend(peers.iter().chain(&blender).map(|peer| peer.name.as_str()));
    let mut table = Table::new(&columns);
    let [cage_file, samples_file, output] = ["cage", "samples", "values"].map(|name| folder.join(name));
    for golden in golden()? {
        let Golden { name, mesh, samples, points: exact } = &golden;
        exchange::write_cage(&cage_file, mesh)?;
        exchange::write_samples(&samples_file, samples)?;
        let mut cells = vec![name.clone(), cell(&error(exact, &own_points(mesh, samples)?, mesh)?)];
        for peer in &peers {
            let rest = ["1", &samples_file.to_string_lossy(), &output.to_string_lossy()];
            peer.run("values", &cage_file, &rest)?;
            cells.push(cell(&error(exact, &points(&exchange::read_numbers(&output)?), mesh)?));
        }
        if let Some(blender) = &blender {
            let smooth = mesh.creases.is_empty() && mesh.corners.is_empty();
            cells.push(if smooth {
                cell(&tessellated(blender, mesh, &cage_file, &output)?)
            } else {
                String::new()
            });
        }
        table.row(&cells);
    }
    Ok(table)
}

fn cell(error: &Error) -> String {
    format!("{:.0e}, {:.0e}", error.distance, error.degrees)
}

fn error(exact: &[Point], given: &[Point], mesh: &ControlMesh) -> Result<Error> {
    ensure!(exact.len() == given.len(), "{} points instead of {}", given.len(), exact.len());
    Ok(greatest(exact.iter().copied().zip(given.iter().copied()), mesh.size()))
}

fn own_points(mesh: &ControlMesh, samples: &[Sample]) -> Result<Vec<Point>> {
    let level = Level::new(mesh)?;
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let places = samples.iter().map(|s| table.locate(FaceId(s.face), s.corner, s.u, s.v));
    let results = surface.eval_batch(&places.collect::<Result<Vec<_>, _>>()?, Derivatives::First);
    let pairs = results.position.iter().zip(&results.normal);
    Ok(pairs.map(|(&position, &normal)| Point { position, normal }).collect())
}

/// Blender's vertices beside the limits of the refined cage's vertices, each with the nearest. Those on the boundary
/// are left out: a bumpy rim may fold, and then no average of faces is the normal.
fn tessellated(blender: &Contestant, mesh: &ControlMesh, cage: &Path, output: &Path) -> Result<Error> {
    blender.run("vertices", cage, &["1", &SIDE.to_string(), &output.to_string_lossy()])?;
    let level = Level::new(mesh)?;
    let refined = Refinement::uniform(&level, SIDE.ilog2())?;
    let finest = refined.finest();
    let exact = limit_vertices(finest, &refined.apply(&mesh.points));
    let numbers = exchange::read_numbers(output)?;
    let mut pairs = Vec::new();
    for v in numbers.chunks_exact(6) {
        let (position, normal) = (Vec3::new(v[0], v[1], v[2]), Vec3::new(v[3], v[4], v[5]));
        let distance = |v: &usize| exact[*v].position.distance(position);
        let nearest = (0..exact.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.context("a cage without vertices")?;
        if !finest.topology().is_boundary(VertexId(nearest as u32)) {
            let exact = exact[nearest];
            let exact = Point { position: exact.position, normal: exact.normal.unwrap_or(Vec3::ZERO) };
            pairs.push((exact, Point { position, normal }));
        }
    }
    Ok(greatest(pairs.into_iter(), mesh.size()))
}

/// A cage with places where position and normal are known.
struct Golden {
    name: String,
    mesh: ControlMesh,
    samples: Vec<Sample>,
    points: Vec<Point>,
}

/// All of `testdata/evaluation`, by name.
fn golden() -> Result<Vec<Golden>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../testdata/evaluation");
    let mut files = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    files.retain(|file| file.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    let read = |file: &Path| {
        let document: Value = serde_json::from_slice(&std::fs::read(file)?)?;
        golden_case(&document).with_context(|| format!("in {}", file.display()))
    };
    files.iter().map(|file| read(file)).collect()
}

fn golden_case(document: &Value) -> Result<Golden> {
    let mut cage = document["mesh"].clone();
    // Edges and infinity have other names than in a cage in JSON.
    for crease in cage["creases"].as_array_mut().into_iter().flatten() {
        crease["vertices"] = crease["edge"].take();
    }
    for key in ["creases", "corners"] {
        for tag in cage[key].as_array_mut().into_iter().flatten() {
            if tag["sharpness"] == "inf" {
                tag["sharpness"] = "infinite".into();
            }
        }
    }
    let mesh = read_cage(&serde_json::to_vec(&cage)?, CageFormat::Json)?.mesh;
    let number = |value: &Value| value.as_f64().context("a number is missing");
    let vector =
        |value: &Value| anyhow::Ok(Vec3::new(number(&value[0])?, number(&value[1])?, number(&value[2])?));
    let (mut samples, mut points) = (Vec::new(), Vec::new());
    for sample in document["samples"].as_array().context("samples are missing")? {
        samples.push(Sample {
            face: number(&sample["face"])? as u32,
            corner: sample["subface"].as_u64().map(|corner| corner as u32),
            u: number(&sample["u"])?,
            v: number(&sample["v"])?,
        });
        points.push(Point { position: vector(&sample["S"])?, normal: vector(&sample["n"])? });
    }
    let name = document["name"].as_str().context("a name is missing")?.to_owned();
    Ok(Golden { name, mesh, samples, points })
}
