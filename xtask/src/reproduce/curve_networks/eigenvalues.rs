//! Eigenvalues of a step around a meeting point against `t`: in closed form, and found from the matrix itself.

use ogee::curve_network::{XMatrix, default_parameter};

use crate::bench::report::Table;
use crate::reproduce::plot::{Anchor, COLOURS, Panel, Svg};

/// The numbers of ports that are shown.
const PORTS: [usize; 7] = [2, 3, 4, 5, 6, 7, 8];

/// The eigenvalues of a matrix with real ones, by orthogonal iteration with shifts; the largest first.
pub(super) fn found(matrix: &XMatrix) -> Vec<f64> {
    /// Steps for an eigenvalue; two or three are the rule.
    const MOST: usize = 400;
    let weights = matrix.weights();
    let mut rows: Vec<Vec<f64>> = (0..weights.rows()).map(|i| weights.row(i).to_vec()).collect();
    let mut values = Vec::new();
    while let Some(last) = rows.len().checked_sub(1) {
        for _ in 0..MOST {
            if rows[last][..last].iter().all(|x| x.abs() < 1e-15) {
                break;
            }
            step(&mut rows);
        }
        values.push(rows[last][last]);
        rows.pop();
        rows.iter_mut().for_each(|row| row.truncate(last));
    }
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// `A - s = Q R` becomes `R Q + s`, with `s` the eigenvalue of the last four numbers that is nearer to the last.
fn step(rows: &mut [Vec<f64>]) {
    let n = rows.len();
    let (a, b, c, d) = (rows[n - 2][n - 2], rows[n - 2][n - 1], rows[n - 1][n - 2], rows[n - 1][n - 1]);
    let (half, root) = (0.5 * (a - d), 0.25 * (a - d) * (a - d) + b * c);
    let shift = if root >= 0.0 { d + half - half.signum() * root.sqrt() } else { d };
    let column = |rows: &[Vec<f64>], j: usize| -> Vec<f64> { rows.iter().map(|row| row[j]).collect() };
    let mut orthogonal: Vec<Vec<f64>> = Vec::with_capacity(n);
    let mut upper = vec![vec![0.0; n]; n];
    for j in 0..n {
        let mut left = column(rows, j);
        left[j] -= shift;
        // Twice: once is not orthogonal enough where a column all but vanishes.
        for _ in 0..2 {
            for (i, unit) in orthogonal.iter().enumerate() {
                let along: f64 = unit.iter().zip(&left).map(|(u, x)| u * x).sum();
                upper[i][j] += along;
                left.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
            }
        }
        let length = left.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 1e-14 {
            upper[j][j] = length;
            left.iter_mut().for_each(|x| *x /= length);
        } else {
            left = beside(&orthogonal, n);
        }
        orthogonal.push(left);
    }
    for i in 0..n {
        for j in 0..n {
            rows[i][j] = (i..n).map(|k| upper[i][k] * orthogonal[j][k]).sum();
        }
        rows[i][i] += shift;
    }
}

/// A unit vector at right angles to all of these.
fn beside(units: &[Vec<f64>], n: usize) -> Vec<f64> {
    let rest = |axis: usize| {
        let mut left: Vec<f64> = (0..n).map(|k| f64::from(u8::from(k == axis))).collect();
        for _ in 0..2 {
            for unit in units {
                let along: f64 = unit.iter().zip(&left).map(|(u, x)| u * x).sum();
                left.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
            }
        }
        let length = left.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length, left)
    };
    let (length, left) = (0..n).map(rest).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
    left.into_iter().map(|x| x / length).collect()
}

/// Eigenvalues against `t`, a panel for each number of ports; and how far the two ways are apart at most.
pub(super) fn plot() -> (String, f64) {
    let (wide, high) = (200.0, 180.0);
    let mut svg = Svg::new([4.0 * (wide + 48.0) + 24.0, 2.0 * (high + 66.0) + 10.0]);
    let mut apart = 0.0_f64;
    for (number, ports) in PORTS.into_iter().enumerate() {
        let (column, row) = ((number % 4) as f64, (number / 4) as f64);
        let panel = Panel {
            corner: [46.0 + column * (wide + 48.0), 30.0 + row * (high + 66.0)],
            size: [wide, high],
            least: [0.0, 0.0],
            most: [0.5, 0.55],
        };
        panel.axes(&mut svg, &[0.0, 0.25, 0.5], &[0.0, 0.125, 0.25, 0.5]);
        let [left, above] = panel.corner;
        svg.text([left + wide / 2.0, above - 8.0], Anchor::Middle, 14.0, &format!("M = {ports}"));
        let star = default_parameter(ports);
        if ports > 2 {
            svg.line(&panel.places(&[[star, 0.0], [star, 0.55]]), "#a1a1aa", 1.4);
            let [x, y] = panel.place([star, 0.55]);
            svg.text([x + 3.0, y + 14.0], Anchor::Start, 12.0, "t*");
        }
        let at = |t: f64| XMatrix::new(ports, t).eigenvalues();
        let samples: Vec<(f64, Vec<f64>)> =
            (0..=60).map(|i| 0.5 * (f64::from(i) / 60.0).powi(2)).map(|t| (t, at(t))).collect();
        for k in 1..=4 * ports {
            // Several curves are one where eigenvalues are multiple.
            if k > 1 && samples.iter().all(|(_, values)| values[k - 1] - values[k] < 1e-9) {
                continue;
            }
            let points: Vec<[f64; 2]> = samples.iter().map(|(t, values)| [*t, values[k]]).collect();
            svg.line(&panel.places(&points), COLOURS[0], 1.4);
        }
        for i in 1..=10 {
            let t = 0.05 * f64::from(i);
            let matrix = XMatrix::new(ports, t);
            let mut above = 1.0;
            for (found, closed) in found(&matrix).into_iter().zip(matrix.eigenvalues()).skip(1) {
                apart = apart.max((found - closed).abs());
                if above - found < 1e-9 {
                    continue;
                }
                above = found;
                svg.dot(panel.place([t, found]), 2.3, COLOURS[1]);
            }
        }
    }
    let [left, above] = [46.0 + 3.0 * (wide + 48.0), 30.0 + high + 66.0];
    svg.line(&[[left, above + 30.0], [left + 26.0, above + 30.0]], COLOURS[0], 1.8);
    svg.text([left + 34.0, above + 34.0], Anchor::Start, 13.0, "closed form");
    svg.dot([left + 13.0, above + 54.0], 2.6, COLOURS[1]);
    svg.text([left + 34.0, above + 58.0], Anchor::Start, 13.0, "from the matrix");
    svg.text([left, above + 86.0], Anchor::Start, 13.0, "across: t; up: eigenvalues");
    svg.text([left, above + 106.0], Anchor::Start, 13.0, "1 is left out");
    (svg.finish(), apart)
}

/// The largest free eigenvalue.
pub(super) fn table() -> Table {
    let mut columns = vec!["M".to_owned(), "t*".to_owned()];
    let shown = [0.05, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5];
    columns.extend(shown.iter().map(|t| format!("t = {t}")));
    columns.push("t = t*".to_owned());
    let names: Vec<&str> = columns.iter().map(String::as_str).collect();
    let mut table = Table::new(&names);
    for ports in PORTS {
        let star = default_parameter(ports);
        let largest = |t: f64| format!("{:.4}", XMatrix::new(ports, t).largest_free_eigenvalue());
        let mut row = vec![ports.to_string(), format!("{star:.4}")];
        row.extend(shown.iter().map(|&t| largest(t)));
        row.push(largest(star));
        table.row(&row);
    }
    table
}

/// The largest free eigenvalue against `t`.
pub(super) fn plot_of_largest() -> String {
    let mut svg = Svg::new([560.0, 340.0]);
    let panel = Panel { corner: [56.0, 20.0], size: [400.0, 270.0], least: [0.0, 0.25], most: [0.5, 0.51] };
    panel.axes(&mut svg, &[0.0, 0.1, 0.2, 0.3, 0.4, 0.5], &[0.25, 0.3, 0.35, 0.4, 0.45, 0.5]);
    svg.text([256.0, 328.0], Anchor::Middle, 13.0, "t");
    svg.text([448.0, 278.0], Anchor::End, 13.0, "largest free eigenvalue; dots at t*");
    svg.text([448.0, 258.0], Anchor::End, 13.0, "one curve for M = 2, 4, 6, 8");
    for (k, ports) in PORTS.into_iter().enumerate() {
        let largest = |t: f64| XMatrix::new(ports, t).largest_free_eigenvalue();
        let points: Vec<[f64; 2]> =
            (0..=100).map(|i| 0.5 * (f64::from(i) / 100.0).powi(2)).map(|t| [t, largest(t)]).collect();
        svg.line(&panel.places(&points), COLOURS[k], 1.6);
        let star = default_parameter(ports);
        svg.dot(panel.place([star, largest(star)]), 4.0, COLOURS[k]);
        let y = 40.0 + 24.0 * k as f64;
        svg.line(&[[476.0, y], [500.0, y]], COLOURS[k], 2.2);
        svg.text([508.0, y + 4.0], Anchor::Start, 13.0, &format!("M = {ports}"));
    }
    svg.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_ways_agree() {
        for (ports, t) in [(2, 0.5), (3, 0.3), (5, 0.45), (8, 0.25)] {
            let matrix = XMatrix::new(ports, t);
            for (found, closed) in found(&matrix).into_iter().zip(matrix.eigenvalues()) {
                assert!((found - closed).abs() < 1e-10, "M = {ports}, t = {t}: {found} {closed}");
            }
        }
    }
}
