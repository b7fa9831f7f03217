//! Lines as OBJ: `v` and `l`, a group for each value.

use std::io::{self, BufWriter, Write};

use ogee::quality::LevelLine;

use crate::number::Shortest;

/// Writes lines; those of one value are a group with the name `line_` and the value's index, if they follow one another.
/// A closed line names its first vertex again at its end.
///
/// # Errors
/// Those of `out`.
pub fn write_obj(lines: &[LevelLine], out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let (mut first, mut group) = (1, None);
    for line in lines {
        if group != Some(line.index) {
            writeln!(out, "g line_{}", line.index)?;
            group = Some(line.index);
        }
        let count = line.points.len() - usize::from(line.closed);
        for point in &line.points[..count] {
            let p = point.position;
            writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
        }
        out.write_all(b"l")?;
        for vertex in first..first + count {
            write!(out, " {vertex}")?;
        }
        if line.closed {
            write!(out, " {first}")?;
        }
        out.write_all(b"\n")?;
        first += count;
    }
    out.flush()
}
