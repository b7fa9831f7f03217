//! Reads the points, curves and surfaces of a file.

use std::collections::HashMap;

use ogee::{Grid, Vec3};

use super::Faults;
use super::document::{Document, Instance, Value};
use super::spline::{Curve, HIGHEST_DEGREE, Knots, Surface};

/// The geometry of a file, by the numbers of its entities. Rational splines are left out.
#[derive(Default)]
pub(super) struct Splines {
    pub(super) points: HashMap<u64, Vec3>,
    pub(super) curves: HashMap<u64, Curve>,
    pub(super) surfaces: HashMap<u64, Surface>,
}

/// Why a spline was left out: a fault of this code, or none if it is only foreign.
type Refusal = Option<(&'static str, String)>;

pub(super) fn read(document: &Document<'_>, faults: &mut Faults) -> Splines {
    let mut splines = Splines::default();
    for instance in &document.instances {
        if let Some(record) = instance.record("CARTESIAN_POINT") {
            match numbers(record.get(1)) {
                Ok(coordinates) => {
                    if let [x, y, z] = coordinates[..] {
                        splines.points.insert(instance.id, Vec3::new(x, y, z));
                    }
                }
                Err((code, message)) => faults.push(instance.fault(code, message)),
            }
        }
    }
    for instance in &document.instances {
        let refusal = if instance.record("B_SPLINE_CURVE_WITH_KNOTS").is_some() {
            curve(instance, &splines.points).map(|curve| {
                splines.curves.insert(instance.id, curve);
            })
        } else if instance.record("B_SPLINE_SURFACE_WITH_KNOTS").is_some() {
            surface(instance, &splines.points).map(|surface| {
                splines.surfaces.insert(instance.id, surface);
            })
        } else {
            Ok(())
        };
        if let Err(Some((code, message))) = refusal {
            faults.push(instance.fault(code, message));
        }
    }
    splines
}

/// The arguments of a spline without its name: of a simple entity in one piece, of a complex one from the two
/// records that share them.
fn arguments<'v, 'a>(instance: &'v Instance<'a>, plain: &str, knotted: &str) -> Vec<&'v Value<'a>> {
    match (instance.record(plain), instance.record(knotted)) {
        (Some(plain), Some(knotted)) => plain.arguments.iter().chain(&knotted.arguments).collect(),
        (None, Some(knotted)) => knotted.arguments.iter().skip(1).collect(),
        _ => Vec::new(),
    }
}

fn curve(instance: &Instance<'_>, points: &HashMap<u64, Vec3>) -> Result<Curve, Refusal> {
    let arguments = arguments(instance, "B_SPLINE_CURVE", "B_SPLINE_CURVE_WITH_KNOTS");
    let [degree, poles, _, _, _, times, knots, _] = arguments[..] else { return Err(None) };
    let Value::List(poles) = poles else { return Err(bad("the poles of a curve are a list")) };
    let knots = knot_vector(degree, times, knots, poles.len())?;
    if instance.record("RATIONAL_B_SPLINE_CURVE").is_some() {
        return Err(None);
    }
    let points = poles.iter().map(|pole| point(pole, points)).collect::<Result<_, _>>()?;
    Ok(Curve { knots, points })
}

fn surface(instance: &Instance<'_>, points: &HashMap<u64, Vec3>) -> Result<Surface, Refusal> {
    let arguments = arguments(instance, "B_SPLINE_SURFACE", "B_SPLINE_SURFACE_WITH_KNOTS");
    let [degree_u, degree_v, poles, _, _, _, _, times_u, times_v, knots_u, knots_v, _] = arguments[..] else {
        return Err(None);
    };
    let Value::List(poles) = poles else { return Err(bad("the poles of a surface are a list of lists")) };
    let mut rows: Vec<&[Value<'_>]> = Vec::with_capacity(poles.len());
    for row in poles {
        match row {
            Value::List(row) => rows.push(row),
            _ => return Err(bad("the poles of a surface are a list of lists")),
        }
    }
    let columns = rows.first().map_or(0, |row| row.len());
    if rows.iter().any(|row| row.len() != columns) {
        return Err(bad("the rows of poles differ in length"));
    }
    let u = knot_vector(degree_u, times_u, knots_u, rows.len())?;
    let v = knot_vector(degree_v, times_v, knots_v, columns)?;
    if instance.record("RATIONAL_B_SPLINE_SURFACE").is_some() {
        return Err(None);
    }
    let cells = rows.iter().copied().flatten().map(|pole| point(pole, points));
    let cells: Vec<Vec3> = cells.collect::<Result<_, _>>()?;
    Ok(Surface { u, v, net: Grid::from_fn(rows.len(), columns, |i, j| cells[i * columns + j]) })
}

fn bad(message: &str) -> Refusal {
    Some(("bad_argument", message.to_owned()))
}

/// A pole. One that is missing has been reported; one of two dimensions belongs to a parameter curve.
fn point(pole: &Value<'_>, points: &HashMap<u64, Vec3>) -> Result<Vec3, Refusal> {
    match pole {
        Value::Reference(id) => points.get(id).copied().ok_or(None),
        _ => Err(bad("a pole is a reference to a point")),
    }
}

/// A list of reals.
fn numbers(value: &Value<'_>) -> Result<Vec<f64>, (&'static str, String)> {
    let Value::List(items) = value else {
        return Err(("bad_argument", "a list of reals expected".to_owned()));
    };
    items
        .iter()
        .map(|item| match item {
            Value::Real(number) => Ok(*number),
            Value::Integer(number) => {
                Err(("real_without_point", format!("the real `{number}` has no point")))
            }
            _ => Err(("bad_argument", "a list of reals expected".to_owned())),
        })
        .collect()
}

fn knot_vector(
    degree: &Value<'_>,
    times: &Value<'_>,
    knots: &Value<'_>,
    poles: usize,
) -> Result<Knots, Refusal> {
    let Value::Integer(degree @ 1..) = *degree else { return Err(bad("a degree is an integer above zero")) };
    let knots = numbers(knots).map_err(Some)?;
    let times = match times {
        Value::List(times) => times.iter().map(|time| match time {
            Value::Integer(time @ 1..) => usize::try_from(*time).ok(),
            _ => None,
        }),
        _ => return Err(bad("multiplicities are a list of integers")),
    };
    let times: Option<Vec<usize>> = times.collect();
    let times = times.ok_or_else(|| bad("a multiplicity is an integer above zero"))?;
    if times.len() != knots.len() {
        let message = format!("{} knots with {} multiplicities", knots.len(), times.len());
        return Err(Some(("knots_mismatch", message)));
    }
    let order = usize::try_from(degree).ok().and_then(|degree| degree.checked_add(1));
    let wanted = order.and_then(|order| order.checked_add(poles));
    let sum = times.iter().try_fold(0_usize, |sum, &time| sum.checked_add(time));
    let (Some(order), Some(sum)) = (order, sum.filter(|_| sum == wanted)) else {
        let message = format!("{poles} poles of degree {degree} do not go with the multiplicities {times:?}");
        return Err(Some(("knots_mismatch", message)));
    };
    if !knots.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err(Some(("knots_not_increasing", "the knots do not increase".to_owned())));
    }
    let inner = times.get(1..times.len().saturating_sub(1)).unwrap_or_default();
    if inner.iter().any(|&time| time >= order) || times.iter().any(|&time| time > order) {
        let message = format!("a knot stands too often for degree {degree}: {times:?}");
        return Err(Some(("knot_multiplicity", message)));
    }
    if poles < order {
        let message = format!("{poles} poles are too few for degree {degree}");
        return Err(Some(("knots_mismatch", message)));
    }
    if order - 1 > HIGHEST_DEGREE {
        return Err(None);
    }
    let mut all = Vec::with_capacity(sum);
    for (&knot, &time) in knots.iter().zip(&times) {
        all.resize(all.len() + time, knot);
    }
    let read = Knots { degree: order - 1, knots: all };
    let [from, to] = read.domain();
    if from < to && (to - from).is_finite() { Ok(read) } else { Err(bad("the knots span no interval")) }
}
