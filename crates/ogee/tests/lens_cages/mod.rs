//! Cages with lenses and poles.
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::{ControlMesh, FaceList, Vec3};

/// A globe: two fans of `around` triangles with `rings` circles between.
pub fn globe(around: u32, rings: u32) -> ControlMesh {
    let mut points = vec![Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -1.1)];
    for ring in 1..=rings {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings + 1);
        for x in 0..around {
            let angle = std::f64::consts::TAU * f64::from(x) / f64::from(around);
            let wobble = 1.0 + 0.1 * (3.0 * angle).sin();
            points.push(Vec3::new(
                wobble * polar.sin() * angle.cos(),
                0.8 * polar.sin() * angle.sin(),
                polar.cos(),
            ));
        }
    }
    let at = |ring: u32, x: u32| 2 + ring * around + x % around;
    let mut faces = FaceList::new();
    for x in 0..around {
        faces.push(&[0, at(0, x), at(0, x + 1)]);
        faces.push(&[1, at(rings - 1, x + 1), at(rings - 1, x)]);
        for ring in 1..rings {
            faces.push(&[at(ring - 1, x), at(ring, x), at(ring, x + 1), at(ring - 1, x + 1)]);
        }
    }
    ControlMesh::new(points, faces)
}

/// A flat tube whose two ends are slits of `length` edges: four lenses.
pub fn pouch(length: u32, rows: u32) -> ControlMesh {
    let around = 2 * length;
    let mut points = Vec::new();
    for y in 0..=rows {
        let height = f64::from(y) / f64::from(rows) - 0.5;
        let round = 1.0 - (2.0 * height).powi(2);
        for x in 0..around {
            let angle = std::f64::consts::TAU * f64::from(x) / f64::from(around);
            points.push(Vec3::new(
                angle.cos() * (0.6 + 0.6 * round),
                0.7 * angle.sin() * round,
                2.0 * height,
            ));
        }
    }
    let at = |y: u32, x: u32| {
        let x = x % around;
        y * around + if y == 0 || y == rows { x.min(around - x) } else { x }
    };
    let mut faces = FaceList::new();
    for y in 0..rows {
        for x in 0..around {
            faces.push(&[at(y, x), at(y, x + 1), at(y + 1, x + 1), at(y + 1, x)]);
        }
    }
    // Columns that were sewn onto their partners are left out.
    let mut number = vec![u32::MAX; points.len()];
    let mut kept = Vec::new();
    let mut list = FaceList::new();
    for face in faces.iter() {
        let face: Vec<u32> = face
            .iter()
            .map(|&v| {
                if number[v as usize] == u32::MAX {
                    number[v as usize] = kept.len() as u32;
                    kept.push(points[v as usize]);
                }
                number[v as usize]
            })
            .collect();
        list.push(&face);
    }
    ControlMesh::new(kept, list)
}

/// The same cage with a vertex in the middle of some quads, joined to two opposite corners.
pub fn with_doublets(mesh: &ControlMesh, every: usize) -> ControlMesh {
    let mut points = mesh.points.clone();
    let mut faces = FaceList::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        if f % every != 0 || face.len() != 4 {
            faces.push(face);
            continue;
        }
        let middle = face.iter().fold(Vec3::ZERO, |sum, &v| sum + 0.25 * mesh.points[v as usize]);
        let x = points.len() as u32;
        points.push(middle);
        faces.push(&[face[0], face[1], face[2], x]);
        faces.push(&[face[0], x, face[2], face[3]]);
    }
    ControlMesh::new(points, faces)
}
