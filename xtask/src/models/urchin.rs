//! An urchin: fins, domes and buds on a ball.

use std::collections::BTreeMap;

use ogee::Vec3;
use ogee::lens::lattice_index;

use super::builder::Builder;
use super::{Form, Model};

/// Radius of the ball.
const RADIUS: f64 = 30.0;
/// Plots along a side of the cube that was blown up, and quads along a side of a plot.
const PLOTS: u32 = 3;
const QUADS: u32 = 3;
const SIDE: u32 = PLOTS * QUADS;
/// By how much of the radius things stand out in the middle.
const DOME: f64 = 0.3;
const FIN: f64 = 0.42;
const BUD: f64 = 0.12;
/// Edges along the ridge of a fin.
const RIDGE: usize = 4;

/// What stands on a plot.
enum Growth {
    /// A fan of triangles inside three circles of eight.
    Dome,
    /// Two lenses, joined by a slit, inside three circles of eight.
    Fin,
    /// One lens inside three layers of 4, 8 and 12.
    Bud,
    /// The quads of the ball.
    Nothing,
}

pub(super) fn model() -> Model {
    let mut ball = Ball::default();
    for face in 0..6 {
        for plot in 0..PLOTS * PLOTS {
            let (column, row) = (plot % PLOTS, plot / PLOTS);
            let growth = match (column == 1, row == 1) {
                (true, true) => Growth::Dome,
                (true, false) | (false, true) if face < 4 => Growth::Fin,
                (false, false) if face >= 4 => Growth::Bud,
                _ => Growth::Nothing,
            };
            ball.grow(face, [column * QUADS, row * QUADS], &growth);
        }
    }
    Model {
        name: "urchin",
        about: &[
            "A ball with sixteen fins, six domes and eight buds.",
            "Exercises vertices of valence 2, alone and in pairs, and fans of triangles: 40 lenses and 6 poles.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: ball.builder.finish(),
    }
}

#[derive(Default)]
struct Ball {
    builder: Builder,
    /// By the place on the cube, in halves of a quad from its middle: sides share vertices.
    vertices: BTreeMap<[i32; 3], u32>,
}

impl Ball {
    /// A plot of a side of the cube, and what stands on it.
    fn grow(&mut self, face: usize, corner: [u32; 2], growth: &Growth) {
        let width = match growth {
            Growth::Dome | Growth::Fin => 2,
            Growth::Bud => 3,
            Growth::Nothing => 0,
        };
        for (i, j) in (0..QUADS).flat_map(|i| (0..QUADS).map(move |j| (i, j))) {
            if i >= width || j >= width {
                let [a, b] = [corner[0] + i, corner[1] + j];
                let quad = [[a, b], [a + 1, b], [a + 1, b + 1], [a, b + 1]].map(|at| self.vertex(face, at));
                self.builder.face(&quad);
            }
        }
        // Around the block, beginning in the middle of a side where it has one.
        let around = 4 * width;
        let rim: Vec<u32> = (0..around)
            .map(|k| {
                let k = (k + width / 2 * u32::from(width == 2)) % around;
                let (side, along) = (k / width, k % width);
                let [a, b] = match side {
                    0 => [along, 0],
                    1 => [width, along],
                    2 => [width - along, width],
                    _ => [0, width - along],
                };
                self.vertex(face, [corner[0] + a, corner[1] + b])
            })
            .collect();
        match growth {
            Growth::Dome => self.dome(&rim),
            Growth::Fin => self.fin(&rim),
            Growth::Bud => self.bud(&rim),
            Growth::Nothing => {}
        }
    }

    /// The vertex at a point of a side of the cube, in quads.
    fn vertex(&mut self, face: usize, [a, b]: [u32; 2]) -> u32 {
        let half = SIDE as i32;
        let (x, y) = (2 * a as i32 - half, 2 * b as i32 - half);
        let place = match face {
            0 => [x, y, half],
            1 => [y, x, -half],
            2 => [half, x, y],
            3 => [-half, y, x],
            4 => [y, half, x],
            _ => [x, -half, y],
        };
        let builder = &mut self.builder;
        *self.vertices.entry(place).or_insert_with(|| {
            // Equal angles rather than equal lengths: quads on a ball are more alike so.
            let [x, y, z] =
                place.map(|at| (f64::from(at) / f64::from(half) * 0.25 * std::f64::consts::PI).tan());
            builder.point(outward(Vec3::new(x, y, z), 0.0))
        })
    }

    fn dome(&mut self, rim: &[u32]) {
        let middle = self.builder.centre(rim);
        let two = self.circle(rim, |_| middle, 2.0 / 3.0, 0.45 * DOME);
        let one = self.circle(rim, |_| middle, 1.0 / 3.0, 0.9 * DOME);
        let pole = self.builder.point(outward(middle, DOME));
        self.builder.loft(&[rim.to_vec(), two, one.clone()]);
        for k in 0..one.len() {
            self.builder.face(&[one[k], one[(k + 1) % one.len()], pole]);
        }
    }

    fn fin(&mut self, rim: &[u32]) {
        let middle = self.builder.centre(rim);
        let ends = [0, RIDGE].map(|k| self.builder.at(rim[k]));
        let along = |k: usize| {
            let t = k.min(rim.len() - k) as f64 / RIDGE as f64;
            middle + 0.45 * (ends[0].lerp(ends[1], t) - middle)
        };
        let slit: Vec<u32> = (0..=RIDGE)
            .map(|k| {
                let arch = 1.0 - 0.35 * (2.0 * k as f64 / RIDGE as f64 - 1.0).powi(2);
                self.builder.point(outward(along(k), FIN * arch))
            })
            .collect();
        let two = self.circle(rim, along, 0.6, 0.4 * FIN);
        let one = self.circle(rim, along, 0.25, 0.75 * FIN);
        let ridge = (0..rim.len()).map(|k| slit[k.min(rim.len() - k)]).collect();
        self.builder.loft(&[rim.to_vec(), two, one, ridge]);
    }

    fn bud(&mut self, rim: &[u32]) {
        let middle = self.builder.centre(rim);
        let mut net = vec![self.builder.point(outward(middle, BUD))];
        for (layer, height) in [(1, 0.8), (2, 0.4)] {
            for t in 0..4 * layer {
                // Between the points of the rim, which has more of them.
                let place = 3 * t;
                let (k, rest) = (place / layer, f64::from(place % layer) / f64::from(layer));
                let [from, to] = [k, k + 1].map(|k| self.builder.at(rim[k as usize % rim.len()]));
                let p = middle.lerp(from.lerp(to, rest), f64::from(layer) / 3.0);
                net.push(self.builder.point(outward(p, BUD * height)));
            }
        }
        net.extend(rim);
        for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
            let corners = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)];
            self.builder.face(&corners.map(|(i, j)| net[lattice_index(i, j)]));
            self.builder.face(&corners.map(|(i, j)| net[lattice_index(-j, i)]));
        }
    }

    /// A copy of the rim, part of the way from what is in the midst of it, and higher.
    fn circle(&mut self, rim: &[u32], inside: impl Fn(usize) -> Vec3, share: f64, height: f64) -> Vec<u32> {
        let points: Vec<Vec3> =
            (0..rim.len()).map(|k| outward(inside(k).lerp(self.builder.at(rim[k]), share), height)).collect();
        self.builder.points(points)
    }
}

/// The point in the same direction, so much of the radius above the ball.
fn outward(p: Vec3, height: f64) -> Vec3 {
    (RADIUS * (1.0 + height) / p.length()) * p
}
