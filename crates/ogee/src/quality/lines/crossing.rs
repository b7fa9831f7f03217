//! Crossings of lines with edges of cells, each found once.

use super::lattice::Lattice;
use super::march::{Crossing, Key};
use super::probe::{Probe, Spot};
use crate::math::par;

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

/// All crossings, by key; those of `known`, which are sorted, are not sought again.
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
    let chunks = par::map(nodes.len().div_ceil(CHUNK), |chunk| {
        let mut probe = probe();
        let nodes = nodes.iter().skip(chunk * CHUNK).take(CHUNK);
        let found = nodes.map(|node| match known.binary_search_by_key(&node.key, |known| known.key) {
            Ok(place) => known[place],
            Err(_) => {
                let found = solve(node, value(node.key.index), lattice, tolerance, &mut probe);
                Node { found, ..*node }
            }
        });
        found.collect::<Vec<Node>>()
    });
    chunks.concat()
}

/// Newton's method between two places on either side of the value; where it would leave them or is slow, halves.
fn solve(
    node: &Node,
    value: f64,
    lattice: &Lattice<'_>,
    tolerance: f64,
    probe: &mut Probe<'_>,
) -> Option<(f64, Spot)> {
    /// More than Newton's method takes from any start from which it converges.
    const EAGER: usize = 12;
    /// Halvings that leave nothing between the ends.
    const STEPS: usize = EAGER + 60;
    let edge = node.key.edge;
    let (pace, axis) = (lattice.pace(edge), usize::from(edge.axis));
    let [a, b] = node.ends.map(|end| end - value);
    let (mut low, mut high) = (0.0, 1.0);
    let mut x = a / (a - b);
    for step in 0..STEPS {
        let spot = probe.spot(lattice.along(edge, x));
        let rest = spot.value? - value;
        if rest.abs() <= tolerance {
            return Some((x, spot));
        }
        if (rest < 0.0) == (a < 0.0) {
            low = x;
        } else {
            high = x;
        }
        let newton = spot.slope.map(|slope| x - rest / (pace * slope.field[axis]));
        x = match newton.filter(|next| step < EAGER && *next > low && *next < high) {
            Some(next) => next,
            None => 0.5 * (low + high),
        };
    }
    None
}
