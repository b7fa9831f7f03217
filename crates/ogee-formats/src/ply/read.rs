//! Reading PLY: the vertices and faces out of the records.

use ogee::Vec3;

use super::body::{Body, RecordFault};
use super::header::{self, Element, Kind};
use crate::builder::CageBuilder;
use crate::cage::CageFile;
use crate::error::{Fault, ReadError};
use crate::text::Lines;

/// Reads a cage.
///
/// # Errors
/// If the header makes no sense; else with every fault of the records.
pub fn read(bytes: &[u8]) -> Result<CageFile, ReadError> {
    let mut lines = Lines::new(bytes);
    let header = header::read(&mut lines).map_err(ReadError::single)?;
    let mut cage = CageBuilder::default();
    let mut body = Body::new(lines, header.encoding);
    for element in &header.elements {
        // What a header promises is believed as far as the file could hold it.
        let limit = bytes.len() / element.least_size(header.encoding).max(1);
        let outcome = match element.name {
            b"vertex" => {
                cage.points.reserve(element.count.min(limit));
                vertices(&mut cage, &mut body, element)
            }
            b"face" => faces(&mut cage, &mut body, element),
            _ => body.skip(element).map_err(|fault| broken_off(fault, element, 0, &body)),
        };
        if let Err(fault) = outcome {
            cage.faults.push(fault);
            break;
        }
    }
    cage.finish()
}

/// The fault after which nothing more can be read.
fn broken_off(fault: RecordFault, element: &Element<'_>, record: usize, body: &Body<'_>) -> Fault {
    let name = String::from_utf8_lossy(element.name);
    let fault = match fault {
        RecordFault::Truncated => {
            let message = format!("the file ends within its {} records `{name}`", element.count);
            Fault::new("truncated", message)
        }
        RecordFault::Malformed(code, reason) => Fault::new(code, format!("{name} {record} {reason}")),
        RecordFault::Lost(reason) => Fault::new("bad_number", format!("{name} {record} {reason}")),
    };
    fault.on_line(body.line())
}

fn vertices(cage: &mut CageBuilder, body: &mut Body<'_>, element: &Element<'_>) -> Result<(), Fault> {
    // For each property the coordinate it is.
    let axes: Vec<Option<usize>> = element
        .properties
        .iter()
        .map(|property| match (property.name, property.kind) {
            (b"x", Kind::Scalar(_)) => Some(0),
            (b"y", Kind::Scalar(_)) => Some(1),
            (b"z", Kind::Scalar(_)) => Some(2),
            _ => None,
        })
        .collect();
    if (0..3).any(|axis| !axes.contains(&Some(axis))) {
        return Err(Fault::new("bad_header", "the vertices have no properties x, y and z"));
    }
    for record in 0..element.count {
        let mut point = [0.0; 3];
        let outcome = body.record(element, |property, value| {
            if let Some(axis) = axes[property] {
                point[axis] = value;
            }
        });
        match outcome {
            Ok(()) => cage.vertex(body.line(), Vec3::from(point)),
            Err(RecordFault::Malformed(code, reason)) => {
                let vertex = cage.points.len();
                cage.broken_vertex(
                    Fault::new(code, format!("vertex {vertex} {reason}")).on_line(body.line()),
                );
            }
            Err(fault) => return Err(broken_off(fault, element, record, body)),
        }
    }
    Ok(())
}

fn faces(cage: &mut CageBuilder, body: &mut Body<'_>, element: &Element<'_>) -> Result<(), Fault> {
    let indices = element.properties.iter().position(|property| {
        matches!(property.name, b"vertex_indices" | b"vertex_index")
            && matches!(property.kind, Kind::List { .. })
    });
    let Some(indices) = indices else {
        return Err(Fault::new("bad_header", "the faces have no list vertex_indices"));
    };
    let mut corners: Vec<i64> = Vec::new();
    for record in 0..element.count {
        corners.clear();
        let mut fractional = None;
        let outcome = body.record(element, |property, value| {
            if property == indices {
                if value.fract() != 0.0 {
                    fractional = Some(value);
                }
                corners.push(value as i64);
            }
        });
        let face = cage.faces.len();
        match (outcome, fractional) {
            (Ok(()), None) => {
                cage.face(body.line(), &corners);
            }
            (Ok(()), Some(value)) => {
                let message = format!("face {face} has a corner {value}, no vertex number");
                cage.broken_face(body.line(), Fault::new("bad_number", message));
            }
            (Err(RecordFault::Malformed(code, reason)), _) => {
                cage.broken_face(body.line(), Fault::new(code, format!("face {face} {reason}")));
            }
            (Err(fault), _) => return Err(broken_off(fault, element, record, body)),
        }
    }
    Ok(())
}
