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

/// Steps for all pixels: what is left is 1e-8 of a pixel nearly everywhere.
pub(crate) const STEPS: usize = 2;

/// Steps more for pixels that belong to the face beyond a side, and those at outlines.
const STEPS_MORE: usize = 6;

/// A step longer than this leaves the region in which it can be trusted.
const LONGEST: f64 = 0.15;

/// Of a pixel: where this is left, a few more steps are worth it.
const DONE: f64 = 1e-3;

/// Moves places to where the middle of their pixel shows the surface.
pub(crate) fn solve(surface: &dyn Surface, view: &View, spots: &mut [Spot]) {
    let layout = surface.layout();
    let mut samples = Samples::default();
    let mut at: Vec<Location> = Vec::with_capacity(spots.len());
    for _ in 0..STEPS {
        evaluate(surface, spots.iter(), &mut at, &mut samples);
        for (i, spot) in spots.iter_mut().enumerate() {
            step(layout, view, spot, &samples, i);
        }
    }
    // Steps that stopped at a side, or that have not come near.
    evaluate(surface, spots.iter(), &mut at, &mut samples);
    let mut left: Vec<usize> =
        (0..spots.len()).filter(|&i| residual(view, &spots[i], &samples, i) > DONE).collect();
    for _ in 0..STEPS_MORE {
        if left.is_empty() {
            return;
        }
        evaluate(surface, left.iter().map(|&i| &spots[i]), &mut at, &mut samples);
        let mut next = Vec::new();
        for (k, &i) in left.iter().enumerate() {
            if residual(view, &spots[i], &samples, k) > DONE {
                step(layout, view, &mut spots[i], &samples, k);
                next.push(i);
            }
        }
        left = next;
    }
}

fn evaluate<'a>(
    surface: &dyn Surface,
    spots: impl Iterator<Item = &'a Spot>,
    at: &mut Vec<Location>,
    samples: &mut Samples,
) {
    let squares = surface.layout().squares();
    at.clear();
    at.extend(spots.map(|spot| squares[spot.square as usize].at(spot.at[0], spot.at[1])));
    surface.evaluate(at, Derivatives::First, samples);
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
