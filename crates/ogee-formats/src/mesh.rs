//! `write_mesh`: a refined mesh as a file of any format we write.
//!
//! Equal meshes give equal bytes. Where a format has no place for normals or texture coordinates they are left
//! out.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use ogee::{ControlMesh, FaceList, Vec3};

use crate::{glb, json, obj, off, ply, stl};

/// Bytes gathered before they are handed on.
pub(crate) const BUFFER: usize = 1 << 16;

/// A mesh to be written, borrowed from wherever it lives.
#[derive(Clone, Copy, Debug)]
pub struct MeshView<'a> {
    /// Positions of the vertices.
    pub points: &'a [Vec3],
    /// The faces.
    pub faces: Faces<'a>,
    /// A unit normal for each vertex; of length zero where there is none.
    pub normals: Option<&'a [Vec3]>,
    /// Texture coordinates, and for each corner of each face the index of its own.
    pub uv: Option<(&'a [[f64; 2]], &'a [u32])>,
    /// The name, where the format has one.
    pub name: &'a str,
}

/// Faces of a mesh, as refinement leaves them or as a cage has them.
#[derive(Clone, Copy, Debug)]
pub enum Faces<'a> {
    /// Quads only.
    Quads(&'a [[u32; 4]]),
    /// Any polygons.
    Polygons(&'a FaceList),
}

impl<'a> Faces<'a> {
    /// Number of faces.
    pub fn len(self) -> usize {
        match self {
            Faces::Quads(quads) => quads.len(),
            Faces::Polygons(list) => list.len(),
        }
    }

    /// True if there is no face.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }

    /// The corners of face `f`.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn face(self, f: usize) -> &'a [u32] {
        match self {
            Faces::Quads(quads) => &quads[f],
            Faces::Polygons(list) => list.face(f),
        }
    }

    /// All faces in order.
    pub fn iter(self) -> impl ExactSizeIterator<Item = &'a [u32]> {
        (0..self.len()).map(move |f| self.face(f))
    }

    /// How many corners all faces have.
    fn corners(self) -> usize {
        match self {
            Faces::Quads(quads) => 4 * quads.len(),
            Faces::Polygons(list) => list.corners().len(),
        }
    }
}

impl<'a> MeshView<'a> {
    /// The points, faces and texture coordinates of a control mesh.
    pub fn of_cage(mesh: &'a ControlMesh, name: &'a str) -> MeshView<'a> {
        MeshView {
            points: &mesh.points,
            faces: Faces::Polygons(&mesh.faces),
            normals: None,
            uv: mesh.uv.as_ref().map(|uv| (&uv.values[..], &uv.indices[..])),
            name,
        }
    }

    /// Refuses what no writer can write.
    fn check(&self) -> io::Result<()> {
        let refuse = |message: &str| Err(refused(message));
        if !self.points.iter().all(|p| p.is_finite()) {
            return refuse("the mesh has a vertex that is not finite");
        }
        if self.faces.iter().flatten().any(|&v| v as usize >= self.points.len()) {
            return refuse("the mesh has a face that uses a missing vertex");
        }
        if let Some(normals) = self.normals {
            if normals.len() != self.points.len() || !normals.iter().all(|n| n.is_finite()) {
                return refuse("the mesh does not have one finite normal for each vertex");
            }
        }
        if let Some((values, indices)) = self.uv {
            let in_range = indices.iter().all(|&i| (i as usize) < values.len());
            let finite = values.iter().flatten().all(|x| x.is_finite());
            if indices.len() != self.faces.corners() || !in_range || !finite {
                return refuse("the mesh does not have one finite texture coordinate for each corner");
            }
        }
        Ok(())
    }
}

/// What no writer can write.
pub(crate) fn refused(message: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message.to_owned())
}

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ: polygons, normals, texture coordinates, full precision.
    Obj,
    /// Polygon File Format, binary: polygons, normals, full precision.
    Ply,
    /// Object File Format: polygons, full precision.
    Off,
    /// Stereolithography, binary: triangles with their own normals, single precision.
    Stl,
    /// glTF in one binary file: triangles, normals, single precision.
    Glb,
    /// The cage in JSON: polygons, texture coordinates, full precision.
    Json,
}

impl MeshFormat {
    /// All formats.
    pub const ALL: [MeshFormat; 6] = [
        MeshFormat::Obj,
        MeshFormat::Ply,
        MeshFormat::Off,
        MeshFormat::Stl,
        MeshFormat::Glb,
        MeshFormat::Json,
    ];

    /// The name, which is also the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            MeshFormat::Obj => "obj",
            MeshFormat::Ply => "ply",
            MeshFormat::Off => "off",
            MeshFormat::Stl => "stl",
            MeshFormat::Glb => "glb",
            MeshFormat::Json => "json",
        }
    }

    /// The format of that name, in small or capital letters.
    pub fn from_name(name: &str) -> Option<MeshFormat> {
        MeshFormat::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// The format that the extension of a file tells.
    pub fn from_path(path: &Path) -> Option<MeshFormat> {
        MeshFormat::from_name(path.extension()?.to_str()?)
    }

    /// True if files of this format hold normals of vertices.
    pub fn has_normals(self) -> bool {
        matches!(self, MeshFormat::Obj | MeshFormat::Ply | MeshFormat::Glb)
    }
}

/// What coordinates mean, for formats that say so: GLB, which is in metres with y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The length of the mesh's unit.
    pub unit_in_metres: f64,
    /// True if z points up in the mesh, false if y does.
    pub z_up: bool,
}

impl Default for Placement {
    /// Millimetres, and the axes as they are.
    fn default() -> Placement {
        Placement { unit_in_metres: 0.001, z_up: false }
    }
}

/// Writes a mesh.
///
/// ```
/// # use ogee_formats::{MeshFormat, MeshView, Placement, write_mesh};
/// let cube = ogee::shapes::cube();
/// let mut file = Vec::new();
/// write_mesh(&MeshView::of_cage(&cube, "cube"), MeshFormat::Stl, Placement::default(), &mut file)?;
/// assert_eq!(file.len(), 84 + 50 * 12);
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// Those of `out`; [`io::ErrorKind::InvalidInput`] if the parts of the mesh do not fit together or the format
/// cannot hold it.
pub fn write_mesh(
    view: &MeshView<'_>,
    format: MeshFormat,
    placement: Placement,
    out: impl Write,
) -> io::Result<()> {
    view.check()?;
    let mut out = BufWriter::with_capacity(BUFFER, out);
    match format {
        MeshFormat::Obj => obj::write_view(view, &mut out)?,
        MeshFormat::Ply => ply::write_view(view, &mut out)?,
        MeshFormat::Off => off::write_view(view, &mut out)?,
        MeshFormat::Stl => stl::write_view(view, &mut out)?,
        MeshFormat::Glb => glb::write_view(view, placement, &mut out)?,
        MeshFormat::Json => json::write_view(view, &mut out)?,
    }
    out.flush()
}
