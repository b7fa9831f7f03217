//! `write_mesh_blocks`: a mesh that comes block by block, for meshes larger than memory.
//!
//! The bytes are those of [`crate::write_mesh`] on the whole mesh. What comes wrong is found when it comes, after bytes were written: a
//! file should get its name when all of it is there.

use std::io::{self, BufWriter, Write};

use ogee::Vec3;

use crate::mesh::{BUFFER, MeshFormat, refused};
use crate::{obj, off, ply};

/// A mesh of quads that comes in blocks, each of any size and in order. Counts are known before.
pub trait MeshBlocks {
    /// Number of vertices.
    fn vertex_count(&self) -> usize;

    /// Number of quads.
    fn face_count(&self) -> usize;

    /// Hands on the positions of all vertices.
    ///
    /// # Errors
    /// The first one of `take`, after which it is not called again.
    fn points(&self, take: &mut dyn FnMut(&[Vec3]) -> io::Result<()>) -> io::Result<()>;

    /// Hands on the corners of all quads.
    ///
    /// # Errors
    /// The first one of `take`, after which it is not called again.
    fn quads(&self, take: &mut dyn FnMut(&[[u32; 4]]) -> io::Result<()>) -> io::Result<()>;
}

impl MeshFormat {
    /// True if a file can be written while the mesh comes: no face of it says again where its corners are.
    pub fn takes_blocks(self) -> bool {
        matches!(self, MeshFormat::Obj | MeshFormat::Ply | MeshFormat::Off)
    }
}

/// Writes a mesh as it comes.
///
/// # Errors
/// Those of `out`; [`io::ErrorKind::InvalidInput`] if the format [takes no blocks](MeshFormat::takes_blocks), a point is not finite, a
/// face uses a missing vertex, or there come more or fewer than were promised.
pub fn write_mesh_blocks(
    mesh: &dyn MeshBlocks,
    name: &str,
    format: MeshFormat,
    out: impl Write,
) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(BUFFER, out);
    let (vertices, faces) = (mesh.vertex_count(), mesh.face_count());
    match format {
        MeshFormat::Obj => {
            obj::write_name(name, &mut out)?;
            each_point(mesh, |p| obj::write_point(p, &mut out))?;
            each_quad(mesh, |quad| obj::write_corners(quad, &mut out))?;
        }
        MeshFormat::Ply => {
            let layout =
                ply::Layout { vertices, faces, most_corners: if faces > 0 { 4 } else { 0 }, normals: false };
            layout.write_header(&mut out)?;
            each_point(mesh, |p| ply::write_vector(p, &mut out))?;
            each_quad(mesh, |quad| layout.write_face(quad, &mut out))?;
        }
        MeshFormat::Off => {
            off::write_header(vertices, faces, &mut out)?;
            each_point(mesh, |p| off::write_point(p, &mut out))?;
            each_quad(mesh, |quad| off::write_face(quad, &mut out))?;
        }
        MeshFormat::Stl | MeshFormat::Glb | MeshFormat::Json => {
            return Err(refused(&format!("{} cannot be written while the mesh comes", format.name())));
        }
    }
    out.flush()
}

/// Writes each point, and sees to it that they are what was promised.
fn each_point(mesh: &dyn MeshBlocks, mut write: impl FnMut(Vec3) -> io::Result<()>) -> io::Result<()> {
    let mut count = 0;
    mesh.points(&mut |points| {
        count += points.len();
        if !points.iter().all(|p| p.is_finite()) {
            return Err(refused("the mesh has a vertex that is not finite"));
        }
        points.iter().try_for_each(|&p| write(p))
    })?;
    as_promised("vertices", count, mesh.vertex_count())
}

/// The same for quads.
fn each_quad(mesh: &dyn MeshBlocks, mut write: impl FnMut(&[u32; 4]) -> io::Result<()>) -> io::Result<()> {
    let (mut count, vertices) = (0, mesh.vertex_count());
    mesh.quads(&mut |quads| {
        count += quads.len();
        if quads.as_flattened().iter().any(|&v| v as usize >= vertices) {
            return Err(refused("the mesh has a face that uses a missing vertex"));
        }
        quads.iter().try_for_each(&mut write)
    })?;
    as_promised("faces", count, mesh.face_count())
}

fn as_promised(what: &str, count: usize, promised: usize) -> io::Result<()> {
    if count == promised {
        return Ok(());
    }
    Err(refused(&format!("{promised} {what} were promised, {count} came")))
}
