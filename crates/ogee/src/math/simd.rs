//! What the processor can do beyond plain code: wide lanes, chosen at run time, and reading ahead.
//!
//! A released program is compiled for the oldest processor of its kind. Inner loops are written over [`Four`] numbers side by
//! side and compiled twice, for plain code and for wide registers; the processor is asked once which of the two to call.
//! Both do the same operations in the same order, products and sums apart, so results are the same bit for bit.
//!
//! All `unsafe` code of the crate is here.

/// Four numbers side by side.
pub(crate) trait Four: Copy {
    /// The same number four times.
    fn splat(x: f64) -> Self;
    /// From memory.
    fn load(from: &[f64; 4]) -> Self;
    /// To memory.
    fn store(self) -> [f64; 4];
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
}

#[cfg(target_arch = "x86_64")]
#[expect(unsafe_code, reason = "wide registers")]
mod wide {
    use super::{Four, Kernel};
    use std::arch::x86_64::{
        __m256d, _mm256_add_pd, _mm256_div_pd, _mm256_loadu_pd, _mm256_mul_pd, _mm256_set1_pd,
        _mm256_sqrt_pd, _mm256_storeu_pd, _mm256_sub_pd,
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
            results.iter().map(|value| value.store().map(f64::to_bits)).collect()
        }
    }

    #[test]
    fn wide_lanes_are_plain_code() {
        let (a, b) = ([1.7, 1e-310, 3e200, 0.1], [-0.3, 7.0, 1e155, 1e-17]);
        assert_eq!(dispatch(All(a, b)), All(a, b).run::<Plain>());
    }
}
