//! `Part`: the faces of a group, with as much around them as their patches depend on, as a level of their own.

use super::meeting::MeetingFan;
use super::{PccmError, meetings};
use crate::math::Vec3;
use crate::mesh::{EdgeId, FaceId, HalfedgeId, Note, Place, VertexId};
use crate::patch::{Neighbourhood, with_ring};
use crate::rules::Level;
use std::borrow::Cow;

/// Some faces of a cage or of its first refinement, all of them quads, with their surroundings.
///
/// Its quads are numbered as those of the whole are, in order, and come before its other polygons, so that halfedges of quad `q`
/// are `4 q .. 4 q + 4`. Faces that are not converted, and those that are hidden in the whole, are hidden here.
pub(crate) struct Part<'a> {
    whole: &'a Level,
    /// The whole cage, or faces of it.
    cage: Cow<'a, Level>,
    /// For each vertex of that the one of the whole cage; nothing where it is the whole cage.
    vertices: Option<Vec<VertexId>>,
    /// Its refinement, where that is what is converted.
    refined: Option<Level>,
    /// The face of the whole for each quad.
    faces: Vec<FaceId>,
    /// By quad.
    converted: Vec<bool>,
}

impl<'a> Part<'a> {
    /// `faces` are those of the cage `steps` refinements on (0 or 1), in order.
    pub(crate) fn new(cage: &'a Level, steps: u32, faces: &[FaceId]) -> Part<'a> {
        Part::showing(cage, steps, faces, faces)
    }

    /// The same, but of the faces that are converted only some are shown: the others are there for their sake, and hidden.
    pub(crate) fn showing(cage: &'a Level, steps: u32, faces: &[FaceId], shown: &[FaceId]) -> Part<'a> {
        let topology = cage.topology();
        let halfedges = topology.halfedge_count();
        let everything = if steps == 0 && topology.is_quads() { topology.face_count() } else { halfedges };
        if shown.len() == everything {
            return Part {
                whole: cage,
                cage: Cow::Borrowed(cage),
                vertices: None,
                refined: (steps > 0).then(|| cage.split()),
                faces: faces.to_vec(),
                converted: vec![true; faces.len()],
            };
        }
        let mut around: Vec<FaceId> = faces.to_vec();
        if steps > 0 {
            around = faces.iter().map(|quad| topology.face(HalfedgeId(quad.0))).collect();
            around.dedup();
        }
        // Chaikin's rule and the faces at meetings of curves look one face further.
        let rings = if cage.is_chaikin() || cage.has_slices() { 2 } else { 1 };
        (0..rings).for_each(|_| around = with_ring(cage, &around));
        if steps == 0 {
            // Only the order changes: it is stable.
            around.sort_by_key(|&f| topology.face_size(f) != 4);
        }
        let Neighbourhood { level, vertices } = Neighbourhood::new(cage, &around);
        let own_faces: Vec<FaceId> = match steps {
            0 => around.into_iter().filter(|&f| topology.face_size(f) == 4).collect(),
            _ => around.iter().flat_map(|&f| topology.halfedges(f)).map(|h| FaceId(h.0)).collect(),
        };
        let among = |list: &[FaceId]| own_faces.iter().map(|f| list.binary_search(f).is_ok()).collect();
        let (converted, shown): (Vec<bool>, Vec<bool>) = (among(faces), among(shown));
        let is_visible = |f: FaceId| match steps {
            0 => cage.is_visible(f),
            _ => cage.is_visible(topology.face(HalfedgeId(f.0))),
        };
        let seen = |own: u32| {
            let quad = own as usize;
            shown.get(quad).is_some_and(|&shown| shown && is_visible(own_faces[quad]))
        };
        let hide = |level: Level| {
            let all = 0..level.topology().face_count() as u32;
            let hidden = all.filter(|&own| !seen(own)).map(FaceId).collect();
            level.with_hidden(hidden)
        };
        let (level, refined) = match steps {
            0 => (hide(level), None),
            _ => {
                let refined = hide(level.split());
                (level, Some(refined))
            }
        };
        Part {
            whole: cage,
            cage: Cow::Owned(level),
            vertices: Some(vertices),
            refined,
            faces: own_faces,
            converted,
        }
    }

    /// The level whose quads are converted.
    pub(crate) fn base(&self) -> &Level {
        self.refined.as_ref().unwrap_or(&self.cage)
    }

    /// The points of the base from those of the whole cage.
    pub(crate) fn points<'p>(&self, cage_points: &'p [Vec3]) -> Cow<'p, [Vec3]> {
        let own = match &self.vertices {
            None => Cow::Borrowed(cage_points),
            Some(vertices) => vertices.iter().map(|v| cage_points[v.index()]).collect(),
        };
        if self.refined.is_none() {
            return own;
        }
        let mut refined = Vec::new();
        self.cage.child_points(&own, &mut refined);
        Cow::Owned(refined)
    }

    /// How many quads the base has.
    pub(crate) fn quad_count(&self) -> usize {
        self.faces.len()
    }

    /// By quad of the base: true if it is converted.
    pub(crate) fn is_converted(&self, quad: usize) -> bool {
        self.converted.get(quad).copied().unwrap_or(false)
    }

    /// The quads of the base that are converted, in order.
    pub(crate) fn converted(&self) -> impl Iterator<Item = FaceId> + '_ {
        (0..).zip(&self.converted).filter(|&(_, &converted)| converted).map(|(quad, _)| FaceId(quad))
    }

    /// The meetings of curves all round which quads are converted.
    pub(super) fn meetings(&self) -> Vec<MeetingFan> {
        let mut all = meetings(self.base());
        all.retain(|fan| fan.halfedges.iter().all(|h| self.is_converted(h.index() / 4)));
        all
    }

    /// The face of the whole that a quad is.
    pub(crate) fn face(&self, quad: FaceId) -> FaceId {
        self.faces[quad.index()]
    }

    /// The halfedges of the base along a halfedge of the whole cage, on either side of it.
    pub(crate) fn along(&self, h: HalfedgeId) -> Vec<HalfedgeId> {
        let topology = self.whole.topology();
        let sides = std::iter::once(h).chain(topology.twin(h));
        let found = sides.filter_map(|h| {
            if self.refined.is_some() {
                let own = self.faces.binary_search(&FaceId(h.0)).ok()? as u32;
                let next = self.cage.topology().next(HalfedgeId(own));
                return Some(vec![HalfedgeId(4 * own), HalfedgeId(4 * next.0 + 3)]);
            }
            let face = topology.face(h);
            let own = self.faces.binary_search(&face).ok()? as u32;
            Some(vec![HalfedgeId(4 * own + h.0 - topology.first(face).0)])
        });
        found.flatten().collect()
    }

    /// What a halfedge of a quad of the base is on the level of the whole that its faces are of.
    pub(crate) fn halfedge(&self, h: HalfedgeId) -> HalfedgeId {
        let (face, corner) = (self.faces[h.index() / 4], h.0 % 4);
        match self.refined {
            None => HalfedgeId(self.whole.topology().first(face).0 + corner),
            Some(_) => HalfedgeId(4 * face.0 + corner),
        }
    }

    /// What a vertex of the base is there.
    pub(crate) fn vertex(&self, v: VertexId) -> VertexId {
        let (Some(vertices), Some(refined)) = (&self.vertices, &self.refined) else {
            return self.vertices.as_ref().map_or(v, |vertices| vertices[v.index()]);
        };
        if let Some(&old) = vertices.get(v.index()) {
            return old;
        }
        let Some(h) = refined.topology().outgoing(v).map(|h| self.halfedge(h)) else { return v };
        let topology = self.whole.topology();
        let (old, faces) = (topology.vertex_count() as u32, topology.face_count() as u32);
        let parent = HalfedgeId(h.0 / 4);
        VertexId(match h.0 % 4 {
            1 => old + faces + topology.edge(parent).0,
            2 => old + topology.face(parent).0,
            _ => old + faces + topology.edge(topology.prev(parent)).0,
        })
    }

    /// A note about the base, told of the level of the whole that its faces are of.
    pub(crate) fn note(&self, note: Note) -> Note {
        let Some(Place::Vertex(own)) = note.place else { return note };
        let vertex = self.vertex(VertexId(own)).0;
        let message = note.message.replace(&format!(" {own} "), &format!(" {vertex} "));
        Note { message, place: Some(Place::Vertex(vertex)), ..note }
    }

    /// A refusal of the base, told of the whole cage.
    pub(crate) fn error(&self, error: PccmError) -> PccmError {
        let topology = self.whole.topology();
        let points = topology.vertex_count() + topology.face_count();
        let edge = |v: VertexId| v.index().checked_sub(points).map(|e| topology.side(EdgeId(e as u32)));
        let place = |place: Place| match place {
            Place::Vertex(v) => Place::Vertex(self.vertex(VertexId(v)).0),
            // Half an edge: one of its ends is the middle.
            Place::Edge(a, b) => {
                let ends = [a, b].map(|v| self.vertex(VertexId(v)));
                let middle = ends.into_iter().filter(|_| self.refined.is_some()).find_map(edge);
                let [a, b] = middle.map_or(ends, |h| [topology.origin(h), topology.target(h)]);
                Place::Edge(a.0, b.0)
            }
            other => other,
        };
        match error {
            PccmError::TooSharp { place: own, sharpness } => {
                PccmError::TooSharp { place: place(own), sharpness }
            }
            other => other,
        }
    }
}
