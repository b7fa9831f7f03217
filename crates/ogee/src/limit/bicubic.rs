//! One bicubic patch: sixteen coefficients of powers of its parameters, a position and its derivatives.
//!
//! A net of control points becomes coefficients once, and every sample is then a few nested products.
//!
//! Here are no closures: they would be compiled for plain code, whatever calls them ([`crate::math::simd`]).

use crate::math::Vec3;
use crate::math::simd::{Four, Plain};
use crate::patch::Wide;

/// Sixteen points or coefficients, `i + 4 j`, `i` along the first parameter.
pub(super) type Net = [Wide; 16];

/// The first parts of position, `du`, `dv`, `duu`, `duv`, `dvv`: one, three or six.
pub(super) type Jet<T, const PARTS: usize> = [T; PARTS];

/// Coefficients of `1, t, t^2, t^3` of the uniform cubic B-spline over the inner cell of four points.
#[inline(always)]
fn powers<V: Four>([a, b, c, d]: [V; 4]) -> [V; 4] {
    let (half, sixth) = (V::splat(1.0 / 2.0), V::splat(1.0 / 6.0));
    let ends = a.plus(c);
    let inner = b.minus(c);
    [
        ends.plus(V::splat(4.0).times(b)).times(sixth),
        c.minus(a).times(half),
        ends.times(half).minus(b),
        d.minus(a).plus(V::splat(3.0).times(inner)).times(sixth),
    ]
}

/// Coefficients of `u^i v^j` of the uniform bicubic B-spline over the inner cell of a net.
#[inline(always)]
pub(super) fn coefficients<V: Four>(net: &[V; 16], out: &mut Net) {
    let mut rows = [V::splat(0.0); 16];
    for j in 0..4 {
        let row = powers([net[4 * j], net[4 * j + 1], net[4 * j + 2], net[4 * j + 3]]);
        for i in 0..4 {
            rows[4 * j + i] = row[i];
        }
    }
    for i in 0..4 {
        let column = powers([rows[i], rows[4 + i], rows[8 + i], rows[12 + i]]);
        for j in 0..4 {
            out[4 * j + i] = column[j].store();
        }
    }
}

/// `a t + b`.
#[inline(always)]
fn step<V: Four>(a: V, t: V, b: V) -> V {
    a.times(t).plus(b)
}

/// A cubic, its slope, and half its second derivative, by nested products; what is not wanted is worth nothing.
#[inline(always)]
fn nested<const ORDER: usize, V: Four>(c: [V; 4], t: V) -> [V; 3] {
    let mut value = step(c[3], t, c[2]);
    let (mut slope, mut bend) = (c[3], c[3]);
    if ORDER > 0 {
        slope = step(slope, t, value);
    }
    value = step(value, t, c[1]);
    if ORDER > 1 {
        bend = step(bend, t, slope);
    }
    if ORDER > 0 {
        slope = step(slope, t, value);
    }
    [step(value, t, c[0]), slope, bend]
}

/// All that is wanted of a patch, from an expression for its coefficient of a number.
macro_rules! jet {
    ($parts:ident, $u:expr, $v:expr, $k:ident => $coefficient:expr) => {{
        let mut columns = [[V::splat(0.0); 4]; 3];
        for j in 0..4 {
            let mut row = [V::splat(0.0); 4];
            for i in 0..4 {
                let $k = 4 * j + i;
                row[i] = $coefficient;
            }
            let parts = match $parts {
                1 => nested::<0, V>(row, $u),
                3 => nested::<1, V>(row, $u),
                _ => nested::<2, V>(row, $u),
            };
            for k in 0..3 {
                columns[k][j] = parts[k];
            }
        }
        let mut jet = [V::splat(0.0); $parts];
        match $parts {
            1 => jet[0] = nested::<0, V>(columns[0], $v)[0],
            3 => {
                [jet[0], jet[2], _] = nested::<1, V>(columns[0], $v);
                jet[1] = nested::<0, V>(columns[1], $v)[0];
            }
            _ => {
                let twice = V::splat(2.0);
                let [value, slope, bend] = nested::<2, V>(columns[0], $v);
                (jet[0], jet[2], jet[5]) = (value, slope, bend.times(twice));
                let [value, slope, _] = nested::<1, V>(columns[1], $v);
                (jet[1], jet[4]) = (value, slope);
                jet[3] = nested::<0, V>(columns[2], $v)[0].times(twice);
            }
        }
        jet
    }};
}

/// Four samples: for each part of the jet its three coordinates.
#[inline(always)]
pub(super) fn four<const PARTS: usize, V: Four>(net: &Net, u: V, v: V) -> Jet<[V; 3], PARTS> {
    let mut jet = [[V::splat(0.0); 3]; PARTS];
    // Not unrolled: three coordinates at once want more registers than there are.
    for axis in 0..std::hint::black_box(3) {
        let parts = jet!(PARTS, u, v, k => V::splat(net[k][axis]));
        for part in 0..PARTS {
            jet[part][axis] = parts[part];
        }
    }
    jet
}

/// One sample, coordinates in lanes: the same operations in the same order, so the same numbers.
#[inline(always)]
pub(super) fn one<const PARTS: usize, V: Four>(net: &Net, u: V, v: V) -> Jet<V, PARTS> {
    jet!(PARTS, u, v, k => V::load(&net[k]))
}

/// [`coefficients`] in plain code.
pub(super) fn coefficients_of(net: &[Wide; 16]) -> Net {
    let mut out = [[0.0; 4]; 16];
    coefficients(&net.map(|point| Plain::load(&point)), &mut out);
    out
}

/// Position, `du`, `dv`, `duu`, `duv`, `dvv` of one sample, in plain code.
pub(super) fn single(net: &Net, u: f64, v: f64) -> [Vec3; 6] {
    one::<6, Plain>(net, Plain::splat(u), Plain::splat(v)).map(|part| {
        let [x, y, z, _] = part.store();
        Vec3::new(x, y, z)
    })
}

/// The four cubic B-splines over a cell at `t`, and their first and second derivatives: weights of control points.
pub(super) fn basis(t: f64) -> [[f64; 4]; 3] {
    let s = 1.0 - t;
    [
        [s * s * s, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * s - 6.0) * s * s + 4.0, t * t * t].map(|b| b / 6.0),
        [-s * s, (3.0 * t - 4.0) * t, (4.0 - 3.0 * s) * s, t * t].map(|b| b / 2.0),
        [s, 3.0 * t - 2.0, 1.0 - 3.0 * t, t],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd;

    fn net() -> Net {
        std::array::from_fn(|k| {
            let t = k as f64;
            [(1.3 * t).sin(), (0.7 * t).cos(), (t * t).sin(), 0.0]
        })
    }

    /// Coefficients, then jets.
    struct Jets(Net, [f64; 4], [f64; 4]);

    impl simd::Kernel for Jets {
        type Output = (Jet<[Wide; 3], 6>, Jet<[Wide; 3], 3>);

        #[inline(always)]
        fn run<V: Four>(self) -> Self::Output {
            let Jets(net, u, v) = self;
            let mut out = [[0.0; 4]; 16];
            coefficients(&net.map(|point| V::load(&point)), &mut out);
            let (u, v) = (V::load(&u), V::load(&v));
            let stored = |part: [V; 3]| part.map(V::store);
            (four::<6, V>(&out, u, v).map(stored), four::<3, V>(&out, u, v).map(stored))
        }
    }

    #[test]
    fn coefficients_are_the_spline() {
        let (u, v) = ([0.0, 1.0, 0.3, 0.51], [0.0, 1.0, 0.7, 0.02]);
        let (jet, first) = simd::dispatch(Jets(net(), u, v));
        assert_eq!(first[..], jet[..3]);
        for l in 0..4 {
            let (bu, bv) = (basis(u[l]), basis(v[l]));
            for (part, (i, j)) in [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)].into_iter().enumerate() {
                for c in 0..3 {
                    let sum: f64 = (0..16).map(|k| bu[i][k % 4] * bv[j][k / 4] * net()[k][c]).sum();
                    assert!((sum - jet[part][c][l]).abs() < 1e-14, "{part} at ({}, {})", u[l], v[l]);
                }
            }
        }
    }
}
