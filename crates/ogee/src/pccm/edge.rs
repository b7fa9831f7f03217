//! Edge curves, second rows and twists: what makes both sides of an edge share their tangent planes.
//!
//! Across edge `i` the construction asks for `D(t) = 2 omega(t) gamma'(t)`, `D` the sum of both cross derivatives,
//! `gamma` the edge curve, `omega(0) = c`. Variant FIRST takes `omega` quadratic and `gamma` quadratic on the first
//! cell; SECOND `omega` piecewise and `gamma` quadratic on the second cell, so that the first keeps a free cubic.
//! Indices here are array positions: 0 1 2 3 4 5 for the labels 0 1 2 4 6 9 (FIRST) and 0 1 2 4 5 7 (SECOND).

use super::fan::{Arrays, Fan};
use crate::math::Vec3;
use crate::math::circulant::{alternating_mean, sign, solve_pair_sums, solve_pair_sums_open};

/// Variant FIRST: the slides' steps (3) to (6).
pub(crate) fn smooth_first(fan: &Fan, keep_twist: bool, inserted: &Arrays, arrays: &mut Arrays) {
    let n = fan.halfedges.len();
    let c = fan.c;
    if fan.is_even() && n > 4 {
        // Step (3): the smallest change that makes the twists solvable.
        let fourth: Vec<Vec3> = (0..n).map(|i| inserted.edge(fan, i, 3)).collect();
        let mean = alternating_mean(&fourth);
        for i in 0..n {
            let h = -sign(i) * mean;
            arrays.set_edge(fan, i, 3, arrays.edge(fan, i, 3) + h);
            arrays.move_second_rows(fan, i, 3, h);
        }
    }
    let mut right = vec![Vec3::ZERO; n];
    for i in fan.smooth_edges() {
        let (q0, q1, q4) = (fan.apex, fan.tangents[i], arrays.edge(fan, i, 3));
        let q2 = (q4 + 6.0 * q1 - 2.0 * q0) / 5.0;
        right[i] = q1 + c / 6.0 * (q4 - q2);
        arrays.set_edge(fan, i, 2, q2);
        arrays.move_second_rows(fan, i, 2, q2 - inserted.edge(fan, i, 2));
    }
    twists(fan, &right, keep_twist, inserted, arrays);
}

/// Solves for `Q_11` of every patch, one pair sum per smooth edge.
fn twists(fan: &Fan, right: &[Vec3], keep_twist: bool, inserted: &Arrays, arrays: &mut Arrays) {
    let n = fan.halfedges.len();
    let before: Vec<Vec3> = (0..n).map(|i| inserted.get(fan, i, 1, 1)).collect();
    let mut twists = if fan.closed { solve_pair_sums(right) } else { solve_pair_sums_open(right, &before) };
    if fan.is_even() && keep_twist {
        let kernel = alternating_mean(&before);
        for (i, twist) in twists.iter_mut().enumerate() {
            *twist += sign(i) * kernel;
        }
    }
    for (i, twist) in twists.into_iter().enumerate() {
        arrays.set(fan, i, 1, 1, twist);
    }
}

/// What variant SECOND knows of the other end of an edge when both ends are smoothed and the edge has four cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FarEnd {
    /// `Q_10` there.
    pub(crate) tangent: Vec3,
    /// `Q_20` there; not yet known in the second pass.
    pub(crate) second: Vec3,
}

/// Variant SECOND, second pass: `Q_20` of every smooth edge, closest to the inserted curve.
pub(crate) fn place_second(fan: &mut Fan, inserted: &Arrays, far: impl Fn(usize) -> Option<FarEnd>) {
    let mut second = vec![Vec3::ZERO; fan.edge_count()];
    for i in fan.smooth_edges() {
        let b = |s: usize| inserted.edge(fan, i, s);
        let q1 = fan.tangents[i];
        second[i] = match far(i) {
            None => {
                let a = (b(5) - 5.0 * q1) / 5.0;
                let d = (2.0 * b(5) - 5.0 * q1) / 5.0;
                (b(2) + 1.8 * (b(3) - a) + 1.6 * (b(4) - d)) / 6.8
            }
            // Position 9 - s is label s seen from the other end.
            Some(far) => fit_both(q1, far.tangent, [b(2), b(7), b(3), b(6), b(4), b(5)])[0],
        };
    }
    if fan.is_even() {
        let mean = alternating_mean(&second);
        for (i, second) in second.iter_mut().enumerate() {
            *second -= sign(i) * mean;
        }
    }
    fan.second = second;
}

/// Coefficients of the free pair `(L2, R2)` in `L2, R2, L4, R4, L5, R5` of a coupled edge.
const COUPLED: [[f64; 2]; 6] = [
    [1.0, 0.0],
    [0.0, 1.0],
    [41.0 / 21.0, 8.0 / 21.0],
    [8.0 / 21.0, 41.0 / 21.0],
    [40.0 / 21.0, 16.0 / 21.0],
    [16.0 / 21.0, 40.0 / 21.0],
];

/// Least squares of `L2, R2, L4, R4, L5, R5` to the inserted values, over `(L2, R2)`.
fn fit_both(l1: Vec3, r1: Vec3, inserted: [Vec3; 6]) -> [Vec3; 2] {
    let l4 = (-5.0 * r1 - 23.0 * l1) / 21.0;
    let r4 = (-5.0 * l1 - 23.0 * r1) / 21.0;
    let fixed = [Vec3::ZERO, Vec3::ZERO, l4, r4, l1 + 2.0 * l4, r1 + 2.0 * r4];
    let (mut diagonal, mut off) = (0.0, 0.0);
    let mut right = [Vec3::ZERO; 2];
    for (row, (value, fixed)) in COUPLED.iter().zip(inserted.iter().zip(fixed)) {
        diagonal += row[0] * row[0];
        off += row[0] * row[1];
        right[0] += row[0] * (*value - fixed);
        right[1] += row[1] * (*value - fixed);
    }
    // The matrix is symmetric in both ends: its two diagonal entries agree.
    let determinant = diagonal * diagonal - off * off;
    [
        (diagonal * right[0] - off * right[1]) / determinant,
        (diagonal * right[1] - off * right[0]) / determinant,
    ]
}

/// Variant SECOND, third pass: the rest of the edge curves, second rows, twists.
pub(crate) fn smooth_second(
    fan: &Fan,
    keep_twist: bool,
    inserted: &Arrays,
    arrays: &mut Arrays,
    far: impl Fn(usize) -> Option<FarEnd>,
) {
    let c = fan.c;
    let mut right = vec![Vec3::ZERO; fan.halfedges.len()];
    for i in fan.smooth_edges() {
        let b = |s: usize| inserted.edge(fan, i, s);
        let (q0, q1, q2) = (fan.apex, fan.tangents[i], fan.second[i]);
        let (q4, q5, q7) = match far(i) {
            None => {
                let q7 = b(5);
                ((q7 + 9.0 * q2 - 5.0 * q1) / 5.0, (2.0 * q7 + 8.0 * q2 - 5.0 * q1) / 5.0, q7)
            }
            Some(FarEnd { tangent: r1, second: r2 }) => {
                let l4 = (-5.0 * r1 - 23.0 * q1 + 8.0 * r2 + 41.0 * q2) / 21.0;
                let r4 = (-5.0 * q1 - 23.0 * r1 + 8.0 * q2 + 41.0 * r2) / 21.0;
                (l4, q1 - 2.0 * q2 + 2.0 * l4, r1 - 2.0 * r2 + 2.0 * r4)
            }
        };
        right[i] = q1 + c / 9.0 * ((q1 - q0) + 6.0 * (q2 - q1));
        for (s, value) in [(2, q2), (3, q4), (4, q5)] {
            arrays.set_edge(fan, i, s, value);
        }
        arrays.move_second_rows(fan, i, 2, q2 - b(2) + c / 9.0 * (2.0 * (q2 - q1) + 1.5 * (q4 - q2)));
        arrays.move_second_rows(fan, i, 3, q4 - b(3) + c / 18.0 * (q7 - q5));
        arrays.move_second_rows(fan, i, 4, q5 - b(4));
    }
    twists(fan, &right, keep_twist, inserted, arrays);
}
