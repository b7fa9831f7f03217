//! Every reason why a network cannot be laid.

use crate::mesh::{Defect, Place};

/// Why a network was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("curve network refused, defects: {}, the first: {}", .defects.len(), .defects[0])]
pub struct NetworkError {
    /// All defects that were found; never empty.
    pub defects: Vec<NetworkDefect>,
}

/// Something that keeps a network from being laid. Vertices are those of the cage.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum NetworkDefect {
    #[error("the cage is no sound mesh: {0}")]
    Mesh(Defect),
    #[error("curve {curve}: no edge joins vertices {from} and {to}; list neighbours, one after the other")]
    NotAnEdge { curve: String, from: u32, to: u32 },
    #[error("edge {from}-{to} belongs to curve {curve} and to curve {other}; give it to one of them")]
    SharedEdge { curve: String, other: String, from: u32, to: u32 },
    #[error("curve {curve} has {vertices} vertices; {least} is the least")]
    CurveShort { curve: String, vertices: usize, least: usize },
    #[error("curve {curve} names vertex {vertex} twice; cut it in two curves there, or mark it closed")]
    CurveRepeats { curve: String, vertex: u32 },
    #[error("curve {curve} has {points} points for {vertices} vertices; give one for each, or refit it")]
    TargetLength { curve: String, points: usize, vertices: usize },
    #[error("curve {curve} has control points and points to go through; give one of the two")]
    TwoShapes { curve: String },
    #[error("curve {curve}: point {index} has a coordinate that is no finite number")]
    TargetNotFinite { curve: String, index: usize },
    #[error(
        "curve {curve} leaves the meeting point at vertex {vertex} without a direction: its first two control points are \
         the same; move the second"
    )]
    ZeroTangent { curve: String, vertex: u32 },
    #[error("curve {curve} meets sharp edge {from}-{to}; take the crease away, or end the curve before it")]
    Crease { curve: String, from: u32, to: u32 },
    #[error(
        "the cage has a meeting of curves at vertex {vertex} already; take those curves and these into one network"
    )]
    MeetingAlready { vertex: u32 },
    #[error("curve {curve} goes through sharp vertex {vertex}; take the tag away")]
    SharpVertex { curve: String, vertex: u32 },
    #[error(
        "curves {curve} and {other} have control points {distance:e} apart at their common vertex {vertex}; give them the \
         same one there"
    )]
    MeetingPointMismatch { curve: String, other: String, vertex: u32, distance: f64 },
    #[error(
        "curve {curve} runs along the border on one side of vertex {vertex} only; cut it in two curves there"
    )]
    BorderMixed { curve: String, vertex: u32 },
    #[error(
        "{edges} edges of curves lead inward from border vertex {vertex}, one of them of curve {curve}; only one may: end \
         the others elsewhere"
    )]
    BorderMeeting { curve: String, vertex: u32, edges: usize },
    #[error(
        "meeting points {from} and {to} are joined by a single edge of curve {curve}; allow at least one split before the \
         network is laid"
    )]
    XAdjacent { curve: String, from: u32, to: u32 },
    #[error(
        "curve {curve}: vertex {vertex} has not one edge to either side, and the mesh may not be changed; allow repair, or \
         take the path along vertices of valence 4"
    )]
    PathValence { curve: String, vertex: u32 },
    #[error(
        "curves {curve} and {other} cannot cross smoothly at vertex {vertex}: that needs four quads, and each curve to run \
         straight through; pin the crossing, or split before"
    )]
    CrossingNotRegular { curve: String, other: String, vertex: u32 },
    #[error("there is no room for the network at vertex {vertex}; allow one more split before it is laid")]
    Repair { vertex: u32 },
    #[error("curve {curve} has {given} {what} for {vertices} vertices; give one for each, or none")]
    ConstraintLength { curve: String, what: &'static str, given: usize, vertices: usize },
    #[error("{what} wanted at vertex {vertex} is no finite number, or a normal without length; mend it")]
    ConstraintNotFinite { what: &'static str, vertex: u32 },
    #[error("a point is wanted at vertex {vertex}, but there are only {count}; name one of these")]
    PointVertex { vertex: u32, count: usize },
    #[error("points are wanted, first at vertex {vertex}, which only fairing can give; allow it")]
    PointsWithoutFairing { vertex: u32 },
    #[error(
        "{what} at vertex {vertex} contradicts the rest: it is missed by {residual:e} of its size; take it away, or what is \
         against it"
    )]
    Contradiction { vertex: u32, what: String, residual: f64 },
    #[error(
        "fairing found no solution: the residual stays at {residual:e}; fix more vertices or take constraints away"
    )]
    Fairing { residual: f64 },
    #[error("there are no curves to make a cage for; give some")]
    NoCurves,
    #[error(
        "curve {curve} is alone at vertex {vertex}: every end needs another curve, and a closed curve two points on others"
    )]
    CurveAlone { curve: String, vertex: u32 },
    #[error(
        "it cannot be seen from the directions of curves at vertex {vertex} how loops run; give the loops"
    )]
    LoopAmbiguous { vertex: u32 },
    #[error(
        "loop {number} does not follow curves all round, from one point where they meet to the next; mend it"
    )]
    LoopBroken { number: usize },
    #[error("two loops follow a curve from vertex {vertex} in one direction; turn one of them round")]
    LoopTwice { vertex: u32 },
    #[error("{what} is {value}, which is not in its range; {remedy}")]
    Parameter { what: String, value: f64, remedy: &'static str },
}

impl NetworkError {
    /// The code of the first defect.
    pub fn code(&self) -> &'static str {
        self.defects[0].code()
    }
}

impl NetworkDefect {
    /// Where in the cage, if it is at one place.
    pub fn place(&self) -> Option<Place> {
        match *self {
            NetworkDefect::Mesh(ref defect) => defect.place(),
            NetworkDefect::NotAnEdge { from, to, .. }
            | NetworkDefect::SharedEdge { from, to, .. }
            | NetworkDefect::Crease { from, to, .. }
            | NetworkDefect::XAdjacent { from, to, .. } => Some(Place::Edge(from, to)),
            NetworkDefect::CurveRepeats { vertex, .. }
            | NetworkDefect::ZeroTangent { vertex, .. }
            | NetworkDefect::MeetingAlready { vertex }
            | NetworkDefect::SharpVertex { vertex, .. }
            | NetworkDefect::MeetingPointMismatch { vertex, .. }
            | NetworkDefect::BorderMixed { vertex, .. }
            | NetworkDefect::BorderMeeting { vertex, .. }
            | NetworkDefect::PathValence { vertex, .. }
            | NetworkDefect::CrossingNotRegular { vertex, .. }
            | NetworkDefect::ConstraintNotFinite { vertex, .. }
            | NetworkDefect::PointVertex { vertex, .. }
            | NetworkDefect::PointsWithoutFairing { vertex }
            | NetworkDefect::Contradiction { vertex, .. }
            | NetworkDefect::CurveAlone { vertex, .. }
            | NetworkDefect::LoopAmbiguous { vertex }
            | NetworkDefect::LoopTwice { vertex }
            | NetworkDefect::Repair { vertex } => Some(Place::Vertex(vertex)),
            NetworkDefect::CurveShort { .. }
            | NetworkDefect::TargetLength { .. }
            | NetworkDefect::TargetNotFinite { .. }
            | NetworkDefect::TwoShapes { .. }
            | NetworkDefect::ConstraintLength { .. }
            | NetworkDefect::NoCurves
            | NetworkDefect::LoopBroken { .. }
            | NetworkDefect::Fairing { .. }
            | NetworkDefect::Parameter { .. } => None,
        }
    }

    /// A stable name.
    pub fn code(&self) -> &'static str {
        match self {
            NetworkDefect::Mesh(
                Defect::NonManifoldEdge { .. }
                | Defect::NonManifoldVertex { .. }
                | Defect::FlippedFace { .. },
            ) => "E_NONMANIFOLD",
            NetworkDefect::Mesh(defect) => defect.code(),
            NetworkDefect::NotAnEdge { .. } => "E_NOT_AN_EDGE",
            NetworkDefect::SharedEdge { .. } => "E_SHARED_EDGE",
            NetworkDefect::CurveShort { .. } => "E_CURVE_SHORT",
            NetworkDefect::CurveRepeats { .. } => "E_CURVE_REPEATS",
            NetworkDefect::TargetLength { .. } => "E_TARGET_LENGTH",
            NetworkDefect::TwoShapes { .. } => "E_TWO_SHAPES",
            NetworkDefect::TargetNotFinite { .. } => "E_TARGET_NOT_FINITE",
            NetworkDefect::ZeroTangent { .. } => "E_ZERO_TANGENT",
            NetworkDefect::Crease { .. } | NetworkDefect::SharpVertex { .. } => "E_CREASE",
            NetworkDefect::MeetingAlready { .. } => "E_MEETING_ALREADY",
            NetworkDefect::MeetingPointMismatch { .. } => "E_MEETING_POINT_MISMATCH",
            NetworkDefect::BorderMixed { .. } => "E_BORDER_MIXED",
            NetworkDefect::BorderMeeting { .. } => "E_BORDER_MEETING",
            NetworkDefect::XAdjacent { .. } => "E_X_ADJACENT",
            NetworkDefect::PathValence { .. } => "E_PATH_VALENCE",
            NetworkDefect::CrossingNotRegular { .. } => "E_CROSSING_NOT_REGULAR",
            NetworkDefect::Repair { .. } => "E_REPAIR",
            NetworkDefect::Parameter { .. } => "E_PARAMETER",
            NetworkDefect::NoCurves => "E_NO_CURVES",
            NetworkDefect::CurveAlone { .. } => "E_CURVE_ALONE",
            NetworkDefect::LoopAmbiguous { .. } => "E_LOOP_AMBIGUOUS",
            NetworkDefect::LoopBroken { .. } => "E_LOOP_BROKEN",
            NetworkDefect::LoopTwice { .. } => "E_LOOP_TWICE",
            NetworkDefect::ConstraintLength { .. } => "E_CONSTRAINT_LENGTH",
            NetworkDefect::ConstraintNotFinite { .. } => "E_CONSTRAINT_NOT_FINITE",
            NetworkDefect::PointVertex { .. } => "E_POINT_VERTEX",
            NetworkDefect::PointsWithoutFairing { .. } => "E_POINTS_WITHOUT_FAIRING",
            NetworkDefect::Contradiction { .. } => "E_CONTRADICTION",
            NetworkDefect::Fairing { .. } => "E_FAIRING",
        }
    }
}
