//! `read_cage`: a file of any format we read, as a control mesh.

use std::path::Path;

use ogee::ControlMesh;

use crate::error::{Fault, ReadError, Warning};
use crate::{json, obj, off, ply};

/// What a cage file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct CageFile {
    /// The cage. Its indices are in range and its numbers finite; whether it is a manifold is for
    /// [`ogee::Topology::new`] to say.
    pub mesh: ControlMesh,
    /// The line of each face, counted from 1; empty for formats without lines.
    pub face_lines: Vec<u32>,
    /// What was passed over.
    pub warnings: Vec<Warning>,
}

/// A format of cage files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CageFormat {
    /// Wavefront OBJ with subdivision tags, see [`obj`].
    Obj,
    /// Object File Format, see [`off`].
    Off,
    /// Polygon File Format, see [`ply`].
    Ply,
    /// The cage in JSON, see [`json`].
    Json,
}

impl CageFormat {
    /// All formats.
    pub const ALL: [CageFormat; 4] = [CageFormat::Obj, CageFormat::Off, CageFormat::Ply, CageFormat::Json];

    /// The name, which is also the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            CageFormat::Obj => "obj",
            CageFormat::Off => "off",
            CageFormat::Ply => "ply",
            CageFormat::Json => "json",
        }
    }

    /// The format of that name, in small or capital letters.
    pub fn from_name(name: &str) -> Option<CageFormat> {
        CageFormat::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// The format that the extension of a file tells.
    ///
    /// ```
    /// # use ogee_formats::CageFormat;
    /// assert_eq!(CageFormat::from_path("models/Hull.OBJ".as_ref()), Some(CageFormat::Obj));
    /// assert_eq!(CageFormat::from_path("hull".as_ref()), None);
    /// ```
    pub fn from_path(path: &Path) -> Option<CageFormat> {
        CageFormat::from_name(path.extension()?.to_str()?)
    }
}

/// Reads a cage.
///
/// ```
/// # use ogee_formats::{CageFormat, read_cage};
/// let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// assert_eq!(read_cage(text, CageFormat::Obj)?.mesh.faces.len(), 1);
///
/// let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 100\n";
/// let error = read_cage(text, CageFormat::Obj).unwrap_err();
/// assert_eq!(error.to_string(), "face 0 uses vertex 99, the file has 3");
/// assert_eq!(error.faults[0].line, Some(4));
/// # Ok::<(), ogee_formats::ReadError>(())
/// ```
///
/// # Errors
/// If the file is not of that format, or has faults; then all that could be found are named.
pub fn read_cage(bytes: &[u8], format: CageFormat) -> Result<CageFile, ReadError> {
    if bytes.trim_ascii().is_empty() {
        return Err(ReadError::single(Fault::new("no_faces", "the file is empty, so it has no faces")));
    }
    match format {
        CageFormat::Obj => obj::read(bytes),
        CageFormat::Off => off::read(bytes),
        CageFormat::Ply => ply::read(bytes),
        CageFormat::Json => json::read(bytes),
    }
}
