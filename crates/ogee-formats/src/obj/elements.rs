//! Reading a piece of a file: vertices, texture coordinates and faces into room that was set aside for them.

use std::borrow::Cow;

use ogee::Place;

use super::careful::{self, Corners, SoFar};
use super::quick;
use super::statements::{Kind, Statements};
use super::survey::Counts;
use crate::error::{Fault, Faults};
use crate::text::Tokens;

/// Where what is read is written to. There is an entry for everything that [`super::survey`] counted.
pub(super) struct Room<'a> {
    pub(super) points: &'a mut [[f64; 3]],
    pub(super) texture_coordinates: &'a mut [[f64; 2]],
    /// For each face, the line.
    pub(super) face_lines: &'a mut [u32],
    /// For each face, how many corners it and the faces of this piece before it have.
    pub(super) ends: &'a mut [u32],
    /// For each corner, its vertex. There may be too many.
    pub(super) vertices: &'a mut [u32],
    /// For each corner, its texture coordinate, counted from 1; 0 where there is none.
    pub(super) texture: &'a mut [u32],
}

/// What was found beside elements.
#[derive(Default)]
pub(super) struct Found<'a> {
    /// How many corners there are.
    pub(super) corners: usize,
    /// How many of them have a texture coordinate.
    pub(super) textured: usize,
    /// The line of the first face that has a corner without texture coordinate.
    pub(super) first_untextured: Option<u32>,
    pub(super) faults: Faults,
    /// Other statements, each with its line.
    pub(super) others: Vec<(u32, Cow<'a, [u8]>)>,
}

/// Reads a piece of a file, before which there is so much.
pub(super) fn read<'a>(piece: &'a [u8], before: Counts, room: Room<'_>) -> Found<'a> {
    let mut reader = Reader { before, room, so_far: Counts::default(), found: Found::default() };
    let mut statements = Statements::new(piece);
    let mut corners = Corners::default();
    while !statements.rest().is_empty() {
        if let Some(length) = reader.quick(statements.rest(), statements.lines()) {
            statements.step(length);
        } else if let Some(statement) = statements.next() {
            reader.careful(statement.line, statement.text, &mut corners);
        }
    }
    reader.found
}

struct Reader<'a, 'r> {
    before: Counts,
    room: Room<'r>,
    /// What of this piece has been read; of lines and corners nothing is said here.
    so_far: Counts,
    found: Found<'a>,
}

impl<'a> Reader<'a, '_> {
    /// Reads the next line if that is easily done, and tells its length.
    #[inline]
    fn quick(&mut self, text: &[u8], line: usize) -> Option<usize> {
        match text {
            [b'v', b' ' | b'\t', ..] => {
                let (point, length) = quick::numbers(text, 1)?;
                self.vertex(point);
                Some(length)
            }
            [b'f', b' ' | b'\t', ..] => {
                let start = self.found.corners;
                let (vertices, texture) = (&mut self.room.vertices[start..], &mut self.room.texture[start..]);
                let face = quick::face(text, vertices, texture)?;
                self.face(line, face.corners, face.textured);
                Some(face.length)
            }
            [b'v', b't', b' ' | b'\t', ..] => {
                let (value, length) = quick::numbers(text, 2)?;
                self.texture_coordinate(value);
                Some(length)
            }
            _ => None,
        }
    }

    /// Reads any statement.
    fn careful(&mut self, line: usize, text: Cow<'a, [u8]>, corners: &mut Corners) {
        let mut tokens = Tokens::new(&text);
        tokens.next();
        let so_far = SoFar {
            vertices: self.before.vertices + self.so_far.vertices,
            texture_coordinates: self.before.texture_coordinates + self.so_far.texture_coordinates,
            faces: self.before.faces + self.so_far.faces,
        };
        match Kind::of(&text) {
            Kind::Vertex => {
                let point = careful::vertex(tokens, so_far)
                    .map_err(|fault| self.fault(line, fault.at(Place::Vertex(so_far.vertices as u32))));
                self.vertex(point.unwrap_or_default());
            }
            Kind::TextureCoordinate => {
                let value =
                    careful::texture_coordinate(tokens, so_far).map_err(|fault| self.fault(line, fault));
                self.texture_coordinate(value.unwrap_or_default());
            }
            Kind::Face => match careful::face(tokens, so_far, corners) {
                Ok(()) => {
                    let start = self.found.corners;
                    let range = start..start + corners.vertices.len();
                    self.room.vertices[range.clone()].copy_from_slice(&corners.vertices);
                    self.room.texture[range].copy_from_slice(&corners.texture);
                    let textured = corners.texture.iter().filter(|&&number| number != 0).count();
                    self.face(line, corners.vertices.len(), textured);
                }
                Err(fault) => {
                    self.fault(line, fault.at(Place::Face(so_far.faces as u32)));
                    self.face(line, 0, 0);
                }
            },
            Kind::Nothing => {}
            Kind::Other => self.found.others.push((self.line(line), text)),
        }
    }

    #[inline]
    fn vertex(&mut self, point: [f64; 3]) {
        self.room.points[self.so_far.vertices] = point;
        self.so_far.vertices += 1;
    }

    fn texture_coordinate(&mut self, value: [f64; 2]) {
        self.room.texture_coordinates[self.so_far.texture_coordinates] = value;
        self.so_far.texture_coordinates += 1;
    }

    /// Adds a face whose corners have been written; one without corners is faulty.
    #[inline]
    fn face(&mut self, line: usize, corners: usize, textured: usize) {
        let face = self.so_far.faces;
        self.so_far.faces += 1;
        self.found.corners += corners;
        self.found.textured += textured;
        self.room.ends[face] = self.found.corners as u32;
        let line = self.line(line);
        self.room.face_lines[face] = line;
        if textured < corners {
            self.found.first_untextured.get_or_insert(line);
        }
    }

    #[cold]
    fn fault(&mut self, line: usize, fault: Fault) {
        let line = self.line(line);
        self.found.faults.push(fault.on_line(line));
    }

    /// The number of a line in the file, from 1.
    #[inline]
    fn line(&self, line: usize) -> u32 {
        u32::try_from(self.before.lines + line + 1).unwrap_or(u32::MAX)
    }
}
