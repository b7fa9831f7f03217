//! `Sector`: the faces between two sharp edges.

use super::Level;
use crate::mesh::{HalfedgeId, VertexId};

/// The faces around a vertex between two infinitely sharp (or boundary) edges, or all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sector {
    /// The halfedge that leaves the vertex in the first face; the others follow counter-clockwise.
    pub first: HalfedgeId,
    /// Number of faces.
    pub faces: u32,
    /// True if no sharp edge meets the vertex: the faces go all the way round.
    pub closed: bool,
}

impl Level {
    /// True if the edge is infinitely sharp, as boundary edges are.
    pub fn is_sharp(&self, h: HalfedgeId) -> bool {
        self.edge_sharpness(h).is_infinite()
    }

    /// The sectors around a vertex, counter-clockwise. At a dart (one sharp edge) there is one, open, of all faces.
    pub fn sectors(&self, v: VertexId) -> Vec<Sector> {
        let topology = &self.topology;
        let mut ring: Vec<HalfedgeId> = topology.ring(v).collect();
        let Some(start) = ring.iter().position(|&h| self.is_sharp(h)) else {
            let closed = Sector { first: HalfedgeId(0), faces: ring.len() as u32, closed: true };
            return ring.first().map(|&first| Sector { first, ..closed }).into_iter().collect();
        };
        ring.rotate_left(start);
        let mut sectors: Vec<Sector> = Vec::new();
        for &h in &ring {
            match sectors.last_mut() {
                Some(sector) if !self.is_sharp(h) => sector.faces += 1,
                _ => sectors.push(Sector { first: h, faces: 1, closed: false }),
            }
        }
        sectors
    }

    /// The halfedges of a sector that leave the vertex, one per face, counter-clockwise.
    pub fn sector_halfedges(&self, sector: Sector) -> impl Iterator<Item = HalfedgeId> + '_ {
        std::iter::successors(Some(sector.first), |&h| self.topology.twin(self.topology.prev(h)))
            .take(sector.faces as usize)
    }
}
