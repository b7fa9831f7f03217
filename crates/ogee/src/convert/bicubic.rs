//! PCCM: bicubic patches of all quads, each on the level that it asks for.

use super::deviation::{self, Measured};
use super::part::LevelFaces;
use super::source::{Source, told, told_note};
use super::{ConvertError, DEEPEST_LEVEL, Options, Packing, PlacedChart, memory};
use crate::lens::Origins;
use crate::mesh::{FaceId, HalfedgeId, Note, Place};
use crate::nurbs::NurbsSurface;
use crate::patch::Adaptive;
use crate::pccm::{self, Blocks, Chart, Group, Layer, Placed};
use std::borrow::Cow;

/// A cage in bicubic patches.
pub(super) struct Bicubic<'a> {
    source: &'a Source,
    /// The cage, and one refinement of its faces that are split.
    adaptive: Adaptive,
    groups: Vec<Converted>,
    memory: u64,
}

/// A group of faces in patches, measured.
struct Converted {
    group: Group,
    /// In terms of the level that its faces are of.
    charts: Vec<(Chart, NurbsSurface)>,
    broken: Vec<HalfedgeId>,
    notes: Vec<Note>,
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
        let mut adaptive = source.adaptive.clone();
        let topology = cage.topology();
        let split = plan.groups.iter().filter(|group| group.steps > 0).flat_map(|group| &group.faces);
        let mut split: Vec<FaceId> = split.map(|quad| topology.face(HalfedgeId(quad.0))).collect();
        split.sort_unstable();
        split.dedup();
        if !split.is_empty() {
            adaptive.refine(&split);
        }
        let seams = source.seams(&adaptive, 0);
        let mut memory = 0;
        let mut groups = Vec::with_capacity(plan.groups.len());
        for number in 0..plan.groups.len() {
            groups.push(loop {
                memory = memory::stated(cage, &plan, options)?;
                let group = &plan.groups[number];
                let block = memory::block_size(group, options);
                let converted = Converted::new(source, group, &choices, options, &seams, block)?;
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
        Ok(Bicubic { source, adaptive, groups, memory })
    }

    pub(super) fn deviation(&self) -> f64 {
        self.groups.iter().map(|converted| converted.deviation).fold(0.0, f64::max)
    }

    /// How many faces are refined how often.
    pub(super) fn faces_by_level(&self) -> Vec<LevelFaces> {
        let cage = self.source.cage();
        let mut levels: Vec<LevelFaces> = Vec::new();
        for Converted { group: Group { steps, level, faces }, .. } in &self.groups {
            let is_visible = |&&face: &&FaceId| match steps {
                0 => cage.is_visible(face),
                _ => cage.is_visible(cage.topology().face(HalfedgeId(face.0))),
            };
            let faces = faces.iter().filter(is_visible).count();
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

    /// All charts; afterwards there are none.
    pub(super) fn take_charts(&mut self) -> Vec<PlacedChart> {
        let all = self.groups.iter_mut().map(|converted| std::mem::take(&mut converted.charts));
        let all: Vec<Vec<(Chart, NurbsSurface)>> = all.collect();
        let mut charts = Vec::with_capacity(all.iter().map(Vec::len).sum());
        for (Converted { group, .. }, of_group) in self.groups.iter().zip(all) {
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
        let of_group = |converted: &'_ Converted| {
            let steps = converted.group.steps;
            let own = move |h: &HalfedgeId| match steps {
                0 => *h,
                _ => HalfedgeId(4 * self.quad(steps, h.0 / 4) + h.0 % 4),
            };
            converted.broken.iter().map(|h| (steps as usize, own(h))).collect::<Vec<_>>()
        };
        self.groups.iter().flat_map(of_group).collect()
    }

    /// In terms of the cage that was given.
    pub(super) fn notes(&self) -> Vec<Note> {
        let mut notes = Vec::new();
        for converted in self.groups.iter().filter(|converted| !converted.notes.is_empty()) {
            let origins: Cow<'_, Origins> = match converted.group.steps {
                0 => Cow::Borrowed(&self.source.origins),
                _ => Cow::Owned(self.source.origins.refined(self.source.cage().topology())),
            };
            notes.extend(converted.notes.iter().map(|note| told_note(note, &origins)));
        }
        notes
    }

    pub(super) fn memory(&self) -> u64 {
        self.memory
    }
}

impl Converted {
    fn new(
        source: &Source,
        group: &Group,
        choices: &pccm::Options,
        options: &Options,
        seams: &[HalfedgeId],
        block: usize,
    ) -> Result<Converted, ConvertError> {
        source.cage().check_depth(group.steps + group.level, u64::MAX)?;
        let choices = pccm::Options { level: group.level, ..*choices };
        let blocks = Blocks::new(source.cage(), group, block);
        let mut converted = Converted {
            group: group.clone(),
            charts: Vec::with_capacity(group.faces.len()),
            broken: Vec::new(),
            notes: Vec::new(),
            deviation: 0.0,
        };
        for block in 0..blocks.len() {
            let patches = pccm::Converted::new(blocks.part(block), source.cage_points(), &choices);
            converted.deviation = converted.deviation.max(deviation_of(&patches));
            converted.charts.extend(match options.packing {
                Packing::Packed => patches.packed(seams),
                Packing::Unpacked => patches.unpacked(),
            });
            converted.broken.extend(patches.broken());
            converted.notes.extend(patches.notes());
        }
        if blocks.len() > 1 {
            converted.in_order();
        }
        Ok(converted)
    }

    /// As if there had been one block only: in the order of faces and vertices, and what two blocks have to say once.
    fn in_order(&mut self) {
        self.charts.sort_unstable_by_key(|(chart, _)| chart.quads[(0, 0)].quad);
        self.broken.sort_unstable();
        self.broken.dedup();
        let vertex = |note: &Note| match note.place {
            Some(Place::Vertex(vertex)) => Some(vertex),
            _ => None,
        };
        self.notes.sort_by_key(vertex);
        let mut once: Vec<Note> = Vec::with_capacity(self.notes.len());
        for note in self.notes.drain(..) {
            let mut of_vertex = once.iter().rev().take_while(|other| other.place == note.place);
            if of_vertex.all(|other| *other != note) {
                once.push(note);
            }
        }
        self.notes = once;
    }
}

/// The largest distance of the limit surface from the visible patches.
fn deviation_of(converted: &pccm::Converted<'_>) -> f64 {
    let (base, level) = (converted.part.base(), converted.patches.level);
    let cells = deviation::changed_cells(base, level, &converted.patches.classes);
    let surfaces = if cells.is_empty() { Vec::new() } else { converted.surfaces() };
    let measured = Measured { base, points: &converted.points, level, surfaces: &surfaces };
    deviation::largest_deviation(&measured, &cells, 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Boundary, ControlMesh, Corner, Crease, Creasing, FaceList, Sharpness, shapes};

    fn creased(mut mesh: ControlMesh, edges: &[[u32; 2]], sharpness: Sharpness) -> ControlMesh {
        mesh.creases.extend(edges.iter().map(|&vertices| Crease { vertices, sharpness }));
        mesh
    }

    /// Edges along faces that follow one another in the list.
    fn edges(mesh: &ControlMesh, step: usize) -> Vec<[u32; 2]> {
        mesh.faces.iter().step_by(step).map(|face| [face[0], face[1]]).collect()
    }

    /// Two quads side by side become a triangle and a pentagon, here and there.
    fn with_polygons(mesh: ControlMesh, around: usize) -> ControlMesh {
        let mut faces = FaceList::new();
        for f in 0..mesh.faces.len() {
            let of = |f: usize| mesh.faces.face(f);
            match f {
                _ if f % 97 == 40 => {
                    let (a, b) = (of(f), of(f + around));
                    faces.push(&[a[0], a[1], b[2], a[2], a[3]]);
                }
                _ if f >= around && (f - around) % 97 == 40 => faces.push(&of(f)[..3]),
                _ => faces.push(of(f)),
            }
        }
        ControlMesh { faces, ..mesh }
    }

    fn cages() -> Vec<(&'static str, ControlMesh)> {
        let torus = || shapes::studded_torus(24, 20, 5);
        let along = edges(&torus(), 7);
        let mut holes = shapes::grid(14, 14);
        holes.holes = vec![30, 31, 77];
        holes.corners.push(Corner { vertex: 100, sharpness: Sharpness::Infinite });
        holes.corners.push(Corner { vertex: 120, sharpness: Sharpness::Finite(1.5) });
        let mut chaikin = creased(torus(), &along, Sharpness::Finite(1.3));
        chaikin.scheme.creasing = Creasing::Chaikin;
        let mut open = shapes::disk(5, 6);
        open.scheme.boundary = Boundary::EdgeOnly;
        vec![
            ("studs", torus()),
            ("studs that touch", shapes::studded_torus(12, 12, 2)),
            ("body", shapes::body()),
            ("sharp", creased(torus(), &along, Sharpness::Infinite)),
            ("semi-sharp", creased(torus(), &along, Sharpness::Finite(2.4))),
            ("chaikin", chaikin),
            ("holes", holes),
            ("disk", open),
            ("polygons", with_polygons(shapes::torus(24, 20), 20)),
        ]
    }

    #[test]
    fn blocks_change_nothing() {
        for (name, mesh) in cages() {
            for layer in [Layer::First, Layer::Second] {
                let options = Options { packing: Packing::Unpacked, ..Options::default() };
                let source = Source::new(&mesh, &options).unwrap_or_else(|error| panic!("{name}: {error}"));
                let choices = pccm::Options { layer, ..pccm::Options::default() };
                let plan =
                    pccm::plan(source.cage(), layer, None).unwrap_or_else(|error| panic!("{name}: {error}"));
                for group in &plan.groups {
                    let convert = |block| {
                        let seams = source.seams(&source.adaptive, 0);
                        let mut made = Converted::new(&source, group, &choices, &options, &seams, block)
                            .unwrap_or_else(|error| panic!("{name}: {error}"));
                        made.in_order();
                        made
                    };
                    let whole = convert(usize::MAX);
                    for block in [17, 150] {
                        let made = convert(block);
                        assert_eq!(made.charts, whole.charts, "{name} in blocks of {block}");
                        assert_eq!(made.broken, whole.broken, "{name} in blocks of {block}");
                        assert_eq!(made.notes, whole.notes, "{name} in blocks of {block}");
                        assert_eq!(made.deviation.to_bits(), whole.deviation.to_bits(), "{name}, {block}");
                    }
                }
            }
        }
    }
}
