//! The conditions at an edge: three equations that make two sectors one curvature-continuous surface.
//!
//! With `A` the sector after an edge and `B` the one before, `t` along the edge and `s` away from it,
//!
//! ```text
//! A = B,    A_s + B_s = a A_t,    A_ss - B_ss = a (A_st - B_st),    a(t) = 2 cos(angle) (2 (1 - t)^3 - (1 - 2t)_+^3)
//! ```
//!
//! for all `t`, at `s = 0` (`docs/methods/g2_caps.md`, Conditions). They are polynomials on both pieces, and hold if they hold at
//! enough places.

use super::fan::{Ends, Fan, SECTOR, Scalar, Terms};
use super::spline::{BREAKS, Functions, functions};
use super::{COEFFICIENTS, INNER};

/// Places on each piece of an edge.
const PLACES: usize = 15;

/// How far the parameter lines of a sector lean over into the next one: the factor `a` of the conditions.
fn lean(angle: f64, t: f64) -> f64 {
    2.0 * angle.cos() * (2.0 * (1.0 - t).powi(3) - (1.0 - 2.0 * t).max(0.0).powi(3))
}

/// The places on an edge at which the conditions are asked for: Chebyshev's on each piece.
fn places() -> impl Iterator<Item = f64> {
    BREAKS.windows(2).flat_map(|piece| {
        let (middle, half) = ((piece[0] + piece[1]) / 2.0, (piece[1] - piece[0]) / 2.0);
        (0..PLACES)
            .map(move |k| middle - half * (std::f64::consts::PI * (k as f64 + 0.5) / PLACES as f64).cos())
    })
}

/// A sector as an edge sees it.
#[derive(Clone, Copy)]
struct Side<T> {
    sector: usize,
    times: T,
    /// Whether the edge is the sector's first one, along `u`.
    first: bool,
}

/// Derivatives of the functions across the edge, at the edge, and along it, at a place.
struct Place {
    across: [Functions; 3],
    along: [Functions; 3],
}

impl Place {
    fn new(t: f64) -> Place {
        Place {
            across: [0, 1, 2].map(|order| functions(order, 0.0)),
            along: [0, 1, 2].map(|order| functions(order, t)),
        }
    }

    /// Adds `weight` times a mixed derivative of a side to an equation.
    fn add<T: Scalar>(&self, terms: &mut Terms<T>, side: Side<T>, [across, along]: [usize; 2], weight: f64) {
        for (far, &away) in self.across[across].iter().enumerate().take(across + 1) {
            for (k, &value) in self.along[along].iter().enumerate().filter(|term| *term.1 != 0.0) {
                let (i, j) = if side.first { (k, far) } else { (far, k) };
                let coefficient = side.sector * SECTOR + COEFFICIENTS * i + j;
                terms.push((coefficient, side.times.times(weight * away * value)));
            }
        }
    }
}

/// A combination of coefficients that has to vanish.
pub(super) struct Equation<T> {
    /// Of values 0, else the order of derivatives.
    pub(super) order: usize,
    pub(super) terms: Terms<T>,
}

/// The three equations at a place of an edge.
fn equations<T: Scalar>(a: Side<T>, b: Side<T>, lean: f64, place: &Place) -> [Equation<T>; 3] {
    let [mut values, mut tangents, mut curvatures] = [const { Vec::new() }; 3];
    place.add(&mut values, a, [0, 0], 1.0);
    place.add(&mut values, b, [0, 0], -1.0);
    place.add(&mut tangents, a, [1, 0], 1.0);
    place.add(&mut tangents, b, [1, 0], 1.0);
    place.add(&mut tangents, a, [0, 1], -lean);
    place.add(&mut curvatures, a, [2, 0], 1.0);
    place.add(&mut curvatures, b, [2, 0], -1.0);
    place.add(&mut curvatures, a, [1, 1], -lean);
    place.add(&mut curvatures, b, [1, 1], lean);
    [(0, values), (1, tangents), (2, curvatures)].map(|(order, terms)| Equation { order, terms })
}

impl<T: Scalar> Fan<T> {
    /// The equations of all edges.
    pub(super) fn equations(&self) -> Vec<Equation<T>> {
        let mut all: Vec<Equation<T>> =
            (0..self.sectors).flat_map(|sector| self.edge_equations(sector)).collect();
        if self.ends == Ends::Crease {
            all.extend(self.crease_equations());
        }
        all
    }

    /// The equations of a sector's first edge; none where it is the boundary or a crease.
    pub(super) fn edge_equations(&self, sector: usize) -> Vec<Equation<T>> {
        let Some((before, times)) = self.before(sector) else { return Vec::new() };
        let a = Side { sector, times: T::from(1.0), first: true };
        let b = Side { sector: before, times, first: false };
        places().flat_map(|t| equations(a, b, lean(self.angle, t), &Place::new(t))).collect()
    }

    /// Both sides of a crease have one curve, and where it ends one tangent plane and one curvature.
    fn crease_equations(&self) -> Vec<Equation<T>> {
        let a = Side { sector: 0, times: T::from(1.0), first: true };
        let b = Side { sector: self.sectors - 1, times: T::from(1.0), first: false };
        let curve = |k: usize| {
            let (on_a, on_b) = (SECTOR * a.sector + COEFFICIENTS * k, SECTOR * b.sector + k);
            Equation { order: 0, terms: vec![(on_a, a.times), (on_b, -b.times)] }
        };
        let (end, lean) = (Place::new(0.0), lean(self.angle, 0.0));
        let [_, tangents, curvatures] = equations(a, b, lean, &end);
        // The equation of tangents, differentiated along the crease; its lean has no slope there.
        let mut twists = Vec::new();
        end.add(&mut twists, a, [1, 1], 1.0);
        end.add(&mut twists, b, [1, 1], 1.0);
        end.add(&mut twists, a, [0, 2], -lean);
        let end = [tangents, Equation { order: 2, terms: twists }, curvatures];
        (0..INNER).map(curve).chain(end).collect()
    }
}
