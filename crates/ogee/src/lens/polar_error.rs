//! Why there is no polar cap.

use crate::mesh::VertexId;

/// A pole that cannot have a cap, or a net that is not polar.
#[derive(Clone, Debug, PartialEq)]
pub struct PolarError {
    /// The vertex of the cage at the pole, where the caller knows it; see [`PolarError::at`].
    pub pole: Option<VertexId>,
    /// What is wrong.
    pub defect: PolarDefect,
}

/// What is wrong with a polar net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PolarDefect {
    /// Circles are too small.
    #[error("its circles have {sectors} points, and {least} are the least; {remedy}", remedy = remedy(*least))]
    TooFewSectors {
        /// How many sectors there are.
        sectors: usize,
        /// How many are needed.
        least: usize,
    },
    /// Circles have different numbers of points.
    #[error(
        "circle {circle} has {points} points where {sectors} are expected; give every circle one per sector"
    )]
    UnequalCircles {
        /// Number of the circle, the innermost is 1.
        circle: usize,
        /// How many points it has.
        points: usize,
        /// How many sectors there are.
        sectors: usize,
    },
    /// There are not enough circles.
    #[error("it has {circles} circles, and {least} are the least; refine the cage first")]
    TooFewCircles {
        /// How many there are.
        circles: usize,
        /// How many are needed.
        least: usize,
    },
    /// A coordinate of the pole or of a circle is infinite or no number, or too large to be squared.
    #[error("a coordinate is infinite, not a number, or too large; check the cage's points")]
    NotFinite,
    /// The tangents at the pole are parallel, or one of them vanishes.
    #[error(
        "it has no tangent plane: its tangents are parallel; move the circles around it apart, or the pole"
    )]
    Singular,
    /// The slit between two lenses is too short, or is not as long as the circle around it says.
    #[error(
        "a slit of {edges} edges has no circle of {points} points; it needs 2 edges and 2 points an edge"
    )]
    Slit {
        /// Edges of the slit.
        edges: usize,
        /// Points of the circle around it.
        points: usize,
    },
    /// Names for the outline of a cap do not fit its sectors.
    #[error(
        "{sectors} sectors cannot be named by {vertices} vertices and {rows} x {columns} faces; give one vertex and two faces each"
    )]
    Names {
        /// Sectors of the cap.
        sectors: usize,
        /// Vertices given.
        vertices: usize,
        /// Rows of faces given.
        rows: usize,
        /// Columns of faces given.
        columns: usize,
    },
}

fn remedy(least: usize) -> &'static str {
    if least > 3 { "double them first" } else { "there is nothing between two meridians" }
}

impl PolarError {
    /// The same error, with the vertex of the cage that it is about.
    #[must_use]
    pub fn at(self, pole: VertexId) -> PolarError {
        PolarError { pole: Some(pole), ..self }
    }

    /// A name for the kind of error that does not change.
    pub fn code(&self) -> &'static str {
        match self.defect {
            PolarDefect::TooFewSectors { .. } => "polar_too_few_sectors",
            PolarDefect::UnequalCircles { .. } => "polar_unequal_circles",
            PolarDefect::TooFewCircles { .. } => "polar_too_few_circles",
            PolarDefect::NotFinite => "polar_not_finite",
            PolarDefect::Singular => "polar_singular",
            PolarDefect::Slit { .. } => "polar_slit",
            PolarDefect::Names { .. } => "polar_names",
        }
    }
}

impl std::fmt::Display for PolarError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.pole {
            Some(pole) => write!(f, "the pole at vertex {pole}: {}", self.defect),
            None => write!(f, "a pole: {}", self.defect),
        }
    }
}

impl std::error::Error for PolarError {}

impl From<PolarDefect> for PolarError {
    fn from(defect: PolarDefect) -> PolarError {
        PolarError { pole: None, defect }
    }
}
