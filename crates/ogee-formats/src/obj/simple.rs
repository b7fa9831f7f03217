//! Reading OBJ a second time for tests: one line after the other, a token at a time. What is not obvious about
//! [`super::read`], which is faster, is compared with this.

use ogee::{FaceVaryingRule, Vec3};

use super::tags;
use crate::builder::{CageBuilder, Texture};
use crate::cage::CageFile;
use crate::error::{Fault, ReadError};
use crate::text::{Lines, Tokens, check_is_text, integer, real, shown, without_mark};

/// Statements that change nothing of the shape.
const PASSED_OVER: [&[u8]; 17] = [
    b"vn",
    b"vp",
    b"o",
    b"g",
    b"s",
    b"mg",
    b"l",
    b"p",
    b"usemtl",
    b"mtllib",
    b"usemap",
    b"maplib",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"shadow_obj",
];

/// Statements of free-form curves and surfaces.
const FREE_FORM: [&[u8]; 17] = [
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"curv",
    b"curv2",
    b"surf",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
    b"ctech",
    b"stech",
    b"trace_obj",
];

/// How many different unknown statements are warned about.
const MOST_UNKNOWN: usize = 16;

/// Stands for a corner without texture coordinate until all are counted.
const NO_TEXTURE: u32 = u32::MAX;

/// Reads a cage.
pub(super) fn read(bytes: &[u8]) -> Result<CageFile, ReadError> {
    check_is_text(bytes, "OBJ")?;
    let mut reader = Reader::default();
    let mut lines = Lines::new(without_mark(bytes));
    let mut joined = Vec::new();
    while let Some((number, line)) = lines.next() {
        if is_continued(line) {
            join(line, &mut lines, &mut joined);
            reader.statement(number, Tokens::new(&joined));
        } else {
            reader.statement(number, Tokens::new(line));
        }
    }
    reader.finish()
}

/// True if the next line belongs to this one. A comment that ends with a folder's name does not go on.
fn is_continued(line: &[u8]) -> bool {
    line.trim_ascii_end().ends_with(b"\\") && !line.trim_ascii_start().starts_with(b"#")
}

/// Puts a line and those that continue it into `joined`.
fn join(first: &[u8], lines: &mut Lines<'_>, joined: &mut Vec<u8>) {
    joined.clear();
    let mut line = first;
    loop {
        let text = line.trim_ascii_end();
        match text.strip_suffix(b"\\") {
            Some(text) => joined.extend_from_slice(text),
            None => {
                joined.extend_from_slice(text);
                return;
            }
        }
        joined.push(b' ');
        match lines.next() {
            Some((_, next)) => line = next,
            None => return,
        }
    }
}

/// What has been read so far.
#[derive(Default)]
struct Reader {
    cage: CageBuilder,
    texture: Vec<[f64; 2]>,
    /// One entry per face corner.
    texture_indices: Vec<u32>,
    textured_corners: usize,
    /// The line of the first face that has a corner without texture coordinate.
    first_untextured: Option<u32>,
    rule: FaceVaryingRule,
    has_free_form: bool,
    /// The keywords warned about, with the lines where they stood first.
    unknown: Vec<(u32, Vec<u8>)>,
    vertices_of_face: Vec<i64>,
    texture_of_face: Vec<u32>,
}

impl Reader {
    fn statement(&mut self, line: u32, mut tokens: Tokens<'_>) {
        let Some(keyword) = tokens.next() else { return };
        match keyword {
            b"v" => self.vertex(line, tokens),
            b"vt" => self.texture_coordinate(line, tokens),
            b"f" | b"fo" => self.face(line, tokens),
            b"t" => tags::read(&mut self.cage, &mut self.rule, line, tokens),
            _ if PASSED_OVER.contains(&keyword) => {}
            _ if FREE_FORM.contains(&keyword) => {
                if !self.has_free_form {
                    let message = "free-form curves and surfaces are not read".to_string();
                    self.cage.warn(line, "free_form", message);
                }
                self.has_free_form = true;
            }
            _ => self.unknown_statement(line, keyword),
        }
    }

    fn unknown_statement(&mut self, line: u32, keyword: &[u8]) {
        let is_known = self.unknown.iter().any(|(_, known)| known == keyword);
        if !is_known && self.unknown.len() < MOST_UNKNOWN {
            let message = format!("`{}` is no statement of OBJ and was passed over", shown(keyword));
            self.cage.warn(line, "unknown_statement", message);
            self.unknown.push((line, keyword.to_vec()));
        }
    }

    fn vertex(&mut self, line: u32, tokens: Tokens<'_>) {
        let vertex = self.cage.points.len();
        match numbers::<3>(tokens, 3) {
            Ok(point) => self.cage.vertex(Some(line), Vec3::from(point)),
            Err(reason) => {
                self.cage.broken_vertex(reason.fault(&format!("vertex {vertex}")).on_line(line));
            }
        }
    }

    fn texture_coordinate(&mut self, line: u32, tokens: Tokens<'_>) {
        let what = || format!("texture coordinate {}", self.texture.len());
        match numbers::<2>(tokens, 1) {
            Ok(value) if value.iter().all(|x| x.is_finite()) => self.texture.push(value),
            Ok(_) => {
                let message = format!("{} is no finite number", what());
                self.cage.faults.push(Fault::new("not_finite", message).on_line(line));
                self.texture.push([0.0; 2]);
            }
            Err(reason) => {
                self.cage.faults.push(reason.fault(&what()).on_line(line));
                self.texture.push([0.0; 2]);
            }
        }
    }

    fn face(&mut self, line: u32, tokens: Tokens<'_>) {
        self.vertices_of_face.clear();
        self.texture_of_face.clear();
        for token in tokens {
            if let Err(fault) = self.face_corner(token) {
                self.cage.broken_face(Some(line), fault);
                return;
            }
        }
        if !self.cage.face(Some(line), &self.vertices_of_face) {
            return;
        }
        let textured = self.texture_of_face.iter().filter(|&&i| i != NO_TEXTURE).count();
        if textured < self.texture_of_face.len() {
            self.first_untextured.get_or_insert(line);
        }
        self.textured_corners += textured;
        self.texture_indices.extend_from_slice(&self.texture_of_face);
    }

    /// Reads `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn face_corner(&mut self, token: &[u8]) -> Result<(), Fault> {
        let face = self.cage.faces.len();
        let malformed = || {
            let message =
                format!("face {face} has a corner `{}`, not v, v/vt, v//vn or v/vt/vn", shown(token));
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
        let vertex = from_zero(vertex, self.cage.points.len())
            .map_err(|reason| Fault::new("missing_vertex", format!("face {face} {}", reason("vertex"))))?;
        let texture = match texture {
            None => NO_TEXTURE,
            Some(number) => from_zero(number, self.texture.len())
                .map(|index| u32::try_from(index).unwrap_or(u32::MAX).min(NO_TEXTURE - 1))
                .map_err(|reason| {
                    let message = format!("face {face} {}", reason("texture coordinate"));
                    Fault::new("face_varying", message)
                })?,
        };
        self.vertices_of_face.push(vertex);
        self.texture_of_face.push(texture);
        Ok(())
    }

    fn finish(mut self) -> Result<CageFile, ReadError> {
        if let (true, Some((line, keyword))) = (self.cage.faces.is_empty(), self.unknown.first()) {
            // Most likely no OBJ at all.
            let message = format!(
                "the file has no faces, and `{}` on line {line} is no statement of OBJ",
                shown(keyword)
            );
            self.cage.faults.push(Fault::new("no_faces", message));
        }
        if self.textured_corners > 0 {
            match self.first_untextured {
                None => self.cage.texture(Texture {
                    values: self.texture,
                    indices: self.texture_indices,
                    rule: self.rule,
                }),
                Some(line) => {
                    let message = "this face has corners without texture coordinate, others have them; \
                                   all texture coordinates were passed over";
                    self.cage.warn(line, "partial_texture", message.to_string());
                }
            }
        }
        self.cage.finish()
    }
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
