//! The hull of a boat.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::{Form, Model};

/// Stations from the transom to the last one before the stem: y, half the beam at the sheer, height of the
/// keel, height of the sheer, and how full the section is (1 a V, 0 a U).
const STATIONS: [[f64; 5]; 10] = [
    [4000.0, 980.0, 60.0, 1180.0, 0.05],
    [3300.0, 1150.0, -70.0, 1140.0, 0.05],
    [2400.0, 1320.0, -220.0, 1105.0, 0.08],
    [1400.0, 1430.0, -330.0, 1090.0, 0.12],
    [400.0, 1460.0, -390.0, 1100.0, 0.18],
    [-600.0, 1400.0, -400.0, 1135.0, 0.28],
    [-1600.0, 1230.0, -375.0, 1195.0, 0.42],
    [-2500.0, 960.0, -320.0, 1275.0, 0.58],
    [-3250.0, 630.0, -235.0, 1365.0, 0.74],
    [-3800.0, 310.0, -120.0, 1445.0, 0.86],
];
/// The stem from above the forefoot to the stem head: y and z.
const STEM: [[f64; 2]; 6] = [
    [-4060.0, 60.0],
    [-4190.0, 330.0],
    [-4300.0, 630.0],
    [-4400.0, 950.0],
    [-4480.0, 1260.0],
    [-4540.0, 1520.0],
];
/// Rows of faces from the keel to the sheer.
const ROWS: usize = 6;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let columns: Vec<Vec<u32>> = STATIONS.iter().map(|station| b.points(section(station))).collect();
    let stem = b.points(STEM.map(|[y, z]| Vec3::new(0.0, y, z)));
    for pair in columns.windows(2) {
        for j in 0..ROWS {
            b.face(&[pair[0][j], pair[0][j + 1], pair[1][j + 1], pair[1][j]]);
        }
    }
    let last = &columns[columns.len() - 1];
    // Keel and stem run into each other past a triangle, so that no vertex of valence 2 is left.
    b.face(&[last[0], last[1], stem[0]]);
    for j in 1..ROWS {
        b.face(&[last[j], last[j + 1], stem[j], stem[j - 1]]);
    }
    transom(&mut b, &columns[0]);
    let keel: Vec<u32> = columns.iter().map(|column| column[0]).chain(stem).collect();
    b.crease_path(&keel, SHARP);
    b.crease_path(&columns[0], SHARP);
    b.mirror();
    Model {
        name: "hull",
        about: &[
            "The shell of a sailing boat, 8.5 m long: round bilges, a raked stem, a flat transom.",
            "Exercises a boundary (the sheer), a creased keel that runs up the stem, creases that meet, triangles.",
        ],
        form: Form::Open,
        mesh: b.finish(),
    }
}

/// One half of a section, from the keel out and up.
fn section(&[y, beam, keel, sheer, sharp]: &[f64; 5]) -> Vec<Vec3> {
    (0..=ROWS)
        .map(|j| {
            let t = j as f64 / ROWS as f64;
            let angle = t * std::f64::consts::FRAC_PI_2;
            // Between an ellipse with a steep side and a straight line that flares.
            let (round_x, round_z) = (angle.sin().powf(0.92), 1.0 - angle.cos().powf(0.95));
            let (line_x, line_z) = (t * (0.72 + 0.28 * t), t);
            let x = round_x * (1.0 - sharp) + line_x * sharp;
            let z = round_z * (1.0 - sharp) + line_z * sharp;
            Vec3::new(if j == 0 { 0.0 } else { beam * x }, y, keel + (sheer - keel) * z)
        })
        .collect()
}

/// Half of the flat stern: a strip inside its edge, then quads to the middle line.
fn transom(b: &mut Builder, edge: &[u32]) {
    let top = b.at(edge[ROWS]).z;
    let middle = |z: f64| Vec3::new(0.0, STATIONS[0][0], z);
    let inset: Vec<Vec3> = edge
        .iter()
        .enumerate()
        .map(|(j, &v)| {
            let p = b.at(v);
            let low = if j == ROWS { top } else { p.z + 0.16 * (top - p.z) };
            Vec3::new(0.84 * p.x, p.y, low)
        })
        .collect();
    let inset = b.points(inset);
    for j in 0..ROWS {
        b.face(&[edge[j], inset[j], inset[j + 1], edge[j + 1]]);
    }
    let mut below = inset[0];
    for j in 1..ROWS {
        let z = if j == ROWS - 1 { top } else { b.at(inset[j + 1]).z };
        let here = b.point(middle(z));
        b.face(&[below, here, inset[j + 1], inset[j]]);
        below = here;
    }
}
