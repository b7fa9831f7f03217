//! The STEP writer: a part as solids and sheets of untrimmed B-spline faces that share edges and vertices.
//!
//! It streams, numbers entities in the order of writing, and invents no geometry: every point, knot and curve
//! stands in the part already. Surface normals point out of the material, so `same_sense` is always `.T.`;
//! no parameter curves are written, readers make them.

use std::io::{self, Write};

use ogee::convert::{Body, Part};
use ogee::nurbs::{KnotVector, NurbsCurve, NurbsSurface, Shell, ShellFace};

use super::context;
use super::emitter::Emitter;
use super::options::Options;
use super::syntax::{Id, List, Logical, Real, Text};
use crate::finite::require_finite;

/// Writes a part as a STEP file.
///
/// A solid becomes a `MANIFOLD_SOLID_BREP`, with hollows a `BREP_WITH_VOIDS`, a sheet a
/// `SHELL_BASED_SURFACE_MODEL`. Faces are named after the pieces of the cage they cover (`f12`, `f12.3`).
///
/// ```
/// use ogee::convert::{Part, Report};
/// use ogee_formats::step::{self, Options, Unit};
///
/// let part = Part { bodies: Vec::new(), report: Report::default() };
/// let options = Options { unit: Unit::Inch, name: "lamp".to_owned(), ..Options::default() };
/// let mut text = Vec::new();
/// step::write(&part, &options, &mut text)?;
/// assert!(step::check(&text).is_clean());
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// `InvalidData`, before anything is written, if the part holds a number that is not finite; otherwise what
/// `out` reports.
///
/// # Panics
/// If a face or an edge of the part names an edge or a vertex that its shell lacks.
pub fn write(part: &Part, options: &Options, out: &mut impl Write) -> io::Result<()> {
    require_finite(part)?;
    let faces = part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces);
    let mut file = Emitter::new(out, faces.map(|face| face.surface.net.cells().len()).sum());
    context::header(&mut file, options)?;
    let definition = context::product(&mut file, options)?;
    let units = context::units(&mut file, options.unit)?;

    let mut solids = Vec::new();
    let mut sheets = Vec::new();
    for (i, body) in part.bodies.iter().enumerate() {
        let name = match part.bodies.len() {
            1 => options.name.clone(),
            _ => format!("{}.{}", options.name, i + 1),
        };
        match body {
            Body::Solid { outer, voids } => solids.push(solid(&mut file, &name, outer, voids)?),
            Body::Sheet(sheet) => sheets.push(surface_model(&mut file, &name, sheet)?),
        }
    }
    representations(&mut file, definition, units, &solids, &sheets)?;
    context::footer(&mut file)?;
    file.finish()
}

/// The representations of the product: one for solids, one for sheets, since the first kind may not hold
/// sheets nor the second solids. A part with both has an empty representation to which the two are related.
fn representations<W: Write>(
    file: &mut Emitter<'_, W>,
    definition: Id,
    units: Id,
    solids: &[Id],
    sheets: &[Id],
) -> io::Result<()> {
    let placement = placement(file)?;
    let mut represent = |kind: &str, bodies: &[Id]| {
        let items = List(std::iter::once(&placement).chain(bodies));
        file.entity(format_args!("{kind}('',{items},{units})"))
    };
    let main = match (solids, sheets) {
        (_, []) if !solids.is_empty() => represent("ADVANCED_BREP_SHAPE_REPRESENTATION", solids)?,
        ([], _) if !sheets.is_empty() => represent("MANIFOLD_SURFACE_SHAPE_REPRESENTATION", sheets)?,
        _ => represent("SHAPE_REPRESENTATION", &[])?,
    };
    if !solids.is_empty() && !sheets.is_empty() {
        let both = [
            represent("ADVANCED_BREP_SHAPE_REPRESENTATION", solids)?,
            represent("MANIFOLD_SURFACE_SHAPE_REPRESENTATION", sheets)?,
        ];
        for other in both {
            file.entity(format_args!("SHAPE_REPRESENTATION_RELATIONSHIP('','',{main},{other})"))?;
        }
    }
    file.entity(format_args!("SHAPE_DEFINITION_REPRESENTATION({definition},{main})"))?;
    Ok(())
}

/// The origin and the axes of a representation.
pub(super) fn placement<W: Write>(file: &mut Emitter<'_, W>) -> io::Result<Id> {
    let origin = file.point(ogee::Vec3::ZERO)?;
    let axis = file.entity(format_args!("DIRECTION('',(0.,0.,1.))"))?;
    let across = file.entity(format_args!("DIRECTION('',(1.,0.,0.))"))?;
    file.entity(format_args!("AXIS2_PLACEMENT_3D('',{origin},{axis},{across})"))
}

/// A solid. All shells are written outward; hollows are turned where they are used.
fn solid<W: Write>(file: &mut Emitter<'_, W>, name: &str, outer: &Shell, voids: &[Shell]) -> io::Result<Id> {
    let outer = shell(file, "CLOSED_SHELL", outer)?;
    let mut hollows = Vec::with_capacity(voids.len());
    for void in voids {
        let inner = shell(file, "CLOSED_SHELL", void)?;
        hollows.push(file.entity(format_args!("ORIENTED_CLOSED_SHELL('',*,{inner},.F.)"))?);
    }
    if hollows.is_empty() {
        file.entity(format_args!("MANIFOLD_SOLID_BREP({},{outer})", Text(name)))
    } else {
        file.entity(format_args!("BREP_WITH_VOIDS({},{outer},{})", Text(name), List(&hollows)))
    }
}

fn surface_model<W: Write>(file: &mut Emitter<'_, W>, name: &str, sheet: &Shell) -> io::Result<Id> {
    let open = shell(file, "OPEN_SHELL", sheet)?;
    file.entity(format_args!("SHELL_BASED_SURFACE_MODEL({},({open}))", Text(name)))
}

/// A shell: its vertices, its edges, its faces.
fn shell<W: Write>(file: &mut Emitter<'_, W>, kind: &str, shell: &Shell) -> io::Result<Id> {
    let mut vertices = Vec::with_capacity(shell.vertices.len());
    for &position in &shell.vertices {
        let point = file.point(position)?;
        vertices.push(file.entity(format_args!("VERTEX_POINT('',{point})"))?);
    }
    let mut points = Vec::new();
    let mut edges = Vec::with_capacity(shell.edges.len());
    for edge in &shell.edges {
        let [start, end] = [edge.start, edge.end].map(|vertex| vertices[vertex as usize]);
        let curve = curve(file, "", &edge.curve, &mut points)?;
        edges.push(file.entity(format_args!("EDGE_CURVE('',{start},{end},{curve},.T.)"))?);
    }
    let mut faces = Vec::with_capacity(shell.faces.len());
    for one in &shell.faces {
        faces.push(face(file, one, &edges, &mut points)?);
    }
    file.entity(format_args!("{kind}('',{})", List(&faces)))
}

fn face<W: Write>(
    file: &mut Emitter<'_, W>,
    face: &ShellFace,
    edges: &[Id],
    points: &mut Vec<Id>,
) -> io::Result<Id> {
    let name = face.address();
    let surface = surface(file, &face.surface, points)?;
    let mut uses = Vec::with_capacity(face.boundary.len());
    for used in &face.boundary {
        let edge = edges[used.edge as usize];
        let forward = Logical(used.forward);
        uses.push(file.entity(format_args!("ORIENTED_EDGE('',*,*,{edge},{forward})"))?);
    }
    let ring = file.entity(format_args!("EDGE_LOOP('',{})", List(&uses)))?;
    let bound = file.entity(format_args!("FACE_OUTER_BOUND('',{ring},.T.)"))?;
    file.entity(format_args!("ADVANCED_FACE('{name}',({bound}),{surface},.T.)"))
}

/// A curve; `points` is room to work in.
pub(super) fn curve<W: Write>(
    file: &mut Emitter<'_, W>,
    name: &str,
    curve: &NurbsCurve,
    points: &mut Vec<Id>,
) -> io::Result<Id> {
    points.clear();
    for &point in &curve.points {
        points.push(file.point(point)?);
    }
    let degree = curve.knots.degree();
    let [times, knots] = knot_lists(&curve.knots);
    let closed = Logical(points.first() == points.last());
    file.entity(format_args!(
        "B_SPLINE_CURVE_WITH_KNOTS({},{degree},{},.UNSPECIFIED.,{closed},.F.,{times},{knots},.UNSPECIFIED.)",
        Text(name),
        List(&*points)
    ))
}

fn surface<W: Write>(
    file: &mut Emitter<'_, W>,
    surface: &NurbsSurface,
    points: &mut Vec<Id>,
) -> io::Result<Id> {
    points.clear();
    for &point in surface.net.cells() {
        points.push(file.point(point)?);
    }
    let [degree_u, degree_v] = [surface.u.degree(), surface.v.degree()];
    let [times_u, knots_u] = knot_lists(&surface.u);
    let [times_v, knots_v] = knot_lists(&surface.v);
    let columns = surface.net.cols();
    let rows = points.chunks_exact(columns);
    let closed_u = Logical(rows.clone().next() == rows.clone().next_back());
    let closed_v = Logical(rows.clone().all(|row| row.first() == row.last()));
    file.entity(format_args!(
        "B_SPLINE_SURFACE_WITH_KNOTS('',{degree_u},{degree_v},{},.UNSPECIFIED.,{closed_u},{closed_v},.F.,\
         {times_u},{times_v},{knots_u},{knots_v},.UNSPECIFIED.)",
        List(rows.map(List))
    ))
}

/// Multiplicities and distinct knots, spelt out.
fn knot_lists(knots: &KnotVector) -> [String; 2] {
    let all = knots.multiplicities();
    let times = all.iter().map(|&(_, times)| times);
    let values = all.iter().map(|&(knot, _)| Real(knot));
    [List(times).to_string(), List(values).to_string()]
}
