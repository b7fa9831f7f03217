//! The quick way: parametric faces whose surroundings are plain, without a level made for them.
//!
//! Quads with regular corners and with one irregular corner are looked up where they are. What has several, or stands
//! beside another polygon, is looked up one step ahead, and polygons whose corners are irregular two steps ahead, where
//! irregular corners are apart. Nothing is refined for that: who meets whom follows from the cage by arithmetic
//! ([`Ahead`]), and only points that patches name are worked out. The rest, near tags and boundaries, goes the general
//! way (`build.rs`), which would give the same table.

use super::build::{Builder, Slot, Target, face_of, tagged_vertices, touches};
use super::kind::Kind;
use super::plain::{Plain, PlainTail};
use super::points::Points;
use super::table::{NO_LEAF, Sources};
use super::tree::{Node, Piece, Tail};
use crate::catmull_clark::rule;
use crate::math::par;
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{FaceId, HalfedgeId};
use crate::refine::Ahead;
use crate::rules::Level;
use crate::stencil::StencilTable;

/// Roots or targets that one thread takes in one go.
const CHUNK: usize = 1024;

/// Marks a root whose chain is still to be written: the tail follows.
const PENDING: u32 = u32::MAX - 1;

/// A tail as a root holds it until there is a place for its ring.
fn pending(tail: &PlainTail) -> Sources {
    let mut slot = [0; 16];
    slot[..5].copy_from_slice(&[NO_LEAF, PENDING, tail.halfedge.0, tail.corner, tail.valence]);
    slot[5..12].copy_from_slice(&tail.outer);
    Sources(slot)
}

/// The tail that a root holds.
fn pending_tail(slot: &Sources) -> Option<PlainTail> {
    let [NO_LEAF, PENDING, halfedge, corner, valence, a, b, c, d, e, f, g, ..] = slot.0 else { return None };
    Some(PlainTail { halfedge: HalfedgeId(halfedge), corner, valence, outer: [a, b, c, d, e, f, g] })
}

/// What a chunk of roots asks for.
#[derive(Default)]
struct Wanted {
    tails: usize,
    /// Numbers in the rings of these tails.
    rings: usize,
    valences: Vec<u32>,
    /// Roots that are no leaves and no tails.
    other: Vec<u32>,
}

/// What a chunk of targets is.
#[derive(Default)]
struct Pieces {
    /// Corner and valence of a tail; a leaf has none.
    shapes: Vec<Option<[u32; 2]>>,
    /// Vertices of the level.
    points: Vec<u32>,
    /// Leaves below splits.
    leaves: usize,
    /// Numbers in the rings of the tails.
    rings: usize,
    valences: Vec<u32>,
    /// The targets of these shapes, and those that are not plain.
    settled: Vec<Target>,
    other: Vec<Target>,
    /// Roots that are leaves.
    roots: Vec<(u32, Sources)>,
}

impl Builder {
    /// Fills the roots that the quick way can, and gives the rest. Levels with as many halfedges as `limit` are not
    /// looked at ahead.
    pub(super) fn plain_roots(
        &mut self,
        level: &Level,
        mesh: &impl Connectivity,
        limit: usize,
    ) -> Vec<Target> {
        let tagged = tagged_vertices(level);
        let starts = std::mem::take(&mut self.table.starts);
        let count = starts.last().map_or(mesh.face_count(), |&count| count as usize);
        self.table.roots = par::collect(count, |root| {
            let face = face_of(&starts, root as u32);
            let h = mesh.first(face);
            let mut slot = [0; 16];
            slot[..2].copy_from_slice(&[NO_LEAF, Node::NONE.bits()]);
            if mesh.face_size(face) != 4 || touches(mesh, h, &tagged) {
                return Sources(slot);
            }
            match Plain::of(mesh, h) {
                Plain::Leaf(net) => Sources(net),
                Plain::Tail(tail) => pending(&tail),
                Plain::Other => Sources(slot),
            }
        });
        let other = self.plain_tails(mesh);
        let hidden = &self.table.hidden;
        let visible = |root: &u32| hidden.binary_search(root).is_err();
        let (mut split, mut rest) = (Vec::new(), Vec::new());
        for root in other.into_iter().filter(visible) {
            let face = face_of(&starts, root);
            let slot = match starts.get(face.index()) {
                Some(&first) if mesh.face_size(face) != 4 && first == root => Slot::Corners { first },
                Some(_) if mesh.face_size(face) != 4 => continue,
                _ => Slot::Root(root),
            };
            let target = Target { face, corner: 0, slot };
            let plain = mesh.halfedge_count() < limit && is_plain(mesh, face, &tagged);
            if plain { split.push(target) } else { rest.push(target) }
        }
        self.table.starts = starts;
        if !split.is_empty() {
            self.plain_splits(mesh, split);
        }
        rest
    }

    /// Writes the chains of quads with one irregular corner; gives the roots that are still open.
    fn plain_tails(&mut self, mesh: &impl Connectivity) -> Vec<u32> {
        let roots = &self.table.roots;
        let wanted = par::map(roots.len().div_ceil(CHUNK), |chunk| {
            let mut wanted = Wanted::default();
            for root in chunk * CHUNK..((chunk + 1) * CHUNK).min(roots.len()) {
                if let Some(tail) = pending_tail(&roots[root]) {
                    wanted.tails += 1;
                    wanted.rings += tail.ring_count();
                    if !wanted.valences.contains(&tail.valence) {
                        wanted.valences.push(tail.valence);
                    }
                } else if roots[root].0[0] == NO_LEAF {
                    wanted.other.push(root as u32);
                }
            }
            wanted
        });
        let sum = |of: fn(&Wanted) -> usize| wanted.iter().map(of).sum::<usize>();
        let (tail_count, ring_count) = (sum(|wanted| wanted.tails), sum(|wanted| wanted.rings));
        let other = wanted.iter().flat_map(|wanted| wanted.other.iter().copied()).collect();
        if tail_count == 0 {
            return other;
        }
        for &valence in wanted.iter().flat_map(|wanted| &wanted.valences) {
            self.kind(Kind::Smooth { valence });
        }
        let smooth = &self.smooth;
        // Zeros that no one has touched yet cost nothing.
        self.table.tails = vec![Tail { first: 0, kind: 0, corner: 0 }; tail_count];
        self.table.rings = vec![0; ring_count];
        u32::try_from(ring_count).expect("fewer than 2^32 numbers in the rings of a table");
        let (mut tails, mut rings) = (&mut self.table.tails[..], &mut self.table.rings[..]);
        let (mut number, mut first) = (0, 0);
        let mut shares = Vec::with_capacity(wanted.len());
        for (roots, wanted) in self.table.roots.chunks_mut(CHUNK).zip(&wanted) {
            let (own_tails, later_tails) = tails.split_at_mut(wanted.tails);
            let (own_rings, later_rings) = rings.split_at_mut(wanted.rings);
            shares.push((roots, own_tails, own_rings, number, first));
            (tails, rings) = (later_tails, later_rings);
            (number, first) = (number + wanted.tails as u32, first + wanted.rings as u32);
        }
        par::each(shares, |(roots, tails, mut rings, mut number, mut first)| {
            let pending = roots.iter_mut().filter_map(|root| Some((pending_tail(root)?, root)));
            for ((tail, root), out) in pending.zip(tails) {
                let (ring, later) = rings.split_at_mut(tail.ring_count());
                tail.ring(mesh, ring);
                *out = Tail { first, kind: smooth[tail.valence as usize], corner: tail.corner };
                *root = Sources::tail(Node::new(Piece::Tail(number)), *out);
                (rings, number, first) = (later, number + 1, first + tail.ring_count() as u32);
            }
        });
        other
    }

    /// Settles what has to be split, where no tag and no boundary touches it.
    fn plain_splits(&mut self, mesh: &impl Connectivity, split: Vec<Target>) {
        let ahead = Ahead(mesh);
        let mut points = Points::new(ahead.vertex_count(), self.next_point());
        let targets = self.cut(mesh, split);
        let split = self.settle_plain(&ahead, &[], targets, &mut points);
        self.table.local.extend(points.rows(|vertex, _, row| rule::smooth_child(mesh, vertex, row)));
        if split.is_empty() {
            return;
        }
        let further = Ahead(&ahead);
        let mut points = Points::new(further.vertex_count(), self.next_point());
        let targets = self.cut(&ahead, split);
        let split = self.settle_plain(&further, &[], targets, &mut points);
        assert!(split.is_empty(), "two steps part all irregular corners");
        let rows = points.rows(|vertex, _, row| rule::smooth_child(&ahead, vertex, row));
        let (rows, used) = rows.over_used(ahead.vertex_count());
        let above = StencilTable::from_rows(used.len(), |i, row| rule::smooth_child(mesh, used[i], row));
        self.table.local.extend(above.then(&rows));
    }

    /// Writes the leaves and tails that are plain on a level of quads; gives the other targets.
    pub(super) fn settle_plain(
        &mut self,
        mesh: &impl Connectivity,
        tagged: &[bool],
        targets: Vec<Target>,
        points: &mut Points,
    ) -> Vec<Target> {
        let marks = points.marks();
        let mut chunks = par::map(targets.len().div_ceil(CHUNK), |chunk| {
            let mut pieces = Pieces::default();
            for &target in &targets[chunk * CHUNK..((chunk + 1) * CHUNK).min(targets.len())] {
                pieces.look(mesh, tagged, target);
            }
            pieces.points.iter().for_each(|&vertex| marks.mark(vertex));
            pieces
        });
        points.number_marked(marks);
        for &valence in chunks.iter().flat_map(|pieces| &pieces.valences) {
            self.kind(Kind::Smooth { valence });
        }
        let (points, smooth, table) = (&*points, &self.smooth, &mut self.table);
        let sum = |of: fn(&Pieces) -> usize| chunks.iter().map(of).sum::<usize>();
        let (mut leaf, mut tail, ring) = (table.leaves.len(), table.tails.len(), table.rings.len());
        u32::try_from(ring + sum(|pieces| pieces.rings))
            .expect("fewer than 2^32 numbers in the rings of a table");
        table.leaves.resize(leaf + sum(|pieces| pieces.leaves), Sources([0; 16]));
        table.tails.resize(tail + sum(Pieces::tails), Tail { first: 0, kind: 0, corner: 0 });
        table.rings.resize(ring + sum(|pieces| pieces.rings), 0);
        let (mut leaves, mut tails) = (&mut table.leaves[leaf..], &mut table.tails[tail..]);
        let (mut rings, mut first) = (&mut table.rings[ring..], ring as u32);
        let mut shares = Vec::with_capacity(chunks.len());
        for pieces in &mut chunks {
            let (own_leaves, later_leaves) = leaves.split_at_mut(pieces.leaves);
            let (own_tails, later_tails) = tails.split_at_mut(pieces.tails());
            let (own_rings, later_rings) = rings.split_at_mut(pieces.rings);
            let next = first + pieces.rings as u32;
            shares.push((pieces, own_leaves, own_tails, own_rings, first));
            (leaves, tails, rings, first) = (later_leaves, later_tails, later_rings, next);
        }
        par::each(shares, |(pieces, leaves, tails, rings, first)| {
            pieces.write(points, smooth, leaves, tails, rings, first);
        });
        let mut other = Vec::new();
        for pieces in chunks {
            other.extend(pieces.other);
            for (root, net) in pieces.roots {
                self.table.roots[root as usize] = net;
            }
            for (shape, target) in pieces.shapes.into_iter().zip(pieces.settled) {
                if shape.is_some() {
                    self.place(target.slot, Node::new(Piece::Tail(tail as u32)));
                    tail += 1;
                } else if !matches!(target.slot, Slot::Root(_)) {
                    self.place(target.slot, Node::new(Piece::Leaf(leaf as u32)));
                    leaf += 1;
                }
            }
        }
        other
    }
}

impl Pieces {
    fn look(&mut self, mesh: &impl Connectivity, tagged: &[bool], target: Target) {
        let first = mesh.first(target.face);
        let plain = match touches(mesh, first, tagged) {
            false => Plain::of(mesh, HalfedgeId(first.0 + target.corner)),
            true => Plain::Other,
        };
        match plain {
            Plain::Leaf(net) => {
                self.points.extend_from_slice(&net);
                self.leaves += usize::from(!matches!(target.slot, Slot::Root(_)));
                self.shapes.push(None);
            }
            Plain::Tail(tail) => {
                let first = self.points.len();
                self.points.resize(first + tail.ring_count(), 0);
                tail.ring(mesh, &mut self.points[first..]);
                self.rings += tail.ring_count();
                if !self.valences.contains(&tail.valence) {
                    self.valences.push(tail.valence);
                }
                self.shapes.push(Some([tail.corner, tail.valence]));
            }
            Plain::Other => {
                self.other.push(target);
                return;
            }
        }
        self.settled.push(target);
    }

    fn tails(&self) -> usize {
        self.shapes.iter().flatten().count()
    }

    /// Writes leaves and tails to their places; numbers of rings start at `first`.
    fn write(
        &mut self,
        points: &Points,
        smooth: &[u32],
        leaves: &mut [Sources],
        tails: &mut [Tail],
        mut rings: &mut [u32],
        mut first: u32,
    ) {
        let mut numbers = self.points.iter().map(|&vertex| points.of(vertex));
        let (mut leaves, mut tails) = (leaves.iter_mut(), tails.iter_mut());
        for (shape, target) in self.shapes.iter().zip(&self.settled) {
            let Some([corner, valence]) = *shape else {
                let mut net = [0; 16];
                net.iter_mut().zip(&mut numbers).for_each(|(point, number)| *point = number);
                match target.slot {
                    Slot::Root(root) => self.roots.push((root, Sources(net))),
                    _ => *leaves.next().expect("leaves were counted") = Sources(net),
                }
                continue;
            };
            let kind = Kind::Smooth { valence };
            let (ring, later) = rings.split_at_mut(kind.ring_count());
            ring.iter_mut().zip(&mut numbers).for_each(|(point, number)| *point = number);
            *tails.next().expect("tails were counted") =
                Tail { first, kind: smooth[valence as usize], corner };
            (rings, first) = (later, first + kind.ring_count() as u32);
        }
    }
}

/// True if no tag touches a corner of the face, and no boundary.
fn is_plain(mesh: &impl Connectivity, face: FaceId, tagged: &[bool]) -> bool {
    let first = mesh.first(face).0;
    (first..first + mesh.face_size(face)).all(|h| {
        let v = mesh.origin(HalfedgeId(h));
        let inside = mesh.outgoing(v).is_some_and(|h| mesh.twin(h).is_some());
        inside && !tagged.get(v.index()).is_some_and(|&tagged| tagged)
    })
}

#[cfg(test)]
mod tests {
    use super::super::build;
    use super::super::surroundings::{Mirrored, Surroundings};
    use super::*;
    use crate::mesh::shapes;

    #[test]
    fn rings_are_where_tails_look_for_them() {
        // More than one chunk of roots.
        let level = Level::new(&shapes::studded_torus(48, 36, 4)).unwrap();
        let (table, surroundings) = (build::table(&level), Surroundings::new(&level));
        let mut tails = 0;
        for root in (0..table.len() as u32).filter(|&root| table.root_leaf(root).is_none()) {
            let Piece::Tail(index) = table.root_node(root).piece() else { continue };
            let (own, tail) = (table.root_tail(root), table.tail(index));
            assert_eq!([own.first, own.kind, own.corner], [tail.first, tail.kind, tail.corner]);
            let ring: Vec<Mirrored> = table.ring(tail).iter().map(|&point| vec![(point, 1.0)]).collect();
            let h = HalfedgeId(4 * root + tail.corner);
            assert_eq!(ring, surroundings.ring(h, table.basis(tail).kind));
            tails += 1;
        }
        assert_eq!(tails, 4 * 12 * 9);
    }
}
