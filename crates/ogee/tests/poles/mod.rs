//! Polar nets for claims about caps and fans.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::lens::{Cap, PolarCap, PolarFaces};
use ogee::nurbs::FaceAddress;
use ogee::{FaceId, Grid, Vec3, VertexId};
use std::f64::consts::TAU;

/// Numbers of sectors that claims are made for.
pub const SECTORS: [usize; 8] = [3, 4, 5, 6, 8, 12, 16, 40];

/// Numbers in `[-1, 1]` that look random and are the same on every machine.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn point(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

/// Circles of radius 1, 2, 3 on a bowl, shaken by `shake`; counter-clockwise seen from above.
pub fn circles(sectors: usize, shake: f64) -> [Vec<Vec3>; 3] {
    let mut numbers = Numbers(sectors as u64);
    [1.0, 2.0, 3.0].map(|radius: f64| {
        let point = |i: usize| {
            let (sine, cosine) = (TAU * i as f64 / sectors as f64).sin_cos();
            let place = Vec3::new(radius * cosine, radius * sine, -radius * radius / 9.0);
            place + shake * numbers.point()
        };
        (0..sectors).map(point).collect()
    })
}

/// Faces of a cap whose circle 2 are the vertices from 0 on, and which replaces the faces from 0 on, circle by circle.
pub fn faces(cap: &PolarCap, faces: PolarFaces) -> Cap {
    let sectors = cap.sectors();
    let circle: Vec<VertexId> = (0..sectors as u32).map(VertexId).collect();
    let replaced = Grid::from_fn(2, sectors, |k, i| FaceAddress::whole(FaceId((k * sectors + i) as u32)));
    cap.faces(&circle, &replaced, faces).unwrap()
}
