//! Polynomial B-spline curves and surfaces of any degree, and the shells and parts made of them.

mod curve;
mod insertion;
mod knots;
mod shell;
mod surface;

pub use curve::NurbsCurve;
pub use knots::KnotVector;
pub use shell::{EdgeUse, FaceAddress, Shell, ShellEdge, ShellFace, Side};
pub use surface::NurbsSurface;
