//! Face after face: the samples of a pattern, by weights that tails of one kind share.

use std::ops::Range;

use super::batch::{Batch, Worker};
use super::evaluate::Counted;
use super::out::{Out, Put};
use super::pattern::{Pattern, Sheet};
use super::walk::wide;
use super::weights::{MOST_POINTS, Sides, Weights};
use super::{Derivatives, Flags};
use crate::math::simd::{self, Four};
use crate::math::{Vec3, par};
use crate::patch::{Node, Piece, Wide};

/// Samples that one task works through: with all derivatives a third of what a core's own cache holds.
const CHUNK: usize = 1024;

/// Faces that one task works through.
pub(super) fn in_block(pattern: &Pattern<'_>) -> usize {
    (CHUNK / pattern.len().max(1)).max(1)
}

/// All places of a pattern on all faces of a range, on all cores. What a face gives depends on no other.
pub(super) fn run(batch: Batch<'_>, pattern: &Pattern<'_>, faces: Range<usize>, out: Out<'_>) {
    if faces.len() > 1 && faces.len() * pattern.len() > CHUNK {
        let half = faces.len() / 2;
        let middle = faces.start + half;
        let (left, right) = out.split_at(half * pattern.len());
        par::join(
            || run(batch, pattern, faces.start..middle, left),
            || run(batch, pattern, middle..faces.end, right),
        );
        return;
    }
    if pattern.is_empty() {
        return;
    }
    let (worker, near, without) = (Worker::new(batch), [[0.0; 4]; MOST_POINTS - 1], Vec::new());
    let mut work = Work { batch, pattern, worker, near, without, out };
    for (number, face) in faces.enumerate() {
        work.face(face as u32, number * pattern.len());
    }
}

/// What is at hand while faces are worked through.
struct Work<'a, 'o> {
    batch: Batch<'a>,
    pattern: &'a Pattern<'a>,
    /// For places that have no weights.
    worker: Worker<'a>,
    /// The points of a ring but the first, relative to that.
    near: [Wide; MOST_POINTS - 1],
    /// The places of a face that have no weights.
    without: Vec<u32>,
    out: Out<'o>,
}

impl<'a> Work<'a, '_> {
    /// The samples of a parametric face; results start at `first`.
    fn face(&mut self, root: u32, first: usize) {
        let table = self.batch.table;
        let sheet = self.pattern.sheet();
        match table.root_leaf(root) {
            Some(net) => self.leaf(net, sheet, first),
            None => self.piece(table.root_node(root), sheet, first),
        }
        if !self.without.is_empty() {
            let rest = self.without.iter().map(|&place| &sheet.items[place as usize]);
            self.worker.places(root, rest, first, &mut self.out);
            self.without.clear();
        }
    }

    /// The samples in a piece of a face.
    fn piece(&mut self, node: Node, sheet: &Sheet, first: usize) {
        let table = self.batch.table;
        if sheet.items.is_empty() {
            return;
        }
        match node.piece() {
            Piece::Leaf(index) => self.leaf(table.leaf(index), sheet, first),
            Piece::Tail(number) => {
                let tail = table.tail(number);
                let weights = sheet.weights(table, tail, self.batch.what);
                self.without.extend_from_slice(&weights.without);
                if !weights.quartets().is_empty() {
                    self.sums(table.ring(tail), weights, first);
                }
            }
            Piece::Split(index) => {
                for (quarter, &node) in sheet.quarters(table).iter().zip(table.split(index)) {
                    self.piece(node, quarter, first);
                }
            }
        }
    }

    /// Sums over sixteen points would take longer than the coefficients of a patch do.
    #[inline]
    fn leaf(&mut self, net: &[u32; 16], sheet: &Sheet, first: usize) {
        let places = Counted { items: &sheet.items, first, straight: sheet.is_whole() };
        self.worker.in_leaf(net, sheet.depth, places, &mut self.out);
    }

    /// Sums over the points of a ring, relative to the first of them.
    #[inline]
    fn sums(&mut self, ring: &[u32], weights: &Weights, first: usize) {
        let Batch { points, what, .. } = self.batch;
        let Some((&base, ring)) = ring.split_first() else { return };
        let near = &mut self.near[..ring.len()];
        let sums = Sums { points, base, ring, near, weights, first };
        let out = &mut self.out;
        match what {
            Derivatives::None => simd::dispatch(Parts::<1> { sums, out }),
            Derivatives::First => simd::dispatch(Parts::<3> { sums, out }),
            Derivatives::Second => simd::dispatch(Parts::<6> { sums, out }),
        }
    }
}

/// The first point of a ring and the others, and weights for places in its tail.
struct Sums<'a> {
    points: &'a [Vec3],
    base: u32,
    ring: &'a [u32],
    near: &'a mut [Wide],
    weights: &'a Weights,
    first: usize,
}

/// So many parts of the jet of every place, for [`simd::dispatch`].
struct Parts<'a, 'o, const COUNT: usize> {
    sums: Sums<'a>,
    out: &'a mut Out<'o>,
}

impl<const COUNT: usize> simd::Kernel for Parts<'_, '_, COUNT> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Parts { sums: Sums { points, base, ring, near, weights, first }, out } = self;
        let base = points[base as usize];
        let origin = V::load(&wide(base));
        for (near, &source) in near.iter_mut().zip(ring) {
            *near = V::load(&wide(points[source as usize])).minus(origin).store();
        }
        let base = [V::splat(base.x), V::splat(base.y), V::splat(base.z)];
        for quartet in weights.quartets() {
            let put = quartet.put(first);
            put.flags(out.flags, Flags::NONE);
            if COUNT == 1 {
                let [[x, y, z]] = weighted::<1, V>(weights.of::<1>(quartet, 0), near);
                put.vectors(out.position, [base[0].plus(x), base[1].plus(y), base[2].plus(z)]);
                continue;
            }
            if let Some(sides) = &quartet.sides {
                rectangle(
                    sides,
                    [weights.of::<2>(quartet, 0), weights.of::<2>(quartet, 1)],
                    near,
                    base,
                    &put,
                    out,
                );
                continue;
            }
            let [[x, y, z], du, dv] = weighted::<3, V>(weights.of::<3>(quartet, 0), near);
            put.vectors(out.position, [base[0].plus(x), base[1].plus(y), base[2].plus(z)]);
            put.vectors(out.du, du);
            put.vectors(out.dv, dv);
            put.normals(&du, &dv, Flags::NONE, out);
            if COUNT == 3 {
                continue;
            }
            let [duu, duv, dvv] = weighted::<3, V>(weights.of::<3>(quartet, 1), near);
            put.vectors(out.duu, duu);
            put.vectors(out.duv, duv);
            put.vectors(out.dvv, dvv);
        }
    }
}

/// The corners of a rectangle: first derivatives from the other sums.
#[inline(always)]
fn rectangle<V: Four>(
    sides: &Sides,
    weights: [&[Wide]; 2],
    near: &[Wide],
    base: [V; 3],
    put: &Put,
    out: &mut Out<'_>,
) {
    let [at, duu] = weighted::<2, V>(weights[0], near);
    put.vectors(out.position, [base[0].plus(at[0]), base[1].plus(at[1]), base[2].plus(at[2])]);
    put.vectors(out.duu, duu);
    let (chord, bend) = (V::load(&sides.along_u.chord), V::load(&sides.along_u.bend));
    let mut du = at;
    for axis in 0..3 {
        let bends = duu[axis].plus(duu[axis]).plus(duu[axis].swapped());
        du[axis] = at[axis].swapped().minus(at[axis]).times(chord).plus(bends.times(bend));
    }
    put.vectors(out.du, du);
    let [duv, dvv] = weighted::<2, V>(weights[1], near);
    put.vectors(out.duv, duv);
    put.vectors(out.dvv, dvv);
    let (chord, bend) = (V::load(&sides.along_v.chord), V::load(&sides.along_v.bend));
    let mut dv = at;
    for axis in 0..3 {
        let bends = dvv[axis].plus(dvv[axis]).plus(dvv[axis].turned());
        dv[axis] = at[axis].turned().minus(at[axis]).times(chord).plus(bends.times(bend));
    }
    put.vectors(out.dv, dv);
    put.normals(&du, &dv, Flags::NONE, out);
}

/// Sums over points, with so many weights for each; four places in lanes.
#[inline(always)]
fn weighted<const PARTS: usize, V: Four>(weights: &[Wide], near: &[Wide]) -> [[V; 3]; PARTS] {
    let mut sums = [[V::splat(0.0); 3]; PARTS];
    for (weights, point) in weights.chunks_exact(PARTS).zip(near) {
        let point = [V::splat(point[0]), V::splat(point[1]), V::splat(point[2])];
        for part in 0..PARTS {
            let weight = V::load(&weights[part]);
            for axis in 0..3 {
                sums[part][axis] = sums[part][axis].plus(weight.times(point[axis]));
            }
        }
    }
    sums
}
