//! Cages with regular and irregular regions of every size, as sculpted models have them: the boundary of a thickened
//! gyroid of voxels, smoothed. All faces are quads, all valences between 3 and 6. The same in every run, to the last
//! bit of the library's sines.

use std::collections::HashSet;
use std::f64::consts::TAU;

use ogee::{ControlMesh, Corner, Crease, Sharpness, Vec3};

use crate::voxels::{Skin, Voxels};

/// A block of voxels, full where `|sin x cos y + sin y cos z + sin z cos x|` is below a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gyroid {
    /// Voxels along each axis.
    pub size: [usize; 3],
    /// Voxels in a period of the sines.
    pub period: f64,
    /// The bound: how thick the wall is.
    pub thickness: f64,
}

/// 1 728 faces.
pub const SMALL: Gyroid = Gyroid { size: [10, 11, 18], period: 12.0, thickness: 0.6 };

/// 106 530 faces.
pub const MEDIUM: Gyroid = Gyroid { size: [50, 50, 53], period: 12.0, thickness: 0.6 };

/// 1 124 884 faces.
pub const LARGE: Gyroid = Gyroid { size: [112, 112, 114], period: 12.0, thickness: 0.6 };

/// 109 034 faces where it is cut open.
pub const OPEN: Gyroid = Gyroid { size: [52, 52, 53], period: 12.0, thickness: 0.6 };

/// Steps of smoothing: steps of stairs become slopes, and no more.
const SMOOTHING: usize = 4;

/// Voxels between planes along which an open cage is creased.
const CREASE_DISTANCE: usize = 16;

/// One vertex in so many is a corner of an open cage.
const CORNER_DISTANCE: usize = 211;

/// Sharpness of creases and corners, in turns: whole, with a fraction, infinite.
const SHARPNESS: [Sharpness; 6] = [
    Sharpness::Finite(0.5),
    Sharpness::Finite(1.0),
    Sharpness::Finite(1.5),
    Sharpness::Finite(2.0),
    Sharpness::Finite(3.0),
    Sharpness::Infinite,
];

impl Gyroid {
    /// The closed cage, without tags.
    pub fn closed(&self) -> ControlMesh {
        let skin = self.voxels().skin(|_, _| false);
        mesh(&skin)
    }

    /// The cage without the faces on the sides of the block, so that it has a boundary; creased along planes, with
    /// corners among its vertices.
    pub fn open(&self) -> ControlMesh {
        let voxels = self.voxels();
        let size = voxels.size();
        let skin = voxels.skin(|axis, plane| plane == 0 || plane == size[axis]);
        let mut mesh = mesh(&skin);
        mesh.creases = creases(&skin);
        let vertices = (0..mesh.points.len()).step_by(CORNER_DISTANCE);
        let sharpness = SHARPNESS.iter().cycle();
        mesh.corners = vertices
            .zip(sharpness)
            .map(|(vertex, &sharpness)| Corner { vertex: vertex as u32, sharpness })
            .collect();
        mesh
    }

    fn voxels(&self) -> Voxels {
        let angle = |at: f64| TAU * at / self.period;
        let mut voxels = Voxels::new(self.size, |at| {
            let [x, y, z] = <[f64; 3]>::from(at).map(angle);
            let value = x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos();
            value.abs() < self.thickness
        });
        voxels.repair();
        voxels
    }
}

/// Where the surface crosses certain planes: edges in a plane that have a face outside of it.
fn creases(skin: &Skin) -> Vec<Crease> {
    let mut seen = HashSet::new();
    let mut creases = Vec::new();
    for face in skin.faces.iter() {
        let corners = [0, 1, 2, 3].map(|k| skin.lattice[face[k] as usize]);
        for k in 0..4 {
            let next = (k + 1) % 4;
            let ends = [face[k].min(face[next]), face[k].max(face[next])];
            for axis in 0..3 {
                let plane = corners[k][axis];
                let is_in_plane = |corner: usize| corners[corner][axis] == plane;
                let crosses = is_in_plane(next) && !(0..4).all(is_in_plane);
                if crosses && plane > 0 && plane % CREASE_DISTANCE == 0 && seen.insert(ends) {
                    // So that three planes an axis have all six.
                    let turn = plane / CREASE_DISTANCE + 2 * axis;
                    creases.push(Crease { vertices: ends, sharpness: SHARPNESS[turn % SHARPNESS.len()] });
                }
            }
        }
    }
    creases
}

/// The mesh of a skin, smoothed: every vertex goes half of the way to the mean of its neighbours, again and again.
fn mesh(skin: &Skin) -> ControlMesh {
    let mut points: Vec<Vec3> =
        skin.lattice.iter().map(|&[x, y, z]| Vec3::new(x as f64, y as f64, z as f64)).collect();
    for _ in 0..SMOOTHING {
        let mut sums = vec![(Vec3::ZERO, 0.0); points.len()];
        for face in skin.faces.iter() {
            for k in 0..4 {
                let sum = &mut sums[face[k] as usize];
                *sum = (
                    sum.0 + points[face[(k + 1) % 4] as usize] + points[face[(k + 3) % 4] as usize],
                    sum.1 + 2.0,
                );
            }
        }
        for (point, (sum, count)) in points.iter_mut().zip(sums) {
            *point = (*point + sum / count) / 2.0;
        }
    }
    ControlMesh::new(points, skin.faces.clone())
}
