//! The shell of a chair.

use ogee::Vec3;

use super::builder::Builder;
use super::{Form, Model};

/// Lines from side to side, as parts of half the width.
const ACROSS: [f64; 9] = [-1.0, -0.94, -0.68, -0.34, 0.0, 0.34, 0.68, 0.94, 1.0];
/// From the front of the seat to the top of the back: y and z of the middle, half the width, how far the
/// sides come forward.
const ALONG: [[f64; 4]; 14] = [
    [-236.0, 414.0, 186.0, 0.0],
    [-230.0, 428.0, 206.0, 2.0],
    [-196.0, 443.0, 226.0, 10.0],
    [-115.0, 442.0, 236.0, 26.0],
    [-20.0, 433.0, 238.0, 40.0],
    [70.0, 432.0, 234.0, 54.0],
    [142.0, 452.0, 226.0, 62.0],
    [182.0, 502.0, 216.0, 60.0],
    [202.0, 572.0, 208.0, 50.0],
    [217.0, 640.0, 203.0, 40.0],
    [232.0, 705.0, 196.0, 31.0],
    [247.0, 765.0, 182.0, 24.0],
    [255.0, 796.0, 164.0, 20.0],
    [258.0, 806.0, 140.0, 16.0],
];
const THICK: f64 = 9.0;
/// The row around which the hand hole lies.
const GRIP: usize = 10;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let rows: Vec<Vec<u32>> = (0..ALONG.len())
        .map(|k| {
            let [y, z, wide, forward] = ALONG[k];
            let [before, after] = [ALONG[k.max(1) - 1], ALONG[(k + 1).min(ALONG.len() - 1)]];
            let along = Vec3::new(0.0, after[0] - before[0], after[1] - before[1]);
            let normal = Vec3::new(1.0, 0.0, 0.0).cross(along).normalized().unwrap_or(Vec3::ZERO);
            b.points(ACROSS.map(|u| Vec3::new(wide * u, y, z) + normal * (forward * u.abs().powf(2.4))))
        })
        .collect();
    b.sheet(&rows);
    let centre = rows[GRIP][ACROSS.len() / 2];
    let middle = b.at(centre);
    let ring = b.punch(centre);
    let rim: Vec<Vec3> = ring
        .iter()
        .map(|&v| {
            let out = b.at(v) - middle;
            middle + Vec3::new(0.92 * out.x, 0.42 * out.y, 0.42 * out.z)
        })
        .collect();
    let rim = b.points(rim);
    b.bridge(&ring, &rim);
    let layer = b.thicken(|_, normal| normal * -THICK);
    b.crease_ring(&rim, 1.0);
    b.crease_ring(&rim.iter().map(|v| v + layer).collect::<Vec<_>>(), 1.0);
    Model {
        name: "chair",
        about: &[
            "The moulded shell of a chair, 470 wide, 9 thick, with a hole in the back to carry it by.",
            "Exercises a thin solid made by thickening a sheet, a handle, rounded free edges.",
        ],
        form: Form::Closed { pieces: 1, genus: 1 },
        mesh: b.finish(),
    }
}
