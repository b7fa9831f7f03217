//! The natural configuration: the fan of faces around one extraordinary vertex, in the plane.
//!
//! Its vertices are those of the subdominant eigenvector of Catmull and Clark's rule, so that refinement only scales the fan. Heights
//! over it are the shapes that caps are compared on.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use ogee::{ControlMesh, FaceId, FaceList, Level, Refinement, Vec3};

/// A fan: the vertex, and for each sector `P10 P11 P20 P21 P12 P22`.
pub(super) struct Fan {
    /// How many sectors.
    pub(super) valence: usize,
    /// The faces at the vertex come first, one a sector, each with the vertex as its first corner.
    pub(super) mesh: ControlMesh,
}

/// A complex number.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

impl Complex {
    fn polar(angle: f64) -> Complex {
        Complex(angle.cos(), angle.sin())
    }

    fn conjugate(self) -> Complex {
        Complex(self.0, -self.1)
    }

    fn times(self, Complex(x, y): Complex) -> Complex {
        Complex(self.0 * x - self.1 * y, self.0 * y + self.1 * x)
    }

    fn plus(self, Complex(x, y): Complex) -> Complex {
        Complex(self.0 + x, self.1 + y)
    }

    fn scaled(self, by: f64) -> Complex {
        Complex(by * self.0, by * self.1)
    }
}

/// The six points of the first sector, edges of length one at the vertex.
fn sector(valence: usize) -> [Complex; 6] {
    let angle = TAU / valence as f64;
    let (cosine, half) = (angle.cos(), (angle / 2.0).cos());
    let kappa = 1.0 + cosine + half * (2.0 * (9.0 + cosine)).sqrt();
    let lambda = (kappa + 4.0) / 16.0;
    let turn = Complex::polar(angle);
    let p11 = Complex::polar(angle / 2.0).scaled(8.0 * half / kappa);
    // 64 lambda x = 36 + 6 x + 12 Re p11 + 2 Re y + 2 cos, 16 lambda y = 6 (1 + p11) + turn + x + y.
    let (a, b) = (64.0 * lambda - 6.0, 16.0 * lambda - 1.0);
    let (first, second) = (36.0 + 12.0 * p11.0 + 2.0 * cosine, 6.0 * (1.0 + p11.0) + turn.0);
    let determinant = a * b - 2.0;
    let x = (first * b + 2.0 * second) / determinant;
    let p21 = Complex((a * second + first) / determinant, (6.0 * p11.1 + turn.1) / b);
    let p12 = turn.times(p21.conjugate());
    let around = Complex(1.0, 0.0).plus(turn).plus(p21).plus(p12).scaled(6.0);
    let ends = Complex(x, 0.0).plus(turn.scaled(x));
    let p22 = p11.scaled(36.0).plus(around).plus(ends).scaled(1.0 / (64.0 * lambda - 1.0));
    [Complex(1.0, 0.0), p11, Complex(x, 0.0), p21, p12, p22]
}

impl Fan {
    /// The configuration with heights over its points, which come in the order of its vertices.
    pub(super) fn new(valence: usize, mut height: impl FnMut(f64, f64) -> f64) -> Fan {
        let own = sector(valence);
        let turned = |k: usize| {
            let turn = Complex::polar(TAU * k as f64 / valence as f64);
            own.map(|point| turn.times(point))
        };
        let plane = std::iter::once(Complex(0.0, 0.0)).chain((0..valence).flat_map(turned));
        let points = plane.map(|Complex(x, y)| Vec3::new(x, y, height(x, y))).collect();
        let corners = |k: usize| {
            let id = |sector: usize, point: usize| (1 + 6 * (sector % valence) + point) as u32;
            let [p10, p11, p20, p21, p12, p22] = [0, 1, 2, 3, 4, 5].map(|point| id(k, point));
            ([p10, p11, p20, p21, p12, p22], [id(k + 1, 0), id(k + 1, 2)])
        };
        let mut faces = FaceList::new();
        for k in 0..valence {
            let ([p10, p11, ..], [next, _]) = corners(k);
            faces.push(&[0, p10, p11, next]);
        }
        for k in 0..valence {
            let ([p10, p11, p20, p21, p12, p22], [next, beyond]) = corners(k);
            faces.push(&[p10, p20, p21, p11]);
            faces.push(&[p11, p21, p22, p12]);
            faces.push(&[next, p11, p12, beyond]);
        }
        Fan { valence, mesh: ControlMesh::new(points, faces) }
    }

    /// The points of the cap at the vertex after some refinements, in the order of its columns.
    pub(super) fn columns(&self, level: u32) -> Result<Vec<Vec3>> {
        if level == 0 {
            return Ok(self.mesh.points.clone());
        }
        let refinement = Refinement::uniform(&Level::new(&self.mesh)?, level)?;
        let points = refinement.apply(&self.mesh.points);
        let mut columns = vec![*points.first().context("a fan has points")?];
        for face in (0..self.valence as u32).map(FaceId) {
            let grid = refinement.grid(face, None);
            let places = [(1, 0), (1, 1), (2, 0), (2, 1), (1, 2), (2, 2)];
            columns.extend(places.map(|at| points[grid[at].index()]));
        }
        Ok(columns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refinement_only_scales_the_fan() {
        for valence in [3, 5, 6, 8, 12] {
            let fan = Fan::new(valence, |_, _| 0.0);
            let refined = fan.columns(1).unwrap();
            let scale = refined[1].length();
            assert!(scale > 0.4 && scale < 0.65);
            for (fine, coarse) in refined.iter().zip(&fan.mesh.points) {
                assert!(fine.distance(scale * *coarse) < 1e-12, "valence {valence}");
            }
        }
    }
}
