//! Ten stars in a spiral.

use ogee::Vec3;

use super::builder::Builder;
use super::profile::direction;
use super::{Form, Model};

/// For each star after the first, which arm holds the next, counted from the arm that holds the one before.
const NEXT: [usize; 8] = [2, 2, 2, 3, 3, 4, 4, 4];
/// Half the width of an arm at its root, its length from there, the gap in which two arms meet.
const ARM: f64 = 5.0;
const REACH: f64 = 17.0;
const GAP: f64 = 7.0;

/// The six vertices around the end of an arm: below from right to left, above from left to right, seen
/// along the arm from the star.
type End = Vec<u32>;

pub(super) fn model() -> Model {
    let mut b = Builder::default();
    let mut heading = 0.0;
    let mut centre = Vec3::ZERO;
    // The arm that waits for the next star.
    let mut waiting: Option<End> = None;
    for arms in 3..=12 {
        let phase = if waiting.is_some() { heading + 0.5 } else { heading };
        let ends = star(&mut b, centre, arms, phase);
        let mut joined = vec![false; arms];
        if let Some(before) = waiting.take() {
            // Face to face, left and right change places.
            let here = [2, 1, 0, 5, 4, 3].map(|k| ends[0][k]);
            b.bridge(&before, &here);
            joined[0] = true;
        }
        if arms < 12 {
            let next = if arms == 3 { 0 } else { NEXT[arms - 4] };
            heading = phase + next as f64 / arms as f64;
            centre += direction(heading) * (radius(arms) + radius(arms + 1) + GAP);
            waiting = Some(ends[next].clone());
            joined[next] = true;
        }
        for (end, _) in ends.iter().zip(joined).filter(|(_, joined)| !joined) {
            b.face(&[end[0], end[1], end[4], end[5]]);
            b.face(&[end[1], end[2], end[3], end[4]]);
        }
    }
    Model {
        name: "stars",
        about: &[
            "Ten starfish hand in hand along a spiral, with three to twelve arms.",
            "Exercises every valence from 3 to 12; between two arms a 6 touches the middle of the star.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}

/// Where the arms part.
fn root(arms: usize) -> f64 {
    1.3 * ARM / (std::f64::consts::PI / arms as f64).sin()
}

/// Where they end.
fn radius(arms: usize) -> f64 {
    root(arms) + REACH
}

/// One star with open arms, the first after `phase` of a turn; returns the ends of the arms.
fn star(b: &mut Builder, centre: Vec3, arms: usize, phase: f64) -> Vec<End> {
    let up = Vec3::new(0.0, 0.0, 1.0);
    let height = 6.0 + 0.22 * root(arms);
    let step = 1.0 / arms as f64;
    let turn = |i: usize, part: f64| direction(phase + (i as f64 + part) * step);
    // Below and above alike: the middle, the valleys between arms, the root of each arm's ridge.
    let mut side = |sign: f64| -> (u32, Vec<u32>, Vec<u32>) {
        let middle = b.point(centre + up * (sign * height));
        let valleys = (0..arms).map(|i| centre + turn(i, -0.5) * root(arms) + up * (sign * 4.4));
        let valleys = b.points(valleys);
        let ridge = 0.9 * root(arms) * (std::f64::consts::PI * step).cos() + 0.25 * REACH;
        let ridges = (0..arms).map(|i| centre + turn(i, 0.0) * ridge + up * (sign * 7.4));
        (middle, valleys, b.points(ridges))
    };
    let (low, low_valleys, low_ridges) = side(-1.0);
    let (high, high_valleys, high_ridges) = side(1.0);
    let mut ends = Vec::new();
    for i in 0..arms {
        let j = (i + 1) % arms;
        b.face(&[high, high_valleys[i], high_ridges[i], high_valleys[j]]);
        b.face(&[low, low_valleys[j], low_ridges[i], low_valleys[i]]);
        let foot = vec![
            low_valleys[i],
            low_ridges[i],
            low_valleys[j],
            high_valleys[j],
            high_ridges[i],
            high_valleys[i],
        ];
        let along = turn(i, 0.0);
        let left = up.cross(along);
        let mut ring = |reach: f64, wide: f64, edge: f64, ridge: f64| {
            let p = centre + along * reach;
            let corner = |x: f64, z: f64| p + left * x + up * z;
            b.points([
                corner(-wide, -edge),
                corner(0.0, -ridge),
                corner(wide, -edge),
                corner(wide, edge),
                corner(0.0, ridge),
                corner(-wide, edge),
            ])
        };
        let rings = [
            foot,
            ring(root(arms) + 0.55 * REACH, 0.86 * ARM, 3.6, 6.0),
            ring(radius(arms), 0.62 * ARM, 2.8, 4.2),
        ];
        b.loft(&rings);
        ends.push(rings[2].clone());
    }
    ends
}
