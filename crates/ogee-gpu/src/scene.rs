//! A scene as shaders are told of it.

use ogee::quality::PlaneLight;
use ogee_render::{Pattern, Quantity, Sampling, Scene, Style, View};

use crate::flat::narrow;
use crate::frame::Frame;
use crate::layout::{self, NEWTON_STEPS, Picture, code};

/// A scene, for a polygon of so many cells and a map that ends at `limit`.
pub(crate) fn picture(scene: &Scene, view: &View, frame: &Frame, cells: u32, limit: Option<f64>) -> Picture {
    let mut picture = Picture { view: frame.view(view), cells, ..Picture::default() };
    (picture.points, picture.newton) = match scene.sampling {
        _ if matches!(scene.style, Style::Error { .. }) => (code::SURFACE, NEWTON_STEPS),
        Sampling::Exact => (code::SURFACE, NEWTON_STEPS),
        Sampling::Parameters(_) => (code::SURFACE, 0),
        Sampling::Polygon(_) => (code::POLYGON, 0),
    };
    let mut lit = |ray: u32, light: &PlaneLight, on_it: &Pattern| {
        (picture.style, picture.ray) = (code::LIT, ray);
        picture.light = frame.light(light);
        picture.pattern = pattern(on_it, frame);
    };
    match &scene.style {
        Style::Shaded => picture.style = code::SHADED,
        Style::Wireframe => picture.style = code::WIREFRAME,
        Style::Reflection { light, pattern } => lit(code::REFLECTED, light, pattern),
        Style::Highlight { light, pattern } => lit(code::NORMAL, light, pattern),
        Style::Isophote { light, step } => {
            picture.style = code::ISOPHOTE;
            (picture.direction, picture.step) = (narrow(*light), *step as f32);
        }
        Style::Zebra { axis, count } => {
            picture.style = code::ZEBRA;
            (picture.direction, picture.step) = (narrow(*axis), *count as f32);
        }
        Style::Curvature { quantity, .. } => {
            picture.style = code::CURVATURE;
            picture.quantity = number(*quantity);
            picture.limit = limit.map_or(0.0, |limit| (limit / unit(&scene.style, frame)) as f32);
        }
        Style::Error { light, .. } => {
            picture.style = code::ERROR;
            picture.light = frame.light(light);
            picture.limit = ogee_render::DISPLACEMENT as f32;
        }
        Style::Combs { .. } => picture.style = code::COMBS,
    }
    picture
}

/// What the value of a pixel is multiplied by to be one of the model.
pub(crate) fn unit(style: &Style, frame: &Frame) -> f64 {
    let scale = frame.length(1.0);
    match style {
        Style::Curvature { quantity: Quantity::Gauss | Quantity::GaussSign, .. } => scale * scale,
        Style::Curvature { .. } => scale,
        Style::Combs { .. } => 1.0 / scale,
        _ => 1.0,
    }
}

fn pattern(pattern: &Pattern, frame: &Frame) -> layout::Pattern {
    let length = |length: f64| frame.length(length) as f32;
    let base = layout::Pattern { period: 1.0, ..layout::Pattern::default() };
    match pattern {
        Pattern::Lines { period, width, phase } => layout::Pattern {
            kind: code::LINES,
            period: length(*period),
            width: *width as f32,
            phase: *phase as f32,
            ..base
        },
        Pattern::Lattice { period, width } => {
            layout::Pattern { kind: code::LATTICE, period: length(*period), width: *width as f32, ..base }
        }
        Pattern::Circles { period, radius } => {
            layout::Pattern { kind: code::CIRCLES, period: length(*period), radius: *radius as f32, ..base }
        }
        Pattern::Image { image, half } => layout::Pattern {
            kind: code::IMAGE,
            half: length(*half),
            size: image.levels.first().map_or([1; 2], |(size, _)| *size),
            ..base
        },
    }
}

fn number(quantity: Quantity) -> u32 {
    match quantity {
        Quantity::Gauss => code::GAUSS,
        Quantity::Mean => code::MEAN,
        Quantity::K1 => code::K1,
        Quantity::K2 => code::K2,
        Quantity::Greatest => code::GREATEST,
        Quantity::GaussSign => code::GAUSS_SIGN,
    }
}

/// Texels of a picture on the light plane, all scales one after the other.
pub(crate) fn light_texels(style: &Style) -> Vec<[f32; 4]> {
    match style {
        Style::Reflection { pattern: Pattern::Image { image, .. }, .. }
        | Style::Highlight { pattern: Pattern::Image { image, .. }, .. } => {
            let texels = image.levels.iter().flat_map(|(_, texels)| texels);
            texels.map(|&[red, green, blue]| [red, green, blue, 0.0]).collect()
        }
        _ => Vec::new(),
    }
}
