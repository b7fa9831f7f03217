//! The quintic method: one Bezier patch per quad.

use super::deviation::{self, Measured};
use super::part::LevelFaces;
use super::source::{Source, told};
use super::{ConvertError, DEEPEST_LEVEL, Options, PlacedChart};
use crate::mesh::FaceId;
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::patch::Adaptive;
use crate::pccm::{self, unpacked};
use crate::refine::TooDeep;

/// A cage in quintic patches.
pub(super) struct Quintic {
    adaptive: Adaptive,
    level: u32,
    /// One per quad of the last level.
    surfaces: Vec<NurbsSurface>,
    deviation: f64,
    memory: u64,
}

impl Quintic {
    /// The least level that will do, the same for all faces.
    pub(super) fn new(source: &Source, options: &Options) -> Result<Quintic, ConvertError> {
        let mut level = options.level.unwrap_or(0);
        loop {
            let quintic = Quintic::at_level(source, options, level)?;
            let reached = quintic.deviation;
            match options.max_deviation {
                Some(wanted) if reached >= wanted && level < DEEPEST_LEVEL && options.level.is_none() => {
                    level += 1;
                }
                Some(wanted) if reached >= wanted => {
                    return Err(ConvertError::Deviation { wanted, reached, level });
                }
                _ => return Ok(quintic),
            }
        }
    }

    /// A quintic has no inner knots: a level means more patches.
    fn at_level(source: &Source, options: &Options, level: u32) -> Result<Quintic, ConvertError> {
        let steps = u32::from(!source.cage().topology().is_quads()) + level;
        let memory = check_memory(source, options, level)?;
        let mut adaptive = source.adaptive.clone();
        let mut origins = source.origins.clone();
        for _ in 0..steps {
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
        let surfaces: Vec<NurbsSurface> = nets.into_iter().map(surface).collect();
        let cells = deviation::all_cells(&last.level, 0);
        let measured = Measured { base: &last.level, points: &last.points, level: 0, surfaces: &surfaces };
        let deviation = deviation::largest_deviation(&measured, &cells, 1);
        Ok(Quintic { adaptive, level, surfaces, deviation, memory })
    }

    pub(super) fn deviation(&self) -> f64 {
        self.deviation
    }

    pub(super) fn memory(&self) -> u64 {
        self.memory
    }

    /// How many faces are refined how often.
    pub(super) fn faces_by_level(&self) -> Vec<LevelFaces> {
        let steps = self.adaptive.levels().len() as u32 - 1 - self.level;
        let faces = self.adaptive.levels()[steps as usize].visible_faces().count();
        vec![LevelFaces { steps, level: self.level, faces }]
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

/// Measured on Spot at levels 0 to 2, rounded up: the patch itself is a small part of it, the refined mesh that it is
/// measured against the larger.
const BYTES_PER_QUINTIC: u128 = 32_000;

/// Asks whether the refined mesh and the coefficients of all patches fit.
fn check_memory(source: &Source, options: &Options, level: u32) -> Result<u64, TooDeep> {
    let cage = source.cage();
    let topology = cage.topology();
    let (steps, quads) = match topology.is_quads() {
        true => (0, topology.face_count()),
        false => (1, topology.halfedge_count()),
    };
    cage.check_depth(steps + level, u64::MAX)?;
    let bytes = |level: u32| ((quads as u128) << (2 * level)) * BYTES_PER_QUINTIC;
    let memory = u128::from(options.memory.unwrap_or(u64::MAX));
    if bytes(level) <= memory {
        return Ok(u64::try_from(bytes(level)).unwrap_or(u64::MAX));
    }
    let deepest = (0..level).rev().find(|&shallower| bytes(shallower) <= memory).unwrap_or(0);
    Err(TooDeep { depth: level, faces: (quads as u128) << (2 * level), deepest })
}
