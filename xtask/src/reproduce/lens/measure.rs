//! How evenly curvature runs: the range of the mean curvature and its gradient.

use super::bezier::{Sample, samples};
use super::methods::Treatment;
use super::nets::Example;

/// Samples along each side of a patch.
const COUNT: usize = 17;

/// Figures of one surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Figures {
    /// The least and the greatest mean curvature, as a share of the reference where there is one.
    pub(super) range: [f64; 2],
    /// The root of the mean square, by area, of the gradient of the mean curvature on the surface.
    pub(super) gradient: f64,
}

/// Measures what an example counts, with the trapezoidal rule on every patch. Poles count for the range.
pub(super) fn figures(treatment: &Treatment, example: &Example) -> Figures {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    let (mut area, mut square) = (0.0, 0.0);
    let mut widen = |position, mean: f64| {
        let share = mean / example.reference.map_or(1.0, |reference| reference(position));
        range = [range[0].min(share), range[1].max(share)];
    };
    for patch in &treatment.patches {
        let samples = samples(patch, COUNT);
        for (i, sample) in samples.into_iter().enumerate() {
            let Some(Sample { position, mean, gradient_squared, area: density }) = sample else { continue };
            if !(example.is_inside)(position) {
                continue;
            }
            let weight = end_weight(i / COUNT) * end_weight(i % COUNT) * density;
            area += weight;
            square += weight * gradient_squared;
            widen(position, mean);
        }
    }
    for pole in &treatment.poles {
        if let Some(curvature) = pole.curvature() {
            widen(pole.position, curvature.mean);
        }
    }
    Figures { range, gradient: (square / area).sqrt() }
}

/// Weights of the trapezoidal rule.
fn end_weight(i: usize) -> f64 {
    if i == 0 || i + 1 == COUNT { 0.5 } else { 1.0 }
}
