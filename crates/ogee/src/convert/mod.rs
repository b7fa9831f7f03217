//! The whole journey from a cage to a part: which method takes which faces, packing, sewing, measuring.
//!
//! So that the command line, and whatever else calls it, make the same part from the same cage.

mod bicubic;
mod bodies;
mod cap_deviation;
mod curvature;
mod curves;
mod deviation;
mod measure;
mod memory;
mod outline;
mod part;
mod quintic;
mod regularity;
mod sew;
mod source;

pub use curves::largest_distance_to_edges;
pub use part::{Body, LevelFaces, Method, Node, NodeKind, Part, Report};

use crate::lens::{self, LensError};
use crate::math::Vec3;
use crate::mesh::{ControlMesh, FaceId, HalfedgeId, Meeting, Note, TopologyError, VertexId, notes};
use crate::nurbs::NurbsSurface;
use crate::patch::Adaptive;
use crate::pccm::{Chart, Layer, PccmError};
use crate::refine::TooDeep;
use bicubic::Bicubic;
use curvature::Curvature;
use measure::{Continuity, Moved};
use outline::{Face, Seams};
use quintic::Quintic;
use source::Source;

/// The greatest level that [`to_part`] tries when asked for a deviation, and accepts when asked for a level.
pub const DEEPEST_LEVEL: u32 = 6;

/// Whether regular quads are joined into large surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Packing {
    /// As few faces as rectangles of quads allow.
    #[default]
    Packed,
    /// One face per quad.
    Unpacked,
}

/// Which axis of the cage points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// Axes stay what they are.
    #[default]
    Z,
    /// The part is turned, `(x, y, z) -> (x, -z, y)`, so that `z` points up.
    Y,
}

impl UpAxis {
    /// Where a point of the cage is in the part.
    fn turn(self, p: Vec3) -> Vec3 {
        match self {
            UpAxis::Z => p,
            UpAxis::Y => Vec3::new(p.x, -p.z, p.y),
        }
    }
}

/// Choices of [`to_part`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The construction.
    pub method: Method,
    /// Refinements of every face before the conversion, of the method G2 the least level of all caps; `None` for the least that is
    /// right for each.
    pub level: Option<u32>,
    /// Raise the level until the measured deviation from the limit surface is below this length. With a `level` given
    /// nothing is raised: a larger deviation is then an error.
    pub max_deviation: Option<f64>,
    /// Join regular quads.
    pub packing: Packing,
    /// Edges of the cage, as pairs of vertices, that stay edges of the part: no packed face crosses them. Curves that end in
    /// a meeting, and everything straight on from them, stay edges in any case.
    pub seams: Vec<[u32; 2]>,
    /// What is done at vertices of valence 2 and poles, for which patches have no rule. Polar caps have two faces each where quads
    /// are packed.
    pub lens: lens::Options,
    /// Turn the part.
    pub up: UpAxis,
    /// Refuse a level that would need more than so many bytes; `None` for no limit.
    pub memory: Option<u64>,
}

/// Why a cage could not be converted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConvertError {
    /// The cage is no sound mesh.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// The method has no rule for it.
    #[error(transparent)]
    Pccm(#[from] PccmError),
    /// Something is in the way of a vertex of valence 2.
    #[error(transparent)]
    Lens(LensError),
    /// Refinement should have made regular faces and caps of it, and did not.
    #[error("face {face} stays irregular however often it is refined; use the method pccm")]
    Irregular {
        /// The face.
        face: FaceId,
    },
    /// The quintic method is for cages without a boundary, and a cap leaves one.
    #[error(
        "bi5 has no patches beside caps, as around vertex {vertex}; use the method pccm, or merge its lens"
    )]
    Cap {
        /// The lens or pole.
        vertex: VertexId,
    },
    /// The quintic method has no patches where curves meet.
    #[error("bi5 has no patches where curves meet, as at vertex {vertex}; use the method pccm")]
    Meeting {
        /// The vertex.
        vertex: u32,
    },
    /// A seam that is no edge.
    #[error("the seam {}-{} is no edge of the cage", .vertices[0], .vertices[1])]
    Seam {
        /// What was asked for.
        vertices: [u32; 2],
    },
    /// It does not fit.
    #[error(transparent)]
    TooDeep(#[from] TooDeep),
    /// Patches would not fit, on no level that there could be.
    #[error(
        "{patches} patches take some {bytes} bytes, more than the {allowed} that may be used; ask for a smaller level or allow a larger deviation, or more memory"
    )]
    Memory {
        /// How many there would be.
        patches: u64,
        /// About what they take.
        bytes: u64,
        /// What is allowed.
        allowed: u64,
    },
    /// All faces are holes, or touch a boundary that is left out.
    #[error("no face of the cage is part of the surface")]
    NoSurface,
    /// A level beyond what is supported.
    #[error("level {level} is too high, {DEEPEST_LEVEL} is the most")]
    LevelTooHigh {
        /// What was asked for.
        level: u32,
    },
    /// The deviation asked for is not reached.
    #[error("the deviation is {reached:.3e} at level {level}, not below {wanted:.3e}")]
    Deviation {
        /// What was asked for.
        wanted: f64,
        /// What was measured.
        reached: f64,
        /// On which level.
        level: u32,
    },
}

impl From<LensError> for ConvertError {
    fn from(error: LensError) -> ConvertError {
        match error {
            LensError::Mesh(error) => ConvertError::Topology(error),
            _ => ConvertError::Lens(error),
        }
    }
}

impl ConvertError {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            ConvertError::Topology(error) => error.defects[0].code(),
            ConvertError::Pccm(error) => error.code(),
            ConvertError::Lens(error) => error.code(),
            ConvertError::Irregular { .. } => "irregular",
            ConvertError::Cap { .. } => "cap",
            ConvertError::Meeting { .. } => "meeting",
            ConvertError::Seam { .. } => "seam",
            ConvertError::TooDeep(_) => "too_deep",
            ConvertError::Memory { .. } => "too_deep",
            ConvertError::NoSurface => "no_surface",
            ConvertError::LevelTooHigh { .. } => "level_too_high",
            ConvertError::Deviation { .. } => "deviation",
        }
    }
}

/// Converts a cage to solids and sheets of smooth NURBS faces.
///
/// ```
/// use ogee::{convert, shapes};
/// let part = convert::to_part(&shapes::cube(), &convert::Options::default())?;
/// assert_eq!((part.report.solids, part.report.faces_written), (1, 6));
/// assert!(part.report.max_normal_angle_deg < 1e-9);
/// # Ok::<(), convert::ConvertError>(())
/// ```
///
/// # Errors
/// If the cage has defects, a vertex that the method has no rule for, or asks for more than a level can give.
pub fn to_part(mesh: &ControlMesh, options: &Options) -> Result<Part, ConvertError> {
    let source = Source::new(mesh, options)?;
    if let (Method::Bi5, Some(&Meeting { vertex, .. })) = (options.method, mesh.meetings.first()) {
        return Err(ConvertError::Meeting { vertex });
    }
    if source.caps.is_empty() && source.adaptive.last().visible_faces().next().is_none() {
        return Err(ConvertError::NoSurface);
    }
    if let Some(level) = options.level.filter(|&level| level > DEEPEST_LEVEL) {
        return Err(ConvertError::LevelTooHigh { level });
    }
    let construction = match options.method {
        Method::Pccm => Construction::Bicubic(Bicubic::new(&source, Layer::Second, options)?),
        Method::PccmFirst => Construction::Bicubic(Bicubic::new(&source, Layer::First, options)?),
        Method::Bi5 => Construction::Quintic(Quintic::new(&source, options)?),
        Method::G2 => Construction::Curvature(Curvature::new(&source, options)?),
    };
    Ok(finish(&source, construction, options, mesh))
}

/// A cage in patches.
enum Construction<'a> {
    Bicubic(Bicubic<'a>),
    Quintic(Quintic),
    Curvature(Curvature<'a>),
}

/// A chart of a level of refinement, with its surface, one unit of knot per quad.
struct PlacedChart {
    level: usize,
    chart: Chart,
    surface: NurbsSurface,
}

impl Construction<'_> {
    fn faces_by_level(&self) -> Vec<LevelFaces> {
        match self {
            Construction::Bicubic(bicubic) => bicubic.faces_by_level(),
            Construction::Quintic(quintic) => quintic.faces_by_level(),
            Construction::Curvature(curvature) => curvature.faces_by_level(),
        }
    }

    fn level(&self) -> u32 {
        let greatest = |of: fn(&LevelFaces) -> u32| self.faces_by_level().iter().map(of).max().unwrap_or(0);
        match self {
            Construction::Curvature(_) => greatest(|faces| faces.steps),
            Construction::Bicubic(_) | Construction::Quintic(_) => greatest(|faces| faces.level),
        }
    }

    fn deviation(&self) -> f64 {
        match self {
            Construction::Bicubic(bicubic) => bicubic.deviation(),
            Construction::Quintic(quintic) => quintic.deviation(),
            Construction::Curvature(curvature) => curvature.deviation(),
        }
    }

    fn adaptive(&self) -> &Adaptive {
        match self {
            Construction::Bicubic(bicubic) => bicubic.adaptive(),
            Construction::Quintic(quintic) => quintic.adaptive(),
            Construction::Curvature(curvature) => curvature.adaptive(),
        }
    }

    /// All charts; to be asked for once.
    fn take_charts(&mut self, packing: Packing) -> Vec<PlacedChart> {
        match self {
            Construction::Bicubic(bicubic) => bicubic.take_charts(),
            Construction::Quintic(quintic) => quintic.charts(),
            Construction::Curvature(curvature) => curvature.charts(packing),
        }
    }

    /// The most bytes that were to be needed.
    fn memory(&self) -> u64 {
        match self {
            Construction::Bicubic(bicubic) => bicubic.memory(),
            Construction::Quintic(quintic) => quintic.memory(),
            Construction::Curvature(curvature) => curvature.memory(),
        }
    }

    fn nodes(&self) -> &[Node] {
        match self {
            Construction::Curvature(curvature) => curvature.nodes(),
            Construction::Bicubic(_) | Construction::Quintic(_) => &[],
        }
    }

    /// Halfedges of a level whose edge is not smooth next to their origin.
    fn broken(&self) -> Vec<(usize, HalfedgeId)> {
        match self {
            Construction::Bicubic(bicubic) => bicubic.broken(),
            Construction::Curvature(curvature) => curvature.broken(),
            Construction::Quintic(_) => Vec::new(),
        }
    }

    /// In terms of the cage that was given.
    fn notes(&self) -> Vec<Note> {
        match self {
            Construction::Bicubic(bicubic) => bicubic.notes(),
            Construction::Curvature(curvature) => curvature.notes(),
            Construction::Quintic(_) => Vec::new(),
        }
    }
}

/// Share of the cube of the cage's size below which a closed part encloses nothing.
const NO_VOLUME: f64 = 1e-12;

/// Sews, sorts, measures, and moves the part back to where the cage was.
fn finish(
    source: &Source,
    mut construction: Construction<'_>,
    options: &Options,
    mesh: &ControlMesh,
) -> Part {
    let (deviation, faces_by_level) = (construction.deviation(), construction.faces_by_level());
    let mut all_notes = notes(mesh);
    all_notes.extend(construction.notes());
    all_notes.extend(source.refined_for_lenses());
    let charts = construction.take_charts(options.packing);
    let mut sewing = Seams::new(construction.adaptive());
    for PlacedChart { level, chart, .. } in &charts {
        sewing.divide(*level, chart.quads.cells().iter().map(|placed| FaceId(placed.quad)));
    }
    construction.broken().into_iter().for_each(|(level, h)| sewing.break_at(level, h));
    let patches: usize = charts.iter().map(|placed| placed.chart.quads.cells().len()).sum();
    let face = |PlacedChart { level, chart, surface }| sewing.chart(level, &chart, surface);
    let mut faces: Vec<Face> = charts.into_iter().map(face).collect();
    let charts = faces.len();
    for cap in &source.caps {
        faces.extend(sewing.cap(cap));
    }
    let spans = |face: &Face| face.surface.u.spans().count() * face.surface.v.spans().count();
    let cap_patches: usize = faces[charts..].iter().map(spans).sum();
    let shells = sew::sew(&sewing, faces);
    let mut bodies = bodies::bodies(shells, &mut all_notes);

    for body in &mut bodies {
        body.shells_mut().for_each(|shell| shell.translate(source.centre));
    }

    let mut continuity = Continuity::default();
    let (mut volume, mut area) = (0.0, 0.0);
    let mut extent: Option<[Vec3; 2]> = None;
    let mut report = Report {
        method: options.method,
        level: construction.level(),
        faces_by_level,
        cage_faces: source.cage_faces,
        patches: patches + cap_patches,
        nodes: construction.nodes().to_vec(),
        lenses: source.lenses.clone(),
        lens_steps: source.steps,
        memory: construction.memory(),
        max_deviation: deviation,
        max_deviation_relative: if source.size > 0.0 { deviation / source.size } else { 0.0 },
        closed: true,
        ..Report::default()
    };
    for body in &bodies {
        for (number, shell) in body.shells().enumerate() {
            // What is written is measured, its rounding far from the origin included, but measured near the origin.
            let near = Moved { shell, by: -source.centre };
            continuity = continuity.join(measure::continuity(near));
            let (own_volume, own_area) = measure::volume_and_area(near);
            volume += if number == 0 { own_volume } else { -own_volume };
            area += own_area;
            if let Some([low, high]) = measure::bounding_box(near) {
                extent = Some(extent.map_or([low, high], |[a, b]| [a.min(low), b.max(high)]));
            }
            report.faces_written += shell.faces.len();
            report.edges += shell.edges.len();
            report.vertices += shell.vertices.len();
            report.shells += 1;
        }
        match body {
            Body::Solid { .. } => report.solids += 1,
            Body::Sheet(_) => report.closed = false,
        }
    }
    if report.closed && volume.abs() <= NO_VOLUME * source.size.powi(3) {
        let message = "the part encloses no volume: its cage is flat, or one point".to_owned();
        all_notes.push(Note { code: "no_volume", message, place: None });
    }
    report.volume = report.closed.then_some(volume);
    report.area = area;
    report.bounding_box = extent.unwrap_or_default().map(|corner| corner + source.centre);
    report.max_gap = continuity.max_gap;
    report.max_normal_angle_deg = continuity.max_normal_angle.to_degrees();
    report.max_curvature_jump = continuity.max_curvature_jump * source.size;
    report.max_curvature_jump_absolute = continuity.max_curvature_jump;
    report.smooth_edges = continuity.smooth_edges;
    report.sharp_edges = continuity.sharp_edges;
    report.notes = all_notes;
    Part { bodies, report }
}
