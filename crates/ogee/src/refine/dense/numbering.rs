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

    /// At corners, inside quads, inside edges.
    pub(super) fn parts<'a, T>(&self, points: &'a [T]) -> [&'a [T]; 3] {
        let (corners, rest) = points.split_at(self.vertices);
        let (interiors, sides) = rest.split_at(self.faces * self.per_face());
        [corners, interiors, sides]
    }

    /// The numbers on a halfedge from its origin to its target, and how to reach those between.
    #[inline(always)]
    fn side(&self, base: &impl Connectivity, h: HalfedgeId) -> Side {
        let edge = base.edge(h);
        let start = (self.edge_start() + edge.index() * self.per_edge()) as u32;
        let along = base.side(edge) == h;
        Side {
            origin: base.origin(h).0,
            before: if along { start.wrapping_sub(1) } else { start + self.per_edge() as u32 },
            step: if along { 1 } else { 1_u32.wrapping_neg() },
        }
    }

    /// The quads over quad `f`, `side^2` of them: cell `(i, j)` at `i side + j`, from its corner `(i, j)` on along u.
    #[inline(always)]
    pub(crate) fn quads(
        &self,
        base: &impl Connectivity,
        f: FaceId,
        rows: &mut [Vec<u32>; 2],
        out: &mut [[u32; 4]],
    ) {
        let n = self.side;
        let side = |k: u32| self.side(base, HalfedgeId(4 * f.0 + k));
        let sides = [side(0), side(1), side(2), side(3)];
        let inside = (self.vertices + f.index() * self.per_face()) as u32;
        if n == 2 {
            let [a, b, c, d] = sides.map(|side| side.origin);
            let [ab, bc, cd, da] = sides.map(|side| side.at(1));
            out.copy_from_slice(&[
                [a, ab, inside, da],
                [da, inside, cd, d],
                [ab, b, bc, inside],
                [inside, bc, c, cd],
            ]);
            return;
        }
        let [low, high] = rows;
        low.resize(n + 1, 0);
        high.resize(n + 1, 0);
        low[0] = sides[0].origin;
        low[n] = sides[3].origin;
        (1..n).for_each(|j| low[j] = sides[3].at(n - j));
        for (i, cells) in (1..=n).zip(out.chunks_exact_mut(n)) {
            if i < n {
                high[0] = sides[0].at(i);
                let first = inside + ((i - 1) * (n - 1)) as u32;
                high[1..n].iter_mut().zip(first..).for_each(|(id, number)| *id = number);
                high[n] = sides[2].at(n - i);
            } else {
                high[0] = sides[1].origin;
                high[n] = sides[2].origin;
                (1..n).for_each(|j| high[j] = sides[1].at(j));
            }
            let [from, to] = [&low[..n + 1], &high[..n + 1]];
            for j in 0..n {
                cells[j] = [from[j], to[j], to[j + 1], from[j + 1]];
            }
            std::mem::swap(low, high);
        }
    }
}

/// The numbers along a halfedge.
#[derive(Clone, Copy, Debug)]
struct Side {
    origin: u32,
    /// One step before the first number inside.
    before: u32,
    step: u32,
}

impl Side {
    /// The number of point `t`, `0 < t < side`.
    #[inline(always)]
    fn at(self, t: usize) -> u32 {
        self.before.wrapping_add(self.step.wrapping_mul(t as u32))
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
