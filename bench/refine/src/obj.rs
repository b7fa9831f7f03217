//! Reading of OBJ: from a path to points and faces in memory, by ogee and by the crate `tobj`.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use ogee_formats::{CageFormat, read_cage};
use serde_json::{Value, json};
use tobj::LoadOptions;

use crate::measure::{self, Shape};

/// As the command reads a cage.
pub(crate) fn ours(file: &Path) -> Result<Value> {
    let (mesh, passes) = measure::passes(|mesh: &mut ogee::ControlMesh| {
        *mesh = read_cage(&std::fs::read(file)?, CageFormat::Obj)?.mesh;
        Ok(())
    })?;
    let shape = Shape {
        vertices: mesh.points.len(),
        faces: mesh.faces.len(),
        point: |v: usize| mesh.points[v].into(),
        quad: |f: usize| [0, 1, 2, 3].map(|k| mesh.faces.face(f)[k]),
    };
    answer(shape.refinement(&passes), file)
}

/// Polygons as they are, indices as they are, single precision, which is its default.
pub(crate) fn tobj(file: &Path) -> Result<Value> {
    let (models, passes) = measure::passes(|models: &mut Vec<tobj::Model>| {
        *models = tobj::load_obj(file, &LoadOptions::default())?.0;
        Ok(())
    })?;
    ensure!(models.len() == 1, "one object is expected");
    let mesh = &models.first().context("an object")?.mesh;
    ensure!(mesh.face_arities.iter().all(|&size| size == 4), "quads are expected");
    let shape = Shape {
        vertices: mesh.positions.len() / 3,
        faces: mesh.indices.len() / 4,
        point: |v: usize| [0, 1, 2].map(|k| f64::from(mesh.positions[3 * v + k])),
        quad: |f: usize| [0, 1, 2, 3].map(|k| mesh.indices[4 * f + k]),
    };
    answer(shape.refinement(&passes), file)
}

fn answer(mut answer: Value, file: &Path) -> Result<Value> {
    answer["file_bytes"] = json!(std::fs::metadata(file)?.len());
    Ok(answer)
}
