//! The uniform bicubic B-spline: sixteen points, a position and its derivatives.
//!
//! Stated twice, for one sample with the coordinates in lanes and for four samples in lanes. Both do the same operations
//! in the same order, so a lone point is a point of a batch bit for bit (`batches_are_lone_points`).

use crate::patch::Wide;

/// Sixteen points, `i + 4 j`, `i` along the first parameter.
pub(super) type Net = [Wide; 16];

/// One number for each sample.
pub(super) type Lanes<const L: usize> = [f64; L];

/// `std::array::from_fn` is not always inlined, which here would cost more than the arithmetic.
#[inline(always)]
pub(super) fn lanes<const L: usize>(f: impl Fn(usize) -> f64) -> Lanes<L> {
    let mut out = [0.0; L];
    for (l, out) in out.iter_mut().enumerate() {
        *out = f(l);
    }
    out
}

/// The four cubic B-splines over a cell at `t` in `[0, 1]`.
#[inline(always)]
pub(super) fn values<const L: usize>(t: Lanes<L>) -> [Lanes<L>; 4] {
    const SIXTH: f64 = 1.0 / 6.0;
    let s: Lanes<L> = lanes(|l| 1.0 - t[l]);
    [
        lanes(|l| s[l] * s[l] * s[l] * SIXTH),
        lanes(|l| ((3.0 * t[l] - 6.0) * t[l] * t[l] + 4.0) * SIXTH),
        lanes(|l| ((3.0 * s[l] - 6.0) * s[l] * s[l] + 4.0) * SIXTH),
        lanes(|l| t[l] * t[l] * t[l] * SIXTH),
    ]
}

/// Their first derivatives.
#[inline(always)]
pub(super) fn slopes<const L: usize>(t: Lanes<L>) -> [Lanes<L>; 4] {
    let s: Lanes<L> = lanes(|l| 1.0 - t[l]);
    [
        lanes(|l| -0.5 * s[l] * s[l]),
        lanes(|l| (1.5 * t[l] - 2.0) * t[l]),
        lanes(|l| (2.0 - 1.5 * s[l]) * s[l]),
        lanes(|l| 0.5 * t[l] * t[l]),
    ]
}

/// Their second derivatives.
#[inline(always)]
pub(super) fn bends<const L: usize>(t: Lanes<L>) -> [Lanes<L>; 4] {
    [lanes(|l| 1.0 - t[l]), lanes(|l| 3.0 * t[l] - 2.0), lanes(|l| 1.0 - 3.0 * t[l]), lanes(|l| t[l])]
}

/// The first parts of position, `du`, `dv`, `duu`, `duv`, `dvv`: one, three or six.
pub(super) type Jet<T, const PARTS: usize> = [T; PARTS];

/// One sample: coordinates in lanes.
#[inline(always)]
pub(super) fn one<const PARTS: usize>(net: &Net, x: f64, y: f64) -> Jet<Wide, PARTS> {
    let (bx, by) = (values([x]), values([y]));
    let (dx, dy) = (slopes([x]), slopes([y]));
    let (ddx, ddy) = (bends([x]), bends([y]));
    let along = |basis: &[[f64; 1]; 4], j: usize| -> Wide {
        let p = &net[4 * j..4 * j + 4];
        lanes(|c| {
            basis[0][0] * p[0][c] + basis[1][0] * p[1][c] + basis[2][0] * p[2][c] + basis[3][0] * p[3][c]
        })
    };
    let across = |basis: &[[f64; 1]; 4], rows: &[Wide; 4]| -> Wide {
        lanes(|c| {
            basis[0][0] * rows[0][c]
                + basis[1][0] * rows[1][c]
                + basis[2][0] * rows[2][c]
                + basis[3][0] * rows[3][c]
        })
    };
    let mut jet = [[0.0; 4]; PARTS];
    let mut rows = [[0.0; 4]; 4];
    for (j, row) in rows.iter_mut().enumerate() {
        *row = along(&bx, j);
    }
    jet[0] = across(&by, &rows);
    if PARTS > 1 {
        let mut slope_rows = [[0.0; 4]; 4];
        for (j, row) in slope_rows.iter_mut().enumerate() {
            *row = along(&dx, j);
        }
        jet[1] = across(&by, &slope_rows);
        jet[2] = across(&dy, &rows);
        if PARTS > 3 {
            let mut bend_rows = [[0.0; 4]; 4];
            for (j, row) in bend_rows.iter_mut().enumerate() {
                *row = along(&ddx, j);
            }
            jet[3] = across(&by, &bend_rows);
            jet[4] = across(&dy, &slope_rows);
            jet[5] = across(&ddy, &rows);
        }
    }
    jet
}

/// Samples in lanes: for each part of the jet its three coordinates.
#[inline(always)]
pub(super) fn many<const PARTS: usize, const L: usize>(
    net: &Net,
    x: Lanes<L>,
    y: Lanes<L>,
) -> Jet<[Lanes<L>; 3], PARTS> {
    let (bx, by) = (values(x), values(y));
    let mut jet = [[[0.0; L]; 3]; PARTS];
    let (dx, dy) = if PARTS > 1 { (slopes(x), slopes(y)) } else { ([[0.0; L]; 4], [[0.0; L]; 4]) };
    let (ddx, ddy) = if PARTS > 3 { (bends(x), bends(y)) } else { ([[0.0; L]; 4], [[0.0; L]; 4]) };
    for c in 0..3 {
        let along = |basis: &[Lanes<L>; 4], j: usize| -> Lanes<L> {
            let p = [net[4 * j][c], net[4 * j + 1][c], net[4 * j + 2][c], net[4 * j + 3][c]];
            lanes(|l| basis[0][l] * p[0] + basis[1][l] * p[1] + basis[2][l] * p[2] + basis[3][l] * p[3])
        };
        let across = |basis: &[Lanes<L>; 4], rows: &[Lanes<L>; 4]| -> Lanes<L> {
            lanes(|l| {
                basis[0][l] * rows[0][l]
                    + basis[1][l] * rows[1][l]
                    + basis[2][l] * rows[2][l]
                    + basis[3][l] * rows[3][l]
            })
        };
        let mut rows = [[0.0; L]; 4];
        for (j, row) in rows.iter_mut().enumerate() {
            *row = along(&bx, j);
        }
        jet[0][c] = across(&by, &rows);
        if PARTS > 1 {
            let mut slope_rows = [[0.0; L]; 4];
            for (j, row) in slope_rows.iter_mut().enumerate() {
                *row = along(&dx, j);
            }
            jet[1][c] = across(&by, &slope_rows);
            jet[2][c] = across(&dy, &rows);
            if PARTS > 3 {
                let mut bend_rows = [[0.0; L]; 4];
                for (j, row) in bend_rows.iter_mut().enumerate() {
                    *row = along(&ddx, j);
                }
                jet[3][c] = across(&by, &bend_rows);
                jet[4][c] = across(&dy, &slope_rows);
                jet[5][c] = across(&ddy, &rows);
            }
        }
    }
    jet
}
