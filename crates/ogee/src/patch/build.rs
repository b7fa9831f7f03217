//! Growing the trees of a [`PatchTable`].
//!
//! Faces are looked at level by level, not one by one: what has to be split at a level is taken out with what touches
//! it and refined as one small level, whose quads are looked at next. Points of deeper levels are kept as weights on the
//! cage. Most faces never come here: where no tag and no boundary is near, [`super::roots`] is quicker; the test
//! `the_quick_way_makes_the_same_table` holds the two together.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::chain::ChainBasis;
use super::kind::Kind;
use super::points::{Below, Points};
use super::surroundings::{CornerKind, Mirrored, Surroundings};
use super::table::{PatchTable, Sources};
use super::tree::{Node, Piece, Tail};
use super::{Neighbourhood, with_ring};
use crate::math::par;
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId, VertexId};
use crate::rules::Level;
use crate::stencil::StencilTable;

/// The table of a level.
pub(super) fn table(level: &Level) -> PatchTable {
    // Two steps ahead there are sixteen times as many halfedges, which have to have numbers.
    grow(level, u32::MAX as usize / 16)
}

/// With fewer halfedges than `ahead_limit` some of what has to be split goes the quick way.
fn grow(level: &Level, ahead_limit: usize) -> PatchTable {
    let starts = starts(level);
    let faces = level.topology().face_count();
    let roots = if starts.is_empty() { 0..faces as u32 } else { 0..starts[faces] };
    let hidden = |&root: &u32| !level.is_visible(face_of(&starts, root));
    let table = PatchTable {
        cage_count: level.topology().vertex_count(),
        hidden: if level.hidden_faces().is_empty() {
            Vec::new()
        } else {
            roots.clone().filter(hidden).collect()
        },
        starts,
        roots: Vec::new(),
        leaves: Vec::new(),
        splits: Vec::new(),
        tails: Vec::new(),
        rings: Vec::new(),
        kinds: Vec::new(),
        local: StencilTable::empty(),
        users: OnceLock::new(),
    };
    let mut builder = Builder { table, kinds: HashMap::new(), smooth: Vec::new() };
    let mut targets = match level.topology().as_quads() {
        Some(quads) => builder.plain_roots(level, &quads, ahead_limit),
        None => builder.plain_roots(level, level.topology(), ahead_limit),
    };
    let mut below: Option<Below> = None;
    while !targets.is_empty() {
        let level = below.as_ref().map_or(level, |below| &below.level);
        let split = builder.settle(level, below.as_ref(), targets);
        if split.is_empty() {
            break;
        }
        let (next, next_targets) = builder.refine(level, below.as_ref(), split);
        (below, targets) = (Some(next), next_targets);
    }
    builder.table
}

/// For each face its first parametric face, and their number at the end; nothing where all are quads.
fn starts(level: &Level) -> Vec<u32> {
    let topology = level.topology();
    if topology.is_quads() {
        return Vec::new();
    }
    let mut starts = vec![0];
    let mut count = 0;
    for f in 0..topology.face_count() as u32 {
        count += match topology.face_size(FaceId(f)) {
            4 => 1,
            corners => corners,
        };
        starts.push(count);
    }
    starts
}

pub(super) fn face_of(starts: &[u32], root: u32) -> FaceId {
    if starts.is_empty() {
        return FaceId(root);
    }
    FaceId(starts.partition_point(|&start| start <= root) as u32 - 1)
}

/// A face that is not settled yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    pub(super) face: FaceId,
    /// Which of its own corners is at `(0, 0)`.
    pub(super) corner: u32,
    pub(super) slot: Slot,
}

/// Where its node goes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Slot {
    Root(u32),
    Child {
        split: u32,
        corner: u32,
    },
    /// A polygon: its corners are roots, this one the first.
    Corners {
        first: u32,
    },
}

/// What is found out about a quad without writing anything.
enum Found {
    Leaf(Box<[Mirrored; 16]>),
    Tail { corner: u32, kind: Kind, ring: Vec<Mirrored> },
    Split,
}

pub(super) struct Builder {
    pub(super) table: PatchTable,
    /// Numbers of kinds; smooth ones, which nearly all are, by valence.
    kinds: HashMap<Kind, u32>,
    pub(super) smooth: Vec<u32>,
}

/// A kind without number.
const UNKNOWN: u32 = u32::MAX;

impl Builder {
    /// The number of a kind of chain.
    pub(super) fn kind(&mut self, kind: Kind) -> u32 {
        let kinds = &mut self.table.kinds;
        let mut new = || {
            kinds.push(ChainBasis::new(kind));
            kinds.len() as u32 - 1
        };
        let Kind::Smooth { valence } = kind else { return *self.kinds.entry(kind).or_insert_with(new) };
        let valence = valence as usize;
        if self.smooth.len() <= valence {
            self.smooth.resize(valence + 1, UNKNOWN);
        }
        if self.smooth[valence] == UNKNOWN {
            self.smooth[valence] = new();
        }
        self.smooth[valence]
    }

    /// The number of the next local point.
    pub(super) fn next_point(&self) -> u32 {
        (self.table.cage_count + self.table.local.len()) as u32
    }

    /// Where the next ring begins.
    pub(super) fn ring_start(&self) -> u32 {
        u32::try_from(self.table.rings.len()).expect("fewer than 2^32 numbers in the rings of a table")
    }

    pub(super) fn tail(&mut self, tail: Tail) -> Node {
        self.table.tails.push(tail);
        Node::new(Piece::Tail(self.table.tails.len() as u32 - 1))
    }

    pub(super) fn leaf(&mut self, slot: Slot, net: [u32; 16]) {
        if let Slot::Root(root) = slot {
            self.table.roots[root as usize] = Sources(net);
            return;
        }
        self.table.leaves.push(Sources(net));
        let index = self.table.leaves.len() as u32 - 1;
        self.place(slot, Node::new(Piece::Leaf(index)));
    }

    pub(super) fn place(&mut self, slot: Slot, node: Node) {
        match slot {
            Slot::Root(root) | Slot::Corners { first: root } => {
                self.table.roots[root as usize] = match node.piece() {
                    Piece::Tail(tail) => Sources::tail(node, self.table.tails[tail as usize]),
                    _ => Sources::node(node),
                };
            }
            Slot::Child { split, corner } => self.table.splits[split as usize][corner as usize] = node,
        }
    }

    /// Writes leaves and tails; gives what has to be split. `below` is `None` for the cage itself.
    fn settle(&mut self, level: &Level, below: Option<&Below>, mut targets: Vec<Target>) -> Vec<Target> {
        let named = below.map_or(0, |below| below.level.topology().vertex_count());
        let mut points = Points::new(named, self.next_point());
        // What is plain on the cage is settled.
        if let (Some(_), Some(quads)) = (below, level.topology().as_quads()) {
            targets = self.settle_plain(&quads, &tagged_vertices(level), targets, &mut points);
        }
        let found = par::collect(targets.len(), |i| find(level, targets[i]));
        let mut split = Vec::new();
        for (target, found) in targets.into_iter().zip(found) {
            match found {
                Found::Leaf(net) => {
                    let net = net.map(|point| points.number(point));
                    self.leaf(target.slot, net);
                }
                Found::Tail { corner, kind, ring } => {
                    let first = self.ring_start();
                    for point in ring {
                        let number = points.number(point);
                        self.table.rings.push(number);
                    }
                    let kind = self.kind(kind);
                    let node = self.tail(Tail { first, kind, corner });
                    self.place(target.slot, node);
                }
                Found::Split => split.push(target),
            }
        }
        self.table.local.extend(points.rows(|vertex, share, row| match below {
            None => row.add(VertexId(vertex), share),
            Some(below) => below.write(vertex, share, row),
        }));
        split
    }

    /// What targets on a level are cut into, as targets on the next.
    pub(super) fn cut(&mut self, mesh: &impl Connectivity, split: Vec<Target>) -> Vec<Target> {
        let mut targets = Vec::with_capacity(4 * split.len());
        for target in split {
            let first = mesh.first(target.face).0;
            if let Slot::Corners { first: root } = target.slot {
                targets.extend((0..mesh.face_size(target.face)).map(|corner| Target {
                    face: FaceId(first + corner),
                    corner: 0,
                    slot: Slot::Root(root + corner),
                }));
                continue;
            }
            let number = self.table.splits.len() as u32;
            self.table.splits.push([Node::NONE; 4]);
            self.place(target.slot, Node::new(Piece::Split(number)));
            // The quad at a corner starts there; its own corner at (0, 0) is turned back by as much.
            targets.extend((0..4).map(|corner| Target {
                face: FaceId(first + (target.corner + corner) % 4),
                corner: (4 - corner) % 4,
                slot: Slot::Child { split: number, corner },
            }));
        }
        targets
    }

    /// Refines what has to be split, and all that touches it, once.
    fn refine(
        &mut self,
        level: &Level,
        below: Option<&Below>,
        mut split: Vec<Target>,
    ) -> (Below, Vec<Target>) {
        let faces: Vec<FaceId> = split.iter().map(|target| target.face).collect();
        let mut part_faces = with_ring(level, &faces);
        if level.is_chaikin() || level.has_slices() {
            // How a crease fades is decided by all edges at its far end as well, and hidden faces bring no ring of
            // their own; a face at a meeting of curves looks across its port.
            part_faces = with_ring(level, &part_faces);
        }
        let part = Neighbourhood::new(level, &part_faces);
        for target in &mut split {
            target.face = FaceId(part_faces.partition_point(|&face| face < target.face) as u32);
        }
        let targets = self.cut(part.level.topology(), split);
        (Below::new(part, below), targets)
    }
}

/// For each vertex whether it has a rule of its own: a tag touches it, or it is a lens. Empty if there are none.
pub(super) fn tagged_vertices(level: &Level) -> Vec<bool> {
    let (_, rules) = level.tagged_rules();
    if rules.is_empty() {
        return Vec::new();
    }
    let mut tagged = vec![false; level.topology().vertex_count()];
    for (v, _) in rules.iter() {
        tagged[v as usize] = true;
    }
    for (f, _) in level.slices() {
        level.topology().halfedges(f).for_each(|h| tagged[level.topology().origin(h).index()] = true);
    }
    tagged
}

/// True if a tag touches a corner of the quad that `h` belongs to.
#[inline]
pub(super) fn touches(mesh: &impl Connectivity, h: HalfedgeId, tagged: &[bool]) -> bool {
    !tagged.is_empty() && (0..4).any(|k| tagged[mesh.origin(HalfedgeId(h.0 + k)).index()])
}

/// What a target is.
fn find(level: &Level, target: Target) -> Found {
    let topology = level.topology();
    if matches!(target.slot, Slot::Corners { .. }) {
        return Found::Split;
    }
    let first = topology.first(target.face).0;
    let corners = [0, 1, 2, 3].map(|corner| HalfedgeId(first + (target.corner + corner) % 4));
    let surroundings = Surroundings::new(level);
    let mut irregular = None;
    for (corner, &h) in (0..).zip(&corners) {
        match surroundings.corner(h) {
            CornerKind::Regular => {}
            CornerKind::Irregular(kind) if irregular.is_none() => irregular = Some((corner, kind)),
            CornerKind::Irregular(_) | CornerKind::Unsettled => return Found::Split,
        }
    }
    match irregular {
        None => Found::Leaf(Box::new(surroundings.net(corners[0]))),
        Some((corner, kind)) => {
            let ring = surroundings.ring(corners[corner as usize], kind);
            Found::Tail { corner, kind, ring }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{ControlMesh, Corner, Crease, FaceList, Sharpness, shapes};

    /// Some faces of a cage cut into triangles, some joined to hexagons.
    fn with_polygons(mesh: ControlMesh) -> ControlMesh {
        let quads: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
        let mut faces = FaceList::new();
        for (f, quad) in quads.iter().enumerate() {
            match f % 5 {
                0 => {
                    faces.push(&[quad[0], quad[1], quad[2]]);
                    faces.push(&[quad[0], quad[2], quad[3]]);
                }
                _ => faces.push(quad),
            }
        }
        ControlMesh { faces, ..mesh }
    }

    fn tagged(mesh: ControlMesh) -> ControlMesh {
        let faces: Vec<&[u32]> = mesh.faces.iter().collect();
        let crease = |f: usize, sharpness| Crease { vertices: [faces[f][1], faces[f][2]], sharpness };
        let creases = vec![
            crease(40, Sharpness::Infinite),
            crease(47, Sharpness::Finite(1.5)),
            crease(77, Sharpness::Finite(0.5)),
        ];
        let corners = vec![Corner { vertex: faces[9][2], sharpness: Sharpness::Infinite }];
        ControlMesh { creases, corners, holes: vec![3, 60], ..mesh }
    }

    /// What a piece is, and its points as weights on the cage.
    type Found = (String, Vec<Vec<(u32, f64)>>);

    fn found(table: &PatchTable, what: String, points: &[u32]) -> Found {
        let weights = |&point: &u32| match point.checked_sub(table.cage_count as u32) {
            None => vec![(point, 1.0)],
            Some(row) => table.local.row(row as usize).collect(),
        };
        (what, points.iter().map(weights).collect())
    }

    fn pieces(table: &PatchTable, node: Node, out: &mut Vec<Found>) {
        match node.piece() {
            Piece::Leaf(index) => out.push(found(table, "leaf".into(), table.leaf(index))),
            Piece::Tail(index) => {
                let tail = table.tail(index);
                let what = format!("{:?} at {}", table.basis(tail).kind, tail.corner);
                out.push(found(table, what, table.ring(tail)));
            }
            Piece::Split(index) => {
                out.push(("split".into(), Vec::new()));
                table.split(index).iter().for_each(|&child| pieces(table, child, out));
            }
        }
    }

    fn root(table: &PatchTable, root: u32) -> Vec<Found> {
        let mut out = Vec::new();
        match table.root_leaf(root) {
            Some(net) => out.push(found(table, "leaf".into(), net)),
            None if table.is_visible(root as usize) => pieces(table, table.root_node(root), &mut out),
            None => {}
        }
        out
    }

    /// Beside polygons of several sizes weights are summed in another order.
    fn same((a, b): (&Found, &Found)) -> bool {
        let equal = |(&(p, x), &(q, y)): (&(u32, f64), &(u32, f64))| p == q && f64::abs(x - y) < 1e-15;
        let rows = |(a, b): (&Vec<_>, &Vec<_>)| a.len() == b.len() && a.iter().zip(b).all(equal);
        a.0 == b.0 && a.1.len() == b.1.len() && a.1.iter().zip(&b.1).all(rows)
    }

    #[test]
    fn the_quick_way_makes_the_same_table() {
        let studded = shapes::studded_torus(16, 12, 4);
        // More targets, and points of theirs, than one thread takes in one go.
        let large = shapes::studded_torus(48, 36, 4);
        let meshes = [
            studded.clone(),
            large.clone(),
            with_polygons(large),
            shapes::cube(),
            shapes::disk(5, 3),
            with_polygons(shapes::torus(15, 9)),
            with_polygons(studded.clone()),
            with_polygons(shapes::grid(9, 7)),
            tagged(studded.clone()),
            tagged(with_polygons(studded)),
        ];
        for mesh in meshes {
            let level = Level::new(&mesh).unwrap();
            let (quick, general) = (table(&level), grow(&level, 0));
            if level.hidden_faces().is_empty() && quick.starts.is_empty() && !level.has_tags() {
                assert_eq!(quick.statistics(), general.statistics());
            }
            for number in 0..quick.len() as u32 {
                let (quick, general) = (root(&quick, number), root(&general, number));
                assert!(quick.len() == general.len() && quick.iter().zip(&general).all(same), "{number}");
            }
        }
    }
}
