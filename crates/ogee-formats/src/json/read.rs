//! Reading the cage in JSON: raw values through the gate, every fault with its place.

use ogee::{LensShape, Place, Vec3};
use serde_json::error::Category;

use super::names::{BOUNDARIES, CREASINGS, FACE_VARYING_RULES, rule};
use super::parse::RawCage;
use crate::builder::{CageBuilder, Tag, Texture};
use crate::cage::CageFile;
use crate::error::{Fault, ReadError};
use crate::text::{check_is_text, without_mark};

/// Reads a cage.
///
/// # Errors
/// If the bytes are no JSON or a key has a value of the wrong kind, with line and column; else with every fault
/// of the values.
pub fn read(bytes: &[u8]) -> Result<CageFile, ReadError> {
    check_is_text(bytes, "JSON")?;
    let mut raw: RawCage =
        serde_json::from_slice(without_mark(bytes)).map_err(|error| ReadError::single(syntax(&error)))?;
    let mut cage = CageBuilder::default();
    for key in std::mem::take(&mut raw.unknown) {
        let key = key.escape_debug().to_string();
        cage.warn(None, "unknown_key", format!("unknown key \"{key}\", passed over"));
    }
    let missing = [("vertices", raw.vertices.is_none()), ("faces", raw.faces.is_none())];
    for (key, _) in missing.iter().filter(|(_, is_missing)| *is_missing) {
        cage.faults.push(Fault::new("missing_key", format!("the cage has no key \"{key}\"")));
    }
    if missing.iter().any(|&(_, is_missing)| is_missing) {
        // Without its vertices every face is faulty, which says nothing new.
        return cage.finish();
    }
    vertices_and_faces(&mut cage, &raw);
    tags(&mut cage, &raw);
    texture(&mut cage, &raw);
    cage.finish()
}

/// The complaint of the JSON parser, with its line.
pub(crate) fn syntax(error: &serde_json::Error) -> Fault {
    let whole = error.to_string();
    let suffix = format!(" at line {} column {}", error.line(), error.column());
    let message = format!("column {}: {}", error.column(), whole.strip_suffix(&suffix).unwrap_or(&whole));
    let code = if error.classify() == Category::Data { "wrong_value" } else { "bad_json" };
    Fault::new(code, message).on_line(u32::try_from(error.line()).ok())
}

fn vertices_and_faces(cage: &mut CageBuilder, raw: &RawCage) {
    for (v, point) in raw.vertices.iter().flatten().enumerate() {
        if point.count == 3 {
            cage.vertex(None, Vec3::from(point.values));
        } else {
            let message = format!("vertex {v} has {} coordinates, not 3", point.count);
            cage.broken_vertex(Fault::new("wrong_length", message));
        }
    }
    for corners in raw.faces.iter().flatten() {
        cage.face(None, corners);
    }
}

fn tags(cage: &mut CageBuilder, raw: &RawCage) {
    for crease in raw.creases.iter().flatten() {
        cage.tag(None, Tag::Crease { ends: crease.vertices, sharpness: crease.sharpness.0 });
    }
    for corner in raw.corners.iter().flatten() {
        cage.tag(None, Tag::Corner { vertex: corner.vertex, sharpness: corner.sharpness.0 });
    }
    for &face in raw.holes.iter().flatten() {
        cage.tag(None, Tag::Hole { face });
    }
    for meeting in raw.meetings.iter().flatten() {
        let ports = meeting.ports.clone();
        cage.tag(None, Tag::Meeting { vertex: meeting.vertex, ports, t: meeting.t });
    }
    if let Some(boundary) = known(cage, "boundary", &raw.boundary, &BOUNDARIES) {
        cage.scheme.boundary = boundary;
    }
    if let Some(creasing) = known(cage, "creasing", &raw.creasing, &CREASINGS) {
        cage.scheme.creasing = creasing;
    }
    if let Some(lens) = &raw.lens {
        let usual = LensShape::default();
        let (beta, gamma) = (lens.beta.unwrap_or(usual.beta), lens.gamma.unwrap_or(usual.gamma));
        cage.scheme.lens = LensShape { beta, gamma };
    }
}

/// The rule that a key names, if there is the key and the rule.
fn known<T: Copy>(
    cage: &mut CageBuilder,
    key: &str,
    value: &Option<String>,
    names: &[(&str, T)],
) -> Option<T> {
    let value = value.as_deref()?;
    match rule(names, value) {
        Ok(rule) => Some(rule),
        Err(known) => {
            let value = value.escape_debug();
            let message = format!("\"{key}\" is \"{value}\", which is none of {known}");
            cage.faults.push(Fault::new("unknown_name", message));
            None
        }
    }
}

fn texture(cage: &mut CageBuilder, raw: &RawCage) {
    let rule = known(cage, "face_varying", &raw.face_varying, &FACE_VARYING_RULES).unwrap_or_default();
    let (uvs, face_uvs) = match (&raw.uvs, &raw.face_uvs) {
        (Some(uvs), Some(face_uvs)) => (uvs, face_uvs),
        (None, None) => return,
        (Some(_), None) => {
            cage.faults.push(Fault::new("missing_key", "\"uvs\" without \"face_uvs\""));
            return;
        }
        (None, Some(_)) => {
            cage.faults.push(Fault::new("missing_key", "\"face_uvs\" without \"uvs\""));
            return;
        }
    };
    for (i, _) in uvs.iter().enumerate().filter(|(_, value)| value.count != 2) {
        let message = format!("texture coordinate {i} has {} coordinates, not 2", uvs[i].count);
        cage.faults.push(Fault::new("wrong_length", message));
    }
    let faces = raw.faces.as_deref().unwrap_or_default();
    if face_uvs.len() != faces.len() {
        let message = format!("\"face_uvs\" has {} faces, \"faces\" has {}", face_uvs.len(), faces.len());
        cage.faults.push(Fault::new("face_varying", message));
        return;
    }
    let mut indices = Vec::with_capacity(cage.faces.corners().len());
    for (f, (corners, uv_corners)) in faces.iter().zip(face_uvs).enumerate() {
        let wrong = |message: String| Fault::new("face_varying", message).at(Place::Face(f as u32));
        if corners.len() != uv_corners.len() {
            let (found, needed) = (uv_corners.len(), corners.len());
            let message = format!("face {f} has {found} texture coordinates for {needed} corners");
            cage.faults.push(wrong(message));
        }
        for &index in uv_corners {
            indices.push(u32::try_from(index).unwrap_or_else(|_| {
                cage.faults.push(wrong(format!("face {f} uses texture coordinate {index}")));
                0
            }));
        }
    }
    // Only then do the indices belong to the corners of the faces.
    if cage.faults.is_empty() {
        cage.texture(Texture { values: uvs.iter().map(|value| value.values).collect(), indices, rule });
    }
}
