//! Samples of one bicubic patch, four at a time.

use super::bicubic::{self, Jet, Net};
use super::normals::{is_sure, unit_normal};
use super::out::{LANES, Lie, Out, Put};
use super::walk::narrow;
use super::{Derivatives, Flags};
use crate::math::Vec3;
use crate::math::simd::{self, Four};
use crate::patch::{Location, Wide};

/// A sample in the parameters of its patch, and where its results go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) index: u32,
}

/// Samples of one patch.
pub(super) trait Source {
    /// True if results go to places one after the other.
    fn is_straight(&self) -> bool;
    fn len(&self) -> usize;
    fn get(&self, i: usize) -> Item;
}

impl Source for &[Item] {
    #[inline(always)]
    fn is_straight(&self) -> bool {
        false
    }

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
    #[inline(always)]
    fn is_straight(&self) -> bool {
        true
    }

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

/// Places of a pattern, whose numbers are counted from `first`.
pub(super) struct Counted<'a> {
    pub(super) items: &'a [Item],
    pub(super) first: usize,
    pub(super) straight: bool,
}

impl Source for Counted<'_> {
    #[inline(always)]
    fn is_straight(&self) -> bool {
        self.straight
    }

    #[inline(always)]
    fn len(&self) -> usize {
        self.items.len()
    }

    #[inline(always)]
    fn get(&self, i: usize) -> Item {
        let item = self.items[i];
        Item { index: self.first as u32 + item.index, ..item }
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
    fn write<const PARTS: usize, V: Four>(&self, put: &Put, jet: &Jet<[V; 3], PARTS>, out: &mut Out<'_>) {
        let [position_scale, first_scale, second_scale] = self.scales;
        let [x, y, z] = scaled(&jet[0], position_scale);
        let base = [V::splat(self.base[0]), V::splat(self.base[1]), V::splat(self.base[2])];
        put.vectors(out.position, [base[0].plus(x), base[1].plus(y), base[2].plus(z)]);
        put.flags(out.flags, self.flags);
        if PARTS == 1 {
            return;
        }
        put.vectors(out.du, scaled(&jet[1], first_scale));
        put.vectors(out.dv, scaled(&jet[2], first_scale));
        put.normals(&jet[1], &jet[2], self.flags, out);
        if PARTS == 3 {
            return;
        }
        put.vectors(out.duu, scaled(&jet[3], second_scale));
        put.vectors(out.duv, scaled(&jet[4], second_scale));
        put.vectors(out.dvv, scaled(&jet[5], second_scale));
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
            let lie = if source.is_straight() && count == LANES { Lie::Together } else { Lie::Apart };
            let put = Put { indices, count, lie };
            group.write::<PARTS, V>(&put, &bicubic::four::<PARTS, V>(&group.net, u, v), out);
        }
    }
}

#[inline(always)]
fn scaled<V: Four>(part: &[V; 3], scale: f64) -> [V; 3] {
    let scale = V::splat(scale);
    [part[0].times(scale), part[1].times(scale), part[2].times(scale)]
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
            let mut places: Vec<[f64; 2]> = at[..13].iter().map(|place| place.parameters()).collect();
            // Rectangles whose corners stand in pairs, and such whose corners stand apart.
            places.extend([[0.6, 0.1], [0.9, 0.1], [0.6, 0.4], [0.9, 0.4]]);
            places.extend([[0.6, 0.6], [0.6, 0.9], [0.8, 0.6], [0.8, 0.9]]);
            let pattern = |plain: bool| -> Samples {
                let mut samples = Samples::default();
                PLAIN.set(plain);
                let pattern = table.pattern(&places, Derivatives::Second).unwrap();
                surface.eval_pattern(&pattern, 0..table.len().min(300), &mut samples).unwrap();
                PLAIN.set(false);
                samples
            };
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
            for (plain, wide) in [(results(true), results(false)), (pattern(true), pattern(false))] {
                assert_eq!(bits(&plain), bits(&wide));
                assert_eq!(plain.flags, wide.flags);
            }
        }
    }
}
