//! From the parameters of a mesh to those of the pixel: Newton's method on the projection.

use ogee::quality::{Layout, Side, Surface};
use ogee::{Derivatives, Location, Samples};

use crate::View;

/// A pixel and a place on the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) pixel: [f64; 2],
    pub(crate) square: u32,
    pub(crate) at: [f64; 2],
}

/// Steps for pixels that belong to the face beyond a side, and those at outlines.
const STEPS_MORE: usize = 8;

/// A step longer than this leaves the region in which it can be trusted.
const LONGEST: f64 = 0.15;

/// Of a pixel: where more is left than this, more steps are worth it.
const DONE: f64 = 1e-3;

/// Moves places to where the middle of their pixel shows the surface, and gives the surface there.
///
/// The mesh is so fine that one step comes close enough nearly everywhere.
pub(crate) fn solve(surface: &dyn Surface, view: &View, spots: &mut [Spot], what: Derivatives) -> Samples {
    let mut samples = Samples::default();
    let mut at: Vec<Location> = Vec::with_capacity(spots.len());
    steps(surface, view, spots, &mut at, &mut samples);
    evaluate(surface, spots.iter(), what, &mut at, &mut samples);
    let far: Vec<usize> =
        (0..spots.len()).filter(|&i| residual(view, &spots[i], &samples, i) > DONE).collect();
    if far.is_empty() {
        return samples;
    }
    // Steps that stopped at a side, or that have not come near.
    let mut lost: Vec<Spot> = far.iter().map(|&i| spots[i]).collect();
    let mut more = Samples::default();
    let mut left: Vec<usize> = (0..lost.len()).collect();
    for _ in 0..STEPS_MORE {
        evaluate(surface, left.iter().map(|&i| &lost[i]), Derivatives::First, &mut at, &mut more);
        let mut next = Vec::new();
        for (k, &i) in left.iter().enumerate() {
            if residual(view, &lost[i], &more, k) > DONE {
                step(surface.layout(), view, &mut lost[i], &more, k);
                next.push(i);
            }
        }
        left = next;
        if left.is_empty() {
            break;
        }
    }
    evaluate(surface, lost.iter(), what, &mut at, &mut more);
    for (k, &i) in far.iter().enumerate() {
        spots[i] = lost[k];
        copy(&more, k, &mut samples, i);
    }
    samples
}

/// One point of many to its place among others.
fn copy(from: &Samples, k: usize, to: &mut Samples, i: usize) {
    let vectors = [
        (&from.position, &mut to.position),
        (&from.du, &mut to.du),
        (&from.dv, &mut to.dv),
        (&from.normal, &mut to.normal),
        (&from.duu, &mut to.duu),
        (&from.duv, &mut to.duv),
        (&from.dvv, &mut to.dvv),
    ];
    for (from, to) in vectors {
        if let (Some(&from), Some(to)) = (from.get(k), to.get_mut(i)) {
            *to = from;
        }
    }
    to.flags[i] = from.flags[k];
}

/// One step for all.
fn steps(
    surface: &dyn Surface,
    view: &View,
    spots: &mut [Spot],
    at: &mut Vec<Location>,
    samples: &mut Samples,
) {
    evaluate(surface, spots.iter(), Derivatives::First, at, samples);
    for (i, spot) in spots.iter_mut().enumerate() {
        step(surface.layout(), view, spot, samples, i);
    }
}

/// How many pixels away the points are before and after each of so many steps.
pub(crate) fn residuals(surface: &dyn Surface, view: &View, spots: &[Spot], count: usize) -> Vec<Vec<f64>> {
    let (mut spots, mut at, mut samples) = (spots.to_vec(), Vec::new(), Samples::default());
    let mut all = Vec::new();
    for _ in 0..=count {
        evaluate(surface, spots.iter(), Derivatives::First, &mut at, &mut samples);
        all.push((0..spots.len()).map(|i| residual(view, &spots[i], &samples, i)).collect());
        for (i, spot) in spots.iter_mut().enumerate() {
            step(surface.layout(), view, spot, &samples, i);
        }
    }
    all
}

fn evaluate<'a>(
    surface: &dyn Surface,
    spots: impl Iterator<Item = &'a Spot>,
    what: Derivatives,
    at: &mut Vec<Location>,
    samples: &mut Samples,
) {
    let squares = surface.layout().squares();
    at.clear();
    at.extend(spots.map(|spot| squares[spot.square as usize].at(spot.at[0], spot.at[1])));
    surface.evaluate(at, what, samples);
}

/// How many pixels away the point is.
fn residual(view: &View, spot: &Spot, samples: &Samples, i: usize) -> f64 {
    let pixel = view.pixel(view.to_camera(samples.position[i]));
    (spot.pixel[0] - pixel[0]).hypot(spot.pixel[1] - pixel[1])
}

/// One step, to the side of the square at most; from there into the square beyond.
fn step(layout: &Layout, view: &View, spot: &mut Spot, samples: &Samples, i: usize) {
    let size = layout.squares()[spot.square as usize].size;
    let q = view.to_camera(samples.position[i]);
    let pixel = view.pixel(q);
    let [a, c] = view.pixel_motion(q, view.turned(samples.du[i])).map(|x| size[0] * x);
    let [b, d] = view.pixel_motion(q, view.turned(samples.dv[i])).map(|x| size[1] * x);
    let (x, y) = (spot.pixel[0] - pixel[0], spot.pixel[1] - pixel[1]);
    let determinant = a * d - b * c;
    let step = [(d * x - b * y) / determinant, (a * y - c * x) / determinant];
    if !(step[0].is_finite() && step[1].is_finite()) {
        return;
    }
    let step = step.map(|x| x.clamp(-LONGEST, LONGEST));
    let [s, t] = spot.at;
    // Already on a side, and bound to leave.
    let leaving = match () {
        () if t <= 0.0 && step[1] < 0.0 => Some((0, s)),
        () if s >= 1.0 && step[0] > 0.0 => Some((1, t)),
        () if t >= 1.0 && step[1] > 0.0 => Some((2, 1.0 - s)),
        () if s <= 0.0 && step[0] < 0.0 => Some((3, 1.0 - t)),
        () => None,
    };
    if let Some((square, at)) =
        leaving.and_then(|(side, x)| layout.cross(Side { square: spot.square, side }, x))
    {
        (spot.square, spot.at) = (square, at);
        return;
    }
    spot.at = [s + step[0], t + step[1]].map(|x| x.clamp(0.0, 1.0));
}
