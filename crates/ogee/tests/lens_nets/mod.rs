//! Cages with lenses and poles, and the golden data about them.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::lens::{Symmetry, lattice_index};
use ogee::{ControlMesh, FaceList, Vec3};
use serde_json::Value;
use std::path::PathBuf;

/// One document of `testdata/lens`.
pub fn document(name: &str) -> Value {
    let mut path = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    path.extend(["..", "..", "testdata", "lens", &format!("{name}.json")]);
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// A number, or a fraction that is written as text.
pub fn exact(value: &Value) -> f64 {
    let Some(text) = value.as_str() else { return value.as_f64().unwrap() };
    let parse = |part: &str| part.parse::<f64>().unwrap();
    text.split_once('/').map_or_else(|| parse(text), |(above, below)| parse(above) / parse(below))
}

/// Points of such numbers.
pub fn exact_points(value: &Value) -> Vec<Vec3> {
    let point = |p: &Value| Vec3::new(exact(&p[0]), exact(&p[1]), exact(&p[2]));
    value.as_array().unwrap().iter().map(point).collect()
}

/// A mesh of given faces, all of whose points are somewhere.
pub fn mesh(faces: FaceList) -> ControlMesh {
    let count = faces.corners().iter().max().unwrap() + 1;
    let point = |v: u32| Vec3::new(f64::from(v), f64::from(v * v % 11), f64::from(v * v % 7));
    ControlMesh::new((0..count).map(point).collect(), faces)
}

/// The w-plane out to `max(|i|, |j|) = layers`, glued.
pub fn single_lens(layers: i32) -> ControlMesh {
    let mut faces = FaceList::new();
    for a in 0..layers {
        for b in 0..layers {
            let corners = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)];
            faces.push(&corners.map(|(i, j)| lattice_index(i, j) as u32));
            faces.push(&corners.map(|(i, j)| lattice_index(-j, i) as u32));
        }
    }
    mesh(faces)
}

/// Two lenses joined by `m` edges, numbered as the golden data have it, with some circles around.
pub fn pair(m: u32, circles: u32) -> ControlMesh {
    let id = |x: u32, y: u32| {
        let x = x % (2 * m);
        if y == 0 { x.min(2 * m - x) } else { m + 1 + (y - 1) * 2 * m + x }
    };
    let mut faces = FaceList::new();
    for y in 0..circles {
        for x in 0..2 * m {
            faces.push(&[id(x, y), id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)]);
        }
    }
    mesh(faces)
}

/// A vertex with `n` triangles, and circles of quads around them.
pub fn fan(n: u32, circles: u32) -> ControlMesh {
    let id = |x: u32, y: u32| if y == 0 { 0 } else { 1 + (y - 1) * n + x % n };
    let mut faces = FaceList::new();
    for x in 0..n {
        faces.push(&[0, id(x, 1), id(x + 1, 1)]);
        for y in 1..circles {
            faces.push(&[id(x, y), id(x, y + 1), id(x + 1, y + 1), id(x + 1, y)]);
        }
    }
    mesh(faces)
}

/// What a symmetry of the grid does in space, to a surface over the plane of `z`.
pub fn mirrored(symmetry: Symmetry, p: Vec3) -> Vec3 {
    match symmetry {
        Symmetry::Identity => p,
        Symmetry::Rotation => Vec3::new(-p.x, -p.y, p.z),
        Symmetry::MirrorX => Vec3::new(-p.x, p.y, p.z),
        Symmetry::MirrorY => Vec3::new(p.x, -p.y, p.z),
    }
}
