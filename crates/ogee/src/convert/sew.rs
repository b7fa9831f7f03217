//! Sewing: faces with their outlines to shells whose faces share edges and vertices.
//!
//! Vertices of the part are the vertices at which some face has a corner; a side with such a vertex in its middle (a T)
//! is split there, its surface stays whole.

use super::outline::{Course, Face, SIDES, Seams, Step};
use crate::math::Vec3;
use crate::nurbs::{EdgeUse, NurbsCurve, NurbsSurface, SharedKnots, Shell, ShellEdge, ShellFace, Side};

/// A piece of a side of a face between two vertices of the part, in the direction of the loop.
struct Segment {
    face: u32,
    side: Side,
    /// The first and the last of its courses.
    ends: [Course; 2],
    /// The surface's parameter at its ends.
    range: [f64; 2],
}

/// Sews faces into connected shells, in the order of their first faces.
pub(super) fn sew(seams: &Seams<'_>, mut faces: Vec<Face>) -> Vec<Shell> {
    let corners = place_corners(seams, &mut faces);
    let mut sewn = Sewn {
        seams,
        faces: &faces,
        segments: Vec::with_capacity(4 * faces.len()),
        sides: vec![CourseSide::Bare; 2 * seams.course_count()],
        corners: &corners,
        edge_of: vec![None; seams.course_count()],
        edges: Vec::new(),
        knots: SharedKnots::default(),
    };
    (0..faces.len() as u32).for_each(|face| sewn.divide(face));
    let boundaries = sewn.boundaries();
    let edges = sewn.edges;
    let faces = faces.into_iter().zip(boundaries).map(|(mut face, boundary)| {
        adopt_edges(&mut face.surface, &boundary, &edges);
        ShellFace { quads: face.pieces, surface: face.surface, boundary }
    });
    let faces = faces.collect();
    split_shells(faces, edges, &corners)
}

/// Net points along a side, in the direction of the loop.
fn side_points(surface: &NurbsSurface, side: Side) -> Vec<(usize, usize)> {
    let (rows, cols) = (surface.net.rows(), surface.net.cols());
    match side {
        Side::V0 => (0..rows).map(|i| (i, 0)).collect(),
        Side::U1 => (0..cols).map(|j| (rows - 1, j)).collect(),
        Side::V1 => (0..rows).rev().map(|i| (i, cols - 1)).collect(),
        Side::U0 => (0..cols).rev().map(|j| (0, j)).collect(),
    }
}

/// The position of every vertex that is a corner of some face. All surfaces get the same one, bit for bit.
fn place_corners(seams: &Seams<'_>, faces: &mut [Face]) -> Vec<Option<Vec3>> {
    let mut corners = seams.positions();
    for face in faces {
        for (number, side) in SIDES.into_iter().enumerate() {
            let points = side_points(&face.surface, side);
            let (Some(first), Some(last)) =
                (face.side(number).first().copied(), face.side(number).last().copied())
            else {
                // A pole is one point of the cap, bit for bit, and the cap says where it is.
                continue;
            };
            for (v, at) in [(first.course.from, points[0]), (last.course.to, points[points.len() - 1])] {
                face.surface.net[at] = *corners[v as usize].get_or_insert(face.surface.net[at]);
            }
        }
    }
    corners
}

/// What lies to the left of a course.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CourseSide {
    /// No face.
    Bare,
    /// A face.
    Used,
    /// A face, and its segment of this number begins here.
    Begins(u32),
}

struct Sewn<'a> {
    seams: &'a Seams<'a>,
    faces: &'a [Face],
    /// Of all faces, one after the other.
    segments: Vec<Segment>,
    /// By course and direction.
    sides: Vec<CourseSide>,
    corners: &'a [Option<Vec3>],
    /// By course: the shell edge it belongs to, once made, and whether that runs along the course's own direction.
    edge_of: Vec<Option<(u32, bool)>>,
    /// Ends are vertices of the sewing until the shells are split.
    edges: Vec<ShellEdge>,
    knots: SharedKnots,
}

impl Sewn<'_> {
    /// Divides the sides of a face at vertices of the part.
    fn divide(&mut self, face: u32) {
        for (number, side) in SIDES.into_iter().enumerate() {
            let mut start: Option<&Step> = None;
            for step in self.faces[face as usize].side(number) {
                self.sides[step.course.side()] = CourseSide::Used;
                let first = *start.get_or_insert(step);
                if self.corners[step.course.to as usize].is_some() {
                    self.sides[first.course.side()] = CourseSide::Begins(self.segments.len() as u32);
                    let ends = [first.course, step.course];
                    self.segments.push(Segment { face, side, ends, range: [first.range[0], step.range[1]] });
                    start = None;
                }
            }
        }
    }

    /// The loops of all faces; makes the edges that they use.
    fn boundaries(&mut self) -> Vec<Vec<EdgeUse>> {
        let mut boundaries = Vec::with_capacity(self.faces.len());
        let mut next = 0;
        for face in 0..self.faces.len() as u32 {
            let first = next;
            while self.segments.get(next).is_some_and(|segment| segment.face == face) {
                next += 1;
            }
            let mut boundary = Vec::with_capacity(next - first);
            boundary.extend((first..next).map(|number| self.use_edge(number)));
            boundaries.push(boundary);
        }
        boundaries
    }

    fn use_edge(&mut self, number: usize) -> EdgeUse {
        let Segment { side, ends: [first, _], range, .. } = self.segments[number];
        let (edge, along) = match self.edge_of[first.key as usize] {
            Some(found) => found,
            None => {
                let mut edge = self.make_edge(number);
                self.knots.share(&mut edge.curve.knots);
                let made = self.edges.len() as u32;
                self.edges.push(edge);
                for course in self.segments[number].courses(self.faces) {
                    self.edge_of[course.key as usize] = Some((made, course.forward));
                }
                (made, first.forward)
            }
        };
        EdgeUse { edge, forward: along == first.forward, side, range }
    }

    /// The edge of a segment, running as its loop does; its curve comes from whichever side has fewer coefficients on it.
    fn make_edge(&self, number: usize) -> ShellEdge {
        let segment = &self.segments[number];
        let [first, last] = segment.ends;
        let curve_of = |segment: &Segment| segment.curve(&self.faces[segment.face as usize].surface);
        let mut curve = curve_of(segment);
        if let CourseSide::Begins(other) = self.sides[last.reversed().side()] {
            let candidate = curve_of(&self.segments[other as usize]);
            if candidate.points.len() < curve.points.len() {
                curve = candidate.reversed();
            }
        }
        let count = curve.points.len();
        for (at, v) in [(0, first.from), (count - 1, last.to)] {
            if let Some(position) = self.corners[v as usize] {
                curve.points[at] = position;
            }
        }
        let is_smooth = |course: Course| {
            self.sides[course.reversed().side()] != CourseSide::Bare && self.seams.is_smooth(course.key)
        };
        ShellEdge {
            start: first.from,
            end: last.to,
            curve,
            smooth: segment.courses(self.faces).all(is_smooth),
        }
    }
}

impl Segment {
    /// All its courses.
    fn courses<'a>(&self, faces: &'a [Face]) -> impl Iterator<Item = Course> + use<'a> {
        let [first, last] = self.ends.map(Course::side);
        let number = SIDES.iter().position(|&side| side == self.side).unwrap_or(0);
        let courses = faces[self.face as usize].side(number).iter().map(|step| step.course);
        let courses = courses.skip_while(move |course| course.side() != first);
        let mut ended = false;
        courses.take_while(move |course| !std::mem::replace(&mut ended, course.side() == last))
    }

    /// The piece of the boundary curve, in the direction of the loop, from parameter 0 on.
    fn curve(&self, surface: &NurbsSurface) -> NurbsCurve {
        let row = surface.side(self.side);
        let [from, to] = self.range;
        if from < to {
            row.piece(from, to).shifted(-from)
        } else {
            row.piece(to, from).shifted(-to).reversed()
        }
    }
}

/// Where an edge is a whole side and has the same knots, the surface's row becomes the edge's curve, bit for bit:
/// computed on its own it agrees to rounding only.
fn adopt_edges(surface: &mut NurbsSurface, boundary: &[EdgeUse], edges: &[ShellEdge]) {
    for used in boundary {
        let along_growing = matches!(used.side, Side::V0 | Side::U1) == used.forward;
        let edge = &edges[used.edge as usize].curve;
        let knots = surface.along(used.side);
        // A piece of a side may have the knots of the whole: its curve can be that of the face beyond.
        let [low, high] = knots.domain();
        let is_whole = used.range == [low, high] || used.range == [high, low];
        let has_same_knots =
            if along_growing { edge.knots == *knots } else { edge.knots.reversed() == *knots };
        if !is_whole || !has_same_knots {
            continue;
        }
        let curve = if along_growing { edge.clone() } else { edge.reversed() };
        let mut points = side_points(surface, used.side);
        if matches!(used.side, Side::V1 | Side::U0) {
            points.reverse();
        }
        for (at, &point) in points.into_iter().zip(&curve.points) {
            surface.net[at] = point;
        }
    }
}

/// Splits faces into connected shells, and numbers vertices and edges within each.
fn split_shells(faces: Vec<ShellFace>, edges: Vec<ShellEdge>, corners: &[Option<Vec3>]) -> Vec<Shell> {
    let shell_of = shells_of_faces(&faces, edges.len());
    let mut shells: Vec<Shell> = Vec::new();
    let mut edges: Vec<Option<ShellEdge>> = edges.into_iter().map(Some).collect();
    let mut edge_ids = vec![0; edges.len()];
    let mut sizes: Vec<usize> = Vec::new();
    for &number in &shell_of {
        if number as usize == sizes.len() {
            sizes.push(0);
        }
        sizes[number as usize] += 1;
    }
    shells.extend(sizes.iter().map(|&size| Shell { faces: Vec::with_capacity(size), ..Shell::default() }));
    for (mut face, number) in faces.into_iter().zip(shell_of) {
        let shell = &mut shells[number as usize];
        for used in &mut face.boundary {
            if let Some(edge) = edges[used.edge as usize].take() {
                edge_ids[used.edge as usize] = shell.edges.len() as u32;
                shell.edges.push(edge);
            }
            used.edge = edge_ids[used.edge as usize];
        }
        shell.faces.push(face);
    }
    // By vertex: the shell that met it last, and its number there. Two shells may touch in a vertex.
    let mut vertex_ids = vec![(u32::MAX, 0); corners.len()];
    for (number, shell) in (0..).zip(&mut shells) {
        for edge in &mut shell.edges {
            for end in [&mut edge.start, &mut edge.end] {
                let (met_by, id) = &mut vertex_ids[*end as usize];
                if *met_by != number {
                    (*met_by, *id) = (number, shell.vertices.len() as u32);
                    shell.vertices.extend(corners[*end as usize]);
                }
                *end = *id;
            }
        }
    }
    shells
}

/// For each face the number of its connected shell, in the order of their first faces.
fn shells_of_faces(faces: &[ShellFace], edges: usize) -> Vec<u32> {
    const NOBODY: u32 = u32::MAX;
    // For each face one of smaller number that it is joined to, or itself.
    let mut parent: Vec<u32> = (0..faces.len() as u32).collect();
    let first = |parent: &mut Vec<u32>, mut face: u32| {
        while parent[face as usize] != face {
            // Half of the way is enough to make all ways short.
            parent[face as usize] = parent[parent[face as usize] as usize];
            face = parent[face as usize];
        }
        face
    };
    let mut users = vec![NOBODY; edges];
    for (number, face) in (0..).zip(faces) {
        for used in &face.boundary {
            let user = &mut users[used.edge as usize];
            if *user == NOBODY {
                *user = number;
                continue;
            }
            let (a, b) = (first(&mut parent, *user), first(&mut parent, number));
            parent[a.max(b) as usize] = a.min(b);
        }
    }
    let mut count = 0;
    for face in 0..parent.len() {
        let before = parent[face] as usize;
        // What is joined to a face of smaller number has that one's shell, which is known by now.
        parent[face] = if before == face { count } else { parent[before] };
        count += u32::from(before == face);
    }
    parent
}
