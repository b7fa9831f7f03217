//! A cage made ready: turned, near the origin, its lenses seen to, and of quads.

use super::{ConvertError, Method, Options, Packing};
use crate::g2_caps::Uncapped;
use crate::lens::{self, Cap, PolarFaces, TreatedLens};
use crate::math::Vec3;
use crate::mesh::{ControlMesh, FaceId, HalfedgeId, Note, Place, Topology, VertexId};
use crate::patch::Adaptive;
use crate::pccm::PccmError;
use crate::rules::Level;

/// A cage made ready.
pub(super) struct Source {
    pub(super) centre: Vec3,
    /// Diagonal of the cage's bounding box.
    pub(super) size: f64,
    /// The cage, and its refinement where it has other polygons than quads.
    pub(super) adaptive: Adaptive,
    pub(super) cage_faces: usize,
    /// In terms of the cage as it was made ready.
    pub(super) caps: Vec<Cap>,
    /// Edges of that cage.
    pub(super) seams: Vec<[u32; 2]>,
    pub(super) lenses: Vec<TreatedLens>,
    /// Where vertices of the quads come from.
    pub(super) origins: lens::Origins,
    /// Refinements before that.
    pub(super) steps: u32,
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
    pub(super) fn new(mesh: &ControlMesh, options: &Options) -> Result<Source, ConvertError> {
        check_seams(mesh, &options.seams)?;
        let points: Vec<Vec3> = mesh.points.iter().map(|&p| options.up.turn(p)).collect();
        let first = points.first().copied().unwrap_or(Vec3::ZERO);
        let [low, high] = points.iter().fold([first, first], |[low, high], &p| [low.min(p), high.max(p)]);
        // Rounding grows with the distance from the origin.
        let centre = low.lerp(high, 0.5);
        let points = points.into_iter().map(|p| p - centre).collect();
        let treated = treated(&ControlMesh { points, ..mesh.clone() }, options)?;

        let topology = treated.level.topology();
        let is_quads = topology.is_quads();
        let origins = if is_quads { treated.origins } else { treated.origins.refined(topology) };
        let faces: Vec<FaceId> = (0..topology.face_count() as u32).map(FaceId).collect();
        let mut adaptive = Adaptive::new(treated.level, treated.mesh.points, treated.addresses);
        if !is_quads {
            adaptive.refine(&faces);
        }
        Ok(Source {
            centre,
            size: low.distance(high),
            adaptive,
            cage_faces: mesh.faces.len(),
            caps: treated.caps,
            seams: treated.edges,
            lenses: treated.lenses,
            origins,
            steps: treated.steps,
        })
    }

    /// The level whose faces are all quads, and its vertices.
    pub(super) fn quads(&self) -> (&Level, &[Vec3]) {
        let last = self.adaptive.last();
        (&last.level, &last.points)
    }

    /// The number of that level.
    pub(super) fn quads_level(&self) -> usize {
        self.adaptive.levels().len() - 1
    }

    /// The halfedges of a level along edges that are to stay edges.
    pub(super) fn seams(&self, adaptive: &Adaptive, number: usize) -> Vec<HalfedgeId> {
        let topology = adaptive.levels()[0].level.topology();
        let first = self.seams.iter().filter_map(|&vertices| find_halfedge(topology, vertices));
        let mut found: Vec<HalfedgeId> = first.collect();
        for number in 0..number {
            found = found.into_iter().filter_map(|h| adaptive.halves(number, h)).flatten().collect();
        }
        found
    }

    /// What refinement for the sake of lenses is worth saying.
    pub(super) fn refined_for_lenses(&self) -> Option<Note> {
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

    /// The cage alone, without the refinement that makes quads of all faces.
    pub(super) fn adaptive_cage(&self) -> Adaptive {
        self.adaptive.first_level()
    }

    /// A place of the cage that was made ready, in terms of the cage that was given.
    pub(super) fn place(&self, place: Place) -> Place {
        let nearest = |v: u32| self.origins.nearest(VertexId(v)).0;
        match place {
            Place::Vertex(v) => Place::Vertex(nearest(v)),
            Place::Edge(a, b) => Place::Edge(nearest(a), nearest(b)),
            Place::Face(face) => Place::Face(face),
        }
    }

    /// Why a sector has no cap, and what was done.
    pub(super) fn no_cap(&self, adaptive: &Adaptive, sector: &Uncapped) -> Note {
        let level = &adaptive.levels()[sector.level];
        let vertex = level.level.topology().origin(sector.halfedges[0]);
        let place = self.place(adaptive.origin(level.vertices[vertex.index()]));
        let why = sector.obstacle.to_string().replace(&format!("vertex {vertex} "), &format!("{place} "));
        let message = format!("{why}; its faces are smoothed by PCCM, so that curvature jumps there");
        Note { code: "no_cap", message, place: Some(place) }
    }

    /// A note about a vertex of the quads, in terms of the cage that was given.
    pub(super) fn told(&self, note: &Note) -> Note {
        let Some(Place::Vertex(vertex)) = note.place else { return note.clone() };
        let first = self.origins.nearest(VertexId(vertex)).0;
        let message = note.message.replace(&format!(" {vertex} "), &format!(" {first} "));
        Note { message, place: Some(Place::Vertex(first)), ..*note }
    }
}

/// A refusal in terms of the cage that was given.
pub(super) fn told(error: PccmError, origins: &lens::Origins) -> PccmError {
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
