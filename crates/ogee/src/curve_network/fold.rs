//! The fold test: does the surface near a meeting point cover the tangent plane once?
//!
//! To first order the surface there is a map of the plane that depends on the tangents and on `t` alone. Instead of
//! evaluating that map, look at turns of its ring; where all of them are positive, the map is one-to-one.

use super::XRing;
use crate::math::Vec3;

/// Of the longest spoke, what is left of vectors that cancel.
const ROUNDING: f64 = 1e-13;

/// The smallest sine among eight families of turns that a ring without folds makes counter-clockwise about `normal`, a unit
/// vector: from each port to the next free spoke and on to the next port, port to corner to free spoke to corner to port, and
/// across ports and free spokes. Where it is positive, the surface does not fold. A vector of no length, but for rounding,
/// turns by nothing.
///
/// The ring is that of [`XRing::eigen`]: other rings of the same tangents make the same surface to first order.
pub fn least_turn(ring: &XRing, normal: Vec3) -> f64 {
    let nothing = ROUNDING * ring.ring.iter().fold(0.0_f64, |longest, spoke| longest.max(spoke.length()));
    let sine = |from: Vec3, to: Vec3| {
        let flat = |v: Vec3| Some(v - normal.dot(v) * normal).filter(|v| v.length() > nothing)?.normalized();
        match (flat(from), flat(to)) {
            (Some(from), Some(to)) => normal.dot(from.cross(to)),
            _ => 0.0,
        }
    };
    let turns = (0..ring.ports()).flat_map(|j| {
        let (port, free, next) = (ring.port(j), ring.free_spoke(j), ring.port(j + 1));
        let (after, before, before_next) =
            (ring.corner_after(j), ring.corner_before(j), ring.corner_before(j + 1));
        [
            sine(port, free),
            sine(free, next),
            sine(port, after - before),
            sine(free, before_next - after),
            sine(port, after),
            sine(after, free),
            sine(free, before_next),
            sine(before_next, next),
        ]
    });
    turns.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const UP: Vec3 = Vec3::new(0.0, 0.0, 1.0);

    fn star(angles: &[f64]) -> Vec<Vec3> {
        angles.iter().map(|a| Vec3::new((TAU * a).cos(), (TAU * a).sin(), 0.0)).collect()
    }

    #[test]
    fn even_stars_do_not_fold_and_reversed_ones_do() {
        let angles: Vec<f64> = (0..5).map(|j| f64::from(j) / 5.0).collect();
        let mut tangents = star(&angles);
        assert!(least_turn(&XRing::eigen(&tangents, 0.25, UP), UP) > 0.1);
        tangents.reverse();
        assert!(least_turn(&XRing::eigen(&tangents, 0.25, UP), UP) < -0.1);
    }

    #[test]
    fn one_half_is_degenerate() {
        let angles: Vec<f64> = (0..3).map(|j| f64::from(j) / 3.0).collect();
        assert!(least_turn(&XRing::eigen(&star(&angles), 0.5, UP), UP).abs() < 1e-15);
    }

    #[test]
    fn two_curves_in_one_direction_have_no_room_between() {
        assert!(least_turn(&XRing::eigen(&star(&[0.0, 0.0, 0.5]), 0.25, UP), UP) <= 0.0);
    }
}
