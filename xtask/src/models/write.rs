//! OBJ with subdivision tags: `f` counts from 1, `t` from 0.

use std::fmt::Write;

use ogee::Sharpness;

use super::{Form, Model};

/// What OBJ calls infinitely sharp.
const INFINITE: f64 = 10.0;

/// The text of a model's file.
pub(super) fn to_obj(model: &Model) -> String {
    let mesh = &model.mesh;
    let mut text = String::new();
    for line in model.about {
        text += &format!("# {line}\n");
    }
    text += &format!("# Millimetres, z up; {}.\n", counts(model));
    for p in &mesh.points {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for face in mesh.faces.iter() {
        text.push('f');
        for v in face {
            // Writing to a string cannot fail.
            let _ = write!(text, " {}", v + 1);
        }
        text.push('\n');
    }
    for crease in &mesh.creases {
        let [a, b] = crease.vertices;
        text += &format!("t crease 2/1/0 {a} {b} {}\n", value(crease.sharpness));
    }
    for corner in &mesh.corners {
        text += &format!("t corner 1/1/0 {} {}\n", corner.vertex, value(corner.sharpness));
    }
    text
}

/// The size of a model in words.
pub(super) fn counts(model: &Model) -> String {
    let mesh = &model.mesh;
    let form = match model.form {
        Form::Closed { pieces: 1, genus } => format!("closed, genus {genus}"),
        Form::Closed { pieces, genus } => format!("closed, {pieces} pieces, genus {genus} in all"),
        Form::Open => "open".to_owned(),
    };
    format!("{} vertices, {} faces, {form}", mesh.points.len(), mesh.faces.len())
}

fn value(sharpness: Sharpness) -> f64 {
    match sharpness {
        Sharpness::Finite(value) => value,
        Sharpness::Infinite => INFINITE,
    }
}
