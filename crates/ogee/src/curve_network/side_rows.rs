//! Tangent planes and cross curvatures along a curve: the rows beside it, turned and bent about it. The curve stays.
//!
//! With half the difference `d` and half the sum `c` of the rows, the surface has along the curve the cross derivative
//! `sum B_i d_i` and the second one `sum B_i 3 (c_i - Q_i)`, in the same B-splines as the curve. So what is wanted at knots
//! is a 1-4-1 system away. Between vertices where something is wanted, turns and bends go over into one another linearly;
//! they fall to nothing at rows that are kept, and stay the same up to a free end.

use super::complex::Complex;
use crate::math::{SurfaceJet, Vec3};

impl Complex {
    /// The surface at every vertex of the path: `u` along it, `v` towards the top row, so that `du x dv` looks outward.
    pub fn jets(&self) -> Vec<SurfaceJet> {
        let (curve, differences) = (self.curve(), self.differences());
        let (across, bends) = (self.cross_derivatives(), self.second_cross_derivatives());
        let limits = self.at_knots(&curve);
        let slope = |row: &[Vec3], i: usize| (self.neighbour(row, i, 1) - self.neighbour(row, i, -1)) / 2.0;
        (0..self.len())
            .map(|i| SurfaceJet {
                position: limits[i],
                du: slope(&curve, i),
                dv: across[i],
                duu: self.neighbour(&curve, i, -1) - 2.0 * curve[i] + self.neighbour(&curve, i, 1),
                duv: slope(&differences, i),
                dvv: bends[i],
            })
            .collect()
    }

    /// Turns the surface about the curve until it has the given normals at the vertices of the path; the curve stays, and so
    /// does the length of cross derivatives. Where nothing is given the turn follows from the next vertices on either side.
    /// Normals need not be unit vectors; one that leans along the curve is made perpendicular to it, and by how many degrees
    /// is returned for each vertex, 0 where nothing is given.
    ///
    /// The side points of the first `keep[0]` and the last `keep[1]` vertices of an open path do not move, and normals given
    /// there are not read: two beside a meeting point, none at a border.
    pub fn set_normals(&mut self, normals: &[Option<Vec3>], keep: [usize; 2]) -> Vec<f64> {
        let jets = self.jets();
        let mut tilts = vec![0.0; jets.len()];
        let mut turns = vec![None; jets.len()];
        for i in self.free(keep) {
            let (Some(along), Some(wanted)) = (jets[i].du.normalized(), normals.get(i).copied().flatten())
            else {
                continue;
            };
            let Some(normal) = (wanted - along.dot(wanted) * along).normalized() else { continue };
            tilts[i] = wanted.angle(normal).to_degrees();
            // Where the two derivatives are parallel there is nothing to turn from.
            let now = jets[i].normal().unwrap_or(normal);
            turns[i] = Some(along.dot(now.cross(normal)).atan2(now.dot(normal)));
        }
        self.keep_zero(&mut turns, keep);
        unwind(&mut turns);
        let turns = between(&turns, self.closed);
        let turned = jets.iter().zip(turns).map(|(jet, turn)| match jet.du.normalized() {
            Some(along) => {
                let lengthwise = along.dot(jet.dv) * along;
                let aside = jet.dv - lengthwise;
                lengthwise + turn.cos() * aside + turn.sin() * along.cross(aside)
            }
            None => jet.dv,
        });
        let turned: Vec<Vec3> = turned.collect();
        self.set_cross_derivatives(&turned, keep);
        tilts
    }

    /// Bends the surface beside the curve until it has the given normal curvatures across it (perpendicular to it) at the
    /// vertices of the path; curve and tangent planes stay. Curvatures are positive where the surface bends towards
    /// `du x dv`. Where nothing is given the change follows from the next vertices on either side. `keep` as in
    /// [`Complex::set_normals`].
    ///
    /// Of the second cross derivative only the part along the normal changes: with `dv = a du + p`, `p` perpendicular to `du`,
    /// the curvature is `(dvv - 2 a duv + a^2 duu) . n / p . p`.
    pub fn set_cross_curvatures(&mut self, wanted: &[Option<f64>], keep: [usize; 2]) {
        let jets = self.jets();
        let mut changes = vec![None; jets.len()];
        for i in self.free(keep) {
            let Some(wanted) = wanted.get(i).copied().flatten() else { continue };
            changes[i] = cross_curvature(&jets[i]).map(|now| wanted - now);
        }
        self.keep_zero(&mut changes, keep);
        let changes = between(&changes, self.closed);
        let bent = jets.iter().zip(changes).map(|(jet, change)| {
            let (Some(along), Some(normal)) = (jet.du.normalized(), jet.normal()) else { return jet.dvv };
            let aside = jet.dv - along.dot(jet.dv) * along;
            jet.dvv + change * aside.dot(aside) * normal
        });
        let bent: Vec<Vec3> = bent.collect();
        self.set_second_cross_derivatives(&bent, keep);
    }

    /// What is kept does not change.
    fn keep_zero(&self, changes: &mut [Option<f64>], keep: [usize; 2]) {
        let free = self.free(keep);
        if changes.iter().any(Option::is_some) {
            let kept = (0..changes.len()).filter(|i| !free.contains(i));
            kept.for_each(|i| changes[i] = Some(0.0));
        }
    }
}

/// Normal curvature perpendicular to `du`; `None` where the surface is singular.
pub(super) fn cross_curvature(jet: &SurfaceJet) -> Option<f64> {
    let normal = jet.normal()?;
    jet.normal_curvature(normal, normal.cross(jet.du))
}

/// Takes full turns out of angles: each lies within half a turn of the one before.
fn unwind(angles: &mut [Option<f64>]) {
    let mut before: Option<f64> = None;
    for angle in angles.iter_mut().flatten() {
        if let Some(before) = before {
            *angle -= ((*angle - before) / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        }
        before = Some(*angle);
    }
}

/// Numbers at every place from those that are given: linear between two of them, constant beyond the first and the last;
/// zero if there are none.
fn between(given: &[Option<f64>], closed: bool) -> Vec<f64> {
    let places: Vec<(usize, f64)> =
        given.iter().enumerate().filter_map(|(i, value)| value.map(|value| (i, value))).collect();
    let (Some(&first), Some(&last)) = (places.first(), places.last()) else { return vec![0.0; given.len()] };
    let count = given.len();
    (0..count)
        .map(|i| {
            let after = places.iter().find(|place| place.0 >= i);
            let before = places.iter().rev().find(|place| place.0 <= i);
            let (from, to) = match (before, after) {
                (Some(&from), Some(&to)) => (from, to),
                (Some(&from), None) if closed => (from, (first.0 + count, first.1)),
                (None, Some(&to)) if closed => ((last.0, last.1), (to.0 + count, to.1)),
                (Some(&end), None) | (None, Some(&end)) => (end, end),
                (None, None) => return 0.0,
            };
            if from.0 == to.0 {
                return from.1;
            }
            let i = if i < from.0 { i + count } else { i };
            let share = (i - from.0) as f64 / (to.0 - from.0) as f64;
            from.1 + share * (to.1 - from.1)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::complex::tests::wobbly;
    use super::*;

    const KEEPS: [(bool, [usize; 2]); 4] =
        [(true, [0, 0]), (false, [0, 0]), (false, [2, 0]), (false, [2, 2])];

    #[test]
    fn normals_are_met_and_the_curve_stays() {
        for (closed, keep) in KEEPS {
            let mut complex = wobbly(9, closed);
            let before = complex.clone();
            let (curve, bends) = (complex.curve(), complex.second_cross_derivatives());
            let wanted: Vec<Option<Vec3>> = (0..9)
                .map(|i| (i % 3 != 1).then(|| Vec3::new(0.1, -0.2, 1.0 + 0.1 * f64::from(i))))
                .collect();
            let tilts = complex.set_normals(&wanted, keep);
            let jets = complex.jets();
            for i in 0..9 {
                assert!(complex.curve()[i].distance(curve[i]) < 1e-14);
                assert!(complex.second_cross_derivatives()[i].distance(bends[i]) < 1e-13);
                if !closed && (i < keep[0] || i + keep[1] >= 9) {
                    assert!(complex.top[i].distance(before.top[i]) < 1e-14);
                    assert_eq!(tilts[i], 0.0);
                } else if let Some(wanted) = wanted[i] {
                    let along = jets[i].du.normalized().unwrap();
                    let normal = (wanted - along.dot(wanted) * along).normalized().unwrap();
                    assert!(
                        jets[i].normal().unwrap().distance(normal) < 1e-13,
                        "closed {closed}, vertex {i}"
                    );
                    assert!((tilts[i] - wanted.angle(normal).to_degrees()).abs() < 1e-12 && tilts[i] > 0.0);
                }
            }
        }
    }

    #[test]
    fn cross_curvatures_are_met_and_tangent_planes_stay() {
        for (closed, keep) in KEEPS {
            let mut complex = wobbly(9, closed);
            let (curve, across) = (complex.curve(), complex.cross_derivatives());
            let wanted: Vec<Option<f64>> =
                (0..9).map(|i| (i % 4 != 3).then(|| 0.3 * f64::from(i) - 1.0)).collect();
            complex.set_cross_curvatures(&wanted, keep);
            for (i, jet) in complex.jets().iter().enumerate() {
                assert!(complex.curve()[i].distance(curve[i]) < 1e-14);
                assert!(complex.cross_derivatives()[i].distance(across[i]) < 1e-13);
                if let Some(wanted) = wanted[i].filter(|_| complex.free(keep).contains(&i)) {
                    let found = cross_curvature(jet).unwrap();
                    assert!((found - wanted).abs() < 1e-12, "closed {closed}, vertex {i}: {found} {wanted}");
                }
            }
        }
    }

    #[test]
    fn changes_go_over_into_one_another() {
        let some = |list: &[f64]| list.iter().map(|&x| (!x.is_nan()).then_some(x)).collect::<Vec<_>>();
        let none = f64::NAN;
        assert_eq!(
            between(&some(&[none, 1.0, none, none, 4.0, none]), false),
            [1.0, 1.0, 2.0, 3.0, 4.0, 4.0]
        );
        assert_eq!(between(&some(&[none, 3.0, none, none, 0.0, none]), true), [2.0, 3.0, 2.0, 1.0, 0.0, 1.0]);
        assert_eq!(between(&some(&[none, none]), true), [0.0, 0.0]);
        let mut angles = some(&[3.0, none, -3.0]);
        unwind(&mut angles);
        assert!((angles[2].unwrap() - (std::f64::consts::TAU - 3.0)).abs() < 1e-15);
    }

    #[test]
    fn short_complexes_do_no_harm() {
        for count in 0..3 {
            for closed in [true, false] {
                for keep in [[0, 0], [1, 0], [2, 2]] {
                    let mut complex = wobbly(count, closed);
                    let before = complex.clone();
                    complex.set_normals(&vec![Some(Vec3::new(0.1, 0.2, 1.0)); count], keep);
                    complex.set_cross_curvatures(&vec![Some(0.5); count], keep);
                    for i in 0..count {
                        assert!(complex.curve()[i].distance(before.curve()[i]) < 1e-14);
                        assert!(complex.top[i].is_finite() && complex.bottom[i].is_finite());
                        let kept = !complex.free(keep).contains(&i);
                        assert!(!kept || complex.top[i].distance(before.top[i]) < 1e-14, "{count} {keep:?}");
                    }
                }
            }
        }
        // Two vertices at a border each: both normals are met.
        let mut complex = wobbly(2, false);
        complex.set_normals(&[Some(Vec3::new(0.1, 0.2, 1.0)); 2], [0, 0]);
        for jet in complex.jets() {
            let along = jet.du.normalized().unwrap();
            let wanted = Vec3::new(0.1, 0.2, 1.0);
            let normal = (wanted - along.dot(wanted) * along).normalized().unwrap();
            assert!(jet.normal().unwrap().distance(normal) < 1e-14);
        }
    }
}
