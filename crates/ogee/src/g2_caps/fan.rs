//! `Fan`: the sectors that are solved for together, how they lie next to each other, and what of them is given.
//!
//! An interior vertex is taken apart into Fourier modes, in which the next sector is the last one times a number of
//! length one: one sector of complex coefficients, with itself as its neighbour. Where a boundary or a crease ends the symmetry all
//! sectors are solved for at once, in real numbers.

use std::ops::{Add, AddAssign, Mul, Neg};

use faer::c64;
use faer::traits::ComplexField;

use super::spline::{cubic, jet};
use super::{COEFFICIENTS, CapClass, INNER};

/// The coefficients of a sector.
pub(super) const SECTOR: usize = COEFFICIENTS * COEFFICIENTS;

/// Real or complex numbers.
pub(super) trait Scalar:
    ComplexField<Real = f64>
    + Copy
    + From<f64>
    + Add<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + AddAssign
{
    /// A multiple.
    fn times(self, number: f64) -> Self {
        self * Self::from(number)
    }
}

impl Scalar for f64 {}
impl Scalar for c64 {}

/// Where the fan ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ends {
    /// Nowhere: the sector after the last is the first one.
    Joined,
    /// In a smooth boundary curve.
    Smooth,
    /// In two boundary curves with natural ends.
    Corner,
    /// On both sides of a crease that ends in the middle.
    Crease,
}

/// Sectors with their edges and columns. Columns are `E`; `P10 P20` of each edge; `P11 P21 P12 P22` of each sector.
#[derive(Clone, Debug)]
pub(super) struct Fan<T> {
    pub(super) ends: Ends,
    pub(super) sectors: usize,
    /// The angle of a sector in the plane of the natural configuration.
    pub(super) angle: f64,
    /// How many edges have points of their own.
    pub(super) edges: usize,
    /// How much of the vertex itself there is: none in a Fourier mode that turns.
    middle: T,
    /// What the sectors are times after -1, 0, 1, 2 times round.
    turns: [T; 4],
}

impl Fan<c64> {
    /// One sector of an interior fan, in the mode that multiplies by `exp(i turn)` from sector to sector.
    pub(super) fn mode(angle: f64, turn: f64) -> Fan<c64> {
        let power = |k: i32| c64::new((turn * f64::from(k)).cos(), (turn * f64::from(k)).sin());
        let middle = if turn == 0.0 { 1.0 } else { 0.0 };
        let turns = [-1, 0, 1, 2].map(power);
        Fan { ends: Ends::Joined, sectors: 1, angle, edges: 1, middle: middle.into(), turns }
    }
}

impl Fan<f64> {
    /// All sectors of a class.
    pub(super) fn whole(class: CapClass) -> Fan<f64> {
        let ends = match class {
            CapClass::Interior { .. } => Ends::Joined,
            CapClass::Boundary { .. } => Ends::Smooth,
            CapClass::Corner { .. } => Ends::Corner,
            CapClass::Dart { .. } => Ends::Crease,
        };
        let (sectors, edges) = (class.sectors(), class.edges());
        Fan { ends, sectors, angle: class.sector_angle(), edges, middle: 1.0, turns: [1.0; 4] }
    }
}

/// A sum: numbers of columns or coefficients, and their weights.
pub(super) type Terms<T> = Vec<(usize, T)>;

impl<T: Scalar> Fan<T> {
    /// How many columns there are.
    pub(super) fn columns(&self) -> usize {
        1 + 2 * self.edges + 4 * self.sectors
    }

    /// How many coefficients there are, given or not; number `169 sector + 13 i + j`.
    pub(super) fn coefficients(&self) -> usize {
        SECTOR * self.sectors
    }

    /// What the sector before `sector` is: its number, and times what.
    pub(super) fn before(&self, sector: usize) -> Option<(usize, T)> {
        self.neighbour(sector as isize - 1)
    }

    fn neighbour(&self, place: isize) -> Option<(usize, T)> {
        let inside = (0..self.sectors as isize).contains(&place);
        (inside || self.ends == Ends::Joined).then(|| self.around(place, self.sectors))
    }

    /// The place among `count` of one that is counted on around the vertex, and times what it is.
    fn around(&self, place: isize, count: usize) -> (usize, T) {
        let count = count as isize;
        (place.rem_euclid(count) as usize, self.turns[(place.div_euclid(count) + 1) as usize])
    }

    /// `P10` (`number` 1) or `P20` (2) of an edge; the middle for 0.
    fn on_edge(&self, edge: isize, number: usize) -> Terms<T> {
        if number == 0 {
            return vec![(0, self.middle)];
        }
        let (edge, times) = self.around(edge, self.edges);
        vec![(2 * edge + number, times)]
    }

    /// The node `(u, v)` of a sector, `-1..=2` both, not both -1: in cells, the middle is `(0, 0)`. Beyond a boundary or the crease nodes are
    /// reflections.
    fn node(&self, sector: isize, u: isize, v: isize) -> Terms<T> {
        let reflected = |on: Terms<T>, inside: Terms<T>| {
            let twice = on.into_iter().map(|(column, weight)| (column, weight + weight));
            twice.chain(inside.into_iter().map(|(column, weight)| (column, -weight))).collect()
        };
        match (u, v) {
            (-1, _) if self.neighbour(sector + 1).is_some() => {
                if v == 0 {
                    self.on_edge(sector + 2, 1)
                } else {
                    self.node(sector + 1, v, 1)
                }
            }
            (-1, _) => reflected(self.node(sector, 0, v), self.node(sector, 1, v)),
            (_, -1) if self.neighbour(sector - 1).is_some() => {
                if u == 0 {
                    self.on_edge(sector - 1, 1)
                } else {
                    self.node(sector - 1, 1, u)
                }
            }
            (_, -1) => reflected(self.node(sector, u, 0), self.node(sector, u, 1)),
            (_, 0) => self.on_edge(sector, u as usize),
            (0, _) => self.on_edge(sector + 1, v as usize),
            _ => {
                let Some((sector, times)) = self.neighbour(sector) else { return Vec::new() };
                let number = (u - 1) as usize + 2 * (v - 1) as usize;
                vec![(1 + 2 * self.edges + 4 * sector + number, times)]
            }
        }
    }

    /// A coefficient that is given: one of the outer three layers, which join the bicubics around the cap, or on a boundary curve.
    pub(super) fn given(&self, sector: usize, i: usize, j: usize) -> Option<Terms<T>> {
        let mut terms = Vec::new();
        let mut add = |node: Terms<T>, weight: f64| {
            terms.extend(node.into_iter().map(|(column, times)| (column, times.times(weight))));
        };
        let place = sector as isize;
        if i >= INNER || j >= INNER {
            for (across, &weight) in jet(i.max(j).saturating_sub(INNER)).iter().enumerate() {
                let (across, other) = (across as isize, i.min(j));
                for (along, share) in (-1..).zip(cubic(other)) {
                    let [u, v] = if i >= j { [across, along] } else { [along, across] };
                    add(self.node(place, u, v), weight * share);
                }
            }
            return Some(terms);
        }
        let last = self.sectors - 1;
        let edge = match self.ends {
            Ends::Smooth | Ends::Corner if sector == 0 && j == 0 => 0,
            Ends::Smooth | Ends::Corner if sector == last && i == 0 => place + 1,
            _ => return None,
        };
        let [beyond, middle, near, far] = cubic(i.max(j));
        match self.ends {
            Ends::Smooth => add(self.on_edge(self.sectors as isize - edge, 1), beyond),
            _ => {
                add(self.on_edge(edge, 0), 2.0 * beyond);
                add(self.on_edge(edge, 1), -beyond);
            }
        }
        add(self.on_edge(edge, 0), middle);
        add(self.on_edge(edge, 1), near);
        add(self.on_edge(edge, 2), far);
        Some(terms)
    }
}

impl CapClass {
    /// The angle of a sector in the plane of the natural configuration, in radians.
    pub(super) fn sector_angle(self) -> f64 {
        use std::f64::consts::{PI, TAU};
        let whole = match self {
            CapClass::Interior { .. } | CapClass::Dart { .. } => TAU,
            CapClass::Boundary { .. } => PI,
            CapClass::Corner { angle, .. } => angle.radians(),
        };
        whole / self.sectors() as f64
    }
}
