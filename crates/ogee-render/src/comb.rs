//! Curvature combs: hairs along the normal, as long as the curve bends.
//!
//! The curves are those in the middle of faces and those between them. A hair stands where the curve bends away from the
//! outside, and points inward where it bends the other way.

use ogee::quality::{Square, Surface, bounding_box};
use ogee::{Derivatives, Location, Samples, SurfaceJet, Vec3};

use crate::View;
use crate::colour::{Colour, decode, mix};
use crate::pattern::line;

/// Hairs along a curve across a square.
const HAIRS: usize = 24;

/// Draws combs over a picture; hairs are `share` of the diagonal of the surface long, where 90 % of all are shorter. What lies
/// behind the surface, whose depth along the view each pixel has, is left out.
pub fn draw(surface: &dyn Surface, view: &View, share: f64, depths: &[f64], colours: &mut [Colour]) {
    let Some([lower, upper]) = bounding_box(surface) else { return };
    let diagonal = upper.distance(lower);
    let mut canvas = Canvas { view, depths, colours, slack: 4e-3 * diagonal };
    let (hairs_colour, tips) = ([40, 90, 160].map(linear), [190, 40, 30].map(linear));
    let mut curves: Vec<Vec<Hair>> = Vec::new();
    for square in surface.layout().squares() {
        for (along, is_edge) in [(0, square.edges[0]), (1, square.edges[3])] {
            for across in [0.0, 0.5] {
                if across == 0.0 && !is_edge {
                    continue;
                }
                curves.push(hairs(surface, square, along, across));
            }
        }
    }
    // Where surfaces turn sharply hairs would hide everything else.
    let mut sizes: Vec<f64> = curves.iter().flatten().map(|hair| hair.bend.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let usual = sizes.get(sizes.len() * 9 / 10).copied().unwrap_or_default();
    if usual <= 0.0 {
        return;
    }
    let thick = view.line_width();
    let tip = |hair: &Hair| {
        hair.root - (share * diagonal * (hair.bend / usual).clamp(-LONGEST, LONGEST)) * hair.normal
    };
    for curve in &curves {
        for pair in curve.windows(2) {
            canvas.line(tip(&pair[0]), tip(&pair[1]), tips, 1.2 * thick);
        }
        for hair in curve {
            canvas.line(hair.root, tip(hair), hairs_colour, 0.7 * thick);
        }
    }
}

/// Times the usual length, at most.
const LONGEST: f64 = 3.0;

/// Where a curve of the surface bends.
struct Hair {
    root: Vec3,
    normal: Vec3,
    /// Negative where the surface bends away from its normal; hairs stand outside there.
    bend: f64,
}

fn linear(byte: u8) -> f32 {
    decode(f32::from(byte) / 255.0)
}

/// Hairs along one parameter of a square at a value of the other.
fn hairs(surface: &dyn Surface, square: &Square, along: usize, across: f64) -> Vec<Hair> {
    let at: Vec<Location> = (0..=HAIRS)
        .map(|i| i as f64 / HAIRS as f64)
        .map(|x| if along == 0 { square.at(x, across) } else { square.at(across, x) })
        .collect();
    let mut samples = Samples::default();
    surface.evaluate(&at, Derivatives::Second, &mut samples);
    let hair = |i: usize| {
        let (position, normal) = (samples.position[i], samples.normal[i]);
        let jet = SurfaceJet {
            position,
            du: samples.du[i],
            dv: samples.dv[i],
            duu: samples.duu[i],
            duv: samples.duv[i],
            dvv: samples.dvv[i],
        };
        let direction = if along == 0 { jet.du } else { jet.dv };
        let bend = jet.normal_curvature(normal, direction).filter(|bend| bend.is_finite())?;
        Some(Hair { root: position, normal, bend })
    };
    (0..at.len()).filter_map(hair).collect()
}

/// A picture that lines are drawn into.
struct Canvas<'a> {
    view: &'a View,
    depths: &'a [f64],
    colours: &'a mut [Colour],
    /// Lines this far behind the surface are still seen: their roots lie on it.
    slack: f64,
}

impl Canvas<'_> {
    fn line(&mut self, a: Vec3, b: Vec3, colour: Colour, width: f64) {
        let (p, q) = (self.view.to_camera(a), self.view.to_camera(b));
        if !self.view.is_parallel && (p.z <= 0.0 || q.z <= 0.0) {
            return;
        }
        let ([x0, y0], [x1, y1]) = (self.view.pixel(p), self.view.pixel(q));
        let (dx, dy) = (x1 - x0, y1 - y0);
        let length = dx.hypot(dy);
        if !length.is_finite() {
            return;
        }
        // Along the axis in which it is longer, a few pixels to either side.
        let (main, other) = if dx.abs() >= dy.abs() { (0, 1) } else { (1, 0) };
        let (start, end, delta) = ([x0, y0], [x1, y1], [dx, dy]);
        let reach = 1.5 * (width + 1.0);
        let clipped = |x: f64, axis: usize| x.clamp(0.0, f64::from(self.view.size[axis])) as u32;
        let (first, last) = (start[main].min(end[main]) - reach, start[main].max(end[main]) + reach);
        for i in clipped(first, main)..clipped(last.ceil(), main) {
            let along = ((f64::from(i) + 0.5 - start[main]) / delta[main]).clamp(0.0, 1.0);
            let middle = start[other] + if delta[main] == 0.0 { 0.0 } else { along * delta[other] };
            for j in clipped(middle - reach, other)..clipped((middle + reach).ceil(), other) {
                let (x, y) = if main == 0 { (i, j) } else { (j, i) };
                let (px, py) = (f64::from(x) + 0.5 - x0, f64::from(y) + 0.5 - y0);
                let part = if length > 0.0 {
                    ((px * dx + py * dy) / (length * length)).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let distance = (px - part * dx).hypot(py - part * dy);
                let cover = line(distance, width) as f32;
                let pixel = (y * self.view.size[0] + x) as usize;
                if cover > 0.0 && p.z + part * (q.z - p.z) <= self.depths[pixel] + self.slack {
                    self.colours[pixel] = mix(self.colours[pixel], colour, cover);
                }
            }
        }
    }
}
