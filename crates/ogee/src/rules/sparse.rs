//! `Sparse<T>`: values at a few indices, in order.

/// Values at a few indices; most elements of a mesh have nothing special about them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sparse<T> {
    entries: Vec<(u32, T)>,
}

impl<T> Default for Sparse<T> {
    fn default() -> Sparse<T> {
        Sparse { entries: Vec::new() }
    }
}

impl<T: Copy> Sparse<T> {
    /// From entries in any order; the last one for an index counts.
    pub(crate) fn new(mut entries: Vec<(u32, T)>) -> Sparse<T> {
        entries.reverse();
        entries.sort_by_key(|&(index, _)| index);
        entries.dedup_by_key(|&mut (index, _)| index);
        Sparse { entries }
    }

    pub(crate) fn get(&self, index: u32) -> Option<T> {
        let at = self.entries.binary_search_by_key(&index, |&(index, _)| index).ok()?;
        Some(self.entries[at].1)
    }

    pub(crate) fn filter(mut self, keep: impl Fn(T) -> bool) -> Sparse<T> {
        self.entries.retain(|&(_, value)| keep(value));
        self
    }

    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = (u32, T)> + '_ {
        self.entries.iter().copied()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }
}
