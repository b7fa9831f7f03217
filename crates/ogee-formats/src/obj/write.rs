//! Writing a cage as OBJ with tags. What [`super::read`] reads back is the same cage, bit for bit.

use std::io::{self, BufWriter, Write};

use ogee::{Boundary, ControlMesh, Creasing, FaceVaryingRule, Sharpness};

use crate::number::Shortest;

/// Writes a cage, each line of `comment` as a comment at the top.
///
/// A sharpness that never fades is written as 10, the least that does not. Meetings of curves have no place in OBJ and are left
/// out; JSON has them.
///
/// # Errors
/// Those of `out`.
pub fn write_cage(mesh: &ControlMesh, comment: &str, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    for line in comment.lines() {
        writeln!(out, "# {line}")?;
    }
    for p in &mesh.points {
        writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
    }
    if let Some(uv) = &mesh.uv {
        for [u, v] in &uv.values {
            writeln!(out, "vt {} {}", Shortest(*u), Shortest(*v))?;
        }
    }
    write_faces(mesh, &mut out)?;
    write_tags(mesh, &mut out)?;
    out.flush()
}

fn write_faces(mesh: &ControlMesh, out: &mut impl Write) -> io::Result<()> {
    let mut corner = 0;
    for face in mesh.faces.iter() {
        write!(out, "f")?;
        for &v in face {
            write!(out, " {}", u64::from(v) + 1)?;
            if let Some(index) = mesh.uv.as_ref().and_then(|uv| uv.indices.get(corner)) {
                write!(out, "/{}", u64::from(*index) + 1)?;
            }
            corner += 1;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn write_tags(mesh: &ControlMesh, out: &mut impl Write) -> io::Result<()> {
    for crease in &mesh.creases {
        let [a, b] = crease.vertices;
        writeln!(out, "t crease 2/1/0 {a} {b} {}", sharpness(crease.sharpness))?;
    }
    for corner in &mesh.corners {
        writeln!(out, "t corner 1/1/0 {} {}", corner.vertex, sharpness(corner.sharpness))?;
    }
    for hole in &mesh.holes {
        writeln!(out, "t hole 1/0/0 {hole}")?;
    }
    let boundary = match mesh.scheme.boundary {
        Boundary::None => 0,
        Boundary::EdgeAndCorner => 1,
        Boundary::EdgeOnly => 2,
    };
    writeln!(out, "t interpolateboundary 1/0/0 {boundary}")?;
    let creasing = match mesh.scheme.creasing {
        Creasing::Uniform => "normal",
        Creasing::Chaikin => "chaikin",
    };
    writeln!(out, "t creasemethod 0/0/1 {creasing}")?;
    if let Some(uv) = &mesh.uv {
        let rule = match uv.rule {
            FaceVaryingRule::None => 0,
            FaceVaryingRule::CornersOnly => 1,
            FaceVaryingRule::CornersPlus1 => 2,
            FaceVaryingRule::CornersPlus2 => 3,
            FaceVaryingRule::Boundaries => 4,
            FaceVaryingRule::All => 5,
        };
        writeln!(out, "t facevaryinginterpolateboundary 1/0/0 {rule}")?;
    }
    Ok(())
}

fn sharpness(sharpness: Sharpness) -> Shortest {
    match sharpness {
        Sharpness::Finite(value) => Shortest(value),
        Sharpness::Infinite => Shortest(10.0),
    }
}
