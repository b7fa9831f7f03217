//! A bottle.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::{direction, swell};
use super::{Form, Model};

const AROUND: usize = 16;
/// Half width, half depth, height of each ring, and how far it is higher at the sides than in front.
const PROFILE: [[f64; 4]; 28] = [
    [18.0, 11.0, 4.5, 0.0],
    [28.0, 17.0, 3.0, 0.0],
    [32.0, 20.0, 0.0, 0.0],
    [36.0, 23.0, 0.0, 0.0],
    [38.5, 25.0, 5.0, 0.0],
    [39.0, 25.5, 22.0, 0.0],
    [38.0, 24.8, 50.0, 0.0],
    [36.2, 23.6, 80.0, 0.0],
    [36.4, 23.8, 108.0, 2.0],
    [38.0, 25.0, 130.0, 6.0],
    [38.6, 25.4, 143.0, 9.0],
    [33.0, 22.0, 154.0, 8.0],
    [22.5, 17.5, 164.0, 4.0],
    [14.8, 14.2, 171.0, 1.0],
    [13.0, 13.0, 177.0, 0.0],
    [13.0, 13.0, 186.0, 0.0],
    [15.2, 15.2, 187.0, 0.0],
    [15.2, 15.2, 190.5, 0.0],
    [13.0, 13.0, 191.5, 0.0],
    [13.0, 13.0, 202.0, 0.0],
    [10.6, 10.6, 202.0, 0.0],
    [10.4, 10.4, 190.0, 0.0],
    [10.6, 10.6, 175.0, 0.0],
    [17.0, 13.0, 161.0, 2.0],
    [33.0, 20.5, 140.0, 5.0],
    [33.4, 21.0, 90.0, 0.0],
    [35.0, 22.0, 30.0, 0.0],
    [27.0, 16.0, 9.0, 0.0],
];
/// The foot, the shoulder, the bead under the cap, the mouth.
const CREASES: [(usize, f64); 6] = [(3, 2.0), (10, SHARP), (16, 2.0), (17, 2.0), (19, SHARP), (20, SHARP)];

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let rings: Vec<Vec<u32>> = PROFILE
        .iter()
        .map(|&[wide, deep, z, lift]| {
            b.points((0..AROUND).map(|i| {
                let d = direction((i as f64 - 2.0) / AROUND as f64);
                let out = d * swell(AROUND);
                Vec3::new(out.x * wide, out.y * deep, z + lift * (d.x * d.x - d.y * d.y))
            }))
        })
        .collect();
    b.turn(&rings, AROUND / 4);
    for (ring, sharpness) in CREASES {
        b.crease_ring(&rings[ring], sharpness);
    }
    Model {
        name: "bottle",
        about: &[
            "A bottle for lotion, 202 high: oval below, round at the neck, with a swept edge on its shoulder.",
            "Exercises closed creases that are no plane curves, sharp and semi-sharp, around a thin wall.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}
