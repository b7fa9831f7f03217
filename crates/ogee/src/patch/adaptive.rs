//! `Adaptive`: refinement that goes on only where it is wanted.

use super::{Neighbourhood, with_ring};
use crate::math::Vec3;
use crate::mesh::{EdgeId, FaceId, HalfedgeId, Place, VertexId};
use crate::nurbs::FaceAddress;
use crate::rules::Level;

/// Levels of refinement of a cage, each of some faces of the one before.
#[derive(Clone, Debug)]
pub(crate) struct Adaptive {
    /// The cage first.
    levels: Vec<AdaptiveLevel>,
    /// For each vertex of all levels where it is on the cage. Those of the cage come first, then the middles of all its faces:
    /// all that can be irregular has a number that does not depend on what is refined.
    origins: Vec<Place>,
}

/// One level: children of faces that were wanted, and of those that touch them, so that everything around the former is as on the
/// whole level.
#[derive(Clone, Debug)]
pub(crate) struct AdaptiveLevel {
    pub(crate) level: Level,
    pub(crate) points: Vec<Vec3>,
    /// For each face the piece of the cage that it is.
    pub(crate) addresses: Vec<FaceAddress>,
    /// For each vertex a number that it keeps on all levels.
    pub(crate) vertices: Vec<u32>,
    /// For each face: true if it is part of the surface. The level itself may not know.
    visible: Vec<bool>,
    /// The faces that were passed on, in order, and the first of the next level's faces that each became.
    passed_on: Vec<(FaceId, u32)>,
    /// For each edge of the level before that was passed on, its number there.
    parents: Vec<u32>,
}

impl AdaptiveLevel {
    /// True if a face is part of the surface.
    pub(crate) fn is_visible(&self, face: FaceId) -> bool {
        self.visible[face.index()]
    }

    /// The faces of the surface.
    pub(crate) fn visible_faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        (0..self.visible.len() as u32).map(FaceId).filter(|&face| self.is_visible(face))
    }

    /// The first face of the next level that a face became, if it was passed on.
    fn children(&self, face: FaceId) -> Option<u32> {
        let place = self.passed_on.binary_search_by_key(&face, |&(face, _)| face).ok()?;
        Some(self.passed_on[place].1)
    }
}

impl Adaptive {
    /// A cage; `addresses` says of each of its faces what it is.
    pub(crate) fn new(level: Level, points: Vec<Vec3>, addresses: Vec<FaceAddress>) -> Adaptive {
        let topology = level.topology();
        let first = AdaptiveLevel {
            vertices: (0..topology.vertex_count() as u32).collect(),
            visible: (0..topology.face_count() as u32).map(|face| level.is_visible(FaceId(face))).collect(),
            points,
            addresses,
            passed_on: Vec::new(),
            parents: Vec::new(),
            level,
        };
        let vertices = first.vertices.iter().map(|&v| Place::Vertex(v));
        let middles = (0..first.visible.len() as u32).map(Place::Face);
        Adaptive { origins: vertices.chain(middles).collect(), levels: vec![first] }
    }

    /// The levels so far.
    pub(crate) fn levels(&self) -> &[AdaptiveLevel] {
        &self.levels
    }

    /// The deepest level so far.
    pub(crate) fn last(&self) -> &AdaptiveLevel {
        &self.levels[self.levels.len() - 1]
    }

    /// How many vertices there are on all levels.
    pub(crate) fn vertex_count(&self) -> usize {
        self.origins.len()
    }

    /// The element of the cage that a vertex is, is the middle of, or came from.
    pub(crate) fn origin(&self, vertex: u32) -> Place {
        self.origins[vertex as usize]
    }

    /// Refines some faces of the last level, in order. Returns their children on the new one, in order.
    pub(crate) fn refine(&mut self, wanted: &[FaceId]) -> Vec<FaceId> {
        let number = self.levels.len() - 1;
        let parent = &self.levels[number];
        let topology = parent.level.topology();
        // Chaikin's rule and the faces at meetings of curves look one face further.
        let rings = if parent.level.is_chaikin() || parent.level.has_slices() { 2 } else { 1 };
        let faces = (0..rings).fold(wanted.to_vec(), |faces, _| with_ring(&parent.level, &faces));
        let whole = faces.len() == topology.face_count();
        let part = (!whole).then(|| Neighbourhood::new(&parent.level, &faces));
        let (own, points) = match &part {
            Some(part) => (&part.level, part.take(&parent.points)),
            None => (&parent.level, parent.points.clone()),
        };
        let own_topology = own.topology();
        let (level, points) = own.refine_points(&points);

        let mut vertices: Vec<u32> = match &part {
            Some(part) => part.vertices.iter().map(|v| parent.vertices[v.index()]).collect(),
            None => parent.vertices.clone(),
        };
        let mut origins: Vec<Place> = match number {
            0 => Vec::new(),
            _ => faces.iter().map(|&face| Place::Face(parent.addresses[face.index()].face.0)).collect(),
        };
        origins.extend(own_topology.edge_halfedges().map(|h| {
            let end = |v: VertexId| self.origins[vertices[v.index()] as usize];
            match (end(own_topology.origin(h)), end(own_topology.target(h))) {
                (Place::Vertex(a), Place::Vertex(b)) => Place::Edge(a, b),
                (Place::Vertex(_), other) | (other, _) => other,
            }
        }));
        if number == 0 {
            vertices.extend(faces.iter().map(|face| topology.vertex_count() as u32 + face.0));
        }
        let known = self.origins.len() as u32;
        vertices.extend((known..).take(origins.len()));

        let halfedges = || faces.iter().flat_map(|&face| topology.halfedges(face));
        let addresses = halfedges().map(|h| {
            let face = topology.face(h);
            parent.addresses[face.index()].quarter(h.0 - topology.first(face).0)
        });
        let visible = halfedges().map(|h| parent.is_visible(topology.face(h)));
        let mut parents = vec![0; own_topology.edge_count()];
        for (own_h, h) in (0..).map(HalfedgeId).zip(halfedges()) {
            parents[own_topology.edge(own_h).index()] = topology.edge(h).0;
        }
        let next = AdaptiveLevel {
            addresses: addresses.collect(),
            visible: visible.collect(),
            parents,
            passed_on: Vec::new(),
            level,
            points,
            vertices,
        };
        let first_child = |own: usize| own_topology.first(FaceId(own as u32)).0;
        let passed_on: Vec<(FaceId, u32)> =
            faces.iter().enumerate().map(|(own, &face)| (face, first_child(own))).collect();
        self.origins.extend(origins);
        self.levels[number].passed_on = passed_on;
        self.levels.push(next);
        self.children(number, wanted)
    }

    /// What some faces became on the next level.
    fn children(&self, number: usize, faces: &[FaceId]) -> Vec<FaceId> {
        let parent = &self.levels[number];
        let size = |face: FaceId| parent.level.topology().face_size(face);
        let of = |&face: &FaceId| parent.children(face).map(|first| first..first + size(face));
        faces.iter().filter_map(of).flatten().map(FaceId).collect()
    }

    /// The two halves of a halfedge on the next level, in its direction; `None` if its face was not passed on.
    pub(crate) fn halves(&self, number: usize, h: HalfedgeId) -> Option<[HalfedgeId; 2]> {
        let parent = &self.levels[number];
        let topology = parent.level.topology();
        let (face, next) = (topology.face(h), topology.next(h));
        let first = parent.children(face)?;
        let child = |h: HalfedgeId| first + h.0 - topology.first(face).0;
        // The first side of the quad at its start, and the last of the quad at its end.
        Some([HalfedgeId(4 * child(h)), HalfedgeId(4 * child(next) + 3)])
    }

    /// The edge of the level before that an edge is half of.
    pub(crate) fn parent_edge(&self, number: usize, edge: EdgeId) -> Option<EdgeId> {
        self.levels[number].parents.get(edge.index() / 2).map(|&parent| EdgeId(parent))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{ControlMesh, Crease, Creasing, Sharpness, shapes};

    /// A hilly sheet with a long crease that bends and whose sharpness varies, which Chaikin's rule hands down from both ends of an edge.
    fn sheet(creasing: Creasing) -> ControlMesh {
        let mut mesh = shapes::grid(9, 9);
        mesh.points.iter_mut().enumerate().for_each(|(k, p)| p.z = ((3 * k) as f64).sin());
        mesh.scheme.creasing = creasing;
        let path = [12, 22, 32, 33, 34, 44, 54, 64, 65, 66, 67];
        for (k, ends) in path.windows(2).enumerate() {
            let sharpness = Sharpness::Finite(1.3 + 0.4 * (k % 4) as f64);
            mesh.creases.push(Crease { vertices: [ends[0], ends[1]], sharpness });
        }
        mesh
    }

    #[test]
    fn some_faces_become_what_they_become_with_all() {
        for creasing in [Creasing::Uniform, Creasing::Chaikin] {
            let mesh = sheet(creasing);
            let level = Level::new(&mesh).expect("a sound cage");
            let faces = || (0..level.topology().face_count() as u32).map(FaceId);
            let addresses = faces().map(FaceAddress::whole).collect();
            let cage = Adaptive::new(level.clone(), mesh.points.clone(), addresses);
            for face in faces() {
                let (mut few, mut all) = (cage.clone(), cage.clone());
                let (mut own, mut whole) = (vec![face], vec![face]);
                for step in 0..3 {
                    own = few.refine(&own);
                    let count = all.last().level.topology().face_count() as u32;
                    all.refine(&(0..count).map(FaceId).collect::<Vec<_>>());
                    whole = all.children(step, &whole);
                    let (few, all) = (few.last(), all.last());
                    for (&a, &b) in own.iter().zip(&whole) {
                        assert_eq!(few.addresses[a.index()], all.addresses[b.index()]);
                        let sides = few.level.topology().halfedges(a).zip(all.level.topology().halfedges(b));
                        for (a, b) in sides {
                            let of = |at: &AdaptiveLevel, h: HalfedgeId| {
                                (at.points[at.level.topology().origin(h).index()], at.level.edge_sharpness(h))
                            };
                            let ((one, sharpness), (other, wanted)) = (of(few, a), of(all, b));
                            assert!(one.distance(other) < 1e-14, "{creasing:?}, face {face}, step {step}");
                            // Both infinite on the boundary.
                            let agree = sharpness == wanted || (sharpness - wanted).abs() < 1e-14;
                            assert!(agree, "{creasing:?}, face {face}, step {step}");
                        }
                    }
                }
            }
        }
    }
}
