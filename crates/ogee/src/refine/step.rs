//! One step of refinement, as a level and a table of weights.

use crate::mesh::{EdgeId, FaceId, VertexId};
use crate::rules::{Level, masks};
use crate::stencil::StencilTable;

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
        let (vertices, faces) = (topology.vertex_count(), topology.face_count());
        let edges = topology.edge_count();
        let stencils = StencilTable::from_rows(vertices + faces + edges, |i, row| {
            if i < vertices {
                masks::vertex_mask(self, VertexId(i as u32), row);
            } else if i < vertices + faces {
                masks::face_mask(self, FaceId((i - vertices) as u32), row);
            } else {
                masks::edge_mask(self, topology.side(EdgeId((i - vertices - faces) as u32)), row);
            }
        });
        Step { level: self.split(), stencils }
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
