//! `StencilTable`: masks written against stored points, and the one loop that applies them.

use super::Row;
use crate::math::{Interpolate, par};

/// A table of affine combinations: row `i` says which sources, with which weights, make output `i`.
///
/// Weights of a row sum to one, those of a derivative to zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StencilTable {
    starts: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<f64>,
}

/// How far from one the weights of a row may sum; they are sums of a few dozen products.
const UNITY_TOLERANCE: f64 = 1e-12;

impl StencilTable {
    /// A table of `count` rows; `write` fills row `i`, face points expanded.
    ///
    /// # Panics
    /// If there would be `2^32` weights or more.
    pub fn from_rows(count: usize, write: impl Fn(usize, &mut Row) + Sync + Send) -> StencilTable {
        // Rows are made in chunks, each by one thread, and joined in order.
        const CHUNK: usize = 4096;
        let chunks = par::map(count.div_ceil(CHUNK), |chunk| {
            let mut part = StencilTable::default();
            let mut row = Row::new();
            for i in chunk * CHUNK..((chunk + 1) * CHUNK).min(count) {
                row.clear();
                write(i, &mut row);
                part.push(&row);
            }
            part
        });
        let total: usize = chunks.iter().map(|part| part.sources.len()).sum();
        u32::try_from(total).expect("fewer than 2^32 weights in a table");
        // Zeros that no one has touched yet cost nothing.
        let mut table =
            StencilTable { starts: vec![0; count + 1], sources: vec![0; total], weights: vec![0.0; total] };
        let (mut starts, mut sources, mut weights) =
            (&mut table.starts[1..], &mut table.sources[..], &mut table.weights[..]);
        let mut offset = 0;
        let mut copies = Vec::with_capacity(chunks.len());
        for part in chunks {
            let (rows, entries) = (part.starts.len(), part.sources.len());
            let (own_starts, own_sources, own_weights);
            (own_starts, starts) = starts.split_at_mut(rows);
            (own_sources, sources) = sources.split_at_mut(entries);
            (own_weights, weights) = weights.split_at_mut(entries);
            copies.push((part, own_starts, own_sources, own_weights, offset));
            offset += entries as u32;
        }
        par::each(copies, |(part, starts, sources, weights, offset)| {
            for (start, end) in starts.iter_mut().zip(part.starts) {
                *start = end + offset;
            }
            sources.copy_from_slice(&part.sources);
            weights.copy_from_slice(&part.weights);
        });
        table
    }

    /// Appends a row; `starts` holds ends until the chunks are joined.
    fn push(&mut self, row: &Row) {
        debug_assert!(
            (row.weights().iter().map(|&(_, w)| w).sum::<f64>() - 1.0).abs() < UNITY_TOLERANCE,
            "the weights of a mask sum to one: {row:?}"
        );
        for &(source, weight) in row.weights() {
            self.sources.push(source);
            self.weights.push(weight);
        }
        self.starts.push(self.sources.len() as u32);
    }

    /// A table without rows, to be filled by [`StencilTable::append`].
    pub(crate) fn empty() -> StencilTable {
        StencilTable { starts: vec![0], sources: Vec::new(), weights: Vec::new() }
    }

    /// Appends a row of sources and weights.
    pub(crate) fn append(&mut self, row: impl IntoIterator<Item = (u32, f64)>) {
        for (source, weight) in row {
            self.sources.push(source);
            self.weights.push(weight);
        }
        self.starts.push(u32::try_from(self.sources.len()).expect("fewer than 2^32 weights in a table"));
    }

    /// Appends the rows of another table.
    pub(crate) fn extend(&mut self, other: StencilTable) {
        if self.is_empty() {
            *self = other;
            return;
        }
        let offset = self.sources.len();
        u32::try_from(offset + other.sources.len()).expect("fewer than 2^32 weights in a table");
        self.starts.extend(other.starts.iter().skip(1).map(|end| end + offset as u32));
        self.sources.extend_from_slice(&other.sources);
        self.weights.extend_from_slice(&other.weights);
    }

    /// The same rows over only those of `count` sources that they name, and these sources.
    pub(crate) fn over_used(mut self, count: usize) -> (StencilTable, Vec<u32>) {
        // Zeros that no one has touched yet cost nothing.
        let mut places = vec![0; count];
        let mut used = Vec::new();
        for source in &mut self.sources {
            let place = &mut places[*source as usize];
            if *place == 0 {
                used.push(*source);
                *place = used.len() as u32;
            }
            *source = *place - 1;
        }
        (self, used)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// True if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Sources and weights of row `i`.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, i: usize) -> impl ExactSizeIterator<Item = (u32, f64)> + '_ {
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        self.sources[range.clone()].iter().copied().zip(self.weights[range].iter().copied())
    }

    /// One output per row: the weighted sum of its sources, in their order.
    ///
    /// # Panics
    /// If a source is missing.
    pub fn apply<T: Interpolate>(&self, sources: &[T]) -> Vec<T> {
        let mut out = Vec::with_capacity(self.len());
        self.apply_after(sources, &mut out);
        out
    }

    /// The same, written after what is there already.
    pub(crate) fn apply_after<T: Interpolate>(&self, sources: &[T], out: &mut Vec<T>) {
        par::extend(out, self.len(), |i| {
            let mut value = T::zero();
            for (source, weight) in self.row(i) {
                value.add_scaled(weight, &sources[source as usize]);
            }
            value
        });
    }

    /// The table that does what this one and then `next` do.
    ///
    /// # Panics
    /// If `next` names a row that this table does not have.
    pub fn then(&self, next: &StencilTable) -> StencilTable {
        StencilTable::from_rows(next.len(), |i, row| {
            for (middle, outer) in next.row(i) {
                for (source, inner) in self.row(middle as usize) {
                    row.add(crate::mesh::VertexId(source), outer * inner);
                }
            }
            row.expand_face_points(|_, _, _| ());
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::VertexId;

    fn halves(count: usize) -> StencilTable {
        StencilTable::from_rows(count, |i, row| {
            row.add(VertexId(i as u32 + 1), 0.5);
            row.add(VertexId(i as u32), 0.5);
            row.expand_face_points(|_, _, _| ());
        })
    }

    #[test]
    fn composition_is_application_twice() {
        let (first, second) = (halves(9), halves(8));
        let data: Vec<f64> = (0..10).map(|i| f64::from(i * i)).collect();
        let both = first.then(&second);
        assert_eq!(both.apply(&data), second.apply(&first.apply(&data)));
        assert_eq!(both.row(0).collect::<Vec<_>>(), [(0, 0.25), (1, 0.5), (2, 0.25)]);
    }
}
