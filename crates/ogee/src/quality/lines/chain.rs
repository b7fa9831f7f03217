//! Chains: the line from one side of a cell to another, as closely as asked, as far as it is wanted.

use super::lattice::Lattice;
use super::march::{Key, Segment};
use super::probe::{Probe, Slope, Spot};
use super::wanted::Wanted;
use super::{LineOptions, LinePoint};
use crate::math::Vec3;
use crate::patch::Location;

/// Where lines are wanted, and how closely.
pub(super) struct Tracer<'a> {
    pub(super) lattice: &'a Lattice<'a>,
    pub(super) options: &'a LineOptions<'a>,
    /// What the field may be off by.
    pub(super) residual: f64,
    pub(super) wanted: &'a Wanted<'a>,
}

/// A part of a line that is wanted. It starts and ends at crossings, or is cut there.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) index: i64,
    /// The crossings.
    pub(super) ends: [Option<Key>; 2],
    /// The points between them, with the places where it was cut.
    pub(super) inner: Vec<LinePoint>,
    /// By how much a point between them misses the value at most.
    pub(super) residual: f64,
}

/// What became of a point that was moved onto a line.
enum Moved {
    /// It is there.
    On(Spot),
    /// It cannot leave the square; the line is about this far outside.
    Outside(Spot, f64),
    /// There is no way.
    Lost,
}

/// Of the tolerance: how far points of the line that are looked at may be off, as others may be farther.
const CAUTION: f64 = 0.8;

/// Of the tolerance: how closely lines are cut off.
const CUT: f64 = 1.0 / 16.0;

/// Of the tolerance: where the ends alone say that a chord is as close, nothing between them is looked at.
const PLAIN: f64 = 0.25;

/// A chord is halved so often at most.
const HALVINGS: u32 = 12;

impl<'a> Tracer<'a> {
    /// True if a point is wanted.
    fn wants(&self, spot: &Spot) -> bool {
        self.wanted.is_here(spot.position, spot.normal)
    }

    /// The points of the line between both ends of a segment, in the parameters of its own square. `None` if it does not
    /// stay in the square, or cannot be followed.
    pub(super) fn follow(
        &self,
        segment: &Segment,
        ends: [&Spot; 2],
        value: f64,
        probe: &mut Probe<'_>,
    ) -> Option<Vec<Spot>> {
        let mut way = self.way(segment, value, probe);
        way.bend(ends[0], ends[1], HALVINGS)?;
        Some(way.points)
    }

    fn way<'b, 'c>(&'b self, segment: &Segment, value: f64, probe: &'b mut Probe<'c>) -> Way<'b, 'c> {
        let square = self.lattice.layout.squares()[segment.ends[0].own.square as usize];
        let [u, v] = square.corner.parameters();
        let within = [[u, u + square.size[0]], [v, v + square.size[1]]];
        Way { tracer: self, probe, value, within, points: Vec::new() }
    }

    /// The parts of a chain that are wanted; the crossings of the segment are its first and last spot.
    pub(super) fn clip(
        &self,
        segment: &Segment,
        chain: &[Spot],
        value: f64,
        probe: &mut Probe<'_>,
    ) -> Vec<Piece> {
        let index = segment.ends[0].key.index;
        let wanted: Vec<bool> = chain.iter().map(|spot| self.wants(spot)).collect();
        let last = chain.len() - 1;
        let mut pieces: Vec<Piece> = Vec::new();
        for (k, spot) in chain.iter().enumerate() {
            if !wanted[k] {
                continue;
            }
            if k == 0 || !wanted[k - 1] {
                let start = (k == 0).then_some(segment.ends[0].key);
                pieces.push(Piece { index, ends: [start, None], inner: Vec::new(), residual: 0.0 });
            }
            let Some(piece) = pieces.last_mut() else { continue };
            let mut add = |spot: &Spot| {
                piece.inner.push(LinePoint { at: spot.at, position: spot.position });
                let rest = spot.value.map_or(f64::INFINITY, |found| (found - value).abs());
                piece.residual = piece.residual.max(rest);
            };
            if k > 0 && !wanted[k - 1] {
                self.cut(segment, spot, &chain[k - 1], value, probe).iter().for_each(&mut add);
            }
            if k > 0 && k < last {
                add(spot);
            }
            if k < last && !wanted[k + 1] {
                self.cut(segment, spot, &chain[k + 1], value, probe).iter().for_each(&mut add);
            }
            if k == last {
                piece.ends[1] = Some(segment.ends[1].key);
            }
        }
        pieces
    }

    /// The last point that is wanted on the way to one that is not, unless it is where the way begins.
    fn cut(
        &self,
        segment: &Segment,
        wanted: &Spot,
        other: &Spot,
        value: f64,
        probe: &mut Probe<'_>,
    ) -> Option<Spot> {
        let mut way = self.way(segment, value, probe);
        let (mut inside, mut outside, mut is_moved) = (*wanted, *other, false);
        for _ in 0..2 * HALVINGS {
            if inside.position.distance(outside.position) <= CUT * self.options.tolerance {
                break;
            }
            let Moved::On(middle) = way.onto_line(&inside, &outside, 0.5) else { break };
            if self.wants(&middle) {
                (inside, is_moved) = (middle, true);
            } else {
                outside = middle;
            }
        }
        is_moved.then_some(inside)
    }
}

/// The way of a line through a square.
struct Way<'a, 'b> {
    tracer: &'a Tracer<'a>,
    probe: &'a mut Probe<'b>,
    value: f64,
    /// The parameters of the square: from and to, in each direction.
    within: [[f64; 2]; 2],
    points: Vec<Spot>,
}

impl Way<'_, '_> {
    /// Adds points between two until chords are as close to the line as asked.
    fn bend(&mut self, from: &Spot, to: &Spot, halvings: u32) -> Option<()> {
        let tolerance = CAUTION * self.tracer.options.tolerance;
        let chord = from.position.distance(to.position);
        if chord <= tolerance {
            return Some(());
        }
        let is_short = chord <= self.tracer.options.longest;
        if is_short && bulge(from, to).is_some_and(|bulge| bulge <= PLAIN * tolerance) {
            return Some(());
        }
        // The middle first: where the line bends one way, it is the farthest. The quarters are for where it bends both ways.
        let (mut middle, mut is_close) = (None, is_short);
        for share in [0.5, 0.25, 0.75] {
            match self.onto_line(from, to, share) {
                Moved::On(spot) => {
                    let chosen = from.position.lerp(to.position, share);
                    if chosen.distance(spot.position) > chord {
                        return None;
                    }
                    is_close &= from_chord(spot.position, from.position, to.position) <= tolerance;
                    middle = middle.or(Some(spot));
                }
                Moved::Outside(spot, farther) => {
                    let off = from_chord(spot.position, from.position, to.position) + farther;
                    if off > tolerance {
                        return None;
                    }
                }
                Moved::Lost => return None,
            }
            if !is_close {
                break;
            }
        }
        let Some(middle) = middle.filter(|_| !is_close) else { return Some(()) };
        let halvings = halvings.checked_sub(1)?;
        self.bend(from, &middle, halvings)?;
        self.points.push(middle);
        self.bend(&middle, to, halvings)
    }

    /// Moves a point of a chord onto the line, across it in the metric of the surface.
    fn onto_line(&mut self, from: &Spot, to: &Spot, share: f64) -> Moved {
        const STEPS: usize = 12;
        let ([a, b], [c, d]) = (from.at.parameters(), to.at.parameters());
        let mut at: Location = from.at.clamped(a + share * (c - a), b + share * (d - b));
        let mut outside = None;
        for _ in 0..STEPS {
            let spot = self.probe.spot(at);
            let Some(rest) = spot.value.map(|found| found - self.value) else { return Moved::Lost };
            if rest.abs() <= self.tracer.residual {
                return Moved::On(spot);
            }
            let Some((across, steepness)) = spot.slope.and_then(|slope| uphill(&slope)) else {
                return Moved::Lost;
            };
            let [u, v] = at.parameters();
            let [[u0, u1], [v0, v1]] = self.within;
            // A quarter of the square at most: what is farther is another line.
            let step = |k: usize, size: f64| (-rest * across[k]).clamp(-0.25 * size, 0.25 * size);
            let wanted = [u + step(0, u1 - u0), v + step(1, v1 - v0)];
            let next = [wanted[0].clamp(u0, u1), wanted[1].clamp(v0, v1)];
            outside = (next != wanted).then(|| (spot, rest.abs() / steepness));
            if next == [u, v] {
                break;
            }
            at = at.clamped(next[0], next[1]);
        }
        outside.map_or(Moved::Lost, |(spot, farther)| Moved::Outside(spot, farther))
    }
}

/// How far a cubic with the line's directions at its ends gets away from its chord at most; `None` if they are unknown, or
/// turn back.
fn bulge(from: &Spot, to: &Spot) -> Option<f64> {
    let chord = to.position - from.position;
    let along = chord.normalized()?;
    let slant = |spot: &Spot| {
        let direction = spot.slope?.direction()?;
        let forward = direction.dot(along);
        (forward > 0.5).then(|| direction.cross(along).length() / forward)
    };
    Some(4.0 / 27.0 * chord.length() * (slant(from)? + slant(to)?))
}

/// The change of parameters across the line that raises the field by 1, and how steep the field is there in space.
fn uphill(Slope { tangents: [du, dv], field: [a, b] }: &Slope) -> Option<([f64; 2], f64)> {
    let (e, f, g) = (du.dot(*du), du.dot(*dv), dv.dot(*dv));
    let determinant = e * g - f * f;
    let (x, y) = ((g * a - f * b) / determinant, (e * b - f * a) / determinant);
    let square = a * x + b * y;
    (determinant > 0.0 && square > 0.0 && square.is_finite())
        .then(|| ([x / square, y / square], square.sqrt()))
}

/// The distance of a point from a chord.
fn from_chord(point: Vec3, from: Vec3, to: Vec3) -> f64 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.dot(along)).clamp(0.0, 1.0);
    point.distance(from + share * along)
}
