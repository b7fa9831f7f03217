//! `PatchTable`: what every parametric face is made of.

use super::{Location, LocationError, ParametricFace};
use crate::mesh::FaceId;
use crate::rules::Level;

/// stub
#[derive(Clone, Debug)]
pub struct PatchTable {
    faces: Vec<ParametricFace>,
}

impl PatchTable {
    /// stub
    pub fn new(level: &Level) -> PatchTable {
        let t = level.topology();
        let faces = (0..t.face_count() as u32).map(FaceId).flat_map(|face| {
            let n = t.face_size(face);
            (0..if n == 4 { 1 } else { n })
                .map(move |k| ParametricFace { face, corner: (n != 4).then_some(k) })
        });
        PatchTable { faces: faces.collect() }
    }

    /// Number of parametric faces, hidden ones included.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// True if there are none; a level always has some.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// The parametric face of a number below [`PatchTable::len`].
    ///
    /// # Panics
    /// If there is none.
    pub fn parametric_face(&self, number: usize) -> ParametricFace {
        self.faces[number]
    }

    /// False if it is no part of the surface.
    ///
    /// # Panics
    /// If there is no such parametric face.
    pub fn is_visible(&self, number: usize) -> bool {
        number < self.faces.len()
    }

    /// Checks an address.
    ///
    /// # Errors
    /// If it names no point of the surface.
    pub fn locate(
        &self,
        face: FaceId,
        corner: Option<u32>,
        u: f64,
        v: f64,
    ) -> Result<Location, LocationError> {
        let wanted = ParametricFace { face, corner };
        let root = self
            .faces
            .iter()
            .position(|&f| f == wanted)
            .ok_or(LocationError::MissingFace { face, count: self.faces.len() })?;
        Ok(Location { root: root as u32, u, v })
    }
}
