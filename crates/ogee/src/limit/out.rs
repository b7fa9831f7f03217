//! Where results go.

use super::evaluate::Item;
use super::normals::{SURE, normals, unit_normal};
use super::{Derivatives, Flags, Samples};
use crate::math::Vec3;
use crate::math::simd::Four;
use crate::patch::Wide;

/// Samples side by side in inner loops.
pub(super) const LANES: usize = 4;

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
    pub(super) fn split_at(self, middle: usize) -> (Out<'a>, Out<'a>) {
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

/// Places of results of up to four samples.
pub(super) struct Put {
    pub(super) indices: [usize; LANES],
    pub(super) count: usize,
    /// True if there are four, and their places follow one another.
    pub(super) straight: bool,
}

impl Put {
    /// Of up to four items that results start at `first` for; `straight` if these follow one another.
    #[inline(always)]
    pub(super) fn new(items: &[Item], first: usize, straight: bool) -> Put {
        let count = items.len();
        let mut indices = [0; LANES];
        for l in 0..LANES {
            indices[l] = first + items[l.min(count - 1)].index as usize;
        }
        Put { indices, count, straight: straight && count == LANES }
    }

    #[inline(always)]
    pub(super) fn vectors<V: Four>(&self, out: &mut [Vec3], coordinates: [V; 3]) {
        if self.straight {
            let out = out[self.indices[0]..].first_chunk_mut();
            V::store_vectors(coordinates, out.expect("there is room for every sample"));
        } else {
            let mut four = [Vec3::ZERO; LANES];
            V::store_vectors(coordinates, &mut four);
            for l in 0..self.count {
                out[self.indices[l]] = four[l];
            }
        }
    }

    #[inline(always)]
    pub(super) fn flags(&self, out: &mut [Flags], flags: Flags) {
        for l in 0..self.count {
            out[self.indices[l]] = flags;
        }
    }

    /// The normals of tangents; `flags` are those of the samples, where there is a normal.
    #[inline(always)]
    pub(super) fn normals<V: Four>(&self, du: &[V; 3], dv: &[V; 3], flags: Flags, out: &mut Out<'_>) {
        let (normals, sure) = normals(du, dv);
        self.vectors(out.normal, normals);
        if sure != SURE {
            self.doubtful(sure, [stored(du), stored(dv)], flags, out);
        }
    }

    /// Normals whose squares are too large or small for numbers, or that do not exist.
    #[cold]
    #[inline(never)]
    fn doubtful(&self, sure: u32, tangents: [[Wide; 3]; 2], flags: Flags, out: &mut Out<'_>) {
        for l in (0..self.count).filter(|&l| sure >> l & 1 == 0) {
            let index = self.indices[l];
            let [du, dv] = tangents.map(|[x, y, z]| Vec3::new(x[l], y[l], z[l]));
            let normal = unit_normal(du, dv);
            out.normal[index] = normal.unwrap_or(Vec3::ZERO);
            if normal.is_none() {
                out.flags[index] = flags.with(Flags::NORMAL_UNDEFINED);
            }
        }
    }
}

#[inline(always)]
fn stored<V: Four>(part: &[V; 3]) -> [Wide; 3] {
    [part[0].store(), part[1].store(), part[2].store()]
}
