//! Two-rings for G2 caps: the natural configuration of each class, and ways to change one.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::Vec3;
use ogee::g2_caps::CapClass;
use std::f64::consts::{PI, TAU};

/// The points of a cap by name.
#[derive(Clone, Debug)]
pub struct Fan {
    pub class: CapClass,
    pub vertex: Vec3,
    /// `P10 P20` of every edge.
    pub edges: Vec<[Vec3; 2]>,
    /// `P11 P21 P12 P22` of every sector.
    pub sectors: Vec<[Vec3; 4]>,
}

/// The angle between neighbouring edges that a class is designed for.
pub fn angle(class: CapClass) -> f64 {
    let faces = class.sectors() as f64;
    match class {
        CapClass::Interior { .. } | CapClass::Dart { .. } => TAU / faces,
        CapClass::Boundary { .. } => PI / faces,
        CapClass::Corner { angle, .. } => angle.radians() / faces,
    }
}

type Complex = [f64; 2];

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn sum(terms: &[(f64, Complex)]) -> Complex {
    terms.iter().fold([0.0, 0.0], |s, (k, z)| [s[0] + k * z[0], s[1] + k * z[1]])
}

impl Fan {
    /// The subdominant eigenvector of Catmull and Clark's matrix, at any real valence.
    pub fn natural(class: CapClass) -> Fan {
        let theta = angle(class);
        let (c, half) = (theta.cos(), (theta / 2.0).cos());
        let kappa = 1.0 + c + half * (2.0 * (9.0 + c)).sqrt();
        let lambda = (kappa + 4.0) / 16.0;
        let turn = |by: f64| -> Complex { [by.cos(), by.sin()] };
        let w = turn(theta);
        let f = turn(theta / 2.0).map(|part| part * 8.0 * half / kappa);
        // 64 l x = 36 + 6 x + 12 Re f + 2 Re y + 2 c and 16 l y = 6 (1 + f) + w + x + y.
        let (a, b) = (64.0 * lambda - 6.0, 16.0 * lambda - 1.0);
        let (right, other) = (36.0 + 12.0 * f[0] + 2.0 * c, 6.0 * (1.0 + f[0]) + w[0]);
        let x = (right * b + 2.0 * other) / (a * b - 2.0);
        let y = [(other + x) / b, (6.0 * f[1] + w[1]) / b];
        let p12 = times(w, [y[0], -y[1]]);
        let rest = sum(&[(6.0, [1.0, 0.0]), (6.0, w), (6.0, y), (6.0, p12)]);
        let far = sum(&[(36.0, f), (1.0, rest), (x, [1.0, 0.0]), (x, w)]);
        let p22 = far.map(|part| part / (64.0 * lambda - 1.0));
        let at = |k: usize, z: Complex| {
            let z = times(turn(theta * k as f64), z);
            Vec3::new(z[0], z[1], 0.0)
        };
        Fan {
            class,
            vertex: Vec3::ZERO,
            edges: (0..class.edges()).map(|k| [at(k, [1.0, 0.0]), at(k, [x, 0.0])]).collect(),
            sectors: (0..class.sectors()).map(|k| [f, y, p12, p22].map(|z| at(k, z))).collect(),
        }
    }

    /// From points in the order of columns.
    pub fn from_columns(class: CapClass, points: &[Vec3]) -> Fan {
        let mut fan = Fan::natural(class);
        let mut points = points.iter();
        fan.in_order().into_iter().for_each(|p| *p = *points.next().unwrap());
        fan
    }

    /// The points in the order of columns.
    pub fn columns(&self) -> Vec<Vec3> {
        self.clone().in_order().into_iter().map(|p| *p).collect()
    }

    fn in_order(&mut self) -> Vec<&mut Vec3> {
        let mut out = vec![&mut self.vertex];
        if let CapClass::Interior { .. } = self.class {
            for ([p10, p20], [p11, p21, p12, p22]) in self.edges.iter_mut().zip(&mut self.sectors) {
                out.extend([p10, p11, p20, p21, p12, p22]);
            }
        } else {
            out.extend(self.edges.iter_mut().flatten());
            out.extend(self.sectors.iter_mut().flatten());
        }
        out
    }

    /// Every point changed.
    pub fn map(mut self, mut f: impl FnMut(Vec3) -> Vec3) -> Fan {
        self.in_order().into_iter().for_each(|p| *p = f(*p));
        self
    }

    /// The same points, counted clockwise: what was the last sector comes first, and each sector's edges change places.
    pub fn mirrored(&self) -> Fan {
        let mut other = self.clone();
        other.edges.reverse();
        other.sectors.reverse();
        if let CapClass::Interior { .. } | CapClass::Dart { .. } = self.class {
            other.edges.rotate_right(1);
        }
        for sector in &mut other.sectors {
            sector.swap(1, 2);
        }
        other
    }

    /// What was edge `by` comes first.
    pub fn turned(&self, by: usize) -> Fan {
        let mut other = self.clone();
        other.edges.rotate_left(by);
        other.sectors.rotate_left(by);
        other
    }

    /// The point at `(u, v)` of a sector's cell, both from -1 to 2 in cells; reflected beyond sharp edges.
    pub fn node(&self, sector: usize, u: i32, v: i32) -> Vec3 {
        let (edges, sectors) = (self.edges.len(), self.sectors.len());
        let closed = matches!(self.class, CapClass::Interior { .. });
        let before = (sector + sectors - 1) % sectors;
        match (u, v) {
            (u, -1) if !closed && sector == 0 => 2.0 * self.node(0, u, 0) - self.node(0, u, 1),
            (-1, v) if !closed && sector + 1 == sectors => {
                2.0 * self.node(sector, 0, v) - self.node(sector, 1, v)
            }
            (0, -1) => self.edges[before][0],
            (1, -1) => self.sectors[before][0],
            (2, -1) => self.sectors[before][2],
            (-1, 0) => self.edges[(sector + 2) % edges][0],
            (-1, 1) => self.sectors[(sector + 1) % sectors][0],
            (-1, 2) => self.sectors[(sector + 1) % sectors][1],
            (0, 0) => self.vertex,
            (u, 0) => self.edges[sector][u as usize - 1],
            (0, v) => self.edges[(sector + 1) % edges][v as usize - 1],
            (u, v) => self.sectors[sector][(u + 2 * v - 3) as usize],
        }
    }
}

/// Value, first and second derivative of a uniform cubic in `[0, 1]` from its four points.
pub fn uniform_cubic(t: f64) -> [[f64; 4]; 3] {
    let r = 1.0 - t;
    [
        [
            r * r * r / 6.0,
            (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (3.0 * r * r * r - 6.0 * r * r + 4.0) / 6.0,
            t * t * t / 6.0,
        ],
        [-r * r / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, -(3.0 * r * r - 4.0 * r) / 2.0, t * t / 2.0],
        [r, 3.0 * t - 2.0, 3.0 * r - 2.0, t],
    ]
}
