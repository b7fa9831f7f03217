//! The layered net of a quad, and knot insertion: from the nodes of the refined mesh to the coefficients of a patch.
//!
//! A quad of the base mesh holds `m x m` cells, `m = 2^level`. Its patch has the domain `[0, m]^2`. Everything at a
//! corner is written in that corner's own view, in which the corner is at `(0, 0)`.

use super::Layer;
use crate::math::{Grid, Vec3};
use crate::mesh::{HalfedgeId, Topology, VertexId};
use crate::nurbs::KnotVector;
use crate::rules::Level;

/// Position in an array of side `last + 1` of what corner `k` sees at `(a, b)`: `a` along the side that leaves the
/// corner, `b` along the one that reaches it.
#[inline]
pub(crate) fn view(k: usize, a: usize, b: usize, last: usize) -> (usize, usize) {
    match k {
        0 => (a, b),
        1 => (last - b, a),
        2 => (last - a, last - b),
        _ => (b, last - a),
    }
}

/// Knots of a patch in cells, the same in `u` and `v`.
pub(crate) fn knots(layer: Layer, level: u32) -> KnotVector {
    let m = 1usize << level;
    let doubled = |j: usize| {
        let from_end = j.min(m - j);
        match layer {
            Layer::First => from_end == 1,
            Layer::Second => from_end == 1 || from_end == 2,
        }
    };
    let inner = (1..m).map(|j| (j as f64, if doubled(j) { 2 } else { 1 }));
    KnotVector::from_multiplicities(3, std::iter::once((0.0, 4)).chain(inner).chain([(m as f64, 4)]))
}

/// One row of the insertion matrix: up to three nodes, `-1..=m + 1` counted from 0, with their weights.
type InsertionRow = Vec<(usize, f64)>;

/// The matrix that takes uniform nodes to the coefficients over the given knots: the polar form at three consecutive
/// knots.
fn insertion(knots: &KnotVector) -> Vec<InsertionRow> {
    let rows = knots.knots()[1..].windows(3).take(knots.coefficients());
    rows.map(|triple| {
        // Node j stands at j + 1: the layer before the first node counts.
        let at = |knot: f64| knot as usize + 1;
        let (first, middle, last) = (at(triple[0]), at(triple[1]), at(triple[2]));
        if first == last {
            vec![(first - 1, 1.0 / 6.0), (first, 4.0 / 6.0), (first + 1, 1.0 / 6.0)]
        } else if first == middle {
            vec![(first, 2.0 / 3.0), (last, 1.0 / 3.0)]
        } else if middle == last {
            vec![(first, 1.0 / 3.0), (last, 2.0 / 3.0)]
        } else {
            vec![(middle, 1.0)]
        }
    })
    .collect()
}

/// Where the cells of a base quad are on the refined level.
pub(crate) struct Cells<'a> {
    base: &'a Level,
    fine: &'a Topology,
    level: u32,
    /// For each cell `(i, j)`: its number within the quad, and by how many corners it is turned.
    template: Grid<(u32, u32)>,
}

impl<'a> Cells<'a> {
    /// `fine` is the base refined `level` times; the base has quads only.
    pub(crate) fn new(base: &'a Level, fine: &'a Level, level: u32) -> Cells<'a> {
        let side = 1usize << level;
        let template = Grid::from_fn(side, side, |i, j| {
            (0..level).rev().fold((0, 0), |(number, turns), bit| {
                let corner = match (i >> bit & 1, j >> bit & 1) {
                    (0, 0) => 0,
                    (1, 0) => 1,
                    (1, 1) => 2,
                    _ => 3,
                };
                (4 * number + (corner + 4 - turns) % 4, corner)
            })
        });
        Cells { base, fine: fine.topology(), level, template }
    }

    /// The face of the refined level at cell `(i, j)`.
    pub(crate) fn face(&self, quad: u32, i: usize, j: usize) -> u32 {
        (quad << (2 * self.level)) + self.template[(i, j)].0
    }

    /// By how many corners the face at cell `(i, j)` is turned against its quad.
    pub(crate) fn turns(&self, i: usize, j: usize) -> u32 {
        self.template[(i, j)].1
    }

    /// The halfedge of the refined level that leaves corner `corner` (in the base quad's frame) of a cell.
    pub(crate) fn halfedge(&self, quad: u32, (i, j): (usize, usize), corner: usize) -> HalfedgeId {
        let turns = self.template[(i, j)].1;
        HalfedgeId(4 * self.face(quad, i, j) + (corner as u32 + 4 - turns) % 4)
    }

    /// The layered net of a quad: its nodes `0..=m` at `1..=m + 1`, with one layer around them.
    pub(crate) fn layered_net(&self, quad: u32, points: &[Vec3]) -> Grid<Vec3> {
        let m = 1usize << self.level;
        let at = |v: VertexId| points[v.index()];
        let mut net = Grid::from_fn(m + 3, m + 3, |i, j| {
            if i == 0 || j == 0 || i == m + 2 || j == m + 2 {
                return Vec3::ZERO;
            }
            let (i, j) = (i - 1, j - 1);
            let cell = (i.min(m - 1), j.min(m - 1));
            let corner = match (i - cell.0, j - cell.1) {
                (0, 0) => 0,
                (1, 0) => 1,
                (1, 1) => 2,
                _ => 3,
            };
            at(self.fine.origin(self.halfedge(quad, cell, corner)))
        });
        let last = m + 2;
        for k in 0..4 {
            let sharp = self.base.is_sharp(HalfedgeId(4 * quad + k as u32));
            for t in 0..=m {
                let outside = if sharp {
                    2.0 * net[view(k, t + 1, 1, last)] - net[view(k, t + 1, 2, last)]
                } else {
                    let side = self.halfedge(quad, view(k, t.min(m - 1), 0, m - 1), k);
                    let Some(across) = self.fine.twin(side) else {
                        unreachable!("a smooth edge has two sides")
                    };
                    // The side runs against us over there: its end is where we start.
                    at(if t < m {
                        self.fine.target(self.fine.next(across))
                    } else {
                        self.fine.origin(self.fine.prev(across))
                    })
                };
                net[view(k, t + 1, 0, last)] = outside;
            }
        }
        for k in 0..4 {
            net[view(k, 0, 0, last)] = self.outer_corner(quad, k, &net, points);
        }
        net
    }

    /// The node diagonally outside corner `k`. At an irregular corner there is none, and none is needed: only the
    /// corner coefficient would use it, and that is overwritten.
    fn outer_corner(&self, quad: u32, k: usize, net: &Grid<Vec3>, points: &[Vec3]) -> Vec3 {
        let last = net.rows() - 1;
        let before = 4 * quad + (k as u32 + 3) % 4;
        if self.base.is_sharp(HalfedgeId(4 * quad + k as u32)) {
            return 2.0 * net[view(k, 0, 1, last)] - net[view(k, 0, 2, last)];
        }
        if self.base.is_sharp(HalfedgeId(before)) {
            return 2.0 * net[view(k, 1, 0, last)] - net[view(k, 2, 0, last)];
        }
        let m = 1usize << self.level;
        let h = self.halfedge(quad, view(k, 0, 0, m - 1), k);
        match self.fine.ring(self.fine.origin(h)).collect::<Vec<_>>()[..] {
            [a, b, c, d] if !self.fine.is_boundary(self.fine.origin(h)) => {
                let ring = [a, b, c, d];
                let own = ring.iter().position(|&other| other == h).unwrap_or(0);
                let opposite = ring[(own + 2) % 4];
                points[self.fine.target(self.fine.next(opposite)).index()]
            }
            _ => Vec3::ZERO,
        }
    }
}

/// The coefficients over two knot vectors, in cells, of a surface with uniform nodes: one layer of nodes lies outside.
pub(crate) fn inserted(u: &KnotVector, v: &KnotVector, net: &Grid<Vec3>) -> Grid<Vec3> {
    let (rows, columns) = (insertion(u), insertion(v));
    let along = |row: &InsertionRow, at: &dyn Fn(usize) -> Vec3| {
        row.iter().fold(Vec3::ZERO, |sum, &(node, weight)| sum + weight * at(node))
    };
    let half = Grid::from_fn(rows.len(), net.cols(), |i, j| along(&rows[i], &|node| net[(node, j)]));
    Grid::from_fn(rows.len(), columns.len(), |i, j| along(&columns[j], &|node| half[(i, node)]))
}

/// Knot insertion: `K P K^T`, before any smoothing.
pub(crate) struct Insertion {
    rows: Vec<InsertionRow>,
}

impl Insertion {
    pub(crate) fn new(knots: &KnotVector) -> Insertion {
        Insertion { rows: insertion(knots) }
    }

    /// The coefficients of one patch from its layered net.
    pub(crate) fn apply(&self, net: &Grid<Vec3>) -> Grid<Vec3> {
        let along = |row: &InsertionRow, at: &dyn Fn(usize) -> Vec3| {
            row.iter().fold(Vec3::ZERO, |sum, &(node, weight)| sum + weight * at(node))
        };
        let half =
            Grid::from_fn(self.rows.len(), net.cols(), |i, j| along(&self.rows[i], &|node| net[(node, j)]));
        Grid::from_fn(self.rows.len(), self.rows.len(), |i, j| along(&self.rows[j], &|node| half[(i, node)]))
    }
}
