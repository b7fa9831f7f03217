//! Writing a refined mesh as OBJ, with normals and texture coordinates where it has them.

use std::io::{self, Write};

use crate::mesh::MeshView;
use crate::number::Shortest;

/// Writes a mesh.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    let name = view.name.split_whitespace().collect::<Vec<_>>().join("_");
    if !name.is_empty() {
        writeln!(out, "o {name}")?;
    }
    for p in view.points {
        writeln!(out, "v {} {} {}", Shortest(p.x), Shortest(p.y), Shortest(p.z))?;
    }
    for [u, v] in view.uv.iter().flat_map(|(values, _)| *values) {
        writeln!(out, "vt {} {}", Shortest(*u), Shortest(*v))?;
    }
    for n in view.normals.unwrap_or_default() {
        writeln!(out, "vn {} {} {}", Shortest(n.x), Shortest(n.y), Shortest(n.z))?;
    }
    let mut texture = view.uv.map(|(_, indices)| indices.iter());
    for face in view.faces.iter() {
        write!(out, "f")?;
        for &v in face {
            let v = u64::from(v) + 1;
            let texture = texture.as_mut().and_then(Iterator::next).map(|&i| u64::from(i) + 1);
            match (texture, view.normals) {
                (None, None) => write!(out, " {v}")?,
                (Some(t), None) => write!(out, " {v}/{t}")?,
                (None, Some(_)) => write!(out, " {v}//{v}")?,
                (Some(t), Some(_)) => write!(out, " {v}/{t}/{v}")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}
