//! The table of figures per method, beside the figures that stood when the methods were first worked out.

use anyhow::Result;

use super::measure::{Figures, figures};
use super::methods::{Depth, Method, treatment};
use super::nets::Example;
use crate::bench::report::Table;

/// A row of the first figures: on the nets (a), (b) and (c). They came from a program of its own, whose regions, samples and third
/// net are known in outline only.
type First = [Option<Figures>; 3];

/// In the order of [`Method::ALL`].
const FIRST: [First; 11] = [
    [known(1.04, 140.0, 2.4), known(0.90, 155.0, 4.9), None],
    [known(1.04, 117.0, 1.8), known(0.90, 130.0, 3.7), None],
    [known(1.04, 3.08, 0.044), known(0.90, 3.62, 0.106), known(-35.5, -0.19, 134.0)],
    [known(1.04, 1.53, 0.012), known(0.90, 2.08, 0.048), known(-24.6, -0.19, 73.0)],
    [known(1.04, 2.02, 0.021), known(0.90, 2.20, 0.071), known(-18.4, -0.19, 49.0)],
    [known(1.04, 2.19, 0.025), known(0.90, 2.86, 0.077), known(-31.8, -0.19, 92.0)],
    [known(0.94, 1.66, 0.022), known(0.91, 1.99, 0.075), known(-19.9, -0.24, 71.0)],
    [known(1.03, 1.45, 0.016), known(0.94, 1.82, 0.070), known(-19.2, -0.22, 70.0)],
    [None, known(1.00, 1.97, 0.036), known(-24.4, -0.19, 70.0)],
    [None, known(1.00, 1.96, 0.036), known(-24.4, -0.19, 70.0)],
    [None, known(0.71, 1.99, 0.036), known(-24.9, -0.19, 75.0)],
];

const fn known(least: f64, greatest: f64, gradient: f64) -> Option<Figures> {
    Some(Figures { range: [least, greatest], gradient })
}

/// Figures of all methods on a net, in the order of [`Method::ALL`].
fn column(example: &Example) -> Result<Vec<Option<Figures>>> {
    let measured = |method| {
        Ok(treatment(&example.mesh, method, Depth::MEASURED)?.map(|surface| figures(&surface, example)))
    };
    Method::ALL.into_iter().map(measured).collect()
}

/// A table of what a net has, what it had first, and the largest share by which one of the three figures differs.
pub(super) fn table(example: &Example, net: usize) -> Result<Table> {
    let mut table = Table::new(&["surface", "measured", "first", "apart"]);
    for ((method, found), first) in Method::ALL.iter().zip(column(example)?).zip(FIRST) {
        let first = first[net];
        let Some(found) = found else { continue };
        let apart = first.map(|first| format!("{:.1} %", 100.0 * deviation(&found, &first)));
        table.row(&[
            method.name().to_owned(),
            words(&found, net),
            first.map_or_else(String::new, |first| words(&first, net)),
            apart.unwrap_or_default(),
        ]);
    }
    Ok(table)
}

/// A range and a gradient, with three figures.
fn words(figures: &Figures, net: usize) -> String {
    let Figures { range: [least, greatest], gradient } = *figures;
    match net {
        2 => format!("{least:.1} .. {greatest:.2} [{gradient:.0}]"),
        _ => format!("{least:.2} .. {} [{}]", short(greatest), short(gradient)),
    }
}

fn short(x: f64) -> String {
    match x {
        100.0.. => format!("{x:.0}"),
        1.0.. => format!("{x:.2}"),
        _ => format!("{x:.3}"),
    }
}

/// The largest share by which one of the three figures is off.
fn deviation(found: &Figures, first: &Figures) -> f64 {
    let off = |found: f64, first: f64| (found / first - 1.0).abs();
    let range = off(found.range[0], first.range[0]).max(off(found.range[1], first.range[1]));
    range.max(off(found.gradient, first.gradient))
}

#[cfg(test)]
mod tests {
    use ogee::lens::PolarVariant;

    use super::*;
    use crate::reproduce::lens::nets::{pair, single, tip};

    /// Methods by growing gradient of the mean curvature, those without figures left out.
    fn order(of: impl Iterator<Item = Option<Figures>>) -> Vec<&'static str> {
        let mut found: Vec<_> =
            Method::ALL.iter().zip(of).filter_map(|(m, f)| Some((m.name(), f?.gradient))).collect();
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        found.into_iter().map(|(name, _)| name).collect()
    }

    #[test]
    fn figures_are_the_first_ones_within_five_percent() {
        for (net, example) in [single(), pair()].iter().enumerate() {
            let column = column(example).unwrap();
            for ((method, found), first) in Method::ALL.iter().zip(&column).zip(FIRST) {
                let place = format!("{} on net {}", method.name(), example.letter);
                match (found, first[net]) {
                    (Some(found), Some(first)) => {
                        let apart = deviation(found, &first);
                        assert!(apart < 0.05, "{place}: {found:?} against {first:?}, apart by {apart:.3}");
                    }
                    (found, first) => assert!(found.is_none() && first.is_none(), "{place}"),
                }
            }
            let own = order(column.into_iter());
            let first = order(FIRST.iter().map(|first| first[net]));
            // The first figures of polar caps are all the same.
            let apart_from_caps = |names: Vec<&'static str>| {
                names.into_iter().filter(|name| !name.starts_with("polar")).collect::<Vec<_>>()
            };
            assert_eq!(apart_from_caps(own), apart_from_caps(first), "net {}", example.letter);
        }
    }

    /// The net of the first figures is lost, and this one was shaped after them: a guard against change, no evidence.
    #[test]
    fn methods_keep_their_order_at_a_wing_tip() {
        let column = column(&tip()).unwrap();
        let by_peak = |of: Vec<Option<Figures>>| {
            let known = Method::ALL.iter().zip(of).zip(FIRST);
            let mut peaks: Vec<_> = known
                // Polar caps 65 and 55 are alike.
                .filter(|((method, _), first)| {
                    **method != Method::Polar(PolarVariant::FiveFive) && first[2].is_some()
                })
                .map(|((method, found), _)| (method.name(), found.unwrap().range[0]))
                .collect();
            peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
            peaks
        };
        let (own, first) = (by_peak(column), by_peak(FIRST.iter().map(|first| first[2]).collect()));
        for (own, first) in own.iter().zip(&first) {
            assert_eq!(own.0, first.0, "{own:?} against {first:?}");
        }
        let ratio = |peaks: &[(&str, f64)]| peaks[peaks.len() - 1].1 / peaks[0].1;
        assert!((ratio(&own) / ratio(&first) - 1.0).abs() < 0.15, "{own:?} against {first:?}");
    }
}
