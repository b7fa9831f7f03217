//! The points inside edges: a row that two grids share, refined between their rows next to it.

use bytemuck::cast_slice_mut;

use super::grids::Grids;
use super::kernel::along;
use crate::math::simd::{Four, Kernel, dispatch};
use crate::math::{Components, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{EdgeId, HalfedgeId};
use crate::rules::{EdgeRule, Level};

/// Refines the insides of all edges into `out`, `2 side - 1` points for each.
pub(super) fn refine<C: Connectivity, T: Components>(rules: &Level, grids: &Grids<'_, C, T>, out: &mut [T]) {
    par::chunks(out, 2 * grids.frame.side - 1, Vec::new, |row, e, out| {
        let h = grids.frame.base.side(EdgeId(e as u32));
        dispatch(Refine { grids, rule: rules.edge_rule(h), halfedge: h, row, out });
    });
}

struct Refine<'a, C, T> {
    grids: &'a Grids<'a, C, T>,
    rule: EdgeRule,
    halfedge: HalfedgeId,
    row: &'a mut Vec<T>,
    out: &'a mut [T],
}

impl<C: Connectivity, T: Components> Kernel for Refine<'_, C, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Refine { grids, rule, halfedge: h, row, out } = self;
        let n = grids.frame.side;
        row.resize(n + 1, T::zero());
        row[0] = grids.frame.corner(grids.frame.base.origin(h));
        grids.frame.side(h).copy(false, &mut row[1..n]);
        row[n] = grids.frame.corner(grids.frame.base.target(h));
        let crease_share = match rule {
            EdgeRule::Smooth => 0.0,
            EdgeRule::Crease => 1.0,
            EdgeRule::Blend { weight } => weight,
        };
        if let (true, Some(twin)) = (crease_share != 1.0, grids.frame.base.twin(h)) {
            // Across the edge first: six eighths of the row, an eighth of each row beside it.
            let beside = (1.0 - crease_share) * (1.0 / 8.0);
            let own = 1.0 - 2.0 * beside;
            cast_slice_mut::<T, f64>(row).iter_mut().for_each(|number| *number *= own);
            grids.add_row_beside(h, false, beside, row);
            grids.add_row_beside(twin, true, beside, row);
        }
        along(row, out);
    }
}
