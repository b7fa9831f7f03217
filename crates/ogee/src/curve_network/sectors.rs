//! `Sectors`: the faces around the vertices of a network, between the edges that carry curves, and which of them need a new
//! side vertex.

use super::defect::{NetworkDefect, NetworkError};
use super::incidence::{edge_between, is_border};
use super::repair::{MeetingPorts, TaggedPath};
use crate::mesh::{FaceId, HalfedgeId, Topology, VertexId};
use std::collections::{BTreeMap, BTreeSet};

/// A part of the faces around a vertex, between two tagged edges or a tagged edge and the border.
pub(super) struct Sector {
    pub(super) vertex: VertexId,
    /// The halfedges that leave the vertex, one per face, counter-clockwise.
    pub(super) halfedges: Vec<HalfedgeId>,
    /// The neighbours along untagged edges, counter-clockwise.
    pub(super) untagged: Vec<VertexId>,
    /// True if the first or last untagged edge lies on the border.
    pub(super) border: bool,
    pub(super) dummies: usize,
    /// Whether it gets new vertices.
    pub(super) new: bool,
    /// Those: free spoke, then, for each dummy port, corner, port, corner, free spoke.
    pub(super) chain: Vec<u32>,
}

impl Sector {
    /// The side vertex at its first tagged edge, or at its last.
    pub(super) fn side(&self, last: bool) -> u32 {
        let ends = |list: &[u32]| if last { list.last().copied() } else { list.first().copied() };
        let kept = if last { self.untagged.last() } else { self.untagged.first() };
        ends(&self.chain).or(kept.map(|v| v.0)).unwrap_or(self.vertex.0)
    }

    /// The part of the chain that belongs to the face of halfedge `i`.
    pub(super) fn portion(&self, i: usize) -> std::ops::RangeInclusive<usize> {
        let (length, faces) = (self.chain.len() - 1, self.halfedges.len());
        let at = |i: usize| (2 * length * i + faces) / (2 * faces);
        at(i)..=at(i + 1)
    }
}

/// The mesh around the network as it is, cut into sectors.
pub(super) struct Sectors<'a> {
    pub(super) topology: &'a Topology,
    pub(super) tagged: BTreeSet<u32>,
    pub(super) crossings: BTreeSet<VertexId>,
    pub(super) list: Vec<Sector>,
    /// Which sector a corner is in, and its number there, by the halfedge that leaves the corner.
    pub(super) of_corner: BTreeMap<HalfedgeId, (usize, usize)>,
    /// The vertices with tagged edges, and their sectors in counter-clockwise order.
    pub(super) of_vertex: BTreeMap<VertexId, Vec<usize>>,
}

/// The pairs of neighbours along a path.
fn legs(path: &TaggedPath) -> impl Iterator<Item = [VertexId; 2]> + '_ {
    let vertices = &path.vertices;
    let back = path.closed.then(|| Some([*vertices.last()?, *vertices.first()?])).flatten();
    vertices.windows(2).map(|pair| [pair[0], pair[1]]).chain(back).map(|pair| pair.map(VertexId))
}

impl<'a> Sectors<'a> {
    pub(super) fn new(topology: &'a Topology, paths: &[TaggedPath]) -> Result<Sectors<'a>, NetworkError> {
        let mut sectors = Sectors {
            topology,
            tagged: BTreeSet::new(),
            crossings: BTreeSet::new(),
            list: Vec::new(),
            of_corner: BTreeMap::new(),
            of_vertex: BTreeMap::new(),
        };
        for (number, path) in paths.iter().enumerate() {
            for [from, to] in legs(path) {
                let inside = from.index().max(to.index()) < topology.vertex_count();
                let edge = if inside { edge_between(topology, from, to) } else { None };
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

    pub(super) fn is_tagged(&self, h: HalfedgeId) -> bool {
        self.tagged.contains(&self.topology.edge(h).0)
    }

    pub(super) fn on_network(&self, v: VertexId) -> bool {
        self.of_vertex.contains_key(&v)
    }

    /// Cuts the faces around a vertex.
    pub(super) fn cut(&mut self, v: VertexId) {
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

    pub(super) fn plan_dummies(&mut self, meetings: &[MeetingPorts]) {
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
    pub(super) fn choose_new(&mut self, meetings: &[MeetingPorts], forced: bool) {
        let valid: BTreeMap<VertexId, bool> =
            meetings.iter().map(|m| VertexId(m.vertex)).map(|v| (v, self.is_valid_meeting(v))).collect();
        for number in 0..self.list.len() {
            let sector = &self.list[number];
            let new = match valid.get(&sector.vertex) {
                Some(valid) => !valid,
                None if self.crossings.contains(&sector.vertex) => false,
                None => match sector.untagged[..] {
                    [side] => self.on_network(side),
                    _ => true,
                },
            };
            let forced = forced && !sector.border && !self.crossings.contains(&sector.vertex);
            self.list[number].new = new || forced;
        }
        // A vertex without valid ring is new all round.
        for (v, valid) in valid {
            let numbers = self.of_vertex.get(&v).cloned().unwrap_or_default();
            let new = !valid || numbers.iter().any(|&number| self.list[number].new);
            numbers.iter().for_each(|&number| self.list[number].new = new);
        }
        let meetings: BTreeSet<u32> = meetings.iter().map(|meeting| meeting.vertex).collect();
        while self.propagate(&meetings) {}
    }

    /// True if the ring of a meeting point is an X-configuration as it is.
    pub(super) fn is_valid_meeting(&self, v: VertexId) -> bool {
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

    /// The smooth crossing that a face touches.
    pub(super) fn crossing_of(&self, f: FaceId) -> Option<VertexId> {
        self.topology.halfedges(f).map(|h| self.topology.origin(h)).find(|v| self.crossings.contains(v))
    }

    /// One round of sectors that must be new because of their neighbours; true if there was any.
    pub(super) fn propagate(&mut self, meetings: &BTreeSet<u32>) -> bool {
        let topology = self.topology;
        let mut more = BTreeSet::new();
        for (&h, &(start, i)) in &self.of_corner {
            // The sectors on the left of a tagged edge, at both of its ends.
            if i == 0
                && self.is_tagged(h)
                && self.crossing_of(topology.face(h)).is_none()
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
            if meetings.contains(&v.0) {
                more.extend(&self.of_vertex[&v]);
            }
        }
        let before = self.list.iter().filter(|sector| sector.new).count();
        more.into_iter().for_each(|number| self.list[number].new = true);
        before < self.list.iter().filter(|sector| sector.new).count()
    }

    /// Vertices of paths that follow the border.
    pub(super) fn rim(&self, paths: &[TaggedPath]) -> BTreeSet<VertexId> {
        let border = |pair: &[VertexId; 2]| {
            edge_between(self.topology, pair[0], pair[1]).is_some_and(|edge| is_border(self.topology, edge))
        };
        paths.iter().flat_map(|path| legs(path).filter(border).flatten()).collect()
    }

    pub(super) fn is_new(&self, corner: HalfedgeId) -> bool {
        self.of_corner.get(&corner).is_some_and(|&(number, _)| self.list[number].new)
    }

    /// Side vertices along a path.
    pub(super) fn sides(&self, path: &TaggedPath) -> Vec<[u32; 2]> {
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
            let left = &self.list[*numbers.iter().find(begins)?];
            let right = &self.list[*numbers.iter().find(ends)?];
            if self.crossings.contains(&v) {
                // The neighbours along the other curve.
                let end = topology.origin(topology.prev(*left.halfedges.last()?));
                return Some([end.0, topology.target(right.halfedges[0]).0]);
            }
            Some([left.side(false), right.side(true)])
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
    pub(super) fn ring(&self, v: VertexId) -> Vec<u32> {
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
}
