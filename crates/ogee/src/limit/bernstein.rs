//! The square of the distance to a bicubic patch, as a polynomial: where it can be small, and where it is convex.
//!
//! In Bernstein form a polynomial is nowhere smaller than its least coefficient, and so are its second derivatives.

use super::walk::narrow;
use crate::math::Vec3;
use crate::patch::Wide;

/// A bicubic patch in Bezier form, `i + 4 j`.
pub(super) type Bezier = [Vec3; 16];

/// The Bezier points of a cell of a uniform bicubic B-spline.
pub(super) fn bezier(net: &[Wide; 16]) -> Bezier {
    let cubic = |[a, b, c, d]: [Vec3; 4]| {
        const SIXTH: f64 = 1.0 / 6.0;
        [
            SIXTH * (a + 4.0 * b + c),
            SIXTH * (4.0 * b + 2.0 * c),
            SIXTH * (2.0 * b + 4.0 * c),
            SIXTH * (b + 4.0 * c + d),
        ]
    };
    let mut points = net.map(narrow);
    for row in points.chunks_exact_mut(4) {
        row.copy_from_slice(&cubic([row[0], row[1], row[2], row[3]]));
    }
    for i in 0..4 {
        let column = cubic([points[i], points[4 + i], points[8 + i], points[12 + i]]);
        for (j, point) in column.into_iter().enumerate() {
            points[4 * j + i] = point;
        }
    }
    points
}

/// Coefficients in each direction: a polynomial of degree six.
const COUNT: usize = 7;

/// A coefficient and its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Least {
    pub(super) value: f64,
    i: usize,
    j: usize,
}

impl Least {
    /// True if it stands at a corner, where it is the value of the polynomial.
    pub(super) fn is_corner(self) -> bool {
        [self.i, self.j].iter().all(|&index| index == 0 || index == COUNT - 1)
    }

    /// Where in the square the polynomial is most like its coefficient.
    pub(super) fn place(self) -> [f64; 2] {
        [self.i, self.j].map(|index| index as f64 / (COUNT - 1) as f64)
    }
}

/// How a polynomial bends over the square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bend {
    /// How far it may lie below a convex one.
    pub(super) deficit: f64,
    /// True if it bends more along the first parameter.
    pub(super) along_first: bool,
}

/// A polynomial of degree six in both parameters of a square. A row has one number more, which is zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square([[f64; COUNT + 1]; COUNT]);

impl Square {
    /// The square of the distance of a patch from the origin.
    pub(super) fn of_distance(patch: &Bezier) -> Square {
        const CUBIC: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
        const SEXTIC: [f64; COUNT] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
        let mut sums = [[0.0; COUNT + 1]; COUNT];
        for coordinate in [|p: Vec3| p.x, |p: Vec3| p.y, |p: Vec3| p.z] {
            let mut rows = [[0.0; 4]; 4];
            for (j, row) in rows.iter_mut().enumerate() {
                for (i, value) in row.iter_mut().enumerate() {
                    *value = CUBIC[i] * CUBIC[j] * coordinate(patch[4 * j + i]);
                }
            }
            for j in 0..4 {
                for l in j..4 {
                    // Products of different rows come twice.
                    let times = if l == j { 1.0 } else { 2.0 };
                    let sum = &mut sums[j + l];
                    for i in 0..4 {
                        let factor = times * rows[j][i];
                        for k in 0..4 {
                            sum[i + k] += factor * rows[l][k];
                        }
                    }
                }
            }
        }
        for (row, across) in sums.iter_mut().zip(SEXTIC) {
            for (value, along) in row.iter_mut().zip(SEXTIC) {
                *value /= across * along;
            }
        }
        Square(sums)
    }

    /// The largest coefficient, signs aside.
    pub(super) fn size(&self) -> f64 {
        self.0.iter().flatten().fold(0.0, |size, value| value.abs().max(size))
    }

    /// The least coefficient, the first of several.
    pub(super) fn least(&self) -> Least {
        let mut least = Least { value: self.0[0][0], i: 0, j: 0 };
        for (j, row) in self.0.iter().enumerate() {
            for (i, &value) in row[..COUNT].iter().enumerate() {
                if value < least.value {
                    least = Least { value, i, j };
                }
            }
        }
        least
    }

    /// Values at the corners, and where they are.
    pub(super) fn corners(&self) -> [([f64; 2], f64); 4] {
        let last = COUNT - 1;
        [
            ([0.0, 0.0], self.0[0][0]),
            ([1.0, 0.0], self.0[0][last]),
            ([0.0, 1.0], self.0[last][0]),
            ([1.0, 1.0], self.0[last][last]),
        ]
    }

    /// How it bends. At a local minimum it is above its least value by the deficit at most.
    ///
    /// Everywhere its second derivatives are a mean of the coefficients of their polynomials, once these are all of the same
    /// degree; and a mean of matrices has no smaller eigenvalue than the least among them.
    pub(super) fn bend(&self) -> Bend {
        let c = &self.0;
        let mut uu = [[0.0; COUNT]; COUNT];
        let mut vv = [[0.0; COUNT]; COUNT];
        let mut uv = [[0.0; COUNT]; COUNT];
        for j in 0..COUNT {
            uu[j] = raised_twice(second_differences(|i| c[j][i]));
        }
        for i in 0..COUNT {
            let column = raised_twice(second_differences(|j| c[j][i]));
            for j in 0..COUNT {
                vv[j][i] = column[j];
            }
        }
        let mut rows = [[0.0; COUNT]; COUNT - 1];
        for (j, row) in rows.iter_mut().enumerate() {
            *row = raised(|i| c[j + 1][i + 1] - c[j + 1][i] - c[j][i + 1] + c[j][i]);
        }
        for i in 0..COUNT {
            let column = raised(|j| rows[j][i]);
            for j in 0..COUNT {
                uv[j][i] = column[j];
            }
        }
        let (mut least, mut along, mut across) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        for j in 0..COUNT {
            for i in 0..COUNT {
                let (a, b, m) = (30.0 * uu[j][i], 30.0 * vv[j][i], 36.0 * uv[j][i]);
                let half = 0.5 * (a - b);
                least = least.min(0.5 * (a + b) - (half * half + m * m).sqrt());
                along = along.max(a.abs());
                across = across.max(b.abs());
            }
        }
        // Half of the square of the diagonal is one.
        Bend { deficit: (-least).max(0.0), along_first: along >= across }
    }

    /// Its two halves along the first parameter, or along the second.
    pub(super) fn halves(&self, along_first: bool) -> [Square; 2] {
        let (mut lower, mut upper) = (*self, *self);
        if along_first {
            for (low, up) in lower.0.iter_mut().zip(&mut upper.0) {
                for step in 1..COUNT {
                    for i in 0..COUNT - step {
                        up[i] = 0.5 * (up[i] + up[i + 1]);
                    }
                    low[step] = up[0];
                }
            }
        } else {
            for step in 1..COUNT {
                for j in 0..COUNT - step {
                    for i in 0..COUNT {
                        upper.0[j][i] = 0.5 * (upper.0[j][i] + upper.0[j + 1][i]);
                    }
                }
                lower.0[step] = upper.0[0];
            }
        }
        [lower, upper]
    }
}

#[inline(always)]
fn second_differences(c: impl Fn(usize) -> f64) -> [f64; COUNT - 2] {
    let mut out = [0.0; COUNT - 2];
    for (i, out) in out.iter_mut().enumerate() {
        *out = c(i) - 2.0 * c(i + 1) + c(i + 2);
    }
    out
}

/// A polynomial of degree five in coefficients of degree six.
#[inline(always)]
fn raised(c: impl Fn(usize) -> f64) -> [f64; COUNT] {
    const DEGREE: usize = COUNT - 1;
    let mut out = [0.0; COUNT];
    out[0] = c(0);
    for (k, out) in out.iter_mut().enumerate().take(DEGREE).skip(1) {
        let share = k as f64 / DEGREE as f64;
        *out = share * c(k - 1) + (1.0 - share) * c(k);
    }
    out[DEGREE] = c(DEGREE - 1);
    out
}

/// A polynomial of degree four in coefficients of degree six.
#[inline(always)]
fn raised_twice(c: [f64; COUNT - 2]) -> [f64; COUNT] {
    [
        c[0],
        (c[0] + 2.0 * c[1]) / 3.0,
        (c[0] + 8.0 * c[1] + 6.0 * c[2]) / 15.0,
        (c[1] + 3.0 * c[2] + c[3]) / 5.0,
        (6.0 * c[2] + 8.0 * c[3] + c[4]) / 15.0,
        (2.0 * c[3] + c[4]) / 3.0,
        c[4],
    ]
}

#[cfg(test)]
mod tests {
    use super::super::bicubic;
    use super::*;

    fn net() -> [Wide; 16] {
        std::array::from_fn(|n| {
            let (i, j) = ((n % 4) as f64, (n / 4) as f64);
            [i - 1.0 + 0.2 * (3.0 * j).sin(), j - 1.3 + 0.1 * (i * j).cos(), (1.7 * i + j).sin(), 0.0]
        })
    }

    fn value(square: &Square, t: [f64; 2]) -> f64 {
        let weights = |t: f64| {
            [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0]
                .into_iter()
                .enumerate()
                .map(move |(i, binomial)| binomial * t.powi(i as i32) * (1.0 - t).powi(6 - i as i32))
        };
        let along = |row: &[f64; 8]| row.iter().zip(weights(t[0])).map(|(value, w)| value * w).sum::<f64>();
        square.0.iter().zip(weights(t[1])).map(|(row, w)| w * along(row)).sum()
    }

    #[test]
    fn it_is_the_square_of_the_distance() {
        let square = Square::of_distance(&bezier(&net()));
        let [left, right] = square.halves(true);
        let [below, above] = square.halves(false);
        for n in 0..36 {
            let [s, t] = [f64::from(n % 6) / 5.0, f64::from(n / 6) / 5.0];
            let patch = bicubic::coefficients_of(&net());
            let wanted = |u, v| bicubic::single(&patch, u, v)[0].length().powi(2);
            let pairs = [
                (value(&square, [s, t]), wanted(s, t)),
                (value(&left, [s, t]), wanted(0.5 * s, t)),
                (value(&right, [s, t]), wanted(0.5 + 0.5 * s, t)),
                (value(&below, [s, t]), wanted(s, 0.5 * t)),
                (value(&above, [s, t]), wanted(s, 0.5 + 0.5 * t)),
            ];
            for (found, wanted) in pairs {
                assert!((found - wanted).abs() < 1e-14 * (1.0 + wanted), "{found} {wanted}");
                assert!(square.least().value <= wanted);
            }
        }
    }
}
