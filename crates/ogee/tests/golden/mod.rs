//! Reads the golden data under `testdata/`; fields as in the notes of `testdata/SOURCES.md`.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::{
    Boundary, ControlMesh, Corner, Crease, Creasing, FaceList, FaceVarying, FaceVaryingRule, Sharpness, Vec3,
};
use serde_json::Value;
use std::path::PathBuf;

/// All documents of a folder of `testdata/`, with their names.
pub fn documents(folder: &str) -> Vec<(String, Value)> {
    let mut root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    root.extend(["..", "..", "testdata", folder]);
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    assert!(!files.is_empty(), "no golden data in {folder}");
    files
        .into_iter()
        .map(|path| {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            (name, serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap())
        })
        .collect()
}

pub fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) if text == "inf" => f64::INFINITY,
        _ => value.as_f64().unwrap_or_else(|| panic!("a number, not {value}")),
    }
}

pub fn index(value: &Value) -> u32 {
    value.as_u64().unwrap() as u32
}

pub fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

pub fn point(value: &Value) -> Vec3 {
    Vec3::new(number(&value[0]), number(&value[1]), number(&value[2]))
}

pub fn points(value: &Value) -> Vec<Vec3> {
    list(value).iter().map(point).collect()
}

pub fn faces(value: &Value) -> FaceList {
    let mut faces = FaceList::new();
    for face in list(value) {
        faces.push(&list(face).iter().map(index).collect::<Vec<_>>());
    }
    faces
}

/// A cage as the golden data have it: `options` may be null.
pub fn cage(cage: &Value, options: &Value) -> ControlMesh {
    let mut mesh = ControlMesh::new(points(&cage["vertices"]), faces(&cage["faces"]));
    for crease in list(&cage["creases"]) {
        let [a, b] = [index(&crease["edge"][0]), index(&crease["edge"][1])];
        mesh.creases.push(Crease {
            vertices: [a, b],
            sharpness: Sharpness::from_value(number(&crease["sharpness"])),
        });
    }
    for edge in list(&cage["crease_edges"]) {
        mesh.creases
            .push(Crease { vertices: [index(&edge[0]), index(&edge[1])], sharpness: Sharpness::Infinite });
    }
    for corner in list(&cage["corners"]) {
        let sharpness = Sharpness::from_value(number(&corner["sharpness"]));
        mesh.corners.push(Corner { vertex: index(&corner["vertex"]), sharpness });
    }
    for vertex in list(&cage["corner_vertices"]) {
        mesh.corners.push(Corner { vertex: index(vertex), sharpness: Sharpness::Infinite });
    }
    mesh.scheme.boundary = match options["boundary"].as_str() {
        Some("edge-only") => Boundary::EdgeOnly,
        Some("none") => Boundary::None,
        _ => Boundary::EdgeAndCorner,
    };
    if options["creasing"].as_str() == Some("chaikin") {
        mesh.scheme.creasing = Creasing::Chaikin;
    }
    if !cage["uvs"].is_null() {
        let values = list(&cage["uvs"]).iter().map(|uv| [number(&uv[0]), number(&uv[1])]).collect();
        let indices = list(&cage["face_uvs"]).iter().flat_map(|face| list(face).iter().map(index)).collect();
        let rule = match options["face_varying"].as_str() {
            Some("none") => FaceVaryingRule::None,
            Some("corners-only") => FaceVaryingRule::CornersOnly,
            Some("corners-plus2") => FaceVaryingRule::CornersPlus2,
            Some("boundaries") => FaceVaryingRule::Boundaries,
            Some("all") => FaceVaryingRule::All,
            _ => FaceVaryingRule::CornersPlus1,
        };
        mesh.uv = Some(FaceVarying { values, indices, rule });
    }
    mesh
}
