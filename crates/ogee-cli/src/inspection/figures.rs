//! The figures as programs read them: the names and shapes of the JSON report.

use std::collections::BTreeMap;

use ogee::ControlMesh;
use ogee::quality::{
    Address, Behaviour, Bend, Cause, CurvatureRange, Distribution, ExtraordinaryPoint, JointPlace, Joints,
    LEVELS, Metric, PointWithoutPlane, Report, Sector, SectorKind,
};
use serde::Serialize;

use super::vertex_of;

/// Everything that was measured.
#[derive(Serialize)]
pub(crate) struct Figures {
    /// What was measured: the limit of a cage, or patches.
    pub(crate) kind: &'static str,
    /// Faces of the cage, or patches.
    pub(crate) faces: usize,
    /// Squares of parameters.
    pub(crate) squares: usize,
    pub(crate) closed: bool,
    pub(crate) area: f64,
    pub(crate) bbox: [[f64; 3]; 2],
    /// The diagonal of the box.
    pub(crate) size: f64,
    pub(crate) continuity: Continuity,
    pub(crate) curvature: Curvature,
    pub(crate) extraordinary: Extraordinary,
}

#[derive(Serialize)]
pub(crate) struct Continuity {
    pub(crate) smooth: JointFigures,
    pub(crate) sharp: JointFigures,
    pub(crate) border_sides: usize,
}

#[derive(Serialize)]
pub(crate) struct JointFigures {
    pub(crate) joints: usize,
    pub(crate) gap: MetricFigures,
    pub(crate) angle_deg: MetricFigures,
    pub(crate) curvature_relative: MetricFigures,
    pub(crate) kink_deg: MetricFigures,
}

#[derive(Serialize)]
pub(crate) struct MetricFigures {
    pub(crate) samples: usize,
    pub(crate) max: f64,
    pub(crate) p95: f64,
    pub(crate) mean: f64,
    pub(crate) worst: Vec<WorstPlace>,
}

#[derive(Serialize)]
pub(crate) struct WorstPlace {
    pub(crate) value: f64,
    pub(crate) at: At,
    pub(crate) beside: At,
    pub(crate) position: [f64; 3],
}

/// A place on the surface, in terms of the cage.
#[derive(Clone, Copy, Serialize)]
pub(crate) struct At {
    pub(crate) face: u32,
    pub(crate) corner: Option<u32>,
    pub(crate) u: f64,
    pub(crate) v: f64,
}

#[derive(Serialize)]
pub(crate) struct Curvature {
    pub(crate) samples: usize,
    pub(crate) undefined_normals: usize,
    pub(crate) undefined_curvatures: usize,
    pub(crate) mean: Spread,
    pub(crate) gauss: Spread,
    pub(crate) greatest: Spread,
    pub(crate) smallest_radius: Radii,
}

#[derive(Serialize)]
pub(crate) struct Radii {
    pub(crate) convex: Option<Radius>,
    pub(crate) concave: Option<Radius>,
}

#[derive(Serialize)]
pub(crate) struct Radius {
    pub(crate) radius: f64,
    pub(crate) at: At,
    pub(crate) position: [f64; 3],
}

#[derive(Serialize)]
pub(crate) struct Spread {
    pub(crate) min: f64,
    pub(crate) p5: f64,
    pub(crate) p50: f64,
    pub(crate) p95: f64,
    pub(crate) max: f64,
    pub(crate) mean: f64,
    pub(crate) histogram: Histogram,
}

#[derive(Serialize)]
pub(crate) struct Histogram {
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Of the area, in bins of equal width.
    pub(crate) shares: Vec<f64>,
    pub(crate) below: f64,
    pub(crate) above: f64,
}

#[derive(Serialize)]
pub(crate) struct Extraordinary {
    pub(crate) found: usize,
    pub(crate) examined: usize,
    pub(crate) by_valence: Vec<Valence>,
    /// The worst of them.
    pub(crate) points: Vec<Point>,
    pub(crate) without_plane_found: usize,
    pub(crate) without_plane: Vec<WithoutPlane>,
}

/// All examined points of one kind and valence together.
#[derive(Serialize)]
pub(crate) struct Valence {
    pub(crate) kind: &'static str,
    pub(crate) faces: usize,
    pub(crate) count: usize,
    pub(crate) growing: usize,
    pub(crate) growth_mean: f64,
    pub(crate) swing_max: f64,
}

/// A point where not four faces meet.
#[derive(Serialize)]
pub(crate) struct Place {
    /// The vertex of the cage, where it is one.
    pub(crate) vertex: Option<u32>,
    pub(crate) at: At,
    pub(crate) position: [f64; 3],
    pub(crate) kind: &'static str,
    pub(crate) faces: usize,
}

#[derive(Serialize)]
pub(crate) struct Point {
    #[serde(flatten)]
    pub(crate) place: Place,
    pub(crate) behaviour: &'static str,
    pub(crate) growth: f64,
    /// Of mean curvature round the ring of radius `2^-6`.
    pub(crate) swing: f64,
    pub(crate) range: Range,
    pub(crate) rings: [Ring; LEVELS.len()],
}

/// The least and the greatest curvature over the faces at a point.
#[derive(Clone, Copy, Serialize)]
pub(crate) struct Range {
    /// Over how much of each side of the faces.
    pub(crate) reach: f64,
    pub(crate) mean: [f64; 2],
    pub(crate) gauss: [f64; 2],
}

impl From<&CurvatureRange> for Range {
    fn from(&CurvatureRange { reach, mean, gauss }: &CurvatureRange) -> Range {
        Range { reach, mean, gauss }
    }
}

#[derive(Serialize)]
pub(crate) struct Ring {
    /// The radius is two to minus this.
    pub(crate) level: u32,
    pub(crate) mean: f64,
    pub(crate) mean_swing: f64,
    pub(crate) gauss_swing: f64,
}

#[derive(Serialize)]
pub(crate) struct WithoutPlane {
    #[serde(flatten)]
    pub(crate) place: Place,
    pub(crate) cause: &'static str,
    pub(crate) spread_deg: f64,
}

/// Extraordinary points that are listed.
const LISTED: usize = 20;

/// Points without a tangent plane that are listed.
const WITHOUT_PLANE: usize = 1000;

/// The ring by which points are ranked.
const RANKED: u32 = 6;

impl Figures {
    /// From what was measured; `mesh` names vertices where there is a cage.
    pub(crate) fn new(report: &Report, faces: usize, mesh: Option<&ControlMesh>) -> Figures {
        let extraordinary = &report.extraordinary;
        let without_plane = &extraordinary.without_plane;
        let curvature = &report.curvature;
        Figures {
            kind: if mesh.is_some() { "cage" } else { "patches" },
            faces,
            squares: report.squares,
            closed: report.is_closed(),
            area: curvature.area,
            bbox: report.bounding_box.map(<[f64; 3]>::from),
            size: report.size(),
            continuity: Continuity {
                smooth: joints(&report.continuity.smooth),
                sharp: joints(&report.continuity.sharp),
                border_sides: report.continuity.border,
            },
            curvature: Curvature {
                samples: curvature.samples,
                undefined_normals: curvature.undefined_normals,
                undefined_curvatures: curvature.undefined_curvatures,
                mean: spread(&curvature.mean),
                gauss: spread(&curvature.gauss),
                greatest: spread(&curvature.greatest),
                smallest_radius: Radii {
                    convex: curvature.convex.as_ref().map(radius),
                    concave: curvature.concave.as_ref().map(radius),
                },
            },
            extraordinary: Extraordinary {
                found: extraordinary.found,
                examined: extraordinary.points.len(),
                by_valence: by_valence(&extraordinary.points),
                points: extraordinary
                    .points
                    .iter()
                    .take(LISTED)
                    .map(|point| self::point(point, mesh))
                    .collect(),
                without_plane_found: without_plane.len(),
                without_plane: without_plane
                    .iter()
                    .take(WITHOUT_PLANE)
                    .map(|point| self::without_plane(point, mesh))
                    .collect(),
            },
        }
    }
}

impl From<Address> for At {
    fn from(Address { face, corner, u, v }: Address) -> At {
        At { face: face.0, corner, u, v }
    }
}

fn joints(joints: &Joints) -> JointFigures {
    JointFigures {
        joints: joints.count,
        gap: metric(&joints.gap),
        angle_deg: metric(&joints.angle),
        curvature_relative: metric(&joints.curvature),
        kink_deg: metric(&joints.kink),
    }
}

fn metric(metric: &Metric) -> MetricFigures {
    let worst = metric.worst.iter().map(|&JointPlace { value, at, beside, position }| WorstPlace {
        value,
        at: at.into(),
        beside: beside.into(),
        position: position.into(),
    });
    let Metric { samples, max, p95, mean, .. } = *metric;
    MetricFigures { samples, max, p95, mean, worst: worst.collect() }
}

fn spread(distribution: &Distribution) -> Spread {
    let [p5, p50, p95] = distribution.quantiles;
    let histogram = &distribution.histogram;
    let ([from, to], [below, above]) = (histogram.range, histogram.outside);
    Spread {
        min: distribution.least,
        p5,
        p50,
        p95,
        max: distribution.greatest,
        mean: distribution.mean,
        histogram: Histogram { from, to, shares: histogram.shares.clone(), below, above },
    }
}

fn radius(bend: &Bend) -> Radius {
    Radius { radius: bend.radius, at: bend.at.into(), position: bend.position.into() }
}

fn by_valence(points: &[ExtraordinaryPoint]) -> Vec<Valence> {
    let mut kinds: BTreeMap<(SectorKind, usize), Valence> = BTreeMap::new();
    for point in points {
        let Sector { kind, faces, .. } = point.sector;
        let found = kinds.entry((kind, faces)).or_insert_with(|| Valence {
            kind: name(kind),
            faces,
            count: 0,
            growing: 0,
            growth_mean: 0.0,
            swing_max: 0.0,
        });
        found.count += 1;
        found.growing += usize::from(point.behaviour == Behaviour::Growing);
        found.growth_mean += (point.growth - found.growth_mean) / found.count as f64;
        found.swing_max = found.swing_max.max(swing(point));
    }
    kinds.into_values().collect()
}

fn swing(point: &ExtraordinaryPoint) -> f64 {
    let rings = LEVELS.iter().zip(&point.rings);
    rings.filter(|(level, _)| **level == RANKED).map(|(_, ring)| ring.mean_swing).sum()
}

fn name(kind: SectorKind) -> &'static str {
    match kind {
        SectorKind::Interior => "interior",
        SectorKind::Dart => "dart",
        SectorKind::Crease => "crease",
        SectorKind::Border => "border",
    }
}

/// The place of a point; `mesh` names its vertex.
pub(crate) fn place_of(sector: &Sector, mesh: Option<&ControlMesh>) -> Place {
    Place {
        vertex: vertex_of(mesh, sector),
        at: sector.at.into(),
        position: sector.position.into(),
        kind: name(sector.kind),
        faces: sector.faces,
    }
}

fn point(point: &ExtraordinaryPoint, mesh: Option<&ControlMesh>) -> Point {
    Point {
        place: place_of(&point.sector, mesh),
        behaviour: match point.behaviour {
            Behaviour::Flat => "flat",
            Behaviour::Bounded => "bounded",
            Behaviour::Growing => "growing",
        },
        growth: point.growth,
        swing: swing(point),
        range: Range::from(&point.range),
        rings: std::array::from_fn(|k| {
            let ogee::quality::Ring { mean, mean_swing, gauss_swing } = point.rings[k];
            Ring { level: LEVELS[k], mean, mean_swing, gauss_swing }
        }),
    }
}

fn without_plane(point: &PointWithoutPlane, mesh: Option<&ControlMesh>) -> WithoutPlane {
    WithoutPlane {
        place: place_of(&point.sector, mesh),
        cause: match point.cause {
            Cause::Rules => "rules",
            Cause::Slow => "slow",
            Cause::Measured => "measured",
        },
        spread_deg: point.spread,
    }
}
