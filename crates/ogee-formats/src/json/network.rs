//! The keys of a network of curves beside those of its cage. What is usual is left out.

use std::fmt::{self, Display, Write as _};
use std::io::{self, Write};

use ogee::Vec3;
use ogee::curve_network::{
    Crossing, CurveNetwork, MeetingOptions, NetworkCurve, NetworkOptions, Placing, PointConstraint, PreSplit,
};

use super::write::{Indices, Numbers, list};
use crate::number::Shortest;

/// All numbers that would be written and could be without end.
pub(super) fn numbers(network: &CurveNetwork) -> Vec<f64> {
    let flat = |p: &Vec3| [p.x, p.y, p.z];
    let mut numbers = Vec::new();
    for curve in &network.curves {
        numbers.extend(curve.control.iter().chain(&curve.through).flatten().flat_map(flat));
        numbers.extend(curve.normals.iter().flatten().flat_map(flat));
        numbers.extend(curve.cross_curvatures.iter().flatten());
    }
    numbers.extend(network.options.parameter);
    numbers.push(network.options.ribbon_width);
    for own in network.meetings.values() {
        numbers.extend(own.parameter);
        numbers.extend(own.normal.iter().flat_map(flat));
        numbers.push(own.crown);
    }
    for point in &network.points {
        numbers.extend(point.position.iter().chain(&point.normal).flat_map(flat));
    }
    numbers
}

/// Writes the keys, each after a comma.
pub(super) fn write(network: &CurveNetwork, out: &mut impl Write) -> io::Result<()> {
    write!(out, ",\n\"curves\": ")?;
    list(out, network.curves.iter().map(Curve))?;
    let options = Object(options(&network.options));
    if !options.0.is_empty() {
        write!(out, ",\n\"options\": {options}")?;
    }
    if !network.meetings.is_empty() {
        let meetings = network.meetings.iter();
        let meetings = meetings.map(|(vertex, own)| (vertex.to_string(), Object(meeting(own)).to_string()));
        write!(out, ",\n\"meeting\": {}", Object(meetings.collect()))?;
    }
    if !network.points.is_empty() {
        write!(out, ",\n\"points\": ")?;
        list(out, network.points.iter().map(|wanted| Object(point(wanted))))?;
    }
    Ok(())
}

/// Displays names with the text of their values.
struct Object(Vec<(String, String)>);

impl Display for Object {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (name, value)) in self.0.iter().enumerate() {
            write!(f, "{}\"{name}\":{value}", if i == 0 { '{' } else { ',' })?;
        }
        f.write_str(if self.0.is_empty() { "{}" } else { "}" })
    }
}

fn options(options: &NetworkOptions) -> Vec<(String, String)> {
    let usual = NetworkOptions::default();
    let mut list = Vec::new();
    let mut add = |name: &str, value: String| list.push((name.to_owned(), value));
    if options.placing != usual.placing {
        add("x_mode", quoted(placing(options.placing)));
    }
    if let Some(t) = options.parameter {
        add("t", Shortest(t).to_string());
    }
    if let PreSplit::Fixed(splits) = options.pre_split {
        add("pre_split", splits.to_string());
    }
    if options.crossing == Crossing::Smooth {
        add("crossing", quoted("smooth"));
    }
    if options.ribbon_width != usual.ribbon_width {
        add("theta", Shortest(options.ribbon_width).to_string());
    }
    for (name, value, usual) in [
        ("force_ribbons", options.force_ribbons, usual.force_ribbons),
        ("repair", options.repair, usual.repair),
        ("flatten", options.flatten, usual.flatten),
        ("straighten", options.straighten, usual.straighten),
        ("fit_mesh", options.fit_mesh, usual.fit_mesh),
        ("fair", options.fair, usual.fair),
    ] {
        if value != usual {
            add(name, value.to_string());
        }
    }
    list
}

fn meeting(own: &MeetingOptions) -> Vec<(String, String)> {
    let mode = own.placing.map(|mode| ("mode", quoted(placing(mode))));
    let t = own.parameter.map(|t| ("t", Shortest(t).to_string()));
    let normal = own.normal.map(|normal| ("normal", vector(normal)));
    let crown = (own.crown != 0.0).then(|| ("crown", Shortest(own.crown).to_string()));
    let flags = [("flatten", own.flatten), ("straighten", own.straighten), ("fit_mesh", own.fit_mesh)];
    let flags = flags.into_iter().filter_map(|(name, flag)| Some((name, flag?.to_string())));
    let all = mode.into_iter().chain(t).chain(normal).chain(crown).chain(flags);
    all.map(|(name, value)| (name.to_owned(), value)).collect()
}

fn point(wanted: &PointConstraint) -> Vec<(String, String)> {
    let vertex = Some(("vertex", wanted.vertex.to_string()));
    let position = wanted.position.map(|position| ("position", vector(position)));
    let normal = wanted.normal.map(|normal| ("normal", vector(normal)));
    let all = vertex.into_iter().chain(position).chain(normal);
    all.map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Displays a curve.
struct Curve<'a>(&'a NetworkCurve);

impl Display for Curve<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let NetworkCurve { name, vertices, closed, control, through, normals, cross_curvatures } = self.0;
        write!(f, "{{\"name\":{},\"vertices\":{},\"closed\":{closed}", quoted(name), Indices(vertices))?;
        for (key, points) in [("control", control), ("through", through)] {
            if let Some(points) = points {
                write!(f, ",\"{key}\":{}", Row(points.iter().map(|&p| Some(vector(p)))))?;
            }
        }
        if !normals.is_empty() {
            write!(f, ",\"normals\":{}", Row(normals.iter().map(|normal| normal.map(vector))))?;
        }
        if !cross_curvatures.is_empty() {
            let values = cross_curvatures.iter().map(|value| value.map(|x| Shortest(x).to_string()));
            write!(f, ",\"cross_curvatures\":{}", Row(values))?;
        }
        f.write_str("}")
    }
}

/// Displays a list on one line, `null` for what is not there.
struct Row<I>(I);

impl<I: Iterator<Item = Option<String>> + Clone> Display for Row<I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('[')?;
        for (i, item) in self.0.clone().enumerate() {
            f.write_str(if i == 0 { "" } else { "," })?;
            f.write_str(item.as_deref().unwrap_or("null"))?;
        }
        f.write_char(']')
    }
}

fn vector(p: Vec3) -> String {
    Numbers([p.x, p.y, p.z]).to_string()
}

/// A text as JSON spells it, with its quotes.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn placing(placing: Placing) -> &'static str {
    match placing {
        Placing::Eigen => "eigen",
        Placing::Parallelogram => "parallelogram",
        Placing::Symmetric => "symmetric",
        Placing::Keep => "keep",
    }
}
