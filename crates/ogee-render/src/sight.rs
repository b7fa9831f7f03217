//! Which points of a surface a view shows, and where.

use ogee::Vec3;
use ogee::quality::Surface;

use crate::View;
use crate::polygon::Polygon;
use crate::raster::fragments;

/// Of the size of what is looked at: how far behind the nearest point of its pixels a point may be and still count as seen.
const DEPTH: f64 = 0.01;

/// The pixel coordinates of each point that nothing hides; `None` for those that are hidden or beside the picture.
pub fn seen(surface: &dyn Surface, view: &View, points: &[Vec3]) -> Vec<Option<[f64; 2]>> {
    let polygon = Polygon::for_view(surface, view);
    let [width, height] = view.size.map(|side| side as usize);
    let mut depths = vec![f64::INFINITY; width * height];
    let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
    for fragment in fragments(&polygon, view) {
        depths[fragment.pixel as usize] = fragment.depth;
        nearest = nearest.min(fragment.depth);
        farthest = farthest.max(fragment.depth);
    }
    let slack = DEPTH * (farthest - nearest);
    let is_seen = |q: Vec3, [x, y]: [f64; 2]| {
        // On the outline the pixel itself may show what is behind.
        let around = |x: f64| (x as usize).saturating_sub(1)..x as usize + 2;
        around(y).any(|y| {
            around(x).any(|x| x < width && y < height && (depths[y * width + x] - q.z).abs() <= slack)
        })
    };
    let pixel = |&point: &Vec3| {
        let q = view.to_camera(point);
        let at @ [x, y] = view.pixel(q);
        let is_inside = (0.0..width as f64).contains(&x) && (0.0..height as f64).contains(&y);
        (q.z > 0.0 || view.is_parallel).then_some(at).filter(|&at| is_inside && is_seen(q, at))
    };
    points.iter().map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Camera;
    use ogee::quality::LimitView;
    use ogee::{Level, LimitSurface, PatchTable, shapes};

    #[test]
    fn a_ball_shows_the_side_that_faces_the_eye() {
        let mesh = shapes::cube();
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let limit = LimitSurface::new(&table, &mesh.points);
        let surface = LimitView::new(&level, &limit);
        // The limits of the corners, which are those of the cube drawn in.
        let corners: Vec<Vec3> =
            ogee::limit_vertices(&level, &mesh.points).iter().map(|vertex| vertex.position).collect();
        let from = Vec3::new(0.05, -1.0, 0.1);
        let view = Camera::fit_from(from, &corners, 20.0, [200, 150]).view([200, 150]).unwrap();
        let shown = seen(&surface, &view, &corners);
        for (corner, at) in corners.iter().zip(shown) {
            assert_eq!(at.is_some(), corner.y < 0.0, "{corner:?}");
            let pixel = view.pixel(view.to_camera(*corner));
            assert!(at.is_none_or(|at| at == pixel));
        }
    }
}
