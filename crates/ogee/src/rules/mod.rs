//! Rules: which mask makes the child of an element, and the level they stand on.

mod classify;
mod face_varying;
mod inherit;
mod level;
pub(crate) mod masks;
mod sector;
mod sparse;

pub use level::Level;
pub(crate) use level::SharpEdge;
pub use sector::Sector;
pub(crate) use sparse::Sparse;

use crate::mesh::VertexId;

/// A mask that makes the child of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexMask {
    /// Catmull and Clark's; also at a dart, where one crease ends.
    Smooth,
    /// That of an interior vertex of valence 2, of the shape that the scheme has; also where one crease ends there.
    Lens,
    /// On a crease or boundary that runs through these neighbours.
    Crease {
        /// The neighbours along the crease.
        ends: [VertexId; 2],
    },
    /// The vertex stays where it is.
    Corner,
}

/// What makes the child of a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VertexRule {
    /// One mask.
    Of(VertexMask),
    /// Sharpness runs out in this step: `weight` of the parent's mask, the rest of the child's.
    Blend {
        /// The mask with the sharpness of this level.
        parent: VertexMask,
        /// The mask with the sharpness of the next.
        child: VertexMask,
        /// Share of the parent's mask, in `[0, 1]`.
        weight: f64,
    },
}

/// What makes the child of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EdgeRule {
    /// Catmull and Clark's.
    Smooth,
    /// The middle of the edge.
    Crease,
    /// `weight` of the crease mask, the rest smooth. With Chaikin creases the weight may pass 1, up to 4/3, as
    /// OpenSubdiv has it.
    Blend {
        /// Share of the crease mask.
        weight: f64,
    },
}
