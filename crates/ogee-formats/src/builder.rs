//! `CageBuilder`: the one gate through which every reader passes what it reads.
//!
//! Faces and tags may name what comes later in a file, so ranges are judged when all is read. What is faulty
//! still takes its number: the vertices and faces after it keep theirs, and their faults are named rightly.

use std::collections::HashMap;

use ogee::{
    ControlMesh, Corner, Crease, FaceList, FaceVarying, FaceVaryingRule, Meeting, Place, Scheme, Sharpness,
    Vec3,
};

use crate::cage::CageFile;
use crate::error::{Fault, Faults, ReadError, Warning};

/// How many warnings are kept at most.
const MOST_WARNINGS: usize = 1000;

/// A cage in the making.
#[derive(Default)]
pub(crate) struct CageBuilder {
    pub(crate) points: Vec<Vec3>,
    pub(crate) faces: FaceList,
    pub(crate) scheme: Scheme,
    pub(crate) faults: Faults,
    face_lines: Vec<u32>,
    tags: Vec<(Option<u32>, Tag)>,
    texture: Option<Texture>,
    warnings: Vec<Warning>,
    /// The corners of the face at hand.
    corners: Vec<u32>,
}

/// A tag as the file gives it: numbers from 0, not yet known to exist.
pub(crate) enum Tag {
    Crease { ends: [i64; 2], sharpness: f64 },
    Corner { vertex: i64, sharpness: f64 },
    Hole { face: i64 },
    Meeting { vertex: i64, ports: Vec<i64>, t: f64 },
}

/// Texture coordinates and, for each corner of each face, which one it has.
pub(crate) struct Texture {
    pub(crate) values: Vec<[f64; 2]>,
    pub(crate) indices: Vec<u32>,
    pub(crate) rule: FaceVaryingRule,
}

impl CageBuilder {
    /// Room for as many vertices and faces as a file promises; promises are believed up to a limit, which the
    /// caller takes from the length of the file.
    pub(crate) fn reserve(&mut self, vertices: usize, faces: usize, limit: usize) {
        self.points.reserve(vertices.min(limit));
        self.faces = FaceList::with_capacity(faces.min(limit), faces.min(limit / 4).saturating_mul(4));
    }

    /// Adds a warning.
    pub(crate) fn warn(&mut self, line: impl Into<Option<u32>>, code: &'static str, message: String) {
        if self.warnings.len() < MOST_WARNINGS {
            self.warnings.push(Warning { line: line.into(), code, message });
        }
    }

    /// Adds a vertex.
    #[inline]
    pub(crate) fn vertex(&mut self, line: Option<u32>, point: Vec3) {
        if !point.is_finite() {
            let vertex = self.points.len() as u32;
            let message = format!("vertex {vertex} has a coordinate that is no finite number");
            self.faults.push(Fault::new("not_finite", message).on_line(line).at(Place::Vertex(vertex)));
        }
        self.points.push(point);
    }

    /// Adds a vertex that could not be read.
    pub(crate) fn broken_vertex(&mut self, fault: Fault) {
        self.faults.push(fault.at(Place::Vertex(self.points.len() as u32)));
        self.points.push(Vec3::ZERO);
    }

    /// Adds a face of vertices numbered from 0; true if it is sound by itself.
    pub(crate) fn face(&mut self, line: Option<u32>, corners: &[i64]) -> bool {
        match self.narrow_corners(corners) {
            Ok(()) => {
                self.faces.push(&self.corners);
                self.face_lines.extend(line);
                true
            }
            Err(fault) => {
                self.broken_face(line, fault);
                false
            }
        }
    }

    /// Adds a face that could not be read.
    pub(crate) fn broken_face(&mut self, line: Option<u32>, fault: Fault) {
        self.faults.push(fault.on_line(line).at(Place::Face(self.faces.len() as u32)));
        self.faces.push(&[]);
        self.face_lines.extend(line);
    }

    /// Takes the corners of a face, if nothing is wrong with it alone.
    fn narrow_corners(&mut self, corners: &[i64]) -> Result<(), Fault> {
        let face = self.faces.len();
        if corners.len() >= 3 && self.faces.corners().len() + corners.len() >= u32::MAX as usize {
            return Err(too_many_corners());
        }
        self.corners.clear();
        narrow_corners(face, corners, &mut self.corners)
    }

    /// Sets vertices, faces and the lines of faces, all that were found.
    pub(crate) fn elements(&mut self, points: Vec<Vec3>, faces: FaceList, face_lines: Vec<u32>) {
        self.points = points;
        self.faces = faces;
        self.face_lines = face_lines;
    }

    /// Adds a tag.
    pub(crate) fn tag(&mut self, line: Option<u32>, tag: Tag) {
        self.tags.push((line, tag));
    }

    /// Sets the texture coordinates.
    pub(crate) fn texture(&mut self, texture: Texture) {
        self.texture = Some(texture);
    }

    /// The cage, if nothing is wrong with it.
    pub(crate) fn finish(mut self) -> Result<CageFile, ReadError> {
        if self.faces.is_empty() && self.faults.is_empty() {
            self.faults.push(Fault::new("no_faces", "the file has no faces"));
        }
        if self.points.len() >= u32::MAX as usize {
            self.faults.push(Fault::new("too_many_elements", "the file has 2^32 vertices or more"));
        }
        self.check_vertices();
        let mut mesh = ControlMesh { scheme: self.scheme, ..ControlMesh::default() };
        self.resolve_tags(&mut mesh);
        mesh.uv = self.resolve_texture();
        self.faults.into_result()?;
        mesh.points = self.points;
        mesh.faces = self.faces;
        Ok(CageFile { mesh, face_lines: self.face_lines, warnings: self.warnings })
    }

    fn face_line(&self, face: usize) -> Option<u32> {
        self.face_lines.get(face).copied()
    }

    /// Every vertex a face uses is there.
    fn check_vertices(&mut self) {
        let count = self.points.len();
        if self.faces.corners().iter().all(|&v| (v as usize) < count) {
            return;
        }
        for (f, corners) in self.faces.iter().enumerate() {
            for &vertex in corners.iter().filter(|&&v| v as usize >= count) {
                let message = format!("face {f} uses vertex {vertex}, the file has {count}");
                let line = self.face_line(f);
                let fault = Fault::new("missing_vertex", message).on_line(line).at(Place::Face(f as u32));
                self.faults.push(fault);
            }
        }
    }

    fn resolve_tags(&mut self, mesh: &mut ControlMesh) {
        // With a broken face a crease may miss its edge through no fault of its own.
        let judge_edges = self.faults.is_empty();
        let mut crease_lines = Vec::new();
        for (line, tag) in std::mem::take(&mut self.tags) {
            match tag {
                Tag::Crease { ends, sharpness } => {
                    if let Some(crease) = self.crease(line, ends, sharpness) {
                        mesh.creases.push(crease);
                        crease_lines.push(line);
                    }
                }
                Tag::Corner { vertex, sharpness } => {
                    mesh.corners.extend(self.corner(line, vertex, sharpness));
                }
                Tag::Meeting { vertex, ports, t } => {
                    mesh.meetings.extend(self.meeting(line, vertex, &ports, t));
                }
                Tag::Hole { face } => match within(face, self.faces.len()) {
                    Some(face) => mesh.holes.push(face),
                    None => {
                        let message = format!("hole names face {face}, the file has {}", self.faces.len());
                        self.faults.push(Fault::new("hole_off_face", message).on_line(line));
                    }
                },
            }
        }
        if judge_edges {
            self.check_creases(&mesh.creases, &crease_lines);
        }
    }

    fn crease(&mut self, line: Option<u32>, ends: [i64; 2], sharpness: f64) -> Option<Crease> {
        let count = self.points.len();
        let [a, b] = ends;
        let (Some(first), Some(second)) = (within(a, count), within(b, count)) else {
            let missing = if within(a, count).is_none() { a } else { b };
            let message = format!("crease {a}-{b} uses vertex {missing}, the file has {count}");
            self.faults.push(Fault::new("crease_off_edge", message).on_line(line));
            return None;
        };
        let place = Place::Edge(first, second);
        let sharpness = self.sharpness(line, sharpness, || format!("crease {a}-{b}"), place)?;
        Some(Crease { vertices: [first, second], sharpness })
    }

    fn corner(&mut self, line: Option<u32>, vertex: i64, sharpness: f64) -> Option<Corner> {
        let count = self.points.len();
        let Some(known) = within(vertex, count) else {
            let message = format!("corner names vertex {vertex}, the file has {count}");
            self.faults.push(Fault::new("corner_off_vertex", message).on_line(line));
            return None;
        };
        let place = Place::Vertex(known);
        let sharpness = self.sharpness(line, sharpness, || format!("corner {vertex}"), place)?;
        Some(Corner { vertex: known, sharpness })
    }

    fn meeting(&mut self, line: Option<u32>, vertex: i64, ports: &[i64], t: f64) -> Option<Meeting> {
        let count = self.points.len();
        let missing = std::iter::once(&vertex).chain(ports).find(|&&v| within(v, count).is_none());
        if let Some(missing) = missing {
            let message = format!("meeting {vertex} names vertex {missing}, the file has {count}");
            self.faults.push(Fault::new("meeting_off_vertex", message).on_line(line));
            return None;
        }
        let ports = ports.iter().filter_map(|&port| within(port, count)).collect();
        Some(Meeting { vertex: within(vertex, count)?, ports, t })
    }

    fn sharpness(
        &mut self,
        line: Option<u32>,
        value: f64,
        what: impl Fn() -> String,
        place: Place,
    ) -> Option<Sharpness> {
        if value.is_nan() {
            let message = format!("the sharpness of {} is not a number", what());
            self.faults.push(Fault::new("sharpness_not_a_number", message).on_line(line).at(place));
            return None;
        }
        Some(Sharpness::from_value(value))
    }

    /// Every crease is an edge.
    fn check_creases(&mut self, creases: &[Crease], lines: &[Option<u32>]) {
        if creases.is_empty() {
            return;
        }
        let ordered = |[a, b]: [u32; 2]| (a.min(b), a.max(b));
        let mut found: HashMap<(u32, u32), bool> =
            creases.iter().map(|crease| (ordered(crease.vertices), false)).collect();
        let mut touched = vec![false; self.points.len()];
        for &(a, b) in found.keys() {
            touched[a as usize] = true;
            touched[b as usize] = true;
        }
        for corners in self.faces.iter() {
            for (k, &a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                if touched[a as usize] && touched[b as usize] {
                    if let Some(found) = found.get_mut(&ordered([a, b])) {
                        *found = true;
                    }
                }
            }
        }
        for (crease, &line) in creases.iter().zip(lines) {
            let [a, b] = crease.vertices;
            if !found[&ordered([a, b])] {
                let fault =
                    Fault::new("crease_off_edge", format!("crease {a}-{b} names no edge of the cage"));
                self.faults.push(fault.on_line(line).at(Place::Edge(a, b)));
            }
        }
    }

    /// Every texture coordinate a face uses is there and finite.
    fn resolve_texture(&mut self) -> Option<FaceVarying> {
        let texture = self.texture.take()?;
        let count = texture.values.len();
        if let Some(i) = texture.values.iter().position(|value| !value.iter().all(|x| x.is_finite())) {
            let message = format!("texture coordinate {i} is no finite number");
            self.faults.push(Fault::new("face_varying", message));
        }
        if texture.indices.iter().any(|&i| i as usize >= count) {
            for f in 0..self.faces.len() {
                let range = self.faces.starts()[f] as usize..self.faces.starts()[f + 1] as usize;
                for index in texture.indices[range].iter().filter(|&&i| i as usize >= count) {
                    let message = format!("face {f} uses texture coordinate {index}, the file has {count}");
                    let fault = Fault::new("face_varying", message).at(Place::Face(f as u32));
                    self.faults.push(fault.on_line(self.face_line(f)));
                }
            }
        }
        Some(FaceVarying { values: texture.values, indices: texture.indices, rule: texture.rule })
    }
}

/// The faces have more corners than can be numbered.
pub(crate) fn too_many_corners() -> Fault {
    Fault::new("too_many_elements", "the faces have 2^32 corners or more")
}

/// Adds the corners of face `face` to `narrow`, if nothing is wrong with it alone; else there may be some of them.
pub(crate) fn narrow_corners(face: usize, corners: &[i64], narrow: &mut Vec<u32>) -> Result<(), Fault> {
    if corners.len() < 3 {
        let message = format!("face {face} has {} corners, fewer than three", corners.len());
        return Err(Fault::new("face_too_small", message));
    }
    let start = narrow.len();
    for &vertex in corners {
        narrow.push(u32::try_from(vertex).map_err(|_| {
            let message = if vertex < 0 {
                format!("face {face} uses vertex {vertex}, the first has number 0")
            } else {
                format!("face {face} uses vertex {vertex}, a cage has fewer than 2^32")
            };
            Fault::new("missing_vertex", message)
        })?);
    }
    match repeated(&narrow[start..]) {
        Some(vertex) => {
            let message = format!("face {face} uses vertex {vertex} more than once");
            Err(Fault::new("repeated_vertex", message))
        }
        None => Ok(()),
    }
}

/// The number, if it is one of `0 .. count`.
fn within(number: i64, count: usize) -> Option<u32> {
    u32::try_from(number).ok().filter(|&number| (number as usize) < count)
}

/// A vertex that a face names twice.
#[inline]
pub(crate) fn repeated(corners: &[u32]) -> Option<u32> {
    // Sorting pays only where there are many.
    if corners.len() <= 8 {
        return (1..corners.len()).find(|&k| corners[..k].contains(&corners[k])).map(|k| corners[k]);
    }
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}
