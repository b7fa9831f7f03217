//! Closed cages whose extraordinary vertices lie beside one another in all the usual ways.

use std::f64::consts::TAU;

use ogee::{ControlMesh, FaceList, Vec3, shapes};

/// A cage with its name.
pub(super) struct Cage {
    pub(super) name: String,
    pub(super) mesh: ControlMesh,
}

/// All cages, in the order of the table.
pub(super) fn cages() -> Vec<Cage> {
    let cage = |name: &str, mesh| Cage { name: name.to_owned(), mesh };
    let mut cages = vec![cage("cube", shapes::cube())];
    for valence in [5, 6, 7, 8, 10, 12] {
        cages.push(cage(&format!("trapezohedron {valence}"), trapezohedron(valence)));
    }
    for valence in [3, 5, 8] {
        cages.push(cage(&format!("bottle with poles of {valence}"), bottle(valence)));
    }
    let corner: Vec<[i32; 3]> = cells([2, 2, 2]).into_iter().filter(|&cell| cell != [1, 1, 1]).collect();
    let plate: Vec<[i32; 3]> =
        cells([5, 3, 1]).into_iter().filter(|cell| ![[1, 1, 0], [3, 1, 0]].contains(cell)).collect();
    let jack = [[1, 1, 1], [0, 1, 1], [2, 1, 1], [1, 0, 1], [1, 2, 1], [1, 1, 0], [1, 1, 2]];
    cages.push(cage("corner of 7 cells", voxels(&corner)));
    cages.push(cage("plate with two holes", voxels(&plate)));
    cages.push(cage("jack of 7 cells", voxels(&jack)));
    cages
}

fn cells([x, y, z]: [i32; 3]) -> Vec<[i32; 3]> {
    (0..x).flat_map(|i| (0..y).flat_map(move |j| (0..z).map(move |k| [i, j, k]))).collect()
}

/// Two poles of a valence, with a zigzag of vertices of valence 3 between them.
fn trapezohedron(valence: usize) -> ControlMesh {
    let around = 2 * valence;
    let zigzag = (0..around).map(|k| {
        let angle = TAU * k as f64 / around as f64;
        let height = if k % 2 == 0 { 0.25 } else { -0.25 };
        Vec3::new(angle.cos(), angle.sin(), height)
    });
    let poles = [1.0, -1.0].map(|z| Vec3::new(0.0, 0.0, z));
    let points = poles.into_iter().chain(zigzag).collect();
    let id = |k: usize| (2 + k % around) as u32;
    let mut faces = FaceList::new();
    for k in (0..around).step_by(2) {
        // Upper vertices are even: a face hangs from the upper pole around a lower vertex, and the other way round.
        faces.push(&[0, id(k), id(k + 1), id(k + 2)]);
        faces.push(&[1, id(k + 3), id(k + 2), id(k + 1)]);
    }
    ControlMesh::new(points, faces)
}

/// Rings of vertices, closed by a fan of quads at each end.
fn bottle(valence: usize) -> ControlMesh {
    const RINGS: [[f64; 2]; 5] = [[0.7, 0.0], [1.0, 0.9], [0.9, 1.8], [0.5, 2.7], [0.45, 3.4]];
    let around = 2 * valence;
    let mut points = Vec::new();
    for [radius, height] in RINGS {
        points.extend((0..around).map(|k| {
            let angle = TAU * k as f64 / around as f64;
            // Corners of the fans stand out, so that their faces are near to squares.
            let radius = radius * if k % 2 == 1 { 1.05 } else { 0.95 };
            Vec3::new(radius * angle.cos(), radius * angle.sin(), height)
        }));
    }
    let id = |ring: usize, k: usize| (ring * around + k % around) as u32;
    let poles = [points.len() as u32, points.len() as u32 + 1];
    points.extend([0.0, RINGS[4][1]].map(|height| Vec3::new(0.0, 0.0, height)));
    let mut faces = FaceList::new();
    for ring in 0..RINGS.len() - 1 {
        for k in 0..around {
            faces.push(&[id(ring, k), id(ring, k + 1), id(ring + 1, k + 1), id(ring + 1, k)]);
        }
    }
    for k in (0..around).step_by(2) {
        faces.push(&[poles[0], id(0, k + 2), id(0, k + 1), id(0, k)]);
        faces.push(&[poles[1], id(4, k), id(4, k + 1), id(4, k + 2)]);
    }
    ControlMesh::new(points, faces)
}

/// The boundary of unit cells.
fn voxels(filled: &[[i32; 3]]) -> ControlMesh {
    let mut points: Vec<[i32; 3]> = Vec::new();
    let mut faces = FaceList::new();
    for &cell in filled {
        for axis in 0..3 {
            for side in 0..2 {
                let mut neighbour = cell;
                neighbour[axis] += 2 * side - 1;
                if filled.contains(&neighbour) {
                    continue;
                }
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| {
                    let mut point = cell;
                    point[axis] += side;
                    point[a] += i;
                    point[b] += j;
                    points.iter().position(|&other| other == point).unwrap_or_else(|| {
                        points.push(point);
                        points.len() - 1
                    }) as u32
                });
                if side == 0 {
                    corners.reverse();
                }
                faces.push(&corners);
            }
        }
    }
    let points = points.iter().map(|&[x, y, z]| Vec3::new(f64::from(x), f64::from(y), f64::from(z)));
    ControlMesh::new(points.collect(), faces)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use ogee::{Level, VertexId};

    use super::*;

    /// How many vertices have each valence other than 4.
    fn valences(mesh: &ControlMesh) -> Vec<(usize, usize)> {
        let level = Level::new(mesh).unwrap();
        let topology = level.topology();
        let mut found = BTreeMap::new();
        for vertex in (0..topology.vertex_count() as u32).map(VertexId) {
            *found.entry(topology.ring(vertex).count()).or_insert(0) += 1;
        }
        found.remove(&4);
        found.into_iter().collect()
    }

    #[test]
    fn cages_have_the_vertices_they_are_named_for() {
        let found: Vec<(usize, Vec<(usize, usize)>)> =
            cages().iter().map(|cage| (cage.mesh.faces.len(), valences(&cage.mesh))).collect();
        let wanted = [
            (6, vec![(3, 8)]),
            (10, vec![(3, 10), (5, 2)]),
            (12, vec![(3, 12), (6, 2)]),
            (14, vec![(3, 14), (7, 2)]),
            (16, vec![(3, 16), (8, 2)]),
            (20, vec![(3, 20), (10, 2)]),
            (24, vec![(3, 24), (12, 2)]),
            (30, vec![(3, 8)]),
            (50, vec![(3, 10), (5, 2)]),
            (80, vec![(3, 16), (8, 2)]),
            (24, vec![(3, 11), (5, 3)]),
            (50, vec![(3, 8), (5, 16)]),
            (30, vec![(3, 24), (6, 8)]),
        ];
        assert_eq!(found, wanted);
    }
}
