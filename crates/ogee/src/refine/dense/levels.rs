//! The same points by way of levels: the simple version, and the one for rules that spread from corners into edges and faces.

use super::numbering::Numbering;
use crate::math::{Components, par};
use crate::mesh::{EdgeId, FaceId};
use crate::refine::sub_grid;
use crate::rules::Level;

/// The points of the last of some levels, the first of which is refined from `base`, in the numbering of grids.
pub(super) fn points<T: Components>(base: &Level, levels: &[Level], points: &[T], out: &mut Vec<T>) {
    let mut fine = points.to_vec();
    let mut finest = base;
    for level in levels {
        let mut next = Vec::new();
        finest.child_points(&fine, &mut next);
        (fine, finest) = (next, level);
    }
    let depth = levels.len() as u32;
    let topology = base.topology();
    let numbering = Numbering::new(topology, 1 << depth);
    let side = numbering.side;
    out.clear();
    out.extend_from_slice(&fine[..numbering.vertices]);
    let grid = |f: FaceId| sub_grid(finest, f.0, 0, depth);
    let interiors = par::map(numbering.faces, |f| {
        let grid = grid(FaceId(f as u32));
        let inside = (1..side).flat_map(|i| (1..side).map(move |j| (i, j)));
        inside.map(|at| fine[grid[at].index()]).collect::<Vec<T>>()
    });
    interiors.iter().for_each(|inside| out.extend_from_slice(inside));
    let sides = par::map(numbering.edges, |e| {
        let h = topology.side(EdgeId(e as u32));
        let grid = grid(topology.face(h));
        let along = (1..side).map(|t| match h.0 % 4 {
            0 => (t, 0),
            1 => (side, t),
            2 => (side - t, side),
            _ => (0, side - t),
        });
        along.map(|at| fine[grid[at].index()]).collect::<Vec<T>>()
    });
    sides.iter().for_each(|inside| out.extend_from_slice(inside));
}
