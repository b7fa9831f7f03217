//! Outlines: what lies along the sides of each face that is to be sewn, in pieces that no other face divides.
//!
//! Such a piece is a *course*: an edge of the base mesh, or of a cap. Vertices are those of the base mesh, then those
//! that caps bring with them.

use std::collections::BTreeMap;

use crate::lens::{Cap, CapVertex};
use crate::math::{Grid, Vec3};
use crate::mesh::{HalfedgeId, VertexId};
use crate::nurbs::{FaceAddress, NurbsSurface, Side};
use crate::pccm::{Chart, Placed};
use crate::rules::Level;

/// The sides of a face in the order of its loop.
pub(super) const SIDES: [Side; 4] = [Side::V0, Side::U1, Side::V1, Side::U0];

/// A face that is to be sewn.
pub(super) struct Face {
    pub(super) surface: NurbsSurface,
    /// What lies along each side, in the direction of the loop; nothing along one that is a single point.
    pub(super) sides: [Vec<Step>; 4],
    pub(super) pieces: Grid<FaceAddress>,
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
    /// The number of the edge: that in the base mesh, or one beyond.
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

/// All edges that faces may share.
pub(super) struct Seams<'a> {
    base: &'a Level,
    /// By edge of the base: false if the faces on both sides meet at an angle there.
    smooth: Vec<bool>,
    /// Edges of caps between two vertices.
    own: BTreeMap<[u32; 2], u32>,
    /// Points of caps.
    points: Vec<Vec3>,
}

impl<'a> Seams<'a> {
    /// Those of a base mesh; `broken` are halfedges whose edge is not smooth next to their origin.
    pub(super) fn new(base: &'a Level, broken: &[HalfedgeId]) -> Seams<'a> {
        let topology = base.topology();
        let edges = topology.edge_halfedges();
        let mut smooth: Vec<bool> = edges.map(|h| topology.twin(h).is_some() && !base.is_sharp(h)).collect();
        for &h in broken {
            smooth[topology.edge(h).index()] = false;
        }
        Seams { base, smooth, own: BTreeMap::new(), points: Vec::new() }
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
        let mut positions = vec![None; self.base.topology().vertex_count()];
        positions.extend(self.points.iter().copied().map(Some));
        positions
    }

    fn along(&self, h: HalfedgeId) -> Course {
        let topology = self.base.topology();
        Course {
            key: topology.edge(h).0,
            forward: topology.twin(h).is_none_or(|twin| h < twin),
            from: topology.origin(h).0,
            to: topology.target(h).0,
        }
    }

    fn between(&mut self, from: u32, to: u32) -> Course {
        let next = self.course_count() as u32;
        let key = *self.own.entry([from.min(to), from.max(to)]).or_insert(next);
        Course { key, forward: from < to, from, to }
    }

    /// A chart with its surface, one unit of knot per quad; `address` names a quad of the base.
    pub(super) fn chart(
        &self,
        chart: &Chart,
        surface: NurbsSurface,
        address: impl Fn(u32) -> FaceAddress,
    ) -> Face {
        let side = |number: usize| {
            let quads = side_quads(&chart.quads, number);
            let length = quads.len() as f64;
            let steps = (0..).zip(quads).map(|(step, placed)| {
                let (start, end) = (f64::from(step), f64::from(step + 1));
                let range = match SIDES[number] {
                    Side::V0 | Side::U1 => [start, end],
                    Side::V1 | Side::U0 => [length - start, length - end],
                };
                Step { course: self.along(placed.halfedge(number as u32)), range }
            });
            steps.collect()
        };
        let pieces = chart.quads.map(|placed| address(placed.quad));
        Face { surface, sides: std::array::from_fn(side), pieces }
    }

    /// The faces of a cap, whose cage is the base mesh `steps` refinements ago.
    pub(super) fn cap(&mut self, cap: &Cap, steps: u32) -> Vec<Face> {
        let first_point = (self.base.topology().vertex_count() + self.points.len()) as u32;
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
                let path = path(self.base, from, to, steps);
                let count = path.len() as f64;
                let [start, end] = edge.range;
                for (k, h) in path.into_iter().enumerate() {
                    let at = |k: usize| start + (end - start) * (k as f64 / count);
                    side.push(Step { course: self.along(h), range: [at(k), at(k + 1)] });
                }
            }
            faces.push(Face { surface: face.surface.clone(), sides, pieces: face.pieces.clone() });
        }
        faces
    }
}

/// The halfedges from one vertex of the cage to another, its neighbour `steps` refinements ago: straight on.
fn path(base: &Level, from: VertexId, to: VertexId, steps: u32) -> Vec<HalfedgeId> {
    let topology = base.topology();
    let straight_on = |h: HalfedgeId| topology.twin(topology.next(h)).map(|across| topology.next(across));
    let walk = |first: HalfedgeId| {
        std::iter::successors(Some(first), |&h| straight_on(h)).take(1 << steps).collect::<Vec<_>>()
    };
    let mut paths = topology.ring(from).map(walk);
    paths.find(|path| path.last().is_some_and(|&h| topology.target(h) == to)).unwrap_or_default()
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
