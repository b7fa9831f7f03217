//! What the processor can do beyond plain code: wide lanes, chosen at run time, and reading ahead.
//!
//! A released program is compiled for the oldest processor of its kind. Inner loops over lanes of four numbers are
//! compiled a second time for wider registers, and the processor is asked which of the two to call. Both do the same
//! operations in the same order, products and sums apart, so results are the same bit for bit.

/// An inner loop. `run` and all that it calls are to be `#[inline(always)]`, or they are compiled for the oldest
/// processor alone.
pub(crate) trait Kernel {
    /// What it gives.
    type Output;
    /// Does it.
    fn run(self) -> Self::Output;
}

/// Runs a kernel as compiled for this processor.
#[inline]
pub(crate) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // Sound: the processor has just been asked.
        #[expect(unsafe_code, reason = "the one call that depends on the processor")]
        return unsafe { run_avx2(kernel) };
    }
    kernel.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}

/// Tells the processor that this will be read soon; nothing where it cannot be told.
#[inline(always)]
pub(crate) fn prefetch<T>(soon: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // Sound: a hint reads nothing, and the address is that of a reference anyway.
        #[expect(unsafe_code, reason = "the other call that depends on the processor")]
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(soon).cast());
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = soon;
}
