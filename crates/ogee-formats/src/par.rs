//! The only door to threads: results come in the order of the tasks, however many threads there are.

/// `f` of each of a few large tasks, on all cores.
pub(crate) fn map<T: Send, R: Send>(tasks: Vec<T>, f: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    if tasks.len() <= 1 {
        return tasks.into_iter().map(f).collect();
    }
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        tasks.into_par_iter().map(f).collect()
    }
    #[cfg(not(feature = "rayon"))]
    tasks.into_iter().map(f).collect()
}
