//! What stands in the way of lenses and poles.

use super::polar_error::PolarError;
use crate::mesh::{FaceId, TopologyError, VertexId};
use crate::refine::TooDeep;

/// Something near a lens vertex, a pair or a pole that keeps its neighbourhood from being regular and smooth. `layer` counts
/// from the lens, the slit or the pole: faces of layer 1 touch it, and end at the vertices of layer 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum Obstacle {
    #[error("face {face} in layer {layer} is no quad; refine the cage once first")]
    NotAQuad { face: FaceId, layer: u32 },
    #[error("vertex {vertex} in layer {layer} lies on the boundary; move it out by refining or add faces")]
    Boundary { vertex: VertexId, layer: u32 },
    #[error("vertex {vertex} in layer {layer} is a lens vertex as well; refine the cage first")]
    OtherLens { vertex: VertexId, layer: u32 },
    #[error("vertex {vertex} in layer {layer} has valence {valence}, not 4; refine the cage first")]
    Extraordinary { vertex: VertexId, valence: u32, layer: u32 },
    #[error(
        "edge {a}-{b} is sharp and begins in layer {layer}; take its tag away or split the surface there"
    )]
    SharpEdge { a: VertexId, b: VertexId, layer: u32 },
    #[error("vertex {vertex} in layer {layer} is sharp; take its tag away")]
    SharpVertex { vertex: VertexId, layer: u32 },
    #[error("curves meet at a corner of face {face} in layer {layer}; refine the cage first")]
    Meeting { face: FaceId, layer: u32 },
    #[error("face {face} in layer {layer} is no part of the surface; take its tag away")]
    HiddenFace { face: FaceId, layer: u32 },
    #[error("the cap of another lens or pole ends near vertex {vertex}; use merge, or refine the cage first")]
    Cap { vertex: VertexId, layer: u32 },
}

impl Obstacle {
    /// A stable name in snake case.
    pub fn code(self) -> &'static str {
        match self {
            Obstacle::NotAQuad { .. } => "not_a_quad",
            Obstacle::Boundary { .. } => "boundary",
            Obstacle::OtherLens { .. } => "other_lens",
            Obstacle::Extraordinary { .. } => "extraordinary",
            Obstacle::SharpEdge { .. } => "sharp_edge",
            Obstacle::SharpVertex { .. } => "sharp_vertex",
            Obstacle::Meeting { .. } => "meeting",
            Obstacle::HiddenFace { .. } => "hidden_face",
            Obstacle::Cap { .. } => "cap",
        }
    }

    /// In which layer it is.
    pub fn layer(self) -> u32 {
        match self {
            Obstacle::NotAQuad { layer, .. }
            | Obstacle::Boundary { layer, .. }
            | Obstacle::OtherLens { layer, .. }
            | Obstacle::Extraordinary { layer, .. }
            | Obstacle::SharpEdge { layer, .. }
            | Obstacle::SharpVertex { layer, .. }
            | Obstacle::Meeting { layer, .. }
            | Obstacle::HiddenFace { layer, .. }
            | Obstacle::Cap { layer, .. } => layer,
        }
    }

    /// How many refinements move it out of the way: each doubles the layer of a vertex, and layers 1 and 2 have to be free. `None` if
    /// it stays where it is, as a sharp edge does that begins at the lens itself, and a hidden face that touches it.
    pub fn refinements(self) -> Option<u32> {
        match (self, self.layer()) {
            // What a polygon leaves behind is a vertex in layer 1.
            (Obstacle::NotAQuad { .. }, 1) => Some(3),
            (Obstacle::Cap { .. }, _) => Some(1),
            (Obstacle::HiddenFace { .. }, 1) | (_, 0) => None,
            (_, 1) => Some(2),
            _ => Some(1),
        }
    }
}

/// Why something cannot be done with lenses.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum LensError {
    #[error("{0}")]
    Mesh(TopologyError),
    #[error(
        "vertices {} and {} have valence 2 and are neighbours: their two faces are a closed pillow; remove both faces",
        .vertices[0], .vertices[1]
    )]
    AdjacentLensVertices { vertices: [VertexId; 4] },
    #[error("vertex {vertex} is no inner vertex with two faces; name a lens vertex")]
    NotALens { vertex: VertexId },
    #[error("the neighbourhood of vertex {vertex} is not regular{}: {obstacle}", after(*refinements))]
    Blocked { vertex: VertexId, obstacle: Obstacle, refinements: u32 },
    #[error("the lens at vertex {vertex} is named twice; name it once")]
    NamedTwice { vertex: VertexId },
    #[error(
        "the lens at vertex {vertex} has no circles around it ({why}), which a polar cap wants; use merge or c2"
    )]
    NoPartner { vertex: VertexId, why: &'static str },
    #[error(transparent)]
    Polar(#[from] PolarError),
    #[error("refinement to make room around lenses does not fit: {0}")]
    TooDeep(#[from] TooDeep),
}

fn after(refinements: u32) -> String {
    match refinements {
        0 => String::new(),
        1 => " after a refinement".to_owned(),
        count => format!(" after {count} refinements"),
    }
}

impl LensError {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            LensError::Mesh(error) => error.defects.first().map_or("no_faces", |defect| defect.code()),
            LensError::AdjacentLensVertices { .. } => "adjacent_lens_vertices",
            LensError::NotALens { .. } => "not_a_lens",
            LensError::Blocked { .. } => "blocked",
            LensError::NamedTwice { .. } => "named_twice",
            LensError::NoPartner { .. } => "no_partner",
            LensError::Polar(error) => error.code(),
            LensError::TooDeep(_) => "too_deep",
        }
    }
}
