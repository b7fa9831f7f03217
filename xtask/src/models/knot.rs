//! A rod bent into a trefoil.

use std::f64::consts::TAU;

use ogee::Vec3;

use super::builder::Builder;
use super::profile::swell;
use super::{Form, Model};

/// The torus that the rod winds on: distance of its middle from the axis, and its own radius.
const RADIUS: f64 = 46.0;
const TUBE: f64 = 20.0;
/// Half the width of the rod along the torus and across it.
const WIDE: f64 = 12.5;
const THICK: f64 = 6.5;
const AROUND: usize = 48;
const ACROSS: usize = 8;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let mut rings: Vec<Vec<u32>> = (0..AROUND)
        .map(|i| {
            let t = TAU * i as f64 / AROUND as f64;
            let (centre, out) = on_torus(t);
            let ahead = on_torus(t + 1e-4).0 - on_torus(t - 1e-4).0;
            let side = ahead.cross(out).normalized().unwrap_or(Vec3::ZERO);
            b.points((0..ACROSS).map(|k| {
                let angle = TAU * k as f64 / ACROSS as f64;
                centre + (side * (WIDE * angle.cos()) - out * (THICK * angle.sin())) * swell(ACROSS)
            }))
        })
        .collect();
    rings.push(rings[0].clone());
    b.loft(&rings);
    Model {
        name: "knot",
        about: &[
            "A flat rod closed along a (2, 3) torus knot, 8 quads across and 48 along.",
            "Exercises packing: every vertex has valence 4, so the surface is one bicubic spline.",
        ],
        form: Form::Closed { pieces: 1, genus: 1 },
        mesh: b.finish(),
    }
}

/// A point of the knot, and the normal of the torus there.
fn on_torus(t: f64) -> (Vec3, Vec3) {
    let (a, b) = (2.0 * t, 3.0 * t);
    let out = Vec3::new(b.cos() * a.cos(), b.cos() * a.sin(), b.sin());
    (Vec3::new(a.cos(), a.sin(), 0.0) * RADIUS + out * TUBE, out)
}
