//! PCCM: bicubic patches of all quads, each on the level that it asks for.

use super::deviation::{self, Measured};
use super::part::LevelFaces;
use super::source::{Source, told, told_note};
use super::{ConvertError, DEEPEST_LEVEL, Options, Packing, PlacedChart};
use crate::lens::Origins;
use crate::mesh::{FaceId, HalfedgeId, Note};
use crate::patch::Adaptive;
use crate::pccm::{self, Chart, Group, Layer, Placed, Plan};
use crate::refine::TooDeep;
use std::borrow::Cow;

/// A cage in bicubic patches.
pub(super) struct Bicubic<'a> {
    source: &'a Source,
    /// The cage, and one refinement of its faces that are split.
    adaptive: Adaptive,
    groups: Vec<Converted<'a>>,
}

/// A group of faces in patches, measured.
struct Converted<'a> {
    group: Group,
    patches: pccm::Converted<'a>,
    deviation: f64,
}

impl<'a> Bicubic<'a> {
    /// Each group of faces on the least level that will do.
    pub(super) fn new(
        source: &'a Source,
        layer: Layer,
        options: &Options,
    ) -> Result<Bicubic<'a>, ConvertError> {
        let cage = source.cage();
        let mut plan =
            pccm::plan(cage, layer, options.level).map_err(|error| told(error, &source.origins))?;
        let choices = pccm::Options { layer, ..pccm::Options::default() };
        let mut groups = Vec::with_capacity(plan.groups.len());
        for number in 0..plan.groups.len() {
            groups.push(loop {
                check_memory(&plan, options)?;
                let converted = Converted::new(source, &plan.groups[number], &choices)?;
                let Converted { deviation: reached, .. } = converted;
                let level = &mut plan.groups[number].level;
                match options.max_deviation {
                    Some(wanted)
                        if reached >= wanted && *level < DEEPEST_LEVEL && options.level.is_none() =>
                    {
                        *level += 1;
                    }
                    Some(wanted) if reached >= wanted => {
                        return Err(ConvertError::Deviation { wanted, reached, level: *level });
                    }
                    _ => break converted,
                }
            });
        }
        let mut adaptive = source.adaptive.clone();
        let topology = cage.topology();
        let split = plan.groups.iter().filter(|group| group.steps > 0).flat_map(|group| &group.faces);
        let mut split: Vec<FaceId> = split.map(|quad| topology.face(HalfedgeId(quad.0))).collect();
        split.sort_unstable();
        split.dedup();
        if !split.is_empty() {
            adaptive.refine(&split);
        }
        Ok(Bicubic { source, adaptive, groups })
    }

    pub(super) fn deviation(&self) -> f64 {
        self.groups.iter().map(|converted| converted.deviation).fold(0.0, f64::max)
    }

    /// How many faces are refined how often.
    pub(super) fn faces_by_level(&self) -> Vec<LevelFaces> {
        let mut levels: Vec<LevelFaces> = Vec::new();
        for Converted { group: Group { steps, level, .. }, patches, .. } in &self.groups {
            let faces =
                patches.part.base().topology().face_count() - patches.part.base().hidden_faces().len();
            match levels.iter_mut().find(|other| (other.steps, other.level) == (*steps, *level)) {
                Some(other) => other.faces += faces,
                None => levels.push(LevelFaces { steps: *steps, level: *level, faces }),
            }
        }
        levels.retain(|level| level.faces > 0);
        levels.sort_by_key(|level| (level.steps, level.level));
        levels
    }

    pub(super) fn adaptive(&self) -> &Adaptive {
        &self.adaptive
    }

    pub(super) fn charts(&self, packing: Packing) -> Vec<PlacedChart> {
        let seams = self.source.seams(&self.adaptive, 0);
        let mut charts = Vec::new();
        for Converted { group, patches, .. } in &self.groups {
            let of_group = match packing {
                Packing::Packed => patches.packed(&seams),
                Packing::Unpacked => patches.unpacked(),
            };
            charts.extend(of_group.into_iter().map(|(Chart { quads }, surface)| {
                let own = |placed: &Placed| Placed { quad: self.quad(group.steps, placed.quad), ..*placed };
                PlacedChart { level: group.steps as usize, chart: Chart { quads: quads.map(own) }, surface }
            }));
        }
        charts
    }

    /// The number, on the level of so many steps, of a face that has the given one when all are refined.
    fn quad(&self, steps: u32, whole: u32) -> u32 {
        match steps {
            0 => whole,
            _ => self.adaptive.halves(0, HalfedgeId(whole)).map_or(whole, |[first, _]| first.0 / 4),
        }
    }

    /// Halfedges of a level whose edge is not smooth next to their origin.
    pub(super) fn broken(&self) -> Vec<(usize, HalfedgeId)> {
        let of_group = |converted: &'_ Converted<'a>| {
            let steps = converted.group.steps;
            let own = move |h: HalfedgeId| match steps {
                0 => h,
                _ => HalfedgeId(4 * self.quad(steps, h.0 / 4) + h.0 % 4),
            };
            converted.patches.broken().into_iter().map(move |h| (steps as usize, own(h)))
        };
        self.groups.iter().flat_map(of_group).collect()
    }

    /// In terms of the cage that was given.
    pub(super) fn notes(&self) -> Vec<Note> {
        let mut notes = Vec::new();
        for Converted { group, patches, .. } in &self.groups {
            let origins: Cow<'_, Origins> = match group.steps {
                0 => Cow::Borrowed(&self.source.origins),
                _ => Cow::Owned(self.source.origins.refined(self.source.cage().topology())),
            };
            notes.extend(patches.notes().iter().map(|note| told_note(note, &origins)));
        }
        notes
    }
}

impl<'a> Converted<'a> {
    fn new(
        source: &'a Source,
        group: &Group,
        choices: &pccm::Options,
    ) -> Result<Converted<'a>, ConvertError> {
        let part = pccm::Part::new(source.cage(), group.steps, &group.faces);
        part.base().check_depth(group.level, u64::MAX)?;
        let choices = pccm::Options { level: group.level, ..*choices };
        let patches = pccm::Converted::new(part, source.cage_points(), &choices);
        let base = patches.part.base();
        let cells = deviation::changed_cells(base, group.level, &patches.patches.classes);
        let surfaces = if cells.is_empty() { Vec::new() } else { patches.surfaces() };
        let measured = Measured { base, points: &patches.points, level: group.level, surfaces: &surfaces };
        let deviation = deviation::largest_deviation(&measured, &cells, 0);
        Ok(Converted { group: group.clone(), patches, deviation })
    }
}

/// Measured on studded tori of 10 000 and 100 000 quads at levels 2 to 5 (82 to 148), rounded up.
const BYTES_PER_COEFFICIENT: u128 = 160;

/// Asks whether the coefficients of all patches fit: as inserted, as smoothed, as surfaces; nets of all levels; the refined mesh.
fn check_memory(plan: &Plan, options: &Options) -> Result<(), TooDeep> {
    let greatest = plan.groups.iter().map(|group| group.level).max().unwrap_or(0);
    let bytes = |most: u32| -> u128 {
        let of_group = |group: &Group| {
            let side = (1u128 << group.level.min(most)) + 7;
            group.faces.len() as u128 * side * side * BYTES_PER_COEFFICIENT
        };
        plan.groups.iter().map(of_group).sum()
    };
    let memory = u128::from(options.memory.unwrap_or(u64::MAX));
    if bytes(greatest) <= memory {
        return Ok(());
    }
    let deepest = (0..greatest).rev().find(|&shallower| bytes(shallower) <= memory).unwrap_or(0);
    let faces = plan.groups.iter().map(|group| (group.faces.len() as u128) << (2 * group.level)).sum();
    Err(TooDeep { depth: greatest, faces, deepest })
}
