//! Where a cap may sit, and its points (Whole meshes on the method's page).
//!
//! A cap takes the place of the faces of one sector around an irregular vertex. Its border continues the bicubic surface
//! around it, so that all other corners of those faces have to be regular.

use super::columns::Node;
use super::tables::is_solvable;
use super::{CapClass, CornerAngle};
use crate::math::Vec3;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::rules::{Level, Sector};

/// A sector that is given a cap.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Site {
    /// What kind of cap.
    pub class: CapClass,
    /// For each sector of the cap, counter-clockwise, the halfedge of its face that leaves the vertex: it runs along the
    /// sector's first edge. At a dart the first runs along the crease.
    pub halfedges: Vec<HalfedgeId>,
}

/// Why an irregular sector has no cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Obstacle {
    /// A face at the vertex, or one that touches such a face, is no quad.
    #[error("vertex {vertex} has no G2 cap on this level: face {face} near it is no quad; refine once more")]
    NotQuad {
        /// The vertex.
        vertex: VertexId,
        /// The face.
        face: FaceId,
    },
    /// A face at the vertex has another irregular corner.
    #[error(
        "vertex {vertex} has no G2 cap on this level: vertex {other}, on a face with it, is irregular; refine once more"
    )]
    NotSeparated {
        /// The vertex.
        vertex: VertexId,
        /// The other corner.
        other: VertexId,
    },
    /// A corner of a face at the vertex has finite sharpness, or an edge there.
    #[error(
        "vertex {vertex} has no G2 cap on this level: sharpness at vertex {at} has not faded; refine until it has"
    )]
    SemiSharp {
        /// The vertex.
        vertex: VertexId,
        /// Where the sharpness is; may be the vertex itself.
        at: VertexId,
    },
    /// Curves meet at the vertex, or at a corner of a face next to it.
    #[error("vertex {vertex} has no G2 cap on this level: at vertex {centre} curves meet")]
    Meeting {
        /// The vertex.
        vertex: VertexId,
        /// Where they meet; may be the vertex itself.
        centre: VertexId,
    },
    /// One face on this side of a smooth boundary or crease: no regular patch has two parallel sides.
    #[error(
        "vertex {vertex} has no G2 cap: it has one face on this side of a smooth boundary or crease; tag it as a corner"
    )]
    OneFace {
        /// The vertex.
        vertex: VertexId,
    },
    /// The boundary of a corner with two faces or more runs straight on, or back.
    #[error(
        "vertex {vertex} has no G2 cap: it is a corner, but its two sharp edges are parallel; bend them, or drop the tag"
    )]
    ParallelEdges {
        /// The vertex.
        vertex: VertexId,
    },
    /// A vertex tagged sharp inside a smooth region has no tangent plane.
    #[error(
        "vertex {vertex} has no G2 cap: it is tagged sharp inside a smooth region, which makes a cone of it"
    )]
    Cone {
        /// The vertex.
        vertex: VertexId,
    },
    /// The rule at valence 2 has no tangent plane that a cap could have.
    #[error("vertex {vertex} has no G2 cap: its valence is 2; treat it first (--lens merge, lens::treat)")]
    ValenceTwo {
        /// The vertex.
        vertex: VertexId,
    },
    /// More faces than there are solutions for.
    #[error(
        "vertex {vertex} has no G2 cap: {faces} faces are more than there are caps for; split the vertex"
    )]
    TooManyFaces {
        /// The vertex.
        vertex: VertexId,
        /// How many faces the sector has.
        faces: u32,
    },
}

impl Obstacle {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            Obstacle::NotQuad { .. } => "not_quad",
            Obstacle::NotSeparated { .. } => "not_separated",
            Obstacle::SemiSharp { .. } => "semi_sharp",
            Obstacle::Meeting { .. } => "meeting",
            Obstacle::OneFace { .. } => "one_face",
            Obstacle::ParallelEdges { .. } => "parallel_edges",
            Obstacle::Cone { .. } => "cone",
            Obstacle::ValenceTwo { .. } => "valence_two",
            Obstacle::TooManyFaces { .. } => "too_many_faces",
        }
    }

    /// True if the obstacle is gone after some more refinements; finite sharpness takes as many as it needs to fade.
    pub fn is_cured_by_refinement(&self) -> bool {
        match self {
            Obstacle::NotQuad { .. } | Obstacle::NotSeparated { .. } | Obstacle::SemiSharp { .. } => true,
            Obstacle::Meeting { vertex, centre } => vertex != centre,
            Obstacle::OneFace { .. }
            | Obstacle::ParallelEdges { .. }
            | Obstacle::Cone { .. }
            | Obstacle::ValenceTwo { .. }
            | Obstacle::TooManyFaces { .. } => false,
        }
    }

    /// Greater where more has to happen before the obstacle is gone.
    fn gravity(&self) -> u32 {
        match self {
            Obstacle::NotSeparated { .. } => 0,
            Obstacle::NotQuad { .. } => 1,
            Obstacle::SemiSharp { .. } => 2,
            _ => 3,
        }
    }
}

/// What a sector is to caps, from the infinitely sharp edges and the tag of its vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Regular,
    Interior,
    Boundary,
    OneFace,
    Corner,
    Dart,
    Cone,
}

fn kind(level: &Level, vertex: VertexId, sector: Sector) -> Kind {
    let topology = level.topology();
    let closing = usize::from(topology.is_boundary(vertex));
    let sharp_edges = topology.ring(vertex).filter(|&h| level.is_sharp(h)).count() + closing;
    let tagged = level.vertex_sharpness(vertex).is_infinite();
    match (sharp_edges, sector.faces) {
        (0 | 1, _) if tagged => Kind::Cone,
        (0, 4) => Kind::Regular,
        (0, _) => Kind::Interior,
        (1, _) => Kind::Dart,
        (2, 1) if !tagged => Kind::OneFace,
        (2, 2) if !tagged => Kind::Regular,
        (2, _) if !tagged => Kind::Boundary,
        (_, 1) => Kind::Regular,
        _ => Kind::Corner,
    }
}

/// The cap of a sector of a vertex; `None` if the sector is regular, or none of its faces is seen. `points` are the level's.
///
/// Regular are interior vertices of valence 4, smooth boundaries and sides of creases with two faces, and corners with one.
///
/// # Errors
/// If the sector is irregular and something is in the way of a cap.
///
/// # Panics
/// If there are fewer points than vertices, or the sector is not the vertex's.
pub fn site(
    level: &Level,
    points: &[Vec3],
    vertex: VertexId,
    sector: Sector,
) -> Result<Option<Site>, Obstacle> {
    let topology = level.topology();
    let halfedges: Vec<HalfedgeId> = level.sector_halfedges(sector).collect();
    if !halfedges.iter().any(|&h| level.is_visible(topology.face(h))) {
        return Ok(None);
    }
    has_faded(level, vertex, vertex)?;
    is_off_meetings(level, vertex, &halfedges)?;
    let faces = sector.faces;
    let class = match kind(level, vertex, sector) {
        Kind::Regular => return Ok(None),
        Kind::OneFace => return Err(Obstacle::OneFace { vertex }),
        Kind::Cone => return Err(Obstacle::Cone { vertex }),
        Kind::Interior | Kind::Dart if faces < 3 => return Err(Obstacle::ValenceTwo { vertex }),
        Kind::Interior => CapClass::Interior { valence: faces },
        Kind::Dart => CapClass::Dart { valence: faces },
        Kind::Boundary => CapClass::Boundary { faces },
        Kind::Corner => CapClass::Corner { faces, angle: CornerAngle::Convex },
    };
    if !is_solvable(class) {
        return Err(Obstacle::TooManyFaces { vertex, faces });
    }
    are_quads(level, vertex, &halfedges)?;
    let corners =
        halfedges.iter().flat_map(|&h| topology.halfedges(topology.face(h)).filter(move |&c| c != h));
    // The gravest one, so that the answer does not depend on where the vertex's faces are counted from.
    let obstacles = corners.filter_map(|corner| is_regular(level, vertex, corner).err());
    if let Some(obstacle) = obstacles.max_by_key(Obstacle::gravity) {
        return Err(obstacle);
    }
    let class = match class {
        CapClass::Corner { faces, .. } => {
            let Some(angle) = corner_angle(level, points, &halfedges) else {
                return Err(Obstacle::ParallelEdges { vertex });
            };
            CapClass::Corner { faces, angle }
        }
        other => other,
    };
    Ok(Some(Site { class, halfedges }))
}

/// No finite sharpness at a vertex.
fn has_faded(level: &Level, vertex: VertexId, at: VertexId) -> Result<(), Obstacle> {
    let topology = level.topology();
    let is_finite = |sharpness: f64| sharpness > 0.0 && sharpness.is_finite();
    // An edge that ends a boundary fan has no halfedge in the ring, but is infinitely sharp.
    let mut sharpness =
        topology.ring(at).map(|h| level.edge_sharpness(h)).chain([level.vertex_sharpness(at)]);
    if sharpness.any(is_finite) { Err(Obstacle::SemiSharp { vertex, at }) } else { Ok(()) }
}

/// No meeting of curves on some faces. One at the vertex itself is named only if there is no other.
fn is_off_meetings(level: &Level, vertex: VertexId, faces: &[HalfedgeId]) -> Result<(), Obstacle> {
    let topology = level.topology();
    let centres = faces
        .iter()
        .filter_map(|&h| level.slice(topology.face(h)))
        .map(|slice| topology.origin(slice.halfedge));
    match centres.min_by_key(|&centre| centre == vertex) {
        Some(centre) => Err(Obstacle::Meeting { vertex, centre }),
        None => Ok(()),
    }
}

fn are_quads(level: &Level, vertex: VertexId, halfedges: &[HalfedgeId]) -> Result<(), Obstacle> {
    let topology = level.topology();
    let mut faces = halfedges.iter().map(|&h| topology.face(h));
    match faces.find(|&face| topology.face_size(face) != 4) {
        Some(face) => Err(Obstacle::NotQuad { vertex, face }),
        None => Ok(()),
    }
}

/// The surface around a face's corner, given by the halfedge that leaves it, is bicubic. That curves meet at the vertex is the
/// answer only if nothing else is in the way.
pub(super) fn is_regular(level: &Level, vertex: VertexId, corner: HalfedgeId) -> Result<(), Obstacle> {
    let other = level.topology().origin(corner);
    for sector in level.sectors(other) {
        let halfedges: Vec<HalfedgeId> = level.sector_halfedges(sector).collect();
        if halfedges.contains(&corner) {
            has_faded(level, vertex, other)?;
            are_quads(level, vertex, &halfedges)?;
            if kind(level, other, sector) != Kind::Regular {
                return Err(Obstacle::NotSeparated { vertex, other });
            }
            is_off_meetings(level, vertex, &halfedges)?;
        }
    }
    Ok(())
}

/// Sine of the angle between the sharp edges of a corner below which they count as parallel.
const PARALLEL: f64 = 0.05;

/// For which angle the cap of a corner is to be designed; `None` if its sharp edges are nearly parallel. All faces are quads.
fn corner_angle(level: &Level, points: &[Vec3], halfedges: &[HalfedgeId]) -> Option<CornerAngle> {
    let topology = level.topology();
    let (first, last) = (*halfedges.first()?, *halfedges.last()?);
    let vertex = points[topology.origin(first).index()];
    let from_vertex = |end: VertexId| points[end.index()] - vertex;
    let start = from_vertex(topology.target(first)).normalized()?;
    let end = from_vertex(topology.origin(topology.prev(last))).normalized()?;
    if start.cross(end).length() < PARALLEL {
        return None;
    }
    let across =
        halfedges.iter().fold(Vec3::ZERO, |sum, &h| sum + from_vertex(topology.target(topology.next(h))));
    Some(if across.dot(start + end) < 0.0 { CornerAngle::Concave } else { CornerAngle::Convex })
}

/// The points of a cap, in the order of columns ([`CapClass`]); `points` are the level's. Beyond sharp edges they are
/// reflected.
///
/// # Panics
/// If there are fewer points than vertices, or the site is of another level.
pub fn cap_points(level: &Level, points: &[Vec3], site: &Site) -> Vec<Vec3> {
    let topology = level.topology();
    let Site { class, ref halfedges } = *site;
    let at = |v: VertexId| points[v.index()];
    let mut out = vec![Vec3::ZERO; class.columns()];
    for (sector, &h) in halfedges.iter().enumerate() {
        // The two sides of the face away from the vertex, and what is beyond them.
        let (first_side, second_side) = (topology.next(h), topology.next(topology.next(h)));
        let beyond = |side: HalfedgeId| topology.twin(side).filter(|_| !level.is_sharp(side));
        let vertex = at(topology.origin(h));
        let [p10, p11, next10] =
            [first_side, second_side, topology.prev(h)].map(|side| at(topology.origin(side)));
        let [p20, p21] = match beyond(first_side) {
            Some(twin) => {
                [topology.target(topology.next(twin)), topology.origin(topology.prev(twin))].map(at)
            }
            None => [2.0 * p10 - vertex, 2.0 * p11 - next10],
        };
        let [p12, next20] = match beyond(second_side) {
            Some(twin) => {
                [topology.target(topology.next(twin)), topology.origin(topology.prev(twin))].map(at)
            }
            None => [2.0 * p11 - p10, 2.0 * next10 - vertex],
        };
        let diagonal = |first: HalfedgeId| {
            topology.twin(topology.prev(first)).map(|h| at(topology.target(topology.next(h))))
        };
        let p22 = match (beyond(first_side), beyond(second_side)) {
            (None, _) => 2.0 * p12 - next20,
            (Some(_), None) => 2.0 * p21 - p20,
            (Some(first), Some(_)) => diagonal(first).unwrap_or(2.0 * p21 - p20),
        };
        for (node, point) in [
            (Node::Vertex, vertex),
            (Node::P10(sector), p10),
            (Node::P20(sector), p20),
            (Node::P11(sector), p11),
            (Node::P21(sector), p21),
            (Node::P12(sector), p12),
            (Node::P22(sector), p22),
        ] {
            out[class.column(node)] = point;
        }
        if sector + 1 == class.edges() - 1
            && matches!(class, CapClass::Boundary { .. } | CapClass::Corner { .. })
        {
            out[class.column(Node::P10(sector + 1))] = next10;
            out[class.column(Node::P20(sector + 1))] = next20;
        }
    }
    out
}
