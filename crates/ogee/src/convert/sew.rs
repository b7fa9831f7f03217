//! Sewing: faces with their outlines to shells whose faces share edges and vertices.
//!
//! Vertices of the part are the vertices at which some face has a corner; a side with such a vertex in its middle (a T)
//! is split there, its surface stays whole.

use super::outline::{Course, Face, SIDES, Seams};
use crate::math::Vec3;
use crate::nurbs::{EdgeUse, NurbsCurve, NurbsSurface, Shell, ShellEdge, ShellFace, Side};

/// A piece of a side of a face between two vertices of the part, in the direction of the loop.
struct Segment {
    side: Side,
    courses: Vec<Course>,
    /// The surface's parameter at its ends.
    range: [f64; 2],
}

/// Sews faces into connected shells, in the order of their first faces.
pub(super) fn sew(seams: &Seams<'_>, mut faces: Vec<Face>) -> Vec<Shell> {
    let corners = place_corners(seams, &mut faces);
    let segments: Vec<Vec<Segment>> = faces.iter().map(|face| segments(face, &corners)).collect();
    let mut sewn = Sewn {
        seams,
        faces: &faces,
        segments: &segments,
        sides: course_sides(seams, &segments),
        corners: &corners,
        edge_of: vec![None; seams.course_count()],
        edges: Vec::new(),
    };
    let mut loops = Vec::with_capacity(faces.len());
    for (number, sides) in segments.iter().enumerate() {
        loops.push(sides.iter().map(|segment| sewn.use_edge(number, segment)).collect::<Vec<_>>());
    }
    let edges = sewn.edges;
    for (face, boundary) in faces.iter_mut().zip(&loops) {
        adopt_edges(&mut face.surface, boundary, &edges);
    }
    let faces = faces.into_iter().zip(loops).map(|(face, boundary)| ShellFace {
        quads: face.pieces,
        surface: face.surface,
        boundary,
    });
    split_shells(faces.collect(), edges, &corners)
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
            let (Some(first), Some(last)) = (face.sides[number].first(), face.sides[number].last()) else {
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

fn segments(face: &Face, corners: &[Option<Vec3>]) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (side, steps) in SIDES.into_iter().zip(&face.sides) {
        let mut courses = Vec::new();
        let mut start = None;
        for step in steps {
            let from = *start.get_or_insert(step.range[0]);
            courses.push(step.course);
            if corners[step.course.to as usize].is_some() {
                segments.push(Segment {
                    side,
                    courses: std::mem::take(&mut courses),
                    range: [from, step.range[1]],
                });
                start = None;
            }
        }
    }
    segments
}

/// By course and direction: the face on that side, and the segment that begins with the course.
fn course_sides(seams: &Seams<'_>, segments: &[Vec<Segment>]) -> Vec<CourseSide> {
    let mut sides = vec![CourseSide::Bare; 2 * seams.course_count()];
    for (face, own) in segments.iter().enumerate() {
        for (number, segment) in own.iter().enumerate() {
            for course in &segment.courses {
                sides[course.side()] = CourseSide::Used;
            }
            sides[segment.courses[0].side()] = CourseSide::Begins { face, number };
        }
    }
    sides
}

/// What lies to the left of a course.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CourseSide {
    /// No face.
    Bare,
    /// A face.
    Used,
    /// A face, one of whose segments begins here.
    Begins { face: usize, number: usize },
}

struct Sewn<'a> {
    seams: &'a Seams<'a>,
    faces: &'a [Face],
    segments: &'a [Vec<Segment>],
    sides: Vec<CourseSide>,
    corners: &'a [Option<Vec3>],
    /// By course: the shell edge it belongs to, once made, and whether that runs along the course's own direction.
    edge_of: Vec<Option<(u32, bool)>>,
    /// Ends are vertices of the sewing until the shells are split.
    edges: Vec<ShellEdge>,
}

impl Sewn<'_> {
    fn use_edge(&mut self, face: usize, segment: &Segment) -> EdgeUse {
        let first = segment.courses[0];
        let (edge, along) = match self.edge_of[first.key as usize] {
            Some(found) => found,
            None => {
                let edge = self.make_edge(face, segment);
                let number = self.edges.len() as u32;
                self.edges.push(edge);
                for course in &segment.courses {
                    self.edge_of[course.key as usize] = Some((number, course.forward));
                }
                (number, first.forward)
            }
        };
        EdgeUse { edge, forward: along == first.forward, side: segment.side, range: segment.range }
    }

    /// The edge of a segment, running as its loop does; its curve comes from whichever side has fewer coefficients on it.
    fn make_edge(&self, face: usize, segment: &Segment) -> ShellEdge {
        let (first, last) = (segment.courses[0], segment.courses[segment.courses.len() - 1]);
        let mut curve = segment.curve(&self.faces[face].surface);
        if let CourseSide::Begins { face: other, number } = self.sides[last.reversed().side()] {
            let candidate = self.segments[other][number].curve(&self.faces[other].surface);
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
        let is_smooth = |course: &Course| {
            self.sides[course.reversed().side()] != CourseSide::Bare && self.seams.is_smooth(course.key)
        };
        ShellEdge { start: first.from, end: last.to, curve, smooth: segment.courses.iter().all(is_smooth) }
    }
}

impl Segment {
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
        let curve = if along_growing { edge.clone() } else { edge.reversed() };
        let knots = surface.side(used.side).knots;
        // A piece of a side may have the knots of the whole: its curve can be that of the face beyond.
        let [low, high] = knots.domain();
        let is_whole = used.range == [low, high] || used.range == [high, low];
        if !is_whole || curve.knots != knots {
            continue;
        }
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
    let groups = connected_faces(&faces, edges.len());
    let mut faces: Vec<Option<ShellFace>> = faces.into_iter().map(Some).collect();
    let mut edges: Vec<Option<ShellEdge>> = edges.into_iter().map(Some).collect();
    let mut edge_ids = vec![0; edges.len()];
    // By vertex: the shell that met it last, and its number there. Two shells may touch in a vertex.
    let mut vertex_ids = vec![(usize::MAX, 0); corners.len()];
    let shells = groups.into_iter().enumerate().map(|(number, group)| {
        let mut shell = Shell::default();
        for mut face in group.into_iter().filter_map(|face| faces[face].take()) {
            for used in &mut face.boundary {
                if let Some(mut edge) = edges[used.edge as usize].take() {
                    edge_ids[used.edge as usize] = shell.edges.len() as u32;
                    for end in [&mut edge.start, &mut edge.end] {
                        let (met_by, id) = &mut vertex_ids[*end as usize];
                        if *met_by != number {
                            (*met_by, *id) = (number, shell.vertices.len() as u32);
                            shell.vertices.extend(corners[*end as usize]);
                        }
                        *end = *id;
                    }
                    shell.edges.push(edge);
                }
                used.edge = edge_ids[used.edge as usize];
            }
            shell.faces.push(face);
        }
        shell
    });
    shells.collect()
}

/// Faces by connected component, in the order of their first faces.
fn connected_faces(faces: &[ShellFace], edges: usize) -> Vec<Vec<usize>> {
    let mut users: Vec<Vec<usize>> = vec![Vec::new(); edges];
    for (number, face) in faces.iter().enumerate() {
        for used in &face.boundary {
            users[used.edge as usize].push(number);
        }
    }
    let mut seen = vec![false; faces.len()];
    let mut groups = Vec::new();
    for start in 0..faces.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        let mut group = vec![start];
        let mut next = 0;
        while let Some(&face) = group.get(next) {
            next += 1;
            for used in &faces[face].boundary {
                for &other in &users[used.edge as usize] {
                    if !std::mem::replace(&mut seen[other], true) {
                        group.push(other);
                    }
                }
            }
        }
        group.sort_unstable();
        groups.push(group);
    }
    groups
}
