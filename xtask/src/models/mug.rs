//! A mug.

use ogee::Vec3;

use super::builder::Builder;
use super::profile::circle;
use super::sweep::tube;
use super::{Form, Model};

const AROUND: usize = 16;
/// Radius and height of each ring, from the recess under the foot over the lip to the floor inside.
const PROFILE: [[f64; 2]; 22] = [
    [25.0, 3.0],
    [28.5, 2.5],
    [30.5, 0.0],
    [34.5, 0.0],
    [38.5, 4.0],
    [40.5, 12.0],
    [41.2, 24.0],
    [41.5, 38.0],
    [41.5, 52.0],
    [41.5, 66.0],
    [41.5, 80.0],
    [41.8, 91.0],
    [42.0, 96.0],
    [39.8, 97.0],
    [37.8, 95.5],
    [37.4, 90.0],
    [37.4, 70.0],
    [37.3, 45.0],
    [37.0, 22.0],
    [34.5, 10.0],
    [29.0, 6.6],
    [22.0, 6.4],
];
/// The rings below the lower and the upper end of the handle.
const LOWER: usize = 6;
const UPPER: usize = 9;
/// The handle from its upper to its lower end: x and z, half its width, half its thickness.
const HANDLE: [[f64; 4]; 7] = [
    [48.5, 73.6, 8.2, 6.6],
    [58.0, 74.0, 8.0, 5.8],
    [68.0, 69.5, 8.4, 5.4],
    [72.5, 57.0, 8.8, 5.4],
    [69.0, 43.0, 8.4, 5.4],
    [59.5, 33.0, 7.8, 5.8],
    [49.0, 30.6, 7.8, 6.6],
];

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    // Half a step, so that the handle grows from the middle of a face.
    let rings: Vec<Vec<u32>> = PROFILE.iter().map(|&[r, z]| b.points(circle(AROUND, -0.5, r, z))).collect();
    b.turn(&rings, AROUND / 4);
    handle(&mut b, &rings);
    b.crease_ring(&rings[2], 1.0);
    b.crease_ring(&rings[3], 1.0);
    Model {
        name: "mug",
        about: &[
            "A mug, 97 high: a turned body with a foot, and a handle between two of its faces.",
            "Exercises a handle (genus 1), valences 3 and 5, a semi-sharp foot, thin walls.",
        ],
        form: Form::Closed { pieces: 1, genus: 1 },
        mesh: b.finish(),
    }
}

/// Opens the wall twice and leads a tube of four sides from one opening to the other.
fn handle(b: &mut Builder, rings: &[Vec<u32>]) {
    let opening = |k: usize| -> [u32; 4] { [rings[k][0], rings[k][1], rings[k + 1][1], rings[k + 1][0]] };
    let (start, mut end) = (opening(UPPER), opening(LOWER));
    b.take_face(&start);
    b.take_face(&end);
    // The handle turns over on its way down: what was below is above.
    end.reverse();
    let stations = HANDLE.map(|[x, z, wide, thick]| (Vec3::new(x, 0.0, z), wide, thick));
    tube(b, &start, &stations, &end, Vec3::new(0.0, 1.0, 0.0));
}
