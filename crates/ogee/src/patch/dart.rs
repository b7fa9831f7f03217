//! Masks at a dart, an interior vertex of three faces and more where one infinitely sharp edge ends.
//!
//! A step is the same seen in a mirror along the crease, so its eigenvectors are odd or even. Odd ones are zero on the
//! crease and at the vertex, and the rule of the crease is all that tells a dart from a smooth vertex: they are the smooth
//! vertex's sines. An even left eigenvector obeys, between its two ends at the crease, a recurrence with constant coefficients, solved by a
//! constant and a cosine; the equations of vertex and crease leave one equation for the frequency
//! (`docs/methods/exact_evaluation.md`, At a dart).

use super::masks::{self, Frame};
use crate::math::Vec3;
use std::f64::consts::{PI, TAU};

/// Weights on a vertex, then neighbours and diagonals by turns, counter-clockwise from the crease.
#[derive(Clone, Debug)]
pub(crate) struct Dart {
    pub(crate) position: Vec<f64>,
    /// Along the crease and a quarter turn from it: exact, and as long as each other on a regular ring.
    pub(crate) tangents: Option<[Vec<f64>; 2]>,
    /// The eigenvalues of the two tangents; they differ but at valence 4.
    pub(crate) eigenvalues: [f64; 2],
}

/// Frequencies between which that of the even tangent lies, times the valence, in half turns: it rises from 1.71 at
/// valence 3 to 2.86; the next is above 3.3. For comparison, 2 is that of the odd tangent.
const FREQUENCIES: [f64; 2] = [1.5, 2.95];

/// To this the wave of the limit position falls from one neighbour to the next: `(7 - 3 sqrt 5) / 2`.
const DECAY: f64 = 0.145_898_033_750_315_46;

impl Dart {
    pub(crate) fn new(valence: usize) -> Dart {
        let mut position = limit(valence).0;
        let sum: f64 = position.iter().sum();
        position.iter_mut().for_each(|weight| *weight /= sum);
        let angle = TAU / valence as f64;
        let across = masks::subdominant(angle);
        let Some(frequency) = even_frequency(valence) else {
            return Dart { position, tangents: None, eigenvalues: [across; 2] };
        };
        let odd = sines(valence);
        let mut even = even(valence, frequency).0;
        // On a regular ring turned by a quarter, the odd mask would give what the even one has to give.
        let regular = |wave: fn(f64) -> f64| {
            let mut ring = vec![0.0];
            for i in 0..valence {
                let (here, next) = (wave(i as f64 * angle), wave((i + 1) as f64 * angle));
                ring.extend([here, here + next]);
            }
            ring
        };
        let value = |mask: &[f64], ring: Vec<f64>| mask.iter().zip(ring).map(|(a, b)| a * b).sum::<f64>();
        let scale = value(&odd, regular(f64::sin)) / value(&even, regular(f64::cos));
        even.iter_mut().for_each(|weight| *weight *= scale);
        let tangents = scale.is_finite().then_some([even, odd]);
        Dart { position, tangents, eigenvalues: [masks::subdominant(frequency), across] }
    }

    /// Masks of position and tangents for the ring as it is numbered from another edge, of which the crease is number
    /// `crease`: the tangents turned towards that edge and the next.
    pub(super) fn seen_from(&self, crease: usize) -> (Vec<f64>, Option<[Vec<f64>; 2]>) {
        let turned = |mut mask: Vec<f64>| {
            mask[1..].rotate_right(2 * crease);
            mask
        };
        let angle = TAU / (self.position.len() / 2) as f64;
        let tangents = self.tangents.as_ref().map(|[along, across]| {
            [0.0, 1.0].map(|edge| {
                let (sin, cos) = ((edge - crease as f64) * angle).sin_cos();
                turned(along.iter().zip(across).map(|(a, b)| cos * a + sin * b).collect())
            })
        });
        (turned(self.position.clone()), tangents)
    }

    /// Position and tangents; neighbours and diagonals counter-clockwise, the first neighbour on the crease. Where there
    /// is no tangent plane, tangents are zero.
    pub(crate) fn frame(&self, vertex: Vec3, edges: &[Vec3], diagonals: &[Vec3]) -> Frame {
        let sum = |weights: &[f64]| {
            let own = weights[0] * vertex;
            let pairs = weights[1..].chunks_exact(2).zip(edges.iter().zip(diagonals));
            pairs.fold(own, |sum, (pair, (&edge, &diagonal))| sum + pair[0] * edge + pair[1] * diagonal)
        };
        let tangents = self.tangents.as_ref();
        let tangents = tangents.map_or([Vec3::ZERO; 2], |[along, across]| [sum(along), sum(across)]);
        Frame { position: sum(&self.position), tangents }
    }
}

/// The odd mask: that of a smooth vertex.
fn sines(valence: usize) -> Vec<f64> {
    let angle = TAU / valence as f64;
    let weight = masks::edge_weight(angle);
    let mut mask = vec![0.0];
    for i in 0..valence {
        let (here, next) = ((i as f64 * angle).sin(), ((i + 1) as f64 * angle).sin());
        mask.extend([weight * here, here + next]);
    }
    mask
}

/// The mask of the limit position, up to a factor.
fn limit(valence: usize) -> (Vec<f64>, f64) {
    let wave = |i: usize| DECAY.powi(i as i32) + DECAY.powi((valence - i) as i32);
    symmetric(valence, 1.0, 5.0, wave)
}

/// The even mask of a frequency, and by how much it fails to be a left eigenvector.
fn even(valence: usize, frequency: f64) -> (Vec<f64>, f64) {
    let value = masks::subdominant(frequency);
    let middle = valence as f64 / 2.0;
    let bend = -4.0 * value * (frequency / 2.0).sin().powi(2);
    symmetric(valence, value, bend, |i| (frequency * (i as f64 - middle)).cos())
}

/// The frequency at which the even mask is a left eigenvector: halving, as sure as the signs at its ends.
fn even_frequency(valence: usize) -> Option<f64> {
    let at = |frequency: f64| even(valence, frequency).1;
    let [mut low, mut high] = FREQUENCIES.map(|f| f * PI / valence as f64);
    let rising = at(high) > 0.0;
    if (at(low) > 0.0) == rising {
        return None;
    }
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            return Some(middle);
        }
        if (at(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
}

/// A mask that is the same in the mirror and a left eigenvector to `value`, but for the equation of the crease; and by
/// how much that one fails.
///
/// With weights `p` at the vertex, `a_i` and `b_i` at neighbours and diagonals, `s = 4 value - 1` and `a` taken as zero
/// on the crease, the equations are `s b_i = (a_i + a_(i+1)) / 4 + p / n^2` and
/// `s^2 a_i = value (a_(i-1) + 2 a_i + a_(i+1)) + 4 (s + 2 value) p / n^2`. `wave` solves the second without `p`, and
/// `bend` is `s^2 - 4 value`.
fn symmetric(valence: usize, value: f64, bend: f64, wave: impl Fn(usize) -> f64) -> (Vec<f64>, f64) {
    let n = valence as f64;
    let s = 4.0 * value - 1.0;
    let vertex = wave(0);
    let share = vertex / (n * n);
    let scale = 4.0 * (s + 2.0 * value) / (n * n * bend);
    let on_crease = |i: usize| i.is_multiple_of(valence);
    let edge = |i: usize| if on_crease(i) { 0.0 } else { scale * (vertex - wave(i)) };
    let edges: Vec<f64> = (0..=valence).map(edge).collect();
    let diagonals: Vec<f64> = edges.windows(2).map(|pair| ((pair[0] + pair[1]) / 4.0 + share) / s).collect();
    let (edge_sum, diagonal_sum) = (edges.iter().sum::<f64>(), diagonals.iter().sum::<f64>());
    // From the equation of the vertex. That of the crease would divide by value - 1/2: zero at valence 4.
    let own = 2.0 * ((value - 1.0 + 2.0 / n) * vertex - edge_sum / 4.0 - value * diagonal_sum);
    let failure = (value - 0.5) * own - share - value * (diagonals[0] + diagonals[valence - 1]);
    let mut mask = vec![vertex];
    for i in 0..valence {
        mask.extend([if i == 0 { own } else { edges[i] }, diagonals[i]]);
    }
    (mask, failure)
}

#[cfg(test)]
mod tests {
    use super::super::chain::ChainBasis;
    use super::super::kind::Kind;
    use super::*;

    const VALENCES: [u32; 13] = [3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 50, 200];

    /// The step on the points that decide the limit, as the rule table has it.
    fn step(valence: u32, crease: u32) -> (ChainBasis, Vec<Vec<(usize, f64)>>) {
        let basis = ChainBasis::new(Kind::Dart { valence, crease });
        let mut rows = basis.all_rows();
        rows.truncate(basis.kind.inner_count());
        (basis, rows)
    }

    /// The largest difference of `mask` times the step and `value` times `mask`, against the largest weight.
    fn failure(mask: &[f64], rows: &[Vec<(usize, f64)>], value: f64) -> f64 {
        let mut gaps: Vec<f64> = mask.iter().map(|weight| -value * weight).collect();
        for (&weight, row) in mask.iter().zip(rows) {
            row.iter().for_each(|&(source, share)| gaps[source] += weight * share);
        }
        let most = |of: &[f64]| of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        most(&gaps) / most(mask)
    }

    #[test]
    fn masks_are_left_eigenvectors() {
        for valence in VALENCES {
            let dart = Dart::new(valence as usize);
            let [along, across] = dart.tangents.clone().expect("a tangent plane");
            for crease in [0, 1, valence / 2, valence - 1] {
                let (basis, rows) = step(valence, crease);
                assert!(failure(&basis.position, &rows, 1.0) < 1e-15);
                assert!((basis.position.iter().sum::<f64>() - 1.0).abs() < 1e-13);
                // The tangents of the basis are turned: combinations of the two.
                let (sin, cos) = (f64::from(crease) * TAU / f64::from(valence)).sin_cos();
                let (sin_next, cos_next) = ((1.0 - f64::from(crease)) * TAU / f64::from(valence)).sin_cos();
                let [first, second] = basis.tangents.clone().expect("tangents");
                let determinant = cos * sin_next + sin * cos_next;
                for (which, value) in dart.eigenvalues.into_iter().enumerate() {
                    let (a, b) = if which == 0 { (sin_next, sin) } else { (-cos_next, cos) };
                    let mask: Vec<f64> =
                        first.iter().zip(&second).map(|(f, s)| (a * f + b * s) / determinant).collect();
                    let gap = failure(&mask, &rows, value);
                    assert!(gap < 1e-13, "valence {valence}, crease {crease}, {which}: {gap:e}");
                }
            }
            let size = |mask: &[f64]| mask.iter().map(|w| w * w).sum::<f64>().sqrt();
            println!("valence {valence}: {:?}, {:?}", dart.eigenvalues, size(&along) / size(&across));
        }
    }

    /// Points on which the three masks are zero shrink faster than both tangents.
    #[test]
    fn nothing_else_shrinks_as_slowly() {
        const STEPS: i32 = 1000;
        for valence in VALENCES.into_iter().filter(|&valence| valence <= 50) {
            let (basis, rows) = step(valence, 0);
            let dart = Dart::new(valence as usize);
            let [along, across] = dart.tangents.expect("a tangent plane");
            let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let mut values: Vec<f64> = (0..rows.len()).map(|i| (1.7 * (i * i) as f64).sin()).collect();
            let mut logarithm = 0.0;
            for step in 0..2 * STEPS {
                // What rounding puts back is taken out again; odd and even masks are at right angles.
                let limit = product(&basis.position, &values);
                values.iter_mut().for_each(|x| *x -= limit);
                for mask in [&along, &across] {
                    // Any vector that the others do not see would do; this one sees the limit, taken out above.
                    let share = product(mask, &values) / product(mask, mask);
                    let own = product(&basis.position, mask);
                    values.iter_mut().zip(mask).for_each(|(x, m)| *x -= share * (m - own));
                }
                let size = product(&values, &values).sqrt();
                if step >= STEPS {
                    logarithm += size.ln();
                }
                values.iter_mut().for_each(|x| *x /= size);
                values =
                    rows.iter().map(|row| row.iter().map(|&(i, w)| w * values[i]).sum::<f64>()).collect();
            }
            let rate = (logarithm / f64::from(STEPS)).exp();
            let [a, b] = dart.eigenvalues;
            println!("valence {valence}: {a:.6} {b:.6}, the rest {rate:.6}");
            assert!(rate < 0.9995 * a.min(b), "valence {valence}: {a} {b} {rate}");
        }
    }
}
