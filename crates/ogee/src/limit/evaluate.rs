//! Samples of one bicubic patch, four at a time.

use std::marker::PhantomData;

use super::bicubic::{self, Jet, Net};
use super::out::Out;
use super::walk::narrow;
use super::{Derivatives, Flags};
use crate::math::Vec3;
use crate::math::simd::{self, Four};
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
    /// Coefficients of powers of its parameters.
    pub(super) net: Net,
    /// What they are relative to.
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
            return simd::dispatch(Run::<PARTS, S> { group: self, source, out });
        }
        let mut jet = [[0.0; 4]; PARTS];
        let item = source.get(0);
        simd::dispatch(One { net: &self.net, item, jet: &mut jet });
        self.write_one(item.index as usize, &jet, out);
    }

    /// Scales and writes one jet: the same operations as those of four.
    fn write_one<const PARTS: usize>(&self, index: usize, jet: &Jet<Wide, PARTS>, out: &mut Out<'_>) {
        let scaled = |part: Wide, scale: f64| narrow(part) * scale;
        let [position_scale, first_scale, second_scale] = self.scales;
        out.position[index] = narrow(self.base) + scaled(jet[0], position_scale);
        out.flags[index] = self.flags;
        if PARTS == 1 {
            return;
        }
        out.du[index] = scaled(jet[1], first_scale);
        out.dv[index] = scaled(jet[2], first_scale);
        let (du, dv) = (narrow(jet[1]), narrow(jet[2]));
        let cross = du.cross(dv);
        let length = cross.dot(cross);
        out.normal[index] = if is_sure(length, du.dot(du), dv.dot(dv)) {
            cross * (1.0 / length.sqrt())
        } else {
            unit_normal(du, dv).unwrap_or_else(|| {
                out.flags[index] = self.flags.with(Flags::NORMAL_UNDEFINED);
                Vec3::ZERO
            })
        };
        if PARTS == 3 {
            return;
        }
        out.duu[index] = scaled(jet[3], second_scale);
        out.duv[index] = scaled(jet[4], second_scale);
        out.dvv[index] = scaled(jet[5], second_scale);
    }

    /// Scales jets, and writes them.
    #[inline(always)]
    fn write<const PARTS: usize, S: Source, V: Four>(
        &self,
        put: &Put<S>,
        jet: &Jet<[V; 3], PARTS>,
        out: &mut Out<'_>,
    ) {
        // One check of all indices: arrays that are wanted have the same length.
        let count = out.position.len();
        assert!(put.indices.iter().all(|&index| index < count), "there is room for every sample");
        let [position_scale, first_scale, second_scale] = self.scales;
        let [x, y, z] = scaled(&jet[0], position_scale);
        let base = [V::splat(self.base[0]), V::splat(self.base[1]), V::splat(self.base[2])];
        put.vectors(out.position, [base[0].plus(x), base[1].plus(y), base[2].plus(z)]);
        put.each(&mut out.flags[..count], |_| self.flags);
        if PARTS == 1 {
            return;
        }
        put.vectors(&mut out.du[..count], scaled(&jet[1], first_scale));
        put.vectors(&mut out.dv[..count], scaled(&jet[2], first_scale));
        let normals = normals(&jet[1], &jet[2]);
        put.vectors(&mut out.normal[..count], normals.vectors);
        if normals.sure != [true; LANES] {
            self.doubtful(put, normals.sure, [stored(&jet[1]), stored(&jet[2])], out);
        }
        if PARTS == 3 {
            return;
        }
        put.vectors(&mut out.duu[..count], scaled(&jet[3], second_scale));
        put.vectors(&mut out.duv[..count], scaled(&jet[4], second_scale));
        put.vectors(&mut out.dvv[..count], scaled(&jet[5], second_scale));
    }

    /// Normals whose squares are too large or small for numbers, or that do not exist.
    #[cold]
    #[inline(never)]
    fn doubtful<S: Source>(
        &self,
        put: &Put<S>,
        sure: [bool; LANES],
        tangents: [[Wide; 3]; 2],
        out: &mut Out<'_>,
    ) {
        for l in (0..put.count).filter(|&l| !sure[l]) {
            let index = put.indices[l];
            let [du, dv] = tangents.map(|[x, y, z]| Vec3::new(x[l], y[l], z[l]));
            let normal = unit_normal(du, dv);
            out.normal[index] = normal.unwrap_or(Vec3::ZERO);
            if normal.is_none() {
                out.flags[index] = self.flags.with(Flags::NORMAL_UNDEFINED);
            }
        }
    }
}

/// Places of results of up to four samples.
struct Put<S> {
    indices: [usize; LANES],
    count: usize,
    source: PhantomData<S>,
}

impl<S: Source> Put<S> {
    #[inline(always)]
    fn vectors<V: Four>(&self, out: &mut [Vec3], [x, y, z]: [V; 3]) {
        let (x, y, z) = (x.store(), y.store(), z.store());
        self.each(out, |l| Vec3::new(x[l], y[l], z[l]));
    }

    #[inline(always)]
    fn each<T>(&self, out: &mut [T], value: impl Fn(usize) -> T) {
        if S::STRAIGHT && self.count == LANES {
            let start = self.indices[0];
            let out = &mut out[start..start + LANES];
            for l in 0..LANES {
                out[l] = value(l);
            }
        } else if self.count == LANES {
            for l in 0..LANES {
                out[self.indices[l]] = value(l);
            }
        } else {
            for l in 0..self.count {
                out[self.indices[l]] = value(l);
            }
        }
    }
}

/// One sample, for [`simd::dispatch`].
struct One<'a, const PARTS: usize> {
    net: &'a Net,
    item: Item,
    jet: &'a mut Jet<Wide, PARTS>,
}

impl<const PARTS: usize> simd::Kernel for One<'_, PARTS> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let One { net, item, jet } = self;
        let parts = bicubic::one::<PARTS, V>(net, V::splat(item.u), V::splat(item.v));
        for part in 0..PARTS {
            jet[part] = parts[part].store();
        }
    }
}

/// Samples of one patch, for [`simd::dispatch`].
struct Run<'a, 'o, const PARTS: usize, S> {
    group: &'a Group,
    source: S,
    out: &'a mut Out<'o>,
}

impl<const PARTS: usize, S: Source> simd::Kernel for Run<'_, '_, PARTS, S> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        let Run { group, source, out } = self;
        let len = source.len();
        for first in (0..len).step_by(LANES) {
            let count = LANES.min(len - first);
            // Lanes that are left over take the last sample again.
            let item = |l: usize| source.get(first + l.min(count - 1));
            let [a, b, c, d] = [item(0), item(1), item(2), item(3)];
            let (u, v) = (V::load(&[a.u, b.u, c.u, d.u]), V::load(&[a.v, b.v, c.v, d.v]));
            let indices = [a.index as usize, b.index as usize, c.index as usize, d.index as usize];
            let put = Put { indices, count, source: PhantomData::<S> };
            group.write::<PARTS, S, V>(&put, &bicubic::four::<PARTS, V>(&group.net, u, v), out);
        }
    }
}

#[inline(always)]
fn scaled<V: Four>(part: &[V; 3], scale: f64) -> [V; 3] {
    let scale = V::splat(scale);
    [part[0].times(scale), part[1].times(scale), part[2].times(scale)]
}

#[inline(always)]
fn square<V: Four>(v: &[V; 3]) -> V {
    v[0].times(v[0]).plus(v[1].times(v[1])).plus(v[2].times(v[2]))
}

#[inline(always)]
fn stored<V: Four>(part: &[V; 3]) -> [Wide; 3] {
    [part[0].store(), part[1].store(), part[2].store()]
}

/// Unit normals in lanes, and for each whether its arithmetic is beyond doubt.
struct Normals<V> {
    vectors: [V; 3],
    sure: [bool; LANES],
}

#[inline(always)]
fn normals<V: Four>(a: &[V; 3], b: &[V; 3]) -> Normals<V> {
    let cross = [
        a[1].times(b[2]).minus(a[2].times(b[1])),
        a[2].times(b[0]).minus(a[0].times(b[2])),
        a[0].times(b[1]).minus(a[1].times(b[0])),
    ];
    let length = square(&cross);
    let scale = V::splat(1.0).over(length.root());
    let vectors = [cross[0].times(scale), cross[1].times(scale), cross[2].times(scale)];
    let (first, second, length) = (square(a).store(), square(b).store(), length.store());
    let mut sure = [true; LANES];
    for l in 0..LANES {
        sure[l] = is_sure(length[l], first[l], second[l]);
    }
    Normals { vectors, sure }
}

/// True if a normal is beyond doubt; `length` is the square of the cross product of two tangents, `first` and `second`
/// are those of the tangents.
#[inline(always)]
fn is_sure(length: f64, first: f64, second: f64) -> bool {
    // Squares of products of derivatives: within these no step has over- or underflown.
    const LEAST: f64 = 1e-200;
    const GREATEST: f64 = 1e200;
    (length > PARALLEL * PARALLEL * first * second) & (length > LEAST) & (length < GREATEST)
}

/// The unit normal of two tangents of any size; nothing where they are parallel or vanish.
pub(super) fn unit_normal(a: Vec3, b: Vec3) -> Option<Vec3> {
    let (a, b) = (a.normalized()?, b.normalized()?);
    let cross = a.cross(b);
    if cross.length() > PARALLEL { cross.normalized() } else { None }
}

/// Tangents of a patch at its own origin.
pub(super) fn tangents_at_origin(net: &Net) -> [Vec3; 2] {
    // Coefficients of u and of v.
    [net[1], net[4]].map(narrow)
}

#[cfg(test)]
mod tests {
    use crate::math::simd::PLAIN;
    use crate::mesh::{Crease, FaceId, Sharpness, shapes};
    use crate::rules::Level;
    use crate::{Derivatives, LimitSurface, PatchTable, Samples};

    /// Leaves, chains and splits, alone and four at a time, on wide registers and in plain code. On a processor without
    /// wide registers both are plain.
    #[test]
    fn wide_registers_give_the_bits_of_plain_code() {
        let mut creased = shapes::disk(7, 2);
        creased.creases.push(Crease { vertices: [0, 1], sharpness: Sharpness::Infinite });
        for mesh in [shapes::studded_torus(12, 8, 4), shapes::cube(), creased] {
            let table = PatchTable::new(&Level::new(&mesh).unwrap());
            let surface = LimitSurface::new(&table, &mesh.points);
            let mut at = Vec::new();
            for face in (0..mesh.faces.len() as u32).map(FaceId) {
                let corner = table.locate(face, None, 0.0, 0.0).unwrap();
                for t in [0.0, 0.01, 0.2, 0.31, 0.5, 0.77, 0.999] {
                    at.extend([corner.at(t, 0.3 * t).unwrap(), corner.at(1.0 - t, t * t).unwrap()]);
                }
            }
            at.truncate(4096);
            let results = |plain: bool| -> Samples {
                PLAIN.set(plain);
                let samples = surface.eval_batch(&at, Derivatives::Second);
                PLAIN.set(false);
                samples
            };
            let (plain, wide) = (results(true), results(false));
            let bits = |samples: &Samples| -> Vec<u64> {
                let arrays = [
                    &samples.position,
                    &samples.du,
                    &samples.dv,
                    &samples.normal,
                    &samples.duu,
                    &samples.duv,
                    &samples.dvv,
                ];
                let vectors = arrays.into_iter().flatten();
                vectors.flat_map(|&v| <[f64; 3]>::from(v)).map(f64::to_bits).collect()
            };
            assert_eq!(bits(&plain), bits(&wide));
            assert_eq!(plain.flags, wide.flags);
        }
    }
}
