//! Where results go.

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

/// How the places of four results follow one another.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lie {
    Together,
    /// The second after the first, then the third, and the fourth after it.
    InPairs,
    Apart,
}

impl Lie {
    /// Of four places with these numbers.
    pub(super) fn of(&[a, b, c, d]: &[u32; LANES]) -> Lie {
        let in_pairs = b == a + 1 && c > b && d == c + 1;
        match in_pairs {
            true if c == b + 1 => Lie::Together,
            true => Lie::InPairs,
            false => Lie::Apart,
        }
    }
}

/// Places of results of up to four samples.
pub(super) struct Put {
    pub(super) indices: [usize; LANES],
    pub(super) count: usize,
    /// [`Lie::Apart`] if there are fewer than four.
    pub(super) lie: Lie,
}

impl Put {
    #[inline(always)]
    pub(super) fn vectors<V: Four>(&self, out: &mut [Vec3], coordinates: [V; 3]) {
        let [a, _, c, _] = self.indices;
        match self.lie {
            Lie::Together => {
                let out = out[a..].first_chunk_mut();
                V::store_vectors(coordinates, out.expect("there is room for every sample"));
            }
            Lie::InPairs => {
                let (first, second) = out[a..c + 2].split_at_mut(c - a);
                let (first, second) = (first.first_chunk_mut(), second.first_chunk_mut());
                let pairs = first.zip(second);
                let (first, second) = pairs.expect("there is room for every sample");
                V::store_pairs(coordinates, first, second);
            }
            Lie::Apart => {
                let mut four = [Vec3::ZERO; LANES];
                V::store_vectors(coordinates, &mut four);
                for l in 0..self.count {
                    out[self.indices[l]] = four[l];
                }
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
