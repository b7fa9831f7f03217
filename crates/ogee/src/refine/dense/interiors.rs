//! The points inside quads: a grid is refined within its own place.

use bytemuck::{cast_slice, cast_slice_mut};

use super::grids::Frame;
use super::kernel::{along, edge_row, vertex_row};
use crate::math::simd::{Four, Kernel, dispatch};
use crate::math::{Components, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};

/// Refines the insides of all quads, `room` points for each, from `frame.side` cells a side to twice as many.
pub(super) fn refine<C: Connectivity, T: Components>(
    frame: &Frame<'_, C, T>,
    interiors: &mut [T],
    room: usize,
) {
    par::chunks(interiors, room, Memory::default, |memory, f, points| {
        dispatch(Refine { frame, face: FaceId(f as u32), points, memory });
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
        let halfedges = [0, 1, 2, 3].map(|k| HalfedgeId(4 * face.0 + k));
        let corners = halfedges.map(|h| frame.corner(frame.base.origin(h)));
        let sides = halfedges.map(|h| frame.side(h));
        let mut rows = memory.rows.chunks_exact_mut(width);
        let row = &mut memory.row[..n + 1];
        let mut refine = |row: &[T]| {
            if let Some(out) = rows.next() {
                along(row, out);
            }
        };
        row[0] = corners[0];
        sides[3].copy(true, &mut row[1..n]);
        row[n] = corners[3];
        refine(row);
        for (i, inside) in (1..n).zip(points.chunks_exact(n - 1)) {
            row[0] = sides[0].at(i);
            row[1..n].copy_from_slice(inside);
            row[n] = sides[2].at(n - i);
            refine(row);
        }
        row[0] = corners[1];
        sides[1].copy(false, &mut row[1..n]);
        row[n] = corners[2];
        refine(row);
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
