//! Writing PLY: binary little endian, coordinates as doubles.

use std::io::{self, Write};

use ogee::Vec3;

use crate::mesh::MeshView;

/// What the header says.
pub(crate) struct Layout {
    pub(crate) vertices: usize,
    pub(crate) faces: usize,
    /// Of any face.
    pub(crate) most_corners: usize,
    pub(crate) normals: bool,
}

impl Layout {
    fn has_short_faces(&self) -> bool {
        self.most_corners <= 255
    }

    pub(crate) fn write_header(&self, out: &mut impl Write) -> io::Result<()> {
        let length = if self.has_short_faces() { "uchar" } else { "uint" };
        // `int` is what every reader expects; its bits are those of `uint`.
        let index = if self.vertices <= i32::MAX as usize { "int" } else { "uint" };
        write!(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}\n", self.vertices)?;
        write!(out, "property double x\nproperty double y\nproperty double z\n")?;
        if self.normals {
            write!(out, "property double nx\nproperty double ny\nproperty double nz\n")?;
        }
        let faces = self.faces;
        write!(out, "element face {faces}\nproperty list {length} {index} vertex_indices\nend_header\n")
    }

    pub(crate) fn write_face(&self, face: &[u32], out: &mut impl Write) -> io::Result<()> {
        if self.has_short_faces() {
            out.write_all(&[face.len() as u8])?;
        } else {
            out.write_all(&(face.len() as u32).to_le_bytes())?;
        }
        face.iter().try_for_each(|v| out.write_all(&v.to_le_bytes()))
    }
}

/// A position or a normal.
pub(crate) fn write_vector(v: Vec3, out: &mut impl Write) -> io::Result<()> {
    <[f64; 3]>::from(v).iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
}

/// Writes a mesh with its normals. PLY has no texture coordinates of face corners; they are left out.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    let layout = Layout {
        vertices: view.points.len(),
        faces: view.faces.len(),
        most_corners: view.faces.iter().map(<[u32]>::len).max().unwrap_or(0),
        normals: view.normals.is_some(),
    };
    layout.write_header(out)?;
    for (v, &p) in view.points.iter().enumerate() {
        write_vector(p, out)?;
        if let Some(normals) = view.normals {
            write_vector(normals[v], out)?;
        }
    }
    view.faces.iter().try_for_each(|face| layout.write_face(face, out))
}
