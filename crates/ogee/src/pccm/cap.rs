//! The cap of a meeting: tensor splines of degree five around a vertex where curves meet, with the curves as edges.
//!
//! Beyond the first two cells around such a vertex the surface is bicubic on the cells of the refined mesh. Inside them it
//! is not, and no bicubic patch can be tangent-continuous there along given curves. So each sector gets one spline of
//! degree (5, 5) over `[0, 2]^2`, with a knot of multiplicity four at 1. Along every spoke the sum of the cross derivatives,
//! weighted, is `2 omega gamma'`, `gamma` the spoke's curve. `docs/methods/pccm.md`, Where curves meet.

use super::closing::{self, Spread};
use crate::math::{Grid, Vec3};

/// Coefficients of a cap's spline in one direction.
pub(crate) const CAP: usize = 10;

/// Nodes a side, counted from the meeting, that a sector is made from.
pub(crate) const NODES: usize = 7;

/// Where a spoke leads: the derivative of its curve at the meeting, per cell, and whether a curve arrives along it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spoke {
    pub(crate) tangent: Vec3,
    pub(crate) is_port: bool,
}

/// How the two cross derivatives beside a spoke share its tangent plane: `q S_v + p S_u = 2 omega gamma'`, where `S_v` is
/// that of the sector after the spoke, `S_u` of the one before it, `p = 1 + skew (1 - t)^2` and `q = 2 - p`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Share {
    pub(super) skew: f64,
    /// `omega = (1 - t)^2 (bend + slope t)`.
    pub(super) bend: f64,
    pub(super) slope: f64,
}

impl Share {
    /// `omega'(0)`.
    fn fall(self) -> f64 {
        self.slope - 2.0 * self.bend
    }

    pub(super) fn p(self) -> f64 {
        1.0 + self.skew
    }

    pub(super) fn q(self) -> f64 {
        1.0 - self.skew
    }
}

/// What a coefficient of one direction is made of: three nodes of the next finer mesh around `centre`, in half cells.
struct Functional {
    centre: isize,
    weights: [f64; 3],
}

/// Value, first and second derivative per cell of the uniform cubic spline whose nodes are half a cell apart.
const VALUE: [f64; 3] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];
const SLOPE: [f64; 3] = [-1.0, 0.0, 1.0];
const BEND: [f64; 3] = [4.0, -8.0, 4.0];

/// Coefficient `k` of a cap: the Bezier coefficients 0, 1, 2 next to the meeting, 3 and 4 of the first cell, 1 and 2 of
/// the second, and its last three, for which the spline has the limit's value and first two derivatives.
fn functional(k: usize) -> Functional {
    let (centre, side, order) = match k {
        0..=2 => (0, 1.0, k),
        3 | 4 => (2, -1.0, 5 - k),
        5 | 6 => (2, 1.0, k - 4),
        _ => (4, -1.0, CAP - 1 - k),
    };
    let [first, second] = [[0.0, 0.0], [side / 5.0, 0.0], [side * 2.0 / 5.0, 1.0 / 20.0]][order];
    Functional { centre, weights: std::array::from_fn(|x| VALUE[x] + first * SLOPE[x] + second * BEND[x]) }
}

/// The nodes of the next finer mesh over all sectors, counter-clockwise; sector 0 begins with a port.
pub(super) struct Sectors<'a>(pub(super) &'a [Grid<Vec3>]);

impl Sectors<'_> {
    /// Node `a` half cells along the first spoke of sector `i` and `b` along its second one; -1 is across the other spoke.
    fn node(&self, i: usize, a: isize, b: isize) -> Vec3 {
        let n = self.0.len();
        match (a, b) {
            (_, -1) => self.0[(i + n - 1) % n][(1, a as usize)],
            (-1, _) => self.0[(i + 1) % n][(b as usize, 1)],
            _ => self.0[i][(a as usize, b as usize)],
        }
    }

    fn apply(&self, i: usize, along: &Functional, across: &Functional) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (x, &wx) in along.weights.iter().enumerate() {
            for (y, &wy) in across.weights.iter().enumerate() {
                let (a, b) = (along.centre - 1 + x as isize, across.centre - 1 + y as isize);
                sum += wx * wy * self.node(i, a, b);
            }
        }
        sum
    }

    /// Coefficient `(k, l)` of the limit surface itself, one of both beyond 2.
    fn limit(&self, i: usize, k: usize, l: usize) -> Vec3 {
        self.apply(i, &functional(k), &functional(l))
    }

    /// The cross derivative of sector `i` at the end of the first cell of its first spoke, and how it changes along it.
    fn across_first(&self, i: usize) -> [Vec3; 2] {
        let across = Functional { centre: 0, weights: SLOPE };
        [VALUE, SLOPE].map(|weights| self.apply(i, &Functional { centre: 2, weights }, &across))
    }
}

/// The nets of all sectors: `nets[i][(k, l)]`, `k` along the first spoke of sector `i`.
///
/// `spokes` are counter-clockwise, ports at even places. `shares` are `None` where the tangents do not go round in a plane;
/// then spokes are tangent-continuous from the end of the first cell on only.
pub(super) fn nets(nodes: &Sectors<'_>, spokes: &[Spoke], shares: Option<&[Share]>) -> Vec<Grid<Vec3>> {
    let n = spokes.len();
    let apex = nodes.0[0][(0, 0)];
    let mut curves: Vec<Curve> = (0..n).map(|i| Curve::new(nodes, i, apex, spokes[i])).collect();
    let mut twists: Vec<Vec3> = (0..n).map(|i| blended_twist(nodes, i, apex, &curves)).collect();
    let mut all_shares = vec![Share::default(); n];
    if let Some(shares) = shares {
        all_shares.copy_from_slice(shares);
        let tangents: Vec<Vec3> = spokes.iter().map(|spoke| spoke.tangent).collect();
        let spread: Vec<Spread> = curves.iter().map(|curve| curve.spread).collect();
        let right = |curves: &[Curve], shares: &[Share]| -> Vec<Vec3> {
            let of = |i: usize| curves[i].right(shares[i], tangents[(i + n - 1) % n], tangents[(i + 1) % n]);
            (0..n).map(of).collect()
        };
        let changes = closing::changes(&all_shares, &tangents, &spread, &right(&curves, &all_shares));
        for ((curve, share), change) in curves.iter_mut().zip(&mut all_shares).zip(changes) {
            curve.bend_by(change.bend);
            share.slope += change.slope;
        }
        twists = closing::twists(&all_shares, &right(&curves, &all_shares), &twists);
    }
    let rows: Vec<[[Vec3; 4]; 2]> = (0..n)
        .map(|i| {
            let before = (i + n - 1) % n;
            let neighbours = [spokes[before].tangent, spokes[(i + 1) % n].tangent];
            let [end, change] = nodes.across_first(i);
            let after = Side {
                weight: all_shares[i].skew,
                start: neighbours[1],
                twist: twists[i],
                end: [end, change],
            };
            let before = Side {
                weight: -all_shares[i].skew,
                start: neighbours[0],
                twist: twists[before],
                end: [-end, -change],
            };
            [after, before].map(|side| curves[i].second_row(all_shares[i], &side))
        })
        .collect();
    (0..n)
        .map(|i| net(nodes, i, [&curves[i], &curves[(i + 1) % n]], [rows[i][0], rows[(i + 1) % n][1]]))
        .collect()
}

/// One sector from the curves of its two spokes and the rows beside them.
fn net(nodes: &Sectors<'_>, i: usize, curves: [&Curve; 2], rows: [[Vec3; 4]; 2]) -> Grid<Vec3> {
    let mut net =
        Grid::from_fn(CAP, CAP, |k, l| if k < 3 && l < 3 { Vec3::ZERO } else { nodes.limit(i, k, l) });
    for k in 0..CAP {
        net[(k, 0)] = curves[0].row[k];
        net[(0, k)] = curves[1].row[k];
    }
    for k in 1..4 {
        net[(k, 1)] = rows[0][k];
        net[(1, k)] = rows[1][k];
    }
    let first = quartic_second(|k| net[(k, 2)]);
    let second = quartic_second(|k| net[(2, k)]);
    net[(2, 2)] = first.lerp(second, 0.5);
    net
}

/// The second coefficient for which the first cell of a row is of degree four, from all others.
fn quartic_second(at: impl Fn(usize) -> Vec3) -> Vec3 {
    let end = at(4).lerp(at(5), 0.5);
    at(3) + (5.0 * at(1) - at(0) + end - 5.0 * at(4)) / 10.0
}

/// The mixed derivative at the meeting of the bilinear blend of the first cell's edges.
fn blended_twist(nodes: &Sectors<'_>, i: usize, apex: Vec3, curves: &[Curve]) -> Vec3 {
    let n = curves.len();
    let (first, second) = (&curves[i], &curves[(i + 1) % n]);
    let [along_second, _] = nodes.across_first(i);
    // Seen from the second spoke the sector lies on the other side.
    let [along_first, _] = nodes.across_first((i + 1) % n).map(|x| -x);
    let value = Functional { centre: 2, weights: VALUE };
    let corner = nodes.apply(i, &value, &value);
    (along_second - second.tangent) + (along_first - first.tangent)
        - (corner - first.end() - second.end() + apex)
}

/// One side of a spoke.
struct Side {
    /// The weight of this side's cross derivative in terms of the transversal is `1 + weight (1 - t)^2`.
    weight: f64,
    /// The cross derivative at the meeting: the tangent of the next spoke on this side.
    start: Vec3,
    /// The mixed derivative there.
    twist: Vec3,
    /// The cross derivative at the end of the first cell, and how it changes along the spoke.
    end: [Vec3; 2],
}

/// The curve of a spoke: a cubic where a curve arrives, of degree four on the first cell elsewhere.
struct Curve {
    tangent: Vec3,
    spread: Spread,
    row: [Vec3; CAP],
}

impl Curve {
    fn new(nodes: &Sectors<'_>, i: usize, apex: Vec3, spoke: Spoke) -> Curve {
        let tangent = spoke.tangent;
        let mut row: [Vec3; CAP] =
            std::array::from_fn(
                |k| if k < 3 { apex + k as f64 / 5.0 * tangent } else { nodes.limit(i, k, 0) },
            );
        if !spoke.is_port {
            row[2] = quartic_second(|k| row[k]);
        }
        Curve { tangent, spread: if spoke.is_port { Spread::Slope } else { Spread::Bend }, row }
    }

    /// The end of the first cell.
    fn end(&self) -> Vec3 {
        self.row[4].lerp(self.row[5], 0.5)
    }

    /// The second derivative at the meeting.
    fn bend(&self) -> Vec3 {
        20.0 * (self.row[2] - 2.0 * self.row[1] + self.row[0])
    }

    /// Adds to the second derivative at the meeting; the first cell stays of degree four.
    fn bend_by(&mut self, by: Vec3) {
        self.row[2] += by / 20.0;
        self.row[3] += by / 20.0;
    }

    /// What `q` times the twist after the spoke and `p` times the one before it add up to.
    fn right(&self, share: Share, before: Vec3, after: Vec3) -> Vec3 {
        2.0 * (share.fall() * self.tangent + share.bend * self.bend()) - 2.0 * share.skew * (after - before)
    }

    /// Bernstein coefficients of `gamma'` on the first cell.
    fn derivative(&self) -> Vec<Vec3> {
        let (start, end) = (self.row[0], self.end());
        match self.spread {
            Spread::Slope => vec![self.tangent, self.tangent, 3.0 * (end - start) - 2.0 * self.tangent],
            Spread::Bend => {
                let one = start + self.tangent / 4.0;
                let two = (5.0 * self.row[2] - 2.0 * one) / 3.0;
                let three = (5.0 * self.row[4] - end) / 4.0;
                [[start, one], [one, two], [two, three], [three, end]].map(|[a, b]| 4.0 * (b - a)).to_vec()
            }
        }
    }

    /// The row beside the curve on the first cell, but for what the limit has from the fifth coefficient on.
    fn second_row(&self, share: Share, side: &Side) -> [Vec3; 4] {
        let start_weight = 1.0 + side.weight;
        let start = (side.start - share.bend * self.tangent) / start_weight;
        let slope =
            side.twist + 2.0 * side.weight * start - share.fall() * self.tangent - share.bend * self.bend();
        let [end, change] = side.end;
        let transversal = [start, start + slope / start_weight / 3.0, end - change / 3.0, end];
        let own = product(&[start_weight, 1.0, 1.0], &transversal);
        let omega = match self.spread {
            Spread::Slope => vec![share.bend, (share.bend + share.slope) / 3.0, 0.0, 0.0],
            Spread::Bend => vec![share.bend, 0.0, 0.0],
        };
        let along = product(&omega, &self.derivative());
        std::array::from_fn(|k| self.row[k] + (own[k] + along[k]) / 5.0)
    }
}

/// The product of two polynomials in Bernstein form.
fn product(factor: &[f64], of: &[Vec3]) -> Vec<Vec3> {
    let binomial = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    let (m, n) = (factor.len() - 1, of.len() - 1);
    (0..=m + n)
        .map(|k| {
            let terms = (k.saturating_sub(n)..=k.min(m)).map(|i| (i, k - i));
            let sum = terms
                .fold(Vec3::ZERO, |sum, (i, j)| sum + binomial(m, i) * binomial(n, j) * factor[i] * of[j]);
            sum / binomial(m + n, k)
        })
        .collect()
}
