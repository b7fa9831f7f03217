//! OFF, the format of Geomview: a header with counts, a line per vertex, a line per face.
//!
//! Headers `OFF`, `COFF`, `NOFF`, `STOFF` and their combinations are read, or none at all. Normals, colours and
//! texture coordinates follow the coordinates on the line of their vertex, colours follow the corners of their
//! face: all are passed over.

use std::io::{self, Write};

use ogee::Vec3;

use crate::builder::CageBuilder;
use crate::cage::CageFile;
use crate::error::{Fault, ReadError};
use crate::mesh::MeshView;
use crate::number::Shortest;
use crate::text::{Lines, Tokens, check_is_text, integer, real, shown, without_mark};

/// The least a vertex or face takes in a file.
const LEAST_LINE: usize = 6;

/// Reads a cage.
///
/// # Errors
/// If the header or the counts are none; else with every fault of the lines.
pub fn read(bytes: &[u8]) -> Result<CageFile, ReadError> {
    check_is_text(bytes, "OFF")?;
    let mut lines = Lines::new(without_mark(bytes));
    let [vertices, faces] = header(&mut lines).map_err(ReadError::single)?;
    let mut cage = CageBuilder::default();
    cage.reserve(vertices, faces, bytes.len() / LEAST_LINE);
    if read_vertices(&mut cage, &mut lines, vertices) {
        read_faces(&mut cage, &mut lines, faces);
        if let Some((line, _)) = lines.next_filled() {
            let message =
                format!("more than {vertices} vertices and {faces} faces; the rest was passed over");
            cage.warn(line, "trailing_lines", message);
        }
    }
    cage.finish()
}

/// Reads the lines of the vertices; false if the file ends among them.
fn read_vertices(cage: &mut CageBuilder, lines: &mut Lines<'_>, count: usize) -> bool {
    for vertex in 0..count {
        let Some((line, tokens)) = lines.next_filled() else {
            cage.faults.push(truncated(count, "vertices", vertex, lines.number()));
            return false;
        };
        match coordinates(tokens) {
            Ok(point) => cage.vertex(Some(line), point),
            Err((code, reason)) => {
                cage.broken_vertex(Fault::new(code, format!("vertex {vertex} {reason}")).on_line(line));
            }
        }
    }
    true
}

fn read_faces(cage: &mut CageBuilder, lines: &mut Lines<'_>, count: usize) {
    let mut corners = Vec::new();
    for face in 0..count {
        let Some((line, tokens)) = lines.next_filled() else {
            cage.faults.push(truncated(count, "faces", face, lines.number()));
            return;
        };
        match face_corners(tokens, &mut corners) {
            Ok(()) => {
                cage.face(Some(line), &corners);
            }
            Err((code, reason)) => {
                cage.broken_face(Some(line), Fault::new(code, format!("face {face} {reason}")));
            }
        }
    }
}

fn truncated(promised: usize, what: &str, found: usize, line: u32) -> Fault {
    let message = format!("the header promises {promised} {what}, the file ends after {found}");
    Fault::new("truncated", message).on_line(line)
}

/// Reads the keyword and the counts, which may share a line.
fn header(lines: &mut Lines<'_>) -> Result<[usize; 2], Fault> {
    let no_counts = |line: u32| {
        let message = "the header has no counts of vertices, faces and edges";
        Fault::new("bad_header", message).on_line(line)
    };
    let (mut line, first) = lines.next_filled().ok_or_else(|| no_counts(lines.number()))?;
    let mut tokens = first.clone();
    let keyword = tokens.next().unwrap_or_default();
    if let Some(prefix) = keyword.strip_suffix(b"OFF") {
        if !is_prefix(prefix) {
            let message = format!("`{}` cages have other dimensions than three", shown(keyword));
            return Err(Fault::new("unsupported_header", message).on_line(line));
        }
    } else if integer(keyword).is_some() {
        tokens = first;
    } else {
        let message = format!("an OFF file begins with OFF, this one with `{}`", shown(keyword));
        return Err(Fault::new("bad_header", message).on_line(line));
    }
    if tokens.clone().next() == Some(b"BINARY") {
        return Err(Fault::new("unsupported_header", "binary OFF is not read").on_line(line));
    }
    if tokens.clone().next().is_none() {
        (line, tokens) = lines.next_filled().ok_or_else(|| no_counts(line))?;
    }
    // The number of edges is often wrong or left out, and nothing needs it.
    let mut count = || tokens.next().and_then(integer).and_then(|count| usize::try_from(count).ok());
    match (count(), count()) {
        (Some(vertices), Some(faces)) => Ok([vertices, faces]),
        _ => Err(no_counts(line)),
    }
}

/// True for `ST`, `C` and `N`, each at most once and in this order.
fn is_prefix(prefix: &[u8]) -> bool {
    let rest = prefix.strip_prefix(b"ST").unwrap_or(prefix);
    let rest = rest.strip_prefix(b"C").unwrap_or(rest);
    rest.strip_prefix(b"N").unwrap_or(rest).is_empty()
}

/// A code and what is wrong, to follow the name of the element.
type Reason = (&'static str, String);

fn coordinates(mut tokens: Tokens<'_>) -> Result<Vec3, Reason> {
    let mut point = [0.0; 3];
    for (found, coordinate) in point.iter_mut().enumerate() {
        let token =
            tokens.next().ok_or_else(|| ("missing_number", format!("has only {found} of 3 coordinates")))?;
        *coordinate = real(token).ok_or_else(|| {
            ("bad_number", format!("has a coordinate `{}`, which is no number", shown(token)))
        })?;
    }
    Ok(Vec3::from(point))
}

fn face_corners(mut tokens: Tokens<'_>, corners: &mut Vec<i64>) -> Result<(), Reason> {
    corners.clear();
    let first = tokens.next().unwrap_or_default();
    let count = integer(first).filter(|&count| count >= 0);
    let count = count
        .ok_or_else(|| ("bad_number", format!("begins with `{}`, not a number of corners", shown(first))))?;
    for found in 0..count {
        let token = tokens
            .next()
            .ok_or_else(|| ("missing_number", format!("promises {count} corners and has {found}")))?;
        corners.push(
            integer(token).ok_or_else(|| {
                ("bad_number", format!("has a corner `{}`, no vertex number", shown(token)))
            })?,
        );
    }
    Ok(())
}

/// Writes a mesh; normals and texture coordinates are left out.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    write_header(view.points.len(), view.faces.len(), out)?;
    for &p in view.points {
        write_point(p, out)?;
    }
    view.faces.iter().try_for_each(|face| write_face(face, out))
}

pub(crate) fn write_header(vertices: usize, faces: usize, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "OFF\n{vertices} {faces} 0")
}

pub(crate) fn write_point(p: Vec3, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))
}

pub(crate) fn write_face(face: &[u32], out: &mut impl Write) -> io::Result<()> {
    write!(out, "{}", face.len())?;
    face.iter().try_for_each(|v| write!(out, " {v}"))?;
    writeln!(out)
}
