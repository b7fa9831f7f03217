//! The uniform bicubic B-spline.

use crate::math::{SurfaceJet, Vec3};

/// The four basis functions on the unit interval, and their first two derivatives.
fn basis(t: f64) -> [[f64; 4]; 3] {
    let s = 1.0 - t;
    [
        [s * s * s, (3.0 * t - 6.0) * t * t + 4.0, ((3.0 - 3.0 * t) * t + 3.0) * t + 1.0, t * t * t]
            .map(|b| b / 6.0),
        [-s * s, (3.0 * t - 4.0) * t, (2.0 - 3.0 * t) * t + 1.0, t * t].map(|b| b / 2.0),
        [s, 3.0 * t - 2.0, 1.0 - 3.0 * t, t],
    ]
}

/// The surface of 16 points, number `i + 4 j` in column `i` along `s` and row `j` along `t`. Derivatives are with
/// respect to parameters that are `scale` times smaller.
pub(super) fn jet(points: &[Vec3; 16], s: f64, t: f64, scale: f64) -> SurfaceJet {
    let (across, up) = (basis(s), basis(t));
    let sum = |along: usize, over: usize| {
        let mut total = Vec3::ZERO;
        for (row, weight) in points.chunks_exact(4).zip(up[over]) {
            let inner = row.iter().zip(across[along]).fold(Vec3::ZERO, |sum, (&p, b)| sum + b * p);
            total += weight * inner;
        }
        total
    };
    SurfaceJet {
        position: sum(0, 0),
        du: scale * sum(1, 0),
        dv: scale * sum(0, 1),
        duu: scale * scale * sum(2, 0),
        duv: scale * scale * sum(1, 1),
        dvv: scale * scale * sum(0, 2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_of_second_degree_has_its_derivatives() {
        // Control values of x^2 are i^2 - 1/3; of x y, i j.
        let points: [Vec3; 16] = std::array::from_fn(|k| {
            let (i, j) = ((k % 4) as f64 - 1.0, (k / 4) as f64 - 1.0);
            Vec3::new(i * i - 1.0 / 3.0, i * j, j)
        });
        let (s, t) = (0.3, 0.8);
        let jet = jet(&points, s, t, 1.0);
        let wanted = [
            (jet.position, Vec3::new(s * s, s * t, t)),
            (jet.du, Vec3::new(2.0 * s, t, 0.0)),
            (jet.dv, Vec3::new(0.0, s, 1.0)),
            (jet.duu, Vec3::new(2.0, 0.0, 0.0)),
            (jet.duv, Vec3::new(0.0, 1.0, 0.0)),
            (jet.dvv, Vec3::ZERO),
        ];
        for (found, wanted) in wanted {
            assert!(found.distance(wanted) < 1e-15 * 4.0);
        }
    }
}
