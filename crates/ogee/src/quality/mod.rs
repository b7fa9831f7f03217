//! Measuring instruments: what a reflected ray sees, lines on the surface, continuity over joints.
//!
//! They look at a [`Surface`]: the limit of a cage ([`LimitView`]) or NURBS patches ([`PatchView`]), cut into squares of
//! parameters that share whole sides.

mod continuity;
mod extraordinary;
mod layout;
mod limit_view;
mod patch_view;
mod reflection;
mod report;
mod statistics;

pub use continuity::{Continuity, FRACTIONS, JointPlace, Joints, Metric};
pub use extraordinary::{
    Behaviour, Cause, Extraordinary, ExtraordinaryPoint, LEVELS, PointWithoutPlane, Ring, Sector, SectorKind,
};
pub use layout::{Joint, Layout, Side, Square};
pub use limit_view::LimitView;
pub use patch_view::{PatchView, PatchViewError};
pub use reflection::{Field, FieldJet, Hit, HitJet, NormalJet, PlaneLight, Ray, Viewer};
pub use report::{Report, ReportOptions};
pub use statistics::{Bend, CurvatureStatistics, Distribution, Histogram};

use crate::limit::{Derivatives, Samples};
use crate::mesh::FaceId;
use crate::patch::Location;

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
