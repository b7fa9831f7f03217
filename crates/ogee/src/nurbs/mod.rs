//! Polynomial B-spline curves and surfaces of any degree, and the shells made of them.

pub(crate) mod basis;
pub(crate) mod curve;
mod insertion;
mod knots;
mod quadrature;
mod shell;
mod surface;

pub use curve::NurbsCurve;
pub use knots::KnotVector;
pub(crate) use knots::SharedKnots;
pub use quadrature::gauss;
pub use shell::{EdgeUse, FaceAddress, Quarters, Shell, ShellEdge, ShellFace, Side};
pub use surface::NurbsSurface;

pub use crate::math::SurfaceJet;
