//! Writing a refined mesh as OBJ, with normals and texture coordinates where it has them.

use std::io::{self, Write};

use ogee::Vec3;

use crate::mesh::MeshView;
use crate::number::Shortest;

/// Writes a mesh.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    write_name(view.name, out)?;
    for &p in view.points {
        write_point(p, out)?;
    }
    for [u, v] in view.uv.iter().flat_map(|(values, _)| *values) {
        writeln!(out, "vt {} {}", Shortest(*u), Shortest(*v))?;
    }
    for n in view.normals.unwrap_or_default() {
        writeln!(out, "vn {} {} {}", Shortest(n.x), Shortest(n.y), Shortest(n.z))?;
    }
    if view.uv.is_none() && view.normals.is_none() {
        return view.faces.iter().try_for_each(|face| write_corners(face, out));
    }
    let mut texture = view.uv.map(|(_, indices)| indices.iter());
    for face in view.faces.iter() {
        write!(out, "f")?;
        for &v in face {
            let v = u64::from(v) + 1;
            let texture = texture.as_mut().and_then(Iterator::next).map(|&i| u64::from(i) + 1);
            match (texture, view.normals) {
                (Some(t), None) => write!(out, " {v}/{t}")?,
                (None, _) => write!(out, " {v}//{v}")?,
                (Some(t), Some(_)) => write!(out, " {v}/{t}/{v}")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The name of a mesh, without blanks, where it has one.
pub(crate) fn write_name(name: &str, out: &mut impl Write) -> io::Result<()> {
    let name = name.split_whitespace().collect::<Vec<_>>().join("_");
    if name.is_empty() { Ok(()) } else { writeln!(out, "o {name}") }
}

pub(crate) fn write_point(p: Vec3, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))
}

/// A face with nothing but positions.
pub(crate) fn write_corners(face: &[u32], out: &mut impl Write) -> io::Result<()> {
    write!(out, "f")?;
    face.iter().try_for_each(|&v| write!(out, " {}", u64::from(v) + 1))?;
    writeln!(out)
}
