//! The only door to threads.
//!
//! Every output is computed by one call and written once, so results do not depend on the schedule or on the
//! number of threads.

/// Outputs computed by one thread in one go: large enough that handing out work costs nothing.
#[cfg(feature = "rayon")]
const CHUNK: usize = 1024;

/// `out[i] = f(i)` for all `i`, on all cores.
pub(crate) fn fill<T: Send>(out: &mut [T], f: impl Fn(usize) -> T + Sync) {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        if out.len() > CHUNK {
            out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, cells)| {
                for (i, cell) in cells.iter_mut().enumerate() {
                    *cell = f(chunk * CHUNK + i);
                }
            });
            return;
        }
    }
    for (i, cell) in out.iter_mut().enumerate() {
        *cell = f(i);
    }
}

/// `f(0), f(1), .. f(count - 1)`, each worth a task of its own, on all cores.
pub(crate) fn map<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().map(f).collect()
    }
    #[cfg(not(feature = "rayon"))]
    {
        (0..count).map(f).collect()
    }
}
