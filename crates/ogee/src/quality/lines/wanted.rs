//! Which parts of lines are wanted.

use super::LineOptions;
use crate::math::Vec3;
use crate::quality::{Field, PlaneLight, Ray, Viewer};

/// Which parts of lines are wanted.
pub(super) struct Wanted<'a> {
    front: Option<Viewer>,
    visible: Option<&'a (dyn Fn(Vec3) -> bool + Sync)>,
    /// The light plane, if lines end where it does: without an end along the axis that tells lines apart.
    plane: Option<(PlaneLight, Ray, Viewer)>,
}

impl<'a> Wanted<'a> {
    pub(super) fn new(field: &Field, options: &LineOptions<'a>) -> Wanted<'a> {
        let plane = match *field {
            Field::Plane { mut light, viewer, ray, axis } => {
                light.half[axis] = f64::INFINITY;
                light.half.iter().any(|half| half.is_finite()).then_some((light, ray, viewer))
            }
            _ => None,
        };
        Wanted { front: options.front, visible: options.visible, plane }
    }

    /// True if a point is wanted.
    pub(super) fn is_here(&self, position: Vec3, normal: Vec3) -> bool {
        self.faces(position, normal, 0.0)
            && self.is_lit(position, normal, 1.0)
            && self.visible.is_none_or(|visible| visible(position))
    }

    /// True if a point is wanted, or may be one cell of the coarsest away from one that is.
    pub(super) fn is_near(&self, position: Vec3, normal: Vec3) -> bool {
        /// The cosine by which the surface may face away: that of a turn of thirty degrees within a cell.
        const AWAY: f64 = 0.5;
        /// How far beyond the end of the plane, in its size.
        const BEYOND: f64 = 1.5;
        self.faces(position, normal, AWAY) && self.is_lit(position, normal, BEYOND)
    }

    fn faces(&self, position: Vec3, normal: Vec3, margin: f64) -> bool {
        self.front.is_none_or(|viewer| normal.dot(viewer.direction(position).0) < margin)
    }

    fn is_lit(&self, position: Vec3, normal: Vec3, share: f64) -> bool {
        self.plane.is_none_or(|(light, ray, viewer)| {
            let light = PlaneLight { half: light.half.map(|half| share * half), ..light };
            light.hit(ray, &viewer, position, normal).is_some()
        })
    }
}
