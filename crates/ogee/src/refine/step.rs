//! One step of refinement, as a level and a table of weights.

use crate::mesh::{EdgeId, FaceId, VertexId};
use crate::rules::{Level, masks};
use crate::stencil::{Row, StencilTable};

/// What one step gives: the next level, and how its points come from those of this one.
#[derive(Clone, Debug)]
pub struct Step {
    /// The next level.
    pub level: Level,
    /// One row per vertex of the next level.
    pub stencils: StencilTable,
}

impl Level {
    /// One step of refinement. Costs about 75 bytes per new vertex for the table; where points are refined once
    /// and no table is wanted, [`Level::refine_points`] is quicker.
    ///
    /// # Panics
    /// If the next level would have `2^32 - 1` halfedges or more; [`crate::Refinement::uniform`] asks first.
    pub fn refine(&self) -> Step {
        let topology = self.topology();
        let count = topology.vertex_count() + topology.face_count() + topology.edge_count();
        let stencils = StencilTable::from_rows(count, |i, row| self.child_mask(i as u32, row));
        Step { level: self.split(), stencils }
    }

    /// What makes a vertex of the next level, by its number there.
    pub(crate) fn child_mask(&self, child: u32, row: &mut Row) {
        let topology = self.topology();
        let (vertices, faces) = (topology.vertex_count() as u32, topology.face_count() as u32);
        if child < vertices {
            masks::vertex_mask(self, VertexId(child), row);
        } else if child < vertices + faces {
            masks::face_mask(self, FaceId(child - vertices), row);
        } else {
            masks::edge_mask(self, topology.side(EdgeId(child - vertices - faces)), row);
        }
    }

    /// The next level alone.
    pub(crate) fn split(&self) -> Level {
        assert!(
            self.topology().halfedge_count() < (u32::MAX / 4) as usize,
            "the next level would have too many elements"
        );
        self.child(self.topology().split())
    }
}
