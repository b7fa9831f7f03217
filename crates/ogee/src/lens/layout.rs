//! The w-plane: which point of a lens's neighbourhood has which number.
//!
//! A regular grid of quads on the plane of `w = u + i v`, with `w` and `-w` glued, is the mesh around a vertex of valence 2;
//! `z = w^2` unfolds it. So the points around a lens are an even function on the grid, and layer `k`, where `max(|i|, |j|) = k`,
//! holds `4 k` of them. In the bi-3 net grid points are the integers and the vertex itself has number 0; in the bi-4 net they
//! are the half integers, counted in halves, and there is no centre.
//!
//! ```text
//!  j
//!  3 | 19  18  17  16      the first quadrant of w, the upper half of z;
//!  2 |  9   8   7  15      the second is the same picture turned by 90 degrees,
//!  1 |  3   2   6  14      and begins with the column i = 0
//!  0 |  0   1   5  13
//!    +----------------- i
//! ```

use super::Obstacle;
use crate::mesh::{FaceId, HalfedgeId, Topology, Valence, VertexId};

/// Points of a bi-3 net with three layers, the lens vertex included.
pub const BICUBIC_POINTS: usize = 25;

/// The number of grid point `(i, j)`, which is that of `(-i, -j)` too: 0 in the centre, then layer by layer, counter-clockwise
/// from `(k, 0)`.
pub fn lattice_index(i: i32, j: i32) -> usize {
    let (i, j) = if j < 0 || (j == 0 && i < 0) { (-i, -j) } else { (i, j) };
    let k = i.abs().max(j);
    if k == 0 {
        return 0;
    }
    let along = |a: i32, b: i32| if a == k { b } else { 2 * k - a };
    let turn = if i > 0 { along(i, j) } else { 2 * k + along(j, -i) };
    (1 + 2 * k * (k - 1) + turn) as usize
}

/// The grid point `(i, j)` of a number, with `j > 0`, or `j = 0` and `i >= 0`.
pub fn lattice_point(index: usize) -> (i32, i32) {
    let Some(beyond_centre) = index.checked_sub(1) else { return (0, 0) };
    let mut k = 1;
    while 2 * k * (k + 1) <= beyond_centre {
        k += 1;
    }
    let turn = (beyond_centre - 2 * k * (k - 1)) as i32;
    let k = k as i32;
    let quadrant = |turn: i32| if turn <= k { (k, turn) } else { (2 * k - turn, k) };
    if turn < 2 * k {
        quadrant(turn)
    } else {
        let (a, b) = quadrant(turn - 2 * k);
        (-b, a)
    }
}

/// A half of the surface around a lens: a quadrant of the w-plane, half a plane of `z`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quadrant {
    /// Where `u` and `v` are positive: from point 1 by point 2 to point 3.
    First,
    /// The first, turned by 90 degrees: from point 3 by point 4 to point 1.
    Second,
}

impl Quadrant {
    /// Both, in order.
    pub const BOTH: [Quadrant; 2] = [Quadrant::First, Quadrant::Second];

    /// 0 or 1.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The grid point at `(a, b)` of the quadrant.
    pub fn point(self, a: i32, b: i32) -> (i32, i32) {
        match self {
            Quadrant::First => (a, b),
            Quadrant::Second => (-b, a),
        }
    }
}

/// A symmetry of the grid, and what it does to `z = w^2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Nothing.
    Identity,
    /// `(i, j)` to `(-j, i)`: half a turn of `z`.
    Rotation,
    /// `(i, j)` to `(j, i)`: `x` changes its sign.
    MirrorX,
    /// `(i, j)` to `(i, -j)`: `y` changes its sign.
    MirrorY,
}

impl Symmetry {
    /// The number of the image of a point.
    pub fn image(self, index: usize) -> usize {
        let (i, j) = lattice_point(index);
        match self {
            Symmetry::Identity => index,
            Symmetry::Rotation => lattice_index(-j, i),
            Symmetry::MirrorX => lattice_index(j, i),
            Symmetry::MirrorY => lattice_index(i, -j),
        }
    }
}

/// The regular neighbourhood of a lens vertex: three layers of vertices and eighteen quads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LensNet {
    /// The vertices by their [number](lattice_index). Number 1 is the neighbour of the lens vertex with the lower id. Vertices of
    /// layers 0, 1 and 2 differ from one another; those of layer 3 need not.
    pub vertices: [VertexId; BICUBIC_POINTS],
    /// `cells[q][a][b]`: the halfedge that runs from `(a, b)` to `(a + 1, b)` in the quad `[a, a + 1] x [b, b + 1]` of quadrant
    /// `q`; in the second quadrant `(a, b)` means the grid point `(-b, a)`.
    pub cells: [[[HalfedgeId; 3]; 3]; 2],
}

impl LensNet {
    /// Walks the neighbourhood of an inner vertex with two faces. `None` if the vertex is no such vertex.
    ///
    /// # Errors
    /// The first thing in the way, layer by layer.
    pub fn new(topology: &Topology, vertex: VertexId) -> Option<Result<LensNet, Obstacle>> {
        let starts = lens_halfedges(topology, vertex)?;
        Some(walk(topology, vertex, starts))
    }

    /// The lens vertex.
    pub fn centre(&self) -> VertexId {
        self.vertices[0]
    }

    /// The quads of layer `k`, 1 to 3, which lie between the vertices of layers `k - 1` and `k`: the first quadrant's, then the second's.
    pub fn faces(&self, topology: &Topology, k: usize) -> Vec<FaceId> {
        let in_layer = move |&(a, b): &(usize, usize)| a.max(b) + 1 == k;
        let places = (0..3).flat_map(|a| (0..3).map(move |b| (a, b))).filter(in_layer).collect::<Vec<_>>();
        self.cells.iter().flat_map(|cells| places.iter().map(|&(a, b)| topology.face(cells[a][b]))).collect()
    }

    /// The eight quads inside layer 2: all that a bi-4 net stands in for.
    pub fn disk(&self, topology: &Topology) -> Vec<FaceId> {
        [self.faces(topology, 1), self.faces(topology, 2)].concat()
    }
}

/// The layer of a point of a net, by its number.
pub(super) fn layer(index: usize) -> u32 {
    let (i, j) = lattice_point(index);
    i.abs().max(j) as u32
}

/// The two halfedges that leave a lens vertex, first the one to the neighbour with the lower id. `None` if it is no lens vertex.
pub(super) fn lens_halfedges(topology: &Topology, vertex: VertexId) -> Option<[HalfedgeId; 2]> {
    if vertex.index() >= topology.vertex_count() || topology.valence(vertex) != Valence::Interior(2) {
        return None;
    }
    let first = topology.outgoing(vertex)?;
    let second = topology.twin(topology.prev(first))?;
    let in_order = topology.target(first) < topology.target(second);
    Some(if in_order { [first, second] } else { [second, first] })
}

/// What keeps a vertex from being an inner one of valence 4.
pub(super) fn irregularity(topology: &Topology, vertex: VertexId, layer: u32) -> Option<Obstacle> {
    match topology.valence(vertex) {
        Valence::Interior(4) => None,
        Valence::Interior(2) => Some(Obstacle::OtherLens { vertex, layer }),
        Valence::Interior(valence) => Some(Obstacle::Extraordinary { vertex, valence, layer }),
        Valence::Boundary(_) => Some(Obstacle::Boundary { vertex, layer }),
    }
}

/// The quad that a halfedge belongs to; other polygons are in the way.
pub(super) fn require_quad(topology: &Topology, h: HalfedgeId, layer: u32) -> Result<(), Obstacle> {
    let face = topology.face(h);
    if topology.face_size(face) == 4 { Ok(()) } else { Err(Obstacle::NotAQuad { face, layer }) }
}

fn walk(topology: &Topology, centre: VertexId, starts: [HalfedgeId; 2]) -> Result<LensNet, Obstacle> {
    let mut net = LensNet { vertices: [centre; BICUBIC_POINTS], cells: starts.map(|start| [[start; 3]; 3]) };
    for k in 1..=3 {
        for cells in &mut net.cells {
            extend(topology, cells, k)?;
        }
        net.fill_layer(topology, k);
        if k < 3 {
            let numbers = lattice_index(k as i32, 0)..lattice_index(k as i32 + 1, 0);
            let in_the_way = |n: usize| irregularity(topology, net.vertices[n], k as u32);
            if let Some(obstacle) = numbers.into_iter().find_map(in_the_way) {
                return Err(obstacle);
            }
        }
    }
    Ok(net)
}

/// Finds the cells of layer `k` of a quadrant from those of the layers inside it.
fn extend(topology: &Topology, cells: &mut [[HalfedgeId; 3]; 3], k: usize) -> Result<(), Obstacle> {
    let last = k - 1;
    let across = |h: HalfedgeId| {
        let boundary = Obstacle::Boundary { vertex: topology.origin(h), layer: last as u32 };
        topology.twin(h).ok_or(boundary)
    };
    if last > 0 {
        for b in 0..last {
            cells[last][b] = topology.next(across(topology.next(cells[last - 1][b]))?);
        }
        for a in 0..last {
            cells[a][last] = across(topology.next(topology.next(cells[a][last - 1])))?;
        }
    }
    for s in 0..last {
        require_quad(topology, cells[last][s], k as u32)?;
        require_quad(topology, cells[s][last], k as u32)?;
    }
    if last > 0 {
        cells[last][last] = across(topology.next(topology.next(cells[last][last - 1])))?;
    }
    require_quad(topology, cells[last][last], k as u32)
}

impl LensNet {
    /// Notes the vertices of layer `k`, whose cells are known.
    fn fill_layer(&mut self, topology: &Topology, k: usize) {
        for (quadrant, cells) in Quadrant::BOTH.into_iter().zip(&self.cells) {
            let mut note = |a: usize, b: usize, vertex: VertexId| {
                let (i, j) = quadrant.point(a as i32, b as i32);
                self.vertices[lattice_index(i, j)] = vertex;
            };
            let last = k - 1;
            for s in 0..k {
                note(k, s, topology.target(cells[last][s]));
                note(s + 1, k, topology.target(topology.next(cells[s][last])));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_points_are_each_others_inverse() {
        for index in 0..=60 {
            let (i, j) = lattice_point(index);
            assert_eq!(lattice_index(i, j), index);
            assert_eq!(lattice_index(-i, -j), index);
        }
    }

    #[test]
    fn symmetries_are_involutions_and_two_mirrors_make_half_a_turn() {
        for index in 0..=60 {
            for symmetry in [Symmetry::Rotation, Symmetry::MirrorX, Symmetry::MirrorY] {
                assert_eq!(symmetry.image(symmetry.image(index)), index);
            }
            let both = Symmetry::MirrorY.image(Symmetry::MirrorX.image(index));
            assert_eq!(both, Symmetry::Rotation.image(index));
        }
    }
}
