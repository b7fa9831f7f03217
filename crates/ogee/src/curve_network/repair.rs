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
use super::incidence::is_border;
use crate::math::Vec3;
use crate::mesh::{ControlMesh, FaceId, FaceList, HalfedgeId, Topology, VertexId};
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
    /// The mesh: old vertices first, with their numbers. It has the tags of the old one but no texture coordinates.
    pub mesh: ControlMesh,
    /// For each face the face of the old mesh that it is part of.
    pub source_faces: Vec<u32>,
    /// For each path and each of its vertices the side vertices on the left and on the right, walking along the path seen
    /// from outside. Beside an end at a meeting point they are free spokes. Empty for paths along the border.
    pub sides: Vec<Vec<[u32; 2]>>,
    /// For each meeting point its spokes, counter-clockwise: ports at even places, free spokes at odd ones.
    pub rings: Vec<Vec<u32>>,
}

/// A part of the faces around a vertex, between two tagged edges or a tagged edge and the border.
struct Sector {
    vertex: VertexId,
    /// The halfedges that leave the vertex, one per face, counter-clockwise.
    halfedges: Vec<HalfedgeId>,
    /// The neighbours along untagged edges, counter-clockwise.
    untagged: Vec<VertexId>,
    /// True if the first or last untagged edge lies on the border.
    border: bool,
    dummies: usize,
    /// Whether it gets new vertices.
    new: bool,
    /// Those: free spoke, then, for each dummy port, corner, port, corner, free spoke.
    chain: Vec<u32>,
}

impl Sector {
    /// The side vertex at its first tagged edge, or at its last.
    fn side(&self, last: bool) -> u32 {
        let ends = |list: &[u32]| if last { list.last().copied() } else { list.first().copied() };
        let kept = if last { self.untagged.last() } else { self.untagged.first() };
        ends(&self.chain).or(kept.map(|v| v.0)).unwrap_or(self.vertex.0)
    }

    /// The part of the chain that belongs to the face of halfedge `i`.
    fn portion(&self, i: usize) -> std::ops::RangeInclusive<usize> {
        let (length, faces) = (self.chain.len() - 1, self.halfedges.len());
        let at = |i: usize| (2 * length * i + faces) / (2 * faces);
        at(i)..=at(i + 1)
    }
}

/// The mesh around the network as it is, cut into sectors.
struct Sectors<'a> {
    topology: &'a Topology,
    tagged: BTreeSet<u32>,
    list: Vec<Sector>,
    /// Which sector a corner is in, and its number there, by the halfedge that leaves the corner.
    of_corner: BTreeMap<HalfedgeId, (usize, usize)>,
    /// The vertices with tagged edges, and their sectors in counter-clockwise order.
    of_vertex: BTreeMap<VertexId, Vec<usize>>,
}

/// Makes room for a network of curves. Edges along the border are no business of it.
///
/// # Errors
/// If the mesh is not sound, a path leaves its edges, or there is no room: then one more split before makes it.
pub fn repair(
    mesh: &ControlMesh,
    paths: &[TaggedPath],
    meetings: &[MeetingPorts],
    ribbons: Ribbons,
) -> Result<Repaired, NetworkError> {
    let topology = Topology::new(mesh).map_err(|error| NetworkError {
        defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
    })?;
    let mut sectors = Sectors::new(&topology, paths)?;
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
    let mut repaired = ControlMesh { points, faces, uv: None, ..mesh.clone() };
    let holes: BTreeSet<u32> = mesh.holes.iter().copied().collect();
    repaired.holes =
        (0..).zip(&source_faces).filter(|(_, source)| holes.contains(source)).map(|(f, _)| f).collect();
    let sides = paths.iter().map(|path| sectors.sides(path)).collect();
    let rings = meetings.iter().map(|meeting| sectors.ring(VertexId(meeting.vertex))).collect();
    let repaired = Repaired { mesh: repaired, source_faces, sides, rings };
    sectors.check(&repaired)?;
    Ok(repaired)
}

fn stuck(v: VertexId) -> NetworkError {
    NetworkError { defects: vec![NetworkDefect::Repair { vertex: v.0 }] }
}

/// The pairs of neighbours along a path.
fn legs(path: &TaggedPath) -> impl Iterator<Item = [VertexId; 2]> + '_ {
    let vertices = &path.vertices;
    let back = path.closed.then(|| Some([*vertices.last()?, *vertices.first()?])).flatten();
    vertices.windows(2).map(|pair| [pair[0], pair[1]]).chain(back).map(|pair| pair.map(VertexId))
}

impl<'a> Sectors<'a> {
    fn new(topology: &'a Topology, paths: &[TaggedPath]) -> Result<Sectors<'a>, NetworkError> {
        let mut sectors = Sectors {
            topology,
            tagged: BTreeSet::new(),
            list: Vec::new(),
            of_corner: BTreeMap::new(),
            of_vertex: BTreeMap::new(),
        };
        for (number, path) in paths.iter().enumerate() {
            for [from, to] in legs(path) {
                let inside = from.index().max(to.index()) < topology.vertex_count();
                let edge = if inside { super::incidence::edge_between(topology, from, to) } else { None };
                let Some(edge) = edge else {
                    let curve = format!("number {number}");
                    let defect = NetworkDefect::NotAnEdge { curve, from: from.0, to: to.0 };
                    return Err(NetworkError { defects: vec![defect] });
                };
                if !is_border(topology, edge) {
                    sectors.tagged.insert(edge.0);
                    sectors.of_vertex.entry(from).or_default();
                    sectors.of_vertex.entry(to).or_default();
                }
            }
        }
        let vertices: Vec<VertexId> = sectors.of_vertex.keys().copied().collect();
        for v in vertices {
            sectors.cut(v);
        }
        Ok(sectors)
    }

    fn is_tagged(&self, h: HalfedgeId) -> bool {
        self.tagged.contains(&self.topology.edge(h).0)
    }

    fn on_network(&self, v: VertexId) -> bool {
        self.of_vertex.contains_key(&v)
    }

    /// Cuts the faces around a vertex.
    fn cut(&mut self, v: VertexId) {
        let topology = self.topology;
        let mut ring: Vec<HalfedgeId> = topology.ring(v).collect();
        if !topology.is_boundary(v) {
            let start = ring.iter().position(|&h| self.is_tagged(h)).unwrap_or(0);
            ring.rotate_left(start);
        }
        let mut numbers = Vec::new();
        // A tagged edge begins a sector, and so does the border.
        for (i, &h) in ring.iter().enumerate() {
            let tagged = self.is_tagged(h);
            if i == 0 || tagged {
                numbers.push(self.list.len());
                self.list.push(Sector {
                    vertex: v,
                    halfedges: Vec::new(),
                    untagged: Vec::new(),
                    border: !tagged,
                    dummies: 0,
                    new: false,
                    chain: Vec::new(),
                });
            }
            let number = self.list.len() - 1;
            let sector = &mut self.list[number];
            self.of_corner.insert(h, (number, sector.halfedges.len()));
            sector.halfedges.push(h);
            if !tagged {
                sector.untagged.push(topology.target(h));
            }
        }
        if let (Some(&last), Some(sector)) = (ring.last(), self.list.last_mut()) {
            let end = topology.prev(last);
            if topology.twin(end).is_none() {
                sector.untagged.push(topology.origin(end));
                sector.border = true;
            }
        }
        self.of_vertex.insert(v, numbers);
    }

    fn plan_dummies(&mut self, meetings: &[MeetingPorts]) {
        for meeting in meetings {
            let numbers = self.of_vertex.get(&VertexId(meeting.vertex)).cloned().unwrap_or_default();
            for number in numbers {
                let sector = &mut self.list[number];
                let start = self.topology.target(sector.halfedges[0]);
                let planned = meeting.dummies.iter().find(|planned| planned.0 == start.0);
                sector.dummies = planned.map_or(0, |planned| planned.1);
            }
        }
    }

    /// Decides which sectors get new vertices.
    fn choose_new(&mut self, meetings: &[MeetingPorts], forced: bool) {
        let valid: BTreeMap<VertexId, bool> =
            meetings.iter().map(|m| VertexId(m.vertex)).map(|v| (v, self.is_valid_meeting(v))).collect();
        for number in 0..self.list.len() {
            let sector = &self.list[number];
            let new = match valid.get(&sector.vertex) {
                Some(valid) => !valid,
                None => match sector.untagged[..] {
                    [side] => self.on_network(side),
                    _ => true,
                },
            };
            self.list[number].new = new || (forced && !sector.border);
        }
        // A vertex without valid ring is new all round.
        for (v, valid) in valid {
            let numbers = self.of_vertex.get(&v).cloned().unwrap_or_default();
            let new = !valid || numbers.iter().any(|&number| self.list[number].new);
            numbers.iter().for_each(|&number| self.list[number].new = new);
        }
        while self.propagate(meetings) {}
    }

    /// True if the ring of a meeting point is an X-configuration as it is.
    fn is_valid_meeting(&self, v: VertexId) -> bool {
        let Some(numbers) = self.of_vertex.get(&v) else { return false };
        let odd = numbers.iter().all(|&number| {
            let sector = &self.list[number];
            sector.untagged.len() == 1 + 2 * sector.dummies && !sector.border
        });
        let topology = self.topology;
        let quads = topology.ring(v).all(|h| topology.face_size(topology.face(h)) == 4);
        let corners: Vec<VertexId> = topology.ring(v).map(|h| topology.target(topology.next(h))).collect();
        let distinct: BTreeSet<VertexId> = corners.iter().copied().collect();
        let untagged = numbers.iter().flat_map(|&number| &self.list[number].untagged);
        odd && quads
            && distinct.len() == corners.len()
            && !corners.iter().chain(untagged).any(|&u| self.on_network(u) || u == v)
    }

    /// One round of sectors that must be new because of their neighbours; true if there was any.
    fn propagate(&mut self, meetings: &[MeetingPorts]) -> bool {
        let topology = self.topology;
        let mut more = BTreeSet::new();
        for (&h, &(start, i)) in &self.of_corner {
            // The sectors on the left of a tagged edge, at both of its ends.
            if i == 0
                && self.is_tagged(h)
                && let Some(&(end, _)) = self.of_corner.get(&topology.next(h))
                && !self.list[start].new
                && !self.list[end].new
                && self.list[start].side(false) == self.list[end].side(true)
            {
                more.extend([start, end]);
            }
        }
        for sector in &self.list {
            // One face between two tagged edges: the sectors beyond them, in the same face.
            let ([h], [], true) = (&sector.halfedges[..], &sector.untagged[..], sector.new) else { continue };
            let first = self.of_corner.get(&topology.next(*h)).map(|corner| corner.0);
            let last = self.of_corner.get(&topology.prev(*h)).map(|corner| corner.0);
            if let (Some(first), Some(last)) = (first, last)
                && !self.list[first].new
                && !self.list[last].new
                && self.list[first].side(true) == self.list[last].side(false)
            {
                more.extend([first, last]);
            }
        }
        for number in more.clone() {
            let v = self.list[number].vertex;
            if meetings.iter().any(|meeting| meeting.vertex == v.0) {
                more.extend(&self.of_vertex[&v]);
            }
        }
        let before = self.list.iter().filter(|sector| sector.new).count();
        more.into_iter().for_each(|number| self.list[number].new = true);
        before < self.list.iter().filter(|sector| sector.new).count()
    }

    /// Vertices of paths that follow the border.
    fn rim(&self, paths: &[TaggedPath]) -> BTreeSet<VertexId> {
        let border = |pair: &[VertexId; 2]| {
            super::incidence::edge_between(self.topology, pair[0], pair[1])
                .is_some_and(|edge| is_border(self.topology, edge))
        };
        paths.iter().flat_map(|path| legs(path).filter(border).flatten()).collect()
    }

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
            let mut rest: Vec<u32> = Vec::new();
            // The chain's part in this face, as places in the rest.
            let mut chain: Option<(VertexId, Vec<usize>)> = None;
            for h in topology.halfedges(f) {
                let v = topology.origin(h);
                match self.of_corner.get(&h).map(|&(number, i)| (&self.list[number], i)) {
                    Some((sector, i)) if sector.new => {
                        let portion = sector.portion(i);
                        let (start, end) = (*portion.start(), *portion.end());
                        let inner = portion.clone().rev().filter(|k| k % 2 == 1 && start < *k && *k < end);
                        let corners: Vec<usize> = inner.map(|k| rest.len() + end - k).collect();
                        rest.extend(portion.rev().map(|k| sector.chain[k]));
                        if !corners.is_empty() && chain.replace((v, corners)).is_some() {
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
            for piece in self.pieces(rest, chain)?.iter().filter(|piece| piece.len() >= 3) {
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
    /// three edges.
    fn pieces(
        &self,
        rest: Vec<u32>,
        chain: Option<(VertexId, Vec<usize>)>,
    ) -> Result<Vec<Vec<u32>>, NetworkError> {
        let Some((v, corners)) = chain else { return Ok(vec![rest]) };
        let count = rest.len();
        let (first, last) = (corners[0], corners[corners.len() - 1]);
        // Around from the last corner to the first: everything beyond the chain, as places from `first` on.
        let turned: Vec<u32> = (0..count).map(|k| rest[(first + k) % count]).collect();
        let corners: Vec<usize> = corners.iter().map(|&k| k - first).collect();
        let is_old = |k: &usize| {
            let u = VertexId(turned[*k]);
            u.index() < self.topology.vertex_count() && !self.on_network(u)
        };
        let beyond: Vec<usize> = (last - first + 2..count.saturating_sub(1)).filter(is_old).collect();
        let beside = |k: &usize| *k == last - first + 2 || *k + 2 == count;
        let far: Vec<usize> = beyond.iter().copied().filter(|k| !beside(k)).collect();
        let goals = if far.is_empty() { beyond } else { far };
        if goals.is_empty() {
            return Err(stuck(v));
        }
        // The first corner looks at the last goal, so that chords do not cross.
        let goal = |i: usize| {
            let steps = (corners.len() - 1).max(1);
            let from_end =
                if corners.len() == 1 { (goals.len() - 1) / 2 } else { i * (goals.len() - 1) / steps };
            goals[goals.len() - 1 - from_end]
        };
        let mut pieces = vec![std::iter::once(turned[0]).chain(turned[goal(0)..].iter().copied()).collect()];
        for i in 1..corners.len() {
            let near = &turned[corners[i - 1]..=corners[i]];
            let (from, to) = (goal(i), goal(i - 1));
            pieces.push(near.iter().chain(&turned[from..=to]).copied().collect::<Vec<u32>>());
        }
        let end = corners.len() - 1;
        pieces.push(turned[corners[end]..=goal(end)].to_vec());
        Ok(pieces)
    }

    /// Side vertices along a path.
    fn sides(&self, path: &TaggedPath) -> Vec<[u32; 2]> {
        let topology = self.topology;
        let count = path.vertices.len();
        let at = |i: usize| VertexId(path.vertices[i % count]);
        let towards = |v: VertexId, u: VertexId| {
            let numbers = self.of_vertex.get(&v)?;
            // The sector that begins with the edge, and the one that ends with it.
            let begins = |number: &&usize| {
                let h = self.list[**number].halfedges[0];
                topology.target(h) == u && self.is_tagged(h)
            };
            let ends = |number: &&usize| {
                let h = self.list[**number].halfedges.last().map(|&h| topology.prev(h));
                h.is_some_and(|h| topology.origin(h) == u && self.is_tagged(h))
            };
            let left = numbers.iter().find(begins)?;
            let right = numbers.iter().find(ends)?;
            Some([self.list[*left].side(false), self.list[*right].side(true)])
        };
        let side = |i: usize| {
            if path.closed || i + 1 < count {
                towards(at(i), at(i + 1))
            } else {
                towards(at(i), at(i.checked_sub(1)?)).map(|[left, right]| [right, left])
            }
        };
        (0..count).map(side).collect::<Option<_>>().unwrap_or_default()
    }

    /// The spokes of a meeting point.
    fn ring(&self, v: VertexId) -> Vec<u32> {
        let mut ring = Vec::new();
        for &number in self.of_vertex.get(&v).map_or(&[][..], Vec::as_slice) {
            let sector = &self.list[number];
            ring.push(self.topology.target(sector.halfedges[0]).0);
            if sector.new {
                ring.extend(sector.chain.iter().step_by(2));
            } else {
                ring.extend(sector.untagged.iter().map(|u| u.0));
            }
        }
        ring
    }

    /// Looks whether all is as it should be: the mesh is sound, no vertex inside has two edges only, side vertices are not
    /// on curves, and no point belongs to two X-configurations.
    fn check(&self, repaired: &Repaired) -> Result<(), NetworkError> {
        let topology = Topology::new(&repaired.mesh).map_err(|_| {
            let v = self.of_vertex.keys().next().copied().unwrap_or(VertexId(0));
            stuck(v)
        })?;
        let count = topology.vertex_count() as u32;
        let thin = (0..count).map(VertexId).find(|&v| {
            let faces = topology.ring(v).count();
            !topology.is_boundary(v)
                && faces == 2
                && (v.index() >= self.topology.vertex_count() || self.topology.ring(v).count() > 2)
        });
        if let Some(v) = thin {
            return Err(stuck(v));
        }
        let mut claimed = BTreeSet::new();
        for ring in &repaired.rings {
            let free = ring.iter().copied().filter(|&u| !self.on_network(VertexId(u)));
            if let Some(u) = free.into_iter().find(|&u| !claimed.insert(u)) {
                return Err(stuck(VertexId(u)));
            }
        }
        let on_network = repaired.sides.iter().flatten().flatten().find(|&&u| self.on_network(VertexId(u)));
        on_network.map_or(Ok(()), |&u| Err(stuck(VertexId(u))))
    }
}
