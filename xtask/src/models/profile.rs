//! Points on circles and other curves that rings are made of.

use std::f64::consts::TAU;

use ogee::Vec3;

/// The unit vector in the plane `z = 0` after a part of a full turn from x towards y.
pub(super) fn direction(turn: f64) -> Vec3 {
    let angle = TAU * turn;
    Vec3::new(angle.cos(), angle.sin(), 0.0)
}

/// How far out the control points of a closed uniform cubic B-spline must lie for its knots to have distance
/// one from the centre: a cage shrinks, and this is the remedy.
pub(super) fn swell(count: usize) -> f64 {
    3.0 / (2.0 + (TAU / count as f64).cos())
}

/// A horizontal circle of `count` points whose limit has the radius given; the first lies `phase` steps from
/// the x axis.
pub(super) fn circle(count: usize, phase: f64, radius: f64, z: f64) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |i| {
        direction((i as f64 + phase) / count as f64) * (radius * swell(count)) + Vec3::new(0.0, 0.0, z)
    })
}
