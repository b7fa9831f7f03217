//! Sewing: charts to shells whose faces share edges and vertices.
//!
//! Vertices of the part are the base vertices at which some chart has a corner; a side with such a vertex in its
//! middle (a T) is split there, its surface stays whole.

use crate::math::{Grid, Vec3};
use crate::mesh::HalfedgeId;
use crate::nurbs::{EdgeUse, FaceAddress, NurbsCurve, NurbsSurface, Shell, ShellEdge, ShellFace, Side};
use crate::pccm::{Chart, Placed};
use crate::rules::Level;

const SIDES: [Side; 4] = [Side::V0, Side::U1, Side::V1, Side::U0];

/// A chart with its surface, one unit of knot per quad.
pub(super) struct Face {
    pub(super) chart: Chart,
    pub(super) surface: NurbsSurface,
}

/// A piece of a side of a chart between two vertices of the part, in the direction of the loop.
struct Segment {
    side: Side,
    /// The base halfedges along it.
    halfedges: Vec<HalfedgeId>,
    /// The surface's parameter at its ends.
    range: [f64; 2],
}

/// Sews faces into connected shells, in the order of their first faces. `broken` are base halfedges whose edge is not
/// smooth next to their origin; `address` names a quad of the base.
pub(super) fn sew(
    base: &Level,
    mut faces: Vec<Face>,
    broken: &[HalfedgeId],
    address: impl Fn(u32) -> FaceAddress,
) -> Vec<Shell> {
    let corners = place_corners(base, &mut faces);
    let segments: Vec<Vec<Segment>> =
        faces.iter().map(|face| segments(base, &face.chart, &corners)).collect();
    let mut sewn = Sewn {
        base,
        faces: &faces,
        segments: &segments,
        starts: segment_starts(base, &segments),
        corners: &corners,
        is_broken: halfedge_flags(base, broken),
        edge_of: vec![None; base.topology().edge_count()],
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
        quads: face.chart.quads.map(|placed| address(placed.quad)),
        surface: face.surface,
        boundary,
    });
    split_shells(faces.collect(), edges, &corners)
}

fn halfedge_flags(base: &Level, marked: &[HalfedgeId]) -> Vec<bool> {
    let mut flags = vec![false; base.topology().halfedge_count()];
    for h in marked {
        flags[h.index()] = true;
    }
    flags
}

/// The quads along a side of a chart, in the direction of the loop.
fn side_quads(quads: &Grid<Placed>, side: usize) -> Vec<Placed> {
    let (width, height) = (quads.rows(), quads.cols());
    match side {
        0 => (0..width).map(|i| quads[(i, 0)]).collect(),
        1 => (0..height).map(|j| quads[(width - 1, j)]).collect(),
        2 => (0..width).rev().map(|i| quads[(i, height - 1)]).collect(),
        _ => (0..height).rev().map(|j| quads[(0, j)]).collect(),
    }
}

/// The position of every base vertex that is a corner of some chart. All surfaces get the same one, bit for bit.
fn place_corners(base: &Level, faces: &mut [Face]) -> Vec<Option<Vec3>> {
    let mut corners = vec![None; base.topology().vertex_count()];
    for face in faces {
        let (rows, cols) = (face.surface.net.rows(), face.surface.net.cols());
        let ends = [(0, 0), (rows - 1, 0), (rows - 1, cols - 1), (0, cols - 1)];
        for (side, at) in ends.into_iter().enumerate() {
            let h = side_quads(&face.chart.quads, side)[0].halfedge(side as u32);
            let v = base.topology().origin(h).index();
            match corners[v] {
                Some(position) => face.surface.net[at] = position,
                None => corners[v] = Some(face.surface.net[at]),
            }
        }
    }
    corners
}

fn segments(base: &Level, chart: &Chart, corners: &[Option<Vec3>]) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (number, side) in SIDES.into_iter().enumerate() {
        let quads = side_quads(&chart.quads, number);
        let length = quads.len() as f64;
        let mut start = 0.0;
        let mut halfedges = Vec::new();
        for (step, placed) in quads.iter().enumerate() {
            let h = placed.halfedge(number as u32);
            halfedges.push(h);
            let end = (step + 1) as f64;
            if step + 1 < quads.len() && corners[base.topology().target(h).index()].is_none() {
                continue;
            }
            let range = match side {
                Side::V0 | Side::U1 => [start, end],
                Side::V1 | Side::U0 => [length - start, length - end],
            };
            segments.push(Segment { side, halfedges: std::mem::take(&mut halfedges), range });
            start = end;
        }
    }
    segments
}

/// By base halfedge: face and number of the segment that begins with it.
fn segment_starts(base: &Level, segments: &[Vec<Segment>]) -> Vec<Option<(usize, usize)>> {
    let mut starts = vec![None; base.topology().halfedge_count()];
    for (face, sides) in segments.iter().enumerate() {
        for (number, segment) in sides.iter().enumerate() {
            starts[segment.halfedges[0].index()] = Some((face, number));
        }
    }
    starts
}

struct Sewn<'a> {
    base: &'a Level,
    faces: &'a [Face],
    segments: &'a [Vec<Segment>],
    starts: Vec<Option<(usize, usize)>>,
    corners: &'a [Option<Vec3>],
    is_broken: Vec<bool>,
    /// By base edge: the shell edge it belongs to, once made, and the base halfedge that it begins with.
    edge_of: Vec<Option<(u32, HalfedgeId)>>,
    /// Ends are base vertices until the shells are split.
    edges: Vec<ShellEdge>,
}

impl Sewn<'_> {
    fn use_edge(&mut self, face: usize, segment: &Segment) -> EdgeUse {
        let topology = self.base.topology();
        let first = segment.halfedges[0];
        let (edge, start) = match self.edge_of[topology.edge(first).index()] {
            Some(found) => found,
            None => {
                let made = (self.edges.len() as u32, first);
                let edge = self.make_edge(face, segment);
                self.edges.push(edge);
                for &h in &segment.halfedges {
                    self.edge_of[topology.edge(h).index()] = Some(made);
                }
                made
            }
        };
        EdgeUse { edge, forward: start == first, side: segment.side, range: segment.range }
    }

    /// The edge of a segment, running as its loop does; its curve comes from whichever side has fewer knots on it.
    fn make_edge(&self, face: usize, segment: &Segment) -> ShellEdge {
        let topology = self.base.topology();
        let (first, last) = (segment.halfedges[0], segment.halfedges[segment.halfedges.len() - 1]);
        let mut curve = segment.curve(&self.faces[face].surface);
        if let Some((other, number)) = topology.twin(last).and_then(|twin| self.starts[twin.index()]) {
            let candidate = self.segments[other][number].curve(&self.faces[other].surface);
            if candidate.points.len() < curve.points.len() {
                curve = candidate.reversed();
            }
        }
        let (start, end) = (topology.origin(first), topology.target(last));
        let count = curve.points.len();
        for (at, v) in [(0, start), (count - 1, end)] {
            if let Some(position) = self.corners[v.index()] {
                curve.points[at] = position;
            }
        }
        let broken = |h: HalfedgeId| {
            self.base.is_sharp(h)
                || self.is_broken[h.index()]
                || topology.twin(h).is_none_or(|twin| {
                    self.is_broken[twin.index()] || !self.base.is_visible(topology.face(twin))
                })
        };
        ShellEdge { start: start.0, end: end.0, curve, smooth: !segment.halfedges.iter().any(|&h| broken(h)) }
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
        if curve.knots != surface.side(used.side).knots {
            continue;
        }
        let (rows, cols) = (surface.net.rows(), surface.net.cols());
        for (k, &point) in curve.points.iter().enumerate() {
            let at = match used.side {
                Side::V0 => (k, 0),
                Side::U1 => (rows - 1, k),
                Side::V1 => (k, cols - 1),
                Side::U0 => (0, k),
            };
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
    // By base vertex: the shell that met it last, and its number there. Two shells may touch in a vertex.
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
