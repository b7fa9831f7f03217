//! What is shown: `Scene`, `Style`, `Pattern`.

use std::sync::Arc;

use ogee::Vec3;
use ogee::quality::PlaneLight;

use crate::{Camera, Light};

/// Everything that decides on a picture, except the surface.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Who looks.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What is shown.
    pub style: Style,
    /// What a pixel is taken from.
    pub sampling: Sampling,
}

/// What a pixel is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// The point of the surface that the middle of the pixel shows.
    #[default]
    Exact,
    /// The point of the surface at the parameters that a mesh of this level has there: the method of the paper.
    Parameters(u32),
    /// Positions and normals interpolated over a mesh of this level with limit points: what is seen elsewhere.
    Polygon(u32),
}

/// What is shown.
#[derive(Clone, Debug)]
pub enum Style {
    /// A matt body under a soft light from above.
    Shaded,
    /// The edges of the cage's faces on the surface.
    Wireframe,
    /// A pattern on a plane, mirrored in the surface.
    Reflection {
        /// The plane.
        light: PlaneLight,
        /// What is on it.
        pattern: Pattern,
    },
    /// The same where normals meet the plane: it does not depend on the viewer.
    Highlight {
        /// The plane.
        light: PlaneLight,
        /// What is on it.
        pattern: Pattern,
    },
    /// Bands of equal angle between the normal and the light.
    Isophote {
        /// Unit vector towards the light.
        light: Vec3,
        /// The width of a dark and a bright band together, in degrees.
        step: f64,
    },
    /// Stripes of an environment far away, mirrored in the surface.
    Zebra {
        /// Unit vector: stripes are circles of latitude around it.
        axis: Vec3,
        /// Pairs of stripes from pole to pole.
        count: f64,
    },
    /// A map of curvature.
    Curvature {
        /// Which.
        quantity: Quantity,
        /// Where colours end, on either side of 0; `None` is where 95 % of the visible surface is.
        limit: Option<f64>,
    },
    /// How far the lines of a mesh of the given level are from those of the surface, in pixels.
    Error {
        /// The plane.
        light: PlaneLight,
        /// The level of the mesh.
        level: u32,
    },
    /// Curvature of the curves in the middle of faces and between them, as hairs along the normal.
    Combs {
        /// How long hairs are where 90 % of all are shorter, as a share of the diagonal of the surface.
        share: f64,
    },
}

/// Which curvature a map shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Gauss curvature.
    Gauss,
    /// Mean curvature.
    Mean,
    /// The larger principal curvature.
    K1,
    /// The smaller principal curvature.
    K2,
    /// The principal curvature of larger size, without sign.
    Greatest,
    /// -1, 0 or 1: saddle, flat or bowl.
    GaussSign,
}

/// What is on a light plane, in its coordinates.
#[derive(Clone, Debug)]
pub enum Pattern {
    /// Stripes across the first axis.
    Lines {
        /// From one stripe to the next.
        period: f64,
        /// The share of a period that is bright, between 0 and 1.
        width: f64,
        /// Where stripes start, in periods.
        phase: f64,
    },
    /// Thin stripes across both axes.
    Lattice {
        /// From one stripe to the next.
        period: f64,
        /// The share of a period that is bright, between 0 and 1.
        width: f64,
    },
    /// Discs in the middles of square cells.
    Circles {
        /// The side of a cell.
        period: f64,
        /// The radius of a disc, in sides.
        radius: f64,
    },
    /// A picture that fills the square of the plane with this half side.
    Image {
        /// The picture.
        image: Arc<Light>,
        /// Half the side along the first axis; the other follows from the picture.
        half: f64,
    },
}

/// The light plane unless another is asked for: above a box by half its diagonal, its first axis along the longest
/// horizontal side; without an end.
pub fn default_light([lower, upper]: [Vec3; 2]) -> PlaneLight {
    let diagonal = upper.distance(lower);
    let centre = 0.5 * (lower + upper);
    let along_x = upper.x - lower.x >= upper.y - lower.y;
    let axes = if along_x {
        [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)]
    } else {
        [Vec3::new(0.0, 1.0, 0.0), Vec3::new(-1.0, 0.0, 0.0)]
    };
    PlaneLight {
        centre: Vec3::new(centre.x, centre.y, upper.z + 0.5 * diagonal),
        axes,
        half: [f64::INFINITY; 2],
    }
}
