//! Measuring instruments: what a reflected ray sees, lines on the surface, continuity over joints.
//!
//! They look at a [`Surface`]: the limit of a cage ([`LimitView`]) or NURBS patches ([`PatchView`]), cut into squares of
//! parameters that share whole sides.

mod continuity;
mod curvature_range;
mod extraordinary;
mod layout;
mod limit_view;
mod lines;
mod patch_view;
mod reflection;
mod report;
mod sides;
mod statistics;

pub use continuity::{Continuity, FRACTIONS, JointPlace, Joints, Metric};
pub use curvature_range::CurvatureRange;
pub use extraordinary::{
    Behaviour, Cause, Extraordinary, ExtraordinaryPoint, LEVELS, PointWithoutPlane, Ring, Sector, SectorKind,
};
pub use layout::{Joint, Layout, Side, Square};
pub use limit_view::LimitView;
pub use lines::{Fairness, LevelLine, LevelLines, Levels, LineOptions, LinePoint, LinesError, level_lines};
pub use patch_view::{PatchView, PatchViewError};
pub use reflection::{Field, FieldJet, Hit, HitJet, NormalJet, PlaneLight, Ray, Viewer};
pub use report::{Report, ReportOptions};
pub use statistics::{Bend, CurvatureStatistics, Distribution, Histogram};

use crate::limit::{Derivatives, Samples};
use crate::math::Vec3;
use crate::mesh::FaceId;
use crate::patch::Location;

/// Curvature below this share of one over the size of a surface is that of a plane: nobody sees it, and rounding makes as
/// much.
pub const FLAT: f64 = 1e-6;

/// A surface made of faces with parameters in `[0, 1]`, joined along their sides.
pub trait Surface: Sync {
    /// How its faces lie side by side.
    fn layout(&self) -> &Layout;

    /// Points in the order asked, on all cores; derivatives are with respect to the parameters of the location.
    fn evaluate(&self, at: &[Location], what: Derivatives, out: &mut Samples);

    /// The name of a place in terms of the cage.
    fn address(&self, at: Location) -> Address;
}

/// A place on the surface of a cage, as files and reports name it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Address {
    /// The face of the cage.
    pub face: FaceId,
    /// Which corner of it; `None` where the face has one square of parameters.
    pub corner: Option<u32>,
    /// Parameters in `[0, 1]`.
    pub u: f64,
    /// The second of them.
    pub v: f64,
}

/// The box of a surface by samples, five along each side of a square; `None` if it has no face or a point is not finite.
pub fn bounding_box(surface: &dyn Surface) -> Option<[Vec3; 2]> {
    /// Squares that are sampled at once.
    const BLOCK: usize = 1024;
    const STEPS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
    let mut samples = Samples::default();
    let mut found: Option<[Vec3; 2]> = None;
    for block in surface.layout().squares().chunks(BLOCK) {
        let grid = |t: f64| STEPS.map(|s| [s, t]);
        let places: Vec<Location> = block
            .iter()
            .flat_map(|square| STEPS.into_iter().flat_map(grid).map(|[s, t]| square.at(s, t)))
            .collect();
        surface.evaluate(&places, Derivatives::None, &mut samples);
        for &point in &samples.position {
            if !point.is_finite() {
                return None;
            }
            let [low, high] = found.unwrap_or([point; 2]);
            found = Some([low.min(point), high.max(point)]);
        }
    }
    found
}
