//! The knob of a gear lever.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::{direction, swell};
use super::{Form, Model};

const AROUND: usize = 12;
/// Half length, half width and height of each ring: out of the socket, over the collar, up the grip, and into
/// the dish for the badge.
const PROFILE: [[f64; 3]; 20] = [
    [5.0, 5.0, 34.0],
    [6.0, 6.0, 32.0],
    [6.0, 6.0, 18.0],
    [6.0, 6.0, 3.0],
    [7.0, 7.0, 0.0],
    [12.0, 12.0, 0.0],
    [13.4, 13.4, 2.0],
    [13.4, 13.4, 11.0],
    [12.2, 12.2, 13.0],
    [12.8, 12.6, 17.0],
    [15.5, 14.2, 26.0],
    [19.5, 17.2, 37.0],
    [23.5, 20.6, 49.0],
    [25.6, 22.6, 60.0],
    [25.0, 22.3, 70.0],
    [21.4, 19.4, 78.5],
    [16.5, 15.2, 82.6],
    [12.5, 11.6, 83.8],
    [11.7, 10.8, 82.6],
    [7.5, 7.0, 83.0],
];
/// Rings at the ends of the collar and around the dish.
const CREASES: [(usize, f64); 4] = [(5, 2.0), (7, 2.0), (8, SHARP), (17, SHARP)];

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let rings: Vec<Vec<u32>> = PROFILE
        .iter()
        .map(|&[long, wide, z]| {
            b.points((0..AROUND).map(|i| {
                let d = direction((i as f64 - 0.5) / AROUND as f64) * swell(AROUND);
                Vec3::new(d.x * wide, d.y * long, z)
            }))
        })
        .collect();
    b.turn(&rings, AROUND / 4);
    b.deform(shape);
    for (ring, sharpness) in CREASES {
        b.crease_ring(&rings[ring], sharpness);
    }
    Model {
        name: "knob",
        about: &[
            "The knob of a gear lever, 84 high: a leaning egg on a collar, a dish for the badge, a blind socket.",
            "Exercises closed creases, sharp and semi-sharp, and valence 3 in flat caps.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}

/// Above the collar the grip leans back, its top tilts towards the driver, and the palm side is fuller.
fn shape(p: Vec3) -> Vec3 {
    let t = ((p.z - 18.0) / 66.0).clamp(0.0, 1.0);
    let y = p.y - 0.0045 * t * p.y * p.y;
    Vec3::new(p.x, y - 9.0 * t * t, p.z + 0.14 * t * t * p.y)
}
