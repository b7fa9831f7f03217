//! Built-in cages.

use super::{ControlMesh, FaceList};
use crate::math::Vec3;

/// The cube `[-1, 1]^3`: eight vertices of valence 3.
pub fn cube() -> ControlMesh {
    let points = (0..8)
        .map(|i| {
            Vec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 2.0
                - Vec3::new(1.0, 1.0, 1.0)
        })
        .collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    ControlMesh::new(points, faces.into_iter().collect())
}

/// A flat open grid of `columns` x `rows` unit squares in the plane `z = 0`, facing up. Vertex `(i, j)` is number
/// `j (columns + 1) + i`.
pub fn grid(columns: u32, rows: u32) -> ControlMesh {
    let points =
        (0..=rows).flat_map(|j| (0..=columns).map(move |i| Vec3::new(f64::from(i), f64::from(j), 0.0)));
    let faces = (0..rows).flat_map(|j| {
        (0..columns).map(move |i| {
            let a = j * (columns + 1) + i;
            [a, a + 1, a + columns + 2, a + columns + 1]
        })
    });
    ControlMesh::new(points.collect(), faces.collect())
}

/// A torus of `around` x `across` quads, each at least 3, all of valence 4: `around` along the large circle of
/// radius 3, `across` along the small one of radius 1.
pub fn torus(around: u32, across: u32) -> ControlMesh {
    let turn = |i: u32, n: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let points = (0..around).flat_map(|i| {
        (0..across).map(move |j| {
            let (a, b) = (turn(i, around), turn(j, across));
            let radius = 3.0 + b.cos();
            Vec3::new(radius * a.cos(), radius * a.sin(), b.sin())
        })
    });
    let at = move |i: u32, j: u32| (i % around) * across + j % across;
    let faces = (0..around)
        .flat_map(|i| (0..across).map(move |j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    ControlMesh::new(points.collect(), faces.collect())
}

/// A torus of which every `spacing`-th quad, both ways, is drawn out to a block: four vertices of valence 3 and four of
/// valence 5 each. With a spacing of 12 about one vertex in twenty is extraordinary.
pub fn studded_torus(around: u32, across: u32, spacing: u32) -> ControlMesh {
    let smooth = torus(around, across);
    let mut mesh = ControlMesh { points: smooth.points, ..ControlMesh::default() };
    let drawn =
        |f: usize| (f as u32 / across).is_multiple_of(spacing) && (f as u32 % across).is_multiple_of(spacing);
    for (f, face) in smooth.faces.iter().enumerate() {
        if !drawn(f) {
            mesh.faces.push(face);
            continue;
        }
        let p = |k: usize| mesh.points[face[k] as usize];
        let up = (p(2) - p(0)).cross(p(3) - p(1));
        // As high as the quad is wide, more or less.
        let out = up.normalized().unwrap_or(Vec3::ZERO) * up.length().sqrt();
        let first = mesh.points.len() as u32;
        let top: Vec<Vec3> = (0..4).map(|k| p(k) + out).collect();
        mesh.points.extend(top);
        mesh.faces.push(&[first, first + 1, first + 2, first + 3]);
        for k in 0..4 {
            let next = (k + 1) % 4;
            mesh.faces.push(&[face[k], face[next], first + next as u32, first + k as u32]);
        }
    }
    mesh
}

/// An open disk of `rings` rings of quads around one vertex of valence `n`, slightly domed. Vertex 0 is the
/// middle.
pub fn disk(n: u32, rings: u32) -> ControlMesh {
    let sector_size = rings * rings + rings;
    let id = |sector: u32, a: u32, b: u32| {
        // Sector coordinates: `a` along its first spoke, `b` towards the next one, which owns its own line.
        if a == 0 && b == 0 {
            0
        } else if a == 0 {
            1 + (sector + 1) % n * sector_size + (b - 1) * (rings + 1)
        } else {
            1 + sector % n * sector_size + (a - 1) * (rings + 1) + b
        }
    };
    let direction = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        Vec3::new(angle.cos(), angle.sin(), 0.0)
    };
    let mut points = vec![Vec3::ZERO; 1 + (n * sector_size) as usize];
    let mut faces = FaceList::new();
    for sector in 0..n {
        for a in 1..=rings {
            for b in 0..=rings {
                let p = direction(sector) * f64::from(a) + direction(sector + 1) * f64::from(b);
                let height = -0.05 * p.dot(p) / f64::from(rings);
                points[id(sector, a, b) as usize] = p + Vec3::new(0.0, 0.0, height);
            }
        }
        for a in 0..rings {
            for b in 0..rings {
                faces.push(&[
                    id(sector, a, b),
                    id(sector, a + 1, b),
                    id(sector, a + 1, b + 1),
                    id(sector, a, b + 1),
                ]);
            }
        }
    }
    ControlMesh::new(points, faces)
}
