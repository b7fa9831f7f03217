//! The points inside quads: what is new there depends on nothing but the grid and its sides.

use bytemuck::cast_slice_mut;

use super::grids::Grids;
use super::kernel::{along, edge_row, vertex_row};
use crate::math::simd::{Four, Kernel, dispatch};
use crate::math::{Components, par};
use crate::mesh::FaceId;
use crate::mesh::connectivity::Connectivity;

/// Refines the insides of all quads into `out`, `(2 side - 1)^2` points for each.
pub(super) fn refine<C: Connectivity, T: Components>(grids: &Grids<'_, C, T>, out: &mut [T]) {
    refine_from(grids, 0, out);
}

/// The same for some quads, from `first` on.
pub(super) fn refine_from<C: Connectivity, T: Components>(
    grids: &Grids<'_, C, T>,
    first: usize,
    out: &mut [T],
) {
    let width = 2 * grids.frame.side - 1;
    par::chunks(out, width * width, Memory::default, |memory, f, out| {
        dispatch(Refine { grids, face: FaceId((first + f) as u32), memory, out });
    });
}

/// What a thread needs to refine one grid after the other.
#[derive(Debug, Default)]
struct Memory(Vec<f64>);

impl Memory {
    /// Room for a row of a grid of `n` cells a side, and for all rows refined along themselves, one number more each.
    #[inline(always)]
    fn rows(&mut self, n: usize, count: usize) -> (&mut [f64], &mut [f64]) {
        let row = (n + 1) * count + 1;
        let rows = (n + 1) * (2 * n - 1) * count + 1;
        self.0.resize(row + rows, 0.0);
        self.0.split_at_mut(row)
    }
}

struct Refine<'a, C, T> {
    grids: &'a Grids<'a, C, T>,
    face: FaceId,
    memory: &'a mut Memory,
    out: &'a mut [T],
}

impl<C: Connectivity, T: Components> Kernel for Refine<'_, C, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Refine { grids, face, memory, out } = self;
        let (n, count) = (grids.frame.side, T::COUNT);
        let width = (2 * n - 1) * count;
        let (row, rows) = memory.rows(n, count);
        for i in 0..=n {
            grids.row(face, i, cast_slice_mut(&mut row[..(n + 1) * count]));
            along::<V, T>(row, &mut rows[i * width..(i + 1) * width + 1]);
        }
        let row = |m: usize| &rows[m * width..(m + 1) * width];
        let out: &mut [f64] = cast_slice_mut(out);
        for m in 0..n {
            edge_row([row(m), row(m + 1)], &mut out[2 * m * width..(2 * m + 1) * width]);
            if m + 1 < n {
                let rows = [row(m), row(m + 1), row(m + 2)];
                vertex_row(rows, &mut out[(2 * m + 1) * width..(2 * m + 2) * width]);
            }
        }
    }
}
