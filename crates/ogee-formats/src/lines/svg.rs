//! Lines as SVG: strokes on white, in pixels of the picture they were projected for.

use std::io::{self, BufWriter, Write};

/// A curve in the plane of the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The value of its line; `None` for what is drawn to be seen with the lines.
    pub value: Option<f64>,
    /// Its last point is its first.
    pub closed: bool,
    /// In pixels from the top left, `y` down.
    pub points: Vec<[f64; 2]>,
}

/// A drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing<'a> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What it shows, for those who cannot see it.
    pub title: &'a str,
    /// Edges of the surface, drawn faintly and first.
    pub edges: &'a [Path],
    /// The lines, in order.
    pub lines: &'a [Path],
}

/// Colours and widths: edges, then lines.
const STROKES: [(&str, &str, f64); 2] = [("edges", "#8d99a6", 1.4), ("lines", "#12395b", 0.9)];

/// Of the smaller side of a picture of usual size, in pixels; strokes are as wide in proportion in all others.
const USUAL: f64 = 700.0;

/// Writes a drawing: one path for each curve, with its value as `data-value`.
///
/// # Errors
/// Those of `out`.
pub fn write_svg(drawing: &Drawing<'_>, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let [width, height] = drawing.size;
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">"
    )?;
    writeln!(out, "<title>{}</title>", escaped(drawing.title))?;
    writeln!(out, "<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>")?;
    let scale = f64::from(width.min(height)) / USUAL;
    for ((name, colour, stroke), paths) in STROKES.into_iter().zip([drawing.edges, drawing.lines]) {
        if paths.is_empty() {
            continue;
        }
        writeln!(
            out,
            "<g id=\"{name}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linecap=\"round\" \
             stroke-linejoin=\"round\">",
            Pixels(stroke * scale)
        )?;
        for path in paths {
            write_path(path, &mut out)?;
        }
        out.write_all(b"</g>\n")?;
    }
    out.write_all(b"</svg>\n")?;
    out.flush()
}

fn write_path(path: &Path, out: &mut impl Write) -> io::Result<()> {
    out.write_all(b"<path")?;
    if let Some(value) = path.value {
        write!(out, " data-value=\"{value}\"")?;
    }
    out.write_all(b" d=\"")?;
    let count = path.points.len().saturating_sub(usize::from(path.closed));
    let mut before: Option<[String; 2]> = None;
    for point in &path.points[..count] {
        let text = point.map(|x| Pixels(x).to_string());
        // What falls on the same hundredth of a pixel is not seen.
        if before.as_ref() == Some(&text) {
            continue;
        }
        let command = if before.is_none() { 'M' } else { 'L' };
        write!(out, "{command}{} {}", text[0], text[1])?;
        before = Some(text);
    }
    out.write_all(if path.closed { b"Z\"/>\n" } else { b"\"/>\n" })
}

/// A number to a hundredth, without zeros at its end.
struct Pixels(f64);

impl std::fmt::Display for Pixels {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // The sum turns -0 into 0.
        let rounded = (100.0 * self.0).round() / 100.0 + 0.0;
        write!(f, "{rounded}")
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_has_a_path_for_each_curve() {
        let points = vec![[1.0, 2.004], [1.001, 2.0], [30.0, -0.001], [1.0, 2.004]];
        let lines = [
            Path { value: Some(-0.25), closed: true, points: points.clone() },
            Path { value: Some(0.5), closed: false, points },
        ];
        let drawing = Drawing { size: [700, 1400], title: "a < b", edges: &[], lines: &lines };
        let mut out = Vec::new();
        write_svg(&drawing, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains("viewBox=\"0 0 700 1400\"") && text.contains("a &lt; b"), "{text}");
        assert!(text.contains("<path data-value=\"-0.25\" d=\"M1 2L30 0Z\"/>"), "{text}");
        assert!(text.contains("<path data-value=\"0.5\" d=\"M1 2L30 0L1 2\"/>"), "{text}");
        assert!(!text.contains("edges"));
    }
}
