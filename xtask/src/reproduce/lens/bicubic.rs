//! The bi-3 net around a lens and its rings, by any rule at the vertex: Catmull and Clark's own too, for which a cage has no name.

use ogee::lens::{BICUBIC_POINTS, Quadrant, lattice_index, lattice_point};
use ogee::nurbs::NurbsSurface;
use ogee::{LensShape, Vec3};

use super::bezier::from_cubic;

/// Catmull and Clark's rule at valence 2.
pub(super) const CATMULL_CLARK: LensShape = LensShape { beta: 0.75, gamma: 0.125 };

/// Points 0 to 24 around a lens.
#[derive(Clone)]
pub(super) struct BicubicNet {
    pub(super) points: [Vec3; BICUBIC_POINTS],
}

impl BicubicNet {
    fn at(&self, i: i32, j: i32) -> Vec3 {
        self.points[lattice_index(i, j)]
    }

    /// One step: the rules of the grid on an even function, but for the lens.
    pub(super) fn step(&self, shape: LensShape) -> BicubicNet {
        let mut points = std::array::from_fn(|number| {
            let (i, j) = lattice_point(number);
            let mut sum = Vec3::ZERO;
            for &(a, weight_a) in &knots_halved(i) {
                for &(b, weight_b) in &knots_halved(j) {
                    sum += weight_a * weight_b * self.at(a, b);
                }
            }
            sum
        });
        let LensShape { beta, gamma } = shape;
        let p = &self.points;
        points[0] =
            (1.0 - beta - gamma) * p[0] + (beta / 2.0) * (p[1] + p[3]) + (gamma / 2.0) * (p[2] + p[4]);
        BicubicNet { points }
    }

    /// The six patches of the ring `1 <= max(u, v) <= 2`.
    pub(super) fn ring(&self) -> Vec<NurbsSurface> {
        let cell = |quadrant: Quadrant, [a, b]: [i32; 2]| {
            from_cubic(|i, j| {
                let (i, j) = quadrant.point(a - 1 + i as i32, b - 1 + j as i32);
                self.at(i, j)
            })
        };
        let cells = [[1, 0], [1, 1], [0, 1]];
        Quadrant::BOTH.into_iter().flat_map(|quadrant| cells.map(|at| cell(quadrant, at))).collect()
    }

    /// The rings from 0 on.
    pub(super) fn rings(&self, shape: LensShape, count: u32) -> Vec<Vec<NurbsSurface>> {
        let nets = std::iter::successors(Some(self.clone()), |net| Some(net.step(shape)));
        nets.take(count as usize).map(|net| net.ring()).collect()
    }
}

/// Old coefficients and weights of a new one of a uniform cubic whose knots are halved.
fn knots_halved(new: i32) -> [(i32, f64); 3] {
    let old = new.div_euclid(2);
    match new.rem_euclid(2) {
        0 => [(old - 1, 0.125), (old, 0.75), (old + 1, 0.125)],
        _ => [(old, 0.5), (old + 1, 0.5), (old, 0.0)],
    }
}
