//! PCCM: bicubic patches of all quads.

use super::deviation::{self, Measured};
use super::source::{Source, told};
use super::{ConvertError, Packing, PlacedChart};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{HalfedgeId, Note};
use crate::nurbs::NurbsSurface;
use crate::patch::Adaptive;
use crate::pccm::{self, Layer, Pieces, pack, unpacked};

/// A cage in bicubic patches.
pub(super) struct Bicubic<'a> {
    source: &'a Source,
    layer: Layer,
    patches: pccm::Patches,
    /// One per quad, in cells.
    surfaces: Vec<NurbsSurface>,
}

impl<'a> Bicubic<'a> {
    pub(super) fn new(source: &'a Source, layer: Layer, level: u32) -> Result<Bicubic<'a>, ConvertError> {
        let options = pccm::Options { layer, level, ..pccm::Options::default() };
        let (quads, points) = source.quads();
        let patches =
            pccm::to_patches(quads, points, &options).map_err(|error| told(error, &source.origins))?;
        let surface = |net: &Grid<Vec3>| NurbsSurface {
            u: patches.knots.clone(),
            v: patches.knots.clone(),
            net: net.clone(),
        };
        let mut surfaces: Vec<NurbsSurface> = patches.nets.iter().map(surface).collect();
        if !patches.caps.is_empty() {
            let pieces = Pieces::new(quads, points, &patches, layer);
            for cap in &patches.caps {
                surfaces[cap.quad as usize] = pieces.in_cells(cap.quad);
            }
        }
        Ok(Bicubic { source, layer, patches, surfaces })
    }

    pub(super) fn deviation(&self) -> f64 {
        let (base, points) = self.source.quads();
        let level = self.patches.level;
        let cells = deviation::changed_cells(base, level, &self.patches.classes);
        let measured = Measured { base, points, level, surfaces: &self.surfaces };
        deviation::largest_deviation(&measured, &cells, 0)
    }

    pub(super) fn adaptive(&self) -> &Adaptive {
        &self.source.adaptive
    }

    pub(super) fn charts(&self, packing: Packing) -> Vec<PlacedChart> {
        let (base, points) = self.source.quads();
        let number = self.source.quads_level();
        let charts = match packing {
            Packing::Packed => {
                let seams = self.source.seams(&self.source.adaptive, number);
                pack(base, &self.patches.classes, &seams)
            }
            Packing::Unpacked => unpacked(base),
        };
        let pieces = Pieces::new(base, points, &self.patches, self.layer);
        let surfaces = par::map(charts.len(), |chart| pieces.surface(&charts[chart]));
        let placed = |(chart, surface)| PlacedChart { level: number, chart, surface };
        charts.into_iter().zip(surfaces).map(placed).collect()
    }

    pub(super) fn broken(&self) -> Vec<(usize, HalfedgeId)> {
        let number = self.source.quads_level();
        self.patches.broken.iter().map(|&h| (number, h)).collect()
    }

    pub(super) fn notes(&self) -> Vec<Note> {
        self.patches.notes.iter().map(|note| self.source.told(note)).collect()
    }
}
