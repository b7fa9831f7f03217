//! The curves in the file of a cage, as pictures show them.

use ogee::Vec3;
use ogee::curve_network::{NetworkCurve, TargetCurve};
use ogee_formats::CageFormat;
use ogee_formats::network::{self, NetworkFormat};
use ogee_render::Stroke;
use ogee_render::colour::{Colour, decode};

use crate::error::{Failure, Finding};
use crate::subject::Subject;

/// Curves in space, and the points where they meet.
#[derive(Default)]
pub(crate) struct Curves {
    polygons: Vec<Vec<Vec3>>,
    meetings: Vec<Vec3>,
    /// What the reader passed over.
    pub(crate) notes: Vec<Finding>,
}

/// Straight pieces of a span of a curve.
const PIECES: usize = 64;

/// Thin lines that a curve and the disc at a meeting point are wide, and their rims, which part them from any pattern.
const CURVE: f64 = 3.6;
const MEETING: f64 = 9.0;
const RIM: f64 = 2.0;

/// sRGB of curves and of rims: on no surface and in no scale of a map.
const COLOUR: [u8; 3] = [255, 122, 0];
const RIM_COLOUR: [u8; 3] = [28, 14, 0];

impl Curves {
    /// The curves in the bytes that a cage was read from.
    pub(crate) fn read(subject: &Subject, format: CageFormat, bytes: &[u8]) -> Result<Curves, Failure> {
        let Some(cage) = subject.cage() else {
            return Err(subject.failure("no_curves", "a part has no curves; draw the cage it came from"));
        };
        let format = match format {
            CageFormat::Json => NetworkFormat::Json,
            CageFormat::Obj => NetworkFormat::Obj,
            _ => return Err(subject.failure("no_curves", "this format of cages has no curves")),
        };
        let file =
            network::read(bytes, format).map_err(|error| Failure::of_reading(&error, &subject.name))?;
        let points = &cage.mesh().points;
        let polygons =
            file.network.curves.iter().map(|curve| polygon(subject, points, curve)).collect::<Result<_, _>>();
        let meetings = cage.mesh().meetings.iter().map(|meeting| points[meeting.vertex as usize]);
        let notes = file.warnings.iter().map(|warning| Finding::of_warning(warning, &subject.name));
        Ok(Curves { polygons: polygons?, meetings: meetings.collect(), notes: notes.collect() })
    }

    /// What is to be drawn over a picture whose thin lines are so wide: rims first, so that no curve cuts another.
    pub(crate) fn strokes(&self, thin: f64) -> Vec<Stroke> {
        let discs: Vec<Vec<Vec3>> = self.meetings.iter().map(|&point| vec![point]).collect();
        let layer = |rim: f64, [red, green, blue]: [u8; 3]| {
            let colour: Colour = [red, green, blue].map(|byte| decode(f32::from(byte) / 255.0));
            let of_width = move |points: &Vec<Vec3>, width: f64| Stroke {
                points: points.clone(),
                width: thin * (width + rim),
                colour,
            };
            let curves = self.polygons.iter().map(move |points| of_width(points, CURVE));
            curves.chain(discs.iter().map(move |point| of_width(point, MEETING)))
        };
        layer(RIM, RIM_COLOUR).chain(layer(0.0, COLOUR)).collect()
    }
}

/// Points along a curve.
fn polygon(subject: &Subject, points: &[Vec3], curve: &NetworkCurve) -> Result<Vec<Vec3>, Failure> {
    let wrong = |why: String| subject.failure("bad_curve", format!("curve {}: {why}", curve.name));
    if let Some(vertex) = curve.vertices.iter().find(|&&vertex| vertex as usize >= points.len()) {
        return Err(wrong(format!("the cage has no vertex {vertex}")));
    }
    let target = TargetCurve::new(curve.target(points), curve.closed);
    let target = target.map_err(|error| wrong(error.to_string()))?;
    let count = PIECES * target.spans();
    Ok((0..=count).map(|i| target.point(i as f64 / PIECES as f64)).collect())
}
