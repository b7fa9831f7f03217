//! Lenses: regions around a vertex of valence 2, and poles, with every construction of Karciauskas and Peters,
//! *Lens-shaped surfaces and C2 subdivision* (`docs/methods/lens.md`).

mod biquartic;
mod biquartic_cap;
mod biquartic_matrix;
mod biquartic_surface;
mod biquartic_tables;
mod cap;
mod chart;
mod circles;
mod cover;
mod detect;
mod error;
mod fan;
mod layout;
mod origins;
mod pair_pole;
mod piece;
mod polar;
mod polar_energy;
mod polar_error;
mod polar_faces;
mod polar_sector;
mod quartic;
mod refit;
mod remesh;
mod rework;
pub(crate) mod rule;
mod treat;
mod treated_surface;

pub use biquartic::{Biquartic, Entry, QuadraticExpansion, RingPatch};
pub use biquartic_cap::CapSite;
pub use biquartic_matrix::{
    BIQUARTIC_POINTS, ExactRow, MATRIX_DENOMINATOR, RAISING_DENOMINATOR, biquartic_matrix, degree_raising,
};
pub use biquartic_surface::BiquarticSurface;
pub use biquartic_tables::{LIMIT_MASKS, LimitMask};
pub use cap::{Cap, CapEdge, CapFace, CapVertex};
pub use circles::{Circle, PolarNeighbourhood};
pub use detect::{Detection, Lens, LensKind, LensPair, Pole, detect, regular_net};
pub use error::{LensError, Obstacle};
pub use fan::{PolarNet, RadialRule};
pub use layout::{BICUBIC_POINTS, LensNet, Quadrant, Symmetry, lattice_index, lattice_point};
pub(crate) use origins::Origins;
pub use pair_pole::pair_pole;
pub use polar::PolarCap;
pub use polar_energy::PolarOperator;
pub use polar_error::{PolarDefect, PolarError};
pub use polar_faces::PolarFaces;
pub use polar_sector::PolarVariant;
pub use refit::refit_operator;
pub use remesh::{Averaging, Remesh, Remeshed, remesh};
pub(crate) use treat::treat_following;
pub use treat::{Method, Options, Treated, TreatedLens, treat};
pub use treated_surface::TreatedSurface;
