//! Small mathematics that everything above stands on.

pub(crate) mod par;

pub(crate) mod bounds;
pub(crate) mod circulant;
mod grid;
mod interpolate;
mod jet;
pub(crate) mod newton;
pub(crate) mod pages;
pub(crate) mod simd;
pub(crate) mod sparse;
mod vec3;

pub use grid::Grid;
pub use interpolate::{Components, Interpolate};
pub use jet::{Curvature, SurfaceJet};
pub use vec3::Vec3;
