//! The surfaces over a fan that are compared: the limit, PCCM patches, caps.

use anyhow::{Context, Result};
use ogee::g2_caps::{CapClass, knots, nets, weights};
use ogee::nurbs::NurbsSurface;
use ogee::pccm::{self, to_patches};
use ogee::{FaceId, Level, LimitSurface, PatchTable, SurfaceJet, Vec3};

use super::fan::Fan;

/// How a fan becomes a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// The limit surface.
    Limit,
    /// PCCM after two refinements, quadratic in the second cell.
    Pccm,
    /// A cap after so many refinements, the limit around it.
    Cap(u32),
}

impl Method {
    pub(super) fn name(self) -> String {
        match self {
            Method::Limit => "limit".to_owned(),
            Method::Pccm => "PCCM".to_owned(),
            Method::Cap(level) => format!("G2 cap, level {level}"),
        }
    }
}

/// A surface over the faces at the vertex of a fan: a sector and a place in it, `(0, 0)` at the vertex.
pub(super) struct FanSurface<'a> {
    method: Method,
    limit: LimitSurface<'a>,
    /// One a sector: patches over `[0, 1]` or of the whole quad in cells, caps over the cells next to the vertex.
    sectors: Vec<NurbsSurface>,
}

/// Lets somebody look at a surface of a fan.
pub(super) fn with_surface<T>(
    fan: &Fan,
    method: Method,
    look: impl FnOnce(&FanSurface<'_>) -> Result<T>,
) -> Result<T> {
    let level = Level::new(&fan.mesh)?;
    let table = PatchTable::new(&level);
    let limit = LimitSurface::new(&table, &fan.mesh.points);
    let sectors = match method {
        Method::Limit => Vec::new(),
        Method::Pccm => {
            let patches = to_patches(&level, &fan.mesh.points, &pccm::Options::default())?;
            let own = patches.nets.into_iter().take(fan.valence);
            own.map(|net| NurbsSurface { u: patches.knots.clone(), v: patches.knots.clone(), net }).collect()
        }
        Method::Cap(level) => caps(fan, level)?,
    };
    look(&FanSurface { method, limit, sectors })
}

/// The sectors of a cap after some refinements.
pub(super) fn caps(fan: &Fan, level: u32) -> Result<Vec<NurbsSurface>> {
    let class = CapClass::Interior { valence: fan.valence as u32 };
    let weights = weights(class).context("the valence has weights")?;
    let nets = nets(&weights, &fan.columns(level)?);
    Ok(nets.into_iter().map(|net| NurbsSurface { u: knots(), v: knots(), net }).collect())
}

impl FanSurface<'_> {
    /// The surface there; nothing at the vertex where it has no curvature.
    pub(super) fn jet(&self, sector: usize, x: f64, y: f64) -> Result<Option<SurfaceJet>> {
        let place = match self.method {
            Method::Limit => None,
            Method::Pccm => Some(f64::from(1u32 << pccm::Options::default().level)),
            Method::Cap(level) => Some(f64::from(1u32 << level)).filter(|cells| cells * x.max(y) <= 1.0),
        };
        if let Some(cells) = place {
            return Ok(Some(self.sectors[sector].jet(cells * x, cells * y)));
        }
        if (x, y) == (0.0, 0.0) {
            return Ok(None);
        }
        let at = self.limit.table().locate(FaceId(sector as u32), None, x, y)?;
        Ok(Some(self.limit.jet(at).jet))
    }

    /// How far curvature ranges over the faces at the vertex, on the limit no nearer than a 32nd of them: mean and Gauss.
    pub(super) fn range(&self, valence: usize) -> Result<[[f64; 2]; 2]> {
        let mut range = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let places = places(self.method != Method::Limit);
        for sector in 0..valence {
            for &[x, y] in &places {
                let Some(curvature) = self.jet(sector, x, y)?.and_then(|jet| jet.curvature()) else {
                    continue;
                };
                for (range, value) in range.iter_mut().zip([curvature.mean, curvature.gauss]) {
                    *range = [range[0].min(value), range[1].max(value)];
                }
            }
        }
        Ok(range)
    }

    /// The farthest that places of it are from the limit surface.
    pub(super) fn distance(&self, valence: usize) -> Result<f64> {
        let places = places(true);
        let mut points: Vec<Vec3> = Vec::new();
        for sector in 0..valence {
            for &[x, y] in &places {
                points.extend(self.jet(sector, x, y)?.map(|jet| jet.position));
            }
        }
        let found = self.limit.closest_points().closest_batch(&points);
        Ok(found.iter().flatten().map(|closest| closest.distance).fold(0.0, f64::max))
    }
}

/// How often the distance to the vertex is halved, and samples along half a side at each of the distances.
const HALVINGS: u32 = 5;
const STEPS: u32 = 8;

/// Places on nested squares of a sector, borders included; `to_the_vertex` fills the innermost.
fn places(to_the_vertex: bool) -> Vec<[f64; 2]> {
    let mut places = Vec::new();
    for halving in 1..=HALVINGS {
        let step = 0.5_f64.powi(halving as i32) / f64::from(STEPS);
        for i in 0..=2 * STEPS {
            for j in 0..=2 * STEPS {
                let is_inside = i.max(j) < STEPS;
                if !is_inside || (halving == HALVINGS && to_the_vertex) {
                    places.push([f64::from(i) * step, f64::from(j) * step]);
                }
            }
        }
    }
    places
}
