//! `System`: what a fan asks for, as matrices of real numbers.

use faer::{Mat, c64};

use super::COEFFICIENTS;
use super::fan::{Fan, SECTOR, Scalar};

/// What the equations of value, first and second order are multiplied by: without it the null space is ten times worse
/// conditioned.
const SCALES: [f64; 3] = [1.0, 0.1, 0.01];

/// What is to be solved. Coefficient `(i, j)` of a sector has the number `169 sector + 13 i + j`.
pub(super) struct System {
    /// The coefficients that are given, a row each in terms of the columns; the rows of the others are zero.
    pub(super) given: Mat<f64>,
    /// The coefficients that are looked for.
    pub(super) free: Vec<usize>,
    /// What has to vanish: a combination of all coefficients a row.
    pub(super) conditions: Mat<f64>,
}

impl Fan<f64> {
    pub(super) fn system(&self) -> System {
        let (given, free) = data(self);
        System { given, free, conditions: conditions(self) }
    }
}

impl Fan<c64> {
    /// As two sectors, the second one the imaginary part of the first: columns are real.
    pub(super) fn system(&self) -> System {
        let (given, free) = data(self);
        let conditions = conditions(self);
        let (rows, count) = conditions.shape();
        let part = |value: c64, imaginary: bool| if imaginary { value.im } else { value.re };
        System {
            given: Mat::from_fn(2 * count, self.columns(), |i, j| part(given[(i % count, j)], i >= count)),
            free: free.iter().copied().chain(free.iter().map(|row| count + row)).collect(),
            conditions: Mat::from_fn(2 * rows, 2 * count, |i, j| {
                let value = conditions[(i % rows, j % count)];
                // What a factor does to an imaginary part is what `i` times it does to a real one.
                let value = if j < count { value } else { c64::new(-value.im, value.re) };
                part(value, i >= rows)
            }),
        }
    }
}

fn data<T: Scalar>(fan: &Fan<T>) -> (Mat<T>, Vec<usize>) {
    let mut given = Mat::zeros(fan.coefficients(), fan.columns());
    let mut free = Vec::new();
    for row in 0..fan.coefficients() {
        let (sector, i, j) = (row / SECTOR, row % SECTOR / COEFFICIENTS, row % COEFFICIENTS);
        match fan.given(sector, i, j) {
            Some(terms) => terms.into_iter().for_each(|(column, weight)| given[(row, column)] += weight),
            None => free.push(row),
        }
    }
    (given, free)
}

fn conditions<T: Scalar>(fan: &Fan<T>) -> Mat<T> {
    let equations = fan.equations();
    let mut rows = Mat::zeros(equations.len(), fan.coefficients());
    for (i, equation) in equations.into_iter().enumerate() {
        for (coefficient, weight) in equation.terms {
            rows[(i, coefficient)] += weight.times(SCALES[equation.order]);
        }
    }
    rows
}
