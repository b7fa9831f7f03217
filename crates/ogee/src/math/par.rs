//! The only door to threads.
//!
//! Every output is computed by one call and written once, so results do not depend on the schedule or on the
//! number of threads.

use super::pages;

/// Outputs computed by one thread in one go: large enough that handing out work costs nothing.
#[cfg(feature = "rayon")]
const CHUNK: usize = 1024;

/// `f(0), f(1), .. f(count - 1)` on all cores; memory is written once, not cleared before.
pub(crate) fn collect<T: Send>(count: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    let mut out = pages::vector(count);
    extend(&mut out, count, f);
    out
}

/// Appends `f(0), f(1), .. f(count - 1)`.
pub(crate) fn extend<T: Send>(out: &mut Vec<T>, count: usize, f: impl Fn(usize) -> T + Sync + Send) {
    pages::reserve(out, count);
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        if count > CHUNK {
            out.par_extend((0..count).into_par_iter().with_min_len(CHUNK).map(f));
            return;
        }
    }
    out.extend((0..count).map(f));
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

/// `f` of each of a few large tasks, on all cores; a task brings what it writes to.
pub(crate) fn each<T: Send>(tasks: Vec<T>, f: impl Fn(T) + Sync + Send) {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        tasks.into_par_iter().for_each(f);
    }
    #[cfg(not(feature = "rayon"))]
    tasks.into_iter().for_each(f);
}

/// `f(0), f(1), .. f(count - 1)`, each worth a task of its own, on all cores; tasks that a thread does one after the other
/// share memory.
pub(crate) fn each_with<M>(
    count: usize,
    memory: impl Fn() -> M + Sync + Send,
    f: impl Fn(&mut M, usize) + Sync + Send,
) {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().for_each_init(memory, f);
    }
    #[cfg(not(feature = "rayon"))]
    {
        let mut memory = memory();
        (0..count).for_each(|i| f(&mut memory, i));
    }
}

/// `f`, with some `count` outputs and several calls of the above one after the other: a thread that already takes part makes
/// them without being put to sleep and woken for each.
pub(crate) fn stay<T: Send>(count: usize, f: impl FnOnce() -> T + Send) -> T {
    #[cfg(feature = "rayon")]
    if count > CHUNK {
        return rayon::scope(|_| f());
    }
    #[cfg(not(feature = "rayon"))]
    let _ = count;
    f()
}

/// Both, at the same time if there is a thread to spare.
pub(crate) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    #[cfg(feature = "rayon")]
    rayon::join(a, b);
    #[cfg(not(feature = "rayon"))]
    {
        a();
        b();
    }
}

/// Writes `f(0), f(1), ..` over what is there, on all cores.
pub(crate) fn fill<T: Send>(out: &mut [T], f: impl Fn(usize) -> T + Sync + Send) {
    #[cfg(feature = "rayon")]
    if out.len() > CHUNK {
        use rayon::prelude::*;
        out.par_iter_mut().with_min_len(CHUNK).enumerate().for_each(|(i, value)| *value = f(i));
        return;
    }
    out.iter_mut().enumerate().for_each(|(i, value)| *value = f(i));
}

/// `f(0, chunk 0), f(1, chunk 1), ..` of the chunks of `size` values on all cores; calls that a thread makes one after the other
/// share memory.
pub(crate) fn chunks<T: Send, M>(
    values: &mut [T],
    size: usize,
    memory: impl Fn() -> M + Sync + Send,
    f: impl Fn(&mut M, usize, &mut [T]) + Sync + Send,
) {
    #[cfg(feature = "rayon")]
    if values.len() > CHUNK {
        use rayon::prelude::*;
        let calls = values.par_chunks_exact_mut(size).enumerate().with_min_len(CHUNK.div_ceil(size));
        calls.for_each_init(memory, |memory, (i, chunk)| f(memory, i, chunk));
        return;
    }
    let mut memory = memory();
    values.chunks_exact_mut(size).enumerate().for_each(|(i, chunk)| f(&mut memory, i, chunk));
}
