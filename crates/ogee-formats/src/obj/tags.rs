//! The `t` lines of OBJ: creases, corners, holes and the rules of the scheme.

use ogee::{Boundary, Creasing, FaceVaryingRule};

use crate::builder::{CageBuilder, Tag};
use crate::error::Fault;
use crate::text::{Tokens, integer, real, shown};

/// What follows the name of a tag.
struct Arguments<'a> {
    integers: Vec<i64>,
    reals: Vec<f64>,
    names: Vec<&'a [u8]>,
}

/// Reads the rest of a `t` line.
pub(super) fn read(cage: &mut CageBuilder, rule: &mut FaceVaryingRule, line: u32, mut tokens: Tokens<'_>) {
    let Some(name) = tokens.next() else {
        cage.faults.push(Fault::new("bad_tag", "a tag without a name").on_line(line));
        return;
    };
    let outcome = match name {
        b"vertexedit" | b"edgeedit" | b"faceedit" => {
            let message = format!("hierarchical edits are not followed: {}", shown(name));
            cage.warn(line, "hierarchical_edit", message);
            Ok(())
        }
        b"crease"
        | b"corner"
        | b"hole"
        | b"interpolateboundary"
        | b"facevaryinginterpolateboundary"
        | b"creasemethod"
        | b"smoothtriangles" => {
            arguments(tokens).and_then(|arguments| apply(cage, rule, line, name, &arguments))
        }
        _ => {
            cage.warn(line, "unknown_tag", format!("unknown tag {}, passed over", shown(name)));
            Ok(())
        }
    };
    if let Err(reason) = outcome {
        let message = format!("tag {}: {reason}", shown(name));
        cage.faults.push(Fault::new("bad_tag", message).on_line(line));
    }
}

/// Reads the three counts and as many values.
fn arguments(mut tokens: Tokens<'_>) -> Result<Arguments<'_>, String> {
    let counts = tokens.next().ok_or("the counts ints/reals/names are missing")?;
    let parsed: Option<Vec<usize>> = counts
        .split(|&b| b == b'/')
        .map(|count| integer(count).and_then(|count| usize::try_from(count).ok()))
        .collect();
    let Some([integers, reals, names]) =
        parsed.as_deref().and_then(|counts| <[usize; 3]>::try_from(counts).ok())
    else {
        return Err(format!("`{}` are not three counts ints/reals/names", shown(counts)));
    };
    let values: Vec<&[u8]> = tokens.collect();
    if integers.saturating_add(reals).saturating_add(names) != values.len() {
        return Err(format!("{} promises another number of values than {}", shown(counts), values.len()));
    }
    let (integer_values, rest) = values.split_at(integers);
    let (real_values, names) = rest.split_at(reals);
    Ok(Arguments {
        integers: parse_all(integer_values, integer, "whole number")?,
        reals: parse_all(real_values, real, "number")?,
        names: names.to_vec(),
    })
}

fn parse_all<T>(tokens: &[&[u8]], parse: fn(&[u8]) -> Option<T>, what: &str) -> Result<Vec<T>, String> {
    tokens
        .iter()
        .map(|token| parse(token).ok_or_else(|| format!("`{}` is no {what}", shown(token))))
        .collect()
}

fn apply(
    cage: &mut CageBuilder,
    rule: &mut FaceVaryingRule,
    line: u32,
    name: &[u8],
    arguments: &Arguments<'_>,
) -> Result<(), String> {
    let Arguments { integers, reals, names } = arguments;
    match name {
        b"crease" => {
            if integers.is_empty() || integers.len() % 2 != 0 || !names.is_empty() {
                return Err("edges are pairs of vertices, and there are no names".into());
            }
            for (i, ends) in integers.chunks_exact(2).enumerate() {
                let sharpness = one_or_each(reals, i, integers.len() / 2)?;
                cage.tag(Some(line), Tag::Crease { ends: [ends[0], ends[1]], sharpness });
            }
        }
        b"corner" => {
            if integers.is_empty() || !names.is_empty() {
                return Err("at least one vertex is needed, and there are no names".into());
            }
            for (i, &vertex) in integers.iter().enumerate() {
                let sharpness = one_or_each(reals, i, integers.len())?;
                cage.tag(Some(line), Tag::Corner { vertex, sharpness });
            }
        }
        b"hole" => {
            if integers.is_empty() || !reals.is_empty() || !names.is_empty() {
                return Err("at least one face is needed, and nothing else".into());
            }
            for &face in integers {
                cage.tag(Some(line), Tag::Hole { face });
            }
        }
        b"interpolateboundary" => {
            cage.scheme.boundary = match only_integer(arguments)? {
                0 => Boundary::None,
                1 => Boundary::EdgeAndCorner,
                2 => Boundary::EdgeOnly,
                other => return Err(format!("{other} is not 0, 1 or 2")),
            };
        }
        b"facevaryinginterpolateboundary" => {
            *rule = match only_integer(arguments)? {
                0 => FaceVaryingRule::None,
                1 => FaceVaryingRule::CornersOnly,
                2 => FaceVaryingRule::CornersPlus1,
                3 => FaceVaryingRule::CornersPlus2,
                4 => FaceVaryingRule::Boundaries,
                5 => FaceVaryingRule::All,
                other => return Err(format!("{other} is not one of 0 to 5")),
            };
        }
        b"creasemethod" => {
            cage.scheme.creasing = match only_name(arguments)? {
                b"normal" => Creasing::Uniform,
                b"chaikin" => Creasing::Chaikin,
                other => return Err(format!("`{}` is neither normal nor chaikin", shown(other))),
            };
        }
        _ => match only_name(arguments)? {
            b"catmark" => {}
            b"smooth" => {
                let message = "the smooth rule for triangles is not followed".to_string();
                cage.warn(line, "smooth_triangles", message);
            }
            other => return Err(format!("`{}` is neither catmark nor smooth", shown(other))),
        },
    }
    Ok(())
}

/// The sharpness of element `i` of `count`: one number serves all, or there is one for each.
fn one_or_each(reals: &[f64], i: usize, count: usize) -> Result<f64, String> {
    match reals {
        [one] => Ok(*one),
        each if each.len() == count => Ok(each[i]),
        _ => Err(format!("{} numbers for the sharpness of {count}; one, or one for each", reals.len())),
    }
}

fn only_integer(arguments: &Arguments<'_>) -> Result<i64, String> {
    match (&arguments.integers[..], &arguments.reals[..], &arguments.names[..]) {
        ([value], [], []) => Ok(*value),
        _ => Err("one whole number is needed, and nothing else".into()),
    }
}

fn only_name<'a>(arguments: &Arguments<'a>) -> Result<&'a [u8], String> {
    match (&arguments.integers[..], &arguments.reals[..], &arguments.names[..]) {
        ([], [], [name]) => Ok(name),
        _ => Err("one name is needed, and nothing else".into()),
    }
}
