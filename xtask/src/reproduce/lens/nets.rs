//! The nets on which methods are compared.

use std::f64::consts::FRAC_PI_4;

use ogee::lens::{Quadrant, lattice_index, lattice_point};
use ogee::{ControlMesh, FaceList, Vec3};

use super::sheet::{Light, Look};

/// Edges of the slit between two lenses.
const SLIT: u32 = 4;

/// A net with one or two lenses, what is measured on it, and how it is looked at.
pub(super) struct Example {
    /// Its letter in tables.
    pub(super) letter: char,
    /// What it is.
    pub(super) title: &'static str,
    /// The cage.
    pub(super) mesh: ControlMesh,
    /// True where a point of the surface counts.
    pub(super) is_inside: fn(Vec3) -> bool,
    /// The mean curvature that figures are divided by; none where they are shown as they are.
    pub(super) reference: Option<fn(Vec3) -> f64>,
    /// How it is looked at.
    pub(super) look: Look,
}

/// The height of the elliptic paraboloid that nets (a) and (b) lie on.
fn height(x: f64, y: f64) -> f64 {
    -(x * x / 4.0 + y * y) / 20.0
}

/// Its mean curvature above a point of the plane, for normals that point up.
fn mean_curvature(at: Vec3) -> f64 {
    let (x, y) = (-at.x / 40.0, -at.y / 10.0);
    let (xx, yy) = (-1.0 / 40.0, -1.0 / 10.0);
    ((1.0 + x * x) * yy + (1.0 + y * y) * xx) / (2.0 * (1.0 + x * x + y * y).powf(1.5))
}

/// Net (a): the characteristic net of a lens, lifted to the paraboloid.
pub(super) fn single() -> Example {
    const LAYERS: i32 = 6;
    let count = lattice_index(-LAYERS, 1);
    let points = (0..=count).map(|number| {
        let (i, j) = lattice_point(number);
        let (x, y) = (f64::from(i * i - j * j) / 4.0, f64::from(2 * i * j) / 4.0);
        Vec3::new(x, y, height(x, y))
    });
    let mut faces = FaceList::new();
    for quadrant in Quadrant::BOTH {
        for a in 0..LAYERS {
            for b in 0..LAYERS {
                let corners = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)];
                faces.push(&corners.map(|(a, b)| {
                    let (i, j) = quadrant.point(a, b);
                    lattice_index(i, j) as u32
                }));
            }
        }
    }
    Example {
        letter: 'a',
        title: "a lens on a paraboloid",
        mesh: ControlMesh::new(points.collect(), faces),
        is_inside: |p| p.x * p.x + p.y * p.y < 9.0,
        reference: Some(mean_curvature),
        look: Look {
            from: Vec3::new(0.25, -0.6, 1.0),
            at: Vec3::new(0.0, 0.0, -0.02),
            height: 3.0,
            light: Light::Above { height: 8.0, period: 0.3, across: Vec3::new(1.0, 1.0, 0.0) },
            curvature: 0.14,
        },
    }
}

/// Net (b): the characteristic net of a pair of lenses, lifted to the paraboloid.
pub(super) fn pair() -> Example {
    Example {
        letter: 'b',
        title: "a pair of lenses on that paraboloid",
        mesh: around_slit(5, |x, y| {
            let (angle, radius) = (f64::from(x) * FRAC_PI_4, f64::from(y) * FRAC_PI_4);
            let (x, y) = (radius.cosh() * angle.cos(), radius.sinh() * angle.sin());
            Vec3::new(x, y, height(x, y))
        }),
        is_inside: |p| (p.x / 1.5_f64.cosh()).powi(2) + (p.y / 1.5_f64.sinh()).powi(2) < 1.0,
        reference: Some(mean_curvature),
        look: Look {
            from: Vec3::new(0.25, -0.6, 1.0),
            at: Vec3::new(0.0, 0.0, -0.02),
            height: 4.4,
            light: Light::Above { height: 8.0, period: 0.4, across: Vec3::new(1.0, 1.0, 0.0) },
            curvature: 0.14,
        },
    }
}

/// Net (c): a thin wing tip. Its sections are ellipses; the tip points up.
pub(super) fn tip() -> Example {
    /// Half the chord, half the thickness, and where along the span, by circle.
    const SECTIONS: [[f64; 3]; 6] = [
        [0.33, 0.0, 0.0],
        [0.65, 0.083, -0.08],
        [0.89, 0.15, -0.33],
        [0.96, 0.28, -1.13],
        [0.80, 0.26, -1.90],
        [0.80, 0.26, -2.70],
    ];
    Example {
        letter: 'c',
        title: "a thin wing tip",
        mesh: around_slit(5, |x, y| {
            let [chord, thickness, span] = SECTIONS[y as usize];
            let angle = f64::from(x) * FRAC_PI_4;
            Vec3::new(chord * angle.cos(), thickness * angle.sin(), span)
        }),
        is_inside: |p| p.z > -1.5,
        reference: None,
        look: Look {
            from: Vec3::new(0.5, -0.55, 1.1),
            at: Vec3::new(0.0, 0.0, -0.16),
            height: 1.25,
            light: Light::Around { axis: Vec3::new(0.3, 0.2, 1.0), count: 8.0 },
            curvature: 20.0,
        },
    }
}

/// A slit and circles around it: point `(x, y)` lies in column `x` of circle `y`, the slit being circle 0. Faces are seen
/// counter-clockwise from where columns run counter-clockwise.
fn around_slit(circles: u32, point: impl Fn(u32, u32) -> Vec3) -> ControlMesh {
    let columns = 2 * SLIT;
    let number = |x: u32, y: u32| match y {
        0 => (x % columns).min(columns - x % columns),
        _ => SLIT + 1 + (y - 1) * columns + x % columns,
    };
    let slit = (0..=SLIT).map(|x| (x, 0));
    let rest = (1..=circles).flat_map(|y| (0..columns).map(move |x| (x, y)));
    let points = slit.chain(rest).map(|(x, y)| point(x, y)).collect();
    let mut faces = FaceList::new();
    for y in 0..circles {
        for x in 0..columns {
            let corners = [(x, y), (x, y + 1), (x + 1, y + 1), (x + 1, y)];
            faces.push(&corners.map(|(x, y)| number(x, y)));
        }
    }
    ControlMesh::new(points, faces)
}
