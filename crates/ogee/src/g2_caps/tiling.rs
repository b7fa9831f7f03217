//! `Tiling`: which face of which level becomes what (Whole meshes on the method's page).
//!
//! The regular surface is the same on every level, so every irregular vertex takes the coarsest on which it may have a
//! cap, and the rest is refined no more than it needs. Faces of different levels meet in T vertices.

use super::site::{Obstacle, Site, is_regular, site};
use super::weights;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::patch::{Adaptive, AdaptiveLevel, with_ring};

/// A cage cut into faces of several levels.
#[derive(Clone, Debug)]
pub(crate) struct Tiling {
    pub(crate) adaptive: Adaptive,
    /// By level: faces that are one bicubic piece, in order.
    pub(crate) regular: Vec<Vec<FaceId>>,
    /// By level, then by vertex.
    pub(crate) caps: Vec<PlacedCap>,
    /// Sectors that can have no cap, alone with regular corners around.
    pub(crate) uncapped: Vec<Uncapped>,
}

/// Where a cap sits.
#[derive(Clone, Debug)]
pub(crate) struct PlacedCap {
    pub(crate) level: usize,
    /// A vertex of that level.
    pub(crate) vertex: VertexId,
    pub(crate) site: Site,
}

/// A sector without a cap.
#[derive(Clone, Debug)]
pub(crate) struct Uncapped {
    pub(crate) level: usize,
    /// Why.
    pub(crate) obstacle: Obstacle,
    /// The halfedges that leave the vertex in the sector's faces.
    pub(crate) halfedges: Vec<HalfedgeId>,
}

/// Levels after which nothing is left to be refined away: sharpness has faded, and nothing irregular shares a face.
const DEEPEST: usize = 16;

impl Tiling {
    /// Cuts a cage; `level_of` is the least level of the caps around a vertex, given by the number that it keeps on all levels.
    ///
    /// # Errors
    /// A face of the cage, a part of which is neither regular nor in a cap on a level so deep that refinement will not change that.
    pub(crate) fn new(cage: &Adaptive, level_of: impl Fn(u32) -> u32) -> Result<Tiling, FaceId> {
        let mut tiling =
            Tiling { adaptive: cage.clone(), regular: Vec::new(), caps: Vec::new(), uncapped: Vec::new() };
        let mut todo: Vec<FaceId> = cage.levels()[0].visible_faces().collect();
        for number in 0.. {
            let level = &tiling.adaptive.levels()[number];
            let mut found = Found::new(level, &todo);
            found.caps(number, &level_of, &mut tiling.caps, &mut tiling.uncapped);
            let (regular, rest) = found.regular();
            tiling.regular.push(regular);
            let Some(&left) = rest.first() else { break };
            if number >= DEEPEST {
                return Err(level.addresses[left.index()].face);
            }
            let wanted = with_hidden(level, &rest);
            let children = tiling.adaptive.refine(&wanted);
            let next = tiling.adaptive.last();
            todo = children.into_iter().filter(|&face| next.is_visible(face)).collect();
        }
        Ok(tiling)
    }
}

/// Faces with the hidden ones that touch them: what is seen of a cap depends on all faces around its vertex.
fn with_hidden(level: &AdaptiveLevel, faces: &[FaceId]) -> Vec<FaceId> {
    let mut all = with_ring(&level.level, faces);
    all.retain(|face| !level.is_visible(*face) || faces.binary_search(face).is_ok());
    all
}

/// What is found on a level.
struct Found<'a> {
    level: &'a AdaptiveLevel,
    todo: &'a [FaceId],
    /// By face: true while it is not taken.
    left: Vec<bool>,
}

impl<'a> Found<'a> {
    fn new(level: &'a AdaptiveLevel, todo: &'a [FaceId]) -> Found<'a> {
        let mut left = vec![false; level.level.topology().face_count()];
        todo.iter().for_each(|face| left[face.index()] = true);
        Found { level, todo, left }
    }

    /// Puts caps wherever they may sit, and finds sectors that can have none.
    fn caps(
        &mut self,
        number: usize,
        level_of: impl Fn(u32) -> u32,
        caps: &mut Vec<PlacedCap>,
        uncapped: &mut Vec<Uncapped>,
    ) {
        let AdaptiveLevel { level, points, vertices, .. } = self.level;
        let topology = level.topology();
        let corners = self.todo.iter().flat_map(|&face| topology.halfedges(face));
        let mut around: Vec<VertexId> = corners.map(|h| topology.origin(h)).collect();
        around.sort_unstable();
        around.dedup();
        for vertex in around {
            for sector in level.sectors(vertex) {
                let fan = || level.sector_halfedges(sector);
                if !fan().any(|h| self.left[topology.face(h).index()]) {
                    continue;
                }
                let found = site(level, points, vertex, sector).and_then(|site| match site {
                    Some(site) if weights(site.class).is_none() => {
                        Err(Obstacle::TooManyFaces { vertex, faces: sector.faces })
                    }
                    other => Ok(other),
                });
                match found {
                    Ok(None) => {}
                    Ok(Some(site)) if level_of(vertices[vertex.index()]) <= number as u32 => {
                        self.take(&site.halfedges);
                        caps.push(PlacedCap { level: number, vertex, site });
                    }
                    Err(obstacle) if !obstacle.is_cured_by_refinement() && self.is_alone(vertex, fan()) => {
                        let halfedges: Vec<HalfedgeId> = fan().collect();
                        self.take(&halfedges);
                        uncapped.push(Uncapped { level: number, obstacle, halfedges });
                    }
                    // Refinement will help.
                    Err(_) | Ok(Some(_)) => {}
                }
            }
        }
    }

    fn take(&mut self, halfedges: &[HalfedgeId]) {
        let topology = self.level.level.topology();
        halfedges.iter().for_each(|&h| self.left[topology.face(h).index()] = false);
    }

    /// True if all faces of a vertex's sector are quads whose other corners are regular, but for what the vertex itself makes
    /// irregular.
    fn is_alone(&self, vertex: VertexId, mut sector: impl Iterator<Item = HalfedgeId>) -> bool {
        let level = &self.level.level;
        let topology = level.topology();
        let is_free = |corner: HalfedgeId| match is_regular(level, topology.origin(corner), corner) {
            Ok(()) => true,
            Err(Obstacle::Meeting { centre, .. }) => centre == vertex,
            Err(_) => false,
        };
        sector.all(|h| {
            let face = topology.face(h);
            let mut others = topology.halfedges(face).filter(|&corner| corner != h);
            topology.face_size(face) == 4 && others.all(is_free)
        })
    }

    fn is_bicubic(&self, corner: HalfedgeId) -> bool {
        let level = &self.level.level;
        is_regular(level, level.topology().origin(corner), corner).is_ok()
    }

    /// The faces that are left, with four regular corners and others.
    fn regular(&self) -> (Vec<FaceId>, Vec<FaceId>) {
        let topology = self.level.level.topology();
        let left = self.todo.iter().copied().filter(|face| self.left[face.index()]);
        left.partition(|&face| {
            topology.face_size(face) == 4 && topology.halfedges(face).all(|corner| self.is_bicubic(corner))
        })
    }
}
