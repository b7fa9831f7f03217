//! Reading the curves of an OBJ file.

use std::collections::HashMap;

use ogee::Vec3;

use super::{Draft, NetworkFile, Shape, finish};
use crate::error::{Fault, Faults, ReadError, Warning};
use crate::text::{Lines, Tokens, check_is_text, integer, real, shown, without_mark};

/// The comment that gives a curve its control points.
const CONTROL: &[u8] = b"#curve-control";

/// Reads a network.
pub(super) fn read(bytes: &[u8]) -> Result<NetworkFile, ReadError> {
    check_is_text(bytes, "OBJ")?;
    let mut reader = Reader::default();
    for (number, line) in Lines::new(without_mark(bytes)) {
        reader.line(number, line);
    }
    reader.finish()
}

/// What has been read so far.
#[derive(Default)]
struct Reader {
    points: Vec<Vec3>,
    has_faces: bool,
    group: Option<String>,
    lines: Vec<(u32, String, Vec<u32>)>,
    uses: HashMap<String, usize>,
    control: HashMap<String, (u32, Vec<Vec3>)>,
    faults: Faults,
}

impl Reader {
    fn line(&mut self, number: u32, line: &[u8]) {
        let line = line.trim_ascii();
        if let Some(rest) =
            line.strip_prefix(CONTROL).filter(|rest| rest.first().is_none_or(u8::is_ascii_whitespace))
        {
            self.control(number, Tokens::new(rest));
            return;
        }
        let mut tokens = Tokens::new(line);
        match tokens.next() {
            // A faulty vertex is for the reader of cages to complain about.
            Some(b"v") => {
                let mut coordinate = || tokens.next().and_then(real).unwrap_or(0.0);
                self.points.push(Vec3::new(coordinate(), coordinate(), coordinate()));
            }
            Some(b"o" | b"g") => {
                let words: Vec<String> = tokens.map(shown).collect();
                self.group = (!words.is_empty()).then(|| words.join("_"));
            }
            Some(b"f" | b"fo") => self.has_faces = true,
            Some(b"l") => self.curve(number, tokens),
            _ => {}
        }
    }

    fn curve(&mut self, line: u32, tokens: Tokens<'_>) {
        let mut vertices = Vec::new();
        for token in tokens {
            let number = token.split(|&b| b == b'/').next().and_then(integer);
            let vertex = match number {
                Some(number @ 1..) => u32::try_from(number - 1).ok(),
                Some(number) if number < 0 => u32::try_from(self.points.len() as i64 + number).ok(),
                _ => None,
            };
            let Some(vertex) = vertex else {
                let message = format!("the line names `{}`, which is no vertex", shown(token));
                self.faults.push(Fault::new("bad_curve", message).on_line(line));
                return;
            };
            vertices.push(vertex);
        }
        let group = self.group.clone().unwrap_or_else(|| format!("curve{}", self.lines.len() + 1));
        let uses = self.uses.entry(group.clone()).or_default();
        *uses += 1;
        let name = if *uses == 1 { group } else { format!("{group}.{uses}") };
        self.lines.push((line, name, vertices));
    }

    fn control(&mut self, line: u32, mut tokens: Tokens<'_>) {
        let wrong =
            |message: String| Fault::new("bad_curve", format!("#curve-control: {message}")).on_line(line);
        let Some(name) = tokens.next().map(shown) else {
            self.faults.push(wrong("the name of a curve is missing".into()));
            return;
        };
        let numbers: Option<Vec<f64>> = tokens.map(|token| real(token).filter(|x| x.is_finite())).collect();
        let Some(numbers) = numbers.filter(|numbers| numbers.len() % 3 == 0) else {
            self.faults.push(wrong(format!("curve {name} needs three finite numbers for each point")));
            return;
        };
        let points = numbers.chunks_exact(3).map(|p| Vec3::new(p[0], p[1], p[2])).collect();
        if self.control.insert(name.clone(), (line, points)).is_some() {
            self.faults.push(wrong(format!("curve {name} has control points already")));
        }
    }

    fn finish(mut self) -> Result<NetworkFile, ReadError> {
        let mut file =
            NetworkFile { points: self.points, has_faces: self.has_faces, ..NetworkFile::default() };
        for (line, name, mut vertices) in self.lines {
            let closed = vertices.len() > 1 && vertices.first() == vertices.last();
            if closed {
                vertices.pop();
            }
            let control = self.control.remove(&name);
            let shape = control.map_or(Shape::Vertices, |(_, points)| Shape::Control(points));
            match finish(Draft { vertices, closed, shape, ..Draft::new(Some(line), name) }) {
                Ok((curve, warning)) => {
                    file.network.curves.push(curve);
                    file.warnings.extend(warning);
                }
                Err(fault) => self.faults.push(fault),
            }
        }
        let mut unused: Vec<_> = self.control.into_iter().collect();
        unused.sort_by_key(|(_, (line, _))| *line);
        for (name, (line, _)) in unused {
            let message = format!("#curve-control names curve {name}, which no line has; passed over");
            file.warnings.push(Warning { line: Some(line), code: "unknown_curve", message });
        }
        self.faults.into_result()?;
        Ok(file)
    }
}
