//! Closing the ring: the conditions on all spokes of a meeting have a solution only if one vector vanishes.
//!
//! Around a meeting `q_i x_i + p_i x_{i-1} = r_i` is asked of the twists `x_i`. The number of spokes is even and the
//! products of the `p` and of the `q` agree, so the matrix is singular: there is one condition on the right sides, which the
//! smallest change of the free spokes' curves, and of `omega` on the ports, makes true.

use super::cap::Share;
use crate::math::Vec3;

/// What may be changed on a spoke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spread {
    /// The second derivative of its curve at the meeting.
    Bend,
    /// Its curve is given: the slope of `omega`.
    Slope,
}

/// The change of a spoke.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Change {
    pub(super) bend: Vec3,
    pub(super) slope: f64,
}

/// Shares below this one of the largest are not divided by.
const NEGLIGIBLE: f64 = 1e-10;

/// Weights of the right sides in the one condition: the left kernel of the system.
fn condition(shares: &[Share]) -> Vec<f64> {
    // y_i q_i + y_{i+1} p_{i+1} = 0
    let mut weights = vec![1.0];
    for i in 1..shares.len() {
        weights.push(-weights[i - 1] * shares[i - 1].q() / shares[i].p());
    }
    let largest = weights.iter().fold(0.0, |most: f64, weight| most.max(weight.abs()));
    weights.into_iter().map(|weight| weight / largest).collect()
}

/// The smallest changes that make the system for the twists solvable; `right` are its right sides.
pub(super) fn changes(shares: &[Share], tangents: &[Vec3], spread: &[Spread], right: &[Vec3]) -> Vec<Change> {
    let n = shares.len();
    let weights = condition(shares);
    let lack = -right.iter().zip(&weights).fold(Vec3::ZERO, |sum, (&right, &weight)| sum + weight * right);
    let length = tangents.iter().map(|tangent| tangent.length()).sum::<f64>() / n as f64;
    // First along one spoke, then in the tangent plane, then along its normal: where the spokes are almost in one line the
    // later ones are small, and keep their digits so.
    let normal = (0..n).fold(Vec3::ZERO, |sum, i| sum + tangents[i].cross(tangents[(i + 1) % n]));
    let (Some(first), Some(third)) = (tangents[0].normalized(), normal.normalized()) else {
        return vec![Change::default(); n];
    };
    let axes = [first, third.cross(first), third];
    // Four unknowns a spoke: the bend along the axes, and the slope times a length.
    let row = |axis: usize| -> Vec<f64> {
        let of = |i: usize| {
            let mut four = [0.0; 4];
            match spread[i] {
                Spread::Bend => four[axis] = 2.0 * weights[i] * shares[i].bend,
                Spread::Slope => four[3] = 2.0 * weights[i] * tangents[i].dot(axes[axis]) / length,
            }
            four
        };
        (0..n).flat_map(of).collect()
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut basis: Vec<(Vec<f64>, f64)> = Vec::new();
    let mut solution = vec![0.0; 4 * n];
    let mut largest: f64 = 0.0;
    for (axis, direction) in axes.into_iter().enumerate() {
        let mut row = row(axis);
        let mut wanted = lack.dot(direction);
        for (unit, value) in &basis {
            let share = dot(&row, unit);
            row.iter_mut().zip(unit).for_each(|(x, unit)| *x -= share * unit);
            wanted -= share * value;
        }
        let size = dot(&row, &row).sqrt();
        largest = largest.max(size);
        if size <= NEGLIGIBLE * largest {
            continue;
        }
        row.iter_mut().for_each(|x| *x /= size);
        let value = wanted / size;
        solution.iter_mut().zip(&row).for_each(|(x, unit)| *x += value * unit);
        basis.push((row, value));
    }
    let change = |four: &[f64]| Change {
        bend: four[0] * axes[0] + four[1] * axes[1] + four[2] * axes[2],
        slope: four[3] / length,
    };
    solution.chunks_exact(4).map(change).collect()
}

/// The twists that fulfil the system and come as near as possible to those `wanted`.
pub(super) fn twists(shares: &[Share], right: &[Vec3], wanted: &[Vec3]) -> Vec<Vec3> {
    let n = shares.len();
    let (mut twists, mut kernel) = (vec![Vec3::ZERO; n], vec![1.0; n]);
    for i in 1..n {
        let (p, q) = (shares[i].p(), shares[i].q());
        twists[i] = (right[i] - p * twists[i - 1]) / q;
        kernel[i] = -p / q * kernel[i - 1];
    }
    let squares: f64 = kernel.iter().map(|k| k * k).sum();
    let terms = twists.iter().zip(wanted).zip(&kernel);
    let free = terms.fold(Vec3::ZERO, |sum, ((&twist, &wanted), &k)| sum + k * (wanted - twist)) / squares;
    twists.iter().zip(&kernel).map(|(&twist, &k)| twist + k * free).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::circulant::sign;

    #[test]
    fn the_ring_closes() {
        // Skews whose products agree: those of directions around a point.
        let angles = [0.0, 0.9, 1.7, 3.1, 4.0, 5.2];
        let lengths = [1.0, 0.6, 2.0, 1.3, 0.7, 1.1];
        let tangents: Vec<Vec3> =
            (0..6).map(|i| lengths[i] * Vec3::new(f64::cos(angles[i]), f64::sin(angles[i]), 0.0)).collect();
        let turn = |i: usize| tangents[i % 6].cross(tangents[(i + 1) % 6]).z;
        let shares: Vec<Share> = (0..6)
            .map(|i| {
                let (before, after) = (turn(i + 5), turn(i));
                let skew = (after - before) / (after + before);
                Share { skew, bend: 0.3 + 0.1 * i as f64, slope: 0.0 }
            })
            .collect();
        let right: Vec<Vec3> =
            (0..6).map(|i| sign(i) * tangents[(i + 2) % 6] + Vec3::new(0.0, 0.0, 0.3)).collect();
        let spread = [Spread::Slope, Spread::Bend].repeat(3);
        let changes = changes(&shares, &tangents, &spread, &right);
        let changed: Vec<Vec3> = (0..6)
            .map(|i| right[i] + 2.0 * shares[i].bend * changes[i].bend + 2.0 * changes[i].slope * tangents[i])
            .collect();
        let twists = twists(&shares, &changed, &right);
        for i in 0..6 {
            let sum = shares[i].q() * twists[i] + shares[i].p() * twists[(i + 5) % 6];
            assert!(sum.distance(changed[i]) < 1e-13, "spoke {i}");
        }
    }
}
