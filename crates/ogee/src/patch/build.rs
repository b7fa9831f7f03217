//! Growing the trees of a [`PatchTable`].
//!
//! Faces are looked at level by level, not one by one: what has to be split at a level is taken out with what touches
//! it and refined as one small level, whose quads are looked at next. Points of deeper levels are kept as weights on the
//! cage.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::chain::{ChainBasis, Kind};
use super::points::{Below, Points};
use super::surroundings::{CornerKind, Mirrored, Plain, Surroundings, plain_corners, plain_ring};
use super::table::{NO_LEAF, PatchTable, Sources};
use super::tree::{Node, Piece, Tail};
use super::{Neighbourhood, with_ring};
use crate::math::par;
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};
use crate::rules::Level;
use crate::stencil::StencilTable;

/// The table of a level.
pub(super) fn table(level: &Level) -> PatchTable {
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
    let mut builder = Builder { table, kinds: HashMap::new() };
    let mut targets = match level.topology().as_quads() {
        Some(quads) => builder.plain_roots(level, &quads, roots.len()),
        None => builder.plain_roots(level, level.topology(), roots.len()),
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

fn face_of(starts: &[u32], root: u32) -> FaceId {
    if starts.is_empty() {
        return FaceId(root);
    }
    FaceId(starts.partition_point(|&start| start <= root) as u32 - 1)
}

/// A face that is not settled yet.
#[derive(Clone, Copy, Debug)]
struct Target {
    face: FaceId,
    /// Which of its own corners is at `(0, 0)`.
    corner: u32,
    slot: Slot,
}

/// Where its node goes.
#[derive(Clone, Copy, Debug)]
enum Slot {
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
    PlainLeaf([u32; 16]),
    PlainTail { corner: u32, valence: u32, ring: Vec<u32> },
    Leaf(Box<[Mirrored; 16]>),
    Tail { corner: u32, kind: Kind, ring: Vec<Mirrored> },
    Split,
}

struct Builder {
    table: PatchTable,
    kinds: HashMap<Kind, u32>,
}

/// Marks a root whose chain is still to be written: its corner and its outer points follow.
const PENDING: u32 = u32::MAX - 1;

impl Builder {
    /// Fills the roots that the quick way can, and gives the rest.
    fn plain_roots(&mut self, level: &Level, mesh: &impl Connectivity, count: usize) -> Vec<Target> {
        let tagged = tagged_vertices(level);
        let starts = std::mem::take(&mut self.table.starts);
        self.table.roots = par::collect(count, |root| {
            let mut slot = [0; 16];
            slot[..2].copy_from_slice(&[NO_LEAF, Node::NONE.bits()]);
            let face = face_of(&starts, root as u32);
            let h = mesh.first(face);
            if mesh.face_size(face) != 4 || touches(mesh, h, &tagged) {
                return Sources(slot);
            }
            match plain_corners(mesh, h) {
                Plain::Regular(net) => return Sources(net),
                Plain::OneIrregular { corner, outer } => {
                    slot[1..3].copy_from_slice(&[PENDING, corner]);
                    slot[3..10].copy_from_slice(&outer);
                }
                Plain::Other => {}
            }
            Sources(slot)
        });
        let unsettled = (0..count as u32).filter(|&root| self.table.roots[root as usize].0[0] == NO_LEAF);
        let (pending, other): (Vec<u32>, Vec<u32>) =
            unsettled.partition(|&root| self.table.roots[root as usize].0[1] == PENDING);
        let mut rest = self.plain_tails(mesh, &starts, &pending);
        let hidden = &self.table.hidden;
        let visible = |root: &u32| hidden.binary_search(root).is_err();
        for root in other.into_iter().filter(visible) {
            let face = face_of(&starts, root);
            let slot = match starts.get(face.index()) {
                Some(&first) if mesh.face_size(face) != 4 && first == root => Slot::Corners { first },
                Some(_) if mesh.face_size(face) != 4 => continue,
                _ => Slot::Root(root),
            };
            rest.push(Target { face, corner: 0, slot });
        }
        self.table.starts = starts;
        rest
    }

    /// Writes the chains of quads with one irregular corner, as far as the quick way can.
    fn plain_tails(&mut self, mesh: &impl Connectivity, starts: &[u32], pending: &[u32]) -> Vec<Target> {
        const CHUNK: usize = 512;
        const WAVE: usize = 32;
        let mut rest = Vec::new();
        self.table.tails.reserve_exact(pending.len());
        // In waves, so that what chunks hold before it is joined is little, and the same memory again.
        for wave in pending.chunks(CHUNK * WAVE) {
            self.plain_wave(mesh, starts, wave, CHUNK, &mut rest);
        }
        rest
    }

    fn plain_wave(
        &mut self,
        mesh: &impl Connectivity,
        starts: &[u32],
        pending: &[u32],
        chunk_size: usize,
        rest: &mut Vec<Target>,
    ) {
        let roots = &self.table.roots;
        let chunks = par::map(pending.len().div_ceil(chunk_size), |chunk| {
            let mut rings: Vec<u32> = Vec::new();
            let mut valences = Vec::new();
            for &root in &pending[chunk * chunk_size..((chunk + 1) * chunk_size).min(pending.len())] {
                let slot = &roots[root as usize].0;
                let h = HalfedgeId(mesh.first(face_of(starts, root)).0 + slot[2]);
                let valence = plain_ring(mesh, h, &mut rings);
                if valence.is_some() {
                    rings.extend_from_slice(&slot[3..10]);
                }
                valences.push(valence);
            }
            (rings, valences)
        });
        let mut pending = pending.iter();
        for (rings, valences) in chunks {
            let mut first = self.ring_start();
            self.table.rings.extend(rings);
            for (valence, &root) in valences.into_iter().zip(&mut pending) {
                let Some(valence) = valence else {
                    self.table.roots[root as usize].0[1] = Node::NONE.bits();
                    let face = face_of(starts, root);
                    rest.push(Target { face, corner: 0, slot: Slot::Root(root) });
                    continue;
                };
                let kind = Kind::Smooth { valence };
                let tail =
                    Tail { first, kind: self.kind(kind), corner: self.table.roots[root as usize].0[2] };
                first += kind.ring_count() as u32;
                let node = self.tail(tail);
                self.place(Slot::Root(root), node);
            }
        }
    }

    /// The number of a kind of chain.
    fn kind(&mut self, kind: Kind) -> u32 {
        let kinds = &mut self.table.kinds;
        *self.kinds.entry(kind).or_insert_with(|| {
            kinds.push(ChainBasis::new(kind));
            kinds.len() as u32 - 1
        })
    }

    /// Where the next ring begins.
    fn ring_start(&self) -> u32 {
        u32::try_from(self.table.rings.len()).expect("fewer than 2^32 numbers in the rings of a table")
    }

    fn tail(&mut self, tail: Tail) -> Node {
        self.table.tails.push(tail);
        Node::new(Piece::Tail(self.table.tails.len() as u32 - 1))
    }

    fn leaf(&mut self, slot: Slot, net: [u32; 16]) {
        if let Slot::Root(root) = slot {
            self.table.roots[root as usize] = Sources(net);
            return;
        }
        self.table.leaves.push(Sources(net));
        let index = self.table.leaves.len() as u32 - 1;
        self.place(slot, Node::new(Piece::Leaf(index)));
    }

    fn place(&mut self, slot: Slot, node: Node) {
        match slot {
            Slot::Root(root) | Slot::Corners { first: root } => {
                let slot = &mut self.table.roots[root as usize].0;
                slot[..2].copy_from_slice(&[NO_LEAF, node.bits()]);
                if let Piece::Tail(tail) = node.piece() {
                    let Tail { first, kind, corner } = self.table.tails[tail as usize];
                    slot[2..5].copy_from_slice(&[first, kind, corner]);
                }
            }
            Slot::Child { split, corner } => self.table.splits[split as usize][corner as usize] = node,
        }
    }

    /// Writes leaves and tails; gives what has to be split. `below` is `None` for the cage itself.
    fn settle(&mut self, level: &Level, below: Option<&Below>, targets: Vec<Target>) -> Vec<Target> {
        let tagged = tagged_vertices(level);
        let found = par::collect(targets.len(), |i| find(level, &tagged, targets[i]));
        let next = (self.table.cage_count + self.table.local.len()) as u32;
        let mut points = Points::new(below, next);
        let mut split = Vec::new();
        for (target, found) in targets.into_iter().zip(found) {
            match found {
                Found::PlainLeaf(net) => {
                    let net = net.map(|vertex| points.vertex(vertex));
                    self.leaf(target.slot, net);
                }
                Found::PlainTail { corner, valence, ring } => {
                    let first = self.ring_start();
                    for vertex in ring {
                        let number = points.vertex(vertex);
                        self.table.rings.push(number);
                    }
                    let kind = self.kind(Kind::Smooth { valence });
                    let node = self.tail(Tail { first, kind, corner });
                    self.place(target.slot, node);
                }
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
        self.table.local.extend(&points.rows());
        split
    }

    /// Refines what has to be split, and all that touches it, once.
    fn refine(&mut self, level: &Level, below: Option<&Below>, split: Vec<Target>) -> (Below, Vec<Target>) {
        let faces: Vec<FaceId> = split.iter().map(|target| target.face).collect();
        let mut part_faces = with_ring(level, &faces);
        if level.is_chaikin() {
            // How a crease fades is decided by all edges at its far end as well, and hidden faces bring no ring of
            // their own.
            part_faces = with_ring(level, &part_faces);
        }
        let part = Neighbourhood::new(level, &part_faces);
        let mut targets = Vec::new();
        for target in split {
            let own = part_faces.partition_point(|&face| face < target.face) as u32;
            let first = part.level.topology().first(FaceId(own)).0;
            let corners = part.level.topology().face_size(FaceId(own));
            if let Slot::Corners { first: root } = target.slot {
                targets.extend((0..corners).map(|corner| Target {
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
        (Below::new(part, below), targets)
    }
}

/// For each vertex whether a tag touches it; empty if there are no tags.
fn tagged_vertices(level: &Level) -> Vec<bool> {
    if !level.has_tags() {
        return Vec::new();
    }
    let mut tagged = vec![false; level.topology().vertex_count()];
    for (v, _) in level.tagged_rules().1.iter() {
        tagged[v as usize] = true;
    }
    tagged
}

/// True if a tag touches a corner of the quad that `h` belongs to.
#[inline]
fn touches(mesh: &impl Connectivity, h: HalfedgeId, tagged: &[bool]) -> bool {
    !tagged.is_empty() && (0..4).any(|k| tagged[mesh.origin(HalfedgeId(h.0 + k)).index()])
}

/// What a target is.
fn find(level: &Level, tagged: &[bool], target: Target) -> Found {
    let topology = level.topology();
    if matches!(target.slot, Slot::Corners { .. }) {
        return Found::Split;
    }
    let first = topology.first(target.face).0;
    let corners = [0, 1, 2, 3].map(|corner| HalfedgeId(first + (target.corner + corner) % 4));
    if let Some(quads) = topology.as_quads().filter(|quads| !touches(quads, HalfedgeId(first), tagged)) {
        match plain_corners(&quads, corners[0]) {
            Plain::Regular(net) => return Found::PlainLeaf(net),
            Plain::OneIrregular { corner, outer } => {
                let mut ring = Vec::with_capacity(24);
                if let Some(valence) = plain_ring(&quads, corners[corner as usize], &mut ring) {
                    ring.extend(outer);
                    return Found::PlainTail { corner, valence, ring };
                }
            }
            Plain::Other => {}
        }
    }
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
