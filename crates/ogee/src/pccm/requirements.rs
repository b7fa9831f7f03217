//! What a cage asks of the conversion: the least level, and what has no rule.

use super::{CornerClass, Fan, Layer, meetings};
use crate::mesh::{FaceId, Place, Valence, VertexId};
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

/// The least number of refinements that is right for all faces of a level of quads; [`super::plan`] has one for each face.
///
/// Meetings of curves want 2, or 3 where one of their edges ends in an irregular vertex. Else SECOND wants 2; FIRST wants 2, or 1 where no edge has two irregular ends and no vertex has even valence of 6 or
/// more. Semi-sharp creases want as many steps as they take to fade; with Chaikin creases this is an upper bound.
///
/// # Errors
/// If the level has a vertex of valence 2, a crease that is too sharp, or other polygons.
pub fn least_level(base: &Level, layer: Layer) -> Result<Requirement, PccmError> {
    refuse_valence_two(base)?;
    let faces: Vec<FaceId> = (0..base.topology().face_count() as u32).map(FaceId).collect();
    Ok(Wanted::new(base, &faces, layer)?.greatest)
}

/// What each of some faces of a level asks for.
pub(super) struct Wanted {
    /// By face of the level: refinements; 0 for faces that were not asked about.
    pub(super) levels: Vec<u32>,
    /// The greatest of them.
    pub(super) greatest: Requirement,
}

impl Wanted {
    /// Of the given faces, all of them quads, with all faces of every irregular fan that has one of them. Fans do not
    /// yet share their levels.
    ///
    /// # Errors
    /// If a semi-sharp crease or corner that touches one of the faces is too sharp.
    pub(super) fn new(level: &Level, faces: &[FaceId], layer: Layer) -> Result<Wanted, PccmError> {
        let mut asked = vec![false; level.topology().face_count()];
        faces.iter().for_each(|f| asked[f.index()] = true);
        let greatest = structural(level, faces, layer);
        let mut wanted = Wanted { levels: vec![0; asked.len()], greatest };
        faces.iter().for_each(|f| wanted.levels[f.index()] = greatest.level);
        wanted.ask_at_meetings(level, &asked);
        wanted.ask_at_semi_sharp(level, &asked)?;
        Ok(wanted)
    }

    fn raise(&mut self, f: FaceId, requirement: Requirement) {
        let own = &mut self.levels[f.index()];
        *own = requirement.level.max(*own);
        if requirement.level > self.greatest.level {
            self.greatest = requirement;
        }
    }

    /// The cap of a meeting takes two cells, what smoothing changes at the other end of an edge three.
    fn ask_at_meetings(&mut self, level: &Level, asked: &[bool]) {
        let topology = level.topology();
        for fan in meetings(level) {
            let crowded = fan.halfedges.iter().any(|&h| is_irregular(level, topology.target(h)));
            let requirement = if crowded {
                Requirement {
                    level: 3,
                    because: "an edge joins a meeting of curves with an irregular vertex",
                }
            } else {
                Requirement {
                    level: 2,
                    because: "curves meet, which takes two cells a side and two more beyond",
                }
            };
            let faces = fan.halfedges.iter().map(|&h| topology.face(h));
            faces.filter(|f| asked[f.index()]).for_each(|f| self.raise(f, requirement));
        }
    }

    /// Semi-sharp creases are right from level 2 on, when they have faded on all faces that touch them.
    fn ask_at_semi_sharp(&mut self, level: &Level, asked: &[bool]) -> Result<(), PccmError> {
        let topology = level.topology();
        let edges = level.semi_sharp_edges().map(|(h, sharpness)| {
            let ends = vec![topology.origin(h), topology.target(h)];
            (Place::Edge(ends[0].0, ends[1].0), ends, sharpness)
        });
        let corners = level.semi_sharp_vertices().map(|(v, s)| (Place::Vertex(v.0), vec![v], s));
        for (place, vertices, sharpness) in edges.chain(corners) {
            let halfedges = vertices.iter().flat_map(|&v| topology.ring(v));
            for f in halfedges.map(|h| topology.face(h)).filter(|f| asked[f.index()]) {
                if sharpness > SHARPEST {
                    return Err(PccmError::TooSharp { place, sharpness });
                }
                let steps = (sharpness.ceil() as u32).max(2);
                self.raise(f, Requirement { level: steps, because: "semi-sharp creases have to fade first" });
            }
        }
        Ok(())
    }
}

/// What the method itself asks for.
fn structural(level: &Level, faces: &[FaceId], layer: Layer) -> Requirement {
    if layer == Layer::Second {
        return Requirement { level: 2, because: "the second layer needs four cells a side" };
    }
    if joins_irregular(level, faces) {
        return Requirement { level: 2, because: "edges join two irregular vertices" };
    }
    Requirement { level: 1, because: "one refinement is the least" }
}

/// Faces that are no quads, and vertices of valence 2.
pub(super) fn refuse_valence_two(base: &Level) -> Result<(), PccmError> {
    let topology = base.topology();
    let mut faces = (0..topology.face_count() as u32).map(FaceId);
    if let Some(face) = faces.find(|&f| topology.face_size(f) != 4) {
        return Err(PccmError::NotQuads { face });
    }
    refuse_lenses(base)
}

/// Vertices of valence 2.
pub(super) fn refuse_lenses(base: &Level) -> Result<(), PccmError> {
    let topology = base.topology();
    for vertex in (0..topology.vertex_count() as u32).map(VertexId) {
        let has_two = topology.valence(vertex) == Valence::Interior(2);
        // Two sharp edges make two sides of a crease, one face each: that is no lens.
        if has_two && topology.ring(vertex).filter(|&h| base.is_sharp(h)).count() < 2 {
            return Err(PccmError::Lens { vertex });
        }
    }
    Ok(())
}

/// True if smoothing may change something at a vertex.
pub(super) fn is_irregular(base: &Level, v: VertexId) -> bool {
    let topology = base.topology();
    let closing = usize::from(topology.is_boundary(v));
    let sharp_edges = topology.ring(v).filter(|&h| base.is_sharp(h)).count() + closing;
    let class = |sector| Fan::classify(base, v, sector, sharp_edges);
    base.sectors(v).into_iter().any(|sector| class(sector) != CornerClass::Regular)
}

/// For each face whether its patch may be more than one bicubic piece: next to irregular vertices, and where sharpness is finite.
pub(crate) fn irregular_faces(base: &Level) -> Vec<bool> {
    let topology = base.topology();
    let mut irregular = vec![false; topology.face_count()];
    let mut mark = |v: VertexId| topology.ring(v).for_each(|h| irregular[topology.face(h).index()] = true);
    (0..topology.vertex_count() as u32).map(VertexId).filter(|&v| is_irregular(base, v)).for_each(&mut mark);
    base.semi_sharp_edges().flat_map(|(h, _)| [topology.origin(h), topology.target(h)]).for_each(&mut mark);
    base.semi_sharp_vertices().for_each(|(v, _)| mark(v));
    base.slices().flat_map(|(slice, _)| topology.halfedges(slice)).for_each(|h| mark(topology.origin(h)));
    irregular
}

/// True if an edge of the faces has two irregular ends, or a vertex of theirs even valence of 6 or more.
fn joins_irregular(level: &Level, faces: &[FaceId]) -> bool {
    let topology = level.topology();
    let mut irregular = vec![None; topology.vertex_count()];
    let mut is_irregular = |v: VertexId| *irregular[v.index()].get_or_insert_with(|| is_irregular(level, v));
    let even = |v: VertexId| matches!(topology.valence(v), Valence::Interior(n) if n >= 6 && n % 2 == 0);
    let mut halfedges = faces.iter().flat_map(|&f| topology.halfedges(f));
    halfedges.any(|h| {
        let [from, to] = [topology.origin(h), topology.target(h)];
        even(from) || is_irregular(from) && is_irregular(to)
    })
}
