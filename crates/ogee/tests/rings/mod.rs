//! Cages with one extraordinary vertex, and the ring of points that decides a face there.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::{ControlMesh, FaceId, FaceList, HalfedgeId, SurfaceJet, Topology, Vec3, VertexId, shapes};

/// Directions in which the vertex is approached, in the corner frame; the larger coordinate is 1.
pub const DIRECTIONS: [(f64, f64); 7] =
    [(1.0, 1.0), (1.0, 0.5), (0.3, 1.0), (1.0, 0.0), (0.0, 1.0), (0.9, 1.0), (1.0, 0.013)];

/// Numbers in `[-1, 1)` that are always the same.
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Noise {
        Noise(seed)
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A disk of radius about 2 with bumps, moved by `offset`. Face `f` begins at its corner `f % 4`, so that the
/// extraordinary vertex, number 0, is met in every corner frame.
pub fn bumpy_disk(valence: u32, offset: f64, seed: u64) -> ControlMesh {
    let mut mesh = shapes::disk(valence, 2);
    let mut noise = Noise::new(seed);
    // Sideways less than neighbours are apart.
    let aside = 0.5 / f64::from(valence);
    for point in &mut mesh.points {
        let bump = Vec3::new(aside * noise.next(), aside * noise.next(), 0.2 * noise.next());
        *point += bump + offset * Vec3::new(1.0, -0.7, 0.4);
    }
    let turned = mesh.faces.iter().enumerate().map(|(f, face)| {
        let mut face = face.to_vec();
        face.rotate_left(f % 4);
        face
    });
    let mut faces = FaceList::new();
    for face in turned.collect::<Vec<_>>() {
        faces.push(&face);
    }
    mesh.faces = faces;
    mesh
}

/// A face at a vertex: its own number and that of its corner there.
#[derive(Clone, Copy, Debug)]
pub struct CornerFrame {
    pub face: FaceId,
    pub corner: usize,
    pub first: HalfedgeId,
}

impl CornerFrame {
    /// The faces around a vertex.
    pub fn around(topology: &Topology, v: VertexId) -> Vec<CornerFrame> {
        let frame = |first| {
            let face = topology.face(first);
            let corner = topology.halfedges(face).position(|h| h == first).unwrap();
            CornerFrame { face, corner, first }
        };
        topology.ring(v).map(frame).collect()
    }

    /// Parameters of the face for those of the corner, and those of the corner again, rounded alike.
    pub fn parameters(self, (x, y): (f64, f64)) -> ([f64; 2], [f64; 2]) {
        let there_and_back = |x: f64| 1.0 - (1.0 - x);
        let (bx, by) = (there_and_back(x), there_and_back(y));
        match self.corner {
            0 => ([x, y], [x, y]),
            1 => ([1.0 - y, x], [x, by]),
            2 => ([1.0 - x, 1.0 - y], [bx, by]),
            _ => ([y, 1.0 - x], [bx, y]),
        }
    }

    /// Derivatives by the parameters of the face for those by the parameters of the corner.
    pub fn turned(self, jet: SurfaceJet) -> SurfaceJet {
        let SurfaceJet { position, du, dv, duu, duv, dvv } = jet;
        match self.corner {
            0 => jet,
            1 => SurfaceJet { position, du: -dv, dv: du, duu: dvv, duv: -duv, dvv: duu },
            2 => SurfaceJet { position, du: -du, dv: -dv, duu, duv, dvv },
            _ => SurfaceJet { position, du: dv, dv: -du, duu: dvv, duv: -duv, dvv: duu },
        }
    }

    /// The `2 n + 8` vertices that decide the face: the vertex, neighbours and diagonals by turns, and the seven around
    /// the far side.
    pub fn ring(self, topology: &Topology) -> Vec<VertexId> {
        let (next, across) = (|h| topology.next(h), |h| topology.twin(h).unwrap());
        let target = |h| topology.target(h);
        let mut ring = vec![topology.origin(self.first)];
        let mut h = self.first;
        loop {
            ring.extend([target(h), target(next(h))]);
            h = across(topology.prev(h));
            if h == self.first {
                break;
            }
        }
        // Out of neighbour 0, straight on; then around the far corner.
        let out = next(across(next(self.first)));
        let below = next(next(across(out)));
        let corner = next(across(next(next(out))));
        let above = next(next(across(next(next(self.first)))));
        let left = next(across(next(above)));
        ring.extend([
            target(below),
            target(out),
            target(next(out)),
            target(corner),
            target(next(corner)),
            target(above),
            target(left),
        ]);
        ring
    }
}

/// The points of some vertices.
pub fn take(points: &[Vec3], vertices: &[VertexId]) -> Vec<Vec3> {
    vertices.iter().map(|v| points[v.index()]).collect()
}

/// How far apart two jets are: positions; first derivatives against the larger of them, and second ones.
pub fn errors(found: &SurfaceJet, wanted: &SurfaceJet) -> [f64; 3] {
    let relative = |pairs: &[(Vec3, Vec3)]| {
        let size = pairs.iter().fold(0.0_f64, |size, (_, wanted)| size.max(wanted.length()));
        pairs.iter().fold(0.0_f64, |error, (found, wanted)| error.max(found.distance(*wanted))) / size
    };
    [
        found.position.distance(wanted.position),
        relative(&[(found.du, wanted.du), (found.dv, wanted.dv)]),
        relative(&[(found.duu, wanted.duu), (found.duv, wanted.duv), (found.dvv, wanted.dvv)]),
    ]
}

/// Errors with the digits that matter.
pub fn shown(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.1e}")).collect::<Vec<_>>().join(", ")
}
