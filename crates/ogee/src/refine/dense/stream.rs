//! The last level block by block, for meshes larger than memory: of its points only what the last step starts from is held, of
//! its faces nothing.

use super::grids::{Frame, Grids};
use super::numbering::Numbering;
use super::plan::{DenseRefinement, Way, refine};
use super::{corners, interiors, sides};
use crate::math::{Components, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};
use crate::refine::split::child_quad;
use crate::rules::Level;

/// About so many points or faces are handed on at once: enough work for all cores, and not much memory.
pub(super) const AT_ONCE: usize = 1 << 18;

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
            if let Some(quads) = base.topology().as_quads().filter(|_| *steps > 1 && T::COUNT > 0) {
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
fn last_step<C: Connectivity + Copy, T: Components, E>(
    rules: &Level,
    quads: &C,
    [coarse, numbering]: [&Numbering; 2],
    points: &[T],
    mut take: impl FnMut(&[T]) -> Result<(), E>,
) -> Result<(), E> {
    let [corners, interiors, sides] = coarse.parts(points);
    let frame = Frame { base: *quads, side: coarse.side, corners, sides };
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
