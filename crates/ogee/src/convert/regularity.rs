//! Whether the caps around irregular vertices fold, as those of folded cages do.

use super::cap_deviation::Fan;
use crate::math::{Grid, Vec3};

/// Samples in each direction of a sector.
const SAMPLES: usize = 9;

/// How far the surfaces around a vertex are from being singular.
#[derive(Clone, Copy, Debug)]
pub(super) struct Regularity {
    /// The least length of `du x dv` over samples, relative to the greatest.
    pub(super) least: f64,
    /// True if the normal turns over from one sample to the next.
    pub(super) folded: bool,
}

impl Regularity {
    pub(super) fn of(fan: &Fan) -> Regularity {
        let (mut least, mut greatest, mut folded) = (f64::MAX, 0.0_f64, false);
        for surface in &fan.surfaces {
            let stations: Vec<f64> = (0..SAMPLES).map(|k| k as f64 / (SAMPLES - 1) as f64).collect();
            let (us, vs): (Vec<_>, Vec<_>) =
                stations.iter().map(|&t| (surface.u.basis(t), surface.v.basis(t))).unzip();
            let areas: Grid<Vec3> = Grid::from_fn(SAMPLES, SAMPLES, |i, j| {
                let [_, du, dv] = surface.tangents_from(&us[i], &vs[j]);
                du.cross(dv)
            });
            for i in 0..SAMPLES {
                for j in 0..SAMPLES {
                    let area = areas[(i, j)];
                    least = least.min(area.length());
                    greatest = greatest.max(area.length());
                    let next = [(i + 1, j), (i, j + 1)].into_iter().filter(|&(i, j)| i.max(j) < SAMPLES);
                    folded |= next.into_iter().any(|at| area.dot(areas[at]) < 0.0);
                }
            }
        }
        Regularity { least: if greatest > 0.0 { least / greatest } else { 0.0 }, folded }
    }
}
