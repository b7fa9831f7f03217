//! Repair: changes a mesh beside a network until every path lies in quads, with one edge to either side.
//!
//! Around a vertex of the network its tagged edges cut the faces into *sectors*. A sector with one untagged edge is as it
//! should be: the neighbour there is the *side vertex*. Any other sector gets a new one, into which its untagged edges are
//! moved, so that a *ribbon* of quads runs along the curve; around a meeting point with dummy ports it gets a chain of
//! them. Vertices are put in beside the network only, and Euler number, border and orientation stay.
//!
//! ```text
//!     two faces, two tagged edges                 two untagged edges
//!          a                a                     a1  a2              a1  a2
//!         / \              / \                     \  /                 \ /
//!       u1   u2    ->    u1 w u2                ==== v ====    ->        w
//!         \ /             \ | /                                     ____/|\____
//!          v                v                                      s ==== v ==== s
//! ```

use super::defect::{NetworkDefect, NetworkError};
use super::sectors::{Sector, Sectors};
use crate::math::Vec3;
use crate::mesh::{ControlMesh, FaceId, FaceList, FaceVarying, Topology, Valence, VertexId};
use std::collections::{BTreeMap, BTreeSet};

/// A path of a network through a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct TaggedPath {
    /// Its vertices, each joined to the next by an edge. A path around a meeting point may end where it starts.
    pub vertices: Vec<u32>,
    /// True if an edge leads from the last vertex to the first.
    pub closed: bool,
}

/// A meeting point, and the dummy ports it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct MeetingPorts {
    /// The vertex.
    pub vertex: u32,
    /// For each tagged edge the neighbour at its other end, and the number of dummy ports in the sector that begins with it,
    /// counter-clockwise. What is not named has none.
    pub dummies: Vec<(u32, usize)>,
}

/// How ribbons are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ribbons {
    /// Put a new side vertex everywhere, not only where it is needed.
    pub forced: bool,
    /// How far out new vertices are, as a part of the way to the sector's neighbours: above 0, below 1.
    pub width: f64,
}

/// A mesh with room for a network.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// The mesh: old vertices first, with their numbers. It has the tags of the old one,
    /// and its texture coordinates where no vertices were put in.
    pub mesh: ControlMesh,
    /// For each face the face of the old mesh that it is part of.
    pub source_faces: Vec<u32>,
    /// For each path and each of its vertices the side vertices on the left and on the right, walking along the path seen
    /// from outside. Beside an end at a meeting point they are free spokes. Empty for paths along the border.
    pub sides: Vec<Vec<[u32; 2]>>,
    /// For each meeting point its spokes, counter-clockwise: ports at even places, free spokes at odd ones.
    pub rings: Vec<Vec<u32>>,
    /// Vertices of two X-configurations: room for the curves, but less than smoothness asks for.
    pub overlaps: Vec<u32>,
    /// Vertices of the network that new vertices were put beside.
    pub changed: Vec<u32>,
}

/// The part of a chain that takes the place of one corner of a face.
struct ChainPart {
    /// Where it begins in what is left of the face.
    place: usize,
    length: usize,
    /// Corners of slices that have two edges only, as places in the part.
    corners: Vec<usize>,
}

/// Makes room for a network of curves. Edges along the border are no business of it, and the quads around smooth crossings
/// stay as they are.
///
/// # Errors
/// If the mesh is not sound, a path leaves its edges, or there is no room: then one more split before makes it.
pub fn repair(
    mesh: &ControlMesh,
    paths: &[TaggedPath],
    meetings: &[MeetingPorts],
    smooth_crossings: &[u32],
    ribbons: Ribbons,
) -> Result<Repaired, NetworkError> {
    let topology = Topology::new(mesh).map_err(|error| NetworkError {
        defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
    })?;
    let mut sectors = Sectors::new(&topology, paths)?;
    sectors.crossings = smooth_crossings.iter().map(|&v| VertexId(v)).collect();
    sectors.plan_dummies(meetings);
    sectors.choose_new(meetings, ribbons.forced);
    let rim: BTreeSet<VertexId> = sectors.rim(paths);
    let mut points = mesh.points.clone();
    sectors.number_chains(&mut points, ribbons.width);
    if let Some(sector) = sectors.list.iter().find(|s| s.new && s.border && rim.contains(&s.vertex)) {
        // The curve along the border would get one more vertex.
        return Err(stuck(sector.vertex));
    }
    let (faces, source_faces) = sectors.emit(mesh)?;
    let uv = mesh.uv.as_ref().and_then(|uv| carried(uv, mesh, &faces, &source_faces));
    let mut repaired = ControlMesh { points, faces, uv, ..mesh.clone() };
    let holes: BTreeSet<u32> = mesh.holes.iter().copied().collect();
    repaired.holes =
        (0..).zip(&source_faces).filter(|(_, source)| holes.contains(source)).map(|(f, _)| f).collect();
    let sides = paths.iter().map(|path| sectors.sides(path)).collect();
    let rings = meetings.iter().map(|meeting| sectors.ring(VertexId(meeting.vertex))).collect();
    let changed: BTreeSet<u32> = sectors.list.iter().filter(|s| s.new).map(|s| s.vertex.0).collect();
    let changed = changed.into_iter().collect();
    let mut repaired = Repaired { mesh: repaired, source_faces, sides, rings, overlaps: Vec::new(), changed };
    let topology = sectors.check(&repaired, paths)?;
    repaired.overlaps = overlaps(&topology, meetings, &repaired.rings);
    Ok(repaired)
}

/// Texture coordinates of faces that are parts of others. `None` where a face has a vertex that its old one had not.
fn carried(uv: &FaceVarying, mesh: &ControlMesh, faces: &FaceList, sources: &[u32]) -> Option<FaceVarying> {
    let mut firsts = Vec::with_capacity(mesh.faces.len());
    let mut first = 0;
    for face in mesh.faces.iter() {
        firsts.push(first);
        first += face.len();
    }
    let index = |old: u32, v: u32| {
        let corner = mesh.faces.face(old as usize).iter().position(|&u| u == v)?;
        uv.indices.get(firsts[old as usize] + corner).copied()
    };
    let corners = faces.iter().zip(sources).flat_map(|(face, &old)| face.iter().map(move |&v| (old, v)));
    let indices = corners.map(|(old, v)| index(old, v)).collect::<Option<_>>()?;
    Some(FaceVarying { indices, ..uv.clone() })
}

/// Vertices that are a free spoke, a dummy port or a corner in two X-configurations.
fn overlaps(topology: &Topology, meetings: &[MeetingPorts], rings: &[Vec<u32>]) -> Vec<u32> {
    let mut users: BTreeMap<u32, usize> = BTreeMap::new();
    for (meeting, ring) in meetings.iter().zip(rings) {
        let corners = topology.ring(VertexId(meeting.vertex)).map(|h| topology.target(topology.next(h)).0);
        let own: BTreeSet<u32> = ring.iter().copied().chain(corners).collect();
        own.into_iter().for_each(|v| *users.entry(v).or_default() += 1);
    }
    users.into_iter().filter(|&(_, count)| count > 1).map(|(v, _)| v).collect()
}

fn stuck(v: VertexId) -> NetworkError {
    NetworkError { defects: vec![NetworkDefect::Repair { vertex: v.0 }] }
}

impl Sectors<'_> {
    /// Gives every new sector its vertices.
    fn number_chains(&mut self, points: &mut Vec<Vec3>, width: f64) {
        for number in 0..self.list.len() {
            let sector = &self.list[number];
            if !sector.new {
                continue;
            }
            let at = points[sector.vertex.index()];
            let length = 4 * sector.dummies + 1;
            let first = points.len() as u32;
            let goals: Vec<Vec3> = if length == 1 {
                vec![self.middle(sector, points)]
            } else {
                self.fan(sector, points, length)
            };
            points.extend(goals.into_iter().map(|goal| at.lerp(goal, width)));
            self.list[number].chain = (first..first + length as u32).collect();
        }
    }

    /// The mean of a sector's untagged neighbours, on the border the one there; of the other corners of its faces if there
    /// are none.
    fn middle(&self, sector: &Sector, points: &[Vec3]) -> Vec3 {
        let topology = self.topology;
        let others: Vec<VertexId> = if sector.border {
            let starts_there = topology.twin(sector.halfedges[0]).is_none();
            let end = if starts_there { sector.untagged.first() } else { sector.untagged.last() };
            end.copied().into_iter().collect()
        } else if sector.untagged.is_empty() {
            let faces = sector.halfedges.iter().map(|&h| topology.face(h));
            let corners = faces.flat_map(|f| topology.halfedges(f)).map(|h| topology.origin(h));
            corners.filter(|&v| v != sector.vertex).collect()
        } else {
            sector.untagged.clone()
        };
        let sum = others.iter().fold(Vec3::ZERO, |sum, v| sum + points[v.index()]);
        if others.is_empty() { points[sector.vertex.index()] } else { sum / others.len() as f64 }
    }

    /// Points along the outline of a sector, from one tagged neighbour to the other.
    fn fan(&self, sector: &Sector, points: &[Vec3], count: usize) -> Vec<Vec3> {
        let topology = self.topology;
        let mut outline: Vec<Vec3> = Vec::new();
        for &h in &sector.halfedges {
            let around = std::iter::successors(Some(topology.next(h)), |&g| Some(topology.next(g)));
            let corners = around.map(|g| topology.origin(g)).take_while(|&v| v != sector.vertex);
            let corners: Vec<Vec3> = corners.map(|v| points[v.index()]).collect();
            let again = usize::from(!outline.is_empty());
            outline.extend(corners.into_iter().skip(again));
        }
        let last = outline.len() - 1;
        let along = |i: usize| {
            let place = (i + 1) as f64 / (count + 1) as f64 * last as f64;
            let leg = (place as usize).min(last.saturating_sub(1));
            outline[leg].lerp(outline[(leg + 1).min(last)], place - leg as f64)
        };
        (0..count).map(along).collect()
    }

    /// The new faces, and for each the old one it is part of.
    fn emit(&self, mesh: &ControlMesh) -> Result<(FaceList, Vec<u32>), NetworkError> {
        let topology = self.topology;
        let mut faces = FaceList::with_capacity(mesh.faces.len(), mesh.faces.corners().len());
        let mut sources = Vec::new();
        for f in (0..mesh.faces.len() as u32).map(FaceId) {
            if let Some(crossing) = self.crossing_of(f) {
                if topology.halfedges(f).any(|h| self.is_new(h)) {
                    return Err(stuck(crossing));
                }
                faces.push(mesh.faces.face(f.index()));
                sources.push(f.0);
                continue;
            }
            let mut rest: Vec<u32> = Vec::new();
            let mut chain: Option<ChainPart> = None;
            for h in topology.halfedges(f) {
                let v = topology.origin(h);
                match self.of_corner.get(&h).map(|&(number, i)| (&self.list[number], i)) {
                    Some((sector, i)) if sector.new => {
                        let portion = sector.portion(i);
                        let (start, end, place) = (*portion.start(), *portion.end(), rest.len());
                        let inner = portion.clone().rev().filter(|k| k % 2 == 1 && start < *k && *k < end);
                        let corners: Vec<usize> = inner.map(|k| end - k).collect();
                        rest.extend(portion.rev().map(|k| sector.chain[k]));
                        let part = ChainPart { place, length: rest.len() - place, corners };
                        if !part.corners.is_empty() && chain.replace(part).is_some() {
                            return Err(stuck(v));
                        }
                    }
                    Some(_) if self.is_tagged(h) || self.is_tagged(topology.prev(h)) => {}
                    _ => rest.push(v.0),
                }
            }
            for h in topology.halfedges(f).filter(|&h| self.is_tagged(h)) {
                let (start, end) = (self.of_corner[&h].0, self.of_corner[&topology.next(h)].0);
                let (v, u) = (topology.origin(h), topology.target(h));
                faces.push(&[v.0, u.0, self.list[end].side(true), self.list[start].side(false)]);
                sources.push(f.0);
            }
            let corner = topology.origin(topology.first(f));
            let pieces = self.pieces(rest, chain).ok_or_else(|| stuck(corner))?;
            for piece in pieces.iter().filter(|piece| piece.len() >= 3) {
                faces.push(piece);
                sources.push(f.0);
            }
        }
        for sector in self.list.iter().filter(|sector| sector.new) {
            let source = topology.face(sector.halfedges[0]).0;
            for slice in sector.chain.windows(3).step_by(2) {
                // Corners stand at odd places: free spoke, corner, port, or port, corner, free spoke.
                faces.push(&[sector.vertex.0, slice[0], slice[1], slice[2]]);
                sources.push(source);
            }
        }
        Ok((faces, sources))
    }

    /// What is left of a face, cut along chords from the corners of a chain to vertices beyond, so that these corners have
    /// three edges. `None` if there is no such vertex.
    fn pieces(&self, mut rest: Vec<u32>, chain: Option<ChainPart>) -> Option<Vec<Vec<u32>>> {
        let Some(chain) = chain else { return Some(vec![rest]) };
        rest.rotate_left(chain.place);
        let is_old = |k: &usize| {
            let u = VertexId(rest[*k]);
            u.index() < self.topology.vertex_count() && !self.on_network(u)
        };
        let beyond: Vec<usize> = (chain.length..rest.len()).filter(is_old).collect();
        let is_far = |k: &usize| *k != chain.length && *k + 1 != rest.len();
        let far: Vec<usize> = beyond.iter().copied().filter(is_far).collect();
        let goals = if far.is_empty() { beyond } else { far };
        let (last_goal, last_corner) = (goals.len().checked_sub(1)?, chain.corners.len() - 1);
        // The first corner looks at the last goal, so that chords do not cross.
        let goal = |i: usize| match last_corner {
            0 => goals[last_goal / 2],
            _ => goals[last_goal - i * last_goal / last_corner],
        };
        let corners = &chain.corners;
        let mut pieces = vec![[&rest[..=corners[0]], &rest[goal(0)..]].concat()];
        for i in 0..last_corner {
            pieces.push([&rest[corners[i]..=corners[i + 1]], &rest[goal(i + 1)..=goal(i)]].concat());
        }
        pieces.push(rest[corners[last_corner]..=goal(last_corner)].to_vec());
        Some(pieces)
    }

    /// Looks whether all is as it should be: the mesh is sound, no vertex inside has two edges only, and side vertices are
    /// not on curves. Gives the connectivity of the mesh.
    fn check(&self, repaired: &Repaired, paths: &[TaggedPath]) -> Result<Topology, NetworkError> {
        let first = self.of_vertex.keys().next().copied().unwrap_or(VertexId(0));
        let topology = Topology::new(&repaired.mesh).map_err(|_| stuck(first))?;
        let is_thin = |topology: &Topology, v: VertexId| topology.valence(v) == Valence::Interior(2);
        let was_thin = |v: VertexId| v.index() < self.topology.vertex_count() && is_thin(self.topology, v);
        let mut vertices = (0..topology.vertex_count() as u32).map(VertexId);
        if let Some(v) = vertices.find(|&v| is_thin(&topology, v) && !was_thin(v)) {
            return Err(stuck(v));
        }
        for (path, sides) in paths.iter().zip(&repaired.sides) {
            for (&v, sides) in path.vertices.iter().zip(sides) {
                let crossing = self.crossings.contains(&VertexId(v));
                if !crossing && sides.iter().any(|&u| self.on_network(VertexId(u))) {
                    return Err(stuck(VertexId(v)));
                }
            }
        }
        Ok(topology)
    }
}
