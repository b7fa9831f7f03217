//! Packing: quads joined into few rectangles by a motorcycle graph.
//!
//! From every irregular vertex a motorcycle runs along each of its edges, straight on through regular vertices, until
//! it meets a separator or the trace of another. What the traces leave between them are rectangles of quads, but for
//! closed strips and tori, which are cut once more. Ties are settled by numbers, so the result is the same every time.
//! After Eppstein, Goodrich, Kim and Tamstorf, Motorcycle graphs: canonical quad mesh partitioning (2008);
//! `docs/methods/packing.md`.

use super::requirements::is_irregular;
use super::{CornerClass, meetings};
use crate::math::Grid;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::rules::Level;
use std::collections::{BTreeMap, BTreeSet};

/// A quad inside a chart: its corner number `turn` stands at the `(0, 0)` corner of its cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Placed {
    pub(crate) quad: u32,
    pub(crate) turn: u32,
}

impl Placed {
    /// The base halfedge along side `side` of the cell, sides counted counter-clockwise from `v = 0`.
    pub(crate) fn halfedge(self, side: u32) -> HalfedgeId {
        HalfedgeId(4 * self.quad + (self.turn + side) % 4)
    }
}

/// A rectangle of quads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chart {
    pub(crate) quads: Grid<Placed>,
}

/// One chart per visible quad.
pub(crate) fn unpacked(base: &Level) -> Vec<Chart> {
    let quads = (0..base.topology().face_count() as u32).filter(|&f| base.is_visible(FaceId(f)));
    quads.map(|quad| Chart { quads: Grid::from_fn(1, 1, |_, _| Placed { quad, turn: 0 }) }).collect()
}

/// The ports of every meeting, straight on to the next irregular vertex, boundary or crease, in halfedges.
pub(crate) fn curves(cage: &Level) -> Vec<HalfedgeId> {
    let topology = cage.topology();
    let meetings = meetings(cage);
    let met: BTreeSet<VertexId> = meetings.iter().map(|fan| fan.vertex).collect();
    let mut along = Vec::new();
    for mut h in meetings.into_iter().flat_map(|fan| fan.halfedges.into_iter().step_by(2)) {
        // Once round at most: a curve may come back to where it began.
        for _ in 0..topology.edge_count() {
            along.push(h);
            let end = topology.target(h);
            let sharp = topology.is_boundary(end) || topology.ring(end).any(|h| cage.is_sharp(h));
            if sharp || met.contains(&end) || is_irregular(cage, end) {
                break;
            }
            let Some(across) = topology.twin(topology.next(h)) else { break };
            h = topology.next(across);
        }
    }
    along
}

/// Few rectangles that cover all visible quads; every irregular vertex is a corner of all its charts.
///
/// No chart crosses an edge of `seams`. Classes are those of quads, which come before other polygons.
pub(crate) fn pack(base: &Level, classes: &[[CornerClass; 4]], seams: &[HalfedgeId]) -> Vec<Chart> {
    let mut traces = Traces::new(base);
    seams.iter().for_each(|&h| traces.separate(h));
    traces.fire_from_irregular(classes);
    // Faces whose regions are still to be looked at, the first ones last.
    let faces = base.topology().face_count() as u32;
    let mut waiting: Vec<u32> = (0..faces).filter(|&f| base.is_visible(FaceId(f))).rev().collect();
    let mut charted = vec![false; faces as usize];
    let mut charts: Vec<(u32, Chart)> = Vec::new();
    while let Some(start) = waiting.pop() {
        if charted[start as usize] {
            continue;
        }
        let region = traces.flood(start);
        match traces.rectangle(&region) {
            Some(chart) => {
                region.cells.keys().for_each(|&quad| charted[quad as usize] = true);
                charts.push((start, chart));
            }
            None => {
                let faces: Vec<u32> = region.cells.into_keys().collect();
                traces.cut(&faces);
                waiting.extend(faces.into_iter().rev());
            }
        }
    }
    charts.sort_by_key(|&(first, _)| first);
    charts.into_iter().map(|(_, chart)| chart).collect()
}

struct Traces<'a> {
    base: &'a Level,
    /// By edge: no chart crosses it.
    separator: Vec<bool>,
    /// By vertex: a motorcycle that comes here stops.
    visited: Vec<bool>,
}

impl<'a> Traces<'a> {
    fn new(base: &'a Level) -> Traces<'a> {
        let topology = base.topology();
        let mut traces = Traces {
            base,
            separator: vec![false; topology.edge_count()],
            visited: vec![false; topology.vertex_count()],
        };
        for h in (0..topology.halfedge_count() as u32).map(HalfedgeId) {
            let hidden = |h: HalfedgeId| !base.is_visible(topology.face(h));
            if base.is_sharp(h) || topology.twin(h).is_some_and(|twin| hidden(h) != hidden(twin)) {
                traces.separator[topology.edge(h).index()] = true;
                traces.visited[topology.origin(h).index()] = true;
                traces.visited[topology.target(h).index()] = true;
            }
        }
        traces
    }

    fn separate(&mut self, h: HalfedgeId) {
        let topology = self.base.topology();
        self.separator[topology.edge(h).index()] = true;
        self.visited[topology.origin(h).index()] = true;
        self.visited[topology.target(h).index()] = true;
    }

    fn fire_from_irregular(&mut self, classes: &[[CornerClass; 4]]) {
        let topology = self.base.topology();
        let mut start = Vec::new();
        for v in (0..topology.vertex_count() as u32).map(VertexId) {
            let corner = |h: HalfedgeId| classes.get(h.index() / 4).map(|corners| corners[h.index() % 4]);
            let regular = |h| corner(h).is_none_or(|class| class == CornerClass::Regular);
            let irregular = !topology.ring(v).all(regular);
            if irregular || self.is_reentrant(v) {
                self.visited[v.index()] = true;
                start.extend(topology.ring(v).filter(|&h| self.is_open(h)));
            }
        }
        self.run(start);
    }

    /// True if visible faces around `v`, between separators, make neither a corner nor a straight side.
    fn is_reentrant(&self, v: VertexId) -> bool {
        let topology = self.base.topology();
        let ring: Vec<HalfedgeId> = topology.ring(v).collect();
        let Some(first) = ring.iter().position(|&h| self.is_separator(h)) else { return false };
        let mut faces = 0;
        (0..ring.len()).any(|i| {
            let h = ring[(first + i) % ring.len()];
            let next = ring[(first + i + 1) % ring.len()];
            faces += u32::from(self.base.is_visible(topology.face(h)));
            let ends = self.is_separator(topology.prev(h)) || self.is_separator(next);
            ends && std::mem::take(&mut faces) > 2
        })
    }

    fn is_separator(&self, h: HalfedgeId) -> bool {
        self.separator[self.base.topology().edge(h).index()]
    }

    /// True if a motorcycle may run along the halfedge.
    fn is_open(&self, h: HalfedgeId) -> bool {
        !self.is_separator(h) && self.base.is_visible(self.base.topology().face(h))
    }

    /// Runs motorcycles in rounds until all have stopped.
    fn run(&mut self, mut living: Vec<HalfedgeId>) {
        let topology = self.base.topology();
        while !living.is_empty() {
            living.sort_unstable_by_key(|&h| (topology.origin(h), topology.target(h)));
            living.retain_mut(|h| {
                let edge = topology.edge(*h).index();
                if std::mem::replace(&mut self.separator[edge], true) {
                    return false;
                }
                let end = topology.target(*h).index();
                if std::mem::replace(&mut self.visited[end], true) {
                    return false;
                }
                // Vertices not yet visited are regular and inside: straight on is two edges round.
                match topology.twin(topology.next(*h)) {
                    Some(across) => *h = topology.next(across),
                    None => return false,
                }
                true
            });
        }
    }

    /// Cuts a region that is no rectangle along one line that crosses it.
    fn cut(&mut self, region: &[u32]) {
        let topology = self.base.topology();
        let mut inner: Vec<HalfedgeId> = region
            .iter()
            .flat_map(|&f| topology.halfedges(FaceId(f)))
            .filter(|&h| !self.is_separator(h) && topology.twin(h).is_some_and(|twin| h < twin))
            .collect();
        inner.sort_unstable_by_key(|&h| topology.edge(h));
        let ends = |h: HalfedgeId| [topology.origin(h), topology.target(h)];
        let crossing = inner.iter().copied().find(|&h| ends(h).iter().any(|v| self.visited[v.index()]));
        let Some(h) = crossing.or(inner.first().copied()) else { return };
        // Both ways: the edge itself is marked by the first, so the other starts behind it.
        let twin = topology.twin(h);
        let behind = twin.filter(|_| !std::mem::replace(&mut self.visited[topology.origin(h).index()], true));
        let behind =
            behind.and_then(|twin| topology.twin(topology.next(twin))).map(|across| topology.next(across));
        self.run(std::iter::once(h).chain(behind).collect());
    }

    /// Lays the faces connected with `start` out on the integer grid.
    fn flood(&self, start: u32) -> Region {
        let topology = self.base.topology();
        let mut cells = BTreeMap::from([(start, Cell { i: 0, j: 0, turn: 0 })]);
        let mut consistent = true;
        let mut queue = vec![start];
        while let Some(quad) = queue.pop() {
            let cell = cells[&quad];
            for side in 0..4 {
                let h = Placed { quad, turn: cell.turn }.halfedge(side);
                let Some(twin) = topology.twin(h).filter(|_| !self.is_separator(h)) else { continue };
                let (di, dj) = [(0, -1), (1, 0), (0, 1), (-1, 0)][side as usize];
                // The shared side is the neighbour's side `side + 2`.
                let turn = (twin.0 % 4 + 4 - (side + 2) % 4) % 4;
                let expected = Cell { i: cell.i + di, j: cell.j + dj, turn };
                match cells.insert(twin.0 / 4, expected) {
                    None => queue.push(twin.0 / 4),
                    Some(found) => {
                        consistent &= found == expected;
                        cells.insert(twin.0 / 4, found);
                    }
                }
            }
        }
        Region { cells, consistent }
    }

    /// The region as a chart, if it is a full rectangle without separators inside.
    fn rectangle(&self, region: &Region) -> Option<Chart> {
        let low = |of: fn(&Cell) -> i32| region.cells.values().map(of).min().unwrap_or(0);
        let high = |of: fn(&Cell) -> i32| region.cells.values().map(of).max().unwrap_or(0);
        let (i0, j0) = (low(|c| c.i), low(|c| c.j));
        let (width, height) = ((high(|c| c.i) - i0 + 1) as usize, (high(|c| c.j) - j0 + 1) as usize);
        if !region.consistent || region.cells.len() != width * height {
            return None;
        }
        let mut grid = Grid::from_fn(width, height, |_, _| None);
        for (&quad, cell) in &region.cells {
            grid[((cell.i - i0) as usize, (cell.j - j0) as usize)] = Some(Placed { quad, turn: cell.turn });
        }
        let inside = |i: usize, j: usize, side: u32| {
            grid[(i, j)].is_some_and(|placed: Placed| !self.is_separator(placed.halfedge(side)))
        };
        let whole = (0..width).all(|i| {
            (0..height).all(|j| {
                grid[(i, j)].is_some()
                    && (i + 1 == width || inside(i, j, 1))
                    && (j + 1 == height || inside(i, j, 2))
            })
        });
        whole.then(|| Chart { quads: grid.map(|placed| placed.unwrap_or(Placed { quad: 0, turn: 0 })) })
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
struct Cell {
    i: i32,
    j: i32,
    turn: u32,
}

struct Region {
    cells: BTreeMap<u32, Cell>,
    /// False if a face was met again in another place: the region closes on itself.
    consistent: bool,
}
