//! The field on the surface, at one place or many.

use crate::limit::{Derivatives, Flags, Samples};
use crate::math::{SurfaceJet, Vec3};
use crate::patch::Location;
use crate::quality::{Field, FieldJet, NormalJet, Surface};

/// Evaluates a field on a surface; keeps its memory.
pub(super) struct Probe<'a> {
    surface: &'a dyn Surface,
    field: &'a Field,
    samples: Samples,
}

/// The field at a place of the lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// Its value, where it has one.
    pub(super) value: Option<f64>,
    /// Lines may be wanted here or not far away.
    pub(super) is_near: bool,
}

/// The field at one place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) at: Location,
    pub(super) position: Vec3,
    /// Unit normal, zero where undefined.
    pub(super) normal: Vec3,
    /// The field, where it has a value.
    pub(super) value: Option<f64>,
    /// Tangents and the field's derivatives along them, where there are any.
    pub(super) slope: Option<Slope>,
}

/// Derivatives along the parameters of a location.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    pub(super) tangents: [Vec3; 2],
    pub(super) field: [f64; 2],
}

impl Slope {
    /// The unit direction of the line: what is below its value lies on its left.
    pub(super) fn direction(&self) -> Option<Vec3> {
        let Slope { tangents: [du, dv], field: [a, b] } = *self;
        (a * dv - b * du).normalized()
    }
}

impl<'a> Probe<'a> {
    pub(super) fn new(surface: &'a dyn Surface, field: &'a Field) -> Probe<'a> {
        Probe { surface, field, samples: Samples::default() }
    }

    /// The values at some places, and whether lines are wanted near a point with a normal.
    pub(super) fn values(
        &mut self,
        at: &[Location],
        is_near: impl Fn(Vec3, Vec3) -> bool,
    ) -> impl Iterator<Item = Sample> {
        self.surface.evaluate(at, Derivatives::First, &mut self.samples);
        let (field, Samples { position, normal, flags, .. }) = (self.field, &self.samples);
        (0..at.len()).map(move |k| Sample {
            value: value(field, position[k], normal[k], flags[k]),
            is_near: is_near(position[k], normal[k]),
        })
    }

    /// Everything at one place.
    pub(super) fn spot(&mut self, at: Location) -> Spot {
        self.surface.evaluate(&[at], Derivatives::Second, &mut self.samples);
        spot(self.field, &self.samples, at, 0)
    }

    /// Everything at some places: quicker than one by one where those of a face stand together, and the same.
    pub(super) fn spots(&mut self, at: &[Location]) -> impl Iterator<Item = Spot> {
        self.surface.evaluate(at, Derivatives::Second, &mut self.samples);
        at.iter().enumerate().map(|(k, &at)| spot(self.field, &self.samples, at, k))
    }
}

/// What evaluation found at a place.
fn spot(field: &Field, samples: &Samples, at: Location, k: usize) -> Spot {
    let (position, normal, flags) = (samples.position[k], samples.normal[k], samples.flags[k]);
    let (du, dv) = (samples.du[k], samples.dv[k]);
    let jet = SurfaceJet { position, du, dv, duu: samples.duu[k], duv: samples.duv[k], dvv: samples.dvv[k] };
    // At an extraordinary vertex tangents are no derivatives.
    let has_turns = !flags.contains(Flags::AT_EXTRAORDINARY) && !flags.contains(Flags::NORMAL_UNDEFINED);
    let turns = has_turns.then(|| jet.normal_derivatives()).flatten();
    let jet = turns.and_then(|turns| field.jet(&NormalJet { position, tangents: [du, dv], normal, turns }));
    let slope = jet.filter(|jet| jet.du.is_finite() && jet.dv.is_finite());
    Spot {
        at,
        position,
        normal,
        value: slope.map_or_else(|| value(field, position, normal, flags), |slope| Some(slope.value)),
        slope: slope.map(|FieldJet { du: a, dv: b, .. }| Slope { tangents: [du, dv], field: [a, b] }),
    }
}

fn value(field: &Field, position: Vec3, normal: Vec3, flags: Flags) -> Option<f64> {
    let has_normal = !flags.contains(Flags::NORMAL_UNDEFINED);
    has_normal.then(|| field.value(position, normal)).flatten().filter(|value| value.is_finite())
}
