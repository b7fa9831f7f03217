//! The colour of a point.

use ogee::quality::{Field, NormalJet, PlaneLight, Ray};
use ogee::{Curvature, Vec3};

use crate::colour::{Colour, DIVERGING, RISING, along, mix, scaled};
use crate::pattern::{disc, lattice, line, stripe};
use crate::{Pattern, Quantity, View};

/// Linear colours of bodies and of what is around them.
pub mod palette {
    use super::Colour;

    /// Behind everything.
    pub const BACKGROUND: Colour = [0.86, 0.87, 0.88];
    /// The matt body, seen from outside.
    pub const BODY: Colour = [0.52, 0.56, 0.60];
    /// The inner side of an open surface.
    pub const INSIDE: Colour = [0.52, 0.36, 0.22];
    /// Glossy paint between the lights it mirrors.
    pub const PAINT: Colour = [0.045, 0.065, 0.095];
    /// The same on the inner side.
    pub const PAINT_INSIDE: Colour = [0.095, 0.05, 0.03];
    /// A light.
    pub const LIGHT: Colour = [0.94, 0.95, 0.96];
    /// Edges.
    pub const EDGE: Colour = [0.02, 0.04, 0.08];
    /// Dark bands.
    pub const DARK: Colour = [0.02, 0.03, 0.045];
    /// Where a map has no value.
    pub const NOTHING: Colour = [0.30, 0.30, 0.30];
}

/// A point of the surface in a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Position.
    pub position: Vec3,
    /// Derivatives along the parameters.
    pub tangents: [Vec3; 2],
    /// Unit normal; zero where there is none.
    pub normal: Vec3,
    /// Derivatives of the normal; `None` where there are none, or they are not wanted.
    pub turns: Option<[Vec3; 2]>,
    /// Curvatures, where they are wanted and exist.
    pub curvature: Option<Curvature>,
}

/// What rays depend on; `None` where normals do not turn smoothly.
#[inline]
pub fn normal_jet(at: &Point) -> Option<NormalJet> {
    let Point { position, tangents, normal, .. } = *at;
    Some(NormalJet { position, tangents, normal, turns: at.turns? })
}

/// A pixel in the parameters of the surface: columns say how far `u` and `v` move along its two sides.
#[derive(Clone, Copy, Debug)]
pub struct Footprint {
    /// Along a row of pixels.
    pub x: [f64; 2],
    /// Along a column of pixels.
    pub y: [f64; 2],
}

impl Footprint {
    /// The pixel that shows a point; infinite where the surface is seen edge-on.
    pub fn new(view: &View, at: &Point) -> Footprint {
        let q = view.to_camera(at.position);
        let [a, c] = view.pixel_motion(q, view.turned(at.tangents[0]));
        let [b, d] = view.pixel_motion(q, view.turned(at.tangents[1]));
        let determinant = a * d - b * c;
        Footprint { x: [d / determinant, -c / determinant], y: [-b / determinant, a / determinant] }
    }

    /// How far a number with these derivatives moves along both sides of the pixel together.
    #[inline]
    pub fn spread(&self, du: f64, dv: f64) -> f64 {
        let along = |side: [f64; 2]| (side[0] * du + side[1] * dv).abs();
        let spread = along(self.x) + along(self.y);
        if spread.is_nan() { f64::INFINITY } else { spread }
    }

    /// How many pixels away a number with these derivatives is 0.
    #[inline]
    pub fn distance(&self, value: f64, du: f64, dv: f64) -> f64 {
        let along = |side: [f64; 2]| side[0] * du + side[1] * dv;
        value.abs() / along(self.x).hypot(along(self.y)).max(f64::MIN_POSITIVE)
    }
}

/// Light on a matt body, from 0 to 1: soft, from above the left shoulder of the viewer; both sides alike.
#[inline]
pub fn matt(view: &View, point: Vec3, normal: Vec3) -> f32 {
    let (direction, _) = view.viewer().direction(point);
    let [right, up, forward] = view.axes;
    let light = 0.62 * up - 0.38 * right - 0.69 * forward;
    let toward = if direction.dot(normal) > 0.0 { -normal } else { normal };
    let wrapped = (0.5 + 0.5 * toward.dot(light)).clamp(0.0, 1.0);
    (0.12 + 0.88 * wrapped * wrapped) as f32
}

/// True where the inner side is seen.
#[inline]
pub fn is_inside(view: &View, point: Vec3, normal: Vec3) -> bool {
    view.viewer().direction(point).0.dot(normal) > 0.0
}

/// The matt body.
pub fn body(view: &View, point: Vec3, normal: Vec3) -> Colour {
    let colour = if is_inside(view, point, normal) { palette::INSIDE } else { palette::BODY };
    scaled(colour, matt(view, point, normal))
}

/// Glossy paint, of which `bright` shows a light of this colour.
pub fn paint(view: &View, point: Vec3, normal: Vec3, light: Colour, bright: f32) -> Colour {
    let colour = if is_inside(view, point, normal) { palette::PAINT_INSIDE } else { palette::PAINT };
    mix(scaled(colour, 0.35 + 1.3 * matt(view, point, normal)), light, bright)
}

/// Light and dark bands with a touch of the body's shape.
pub fn bands(view: &View, point: Vec3, normal: Vec3, bright: f32) -> Colour {
    scaled(mix(palette::DARK, palette::LIGHT, bright), body_light(view, point, normal))
}

/// A pattern on the light plane as a point sees it.
pub fn lit(
    view: &View,
    light: &PlaneLight,
    ray: Ray,
    pattern: &Pattern,
    at: &Point,
    pixel: &Footprint,
) -> Colour {
    let position = at.position;
    let hit = normal_jet(at).and_then(|jet| light.hit_jet(ray, &view.viewer(), &jet));
    let Some(hit) = hit else {
        return paint(view, position, at.normal, palette::LIGHT, 0.0);
    };
    let [x, y] = hit.hit.at;
    let spread = [0, 1].map(|axis| pixel.spread(hit.du[axis], hit.dv[axis]));
    let (colour, bright) = match pattern {
        Pattern::Lines { period, width, phase } => {
            (palette::LIGHT, stripe(x / period + phase, spread[0] / period, *width))
        }
        Pattern::Lattice { period, width } => {
            (palette::LIGHT, lattice([x / period, y / period], spread.map(|s| s / period), *width))
        }
        Pattern::Circles { period, radius } => {
            let wide = spread[0].max(spread[1]) / period;
            (palette::LIGHT, disc(x / period, y / period, wide, *radius))
        }
        Pattern::Image { image, half } => match image.at([x, y], *half, spread[0].max(spread[1])) {
            Some(colour) => (colour, 0.92),
            None => (palette::LIGHT, 0.0),
        },
    };
    paint(view, position, at.normal, colour, bright as f32)
}

/// Bands of equal angle, in degrees, between the normal and the light.
pub fn isophote(view: &View, light: Vec3, step: f64, at: &Point, pixel: &Footprint) -> Colour {
    let angle = at.normal.cross(light).length().atan2(at.normal.dot(light));
    let spread = match at.turns {
        // The angle changes as the normal turns towards the light.
        Some(turns) => {
            let sine = angle.sin().max(1e-9);
            let [du, dv] = turns.map(|turn| (-turn.dot(light) / sine).clamp(-turn.length(), turn.length()));
            pixel.spread(du, dv)
        }
        None => 0.0,
    };
    let bright = stripe(angle.to_degrees() / step, spread.to_degrees() / step, 0.5);
    bands(view, at.position, at.normal, bright as f32)
}

/// Stripes of an environment far away.
pub fn zebra(view: &View, axis: Vec3, count: f64, at: &Point, pixel: &Footprint) -> Colour {
    let field = Field::Zebra { viewer: view.viewer(), axis };
    let bright = match normal_jet(at).and_then(|jet| field.jet(&jet)) {
        Some(jet) => {
            let slope = 1.0 / (1.0 - jet.value * jet.value).max(1e-9).sqrt();
            let per_angle = count / std::f64::consts::PI;
            let spread = pixel.spread(slope * jet.du, slope * jet.dv);
            stripe(per_angle * jet.value.clamp(-1.0, 1.0).asin(), per_angle * spread, 0.5)
        }
        None => 0.5,
    };
    bands(view, at.position, at.normal, bright as f32)
}

/// The curvature that a map shows; `None` where the surface has none.
pub fn curvature(quantity: Quantity, at: &Point) -> Option<f64> {
    let curvature = at.curvature?;
    Some(match quantity {
        Quantity::Gauss | Quantity::GaussSign => curvature.gauss,
        Quantity::Mean => curvature.mean,
        Quantity::K1 => curvature.k1,
        Quantity::K2 => curvature.k2,
        Quantity::Greatest => curvature.k1.abs().max(curvature.k2.abs()),
    })
}

/// The colour of a curvature; `limit` is where colours end.
pub fn map(quantity: Quantity, value: Option<f64>, limit: f64) -> Colour {
    let Some(value) = value else { return palette::NOTHING };
    let share = if limit > 0.0 { (value / limit) as f32 } else { 0.0 };
    match quantity {
        Quantity::Greatest => along(&RISING, share),
        // What is flat to a thousandth of the greatest is flat.
        Quantity::GaussSign => along(&DIVERGING, 0.5 + 0.5 * (1e3 * share).clamp(-1.0, 1.0)),
        _ => along(&DIVERGING, 0.5 + 0.5 * share),
    }
}

/// How bright a body is whose shape can still be seen below a map.
pub fn body_light(view: &View, point: Vec3, normal: Vec3) -> f32 {
    0.55 + 0.45 * matt(view, point, normal)
}

/// The edges of a square of parameters on the body: `at` is in the square, from 0 to `size`, and `sides` says which of its
/// sides are edges, counter-clockwise from the one along the first parameter.
pub fn wire(
    view: &View,
    [s, t]: [f64; 2],
    size: [f64; 2],
    sides: [bool; 4],
    at: &Point,
    pixel: &Footprint,
) -> Colour {
    let distances = [
        pixel.distance(t, 0.0, 1.0),
        pixel.distance(size[0] - s, 1.0, 0.0),
        pixel.distance(size[1] - t, 0.0, 1.0),
        pixel.distance(s, 1.0, 0.0),
    ];
    let nearest = (0..4).filter(|&k| sides[k]).fold(f64::INFINITY, |least, k| least.min(distances[k]));
    mix(body(view, at.position, at.normal), palette::EDGE, line(nearest, 1.3 * view.line_width()) as f32)
}

/// The colour of a displacement of lines, in pixels, up to `limit`.
pub fn displacement(pixels: Option<f64>, limit: f64) -> Colour {
    pixels.map_or(palette::NOTHING, |pixels| along(&RISING, (pixels / limit) as f32))
}
