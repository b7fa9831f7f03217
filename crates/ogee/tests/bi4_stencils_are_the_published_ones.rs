//! The matrix of a bi-4 step, its eigenvalues and its masks, in exact arithmetic; and the stencils once more, from their guides.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod lens_nets;
mod modular;

use golden::{index, list};
use lens_nets::document;
use modular::{Field, fields};
use ogee::lens::{
    BIQUARTIC_POINTS, ExactRow, LIMIT_MASKS, MATRIX_DENOMINATOR, Symmetry, biquartic_matrix, degree_raising,
    lattice_index, lattice_point,
};
use serde_json::Value;

/// An integer, however long, that is written as a number or as text.
fn integer(value: &Value) -> i128 {
    value.as_str().map_or_else(|| i128::from(value.as_i64().unwrap()), |text| text.parse().unwrap())
}

fn integers(value: &Value) -> Vec<i128> {
    list(value).iter().map(integer).collect()
}

fn weight(row: &ExactRow, number: usize) -> i64 {
    row.iter().find(|term| term.0 == number).map_or(0, |term| term.1)
}

#[test]
fn the_matrix_is_that_of_the_tables() {
    let (matrix, golden) = (biquartic_matrix(), document("bi4_matrix_60"));
    assert_eq!(integer(&golden["denominator"]), i128::from(MATRIX_DENOMINATOR));
    assert_eq!(matrix.len(), BIQUARTIC_POINTS);
    for (row, wanted) in matrix.iter().zip(list(&golden["rows"])) {
        let wanted: ExactRow =
            list(wanted).iter().map(|t| (index(&t[0]) as usize, integer(&t[1]) as i64)).collect();
        assert_eq!(*row, wanted);
        assert_eq!(row.iter().map(|term| term.1).sum::<i64>(), MATRIX_DENOMINATOR);
        assert!(row.iter().map(|term| term.1.abs()).sum::<i64>() <= 10_271 * MATRIX_DENOMINATOR / 10_000);
        assert!(row.iter().all(|&(number, _)| number <= 24));
    }
    let stencils = document("bi4_stencils");
    for (number, stencil) in stencils["stencils"].as_object().unwrap() {
        let row = &matrix[number.parse::<usize>().unwrap() - 1];
        let scale = i128::from(MATRIX_DENOMINATOR) / integer(&stencil["denominator"]);
        for (k, numerator) in (1..).zip(integers(&stencil["numerators"])) {
            assert_eq!(i128::from(weight(row, k)), scale * numerator, "A({number}, {k})");
        }
    }
    let raising = document("degree_raise_25_to_60");
    for (row, wanted) in degree_raising().iter().zip(list(&raising["numerators"])) {
        for (number, wanted) in list(wanted).iter().enumerate() {
            assert_eq!(i128::from(weight(row, number)), integer(wanted));
        }
    }
}

#[test]
fn the_matrix_has_the_symmetries_of_the_grid() {
    let matrix = biquartic_matrix();
    for symmetry in [Symmetry::Rotation, Symmetry::MirrorX, Symmetry::MirrorY] {
        for number in 1..=BIQUARTIC_POINTS {
            for &(old, numerator) in &matrix[number - 1] {
                let image = &matrix[symmetry.image(number) - 1];
                assert_eq!(weight(image, symmetry.image(old)), numerator, "{symmetry:?} ({number}, {old})");
            }
        }
    }
}

/// Coefficient `m` of the quartic spline with double knots that is `t^power`: the polar form at its four knots.
fn power_coefficient(field: Field, m: i32, power: usize) -> u64 {
    let q = m.div_euclid(2);
    let knots = if m.rem_euclid(2) == 1 { [q, q, q + 1, q + 1] } else { [q - 1, q, q, q + 1] };
    let mut symmetric = [1_i128, 0, 0, 0, 0];
    for knot in knots {
        for k in (1..5).rev() {
            symmetric[k] += symmetric[k - 1] * i128::from(knot);
        }
    }
    field.fraction(symmetric[power], [1, 4, 6, 4, 1][power])
}

/// `factor u^a v^b`.
type Term = (i128, usize, usize);

/// Coefficients of the spline `sum of factor u^a v^b` at the points 1 to 60.
fn polynomial(field: Field, terms: &[Term]) -> Vec<u64> {
    (1..=BIQUARTIC_POINTS)
        .map(|number| {
            let (i, j) = lattice_point(number);
            let term = |&(factor, a, b): &Term| {
                let powers = field.mul(power_coefficient(field, i, a), power_coefficient(field, j, b));
                (field.integer(factor), powers)
            };
            field.dot(terms.iter().map(term))
        })
        .collect()
}

/// `1`, `f1 = u^2 - v^2`, `f2 = 2 u v`, `f1^2`, `f1 f2`, `f2^2`, and four to the power of their degree.
fn eigenfunctions(field: Field) -> [(Vec<u64>, i128); 6] {
    let terms: [(&[Term], i128); 6] = [
        (&[(1, 0, 0)], 1),
        (&[(1, 2, 0), (-1, 0, 2)], 4),
        (&[(2, 1, 1)], 4),
        (&[(1, 4, 0), (-2, 2, 2), (1, 0, 4)], 16),
        (&[(2, 3, 1), (-2, 1, 3)], 16),
        (&[(4, 2, 2)], 16),
    ];
    terms.map(|(terms, power)| (polynomial(field, terms), power))
}

#[test]
fn powers_of_the_square_are_eigenfunctions_and_masks_are_dual_to_them() {
    let matrix = biquartic_matrix();
    let scale = i128::from(MATRIX_DENOMINATOR);
    for field in fields(3) {
        let functions = eigenfunctions(field);
        for (function, power) in &functions {
            for (row, &value) in matrix.iter().zip(function) {
                let terms =
                    row.iter().map(|&(number, n)| (field.fraction(n.into(), scale), function[number - 1]));
                assert_eq!(field.dot(terms), field.mul(value, field.fraction(1, *power)));
            }
        }
        for (a, mask) in LIMIT_MASKS.iter().enumerate() {
            let weights = mask.numerators.map(|n| field.fraction(n, mask.denominator));
            for (b, (function, _)) in functions.iter().enumerate() {
                let value = field.dot(weights.iter().copied().zip(function.iter().copied()));
                assert_eq!(value, u64::from(a == b), "mask {a} on function {b}");
            }
            let eigenvalue = field.fraction(1, functions[a].1);
            for column in 1..=24 {
                let terms =
                    (0..24).map(|k| (weights[k], field.fraction(weight(&matrix[k], column).into(), scale)));
                assert_eq!(field.dot(terms), field.mul(eigenvalue, weights[column - 1]));
            }
        }
    }
    let layout = document("layout");
    let field = fields(1)[0];
    let functions = eigenfunctions(field);
    for (k, point) in list(&layout["bi4_characteristic_times_6"]).iter().enumerate() {
        for (coordinate, value) in integers(point).into_iter().enumerate() {
            assert_eq!(field.mul(6, functions[1 + coordinate].0[k]), field.integer(value));
        }
    }
}

#[test]
fn masks_are_those_of_the_tables() {
    let golden = document("bi4_masks_24");
    for (mask, name) in LIMIT_MASKS.iter().zip(["1", "f1", "f2", "f1f1", "f1f2", "f2f2"]) {
        let wanted = &golden["masks"][name];
        assert_eq!(mask.denominator, integer(&wanted["denominator"]));
        assert_eq!(mask.numerators.to_vec(), integers(&wanted["numerators"]));
        for (&numerator, float) in mask.numerators.iter().zip(list(&wanted["float"])) {
            let value = numerator as f64 / mask.denominator as f64;
            assert!((value - float.as_f64().unwrap()).abs() < 1e-15);
        }
    }
}

/// The factors of the paper's characteristic polynomial that are no powers of `x`: coefficients, that of the highest power first, and
/// how often each stands. The leading coefficient of the second long one is `2^52`.
const FACTORS: [(&[i128], usize); 9] = [
    (&[1, -1], 1),
    (&[4, -1], 2),
    (&[16, -1], 3),
    (&[64, -1], 3),
    (&[256, -1], 2),
    (&[134_217_728, -2_110_592, 7_487], 1),
    (&[4_503_599_627_370_496, -75_230_110_285_824, 62_486_728_704, 410_899_717], 1),
    (
        &[
            288_230_376_151_711_744,
            -7_667_169_458_388_992,
            19_671_721_967_616,
            397_951_106_240,
            -1_115_103_427,
        ],
        1,
    ),
    (
        &[
            2_361_183_241_434_822_606_848,
            -19_679_041_521_748_803_584,
            35_225_654_240_739_328,
            91_463_875_469_312,
            -286_255_219_911,
        ],
        1,
    ),
];

/// Times `2^(26 * 60)` both sides have integer coefficients. Rows of `2^26 A` have absolute sums below `2^26.04`, so the left side's
/// coefficient of `x^(60 - k)` is below `(60 choose k) 2^(26.04 k) < 2^1623`, and the right side's is smaller: 27 primes leave no doubt.
#[test]
fn the_characteristic_polynomial_is_that_of_the_paper() {
    let matrix = biquartic_matrix();
    for field in fields(27) {
        let scale = field.fraction(1, MATRIX_DENOMINATOR.into());
        let dense = matrix.iter().map(|row| {
            let mut dense = vec![0; BIQUARTIC_POINTS];
            for &(number, n) in row {
                dense[number - 1] = field.mul(field.integer(n.into()), scale);
            }
            dense
        });
        let found = field.characteristic_polynomial(dense.collect());
        let mut wanted = vec![0; 37];
        wanted[36] = 1;
        for (factor, times) in FACTORS {
            let monic: Vec<u64> = factor.iter().rev().map(|&c| field.fraction(c, factor[0])).collect();
            for _ in 0..times {
                wanted = field.product(&wanted, &monic);
            }
        }
        assert_eq!(found, wanted, "modulo {}", field.0);
    }
}

#[test]
fn the_seventh_eigenvalue_is_below_the_square_of_the_second() {
    let matrix = biquartic_matrix();
    // Rows 25 to 60 have no weights on the points that they make, which adds the eigenvalue 0 alone.
    let inner =
        faer::Mat::from_fn(24, 24, |i, j| weight(&matrix[i], j + 1) as f64 / MATRIX_DENOMINATOR as f64);
    let mut moduli: Vec<f64> = inner.eigenvalues().unwrap().iter().map(|z| z.re.hypot(z.im)).collect();
    moduli.sort_by(|a, b| b.total_cmp(a));
    for (found, wanted) in moduli.iter().zip([1.0, 0.25, 0.25, 0.0625, 0.0625, 0.0625]) {
        assert!((found - wanted).abs() < 1e-10, "{found}");
    }
    assert!((moduli[6] - 0.020388).abs() < 1e-6, "{}", moduli[6]);
    // Every root of the factors is found.
    for (factor, _) in FACTORS {
        for root in roots(factor) {
            let distance = moduli.iter().map(|x| (x - root.abs()).abs()).fold(f64::INFINITY, f64::min);
            assert!(distance < 1e-10, "{root}: {distance:e}");
        }
    }
}

/// Real roots in `[-0.1, 1.1]` by bisection between changes of sign.
fn roots(factor: &[i128]) -> Vec<f64> {
    let value = |x: f64| factor.iter().fold(0.0, |sum, &c| sum * x + c as f64 / factor[0] as f64);
    let at = |k: i32| f64::from(k) * 1e-5 + 3e-7;
    (-10_000..110_000)
        .filter(|&k| (value(at(k)) > 0.0) != (value(at(k + 1)) > 0.0))
        .map(|k| {
            let (mut low, mut high) = (at(k), at(k + 1));
            for _ in 0..60 {
                let middle = (low + high) / 2.0;
                if (value(middle) > 0.0) == (value(low) > 0.0) { low = middle } else { high = middle }
            }
            low
        })
        .collect()
}

/// A polynomial in `s` and `t` without powers above the second of either: `[a][b]` is the coefficient of `s^a t^b`.
type Jet = [[u64; 3]; 3];

fn times(field: Field, f: &Jet, g: &Jet) -> Jet {
    let mut out = [[0; 3]; 3];
    for (a, b, c, d) in quadruples() {
        if a + c < 3 && b + d < 3 {
            out[a + c][b + d] = field.add(out[a + c][b + d], field.mul(f[a][b], g[c][d]));
        }
    }
    out
}

fn quadruples() -> impl Iterator<Item = (usize, usize, usize, usize)> {
    (0..81).map(|k| (k / 27, k / 9 % 3, k / 3 % 3, k % 3))
}

fn bernstein(field: Field, degree: usize, k: usize, x: &Jet) -> Jet {
    let binomial = [1, 5, 10, 10, 5, 1];
    let factor = if degree == 5 { binomial[k] } else { [1, 2, 1][k] };
    let mut one_minus = x.map(|row| row.map(|c| field.sub(0, c)));
    one_minus[0][0] = field.add(one_minus[0][0], 1);
    let mut out = [[0; 3]; 3];
    out[0][0] = factor;
    (0..degree).fold(out, |product, i| times(field, &product, if i < k { x } else { &one_minus }))
}

/// The 27 functions that a guide is made of, in `w = (u + s, v + t)`: degree 5 in `x` and in `y` in the lower three rows, of degree 2 in
/// `x` in the upper three.
fn guide_functions(field: Field, u: u64, v: u64) -> Vec<Jet> {
    let half = field.fraction(1, 2);
    let double = |a: u64| field.add(a, a);
    let square = |a: u64| field.mul(a, a);
    // (x + 1) / 2 and y / 2, with x = (u + s)^2 - (v + t)^2 and y = 2 (u + s) (v + t).
    let mut x: Jet = [[0; 3]; 3];
    x[0][0] = field.add(field.sub(square(u), square(v)), 1);
    (x[1][0], x[2][0]) = (double(u), 1);
    (x[0][1], x[0][2]) = (field.sub(0, double(v)), field.sub(0, 1));
    let x = x.map(|row| row.map(|c| field.mul(c, half)));
    let y: Jet = [[field.mul(u, v), u, 0], [v, 1, 0], [0, 0, 0]];
    let products = |rows: std::ops::Range<usize>, degree: usize| {
        rows.flat_map(move |j| {
            (0..=degree)
                .map(move |i| times(field, &bernstein(field, degree, i, &x), &bernstein(field, 5, j, &y)))
        })
    };
    products(0..3, 5).chain(products(3..6, 2)).collect()
}

#[test]
fn guides_give_the_stencils() {
    let matrix = biquartic_matrix();
    for field in fields(3) {
        let fraction = |a: i128, b: i128| field.fraction(a, b);
        let minus = |a: u64| field.sub(0, a);
        // Value, slope and half the second derivative at a knot from the coefficients around it.
        let taylor = [
            [fraction(1, 4), fraction(1, 2), fraction(1, 4)],
            [minus(1), 0, 1],
            [fraction(3, 2), minus(3), fraction(3, 2)],
        ];
        // And back, for knots at half the distance.
        let coefficients = [
            [1, fraction(-1, 4), fraction(1, 24)],
            [1, 0, fraction(-1, 24)],
            [1, fraction(1, 4), fraction(1, 24)],
        ];
        let (mut conditions, mut right) = (Vec::new(), Vec::new());
        for (u, v) in [(1, 0), (0, 1), (1, 1)] {
            let functions = guide_functions(field, u, v);
            for a in 0..3 {
                for b in 0..3 {
                    conditions.push(functions.iter().map(|jet| jet[a][b]).collect());
                    let mut row = vec![0; 24];
                    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                        let number = lattice_index(2 * u as i32 + i as i32 - 1, 2 * v as i32 + j as i32 - 1);
                        row[number - 1] = field.add(row[number - 1], field.mul(taylor[a][i], taylor[b][j]));
                    }
                    right.push(row);
                }
            }
        }
        let guide = field.solve(conditions, right);
        // The new coefficient at offset (i, j), from -1 to 1, around a knot of the new net, in the old points.
        let sample = |(u, v): (i128, i128), (i, j): (usize, usize)| -> Vec<u64> {
            let functions = guide_functions(field, fraction(u, 2), fraction(v, 2));
            let weights: Vec<u64> = functions
                .iter()
                .map(|jet| {
                    let places = (0..3).flat_map(|a| (0..3).map(move |b| (a, b)));
                    field.dot(
                        places.map(|(a, b)| (jet[a][b], field.mul(coefficients[i][a], coefficients[j][b]))),
                    )
                })
                .collect();
            (0..24).map(|c| field.dot(weights.iter().copied().zip(guide.iter().map(|row| row[c])))).collect()
        };
        type Place = ((i128, i128), (usize, usize));
        let wanted: [(usize, &[Place]); 5] = [
            (1, &[((1, 0), (0, 1))]),
            (2, &[((1, 0), (0, 2)), ((0, 1), (2, 0)), ((1, 1), (0, 0))]),
            (5, &[((1, 0), (1, 1))]),
            (6, &[((1, 0), (1, 2)), ((1, 1), (1, 0))]),
            (7, &[((1, 1), (1, 1))]),
        ];
        for (number, places) in wanted {
            let samples: Vec<Vec<u64>> = places.iter().map(|&(knot, offset)| sample(knot, offset)).collect();
            for column in 1..=24 {
                let sum = samples.iter().fold(0, |sum, row| field.add(sum, row[column - 1]));
                let mean = field.mul(sum, fraction(1, places.len() as i128));
                let numerator = i128::from(weight(&matrix[number - 1], column));
                assert_eq!(mean, fraction(numerator, MATRIX_DENOMINATOR.into()), "A({number}, {column})");
            }
        }
    }
}

/// An integer of any length, written as text.
fn long_integer(field: Field, value: &Value) -> u64 {
    let text = value.as_str().unwrap();
    let digits = text.trim_start_matches('-').chars().map(|digit| u64::from(digit.to_digit(10).unwrap()));
    let absolute = digits.fold(0, |sum, digit| field.add(field.mul(sum, 10), digit));
    if text.starts_with('-') { field.sub(0, absolute) } else { absolute }
}

#[test]
fn the_refit_operator_of_the_tables_is_exact() {
    let golden = document("remesh_fig10");
    let (matrix, raising) = (biquartic_matrix(), degree_raising());
    for field in fields(2) {
        let dense = |rows: &[ExactRow], below: i128| -> Vec<Vec<u64>> {
            let row =
                |row: &ExactRow| (1..=24).map(|k| field.fraction(weight(row, k).into(), below)).collect();
            rows[12..].iter().map(row).collect()
        };
        let (step, raise) = (dense(&matrix, MATRIX_DENOMINATOR.into()), dense(&raising, 144));
        let product = |right: &[Vec<u64>]| -> Vec<Vec<u64>> {
            let entry = |i: usize, j: usize| field.dot(step.iter().zip(right).map(|(a, b)| (a[i], b[j])));
            (0..24).map(|i| (0..24).map(|j| entry(i, j)).collect()).collect()
        };
        let operator = field.solve(product(&step), product(&raise));
        let below = field.inverse(long_integer(field, &golden["Q_denominator"]));
        for (row, wanted) in operator.iter().zip(list(&golden["Q_numerators"])) {
            let exact = |value: &Value| field.mul(long_integer(field, value), below);
            assert_eq!(*row, list(wanted).iter().map(exact).collect::<Vec<_>>());
        }
        assert_eq!(operator.len(), list(&golden["Q_numerators"]).len());
    }
}
