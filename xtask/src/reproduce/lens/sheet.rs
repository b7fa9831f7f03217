//! Sheets: one net by every method, under the same light or on the same scale of colours.

use anyhow::{Context, Result};
use ogee::nurbs::FaceAddress;
use ogee::quality::{PatchView, PlaneLight};
use ogee::{FaceId, Grid, Vec3};
use ogee_render::{Camera, Image, Pattern, Projection, Quantity, Sampling, Scene, Style, render};

use super::methods::{Depth, Method, treatment};
use super::nets::Example;

/// Pixels along the sides of a picture of one method.
pub(in crate::reproduce) const TILE: u32 = 300;

/// Samples along each side of a pixel.
const SAMPLES: u32 = 3;

/// Pictures side by side.
const COLUMNS: usize = 4;

/// Which sheet.
#[derive(Clone, Copy)]
pub(super) enum Sheet {
    /// Lines of light.
    Lines,
    /// Mean curvature as colours.
    MeanCurvature,
}

/// How a net is looked at.
pub(super) struct Look {
    /// From where.
    pub(super) from: Vec3,
    /// What is in the middle.
    pub(super) at: Vec3,
    /// How much of the model a picture shows.
    pub(super) height: f64,
    /// Lines of light.
    pub(super) light: Light,
    /// The mean curvature where colours end.
    pub(super) curvature: f64,
}

/// Lines of light.
#[derive(Clone, Copy)]
pub(super) enum Light {
    /// Highlight lines of parallel lights above, with the distance from one to the next, across a direction.
    Above { height: f64, period: f64, across: Vec3 },
    /// Stripes of an environment far away, around an axis, as many pairs from pole to pole.
    Around { axis: Vec3, count: f64 },
}

impl Light {
    fn style(self) -> Style {
        match self {
            Light::Above { height, period, across } => {
                let across = across.normalized().unwrap_or_default();
                let axes = [across, Vec3::new(-across.y, across.x, 0.0)];
                let centre = Vec3::new(0.0, 0.0, height);
                let light = PlaneLight { centre, axes, half: [f64::INFINITY; 2] };
                Style::Highlight { light, pattern: Pattern::Lines { period, width: 0.5, phase: 0.25 } }
            }
            Light::Around { axis, count } => {
                Style::Zebra { axis: axis.normalized().unwrap_or_default(), count }
            }
        }
    }
}

/// A net by all methods that there are for it.
pub(super) fn sheet(example: &Example, sheet: Sheet) -> Result<Image> {
    let look = &example.look;
    let style = match sheet {
        Sheet::Lines => look.light.style(),
        Sheet::MeanCurvature => Style::Curvature { quantity: Quantity::Mean, limit: Some(look.curvature) },
    };
    let eye = look.at + 100.0 * look.height * look.from.normalized().context("a direction to look from")?;
    let projection = Projection::Parallel { height: look.height };
    let camera = Camera { eye, at: look.at, up: Vec3::new(0.0, 0.0, 1.0), projection };
    let scene = Scene { camera, size: [TILE * SAMPLES; 2], style, sampling: Sampling::Exact };
    let mut tiles = Vec::new();
    for method in Method::ALL {
        let Some(treatment) = treatment(&example.mesh, method, Depth::DRAWN)? else { continue };
        let address = FaceAddress::whole(FaceId(0));
        let patches = treatment.patches.into_iter().map(|patch| (patch, Grid::from_fn(1, 1, |_, _| address)));
        let view = PatchView::new(patches.collect())?;
        let mut tile = render(&view, &scene)?.reduced(SAMPLES).image();
        tile.add_caption(method.name());
        tiles.push(tile);
    }
    if let (Sheet::MeanCurvature, Some(last)) = (sheet, tiles.last_mut()) {
        last.add_legend(&scene.style, look.curvature);
    }
    Ok(tiled(&tiles, COLUMNS))
}

/// Pictures of one size in rows of so many, with lines of paper between them.
pub(in crate::reproduce) fn tiled(tiles: &[Image], across: usize) -> Image {
    const GAP: u32 = 4;
    let rows = tiles.len().div_ceil(across) as u32;
    let columns = tiles.len().min(across) as u32;
    let size = [columns * (TILE + GAP) - GAP, rows * (TILE + GAP) - GAP];
    let mut image = Image::filled(size, [255; 4]);
    for (number, tile) in tiles.iter().enumerate() {
        let left = (number % across) * (TILE + GAP) as usize;
        let top = (number / across) * (TILE + GAP) as usize;
        for (y, row) in tile.pixels.chunks_exact(4 * TILE as usize).enumerate() {
            let first = 4 * ((top + y) * size[0] as usize + left);
            image.pixels[first..first + row.len()].copy_from_slice(row);
        }
    }
    image
}
