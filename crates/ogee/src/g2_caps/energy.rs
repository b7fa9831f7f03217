//! Energies of a sector, as factors: rows whose squares add up to the energy.

use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef};

use super::COEFFICIENTS;
use super::fan::SECTOR;
use super::spline::{BREAKS, Functions, functions};
use crate::nurbs::gauss;

/// Gauss points on each piece, in each direction.
const POINTS: usize = 10;

/// The monomials of two variables up to degree three, without the constant; the four of degree three come last.
const MONOMIALS: [(usize, usize); 9] =
    [(1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];

/// Parameters and weights of a rule for `[0, 1]` that knows of the knot.
fn rule() -> Vec<(f64, f64)> {
    let points = gauss(POINTS);
    BREAKS
        .windows(2)
        .flat_map(|piece| {
            let (middle, half) = ((piece[0] + piece[1]) / 2.0, (piece[1] - piece[0]) / 2.0);
            points.iter().map(move |&(x, weight)| (middle + half * x, half * weight)).collect::<Vec<_>>()
        })
        .collect()
}

/// The functions and their derivatives up to some order, at every point of the rule in one direction.
fn samples(orders: usize) -> Vec<(f64, Vec<Functions>)> {
    let at = |(t, weight)| (weight, (0..=orders).map(|order| functions(order, t)).collect());
    rule().into_iter().map(at).collect()
}

/// The triangular factor of rows that whose squares add up to an energy.
fn factor(rows: &[Vec<f64>]) -> Mat<f64> {
    let all = Mat::from_fn(rows.len(), SECTOR, |i, j| rows[i][j]);
    all.qr().thin_R().to_owned()
}

/// Adds `weight` times a mixed derivative, given by the functions of both directions.
fn add(row: &mut [f64], u: &Functions, v: &Functions, weight: f64) {
    for (i, &along) in u.iter().enumerate().filter(|term| *term.1 != 0.0) {
        for (j, &value) in v.iter().enumerate() {
            row[COEFFICIENTS * i + j] += weight * along * value;
        }
    }
}

/// Parametric: the squares of all fourth derivatives by the parameters, with binomial weights. It shapes the planar map.
pub(super) fn parametric() -> Mat<f64> {
    const BINOMIALS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
    let samples = samples(4);
    let mut rows = Vec::new();
    for (weight_u, u) in &samples {
        for (weight_v, v) in &samples {
            for (order, binomial) in BINOMIALS.into_iter().enumerate() {
                let mut row = vec![0.0; SECTOR];
                add(&mut row, &u[order], &v[4 - order], (weight_u * weight_v * binomial).sqrt());
                rows.push(row);
            }
        }
    }
    factor(&rows)
}

/// Planar: the squares of all third derivatives of a function by the coordinates of the plane that the map leads to, integrated
/// over the image of the sector. Quadratic polynomials of the plane cost nothing, wherever the parameter lines run. `None` if the map
/// folds.
pub(super) fn planar(map: &[[f64; 2]]) -> Option<Mat<f64>> {
    let samples = samples(3);
    let mut rows = Vec::new();
    for (weight_u, u) in &samples {
        for (weight_v, v) in &samples {
            let jets = [0, 1].map(|axis| {
                MONOMIALS.map(|(a, b)| {
                    let mut derivative = vec![0.0; SECTOR];
                    add(&mut derivative, &u[a], &v[b], 1.0 / (factorial(a) * factorial(b)));
                    derivative.iter().zip(map).map(|(weight, point)| weight * point[axis]).sum::<f64>()
                })
            });
            let determinant = jets[0][0] * jets[1][1] - jets[0][1] * jets[1][0];
            if determinant.is_nan() || determinant <= 0.0 {
                return None;
            }
            let inverse =
                composition(&jets).qr().solve(Mat::<f64>::identity(MONOMIALS.len(), MONOMIALS.len()));
            for (third, &(p, q)) in MONOMIALS.iter().enumerate().skip(5) {
                let area = weight_u * weight_v * determinant;
                let scale = (area * binomial(p)).sqrt() * factorial(p) * factorial(q);
                rows.push(derivative(inverse.as_ref(), third, u, v, scale));
            }
        }
    }
    Some(factor(&rows))
}

/// A derivative by the plane: from Taylor coefficients by the parameters.
fn derivative(
    inverse: MatRef<'_, f64>,
    third: usize,
    u: &[Functions],
    v: &[Functions],
    scale: f64,
) -> Vec<f64> {
    let mut row = vec![0.0; SECTOR];
    for (k, &(a, b)) in MONOMIALS.iter().enumerate() {
        let taylor = scale * inverse[(third, k)] / (factorial(a) * factorial(b));
        add(&mut row, &u[a], &v[b], taylor);
    }
    row
}

/// From the Taylor coefficients of a function of the plane to those of the function of the parameters: column `(p, q)` holds
/// those of `x^p y^q`.
fn composition(jets: &[[f64; 9]; 2]) -> Mat<f64> {
    let product = |f: &[f64; 9], g: &[f64; 9]| {
        let mut out = [0.0; 9];
        for (&(a, b), f) in MONOMIALS.iter().zip(f) {
            for (&(c, d), g) in MONOMIALS.iter().zip(g) {
                if let Some(place) = MONOMIALS.iter().position(|&monomial| monomial == (a + c, b + d)) {
                    out[place] += f * g;
                }
            }
        }
        out
    };
    let columns = MONOMIALS.map(|(p, q)| {
        let factors = std::iter::repeat_n(&jets[0], p).chain(std::iter::repeat_n(&jets[1], q));
        factors.copied().reduce(|power, next| product(&power, &next)).unwrap_or_default()
    });
    Mat::from_fn(9, 9, |i, j| columns[j][i])
}

fn factorial(n: usize) -> f64 {
    [1.0, 1.0, 2.0, 6.0][n]
}

/// `3` over `p`.
fn binomial(p: usize) -> f64 {
    [1.0, 3.0, 3.0, 1.0][p]
}
