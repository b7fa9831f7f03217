//! A cap's coefficients from its points (Outer border, Weights, and Boundaries, creases, corners, darts on the
//! method's page).
//!
//! Weights give the inner coefficients. The outer three layers continue the bicubic surface around the cap with two derivatives,
//! and depend on nothing but the points next to them; so do the boundary curves of open fans, which are Catmull and Clark's.

use super::columns::Node;
use super::{COEFFICIENTS, CapClass, DEGREE, INNER, Weights};
use crate::math::{Grid, Vec3};
use crate::nurbs::KnotVector;

/// The knots of a sector in both directions: `0` and `1` eightfold, `1/2` fivefold.
pub fn knots() -> KnotVector {
    let inner = COEFFICIENTS - DEGREE - 1;
    KnotVector::from_multiplicities(DEGREE, [(0.0, DEGREE + 1), (0.5, inner), (1.0, DEGREE + 1)])
}

/// The coefficients of all sectors of a cap from its points in the order of columns ([`CapClass`]).
///
/// Each net has 13 x 13 coefficients `(i, j)`, `i` along the sector's first edge, `j` along its second, `(0, 0)` at the vertex;
/// [`knots`] are those of both directions. Rows that two sectors share are equal bit for bit. Points are best near the origin:
/// rounding grows with the distance.
///
/// # Panics
/// If there are fewer points than columns.
pub fn nets(weights: &Weights, points: &[Vec3]) -> Vec<Grid<Vec3>> {
    let class = weights.class;
    let mut nets: Vec<Grid<Vec3>> = (0..class.sectors())
        .map(|sector| {
            let around = surroundings(class, points, sector);
            let data = seen_from(class, points, sector);
            let own = if class.is_closed() { 0 } else { sector };
            Grid::from_fn(COEFFICIENTS, COEFFICIENTS, |i, j| {
                match (i.checked_sub(INNER), j.checked_sub(INNER)) {
                    (Some(layer), _) => {
                        outer(layer, |across| along_side(j, |along| around[(across + 1, along)]))
                    }
                    (None, Some(layer)) => {
                        outer(layer, |across| along_side(i, |along| around[(along, across + 1)]))
                    }
                    (None, None) => {
                        let row = weights.row(own, i, j);
                        row.iter().zip(&data).fold(Vec3::ZERO, |sum, (&weight, &point)| sum + weight * point)
                    }
                }
            })
        })
        .collect();
    write_boundary(class, points, &mut nets);
    share(class, &mut nets);
    nets
}

/// The points in the order in which a sector's weights take them: around an interior vertex its own come first.
fn seen_from(class: CapClass, points: &[Vec3], sector: usize) -> Vec<Vec3> {
    let mut data = points[..class.columns()].to_vec();
    if class.is_closed() {
        data[1..].rotate_left(class.column(Node::P10(sector)) - 1);
    }
    data
}

/// The points around the cell of a sector: `(u, v)`, in cells, at `(u + 1, v + 1)` for both from -1 to 2. Beyond sharp edges
/// points are reflected. The point at `(-1, -1)` is never asked for.
fn surroundings(class: CapClass, points: &[Vec3], sector: usize) -> Grid<Vec3> {
    let at = |node: Node| points[class.column(node)];
    let previous = sector.checked_sub(1).unwrap_or(class.sectors() - 1);
    let next = sector + 1;
    let mut around = Grid::from_fn(4, 4, |u, v| match (u, v) {
        (0, 1) => at(Node::P10(next + 1)),
        (0, 2) => at(Node::P11(next)),
        (0, 3) => at(Node::P21(next)),
        (1, 0) => at(Node::P10(previous)),
        (2, 0) => at(Node::P11(previous)),
        (3, 0) => at(Node::P12(previous)),
        (2, 1) => at(Node::P10(sector)),
        (3, 1) => at(Node::P20(sector)),
        (1, 2) => at(Node::P10(next)),
        (1, 3) => at(Node::P20(next)),
        (2, 2) => at(Node::P11(sector)),
        (3, 2) => at(Node::P21(sector)),
        (2, 3) => at(Node::P12(sector)),
        (3, 3) => at(Node::P22(sector)),
        _ => at(Node::Vertex),
    });
    if !class.is_closed() {
        if sector == 0 {
            for u in 1..4 {
                around[(u, 0)] = 2.0 * around[(u, 1)] - around[(u, 2)];
            }
        }
        if sector + 1 == class.sectors() {
            for v in 1..4 {
                around[(0, v)] = 2.0 * around[(1, v)] - around[(2, v)];
            }
        }
    }
    around
}

/// The denominator of [`SIDE`] and [`OUTER`].
pub(super) const DENOMINATOR: f64 = 1680.0;

/// The first seven coefficients of a uniform cubic's cell from the points at -1, 0, 1, 2; the others from the far end.
pub(super) const SIDE: [[f64; 4]; 7] = [
    [280.0, 1120.0, 280.0, 0.0],
    [220.0, 1120.0, 340.0, 0.0],
    [170.0, 1100.0, 410.0, 0.0],
    [129.0, 1063.0, 487.0, 1.0],
    [96.0, 1012.0, 568.0, 4.0],
    [70.0, 950.0, 650.0, 10.0],
    [30.0, 810.0, 810.0, 30.0],
];

/// The last three coefficients across a side from the points at 0, 1, 2: the two-jet of a uniform cubic at 1.
pub(super) const OUTER: [[f64; 3]; 3] =
    [[410.0, 1100.0, 170.0], [340.0, 1120.0, 220.0], [280.0, 1120.0, 280.0]];

/// Coefficient `number` of a cubic from its four points.
fn along_side(number: usize, at: impl Fn(usize) -> Vec3) -> Vec3 {
    let last = COEFFICIENTS - 1;
    let sum = |weights: [f64; 4], at: &dyn Fn(usize) -> Vec3| {
        weights.iter().enumerate().fold(Vec3::ZERO, |sum, (k, &weight)| sum + weight * at(k)) / DENOMINATOR
    };
    if number < SIDE.len() { sum(SIDE[number], &at) } else { sum(SIDE[last - number], &|k| at(3 - k)) }
}

/// Outer coefficient `10 + layer` from the points 0, 1, 2 across.
fn outer(layer: usize, at: impl Fn(usize) -> Vec3) -> Vec3 {
    let weights = OUTER[layer].iter().enumerate();
    weights.fold(Vec3::ZERO, |sum, (k, &weight)| sum + weight * at(k)) / DENOMINATOR
}

/// The boundary curves of open fans: a cubic that runs through the vertex, or ends there as at a corner.
fn write_boundary(class: CapClass, points: &[Vec3], nets: &mut [Grid<Vec3>]) {
    let last = class.sectors() - 1;
    let at = |node: Node| points[class.column(node)];
    let [start, end] = [0, last + 1].map(|edge| [at(Node::P10(edge)), at(Node::P20(edge))]);
    let vertex = at(Node::Vertex);
    let [before_start, before_end] = match class {
        CapClass::Interior { .. } | CapClass::Dart { .. } => return,
        CapClass::Boundary { .. } => [end[0], start[0]],
        CapClass::Corner { .. } => [2.0 * vertex - start[0], 2.0 * vertex - end[0]],
    };
    for i in 0..COEFFICIENTS {
        nets[0][(i, 0)] = along_side(i, |k| [before_start, vertex, start[0], start[1]][k]);
        nets[last][(0, i)] = along_side(i, |k| [before_end, vertex, end[0], end[1]][k]);
    }
}

/// Makes rows that two sectors share equal bit for bit: computed twice they agree to rounding only.
fn share(class: CapClass, nets: &mut [Grid<Vec3>]) {
    let sectors = nets.len();
    for sector in first_shared_edge(class)..sectors {
        let before = (sector + sectors - 1) % sectors;
        for j in 1..COEFFICIENTS {
            let mean = (nets[sector][(j, 0)] + nets[before][(0, j)]) / 2.0;
            nets[sector][(j, 0)] = mean;
            nets[before][(0, j)] = mean;
        }
    }
    let vertex = nets.iter().fold(Vec3::ZERO, |sum, net| sum + net[(0, 0)]) / sectors as f64;
    for net in nets {
        net[(0, 0)] = vertex;
    }
}

/// All edges from this one on have a sector on both sides.
fn first_shared_edge(class: CapClass) -> usize {
    match class {
        CapClass::Interior { .. } | CapClass::Dart { .. } => 0,
        CapClass::Boundary { .. } | CapClass::Corner { .. } => 1,
    }
}
