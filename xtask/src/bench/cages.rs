//! The cages of the comparison with other programs: always the same, to the last bit of the library's sines.

use std::f64::consts::TAU;

use anyhow::Result;
use ogee::{ControlMesh, FaceId, FaceList, Level, Vec3, shapes};

/// A cage, and what it stands for.
pub(crate) struct BenchCage {
    /// Short, for tables and names of files.
    pub(crate) name: &'static str,
    pub(crate) about: String,
    pub(crate) mesh: ControlMesh,
}

impl BenchCage {
    fn new(name: &'static str, about: &str, mesh: ControlMesh) -> BenchCage {
        let about = format!("{about}, {} quads", mesh.faces.len());
        BenchCage { name, about, mesh }
    }
}

/// All valences 4.
pub(crate) fn regular() -> BenchCage {
    BenchCage::new("regular", "torus, every valence 4", shapes::torus(400, 250))
}

/// One vertex in twenty is extraordinary.
pub(crate) fn mixed() -> BenchCage {
    let mesh = shapes::studded_torus(380, 260, 12);
    BenchCage::new("mixed", "torus with studs, one vertex in twenty of valence 3 or 5", mesh)
}

/// Every face has one extraordinary vertex, of valence 3 or 6.
pub(crate) fn valences_3_and_6() -> Result<BenchCage> {
    let mesh = refined(&rhombille(100, 64))?;
    Ok(BenchCage::new(
        "valences 3, 6",
        "rhombille torus refined once, one vertex of valence 3 or 6 in every quad",
        mesh,
    ))
}

/// Every face has one extraordinary vertex; a quarter of them have valence 5, 6, 7 or 8, the others 3.
pub(crate) fn valences_3_to_8() -> Result<BenchCage> {
    let mesh = refined(&trapezohedra(40))?;
    let about = "trapezohedra refined once, one vertex of valence 5 to 8 in a quarter of the quads and of valence 3 in the others";
    Ok(BenchCage::new("valences 3, 5 to 8", about, mesh))
}

/// The quads of the first level as a cage of their own.
fn refined(mesh: &ControlMesh) -> Result<ControlMesh> {
    let (level, points) = Level::new(mesh)?.refine_points(&mesh.points);
    let topology = level.topology();
    let mut faces = FaceList::new();
    for f in 0..topology.face_count() {
        let corners: Vec<u32> = topology.halfedges(FaceId(f as u32)).map(|h| topology.origin(h).0).collect();
        faces.push(&corners);
    }
    Ok(ControlMesh::new(points, faces))
}

/// A bumpy torus of `3 around across` quads, each with two vertices of valence 6 and two of valence 3: one quad for
/// every edge of a triangular grid, between the edge's ends and the middles of its two triangles.
fn rhombille(around: u32, across: u32) -> ControlMesh {
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    let count = around * across;
    let upper = |i: u32, j: u32| count + at(i, j);
    let lower = |i: u32, j: u32| 2 * count + at(i, j);
    let place = |i: f64, j: f64| {
        let (a, b) = (TAU * i / f64::from(around), TAU * j / f64::from(across));
        let small = 1.0 + 0.1 * (7.0 * a).sin() * (5.0 * b).sin();
        let radius = 3.0 + small * b.cos();
        Vec3::new(radius * a.cos(), radius * a.sin(), small * b.sin())
    };
    let mut points = Vec::with_capacity(3 * count as usize);
    for shift in [0.0, 1.0 / 3.0, 2.0 / 3.0] {
        for i in 0..around {
            points.extend((0..across).map(|j| place(f64::from(i) + shift, f64::from(j) + shift)));
        }
    }
    let mut faces = FaceList::new();
    for i in 0..around {
        for j in 0..across {
            // The triangles before the first are those after the last.
            let (left, below) = (i + around - 1, j + across - 1);
            faces.push(&[at(i, j), lower(i, below), at(i + 1, j), upper(i, j)]);
            faces.push(&[at(i, j), upper(i, j), at(i, j + 1), lower(left, j)]);
            faces.push(&[at(i + 1, j), lower(i, j), at(i, j + 1), upper(i, j)]);
        }
    }
    ControlMesh::new(points, faces)
}

/// A square of `side^2` pieces; a piece is two poles of valence 5, 6, 7 or 8 and a zigzag of valence 3 between them.
fn trapezohedra(side: u32) -> ControlMesh {
    let mut mesh = ControlMesh::default();
    for piece in 0..side * side {
        let n = 5 + piece % 4;
        let middle = Vec3::new(f64::from(piece % side), f64::from(piece / side), 0.0) * 3.0;
        let first = mesh.points.len() as u32;
        let height = 1.0 + 0.2 * f64::from(piece).sin();
        mesh.points.extend([1.0, -1.0].map(|end| middle + Vec3::new(0.0, 0.0, end * height)));
        mesh.points.extend((0..2 * n).map(|k| {
            let angle = TAU * f64::from(k) / f64::from(2 * n);
            let z = if k % 2 == 0 { 0.2 } else { -0.2 };
            middle + Vec3::new(angle.cos(), angle.sin(), z)
        }));
        let around = |k: u32| first + 2 + k % (2 * n);
        for k in (0..2 * n).step_by(2) {
            mesh.faces.push(&[first, around(k), around(k + 1), around(k + 2)]);
            mesh.faces.push(&[first + 1, around(k + 3), around(k + 2), around(k + 1)]);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many vertices of each face are extraordinary, and which valences there are.
    fn extraordinary(mesh: &ControlMesh) -> (Vec<usize>, Vec<u32>) {
        let level = Level::new(mesh).unwrap();
        let topology = level.topology();
        let mut valences = Vec::new();
        let counts = (0..topology.face_count()).map(|f| {
            let corners =
                topology.halfedges(FaceId(f as u32)).map(|h| topology.valence(topology.origin(h)).edges());
            let odd: Vec<u32> = corners.filter(|&valence| valence != 4).collect();
            valences.extend(&odd);
            odd.len()
        });
        let counts = counts.collect();
        valences.sort_unstable();
        valences.dedup();
        (counts, valences)
    }

    #[test]
    fn every_face_has_one_extraordinary_vertex() {
        for (cage, expected) in
            [(valences_3_and_6().unwrap(), vec![3, 6]), (valences_3_to_8().unwrap(), vec![3, 5, 6, 7, 8])]
        {
            let (counts, valences) = extraordinary(&cage.mesh);
            assert!(counts.iter().all(|&count| count == 1), "{}", cage.name);
            assert_eq!(valences, expected, "{}", cage.name);
        }
        assert!(extraordinary(&regular().mesh).1.is_empty());
    }

    #[test]
    fn cages_are_closed_and_turned_outward() {
        for mesh in [rhombille(12, 9), trapezohedra(2)] {
            let level = Level::new(&mesh).unwrap();
            let topology = level.topology();
            assert!(topology.edge_halfedges().all(|h| topology.twin(h).is_some()));
            // Twelve times the volume: both triangulations of every quad.
            let volume: f64 = mesh
                .faces
                .iter()
                .map(|face| {
                    let p = |k: usize| mesh.points[face[k] as usize];
                    let wedge = |a: Vec3, b: Vec3, c: Vec3| a.dot(b.cross(c));
                    wedge(p(0), p(1), p(2))
                        + wedge(p(0), p(2), p(3))
                        + wedge(p(1), p(2), p(3))
                        + wedge(p(1), p(3), p(0))
                })
                .sum();
            assert!(volume > 1.0);
        }
    }
}
