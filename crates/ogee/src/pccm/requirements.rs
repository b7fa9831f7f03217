//! What a cage asks of the conversion: the least level, and what has no rule.

use super::{CornerClass, Fan, Layer, meetings};
use crate::mesh::{FaceId, HalfedgeId, Place, Valence, VertexId};
use crate::rules::Level;

/// The greatest finite sharpness that is converted: a patch has `2^q` cells a side.
pub const SHARPEST: f64 = 6.0;

/// Why a cage cannot be converted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PccmError {
    /// There is no patch for the rule at valence 2.
    #[error(
        "vertex {vertex} has valence 2, for which there is no patch; treat it first (--lens merge, lens::treat)"
    )]
    Lens {
        /// The vertex.
        vertex: VertexId,
    },
    /// A smaller level would not be smooth.
    #[error("level {level} is too low: {least} is the least, {because}")]
    LevelTooLow {
        /// What was asked for.
        level: u32,
        /// What is needed.
        least: u32,
        /// Why.
        because: &'static str,
    },
    /// A semi-sharp crease or corner would make patches of more than 64 cells a side.
    #[error(
        "{place} has sharpness {sharpness}; {SHARPEST} is the most that is converted, or 10 for infinitely sharp"
    )]
    TooSharp {
        /// The edge or vertex.
        place: Place,
        /// Its sharpness.
        sharpness: f64,
    },
    /// There is no quintic rule for sharp edges and boundaries.
    #[error("bi5 has no rule for sharp edges and boundaries, such as edge {a}-{b}; use the method pccm")]
    SharpEdge {
        /// One end.
        a: VertexId,
        /// The other.
        b: VertexId,
    },
    /// There is no quintic rule for sharp vertices.
    #[error("bi5 has no rule for sharp vertices, such as {vertex}; use the method pccm")]
    SharpVertex {
        /// The vertex.
        vertex: VertexId,
    },
    /// Polygons are refined once before.
    #[error("face {face} is no quad; refine the cage once first")]
    NotQuads {
        /// The face.
        face: FaceId,
    },
}

impl PccmError {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            PccmError::Lens { .. } => "valence_two",
            PccmError::LevelTooLow { .. } => "level_too_low",
            PccmError::TooSharp { .. } => "too_sharp",
            PccmError::SharpEdge { .. } => "sharp_edge",
            PccmError::SharpVertex { .. } => "sharp_vertex",
            PccmError::NotQuads { .. } => "not_quads",
        }
    }
}

/// A level and the reason for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// Refinements before the conversion.
    pub level: u32,
    /// Why no fewer, in a few words.
    pub because: &'static str,
}

/// The least number of refinements that is right for a level of quads.
///
/// Meetings of curves want 2, or 3 where one of their edges ends in an irregular vertex. Else SECOND wants 2; FIRST wants 2, or 1 where no edge has two irregular ends and no vertex has even valence of 6 or
/// more. Semi-sharp creases want as many steps as they take to fade; with Chaikin creases this is an upper bound.
///
/// # Errors
/// If the level has a vertex of valence 2, a crease that is too sharp, or other polygons.
pub fn least_level(base: &Level, layer: Layer) -> Result<Requirement, PccmError> {
    refuse(base)?;
    let mut least = Requirement { level: 2, because: "edges join two irregular vertices" };
    if layer == Layer::Second {
        least.because = "the second layer needs four cells a side";
    } else if !joins_irregular(base) {
        least = Requirement { level: 1, because: "one refinement is the least" };
    }
    if let Some(level) = meeting_level(base).filter(|&level| level > least.level) {
        let because = match level {
            2 => "curves meet, which takes two cells a side and two more beyond",
            _ => "an edge joins a meeting of curves with an irregular vertex",
        };
        least = Requirement { level, because };
    }
    let edges = base.semi_sharp_edges().map(|(_, s)| s);
    let sharpest = edges.chain(base.semi_sharp_vertices().map(|(_, s)| s)).fold(0.0, f64::max);
    let steps = sharpest.ceil() as u32;
    // Semi-sharp creases are right from level 2 on, when they have faded.
    if sharpest > 0.0 && steps.max(2) > least.level {
        least = Requirement { level: steps.max(2), because: "semi-sharp creases have to fade first" };
    }
    Ok(least)
}

fn refuse(base: &Level) -> Result<(), PccmError> {
    let topology = base.topology();
    refuse_valence_two(base)?;
    if let Some((h, sharpness)) = base.semi_sharp_edges().find(|&(_, s)| s > SHARPEST) {
        let place = Place::Edge(topology.origin(h).0, topology.target(h).0);
        return Err(PccmError::TooSharp { place, sharpness });
    }
    if let Some((v, sharpness)) = base.semi_sharp_vertices().find(|&(_, s)| s > SHARPEST) {
        return Err(PccmError::TooSharp { place: Place::Vertex(v.0), sharpness });
    }
    Ok(())
}

/// Faces that are no quads, and vertices of valence 2.
pub(super) fn refuse_valence_two(base: &Level) -> Result<(), PccmError> {
    let topology = base.topology();
    let mut faces = (0..topology.face_count() as u32).map(FaceId);
    if let Some(face) = faces.find(|&f| topology.face_size(f) != 4) {
        return Err(PccmError::NotQuads { face });
    }
    for vertex in (0..topology.vertex_count() as u32).map(VertexId) {
        let has_two = topology.valence(vertex) == Valence::Interior(2);
        // Two sharp edges make two sides of a crease, one face each: that is no lens.
        if has_two && topology.ring(vertex).filter(|&h| base.is_sharp(h)).count() < 2 {
            return Err(PccmError::Lens { vertex });
        }
    }
    Ok(())
}

/// What meetings of curves want: the cap of a meeting takes two cells, what smoothing changes at the other end of an edge
/// three.
fn meeting_level(base: &Level) -> Option<u32> {
    let topology = base.topology();
    let spokes: Vec<HalfedgeId> = meetings(base).into_iter().flat_map(|fan| fan.halfedges).collect();
    let crowded = spokes.iter().any(|&h| is_irregular(base, topology.target(h)));
    (!spokes.is_empty()).then_some(if crowded { 3 } else { 2 })
}

/// True if smoothing may change something at a vertex.
fn is_irregular(base: &Level, v: VertexId) -> bool {
    let topology = base.topology();
    let closing = usize::from(topology.is_boundary(v));
    let sharp_edges = topology.ring(v).filter(|&h| base.is_sharp(h)).count() + closing;
    let class = |sector| Fan::classify(base, v, sector, sharp_edges);
    base.sectors(v).into_iter().any(|sector| class(sector) != CornerClass::Regular)
}

/// True if an edge has two irregular ends or a vertex even valence of 6 or more.
fn joins_irregular(base: &Level) -> bool {
    let topology = base.topology();
    let vertices = (0..topology.vertex_count() as u32).map(VertexId);
    let irregular: Vec<bool> = vertices.map(|v| is_irregular(base, v)).collect();
    let both = |h: HalfedgeId| irregular[topology.origin(h).index()] && irregular[topology.target(h).index()];
    let even = |v: VertexId| matches!(topology.valence(v), Valence::Interior(n) if n >= 6 && n % 2 == 0);
    (0..topology.halfedge_count() as u32).map(HalfedgeId).any(both)
        || (0..topology.vertex_count() as u32).map(VertexId).any(even)
}
