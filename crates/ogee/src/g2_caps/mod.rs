//! G2 caps: around every extraordinary vertex surfaces of degree seven that are curvature-continuous among themselves and
//! to the bicubic surface around them.
//!
//! A construction of our own; the method's page is `docs/methods/g2_caps.md`. A cap has one surface a sector; its coefficients are
//! linear in the vertices of the two-ring, by weights that depend on the class of the vertex alone.

mod apply;
mod class;
mod columns;
mod site;
mod tables;
mod tiling;
mod weights;

pub use apply::{knots, nets};
pub use class::{CapClass, CornerAngle};
pub use site::{Obstacle, Site, cap_points, site};
pub use tables::{encode, is_solvable, shipped_classes, table_name, weights};
pub use weights::Weights;

pub(crate) use tiling::{PlacedCap, Tiling, Uncapped};

/// Degree of a sector in both directions.
pub const DEGREE: usize = 7;

/// Coefficients of a sector in each direction: two polynomial pieces that meet with two derivatives.
pub const COEFFICIENTS: usize = 13;

/// Coefficients in each direction that weights give; the rest follow from the bicubics next to the sector.
pub const INNER: usize = 10;
