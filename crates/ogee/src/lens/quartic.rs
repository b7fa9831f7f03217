//! Quartic splines with double knots at the integers: C2, two coefficients for each interval.
//!
//! Coefficient `m` belongs to the parameter `m / 2`. All weights here are those of one direction; surfaces take products.

/// Bezier coefficients on `[q, q + 1]` from the coefficients `2 q - 1` to `2 q + 3`.
pub(super) const BEZIER: [[f64; 5]; 5] = [
    [0.25, 0.5, 0.25, 0.0, 0.0],
    [0.0, 0.5, 0.5, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.5, 0.5, 0.0],
    [0.0, 0.0, 0.25, 0.5, 0.25],
];

/// New coefficient `m` when all knots are halved, from old ones: index and weight times 16.
pub(super) fn refined(m: i32) -> [(i32, i64); 3] {
    let first = 2 * m.div_euclid(4);
    match m.rem_euclid(4) {
        0 => [(first - 1, 3), (first, 10), (first + 1, 3)],
        1 => [(first - 1, 1), (first, 6), (first + 1, 9)],
        2 => [(first, 2), (first + 1, 12), (first + 2, 2)],
        _ => [(first + 1, 9), (first + 2, 6), (first + 3, 1)],
    }
}

/// Coefficient `m` of a uniform cubic spline, from that one's coefficients at the integers: index and weight times 12.
pub(super) fn raised(m: i32) -> [(i32, i64); 3] {
    let q = m.div_euclid(2);
    match m.rem_euclid(2) {
        0 => [(q - 1, 1), (q, 10), (q + 1, 1)],
        _ => [(q, 6), (q + 1, 6), (q + 2, 0)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value at `t` of the spline with these coefficients.
    fn value(coefficient: impl Fn(i32) -> f64, t: f64) -> f64 {
        let q = t.floor();
        let x = t - q;
        let row = |weights: &[f64; 5]| {
            (0..5).map(|k| weights[k] * coefficient(2 * q as i32 - 1 + k as i32)).sum::<f64>()
        };
        let binomial = [1.0, 4.0, 6.0, 4.0, 1.0];
        let bernstein = |k: usize| binomial[k] * x.powi(k as i32) * (1.0 - x).powi(4 - k as i32);
        (0..5).map(|k| bernstein(k) * row(&BEZIER[k])).sum()
    }

    fn wobble(m: i32) -> f64 {
        (f64::from(m) * 1.7).sin() + f64::from(m % 3)
    }

    #[test]
    fn refinement_leaves_the_curve_where_it_is() {
        let fine = |m: i32| refined(m).iter().map(|&(k, w)| w as f64 / 16.0 * wobble(k)).sum();
        for step in -20..20 {
            let t = f64::from(step) * 0.13;
            assert!((value(wobble, t) - value(fine, 2.0 * t)).abs() < 1e-13, "at {t}");
        }
    }

    #[test]
    fn a_raised_cubic_is_the_same_curve() {
        let quartic = |m: i32| raised(m).iter().map(|&(k, w)| w as f64 / 12.0 * wobble(k)).sum();
        for step in -20..20 {
            let t = f64::from(step) * 0.13;
            let (q, x) = (t.floor(), t - t.floor());
            let c: Vec<f64> = (-1..3).map(|k| wobble(q as i32 + k)).collect();
            let cubic = ((1.0 - x).powi(3) * c[0]
                + (3.0 * x.powi(3) - 6.0 * x * x + 4.0) * c[1]
                + (-3.0 * x.powi(3) + 3.0 * x * x + 3.0 * x + 1.0) * c[2]
                + x.powi(3) * c[3])
                / 6.0;
            assert!((value(quartic, t) - cubic).abs() < 1e-13, "at {t}");
        }
    }
}
