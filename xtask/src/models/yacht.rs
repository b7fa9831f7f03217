//! The hull of a motor yacht, by its lines.

use ogee::curve_network::{Crossing, CurveNetwork, NetworkCurve, NetworkOptions};
use ogee::{Level, Vec3, limit_vertices};

use super::builder::Builder;
use super::{Form, NetworkModel};

/// Stations from the transom forward: y, half the beam at the sheer, height of the keel.
const KEEL: [[f64; 3]; 9] = [
    [4000.0, 1010.0, -10.0],
    [3100.0, 1200.0, -160.0],
    [2100.0, 1345.0, -290.0],
    [1000.0, 1440.0, -380.0],
    [-100.0, 1450.0, -420.0],
    [-1200.0, 1360.0, -410.0],
    [-2200.0, 1150.0, -350.0],
    [-3050.0, 830.0, -250.0],
    [-3720.0, 440.0, -120.0],
];
/// At the same stations: height of the sheer, and how full the section is (1 a V, 0 a U).
const SHEER: [[f64; 2]; 9] = [
    [1120.0, 0.10],
    [1085.0, 0.10],
    [1065.0, 0.12],
    [1065.0, 0.15],
    [1090.0, 0.20],
    [1145.0, 0.28],
    [1225.0, 0.40],
    [1320.0, 0.54],
    [1415.0, 0.68],
];
/// The stem from the forefoot to the stem head: y and z.
const STEM: [[f64; 2]; 6] = [
    [-4010.0, 90.0],
    [-4140.0, 360.0],
    [-4260.0, 650.0],
    [-4370.0, 950.0],
    [-4465.0, 1245.0],
    [-4540.0, 1530.0],
];
/// Rows of faces from the keel to the sheer.
const ROWS: usize = 6;
/// Rows that are lines of the hull.
const STRAKE: usize = 1;
const WATERLINE: usize = 2;
const KNUCKLE: usize = 4;
/// How often points are moved by what their limits are off.
const STEPS: usize = 40;

pub(super) fn model() -> NetworkModel {
    let mut b = Builder::default();
    let last = KEEL.len() - 1;
    // Columns run from the sheer on starboard under the keel to the sheer on port.
    let columns: Vec<Vec<u32>> = (0..=last).map(|i| b.points(section(i))).collect();
    let stem = b.points(STEM.map(|[y, z]| Vec3::new(0.0, y, z)));
    for pair in columns.windows(2) {
        for j in 0..2 * ROWS {
            b.face(&[pair[0][j], pair[0][j + 1], pair[1][j + 1], pair[1][j]]);
        }
    }
    let bow = &columns[last];
    // Keel and stem run into each other past two triangles, so that no vertex of valence 2 is left.
    b.face(&[bow[ROWS], bow[ROWS + 1], stem[0]]);
    b.face(&[bow[ROWS - 1], bow[ROWS], stem[0]]);
    for j in 1..ROWS {
        b.face(&[bow[ROWS + j], bow[ROWS + j + 1], stem[j], stem[j - 1]]);
        b.face(&[bow[ROWS - j - 1], bow[ROWS - j], stem[j - 1], stem[j]]);
    }
    let mut mesh = b.finish();
    let offsets = mesh.points.clone();

    let row = |j: usize| -> Vec<u32> {
        let port = columns.iter().map(|column| column[ROWS + j]);
        let starboard = columns.iter().rev().map(|column| column[ROWS - j]);
        port.chain([stem[j - 1]]).chain(starboard).collect()
    };
    let keel = columns.iter().map(|column| column[ROWS]).chain(stem.iter().copied()).collect();
    let mut lines = vec![
        ("sheer".to_owned(), row(ROWS)),
        ("transom".to_owned(), columns[0].clone()),
        ("keel".to_owned(), keel),
        ("waterline".to_owned(), row(WATERLINE)),
        ("knuckle".to_owned(), row(KNUCKLE)),
        ("station 2".to_owned(), columns[2].clone()),
        ("station 4".to_owned(), columns[4].clone()),
    ];
    for (side, name) in [(1, "port"), (-1, "starboard")] {
        let at = |column: &Vec<u32>, j: usize| column[ROWS.wrapping_add_signed(side * j as isize)];
        lines.push((format!("frame on {name}"), (KNUCKLE..=ROWS).map(|j| at(&columns[6], j)).collect()));
        lines.push((format!("strake on {name}"), columns[1..=5].iter().map(|c| at(c, STRAKE)).collect()));
    }
    let curve = |(name, vertices): (String, Vec<u32>)| {
        let through = Some(vertices.iter().map(|&v| offsets[v as usize]).collect());
        NetworkCurve { name, vertices, through, ..NetworkCurve::default() }
    };
    let curves = lines.into_iter().map(curve).collect();

    // Between the lines too the surface goes through the offsets.
    let level = Level::new(&mesh).expect("a sound cage");
    for _ in 0..STEPS {
        let limits = limit_vertices(&level, &mesh.points);
        for ((point, limit), &offset) in mesh.points.iter_mut().zip(limits).zip(&offsets) {
            *point += offset - limit.position;
        }
    }
    for p in &mut mesh.points {
        *p = <[f64; 3]>::from(*p).map(|x| (x * 1e4).round() / 1e4 + 0.0).into();
    }
    let options = NetworkOptions {
        crossing: Crossing::Smooth,
        flatten: true,
        fit_mesh: true,
        ..NetworkOptions::default()
    };
    NetworkModel {
        name: "yacht",
        form: Form::Open,
        mesh,
        network: CurveNetwork { curves, options, ..CurveNetwork::default() },
    }
}

/// A section of the hull, from the sheer on starboard to the sheer on port.
fn section(i: usize) -> Vec<Vec3> {
    let ([y, beam, keel], [sheer, sharp]) = (KEEL[i], SHEER[i]);
    let half = |j: usize| {
        let t = j as f64 / ROWS as f64;
        let angle = t * std::f64::consts::FRAC_PI_2;
        // Between an ellipse with a steep side and a straight line that flares.
        let (round_x, round_z) = (angle.sin(), 1.0 - angle.cos());
        let (line_x, line_z) = (t * (0.74 + 0.26 * t), t);
        let x = round_x * (1.0 - sharp) + line_x * sharp;
        let z = round_z * (1.0 - sharp) + line_z * sharp;
        [beam * x, keel + (sheer - keel) * z]
    };
    let round = |x: f64| (x * 1e4).round() / 1e4 + 0.0;
    let point = |sign: f64, j: usize| {
        let [x, z] = half(j);
        Vec3::new(round(sign * x), y, round(z))
    };
    (1..=ROWS).rev().map(|j| point(-1.0, j)).chain((0..=ROWS).map(|j| point(1.0, j))).collect()
}
