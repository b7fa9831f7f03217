//! Writing the cage in JSON. What [`super::read`] reads back is the same cage, bit for bit.

use std::fmt::{self, Display};
use std::io::{self, BufWriter, Write};

use ogee::curve_network::CurveNetwork;
use ogee::{ControlMesh, FaceVaryingRule, LensShape, Sharpness};

use super::names::{BOUNDARIES, CREASINGS, FACE_VARYING_RULES, name};
use crate::mesh::MeshView;
use crate::number::Shortest;

/// Writes a cage.
///
/// # Errors
/// If a number is not finite, which JSON cannot say; and those of `out`.
pub fn write_cage(mesh: &ControlMesh, out: impl Write) -> io::Result<()> {
    write_cage_with(mesh, None, out)
}

/// The same with the network of curves that lies on the cage.
pub(crate) fn write_cage_with(
    mesh: &ControlMesh,
    network: Option<&CurveNetwork>,
    out: impl Write,
) -> io::Result<()> {
    let uvs = mesh.uv.iter().flat_map(|uv| uv.values.iter().flatten());
    let points = mesh.points.iter().flat_map(|p| [p.x, p.y, p.z]);
    let sharpness = mesh.creases.iter().map(|crease| crease.sharpness);
    let sharpness = sharpness.chain(mesh.corners.iter().map(|corner| corner.sharpness));
    let is_number = |sharpness: Sharpness| !sharpness.value().is_nan();
    let shapes = mesh.meetings.iter().map(|meeting| meeting.t);
    let shapes = shapes.chain([mesh.scheme.lens.beta, mesh.scheme.lens.gamma]);
    let points = points.chain(network.into_iter().flat_map(super::network::numbers));
    if !points.chain(uvs.copied()).chain(shapes).all(f64::is_finite) || !sharpness.into_iter().all(is_number)
    {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "JSON has no way to write a number not finite",
        ));
    }
    let mut out = BufWriter::new(out);
    write!(out, "{{\n\"vertices\": ")?;
    list(&mut out, mesh.points.iter().map(|p| Numbers([p.x, p.y, p.z])))?;
    write!(out, ",\n\"faces\": ")?;
    list(&mut out, mesh.faces.iter().map(Indices))?;
    write!(out, ",\n\"creases\": ")?;
    list(
        &mut out,
        mesh.creases.iter().map(|crease| {
            let [a, b] = crease.vertices;
            format!("{{\"vertices\":[{a},{b}],\"sharpness\":{}}}", sharpness_value(crease.sharpness))
        }),
    )?;
    write!(out, ",\n\"corners\": ")?;
    list(
        &mut out,
        mesh.corners.iter().map(|corner| {
            let sharpness = sharpness_value(corner.sharpness);
            format!("{{\"vertex\":{},\"sharpness\":{sharpness}}}", corner.vertex)
        }),
    )?;
    let boundary = name(&BOUNDARIES, &mesh.scheme.boundary);
    let creasing = name(&CREASINGS, &mesh.scheme.creasing);
    write!(out, ",\n\"boundary\": \"{boundary}\",\n\"creasing\": \"{creasing}\"")?;
    let LensShape { beta, gamma } = mesh.scheme.lens;
    if mesh.scheme.lens != LensShape::default() {
        let (beta, gamma) = (Shortest(beta), Shortest(gamma));
        write!(out, ",\n\"lens\": {{\"beta\":{beta},\"gamma\":{gamma}}}")?;
    }
    write!(out, ",\n\"holes\": ")?;
    write!(out, "{}", Indices(&mesh.holes))?;
    if !mesh.meetings.is_empty() {
        write!(out, ",\n\"meetings\": ")?;
        list(
            &mut out,
            mesh.meetings.iter().map(|meeting| {
                let (ports, t) = (Indices(&meeting.ports), Shortest(meeting.t));
                format!("{{\"vertex\":{},\"ports\":{ports},\"t\":{t}}}", meeting.vertex)
            }),
        )?;
    }
    if let Some(network) = network {
        super::network::write(network, &mut out)?;
    }
    if let Some(uv) = &mesh.uv {
        let faces = mesh.faces.starts().windows(2).map(|ends| {
            let range = ends[0] as usize..ends[1] as usize;
            uv.indices.get(range).unwrap_or_default()
        });
        write_texture(&mut out, &uv.values, faces, uv.rule)?;
    }
    writeln!(out, "\n}}")?;
    out.flush()
}

/// Writes a mesh with its texture coordinates; a cage has no normals.
pub(crate) fn write_view(view: &MeshView<'_>, out: &mut impl Write) -> io::Result<()> {
    write!(out, "{{\n\"vertices\": ")?;
    list(out, view.points.iter().map(|p| Numbers([p.x, p.y, p.z])))?;
    write!(out, ",\n\"faces\": ")?;
    list(out, view.faces.iter().map(Indices))?;
    if let Some((values, texture)) = view.uv {
        let mut rest = texture;
        let faces = view.faces.iter().map(move |face| {
            let (these, others) = rest.split_at(face.len());
            rest = others;
            these
        });
        write_texture(out, values, faces, FaceVaryingRule::default())?;
    }
    writeln!(out, "\n}}")
}

fn write_texture<'a>(
    out: &mut impl Write,
    values: &[[f64; 2]],
    faces: impl Iterator<Item = &'a [u32]>,
    rule: FaceVaryingRule,
) -> io::Result<()> {
    write!(out, ",\n\"uvs\": ")?;
    list(out, values.iter().map(|&value| Numbers(value)))?;
    write!(out, ",\n\"face_uvs\": ")?;
    list(out, faces.map(Indices))?;
    write!(out, ",\n\"face_varying\": \"{}\"", name(&FACE_VARYING_RULES, &rule))
}

/// Writes items, each on a line.
pub(super) fn list(out: &mut impl Write, items: impl Iterator<Item = impl Display>) -> io::Result<()> {
    write!(out, "[")?;
    let mut is_first = true;
    for item in items {
        write!(out, "{}\n{item}", if is_first { "" } else { "," })?;
        is_first = false;
    }
    write!(out, "{}]", if is_first { "" } else { "\n" })
}

/// Displays a list of numbers.
pub(super) struct Numbers<const N: usize>(pub(super) [f64; N]);

impl<const N: usize> Display for Numbers<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, &x) in self.0.iter().enumerate() {
            write!(f, "{}{}", if i == 0 { '[' } else { ',' }, Shortest(x))?;
        }
        f.write_str("]")
    }
}

/// Displays a list of indices.
pub(super) struct Indices<'a>(pub(super) &'a [u32]);

impl Display for Indices<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[")?;
        for (i, index) in self.0.iter().enumerate() {
            f.write_str(if i == 0 { "" } else { "," })?;
            Display::fmt(index, f)?;
        }
        f.write_str("]")
    }
}

fn sharpness_value(sharpness: Sharpness) -> String {
    match sharpness {
        Sharpness::Finite(value) if value.is_finite() => Shortest(value).to_string(),
        _ => "\"infinite\"".to_string(),
    }
}
