//! Which square and parameters each pixel shows: triangles into pixels, the nearest first.

use ogee::Vec3;
use rayon::prelude::*;

use crate::View;
use crate::polygon::Polygon;

/// What a pixel shows.
#[derive(Clone, Copy, Debug)]
pub struct Fragment {
    /// The pixel, row by row from the top left.
    pub pixel: u32,
    /// The square of parameters, by its place in the list of the polygon.
    pub place: u32,
    /// Parameters in the square.
    pub at: [f64; 2],
    /// Depth along the view.
    pub depth: f64,
}

/// Rows that one task fills.
const BAND: u32 = 16;

/// A corner of a triangle in the picture.
#[derive(Clone, Copy)]
struct Corner {
    pixel: [f64; 2],
    /// One over the depth, or 1 where rays are parallel: what makes parameters linear in the picture.
    weight: f64,
    /// Grows towards the eye, linear in the picture.
    nearness: f64,
    at: [f64; 2],
}

/// The nearest fragments of all pixels that show the polygon, in the order of pixels.
pub(crate) fn fragments(polygon: &Polygon, view: &View) -> Vec<Fragment> {
    let near = near_plane(polygon, view);
    let bands = view.size[1].div_ceil(BAND);
    let mut of_bands: Vec<Vec<u32>> = vec![Vec::new(); bands as usize];
    let ranges: Vec<Option<[u32; 2]>> = (0..polygon.squares.len())
        .into_par_iter()
        .map(|place| rows(polygon.grid(place), view, near))
        .collect();
    for (place, range) in (0..).zip(ranges) {
        if let Some([first, last]) = range {
            (first / BAND..=last / BAND).for_each(|band| of_bands[band as usize].push(place));
        }
    }
    let filled: Vec<Vec<Fragment>> = of_bands
        .par_iter()
        .enumerate()
        .map(|(band, places)| fill(polygon, view, near, band as u32, places))
        .collect();
    filled.concat()
}

/// Nothing nearer than this is shown.
fn near_plane(polygon: &Polygon, view: &View) -> f64 {
    if view.is_parallel {
        return f64::NEG_INFINITY;
    }
    let farthest = polygon.points.iter().map(|&p| view.to_camera(p).z).fold(0.0, f64::max);
    1e-5 * farthest
}

/// The rows of pixels that a grid may cover.
fn rows(grid: &[Vec3], view: &View, near: f64) -> Option<[u32; 2]> {
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut in_front, mut behind) = (false, false);
    for &point in grid {
        let q = view.to_camera(point);
        if q.z > near {
            let y = view.pixel(q)[1];
            (least, greatest, in_front) = (least.min(y), greatest.max(y), true);
        } else {
            behind = true;
        }
    }
    if behind && in_front {
        return Some([0, view.size[1] - 1]);
    }
    let height = f64::from(view.size[1]);
    (in_front && greatest >= 0.0 && least <= height).then(|| {
        let row = |y: f64| (y.clamp(0.0, height - 1.0)) as u32;
        [row(least - 1.0), row(greatest + 1.0)]
    })
}

/// Pixels of a band.
struct Band {
    first_row: u32,
    rows: u32,
    width: u32,
    nearness: Vec<f64>,
    shown: Vec<(u32, [f64; 2])>,
}

fn fill(polygon: &Polygon, view: &View, near: f64, number: u32, places: &[u32]) -> Vec<Fragment> {
    let first_row = number * BAND;
    let rows = BAND.min(view.size[1] - first_row);
    let width = view.size[0];
    let count = (rows * width) as usize;
    let mut band = Band {
        first_row,
        rows,
        width,
        nearness: vec![f64::NEG_INFINITY; count],
        shown: vec![(0, [0.0; 2]); count],
    };
    let n = polygon.cells as usize;
    for &place in places {
        let frame: Vec<Vec3> =
            polygon.grid(place as usize).iter().map(|&point| view.to_camera(point)).collect();
        let pixels: Vec<[f64; 2]> = frame.iter().map(|&q| view.pixel(q)).collect();
        for j in 0..n {
            for i in 0..n {
                let first = i + (n + 1) * j;
                let four = [first, first + 1, first + n + 2, first + n + 1];
                if four.iter().all(|&k| frame[k].z > near) {
                    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
                    for k in four {
                        (least, greatest) = (least.min(pixels[k][1]), greatest.max(pixels[k][1]));
                    }
                    if greatest < f64::from(first_row) || least > f64::from(first_row + rows) {
                        continue;
                    }
                }
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                let at = corners.map(|(i, j)| [i as f64 / n as f64, j as f64 / n as f64]);
                for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                    band.clipped(view, near, place, [a, b, c].map(|k| (frame[four[k]], at[k])));
                }
            }
        }
    }
    band.fragments(view)
}

impl Band {
    /// A triangle, or what of it is in front of the near plane.
    fn clipped(&mut self, view: &View, near: f64, place: u32, corners: [(Vec3, [f64; 2]); 3]) {
        let project = |(q, at): (Vec3, [f64; 2])| {
            let weight = if view.is_parallel { 1.0 } else { 1.0 / q.z };
            let nearness = if view.is_parallel { -q.z } else { weight };
            Corner { pixel: view.pixel(q), weight, nearness, at }
        };
        if corners.iter().all(|(q, _)| q.z > near) {
            return self.triangle(place, corners.map(project));
        }
        let mut kept: Vec<(Vec3, [f64; 2])> = Vec::with_capacity(4);
        for k in 0..3 {
            let ((p, a), (q, b)) = (corners[k], corners[(k + 1) % 3]);
            if p.z > near {
                kept.push((p, a));
            }
            if (p.z > near) != (q.z > near) {
                let part = (near - p.z) / (q.z - p.z);
                let cut = p.lerp(q, part);
                kept.push((
                    Vec3::new(cut.x, cut.y, near),
                    [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis])),
                ));
            }
        }
        for k in 1..kept.len().max(2) - 1 {
            self.triangle(place, [kept[0], kept[k], kept[k + 1]].map(project));
        }
    }

    fn triangle(&mut self, place: u32, corners: [Corner; 3]) {
        let [a, b, c] = corners.map(|corner| corner.pixel);
        let area = side(a, b, c);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let range = |axis: usize, low: f64, high: f64| {
            let least = a[axis].min(b[axis]).min(c[axis]);
            let greatest = a[axis].max(b[axis]).max(c[axis]);
            // Middles of pixels are half-way between whole numbers.
            let (first, end) =
                ((least - 0.5).ceil().max(low), (greatest - 0.5).floor().min(high - 1.0) + 1.0);
            (first, end)
        };
        let (top, bottom) = (f64::from(self.first_row), f64::from(self.first_row + self.rows));
        let ((x0, x1), (y0, y1)) = (range(0, 0.0, f64::from(self.width)), range(1, top, bottom));
        if x0 >= x1 || y0 >= y1 {
            return;
        }
        let turn = area.signum();
        for y in y0 as u32..y1 as u32 {
            let row = ((y - self.first_row) * self.width) as usize;
            for x in x0 as u32..x1 as u32 {
                let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                let weights = [side(b, c, p), side(c, a, p), side(a, b, p)].map(|weight| turn * weight);
                // On an edge both neighbours are taken; depth decides.
                if weights.iter().any(|&weight| weight < 0.0) {
                    continue;
                }
                let sum = weights[0] + weights[1] + weights[2];
                let mean = |value: fn(&Corner) -> f64| {
                    (0..3).map(|k| weights[k] * value(&corners[k])).sum::<f64>() / sum
                };
                let nearness = mean(|corner| corner.nearness);
                let pixel = row + x as usize;
                if nearness > self.nearness[pixel] {
                    self.nearness[pixel] = nearness;
                    let weight = mean(|corner| corner.weight);
                    let at = [
                        mean(|corner| corner.weight * corner.at[0]) / weight,
                        mean(|corner| corner.weight * corner.at[1]) / weight,
                    ];
                    self.shown[pixel] = (place, at);
                }
            }
        }
    }

    fn fragments(&self, view: &View) -> Vec<Fragment> {
        let first = self.first_row * self.width;
        let covered = self.nearness.iter().enumerate().filter(|(_, nearness)| nearness.is_finite());
        let fragment = |(pixel, &nearness): (usize, &f64)| {
            let (place, at) = self.shown[pixel];
            let depth = if view.is_parallel { -nearness } else { 1.0 / nearness };
            Fragment { pixel: first + pixel as u32, place, at: at.map(|x| x.clamp(0.0, 1.0)), depth }
        };
        covered.map(fragment).collect()
    }
}

/// Twice the area of a triangle, positive one way round; two triangles that share the edge from `a` to `b` see opposite
/// numbers to the bit, so that no pixel falls between them.
#[inline]
fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let area = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if a < b { area(a, b) } else { -area(b, a) }
}
