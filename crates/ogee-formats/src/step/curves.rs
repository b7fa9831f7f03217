//! Curves without surfaces: a wireframe.

use std::io::{self, Write};

use super::context;
use super::emitter::Emitter;
use super::options::Options;
use super::syntax::{List, Text};
use super::write::{curve, placement};
use crate::curves::NamedCurve;
use crate::finite::require_finite_curves;

/// Writes curves as a STEP file: a `GEOMETRIC_CURVE_SET` of B-spline curves, each with its name.
///
/// # Errors
/// `InvalidData`, before anything is written, if a curve holds a number that is not finite; otherwise those of `out`.
pub fn write_curves(curves: &[NamedCurve], options: &Options, out: &mut impl Write) -> io::Result<()> {
    require_finite_curves(curves)?;
    let mut file = Emitter::new(out, curves.iter().map(|one| one.curve.points.len()).sum());
    context::header(&mut file, options)?;
    let definition = context::product(&mut file, options)?;
    let units = context::units(&mut file, options.unit)?;
    let mut points = Vec::new();
    let mut written = Vec::with_capacity(curves.len());
    for one in curves {
        written.push(curve(&mut file, &one.name, &one.curve, &mut points)?);
    }
    let set = file.entity(format_args!("GEOMETRIC_CURVE_SET({},{})", Text(&options.name), List(&written)))?;
    let items = [placement(&mut file)?, set];
    let wireframe = file.entity(format_args!(
        "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',{},{units})",
        List(&items)
    ))?;
    file.entity(format_args!("SHAPE_DEFINITION_REPRESENTATION({definition},{wireframe})"))?;
    context::footer(&mut file)?;
    file.finish()
}
