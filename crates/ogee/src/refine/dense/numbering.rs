//! Which vertex of the last level is where: closed formulas, from the base level's connectivity alone.

use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId, VertexId};

/// The vertices of grids of `side` cells a side over the quads of a base level with `V` vertices and `F` faces, `M = side - 1`:
///
/// ```text
/// [0, V)                corners, as in the base level
/// V + f M^2 + ..        inside quad f: (i, j) at (i - 1) M + (j - 1), 0 < i, j < side, i along u, j along v
/// V + F M^2 + e M + ..  inside edge e: t at t - 1, 0 < t < side, from the origin of the edge's smaller halfedge
/// ```
///
/// With `side` 2 that is the numbering of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Numbering {
    pub(crate) vertices: usize,
    pub(crate) faces: usize,
    pub(crate) edges: usize,
    pub(crate) side: usize,
}

impl Numbering {
    pub(crate) fn new(base: &impl Connectivity, side: usize) -> Numbering {
        Numbering { vertices: base.vertex_count(), faces: base.face_count(), edges: base.edge_count(), side }
    }

    /// Points inside one edge.
    pub(crate) fn per_edge(&self) -> usize {
        self.side - 1
    }

    /// Points inside one quad.
    pub(crate) fn per_face(&self) -> usize {
        (self.side - 1) * (self.side - 1)
    }

    /// All points.
    pub(crate) fn count(&self) -> usize {
        self.edge_start() + self.edges * self.per_edge()
    }

    /// Where points inside edges begin.
    pub(crate) fn edge_start(&self) -> usize {
        self.vertices + self.faces * self.per_face()
    }

    /// The number of point `t` of a halfedge, `0 <= t <= side`, from its origin.
    fn on_halfedge(&self, base: &impl Connectivity, h: HalfedgeId, t: usize) -> u32 {
        if t == 0 {
            return base.origin(h).0;
        }
        if t == self.side {
            return base.target(h).0;
        }
        let edge = base.edge(h);
        let along = if base.side(edge) == h { t - 1 } else { self.side - 1 - t };
        (self.edge_start() + edge.index() * self.per_edge() + along) as u32
    }

    /// The numbers of row `i` of quad `f`: `side + 1` of them, along v.
    pub(crate) fn row(&self, base: &impl Connectivity, f: FaceId, i: usize, out: &mut [u32]) {
        let n = self.side;
        let h = [0, 1, 2, 3].map(|k| HalfedgeId(4 * f.0 + k));
        if i == 0 {
            out.iter_mut().enumerate().for_each(|(j, id)| *id = self.on_halfedge(base, h[3], n - j));
        } else if i == n {
            out.iter_mut().enumerate().for_each(|(j, id)| *id = self.on_halfedge(base, h[1], j));
        } else {
            let first = (self.vertices + f.index() * self.per_face() + (i - 1) * (n - 1)) as u32;
            out[0] = self.on_halfedge(base, h[0], i);
            for (id, j) in out[1..n].iter_mut().zip(0..) {
                *id = first + j;
            }
            out[n] = self.on_halfedge(base, h[2], n - i);
        }
    }

    /// The quads over quad `f`, `side^2` of them: cell `(i, j)` at `i side + j`, from its corner `(i, j)` on along u.
    pub(crate) fn quads(
        &self,
        base: &impl Connectivity,
        f: FaceId,
        rows: &mut [Vec<u32>; 2],
        out: &mut [[u32; 4]],
    ) {
        let [low, high] = rows;
        low.resize(self.side + 1, 0);
        high.resize(self.side + 1, 0);
        self.row(base, f, 0, low);
        for (i, cells) in out.chunks_exact_mut(self.side).enumerate() {
            self.row(base, f, i + 1, high);
            for (cell, (low, high)) in cells.iter_mut().zip(low.windows(2).zip(high.windows(2))) {
                *cell = [low[0], high[0], high[1], low[1]];
            }
            std::mem::swap(low, high);
        }
    }
}

/// The halfedge from one vertex to another that is around it.
pub(super) fn spoke(base: &impl Connectivity, from: VertexId, to: VertexId) -> Option<Spoke> {
    base.ring(from).find_map(|h| {
        let before = base.prev(h);
        if base.target(h) == to {
            Some(Spoke::Leaving(h))
        } else if base.origin(before) == to {
            Some(Spoke::Arriving(before))
        } else {
            None
        }
    })
}

/// An edge at a vertex, by a halfedge.
#[derive(Clone, Copy, Debug)]
pub(super) enum Spoke {
    Leaving(HalfedgeId),
    Arriving(HalfedgeId),
}
