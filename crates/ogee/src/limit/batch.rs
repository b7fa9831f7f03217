//! Many points: samples sorted by piece, four at a time.

use super::bicubic::{self, Jet, Lanes, Net, lanes};
use super::place::{self, Patch, Tile, power_of_two};
use super::walk::{Walk, last_step, narrow, subtract, wide};
use super::{Derivatives, Flags, Samples};
use crate::math::{Vec3, par, simd};
use crate::patch::{ChainBasis, Kind, Location, PatchTable, Piece, Tail, Wide, to_corner};

/// Samples that one task works through, and sorts where that helps.
const CHUNK: usize = 8192;

/// Samples side by side in the inner loop.
const LANES: usize = 4;

/// Tangents are parallel where the sine of their angle is below this: some dozen roundings.
const PARALLEL: f64 = 1e-14;

/// Where results go; what was not asked for is empty.
pub(super) struct Out<'a> {
    pub(super) position: &'a mut [Vec3],
    pub(super) du: &'a mut [Vec3],
    pub(super) dv: &'a mut [Vec3],
    pub(super) normal: &'a mut [Vec3],
    pub(super) duu: &'a mut [Vec3],
    pub(super) duv: &'a mut [Vec3],
    pub(super) dvv: &'a mut [Vec3],
    pub(super) flags: &'a mut [Flags],
}

impl<'a> Out<'a> {
    fn split_at(self, middle: usize) -> (Out<'a>, Out<'a>) {
        fn cut<T>(slice: &mut [T], middle: usize) -> (&mut [T], &mut [T]) {
            slice.split_at_mut(middle.min(slice.len()))
        }
        let (position, position_rest) = cut(self.position, middle);
        let (du, du_rest) = cut(self.du, middle);
        let (dv, dv_rest) = cut(self.dv, middle);
        let (normal, normal_rest) = cut(self.normal, middle);
        let (duu, duu_rest) = cut(self.duu, middle);
        let (duv, duv_rest) = cut(self.duv, middle);
        let (dvv, dvv_rest) = cut(self.dvv, middle);
        let (flags, flags_rest) = cut(self.flags, middle);
        let rest = Out {
            position: position_rest,
            du: du_rest,
            dv: dv_rest,
            normal: normal_rest,
            duu: duu_rest,
            duv: duv_rest,
            dvv: dvv_rest,
            flags: flags_rest,
        };
        (Out { position, du, dv, normal, duu, duv, dvv, flags }, rest)
    }
}

impl Samples {
    /// Room for so many, in the arrays that are wanted.
    pub(super) fn resize(&mut self, count: usize, what: Derivatives) {
        let wanted = |order: Derivatives| if what >= order { count } else { 0 };
        let (first, second) = (wanted(Derivatives::First), wanted(Derivatives::Second));
        self.position.resize(count, Vec3::ZERO);
        self.flags.resize(count, Flags::NONE);
        for array in [&mut self.du, &mut self.dv, &mut self.normal] {
            array.resize(first, Vec3::ZERO);
        }
        for array in [&mut self.duu, &mut self.duv, &mut self.dvv] {
            array.resize(second, Vec3::ZERO);
        }
    }

    pub(super) fn slices(&mut self) -> Out<'_> {
        Out {
            position: &mut self.position,
            du: &mut self.du,
            dv: &mut self.dv,
            normal: &mut self.normal,
            duu: &mut self.duu,
            duv: &mut self.duv,
            dvv: &mut self.dvv,
            flags: &mut self.flags,
        }
    }
}

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
            Some(order) => worker.all(at, |i| order[i] as usize, &mut out),
            None => worker.all(at, |i| i, &mut out),
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

    #[inline(always)]
    fn look(&mut self, at: usize, count: usize, root: impl Fn(usize) -> u32, batch: Batch<'_>) {
        for (stage, distance) in Ahead::DISTANCES.into_iter().enumerate() {
            let end = (at + distance).min(count);
            for i in self.done[stage].max(at)..end {
                if i > 0 && root(i) == root(i - 1) {
                    continue;
                }
                match stage {
                    0 => batch.table.prefetch_root(root(i)),
                    1 => batch.table.prefetch_points(root(i), batch.points),
                    _ => batch.table.prefetch_ring(root(i), batch.points),
                }
            }
            self.done[stage] = end;
        }
    }
}

/// A sample in the parameters of its bicubic patch.
#[derive(Clone, Copy)]
struct Item {
    x: f64,
    y: f64,
    index: u32,
}

/// A sample whose patch has still to be made: samples of one patch have the same key, and keys go down a chain.
#[derive(Clone, Copy)]
struct Keyed {
    key: u64,
    item: Item,
}

/// One bicubic patch, and how what it gives becomes what was asked for.
struct Group {
    net: Net,
    /// What the net is relative to.
    base: Wide,
    /// The corner of the piece that the net's parameters start from.
    corner: u32,
    /// The scale of position relative to the base, and of first and second derivatives.
    scales: [f64; 3],
    flags: Flags,
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
        let group =
            Group { net: [[0.0; 4]; 16], base: [0.0; 4], corner: 0, scales: [1.0; 3], flags: Flags::NONE };
        Worker { batch, walk: Walk::default(), group, items: Vec::new(), keyed: Vec::new() }
    }

    /// All samples of a chunk, `order(0), order(1), ..`.
    fn all(&mut self, at: &[Location], order: impl Fn(usize) -> usize, out: &mut Out<'_>) {
        let root = |i: usize| at[order(i)].root;
        let mut i = 0;
        let mut ahead = Ahead::default();
        while i < at.len() {
            let first = root(i);
            self.items.clear();
            while i < at.len() && root(i) == first {
                let number = order(i);
                let Location { u: x, v: y, .. } = at[number];
                self.items.push(Item { x, y, index: number as u32 });
                i += 1;
            }
            ahead.look(i, at.len(), root, self.batch);
            self.run(first, out);
        }
    }

    /// The samples of one parametric face, which are in `items`.
    fn run(&mut self, root: u32, out: &mut Out<'_>) {
        let table = self.batch.table;
        let mut items = std::mem::take(&mut self.items);
        if let Some(net) = table.root_leaf(root) {
            self.leaf(net, 0);
            self.evaluate(&items, out);
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
        const BUCKETS: usize = 256;
        let table = self.batch.table;
        let corner = tail.corner;
        let mut ends = [0u32; BUCKETS + 1];
        self.keyed.clear();
        let mut largest = 0;
        for &Item { x, y, index } in items.iter() {
            let (x, y) = to_corner(corner, x, y);
            let (key, x, y) = place::in_chain(x, y);
            largest = largest.max(key as usize);
            ends[(key as usize).min(BUCKETS - 1) + 1] += 1;
            self.keyed.push(Keyed { key, item: Item { x, y, index } });
        }
        if largest >= BUCKETS {
            self.keyed.sort_unstable_by_key(|keyed| (keyed.key, keyed.item.index));
            let keyed = std::mem::take(&mut self.keyed);
            for same in keyed.chunk_by(|a, b| a.key == b.key) {
                for (item, keyed) in items.iter_mut().zip(same) {
                    *item = keyed.item;
                }
                self.piece(Patch::of_step(table, tail, number, same[0].key, 0), &items[..same.len()], out);
            }
            self.keyed = keyed;
            return;
        }
        for key in 0..=largest {
            ends[key + 1] += ends[key];
        }
        let mut next = ends;
        for keyed in &self.keyed {
            let slot = &mut next[keyed.key as usize];
            items[*slot as usize] = keyed.item;
            *slot += 1;
        }
        for key in 0..=largest {
            let (start, end) = (ends[key] as usize, ends[key + 1] as usize);
            if start < end {
                self.piece(Patch::of_step(table, tail, number, key as u64, 0), &items[start..end], out);
            }
        }
    }

    /// Samples of a face that is split.
    fn tree(&mut self, root: u32, items: &mut [Item], out: &mut Out<'_>) {
        let table = self.batch.table;
        self.keyed.clear();
        for &Item { x, y, index } in items.iter() {
            let (key, x, y) = place::key(table, root, x, y);
            self.keyed.push(Keyed { key, item: Item { x, y, index } });
        }
        self.keyed.sort_unstable_by_key(|keyed| (keyed.key, keyed.item.index));
        let keyed = std::mem::take(&mut self.keyed);
        for same in keyed.chunk_by(|a, b| a.key == b.key) {
            for (item, keyed) in items.iter_mut().zip(same) {
                *item = keyed.item;
            }
            self.piece(Patch::of(table, same[0].key), &items[..same.len()], out);
        }
        self.keyed = keyed;
    }

    /// Samples of one bicubic patch, or at one vertex.
    fn piece(&mut self, patch: Patch<'_>, items: &[Item], out: &mut Out<'_>) {
        match patch {
            Patch::Leaf { sources, depth } => self.leaf(sources, depth),
            Patch::Tile(tile) => self.tile(tile),
            Patch::Vertex { tail, number } => return self.vertex(tail, number, items, out),
        }
        self.evaluate(items, out);
    }

    fn leaf(&mut self, sources: &[u32; 16], depth: i32) {
        // Relative to a point of its own, so that parts far from the origin lose nothing.
        let base = wide(self.batch.points[sources[5] as usize]);
        for (point, &source) in self.group.net.iter_mut().zip(sources) {
            *point = subtract(wide(self.batch.points[source as usize]), base);
        }
        let scale = power_of_two(depth);
        self.group.base = base;
        self.group.corner = 0;
        self.group.scales = [1.0, scale, scale * scale];
        self.group.flags = Flags::NONE;
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
            let power = |factor: f64| (factor * basis.eigenvalue).powi(beyond);
            // An infinite scale would make NaN of a zero.
            group.scales = [power(1.0), scale * power(2.0), (scale * scale * power(4.0)).min(f64::MAX)];
            group.flags = Flags::BEYOND_NMAX;
        }
        group.corner = tail.corner;
        group.base = self.walk.base();
        self.walk.tile(basis, tile, &mut group.net);
    }

    #[inline]
    fn evaluate(&self, items: &[Item], out: &mut Out<'_>) {
        let group = &self.group;
        match self.batch.what {
            Derivatives::None => evaluate::<0>(group, items, out),
            Derivatives::First => evaluate::<1>(group, items, out),
            Derivatives::Second => evaluate::<2>(group, items, out),
        }
    }

    /// Samples at an extraordinary vertex itself.
    fn vertex(&mut self, tail: Tail, number: u32, items: &[Item], out: &mut Out<'_>) {
        let Batch { table, points, what } = self.batch;
        let (position, masks) = self.walk.corner(table, points, number, tail);
        let basis = table.basis(tail);
        let outward = self.walk.outward(basis);
        let mut flags = flags_at(basis);
        let mut tangents = [Vec3::ZERO; 2];
        let mut normal = None;
        if what > Derivatives::None {
            tangents = masks.unwrap_or_else(|| {
                self.walk.go(table, points, number, tail, last_step(basis));
                self.walk.tile(basis, 1, &mut self.group.net);
                let jet = bicubic::one::<1>(&self.group.net, 0.0, 0.0);
                [jet[1], jet[2]].map(|tangent| narrow(tangent).normalized().unwrap_or(Vec3::ZERO))
            });
            normal = unit_normal(tangents[0], tangents[1]);
            // The sharp edges of a reflex corner span the plane the wrong way round.
            let is_corner = matches!(basis.kind, Kind::Corner { faces: 2, .. });
            if is_corner && normal.is_some_and(|n| n.dot(outward) < 0.0) {
                tangents = [tangents[1], tangents[0]];
                normal = normal.map(|n| -n);
            }
            if normal.is_none() {
                flags = flags.with(Flags::NORMAL_UNDEFINED);
            }
        }
        let [du, dv] = match tail.corner {
            0 => tangents,
            1 => [-tangents[1], tangents[0]],
            2 => [-tangents[0], -tangents[1]],
            _ => [tangents[1], -tangents[0]],
        };
        for item in items {
            let i = item.index as usize;
            out.position[i] = position;
            out.flags[i] = flags;
            if what > Derivatives::None {
                out.du[i] = du;
                out.dv[i] = dv;
                out.normal[i] = normal.unwrap_or(Vec3::ZERO);
            }
            if what > Derivatives::First {
                out.duu[i] = Vec3::ZERO;
                out.duv[i] = Vec3::ZERO;
                out.dvv[i] = Vec3::ZERO;
            }
        }
    }
}

/// What is known about an irregular vertex (`docs/methods/exact_evaluation.md`).
fn flags_at(basis: &ChainBasis) -> Flags {
    let flags = Flags::AT_EXTRAORDINARY;
    let (one_sided, unbounded) = match basis.kind {
        Kind::Smooth { valence } => (valence < 3, valence > 4),
        Kind::Cone { .. } => (true, true),
        Kind::Dart { .. } => (false, true),
        Kind::Crease { faces, .. } => (faces > 3, faces > 2),
        Kind::Corner { faces, .. } => (faces > 2, faces > 2),
    };
    let flags = if one_sided { flags.with(Flags::NORMAL_ONE_SIDED) } else { flags };
    if unbounded { flags.with(Flags::UNBOUNDED_CURVATURE) } else { flags }
}

/// All samples of one patch.
#[inline]
fn evaluate<const ORDER: usize>(group: &Group, items: &[Item], out: &mut Out<'_>) {
    let &[item] = items else {
        return simd::dispatch(Evaluate::<ORDER> { group, items, out });
    };
    let mut jet = [[0.0; 4]; 6];
    simd::dispatch(One::<ORDER> { net: &group.net, item, jet: &mut jet });
    let mut parts = [[[0.0]; 3]; 6];
    for (part, wide) in parts.iter_mut().zip(&jet) {
        *part = [[wide[0]], [wide[1]], [wide[2]]];
    }
    write::<ORDER, 1>(group, items, parts, out);
}

/// One sample, for [`simd::dispatch`]. All four lanes go to memory: a compiler that knows the fourth to be idle packs the
/// other three in ways that cost more.
struct One<'a, const ORDER: usize> {
    net: &'a Net,
    item: Item,
    jet: &'a mut Jet<Wide>,
}

impl<const ORDER: usize> simd::Kernel for One<'_, ORDER> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        *self.jet = bicubic::one::<ORDER>(self.net, self.item.x, self.item.y);
    }
}

/// All samples of one patch, for [`simd::dispatch`].
struct Evaluate<'a, 'o, const ORDER: usize> {
    group: &'a Group,
    items: &'a [Item],
    out: &'a mut Out<'o>,
}

impl<const ORDER: usize> simd::Kernel for Evaluate<'_, '_, ORDER> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Evaluate { group, items, out } = self;
        for items in items.chunks(LANES) {
            let at = |l: usize| items[l.min(items.len() - 1)];
            let x: Lanes<LANES> = lanes(|l| at(l).x);
            let y: Lanes<LANES> = lanes(|l| at(l).y);
            let jet = bicubic::many::<ORDER, LANES>(&group.net, x, y);
            write::<ORDER, LANES>(group, items, jet, out);
        }
    }
}

/// Turns jets into the directions and scales of the face, and writes them.
#[inline(always)]
fn write<const ORDER: usize, const L: usize>(
    group: &Group,
    items: &[Item],
    jet: Jet<[Lanes<L>; 3]>,
    out: &mut Out<'_>,
) {
    let vector = |part: &[Lanes<L>; 3], l: usize, scale: f64| {
        Vec3::new(scale * part[0][l], scale * part[1][l], scale * part[2][l])
    };
    let [position_scale, first, second] = group.scales;
    let base = narrow(group.base);
    for (l, item) in items.iter().enumerate() {
        let i = item.index as usize;
        out.position[i] = base + vector(&jet[0], l, position_scale);
        out.flags[i] = group.flags;
    }
    if ORDER == 0 {
        return;
    }
    // The corner's frame is turned against the face's.
    let (along, along_sign, across, across_sign) = match group.corner {
        0 => (1, 1.0, 2, 1.0),
        1 => (2, -1.0, 1, 1.0),
        2 => (1, -1.0, 2, -1.0),
        _ => (2, 1.0, 1, -1.0),
    };
    let normals = normals(&jet[1], &jet[2]);
    for (l, item) in items.iter().enumerate() {
        let i = item.index as usize;
        out.du[i] = vector(&jet[along], l, along_sign * first);
        out.dv[i] = vector(&jet[across], l, across_sign * first);
        let mut normal = vector(&normals.vectors, l, 1.0);
        if !normals.sure[l] {
            let tangents = [1, 2].map(|part: usize| vector(&jet[part], l, 1.0));
            normal = unit_normal(tangents[0], tangents[1]).unwrap_or_else(|| {
                out.flags[i] = out.flags[i].with(Flags::NORMAL_UNDEFINED);
                Vec3::ZERO
            });
        }
        out.normal[i] = normal;
    }
    if ORDER == 1 {
        return;
    }
    let (along, mixed_sign, across) = match group.corner {
        0 | 2 => (3, 1.0, 5),
        _ => (5, -1.0, 3),
    };
    for (l, item) in items.iter().enumerate() {
        let i = item.index as usize;
        out.duu[i] = vector(&jet[along], l, second);
        out.duv[i] = vector(&jet[4], l, mixed_sign * second);
        out.dvv[i] = vector(&jet[across], l, second);
    }
}

/// Unit normals in lanes, and for each whether its arithmetic is beyond doubt.
struct Normals<const L: usize> {
    vectors: [Lanes<L>; 3],
    sure: [bool; L],
}

#[inline(always)]
fn normals<const L: usize>(a: &[Lanes<L>; 3], b: &[Lanes<L>; 3]) -> Normals<L> {
    let product = |i: usize, j: usize| -> Lanes<L> { lanes(|l| a[i][l] * b[j][l] - a[j][l] * b[i][l]) };
    let cross = [product(1, 2), product(2, 0), product(0, 1)];
    let square = |v: &[Lanes<L>; 3]| -> Lanes<L> {
        lanes(|l| v[0][l] * v[0][l] + v[1][l] * v[1][l] + v[2][l] * v[2][l])
    };
    let (length, first, second) = (square(&cross), square(a), square(b));
    // Squares of products of derivatives: within these no step has over- or underflown.
    const RANGE: std::ops::Range<f64> = 1e-200..1e200;
    let mut sure = [false; L];
    for (l, sure) in sure.iter_mut().enumerate() {
        *sure = length[l] > PARALLEL * PARALLEL * first[l] * second[l] && RANGE.contains(&length[l]);
    }
    let root: Lanes<L> = lanes(|l| 1.0 / length[l].sqrt());
    let scaled = |c: usize| -> Lanes<L> { lanes(|l| cross[c][l] * root[l]) };
    let vectors = [scaled(0), scaled(1), scaled(2)];
    Normals { vectors, sure }
}

/// The unit normal of two tangents of any size; nothing where they are parallel or vanish.
fn unit_normal(a: Vec3, b: Vec3) -> Option<Vec3> {
    let (a, b) = (a.normalized()?, b.normalized()?);
    let cross = a.cross(b);
    if cross.length() > PARALLEL { cross.normalized() } else { None }
}

impl Worker<'_> {
    /// One sample.
    pub(super) fn lone(&mut self, at: Location, out: &mut Out<'_>) {
        self.items.push(Item { x: at.u, y: at.v, index: 0 });
        self.run(at.root, out);
        self.items.clear();
        self.walk.forget();
    }
}
