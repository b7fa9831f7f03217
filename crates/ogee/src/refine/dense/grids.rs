//! `Frame` and `Grids`: the points of a level of grids, and where to find them.

use crate::math::Components;
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId, VertexId};

/// Corners and sides of grids of `side` cells a side, at least 2, over the quads of `base`.
pub(crate) struct Frame<'a, C, T> {
    pub(crate) base: C,
    pub(crate) side: usize,
    /// At the base level's vertices.
    pub(crate) corners: &'a [T],
    /// Inside edges, `side - 1` each, from the origin of the edge's smaller halfedge.
    pub(crate) sides: &'a [T],
}

/// A frame, and the points inside each quad, row after row.
pub(crate) struct Grids<'a, C, T> {
    pub(crate) frame: Frame<'a, C, T>,
    pub(crate) interiors: &'a [T],
}

impl<C: Connectivity, T: Components> Frame<'_, C, T> {
    /// The points inside an edge, in the order of the halfedge.
    #[inline(always)]
    pub(crate) fn side(&self, h: HalfedgeId) -> Side<'_, T> {
        let edge = self.base.edge(h);
        let count = self.side - 1;
        Side { points: &self.sides[edge.index() * count..][..count], reversed: self.base.side(edge) != h }
    }

    /// The first point inside a halfedge's edge.
    #[inline(always)]
    pub(crate) fn first(&self, h: HalfedgeId) -> T {
        self.side(h).at(1)
    }

    /// The last point inside a halfedge's edge.
    #[inline(always)]
    pub(crate) fn last(&self, h: HalfedgeId) -> T {
        self.side(h).at(self.side - 1)
    }

    /// The points of a halfedge's edge, its ends included.
    pub(crate) fn whole_side(&self, h: HalfedgeId, out: &mut Vec<T>) {
        let n = self.side;
        out.resize(n + 1, T::zero());
        self.side(h).copy(false, &mut out[1..n]);
        (out[0], out[n]) = (self.corner(self.base.origin(h)), self.corner(self.base.target(h)));
    }

    /// The corner at a vertex of the base level.
    #[inline(always)]
    pub(crate) fn corner(&self, v: VertexId) -> T {
        self.corners[v.index()]
    }
}

/// The points inside an edge as a halfedge meets them.
#[derive(Clone, Copy)]
pub(crate) struct Side<'a, T> {
    points: &'a [T],
    reversed: bool,
}

impl<T: Components> Side<'_, T> {
    /// Point `t`, from 1 on.
    #[inline(always)]
    pub(crate) fn at(self, t: usize) -> T {
        self.points[if self.reversed { self.points.len() - t } else { t - 1 }]
    }

    /// All of them, or all in the other order.
    #[inline(always)]
    pub(crate) fn copy(self, backwards: bool, out: &mut [T]) {
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
    pub(crate) fn interior(&self, f: FaceId) -> &[T] {
        let count = (self.frame.side - 1) * (self.frame.side - 1);
        &self.interiors[f.index() * count..][..count]
    }

    /// The point inside the face that is next to the origin of the halfedge.
    #[inline(always)]
    pub(crate) fn beside(&self, h: HalfedgeId) -> T {
        self.interior(self.frame.base.face(h))[self.row_beside(h).0]
    }

    /// Adds `weight` times the row of a face next to one of its halfedges, from edge to edge: against the halfedge if
    /// `backwards`.
    #[inline(always)]
    pub(crate) fn add_row_beside(&self, h: HalfedgeId, backwards: bool, weight: f64, out: &mut [T]) {
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

    /// A whole row of [`Grids::add_row_beside`] along the halfedge.
    pub(crate) fn row_beside_whole(&self, h: HalfedgeId, out: &mut Vec<T>) {
        out.clear();
        out.resize(self.frame.side + 1, T::zero());
        self.add_row_beside(h, false, 1.0, out);
    }

    /// The whole grid of a quad, its sides included, row after row.
    pub(crate) fn closed(&self, f: FaceId, out: &mut Vec<T>) {
        let n = self.frame.side;
        out.resize((n + 1) * (n + 1), T::zero());
        for (i, row) in out.chunks_exact_mut(n + 1).enumerate() {
            self.row(f, i, row);
        }
    }

    /// Row `i` of a quad's grid, along v, from side to side.
    #[inline(always)]
    pub(crate) fn row(&self, f: FaceId, i: usize, row: &mut [T]) {
        let (frame, n, h) = (&self.frame, self.frame.side, 4 * f.0);
        let corner = |k: u32| frame.corner(frame.base.origin(HalfedgeId(h + k)));
        let side = |k: u32| frame.side(HalfedgeId(h + k));
        let inside = &mut row[1..n];
        if i == 0 {
            side(3).copy(true, inside);
            (row[0], row[n]) = (corner(0), corner(3));
        } else if i < n {
            inside.copy_from_slice(&self.interior(f)[(i - 1) * (n - 1)..i * (n - 1)]);
            (row[0], row[n]) = (side(0).at(i), side(2).at(n - i));
        } else {
            side(1).copy(false, inside);
            (row[0], row[n]) = (corner(1), corner(2));
        }
    }
}
