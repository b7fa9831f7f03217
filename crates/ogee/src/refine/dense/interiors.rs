//! The points inside quads: what is new there depends on nothing but the grid and its sides.

use bytemuck::{cast_slice, cast_slice_mut};

use super::grids::Grids;
use super::kernel::{along, edge_row, vertex_row};
use crate::math::simd::{Four, Kernel, dispatch};
use crate::math::{Components, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};

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
#[derive(Debug)]
struct Memory<T> {
    /// One row of the grid.
    row: Vec<T>,
    /// All rows, refined along themselves.
    rows: Vec<T>,
}

impl<T> Default for Memory<T> {
    fn default() -> Memory<T> {
        Memory { row: Vec::new(), rows: Vec::new() }
    }
}

struct Refine<'a, C, T> {
    grids: &'a Grids<'a, C, T>,
    face: FaceId,
    memory: &'a mut Memory<T>,
    out: &'a mut [T],
}

impl<C: Connectivity, T: Components> Kernel for Refine<'_, C, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Refine { grids, face, memory, out } = self;
        let frame = &grids.frame;
        let points = grids.interior(face);
        let n = frame.side;
        let width = 2 * n - 1;
        memory.row.resize(n + 1, T::zero());
        memory.rows.resize((n + 1) * width, T::zero());
        let h = 4 * face.0;
        let [h0, h1, h2, h3] = [HalfedgeId(h), HalfedgeId(h + 1), HalfedgeId(h + 2), HalfedgeId(h + 3)];
        let corner = |h: HalfedgeId| frame.corner(frame.base.origin(h));
        let [first, last] = [frame.side(h0), frame.side(h2)];
        let row = &mut memory.row[..n + 1];
        let rows = &mut memory.rows[..(n + 1) * width];
        row[0] = corner(h0);
        frame.side(h3).copy(true, &mut row[1..n]);
        row[n] = corner(h3);
        along(row, &mut rows[..width]);
        for i in 1..n {
            row[0] = first.at(i);
            row[1..n].copy_from_slice(&points[(i - 1) * (n - 1)..i * (n - 1)]);
            row[n] = last.at(n - i);
            along(row, &mut rows[i * width..(i + 1) * width]);
        }
        row[0] = corner(h1);
        frame.side(h1).copy(false, &mut row[1..n]);
        row[n] = corner(h2);
        along(row, &mut rows[n * width..]);

        let rows: &[f64] = cast_slice(rows);
        let width = width * T::COUNT;
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
