//! Crossings of lines with edges of cells, each found once.

use super::lattice::{Edge, Lattice};
use super::march::{Crossing, Key};
use super::probe::{Probe, Spot};
use crate::math::par;
use crate::patch::Location;

/// A crossing under the name that all cells use.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) key: Key,
    /// The field at both ends of the edge.
    ends: [f64; 2],
    /// What was found: the place along the edge, from 0 to 1, and the surface there. `None` if the field leaps over the
    /// value instead.
    pub(super) found: Option<(f64, Spot)>,
}

/// Crossings that one task works through.
const CHUNK: usize = 256;

/// Those crossings, by key, that are not among the ones that are `known` and sorted.
pub(super) fn find<'a>(
    crossings: impl Iterator<Item = Crossing>,
    known: &[Node],
    lattice: &Lattice<'_>,
    value: impl Fn(i64) -> f64 + Sync + Send,
    tolerance: f64,
    probe: impl Fn() -> Probe<'a> + Sync + Send,
) -> Vec<Node> {
    let mut nodes: Vec<Node> =
        crossings.map(|Crossing { key, ends, .. }| Node { key, ends, found: None }).collect();
    nodes.sort_unstable_by_key(|node| node.key);
    nodes.dedup_by_key(|node| node.key);
    nodes.retain(|node| known.binary_search_by_key(&node.key, |known| known.key).is_err());
    let chunks = par::map(nodes.len().div_ceil(CHUNK), |chunk| {
        let mut chunk = nodes[chunk * CHUNK..nodes.len().min((chunk + 1) * CHUNK)].to_vec();
        let search = |node: &Node| Search::new(node, value(node.key.index), lattice);
        let mut searches: Vec<(usize, Search)> = chunk.iter().map(search).enumerate().collect();
        let mut probe = probe();
        // All of them a step at a time: many places are evaluated quicker than one.
        for step in 0..STEPS {
            let at: Vec<Location> =
                searches.iter().map(|(_, search)| lattice.along(search.edge, search.x)).collect();
            let spots: Vec<Spot> = probe.spots(&at).collect();
            let mut spots = spots.into_iter();
            searches.retain_mut(|(number, search)| {
                let Some(spot) = spots.next() else { return false };
                match search.advance(&spot, step, tolerance) {
                    Progress::Found => chunk[*number].found = Some((search.x, spot)),
                    Progress::None => {}
                    Progress::More => return true,
                }
                false
            });
            if searches.is_empty() {
                break;
            }
        }
        chunk
    });
    chunks.concat()
}

/// More steps than Newton's method takes from any start from which it converges.
const EAGER: usize = 12;

/// Steps of which the last ones, halvings, leave nothing between the ends.
const STEPS: usize = EAGER + 60;

/// A crossing that is sought: Newton's method between two places on either side of the value; where it would leave them,
/// or is slow, halves.
struct Search {
    edge: Edge,
    value: f64,
    starts_below: bool,
    /// Of the parameter of a location, per unit along the edge.
    pace: f64,
    low: f64,
    high: f64,
    /// The place that is looked at next.
    x: f64,
}

/// What a step of a search came to.
enum Progress {
    Found,
    /// The field has no value here.
    None,
    More,
}

impl Search {
    fn new(node: &Node, value: f64, lattice: &Lattice<'_>) -> Search {
        let edge = node.key.edge;
        let [a, b] = node.ends.map(|end| end - value);
        let (pace, x) = (lattice.pace(edge), a / (a - b));
        Search { edge, value, starts_below: a < 0.0, pace, low: 0.0, high: 1.0, x }
    }

    fn advance(&mut self, spot: &Spot, step: usize, tolerance: f64) -> Progress {
        let Some(found) = spot.value else { return Progress::None };
        let rest = found - self.value;
        if rest.abs() <= tolerance {
            return Progress::Found;
        }
        if (rest < 0.0) == self.starts_below {
            self.low = self.x;
        } else {
            self.high = self.x;
        }
        let axis = usize::from(self.edge.axis);
        let newton = spot.slope.map(|slope| self.x - rest / (self.pace * slope.field[axis]));
        let is_within = |next: &f64| step < EAGER && *next > self.low && *next < self.high;
        self.x = newton.filter(is_within).unwrap_or(0.5 * (self.low + self.high));
        Progress::More
    }
}
