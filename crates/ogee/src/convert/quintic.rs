//! The quintic method: one Bezier patch per quad.

use super::deviation::{self, Measured};
use super::source::{Source, told};
use super::{ConvertError, PlacedChart};
use crate::mesh::FaceId;
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::patch::Adaptive;
use crate::pccm::{self, unpacked};

/// A cage in quintic patches.
pub(super) struct Quintic {
    adaptive: Adaptive,
    /// One per quad of the last level.
    surfaces: Vec<NurbsSurface>,
}

impl Quintic {
    /// A quintic has no inner knots: a level means more patches.
    pub(super) fn new(source: &Source, level: u32) -> Result<Quintic, ConvertError> {
        let mut adaptive = source.adaptive.clone();
        let mut origins = source.origins.clone();
        for _ in 0..level {
            let topology = adaptive.last().level.topology();
            origins = origins.refined(topology);
            let faces: Vec<FaceId> = (0..topology.face_count() as u32).map(FaceId).collect();
            adaptive.refine(&faces);
        }
        let last = adaptive.last();
        let nets =
            pccm::to_quintic_patches(&last.level, &last.points).map_err(|error| told(error, &origins))?;
        let knots = KnotVector::from_multiplicities(5, [(0.0, 6), (1.0, 6)]);
        let surface = |net| NurbsSurface { u: knots.clone(), v: knots.clone(), net };
        let surfaces = nets.into_iter().map(surface).collect();
        Ok(Quintic { adaptive, surfaces })
    }

    pub(super) fn deviation(&self) -> f64 {
        let last = self.adaptive.last();
        let cells = deviation::all_cells(&last.level, 0);
        let measured =
            Measured { base: &last.level, points: &last.points, level: 0, surfaces: &self.surfaces };
        deviation::largest_deviation(&measured, &cells, 1)
    }

    pub(super) fn adaptive(&self) -> &Adaptive {
        &self.adaptive
    }

    pub(super) fn charts(&self) -> Vec<PlacedChart> {
        let level = self.adaptive.levels().len() - 1;
        let placed = |chart: pccm::Chart| {
            let surface = self.surfaces[chart.quads[(0, 0)].quad as usize].clone();
            PlacedChart { level, chart, surface }
        };
        unpacked(&self.adaptive.last().level).into_iter().map(placed).collect()
    }
}
