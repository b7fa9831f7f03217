//! Blocks: the faces of a group in pieces that are converted one after the other, so that what conversion needs on its way is
//! needed for one of them only.
//!
//! A patch depends on what is a few faces around it: a corner is smoothed together with the patches around it, and an edge with
//! the corner at its other end, whose own edges know of theirs in turn. So a block is converted with [`RINGS`] of the group's faces
//! around it, and what becomes of these is thrown away. The patches are the same, bit for bit, whatever the blocks are.

use super::{Group, Part};
use crate::mesh::{FaceId, HalfedgeId};
use crate::patch::with_ring;
use crate::rules::Level;

/// Faces around a block on which its patches depend: around its corners, around the corners that are an edge away from them, and around
/// those an edge further; and one ring more, since the deviation from the limit surface looks for points on neighbours.
const RINGS: u32 = 4;

/// The faces of a group in blocks.
pub(crate) struct Blocks<'a> {
    cage: &'a Level,
    group: &'a Group,
    /// Faces of the cage, those of a block in order.
    faces: Vec<FaceId>,
    /// Where blocks begin among these, and where the last one ends.
    starts: Vec<usize>,
}

impl<'a> Blocks<'a> {
    /// Blocks of about so many faces of the cage, grown from face to face so that few faces are around them.
    pub(crate) fn new(cage: &'a Level, group: &'a Group, size: usize) -> Blocks<'a> {
        let topology = cage.topology();
        let mut waiting = vec![false; topology.face_count()];
        let mut seeds: Vec<FaceId> = match group.steps {
            0 => group.faces.clone(),
            _ => group.faces.iter().map(|quad| topology.face(HalfedgeId(quad.0))).collect(),
        };
        seeds.dedup();
        // What happens where curves meet reaches further than a few rings.
        let size = if cage.has_slices() { seeds.len() } else { size.max(1) };
        seeds.iter().for_each(|seed| waiting[seed.index()] = true);
        let mut faces: Vec<FaceId> = Vec::with_capacity(seeds.len());
        let mut starts = vec![0];
        let mut next = 0;
        for seed in seeds {
            if std::mem::replace(&mut waiting[seed.index()], false) {
                faces.push(seed);
            }
            while let Some(&face) = faces.get(next) {
                next += 1;
                for across in topology.halfedges(face).filter_map(|h| topology.twin(h)) {
                    let across = topology.face(across);
                    let start = starts[starts.len() - 1];
                    if faces.len() - start < size && std::mem::replace(&mut waiting[across.index()], false) {
                        faces.push(across);
                    }
                }
                if faces.len() - starts[starts.len() - 1] >= size {
                    next = faces.len();
                    starts.push(next);
                }
            }
        }
        if starts[starts.len() - 1] < faces.len() {
            starts.push(faces.len());
        }
        for block in starts.windows(2) {
            faces[block[0]..block[1]].sort_unstable();
        }
        Blocks { cage, group, faces, starts }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The faces of the group that a block is made of, in order.
    fn own(&self, faces: &[FaceId]) -> Vec<FaceId> {
        let Group { steps, faces: all, .. } = self.group;
        match steps {
            0 => faces.iter().copied().filter(|face| all.binary_search(face).is_ok()).collect(),
            _ => {
                let quads = faces.iter().flat_map(|&face| self.cage.topology().halfedges(face));
                quads.map(|h| FaceId(h.0)).filter(|quad| all.binary_search(quad).is_ok()).collect()
            }
        }
    }

    /// The faces of the group that a block is made of, and those that are converted for its sake, in order.
    fn faces(&self, block: usize) -> (Vec<FaceId>, Vec<FaceId>) {
        let faces = &self.faces[self.starts[block]..self.starts[block + 1]];
        if self.len() == 1 {
            return (self.group.faces.clone(), self.group.faces.clone());
        }
        let around = (0..RINGS).fold(faces.to_vec(), |faces, _| with_ring(self.cage, &faces));
        (self.own(faces), self.own(&around))
    }

    /// How many faces are converted at once, at most.
    pub(crate) fn largest(&self) -> usize {
        (0..self.len()).map(|block| self.faces(block).1.len()).max().unwrap_or(0)
    }

    /// A block with all that its patches depend on; the faces of the block are those that are visible.
    pub(crate) fn part(&self, block: usize) -> Part<'a> {
        let (own, converted) = self.faces(block);
        Part::showing(self.cage, self.group.steps, &converted, &own)
    }
}
