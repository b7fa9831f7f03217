//! `FineMesh`: the finest level as plain quads, for files and pictures.

#[cfg(doc)]
use super::DenseRefinement;
use crate::math::{Components, Vec3};
use crate::mesh::{FaceId, HalfedgeId};
use crate::rules::Level;

/// A refined mesh as points (or other data) and quads, numbered as [`DenseRefinement`] says; no level keeps connectivity.
#[derive(Clone, Debug, PartialEq)]
pub struct FineMesh<T = Vec3> {
    /// Points of the finest level.
    pub points: Vec<T>,
    /// The quads; hidden ones are left out.
    pub faces: Vec<[u32; 4]>,
}

/// A depth that would not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{depth} levels would make {faces} faces, which do not fit; at most {deepest} levels fit")]
pub struct TooDeep {
    /// The depth that was asked for.
    pub depth: u32,
    /// How many faces it would make.
    pub faces: u128,
    /// The greatest depth that fits.
    pub deepest: u32,
}

impl Level {
    /// `depth` steps of refinement of points alone: [`Level::dense`], its points and its quads.
    ///
    /// # Errors
    /// As [`Level::dense`].
    ///
    /// # Panics
    /// If `depth` is 0 (a cage is no mesh of quads), or there are fewer points than vertices.
    pub fn fine_mesh<T: Components>(
        &self,
        points: &[T],
        depth: u32,
        memory: u64,
    ) -> Result<FineMesh<T>, TooDeep> {
        let mut mesh = FineMesh { points: Vec::new(), faces: Vec::new() };
        self.fine_mesh_into(points, depth, memory, &mut mesh)?;
        Ok(mesh)
    }

    /// The same into the memory of an earlier mesh, which saves a good part of the time where it is done again and
    /// again.
    ///
    /// # Errors
    /// As [`Level::fine_mesh`]; then `mesh` is left as it was.
    ///
    /// # Panics
    /// As [`Level::fine_mesh`].
    pub fn fine_mesh_into<T: Components>(
        &self,
        points: &[T],
        depth: u32,
        memory: u64,
        mesh: &mut FineMesh<T>,
    ) -> Result<(), TooDeep> {
        let refinement = self.dense(depth, memory)?;
        refinement.points(points, &mut mesh.points);
        refinement.quads(&mut mesh.faces);
        Ok(())
    }

    /// Leaves those of the next level's quads that are part of the surface.
    pub(super) fn retain_visible(&self, quads: &mut Vec<[u32; 4]>) {
        if self.hidden_faces().is_empty() {
            return;
        }
        let mut halfedge = 0;
        quads.retain(|_| {
            let visible = self.is_visible(self.topology().face(HalfedgeId(halfedge)));
            halfedge += 1;
            visible
        });
    }

    /// The visible faces of this level as quads.
    ///
    /// # Panics
    /// If there are other polygons.
    pub fn quads(&self) -> Vec<[u32; 4]> {
        assert!(self.topology().is_quads(), "all faces are quads");
        let corners = self.topology().origin.chunks_exact(4);
        let quads = corners.enumerate().filter(|&(f, _)| self.is_visible(FaceId(f as u32)));
        quads.map(|(_, quad)| [quad[0], quad[1], quad[2], quad[3]]).collect()
    }

    /// How many faces there are after so many steps.
    pub(super) fn faces_at(&self, depth: u32) -> u128 {
        let topology = self.topology();
        match depth {
            0 => topology.face_count() as u128,
            _ => (topology.halfedge_count() as u128) << (2 * (depth.min(46) - 1)),
        }
    }

    /// Asks whether levels of `depth` steps fit into ids and into `memory` bytes; for points and quads alone there is
    /// [`Level::check_fine_mesh`].
    ///
    /// # Errors
    /// If they do not.
    pub fn check_depth(&self, depth: u32, memory: u64) -> Result<(), TooDeep> {
        let faces = |depth: u32| self.faces_at(depth);
        // Ids of halfedges are below 2^32 - 1 on every level that has halfedges, so four a face on the last.
        let fits = |depth: u32| {
            4 * faces(depth) < u128::from(u32::MAX) && faces(depth) * BYTES_PER_FACE <= u128::from(memory)
        };
        if depth == 0 || fits(depth) {
            return Ok(());
        }
        let deepest = (0..depth.min(46)).rev().find(|&shallower| fits(shallower)).unwrap_or(0);
        Err(TooDeep { depth, faces: faces(depth), deepest })
    }
}

/// What a face of the finest level costs: its point and corners (40 bytes), and a quarter of what a face of the
/// level before costs (connectivity 52 bytes, its points 24).
const BYTES_PER_FACE: u128 = 60;
