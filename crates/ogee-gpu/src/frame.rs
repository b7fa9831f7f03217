//! `Frame`: the model as shaders see it, around the origin and of size one, so that single precision serves models of any
//! size at any place.

use ogee::Vec3;
use ogee::quality::PlaneLight;
use ogee_render::View;

use crate::flat::narrow;
use crate::layout;

/// From the model to the shaders.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    centre: Vec3,
    /// One over the diagonal of the model.
    scale: f64,
}

impl Frame {
    /// The frame of a box.
    pub(crate) fn new([lower, upper]: [Vec3; 2]) -> Frame {
        let diagonal = upper.distance(lower);
        let scale = if diagonal > 0.0 { 1.0 / diagonal } else { 1.0 };
        Frame { centre: 0.5 * (lower + upper), scale }
    }

    /// A length of the model in this frame.
    pub(crate) fn length(&self, length: f64) -> f64 {
        self.scale * length
    }

    pub(crate) fn vector(&self, vector: Vec3) -> Vec3 {
        self.scale * vector
    }

    pub(crate) fn point(&self, point: Vec3) -> Vec3 {
        self.vector(point - self.centre)
    }

    /// A point of this frame in the model.
    pub(crate) fn point_back(&self, point: [f32; 3]) -> Vec3 {
        Vec3::from(point.map(f64::from)) / self.scale + self.centre
    }

    /// A camera; all of the model lies within a half around the origin.
    pub(crate) fn view(&self, view: &View) -> layout::View {
        let eye = self.point(view.eye);
        let [right, up, forward] = view.axes;
        let middle = -eye.dot(forward);
        // With nearer planes the depth of what is far would be coarse on devices that keep it in [-1, 1].
        let near = if view.is_parallel { middle - 1.0 } else { (middle - 1.0).max(1e-5) };
        layout::View {
            eye: narrow(eye),
            scale: if view.is_parallel { view.scale / self.scale } else { view.scale } as f32,
            right: narrow(right),
            is_parallel: u32::from(view.is_parallel),
            up: narrow(up),
            near: near as f32,
            forward: narrow(forward),
            far: (middle + 1.0) as f32,
            size: view.size.map(|x| x as f32),
            line_width: view.line_width() as f32,
            unused: 0.0,
        }
    }

    /// A plane of light.
    pub(crate) fn light(&self, light: &PlaneLight) -> layout::PlaneLight {
        // Infinity is no number that shaders have to know.
        let [half_a, half_b] = light.half.map(|half| self.length(half).min(f64::from(f32::MAX)) as f32);
        let [axis_a, axis_b] = light.axes.map(narrow);
        layout::PlaneLight {
            centre: narrow(self.point(light.centre)),
            half_a,
            axis_a,
            half_b,
            axis_b,
            unused: 0.0,
        }
    }
}
