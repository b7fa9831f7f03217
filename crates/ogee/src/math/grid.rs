//! `Grid<T>`: a rectangular array, indexed `(i, j)` with `i` along `u` and `j` along `v`.

use std::ops::{Index, IndexMut};

/// A rectangular array of points or ids. `grid[(i, j)]`: `i` along `u` (the rows), `j` along `v`; `j` runs
/// fastest in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T> {
    rows: usize,
    cols: usize,
    cells: Vec<T>,
}

impl<T> Grid<T> {
    /// A grid of `rows` x `cols` cells, each made by `f(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut f: impl FnMut(usize, usize) -> T) -> Grid<T> {
        let mut cells = Vec::with_capacity(rows * cols);
        for i in 0..rows {
            for j in 0..cols {
                cells.push(f(i, j));
            }
        }
        Grid { rows, cols, cells }
    }

    /// Number of cells along `u`.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of cells along `v`.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// All cells, `j` fastest.
    pub fn cells(&self) -> &[T] {
        &self.cells
    }

    /// All cells, `j` fastest, to be changed.
    pub fn cells_mut(&mut self) -> &mut [T] {
        &mut self.cells
    }

    /// The row `i`: all `j`.
    ///
    /// # Panics
    /// If there is no row `i`.
    pub fn row(&self, i: usize) -> &[T] {
        &self.cells[i * self.cols..(i + 1) * self.cols]
    }

    /// Applies `f` to every cell.
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Grid<U> {
        Grid { rows: self.rows, cols: self.cols, cells: self.cells.iter().map(f).collect() }
    }
}

impl<T: Clone> Grid<T> {
    /// The grid with `u` and `v` exchanged.
    pub fn transposed(&self) -> Grid<T> {
        Grid::from_fn(self.cols, self.rows, |i, j| self[(j, i)].clone())
    }
}

impl<T> Index<(usize, usize)> for Grid<T> {
    type Output = T;
    #[inline]
    fn index(&self, (i, j): (usize, usize)) -> &T {
        debug_assert!(i < self.rows && j < self.cols);
        &self.cells[i * self.cols + j]
    }
}

impl<T> IndexMut<(usize, usize)> for Grid<T> {
    #[inline]
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut T {
        debug_assert!(i < self.rows && j < self.cols);
        &mut self.cells[i * self.cols + j]
    }
}
