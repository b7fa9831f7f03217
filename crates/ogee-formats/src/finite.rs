//! The gate of every writer of parts: no file ever holds a number that is none.

use std::io;

use ogee::Vec3;
use ogee::convert::Part;

use crate::curves::NamedCurve;

/// `InvalidData` if a coordinate or a knot of the part is infinite or NaN. Writers ask before their first
/// byte, so a refused part leaves nothing behind.
pub(crate) fn require_finite(part: &Part) -> io::Result<()> {
    let all_finite = |points: &[Vec3]| points.iter().all(|point| point.is_finite());
    for shell in part.bodies.iter().flat_map(|body| body.shells()) {
        for face in &shell.faces {
            let knots = face.surface.u.knots().iter().chain(face.surface.v.knots());
            if !all_finite(face.surface.net.cells()) || knots.copied().any(|knot| !knot.is_finite()) {
                return Err(refused(&format!("face {}", face.address())));
            }
        }
        for (i, edge) in shell.edges.iter().enumerate() {
            let knots = edge.curve.knots.knots();
            if !all_finite(&edge.curve.points) || knots.iter().any(|knot| !knot.is_finite()) {
                return Err(refused(&format!("edge {i}")));
            }
        }
        if !all_finite(&shell.vertices) {
            return Err(refused("a vertex"));
        }
    }
    Ok(())
}

/// The same for curves.
pub(crate) fn require_finite_curves(curves: &[NamedCurve]) -> io::Result<()> {
    for NamedCurve { name, curve } in curves {
        let knots = curve.knots.knots().iter().all(|knot| knot.is_finite());
        if !knots || !curve.points.iter().all(|point| point.is_finite()) {
            return Err(refused(&format!("curve {name}")));
        }
    }
    Ok(())
}

fn refused(place: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("{place} has a number that is not finite"))
}
