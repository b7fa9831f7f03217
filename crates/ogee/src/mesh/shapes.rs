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

/// A body with a cabin, 8 long, 4 wide and 2 high: 124 quads with eight vertices of valence 3, four of them on the
/// cabin's roof, and four of valence 5 at its foot; front towards negative `x`.
pub fn body() -> ControlMesh {
    const SIDES: [i32; 3] = [8, 4, 2];
    /// The quads of the upper side that the cabin stands on.
    const CABIN: [std::ops::Range<i32>; 2] = [3..7, 1..3];
    let place = |[i, j, k]: [i32; 3]| {
        let (x, y) = (f64::from(i) - 4.0, f64::from(j) - 2.0);
        let (a, b) = (x / 4.0, y / 2.0);
        // Ends are narrower and lower than the middle, sides and ends bulge, and the cabin leans inward.
        let narrow = 1.0 - 0.18 * a * a;
        if k == 3 {
            return Vec3::new(
                0.8 * x + 0.3,
                0.75 * y * narrow,
                2.05 - 0.12 * b * b - 0.1 * (a - 0.1) * (a - 0.1),
            );
        }
        let height = [0.0, 0.7, 1.3 - 0.25 * a * a - 0.16 * b * b + 0.05 * a][k as usize];
        let bulge = [0.94, 1.06, 1.0][k as usize];
        Vec3::new(x * (1.0 - 0.08 * b * b) * (0.5 + 0.5 * bulge), y * narrow * bulge, height)
    };
    let mut numbers = std::collections::BTreeMap::new();
    let mut points = Vec::new();
    let mut faces = FaceList::new();
    let mut quad = |corners: [[i32; 3]; 4]| {
        let ids = corners.map(|corner| {
            *numbers.entry(corner).or_insert_with(|| {
                points.push(place(corner));
                points.len() as u32 - 1
            })
        });
        faces.push(&ids);
    };
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        for i in 0..SIDES[a] {
            for j in 0..SIDES[b] {
                let corner = |level: i32, di: i32, dj: i32| {
                    let mut corner = [0; 3];
                    (corner[axis], corner[a], corner[b]) = (level, i + di, j + dj);
                    corner
                };
                quad([corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)]);
                let top = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(di, dj)| corner(SIDES[axis], di, dj));
                if axis == 2 && CABIN[0].contains(&i) && CABIN[1].contains(&j) {
                    quad(top.map(|[x, y, z]| [x, y, z + 1]));
                } else {
                    quad(top);
                }
            }
        }
    }
    let [along, across] = CABIN;
    let wall = |quad: &mut dyn FnMut([[i32; 3]; 4]), [x0, y0]: [i32; 2], [x1, y1]: [i32; 2]| {
        quad([[x0, y0, 2], [x1, y1, 2], [x1, y1, 3], [x0, y0, 3]]);
    };
    for x in along.clone() {
        wall(&mut quad, [x, across.start], [x + 1, across.start]);
        wall(&mut quad, [x + 1, across.end], [x, across.end]);
    }
    for y in across {
        wall(&mut quad, [along.end, y], [along.end, y + 1]);
        wall(&mut quad, [along.start, y + 1], [along.start, y]);
    }
    ControlMesh::new(points, faces)
}

/// A wing from tip to tip, 12 long, 4 deep and about 0.6 thick: 56 quads in bands of eight around it, closed at each tip by
/// zipping its two sides together. So the ends of both seams are lenses, vertices of valence 2, and all other vertices have
/// valence 4. Vertices 0 and 4 are the lenses of the tip at `z = -6`, the last and the fifth from last those of the other.
pub fn lens() -> ControlMesh {
    const BANDS: u32 = 7;
    const SEAM: u32 = 4;
    const AROUND: u32 = 2 * SEAM;
    let last = SEAM + 1 + (BANDS - 1) * AROUND;
    let id = |band: u32, k: u32| {
        // A seam goes there and back again.
        let on_seam = |k: u32| k.min(AROUND - k);
        match (band, k % AROUND) {
            (0, k) => on_seam(k),
            (BANDS, k) => last + on_seam(k),
            (band, k) => SEAM + 1 + (band - 1) * AROUND + k,
        }
    };
    let mut points = vec![Vec3::ZERO; (last + SEAM + 1) as usize];
    let mut faces = FaceList::new();
    for (band, k) in (0..=BANDS).flat_map(|band| (0..AROUND).map(move |k| (band, k))) {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(AROUND)).sin_cos();
        let along = 2.0 * f64::from(band) / f64::from(BANDS) - 1.0;
        let depth = 2.0 - 1.2 * along * along;
        let is_seam = band == 0 || band == BANDS;
        let thickness = if is_seam { 0.0 } else { 0.2 * depth };
        // Tips are swept back.
        let x = depth * cos - 0.8 * along * along;
        points[id(band, k) as usize] = Vec3::new(x, thickness * sin, 6.0 * along);
        if band < BANDS {
            faces.push(&[id(band, k), id(band, k + 1), id(band + 1, k + 1), id(band + 1, k)]);
        }
    }
    ControlMesh::new(points, faces)
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
