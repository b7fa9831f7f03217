//! What a network wants of the surface along its curves, brought to the rows beside them: normals and cross curvatures.
//!
//! Rows that others decide are kept: around meeting points and smooth crossings, on the border where it carries a curve,
//! and where two curves share a side vertex. What is wanted there is compared with what comes out.

use super::complex::{Complex, reposition};
use super::network::CurveNetwork;
use super::plan::{NetworkPlan, Segment};
use super::warning::NetworkWarning;
use crate::limit::LimitSurface;
use crate::math::Vec3;
use crate::mesh::{ControlMesh, VertexId};
use crate::patch::PatchTable;
use crate::rules::Level;
use std::collections::{BTreeMap, BTreeSet};

/// Angles below this are met, in degrees.
const ANGLE_TOLERANCE: f64 = 1e-6;

/// Of one over the size of the mesh, how far a curvature may be off.
const CURVATURE_TOLERANCE: f64 = 1e-6;

/// What is wanted at the vertices of a segment.
#[derive(Default)]
struct Wants {
    normals: Vec<Option<Vec3>>,
    curvatures: Vec<Option<f64>>,
}

/// Something wanted where rows are kept.
pub(super) struct Missed {
    segment: usize,
    /// Number in the segment.
    at: usize,
    normal: Option<Vec3>,
    curvature: Option<f64>,
    /// Whether more splits would make room for it.
    pub(super) crowded: bool,
}

impl Wants {
    fn new(network: &CurveNetwork, segment: &Segment) -> Wants {
        let curve = &network.curves[segment.curve];
        if curve.normals.is_empty() && curve.cross_curvatures.is_empty() {
            return Wants::default();
        }
        // Splits keep the numbers of vertices.
        let places: BTreeMap<u32, usize> = curve.vertices.iter().zip(0..).map(|(&v, i)| (v, i)).collect();
        let at = |v: &u32| places.get(v).copied();
        let normal = |v: &u32| curve.normals.get(at(v)?).copied().flatten();
        let curvature = |v: &u32| curve.cross_curvatures.get(at(v)?).copied().flatten();
        let path = &segment.vertices;
        Wants { normals: path.iter().map(normal).collect(), curvatures: path.iter().map(curvature).collect() }
    }

    fn normal(&self, i: usize) -> Option<Vec3> {
        self.normals.get(i).copied().flatten()
    }

    fn curvature(&self, i: usize) -> Option<f64> {
        self.curvatures.get(i).copied().flatten()
    }

    fn any(&self, i: usize) -> bool {
        self.normal(i).is_some() || self.curvature(i).is_some()
    }
}

/// Vertices that more than one row beside a curve depends on, or that others decide.
pub(super) fn busy_vertices(plan: &NetworkPlan, sides: &[Vec<[u32; 2]>], decided: &[u32]) -> BTreeSet<u32> {
    let mut busy: BTreeSet<u32> = decided.iter().copied().collect();
    let mut used = BTreeSet::new();
    for (segment, sides) in plan.segments.iter().zip(sides) {
        busy.extend(segment.vertices.iter().filter(|_| segment.along_border));
        busy.extend(sides.iter().flatten().filter(|&&v| !used.insert(v)));
    }
    busy
}

/// Turns and bends the rows beside all curves that want it. What is wanted where rows are kept is returned.
pub(super) fn shape_rows(
    points: &mut [Vec3],
    network: &CurveNetwork,
    plan: &NetworkPlan,
    sides: &[Vec<[u32; 2]>],
    decided: &[u32],
    warnings: &mut Vec<NetworkWarning>,
) -> Vec<Missed> {
    let mut missed = Vec::new();
    let wants: Vec<Wants> = plan.segments.iter().map(|segment| Wants::new(network, segment)).collect();
    if wants.iter().all(|wants| (0..wants.normals.len()).all(|i| !wants.any(i))) {
        return missed;
    }
    let busy = busy_vertices(plan, sides, decided);
    let on_border = plan.segments.iter().filter(|segment| segment.along_border);
    let rim: BTreeSet<u32> = on_border.flat_map(|segment| segment.vertices.iter().copied()).collect();
    let crosses = |v: u32| plan.smooth_crossings.binary_search(&v).is_ok();
    for (number, (segment, wants)) in plan.segments.iter().zip(&wants).enumerate() {
        let count = segment.vertices.len();
        if (0..count).all(|i| !wants.any(i)) {
            continue;
        }
        let closed = segment.target.is_closed();
        // Beside a crossing or a meeting point too.
        let near = |i: usize, special: &dyn Fn(usize) -> bool| {
            let step = |to: isize| {
                let k = i as isize + to;
                if closed { Some(k.rem_euclid(count as isize) as usize) } else { usize::try_from(k).ok() }
            };
            [-1, 0, 1].into_iter().filter_map(step).any(|k| k < count && special(k))
        };
        let special = |k: usize| {
            crosses(segment.vertices[k])
                || (k == 0 && segment.meets[0])
                || (k + 1 == count && segment.meets[1])
        };
        let kept = |i: usize| {
            segment.along_border || near(i, &special) || sides[number][i].iter().any(|v| busy.contains(v))
        };
        let kept: Vec<bool> = (0..count).map(kept).collect();
        for at in (0..count).filter(|&i| kept[i] && wants.any(i)) {
            let crowded = !rim.contains(&segment.vertices[at]) && !special(at);
            missed.push(Missed {
                segment: number,
                at,
                normal: wants.normal(at),
                curvature: wants.curvature(at),
                crowded,
            });
        }
        for stretch in stretches(&kept, closed) {
            let tilts = shape(points, segment, &sides[number], wants, &stretch);
            let name = || network.curves[segment.curve].name.clone();
            warnings.extend(tilts.into_iter().map(|(vertex, angle_deg)| NetworkWarning::NormalTilted {
                vertex,
                curve: name(),
                angle_deg,
            }));
        }
    }
    missed
}

/// A run of vertices whose rows may move, with the kept ones at its ends, if it has any.
struct Stretch {
    /// Numbers in the segment.
    places: Vec<usize>,
    keep: [usize; 2],
    closed: bool,
}

fn stretches(kept: &[bool], closed: bool) -> Vec<Stretch> {
    let count = kept.len();
    let Some(first) = kept.iter().position(|&kept| kept) else {
        return vec![Stretch { places: (0..count).collect(), keep: [0, 0], closed }];
    };
    // A closed path is walked from a kept vertex back to it.
    let walk: Vec<usize> =
        if closed { (0..=count).map(|k| (first + k) % count).collect() } else { (0..count).collect() };
    let mut stretches = Vec::new();
    let mut start = 0;
    while let Some(offset) = walk[start..].iter().position(|&i| !kept[i]) {
        let from = start + offset;
        let to = walk[from..].iter().position(|&i| kept[i]).map_or(walk.len(), |length| from + length);
        let (before, after) = (usize::from(from > 0), usize::from(to < walk.len()));
        let places = walk[from - before..to + after].to_vec();
        stretches.push(Stretch { places, keep: [before, after], closed: false });
        start = to;
    }
    stretches
}

/// Turns and bends the rows of one stretch; where normals had to be made perpendicular, and by how much.
fn shape(
    points: &mut [Vec3],
    segment: &Segment,
    sides: &[[u32; 2]],
    wants: &Wants,
    stretch: &Stretch,
) -> Vec<(u32, f64)> {
    let places = &stretch.places;
    let control = segment.target.control();
    let row = |side: usize| places.iter().map(|&i| points[sides[i][side] as usize]).collect::<Vec<Vec3>>();
    let (top, bottom) = (row(0), row(1));
    let middle = (0..places.len()).map(|k| reposition(control[places[k]], top[k], bottom[k])).collect();
    let mut complex = Complex { top, middle, bottom, closed: stretch.closed };
    let normals: Vec<Option<Vec3>> = places.iter().map(|&i| wants.normal(i)).collect();
    let tilts = complex.set_normals(&normals, stretch.keep);
    let curvatures: Vec<Option<f64>> = places.iter().map(|&i| wants.curvature(i)).collect();
    complex.set_cross_curvatures(&curvatures, stretch.keep);
    let end = places.len() - stretch.keep[1];
    for k in stretch.keep[0]..end {
        let [left, right] = sides[places[k]];
        points[left as usize] = complex.top[k];
        points[right as usize] = complex.bottom[k];
    }
    let tilted = places.iter().zip(tilts).filter(|(_, tilt)| *tilt > ANGLE_TOLERANCE);
    tilted.map(|(&i, tilt)| (segment.vertices[i], tilt)).collect()
}

/// Looks at the finished surface where rows were kept, and tells what was not met.
pub(super) fn tell_missed(
    missed: &[Missed],
    network: &CurveNetwork,
    segments: &[Segment],
    mesh: &ControlMesh,
) -> Vec<NetworkWarning> {
    let mut warnings = Vec::new();
    // A curve that goes through a meeting point ends there twice.
    let mut seen = BTreeSet::new();
    let level = match Level::new(mesh) {
        Ok(level) if !missed.is_empty() => level,
        _ => return warnings,
    };
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let topology = level.topology();
    for missed in missed {
        let segment = &segments[missed.segment];
        let vertex = segment.vertices[missed.at];
        let curve = || network.curves[segment.curve].name.clone();
        if !seen.insert((segment.curve, vertex)) {
            continue;
        }
        let Some(at) = table.locate_vertex(topology, VertexId(vertex)) else { continue };
        let found = surface.jet(at);
        let along = segment.target.tangent(missed.at);
        if let (Some(wanted), Some(unit)) = (missed.normal, along.normalized())
            && let Some(normal) = (wanted - unit.dot(wanted) * unit).normalized()
        {
            let tilt = wanted.angle(normal).to_degrees();
            if tilt > ANGLE_TOLERANCE {
                warnings.push(NetworkWarning::NormalTilted { vertex, curve: curve(), angle_deg: tilt });
            }
            let angle_deg = normal.angle(found.normal).to_degrees();
            if angle_deg > ANGLE_TOLERANCE {
                warnings.push(NetworkWarning::NormalMissed { vertex, curve: curve(), angle_deg });
            }
        }
        if let Some(wanted) = missed.curvature {
            let bend = found.jet.normal_curvature(found.normal, found.normal.cross(along));
            // At a meeting point the surface is flat but for what is special there.
            let difference = (bend.filter(|bend| bend.is_finite()).unwrap_or(0.0) - wanted).abs();
            if difference * mesh.size() > CURVATURE_TOLERANCE {
                warnings.push(NetworkWarning::CrossCurvatureMissed { vertex, curve: curve(), difference });
            }
        }
    }
    warnings
}
