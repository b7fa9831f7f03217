//! The points inside quads: a grid is refined within its own place.

use bytemuck::{cast_slice, cast_slice_mut};

use super::grids::Frame;
use super::kernel::{along, edge_row, vertex_row};
use crate::math::simd::{Four, Kernel, dispatch};
use crate::math::{Components, par};
use crate::mesh::FaceId;
use crate::mesh::connectivity::Connectivity;

/// Refines the insides of all quads, `room` points for each, from `frame.side` cells a side to twice as many.
pub(super) fn refine<C: Connectivity, T: Components>(
    frame: &Frame<'_, C, T>,
    interiors: &mut [T],
    room: usize,
) {
    refine_from(frame, 0, interiors, room);
}

/// The same for some quads, from `first` on.
pub(super) fn refine_from<C: Connectivity, T: Components>(
    frame: &Frame<'_, C, T>,
    first: usize,
    interiors: &mut [T],
    room: usize,
) {
    par::chunks(interiors, room, Memory::default, |memory, f, points| {
        dispatch(Refine { frame, face: FaceId((first + f) as u32), points, memory });
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
    frame: &'a Frame<'a, C, T>,
    face: FaceId,
    points: &'a mut [T],
    memory: &'a mut Memory<T>,
}

impl<C: Connectivity, T: Components> Kernel for Refine<'_, C, T> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Refine { frame, face, points, memory } = self;
        let n = frame.side;
        let width = 2 * n - 1;
        memory.row.resize(n + 1, T::zero());
        memory.rows.resize((n + 1) * width, T::zero());
        for (i, out) in memory.rows.chunks_exact_mut(width).enumerate() {
            frame.row(face, i, &points[..(n - 1) * (n - 1)], &mut memory.row);
            along(&memory.row, out);
        }
        let rows: &[f64] = cast_slice(&memory.rows);
        let width = width * T::COUNT;
        let row = |m: usize| &rows[m * width..(m + 1) * width];
        let out: &mut [f64] = cast_slice_mut(&mut points[..(2 * n - 1) * (2 * n - 1)]);
        let (pairs, last) = out.split_at_mut(2 * (n - 1) * width);
        for (m, pair) in pairs.chunks_exact_mut(2 * width).enumerate() {
            let (first, second) = pair.split_at_mut(width);
            edge_row([row(m), row(m + 1)], first);
            vertex_row([row(m), row(m + 1), row(m + 2)], second);
        }
        edge_row([row(n - 1), row(n)], last);
    }
}
