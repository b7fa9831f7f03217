//! A scene as shaders are told of it.

use ogee_render::{Pattern, Quantity, Sampling, Scene, Style, View};

use crate::flat::narrow;
use crate::frame::Frame;
use crate::layout::{self, NEWTON_STEPS, Picture, Shown, code};

/// What a scene shows of a surface whose points are in so many parts.
pub(crate) fn shown(scene: &Scene, parts: u32) -> Shown {
    let nothing = Shown::nothing(parts);
    let lit = |ray: u32, pattern: &Pattern| {
        let pattern = match pattern {
            Pattern::Lines { .. } => code::LINES,
            Pattern::Lattice { .. } => code::LATTICE,
            Pattern::Circles { .. } => code::CIRCLES,
            Pattern::Image { .. } => code::IMAGE,
        };
        Shown { style: code::LIT, pattern, ray, ..nothing }
    };
    let only = |style: u32| Shown { style, ..nothing };
    let shown = match &scene.style {
        Style::Shaded => only(code::SHADED),
        Style::Wireframe => only(code::WIREFRAME),
        Style::Reflection { pattern, .. } => lit(code::REFLECTED, pattern),
        Style::Highlight { pattern, .. } => lit(code::NORMAL, pattern),
        Style::Isophote { .. } => only(code::ISOPHOTE),
        Style::Zebra { .. } => only(code::ZEBRA),
        Style::Curvature { .. } => only(code::CURVATURE),
        Style::Error { .. } => only(code::ERROR),
        Style::Combs { .. } => only(code::COMBS),
    };
    let is_polygon = matches!(scene.sampling, Sampling::Polygon(_)) && !is_error(scene);
    Shown { points: if is_polygon { code::POLYGON } else { code::SURFACE }, ..shown }
}

/// Errors compare a polygon with exact points, whatever else is asked for.
pub(crate) fn is_error(scene: &Scene) -> bool {
    matches!(scene.style, Style::Error { .. })
}

/// A scene, for a polygon of so many cells and a map that ends at `limit`.
pub(crate) fn picture(scene: &Scene, view: &View, frame: &Frame, cells: u32, limit: Option<f64>) -> Picture {
    let is_exact = scene.sampling == Sampling::Exact || is_error(scene);
    let newton = if is_exact { NEWTON_STEPS } else { 0 };
    let mut picture = Picture { view: frame.view(view), cells, newton, ..Picture::default() };
    match &scene.style {
        Style::Shaded | Style::Wireframe | Style::Combs { .. } => {}
        Style::Reflection { light, pattern } | Style::Highlight { light, pattern } => {
            picture.light = frame.light(light);
            picture.pattern = self::pattern(pattern, frame);
        }
        Style::Isophote { light: direction, step } | Style::Zebra { axis: direction, count: step } => {
            (picture.direction, picture.step) = (narrow(*direction), *step as f32);
        }
        Style::Curvature { quantity, .. } => {
            picture.quantity = number(*quantity);
            picture.limit = limit.map_or(0.0, |limit| (limit / unit(&scene.style, frame)) as f32);
        }
        Style::Error { light, .. } => {
            picture.light = frame.light(light);
            picture.limit = ogee_render::DISPLACEMENT as f32;
        }
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
        Pattern::Lines { period, width, phase } => {
            layout::Pattern { period: length(*period), width: *width as f32, phase: *phase as f32, ..base }
        }
        Pattern::Lattice { period, width } => {
            layout::Pattern { period: length(*period), width: *width as f32, ..base }
        }
        Pattern::Circles { period, radius } => {
            layout::Pattern { period: length(*period), radius: *radius as f32, ..base }
        }
        Pattern::Image { image, half } => layout::Pattern {
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
