//! From levels to grids: for rules that spread from corners into edges and faces, and for what is known level by level.

use super::numbering::Numbering;
use crate::math::par;
use crate::mesh::{EdgeId, FaceId};
use crate::refine::sub_grid;
use crate::rules::Level;

/// Values at the vertices of a level refined from `base`, put into the order of grids.
pub(super) fn in_grids<T: Copy + Send + Sync>(base: &Level, finest: &Level, values: &[T], out: &mut Vec<T>) {
    let topology = base.topology();
    let mut depth = 0;
    while topology.face_count() << (2 * depth) < finest.topology().face_count() {
        depth += 1;
    }
    assert_eq!(
        topology.face_count() << (2 * depth),
        finest.topology().face_count(),
        "the level is of this cage"
    );
    let numbering = Numbering::new(topology, 1 << depth);
    let side = numbering.side;
    out.clear();
    out.extend_from_slice(&values[..numbering.vertices]);
    let grid = |f: FaceId| sub_grid(finest, f.0, 0, depth);
    let interiors = par::map(numbering.faces, |f| {
        let grid = grid(FaceId(f as u32));
        let inside = (1..side).flat_map(|i| (1..side).map(move |j| (i, j)));
        inside.map(|at| values[grid[at].index()]).collect::<Vec<T>>()
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
        along.map(|at| values[grid[at].index()]).collect::<Vec<T>>()
    });
    sides.iter().for_each(|inside| out.extend_from_slice(inside));
}
