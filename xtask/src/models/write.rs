//! A model as the text of its file.

use anyhow::{Context, Result};

use ogee::ControlMesh;

use super::{Form, Model, NetworkModel};

/// The text of a model's file: what it is for, its size, and the cage.
pub(super) fn to_obj(model: &Model) -> Result<String> {
    let about =
        format!("{}\nMillimetres, z up; {}.", model.about.join("\n"), counts(&model.mesh, &model.form));
    let mut text = Vec::new();
    ogee_formats::obj::write_cage(&model.mesh, &about, &mut text)?;
    String::from_utf8(text).context("OBJ is plain text")
}

/// The text of the file of a model with curves.
pub(super) fn to_json(model: &NetworkModel) -> Result<String> {
    let mut text = Vec::new();
    ogee_formats::network::write_json(&model.mesh, &model.network, &mut text)?;
    String::from_utf8(text).context("JSON is plain text")
}

/// The size of a model in words.
pub(super) fn counts(mesh: &ControlMesh, form: &Form) -> String {
    let form = match *form {
        Form::Closed { pieces: 1, genus } => format!("closed, genus {genus}"),
        Form::Closed { pieces, genus } => format!("closed, {pieces} pieces, genus {genus} in all"),
        Form::Open => "open".to_owned(),
    };
    format!("{} vertices, {} faces, {form}", mesh.points.len(), mesh.faces.len())
}
