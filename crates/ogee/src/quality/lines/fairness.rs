//! How evenly a line runs: figures by which two designs are compared.

use super::probe::Probe;
use super::{LevelLine, LinePoint};
use crate::math::{Vec3, par};
use crate::quality::{Field, Surface};

/// How evenly a line runs on its surface. Its turning is that within the tangent plane, left or right: what the surface
/// itself turns is not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fairness {
    /// The length of its chords.
    pub length: f64,
    /// By how much it turns in all, left and right alike, in radians.
    pub turning: f64,
    /// How often it changes from turning left to turning right or back.
    pub inflections: usize,
    /// The greatest change of its curvature per length, in one over the square of the unit of the model.
    pub curvature_change: f64,
}

/// Of the line's length: chords shorter than this are taken together, as what they turn by is rounding.
const SHORT: f64 = 1e-3;

/// Turning by less, in radians, is neither left nor right.
const STRAIGHT: f64 = 1e-7;

impl Fairness {
    /// The figures of lines of a field, on all cores.
    pub fn of_all(lines: &[LevelLine], surface: &dyn Surface, field: &Field) -> Vec<Fairness> {
        par::map(lines.len(), |line| Fairness::of(&lines[line], surface, field))
    }

    /// The figures of a line of a field. Directions are those of the line itself, not of its chords.
    pub fn of(line: &LevelLine, surface: &dyn Surface, field: &Field) -> Fairness {
        let length = line.points.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum();
        let steps = directions(&thinned(&line.points, SHORT * length), surface, field);
        let mut bends: Vec<(f64, f64)> = Vec::new();
        for pair in steps.windows(2) {
            let [(p, along_p, normal_p), (q, along_q, normal_q)] = [pair[0], pair[1]];
            let Some(normal) = (normal_p + normal_q).normalized() else { continue };
            // Both directions as the tangent plane between them sees them.
            let flat = |along: Vec3| along - along.dot(normal) * normal;
            let (a, b) = (flat(along_p), flat(along_q));
            bends.push((normal.dot(a.cross(b)).atan2(a.dot(b)), p.distance(q)));
        }
        let mut fairness = Fairness { length, ..Fairness::default() };
        let mut side = 0.0;
        for &(turn, _) in &bends {
            fairness.turning += turn.abs();
            if turn.abs() > STRAIGHT {
                fairness.inflections += usize::from(side * turn < 0.0);
                side = turn.signum();
            }
        }
        for pair in bends.windows(2) {
            let [(a, along_a), (b, along_b)] = [pair[0], pair[1]];
            let change = (b / along_b - a / along_a).abs() / (0.5 * (along_a + along_b));
            fairness.curvature_change = fairness.curvature_change.max(change);
        }
        fairness
    }
}

/// Points at least so far apart; the first is kept, and the last of a closed line.
fn thinned(points: &[LinePoint], apart: f64) -> Vec<LinePoint> {
    let mut kept: Vec<LinePoint> = Vec::new();
    for point in points {
        if kept.last().is_none_or(|last| last.position.distance(point.position) >= apart) {
            kept.push(*point);
        }
    }
    kept
}

/// Position, unit direction of the line and normal at its points, where they exist.
fn directions(points: &[LinePoint], surface: &dyn Surface, field: &Field) -> Vec<(Vec3, Vec3, Vec3)> {
    let mut probe = Probe::new(surface, field);
    let spots = points.iter().map(|point| probe.spot(point.at));
    spots.filter_map(|spot| Some((spot.position, spot.slope?.direction()?, spot.normal))).collect()
}
