//! `Camera`: who looks, and where a point is in the picture.

use ogee::Vec3;
use ogee::quality::Viewer;

/// How depth becomes smallness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Rays from the eye; the whole vertical angle of view in degrees.
    Perspective {
        /// Between 0 and 180.
        angle: f64,
    },
    /// Parallel rays; what the height of the picture shows, in units of the model.
    Parallel {
        /// Above 0.
        height: f64,
    },
}

/// Who looks, and at what.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye; parallel rays start beside it.
    pub eye: Vec3,
    /// What is in the middle of the picture.
    pub at: Vec3,
    /// What points up in the picture.
    pub up: Vec3,
    /// How depth becomes smallness.
    pub projection: Projection,
}

/// Angle of view unless another is asked for, in degrees: little distortion, still some depth.
pub const ANGLE: f64 = 30.0;

/// From the right, the front and above.
pub const THREE_QUARTER: Vec3 = Vec3::new(0.55, -0.7, 0.46);

/// The corners of a box.
fn corners([lower, upper]: [Vec3; 2]) -> [Vec3; 8] {
    std::array::from_fn(|corner| {
        let pick = |bit: usize, a: f64, b: f64| if corner >> bit & 1 == 0 { a } else { b };
        Vec3::new(pick(0, lower.x, upper.x), pick(1, lower.y, upper.y), pick(2, lower.z, upper.z))
    })
}

/// The box around some points; the origin if there are none.
pub(crate) fn extent(points: &[Vec3]) -> [Vec3; 2] {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold([first; 2], |[lower, upper], &point| [lower.min(point), upper.max(point)])
}

impl Camera {
    /// A three-quarter view from the front, the right and above, with `z` up, in which a box fits into a picture of
    /// `size` pixels.
    pub fn fit(bounds: [Vec3; 2], size: [u32; 2]) -> Camera {
        Camera::fit_from(THREE_QUARTER, &corners(bounds), ANGLE, size)
    }

    /// The view from a direction, so near that all of the points just fit.
    pub fn fit_from(direction: Vec3, points: &[Vec3], angle: f64, size: [u32; 2]) -> Camera {
        /// Of the picture is left free on each side.
        const MARGIN: f64 = 0.04;
        let [lower, upper] = extent(points);
        let middle = 0.5 * (lower + upper);
        let direction = direction.normalized().unwrap_or(Vec3::new(0.0, -1.0, 0.0));
        let up = if direction.x.hypot(direction.y) > 1e-6 {
            Vec3::new(0.0, 0.0, 1.0)
        } else {
            Vec3::new(0.0, 1.0, 0.0)
        };
        let right = up.cross(direction).normalized().unwrap_or(Vec3::new(1.0, 0.0, 0.0));
        let upward = direction.cross(right);
        let tangent = (angle.to_radians() / 2.0).tan() * (1.0 - 2.0 * MARGIN);
        let aspect = f64::from(size[0]) / f64::from(size[1].max(1));
        // Each side of the picture is a plane through the eye; the farthest point beyond each says where it goes.
        let reach = |axis: Vec3, tangent: f64| {
            let beyond = |axis: Vec3| {
                let reaches =
                    points.iter().map(|&p| (p - middle).dot(axis) + tangent * (p - middle).dot(direction));
                reaches.fold(f64::NEG_INFINITY, f64::max)
            };
            let (plus, minus) = (beyond(axis), beyond(-axis));
            (0.5 * (plus - minus), 0.5 * (plus + minus) / tangent)
        };
        let ((across, wide), (along, high)) = (reach(right, tangent * aspect), reach(upward, tangent));
        let at = middle + across * right + along * upward;
        // A point has no size to stand back by: as much as rounding lets the eye be told from it.
        let distance = wide.max(high).max(16.0 * f64::EPSILON * middle.length());
        let distance = if distance > 0.0 { distance } else { 1.0 };
        Camera { eye: at + distance * direction, at, up, projection: Projection::Perspective { angle } }
    }

    /// The camera as arithmetic wants it, for pictures of `size` pixels. `None` if eye and target coincide, up is along
    /// the view, or a number is not finite or out of its range.
    pub fn view(&self, size: [u32; 2]) -> Option<View> {
        let forward = (self.at - self.eye).normalized()?;
        let right = forward.cross(self.up.normalized()?);
        if right.length() < 1e-9 {
            return None;
        }
        let right = right.normalized()?;
        let height = f64::from(size[1]);
        let (scale, is_parallel) = match self.projection {
            Projection::Perspective { angle } if angle > 0.0 && angle < 180.0 => {
                (height / 2.0 / (angle.to_radians() / 2.0).tan(), false)
            }
            Projection::Parallel { height: shown } if shown > 0.0 => (height / shown, true),
            _ => return None,
        };
        let view =
            View { eye: self.eye, axes: [right, right.cross(forward), forward], scale, is_parallel, size };
        let is_finite = view.axes.iter().all(|axis| axis.is_finite());
        (is_finite && self.eye.is_finite() && scale.is_finite()).then_some(view)
    }
}

/// A camera in pixels. The middle of the top left pixel is `(0.5, 0.5)`; `x` runs to the right, `y` down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye.
    pub eye: Vec3,
    /// Unit vectors to the right, up and forward.
    pub axes: [Vec3; 3],
    /// Pixels: at depth 1 for a length of 1, or for a length of 1 where rays are parallel.
    pub scale: f64,
    /// True where rays are parallel.
    pub is_parallel: bool,
    /// Width and height.
    pub size: [u32; 2],
}

impl View {
    /// A point in the frame of the camera: right, up, depth.
    #[inline]
    pub fn to_camera(&self, point: Vec3) -> Vec3 {
        self.turned(point - self.eye)
    }

    /// A vector in the frame of the camera.
    #[inline]
    pub fn turned(&self, vector: Vec3) -> Vec3 {
        Vec3::new(vector.dot(self.axes[0]), vector.dot(self.axes[1]), vector.dot(self.axes[2]))
    }

    /// The pixel coordinates of a point in the frame of the camera.
    #[inline]
    pub fn pixel(&self, q: Vec3) -> [f64; 2] {
        let k = if self.is_parallel { self.scale } else { self.scale / q.z };
        [0.5 * f64::from(self.size[0]) + k * q.x, 0.5 * f64::from(self.size[1]) - k * q.y]
    }

    /// How the pixel of a point moves when the point moves along a tangent; both in the frame of the camera.
    #[inline]
    pub fn pixel_motion(&self, q: Vec3, w: Vec3) -> [f64; 2] {
        if self.is_parallel {
            return [self.scale * w.x, -self.scale * w.y];
        }
        let k = self.scale / q.z;
        [k * (w.x - q.x / q.z * w.z), -k * (w.y - q.y / q.z * w.z)]
    }

    /// How many pixels wide a thin line is: it looks the same in larger pictures.
    pub fn line_width(&self) -> f64 {
        (f64::from(self.size[0].min(self.size[1])) / 700.0).max(1.0)
    }

    /// Who looks, for reflections.
    pub fn viewer(&self) -> Viewer {
        if self.is_parallel { Viewer::Parallel(self.axes[2]) } else { Viewer::Eye(self.eye) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fitted_box_lies_inside_the_picture_and_touches_its_margin() {
        let lower = Vec3::new(-1.0, 2.0, 0.5);
        let upper = Vec3::new(3.0, 2.5, 4.0);
        for size in [[700, 700], [300, 900], [900, 200]] {
            let view = Camera::fit([lower, upper], size).view(size).unwrap();
            let (mut least, mut greatest) = ([f64::MAX; 2], [f64::MIN; 2]);
            for point in corners([lower, upper]) {
                let pixel = view.pixel(view.to_camera(point));
                for k in 0..2 {
                    least[k] = least[k].min(pixel[k]);
                    greatest[k] = greatest[k].max(pixel[k]);
                }
            }
            let free = |k: usize| {
                let size = f64::from(size[k]);
                least[k].min(size - greatest[k]) / size
            };
            assert!(free(0) > 0.039 && free(1) > 0.039);
            assert!(free(0).min(free(1)) < 0.041, "{} {}", free(0), free(1));
        }
    }

    #[test]
    fn the_unit_of_length_does_not_matter() {
        let [lower, upper] = [Vec3::new(-1.0, 2.0, 0.5), Vec3::new(3.0, 2.5, 4.0)];
        let usual = Camera::fit([lower, upper], [300, 200]);
        for unit in [1e-60, 1e-12, 1e12, 1e60] {
            let Camera { eye, at, .. } = Camera::fit([unit * lower, unit * upper], [300, 200]);
            for (point, expected) in [(eye, usual.eye), (at, usual.at)] {
                assert!((point / unit).distance(expected) < 1e-12, "{unit:e}: {point:?}");
            }
        }
        for point in [Vec3::ZERO, Vec3::new(1e9, 0.0, 0.0)] {
            assert!(Camera::fit([point; 2], [300, 200]).view([300, 200]).is_some(), "{point:?}");
        }
    }

    #[test]
    fn pixels_move_as_derivatives_say() {
        let camera = Camera {
            eye: Vec3::new(3.0, -4.0, 2.0),
            at: Vec3::ZERO,
            up: Vec3::new(0.0, 0.0, 1.0),
            projection: Projection::Perspective { angle: 40.0 },
        };
        let parallel = Camera { projection: Projection::Parallel { height: 3.0 }, ..camera };
        let (point, tangent, h) = (Vec3::new(0.3, 0.2, -0.1), Vec3::new(0.2, -0.5, 0.7), 1e-6);
        for camera in [camera, parallel] {
            let view = camera.view([400, 300]).unwrap();
            let at = |step: f64| view.pixel(view.to_camera(point + step * tangent));
            let motion = view.pixel_motion(view.to_camera(point), view.turned(tangent));
            for k in 0..2 {
                assert!((motion[k] - (at(h)[k] - at(-h)[k]) / (2.0 * h)).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn views_that_show_nothing_are_none() {
        let camera = Camera::fit([Vec3::ZERO, Vec3::new(1.0, 1.0, 1.0)], [10, 10]);
        assert!(camera.view([10, 10]).is_some());
        assert!(Camera { at: camera.eye, ..camera }.view([10, 10]).is_none());
        assert!(Camera { up: camera.at - camera.eye, ..camera }.view([10, 10]).is_none());
        for angle in [0.0, 180.0, f64::NAN] {
            let projection = Projection::Perspective { angle };
            assert!(Camera { projection, ..camera }.view([10, 10]).is_none());
        }
    }
}
