//! BezierView files: every surface as its Bezier pieces, for a second pair of eyes.
//!
//! Text. A patch is the line `5`, the line `deg_u deg_v`, and its coefficients, one to a line, row by row
//! along `u`. A line `Group n name` opens each shell.

use std::io::{self, BufWriter, Write};

use ogee::convert::Part;

use crate::finite::require_finite;

/// Writes all patches of a part, one group per shell.
///
/// # Errors
/// `InvalidData`, before anything is written, if the part holds a number that is not finite; otherwise what
/// `out` reports.
pub fn write(part: &Part, out: &mut impl Write) -> io::Result<()> {
    require_finite(part)?;
    let mut out = BufWriter::new(out);
    for (group, shell) in part.bodies.iter().flat_map(|body| body.shells()).enumerate() {
        writeln!(out, "Group {group} shell{group}")?;
        for face in &shell.faces {
            for piece in face.surface.bezier_pieces().cells() {
                writeln!(out, "5\n{} {}", piece.u.degree(), piece.v.degree())?;
                for point in piece.net.cells() {
                    writeln!(out, "{} {} {}", point.x, point.y, point.z)?;
                }
            }
        }
    }
    out.flush()
}
