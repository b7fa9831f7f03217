//! A right hand.

use ogee::Vec3;

use super::builder::Builder;
use super::{Form, Model};

/// The arm and the palm up to the knuckles: height, left edge, right edge, half the thickness, how much the
/// palm is hollowed.
const PALM: [[f64; 5]; 8] = [
    [-58.0, -31.0, 30.0, 22.0, 0.0],
    [-52.0, -31.0, 30.0, 22.0, 0.0],
    [-20.0, -29.5, 29.0, 20.5, 0.0],
    [6.0, -31.0, 31.0, 20.0, 0.0],
    [28.0, -39.0, 37.0, 21.0, 1.5],
    [54.0, -44.0, 43.0, 20.0, 4.0],
    [80.0, -46.5, 45.5, 17.0, 4.0],
    [100.0, -47.0, 46.0, 13.5, 1.0],
];
/// Heights of the five lines of the last ring above its own.
const KNUCKLES: [f64; 5] = [-12.0, -3.0, 3.0, 4.0, -3.0];
/// Little, ring, middle, index finger: length, scale of its thickness, lean towards the thumb, curl.
const FINGERS: [[f64; 4]; 4] = [
    [62.0, 0.86, -0.20, 0.34],
    [80.0, 0.97, -0.075, 0.26],
    [87.0, 1.0, 0.015, 0.20],
    [78.0, 0.98, 0.10, 0.16],
];
/// Pieces of a finger: where each ends, as a part of the length; half its width and thickness there; its part
/// of the bending.
const FINGER: [[f64; 4]; 8] = [
    [0.12, 9.6, 10.0, 0.1],
    [0.30, 9.4, 9.6, 0.1],
    [0.47, 9.8, 9.6, 0.35],
    [0.58, 9.3, 8.9, 0.35],
    [0.74, 9.0, 8.3, 0.25],
    [0.86, 8.8, 8.0, 0.15],
    [0.96, 7.4, 6.4, 0.05],
    [1.0, 3.6, 3.0, 0.0],
];
/// Pieces of the thumb, likewise.
const THUMB: [[f64; 4]; 8] = [
    [0.13, 14.0, 14.5, 0.25],
    [0.32, 12.0, 12.8, 0.45],
    [0.50, 10.6, 10.8, 0.15],
    [0.64, 11.0, 10.4, 0.1],
    [0.76, 11.0, 9.6, 0.05],
    [0.88, 10.6, 8.8, 0.0],
    [0.965, 8.4, 6.6, 0.05],
    [1.0, 4.2, 3.2, 0.0],
];

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let rings: Vec<Vec<u32>> = (0..PALM.len()).map(|k| b.points(palm_ring(k))).collect();
    b.loft(&rings);
    let mut under: Vec<u32> = rings[0].iter().rev().copied().collect();
    under.rotate_left(5);
    b.cap_grid(&under, 4);
    b.crease_ring(&rings[0], 2.0);
    let top = &rings[PALM.len() - 1];
    for (i, &[length, scale, lean, curl]) in FINGERS.iter().enumerate() {
        let start = [top[i], top[i + 1], top[8 - i], top[9 - i]];
        let ahead = Vec3::new(lean, -0.06, 1.0);
        limb(&mut b, &start, ahead, Vec3::new(1.0, 0.0, -lean), &FINGER, [length, scale, curl, 0.0]);
    }
    let (low, high) = (&rings[4], &rings[5]);
    let start = b.take_face(&[low[4], low[5], high[5], high[4]]);
    let first = start.iter().position(|&v| v == high[4]).unwrap_or(0);
    let start: Vec<u32> = (0..4).map(|k| start[(first + k) % 4]).collect();
    limb(
        &mut b,
        &start,
        Vec3::new(0.95, -0.36, 0.16),
        Vec3::new(0.16, 0.0, -0.95),
        &THUMB,
        [86.0, 1.0, 0.25, 0.75],
    );
    Model {
        name: "hand",
        about: &[
            "A right hand, 250 high, as shop windows have them to show gloves.",
            "Exercises valences 3 to 6 that touch: between two fingers two vertices of valence 6 share an edge.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}

/// Five points in front from left to right, five behind from right to left.
fn palm_ring(k: usize) -> Vec<Vec3> {
    let [z, left, right, thick, hollow] = PALM[k];
    let last = k == PALM.len() - 1;
    let point = |i: usize, front: bool| {
        let t = i as f64 / 4.0;
        let middle = 1.0 - (2.0 * t - 1.0).powi(2);
        let half = thick * (0.66 + 0.34 * middle);
        // The ball of the thumb, and the heel of the hand across from it.
        let mound = [4.0, 1.0, 0.0, 4.0, 5.0][i] * (1.0 - (z - 40.0).abs() / 40.0).max(0.0);
        let y = if front { hollow * middle - half - mound } else { half + 0.25 * hollow * middle };
        Vec3::new(left + (right - left) * t, y, z + if last { KNUCKLES[i] } else { 0.0 })
    };
    (0..5).map(|i| point(i, true)).chain((0..5).rev().map(|i| point(i, false))).collect()
}

/// A limb from a ring of four (front left, front right, back right, back left, seen with its tip up), curling
/// towards the front and turning to the left as it goes. `size` is its length, a scale, and both angles.
fn limb(b: &mut Builder, start: &[u32], ahead: Vec3, right: Vec3, pieces: &[[f64; 4]], size: [f64; 4]) {
    let [length, scale, curl, lift] = size;
    let mut ahead = ahead.normalized().unwrap_or(Vec3::ZERO);
    let mut right = (right - ahead * right.dot(ahead)).normalized().unwrap_or(Vec3::ZERO);
    let mut middle = b.centre(start);
    let mut reached = 0.0;
    let mut rings = vec![start.to_vec()];
    for &[end, wide, thick, part] in pieces {
        let front = right.cross(ahead);
        let turn: f64 = curl * part;
        ahead = ahead * turn.cos() + front * turn.sin();
        let turn: f64 = lift * part;
        (ahead, right) = (ahead * turn.cos() - right * turn.sin(), right * turn.cos() + ahead * turn.sin());
        middle += ahead * ((end - reached) * length);
        reached = end;
        let front = right.cross(ahead) * (thick * scale);
        let side = right * (wide * scale);
        rings.push(b.points([
            middle + front - side,
            middle + front + side,
            middle - front + side,
            middle - front - side,
        ]));
    }
    b.loft(&rings);
    b.face(&rings[rings.len() - 1]);
}
