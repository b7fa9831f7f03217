//! The whole journey from a cage to a part: which method takes which faces, packing, sewing, measuring.
//!
//! So that the command line, and whatever else calls it, make the same part from the same cage.

mod bodies;
mod curves;
mod deviation;
mod measure;
mod outline;
mod part;
mod sew;

pub use curves::largest_distance_to_edges;
pub use part::{Body, Method, Part, Report};

use crate::lens::{self, Cap, LensError, PolarFaces, TreatedLens};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{ControlMesh, HalfedgeId, Meeting, Note, Place, Topology, TopologyError, VertexId, notes};
use crate::nurbs::{FaceAddress, KnotVector, NurbsSurface};
use crate::pccm::{self, Chart, Layer, PccmError, Pieces, least_level, pack, unpacked};
use crate::refine::TooDeep;
use crate::rules::Level;
use deviation::{Measured, QuadCell};
use measure::Continuity;
use outline::{Face, Seams};

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
    /// Refinements before the conversion; `None` for the least that is right for the cage.
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
            ConvertError::Cap { .. } => "cap",
            ConvertError::Meeting { .. } => "meeting",
            ConvertError::Seam { .. } => "seam",
            ConvertError::TooDeep(_) => "too_deep",
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
    if source.caps.is_empty() && source.quads.hidden_faces().len() == source.quads.topology().face_count() {
        return Err(ConvertError::NoSurface);
    }
    let seams = source.seams();
    let least = source.least_level(options.method).map_err(|error| told(error, &source.origins))?;
    if let Some(level) = options.level.filter(|&level| level > DEEPEST_LEVEL) {
        return Err(ConvertError::LevelTooHigh { level });
    }
    let first = options.level.unwrap_or(least);
    let mut level = first;
    loop {
        check_memory(&source, options, level)?;
        let patches = Converted::new(&source, options.method, level)?;
        let deviation = patches.deviation();
        match options.max_deviation {
            Some(wanted) if deviation >= wanted && level < DEEPEST_LEVEL && options.level.is_none() => {
                level += 1
            }
            Some(wanted) if deviation >= wanted => {
                return Err(ConvertError::Deviation { wanted, reached: deviation, level });
            }
            _ => return Ok(finish(&source, patches, deviation, options, mesh, &seams)),
        }
    }
}

/// Asks whether the refined mesh and the coefficients of all patches fit.
fn check_memory(source: &Source, options: &Options, level: u32) -> Result<(), TooDeep> {
    source.quads.check_depth(level, u64::MAX)?;
    let quads = source.quads.topology().face_count() as u128;
    let bytes = |level: u32| match options.method {
        // Coefficients as inserted, as smoothed, as surfaces; nets of all levels; the refined mesh.
        Method::Pccm | Method::PccmFirst => {
            let side = (1u128 << level) + 7;
            quads * side * side * BYTES_PER_COEFFICIENT
        }
        Method::Bi5 => (quads << (2 * level)) * BYTES_PER_QUINTIC,
    };
    let memory = u128::from(options.memory.unwrap_or(u64::MAX));
    if bytes(level) <= memory {
        return Ok(());
    }
    let deepest = (0..level).rev().find(|&shallower| bytes(shallower) <= memory).unwrap_or(0);
    Err(TooDeep { depth: level, faces: quads << (2 * level), deepest })
}

/// Measured on studded tori of 10 000 and 100 000 quads at levels 2 to 5 (82 to 148), rounded up.
const BYTES_PER_COEFFICIENT: u128 = 160;

/// Measured on Spot at levels 0 to 2, rounded up: the patch itself is a small part of it, the refined mesh that it is
/// measured against the larger.
const BYTES_PER_QUINTIC: u128 = 32_000;

/// A cage made ready: turned, near the origin, of quads.
struct Source {
    centre: Vec3,
    /// Diagonal of the cage's bounding box.
    size: f64,
    quads: Level,
    points: Vec<Vec3>,
    /// The cage itself, where its quads are those of its refinement.
    cage: Option<Level>,
    /// For each quad the piece of the cage that it is.
    addresses: Vec<FaceAddress>,
    cage_faces: usize,
    /// In terms of the cage as it was made ready.
    caps: Vec<Cap>,
    /// Edges of that cage.
    seams: Vec<[u32; 2]>,
    lenses: Vec<TreatedLens>,
    /// Where vertices of the quads come from.
    origins: lens::Origins,
    /// Refinements before that.
    steps: u32,
}

/// A cage without vertices that patches have no rule for, as far as that is wanted.
fn treated(mesh: &ControlMesh, options: &Options) -> Result<lens::Treated, ConvertError> {
    let mut choices = options.lens;
    if options.packing == Packing::Unpacked {
        choices.faces = PolarFaces::PerSector;
    }
    if options.method == Method::Bi5 && choices.method == lens::Method::Auto {
        choices.method = lens::Method::Merge;
    }
    let treated = lens::treat_following(mesh, &choices, &options.seams, options.memory.unwrap_or(u64::MAX))?;
    let capped = treated.lenses.iter().find(|lens| lens.has_cap());
    match capped {
        Some(&TreatedLens { vertex, .. }) if options.method == Method::Bi5 => {
            Err(ConvertError::Cap { vertex })
        }
        _ => Ok(treated),
    }
}

fn check_seams(mesh: &ControlMesh, seams: &[[u32; 2]]) -> Result<(), ConvertError> {
    if seams.is_empty() {
        return Ok(());
    }
    let topology = Topology::new(mesh)?;
    let is_edge = |&vertices: &[u32; 2]| {
        vertices.iter().all(|&v| (v as usize) < topology.vertex_count())
            && find_halfedge(&topology, vertices).is_some()
    };
    match seams.iter().copied().find(|vertices| !is_edge(vertices)) {
        Some(vertices) => Err(ConvertError::Seam { vertices }),
        None => Ok(()),
    }
}

/// The halfedge between two vertices, in either direction.
fn find_halfedge(topology: &Topology, [a, b]: [u32; 2]) -> Option<HalfedgeId> {
    let leaves =
        |from: u32, to: u32| topology.ring(VertexId(from)).find(|&h| topology.target(h) == VertexId(to));
    leaves(a, b).or_else(|| leaves(b, a))
}

impl Source {
    fn new(mesh: &ControlMesh, options: &Options) -> Result<Source, ConvertError> {
        check_seams(mesh, &options.seams)?;
        let points: Vec<Vec3> = mesh.points.iter().map(|&p| options.up.turn(p)).collect();
        let first = points.first().copied().unwrap_or(Vec3::ZERO);
        let [low, high] = points.iter().fold([first, first], |[low, high], &p| [low.min(p), high.max(p)]);
        // Rounding grows with the distance from the origin.
        let centre = low.lerp(high, 0.5);
        let points = points.into_iter().map(|p| p - centre).collect();
        let treated = treated(&ControlMesh { points, ..mesh.clone() }, options)?;

        let cage = treated.level;
        let mut source = Source {
            centre,
            size: low.distance(high),
            cage_faces: mesh.faces.len(),
            addresses: treated.addresses,
            points: treated.mesh.points,
            quads: cage.clone(),
            cage: None,
            caps: treated.caps,
            seams: treated.edges,
            lenses: treated.lenses,
            origins: treated.origins,
            steps: treated.steps,
        };
        let topology = cage.topology();
        if !topology.is_quads() {
            let halfedges = (0..topology.halfedge_count() as u32).map(HalfedgeId);
            let corners = halfedges.map(|h| {
                let face = topology.face(h);
                let whole = source.addresses[face.index()];
                whole.quarter(h.0 - topology.first(face).0)
            });
            source.addresses = corners.collect();
            source.origins = source.origins.refined(topology);
            (source.quads, source.points) = cage.refine_points(&source.points);
            source.cage = Some(cage);
        }
        Ok(source)
    }

    /// Refinements from the cage with its caps to the quads.
    fn cap_steps(&self) -> u32 {
        u32::from(self.cage.is_some())
    }

    /// The halfedges of the quads along edges of the cage.
    fn seams(&self) -> Vec<HalfedgeId> {
        let topology = self.cage.as_ref().unwrap_or(&self.quads).topology();
        let found = self.seams.iter().filter_map(|&vertices| find_halfedge(topology, vertices));
        if self.cage.is_none() {
            return found.collect();
        }
        // The two halves: the first side of quad h, and the last of the quad after it.
        found.flat_map(|h| [HalfedgeId(4 * h.0), HalfedgeId(4 * topology.next(h).0 + 3)]).collect()
    }

    /// What refinement for the sake of lenses is worth saying.
    fn refined_for_lenses(&self) -> Option<Note> {
        let vertex = self.lenses.first().filter(|_| self.steps > 0)?.vertex;
        let times = match self.steps {
            1 => "once".to_owned(),
            steps => format!("{steps} times"),
        };
        let message = format!(
            "the cage was refined {times}, to make room around vertices of valence 2 such as {vertex}"
        );
        Some(Note { code: "lens_refined", message, place: Some(Place::Vertex(vertex.0)) })
    }

    fn least_level(&self, method: Method) -> Result<u32, PccmError> {
        Ok(match method {
            Method::Pccm => least_level(&self.quads, Layer::Second)?.level,
            Method::PccmFirst => least_level(&self.quads, Layer::First)?.level,
            Method::Bi5 => 0,
        })
    }

    /// A note about a vertex of the quads, in terms of the cage that was given.
    fn told(&self, note: &Note) -> Note {
        let Some(Place::Vertex(vertex)) = note.place else { return note.clone() };
        let first = self.origins.nearest(VertexId(vertex)).0;
        let message = note.message.replace(&format!(" {vertex} "), &format!(" {first} "));
        Note { message, place: Some(Place::Vertex(first)), ..*note }
    }
}

/// A refusal in terms of the cage that was given.
fn told(error: PccmError, origins: &lens::Origins) -> PccmError {
    let edge = |a, b| origins.edge(a, b).unwrap_or([a, b].map(|v| origins.nearest(v)));
    match error {
        PccmError::Lens { vertex } => PccmError::Lens { vertex: origins.nearest(vertex) },
        PccmError::SharpVertex { vertex } => PccmError::SharpVertex { vertex: origins.nearest(vertex) },
        PccmError::SharpEdge { a, b } => {
            let [a, b] = edge(a, b);
            PccmError::SharpEdge { a, b }
        }
        PccmError::TooSharp { place: Place::Edge(a, b), sharpness } => {
            let [a, b] = edge(VertexId(a), VertexId(b));
            PccmError::TooSharp { place: Place::Edge(a.0, b.0), sharpness }
        }
        PccmError::TooSharp { place: Place::Vertex(vertex), sharpness } => {
            let place = Place::Vertex(origins.nearest(VertexId(vertex)).0);
            PccmError::TooSharp { place, sharpness }
        }
        // These name nothing, or a face, and all faces are quads by now.
        error @ (PccmError::LevelTooLow { .. } | PccmError::NotQuads { .. } | PccmError::TooSharp { .. }) => {
            error
        }
    }
}

/// Patches of all quads, by whichever method.
struct Converted<'a> {
    level: u32,
    base: std::borrow::Cow<'a, Level>,
    points: std::borrow::Cow<'a, [Vec3]>,
    /// For each quad of the base that of the source.
    source_quads: Vec<u32>,
    /// One per quad of the base, in cells.
    surfaces: Vec<NurbsSurface>,
    kind: Kind,
}

enum Kind {
    Bicubic { patches: pccm::Patches, layer: Layer },
    Quintic,
}

impl<'a> Converted<'a> {
    fn new(source: &'a Source, method: Method, level: u32) -> Result<Converted<'a>, ConvertError> {
        use std::borrow::Cow;
        let layer = match method {
            Method::Pccm => Layer::Second,
            Method::PccmFirst => Layer::First,
            Method::Bi5 => return Converted::quintic(source, level),
        };
        let options = pccm::Options { layer, level, ..pccm::Options::default() };
        let patches = pccm::to_patches(&source.quads, &source.points, &options)
            .map_err(|error| told(error, &source.origins))?;
        let surface = |net: &Grid<Vec3>| NurbsSurface {
            u: patches.knots.clone(),
            v: patches.knots.clone(),
            net: net.clone(),
        };
        let mut surfaces: Vec<NurbsSurface> = patches.nets.iter().map(surface).collect();
        if !patches.caps.is_empty() {
            let pieces = Pieces::new(&source.quads, &source.points, &patches, layer);
            for cap in &patches.caps {
                surfaces[cap.quad as usize] = pieces.in_cells(cap.quad);
            }
        }
        Ok(Converted {
            level,
            base: Cow::Borrowed(&source.quads),
            points: Cow::Borrowed(&source.points),
            source_quads: (0..patches.nets.len() as u32).collect(),
            surfaces,
            kind: Kind::Bicubic { patches, layer },
        })
    }

    /// A quintic has no inner knots: a level means more patches.
    fn quintic(source: &'a Source, level: u32) -> Result<Converted<'a>, ConvertError> {
        use std::borrow::Cow;
        let (mut base, mut points) = (Cow::Borrowed(&source.quads), Cow::Borrowed(&source.points[..]));
        let mut origins = source.origins.clone();
        for _ in 0..level {
            origins = origins.refined(base.topology());
            let (next, next_points) = base.refine_points(&points);
            (base, points) = (Cow::Owned(next), Cow::Owned(next_points));
        }
        let nets = pccm::to_quintic_patches(&base, &points).map_err(|error| told(error, &origins))?;
        let knots = KnotVector::from_multiplicities(5, [(0.0, 6), (1.0, 6)]);
        let surfaces = nets.into_iter().map(|net| NurbsSurface { u: knots.clone(), v: knots.clone(), net });
        let source_quads = (0..base.topology().face_count() as u32).map(|quad| quad >> (2 * level)).collect();
        Ok(Converted { level, surfaces: surfaces.collect(), source_quads, base, points, kind: Kind::Quintic })
    }

    fn deviation(&self) -> f64 {
        let (level, cells, steps_more): (u32, Vec<QuadCell>, u32) = match &self.kind {
            Kind::Bicubic { patches, .. } => {
                (self.level, deviation::changed_cells(&self.base, self.level, &patches.classes), 0)
            }
            Kind::Quintic => (0, deviation::all_cells(&self.base, 0), 1),
        };
        let measured = Measured { base: &self.base, points: &self.points, level, surfaces: &self.surfaces };
        deviation::largest_deviation(&measured, &cells, steps_more)
    }

    /// Charts with their surfaces, in quads.
    fn charts(&self, packing: Packing, seams: &[HalfedgeId]) -> Vec<(Chart, NurbsSurface)> {
        let Kind::Bicubic { patches, layer } = &self.kind else {
            let charts = unpacked(&self.base);
            let surface = |chart: &Chart| self.surfaces[chart.quads[(0, 0)].quad as usize].clone();
            let surfaces: Vec<NurbsSurface> = charts.iter().map(surface).collect();
            return charts.into_iter().zip(surfaces).collect();
        };
        let charts = match packing {
            Packing::Packed => pack(&self.base, &patches.classes, seams),
            Packing::Unpacked => unpacked(&self.base),
        };
        let pieces = Pieces::new(&self.base, &self.points, patches, *layer);
        let surfaces = par::map(charts.len(), |chart| pieces.surface(&charts[chart]));
        charts.into_iter().zip(surfaces).collect()
    }

    /// The piece of the cage that a quad of the base is. A quintic base that was refined has a patch per quarter.
    fn address(&self, source: &Source, quad: u32) -> FaceAddress {
        let whole = source.addresses[self.source_quads[quad as usize] as usize];
        let steps = match self.kind {
            Kind::Quintic => self.level,
            Kind::Bicubic { .. } => 0,
        };
        (0..steps).rev().fold(whole, |piece, step| piece.quarter(quad >> (2 * step) & 3))
    }

    fn broken(&self) -> &[HalfedgeId] {
        match &self.kind {
            Kind::Bicubic { patches, .. } => &patches.broken,
            Kind::Quintic => &[],
        }
    }

    fn notes(&self) -> &[Note] {
        match &self.kind {
            Kind::Bicubic { patches, .. } => &patches.notes,
            Kind::Quintic => &[],
        }
    }
}

/// Share of the cube of the cage's size below which a closed part encloses nothing.
const NO_VOLUME: f64 = 1e-12;

/// Sews, sorts, measures, and moves the part back to where the cage was.
fn finish(
    source: &Source,
    patches: Converted<'_>,
    deviation: f64,
    options: &Options,
    mesh: &ControlMesh,
    seams: &[HalfedgeId],
) -> Part {
    let mut all_notes = notes(mesh);
    all_notes.extend(patches.notes().iter().map(|note| source.told(note)));
    all_notes.extend(source.refined_for_lenses());
    let address = |quad: u32| patches.address(source, quad);
    let mut sewing = Seams::new(&patches.base, patches.broken());
    let charts = patches.charts(options.packing, seams);
    let mut faces: Vec<Face> =
        charts.into_iter().map(|(chart, surface)| sewing.chart(&chart, surface, address)).collect();
    let charts = faces.len();
    for cap in &source.caps {
        faces.extend(sewing.cap(cap, source.cap_steps()));
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
        level: patches.level,
        cage_faces: source.cage_faces,
        patches: patches.surfaces.len() - patches.base.hidden_faces().len() + cap_patches,
        lenses: source.lenses.clone(),
        lens_steps: source.steps,
        max_deviation: deviation,
        max_deviation_relative: if source.size > 0.0 { deviation / source.size } else { 0.0 },
        closed: true,
        ..Report::default()
    };
    for body in &bodies {
        for (number, shell) in body.shells().enumerate() {
            // What is written is measured, its rounding far from the origin included, but measured near the origin.
            let mut near = shell.clone();
            near.translate(-source.centre);
            continuity = continuity.join(measure::continuity(&near));
            let (own_volume, own_area) = measure::volume_and_area(&near);
            volume += if number == 0 { own_volume } else { -own_volume };
            area += own_area;
            if let Some([low, high]) = measure::bounding_box(&near) {
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
    report.smooth_edges = continuity.smooth_edges;
    report.sharp_edges = continuity.sharp_edges;
    report.notes = all_notes;
    Part { bodies, report }
}
