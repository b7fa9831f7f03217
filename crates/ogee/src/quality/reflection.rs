//! What a point of a surface sees: the light plane in the direction of its reflected ray or of its normal, and numbers
//! whose level lines designers read.
//!
//! A reflected ray `r = d - 2 (d.n) n` does not depend on the sign of the normal. Where it meets the plane, the
//! coordinates in the plane decide on light or dark. Derivatives along the surface's parameters come with them: lines are
//! traced with them, and the width of a pixel in the pattern follows from them. Source: Yasui and Kanai, Surface Quality
//! Assessment of Subdivision Surfaces on Programmable Graphics Hardware, equation (1), solved for the line instead of for
//! the point; highlight lines after Beier and Chen.

use crate::math::{SurfaceJet, Vec3};

/// Who looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewer {
    /// An eye at a point.
    Eye(Vec3),
    /// Parallel rays in a unit direction.
    Parallel(Vec3),
}

/// Which ray from the surface meets the light plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ray {
    /// The reflected view: reflection lines.
    #[default]
    Reflected,
    /// The normal: highlight lines, which do not depend on the viewer.
    Normal,
}

/// Position and unit normal with their derivatives: all that rays depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalJet {
    /// Position.
    pub position: Vec3,
    /// Derivatives of the position along `u` and `v`.
    pub tangents: [Vec3; 2],
    /// Unit normal.
    pub normal: Vec3,
    /// Derivatives of the normal along `u` and `v`.
    pub turns: [Vec3; 2],
}

impl NormalJet {
    /// From derivatives of a surface; `None` where it has no normal or no curvature.
    pub fn of(jet: &SurfaceJet) -> Option<NormalJet> {
        Some(NormalJet {
            position: jet.position,
            tangents: [jet.du, jet.dv],
            normal: jet.normal()?,
            turns: jet.normal_derivatives()?,
        })
    }
}

/// A plane that carries a pattern of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneLight {
    /// The origin of its coordinates.
    pub centre: Vec3,
    /// Unit vectors at right angles, the directions of its coordinates.
    pub axes: [Vec3; 2],
    /// How far it reaches on either side along the axes; infinite if it has no end.
    pub half: [f64; 2],
}

/// Where a ray meets the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Coordinates in the plane.
    pub at: [f64; 2],
    /// The distance along the ray.
    pub distance: f64,
}

/// Where a ray meets the plane, and how that moves with the parameters of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitJet {
    /// Where.
    pub hit: Hit,
    /// Derivative of the coordinates along `u`.
    pub du: [f64; 2],
    /// Derivative of the coordinates along `v`.
    pub dv: [f64; 2],
}

/// Rays closer to parallel with the plane than this sine do not meet it.
const GRAZING: f64 = 1e-9;

impl Viewer {
    /// The unit direction of view to a point, and one over the distance (0 for parallel rays).
    #[inline]
    pub fn direction(&self, point: Vec3) -> (Vec3, f64) {
        match *self {
            Viewer::Eye(eye) => {
                let ray = point - eye;
                let length = ray.length();
                (ray / length, 1.0 / length)
            }
            Viewer::Parallel(direction) => (direction, 0.0),
        }
    }

    /// The unit direction of the reflected ray.
    #[inline]
    pub fn reflected(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let (view, _) = self.direction(point);
        view - 2.0 * view.dot(normal) * normal
    }

    /// The reflected ray and its derivatives.
    fn reflected_jet(&self, jet: &NormalJet) -> [Vec3; 3] {
        let NormalJet { position, tangents, normal, turns } = *jet;
        let (view, nearness) = self.direction(position);
        let facing = view.dot(normal);
        let along = |tangent: Vec3, turn: Vec3| {
            let swing = nearness * (tangent - view.dot(tangent) * view);
            swing - 2.0 * ((swing.dot(normal) + view.dot(turn)) * normal + facing * turn)
        };
        [view - 2.0 * facing * normal, along(tangents[0], turns[0]), along(tangents[1], turns[1])]
    }
}

impl PlaneLight {
    /// The unit normal of the plane.
    #[inline]
    pub fn normal(&self) -> Vec3 {
        self.axes[0].cross(self.axes[1])
    }

    /// Where the ray of a point meets the plane; `None` if it misses it.
    #[inline]
    pub fn hit(&self, ray: Ray, viewer: &Viewer, point: Vec3, normal: Vec3) -> Option<Hit> {
        let direction = match ray {
            Ray::Reflected => viewer.reflected(point, normal),
            Ray::Normal => normal,
        };
        self.meet(point, direction)
    }

    #[inline]
    fn meet(&self, point: Vec3, direction: Vec3) -> Option<Hit> {
        let normal = self.normal();
        let descent = direction.dot(normal);
        let distance = (self.centre - point).dot(normal) / descent;
        // The way of asking passes over what is no number.
        let meets = descent.abs() > GRAZING && distance > 0.0 && distance < f64::INFINITY;
        let offset = point + distance * direction - self.centre;
        let at = self.axes.map(|axis| offset.dot(axis));
        (meets && at[0].abs() <= self.half[0] && at[1].abs() <= self.half[1]).then_some(Hit { at, distance })
    }

    /// Where the ray of a point meets the plane, with derivatives; `None` if it misses it.
    pub fn hit_jet(&self, ray: Ray, viewer: &Viewer, jet: &NormalJet) -> Option<HitJet> {
        let [direction, turn_u, turn_v] = match ray {
            Ray::Reflected => viewer.reflected_jet(jet),
            Ray::Normal => [jet.normal, jet.turns[0], jet.turns[1]],
        };
        let hit = self.meet(jet.position, direction)?;
        let plane = self.normal();
        let descent = direction.dot(plane);
        let along = |tangent: Vec3, turn: Vec3| {
            let moved = tangent + hit.distance * turn;
            let in_plane = moved - (moved.dot(plane) / descent) * direction;
            self.axes.map(|axis| in_plane.dot(axis))
        };
        Some(HitJet { hit, du: along(jet.tangents[0], turn_u), dv: along(jet.tangents[1], turn_v) })
    }
}

/// A number at every point of a surface whose level lines are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// A coordinate in the light plane: reflection lines and highlight lines.
    Plane {
        /// The plane.
        light: PlaneLight,
        /// Who looks.
        viewer: Viewer,
        /// Which ray meets it.
        ray: Ray,
        /// Which coordinate, 0 or 1.
        axis: usize,
    },
    /// The cosine between the normal and a unit direction of light: isophotes.
    Isophote {
        /// Towards the light.
        light: Vec3,
    },
    /// The cosine between the reflected ray and a unit axis: zebra stripes of an environment at infinity.
    Zebra {
        /// Who looks.
        viewer: Viewer,
        /// The axis of the environment.
        axis: Vec3,
    },
    /// The cosine between the normal and the view: its line of value 0 is the outline.
    Facing {
        /// Who looks.
        viewer: Viewer,
    },
}

/// A field at a point, with derivatives along the parameters of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldJet {
    /// Its value.
    pub value: f64,
    /// Derivative along `u`.
    pub du: f64,
    /// Derivative along `v`.
    pub dv: f64,
}

impl Field {
    /// Its value at a point with a unit normal; `None` where it has none.
    #[inline]
    pub fn value(&self, point: Vec3, normal: Vec3) -> Option<f64> {
        match self {
            Field::Plane { light, viewer, ray, axis } => {
                light.hit(*ray, viewer, point, normal).map(|hit| hit.at[*axis])
            }
            Field::Isophote { light } => Some(normal.dot(*light)),
            Field::Zebra { viewer, axis } => Some(viewer.reflected(point, normal).dot(*axis)),
            Field::Facing { viewer } => Some(viewer.direction(point).0.dot(normal)),
        }
    }

    /// Its value and derivatives; `None` where it has none.
    pub fn jet(&self, jet: &NormalJet) -> Option<FieldJet> {
        match self {
            Field::Plane { light, viewer, ray, axis } => {
                let HitJet { hit, du, dv } = light.hit_jet(*ray, viewer, jet)?;
                Some(FieldJet { value: hit.at[*axis], du: du[*axis], dv: dv[*axis] })
            }
            Field::Isophote { light } => {
                let [du, dv] = jet.turns.map(|turn| turn.dot(*light));
                Some(FieldJet { value: jet.normal.dot(*light), du, dv })
            }
            Field::Zebra { viewer, axis } => {
                let [value, du, dv] = viewer.reflected_jet(jet).map(|vector| vector.dot(*axis));
                Some(FieldJet { value, du, dv })
            }
            Field::Facing { viewer } => {
                let NormalJet { position, tangents, normal, turns } = *jet;
                let (view, nearness) = viewer.direction(position);
                let value = view.dot(normal);
                let along = |k: usize| {
                    let swing = nearness * (tangents[k] - view.dot(tangents[k]) * view);
                    swing.dot(normal) + view.dot(turns[k])
                };
                Some(FieldJet { value, du: along(0), dv: along(1) })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::SurfaceJet;

    /// A unit sphere around the origin near its top, by longitude-free parameters `(x, y)`.
    fn sphere(x: f64, y: f64) -> SurfaceJet {
        let z = (1.0 - x * x - y * y).sqrt();
        let (zx, zy) = (-x / z, -y / z);
        SurfaceJet {
            position: Vec3::new(x, y, z),
            du: Vec3::new(1.0, 0.0, zx),
            dv: Vec3::new(0.0, 1.0, zy),
            duu: Vec3::new(0.0, 0.0, -(1.0 + zx * zx) / z),
            duv: Vec3::new(0.0, 0.0, -zx * zy / z),
            dvv: Vec3::new(0.0, 0.0, -(1.0 + zy * zy) / z),
        }
    }

    fn normal_jet(x: f64, y: f64) -> NormalJet {
        NormalJet::of(&sphere(x, y)).unwrap()
    }

    fn ceiling(height: f64) -> PlaneLight {
        PlaneLight {
            centre: Vec3::new(0.1, -0.2, height),
            axes: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
            half: [f64::INFINITY; 2],
        }
    }

    #[test]
    fn a_sphere_stretches_what_it_reflects_by_its_curvature() {
        // At normal incidence and height h the plane moves by 1 - 2 h k along a principal direction; here k = -1.
        let viewer = Viewer::Parallel(Vec3::new(0.0, 0.0, -1.0));
        let jet = ceiling(4.0).hit_jet(Ray::Reflected, &viewer, &normal_jet(0.0, 0.0)).unwrap();
        assert!((jet.du[0] - 7.0).abs() < 1e-12 && (jet.dv[1] - 7.0).abs() < 1e-12, "{jet:?}");
        assert!(jet.du[1].abs() < 1e-12 && jet.dv[0].abs() < 1e-12);
    }

    #[test]
    fn derivatives_are_those_of_the_values() {
        let viewers = [Viewer::Eye(Vec3::new(2.0, -3.0, 4.0)), Viewer::Parallel(Vec3::new(0.6, 0.0, -0.8))];
        let light = ceiling(5.0);
        let mut fields = vec![Field::Isophote { light: Vec3::new(0.48, 0.6, 0.64) }];
        for viewer in viewers {
            fields.push(Field::Zebra { viewer, axis: Vec3::new(0.0, 0.6, 0.8) });
            fields.push(Field::Facing { viewer });
            for (ray, axis) in [(Ray::Reflected, 0), (Ray::Reflected, 1), (Ray::Normal, 0)] {
                fields.push(Field::Plane { light, viewer, ray, axis });
            }
        }
        let (x, y, h) = (0.1, -0.15, 1e-5);
        for field in fields {
            let at = |x: f64, y: f64| {
                let jet = sphere(x, y);
                field.value(jet.position, jet.normal().unwrap()).unwrap()
            };
            let jet = field.jet(&normal_jet(x, y)).unwrap();
            let du = (at(x + h, y) - at(x - h, y)) / (2.0 * h);
            let dv = (at(x, y + h) - at(x, y - h)) / (2.0 * h);
            let size = 1.0 + du.abs() + dv.abs();
            assert!(
                (jet.du - du).abs() < 3e-9 * size && (jet.dv - dv).abs() < 3e-9 * size,
                "{field:?}: {jet:?}"
            );
            assert_eq!(jet.value, at(x, y));
        }
    }

    #[test]
    fn rays_that_miss_the_plane_give_nothing() {
        let viewer = Viewer::Parallel(Vec3::new(0.0, 0.0, -1.0));
        let (point, normal) = (Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, 1.0));
        let hit = |light: PlaneLight| light.hit(Ray::Reflected, &viewer, point, normal);
        assert!(hit(ceiling(2.0)).is_some());
        assert!(hit(ceiling(0.5)).is_none(), "the plane is behind");
        assert!(hit(PlaneLight { half: [0.05, 1.0], ..ceiling(2.0) }).is_none(), "beyond its end");
        let wall = PlaneLight { axes: [Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)], ..ceiling(2.0) };
        assert!(hit(wall).is_none(), "the ray runs along the plane");
    }
}
