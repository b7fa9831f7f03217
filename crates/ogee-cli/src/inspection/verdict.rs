//! What a figure means to somebody who has to decide.

use super::figures::Continuity;

/// How good a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// What is left is rounding.
    Exact,
    /// Nobody sees it, and CAD programs take it.
    Fine,
    /// Worth a look.
    Look,
}

impl Verdict {
    fn of(value: f64, [exact, fine]: [f64; 2]) -> Verdict {
        if value <= exact {
            Verdict::Exact
        } else if value <= fine {
            Verdict::Fine
        } else {
            Verdict::Look
        }
    }

    /// On gap, angle, curvature and kink over smooth joints of a surface of this size.
    ///
    /// Rounding leaves a millionth of a degree at most. Beyond that: kernels join points that are a millionth of a part
    /// apart; angles below 0.01 degrees pass for smooth among CAD users; curvature that jumps by a twentieth and lines
    /// that turn by a degree are lost on the eye.
    pub(crate) fn on(continuity: &Continuity, size: f64) -> [Verdict; 4] {
        let smooth = &continuity.smooth;
        [
            Verdict::of(smooth.gap.max, [1e-9 * size, 1e-6 * size]),
            Verdict::of(smooth.angle_deg.max, [1e-6, 0.01]),
            Verdict::of(smooth.curvature_relative.max, [1e-6, 0.05]),
            Verdict::of(smooth.kink_deg.max, [1e-4, 1.0]),
        ]
    }
}
