//! `Location`: an address on the surface that has been checked.

use crate::mesh::FaceId;

/// A point of the surface: a parametric face and parameters in it. Made by [`crate::PatchTable::locate`], and good for
/// the table that made it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location {
    pub(crate) root: u32,
    pub(crate) u: f64,
    pub(crate) v: f64,
}

impl Location {
    /// The number of its parametric face: a quad counts one, any other polygon one per corner, in the order of the
    /// mesh.
    pub fn parametric_face(self) -> usize {
        self.root as usize
    }

    /// Another point of the same parametric face: quicker than to look its address up again.
    ///
    /// # Errors
    /// If `u` or `v` is not in `[0, 1]`.
    #[inline]
    pub fn at(self, u: f64, v: f64) -> Result<Location, LocationError> {
        if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v) {
            Ok(Location { root: self.root, u, v })
        } else {
            Err(LocationError::OutsideSquare { u, v })
        }
    }

    /// The point of the same parametric face nearest to these parameters.
    #[inline]
    #[must_use]
    pub fn clamped(self, u: f64, v: f64) -> Location {
        // Written so that what is no number becomes 0.
        let clamp = |x: f64| if x > 0.0 { x.min(1.0) } else { 0.0 };
        Location { root: self.root, u: clamp(u), v: clamp(v) }
    }

    /// Its parameters, in `[0, 1]`.
    pub fn parameters(self) -> [f64; 2] {
        [self.u, self.v]
    }
}

/// The square that carries parameters: a quad, or one corner of any other polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ParametricFace {
    /// The face.
    pub face: FaceId,
    /// Which corner; `None` on a quad.
    pub corner: Option<u32>,
}

/// Why an address names no point of the surface.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LocationError {
    /// No such face.
    #[error("there is no face {face}, only {count}")]
    MissingFace {
        /// The face asked for.
        face: FaceId,
        /// How many there are.
        count: usize,
    },
    /// A hole, or a face at the boundary that the scheme leaves out.
    #[error("face {face} is no part of the surface")]
    HiddenFace {
        /// The face asked for.
        face: FaceId,
    },
    /// A quad has one square of parameters for the whole face.
    #[error("face {face} is a quad, which takes no corner")]
    CornerOnQuad {
        /// The face asked for.
        face: FaceId,
    },
    /// On any other polygon every corner has parameters of its own.
    #[error("face {face} has {corners} corners, and one of them has to be named")]
    CornerWanted {
        /// The face asked for.
        face: FaceId,
        /// How many corners it has.
        corners: u32,
    },
    /// No such corner.
    #[error("face {face} has no corner {corner}, only {corners}")]
    MissingCorner {
        /// The face asked for.
        face: FaceId,
        /// The corner asked for.
        corner: u32,
        /// How many there are.
        corners: u32,
    },
    /// Parameters outside `[0, 1]`, or not numbers.
    #[error("the parameters ({u:?}, {v:?}) are not in [0, 1]")]
    OutsideSquare {
        /// The first.
        u: f64,
        /// The second.
        v: f64,
    },
}

impl LocationError {
    /// The name of the kind of error, in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            LocationError::MissingFace { .. } => "missing_face",
            LocationError::HiddenFace { .. } => "hidden_face",
            LocationError::CornerOnQuad { .. } => "corner_on_quad",
            LocationError::CornerWanted { .. } => "corner_wanted",
            LocationError::MissingCorner { .. } => "missing_corner",
            LocationError::OutsideSquare { .. } => "outside_square",
        }
    }
}
