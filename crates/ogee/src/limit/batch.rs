//! Many points: samples sorted by piece, four at a time.

use super::bicubic::{self, Net};
use super::corner::at_corner;
use super::evaluate::{Group, Item, Source, Together};
use super::out::Out;
use super::place::{self, Patch, Tile, power_of_two};
use super::walk::{Walk, wide};
use super::{Derivatives, Flags};
use crate::math::simd::{self, Four};
use crate::math::{Vec3, par};
use crate::patch::{Location, PatchTable, Piece, Tail, Wide, child};

/// Samples that one task works through, and sorts where that helps.
const CHUNK: usize = 8192;

/// A table, the points of a pose, and how much is wanted.
#[derive(Clone, Copy)]
pub(super) struct Batch<'a> {
    pub(super) table: &'a PatchTable,
    pub(super) points: &'a [Vec3],
    pub(super) what: Derivatives,
}

impl Batch<'_> {
    /// All samples, on all cores. What a sample gives does not depend on those beside it.
    pub(super) fn run(self, at: &[Location], mut out: Out<'_>) {
        if at.len() > CHUNK {
            // Whole chunks to the left.
            let middle = at.len().div_ceil(CHUNK).div_ceil(2) * CHUNK;
            let (left, right) = out.split_at(middle);
            par::join(|| self.run(&at[..middle], left), || self.run(&at[middle..], right));
            return;
        }
        let mut worker = Worker::new(self);
        match self.order(at) {
            Some(order) => worker.sorted(at, &order, &mut out),
            None => worker.straight(at, &mut out),
        }
    }

    /// The samples sorted by parametric face, if they are not, and if several of them share one.
    fn order(&self, at: &[Location]) -> Option<Vec<u32>> {
        let changes = at.windows(2).filter(|pair| pair[0].root != pair[1].root).count();
        if 2 * changes < at.len() || self.table.len() > at.len() {
            return None;
        }
        let mut order: Vec<u32> = (0..at.len() as u32).collect();
        order.sort_unstable_by_key(|&i| (at[i as usize].root, i));
        Some(order)
    }
}

/// Reads ahead: where samples are scattered, waiting for memory costs several times the arithmetic.
#[derive(Default)]
struct Ahead {
    /// How far each stage has come.
    done: [usize; 3],
}

impl Ahead {
    /// Samples between asking for a face, for its points or its ring's numbers, for its ring's points, and using them.
    const DISTANCES: [usize; 3] = [24, 16, 8];

    /// Samples of one face that take longer than memory does.
    const LONG: usize = 7;

    #[inline(always)]
    fn look(&mut self, first: usize, at: usize, count: usize, root: impl Fn(usize) -> u32, batch: Batch<'_>) {
        if at - first > Ahead::LONG {
            // In long runs it is enough to look one run ahead, and two for what leads there.
            self.done = [at; 3];
            let length = at - first;
            for (stage, i) in [at + 2 * length, at + length, at].into_iter().enumerate() {
                if i < count {
                    ask(stage, root(i), batch);
                }
            }
            return;
        }
        for (stage, distance) in Ahead::DISTANCES.into_iter().enumerate() {
            let end = (at + distance).min(count);
            for i in self.done[stage].max(at)..end {
                if i > 0 && root(i) == root(i - 1) {
                    continue;
                }
                ask(stage, root(i), batch);
            }
            self.done[stage] = end;
        }
    }
}

/// Asks for a parametric face, for its points or its ring's numbers, or for its ring's points.
#[inline(always)]
fn ask(stage: usize, root: u32, Batch { table, points, .. }: Batch<'_>) {
    match stage {
        0 => table.prefetch_root(root),
        1 => table.prefetch_points(root, points),
        _ => table.prefetch_ring(root, points),
    }
}

/// A sample whose patch has still to be made: samples of one patch have the same key, and keys go down a chain.
#[derive(Clone, Copy)]
struct Keyed {
    key: u64,
    item: Item,
}

/// The patch of a leaf, for [`simd::dispatch`].
struct Leaf<'a> {
    points: &'a [Vec3],
    sources: &'a [u32; 16],
    base: Wide,
    net: &'a mut Net,
}

impl simd::Kernel for Leaf<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Leaf { points, sources, base, net } = self;
        let base = V::load(&base);
        let mut control = [base; 16];
        for k in 0..16 {
            control[k] = V::load(&wide(points[sources[k] as usize])).minus(base);
        }
        bicubic::coefficients(&control, net);
    }
}

/// Evaluates samples one run after another; keeps its memory.
pub(super) struct Worker<'a> {
    batch: Batch<'a>,
    walk: Walk,
    group: Group,
    items: Vec<Item>,
    keyed: Vec<Keyed>,
}

impl<'a> Worker<'a> {
    pub(super) fn new(batch: Batch<'a>) -> Worker<'a> {
        let group = Group { net: [[0.0; 4]; 16], base: [0.0; 4], scales: [1.0; 3], flags: Flags::NONE };
        Worker { batch, walk: Walk::default(), group, items: Vec::new(), keyed: Vec::new() }
    }

    /// All samples of a chunk in the order in which they stand.
    fn straight(&mut self, at: &[Location], out: &mut Out<'_>) {
        let root = |i: usize| at[i].root;
        let mut ahead = Ahead::default();
        let mut first = 0;
        while first < at.len() {
            let mut end = first + 1;
            while end < at.len() && root(end) == root(first) {
                end += 1;
            }
            ahead.look(first, end, at.len(), root, self.batch);
            let same = Together { at: &at[first..end], first };
            if let Some(net) = self.batch.table.root_leaf(root(first)) {
                self.leaf(net, 0);
                self.group.evaluate(self.batch.what, same, out);
            } else {
                self.items.clear();
                self.items.extend((0..same.len()).map(|i| same.get(i)));
                self.run(root(first), out);
            }
            first = end;
        }
    }

    /// All samples of a chunk in another order.
    fn sorted(&mut self, at: &[Location], order: &[u32], out: &mut Out<'_>) {
        let root = |i: usize| at[order[i] as usize].root;
        let mut ahead = Ahead::default();
        let mut first = 0;
        while first < at.len() {
            let mut end = first;
            self.items.clear();
            while end < at.len() && root(end) == root(first) {
                let Location { u, v, .. } = at[order[end] as usize];
                self.items.push(Item { u, v, index: order[end] });
                end += 1;
            }
            ahead.look(first, end, at.len(), root, self.batch);
            self.run(root(first), out);
            first = end;
        }
    }

    /// The samples of one parametric face, which are in `items`.
    fn run(&mut self, root: u32, out: &mut Out<'_>) {
        let table = self.batch.table;
        let mut items = std::mem::take(&mut self.items);
        if let Some(net) = table.root_leaf(root) {
            self.leaf(net, 0);
            self.group.evaluate(self.batch.what, &items[..], out);
        } else {
            match table.root_node(root).piece() {
                Piece::Tail(number) => self.chain(number, table.root_tail(root), &mut items, out),
                _ => self.tree(root, &mut items, out),
            }
        }
        self.items = items;
    }

    /// Samples of a face that is one chain: put into buckets by step and tile, as long as those are few.
    fn chain(&mut self, number: u32, tail: Tail, items: &mut [Item], out: &mut Out<'_>) {
        const BUCKETS: usize = 64;
        if let [item] = items {
            // Alone, as most are that are scattered.
            let (key, u, v) = place::in_chain(tail.corner, item.u, item.v);
            (item.u, item.v) = (u, v);
            return self.piece(Patch::of_step(self.batch.table, tail, number, key, 0), items, out);
        }
        let mut starts = [0u16; BUCKETS + 2];
        let mut largest = 0;
        self.keyed.clear();
        self.keyed.extend(items.iter().map(|&Item { u, v, index }| {
            let (key, u, v) = place::in_chain(tail.corner, u, v);
            largest = largest.max(key as usize);
            starts[(key as usize).min(BUCKETS - 1) + 2] += 1;
            Keyed { key, item: Item { u, v, index } }
        }));
        let keyed = std::mem::take(&mut self.keyed);
        if largest >= BUCKETS {
            self.sorted_keys(keyed, items, out, |table, key| Patch::of_step(table, tail, number, key, 0));
            return;
        }
        // From counts to starts; filling a bucket moves its start to its end, which is the start of the next.
        for key in 0..=largest {
            starts[key + 2] += starts[key + 1];
        }
        for keyed in &keyed {
            let slot = &mut starts[keyed.key as usize + 1];
            items[usize::from(*slot)] = keyed.item;
            *slot += 1;
        }
        self.keyed = keyed;
        for key in 0..=largest {
            let (start, end) = (usize::from(starts[key]), usize::from(starts[key + 1]));
            if start == end {
                continue;
            }
            let (step, tile) = (key as i32 >> 2, key & 3);
            if step == 0 {
                self.vertex(tail, number, &items[start..end], out);
            } else {
                self.on_tile(Tile { tail, number, step, beyond: 0, tile, depth: 0 }, &items[start..end], out);
            }
        }
    }

    /// Samples by growing keys; `items` is room for them.
    fn sorted_keys(
        &mut self,
        mut keyed: Vec<Keyed>,
        items: &mut [Item],
        out: &mut Out<'_>,
        patch: impl Fn(&'a PatchTable, u64) -> Patch<'a>,
    ) {
        keyed.sort_unstable_by_key(|keyed| (keyed.key, keyed.item.index));
        for same in keyed.chunk_by(|a, b| a.key == b.key) {
            for (item, keyed) in items.iter_mut().zip(same) {
                *item = keyed.item;
            }
            self.piece(patch(self.batch.table, same[0].key), &items[..same.len()], out);
        }
        self.keyed = keyed;
    }

    /// Samples of a face that is split.
    fn tree(&mut self, root: u32, items: &mut [Item], out: &mut Out<'_>) {
        let table = self.batch.table;
        let mut keyed = std::mem::take(&mut self.keyed);
        keyed.clear();
        keyed.extend(items.iter().map(|&Item { u, v, index }| {
            let (key, u, v) = place::key(table, root, u, v);
            Keyed { key, item: Item { u, v, index } }
        }));
        self.sorted_keys(keyed, items, out, Patch::of);
    }

    /// Samples of one bicubic patch, or at one vertex.
    fn piece(&mut self, patch: Patch<'_>, items: &[Item], out: &mut Out<'_>) {
        match patch {
            Patch::Leaf { sources, depth } => self.leaf(sources, depth),
            Patch::Tile(tile) => return self.on_tile(tile, items, out),
            Patch::Vertex { tail, number } => return self.vertex(tail, number, items, out),
        }
        self.group.evaluate(self.batch.what, items, out);
    }

    fn leaf(&mut self, sources: &[u32; 16], depth: i32) {
        // Relative to a point of its own, so that parts far from the origin lose nothing.
        let base = wide(self.batch.points[sources[5] as usize]);
        simd::dispatch(Leaf { points: self.batch.points, sources, base, net: &mut self.group.net });
        let scale = power_of_two(depth);
        self.group.base = base;
        self.group.scales = [1.0, scale, scale * scale];
        self.group.flags = Flags::NONE;
    }

    /// Samples of a tile, which is one patch, or four.
    fn on_tile(&mut self, tile: Tile, items: &[Item], out: &mut Out<'_>) {
        if !self.batch.table.basis(tile.tail).has_quarters() {
            self.tile(tile);
            return self.group.evaluate(self.batch.what, items, out);
        }
        for quarter in 0..4 {
            let within = items.iter().filter_map(|&Item { u, v, index }| {
                let (own, u, v) = child(u, v);
                (own == quarter).then_some(Item { u, v, index })
            });
            let some: Vec<Item> = within.collect();
            if !some.is_empty() {
                self.tile(tile.quarter(quarter));
                self.group.evaluate(self.batch.what, &some[..], out);
            }
        }
    }

    fn tile(&mut self, Tile { tail, number, step, beyond, tile, depth }: Tile) {
        let Batch { table, points, .. } = self.batch;
        self.walk.go(table, points, number, tail, step);
        let basis = table.basis(tail);
        let scale = power_of_two(step + depth);
        let group = &mut self.group;
        group.scales = [1.0, scale, scale * scale];
        group.flags = Flags::NONE;
        if beyond > 0 {
            // Products of powers would leave the range of numbers where the power of the product does not.
            let [position, first, second] = basis.growth(beyond);
            // An infinite scale would make NaN of a zero.
            group.scales = [position, scale * first, (scale * scale * second).min(f64::MAX)];
            group.flags = Flags::BEYOND_NMAX;
        }
        group.base = self.walk.base();
        self.walk.tile(basis, tile, tail.corner, &mut group.net);
    }

    /// Samples at an extraordinary vertex itself.
    fn vertex(&mut self, tail: Tail, number: u32, items: &[Item], out: &mut Out<'_>) {
        let Batch { table, points, what } = self.batch;
        let point = at_corner(&mut self.walk, table, points, number, tail);
        for item in items {
            let i = item.index as usize;
            out.position[i] = point.position;
            out.flags[i] = point.flags;
            if what > Derivatives::None {
                out.du[i] = point.du;
                out.dv[i] = point.dv;
                out.normal[i] = point.normal;
            }
            if what > Derivatives::First {
                out.duu[i] = Vec3::ZERO;
                out.duv[i] = Vec3::ZERO;
                out.dvv[i] = Vec3::ZERO;
            }
        }
    }
}

impl Worker<'_> {
    /// Some places on a parametric face; results go to their numbers, counted from `first`.
    pub(super) fn places<'i>(
        &mut self,
        root: u32,
        places: impl IntoIterator<Item = &'i Item>,
        first: usize,
        out: &mut Out<'_>,
    ) {
        self.items.clear();
        self.items.extend(places.into_iter().map(|item| Item { index: first as u32 + item.index, ..*item }));
        self.run(root, out);
    }

    /// Samples in a leaf of a face that was halved so often.
    #[inline]
    pub(super) fn in_leaf(&mut self, net: &[u32; 16], depth: i32, source: impl Source, out: &mut Out<'_>) {
        self.leaf(net, depth);
        self.group.evaluate(self.batch.what, source, out);
    }

    /// One sample.
    pub(super) fn lone(&mut self, at: Location, out: &mut Out<'_>) {
        self.items.push(Item { u: at.u, v: at.v, index: 0 });
        self.run(at.root, out);
        self.items.clear();
        self.walk.forget();
    }
}
