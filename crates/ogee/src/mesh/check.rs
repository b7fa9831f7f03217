//! Every defect a control mesh can have, and what is worth a note.

use super::meetings::check_meetings;
use super::topology::NONE;
use super::{ControlMesh, FaceId, HalfedgeId, LensShape, Topology, VertexId};

/// Why a control mesh was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("control mesh refused, defects: {}, the first: {}", .defects.len(), .defects[0])]
pub struct TopologyError {
    /// All defects that were found; never empty.
    pub defects: Vec<Defect>,
}

/// Something that keeps a mesh from being an oriented manifold surface with meaningful tags.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum Defect {
    #[error("the cage has no faces")]
    NoFaces,
    #[error("face {face} has {corners} corners, fewer than three")]
    FaceTooSmall { face: FaceId, corners: u32 },
    #[error("face {face} names vertex {vertex}, but there are only {count}")]
    MissingVertex { face: FaceId, vertex: u32, count: u32 },
    #[error("face {face} names vertex {vertex} more than once")]
    RepeatedVertex { face: FaceId, vertex: VertexId },
    #[error("edge {a}-{b} belongs to {faces} faces; split the mesh there")]
    NonManifoldEdge { a: VertexId, b: VertexId, faces: u32 },
    #[error("faces {face} and {neighbour} run the same way along edge {a}-{b}; flip one of them")]
    FlippedFace { face: FaceId, neighbour: FaceId, a: VertexId, b: VertexId },
    #[error("vertex {vertex} joins {fans} separate fans of faces; give each fan a vertex of its own")]
    NonManifoldVertex { vertex: VertexId, fans: u32 },
    #[error("vertex {vertex} has a coordinate that is no finite number")]
    NotFinite { vertex: VertexId },
    #[error("crease {a}-{b} names no edge of the mesh")]
    CreaseOffEdge { a: u32, b: u32 },
    #[error("corner tag names vertex {vertex}, but there are only {count}")]
    CornerOffVertex { vertex: u32, count: u32 },
    #[error("hole tag names face {face}, but there are only {count}")]
    HoleOffFace { face: u32, count: u32 },
    #[error("meeting names vertex {vertex}, but there are only {count}")]
    MeetingOffVertex { vertex: u32, count: u32 },
    #[error("meeting of curves at vertex {vertex}: {message}")]
    Meeting { vertex: u32, message: String },
    #[error("a sharpness at vertex {vertex} is not a number")]
    SharpnessNotANumber { vertex: u32 },
    #[error(
        "the lens shape beta {beta}, gamma {gamma} gives no tangent plane at vertices of valence 2; choose beta > 0, \
         gamma >= 0, beta + gamma <= 1, 2 beta + 4 gamma > 1 and 6 beta + 4 gamma < 5, as 1/2 and 1/8"
    )]
    LensShape { beta: f64, gamma: f64 },
    #[error("texture coordinates: {message}")]
    FaceVarying { message: String },
    #[error("the mesh has {halfedges} face corners; 2^32 - 2 is the most")]
    TooManyElements { halfedges: usize },
}

/// A place in a cage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A vertex.
    Vertex(u32),
    /// An edge, by its ends.
    Edge(u32, u32),
    /// A face.
    Face(u32),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Place::Edge(a, b) => write!(f, "edge {a}-{b}"),
            Place::Face(face) => write!(f, "face {face}"),
        }
    }
}

impl Defect {
    /// A stable name in snake case, the `code` of the command line's JSON.
    pub fn code(&self) -> &'static str {
        match self {
            Defect::NoFaces => "no_faces",
            Defect::FaceTooSmall { .. } => "face_too_small",
            Defect::MissingVertex { .. } => "missing_vertex",
            Defect::RepeatedVertex { .. } => "repeated_vertex",
            Defect::NonManifoldEdge { .. } => "non_manifold_edge",
            Defect::FlippedFace { .. } => "flipped_face",
            Defect::NonManifoldVertex { .. } => "non_manifold_vertex",
            Defect::NotFinite { .. } => "not_finite",
            Defect::CreaseOffEdge { .. } => "crease_off_edge",
            Defect::CornerOffVertex { .. } => "corner_off_vertex",
            Defect::HoleOffFace { .. } => "hole_off_face",
            Defect::MeetingOffVertex { .. } => "meeting_off_vertex",
            Defect::Meeting { .. } => "meeting",
            Defect::SharpnessNotANumber { .. } => "sharpness_not_a_number",
            Defect::LensShape { .. } => "lens_shape",
            Defect::FaceVarying { .. } => "face_varying",
            Defect::TooManyElements { .. } => "too_many_elements",
        }
    }

    /// Where it is; `None` if it concerns the whole mesh.
    pub fn place(&self) -> Option<Place> {
        match *self {
            Defect::NoFaces
            | Defect::TooManyElements { .. }
            | Defect::LensShape { .. }
            | Defect::FaceVarying { .. } => None,
            Defect::FaceTooSmall { face, .. }
            | Defect::MissingVertex { face, .. }
            | Defect::RepeatedVertex { face, .. } => Some(Place::Face(face.0)),
            Defect::NonManifoldEdge { a, b, .. } | Defect::FlippedFace { a, b, .. } => {
                Some(Place::Edge(a.0, b.0))
            }
            Defect::NonManifoldVertex { vertex, .. } | Defect::NotFinite { vertex } => {
                Some(Place::Vertex(vertex.0))
            }
            Defect::CreaseOffEdge { a, b } => Some(Place::Edge(a, b)),
            Defect::CornerOffVertex { vertex, .. }
            | Defect::MeetingOffVertex { vertex, .. }
            | Defect::Meeting { vertex, .. }
            | Defect::SharpnessNotANumber { vertex } => Some(Place::Vertex(vertex)),
            Defect::HoleOffFace { face, .. } => Some(Place::Face(face)),
        }
    }
}

/// Something worth knowing that is no error.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// A stable name in snake case.
    pub code: &'static str,
    /// For people.
    pub message: String,
    /// Where; `None` if it concerns the whole mesh.
    pub place: Option<Place>,
}

/// Every defect of a mesh, in the order faces, edges, vertices, tags. Costs its connectivity, and a sort of the edges where
/// that is faulty.
pub fn check(mesh: &ControlMesh) -> Vec<Defect> {
    match Topology::pair(mesh) {
        Some(topology) => check_tags(mesh, &topology),
        None => check_all(mesh),
    }
}

/// Every defect of a mesh whose faces or points are faulty.
pub(super) fn check_all(mesh: &ControlMesh) -> Vec<Defect> {
    let mut defects = Vec::new();
    if mesh.faces.is_empty() {
        defects.push(Defect::NoFaces);
    }
    let halfedges = mesh.faces.corners().len();
    if halfedges >= NONE as usize {
        defects.push(Defect::TooManyElements { halfedges });
        return defects;
    }
    let sound = check_faces(mesh, &mut defects);
    check_edges(mesh, &sound, &mut defects);
    for (v, p) in mesh.points.iter().enumerate() {
        if !p.is_finite() {
            defects.push(Defect::NotFinite { vertex: VertexId(v as u32) });
        }
    }
    check_creases(mesh, edges_of(mesh), &mut defects);
    check_other_tags(mesh, &mut defects);
    defects
}

/// Every defect of a mesh whose faces and points are sound.
pub(crate) fn check_tags(mesh: &ControlMesh, topology: &Topology) -> Vec<Defect> {
    let mut defects = Vec::new();
    let vertices = topology.vertex_count() as u32;
    let is_edge = |[a, b]: [u32; 2]| a < vertices && topology.find_edge([VertexId(a), VertexId(b)]).is_some();
    check_creases(mesh, is_edge, &mut defects);
    check_other_tags(mesh, &mut defects);
    if !mesh.meetings.is_empty() && defects.is_empty() {
        check_meetings(mesh, &mut defects);
    }
    defects
}

/// Looks at each face on its own; says which are fit to be looked at further.
fn check_faces(mesh: &ControlMesh, defects: &mut Vec<Defect>) -> Vec<bool> {
    let count = mesh.points.len() as u32;
    let mut sound = vec![true; mesh.faces.len()];
    let mut sorted = Vec::new();
    for (f, corners) in mesh.faces.iter().enumerate() {
        let face = FaceId(f as u32);
        let before = defects.len();
        if corners.len() < 3 {
            defects.push(Defect::FaceTooSmall { face, corners: corners.len() as u32 });
        }
        defects.extend(corners.iter().filter(|&&v| v >= count).map(|&vertex| Defect::MissingVertex {
            face,
            vertex,
            count,
        }));
        sorted.clear();
        sorted.extend_from_slice(corners);
        sorted.sort_unstable();
        let mut last = None;
        for pair in sorted.windows(2).filter(|pair| pair[0] == pair[1]) {
            if last != Some(pair[0]) {
                defects.push(Defect::RepeatedVertex { face, vertex: VertexId(pair[0]) });
                last = Some(pair[0]);
            }
        }
        sound[f] = defects.len() == before;
    }
    sound
}

/// Edges with more than two faces or with two that run the same way, then vertices where fans meet.
fn check_edges(mesh: &ControlMesh, sound: &[bool], defects: &mut Vec<Defect>) {
    // One entry per halfedge of a sound face: ends in order, the face, and whether it runs upward.
    let mut sides: Vec<(u32, u32, u32, bool)> = Vec::new();
    for (f, corners) in mesh.faces.iter().enumerate().filter(|&(f, _)| sound[f]) {
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            sides.push((a.min(b), a.max(b), f as u32, a < b));
        }
    }
    sides.sort_unstable();
    let before = defects.len();
    for edge in sides.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        let (a, b) = (VertexId(edge[0].0), VertexId(edge[0].1));
        match edge {
            [first, second] if first.3 == second.3 => {
                defects.push(Defect::FlippedFace { face: FaceId(second.2), neighbour: FaceId(first.2), a, b })
            }
            [_] | [_, _] => {}
            many => defects.push(Defect::NonManifoldEdge { a, b, faces: many.len() as u32 }),
        }
    }
    if defects.len() == before {
        check_fans(mesh, sound, defects);
    }
}

/// Vertices whose faces do not form one fan; asked only when all edges are sound.
fn check_fans(mesh: &ControlMesh, sound: &[bool], defects: &mut Vec<Defect>) {
    let mut faces = super::FaceList::new();
    for (_, corners) in mesh.faces.iter().enumerate().filter(|&(f, _)| sound[f]) {
        faces.push(corners);
    }
    let topology = Topology::of_part(&faces, mesh.points.len());
    let mut outgoing: Vec<(u32, u32)> =
        faces.corners().iter().enumerate().map(|(h, &v)| (v, h as u32)).collect();
    outgoing.sort_unstable();
    let mut seen = vec![false; topology.halfedge_count()];
    for fan in outgoing.chunk_by(|x, y| x.0 == y.0) {
        let mut fans = 0;
        // Open fans first, from their clockwise ends; what is left then are closed ones.
        let open = fan.iter().filter(|&&(_, h)| topology.twin(HalfedgeId(h)).is_none());
        for &(_, start) in open.chain(fan) {
            if seen[start as usize] {
                continue;
            }
            fans += 1;
            let mut around = Some(HalfedgeId(start));
            while let Some(h) = around.filter(|h| !seen[h.index()]) {
                seen[h.index()] = true;
                around = topology.twin(topology.prev(h));
            }
        }
        if fans > 1 {
            defects.push(Defect::NonManifoldVertex { vertex: VertexId(fan[0].0), fans });
        }
    }
}

/// The edges of a mesh of any faces, by their ends in either order.
fn edges_of(mesh: &ControlMesh) -> impl Fn([u32; 2]) -> bool + use<> {
    let mut edges: Vec<(u32, u32)> = Vec::new();
    if !mesh.creases.is_empty() {
        edges.reserve(mesh.faces.corners().len());
        for corners in mesh.faces.iter() {
            for (k, &a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                edges.push((a.min(b), a.max(b)));
            }
        }
        edges.sort_unstable();
    }
    move |[a, b]| edges.binary_search(&(a.min(b), a.max(b))).is_ok()
}

/// Creases that name no edge, or whose sharpness is no number.
fn check_creases(mesh: &ControlMesh, is_edge: impl Fn([u32; 2]) -> bool, defects: &mut Vec<Defect>) {
    for crease in &mesh.creases {
        let [a, b] = crease.vertices;
        if !is_edge([a, b]) {
            defects.push(Defect::CreaseOffEdge { a, b });
        }
        if crease.sharpness.value().is_nan() {
            defects.push(Defect::SharpnessNotANumber { vertex: a });
        }
    }
}

/// Other tags that name what is not there, sharpness that is no number, rules that have no limit worth having.
fn check_other_tags(mesh: &ControlMesh, defects: &mut Vec<Defect>) {
    let count = mesh.points.len() as u32;
    for corner in &mesh.corners {
        if corner.vertex >= count {
            defects.push(Defect::CornerOffVertex { vertex: corner.vertex, count });
        }
        if corner.sharpness.value().is_nan() {
            defects.push(Defect::SharpnessNotANumber { vertex: corner.vertex });
        }
    }
    for meeting in mesh.meetings.iter().filter(|meeting| meeting.vertex >= count) {
        defects.push(Defect::MeetingOffVertex { vertex: meeting.vertex, count });
    }
    let count = mesh.faces.len() as u32;
    defects
        .extend(mesh.holes.iter().filter(|&&f| f >= count).map(|&face| Defect::HoleOffFace { face, count }));
    let LensShape { beta, gamma } = mesh.scheme.lens;
    if !mesh.scheme.lens.is_smooth() {
        defects.push(Defect::LensShape { beta, gamma });
    }
    if let Some(uv) = &mesh.uv {
        if uv.indices.len() != mesh.faces.corners().len() {
            let message =
                format!("{} indices for {} face corners", uv.indices.len(), mesh.faces.corners().len());
            defects.push(Defect::FaceVarying { message });
        } else if let Some(&index) = uv.indices.iter().find(|&&i| i as usize >= uv.values.len()) {
            let message = format!("index {index}, but there are only {} values", uv.values.len());
            defects.push(Defect::FaceVarying { message });
        } else if let Some(i) = uv.values.iter().position(|v| v.iter().any(|x| !x.is_finite())) {
            defects.push(Defect::FaceVarying { message: format!("value {i} is no finite number") });
        }
    }
}

/// What is no defect but worth saying: vertices that no face uses.
pub fn notes(mesh: &ControlMesh) -> Vec<Note> {
    let mut used = vec![false; mesh.points.len()];
    for &v in mesh.faces.corners() {
        if let Some(flag) = used.get_mut(v as usize) {
            *flag = true;
        }
    }
    let isolated: Vec<u32> = (0..used.len() as u32).filter(|&v| !used[v as usize]).collect();
    match isolated[..] {
        [] => Vec::new(),
        [vertex] => vec![Note {
            code: "isolated_vertex",
            message: format!("vertex {vertex} belongs to no face"),
            place: Some(Place::Vertex(vertex)),
        }],
        [first, ..] => vec![Note {
            code: "isolated_vertex",
            message: format!("{} vertices belong to no face, the first is {first}", isolated.len()),
            place: Some(Place::Vertex(first)),
        }],
    }
}
