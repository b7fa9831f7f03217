//! The box around a surface.

use super::Surface;
use crate::limit::{Derivatives, Samples};
use crate::math::Vec3;

/// The lower and the upper corner of a box around points of the surface, nine by nine on each square; what bulges
/// between them is left out. `None` if there is no surface, or a point that is not finite.
pub fn bounds(surface: &dyn Surface) -> Option<[Vec3; 2]> {
    const STEPS: usize = 8;
    let step = |k: usize| k as f64 / STEPS as f64;
    let squares = surface.layout().squares().iter();
    let at: Vec<_> = squares
        .flat_map(|square| {
            (0..=STEPS).flat_map(move |j| (0..=STEPS).map(move |i| square.at(step(i), step(j))))
        })
        .collect();
    let mut samples = Samples::default();
    surface.evaluate(&at, Derivatives::None, &mut samples);
    let first = *samples.position.first()?;
    let whole = samples.position.iter().fold(Some([first; 2]), |whole, &p| {
        whole.filter(|_| p.is_finite()).map(|[a, b]| [a.min(p), b.max(p)])
    });
    whole.filter(|_| first.is_finite())
}
