//! Networks of curves: JSON in, and lines of OBJ both ways.
//!
//! ```json
//! { "curves": [ { "name": "sheer", "vertices": [0, 1, 2, 3], "closed": false,
//!                 "control": [[0, 0, 1], [1, 0, 1], [2, 0, 1], [3, 0, 1]] } ],
//!   "options": { "x_mode": "eigen", "t": null, "pre_split": "auto", "crossing": "pin",
//!                "force_ribbons": false, "theta": 0.5, "repair": true },
//!   "meeting": { "3": { "t": 0.25, "mode": "eigen", "normal": [0, 0, 1], "crown": 0 } } }
//! ```
//!
//! Only `curves` has to be there, and of a curve only `vertices`: vertices of the cage along its edges. What the surface's curve is
//! to be is said by `control`, its control points, one per vertex; by `through`, points that it goes through, one per vertex; or
//! by neither, and the vertices themselves are the control points. With `"refit": true` another number of control points does as
//! well. `normals` are those that the surface is to have at the vertices, `cross_curvatures` its normal curvatures across the curve,
//! one per vertex, `null` where any will do. The cage may stand in the same file.
//!
//! `"fair": true` among the options moves all points that curves do not hold to where the surface bends least; then `points`, a
//! list of `{"vertex": v, "position": [x, y, z], "normal": [x, y, z]}`, are met as well. `"scheme"` is `"abbas-nasri-2004"` or
//! `"generalised"`: the papers' own forms. `"flatten"` and `"straighten"` change curves so that the surface can be smooth.
//!
//! A file without faces is a bare network: `vertices` are its points, and a cage is made between the curves. `loops`, lists of
//! vertices counter-clockwise, say which loops of curves are to be filled, where that cannot be seen.
//!
//! In OBJ each line `l v1 v2 ..` is a curve, closed if it ends where it began, with the name of the `o` or `g` before it. A
//! comment `#curve-control NAME x y z x y z ..` gives its control points.

mod json;
mod obj;
mod write;

use std::path::Path;

use ogee::Vec3;
use ogee::curve_network::{CurveNetwork, NetworkCurve, TargetCurve};

use crate::error::{Fault, ReadError, Warning};

pub use write::{write_json, write_obj};

/// What a file of curves holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetworkFile {
    /// The network. Nothing is known yet about how it fits a cage.
    pub network: CurveNetwork,
    /// The vertices of the file, if it has any.
    pub points: Vec<Vec3>,
    /// True if it has faces, which are for [`read_cage`](crate::read_cage). Where it has none the curves are to be skinned.
    pub has_faces: bool,
    /// The loops of a network without faces, each as its vertices; empty if they are to be found.
    pub loops: Vec<Vec<u32>>,
    /// What was passed over, and curves that were fitted.
    pub warnings: Vec<Warning>,
}

/// A format of files of curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetworkFormat {
    /// The network in JSON.
    Json,
    /// Lines of OBJ.
    Obj,
}

impl NetworkFormat {
    /// The format that the extension of a file tells.
    pub fn from_path(path: &Path) -> Option<NetworkFormat> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "json" => Some(NetworkFormat::Json),
            "obj" => Some(NetworkFormat::Obj),
            _ => None,
        }
    }
}

/// Reads a network.
///
/// ```
/// use ogee_formats::network::{NetworkFormat, read};
///
/// let text = br#"{ "curves": [ { "name": "keel", "vertices": [4, 7, 9] } ] }"#;
/// assert_eq!(read(text, NetworkFormat::Json)?.network.curves[0].vertices, [4, 7, 9]);
///
/// let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\no rim\nl 1 2 3 1\n";
/// let curve = &read(text, NetworkFormat::Obj)?.network.curves[0];
/// assert_eq!((&curve.name[..], &curve.vertices[..], curve.closed), ("rim", &[0, 1, 2][..], true));
/// # Ok::<(), ogee_formats::ReadError>(())
/// ```
///
/// # Errors
/// If the file is not of that format, has faults, or no curve; then all faults that could be found are named.
pub fn read(bytes: &[u8], format: NetworkFormat) -> Result<NetworkFile, ReadError> {
    let file = match format {
        NetworkFormat::Json => json::read(bytes),
        NetworkFormat::Obj => obj::read(bytes),
    }?;
    if file.network.curves.is_empty() {
        let where_to = match format {
            NetworkFormat::Json => "list them under \"curves\"",
            NetworkFormat::Obj => "give each a line `l v1 v2 ..`",
        };
        let message = format!("the file has no curves; {where_to}");
        return Err(ReadError::single(Fault::new("no_curves", message)));
    }
    Ok(file)
}

/// A curve in the making.
struct Draft {
    line: Option<u32>,
    name: String,
    vertices: Vec<u32>,
    closed: bool,
    shape: Shape,
    normals: Vec<Option<Vec3>>,
    cross_curvatures: Vec<Option<f64>>,
}

impl Draft {
    /// An open curve without vertices.
    fn new(line: Option<u32>, name: String) -> Draft {
        let (normals, cross_curvatures) = (Vec::new(), Vec::new());
        Draft {
            line,
            name,
            vertices: Vec::new(),
            closed: false,
            shape: Shape::Vertices,
            normals,
            cross_curvatures,
        }
    }
}

/// What a curve is to be.
enum Shape {
    /// As its vertices are.
    Vertices,
    /// A curve with these control points.
    Control(Vec<Vec3>),
    /// The same, fitted if there are not as many as vertices.
    Refit(Vec<Vec3>),
    /// A curve through these points.
    Through(Vec<Vec3>),
}

/// The curve; a warning where it had to be fitted.
fn finish(draft: Draft) -> Result<(NetworkCurve, Option<Warning>), Fault> {
    let Draft { line, name, vertices, closed, shape, normals, cross_curvatures } = draft;
    let wrong = |reason: String| Fault::new("bad_curve", format!("curve {name}: {reason}")).on_line(line);
    let (mut warning, mut through) = (None, None);
    let control = match shape {
        Shape::Vertices => None,
        Shape::Control(control) => Some(control),
        Shape::Refit(control) => {
            let (given, wanted) = (control.len(), vertices.len());
            let fit = TargetCurve::new(control, closed).and_then(|curve| curve.with_points(wanted));
            let fit = fit.map_err(|error| wrong(error.to_string()))?;
            if fit.deviation > 0.0 {
                let message = format!(
                    "curve {name} has {given} control points and {wanted} vertices; it was fitted, and is off by {:.3e}",
                    fit.deviation
                );
                warning = Some(Warning { line, code: "refitted", message });
            }
            Some(fit.curve.control().to_vec())
        }
        Shape::Through(points) => {
            through = Some(points);
            None
        }
    };
    Ok((NetworkCurve { name, vertices, closed, control, through, normals, cross_curvatures }, warning))
}
