//! `Frame` and `Grids`: the points of a level of grids, and where to find them.

use crate::math::Components;
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId, VertexId};

/// Corners and sides of grids of `side` cells a side, at least 2, over the quads of `base`.
pub(super) struct Frame<'a, C, T> {
    pub(super) base: &'a C,
    pub(super) side: usize,
    /// At the base level's vertices.
    pub(super) corners: &'a [T],
    /// Inside edges, `side - 1` each, from the origin of the edge's smaller halfedge.
    pub(super) sides: &'a [T],
}

/// A frame, and the points inside each quad, row after row.
pub(super) struct Grids<'a, C, T> {
    pub(super) frame: Frame<'a, C, T>,
    pub(super) interiors: &'a [T],
}

impl<C: Connectivity, T: Components> Frame<'_, C, T> {
    /// The points inside an edge, in the order of the halfedge.
    #[inline(always)]
    pub(super) fn side(&self, h: HalfedgeId) -> Side<'_, T> {
        let edge = self.base.edge(h);
        let count = self.side - 1;
        Side { points: &self.sides[edge.index() * count..][..count], reversed: self.base.side(edge) != h }
    }

    /// The first point inside a halfedge's edge.
    #[inline(always)]
    pub(super) fn first(&self, h: HalfedgeId) -> T {
        self.side(h).at(1)
    }

    /// The last point inside a halfedge's edge.
    #[inline(always)]
    pub(super) fn last(&self, h: HalfedgeId) -> T {
        self.side(h).at(self.side - 1)
    }

    /// The corner at a vertex of the base level.
    #[inline(always)]
    pub(super) fn corner(&self, v: VertexId) -> T {
        self.corners[v.index()]
    }
}

/// The points inside an edge as a halfedge meets them.
#[derive(Clone, Copy)]
pub(super) struct Side<'a, T> {
    points: &'a [T],
    reversed: bool,
}

impl<T: Components> Side<'_, T> {
    /// Point `t`, from 1 on.
    #[inline(always)]
    pub(super) fn at(self, t: usize) -> T {
        self.points[if self.reversed { self.points.len() - t } else { t - 1 }]
    }

    /// All of them, or all in the other order.
    #[inline(always)]
    pub(super) fn copy(self, backwards: bool, out: &mut [T]) {
        if self.reversed == backwards {
            out.copy_from_slice(self.points);
        } else {
            out.iter_mut().zip(self.points.iter().rev()).for_each(|(out, point)| *out = *point);
        }
    }
}

impl<C: Connectivity, T: Components> Grids<'_, C, T> {
    /// The points inside a quad, row after row.
    #[inline(always)]
    pub(super) fn interior(&self, f: FaceId) -> &[T] {
        let count = (self.frame.side - 1) * (self.frame.side - 1);
        &self.interiors[f.index() * count..][..count]
    }

    /// The point inside the face that is next to the origin of the halfedge.
    #[inline(always)]
    pub(super) fn beside(&self, h: HalfedgeId) -> T {
        self.interior(self.frame.base.face(h))[self.row_beside(h).0]
    }

    /// Adds `weight` times the row of a face next to one of its halfedges, from edge to edge: against the halfedge if
    /// `backwards`.
    #[inline(always)]
    pub(super) fn add_row_beside(&self, h: HalfedgeId, backwards: bool, weight: f64, out: &mut [T]) {
        let (frame, n) = (&self.frame, self.frame.side);
        let ends = [frame.last(frame.base.prev(h)), frame.first(frame.base.next(h))];
        let (first, step) = self.row_beside(h);
        let inside = self.interior(frame.base.face(h));
        let (mut at, step) = if backwards {
            (first.wrapping_add_signed((n as isize - 2) * step), -step)
        } else {
            (first, step)
        };
        out[0].add_scaled(weight, &ends[usize::from(backwards)]);
        for point in &mut out[1..n] {
            point.add_scaled(weight, &inside[at]);
            at = at.wrapping_add_signed(step);
        }
        out[n].add_scaled(weight, &ends[usize::from(!backwards)]);
    }

    /// Where the row of points inside a face next to one of its halfedges begins, and the step to the next one.
    #[inline(always)]
    fn row_beside(&self, h: HalfedgeId) -> (usize, isize) {
        let count = self.frame.side - 1;
        match h.0 % 4 {
            0 => (0, count as isize),
            1 => ((count - 1) * count, 1),
            2 => (count * count - 1, -(count as isize)),
            _ => (count - 1, -1),
        }
    }
}
