//! Patches in JSON: the surfaces of a part with the pieces of the cage they cover, out and in again.
//!
//! `{"patches":[{"face":f,"corner":k,"degree":[3,3],"knots_u":[..],"knots_v":[..],"points":[[[x,y,z],..],..]}]}`
//! with `points[i][j]`, `i` along `u`. `corner` is null where the piece is a whole face. A patch packed from
//! several pieces has `faces` as well, rows along `u`, and `corners` where there are any; `face` and `corner`
//! are then those at its `(0, 0)`. Numbers read back as the same bits.

use std::io::{self, BufWriter, Write};

use ogee::convert::Part;
use ogee::nurbs::{FaceAddress, KnotVector, NurbsSurface, Quarters, ShellFace};
use ogee::{FaceId, Grid, Vec3};
use serde::{Deserialize, Serialize};

use crate::finite::require_finite;

/// A surface and the pieces of the cage that it covers.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The surface.
    pub surface: NurbsSurface,
    /// The pieces: `quads[(i, j)]`, `i` along `u`.
    pub quads: Grid<FaceAddress>,
}

/// Why a file of patches was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PatchesError {
    /// The text is no JSON, or none of this shape.
    #[error("{0}")]
    Json(#[from] serde_json::Error),
    /// Numbers that do not fit together.
    #[error("patch {patch}: {reason}")]
    Patch {
        /// The patch, numbered from 0 in the order of the file.
        patch: usize,
        /// What is wrong.
        reason: String,
    },
}

impl PatchesError {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            PatchesError::Json(_) => "bad_json",
            PatchesError::Patch { .. } => "bad_patch",
        }
    }
}

/// A patch as it stands in the file. Unknown fields are passed over.
#[derive(Serialize, Deserialize)]
struct Record {
    face: u32,
    #[serde(default)]
    corner: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    path: Option<Vec<u32>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    faces: Option<Vec<Vec<u32>>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    corners: Option<Vec<Vec<Option<u32>>>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    paths: Option<Vec<Vec<Vec<u32>>>>,
    degree: [usize; 2],
    knots_u: Vec<f64>,
    knots_v: Vec<f64>,
    points: Vec<Vec<[f64; 3]>>,
}

/// Writes the patches of all bodies, in the order of the part, one to a line.
///
/// # Errors
/// `InvalidData`, before anything is written, if the part holds a number that is not finite; otherwise what
/// `out` reports.
pub fn write(part: &Part, out: &mut impl Write) -> io::Result<()> {
    require_finite(part)?;
    let mut out = BufWriter::new(out);
    out.write_all(b"{\"patches\":[")?;
    let shells = part.bodies.iter().flat_map(|body| body.shells());
    for (i, face) in shells.flat_map(|shell| &shell.faces).enumerate() {
        out.write_all(if i == 0 { b"\n" } else { b",\n" })?;
        serde_json::to_writer(&mut out, &record(face))?;
    }
    out.write_all(b"\n]}\n")?;
    out.flush()
}

/// Reads patches.
///
/// ```
/// let text = br#"{"patches":[{"face":7,"corner":null,"degree":[1,1],"knots_u":[0,0,1,1],"knots_v":[0,0,1,1],
///     "points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]}]}"#;
/// let patches = ogee_formats::patches::read(text)?;
/// assert_eq!(patches[0].quads[(0, 0)].to_string(), "f7");
/// # Ok::<(), ogee_formats::patches::PatchesError>(())
/// ```
///
/// # Errors
/// If the text is not of the shape above, or the numbers of a patch do not make a surface.
pub fn read(text: &[u8]) -> Result<Vec<Patch>, PatchesError> {
    #[derive(Deserialize)]
    struct File {
        patches: Vec<Record>,
    }
    let file: File = serde_json::from_slice(text)?;
    file.patches
        .iter()
        .enumerate()
        .map(|(i, record)| {
            patch(record).map_err(|reason| PatchesError::Patch { patch: i, reason: reason.to_owned() })
        })
        .collect()
}

fn record(face: &ShellFace) -> Record {
    let FaceAddress { face: first, corner, quarters } = face.address();
    let packed = face.quads.cells().len() > 1;
    let deep = face.quads.cells().iter().any(|piece| piece.quarters.depth() > 0);
    let cornered = face.quads.cells().iter().any(|piece| piece.corner.is_some());
    let NurbsSurface { u, v, net } = &face.surface;
    Record {
        face: first.0,
        corner,
        path: (deep && !packed).then(|| quarters.iter().collect()),
        faces: packed.then(|| rows(&face.quads, |piece| piece.face.0)),
        corners: (packed && cornered).then(|| rows(&face.quads, |piece| piece.corner)),
        paths: (packed && deep).then(|| rows(&face.quads, |piece| piece.quarters.iter().collect())),
        degree: [u.degree(), v.degree()],
        knots_u: u.knots().to_vec(),
        knots_v: v.knots().to_vec(),
        points: rows(net, |&point| point.into()),
    }
}

fn rows<T, U>(grid: &Grid<T>, cell: impl Fn(&T) -> U + Copy) -> Vec<Vec<U>> {
    (0..grid.rows()).map(|i| grid.row(i).iter().map(cell).collect()).collect()
}

fn patch(record: &Record) -> Result<Patch, &'static str> {
    let [p, q] = record.degree;
    let u = knot_vector(p, &record.knots_u)?;
    let v = knot_vector(q, &record.knots_v)?;
    let net = grid(&record.points).ok_or("the rows of points differ in length")?;
    if [net.rows(), net.cols()] != [u.coefficients(), v.coefficients()] {
        return Err("points do not match degree and knots");
    }
    let net = net.map(|&point| Vec3::from(point));
    let quads = match &record.faces {
        None => Grid::from_fn(1, 1, |_, _| FaceAddress {
            face: FaceId(record.face),
            corner: record.corner,
            quarters: path(record.path.as_deref().unwrap_or_default()),
        }),
        Some(faces) => {
            let faces = grid(faces).ok_or("the rows of faces differ in length")?;
            let corners = match &record.corners {
                None => faces.map(|_| None),
                Some(corners) => grid(corners).ok_or("the rows of corners differ in length")?,
            };
            let paths = record.paths.as_deref().unwrap_or_default();
            if [faces.rows(), faces.cols()] != [corners.rows(), corners.cols()] {
                return Err("there are not as many corners as faces");
            }
            Grid::from_fn(faces.rows(), faces.cols(), |i, j| FaceAddress {
                face: FaceId(faces[(i, j)]),
                corner: corners[(i, j)],
                quarters: paths
                    .get(i)
                    .and_then(|row| row.get(j))
                    .map(|steps| path(steps))
                    .unwrap_or_default(),
            })
        }
    };
    Ok(Patch { surface: NurbsSurface { u, v, net }, quads })
}

/// Quarters of a quarter.
fn path(steps: &[u32]) -> Quarters {
    steps.iter().copied().collect()
}

/// A rectangle from its rows; `None` if it is none or empty.
fn grid<T: Copy>(rows: &[Vec<T>]) -> Option<Grid<T>> {
    let columns = rows.first()?.len();
    let full = columns > 0 && rows.iter().all(|row| row.len() == columns);
    full.then(|| Grid::from_fn(rows.len(), columns, |i, j| rows[i][j]))
}

/// The promises of [`KnotVector::new`], asked instead of demanded.
fn knot_vector(degree: usize, knots: &[f64]) -> Result<KnotVector, &'static str> {
    let order = degree.saturating_add(1);
    if degree == 0 || knots.len() / 2 < order {
        return Err("too few knots for the degree");
    }
    if !knots.windows(2).all(|pair| pair[0] <= pair[1]) {
        return Err("knots decrease");
    }
    let last = knots.len() - 1;
    if knots[0] != knots[degree] || knots[last] != knots[last - degree] || knots[0] == knots[last] {
        return Err("knots are not clamped");
    }
    if (1..knots.len() - order).any(|i| knots[i] == knots[i + degree]) {
        return Err("an inner knot stands more often than the degree");
    }
    Ok(KnotVector::new(degree, knots.to_vec()))
}
