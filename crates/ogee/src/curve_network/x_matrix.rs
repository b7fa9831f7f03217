//! `XMatrix`: one refinement of an X-configuration, as a matrix, and its eigenvalues.
//!
//! Abbas and Nasri 2004, with the centre fixed: their first row, the plain rule for a vertex, keeps the curves exact only
//! where it happens to keep the centre.

use super::XRing;
use crate::math::{Grid, Vec3};
use std::f64::consts::PI;

/// What a refinement makes of an X-configuration.
///
/// Rows and columns are in the order centre `A`; ring `E_0, D_0, E_1, D_1, ..`; corners `P_0, R_1, P_1, R_2, .., R_0`, as in
/// [`XRing`]: `1 + 4 M` of them.
#[derive(Clone, Debug, PartialEq)]
pub struct XMatrix {
    parameter: f64,
    weights: Grid<f64>,
}

impl XMatrix {
    /// The matrix of `ports` ports and parameter `t`.
    pub fn new(ports: usize, t: f64) -> XMatrix {
        let spokes = 2 * ports;
        let size = 1 + 2 * spokes;
        let (spoke, corner) = (|i: usize| 1 + i % spokes, |i: usize| 1 + spokes + i % spokes);
        let mut weights = Grid::from_fn(size, size, |_, _| 0.0);
        weights[(0, 0)] = 1.0;
        for i in 0..spokes {
            // The modified face point of the slice between spokes i and i + 1: its port, its free spoke, and the free
            // spoke on the other side of the port.
            let [port, free, other] = if i % 2 == 0 { [i, i + 1, i + spokes - 1] } else { [i + 1, i, i + 2] };
            let terms =
                [(0, 2.0), (spoke(port), 1.0), (corner(i), 1.0), (spoke(free), t), (spoke(other), -t)];
            for (column, weight) in terms {
                weights[(corner(i), column)] += weight / 4.0;
            }
        }
        for i in 0..spokes {
            for column in 0..size {
                let faces = weights[(corner(i), column)] + weights[(corner(i + spokes - 1), column)];
                let ends = f64::from(u8::from(column == 0)) + f64::from(u8::from(column == spoke(i)));
                weights[(spoke(i), column)] = (ends + faces) / 4.0;
            }
        }
        XMatrix { parameter: t, weights }
    }

    /// Number of ports `M`.
    pub fn ports(&self) -> usize {
        (self.weights.rows() - 1) / 4
    }

    /// The weights: row `i` makes point `i` of the refined configuration.
    pub fn weights(&self) -> &Grid<f64> {
        &self.weights
    }

    /// The refined ring, relative to the centre, which stays.
    ///
    /// # Panics
    /// If the ring has another number of ports.
    pub fn refine(&self, ring: &XRing) -> XRing {
        assert_eq!(ring.ports(), self.ports(), "ring and matrix have the same number of ports");
        let point = |i: usize| {
            let terms = self.weights.row(i)[1..].iter().zip(ring.ring.iter().chain(&ring.corners));
            terms.fold(Vec3::ZERO, |sum, (&weight, &p)| sum + weight * p)
        };
        let spokes = ring.ring.len();
        XRing {
            ring: (1..=spokes).map(point).collect(),
            corners: (spokes + 1..=2 * spokes).map(point).collect(),
        }
    }

    /// All `1 + 4 M` eigenvalues in closed form, the largest first: 1 once; 1/2 and 1/8 from the curves, once for each;
    /// and of each mode of the free spokes a pair.
    pub fn eigenvalues(&self) -> Vec<f64> {
        let ports = self.ports();
        let mut values = vec![1.0];
        values.extend(std::iter::repeat_n(0.5, ports));
        values.extend(std::iter::repeat_n(0.125, ports));
        values.extend((0..ports).flat_map(|w| self.free_eigenvalues(w)));
        values.sort_by(|a, b| b.total_cmp(a));
        values
    }

    /// The largest eigenvalue of the free spokes. Normals around a meeting point settle by twice of it at every
    /// refinement, or by 1/4 if the ring is [`XRing::eigen`]; where it is 1/2, they do not settle.
    pub fn largest_free_eigenvalue(&self) -> f64 {
        (0..self.ports()).map(|w| self.free_eigenvalues(w)[0]).fold(0.0, f64::max)
    }

    /// The pair of mode `w`: `1/4 + x +- sqrt(x^2 + x/2)`, `x = t sin^2(pi w / M) / 8`; the larger first.
    fn free_eigenvalues(&self, w: usize) -> [f64; 2] {
        let sine = (PI * w as f64 / self.ports() as f64).sin();
        let x = self.parameter * sine * sine / 8.0;
        let root = (x * x + x / 2.0).sqrt();
        [0.25 + x + root, 0.25 + x - root]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The dimension of the null space of `weights - value`, by elimination with complete pivoting.
    fn nullity(weights: &Grid<f64>, value: f64) -> usize {
        let size = weights.rows();
        let mut rows: Vec<Vec<f64>> = (0..size)
            .map(|i| (0..size).map(|j| weights[(i, j)] - if i == j { value } else { 0.0 }).collect())
            .collect();
        for step in 0..size {
            let places = (step..size).flat_map(|i| (step..size).map(move |j| (i, j)));
            let (i, j) = places.max_by(|a, b| rows[a.0][a.1].abs().total_cmp(&rows[b.0][b.1].abs())).unwrap();
            if rows[i][j].abs() < 1e-11 {
                return size - step;
            }
            rows.swap(step, i);
            rows.iter_mut().for_each(|row| row.swap(step, j));
            let pivot = rows[step].clone();
            for row in &mut rows[step + 1..] {
                let factor = row[step] / pivot[step];
                row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            }
        }
        0
    }

    #[test]
    fn closed_form_eigenvalues_are_all_there_are() {
        for ports in 2..=8 {
            for t in [0.1, 0.25, crate::curve_network::default_parameter(ports), 0.5] {
                let matrix = XMatrix::new(ports, t);
                let mut values = matrix.eigenvalues();
                assert_eq!(values.len(), 1 + 4 * ports);
                values.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
                let found: usize = values.iter().map(|&value| nullity(matrix.weights(), value)).sum();
                assert_eq!(found, 1 + 4 * ports, "{ports} ports, t = {t}");
            }
        }
    }

    #[test]
    fn weights_are_those_of_the_table() {
        // Row masks x 288: the same rules, multiplied out by hand.
        let (ports, t) = (5, 0.3);
        let matrix = XMatrix::new(ports, t);
        let row = |i: usize, terms: &[(usize, f64)]| {
            let mut wanted = vec![0.0; 1 + 4 * ports];
            terms.iter().for_each(|&(column, weight)| wanted[column] += weight / 288.0);
            let row = matrix.weights().row(i);
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-15, "row {i} sums to one");
            assert!(row.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-15), "row {i}: {row:?}");
        };
        let port = |j: usize| 1 + 2 * (j % ports);
        let free = |j: usize| 2 + 2 * (j % ports);
        let after = |j: usize| 1 + 2 * ports + 2 * (j % ports);
        let before = |j: usize| 2 + 2 * ports + 2 * ((j + ports - 1) % ports);
        row(0, &[(0, 288.0)]);
        for j in 0..ports {
            let last = j + ports - 1;
            row(port(j), &[(0, 144.0), (port(j), 108.0), (after(j), 18.0), (before(j), 18.0)]);
            let ends =
                [(0, 144.0), (port(j), 18.0), (port(j + 1), 18.0), (after(j), 18.0), (before(j + 1), 18.0)];
            let spokes = [(free(j), 72.0 + 36.0 * t), (free(last), -18.0 * t), (free(j + 1), -18.0 * t)];
            row(free(j), &[&ends[..], &spokes].concat());
            for (corner, sign) in [(after(j), 1.0), (before(j), -1.0)] {
                let spokes = [(free(j), 72.0 * t * sign), (free(last), -72.0 * t * sign)];
                row(corner, &[&[(0, 144.0), (port(j), 72.0), (corner, 72.0)], &spokes[..]].concat());
            }
        }
    }

    #[test]
    fn the_largest_free_eigenvalue_reaches_one_half_for_even_ports_only() {
        let largest = |ports, t| XMatrix::new(ports, t).largest_free_eigenvalue();
        assert!((largest(3, 0.5) - (19.0 + 105.0_f64.sqrt()) / 64.0).abs() < 1e-15);
        assert!((largest(4, 0.5) - 0.5).abs() < 1e-15);
        assert!((largest(6, 0.0) - 0.25).abs() < 1e-15);
    }
}
