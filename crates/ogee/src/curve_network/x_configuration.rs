//! X-configurations: the quads around a point where curves meet (Abbas and Nasri 2004).
//!
//! ```text
//!                  D_j          E_j  port: the first control point of curve j, or a dummy
//!         R_{j+1} /  \ P_j      D_j  free spoke between ports j and j + 1
//!                /    \         P_j  corner of the quad (A, E_j, P_j, D_j)
//!      E_{j+1} -- A -- E_j      R_j  corner of the quad (A, D_{j-1}, R_j, E_j)
//!                \    /
//!                 ....          ring = [E_0, D_0, E_1, D_1, ..], counter-clockwise
//! ```
//!
//! There is a quad, an *X-slice*, between each port and each free spoke beside it, so `M` ports make `2 M` of them. The
//! centre stays where it is, and the face point of a slice sees `A + t (D - O)` in place of its free spoke `D`, where `O` is
//! the free spoke on the other side of the port. With that the curves are exact for any `t` and any `D`, `P`, `R`; how
//! smooth the surface is depends on them. Near the centre the surface looks like the ring that refinement only halves:
//! [`XRing::eigen`].

use super::complex::reposition;
use crate::math::Vec3;
use std::f64::consts::{PI, TAU};

/// The parameter `t` that makes ports and free spokes of a symmetric configuration equally long:
/// `1 / (2 (1 + cos(pi / M)))`. It is 1/2 for two ports, where it gives plain Catmull-Clark rules, and falls to 1/4.
///
/// ```
/// use ogee::curve_network::default_parameter;
/// assert_eq!(default_parameter(2), 0.5);
/// assert!((default_parameter(3) - 1.0 / 3.0).abs() < 1e-15);
/// ```
pub fn default_parameter(ports: usize) -> f64 {
    1.0 / (2.0 * (1.0 + (PI / ports as f64).cos()))
}

/// The points around the centre of an X-configuration, relative to the centre.
#[derive(Clone, Debug, PartialEq)]
pub struct XRing {
    /// `2 M` spokes counter-clockwise: ports `E_j` at `2 j`, free spokes `D_j` at `2 j + 1`.
    pub ring: Vec<Vec3>,
    /// Corner `i` is that of the slice between spokes `i` and `i + 1`: `P_j` at `2 j`, `R_{j+1}` at `2 j + 1`.
    pub corners: Vec<Vec3>,
}

impl XRing {
    /// Ports and what lies between them: `ports[j]` is `E_j`, `free[j]` is `D_j`, `after[j]` is `P_j`, `before[j]` is `R_j`.
    fn from_parts(ports: &[Vec3], free: &[Vec3], after: &[Vec3], before: &[Vec3]) -> XRing {
        let count = ports.len();
        XRing {
            ring: (0..count).flat_map(|j| [ports[j], free[j]]).collect(),
            corners: (0..count).flat_map(|j| [after[j], before[(j + 1) % count]]).collect(),
        }
    }

    /// The eigen configuration: refinement halves it and does nothing else.
    ///
    /// `tangents` are the first legs `T_j` of the curves' control polygons, counter-clockwise, two or more; `0 < t <= 1/2`.
    /// With three ports or more, `t = 1/2` gives a surface without tangent plane in general. Two ports need `t = 1/2`;
    /// there the free spokes are the mean of the tangents and, on either side, half of their difference turned by 90
    /// degrees about `normal` and scaled by its length, usually 1; it is not used otherwise.
    pub fn eigen(tangents: &[Vec3], t: f64, normal: Vec3) -> XRing {
        let count = tangents.len();
        let kernel = free_spoke_kernel(count, t);
        let mut free: Vec<Vec3> = (0..count)
            .map(|j| {
                let terms = tangents.iter().enumerate();
                terms.fold(Vec3::ZERO, |sum, (k, &tangent)| sum + kernel[(j + count - k) % count] * tangent)
            })
            .collect();
        if let ([first, second], [one, other]) = (tangents, &mut free[..]) {
            let aside = normal.cross(*first - *second) / 2.0;
            *one += aside;
            *other -= aside;
        }
        let aside = |j: usize| t * (free[j] - free[(j + count - 1) % count]);
        let after: Vec<Vec3> = (0..count).map(|j| tangents[j] + aside(j)).collect();
        let before: Vec<Vec3> = (0..count).map(|j| tangents[j] - aside(j)).collect();
        XRing::from_parts(tangents, &free, &after, &before)
    }

    /// The parallelogram configuration (Abbas and Nasri's generalised scheme): free spokes `h (T_j + T_{j+1})`, corners
    /// that close the parallelograms. Where two neighbouring tangents are opposite, the free spoke is `T_j` turned by 90
    /// degrees about the unit `normal`.
    pub fn parallelogram(tangents: &[Vec3], thickness: f64, normal: Vec3) -> XRing {
        let count = tangents.len();
        let free: Vec<Vec3> = (0..count)
            .map(|j| {
                let (here, next) = (tangents[j], tangents[(j + 1) % count]);
                let sum = here + next;
                if sum.length() < OPPOSITE * (here.length() + next.length()) {
                    normal.cross(here)
                } else {
                    thickness * sum
                }
            })
            .collect();
        let after: Vec<Vec3> = (0..count).map(|j| tangents[j] + free[j]).collect();
        let before: Vec<Vec3> = (0..count).map(|j| tangents[j] + free[(j + count - 1) % count]).collect();
        XRing::from_parts(tangents, &free, &after, &before)
    }

    /// The symmetric configuration (Abbas and Nasri 2004): every slice is the mirror image, through the centre, of the one
    /// opposite, as far as the tangents allow. Corners, and free spokes opposite others, are the mean of those of the eigen
    /// configuration and their mirror images; ports follow from their curves, and with an odd number of them free spokes are
    /// their mirror images.
    pub fn symmetric(tangents: &[Vec3], t: f64, normal: Vec3) -> XRing {
        let mut ring = XRing::eigen(tangents, t, normal);
        let (ports, spokes) = (tangents.len(), 2 * tangents.len());
        let mirrored = |list: &[Vec3], i: usize| (list[i] - list[(i + ports) % spokes]) / 2.0;
        ring.corners = (0..spokes).map(|i| mirrored(&ring.corners, i)).collect();
        for (j, &tangent) in tangents.iter().enumerate() {
            ring.ring[2 * j] = reposition(tangent, ring.corner_after(j), ring.corner_before(j));
        }
        // Port and free spoke are opposite if their number is odd: then the ports decide.
        let free: Vec<Vec3> = (0..ports)
            .map(|j| match ports % 2 {
                0 => mirrored(&ring.ring, 2 * j + 1),
                _ => -ring.ring[(2 * j + 1 + ports) % spokes],
            })
            .collect();
        for (j, free) in free.into_iter().enumerate() {
            ring.ring[2 * j + 1] = free;
        }
        ring
    }

    /// How far the points of the ring are from being mirrored in the centre: the longest sum of two opposite ones.
    pub fn asymmetry(&self) -> f64 {
        let half = self.ports();
        let worst =
            |list: &[Vec3]| (0..half).map(|i| (list[i] + list[i + half]).length()).fold(0.0, f64::max);
        worst(&self.ring).max(worst(&self.corners))
    }

    /// Lifts every free spoke by the same vector: an eigenvector of eigenvalue 1/4, so it bends the surface between the
    /// curves at the centre, where it is flat otherwise, and leaves the curves exact.
    pub fn crown(&mut self, lift: Vec3) {
        self.ring.iter_mut().skip(1).step_by(2).for_each(|free| *free += lift);
    }

    /// Number of ports `M`.
    pub fn ports(&self) -> usize {
        self.ring.len() / 2
    }

    /// Port `E_j`, `j` modulo the number of ports.
    pub fn port(&self, j: usize) -> Vec3 {
        self.ring[2 * j % self.ring.len()]
    }

    /// Free spoke `D_j`, between ports `j` and `j + 1`; `j` modulo the number of ports.
    pub fn free_spoke(&self, j: usize) -> Vec3 {
        self.ring[(2 * j + 1) % self.ring.len()]
    }

    /// Corner `P_j`, between port `j` and free spoke `j`; `j` modulo the number of ports.
    pub fn corner_after(&self, j: usize) -> Vec3 {
        self.corners[2 * j % self.corners.len()]
    }

    /// Corner `R_j`, between free spoke `j - 1` and port `j`; `j` modulo the number of ports.
    pub fn corner_before(&self, j: usize) -> Vec3 {
        let count = self.corners.len();
        self.corners[(2 * j + count - 1) % count]
    }
}

/// Of the lengths of two tangents, how short their sum is when they count as opposite.
const OPPOSITE: f64 = 1e-6;

/// Weights `g` of `D_j = sum_k g_{j-k} T_k`, which solve
/// `(1 - t) D_j + (t / 2) (D_{j-1} + D_{j+1}) = (T_j + T_{j+1}) / 2`, mode by mode: the system is circulant.
fn free_spoke_kernel(ports: usize, t: f64) -> Vec<f64> {
    let angle = |w: usize, m: usize| TAU * (w * m % ports) as f64 / ports as f64;
    let weight = |m: usize| {
        // The alternating mode vanishes from the right side, and at t = 1/2 from the left.
        let modes = (0..ports).filter(|w| 2 * w != ports);
        let sum: f64 = modes
            .map(|w| {
                let pair_mean = (angle(w, m).cos() + angle(w, m + 1).cos()) / 2.0;
                pair_mean / (1.0 - t * (1.0 - angle(w, 1).cos()))
            })
            .sum();
        sum / ports as f64
    };
    (0..ports).map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve_network::XMatrix;

    /// Any tangents, in space.
    fn tangents(count: usize) -> Vec<Vec3> {
        (0..count)
            .map(|j| {
                let a = j as f64;
                Vec3::new(
                    (1.3 * a + 0.2).cos() * (1.0 + 0.1 * a),
                    (1.1 * a).sin() + 0.4,
                    0.2 * (2.0 * a).sin(),
                )
            })
            .collect()
    }

    #[test]
    fn the_cyclic_system_is_solved() {
        for count in 3..12 {
            for t in [0.03, 0.2, default_parameter(count), 0.4999, 0.5] {
                let tangents = tangents(count);
                let ring = XRing::eigen(&tangents, t, Vec3::ZERO);
                for j in 0..count {
                    let d = |offset: usize| ring.free_spoke(j + offset);
                    let made = (1.0 - t) * d(0) + t / 2.0 * (d(count - 1) + d(1));
                    let wanted = (tangents[j] + tangents[(j + 1) % count]) / 2.0;
                    assert!(made.distance(wanted) < 1e-13, "{count} ports, t = {t}, row {j}");
                }
            }
        }
    }

    #[test]
    fn the_eigen_ring_is_halved() {
        for count in 2..10 {
            for t in [0.05, 0.25, default_parameter(count), 0.5] {
                if count == 2 && t < 0.5 {
                    continue;
                }
                let ring = XRing::eigen(&tangents(count), t, Vec3::new(0.6, 0.0, 0.8));
                let next = XMatrix::new(count, t).refine(&ring);
                let points = ring.ring.iter().chain(&ring.corners);
                for (before, after) in points.zip(next.ring.iter().chain(&next.corners)) {
                    assert!(after.distance(*before / 2.0) < 1e-13, "{count} ports, t = {t}");
                }
            }
        }
    }

    #[test]
    fn the_eigen_ring_is_linear_in_its_tangents() {
        let map = |p: Vec3| Vec3::new(2.0 * p.x - p.y + p.z, 0.3 * p.x + p.y, p.z - 0.7 * p.y);
        for count in 3..10 {
            let t = default_parameter(count);
            let moved: Vec<Vec3> = tangents(count).into_iter().map(map).collect();
            let (before, after) =
                (XRing::eigen(&tangents(count), t, Vec3::ZERO), XRing::eigen(&moved, t, Vec3::ZERO));
            let pairs =
                before.ring.iter().chain(&before.corners).zip(after.ring.iter().chain(&after.corners));
            for (&before, &after) in pairs {
                assert!(map(before).distance(after) < 1e-13, "{count} ports");
            }
        }
    }

    #[test]
    fn the_crown_is_quartered() {
        for count in 2..7 {
            let t = 0.3;
            let mut ring = XRing { ring: vec![Vec3::ZERO; 2 * count], corners: vec![Vec3::ZERO; 2 * count] };
            ring.crown(Vec3::new(0.0, 0.0, 1.0));
            let next = XMatrix::new(count, t).refine(&ring);
            for j in 0..count {
                assert!((next.free_spoke(j) - Vec3::new(0.0, 0.0, 0.25)).length() < 1e-15);
                assert!(next.port(j).length() + next.corner_after(j).length() < 1e-15);
            }
        }
    }

    #[test]
    fn symmetric_spokes_are_equally_long() {
        for count in 3..9 {
            let at = |j: usize| TAU * j as f64 / count as f64;
            let star: Vec<Vec3> = (0..count).map(|j| Vec3::new(at(j).cos(), at(j).sin(), 0.0)).collect();
            let ring = XRing::eigen(&star, default_parameter(count), Vec3::ZERO);
            assert!(ring.ring.iter().all(|spoke| (spoke.length() - 1.0).abs() < 1e-14), "{count} ports");
        }
    }

    #[test]
    fn symmetric_rings_are_their_mirror_images_where_tangents_are() {
        for count in 2..9 {
            let at = |j: usize| TAU * j as f64 / count as f64;
            let star: Vec<Vec3> = (0..count).map(|j| Vec3::new(at(j).cos(), at(j).sin(), 0.0)).collect();
            for t in [0.1, 0.25, 0.5] {
                let ring = XRing::symmetric(&star, t, Vec3::new(0.0, 0.0, 1.0));
                assert!(ring.asymmetry() < 1e-14, "{count} ports, t = {t}: {ring:?}");
                // The curves' own control points.
                for (j, &tangent) in star.iter().enumerate() {
                    let made = (ring.corner_after(j) + 4.0 * ring.port(j) + ring.corner_before(j)) / 6.0;
                    assert!(made.distance(tangent) < 1e-15 * 8.0);
                }
            }
            // Eigen rings are symmetric at the default parameter, as far as ports go.
            let eigen = XRing::eigen(&star, default_parameter(count), Vec3::new(0.0, 0.0, 1.0));
            assert!(eigen.asymmetry() < 1e-14);
        }
        // Free spokes opposite ports can be anywhere; ports opposite ports are where their curves are.
        assert!(XRing::symmetric(&tangents(3), 0.25, Vec3::ZERO).asymmetry() < 1e-14);
        assert!(XRing::symmetric(&tangents(4), 0.25, Vec3::ZERO).asymmetry() > 0.1);
    }

    #[test]
    fn parallelograms_close() {
        let ring = XRing::parallelogram(&tangents(5), 1.0, Vec3::new(0.0, 0.0, 1.0));
        for j in 0..5 {
            assert_eq!(ring.free_spoke(j), ring.port(j) + ring.port(j + 1));
            assert_eq!(ring.corner_after(j), ring.port(j) + ring.free_spoke(j));
            assert_eq!(ring.corner_before(j), ring.port(j) + ring.free_spoke(j + 4));
        }
        let straight = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(-1.0, 0.0, 0.0)];
        let ring = XRing::parallelogram(&straight, 1.0, Vec3::new(0.0, 0.0, 1.0));
        assert_eq!(ring.free_spoke(0), Vec3::new(0.0, 1.0, 0.0));
    }
}
