//! `DepthImage`: what is in sight, for lines that are drawn as curves.

use ogee::Vec3;
use ogee::quality::Surface;

use crate::View;
use crate::polygon::Polygon;
use crate::raster::fragments;

/// The depth of what each pixel shows.
#[derive(Clone, Debug)]
pub struct DepthImage {
    view: View,
    /// Row by row from the top left; infinite where nothing is.
    depths: Vec<f64>,
}

/// Pixels at its depth by which a point of the surface may lie behind the mesh that stands for the surface.
const BEHIND: f64 = 2.0;

impl DepthImage {
    /// A surface as a view sees it. Twice as many pixels as the picture has along each side let lines end within half a
    /// pixel of what hides them.
    pub fn new(surface: &dyn Surface, view: &View) -> DepthImage {
        let mut depths = vec![f64::INFINITY; view.size[0] as usize * view.size[1] as usize];
        for fragment in fragments(&Polygon::for_view(surface, view), view) {
            depths[fragment.pixel as usize] = fragment.depth;
        }
        DepthImage::of_depths(view, depths)
    }

    /// The same from the depth that each pixel of a picture has; infinite where nothing is.
    pub(crate) fn of_depths(view: &View, depths: Vec<f64>) -> DepthImage {
        DepthImage { view: *view, depths }
    }

    /// True if a point of the surface is in the picture and nothing is before it. One pixel more or less is not told: a
    /// point counts as seen if it would be in one of the pixels around its own.
    pub fn shows(&self, point: Vec3) -> bool {
        let q = self.view.to_camera(point);
        if q.z <= 0.0 && !self.view.is_parallel {
            return false;
        }
        let [x, y] = self.view.pixel(q);
        let [width, height] = self.view.size.map(f64::from);
        if !(x >= 0.0 && y >= 0.0 && x < width && y < height) {
            return false;
        }
        let pixel = if self.view.is_parallel { 1.0 / self.view.scale } else { q.z / self.view.scale };
        let nearest = q.z - BEHIND * pixel;
        let around = |x: f64, size: u32| (x as u32).saturating_sub(1)..=(x as u32 + 1).min(size - 1);
        around(y, self.view.size[1]).any(|row| {
            around(x, self.view.size[0])
                .any(|column| self.depths[(row * self.view.size[0] + column) as usize] >= nearest)
        })
    }
}
