//! Outlines: what lies along the sides of each face that is to be sewn, in pieces that no other face divides.
//!
//! Such a piece is a *course*: an edge of a level of refinement, or of a cap. Where faces of different levels meet, the longer side
//! has several (a T). Vertices are those of the levels, then those that caps bring with them.

use std::collections::BTreeMap;

use crate::lens::{Cap, CapVertex};
use crate::math::{Grid, Vec3};
use crate::mesh::{FaceId, HalfedgeId};
use crate::nurbs::{FaceAddress, NurbsSurface, Side};
use crate::patch::{Adaptive, AdaptiveLevel};
use crate::pccm::{Chart, Placed};

/// The sides of a face in the order of its loop.
pub(super) const SIDES: [Side; 4] = [Side::V0, Side::U1, Side::V1, Side::U0];

/// A face that is to be sewn.
pub(super) struct Face {
    pub(super) surface: NurbsSurface,
    /// What lies along its sides, one after the other, in the direction of the loop.
    steps: Vec<Step>,
    /// Where each side ends among these.
    ends: [u32; 4],
    pub(super) pieces: Grid<FaceAddress>,
}

impl Face {
    fn new(surface: NurbsSurface, sides: [Vec<Step>; 4], pieces: Grid<FaceAddress>) -> Face {
        let mut steps = Vec::with_capacity(sides.iter().map(Vec::len).sum());
        let ends = sides.map(|side| {
            steps.extend(side);
            steps.len() as u32
        });
        Face { surface, steps, ends, pieces }
    }

    /// What lies along a side; nothing along one that is a single point.
    pub(super) fn side(&self, number: usize) -> &[Step] {
        let start = if number == 0 { 0 } else { self.ends[number - 1] };
        &self.steps[start as usize..self.ends[number] as usize]
    }
}

/// A course along a side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) course: Course,
    /// The surface's parameter at its ends.
    pub(super) range: [f64; 2],
}

/// An edge in one of its two directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// The number of the edge.
    pub(super) key: u32,
    /// True if it runs in the edge's own direction.
    pub(super) forward: bool,
    pub(super) from: u32,
    pub(super) to: u32,
}

impl Course {
    /// The number of its left side.
    pub(super) fn side(self) -> usize {
        2 * self.key as usize + usize::from(self.forward)
    }

    pub(super) fn reversed(self) -> Course {
        Course { key: self.key, forward: !self.forward, from: self.to, to: self.from }
    }
}

/// All edges that faces may share: those of every level of refinement that a face is made of, then those of caps.
pub(super) struct Seams<'a> {
    adaptive: &'a Adaptive,
    /// For each level the number of its first edge.
    first_edges: Vec<usize>,
    /// By edge of a level: true if faces of deeper levels divide it.
    divided: Vec<bool>,
    /// By edge of a level: false if the faces on both sides meet at an angle there.
    smooth: Vec<bool>,
    /// Edges of caps between two vertices.
    own: BTreeMap<[u32; 2], u32>,
    /// Points of caps.
    points: Vec<Vec3>,
}

impl<'a> Seams<'a> {
    pub(super) fn new(adaptive: &'a Adaptive) -> Seams<'a> {
        let mut first_edges = Vec::new();
        let mut smooth = Vec::new();
        for AdaptiveLevel { level, .. } in adaptive.levels() {
            let topology = level.topology();
            first_edges.push(smooth.len());
            smooth
                .extend(topology.edge_halfedges().map(|h| topology.twin(h).is_some() && !level.is_sharp(h)));
        }
        let divided = vec![false; smooth.len()];
        Seams { adaptive, first_edges, divided, smooth, own: BTreeMap::new(), points: Vec::new() }
    }

    /// Faces of a level are going to be sewn: the edges of levels above that they lie along are divided. To be told of all faces
    /// before the first outline is asked for.
    pub(super) fn divide(&mut self, number: usize, faces: impl IntoIterator<Item = FaceId>) {
        let topology = self.adaptive.levels()[number].level.topology();
        for h in faces.into_iter().flat_map(|face| topology.halfedges(face)) {
            let (mut number, mut edge) = (number, topology.edge(h));
            while let Some(parent) = self.adaptive.parent_edge(number, edge) {
                (number, edge) = (number - 1, parent);
                if std::mem::replace(&mut self.divided[self.first_edges[number] + edge.index()], true) {
                    break;
                }
            }
        }
    }

    /// The surfaces on both sides of a halfedge's edge do not share their tangent planes near its origin.
    pub(super) fn break_at(&mut self, number: usize, h: HalfedgeId) {
        let course = self.along(number, h);
        self.smooth[course.key as usize] = false;
    }

    /// How many edges there are.
    pub(super) fn course_count(&self) -> usize {
        self.smooth.len() + self.own.len()
    }

    /// True if faces on both sides of an edge share tangent planes along it by construction.
    pub(super) fn is_smooth(&self, key: u32) -> bool {
        self.smooth.get(key as usize).copied().unwrap_or(true)
    }

    /// Positions of vertices as far as they are settled.
    pub(super) fn positions(&self) -> Vec<Option<Vec3>> {
        let mut positions = vec![None; self.adaptive.vertex_count()];
        positions.extend(self.points.iter().copied().map(Some));
        positions
    }

    fn along(&self, number: usize, h: HalfedgeId) -> Course {
        let AdaptiveLevel { level, vertices, .. } = &self.adaptive.levels()[number];
        let topology = level.topology();
        Course {
            key: (self.first_edges[number] + topology.edge(h).index()) as u32,
            forward: topology.twin(h).is_none_or(|twin| h < twin),
            from: vertices[topology.origin(h).index()],
            to: vertices[topology.target(h).index()],
        }
    }

    /// What lies along a halfedge of a level, with the share of it that each piece begins and ends at.
    fn courses(&self, number: usize, h: HalfedgeId, range: [f64; 2], out: &mut Vec<Step>) {
        let course = self.along(number, h);
        let halves = if self.divided[course.key as usize] { self.adaptive.halves(number, h) } else { None };
        let Some([first, second]) = halves else {
            out.push(Step { course, range });
            return;
        };
        let middle = (range[0] + range[1]) / 2.0;
        self.courses(number + 1, first, [range[0], middle], out);
        self.courses(number + 1, second, [middle, range[1]], out);
    }

    fn between(&mut self, from: u32, to: u32) -> Course {
        let next = self.course_count() as u32;
        let key = *self.own.entry([from.min(to), from.max(to)]).or_insert(next);
        Course { key, forward: from < to, from, to }
    }

    /// A chart of a level with its surface, one unit of knot per quad.
    pub(super) fn chart(&self, number: usize, chart: &Chart, surface: NurbsSurface) -> Face {
        let topology = self.adaptive.levels()[number].level.topology();
        let side = |side: usize| {
            let quads = side_quads(&chart.quads, side);
            let length = quads.len() as f64;
            let mut steps = Vec::with_capacity(quads.len());
            for (step, placed) in (0..).zip(quads) {
                let (start, end) = (f64::from(step), f64::from(step + 1));
                let range = match SIDES[side] {
                    Side::V0 | Side::U1 => [start, end],
                    Side::V1 | Side::U0 => [length - start, length - end],
                };
                let h = HalfedgeId(topology.first(FaceId(placed.quad)).0 + (placed.turn + side as u32) % 4);
                self.courses(number, h, range, &mut steps);
            }
            steps
        };
        let addresses = &self.adaptive.levels()[number].addresses;
        let pieces = chart.quads.map(|placed| addresses[placed.quad as usize]);
        Face::new(surface, std::array::from_fn(side), pieces)
    }

    /// The faces of a cap of the cage.
    pub(super) fn cap(&mut self, cap: &Cap) -> Vec<Face> {
        let first_point = (self.adaptive.vertex_count() + self.points.len()) as u32;
        self.points.extend_from_slice(&cap.points);
        let mut faces = Vec::with_capacity(cap.faces.len());
        for face in &cap.faces {
            let mut sides: [Vec<Step>; 4] = Default::default();
            for edge in &face.boundary {
                let side = &mut sides[SIDES.iter().position(|&side| side == edge.side).unwrap_or(0)];
                let number = |v: CapVertex| match v {
                    CapVertex::Cage(v) => v.0,
                    CapVertex::Own(point) => first_point + point,
                };
                let (CapVertex::Cage(from), CapVertex::Cage(to)) = (edge.from, edge.to) else {
                    let course = self.between(number(edge.from), number(edge.to));
                    side.push(Step { course, range: edge.range });
                    continue;
                };
                let topology = self.adaptive.levels()[0].level.topology();
                if let Some(h) = topology.ring(from).find(|&h| topology.target(h) == to) {
                    self.courses(0, h, edge.range, side);
                }
            }
            faces.push(Face::new(face.surface.clone(), sides, face.pieces.clone()));
        }
        faces
    }
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
