//! Writing GLB: one triangle mesh with smooth normals, for viewers.
//!
//! Positions are those of the mesh, in single precision; the matrix of the one node takes them to the metres and
//! the upward y of glTF, so that nothing is lost to scaling.

use std::io::{self, Write};

use ogee::Vec3;
use serde_json::json;

use crate::mesh::{MeshView, Placement};
use crate::triangles;

const COMPONENT_F32: u32 = 5126;
const COMPONENT_U32: u32 = 5125;
const TARGET_VERTICES: u32 = 34962;
const TARGET_INDICES: u32 = 34963;

/// Writes a mesh. Normals that are not given are the mean of the faces around, by area; texture coordinates are
/// left out.
pub(crate) fn write_view(view: &MeshView<'_>, placement: Placement, out: &mut impl Write) -> io::Result<()> {
    let refuse = |message: &str| io::Error::new(io::ErrorKind::InvalidInput, message.to_string());
    let triangle_count = triangles::count(view.faces);
    if triangle_count == 0 {
        return Err(refuse("GLB needs at least one triangle"));
    }
    if view.points.iter().any(|&p| !single(p).iter().all(|x| x.is_finite())) {
        return Err(refuse("GLB holds single precision, and a vertex is too far away for it"));
    }
    let unit = placement.unit_in_metres;
    if !unit.is_finite() || unit <= 0.0 {
        return Err(refuse("the unit of the mesh is no positive length"));
    }
    let mut text = description(view, placement, triangle_count);
    while !text.len().is_multiple_of(4) {
        text.push(' ');
    }
    let binary = 24 * view.points.len() + 12 * triangle_count;
    let length = |bytes: usize| u32::try_from(bytes).map_err(|_| refuse("GLB holds less than 4 GiB"));
    out.write_all(b"glTF")?;
    out.write_all(&2u32.to_le_bytes())?;
    out.write_all(&length(12 + 8 + text.len() + 8 + binary)?.to_le_bytes())?;
    out.write_all(&length(text.len())?.to_le_bytes())?;
    out.write_all(b"JSON")?;
    out.write_all(text.as_bytes())?;
    out.write_all(&length(binary)?.to_le_bytes())?;
    out.write_all(b"BIN\0")?;
    for &p in view.points {
        write_vector(p, out)?;
    }
    for n in unit_normals(view) {
        write_vector(n, out)?;
    }
    for triangle in triangles::of_faces(view.points, view.faces) {
        for v in triangle {
            out.write_all(&v.to_le_bytes())?;
        }
    }
    Ok(())
}

/// The JSON chunk.
fn description(view: &MeshView<'_>, placement: Placement, triangle_count: usize) -> String {
    let vertices = view.points.len();
    let (low, high) =
        view.points.iter().fold(([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]), |(mut low, mut high), &p| {
            for (axis, x) in single(p).into_iter().enumerate() {
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
            (low, high)
        });
    let part = |offset: usize, length: usize, target: u32| json!({"buffer": 0, "byteOffset": offset, "byteLength": length, "target": target});
    json!({
        "asset": {"version": "2.0", "generator": "ogee"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": view.name, "mesh": 0, "matrix": matrix(placement)}],
        "meshes": [{
            "name": view.name,
            "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "mode": 4}],
        }],
        "accessors": [
            {"bufferView": 0, "componentType": COMPONENT_F32, "count": vertices, "type": "VEC3",
             "min": low, "max": high},
            {"bufferView": 1, "componentType": COMPONENT_F32, "count": vertices, "type": "VEC3"},
            {"bufferView": 2, "componentType": COMPONENT_U32, "count": 3 * triangle_count, "type": "SCALAR"},
        ],
        "bufferViews": [
            part(0, 12 * vertices, TARGET_VERTICES),
            part(12 * vertices, 12 * vertices, TARGET_VERTICES),
            part(24 * vertices, 12 * triangle_count, TARGET_INDICES),
        ],
        "buffers": [{"byteLength": 24 * vertices + 12 * triangle_count}],
    })
    .to_string()
}

/// Scale and turn, column after column.
fn matrix(placement: Placement) -> [f64; 16] {
    let s = placement.unit_in_metres;
    if placement.z_up {
        // (x, y, z) to (x, z, -y).
        [s, 0.0, 0.0, 0.0, 0.0, 0.0, -s, 0.0, 0.0, s, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    } else {
        [s, 0.0, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, 0.0, 1.0]
    }
}

/// A unit normal for each vertex, as glTF demands; where there is none, any.
fn unit_normals(view: &MeshView<'_>) -> Vec<Vec3> {
    let any = Vec3::new(0.0, 0.0, 1.0);
    let given: Option<Vec<Option<Vec3>>> =
        view.normals.map(|normals| normals.iter().map(|n| n.normalized()).collect());
    if let Some(given) = &given {
        if given.iter().all(Option::is_some) {
            return given.iter().map(|n| n.unwrap_or(any)).collect();
        }
    }
    let mut sums = vec![Vec3::ZERO; view.points.len()];
    for triangle in triangles::of_faces(view.points, view.faces) {
        let weighted = triangles::normal(view.points, triangle);
        for v in triangle {
            sums[v as usize] += weighted;
        }
    }
    let smooth = sums.into_iter().map(|sum| sum.normalized().unwrap_or(any));
    match given {
        Some(given) => given.into_iter().zip(smooth).map(|(given, smooth)| given.unwrap_or(smooth)).collect(),
        None => smooth.collect(),
    }
}

fn single(v: Vec3) -> [f32; 3] {
    <[f64; 3]>::from(v).map(|x| x as f32)
}

fn write_vector(v: Vec3, out: &mut impl Write) -> io::Result<()> {
    for x in single(v) {
        out.write_all(&x.to_le_bytes())?;
    }
    Ok(())
}
