//! NURBS patches, as instruments look at them.

use super::sides::matched;
use super::{Address, Layout, Square, Surface};
use crate::limit::{Derivatives, Flags, Samples};
use crate::math::{Grid, SurfaceJet, Vec3, par};
use crate::nurbs::{FaceAddress, NurbsSurface};
use crate::patch::Location;

/// Patches with the layout of their squares: a square for each piece of the cage that a patch covers, cut where a side of it lies
/// beside several smaller ones.
#[derive(Clone, Debug)]
pub struct PatchView {
    patches: Vec<(NurbsSurface, Grid<FaceAddress>)>,
    layout: Layout,
}

/// Why patches cannot be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PatchViewError {
    /// There are none.
    #[error("there are no patches")]
    Empty,
    /// A patch that covers nothing of the cage.
    #[error("patch {patch} covers no face")]
    NoFace {
        /// The patch, numbered from 0.
        patch: usize,
    },
}

impl PatchView {
    /// Lays patches side by side: sides whose ends and middles agree, to 1e-6 of the size of all, are joined. Each patch
    /// comes with the pieces of the cage that it covers, `(i, j)`, `i` along `u`, all of the same size in its parameters.
    ///
    /// Where half a side, or a smaller part of it by halving, is a side of another piece, the larger one is cut in two across that
    /// side, and so is whatever lies beside the new pieces, until squares share whole sides.
    ///
    /// # Errors
    /// If there is nothing to look at.
    pub fn new(patches: Vec<(NurbsSurface, Grid<FaceAddress>)>) -> Result<PatchView, PatchViewError> {
        if patches.is_empty() {
            return Err(PatchViewError::Empty);
        }
        if let Some(patch) = patches.iter().position(|(_, cells)| cells.cells().is_empty()) {
            return Err(PatchViewError::NoFace { patch });
        }
        let mut squares = Vec::new();
        for (number, (_, cells)) in (0..).zip(&patches) {
            let size = [1.0 / cells.rows() as f64, 1.0 / cells.cols() as f64];
            for i in 0..cells.rows() {
                for j in 0..cells.cols() {
                    let (u, v) = (i as f64 * size[0], j as f64 * size[1]);
                    let edges = [j == 0, i + 1 == cells.rows(), j + 1 == cells.cols(), i == 0];
                    squares.push(Square::whole(Location { root: number, u, v }, size, edges));
                }
            }
        }
        let (squares, joints) = matched(squares, |at| jet(&patches[at.root as usize].0, at).position);
        Ok(PatchView { patches, layout: Layout::new(squares, joints) })
    }

    /// The patches, and the pieces of the cage that they cover.
    pub fn patches(&self) -> &[(NurbsSurface, Grid<FaceAddress>)] {
        &self.patches
    }
}

impl Surface for PatchView {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn evaluate(&self, at: &[Location], what: Derivatives, out: &mut Samples) {
        let jets = par::collect(at.len(), |i| jet(&self.patches[at[i].root as usize].0, at[i]));
        let normals: Vec<Option<Vec3>> = jets.iter().map(SurfaceJet::normal).collect();
        let is = |wanted: Derivatives| what >= wanted;
        let list = |wanted: bool, part: fn(&SurfaceJet) -> Vec3| -> Vec<Vec3> {
            if wanted { jets.iter().map(part).collect() } else { Vec::new() }
        };
        *out = Samples {
            position: list(true, |jet| jet.position),
            du: list(is(Derivatives::First), |jet| jet.du),
            dv: list(is(Derivatives::First), |jet| jet.dv),
            normal: if is(Derivatives::First) {
                normals.iter().map(|normal| normal.unwrap_or_default()).collect()
            } else {
                Vec::new()
            },
            duu: list(is(Derivatives::Second), |jet| jet.duu),
            duv: list(is(Derivatives::Second), |jet| jet.duv),
            dvv: list(is(Derivatives::Second), |jet| jet.dvv),
            flags: normals
                .iter()
                .map(|normal| if normal.is_some() { Flags::NONE } else { Flags::NORMAL_UNDEFINED })
                .collect(),
        };
    }

    fn address(&self, at: Location) -> Address {
        let cells = &self.patches[at.root as usize].1;
        let within = |x: f64, count: usize| {
            let x = x * count as f64;
            let cell = (x as usize).min(count - 1);
            (cell, x - cell as f64)
        };
        let ((i, u), (j, v)) = (within(at.u, cells.rows()), within(at.v, cells.cols()));
        let FaceAddress { face, corner, quarters } = cells[(i, j)];
        let [u, v] = quarters.outwards([u, v]);
        Address { face, corner, u, v }
    }
}

/// The jet of a patch with parameters from 0 to 1.
fn jet(surface: &NurbsSurface, at: Location) -> SurfaceJet {
    let ([u0, u1], [v0, v1]) = (surface.u.domain(), surface.v.domain());
    let (a, b) = (u1 - u0, v1 - v0);
    let jet = surface.jet(u0 + at.u * a, v0 + at.v * b);
    SurfaceJet {
        position: jet.position,
        du: a * jet.du,
        dv: b * jet.dv,
        duu: (a * a) * jet.duu,
        duv: (a * b) * jet.duv,
        dvv: (b * b) * jet.dvv,
    }
}
