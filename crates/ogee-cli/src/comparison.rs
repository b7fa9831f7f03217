//! One cage by several methods: its limit surface and parts that were made from it, measured by the same instruments.

use ogee::ControlMesh;
use ogee::convert::{Method, Options, Packing, to_part};
use ogee::lens;
use ogee::quality::{ExtraordinaryPoint, Field, PatchView, Ray, Report, ReportOptions, Surface, Viewer};
use ogee_render::{ANGLE, Camera, THREE_QUARTER, default_light, outline};
use serde::Serialize;

use crate::cage::Cage;
use crate::error::Failure;
use crate::inspection::figures::{Figures, Place, Range, place_of};
use crate::inspection::{PICTURE, vertex_of};
use crate::part::refusal;
use crate::subject::Subject;
use crate::system;

/// How a surface is made from a cage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// The limit surface itself.
    Limit,
    /// A part.
    Part(Method),
}

impl Way {
    /// Its name on the command line and in reports.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Way::Limit => "limit",
            Way::Part(method) => method.name(),
        }
    }
}

/// What is made of a cage in these ways: patches, or nothing for the limit, which is there already.
pub(crate) fn views(cage: &Cage, ways: &[Way]) -> Result<Vec<Option<PatchView>>, Failure> {
    ways.iter()
        .map(|&way| match way {
            Way::Limit => Ok(None),
            Way::Part(method) => view(cage, method).map(Some),
        })
        .collect()
}

fn view(cage: &Cage, method: Method) -> Result<PatchView, Failure> {
    let options = Options {
        method,
        packing: Packing::Unpacked,
        lens: lens::Options::default(),
        memory: system::available_memory(),
        ..Options::default()
    };
    let part = to_part(cage.mesh(), &options).map_err(|error| refusal(cage, &error))?;
    let shells = part.bodies.iter().flat_map(|body| body.shells());
    let faces = shells.flat_map(|shell| &shell.faces);
    let patches = faces.map(|face| (face.surface.clone(), face.quads.clone())).collect();
    PatchView::new(patches).map_err(|error| cage.failure("no_surface", error.to_string()))
}

/// Surfaces of one cage, with everything that was measured.
#[derive(Serialize)]
pub(crate) struct Comparison {
    /// Faces of the cage.
    pub(crate) faces: usize,
    /// The surfaces in the order in which they were asked for.
    pub(crate) surfaces: Vec<Compared>,
    /// The points where not four faces meet, the one around which the first surface's curvature ranges most first.
    pub(crate) points: Vec<ComparedPoint>,
    /// The diagonal of the first surface.
    #[serde(skip)]
    pub(crate) size: f64,
}

/// One of the surfaces.
#[derive(Serialize)]
pub(crate) struct Compared {
    pub(crate) method: &'static str,
    #[serde(flatten)]
    pub(crate) figures: Figures,
}

/// A point with the range of curvature around it on each surface.
#[derive(Serialize)]
pub(crate) struct ComparedPoint {
    #[serde(flatten)]
    pub(crate) place: Place,
    /// In the order of the surfaces; nothing where a surface has no such point.
    pub(crate) ranges: Vec<Option<Range>>,
}

/// Patches that meet at this angle or more, in degrees, are meant to: a fault is rarely as large, a crease rarely less.
pub(crate) const CREASE_ANGLE: f64 = 10.0;

/// Measures surfaces of one cage under one light, seen by one eye.
pub(crate) fn compare(
    subject: &Subject,
    cage: &Cage,
    ways: &[Way],
    surfaces: &[&dyn Surface],
) -> Result<Comparison, Failure> {
    let mesh = cage.mesh();
    let bounds = subject.bounds(surfaces[0])?;
    let camera = Camera::fit_from(THREE_QUARTER, &outline(surfaces[0]), ANGLE, PICTURE);
    let light = default_light(bounds);
    let field = Field::Plane { light, viewer: Viewer::Eye(camera.eye), ray: Ray::Reflected, axis: 0 };
    let measured: Vec<Report> = ways
        .iter()
        .zip(surfaces)
        .map(|(&way, &surface)| {
            let crease_angle = (way != Way::Limit).then_some(CREASE_ANGLE);
            let options = ReportOptions { crease_angle, ..ReportOptions::new(field) };
            Report::new(surface, &options)
                .ok_or_else(|| subject.failure("no_surface", "there is no face whose points are finite"))
        })
        .collect::<Result<_, Failure>>()?;
    let compared = ways.iter().zip(&measured).zip(surfaces).map(|((&way, report), surface)| {
        let faces = match way {
            Way::Limit => mesh.faces.len(),
            Way::Part(_) => surface.layout().squares().len(),
        };
        let kind = if way == Way::Limit { "cage" } else { "patches" };
        Compared { method: way.name(), figures: Figures { kind, ..Figures::new(report, faces, Some(mesh)) } }
    });
    Ok(Comparison {
        faces: mesh.faces.len(),
        surfaces: compared.collect(),
        points: points(mesh, &measured),
        size: measured[0].size(),
    })
}

/// The points of the first surface, each with the same point on the others.
fn points(mesh: &ControlMesh, measured: &[Report]) -> Vec<ComparedPoint> {
    let mut first: Vec<&ExtraordinaryPoint> = measured[0].extraordinary.points.iter().collect();
    first.sort_by(|a, b| b.range.mean_span().total_cmp(&a.range.mean_span()));
    // A point of a part lies on one of the faces at the vertex, though not at the same place in space.
    let is_same = |a: &ExtraordinaryPoint, b: &ExtraordinaryPoint| {
        let face = b.sector.at.face;
        let is_there = match vertex_of(Some(mesh), &a.sector) {
            Some(vertex) => mesh.faces.face(face.index()).contains(&vertex),
            None => a.sector.at.face == face,
        };
        is_there && (a.sector.kind, a.sector.faces) == (b.sector.kind, b.sector.faces)
    };
    let near = |point: &ExtraordinaryPoint, report: &Report| {
        let same = report.extraordinary.points.iter().filter(|other| is_same(point, other));
        let distance = |other: &&ExtraordinaryPoint| other.sector.position.distance(point.sector.position);
        same.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|other| Range::from(&other.range))
    };
    let points = first.into_iter().map(|point| ComparedPoint {
        place: place_of(&point.sector, Some(mesh)),
        ranges: measured.iter().map(|report| near(point, report)).collect(),
    });
    points.collect()
}
