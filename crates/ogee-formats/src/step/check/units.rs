//! Units and uncertainty of the contexts in which shapes stand.

use super::document::{Document, Instance, Record, Value};
use super::{Fault, Faults};

/// What the file says about lengths.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Units {
    pub(super) in_millimetres: Option<f64>,
    pub(super) uncertainty: Option<f64>,
}

/// Checks every three-dimensional context; the first one with a unit of length counts.
pub(super) fn check(document: &Document<'_>, faults: &mut Faults) -> Units {
    let mut units = Units::default();
    let mut contexts = 0;
    for context in &document.instances {
        let Some(geometric) = context.record("GEOMETRIC_REPRESENTATION_CONTEXT") else { continue };
        // Parameter curves live in contexts of two dimensions, without units.
        if geometric.arguments.contains(&Value::Integer(2)) {
            continue;
        }
        contexts += 1;
        match length_unit(document, context) {
            Some(unit) => {
                units.in_millimetres = units.in_millimetres.or(Some(unit));
            }
            None => {
                faults.push(context.fault("missing_unit", "the context has no unit of length".to_owned()))
            }
        }
        match uncertainty(document, context) {
            Some(length) if length > 0.0 => {
                units.uncertainty = units.uncertainty.or(Some(length));
            }
            Some(length) => {
                let message = format!("an uncertainty of {length} is not positive");
                faults.push(context.fault("bad_uncertainty", message));
            }
            None => {
                faults
                    .push(context.fault("missing_uncertainty", "the context has no uncertainty".to_owned()));
            }
        }
    }
    if contexts == 0 {
        let message = "there is no GEOMETRIC_REPRESENTATION_CONTEXT with units".to_owned();
        faults.push(Fault { code: "missing_unit", message, line: None, id: None });
    }
    units
}

/// The items of the list that is the last argument of a record.
fn listed<'v, 'a>(context: &'v Instance<'a>, name: &str) -> &'v [Value<'a>] {
    match context.record(name).and_then(|record| record.arguments.last()) {
        Some(Value::List(items)) => items,
        _ => &[],
    }
}

fn length_unit(document: &Document<'_>, context: &Instance<'_>) -> Option<f64> {
    listed(context, "GLOBAL_UNIT_ASSIGNED_CONTEXT").iter().find_map(|unit| {
        document.follow(unit, "LENGTH_UNIT")?;
        match document.follow(unit, "CONVERSION_BASED_UNIT") {
            None => metric(document.follow(unit, "SI_UNIT")?),
            Some(conversion) => {
                // One step only: a unit converted from itself ends nowhere.
                let measure = document.follow(conversion.arguments.last()?, "LENGTH_MEASURE_WITH_UNIT")?;
                let base = metric(document.follow(measure.get(1), "SI_UNIT")?)?;
                Some(length(measure.get(0))? * base)
            }
        }
    })
}

/// Millimetres in a metric unit.
fn metric(unit: &Record<'_>) -> Option<f64> {
    if *unit.arguments.last()? != Value::Enumeration("METRE") {
        return None;
    }
    Some(match unit.get(unit.arguments.len().checked_sub(2)?) {
        Value::Unset => 1e3,
        Value::Enumeration("KILO") => 1e6,
        Value::Enumeration("DECI") => 1e2,
        Value::Enumeration("CENTI") => 1e1,
        Value::Enumeration("MILLI") => 1.0,
        Value::Enumeration("MICRO") => 1e-3,
        Value::Enumeration("NANO") => 1e-6,
        _ => return None,
    })
}

fn uncertainty(document: &Document<'_>, context: &Instance<'_>) -> Option<f64> {
    listed(context, "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT").iter().find_map(|item| {
        let measure = document.follow(item, "UNCERTAINTY_MEASURE_WITH_UNIT")?;
        length(measure.get(0))
    })
}

/// The number in `LENGTH_MEASURE(1.)`.
fn length(value: &Value<'_>) -> Option<f64> {
    match value {
        Value::Typed(typed) => length(typed.get(0)),
        Value::Real(number) => Some(*number),
        // Reported where arguments are looked at.
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}
