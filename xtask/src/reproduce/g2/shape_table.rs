//! Section "Shape": how far curvature ranges by each method, as a share of the cap of level 0.

use anyhow::Result;

use super::shapes::Shape;
use super::surface::{Method, with_surface};
use crate::bench::report::Table;

/// The valences that are compared.
pub(super) const VALENCES: [usize; 5] = [3, 5, 6, 8, 12];

/// What is compared with the cap of level 0.
pub(super) const METHODS: [Method; 3] = [Method::Limit, Method::Pccm, Method::Cap(1)];

/// Ranges of mean and Gauss curvature as shares of those of the cap of level 0, and the worst share of the mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shares {
    /// Geometric means over the shapes.
    pub(super) mean: f64,
    pub(super) gauss: f64,
    /// Over the shapes the greatest share of the range of mean curvature.
    pub(super) worst: f64,
}

/// The first figures, by valence and method: where no one had this library yet.
pub(super) const FIRST: [[Shares; 3]; 5] = [
    [first(1.52, 1.76, 3.2), first(2.50, 2.76, 5.7), first(1.13, 1.34, 1.8)],
    [first(1.29, 1.45, 2.6), first(1.21, 1.19, 2.0), first(1.04, 1.07, 1.4)],
    [first(1.77, 1.85, 3.3), first(1.72, 1.49, 2.8), first(1.17, 1.21, 1.6)],
    [first(2.44, 2.01, 7.2), first(2.00, 1.84, 9.1), first(1.33, 1.39, 2.4)],
    [first(2.96, 1.71, 7.6), first(2.45, 2.24, 10.2), first(1.40, 1.47, 2.5)],
];

const fn first(mean: f64, gauss: f64, worst: f64) -> Shares {
    Shares { mean, gauss, worst }
}

/// The spans of mean and Gauss curvature of a shape by a method.
fn spans(shape: Shape, valence: usize, method: Method) -> Result<[f64; 2]> {
    let fan = shape.fan(valence);
    let range = with_surface(&fan, method, |surface| surface.range(valence))?;
    Ok(range.map(|[least, greatest]| greatest - least))
}

/// Shares of all methods at a valence.
pub(super) fn shares(valence: usize) -> Result<[Shares; 3]> {
    let mut shares = [Shares { mean: 0.0, gauss: 0.0, worst: 0.0 }; 3];
    for shape in Shape::ALL {
        let own = spans(shape, valence, Method::Cap(0))?;
        for (shares, method) in shares.iter_mut().zip(METHODS) {
            let found = spans(shape, valence, method)?;
            let [mean, gauss] = [found[0] / own[0], found[1] / own[1]];
            shares.mean += mean.ln() / Shape::ALL.len() as f64;
            shares.gauss += gauss.ln() / Shape::ALL.len() as f64;
            shares.worst = shares.worst.max(mean);
        }
    }
    Ok(shares.map(|Shares { mean, gauss, worst }| Shares { mean: mean.exp(), gauss: gauss.exp(), worst }))
}

/// Figures, the first ones, and by how much they differ.
pub(super) fn table() -> Result<Table> {
    let mut table = Table::new(&["n", "surface", "measured: mean / Gauss (worst)", "first", "apart"]);
    for (valence, first) in VALENCES.into_iter().zip(FIRST) {
        for ((method, found), first) in METHODS.into_iter().zip(shares(valence)?).zip(first) {
            let apart = (found.mean / first.mean - 1.0).abs().max((found.gauss / first.gauss - 1.0).abs());
            table.row(&[
                valence.to_string(),
                method.name(),
                words(&found),
                words(&first),
                format!("{:.1} %", 100.0 * apart),
            ]);
        }
    }
    Ok(table)
}

fn words(Shares { mean, gauss, worst }: &Shares) -> String {
    format!("{mean:.2} / {gauss:.2} ({worst:.1})")
}

/// The range of mean curvature on the saddle of the first example, by each method.
pub(super) fn example() -> Result<Table> {
    let mut table = Table::new(&["surface", "measured", "first"]);
    let valence = 8;
    let fan = super::fan::Fan::new(valence, |x, y| 0.3 * (x * x - y * y));
    let first = ["-1.96 .. 1.96", "-0.75 .. 0.75", "-0.48 .. 0.48", "-0.26 .. 0.26"];
    let methods = METHODS.into_iter().chain([Method::Cap(0)]);
    for (method, first) in methods.zip(first) {
        let [[least, greatest], _] = with_surface(&fan, method, |surface| surface.range(valence))?;
        table.row(&[method.name(), format!("{least:.2} .. {greatest:.2}"), first.to_owned()]);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn caps_run_more_evenly_than_the_limit_as_they_did_first() {
        for (valence, first) in VALENCES.into_iter().zip(FIRST) {
            let found = shares(valence).unwrap()[0];
            assert!(found.mean >= 1.0 && found.gauss >= 1.0, "valence {valence}: {found:?}");
            let apart = [found.mean / first[0].mean, found.gauss / first[0].gauss].map(|x| (x - 1.0).abs());
            assert!(apart.iter().all(|&apart| apart < 0.05), "valence {valence}: {found:?}");
        }
    }
}
