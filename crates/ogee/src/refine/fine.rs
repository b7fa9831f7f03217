//! `FineMesh`: the finest level as plain quads, for files and pictures.

use std::borrow::Cow;

use super::split::child_quad;
use crate::math::{Interpolate, Vec3, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};
use crate::rules::Level;

/// A refined mesh as points (or other data) and quads; its last level keeps no connectivity.
#[derive(Clone, Debug, PartialEq)]
pub struct FineMesh<T = Vec3> {
    /// Points of the finest level.
    pub points: Vec<T>,
    /// The quads, in the order of the level's faces; hidden ones are left out.
    pub faces: Vec<[u32; 4]>,
}

/// The quads of the level after `topology`.
fn write_quads(topology: &impl Connectivity, out: &mut Vec<[u32; 4]>) {
    out.clear();
    par::extend(out, topology.halfedge_count(), |h| child_quad(topology, HalfedgeId(h as u32)));
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
    /// `depth` steps of refinement of points alone. The last level's connectivity is never made, which saves most
    /// of the time and memory.
    ///
    /// # Errors
    /// If the finest level would have `2^32 - 1` halfedges or more, or more than `memory` bytes would be needed.
    ///
    /// # Panics
    /// If `depth` is 0 (a cage is no mesh of quads), or there are fewer points than vertices.
    pub fn fine_mesh<T: Interpolate>(
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
    pub fn fine_mesh_into<T: Interpolate>(
        &self,
        points: &[T],
        depth: u32,
        memory: u64,
        mesh: &mut FineMesh<T>,
    ) -> Result<(), TooDeep> {
        assert!(depth > 0, "a fine mesh is at least one step away");
        self.check_depth(depth, memory)?;
        let mut level = Cow::Borrowed(self);
        let mut points = Cow::Borrowed(points);
        for _ in 1..depth {
            let (next, next_points) = level.refine_points(&points);
            (level, points) = (Cow::Owned(next), Cow::Owned(next_points));
        }
        level.last_step(&points, mesh);
        Ok(())
    }

    fn last_step<T: Interpolate>(&self, points: &[T], mesh: &mut FineMesh<T>) {
        let topology = self.topology();
        self.child_points(points, &mut mesh.points);
        match topology.as_quads() {
            Some(quads) => write_quads(&quads, &mut mesh.faces),
            None => write_quads(topology, &mut mesh.faces),
        }
        if !self.hidden_faces().is_empty() {
            let mut halfedge = 0;
            mesh.faces.retain(|_| {
                let visible = self.is_visible(topology.face(HalfedgeId(halfedge)));
                halfedge += 1;
                visible
            });
        }
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

    /// Asks whether `depth` steps fit into ids and into `memory` bytes.
    ///
    /// # Errors
    /// If they do not.
    pub fn check_depth(&self, depth: u32, memory: u64) -> Result<(), TooDeep> {
        let halfedges = self.topology().halfedge_count() as u128;
        let faces = |depth: u32| match depth {
            0 => self.topology().face_count() as u128,
            _ => halfedges << (2 * (depth.min(46) - 1)),
        };
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
