//! How well weights fulfil the conditions that they are made for.

use super::fan::{Fan, SECTOR};
use super::{COEFFICIENTS, CapClass, INNER, Weights};
use crate::math::Grid;

/// How far weights are from the conditions on edges, for values, first and second order: at the worst place the sum over all columns of what
/// is left of an equation, unscaled, so that it bounds what points at most 1 from the origin can make of it.
///
/// Weights that hold have about 1e-15, 1e-13 and 1e-12 (`docs/methods/g2_caps.md`, Practice).
pub fn residuals(weights: &Weights) -> [f64; 3] {
    let class = weights.class;
    let fan = Fan::whole(class);
    let rows = coefficients(weights, &fan);
    // Around an interior vertex all edges are alike.
    let equations = if class.is_closed() { fan.edge_equations(0) } else { fan.equations() };
    let mut worst = [0.0_f64; 3];
    for equation in equations {
        let mut left = vec![0.0; fan.columns()];
        for (row, weight) in equation.terms {
            left.iter_mut().zip(rows.row(row)).for_each(|(sum, share)| *sum += weight * share);
        }
        let sum = left.iter().map(|share: &f64| share.abs()).sum();
        worst[equation.order] = worst[equation.order].max(sum);
    }
    worst
}

/// All coefficients of all sectors that edges 0 of interior vertices or all edges of others touch, in the columns of the fan.
fn coefficients(weights: &Weights, fan: &Fan<f64>) -> Grid<f64> {
    let class = weights.class;
    let mut rows = Grid::from_fn(fan.coefficients(), fan.columns(), |_, _| 0.0);
    for row in 0..fan.coefficients() {
        let (sector, i, j) = (row / SECTOR, row % SECTOR / COEFFICIENTS, row % COEFFICIENTS);
        if let Some(terms) = fan.given(sector, i, j) {
            terms.into_iter().for_each(|(column, weight)| rows[(row, column)] += weight);
        } else {
            let stored = if class.is_closed() { 0 } else { sector };
            for (column, &weight) in weights.sectors[stored].row(INNER * i + j).iter().enumerate() {
                rows[(row, fan_column(class, sector, column))] = weight;
            }
        }
    }
    rows
}

/// The column of the fan that a column of a sector's weights is.
fn fan_column(class: CapClass, sector: usize, column: usize) -> usize {
    let (CapClass::Interior { .. }, Some(place)) = (class, column.checked_sub(1)) else { return column };
    let n = class.sectors();
    let sector = (sector + place / 6) % n;
    match place % 6 {
        0 => 1 + 2 * sector,
        2 => 2 + 2 * sector,
        inside => {
            1 + 2 * n + 4 * sector + [1, 3, 4, 5].iter().position(|&number| number == inside).unwrap_or(0)
        }
    }
}
