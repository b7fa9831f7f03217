//! Rows that follow from those before them.

use super::energy::{Rows, gram, transposed};

/// Square of the distance of a row of length one from what those before it span, below which it follows from them.
const DEPENDENT: f64 = 1e-12;

/// For each row whether it is a combination of rows before it. Rows have length one; `columns` is how many unknowns they are
/// over.
///
/// By the pivots of the matrix of their products, factored row after row (`L D L'`): a pivot is the square of the distance
/// of its row from those before it. A row that depends on others leaves the matrix.
pub(super) fn dependent(rows: &Rows, columns: usize) -> Vec<bool> {
    let products = gram(&transposed(rows, columns), rows.len());
    let count = rows.len();
    let mut pivots = vec![0.0; count];
    let mut out = vec![false; count];
    // Column j of L as rows below it with their entries, in order; parents are those of the elimination tree.
    let mut lower: Vec<Vec<(usize, f64)>> = vec![Vec::new(); count];
    let mut parents = vec![usize::MAX; count];
    let mut marks = vec![usize::MAX; count];
    let mut work = vec![0.0; count];
    for k in 0..count {
        marks[k] = k;
        let mut pattern = Vec::new();
        let mut pivot = 0.0;
        for &(i, value) in &products[k] {
            let i = i as usize;
            if i == k {
                pivot = value;
            }
            if i >= k || out[i] {
                continue;
            }
            work[i] += value;
            let mut at = i;
            while marks[at] != k {
                marks[at] = k;
                pattern.push(at);
                if parents[at] == usize::MAX {
                    parents[at] = k;
                }
                at = parents[at];
            }
        }
        pattern.sort_unstable();
        let mut entries = Vec::new();
        for j in pattern {
            let value = std::mem::take(&mut work[j]);
            if out[j] {
                continue;
            }
            for &(i, factor) in &lower[j] {
                work[i] -= factor * value;
            }
            let factor = value / pivots[j];
            pivot -= factor * value;
            entries.push((j, factor));
        }
        pivots[k] = pivot;
        out[k] = pivot < DEPENDENT;
        if !out[k] {
            for (j, factor) in entries {
                lower[j].push((k, factor));
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(row: &[f64]) -> Vec<(u32, f64)> {
        let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        (0..).zip(row).filter(|(_, x)| **x != 0.0).map(|(i, x)| (i, x / length)).collect()
    }

    #[test]
    fn rows_that_follow_from_others_are_named() {
        let rows = vec![
            unit(&[1.0, 2.0, 0.0, 0.0, 0.0]),
            unit(&[0.0, 1.0, -1.0, 0.0, 0.0]),
            unit(&[2.0, 4.0, 0.0, 0.0, 0.0]),
            unit(&[0.0, 0.0, 0.0, 1.0, 3.0]),
            unit(&[1.0, 3.0, -1.0, 0.0, 0.0]),
            unit(&[0.0, 0.0, 1.0, 1.0, 0.0]),
            unit(&[0.0, 1.0, 0.0, 1.0, 1e-9]),
            unit(&[0.0, 1.0, 0.0, 1.0, 0.0]),
        ];
        assert_eq!(dependent(&rows, 5), [false, false, true, false, true, false, true, true]);
        let independent: Rows = (0..6).map(|i| vec![(i, 0.6), (i + 1, 0.8)]).collect();
        assert!(dependent(&independent, 7).iter().all(|dependent| !dependent));
        assert_eq!(dependent(&vec![Vec::new()], 3), [true]);
    }
}
