//! `Refinement`: several steps with their tables, and the grids of points that they make of each face.

use super::{Step, TooDeep};
use crate::math::{Grid, Interpolate};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::rules::Level;

/// Uniform refinement: weights, not points.
#[derive(Clone, Debug)]
pub struct Refinement {
    base: Level,
    steps: Vec<Step>,
}

impl Refinement {
    /// `depth` steps of refinement.
    ///
    /// # Errors
    /// If the finest level would have too many elements for 32-bit ids.
    pub fn uniform(level: &Level, depth: u32) -> Result<Refinement, TooDeep> {
        level.check_depth(depth, u64::MAX)?;
        let mut steps: Vec<Step> = Vec::with_capacity(depth as usize);
        for _ in 0..depth {
            let step = steps.last().map_or(level, |step| &step.level).refine();
            steps.push(step);
        }
        Ok(Refinement { base: level.clone(), steps })
    }

    /// The data of the finest level from that of the cage: points, colours, weights.
    pub fn apply<T: Interpolate>(&self, cage: &[T]) -> Vec<T> {
        let mut data = cage[..self.base.topology().vertex_count()].to_vec();
        for step in &self.steps {
            data = step.stencils.apply(&data);
        }
        data
    }

    /// The finest level.
    pub fn finest(&self) -> &Level {
        self.steps.last().map_or(&self.base, |step| &step.level)
    }

    /// Number of steps.
    pub fn depth(&self) -> u32 {
        self.steps.len() as u32
    }

    /// The vertices of the finest level over a face, laid along its `(u, v)`: `2^depth + 1` a side on a quad
    /// (`corner` is `None`); `2^(depth - 1) + 1` on the quarter at corner `corner` of any other polygon.
    ///
    /// # Panics
    /// If there is no such face or corner, or a polygon is asked for without any refinement.
    pub fn grid(&self, face: FaceId, corner: Option<u32>) -> Grid<VertexId> {
        let topology = self.base.topology();
        let quad = topology.face_size(face) == 4;
        assert_eq!(
            quad,
            corner.is_none(),
            "a quad has no corners to ask for, other polygons have nothing else"
        );
        match corner {
            None => {
                quad_grid(self.finest(), QuadPath { first: topology.first(face).0, turns: 0 }, self.depth())
            }
            Some(corner) => {
                assert!(corner < topology.face_size(face), "face {face} has no corner {corner}");
                let quad = topology.first(face).0 + corner;
                quad_grid(self.finest(), QuadPath { first: 4 * quad, turns: 0 }, self.depth() - 1)
            }
        }
    }
}

/// A quad on the way down from a base face: its first halfedge, and by how many corners it is turned
/// against that face.
#[derive(Clone, Copy, Debug)]
struct QuadPath {
    first: u32,
    turns: u32,
}

impl QuadPath {
    /// The child at corner `corner` of the base face's own frame.
    fn child(self, corner: u32) -> QuadPath {
        // Own corner number of that corner; the child's corner 0 is that corner, so it is turned by its number.
        let own = (corner + 4 - self.turns) % 4;
        let quad = self.first + own;
        QuadPath { first: 4 * quad, turns: corner }
    }
}

/// The vertices of `finest` over quad `quad` of the level `depth` steps above it, in a frame against which that quad is
/// turned by `turns` corners.
pub(crate) fn sub_grid(finest: &Level, quad: u32, turns: u32, depth: u32) -> Grid<VertexId> {
    quad_grid(finest, QuadPath { first: 4 * quad, turns }, depth)
}

/// The vertices of `finest` over a quad `depth` levels above it.
fn quad_grid(finest: &Level, root: QuadPath, depth: u32) -> Grid<VertexId> {
    let side = 1usize << depth;
    Grid::from_fn(side + 1, side + 1, |i, j| {
        let (halfedge, _) = cell_corner(root, depth, i, j);
        finest.topology().origin(halfedge)
    })
}

/// The halfedge of the finest level that leaves grid vertex `(i, j)` inside the base quad, counter-clockwise first
/// in its cell, and the corner of that cell (in the base frame) at which the vertex stands.
fn cell_corner(root: QuadPath, depth: u32, i: usize, j: usize) -> (HalfedgeId, u32) {
    let side = 1usize << depth;
    let (a, b) = (i.min(side - 1), j.min(side - 1));
    let mut path = root;
    for bit in (0..depth).rev() {
        let corner = match (a >> bit & 1, b >> bit & 1) {
            (0, 0) => 0,
            (1, 0) => 1,
            (1, 1) => 2,
            _ => 3,
        };
        path = path.child(corner);
    }
    let corner = match (i - a, j - b) {
        (0, 0) => 0,
        (1, 0) => 1,
        (1, 1) => 2,
        _ => 3,
    };
    (HalfedgeId(path.first + (corner + 4 - path.turns) % 4), corner)
}
