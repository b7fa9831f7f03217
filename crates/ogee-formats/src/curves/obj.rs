//! Curves as free-form elements of OBJ.

use std::io::{self, BufWriter, Write};

use super::NamedCurve;
use crate::finite::require_finite_curves;
use crate::number::Shortest;

/// Writes curves: of each an object with its name, its control points as `v`, its parameter range and their numbers as `curv`,
/// its knots as `parm`. Blanks in names become `_`.
///
/// # Errors
/// `InvalidData`, before anything is written, if a curve holds a number that is not finite; otherwise those of `out`.
pub fn write_obj(curves: &[NamedCurve], out: impl Write) -> io::Result<()> {
    require_finite_curves(curves)?;
    let mut out = BufWriter::new(out);
    let mut first = 1;
    for NamedCurve { name, curve } in curves {
        writeln!(out, "o {}", name.split_whitespace().collect::<Vec<_>>().join("_"))?;
        for p in &curve.points {
            writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
        }
        let degree = curve.knots.degree();
        let [from, to] = curve.knots.domain();
        write!(out, "cstype bspline\ndeg {degree}\ncurv {} {}", Shortest(from), Shortest(to))?;
        for vertex in first..first + curve.points.len() {
            write!(out, " {vertex}")?;
        }
        write!(out, "\nparm u")?;
        for &knot in curve.knots.knots() {
            write!(out, " {}", Shortest(knot))?;
        }
        writeln!(out, "\nend")?;
        first += curve.points.len();
    }
    out.flush()
}
