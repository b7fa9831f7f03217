//! A bi-4 lens as finitely many patches: some rings, and two patches that close the hole in them.
//!
//! The closing patches are those of the same spline over `[0, 1] x [0, 1]`, where a net has no coefficient in the centre. Whatever
//! that is, all joints are C2, for the spline is an even function; and at the lens, where the parameters are singular, `f = p + a u^2 + b v^2 + 2 c u v`
//! up to terms of order four. The centre is chosen so that `a = -b`, which makes this `p + a x + c y` with `x + i y = w^2`: a surface with a tangent
//! plane, and with bounded curvature. It is the mean of the points 2 and 4. How far the patches are from the limit falls by
//! the eigenvalue 0.0204 a ring.

use super::biquartic::{Biquartic, RingPatch, bezier_net};
use super::biquartic_surface::bezier;
use super::cap::{Cap, CapEdge, CapFace, CapVertex};
use super::layout::{LensNet, Quadrant, lattice_index};
use crate::math::{Grid, Vec3};
use crate::mesh::{FaceId, Topology, VertexId};
use crate::nurbs::{FaceAddress, Side};

/// Where in a cage a bi-4 lens is put.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CapSite {
    /// The vertices of layer 2, numbers 5 to 12, which are the outline.
    pub outline: [VertexId; 8],
    /// The faces inside, for each quadrant over `[0, 1] x [0, 1]`, `[1, 2] x [0, 1]`, `[1, 2] x [1, 2]` and `[0, 1] x [1, 2]`.
    pub pieces: [[FaceAddress; 4]; 2],
}

impl CapSite {
    /// The site of a net; `address` says how the faces are called.
    pub fn new(net: &LensNet, topology: &Topology, address: impl Fn(FaceId) -> FaceAddress) -> CapSite {
        let places = [[0, 0], [1, 0], [1, 1], [0, 1]];
        CapSite {
            outline: std::array::from_fn(|k| net.vertices[5 + k]),
            pieces: net.cells.map(|cells| places.map(|[a, b]| address(topology.face(cells[a][b])))),
        }
    }
}

impl Biquartic {
    /// The surface as `6 rings + 2` faces of degree (4, 4), each over the unit square; at least one ring is made. Ring by ring the
    /// patches of [`Biquartic::ring_patches`], at last the closing patches of both quadrants.
    ///
    /// All joints are C2, but for the lens itself, where tangent planes agree. The inner side of a ring patch has a vertex in its middle
    /// where the next ring has two patches. What is approximate are the closing patches: of a net of size 1 that was refitted they
    /// miss the limit by some 2e-9 after three rings and 3e-11 after four; of one that was not, by 6e-8 and 1e-9.
    pub fn cap(&self, rings: u32, site: &CapSite) -> Cap {
        let rings = rings.max(1);
        let mut cap = Cap::default();
        let mut net = self.clone();
        for ring in 0..rings {
            let patches = net.ring_patches();
            let corners = Corners { ring, rings, outline: &site.outline };
            if ring > 0 {
                cap.points.extend((5..13).map(|number| outline_point(&patches, number)));
            }
            if ring + 1 == rings {
                let closing = closing_patches(&net);
                cap.points.extend(closing.iter().flat_map(|net| [net[(4, 0)], net[(4, 4)]]));
                cap.points.push(closing[0][(0, 0)]);
                cap.faces.extend(patches.into_iter().map(|patch| corners.face(patch, site)));
                for (quadrant, net) in Quadrant::BOTH.into_iter().zip(closing) {
                    cap.faces.push(corners.closing_face(quadrant, net, site));
                }
                break;
            }
            cap.faces.extend(patches.into_iter().map(|patch| corners.face(patch, site)));
            net = net.step();
        }
        cap
    }
}

/// Bezier points of the patches that close the ring of a net, over the unit square inside it.
fn closing_patches(net: &Biquartic) -> [Grid<Vec3>; 2] {
    let centre = (net.point(2) + net.point(4)) / 2.0;
    let coefficient = |number: usize| if number == 0 { centre } else { net.point(number) };
    let mut nets = Quadrant::BOTH.map(|quadrant| bezier_net(quadrant, [0, 0], coefficient));
    // On the curves that both patches have for a side they are to have the same bits, which sums in another order would not give.
    for d in 0..5 {
        let [first, second] = [nets[0][(d, 0)], nets[1][(d, 0)]];
        nets[1][(0, d)] = first;
        nets[0][(0, d)] = second;
    }
    let lens = nets[0][(0, 0)];
    for net in &mut nets {
        for at in [(0, 0), (1, 0), (0, 1)] {
            net[at] = lens;
        }
    }
    nets
}

/// The corner of a ring at an outer grid point, numbers 5 to 12.
fn outline_point(ring: &[RingPatch; 6], number: usize) -> Vec3 {
    let at = number - 5;
    let (q, k) = (at / 4, at % 4);
    let (patch, corner) = [(0, (4, 0)), (0, (4, 4)), (1, (4, 4)), (2, (4, 4))][k];
    ring[3 * q + patch].net[corner]
}

/// The vertices of one ring: the next ring, or the closing patches, begin at its inner ones.
struct Corners<'a> {
    ring: u32,
    rings: u32,
    outline: &'a [VertexId; 8],
}

impl Corners<'_> {
    /// The vertex at a grid point of a quadrant, in half units of the ring: its outline has `max(i, j) = 4`, its inner side 2.
    fn vertex(&self, quadrant: Quadrant, i: i32, j: i32) -> CapVertex {
        let (ring, (i, j)) =
            if i.max(j) == 4 { (self.ring, (i / 2, j / 2)) } else { (self.ring + 1, (i, j)) };
        let (i, j) = quadrant.point(i, j);
        let number = lattice_index(i, j) as u32;
        match ring {
            0 => CapVertex::Cage(self.outline[number as usize - 5]),
            ring if ring == self.rings => {
                // The closing patches have corners alone there: numbers 5, 7, 9 and 11.
                CapVertex::Own(8 * (ring - 1) + (number - 5) / 2)
            }
            ring => CapVertex::Own(8 * (ring - 1) + number - 5),
        }
    }

    fn pole(&self) -> CapVertex {
        CapVertex::Own(8 * (self.rings - 1) + 4)
    }

    fn face(&self, patch: RingPatch, site: &CapSite) -> CapFace {
        let RingPatch { quadrant, cell: [a, b], net } = patch;
        let is_last = self.ring + 1 == self.rings;
        let (i, j) = (2 * a as i32, 2 * b as i32);
        let corners = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)];
        let mut boundary = Vec::with_capacity(5);
        for (k, side) in SIDES.into_iter().enumerate() {
            let [from, to] = [corners[k], corners[(k + 1) % 4]];
            let is_inner = from.0.max(from.1) == 2 && to.0.max(to.1) == 2;
            let vertices = [from, to].map(|(i, j)| self.vertex(quadrant, i, j));
            if is_inner && !is_last {
                let middle = self.vertex(quadrant, (from.0 + to.0) / 2, (from.1 + to.1) / 2);
                boundary.extend(edge_in_halves(side, vertices, middle));
            } else {
                boundary.push(whole_edge(side, vertices));
            }
        }
        let place = if self.ring > 0 { 0 } else { [[0, 3], [1, 2]][a][b] };
        let pieces = Grid::from_fn(1, 1, |_, _| site.pieces[quadrant.index()][place]);
        CapFace { surface: bezier(net), boundary, pieces }
    }

    fn closing_face(&self, quadrant: Quadrant, net: Grid<Vec3>, site: &CapSite) -> CapFace {
        let vertex = |i: i32, j: i32| self.vertex(quadrant, i, j);
        let corners = [self.pole(), vertex(2, 0), vertex(2, 2), vertex(0, 2)];
        let edge = |k: usize| whole_edge(SIDES[k], [corners[k], corners[(k + 1) % 4]]);
        let pieces = Grid::from_fn(1, 1, |_, _| site.pieces[quadrant.index()][0]);
        CapFace { surface: bezier(net), boundary: (0..4).map(edge).collect(), pieces }
    }
}

/// The sides in the order of the loop, from the corner `(0, 0)` on.
const SIDES: [Side; 4] = [Side::V0, Side::U1, Side::V1, Side::U0];

fn ends(side: Side) -> [f64; 2] {
    match side {
        Side::V0 | Side::U1 => [0.0, 1.0],
        Side::V1 | Side::U0 => [1.0, 0.0],
    }
}

fn whole_edge(side: Side, [from, to]: [CapVertex; 2]) -> CapEdge {
    CapEdge { side, from, to, range: ends(side) }
}

fn edge_in_halves(side: Side, [from, to]: [CapVertex; 2], middle: CapVertex) -> [CapEdge; 2] {
    let [start, end] = ends(side);
    [
        CapEdge { side, from, to: middle, range: [start, 0.5] },
        CapEdge { side, from: middle, to, range: [0.5, end] },
    ]
}
