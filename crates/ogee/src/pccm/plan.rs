//! The plan of a conversion: which faces are refined once before, and how often each is refined after that.
//!
//! Polygons other than quads have no patch, so they are refined once; and patches have `2^level` cells a side, more than
//! the least where semi-sharp creases have to fade. Both are asked for by single faces. Around an irregular vertex patches are
//! smoothed together, so all of its faces go with the one that asks for most, and through their other irregular corners the
//! faces there. At a regular vertex nothing is smoothed: on both sides of an edge whose ends are regular the patches are the limit
//! surface itself, whatever their levels. `docs/methods/pccm.md`, How many refinements.

use super::part::Part;
use super::requirements::{Requirement, Wanted, refuse_lenses};
use super::{CornerClass, Fan, Layer, PccmError, meetings};
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::rules::Level;
use std::collections::BTreeMap;

/// Faces that are converted alike.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Refinements of the cage whose faces these are: 0, or 1 where polygons had to be split.
    pub steps: u32,
    /// Refinements of each of these faces; a patch has `2^level` cells a side.
    pub level: u32,
    /// Faces of the cage, or of its first refinement, in order. All are quads.
    pub faces: Vec<FaceId>,
}

/// Which faces of a cage are converted on which level. Hidden faces are among them: smoothing needs them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// By steps, then by level. Every face of the cage is in one of them, itself or with all of its quarters.
    pub groups: Vec<Group>,
}

/// The least that is right for each face of a cage.
///
/// Polygons other than quads are split, and with them all faces around irregular vertices that they touch, and so on; all else
/// stays whole. `asked` is a level for all faces.
///
/// # Errors
/// If a vertex of valence 2 has no rule, a semi-sharp crease is too sharp, or some face wants more than the level asked for.
/// What is named is named as it is in the cage.
pub fn plan(cage: &Level, layer: Layer, asked: Option<u32>) -> Result<Plan, PccmError> {
    refuse_lenses(cage)?;
    let (whole, split) = divide(cage);
    let mut faces_of: BTreeMap<(u32, u32), Vec<FaceId>> = BTreeMap::new();
    let mut greatest: Option<Requirement> = None;
    let mut add = |steps: u32, requirement: Requirement, levels: Vec<(FaceId, u32)>| {
        for (f, level) in levels {
            faces_of.entry((steps, asked.unwrap_or(level))).or_default().push(f);
        }
        if greatest.is_none_or(|other| other.level < requirement.level) {
            greatest = Some(requirement);
        }
    };
    if !whole.is_empty() {
        let wanted = Wanted::new(cage, &whole, layer)?;
        let levels = shared_levels(cage, &whole, &wanted);
        add(0, wanted.greatest, levels);
    }
    if !split.is_empty() {
        let quads: Vec<FaceId> =
            split.iter().flat_map(|&f| cage.topology().halfedges(f)).map(|h| FaceId(h.0)).collect();
        let part = Part::new(cage, 1, &quads);
        let own: Vec<FaceId> = part.converted().collect();
        let wanted = Wanted::new(part.base(), &own, layer).map_err(|error| part.error(error))?;
        let levels = shared_levels(part.base(), &own, &wanted);
        add(1, wanted.greatest, levels.into_iter().map(|(f, level)| (part.face(f), level)).collect());
    }
    if let (Some(level), Some(least)) = (asked, greatest.filter(|least| asked < Some(least.level))) {
        return Err(PccmError::LevelTooLow { level, least: least.level, because: least.because });
    }
    let groups = faces_of.into_iter().map(|((steps, level), faces)| Group { steps, level, faces });
    Ok(Plan { groups: groups.collect() })
}

/// Faces of a cage that stay whole, and those that are split, both in order.
fn divide(cage: &Level) -> (Vec<FaceId>, Vec<FaceId>) {
    let topology = cage.topology();
    let faces = || (0..topology.face_count() as u32).map(FaceId);
    if topology.is_quads() {
        return (faces().collect(), Vec::new());
    }
    let together = Together::around_irregular_vertices(cage);
    let mut split = vec![false; topology.face_count()];
    faces().filter(|&f| topology.face_size(f) != 4).for_each(|f| split[together.first(f).index()] = true);
    faces().partition(|&f| !split[together.first(f).index()])
}

/// For each of the faces the greatest level that is wanted by those that are smoothed with it.
fn shared_levels(level: &Level, faces: &[FaceId], wanted: &Wanted) -> Vec<(FaceId, u32)> {
    if faces.iter().all(|f| wanted.levels[f.index()] == wanted.greatest.level) {
        return faces.iter().map(|&f| (f, wanted.greatest.level)).collect();
    }
    let together = Together::around_irregular_vertices(level);
    let mut shared = vec![0; wanted.levels.len()];
    for &f in faces {
        let first = together.first(f).index();
        shared[first] = wanted.levels[f.index()].max(shared[first]);
    }
    faces.iter().map(|&f| (f, shared[together.first(f).index()])).collect()
}

/// Which faces hang together.
struct Together {
    /// For each face one of smaller number that it is joined to, or itself.
    parent: Vec<u32>,
}

impl Together {
    fn around_irregular_vertices(level: &Level) -> Together {
        let topology = level.topology();
        let mut together = Together { parent: (0..topology.face_count() as u32).collect() };
        for v in (0..topology.vertex_count() as u32).map(VertexId) {
            let closing = usize::from(topology.is_boundary(v));
            let sharp_edges = topology.ring(v).filter(|&h| level.is_sharp(h)).count() + closing;
            for sector in level.sectors(v) {
                if Fan::classify(level, v, sector, sharp_edges) != CornerClass::Regular {
                    together.join(level, level.sector_halfedges(sector));
                }
            }
        }
        // The ring of a meeting of two curves looks regular.
        meetings(level).into_iter().for_each(|fan| together.join(level, fan.halfedges.into_iter()));
        together
    }

    fn join(&mut self, level: &Level, mut halfedges: impl Iterator<Item = HalfedgeId>) {
        let face = |h: HalfedgeId| level.topology().face(h);
        let Some(first) = halfedges.next().map(face) else { return };
        for f in halfedges.map(face) {
            let (a, b) = (self.first(first).0, self.first(f).0);
            self.parent[a.max(b) as usize] = a.min(b);
            // Short ways for those who come after.
            self.parent[f.index()] = a.min(b);
        }
    }

    /// The first of all faces that a face hangs together with.
    fn first(&self, f: FaceId) -> FaceId {
        let mut at = f.0;
        while self.parent[at as usize] != at {
            at = self.parent[at as usize];
        }
        FaceId(at)
    }
}
