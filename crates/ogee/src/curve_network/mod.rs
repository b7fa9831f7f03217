//! Networks of curves that a surface contains exactly: Abbas and Nasri, Interpolating multiple intersecting curves using
//! Catmull-Clark subdivision surfaces (2004), and their generalised scheme for meeting points without symmetry.
//!
//! A Catmull-Clark surface has a uniform cubic B-spline along every path of regular vertices. Its control points are sums of
//! those of the path and of the rows beside it ([`Complex`]), so moving the path gives it any curve of that kind
//! ([`TargetCurve`]). Where curves meet, the quads around the meeting point form an X-configuration ([`XRing`]), whose rules
//! ([`XMatrix`]) keep all of them exact; [`place()`] finds a ring that makes the surface smooth there.
//!
//! A [`CurveNetwork`] is data that one can build by hand. [`NetworkPlan::new`] is its gate: it names every defect, cuts the
//! curves where they meet, and says how often the cage must be split before there is room for all. [`embed`] goes the
//! whole way to a cage whose surface contains the curves. The page is `docs/methods/curve_network.md`.

mod bare;
mod between;
mod check;
mod complex;
mod defect;
mod embed;
mod fold;
mod incidence;
mod loops;
mod measure;
mod network;
mod place;
mod plan;
mod pre_split;
mod repair;
pub(crate) mod rule;
mod sectors;
mod side_rows;
mod skin;
mod tangent_plane;
mod target_curve;
mod through;
mod tridiagonal;
mod turn_legs;
mod wants;
mod warning;
mod x_configuration;
mod x_matrix;

pub use complex::{Complex, control_point, reposition, rim_start, smooth_crossing};
pub use defect::{NetworkDefect, NetworkError};
pub use embed::{Embedding, XConfiguration, embed};
pub use fold::least_turn;
pub use measure::{MeetingFigures, NetworkFigures};
pub use network::{
    Crossing, CurveNetwork, MeetingOptions, NetworkCurve, NetworkOptions, Placing, PointConstraint, PreSplit,
};
pub use place::{Arrival, Placement, Site, place};
pub use plan::{MeetingVertex, NetworkPlan, Segment, SegmentEnd, ring_normal};
pub use repair::{MeetingPorts, Repaired, Ribbons, TaggedPath, repair};
pub use skin::{BareNetwork, Skin, skin};
pub use tangent_plane::{TangentPlane, kink, straighten};
pub use target_curve::{CurveError, CurveJet, Fit, TargetCurve};
pub use warning::NetworkWarning;
pub use x_configuration::{XRing, default_parameter};
pub use x_matrix::XMatrix;
