//! Weights of places over the ring of a tail: what all tails of one kind share.
//!
//! Position and derivatives at a place are sums over the points of the ring, with weights that depend on the place and the
//! kind of tail alone. They are what evaluation gives where one of the points is 1 and the others are 0; four such cases
//! go side by side, as coordinates.

use super::Derivatives;
use super::bicubic::{self, Net};
use super::evaluate::Item;
use super::out::LANES;
use super::place::{in_chain, power_of_two};
use crate::math::simd::{Four, Plain};
use crate::patch::{ChainBasis, TURNED, Wide};

/// The most points of a ring that has weights: those of valence 28. With more, sums are no quicker than steps.
pub(super) const MOST_POINTS: usize = 64;

/// The most places that have weights: those of a kind have to stay in the processor's cache.
const MOST_PLACES: usize = 64;

/// Steps down a chain to which there are weights. Deeper, a sum loses digits that a walk keeps, whose ring stays relative to
/// a point near it.
const STEPS: usize = 4;

/// Weights of some places in a tail over the points of its ring.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// How many points.
    points: usize,
    order: Order,
    /// For each four places, and each round, point after point the weights of some parts of the jet, places in lanes.
    lanes: Vec<Wide>,
    /// The numbers of places that have no weights: too deep in a chain, or its end. Their lanes are those of another.
    pub(super) without: Vec<u32>,
}

/// How the parts of a jet are summed: as many at a time as there are registers for.
#[derive(Clone, Copy, Debug)]
struct Order {
    rounds: usize,
    parts: usize,
}

impl Order {
    fn of(what: Derivatives) -> Order {
        let (rounds, parts) = match what {
            Derivatives::None => (1, 1),
            Derivatives::First => (1, 3),
            Derivatives::Second => (2, 3),
        };
        Order { rounds, parts }
    }
}

/// Where a place lies: how often its tile was halved, the tile, and the parameters in it.
#[derive(Clone, Copy)]
struct Spot {
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
        let count = basis.ring_count();
        let pays = !basis.has_quarters() && count <= MOST_POINTS && items.len() <= MOST_PLACES;
        let spots = items.iter().map(|item| {
            let (key, u, v) = in_chain(corner, item.u, item.v);
            let (step, tile) = ((key >> 2) as usize, (key & 3) as usize);
            // Step 0 is the vertex itself.
            (pays && (1..=STEPS).contains(&step)).then_some(Spot { step, tile, u, v })
        });
        let (mut weights, spots) = Weights::room(count, items, spots.collect(), what);
        let deepest = spots.iter().map(|spot| spot.step).max().unwrap_or(0);
        let mut fine = vec![[0.0; 4]; basis.work_count()];
        for group in 0..count.div_ceil(LANES) {
            let mut ring: Vec<Wide> = (0..basis.work_count()).map(|point| unit(point, group)).collect();
            for step in 1..=deepest {
                basis.step(&mut ring, &mut fine);
                for (tile, numbers) in basis.tiles.iter().enumerate() {
                    let control =
                        TURNED[corner as usize].map(|point| fine[numbers[usize::from(point)] as usize]);
                    let net = bicubic::coefficients_of(&control);
                    let here = |&(_, spot): &(usize, &Spot)| spot.step == step && spot.tile == tile;
                    for (place, spot) in spots.iter().enumerate().filter(here) {
                        weights.set(place, group, &net, spot, depth);
                    }
                }
                std::mem::swap(&mut ring, &mut fine);
            }
        }
        weights
    }

    /// No weights yet, and for each lane where its place lies: for a place that is to have none, and for lanes left over,
    /// where another does.
    fn room(
        points: usize,
        items: &[Item],
        spots: Vec<Option<Spot>>,
        what: Derivatives,
    ) -> (Weights, Vec<Spot>) {
        let order = Order::of(what);
        let without = items.iter().zip(&spots).filter(|(_, spot)| spot.is_none()).map(|(item, _)| item.index);
        let mut weights = Weights { points, order, lanes: Vec::new(), without: without.collect() };
        let Some(any) = spots.iter().copied().flatten().next() else {
            return (weights, Vec::new());
        };
        let fours = spots.len().div_ceil(LANES);
        weights.lanes.resize(fours * order.rounds * points * order.parts, [0.0; 4]);
        let mut spots: Vec<Spot> = spots.into_iter().map(|spot| spot.unwrap_or(any)).collect();
        spots.resize(fours * LANES, any);
        (weights, spots)
    }

    /// The weights of a place over four points, from the patch that these make.
    fn set(&mut self, place: usize, group: usize, net: &Net, spot: &Spot, depth: i32) {
        let Order { rounds, parts } = self.order;
        let scale = power_of_two(depth + spot.step as i32);
        let scales = [1.0, scale, scale, scale * scale, scale * scale, scale * scale];
        let jet = bicubic::one::<6, Plain>(net, Plain::splat(spot.u), Plain::splat(spot.v)).map(Plain::store);
        for part in 0..rounds * parts {
            for (point, value) in (LANES * group..self.points).zip(jet[part]) {
                let row = (place / LANES * rounds + part / parts) * self.points + point;
                self.lanes[row * parts + part % parts][place % LANES] = scales[part] * value;
            }
        }
    }

    /// False if no place has weights.
    pub(super) fn are_there(&self) -> bool {
        !self.lanes.is_empty()
    }

    /// The weights of four places in one round.
    #[inline(always)]
    pub(super) fn of_four(&self, four: usize, round: usize) -> &[Wide] {
        let length = self.points * self.order.parts;
        &self.lanes[(four * self.order.rounds + round) * length..][..length]
    }
}

/// Four cases side by side, of which one has this point for its 1.
fn unit(point: usize, group: usize) -> Wide {
    std::array::from_fn(|l| if point == LANES * group + l { 1.0 } else { 0.0 })
}
