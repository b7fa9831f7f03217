//! Meetings of curves: where they are, which way their spokes lead, and the caps around them.
//!
//! What a cap is made of is read off one more refinement of the faces near the meeting, where the limit surface is bicubic
//! from the end of the first cell on.

use super::cap::{self, CAP, NODES, Sectors, Share, Spoke};
use super::net::{Cells, view};
use crate::math::{Grid, Vec3};
use crate::mesh::{FaceId, HalfedgeId, Note, Place, VertexId};
use crate::nurbs::{KnotVector, curve::polar};
use crate::patch::{Kind, Neighbourhood, with_ring};
use crate::refine::sub_grid;
use crate::rules::Level;

/// Cells along a spoke, counted from the meeting, that a cap covers.
pub(crate) const CAP_CELLS: usize = 2;

/// The spline of degree (5, 5) over the first two cells of a quad next to a meeting of curves.
#[derive(Clone, Debug)]
pub struct Cap {
    /// The quad of the base level.
    pub quad: u32,
    /// Its corner at the meeting.
    pub corner: u32,
    /// Coefficients over the knots `0 0 0 0 0 0 1 1 1 1 2 2 2 2 2 2` in cells, in both directions: `net[(a, b)]`, `a` along
    /// the side that leaves the corner, `b` along the one that reaches it.
    pub net: Grid<Vec3>,
}

impl Cap {
    /// Knots of all caps, in cells.
    pub fn knots() -> KnotVector {
        KnotVector::from_multiplicities(5, [(0.0, 6), (1.0, 4), (2.0, 6)])
    }

    /// The polar form of the piece on a cell, in the corner's own view.
    pub(crate) fn polar(&self, cell: (usize, usize), u: &[f64; 5], v: &[f64; 5]) -> Vec3 {
        let knots = Cap::knots();
        let span = |cell: usize| knots.span(cell as f64 + 0.5);
        let column: Vec<Vec3> = (0..CAP).map(|i| polar(&knots, span(cell.1), self.net.row(i), v)).collect();
        polar(&knots, span(cell.0), &column, u)
    }
}

/// Where spokes share no tangent plane, and by how much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kink {
    pub(crate) vertex: VertexId,
    /// The greatest angle of a spoke out of the plane, in radians; `None` where spokes do not go round in it.
    pub(crate) angle: Option<f64>,
}

impl Kink {
    pub(crate) fn note(self) -> Note {
        let Kink { vertex, angle } = self;
        let message = match angle {
            Some(angle) => format!(
                "spokes of the meeting at vertex {vertex} are up to {:.3e} degrees out of their plane: the surface has a point there",
                angle.to_degrees()
            ),
            None => format!(
                "spokes of the meeting at vertex {vertex} do not go round it in one plane: the surface is not smooth there"
            ),
        };
        Note { code: "meeting_not_smooth", message, place: Some(Place::Vertex(vertex.0)) }
    }
}

/// A meeting on a level: the halfedges that leave it, counter-clockwise, the first along a port.
pub(crate) struct MeetingFan {
    pub(crate) vertex: VertexId,
    pub(crate) halfedges: Vec<HalfedgeId>,
    t: f64,
}

/// All meetings of a level, by number of vertex.
pub(crate) fn meetings(base: &Level) -> Vec<MeetingFan> {
    let topology = base.topology();
    let mut vertices: Vec<VertexId> =
        base.slices().map(|(_, slice)| topology.origin(slice.halfedge)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let fan = |vertex: VertexId| {
        let mut halfedges: Vec<HalfedgeId> = topology.ring(vertex).collect();
        let first = base.slice(topology.face(halfedges[0]))?;
        if !first.port_first {
            halfedges.rotate_left(1);
        }
        Some(MeetingFan { vertex, halfedges, t: first.t })
    };
    vertices.into_iter().filter_map(fan).collect()
}

/// The caps of meetings, and where they are not smooth. `fine` is the base refined `level` times.
pub(crate) fn caps(
    base: &Level,
    fans: &[MeetingFan],
    fine: &Level,
    fine_points: &[Vec3],
    level: u32,
) -> (Vec<Cap>, Vec<Kink>) {
    if fans.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let cells = Cells::new(base, fine, level);
    let last = (1usize << level) - 1;
    let side = NODES / 2;
    let seen =
        |h: HalfedgeId| (0..side * side).map(move |cell| view(h.index() % 4, cell / side, cell % side, last));
    let halfedges = || fans.iter().flat_map(|fan| &fan.halfedges);
    let faces: Vec<FaceId> = halfedges()
        .flat_map(|&h| seen(h).map(move |(i, j)| (h, i, j)))
        .map(|(h, i, j)| FaceId(cells.face((h.index() / 4) as u32, i, j)))
        .collect();
    let around = with_ring(fine, &faces);
    let part = Neighbourhood::new(fine, &around);
    let (finer, finer_points) = part.level.refine_points(&part.take(fine_points));
    let nodes_of = |h: HalfedgeId| -> Grid<Vec3> {
        let mut nodes = Grid::from_fn(NODES, NODES, |_, _| Vec3::ZERO);
        for cell in 0..side * side {
            let (i, j) = view(h.index() % 4, cell / side, cell % side, last);
            let face = FaceId(cells.face((h.index() / 4) as u32, i, j));
            let Ok(own) = around.binary_search(&face) else { unreachable!("the face was gathered above") };
            let grid = sub_grid(&finer, own as u32, cells.turns(i, j), 1);
            for (x, y) in (0..9).map(|node| (node / 3, node % 3)) {
                let v = grid[view(h.index() % 4, x, y, 2)];
                nodes[(2 * (cell / side) + x, 2 * (cell % side) + y)] = finer_points[v.index()];
            }
        }
        nodes
    };
    let (mut caps, mut kinks) = (Vec::new(), Vec::new());
    for fan in fans {
        let nodes: Vec<Grid<Vec3>> = fan.halfedges.iter().map(|&h| nodes_of(h)).collect();
        let spokes = spokes(&nodes, fan.t);
        let (spokes, shares, angle) = shares(spokes);
        if shares.is_none() || angle > FLAT {
            kinks.push(Kink { vertex: fan.vertex, angle: shares.is_some().then_some(angle) });
        }
        let nets = cap::nets(&Sectors(&nodes), &spokes, shares.as_deref());
        caps.extend(fan.halfedges.iter().zip(nets).map(|(h, net)| Cap {
            quad: h.0 / 4,
            corner: h.0 % 4,
            net,
        }));
    }
    (caps, kinks)
}

/// Spokes may leave their plane by so much, in radians, and count as lying in it.
const FLAT: f64 = 1e-9;

/// Where the spokes lead: the tangents of the curves, and where the free spokes lead in the end.
fn spokes(nodes: &[Grid<Vec3>], t: f64) -> Vec<Spoke> {
    let apex = nodes[0][(0, 0)];
    let ring: Vec<Vec3> =
        nodes.iter().flat_map(|nodes| [nodes[(1, 0)] - apex, nodes[(1, 1)] - apex]).collect();
    let kind = Kind::Meeting { ports: nodes.len() as u32 / 2, port_first: true, t: t.to_bits() };
    // The nodes are half a cell apart.
    let tangents = kind.meeting_tangents(&ring).enumerate();
    tangents.map(|(k, [first, _])| Spoke { tangent: 2.0 * first, is_port: k.is_multiple_of(2) }).collect()
}

/// The least sine of the angle between neighbouring spokes, and the least length of a free one against the ports beside it,
/// with which the limit's own free spokes are kept.
const OPEN: f64 = 0.05;

/// How cross derivatives are shared along every spoke, and how far the spokes are out of their plane, in radians. Free
/// spokes that lead nowhere are replaced by the bisectors of the ports. `None` if spokes do not go round in a plane.
fn shares(mut spokes: Vec<Spoke>) -> (Vec<Spoke>, Option<Vec<Share>>, f64) {
    let n = spokes.len();
    let normal = (0..n).fold(Vec3::ZERO, |sum, i| sum + spokes[i].tangent.cross(spokes[(i + 1) % n].tangent));
    let Some(normal) = normal.normalized() else { return (spokes, None, 0.0) };
    let flat = |v: Vec3| v - v.dot(normal) * normal;
    let sine = |a: Vec3, b: Vec3| a.cross(b).dot(normal) / (a.length() * b.length());
    let is_open = |spokes: &[Spoke]| {
        (0..n).all(|i| {
            let [here, next] = [spokes[i].tangent, spokes[(i + 1) % n].tangent];
            let (port, free) = if spokes[i].is_port { (here, next) } else { (next, here) };
            sine(here, next) >= OPEN && free.length() >= OPEN * port.length()
        }) && turns_once(spokes, normal)
    };
    if !is_open(&spokes) {
        for i in (1..n).step_by(2) {
            let [before, after] = [spokes[i - 1].tangent, spokes[(i + 1) % n].tangent].map(flat);
            if let Some(bisector) = bisector(before, after, normal) {
                spokes[i].tangent = bisector;
            }
        }
        if !is_open(&spokes) {
            return (spokes, None, 0.0);
        }
    }
    let turn = |i: usize| spokes[i].tangent.cross(spokes[(i + 1) % n].tangent).dot(normal);
    let share = |i: usize| {
        let before = (i + n - 1) % n;
        let (area_before, area_after) = (turn(before), turn(i));
        let skew = (area_after - area_before) / (area_after + area_before);
        let own = spokes[i].tangent;
        let sum = (1.0 - skew) * spokes[(i + 1) % n].tangent + (1.0 + skew) * spokes[before].tangent;
        Share { skew, bend: sum.dot(own) / (2.0 * own.dot(own)), slope: 0.0 }
    };
    let shares = (0..n).map(share).collect();
    let out_of_plane = |spoke: &Spoke| (spoke.tangent.dot(normal) / spoke.tangent.length()).abs().asin();
    let angle = spokes.iter().map(out_of_plane).fold(0.0, f64::max);
    (spokes, Some(shares), angle)
}

/// True if the spokes go round once.
fn turns_once(spokes: &[Spoke], normal: Vec3) -> bool {
    let n = spokes.len();
    let angle = |i: usize| counter_clockwise(spokes[i].tangent, spokes[(i + 1) % n].tangent, normal);
    ((0..n).map(angle).sum::<f64>() - std::f64::consts::TAU).abs() < 0.1
}

/// The angle from `a` to `b` about a unit normal, in `[0, 2 pi)`.
fn counter_clockwise(a: Vec3, b: Vec3, normal: Vec3) -> f64 {
    a.cross(b).dot(normal).atan2(a.dot(b)).rem_euclid(std::f64::consts::TAU)
}

/// Half way from `a` to `b`, counter-clockwise, as long as both are in the (geometric) mean.
fn bisector(a: Vec3, b: Vec3, normal: Vec3) -> Option<Vec3> {
    let (sin, cos) = (counter_clockwise(a, b, normal) / 2.0).sin_cos();
    let unit = a.normalized()?;
    Some((a.length() * b.length()).sqrt() * (cos * unit + sin * normal.cross(unit)))
}
