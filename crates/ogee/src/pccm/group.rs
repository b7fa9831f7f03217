//! The patches of one group of a plan, and the surfaces that are read from them.

use super::packing::{Chart, Placed, pack, unpacked};
use super::part::Part;
use super::{Group, Layer, Options, Patches, PccmError, Pieces, smooth};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{FaceId, HalfedgeId, Note};
use crate::nurbs::NurbsSurface;
use crate::rules::Level;
use std::borrow::Cow;

/// Converts the faces of one group of [`super::plan`], at the cost of these and of what touches them.
///
/// `points` are the vertices of the cage, `options.level` is not looked at. Nets and classes are those of the group's faces, in
/// order, and [`super::Cap::quad`] is a place among them. Broken halfedges and notes are told of the cage, or of its first
/// refinement, whichever the faces are of. All is as from [`super::to_patches`] on the whole of that level, bit for bit but on sides that
/// other groups share.
///
/// # Errors
/// If a face of a group of no steps is no quad.
///
/// # Panics
/// If there are fewer points than vertices, or a face is out of range.
pub fn to_group_patches(
    cage: &Level,
    points: &[Vec3],
    group: &Group,
    options: &Options,
) -> Result<Patches, PccmError> {
    let topology = cage.topology();
    let mut faces = group.faces.iter().copied().filter(|_| group.steps == 0);
    if let Some(face) = faces.find(|&f| topology.face_size(f) != 4) {
        return Err(PccmError::NotQuads { face });
    }
    let options = Options { level: group.level, ..*options };
    let part = Part::new(cage, group.steps, &group.faces);
    let Converted { part, patches, .. } = Converted::new(part, points, &options);
    let mut place = vec![0; part.quad_count()];
    (0..).zip(part.converted()).for_each(|(number, quad)| place[quad.index()] = number);
    let Patches { nets, classes, mut caps, broken, notes, level, knots } = patches;
    caps.iter_mut().for_each(|cap| cap.quad = place[cap.quad as usize]);
    let converted = |quad: &usize| part.is_converted(*quad);
    Ok(Patches {
        level,
        knots,
        nets: nets.into_iter().enumerate().filter(|(quad, _)| converted(quad)).map(|(_, net)| net).collect(),
        classes: part.converted().map(|quad| classes[quad.index()]).collect(),
        caps,
        broken: broken.into_iter().map(|h| part.halfedge(h)).collect(),
        notes: notes.into_iter().map(|note| part.note(note)).collect(),
    })
}

/// A group in patches. Its own numbers are those of a part of the cage.
pub(crate) struct Converted<'a> {
    pub(crate) part: Part<'a>,
    pub(crate) points: Cow<'a, [Vec3]>,
    pub(crate) patches: Patches,
    layer: Layer,
}

impl<'a> Converted<'a> {
    /// `points` are the vertices of the cage.
    pub(crate) fn new(part: Part<'a>, points: &'a [Vec3], options: &Options) -> Converted<'a> {
        let points = part.points(points);
        let patches = smooth(&part, &points, options);
        Converted { part, points, patches, layer: options.layer }
    }

    /// One surface per quad of the part, in cells; empty for those that are not converted.
    pub(crate) fn surfaces(&self) -> Vec<NurbsSurface> {
        let knots = &self.patches.knots;
        let surface = |net| NurbsSurface { u: knots.clone(), v: knots.clone(), net };
        let mut surfaces: Vec<NurbsSurface> = self.patches.nets.iter().cloned().map(surface).collect();
        if !self.patches.caps.is_empty() {
            let pieces = self.pieces();
            for cap in &self.patches.caps {
                surfaces[cap.quad as usize] = pieces.in_cells(cap.quad);
            }
        }
        surfaces
    }

    fn pieces(&self) -> Pieces<'_> {
        Pieces::new(self.part.base(), &self.points, &self.patches, self.layer)
    }

    /// The surfaces of the faces of halfedges of that level, as far as they are in the group: `(0, 0)` is at the halfedge's origin,
    /// and `u` runs along it.
    pub(crate) fn seen_from(&self, halfedges: &[HalfedgeId]) -> Vec<NurbsSurface> {
        let pieces = self.pieces();
        let own = halfedges.iter().filter_map(|&h| self.part.along(h).first().copied());
        let placed = own.map(|own| Placed { quad: own.0 / 4, turn: own.0 % 4 });
        placed.map(|placed| pieces.surface(&Chart { quads: Grid::from_fn(1, 1, |_, _| placed) })).collect()
    }

    /// One chart per visible face, with its surface, told of the level that the group's faces are of.
    pub(crate) fn unpacked(&self) -> Vec<(Chart, NurbsSurface)> {
        self.with_surfaces(unpacked(self.part.base()))
    }

    /// Few charts; no chart crosses any of the given halfedges of the cage.
    pub(crate) fn packed(&self, seams: &[HalfedgeId]) -> Vec<(Chart, NurbsSurface)> {
        let own: Vec<HalfedgeId> = seams.iter().flat_map(|&h| self.part.along(h)).collect();
        self.with_surfaces(pack(self.part.base(), &self.patches.classes, &own))
    }

    fn with_surfaces(&self, charts: Vec<Chart>) -> Vec<(Chart, NurbsSurface)> {
        let pieces = self.pieces();
        let surfaces = par::map(charts.len(), |chart| pieces.surface(&charts[chart]));
        let told = |placed: &Placed| Placed { quad: self.part.face(FaceId(placed.quad)).0, ..*placed };
        charts.into_iter().map(|chart| Chart { quads: chart.quads.map(told) }).zip(surfaces).collect()
    }

    /// Halfedges whose edge is not smooth next to their origin, told of that level.
    pub(crate) fn broken(&self) -> Vec<HalfedgeId> {
        self.patches.broken.iter().map(|&h| self.part.halfedge(h)).collect()
    }

    /// Notes, told of that level.
    pub(crate) fn notes(&self) -> Vec<Note> {
        self.patches.notes.iter().map(|note| self.part.note(note.clone())).collect()
    }
}
