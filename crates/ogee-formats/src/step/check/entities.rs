//! What holds of every entity: references lead somewhere, arguments are as many as the schema says, and the
//! shape belongs to a product.

use std::collections::HashSet;

use super::document::{Document, Value};
use super::{Fault, Faults};

/// How many arguments the entities of a solid's file have.
fn arguments(name: &str) -> Option<usize> {
    Some(match name {
        "APPLICATION_CONTEXT" => 1,
        "SHAPE_DEFINITION_REPRESENTATION"
        | "CARTESIAN_POINT"
        | "DIRECTION"
        | "VERTEX_POINT"
        | "EDGE_LOOP" => 2,
        "CLOSED_SHELL" | "OPEN_SHELL" | "MANIFOLD_SOLID_BREP" | "SHELL_BASED_SURFACE_MODEL" => 2,
        "LENGTH_MEASURE_WITH_UNIT" | "PLANE" => 2,
        "PRODUCT_CONTEXT" | "PRODUCT_DEFINITION_CONTEXT" | "PRODUCT_DEFINITION_FORMATION" => 3,
        "PRODUCT_DEFINITION_SHAPE" | "BREP_WITH_VOIDS" | "FACE_OUTER_BOUND" | "FACE_BOUND" => 3,
        "ADVANCED_BREP_SHAPE_REPRESENTATION" | "MANIFOLD_SURFACE_SHAPE_REPRESENTATION" => 3,
        "SHAPE_REPRESENTATION" | "PRODUCT_RELATED_PRODUCT_CATEGORY" => 3,
        "APPLICATION_PROTOCOL_DEFINITION" | "PRODUCT" | "PRODUCT_DEFINITION" => 4,
        "UNCERTAINTY_MEASURE_WITH_UNIT" | "AXIS2_PLACEMENT_3D" | "ADVANCED_FACE" => 4,
        "ORIENTED_CLOSED_SHELL" | "SHAPE_REPRESENTATION_RELATIONSHIP" => 4,
        "ORIENTED_EDGE" | "EDGE_CURVE" => 5,
        "DIMENSIONAL_EXPONENTS" => 7,
        "B_SPLINE_CURVE_WITH_KNOTS" => 9,
        "B_SPLINE_SURFACE_WITH_KNOTS" => 13,
        _ => return None,
    })
}

/// Entities that are bodies.
pub(super) const SOLIDS: [&str; 2] = ["MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS"];

pub(super) fn check(document: &Document<'_>, faults: &mut Faults) {
    let mut used = HashSet::new();
    let mut missing = Vec::new();
    for instance in &document.instances {
        missing.clear();
        for record in &instance.records {
            for value in &record.arguments {
                references(value, &mut |id| {
                    used.insert(id);
                    if document.get(id).is_none() && !missing.contains(&id) {
                        missing.push(id);
                    }
                });
            }
        }
        for id in &missing {
            let message = format!("{} refers to #{id}, which is nowhere defined", instance.name());
            faults.push(instance.fault("dangling_reference", message));
        }
        if instance.records.iter().any(|record| record.arguments.iter().any(is_whole_length)) {
            faults.push(instance.fault("real_without_point", "a LENGTH_MEASURE has no point".to_owned()));
        }
        // The records of a complex entity leave out what they inherit.
        if let [record] = instance.records.as_slice() {
            match arguments(record.name) {
                Some(wanted) if wanted != record.arguments.len() => {
                    let found = record.arguments.len();
                    let message = format!("{} has {wanted} arguments, here {found}", record.name);
                    faults.push(instance.fault("wrong_argument_count", message));
                }
                _ => {}
            }
        }
    }
    let solids = |name| SOLIDS.contains(&name) || name == "SHELL_BASED_SURFACE_MODEL";
    for body in document.instances.iter().filter(|instance| solids(instance.name())) {
        if !used.contains(&body.id) {
            faults.push(body.fault("unused_body", format!("{} stands in no representation", body.name())));
        }
    }
    for wanted in ["PRODUCT", "SHAPE_DEFINITION_REPRESENTATION"] {
        if !document.instances.iter().any(|instance| instance.record(wanted).is_some()) {
            let message = format!("there is no {wanted}: readers find no part");
            faults.push(Fault { code: "missing_shape", message, line: None, id: None });
        }
    }
}

/// Calls `found` with every reference in a value. Values stand in one another no deeper than the parser lets
/// them.
fn references(value: &Value<'_>, found: &mut impl FnMut(u64)) {
    match value {
        Value::Reference(id) => found(*id),
        Value::List(items) => items.iter().for_each(|item| references(item, found)),
        Value::Typed(record) => record.arguments.iter().for_each(|item| references(item, found)),
        _ => {}
    }
}

/// True for `LENGTH_MEASURE(1)`.
fn is_whole_length(value: &Value<'_>) -> bool {
    match value {
        Value::Typed(typed) => typed.name == "LENGTH_MEASURE" && matches!(typed.get(0), Value::Integer(_)),
        _ => false,
    }
}
