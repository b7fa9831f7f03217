//! `Canvas`: lines in space drawn into a picture, with smooth edges and round ends.

use ogee::Vec3;

use crate::View;
use crate::colour::{Colour, mix};
use crate::pattern::line;

/// A picture that lines are drawn into.
pub(crate) struct Canvas<'a> {
    view: &'a View,
    colours: &'a mut [Colour],
}

impl<'a> Canvas<'a> {
    pub(crate) fn new(view: &'a View, colours: &'a mut [Colour]) -> Canvas<'a> {
        Canvas { view, colours }
    }

    /// Draws a line `width` pixels wide, over whatever is there.
    pub(crate) fn line(&mut self, a: Vec3, b: Vec3, colour: Colour, width: f64) {
        cover(self.view, [a, b], width, |pixel, cover| {
            self.colours[pixel] = mix(self.colours[pixel], colour, cover);
        });
    }
}

/// Tells every pixel that a line touches, and how much of it is covered.
pub(crate) fn cover(view: &View, [a, b]: [Vec3; 2], width: f64, mut touch: impl FnMut(usize, f32)) {
    let (p, q) = (view.to_camera(a), view.to_camera(b));
    if !view.is_parallel && (p.z <= 0.0 || q.z <= 0.0) {
        return;
    }
    let ([x0, y0], [x1, y1]) = (view.pixel(p), view.pixel(q));
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = dx.hypot(dy);
    if !length.is_finite() {
        return;
    }
    // Along the axis in which it is longer, a few pixels to either side.
    let (main, other) = if dx.abs() >= dy.abs() { (0, 1) } else { (1, 0) };
    let (start, end, delta) = ([x0, y0], [x1, y1], [dx, dy]);
    let reach = 1.5 * (width + 1.0);
    let clipped = |x: f64, axis: usize| x.clamp(0.0, f64::from(view.size[axis])) as u32;
    let (first, last) = (start[main].min(end[main]) - reach, start[main].max(end[main]) + reach);
    for i in clipped(first, main)..clipped(last.ceil(), main) {
        let along = ((f64::from(i) + 0.5 - start[main]) / delta[main]).clamp(0.0, 1.0);
        let middle = start[other] + if delta[main] == 0.0 { 0.0 } else { along * delta[other] };
        for j in clipped(middle - reach, other)..clipped((middle + reach).ceil(), other) {
            let (x, y) = if main == 0 { (i, j) } else { (j, i) };
            let (px, py) = (f64::from(x) + 0.5 - x0, f64::from(y) + 0.5 - y0);
            let part =
                if length > 0.0 { ((px * dx + py * dy) / (length * length)).clamp(0.0, 1.0) } else { 0.0 };
            let cover = line((px - part * dx).hypot(py - part * dy), width) as f32;
            if cover > 0.0 {
                touch((y * view.size[0] + x) as usize, cover);
            }
        }
    }
}

/// The distance of two points in the picture; endless where one is not before the eye.
pub(crate) fn pixels(view: &View, a: Vec3, b: Vec3) -> f64 {
    let [p, q] = [a, b].map(|point| view.to_camera(point));
    if !view.is_parallel && p.z.min(q.z) <= 0.0 {
        return f64::INFINITY;
    }
    let ([x0, y0], [x1, y1]) = (view.pixel(p), view.pixel(q));
    (x1 - x0).hypot(y1 - y0)
}
