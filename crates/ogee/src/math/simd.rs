//! What the processor can do beyond plain code: wide lanes, chosen at run time, and reading ahead.
//!
//! A released program is compiled for the oldest processor of its kind. Inner loops are written over [`Four`] numbers side by
//! side and compiled twice, for plain code and for wide registers; the processor is asked once which of the two to call.
//! Both do the same operations in the same order, products and sums apart, so results are the same bit for bit.
//!
//! All `unsafe` code of the crate is here and in [`super::pages`].

use super::Vec3;

/// Four numbers side by side.
pub(crate) trait Four: Copy {
    /// The same number four times.
    fn splat(x: f64) -> Self;
    /// From memory.
    fn load(from: &[f64; 4]) -> Self;
    /// To memory.
    fn store(self) -> [f64; 4];
    /// Four vectors to memory, from their first, second and third coordinates.
    fn store_vectors(coordinates: [Self; 3], out: &mut [Vec3; 4]);
    /// The same to two places in memory, two vectors each.
    fn store_pairs(coordinates: [Self; 3], first: &mut [Vec3; 2], second: &mut [Vec3; 2]);
    /// The second lane, the first, the fourth, the third.
    fn swapped(self) -> Self;
    /// The third lane, the fourth, the first, the second.
    fn turned(self) -> Self;
    /// Sums.
    fn plus(self, other: Self) -> Self;
    /// Differences.
    fn minus(self, other: Self) -> Self;
    /// Products.
    fn times(self, other: Self) -> Self;
    /// Quotients.
    fn over(self, other: Self) -> Self;
    /// Square roots.
    fn root(self) -> Self;
    /// Where it is greater: the lowest bit is the first lane's.
    fn above(self, other: Self) -> u32;
}

/// An inner loop. `run` and all that it calls are to be `#[inline(always)]`, or they are compiled for the oldest
/// processor alone.
pub(crate) trait Kernel {
    /// What it gives.
    type Output;
    /// Does it.
    fn run<V: Four>(self) -> Self::Output;
}

/// Runs a kernel as compiled for this processor.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(test)]
    if PLAIN.get() {
        return kernel.run::<Plain>();
    }
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // Sound: the processor has just been asked.
        #[expect(unsafe_code, reason = "wide registers")]
        return unsafe { wide::run(kernel) };
    }
    kernel.run::<Plain>()
}

#[cfg(test)]
thread_local! {
    /// Set by tests that want plain code on any processor.
    pub(crate) static PLAIN: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

/// Four numbers of plain code.
#[derive(Clone, Copy)]
pub(crate) struct Plain([f64; 4]);

impl Plain {
    #[inline(always)]
    fn with(self, other: Plain, f: impl Fn(f64, f64) -> f64) -> Plain {
        let ([a, b, c, d], [e, g, h, i]) = (self.0, other.0);
        Plain([f(a, e), f(b, g), f(c, h), f(d, i)])
    }
}

impl Four for Plain {
    #[inline(always)]
    fn splat(x: f64) -> Plain {
        Plain([x; 4])
    }
    #[inline(always)]
    fn load(from: &[f64; 4]) -> Plain {
        Plain(*from)
    }
    #[inline(always)]
    fn store(self) -> [f64; 4] {
        self.0
    }
    #[inline(always)]
    fn store_vectors([x, y, z]: [Plain; 3], out: &mut [Vec3; 4]) {
        for l in 0..4 {
            out[l] = Vec3::new(x.0[l], y.0[l], z.0[l]);
        }
    }
    #[inline(always)]
    fn store_pairs([x, y, z]: [Plain; 3], first: &mut [Vec3; 2], second: &mut [Vec3; 2]) {
        for l in 0..2 {
            first[l] = Vec3::new(x.0[l], y.0[l], z.0[l]);
            second[l] = Vec3::new(x.0[2 + l], y.0[2 + l], z.0[2 + l]);
        }
    }
    #[inline(always)]
    fn swapped(self) -> Plain {
        let [a, b, c, d] = self.0;
        Plain([b, a, d, c])
    }
    #[inline(always)]
    fn turned(self) -> Plain {
        let [a, b, c, d] = self.0;
        Plain([c, d, a, b])
    }
    #[inline(always)]
    fn plus(self, other: Plain) -> Plain {
        self.with(other, |a, b| a + b)
    }
    #[inline(always)]
    fn minus(self, other: Plain) -> Plain {
        self.with(other, |a, b| a - b)
    }
    #[inline(always)]
    fn times(self, other: Plain) -> Plain {
        self.with(other, |a, b| a * b)
    }
    #[inline(always)]
    fn over(self, other: Plain) -> Plain {
        self.with(other, |a, b| a / b)
    }
    #[inline(always)]
    fn root(self) -> Plain {
        self.with(self, |a, _| a.sqrt())
    }
    #[inline(always)]
    fn above(self, other: Plain) -> u32 {
        (0..4).fold(0, |bits, l| bits | u32::from(self.0[l] > other.0[l]) << l)
    }
}

#[cfg(target_arch = "x86_64")]
#[expect(unsafe_code, reason = "wide registers")]
mod wide {
    use super::{Four, Kernel, Vec3};
    use std::arch::x86_64::{
        __m256d, _CMP_GT_OQ, _mm_storeu_pd, _mm256_add_pd, _mm256_blend_pd, _mm256_castpd256_pd128,
        _mm256_cmp_pd, _mm256_div_pd, _mm256_extractf128_pd, _mm256_loadu_pd, _mm256_movemask_pd,
        _mm256_mul_pd, _mm256_permute_pd, _mm256_permute2f128_pd, _mm256_set1_pd, _mm256_shuffle_pd,
        _mm256_sqrt_pd, _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd,
    };

    /// A kernel compiled for wide registers.
    #[target_feature(enable = "avx2")]
    pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
        kernel.run::<Register>()
    }

    /// Four numbers in a register. Only [`run`] makes kernels use it, on processors that have one; that makes every block
    /// below sound. Loads and stores are of arrays of just that size, of any alignment.
    #[derive(Clone, Copy)]
    pub(super) struct Register(__m256d);

    impl Register {
        /// Four vectors one after the other, from their first, second and third coordinates.
        #[inline(always)]
        fn in_rows([x, y, z]: [Register; 3]) -> [__m256d; 3] {
            unsafe {
                // x0 y0 x2 y2, y1 z1 y3 z3, z0 x1 z2 x3.
                let xy = _mm256_unpacklo_pd(x.0, y.0);
                let yz = _mm256_unpackhi_pd(y.0, z.0);
                let zx = _mm256_shuffle_pd::<0b1010>(z.0, x.0);
                [
                    _mm256_permute2f128_pd::<0x20>(xy, zx),
                    _mm256_blend_pd::<0b1100>(yz, xy),
                    _mm256_permute2f128_pd::<0x31>(zx, yz),
                ]
            }
        }
    }

    impl Four for Register {
        #[inline(always)]
        fn splat(x: f64) -> Register {
            Register(unsafe { _mm256_set1_pd(x) })
        }
        #[inline(always)]
        fn load(from: &[f64; 4]) -> Register {
            Register(unsafe { _mm256_loadu_pd(from.as_ptr()) })
        }
        #[inline(always)]
        fn store(self) -> [f64; 4] {
            let mut out = [0.0; 4];
            unsafe { _mm256_storeu_pd(out.as_mut_ptr(), self.0) };
            out
        }
        #[inline(always)]
        fn store_vectors(coordinates: [Register; 3], out: &mut [Vec3; 4]) {
            // A vector is three numbers in a row, so four of them are twelve.
            let out = out.as_mut_ptr().cast::<f64>();
            let [first, middle, last] = Register::in_rows(coordinates);
            unsafe {
                _mm256_storeu_pd(out, first);
                _mm256_storeu_pd(out.add(4), middle);
                _mm256_storeu_pd(out.add(8), last);
            }
        }
        #[inline(always)]
        fn store_pairs(coordinates: [Register; 3], first: &mut [Vec3; 2], second: &mut [Vec3; 2]) {
            // Two vectors are six numbers.
            let (one, two) = (first.as_mut_ptr().cast::<f64>(), second.as_mut_ptr().cast::<f64>());
            let [first, middle, last] = Register::in_rows(coordinates);
            unsafe {
                _mm256_storeu_pd(one, first);
                _mm_storeu_pd(one.add(4), _mm256_castpd256_pd128(middle));
                _mm_storeu_pd(two, _mm256_extractf128_pd::<1>(middle));
                _mm256_storeu_pd(two.add(2), last);
            }
        }
        #[inline(always)]
        fn swapped(self) -> Register {
            Register(unsafe { _mm256_permute_pd::<0b0101>(self.0) })
        }
        #[inline(always)]
        fn turned(self) -> Register {
            Register(unsafe { _mm256_permute2f128_pd::<0x01>(self.0, self.0) })
        }
        #[inline(always)]
        fn plus(self, other: Register) -> Register {
            Register(unsafe { _mm256_add_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn minus(self, other: Register) -> Register {
            Register(unsafe { _mm256_sub_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn times(self, other: Register) -> Register {
            Register(unsafe { _mm256_mul_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn over(self, other: Register) -> Register {
            Register(unsafe { _mm256_div_pd(self.0, other.0) })
        }
        #[inline(always)]
        fn root(self) -> Register {
            Register(unsafe { _mm256_sqrt_pd(self.0) })
        }
        #[inline(always)]
        fn above(self, other: Register) -> u32 {
            unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_GT_OQ>(self.0, other.0)) as u32 }
        }
    }
}

/// Tells the processor that this will be read soon; nothing where it cannot be told.
#[inline(always)]
pub(crate) fn prefetch<T>(soon: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // Sound: a hint reads nothing, and the address is that of a reference anyway.
        #[expect(unsafe_code, reason = "a hint takes an address")]
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(soon).cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = soon;
}

#[cfg(test)]
mod tests {
    use super::*;

    struct All([f64; 4], [f64; 4]);

    impl Kernel for All {
        type Output = Vec<[u64; 4]>;

        #[inline(always)]
        fn run<V: Four>(self) -> Vec<[u64; 4]> {
            let (a, b) = (V::load(&self.0), V::load(&self.1));
            let results = [a.plus(b), a.minus(b), a.times(b), a.over(b), a.root(), V::splat(self.1[2])];
            let turned = [a.swapped(), a.turned()];
            let mut vectors = [Vec3::ZERO; 4];
            V::store_vectors([a, b, a.plus(b)], &mut vectors);
            let (mut first, mut second) = ([Vec3::ZERO; 2], [Vec3::ZERO; 2]);
            V::store_pairs([a, b, a.plus(b)], &mut first, &mut second);
            assert_eq!([first, second].as_flattened(), vectors);
            let vectors = vectors.map(|v| [v.x, v.y, v.z, f64::from(a.above(b))]);
            let numbers = results.into_iter().chain(turned).map(V::store).chain(vectors);
            numbers.map(|value| value.map(f64::to_bits)).collect()
        }
    }

    #[test]
    fn wide_lanes_are_plain_code() {
        let (a, b) = ([1.7, 1e-310, 3e200, 0.1], [-0.3, 7.0, 1e155, 1e-17]);
        assert_eq!(dispatch(All(a, b)), All(a, b).run::<Plain>());
    }
}
