//! A hollow bauble.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::circle;
use super::sweep::tube;
use super::{Form, Model};

const AROUND: usize = 12;
/// Radius and height of each ring of the outside, from the drop below to the cap on top.
const OUTSIDE: [[f64; 2]; 15] = [
    [2.5, -58.0],
    [4.5, -54.0],
    [6.5, -47.0],
    [12.0, -39.5],
    [24.0, -32.0],
    [34.0, -20.0],
    [38.5, -4.0],
    [38.5, 6.0],
    [34.0, 22.0],
    [24.0, 33.5],
    [14.0, 39.0],
    [11.5, 40.5],
    [11.5, 47.5],
    [10.0, 49.0],
    [9.0, 49.4],
];
/// Radius and height of each ring of the hollow, from the top to below.
const HOLLOW: [[f64; 2]; 7] =
    [[12.0, 34.5], [22.5, 30.0], [31.5, 20.0], [35.8, 5.5], [35.8, -4.0], [31.5, -18.0], [14.0, -32.5]];
/// The wire loop: x and z of its middle.
const LOOP: [[f64; 2]; 5] = [[-9.5, 57.0], [-8.5, 65.0], [0.0, 70.5], [8.5, 65.0], [9.5, 57.0]];
const WIRE: f64 = 2.6;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let rings = |b: &mut Builder, profile: &[[f64; 2]]| -> Vec<Vec<u32>> {
        profile.iter().map(|&[r, z]| b.points(circle(AROUND, -1.5, r, z))).collect()
    };
    let outside = rings(&mut b, &OUTSIDE);
    let inner = b.turn(&outside, 3);
    let top = &outside[OUTSIDE.len() - 1];
    // Grids run from the first vertex of the ring: the middle faces of two opposite sides.
    let left = [inner[2], inner[3], top[7], top[8]];
    let right = [inner[0], inner[1], top[2], top[1]];
    b.take_face(&left);
    b.take_face(&right);
    let stations = LOOP.map(|[x, z]| (Vec3::new(x, 0.0, z), WIRE, WIRE));
    tube(&mut b, &left, &stations, &right, Vec3::new(0.0, 1.0, 0.0));
    for ring in [11, 12] {
        b.crease_ring(&outside[ring], SHARP);
    }
    let hollow = rings(&mut b, &HOLLOW);
    b.turn(&hollow, 3);
    Model {
        name: "bauble",
        about: &[
            "A hollow glass bauble, 130 high, with a cap and a loop to hang it by.",
            "Exercises a void (a second piece that faces inward), a handle, thin walls.",
        ],
        form: Form::Closed { pieces: 2, genus: 1 },
        mesh: b.finish(),
    }
}
