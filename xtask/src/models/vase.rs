//! A fluted vase.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::{direction, swell};
use super::{Form, Model};

/// Every second line along the vase is the edge of a flute.
const AROUND: usize = 24;
/// Radius, height, and how far edges stand out: the outside from the foot to the lip.
const OUTSIDE: [[f64; 3]; 15] = [
    [17.0, 3.0, 0.0],
    [24.0, 2.0, 0.0],
    [28.0, 0.0, 0.0],
    [32.0, 0.0, 0.0],
    [35.0, 5.0, 0.0],
    [39.5, 18.0, 0.8],
    [49.0, 44.0, 2.6],
    [57.0, 74.0, 3.6],
    [59.5, 104.0, 4.0],
    [55.0, 133.0, 3.6],
    [45.0, 158.0, 2.6],
    [36.0, 178.0, 1.6],
    [32.5, 196.0, 0.8],
    [35.0, 213.0, 0.0],
    [40.0, 224.0, 0.0],
];
/// Radius and height of the inside, from the lip to the floor.
const INSIDE: [[f64; 2]; 11] = [
    [39.6, 226.5],
    [37.0, 225.6],
    [31.5, 213.0],
    [28.8, 196.0],
    [31.5, 178.0],
    [39.5, 158.0],
    [50.5, 130.0],
    [54.0, 104.0],
    [48.0, 62.0],
    [34.0, 16.0],
    [22.0, 8.0],
];
/// The rings between which flutes run, and by what part of a full turn they wind.
const FLUTES: std::ops::RangeInclusive<usize> = 5..=12;
const TURN: f64 = 0.26;
const HEIGHT: f64 = 226.0;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let mut ring = |radius: f64, z: f64, stand: f64| {
        let t = z / HEIGHT;
        let wound = TURN * t * t * (3.0 - 2.0 * t);
        b.points((0..AROUND).map(|i| {
            let reach = radius * swell(AROUND) + if i % 2 == 0 { stand } else { -stand };
            direction(i as f64 / AROUND as f64 + wound) * reach + Vec3::new(0.0, 0.0, z)
        }))
    };
    let mut rings: Vec<Vec<u32>> = OUTSIDE.iter().map(|&[r, z, stand]| ring(r, z, stand)).collect();
    rings.extend(INSIDE.iter().map(|&[r, z]| ring(r, z, 0.0)));
    b.turn(&rings, AROUND / 4);
    for i in (0..AROUND).step_by(2) {
        let edge: Vec<u32> = rings[FLUTES].iter().map(|ring| ring[i]).collect();
        b.crease_path(&edge, SHARP);
    }
    b.crease_ring(&rings[3], 2.0);
    Model {
        name: "vase",
        about: &[
            "A vase, 226 high, with twelve flutes that wind around it and fade at both ends.",
            "Exercises darts (sharp creases that end in the smooth) and a semi-sharp foot.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}
