//! A cage under construction: vertices are made once and named by their ids, so that nothing is ever welded
//! by looking at positions.
//!
//! A *ring* is a closed list of vertex ids. Seen from where the surface is going next it runs
//! counter-clockwise, so that faces come out facing outward.

use std::collections::HashSet;

use ogee::{ControlMesh, Corner, Crease, FaceList, Sharpness, Vec3};

/// Sharpness that never fades.
pub(super) const SHARP: f64 = 10.0;

/// Vertices, faces and tags that may still change.
#[derive(Clone, Debug, Default)]
pub(super) struct Builder {
    points: Vec<Vec3>,
    faces: Vec<Vec<u32>>,
    creases: Vec<Crease>,
    corners: Vec<Corner>,
}

impl Builder {
    /// Adds a vertex.
    pub(super) fn point(&mut self, p: Vec3) -> u32 {
        self.points.push(p);
        self.points.len() as u32 - 1
    }

    /// Adds several vertices.
    pub(super) fn points(&mut self, points: impl IntoIterator<Item = Vec3>) -> Vec<u32> {
        points.into_iter().map(|p| self.point(p)).collect()
    }

    /// Where a vertex is.
    pub(super) fn at(&self, v: u32) -> Vec3 {
        self.points[v as usize]
    }

    /// The middle of some vertices.
    pub(super) fn centre(&self, vertices: &[u32]) -> Vec3 {
        vertices.iter().fold(Vec3::ZERO, |sum, &v| sum + self.at(v)) / vertices.len() as f64
    }

    /// Adds a face.
    pub(super) fn face(&mut self, corners: &[u32]) {
        self.faces.push(corners.to_vec());
    }

    /// Moves all points by `f`.
    pub(super) fn deform(&mut self, f: impl Fn(Vec3) -> Vec3) {
        for p in &mut self.points {
            *p = f(*p);
        }
    }

    /// Quads from a ring to the next one.
    pub(super) fn bridge(&mut self, from: &[u32], to: &[u32]) {
        assert_eq!(from.len(), to.len(), "rings of equal length");
        for i in 0..from.len() {
            let j = (i + 1) % from.len();
            self.face(&[from[i], from[j], to[j], to[i]]);
        }
    }

    /// Quads between rows of equal length; seen from outside a row runs to the right, the next lies above it.
    pub(super) fn sheet(&mut self, rows: &[Vec<u32>]) {
        for pair in rows.windows(2) {
            for i in 1..pair[0].len() {
                self.face(&[pair[0][i - 1], pair[0][i], pair[1][i], pair[1][i - 1]]);
            }
        }
    }

    /// Quads through a row of rings.
    pub(super) fn loft(&mut self, rings: &[Vec<u32>]) {
        for pair in rings.windows(2) {
            self.bridge(&pair[0], &pair[1]);
        }
    }

    /// A turned solid: quads through all rings, the first and the last closed by grids so many quads wide.
    /// Returns the new vertices of the last one.
    pub(super) fn turn(&mut self, rings: &[Vec<u32>], columns: usize) -> Vec<u32> {
        self.loft(rings);
        let first: Vec<u32> = rings[0].iter().rev().copied().collect();
        self.cap_grid(&first, columns);
        self.cap_grid(&rings[rings.len() - 1], columns)
    }

    /// Closes a ring by a grid of quads, `columns` wide from its first vertex on, spread evenly between the
    /// sides. Returns the new vertices, row by row.
    pub(super) fn cap_grid(&mut self, ring: &[u32], columns: usize) -> Vec<u32> {
        let rows = ring.len() / 2 - columns;
        let id = |k: usize| ring[k % ring.len()];
        let (low, right) = (|i: usize| id(i), |j: usize| id(columns + j));
        let (high, left) = (|i: usize| id(2 * columns + rows - i), |j: usize| id(ring.len() - j));
        let mut grid = vec![vec![0; columns + 1]; rows + 1];
        let mut made = Vec::new();
        for j in 0..=rows {
            for i in 0..=columns {
                grid[j][i] = match (i, j) {
                    (_, 0) => low(i),
                    (_, j) if j == rows => high(i),
                    (0, _) => left(j),
                    (i, _) if i == columns => right(j),
                    _ => {
                        let (u, v) = (i as f64 / columns as f64, j as f64 / rows as f64);
                        // Coons: both ruled surfaces less the bilinear one.
                        let p = self.at(low(i)).lerp(self.at(high(i)), v)
                            + self.at(left(j)).lerp(self.at(right(j)), u)
                            - self
                                .at(id(0))
                                .lerp(self.at(right(0)), u)
                                .lerp(self.at(left(rows)).lerp(self.at(right(rows)), u), v);
                        let v = self.point(p);
                        made.push(v);
                        v
                    }
                };
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                self.face(&[grid[j][i], grid[j][i + 1], grid[j + 1][i + 1], grid[j + 1][i]]);
            }
        }
        made
    }

    /// Takes out the face with these corners and returns its ring as the face ran.
    pub(super) fn take_face(&mut self, corners: &[u32]) -> Vec<u32> {
        let is_it = |face: &Vec<u32>| face.len() == corners.len() && corners.iter().all(|v| face.contains(v));
        let f = self.faces.iter().position(is_it).expect("a face with these corners");
        self.faces.remove(f)
    }

    /// Takes out the faces around an inner vertex and returns the ring that is left, as the faces ran.
    pub(super) fn punch(&mut self, vertex: u32) -> Vec<u32> {
        let (fan, rest): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.faces).into_iter().partition(|face| face.contains(&vertex));
        self.faces = rest;
        // From each face the corners after the vertex, up to where the next face takes over.
        let chains: Vec<Vec<u32>> = fan
            .iter()
            .map(|face| {
                let k = face.iter().position(|&v| v == vertex).unwrap_or(0);
                (1..face.len()).map(|i| face[(k + i) % face.len()]).collect()
            })
            .collect();
        let mut ring = chains[0].clone();
        while ring.last() != ring.first() {
            let next = chains.iter().find(|chain| chain.first() == ring.last());
            ring.extend(&next.expect("a closed fan")[1..]);
        }
        ring.pop();
        ring
    }

    /// Gives a surface with boundary a thickness: a second layer, moved from the first by `offset` of position
    /// and unit normal and facing the other way, and quads along the boundary. Returns where the second layer's
    /// vertices begin: vertex `v` of the first has number `v` more there.
    pub(super) fn thicken(&mut self, offset: impl Fn(Vec3, Vec3) -> Vec3) -> u32 {
        let layer = self.points.len() as u32;
        let mut normals = vec![Vec3::ZERO; self.points.len()];
        for face in &self.faces {
            for k in 0..face.len() {
                let [a, b, c] = [0, 1, 2].map(|i| self.at(face[(k + i) % face.len()]));
                normals[face[(k + 1) % face.len()] as usize] += (b - a).cross(c - b);
            }
        }
        for (v, normal) in normals.into_iter().enumerate() {
            let p = self.points[v];
            self.points.push(p + offset(p, normal.normalized().unwrap_or(Vec3::ZERO)));
        }
        let sides = |face: &Vec<u32>| -> Vec<(u32, u32)> {
            (0..face.len()).map(|k| (face[k], face[(k + 1) % face.len()])).collect()
        };
        let known: HashSet<(u32, u32)> = self.faces.iter().flat_map(sides).collect();
        for face in self.faces.clone() {
            self.faces.push(face.iter().rev().map(|v| v + layer).collect());
            for (a, b) in sides(&face).into_iter().filter(|&(a, b)| !known.contains(&(b, a))) {
                self.face(&[b, a, a + layer, b + layer]);
            }
        }
        layer
    }

    /// Adds the image of everything at the plane `x = 0`. Vertices that were put exactly on the plane are their
    /// own images; returns the image of every vertex.
    pub(super) fn mirror(&mut self) -> Vec<u32> {
        let image: Vec<u32> = (0..self.points.len() as u32)
            .map(|v| match self.at(v) {
                p if p.x == 0.0 => v,
                p => self.point(Vec3::new(-p.x, p.y, p.z)),
            })
            .collect();
        for face in self.faces.clone() {
            self.faces.push(face.iter().rev().map(|&v| image[v as usize]).collect());
        }
        for crease in self.creases.clone() {
            let vertices = crease.vertices.map(|v| image[v as usize]);
            if vertices != crease.vertices {
                self.creases.push(Crease { vertices, sharpness: crease.sharpness });
            }
        }
        for corner in self.corners.clone() {
            let vertex = image[corner.vertex as usize];
            if vertex != corner.vertex {
                self.corners.push(Corner { vertex, sharpness: corner.sharpness });
            }
        }
        image
    }

    /// Tags the edges of a chain of vertices.
    pub(super) fn crease_path(&mut self, path: &[u32], sharpness: f64) {
        for pair in path.windows(2) {
            let sharpness = Sharpness::from_value(sharpness);
            self.creases.push(Crease { vertices: [pair[0], pair[1]], sharpness });
        }
    }

    /// Tags the edges of a ring.
    pub(super) fn crease_ring(&mut self, ring: &[u32], sharpness: f64) {
        self.crease_path(ring, sharpness);
        self.crease_path(&[ring[ring.len() - 1], ring[0]], sharpness);
    }

    /// Tags a vertex.
    pub(super) fn corner(&mut self, vertex: u32, sharpness: f64) {
        self.corners.push(Corner { vertex, sharpness: Sharpness::from_value(sharpness) });
    }

    /// The cage: unused vertices dropped, coordinates rounded to a tenth of a micrometre.
    pub(super) fn finish(self) -> ControlMesh {
        let mut number = vec![u32::MAX; self.points.len()];
        let mut mesh = ControlMesh::default();
        for &v in self.faces.iter().flatten() {
            number[v as usize] = 0;
        }
        for (v, n) in number.iter_mut().enumerate().filter(|(_, n)| **n == 0) {
            *n = mesh.points.len() as u32;
            let p = self.points[v];
            mesh.points.push(Vec3::new(round(p.x), round(p.y), round(p.z)));
        }
        mesh.faces = FaceList::with_capacity(self.faces.len(), 4 * self.faces.len());
        for face in &self.faces {
            mesh.faces.push(&face.iter().map(|&v| number[v as usize]).collect::<Vec<u32>>());
        }
        let renumber = |crease: Crease| Crease {
            vertices: crease.vertices.map(|v| number[v as usize]),
            sharpness: crease.sharpness,
        };
        mesh.creases = self.creases.into_iter().map(renumber).collect();
        mesh.corners = self
            .corners
            .into_iter()
            .map(|corner| Corner { vertex: number[corner.vertex as usize], sharpness: corner.sharpness })
            .collect();
        mesh
    }
}

/// To a tenth of a micrometre, and never a negative zero.
fn round(x: f64) -> f64 {
    (x * 1e4).round() / 1e4 + 0.0
}
