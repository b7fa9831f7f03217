//! Curvature over the whole surface: how it is spread, where it is strongest, and the area on the way.
//!
//! Every square is sampled at the nodes of a Gauss rule, so each sample stands for a known piece of the area. The nodes
//! lie inside the squares: extraordinary points, where there is no curvature, are never hit.

use super::continuity::jet;
use super::{Address, FLAT, Surface};
use crate::limit::{Derivatives, Flags, Samples};
use crate::math::{Vec3, par};
use crate::nurbs::gauss;
use crate::patch::Location;

/// Curvature over a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvatureStatistics {
    /// How many samples were taken.
    pub samples: usize,
    /// How many of them have no normal: the surface is singular there.
    pub undefined_normals: usize,
    /// How many of them have no curvature, singular ones included.
    pub undefined_curvatures: usize,
    /// The area of the surface.
    pub area: f64,
    /// Mean curvature, `(k1 + k2) / 2`.
    pub mean: Distribution,
    /// Gauss curvature, `k1 k2`.
    pub gauss: Distribution,
    /// The principal curvature of larger size, without sign.
    pub greatest: Distribution,
    /// The strongest bend away from the normals, outward ones: an edge. `None` where it is flat or hollow all over.
    pub convex: Option<Bend>,
    /// The strongest bend towards the normals: a groove, and what limits the radius of a tool. `None` where it is flat or
    /// bulges all over.
    pub concave: Option<Bend>,
}

/// How strongly a surface bends at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// The radius of curvature.
    pub radius: f64,
    /// Where.
    pub at: Address,
    /// The point there.
    pub position: Vec3,
}

/// How a number is spread over the area.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distribution {
    /// The least.
    pub least: f64,
    /// The greatest.
    pub greatest: f64,
    /// The mean over the area.
    pub mean: f64,
    /// What 5 %, 50 % and 95 % of the area do not exceed.
    pub quantiles: [f64; 3],
    /// Shares of the area in bins of equal width.
    pub histogram: Histogram,
}

/// Shares of the area by value, in bins of equal width.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// Where the first bin starts and the last one ends.
    pub range: [f64; 2],
    /// The share of each bin. With those outside the range they sum to one.
    pub shares: Vec<f64>,
    /// The shares below the range and above it.
    pub outside: [f64; 2],
}

/// Nodes along a side of a square at most: curvature varies little over a square.
const NODES: usize = 6;

/// Samples that are kept, about.
const MOST: usize = 1 << 20;

/// Samples that are evaluated at once.
const BLOCK: usize = 1 << 14;

/// Bins of a histogram.
const BINS: usize = 48;

/// The share of the area on either side that a histogram leaves out: curvature has long tails.
const TAIL: f64 = 0.01;

/// One sample: its share of the area and its principal curvatures, if it has any.
struct Sample {
    area: f64,
    principal: Option<[f64; 2]>,
}

impl CurvatureStatistics {
    /// Samples every square; fewer samples a square where there are very many. `size` is the diagonal of the surface.
    pub(super) fn new(surface: &dyn Surface, size: f64) -> CurvatureStatistics {
        let squares = surface.layout().squares();
        let side = ((MOST as f64 / squares.len().max(1) as f64).sqrt() as usize).clamp(1, NODES);
        let nodes: Vec<(f64, f64)> =
            gauss(side).into_iter().map(|(x, weight)| ((1.0 + x) / 2.0, weight / 2.0)).collect();
        let mut samples = Samples::default();
        let mut places: Vec<Location> = Vec::new();
        let mut all: Vec<Sample> = Vec::new();
        let mut undefined_normals = 0;
        // The strongest bend of each sign, with its place.
        let mut strongest: [Option<(f64, Location, Vec3)>; 2] = [None; 2];
        for block in squares.chunks((BLOCK / (side * side)).max(1)) {
            places.clear();
            let mut weights = Vec::new();
            for square in block {
                for (s, along) in &nodes {
                    places.extend(nodes.iter().map(|(t, _)| square.at(*s, *t)));
                    let size = square.size[0] * square.size[1];
                    weights.extend(nodes.iter().map(|(_, across)| size * along * across));
                }
            }
            surface.evaluate(&places, Derivatives::Second, &mut samples);
            let start = all.len();
            par::extend(&mut all, places.len(), |i| {
                let point = jet(&samples, i);
                let area = weights[i] * point.jet.du.cross(point.jet.dv).length();
                Sample { area, principal: point.curvature().map(|c| [c.k1, c.k2]) }
            });
            let is_singular = |flags: &&Flags| flags.contains(Flags::NORMAL_UNDEFINED);
            undefined_normals += samples.flags.iter().filter(is_singular).count();
            for (i, sample) in all[start..].iter().enumerate() {
                let Some([k1, k2]) = sample.principal else { continue };
                for (best, k) in strongest.iter_mut().zip([-k2, k1]) {
                    if k > best.map_or(FLAT / size, |best| best.0) {
                        *best = Some((k, places[i], samples.position[i]));
                    }
                }
            }
        }
        let area = all.iter().map(|sample| sample.area).sum();
        let spread = |value: fn([f64; 2]) -> f64| {
            let values = all.iter().filter_map(|sample| Some((value(sample.principal?), sample.area)));
            Distribution::new(values.filter(|(value, area)| value.is_finite() && *area > 0.0).collect())
        };
        let [convex, concave] = strongest.map(|best| {
            best.map(|(k, at, position)| Bend { radius: 1.0 / k, at: surface.address(at), position })
        });
        CurvatureStatistics {
            samples: all.len(),
            undefined_normals,
            undefined_curvatures: all.iter().filter(|sample| sample.principal.is_none()).count(),
            area,
            mean: spread(|[k1, k2]| k1.midpoint(k2)),
            gauss: spread(|[k1, k2]| k1 * k2),
            greatest: spread(|[k1, k2]| k1.abs().max(k2.abs())),
            convex,
            concave,
        }
    }
}

impl Distribution {
    /// Of values with the area that each stands for.
    fn new(mut values: Vec<(f64, f64)>) -> Distribution {
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (Some(first), Some(last)) = (values.first(), values.last()) else {
            return Distribution::default();
        };
        let (least, greatest) = (first.0, last.0);
        let total: f64 = values.iter().map(|(_, area)| area).sum();
        let mut sums: Vec<f64> = Vec::with_capacity(values.len());
        for (_, area) in &values {
            sums.push(sums.last().unwrap_or(&0.0) + area);
        }
        let quantile = |share: f64| {
            let rank = sums.partition_point(|&sum| sum < share * total);
            values[rank.min(values.len() - 1)].0
        };
        let mean = values.iter().map(|(value, area)| value * (area / total)).sum();
        let histogram = Histogram::new(&values, total, [quantile(TAIL), quantile(1.0 - TAIL)]);
        Distribution { least, greatest, mean, quantiles: [0.05, 0.5, 0.95].map(quantile), histogram }
    }
}

impl Histogram {
    fn new(values: &[(f64, f64)], total: f64, [mut from, mut to]: [f64; 2]) -> Histogram {
        // One value and its rounding: a bin in the middle.
        let width = (to - from).max(1e-9 * from.abs().max(to.abs())).max(f64::MIN_POSITIVE);
        if to - from < width {
            (from, to) = (from - width / 2.0, to + width / 2.0);
        }
        let mut histogram = Histogram { range: [from, to], shares: vec![0.0; BINS], outside: [0.0; 2] };
        for &(value, area) in values {
            let bin = (value - from) / (to - from) * BINS as f64;
            let share = match value {
                _ if value < from => &mut histogram.outside[0],
                _ if value > to => &mut histogram.outside[1],
                _ => &mut histogram.shares[(bin as usize).min(BINS - 1)],
            };
            *share += area / total;
        }
        histogram
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_of_the_area() {
        // Three quarters of the area at 1, a quarter spread evenly over 2 to 3.
        let spread = (0..1000).map(|i| (2.0 + f64::from(i) / 999.0, 0.25 / 1000.0));
        let found = Distribution::new([(1.0, 0.75)].into_iter().chain(spread).collect());
        assert_eq!((found.least, found.greatest), (1.0, 3.0));
        assert!((found.mean - (0.75 + 0.25 * 2.5)).abs() < 1e-12);
        let [low, middle, high] = found.quantiles;
        assert!(low == 1.0 && middle == 1.0 && (high - 2.8).abs() < 2e-3, "{high}");
        let Histogram { range, shares, outside } = &found.histogram;
        assert!(range[0] == 1.0 && (range[1] - 2.96).abs() < 2e-3 && outside[0] == 0.0);
        assert!((shares[0] - 0.75).abs() < 1e-12 && (outside[1] - 0.01).abs() < 1e-3);
        assert!((shares.iter().chain(outside).sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn one_value_has_a_histogram_too() {
        for value in [0.0, 5.0, -1e-30, 1e300] {
            let found = Distribution::new(vec![(value, 1.0); 3]);
            assert_eq!((found.least, found.greatest, found.quantiles), (value, value, [value; 3]));
            assert!((found.histogram.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{value}");
        }
        assert_eq!(Distribution::new(Vec::new()), Distribution::default());
    }
}
