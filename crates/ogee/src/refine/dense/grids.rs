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

/// A frame, and what is inside.
pub(super) struct Grids<'a, C, T> {
    pub(super) frame: &'a Frame<'a, C, T>,
    /// `room` points for each quad, as many as the last level needs; those of this level stand in front, row after row.
    pub(super) interiors: &'a [T],
    pub(super) room: usize,
}

impl<C: Connectivity, T: Components> Frame<'_, C, T> {
    /// The points inside an edge, and true if they run against the halfedge.
    #[inline(always)]
    pub(super) fn side(&self, h: HalfedgeId) -> (&[T], bool) {
        let edge = self.base.edge(h);
        let count = self.side - 1;
        (&self.sides[edge.index() * count..][..count], self.base.side(edge) != h)
    }

    /// The first point inside a halfedge's edge.
    #[inline(always)]
    pub(super) fn first(&self, h: HalfedgeId) -> T {
        let (points, reversed) = self.side(h);
        points[if reversed { points.len() - 1 } else { 0 }]
    }

    /// The last point inside a halfedge's edge.
    #[inline(always)]
    pub(super) fn last(&self, h: HalfedgeId) -> T {
        let (points, reversed) = self.side(h);
        points[if reversed { 0 } else { points.len() - 1 }]
    }

    /// The corner at a vertex of the base level.
    #[inline(always)]
    pub(super) fn corner(&self, v: VertexId) -> T {
        self.corners[v.index()]
    }

    /// Row `i` of a quad's grid, along v, from side to side.
    #[inline(always)]
    pub(super) fn row(&self, f: FaceId, i: usize, interior: &[T], out: &mut [T]) {
        let n = self.side;
        let h = [0, 1, 2, 3].map(|k| HalfedgeId(4 * f.0 + k));
        if i == 0 || i == n {
            // Against the last halfedge, or along the second.
            let (h, against) = if i == 0 { (h[3], true) } else { (h[1], false) };
            let (points, reversed) = self.side(h);
            out[1..n].copy_from_slice(points);
            let [from, to] = [self.base.origin(h), self.base.target(h)].map(|v| self.corner(v));
            [out[0], out[n]] = if against { [to, from] } else { [from, to] };
            if reversed != against {
                out[1..n].reverse();
            }
            return;
        }
        let at = |h: HalfedgeId, t: usize| {
            let (points, reversed) = self.side(h);
            points[if reversed { n - 1 - t } else { t - 1 }]
        };
        out[0] = at(h[0], i);
        out[1..n].copy_from_slice(&interior[(i - 1) * (n - 1)..i * (n - 1)]);
        out[n] = at(h[2], n - i);
    }
}

impl<C: Connectivity, T: Components> Grids<'_, C, T> {
    /// The points inside a quad, row after row.
    #[inline(always)]
    fn interior(&self, f: FaceId) -> &[T] {
        let count = self.frame.side - 1;
        &self.interiors[f.index() * self.room..][..count * count]
    }

    /// The point inside the face that is next to the origin of the halfedge.
    #[inline(always)]
    pub(super) fn beside(&self, h: HalfedgeId) -> T {
        self.interior(self.frame.base.face(h))[self.row_beside(h).0]
    }

    /// Point `m` of the row of a face next to one of its halfedges, `0 <= m <= side`; the first and the last are on edges.
    #[inline(always)]
    pub(super) fn beside_at(&self, h: HalfedgeId, m: usize) -> T {
        let base = self.frame.base;
        if m == 0 {
            return self.frame.last(base.prev(h));
        }
        if m == self.frame.side {
            return self.frame.first(base.next(h));
        }
        let (start, step) = self.row_beside(h);
        self.interior(base.face(h))[start.wrapping_add_signed((m as isize - 1) * step)]
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
