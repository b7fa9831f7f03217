//! Bicubic polar subdivision: a fan of triangles in the midst of circles of quads.
//!
//! A step refines outwards only and leaves the number of sectors; around, circles are uniform periodic cubics already. The limit
//! is C1 with bounded curvature. Karciauskas and Peters, *Bicubic polar subdivision*; `docs/methods/lens.md`.

use super::polar_error::{PolarDefect, PolarError};
use crate::math::Vec3;
use std::f64::consts::TAU;

/// Fewer sectors have no radial rule of their own: the weights do not sum to one at 3, and at 4 and 5 the eigenvalues that should
/// be quarters are not.
const LEAST_SECTORS: usize = 6;

/// A pole with circles of control points around it: triangles inside the innermost circle, quads between the others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolarNet {
    /// The pole.
    pub pole: Vec3,
    /// The circles from the innermost outwards, with one point a sector each, counter-clockwise.
    pub circles: Vec<Vec<Vec3>>,
}

/// The free weight `beta` of bicubic polar subdivision: the share of the innermost circle in its own next points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RadialRule {
    /// 1/2.
    Half,
    /// 5/8, for which no weight is negative.
    #[default]
    FiveEighths,
}

impl RadialRule {
    /// The value of `beta`.
    pub fn beta(self) -> f64 {
        match self {
            RadialRule::Half => 0.5,
            RadialRule::FiveEighths => 0.625,
        }
    }

    /// Weights of the innermost circle in its own next points: `[k]` for the point `k` sectors away.
    fn ring(self, sectors: usize) -> Vec<f64> {
        let weight = |k: usize| {
            let c = (TAU * k as f64 / sectors as f64).cos();
            (self.beta() - 0.5 + 0.625 * c + c * c + 0.5 * c * c * c) / sectors as f64
        };
        (0..sectors).map(weight).collect()
    }
}

impl PolarNet {
    /// One step outwards: `l` circles become `2 l - 1`, as many as can be made of those that are there.
    ///
    /// # Errors
    /// If there are fewer than six sectors ([`PolarNet::doubled`] first) or no circle, or circles differ in their number of
    /// points.
    pub fn refined(&self, rule: RadialRule) -> Result<PolarNet, PolarError> {
        let sectors = self.sectors()?;
        if sectors < LEAST_SECTORS {
            return Err(PolarDefect::TooFewSectors { sectors, least: LEAST_SECTORS }.into());
        }
        Ok(self.step(rule))
    }

    /// One step around: twice as many sectors on the same curves, the first where it was.
    ///
    /// # Errors
    /// If there are fewer than three sectors or no circle, or circles differ in their number of points.
    pub fn doubled(&self) -> Result<PolarNet, PolarError> {
        let sectors = self.sectors()?;
        let double = |circle: &Vec<Vec3>| {
            let points = |i: usize| {
                let [before, here, after] = [i + sectors - 1, i, i + 1].map(|i| circle[i % sectors]);
                [(before + 6.0 * here + after) / 8.0, (here + after) / 2.0]
            };
            (0..sectors).flat_map(points).collect()
        };
        Ok(PolarNet { pole: self.pole, circles: self.circles.iter().map(double).collect() })
    }

    /// What `steps` refinements of a cage leave around the pole: as many steps outwards and as many around, so that circles
    /// agree with the cage's own vertices where only regular rules had a say. Fewer than six sectors are doubled before the
    /// first step outwards.
    ///
    /// # Errors
    /// If there are fewer than three sectors or no circle, or circles differ in their number of points.
    pub fn refined_with_cage(&self, rule: RadialRule, steps: u32) -> Result<PolarNet, PolarError> {
        let sectors = self.sectors()?;
        if steps == 0 {
            return Ok(self.clone());
        }
        let before = u32::from(sectors < LEAST_SECTORS);
        let mut net = self.clone();
        for _ in 0..before {
            net = net.doubled()?;
        }
        for _ in 0..steps {
            net = net.refined(rule)?;
        }
        for _ in before..steps {
            net = net.doubled()?;
        }
        Ok(net)
    }

    /// The point of the limit surface at the pole. Doubling does not move it, so it is that of any number of sectors.
    ///
    /// # Errors
    /// If there are fewer than three sectors or no circle, or circles differ in their number of points.
    pub fn limit(&self, rule: RadialRule) -> Result<Vec3, PolarError> {
        let sectors = self.sectors()?;
        let sum = self.circles[0].iter().fold(Vec3::ZERO, |sum, &point| sum + (point - self.pole));
        Ok(self.pole + 4.0 / 3.0 * (rule.beta() - 0.25) / sectors as f64 * sum)
    }

    /// Tangents of the limit surface at the pole, towards the first point of the circles and a quarter turn on: the derivatives
    /// along the coordinates of the characteristic net `c(i, j) = j (cos 2 pi i / n, sin 2 pi i / n)`. Their cross product is the
    /// normal; doubling multiplies both by one positive factor.
    ///
    /// # Errors
    /// If there are fewer than three sectors or no circle, or circles differ in their number of points.
    pub fn tangents(&self) -> Result<[Vec3; 2], PolarError> {
        let sectors = self.sectors()?;
        let (mut t1, mut t2) = (Vec3::ZERO, Vec3::ZERO);
        for (i, &point) in self.circles[0].iter().enumerate() {
            let (sine, cosine) = (TAU * i as f64 / sectors as f64).sin_cos();
            t1 += cosine * (point - self.pole);
            t2 += sine * (point - self.pole);
        }
        let share = 2.0 / sectors as f64;
        Ok([share * t1, share * t2])
    }

    /// The number of sectors, if this is a polar net.
    fn sectors(&self) -> Result<usize, PolarError> {
        let Some(first) = self.circles.first() else {
            return Err(PolarDefect::TooFewCircles { circles: 0, least: 1 }.into());
        };
        let sectors = first.len();
        if sectors < 3 {
            return Err(PolarDefect::TooFewSectors { sectors, least: 3 }.into());
        }
        match self.circles.iter().position(|circle| circle.len() != sectors) {
            None => Ok(sectors),
            Some(k) => {
                let points = self.circles[k].len();
                Err(PolarDefect::UnequalCircles { circle: k + 1, points, sectors }.into())
            }
        }
    }

    /// The radial rule as it is written, for any number of sectors.
    fn step(&self, rule: RadialRule) -> PolarNet {
        let (pole, circles, beta) = (self.pole, &self.circles, rule.beta());
        let sectors = circles[0].len();
        let sum = circles[0].iter().fold(Vec3::ZERO, |sum, &point| sum + point);
        let alpha = beta - 0.25;
        let ring = rule.ring(sectors);
        let innermost = |i: usize| {
            let terms = ring.iter().enumerate();
            terms.fold((1.0 - beta) * pole, |sum, (k, &weight)| sum + weight * circles[0][(i + k) % sectors])
        };
        let mut out = vec![(0..sectors).map(innermost).collect::<Vec<_>>()];
        for (j, pair) in circles.windows(2).enumerate() {
            let inside = |i: usize| if j == 0 { pole } else { circles[j - 1][i] };
            let even = |i: usize| (inside(i) + 6.0 * pair[0][i] + pair[1][i]) / 8.0;
            out.push((0..sectors).map(even).collect());
            out.push((0..sectors).map(|i| (pair[0][i] + pair[1][i]) / 2.0).collect());
        }
        PolarNet { pole: (1.0 - alpha) * pole + alpha / sectors as f64 * sum, circles: out }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a step makes of a wave around the pole, as a multiple of it.
    fn factor(sectors: usize, wave: f64, rule: RadialRule) -> f64 {
        let circle = |i: usize| Vec3::new((wave * TAU * i as f64 / sectors as f64).cos(), 0.0, 0.0);
        let net = PolarNet { pole: Vec3::ZERO, circles: vec![(0..sectors).map(circle).collect()] };
        net.step(rule).circles[0][0].x
    }

    #[test]
    fn fewer_than_six_sectors_have_no_rule_of_their_own() {
        for rule in [RadialRule::Half, RadialRule::FiveEighths] {
            assert!(
                (factor(3, 0.0, rule) - rule.beta() - 0.125).abs() < 1e-15,
                "weights sum to more than one"
            );
            assert!((factor(4, 1.0, rule) - 0.5625).abs() < 1e-15, "tangents do not halve");
            assert!((factor(5, 2.0, rule) - 0.3125).abs() < 1e-15, "curvature grows");
            for sectors in [6, 9] {
                assert!((factor(sectors, 0.0, rule) - rule.beta()).abs() < 1e-15);
                assert!((factor(sectors, 1.0, rule) - 0.5).abs() < 1e-15);
                assert!((factor(sectors, 2.0, rule) - 0.25).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn no_weight_of_five_eighths_is_negative() {
        for sectors in 6..=40 {
            assert!(RadialRule::FiveEighths.ring(sectors).into_iter().all(|weight| weight > -1e-16));
        }
    }
}
