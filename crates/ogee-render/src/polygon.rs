//! `Polygon`: a mesh with its points on the surface, which says what each pixel shows.
//!
//! Every square of parameters has a grid of its own, so parameters never mix with those of a neighbour. Only squares that
//! may be in the picture have one.

use ogee::quality::{Square, Surface};
use ogee::{Derivatives, Samples, Vec3};

use crate::View;

/// A grid of points on every square that may be seen.
#[derive(Clone, Debug)]
pub struct Polygon {
    /// Cells along a side of a square.
    pub cells: u32,
    /// The numbers of the squares, in order.
    pub squares: Vec<u32>,
    /// `(cells + 1)^2` points for each of them, along `s` first.
    pub points: Vec<Vec3>,
    /// Unit normals there, if asked for.
    pub normals: Vec<Vec3>,
}

/// Of a pixel: how far silhouettes of the mesh may be from those of the surface.
const TOLERANCE: f64 = 0.2;

/// Cells of all grids together, at most.
const MOST_CELLS: usize = 3_000_000;

impl Polygon {
    /// Grids with `2^level` cells along a side of every square.
    pub fn new(surface: &dyn Surface, squares: &[u32], level: u32, normals: bool) -> Polygon {
        let cells = 1u32 << level;
        let what = if normals { Derivatives::First } else { Derivatives::None };
        let layout = surface.layout();
        let side: Vec<f64> = (0..=cells).map(|i| f64::from(i) / f64::from(cells)).collect();
        let mut at = Vec::with_capacity(squares.len() * side.len() * side.len());
        for &square in squares {
            let square: &Square = &layout.squares()[square as usize];
            for &t in &side {
                at.extend(side.iter().map(|&s| square.at(s, t)));
            }
        }
        let mut samples = Samples::default();
        surface.evaluate(&at, what, &mut samples);
        Polygon { cells, squares: squares.to_vec(), points: samples.position, normals: samples.normal }
    }

    /// The mesh for a picture, so fine that its outline is that of the surface to a fifth of a pixel.
    pub fn for_view(surface: &dyn Surface, view: &View) -> Polygon {
        let all: Vec<u32> = (0..surface.layout().squares().len() as u32).collect();
        let mut level = 1;
        let mut polygon = Polygon::new(surface, &all, level, false);
        loop {
            let error = polygon.sagitta(view);
            // A finer mesh divides it by four.
            let more =
                if error > TOLERANCE { (error / TOLERANCE).log(4.0).ceil().max(1.0) as u32 } else { 0 };
            let seen = polygon.in_view(view);
            let fits = |level: u32| seen.len().max(1) << (2 * level) <= MOST_CELLS;
            let next = (level + more.min(3)).min((1..=10).rev().find(|&l| fits(l)).unwrap_or(1));
            if next <= level {
                return polygon;
            }
            level = next;
            polygon = Polygon::new(surface, &seen, level, false);
        }
    }

    /// Points of a square, by its place in the list.
    #[inline]
    pub(crate) fn grid(&self, place: usize) -> &[Vec3] {
        let count = (self.cells as usize + 1).pow(2);
        &self.points[place * count..(place + 1) * count]
    }

    /// Normals of a square, by its place in the list.
    #[inline]
    pub(crate) fn grid_normals(&self, place: usize) -> &[Vec3] {
        let count = (self.cells as usize + 1).pow(2);
        &self.normals[place * count..(place + 1) * count]
    }

    /// How far, in pixels, edges of the mesh are from the surface where they are in the picture: half the distance of a
    /// point from the middle of its neighbours two cells apart, over four.
    fn sagitta(&self, view: &View) -> f64 {
        let n = self.cells as usize + 1;
        let mut worst: f64 = 0.0;
        for place in 0..self.squares.len() {
            let grid: Vec<Option<[f64; 2]>> = self.grid(place).iter().map(|&p| seen_at(view, p)).collect();
            for j in 0..n {
                for i in 0..n {
                    for (step, inner) in [(1, i > 0 && i + 1 < n), (n, j > 0 && j + 1 < n)] {
                        let k = i + n * j;
                        if !inner {
                            continue;
                        }
                        let (Some(a), Some(b), Some(c)) = (grid[k - step], grid[k], grid[k + step]) else {
                            continue;
                        };
                        let bend = [0, 1].map(|axis| b[axis] - 0.5 * (a[axis] + c[axis]));
                        if near_picture(view, b, 2.0 * bend[0].hypot(bend[1])) {
                            worst = worst.max(0.25 * bend[0].hypot(bend[1]));
                        }
                    }
                }
            }
        }
        worst
    }

    /// The squares that may have a part in the picture.
    fn in_view(&self, view: &View) -> Vec<u32> {
        let is_seen = |place: usize| {
            let grid = self.grid(place);
            let mut least = [f64::INFINITY; 2];
            let mut greatest = [f64::NEG_INFINITY; 2];
            let mut in_front = false;
            for &point in grid {
                let Some(pixel) = seen_at(view, point) else {
                    // Beside or behind the eye: nothing is certain, unless all of it is behind.
                    continue;
                };
                in_front = true;
                for axis in 0..2 {
                    least[axis] = least[axis].min(pixel[axis]);
                    greatest[axis] = greatest[axis].max(pixel[axis]);
                }
            }
            let behind = grid.iter().any(|&point| seen_at(view, point).is_none());
            // The surface may swell beyond its points by as much as they spread.
            let inside = |axis: usize| {
                let margin = 0.5 * (greatest[axis] - least[axis]) + 2.0;
                greatest[axis] + margin >= 0.0 && least[axis] - margin <= f64::from(view.size[axis])
            };
            in_front && (behind || (inside(0) && inside(1)))
        };
        (0..self.squares.len()).filter(|&place| is_seen(place)).map(|place| self.squares[place]).collect()
    }
}

/// The pixel of a point in front of the eye.
fn seen_at(view: &View, point: Vec3) -> Option<[f64; 2]> {
    let q = view.to_camera(point);
    (view.is_parallel || q.z > 0.0).then(|| view.pixel(q))
}

/// True if a pixel is in the picture or this far beside it.
fn near_picture(view: &View, pixel: [f64; 2], margin: f64) -> bool {
    (0..2).all(|axis| pixel[axis] >= -margin && pixel[axis] <= f64::from(view.size[axis]) + margin)
}
