//! Weights of places over the ring of a tail: what all tails of one kind share.
//!
//! Position and derivatives at a place are sums over the points of the ring, relative to the first of them, with weights that depend on the place and the
//! kind of tail alone. They are what evaluation gives where one of the points is 1 and the others are 0; four such cases
//! go side by side, as coordinates.
//!
//! Where four places are the corners of a rectangle in one tile, position and second derivatives are summed, and first
//! derivatives follow: along a side the surface is a cubic, which its ends and its second derivatives there decide. The
//! other way round a small second derivative would be what is left of large differences.

use super::Derivatives;
use super::bicubic::{self, Net};
use super::evaluate::Item;
use super::out::{LANES, Lie, Put};
use super::place::{in_chain, power_of_two};
use crate::math::simd::{Four, Plain};
use crate::patch::{ChainBasis, Kind, TURNED, Wide};

/// The most points of a ring that has weights: those of valence 28. With more, sums are no quicker than steps.
pub(super) const MOST_POINTS: usize = 64;

/// The most places that have weights: those of a kind have to stay in the processor's cache.
const MOST_PLACES: usize = 64;

/// Steps down a chain to which there are weights. Deeper, a sum loses digits that a walk keeps, whose ring stays relative to
/// a point near it.
const STEPS: usize = 4;

/// The same at a lens, whose rings shrink by 1/4 in every step and so lose digits twice as fast.
const LENS_STEPS: usize = 2;

/// The shortest side of a rectangle, in the parameters of the piece: roundings of its ends are divided by it.
const SHORTEST: f64 = 1.0 / 8.0;

/// Weights of some places in a tail over the points of its ring.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// How many points, the first left out.
    points: usize,
    quartets: Vec<Quartet>,
    /// For each quartet, and each round, point after point the weights of some parts of the jet, places in lanes.
    lanes: Vec<Wide>,
    /// The numbers of places that have no weights: too deep in a chain, or its end.
    pub(super) without: Vec<u32>,
}

/// Quartet places side by side.
#[derive(Clone, Debug)]
pub(super) struct Quartet {
    /// Their numbers; if there are fewer, the last again.
    places: [u32; LANES],
    count: usize,
    lie: Lie,
    /// If they are the corners of a rectangle.
    pub(super) sides: Option<Sides>,
    /// Where their weights begin.
    first: usize,
}

/// A rectangle in one tile, whose corners are `(u0, v0)`, `(u1, v0)`, `(u0, v1)`, `(u1, v1)`: what makes first derivatives
/// along its sides.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    pub(super) along_u: Side,
    pub(super) along_v: Side,
}

/// What makes the slopes of cubics at both ends, ends in lanes.
#[derive(Clone, Debug)]
pub(super) struct Side {
    /// Times the other end less this one.
    pub(super) chord: Wide,
    /// Times twice the second derivative here and once that at the other end.
    pub(super) bend: Wide,
}

impl Side {
    /// Of cubics over an interval so long; `far` are the lanes of its second end.
    fn new(length: f64, far: [bool; LANES]) -> Side {
        let [chord, bend] = [1.0 / length, -length / 6.0].map(|x| far.map(|far| if far { -x } else { x }));
        Side { chord, bend }
    }
}

impl Quartet {
    /// Where results go that start at `first`.
    #[inline(always)]
    pub(super) fn put(&self, first: usize) -> Put {
        let mut indices = [0; LANES];
        for l in 0..LANES {
            indices[l] = first + self.places[l] as usize;
        }
        Put { indices, count: self.count, lie: self.lie }
    }
}

/// Parts of the jet that are summed, and how many at a time, so that there are registers for them.
fn order(what: Derivatives, in_rectangle: bool) -> (&'static [usize], usize) {
    match what {
        Derivatives::None => (&[0], 1),
        Derivatives::First => (&[0, 1, 2], 3),
        Derivatives::Second if in_rectangle => (&[0, 3, 4, 5], 2),
        Derivatives::Second => (&[0, 1, 2, 3, 4, 5], 3),
    }
}

/// Where a place lies: how often its tile was halved, the tile, and the parameters in it.
#[derive(Clone, Copy)]
struct Spot {
    number: u32,
    step: usize,
    tile: usize,
    u: f64,
    v: f64,
}

impl Weights {
    /// Over the ring of a tail whose irregular corner is `corner`.
    pub(super) fn new(
        basis: &ChainBasis,
        corner: u32,
        items: &[Item],
        depth: i32,
        what: Derivatives,
    ) -> Weights {
        let points = basis.ring_count() - 1;
        let pays = !basis.has_quarters() && points < MOST_POINTS && items.len() <= MOST_PLACES;
        let steps = if let Kind::Lens { .. } = basis.kind { LENS_STEPS } else { STEPS };
        let (mut spots, mut without) = (Vec::new(), Vec::new());
        for &Item { u, v, index } in items {
            let (key, u, v) = in_chain(corner, u, v);
            let (step, tile) = ((key >> 2) as usize, (key & 3) as usize);
            // Step 0 is the vertex itself.
            if pays && (1..=steps).contains(&step) {
                spots.push(Spot { number: index, step, tile, u, v });
            } else {
                without.push(index);
            }
        }
        let mut weights = Weights { points, quartets: Vec::new(), lanes: Vec::new(), without };
        let spots = weights.room(spots, depth, what);
        let deepest = spots.iter().map(|spot| spot.step).max().unwrap_or(0);
        let mut fine = vec![[0.0; 4]; basis.work_count()];
        for group in 0..points.div_ceil(LANES) {
            let mut ring: Vec<Wide> = (0..basis.work_count()).map(|point| unit(point, group)).collect();
            for step in 1..=deepest {
                basis.step(&mut ring, &mut fine);
                for (tile, numbers) in basis.tiles.iter().enumerate() {
                    let control =
                        TURNED[corner as usize].map(|point| fine[numbers[usize::from(point)] as usize]);
                    let net = bicubic::coefficients_of(&control);
                    let here = |&(_, spot): &(usize, &Spot)| spot.step == step && spot.tile == tile;
                    for (place, spot) in spots.iter().enumerate().filter(here) {
                        weights.set(place, group, &net, spot, depth, what);
                    }
                }
                std::mem::swap(&mut ring, &mut fine);
            }
        }
        weights
    }

    /// Puts spots into quartets, without weights yet, and gives the spot of each lane: rectangles first, where these save sums.
    fn room(&mut self, mut spots: Vec<Spot>, depth: i32, what: Derivatives) -> Vec<Spot> {
        let (mut lanes, mut rest) = (Vec::new(), Vec::new());
        while what == Derivatives::Second && !spots.is_empty() {
            let Some(corners) = rectangle(&spots) else {
                rest.push(spots.remove(0));
                continue;
            };
            let four = corners.map(|corner| spots[corner]);
            let scale = power_of_two(depth + four[0].step as i32);
            let along_u = Side::new((four[1].u - four[0].u) / scale, [false, true, false, true]);
            let along_v = Side::new((four[2].v - four[0].v) / scale, [false, false, true, true]);
            self.push(&four, Some(Sides { along_u, along_v }), what);
            lanes.extend(four);
            spots.retain(|spot| four.iter().all(|corner| corner.number != spot.number));
        }
        rest.append(&mut spots);
        for some in rest.chunks(LANES) {
            self.push(some, None, what);
            lanes.extend((0..LANES).map(|l| some[l.min(some.len() - 1)]));
        }
        lanes
    }

    /// Room for up to four places.
    fn push(&mut self, spots: &[Spot], sides: Option<Sides>, what: Derivatives) {
        let places = std::array::from_fn(|l| spots[l.min(spots.len() - 1)].number);
        let (first, (parts, _)) = (self.lanes.len(), order(what, sides.is_some()));
        self.lanes.resize(first + parts.len() * self.points, [0.0; 4]);
        self.quartets.push(Quartet { places, count: spots.len(), lie: Lie::of(&places), sides, first });
    }

    /// The weights of a place over four points, from the patch that these make.
    fn set(&mut self, place: usize, group: usize, net: &Net, spot: &Spot, depth: i32, what: Derivatives) {
        let Quartet { sides, first, .. } = &self.quartets[place / LANES];
        let scale = power_of_two(depth + spot.step as i32);
        let scales = [1.0, scale, scale, scale * scale, scale * scale, scale * scale];
        let jet = bicubic::one::<6, Plain>(net, Plain::splat(spot.u), Plain::splat(spot.v)).map(Plain::store);
        let (parts, at_once) = order(what, sides.is_some());
        for (k, &part) in parts.iter().enumerate() {
            for (point, value) in (LANES * group..self.points).zip(jet[part]) {
                let row = k / at_once * self.points + point;
                self.lanes[first + row * at_once + k % at_once][place % LANES] = scales[part] * value;
            }
        }
    }

    /// Places by fours; none if no place has weights.
    #[inline(always)]
    pub(super) fn quartets(&self) -> &[Quartet] {
        &self.quartets
    }

    /// The weights of a quartet in one round, of so many parts.
    #[inline(always)]
    pub(super) fn of<const PARTS: usize>(&self, quartet: &Quartet, round: usize) -> &[Wide] {
        let length = self.points * PARTS;
        &self.lanes[quartet.first + round * length..][..length]
    }
}

/// The first spot and three others, if they are the corners of a rectangle in one tile that is large enough.
fn rectangle(spots: &[Spot]) -> Option<[usize; LANES]> {
    let first = &spots[0];
    let shortest = SHORTEST * power_of_two(first.step as i32);
    let far = |from: f64, to: f64| (to - from).abs() >= shortest;
    let together = |spot: &Spot| (spot.step, spot.tile) == (first.step, first.tile);
    let find = |u: f64, v: f64| spots.iter().position(|spot| together(spot) && spot.u == u && spot.v == v);
    let on_line = |spot: &&Spot| together(spot) && spot.v == first.v && far(first.u, spot.u);
    spots.iter().filter(on_line).find_map(|right| {
        let on_line = |spot: &&Spot| together(spot) && spot.u == first.u && far(first.v, spot.v);
        spots.iter().filter(on_line).find_map(|above| {
            Some([0, find(right.u, first.v)?, find(first.u, above.v)?, find(right.u, above.v)?])
        })
    })
}

/// Four cases side by side, of which one has this point for its 1; the first point has none.
fn unit(point: usize, group: usize) -> Wide {
    std::array::from_fn(|l| if point == 1 + LANES * group + l { 1.0 } else { 0.0 })
}
