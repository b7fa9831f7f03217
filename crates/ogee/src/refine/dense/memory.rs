//! What dense refinement needs, from counts alone: to be asked before anything is allocated.

use super::stream::AT_ONCE;
use crate::math::Vec3;
use crate::refine::TooDeep;
use crate::rules::Level;

const POINT: u128 = size_of::<Vec3>() as u128;
const QUAD: u128 = size_of::<[u32; 4]>() as u128;
/// What a face of a base costs that is not the cage: its connectivity, and its points twice.
const BASE_FACE: u128 = 60 + 48;
/// What a face of the last level costs where levels are made after all: half of it for that level, and for all before.
const LEVEL_FACE: u128 = 120;

/// No cage is refined so often.
const DEEPEST: u32 = 40;

/// The base of the grids, in numbers, and the steps from there.
struct Base {
    steps: u32,
    vertices: u128,
    faces: u128,
    edges: u128,
    /// Bytes of the base itself, where it is not the cage.
    bytes: u128,
    /// True if there are levels instead of grids.
    spreads: bool,
}

impl Base {
    /// `None` at depth 0. Counts beyond a depth where ids ended long ago are those of that depth.
    fn new(level: &Level, depth: u32) -> Option<Base> {
        let depth = depth.min(DEEPEST);
        let topology = level.topology();
        let [vertices, faces, edges, halfedges] = [
            topology.vertex_count(),
            topology.face_count(),
            topology.edge_count(),
            topology.halfedge_count(),
        ]
        .map(|count| count as u128);
        let spreads = level.spreads();
        match depth {
            0 => None,
            _ if topology.is_quads() => {
                Some(Base { steps: depth, vertices, faces, edges, bytes: 0, spreads })
            }
            _ => Some(Base {
                steps: depth - 1,
                vertices: vertices + faces + edges,
                faces: halfedges,
                edges: 2 * edges + halfedges,
                bytes: if depth == 1 { 0 } else { halfedges * BASE_FACE },
                spreads,
            }),
        }
    }

    fn points(&self, steps: u32) -> u128 {
        let inside = (1 << steps) - 1;
        self.vertices + self.faces * inside * inside + self.edges * inside
    }

    fn last_faces(&self) -> u128 {
        self.faces << (2 * self.steps)
    }

    /// True if the ids of the last level's vertices, and of the halfedges of all levels that are made, are below `2^32 - 1`.
    fn ids_fit(&self) -> bool {
        let of_levels = match self.bytes {
            _ if self.spreads => self.last_faces(),
            0 => 0,
            _ => self.faces,
        };
        self.points(self.steps).max(4 * of_levels) < u128::from(u32::MAX)
    }

    /// The points of the level before the last, and of the one before that while it is made.
    fn before(&self) -> u128 {
        (0..self.steps).rev().take(2).map(|steps| self.points(steps)).sum::<u128>() * POINT
    }

    fn mesh(&self) -> u128 {
        let levels = if self.spreads { self.last_faces() * LEVEL_FACE } else { 0 };
        // The level before is given back when quads are written.
        let more = self.before().max(self.last_faces() * QUAD);
        self.points(self.steps) * POINT + levels + self.bytes + more
    }

    fn stream(&self) -> u128 {
        let blocks = AT_ONCE as u128 * (2 * POINT + QUAD);
        if self.steps < 2 || self.spreads {
            return self.mesh() + blocks;
        }
        // The corners and the sides of the last level, and a block of it.
        let side = 1 << self.steps;
        let rows = (self.vertices + self.edges * (side - 1)) * POINT;
        self.before() + rows + self.bytes + side * side * POINT + blocks
    }
}

impl Level {
    /// The most bytes that [`Level::fine_mesh`] and the calls it is made of hold on their way to a depth, for points of three
    /// numbers, this level left out: the last level, and before its quads are written the level before; where it is the base, the
    /// first level as well.
    pub fn fine_mesh_bytes(&self, depth: u32) -> u128 {
        Base::new(self, depth).map_or(0, |base| base.mesh())
    }

    /// Asks whether [`Level::fine_mesh`] fits into ids and into `memory` bytes.
    ///
    /// # Errors
    /// If it does not.
    pub fn check_fine_mesh(&self, depth: u32, memory: u64) -> Result<(), TooDeep> {
        self.check_dense(depth, |base| base.mesh() <= u128::from(memory))
    }

    /// The most bytes that [`DenseRefinement::visit_points`](crate::DenseRefinement::visit_points) and
    /// [`DenseRefinement::visit_quads`](crate::DenseRefinement::visit_quads) hold on their way to a depth, as
    /// [`Level::fine_mesh_bytes`] counts.
    pub fn streaming_bytes(&self, depth: u32) -> u128 {
        Base::new(self, depth).map_or(0, |base| base.stream())
    }

    /// Asks whether `depth` steps fit into ids, and into `memory` bytes if the last of them comes block by block.
    ///
    /// # Errors
    /// If they do not.
    pub fn check_streaming(&self, depth: u32, memory: u64) -> Result<(), TooDeep> {
        self.check_dense(depth, |base| base.stream() <= u128::from(memory))
    }

    fn check_dense(&self, depth: u32, fits: impl Fn(&Base) -> bool) -> Result<(), TooDeep> {
        let fits = |depth: u32| {
            depth == 0 || Base::new(self, depth).is_some_and(|base| base.ids_fit() && fits(&base))
        };
        if fits(depth) {
            return Ok(());
        }
        let deepest = (0..depth.min(DEEPEST)).rev().find(|&shallower| fits(shallower)).unwrap_or(0);
        Err(TooDeep { depth, faces: self.faces_at(depth), deepest })
    }

    /// True if rules at corners of the base spread into edges and faces from step to step.
    pub(super) fn spreads(&self) -> bool {
        self.has_slices() || self.is_chaikin() && self.semi_sharp_edges().next().is_some()
    }
}
