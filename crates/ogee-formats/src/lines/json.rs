//! Lines as JSON: where each point is on the surface and in space.
//!
//! `{"lines":[{"value":c,"index":j,"closed":b,"length":..,"turning":..,"inflections":..,"curvature_change":..,`
//! `"points":[{"face":f,"corner":k,"u":u,"v":v,"x":x,"y":y,"z":z},..]},..]}`, a line of text for each line. `corner` is null
//! where a face has one square of parameters. The last point of a closed line is its first.

use std::io::{self, BufWriter, Write};

use ogee::Location;
use ogee::quality::{Address, Fairness, LevelLine};
use serde::Serialize;

#[derive(Serialize)]
struct Line {
    value: f64,
    index: i64,
    closed: bool,
    length: f64,
    turning: f64,
    inflections: usize,
    curvature_change: f64,
    points: Vec<Point>,
}

#[derive(Serialize)]
struct Point {
    face: u32,
    corner: Option<u32>,
    u: f64,
    v: f64,
    x: f64,
    y: f64,
    z: f64,
}

/// Writes lines with their figures; `address` names places as the surface does. Numbers read back as the same bits.
///
/// # Errors
/// Those of `out`.
pub fn write_json<'a>(
    lines: impl IntoIterator<Item = (&'a LevelLine, Fairness)>,
    address: impl Fn(Location) -> Address,
    out: impl Write,
) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    out.write_all(b"{\"lines\":[")?;
    for (number, (line, fairness)) in lines.into_iter().enumerate() {
        let LevelLine { value, index, closed, ref points } = *line;
        let points = points.iter().map(|point| {
            let (Address { face, corner, u, v }, p) = (address(point.at), point.position);
            Point { face: face.0, corner, u, v, x: p.x, y: p.y, z: p.z }
        });
        let Fairness { length, turning, inflections, curvature_change } = fairness;
        let points = points.collect();
        let line = Line { value, index, closed, length, turning, inflections, curvature_change, points };
        out.write_all(if number == 0 { b"\n" } else { b",\n" })?;
        serde_json::to_writer(&mut out, &line)?;
    }
    out.write_all(b"\n]}\n")?;
    out.flush()
}
