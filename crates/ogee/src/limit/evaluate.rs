//! Samples of one bicubic patch, four at a time.

use super::bicubic::{self, Jet, Lanes, Net, lanes};
use super::out::Out;
use super::walk::narrow;
use super::{Derivatives, Flags};
use crate::math::{Vec3, simd};
use crate::patch::{Location, Wide};

/// Samples side by side in the inner loop.
const LANES: usize = 4;

/// Tangents are parallel where the sine of their angle is below this: some dozen roundings.
const PARALLEL: f64 = 1e-14;

/// A sample in the parameters of its patch, and where its results go.
#[derive(Clone, Copy)]
pub(super) struct Item {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) index: u32,
}

/// Samples of one patch.
pub(super) trait Source {
    /// True if results go to places one after the other.
    const STRAIGHT: bool;
    fn len(&self) -> usize;
    fn get(&self, i: usize) -> Item;
}

impl Source for &[Item] {
    const STRAIGHT: bool = false;

    #[inline(always)]
    fn len(&self) -> usize {
        <[Item]>::len(self)
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Item {
        self[i]
    }
}

/// Locations of one parametric face that stand together; results start at `first`.
#[derive(Clone, Copy)]
pub(super) struct Together<'a> {
    pub(super) at: &'a [Location],
    pub(super) first: usize,
}

impl Source for Together<'_> {
    const STRAIGHT: bool = true;

    #[inline(always)]
    fn len(&self) -> usize {
        self.at.len()
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Item {
        let Location { u, v, .. } = self.at[i];
        Item { u, v, index: (self.first + i) as u32 }
    }
}

/// One bicubic patch, and how what it gives becomes what was asked for.
pub(super) struct Group {
    pub(super) net: Net,
    /// What the net is relative to.
    pub(super) base: Wide,
    /// The scale of position relative to the base, and of first and second derivatives.
    pub(super) scales: [f64; 3],
    pub(super) flags: Flags,
}

impl Group {
    /// Evaluates samples, and writes what is wanted of them.
    #[inline]
    pub(super) fn evaluate(&self, what: Derivatives, source: impl Source, out: &mut Out<'_>) {
        match what {
            Derivatives::None => self.parts::<1, _>(source, out),
            Derivatives::First => self.parts::<3, _>(source, out),
            Derivatives::Second => self.parts::<6, _>(source, out),
        }
    }

    #[inline]
    fn parts<const PARTS: usize, S: Source>(&self, source: S, out: &mut Out<'_>) {
        if source.len() > 1 {
            return simd::dispatch(Many::<PARTS, S> { group: self, source, out });
        }
        let mut jet = [[0.0; 4]; PARTS];
        simd::dispatch(One { net: &self.net, item: source.get(0), jet: &mut jet });
        let mut parts = [[[0.0]; 3]; PARTS];
        for (part, wide) in parts.iter_mut().zip(&jet) {
            *part = [[wide[0]], [wide[1]], [wide[2]]];
        }
        self.write::<PARTS, 1, S>(&source, 0, 1, &parts, out);
    }

    /// Scales jets, and writes `count` of them: those of the samples from `first` on.
    #[inline(always)]
    fn write<const PARTS: usize, const L: usize, S: Source>(
        &self,
        source: &S,
        first: usize,
        count: usize,
        jet: &Jet<[Lanes<L>; 3], PARTS>,
        out: &mut Out<'_>,
    ) {
        let put = Put { source, first, count };
        let scaled = |part: &[Lanes<L>; 3], scale: f64| -> [Lanes<L>; 3] {
            let times = |c: usize| -> Lanes<L> { lanes(|l| part[c][l] * scale) };
            [times(0), times(1), times(2)]
        };
        let [position_scale, first_scale, second_scale] = self.scales;
        let relative = scaled(&jet[0], position_scale);
        let moved = |c: usize| -> Lanes<L> { lanes(|l| self.base[c] + relative[c][l]) };
        put.vectors(out.position, &[moved(0), moved(1), moved(2)]);
        put.each(out.flags, |_| self.flags);
        if PARTS == 1 {
            return;
        }
        put.vectors(out.du, &scaled(&jet[1], first_scale));
        put.vectors(out.dv, &scaled(&jet[2], first_scale));
        let normals = normals(&jet[1], &jet[2]);
        put.vectors(out.normal, &normals.vectors);
        if !normals.sure.iter().all(|&sure| sure) {
            self.doubtful(&put, &jet[1], &jet[2], &normals, out);
        }
        if PARTS == 3 {
            return;
        }
        put.vectors(out.duu, &scaled(&jet[3], second_scale));
        put.vectors(out.duv, &scaled(&jet[4], second_scale));
        put.vectors(out.dvv, &scaled(&jet[5], second_scale));
    }

    /// Normals whose squares are too large or small for numbers, or that do not exist.
    #[cold]
    fn doubtful<const L: usize, S: Source>(
        &self,
        put: &Put<'_, S>,
        du: &[Lanes<L>; 3],
        dv: &[Lanes<L>; 3],
        normals: &Normals<L>,
        out: &mut Out<'_>,
    ) {
        for l in (0..put.count).filter(|&l| !normals.sure[l]) {
            let index = put.source.get(put.first + l).index as usize;
            let vector = |part: &[Lanes<L>; 3]| Vec3::new(part[0][l], part[1][l], part[2][l]);
            let normal = unit_normal(vector(du), vector(dv));
            out.normal[index] = normal.unwrap_or(Vec3::ZERO);
            if normal.is_none() {
                out.flags[index] = self.flags.with(Flags::NORMAL_UNDEFINED);
            }
        }
    }
}

/// Places of results.
struct Put<'a, S> {
    source: &'a S,
    first: usize,
    count: usize,
}

impl<S: Source> Put<'_, S> {
    #[inline(always)]
    fn vectors<const L: usize>(&self, out: &mut [Vec3], part: &[Lanes<L>; 3]) {
        self.each(out, |l| Vec3::new(part[0][l], part[1][l], part[2][l]));
    }

    #[inline(always)]
    fn each<T>(&self, out: &mut [T], value: impl Fn(usize) -> T) {
        if S::STRAIGHT {
            let start = self.source.get(self.first).index as usize;
            for (l, out) in out[start..start + self.count].iter_mut().enumerate() {
                *out = value(l);
            }
        } else {
            for l in 0..self.count {
                out[self.source.get(self.first + l).index as usize] = value(l);
            }
        }
    }
}

/// One sample, for [`simd::dispatch`]. All four lanes go to memory: a compiler that knows the fourth to be idle packs the
/// other three in ways that cost more.
struct One<'a, const PARTS: usize> {
    net: &'a Net,
    item: Item,
    jet: &'a mut Jet<Wide, PARTS>,
}

impl<const PARTS: usize> simd::Kernel for One<'_, PARTS> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        *self.jet = bicubic::one(self.net, self.item.u, self.item.v);
    }
}

/// Several samples, for [`simd::dispatch`].
struct Many<'a, 'o, const PARTS: usize, S> {
    group: &'a Group,
    source: S,
    out: &'a mut Out<'o>,
}

impl<const PARTS: usize, S: Source> simd::Kernel for Many<'_, '_, PARTS, S> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Many { group, source, out } = self;
        let len = source.len();
        let mut first = 0;
        while first + LANES <= len {
            let u: Lanes<LANES> = lanes(|l| source.get(first + l).u);
            let v: Lanes<LANES> = lanes(|l| source.get(first + l).v);
            let jet = bicubic::many::<PARTS, LANES>(&group.net, u, v);
            group.write::<PARTS, LANES, S>(&source, first, LANES, &jet, out);
            first += LANES;
        }
        if first < len {
            // The last sample again in lanes that are left over.
            let at = |l: usize| source.get((first + l).min(len - 1));
            let (u, v): (Lanes<LANES>, Lanes<LANES>) = (lanes(|l| at(l).u), lanes(|l| at(l).v));
            let jet = bicubic::many::<PARTS, LANES>(&group.net, u, v);
            group.write::<PARTS, LANES, S>(&source, first, len - first, &jet, out);
        }
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
    let least: Lanes<L> = lanes(|l| PARALLEL * PARALLEL * first[l] * second[l]);
    let mut sure = [false; L];
    for (l, sure) in sure.iter_mut().enumerate() {
        *sure = length[l] > least[l] && RANGE.contains(&length[l]);
    }
    let scale: Lanes<L> = lanes(|l| 1.0 / length[l].sqrt());
    let scaled = |c: usize| -> Lanes<L> { lanes(|l| cross[c][l] * scale[l]) };
    Normals { vectors: [scaled(0), scaled(1), scaled(2)], sure }
}

/// The unit normal of two tangents of any size; nothing where they are parallel or vanish.
pub(super) fn unit_normal(a: Vec3, b: Vec3) -> Option<Vec3> {
    let (a, b) = (a.normalized()?, b.normalized()?);
    let cross = a.cross(b);
    if cross.length() > PARALLEL { cross.normalized() } else { None }
}

/// Position and tangents of a net at its own origin, relative to its base.
pub(super) fn at_origin(net: &Net) -> [Vec3; 3] {
    let jet: Jet<Wide, 3> = bicubic::one(net, 0.0, 0.0);
    [narrow(jet[0]), narrow(jet[1]), narrow(jet[2])]
}
