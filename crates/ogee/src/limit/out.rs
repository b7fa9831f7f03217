//! Where results go.

use super::{Derivatives, Flags, Samples};
use crate::math::Vec3;

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
