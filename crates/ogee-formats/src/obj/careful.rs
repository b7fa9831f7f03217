//! Reading vertices, texture coordinates and faces a word at a time, whatever is in them: each habit of the programs that
//! write OBJ, each fault with what is wrong.

use crate::builder::narrow_corners;
use crate::error::Fault;
use crate::text::{Tokens, integer, real, shown};

/// How much comes before a statement, which numbers count back from, and by which messages name things.
#[derive(Clone, Copy)]
pub(super) struct SoFar {
    pub(super) vertices: usize,
    pub(super) texture_coordinates: usize,
    pub(super) faces: usize,
}

/// The corners of one face.
#[derive(Default)]
pub(super) struct Corners {
    /// The vertices, counted from 0.
    pub(super) vertices: Vec<u32>,
    /// The texture coordinates, counted from 1; 0 where there is none.
    pub(super) texture: Vec<u32>,
    numbers: Vec<i64>,
}

/// Reads the coordinates of a vertex.
pub(super) fn vertex(tokens: Tokens<'_>, so_far: SoFar) -> Result<[f64; 3], Fault> {
    let what = || format!("vertex {}", so_far.vertices);
    let point = numbers::<3>(tokens, 3).map_err(|reason| reason.fault(&what()))?;
    if point.iter().all(|x| x.is_finite()) {
        Ok(point)
    } else {
        Err(Fault::new("not_finite", format!("{} has a coordinate that is no finite number", what())))
    }
}

/// Reads a texture coordinate.
pub(super) fn texture_coordinate(tokens: Tokens<'_>, so_far: SoFar) -> Result<[f64; 2], Fault> {
    let what = || format!("texture coordinate {}", so_far.texture_coordinates);
    let value = numbers::<2>(tokens, 1).map_err(|reason| reason.fault(&what()))?;
    if value.iter().all(|x| x.is_finite()) {
        Ok(value)
    } else {
        Err(Fault::new("not_finite", format!("{} is no finite number", what())))
    }
}

/// Reads the corners of a face.
pub(super) fn face(tokens: Tokens<'_>, so_far: SoFar, corners: &mut Corners) -> Result<(), Fault> {
    let Corners { vertices, texture, numbers } = corners;
    vertices.clear();
    texture.clear();
    numbers.clear();
    for token in tokens {
        let (vertex, coordinate) = corner(token, so_far)?;
        numbers.push(vertex);
        texture.push(coordinate);
    }
    narrow_corners(so_far.faces, numbers, vertices)
}

/// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`: the vertex, counted from 0, and the texture coordinate, counted from 1, or 0.
fn corner(token: &[u8], so_far: SoFar) -> Result<(i64, u32), Fault> {
    let face = so_far.faces;
    let malformed = || {
        let message = format!("face {face} has a corner `{}`, not v, v/vt, v//vn or v/vt/vn", shown(token));
        Fault::new("bad_number", message)
    };
    let mut parts = token.split(|&b| b == b'/');
    let vertex = integer(parts.next().unwrap_or_default()).ok_or_else(malformed)?;
    let texture = match parts.next() {
        None | Some(b"") => None,
        Some(part) => Some(integer(part).ok_or_else(malformed)?),
    };
    if let Some(normal) = parts.next() {
        if !normal.is_empty() {
            integer(normal).ok_or_else(malformed)?;
        }
    }
    if parts.next().is_some() {
        return Err(malformed());
    }
    let vertex = from_zero(vertex, so_far.vertices)
        .map_err(|reason| Fault::new("missing_vertex", format!("face {face} {}", reason("vertex"))))?;
    let texture = match texture {
        None => 0,
        Some(number) => {
            let index = from_zero(number, so_far.texture_coordinates).map_err(|reason| {
                let message = format!("face {face} {}", reason("texture coordinate"));
                Fault::new("face_varying", message)
            })?;
            // One that cannot be numbered is missing from every file, and will be missed.
            u32::try_from(index + 1).unwrap_or(u32::MAX)
        }
    };
    Ok((vertex, texture))
}

/// A number of the file, which counts from 1 or back from the last, as one that counts from 0.
fn from_zero(number: i64, so_far: usize) -> Result<i64, impl Fn(&str) -> String> {
    let index = match number {
        1.. => number - 1,
        _ => number + so_far as i64,
    };
    if number != 0 && index >= 0 {
        return Ok(index);
    }
    Err(move |what: &str| match number {
        0 => format!("uses {what} number 0 of the file, which counts from 1"),
        _ => format!("uses {what} {number}, counted back from the last, but only {so_far} come before it"),
    })
}

/// Why a line of numbers could not be read.
enum NumberFault {
    Missing { found: usize, needed: usize },
    Malformed(String),
}

impl NumberFault {
    fn fault(self, what: &str) -> Fault {
        match self {
            NumberFault::Missing { found, needed } => {
                Fault::new("missing_number", format!("{what} has only {found} of {needed} coordinates"))
            }
            NumberFault::Malformed(token) => {
                Fault::new("bad_number", format!("{what} has a coordinate `{token}`, which is no number"))
            }
        }
    }
}

/// The first `N` numbers of a line, of which `needed` have to be there; the others are 0. What follows, a
/// weight or a colour, is no part of the shape.
fn numbers<const N: usize>(mut tokens: Tokens<'_>, needed: usize) -> Result<[f64; N], NumberFault> {
    let mut values = [0.0; N];
    for (found, value) in values.iter_mut().enumerate() {
        let Some(token) = tokens.next() else {
            if found < needed {
                return Err(NumberFault::Missing { found, needed });
            }
            break;
        };
        *value = real(token).ok_or_else(|| NumberFault::Malformed(shown(token)))?;
    }
    Ok(values)
}
