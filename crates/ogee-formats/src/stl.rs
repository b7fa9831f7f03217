//! Writing STL: binary, each triangle with the normal of its own plane.

use std::io::{self, Write};

use ogee::Vec3;

use crate::mesh::MeshView;
use crate::triangles;

/// Begins the header; `solid` would make readers take the file for text.
const HEADER: &[u8] = b"binary STL written by ogee";

/// Writes a mesh; a triangle without area has a normal of zeros.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    let count = u32::try_from(triangles::count(view.faces))
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidInput, "STL holds fewer than 2^32 triangles"))?;
    let mut header = [0; 80];
    header[..HEADER.len()].copy_from_slice(HEADER);
    out.write_all(&header)?;
    out.write_all(&count.to_le_bytes())?;
    for triangle in triangles::of_faces(view.points, view.faces) {
        let normal = triangles::normal(view.points, triangle).normalized().unwrap_or(Vec3::ZERO);
        write_vector(normal, out)?;
        for v in triangle {
            write_vector(view.points[v as usize], out)?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

fn write_vector(v: Vec3, out: &mut impl Write) -> io::Result<()> {
    for x in <[f64; 3]>::from(v) {
        out.write_all(&(x as f32).to_le_bytes())?;
    }
    Ok(())
}
