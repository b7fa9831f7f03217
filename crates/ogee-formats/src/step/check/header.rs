//! The header: three records of fixed form.

use super::document::{Document, Record, Value};
use super::{Fault, Faults};

/// Schemas of shapes that CAD programs read.
const SCHEMAS: [&str; 8] = [
    "AUTOMOTIVE_DESIGN",
    "AUTOMOTIVE_DESIGN_CC1",
    "AUTOMOTIVE_DESIGN_CC2",
    "CONFIG_CONTROL_DESIGN",
    "AP203_CONFIGURATION_CONTROLLED_3D_DESIGN_OF_MECHANICAL_PARTS_AND_ASSEMBLIES_MIM_LF",
    "AP214E3_2010",
    "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF",
    "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM",
];

/// Checks the header; returns the name of the first schema.
pub(super) fn check(document: &Document<'_>, faults: &mut Faults) -> Option<String> {
    let mut schema = None;
    for name in ["FILE_DESCRIPTION", "FILE_NAME", "FILE_SCHEMA"] {
        let Some((line, record)) = document.header.iter().find(|(_, record)| record.name == name) else {
            let message = format!("the header has no {name}");
            faults.push(Fault { code: "missing_header_record", message, line: None, id: None });
            continue;
        };
        let mut fault = |code, message| faults.push(Fault { code, message, line: Some(*line), id: None });
        match name {
            "FILE_DESCRIPTION" => description(record, &mut fault),
            "FILE_NAME" => file_name(record, &mut fault),
            _ => schema = file_schema(record, &mut fault),
        }
    }
    schema
}

fn is_text(value: &Value<'_>) -> bool {
    matches!(value, Value::Text(_))
}

fn is_flat_list(value: &Value<'_>) -> bool {
    matches!(value, Value::List(items) if !items.is_empty() && items.iter().all(is_text))
}

fn description(record: &Record<'_>, fault: &mut impl FnMut(&'static str, String)) {
    let [description, level] = record.arguments.as_slice() else {
        fault("file_description", "FILE_DESCRIPTION has two arguments".to_owned());
        return;
    };
    if !is_flat_list(description) {
        fault("file_description", "the first argument of FILE_DESCRIPTION is a list of strings".to_owned());
    }
    let known = match level {
        Value::Text(level) => {
            let mut parts = level.split(|&letter| letter == b';');
            let edition = parts.next().is_some_and(|edition| matches!(edition, b"1" | b"2" | b"3" | b"4"));
            edition && parts.next().is_some_and(|class| matches!(class, b"1" | b"2" | b"3"))
        }
        _ => false,
    };
    if !known {
        fault("file_description", "the implementation level is a string such as '2;1'".to_owned());
    }
}

fn file_name(record: &Record<'_>, fault: &mut impl FnMut(&'static str, String)) {
    let arguments = &record.arguments;
    if arguments.len() != 7 {
        fault("file_name_arity", format!("FILE_NAME has seven arguments, here {}", arguments.len()));
        return;
    }
    for (i, argument) in arguments.iter().enumerate() {
        let list = matches!(i, 2 | 3);
        // Old files leave the authorisation unset.
        if list && !is_flat_list(argument) {
            let message = format!("argument {} of FILE_NAME is a flat list of strings", i + 1);
            fault("file_name_argument", message);
        } else if !list && !is_text(argument) && *argument != Value::Unset {
            fault("file_name_argument", format!("argument {} of FILE_NAME is a string", i + 1));
        }
    }
    if let Value::Text(time) = &arguments[1] {
        let dated = time.len() >= 10 && time[4] == b'-' && time[7] == b'-';
        if !time.is_empty() && !dated {
            fault("file_name_argument", "the time in FILE_NAME is no ISO 8601 time".to_owned());
        }
    }
}

fn file_schema(record: &Record<'_>, fault: &mut impl FnMut(&'static str, String)) -> Option<String> {
    let names = match record.arguments.as_slice() {
        [list @ Value::List(names)] if is_flat_list(list) => names,
        _ => {
            fault("file_schema", "the argument of FILE_SCHEMA is a list of strings".to_owned());
            return None;
        }
    };
    let mut first = None;
    for name in names {
        let Value::Text(name) = name else { continue };
        let name = String::from_utf8_lossy(name);
        let (name, numbers) = match name.split_once('{') {
            Some((name, numbers)) => (name.trim(), numbers.trim()),
            None => (name.trim(), ""),
        };
        if !SCHEMAS.contains(&name.to_uppercase().as_str()) {
            fault("unknown_schema", format!("the schema `{name}` is none of STEP's for shapes"));
        } else if !numbers.is_empty() {
            let inner = numbers.strip_suffix('}').unwrap_or("");
            let good = inner.split_whitespace().all(|number| number.parse::<u32>().is_ok());
            if !good || !inner.trim_start().starts_with("1 0 10303 ") {
                fault("unknown_schema", format!("the schema `{name}` carries a wrong object identifier"));
            }
        }
        first.get_or_insert_with(|| name.to_owned());
    }
    first
}
