//! The body of a car, on its wheels.

use std::f64::consts::TAU;

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::profile::swell;
use super::{Form, Model};

/// Lengthwise places of the wheels, and the sections in between: front is at negative y.
const AXLES: [f64; 2] = [-1320.0, 1320.0];
const SECTIONS: [f64; 23] = [
    -2110.0, -1970.0, -1790.0, -1680.0, -1510.0, -1320.0, -1130.0, -960.0, -850.0, -640.0, -350.0, -20.0,
    320.0, 620.0, 850.0, 960.0, 1130.0, 1320.0, 1510.0, 1680.0, 1790.0, 1970.0, 2110.0,
];
/// The opening for a wheel: y from the axle and z of its edge, over seven sections.
const ARCH: [[f64; 2]; 7] = [
    [-415.0, 190.0],
    [-398.0, 440.0],
    [-268.0, 655.0],
    [0.0, 735.0],
    [268.0, 655.0],
    [398.0, 440.0],
    [415.0, 190.0],
];
/// Curves along the body, y and value: the line over hood, roof and tail; the belt and its half width; the
/// half width below the belt; the lower edge.
const TOP: [[f64; 2]; 15] = [
    [-2110.0, 600.0],
    [-1970.0, 680.0],
    [-1680.0, 775.0],
    [-1320.0, 850.0],
    [-960.0, 905.0],
    [-850.0, 935.0],
    [-640.0, 1045.0],
    [-350.0, 1205.0],
    [-20.0, 1310.0],
    [320.0, 1330.0],
    [850.0, 1255.0],
    [1320.0, 1105.0],
    [1680.0, 990.0],
    [1970.0, 915.0],
    [2110.0, 800.0],
];
const BELT: [[f64; 2]; 9] = [
    [-2110.0, 575.0],
    [-1970.0, 665.0],
    [-1680.0, 790.0],
    [-1320.0, 865.0],
    [-850.0, 880.0],
    [0.0, 890.0],
    [850.0, 935.0],
    [1500.0, 955.0],
    [2110.0, 780.0],
];
const BELT_WIDTH: [[f64; 2]; 9] = [
    [-2110.0, 560.0],
    [-1970.0, 690.0],
    [-1680.0, 775.0],
    [-1320.0, 810.0],
    [-850.0, 795.0],
    [0.0, 790.0],
    [850.0, 815.0],
    [1400.0, 815.0],
    [2110.0, 600.0],
];
const WIDTH: [[f64; 2]; 9] = [
    [-2110.0, 640.0],
    [-1970.0, 790.0],
    [-1680.0, 885.0],
    [-1320.0, 915.0],
    [-850.0, 890.0],
    [0.0, 875.0],
    [850.0, 900.0],
    [1400.0, 925.0],
    [2110.0, 680.0],
];
const SILL: [[f64; 2]; 6] =
    [[-2110.0, 300.0], [-1790.0, 205.0], [-850.0, 190.0], [850.0, 190.0], [1790.0, 215.0], [2110.0, 370.0]];
/// Rows of a half section: floor, inside of the wheel well, lower edge, side, belt, window, roof.
const LIP: usize = 4;
const WINDOW: usize = 8;
const ROWS: usize = 10;
/// The section at the foot of the windscreen.
const COWL: usize = 8;
const WHEEL: f64 = 325.0;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let sections: Vec<Vec<u32>> = (0..SECTIONS.len()).map(|k| b.points(section(k))).collect();
    for pair in sections.windows(2) {
        for j in 0..ROWS {
            b.face(&[pair[0][j], pair[1][j], pair[1][j + 1], pair[0][j + 1]]);
        }
    }
    end(&mut b, &sections[0], -40.0);
    end(&mut b, &sections[SECTIONS.len() - 1], 45.0);
    let line = |row: usize, from: usize, to: usize| -> Vec<u32> {
        sections[from..=to].iter().map(|section| section[row]).collect()
    };
    b.crease_path(&line(LIP, 1, SECTIONS.len() - 2), 2.0);
    b.crease_path(&line(WINDOW, 7, 18), 2.0);
    b.crease_path(&sections[COWL][WINDOW..], 1.0);
    for y in AXLES {
        wheel(&mut b, y);
    }
    b.mirror();
    Model {
        name: "car",
        about: &[
            "A coupe, 4.3 m long, standing on four wheels.",
            "Exercises styling: long smooth flanks, semi-sharp wheel arches and window line, five pieces.",
        ],
        form: Form::Closed { pieces: 5, genus: 0 },
        mesh: b.finish(),
    }
}

/// The points of a half section, from the middle of the floor to the middle of the roof.
fn section(k: usize) -> Vec<Vec3> {
    let y = SECTIONS[k];
    let (top, belt, sill) = (along(&TOP, y), along(&BELT, y), along(&SILL, y));
    let (belt_width, width) = (along(&BELT_WIDTH, y), along(&WIDTH, y));
    let arch = AXLES.iter().zip([2, 14]).find_map(|(axle, first)| {
        let [from, z] = *ARCH.get(k.checked_sub(first)?)?;
        Some([axle + from, z])
    });
    let [lip_y, lip] = arch.unwrap_or([y, sill]);
    let open = lip > 200.0 && arch.is_some();
    let well = if open { lip } else { sill };
    let cabin = ramp(y, -900.0, -330.0) * (1.0 - ramp(y, 900.0, 1750.0));
    let mix = |a: f64, b: f64| a + (b - a) * cabin;
    let window = belt + mix(0.5 * (top - belt), 30.0);
    let rail = belt + mix(0.9 * (top - belt), top - belt - 62.0);
    let narrow = width / 900.0;
    let part = |t: f64, x: f64| Vec3::new(x, lip_y + (y - lip_y) * t, lip + (belt - lip) * t);
    let points = [
        Vec3::new(0.0, y, sill - 15.0),
        Vec3::new(480.0 * narrow, y, sill - 15.0),
        Vec3::new(560.0 * narrow, lip_y, well - 8.0),
        Vec3::new(width - 95.0, lip_y, well - 4.0),
        part(0.0, if open { width + 4.0 } else { width - 30.0 }),
        part(0.34, width),
        part(0.68, width - 8.0),
        Vec3::new(belt_width, y, belt),
        Vec3::new(belt_width * mix(0.74, 0.90), y, window),
        Vec3::new(mix(0.40 * belt_width, 540.0), y, rail),
        Vec3::new(0.0, y, top),
    ];
    points.map(rounded).to_vec()
}

/// Sweeps front and rear back at the sides.
fn rounded(p: Vec3) -> Vec3 {
    let side = (p.x / 900.0).powi(2);
    let back = 330.0 * ramp(-p.y, 1730.0, 2160.0) - 210.0 * ramp(p.y, 1730.0, 2160.0);
    Vec3::new(p.x, p.y + side * back, p.z)
}

/// Closes one end: a strip inside the last section, moved out by `bulge`, and quads to the middle line.
fn end(b: &mut Builder, section: &[u32], bulge: f64) {
    let low = b.at(section[0]);
    let middle = low.lerp(b.at(section[ROWS]), 0.5);
    let inset: Vec<Vec3> = section
        .iter()
        .map(|&v| {
            let p = b.at(v) - middle;
            middle + Vec3::new(0.86 * p.x, p.y + bulge, 0.78 * p.z)
        })
        .collect();
    let inset = b.points(inset);
    let quad = |b: &mut Builder, mut corners: [u32; 4]| {
        if bulge > 0.0 {
            corners.reverse();
        }
        b.face(&corners);
    };
    for j in 0..ROWS {
        quad(b, [section[j], section[j + 1], inset[j + 1], inset[j]]);
    }
    let mut below = inset[0];
    for j in 1..ROWS - 1 {
        let here = if j == ROWS - 2 {
            inset[ROWS]
        } else {
            let t = j as f64 / (ROWS - 2) as f64;
            let p = b.at(inset[0]).lerp(b.at(inset[ROWS]), t);
            b.point(p + Vec3::new(0.0, 0.7 * bulge * (1.0 - (2.0 * t - 1.0).powi(2)), 0.0))
        };
        quad(b, [below, inset[j], inset[j + 1], here]);
        below = here;
    }
}

/// A tyre with a dished rim on the right side of the car.
fn wheel(b: &mut Builder, y: f64) {
    const AROUND: usize = 8;
    // Distance from the middle of the wheel outward, and radius.
    let profile = [
        [-100.0, 150.0],
        [-105.0, 290.0],
        [-80.0, WHEEL],
        [80.0, WHEEL],
        [105.0, 300.0],
        [104.0, 235.0],
        [78.0, 215.0],
        [66.0, 110.0],
        [84.0, 60.0],
    ];
    let rings: Vec<Vec<u32>> = profile
        .iter()
        .map(|&[out, radius]| {
            b.points((0..AROUND).map(|i| {
                let angle = TAU * (i as f64 + 0.5) / AROUND as f64;
                let reach = radius * swell(AROUND);
                Vec3::new(775.0 + out, y + reach * angle.cos(), WHEEL + reach * angle.sin())
            }))
        })
        .collect();
    b.turn(&rings, AROUND / 4);
    b.crease_ring(&rings[5], SHARP);
}

/// A smooth curve through given values.
fn along(curve: &[[f64; 2]], y: f64) -> f64 {
    let slope = |k: usize| {
        let (a, b) = (curve[k.max(1) - 1], curve[(k + 1).min(curve.len() - 1)]);
        (b[1] - a[1]) / (b[0] - a[0])
    };
    let k = curve.iter().rposition(|knot| knot[0] <= y).unwrap_or(0).min(curve.len() - 2);
    let (a, b) = (curve[k], curve[k + 1]);
    let (h, t) = (b[0] - a[0], (y - a[0]) / (b[0] - a[0]));
    let (s, r) = (1.0 - t, t * t * (3.0 - 2.0 * t));
    a[1] * (1.0 - r) + b[1] * r + h * t * s * (s * slope(k) - t * slope(k + 1))
}

/// From 0 before `from` to 1 after `to`, without a bend.
fn ramp(x: f64, from: f64, to: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
