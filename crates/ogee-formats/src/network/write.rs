//! Curves beside a cage: what is read back is the same network.

use std::io::{self, BufWriter, Write};

use ogee::ControlMesh;
use ogee::curve_network::{CurveNetwork, NetworkCurve};

use crate::number::Shortest;
use crate::{json, obj};

/// Writes a cage as OBJ with its curves: `l` lines in groups with their names, and `#curve-control` where a curve has control
/// points of its own. Blanks in names become `_`.
///
/// # Errors
/// Those of `out`.
pub fn write_obj(
    mesh: &ControlMesh,
    curves: &[NetworkCurve],
    comment: &str,
    out: impl Write,
) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    obj::write_cage(mesh, comment, &mut out)?;
    for curve in curves {
        let name = curve.name.split_whitespace().collect::<Vec<_>>().join("_");
        write!(out, "g {name}\nl")?;
        let back = curve.vertices.first().filter(|_| curve.closed);
        for &v in curve.vertices.iter().chain(back) {
            write!(out, " {}", u64::from(v) + 1)?;
        }
        if let Some(control) = &curve.control {
            write!(out, "\n#curve-control {name}")?;
            for p in control {
                write!(out, " {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
            }
        }
        writeln!(out)?;
    }
    out.flush()
}

/// Writes a cage in JSON with its network: curves, options, choices for meeting points, points. What is usual is left out.
///
/// # Errors
/// If a number is not finite, which JSON cannot say; and those of `out`.
pub fn write_json(mesh: &ControlMesh, network: &CurveNetwork, out: impl Write) -> io::Result<()> {
    json::write_cage_with(mesh, Some(network), out)
}
