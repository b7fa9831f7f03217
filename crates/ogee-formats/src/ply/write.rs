//! Writing PLY: binary little endian, coordinates as doubles.

use std::io::{self, Write};

use crate::mesh::MeshView;

/// Writes a mesh with its normals. PLY has no texture coordinates of face corners; they are left out.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    let most_corners = view.faces.iter().map(<[u32]>::len).max().unwrap_or(0);
    let length = if most_corners <= 255 { "uchar" } else { "uint" };
    // `int` is what every reader expects; its bits are those of `uint`.
    let index = if view.points.len() <= i32::MAX as usize { "int" } else { "uint" };
    write!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}\n", view.points.len())?;
    write!(out, "property double x\nproperty double y\nproperty double z\n")?;
    if view.normals.is_some() {
        write!(out, "property double nx\nproperty double ny\nproperty double nz\n")?;
    }
    write!(
        out,
        "element face {}\nproperty list {length} {index} vertex_indices\nend_header\n",
        view.faces.len()
    )?;
    for (v, p) in view.points.iter().enumerate() {
        for x in <[f64; 3]>::from(*p) {
            out.write_all(&x.to_le_bytes())?;
        }
        if let Some(normals) = view.normals {
            for x in <[f64; 3]>::from(normals[v]) {
                out.write_all(&x.to_le_bytes())?;
            }
        }
    }
    for face in view.faces.iter() {
        if most_corners <= 255 {
            out.write_all(&[face.len() as u8])?;
        } else {
            out.write_all(&(face.len() as u32).to_le_bytes())?;
        }
        for v in face {
            out.write_all(&v.to_le_bytes())?;
        }
    }
    Ok(())
}
