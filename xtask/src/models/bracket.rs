//! An angle bracket.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::swell;
use super::{Form, Model};

/// Lines across the bracket; a hole takes two neighbouring columns.
const ACROSS: [f64; 9] = [-46.0, -39.0, -26.0, -13.0, 0.0, 13.0, 26.0, 39.0, 46.0];
/// Lines along the face inside the angle, y and z: down the upright and out along the base.
const ALONG: [[f64; 2]; 15] = [
    [6.0, 76.0],
    [6.0, 70.0],
    [6.0, 61.0],
    [6.0, 50.0],
    [6.0, 39.0],
    [6.0, 28.0],
    [6.0, 17.0],
    [8.0, 8.0],
    [17.0, 6.0],
    [25.0, 6.0],
    [31.0, 6.0],
    [44.0, 6.0],
    [57.0, 6.0],
    [64.0, 6.0],
    [70.0, 6.0],
];
const THICK: f64 = 6.0;
/// Row, column and radius of each hole.
const HOLES: [(usize, usize, f64); 3] = [(3, 4, 6.0), (11, 2, 8.0), (11, 6, 8.0)];

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let rows: Vec<Vec<u32>> =
        ALONG.iter().map(|&[y, z]| b.points(ACROSS.map(|x| Vec3::new(x * narrow(z), y, z)))).collect();
    b.sheet(&rows);
    let rims: Vec<Vec<u32>> = HOLES.iter().map(|&(j, i, radius)| hole(&mut b, rows[j][i], radius)).collect();
    let layer = b.thicken(|_, normal| normal * -THICK);
    let shift = |ring: &[u32]| -> Vec<u32> { ring.iter().map(|v| v + layer).collect() };
    for rim in &rims {
        b.crease_ring(rim, SHARP);
        b.crease_ring(&shift(rim), SHARP);
    }
    let outline = outline(&rows);
    b.crease_ring(&outline, 2.0);
    b.crease_ring(&shift(&outline), 2.0);
    // Where two edges of the outline meet there is one face between them: the third edge is as sharp.
    for row in [&rows[0], &rows[ALONG.len() - 1]] {
        for v in [row[0], row[ACROSS.len() - 1]] {
            b.crease_path(&[v, v + layer], 2.0);
        }
    }
    Model {
        name: "bracket",
        about: &[
            "An angle bracket of sheet metal, 92 x 70 x 76, 6 thick, with three drilled holes.",
            "Exercises three handles, sharp rims of holes and semi-sharp edges outside, valences 3 and 5.",
        ],
        form: Form::Closed { pieces: 1, genus: 3 },
        mesh: b.finish(),
    }
}

/// The upright gets narrower towards its end.
fn narrow(z: f64) -> f64 {
    let t = ((z - 17.0) / 59.0).clamp(0.0, 1.0);
    1.0 - 0.42 * t * t * (3.0 - 2.0 * t)
}

/// Opens the four faces around a vertex and narrows the opening to a circle; returns its rim.
fn hole(b: &mut Builder, centre: u32, radius: f64) -> Vec<u32> {
    let middle = b.at(centre);
    let ring = b.punch(centre);
    let rim: Vec<Vec3> = ring
        .iter()
        .map(|&v| {
            let out = (b.at(v) - middle).normalized().unwrap_or(Vec3::ZERO);
            middle + eighth(out) * (radius * swell(8))
        })
        .collect();
    let rim = b.points(rim);
    b.bridge(&ring, &rim);
    rim
}

/// The nearest direction among those that are multiples of an eighth of a turn from the x axis.
fn eighth(out: Vec3) -> Vec3 {
    let rise = Vec3::new(0.0, out.y, out.z);
    let turns = (rise.length().atan2(out.x) / std::f64::consts::FRAC_PI_4).round();
    let angle = turns * std::f64::consts::FRAC_PI_4;
    Vec3::new(angle.cos(), 0.0, 0.0) + rise.normalized().unwrap_or(Vec3::ZERO) * angle.sin()
}

/// The boundary of a sheet given by rows.
fn outline(rows: &[Vec<u32>]) -> Vec<u32> {
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let inner = &rows[1..rows.len() - 1];
    let right = inner.iter().map(|row| row[row.len() - 1]);
    let left = inner.iter().rev().map(|row| row[0]);
    first.iter().copied().chain(right).chain(last.iter().rev().copied()).chain(left).collect()
}
