//! The last level block by block, for meshes larger than memory: of its points only what the last step starts from is held, of
//! its faces nothing.

use super::grids::{Frame, Grids};
use super::numbering::Numbering;
use super::plan::{DenseRefinement, Way, refine};
use super::{corners, interiors, sides};
use crate::math::{Components, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};
use crate::refine::TooDeep;
use crate::refine::split::child_quad;
use crate::rules::Level;

/// About so many points or faces are handed on at once: enough work for all cores, and not much memory.
const AT_ONCE: usize = 1 << 18;

const BYTES_PER_POINT: u128 = 24;

/// What a face of the base level costs where that is not the cage: its connectivity and its points.
const BYTES_PER_BASE_FACE: u128 = 110;

impl Level {
    /// The most bytes that [`DenseRefinement::visit_points`] and [`DenseRefinement::visit_quads`] hold on their way to a depth, the
    /// plan included and this level left out. Known from counts alone, to be asked before anything is allocated.
    pub fn streaming_bytes(&self, depth: u32) -> u128 {
        let topology = self.topology();
        let [v, f, e, h] = [
            topology.vertex_count(),
            topology.face_count(),
            topology.edge_count(),
            topology.halfedge_count(),
        ]
        .map(|count| count as u128);
        let is_quads = topology.is_quads();
        let [vertices, faces, edges] = if is_quads { [v, f, e] } else { [v + f + e, h, 2 * e + h] };
        let steps = if is_quads { depth } else { depth.saturating_sub(1) }.min(40);
        let blocks = AT_ONCE as u128 * (2 * BYTES_PER_POINT + size_of::<[u32; 4]>() as u128);
        if steps < 2 || self.has_slices() || self.is_chaikin() {
            return self.fine_mesh_bytes(depth) + blocks;
        }
        let side = 1u128 << steps;
        // The points of the level before, rows of both levels, and corners.
        let coarse = vertices + faces * (side / 2 - 1).pow(2) + edges * (side / 2 - 1);
        let rows = edges * (side / 2 + side);
        let base = if is_quads { 0 } else { BYTES_PER_BASE_FACE * faces };
        let grid = BYTES_PER_POINT * side * side;
        BYTES_PER_POINT * (coarse + rows + 3 * vertices) + base + grid + blocks
    }

    /// Asks whether `depth` steps fit into ids, and into `memory` bytes if the last of them comes block by block.
    ///
    /// # Errors
    /// If they do not.
    pub fn check_streaming(&self, depth: u32, memory: u64) -> Result<(), TooDeep> {
        let fits = |depth: u32| {
            self.check_depth(depth, u64::MAX).is_ok() && self.streaming_bytes(depth) <= u128::from(memory)
        };
        self.check_depth(depth, u64::MAX)?;
        if depth == 0 || fits(depth) {
            return Ok(());
        }
        let deepest = (0..depth).rev().find(|&shallower| fits(shallower)).unwrap_or(0);
        Err(TooDeep { depth, faces: self.faces_at(depth), deepest })
    }
}

impl DenseRefinement<'_> {
    /// The points of [`DenseRefinement::points`], bit for bit and in their order, in blocks. From the second step on a quarter of
    /// them is held; in a single step, and where levels are made after all, all of them.
    ///
    /// # Errors
    /// The first one of `take`, after which it is not called again.
    ///
    /// # Panics
    /// As [`DenseRefinement::points`].
    pub fn visit_points<T: Components, E>(
        &self,
        cage: &[T],
        mut take: impl FnMut(&[T]) -> Result<(), E>,
    ) -> Result<(), E> {
        if let Way::Grids { base, numbering, steps, rules } = &self.way {
            if let Some(quads) = base.topology().as_quads().filter(|_| *steps > 1) {
                let coarse = Numbering::new(&quads, numbering.side / 2);
                let values = self.base_values(base, cage);
                let mut points = Vec::new();
                match steps {
                    2 => base.child_points(&values, &mut points),
                    _ => refine(base, &quads, &coarse, rules, &values, &mut points),
                }
                drop(values);
                let rules = rules.get(*steps as usize - 2).or(rules.last()).unwrap_or(base);
                return last_step(rules, &quads, [&coarse, numbering], &points, take);
            }
        }
        let mut points = Vec::new();
        self.points(cage, &mut points);
        points.chunks(AT_ONCE).try_for_each(&mut take)
    }

    /// The quads of [`DenseRefinement::quads`], in their order, in blocks.
    ///
    /// # Errors
    /// The first one of `take`, after which it is not called again.
    pub fn visit_quads<E>(&self, mut take: impl FnMut(&[[u32; 4]]) -> Result<(), E>) -> Result<(), E> {
        let (base, side) = match &self.way {
            Way::Step => (self.cage, 1),
            Way::Grids { base, numbering, .. } | Way::Levels { base, numbering, .. } => {
                (&**base, numbering.side)
            }
        };
        let topology = base.topology();
        let visible: Vec<u32> =
            (0..topology.face_count() as u32).filter(|&f| base.is_visible(FaceId(f))).collect();
        let mut block = Vec::new();
        for faces in visible.chunks(AT_ONCE.div_ceil(side * side)) {
            block.clear();
            match (&self.way, topology.as_quads()) {
                (Way::Grids { numbering, .. } | Way::Levels { numbering, .. }, Some(quads)) => {
                    block.resize(faces.len() * side * side, [0; 4]);
                    par::chunks(&mut block, side * side, Default::default, |rows, f, out| {
                        numbering.quads(&quads, FaceId(faces[f]), rows, out);
                    });
                }
                _ => {
                    let corners = |&f: &u32| topology.halfedges(FaceId(f));
                    block.extend(faces.iter().flat_map(corners).map(|h: HalfedgeId| child_quad(topology, h)));
                }
            }
            take(&block)?;
        }
        Ok(())
    }
}

/// The last step from the points of the level before.
fn last_step<C: Connectivity, T: Components, E>(
    rules: &Level,
    quads: &C,
    [coarse, numbering]: [&Numbering; 2],
    points: &[T],
    mut take: impl FnMut(&[T]) -> Result<(), E>,
) -> Result<(), E> {
    let [corners, interiors, sides] = coarse.parts(points);
    let frame = Frame { base: quads, side: coarse.side, corners, sides };
    let grids = Grids { frame, interiors };
    let mut block = vec![T::zero(); numbering.vertices];
    corners::refine(rules, &grids, &mut block);
    block.chunks(AT_ONCE).try_for_each(&mut take)?;

    let room = numbering.per_face();
    let at_once = AT_ONCE.div_ceil(room);
    for first in (0..numbering.faces).step_by(at_once) {
        block.resize(at_once.min(numbering.faces - first) * room, T::zero());
        interiors::refine_from(&grids, first, &mut block);
        take(&block)?;
    }
    drop(block);

    let mut rows = vec![T::zero(); numbering.edges * numbering.per_edge()];
    sides::refine(rules, &grids, &mut rows);
    rows.chunks(AT_ONCE).try_for_each(&mut take)
}
