//! How far curvature ranges over the faces at a point.
//!
//! Two surfaces for one cage are compared by this: the less curvature has to range over the same faces, the more evenly it runs.
//! Around an extraordinary vertex of a limit surface it has no bound, so samples come no nearer than a 32nd of the faces; on
//! patches the point itself is one more sample.

use crate::limit::LimitJet;

/// The least and the greatest curvature over the faces at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurvatureRange {
    /// Over how much of each side of the faces: all of it, or the half next to the point where other corners of them are
    /// extraordinary too, so that every point has its own.
    pub reach: f64,
    /// Mean curvature: the least, and the greatest.
    pub mean: [f64; 2],
    /// Gauss curvature: the least, and the greatest.
    pub gauss: [f64; 2],
}

/// How often the distance to the point is halved.
const HALVINGS: i32 = 5;

/// Samples along half a side, at each of the distances.
const STEPS: u32 = 4;

impl CurvatureRange {
    /// Where samples lie in a face seen from its corner at the point: on nested squares, each half as large as the one before
    /// and without it, borders included; and the corner itself.
    pub(super) fn places(reach: f64) -> Vec<[f64; 2]> {
        let mut places = vec![[0.0, 0.0]];
        for halving in 1..=HALVINGS {
            let step = reach * 0.5_f64.powi(halving) / f64::from(STEPS);
            let innermost = if halving == HALVINGS { STEPS } else { STEPS + 1 };
            for i in 0..=2 * STEPS {
                let from = if i < innermost { innermost } else { 0 };
                places.extend((from..=2 * STEPS).map(|j| [f64::from(i) * step, f64::from(j) * step]));
            }
        }
        places
    }

    /// Of samples; those without curvature count for nothing.
    pub(super) fn of(samples: impl Iterator<Item = LimitJet>, reach: f64) -> CurvatureRange {
        let widened = |range: Option<[f64; 2]>, x: f64| {
            Some(range.map_or([x; 2], |[least, greatest]| [least.min(x), greatest.max(x)]))
        };
        let curvatures = samples.filter_map(|sample| sample.curvature());
        let finite = curvatures.filter(|found| found.mean.is_finite() && found.gauss.is_finite());
        let (mean, gauss) = finite.fold((None, None), |(mean, gauss), found| {
            (widened(mean, found.mean), widened(gauss, found.gauss))
        });
        CurvatureRange { reach, mean: mean.unwrap_or_default(), gauss: gauss.unwrap_or_default() }
    }

    /// The greatest mean curvature less the least.
    pub fn mean_span(&self) -> f64 {
        self.mean[1] - self.mean[0]
    }

    /// The greatest Gauss curvature less the least.
    pub fn gauss_span(&self) -> f64 {
        self.gauss[1] - self.gauss[0]
    }
}
