//! `Stroke`: curves in space drawn over a picture of a surface, where the surface does not hide them.

use std::collections::HashMap;

use ogee::Vec3;
use ogee::quality::Surface;

use crate::canvas::{cover, pixels};
use crate::colour::{Colour, mix};
use crate::{Camera, DepthImage, Picture, RenderError, View};

/// A curve to be drawn, as points along it; one point alone makes a disc.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// Points in space, one after the other, so near to each other that straight lines between them will do.
    pub points: Vec<Vec3>,
    /// How many pixels wide it is. Its ends are round.
    pub width: f64,
    /// Its linear colour.
    pub colour: Colour,
}

/// Pixels from one place to the next where it is asked whether a stroke is in sight.
const STEP: f64 = 1.0;

/// Such places between two points, at most: more are beside the picture for the greatest part.
const MOST: f64 = 16_384.0;

impl Picture {
    /// Draws curves over the picture, one above the other, where they lie on the surface or before it. The surface and the
    /// camera are those that the picture was made with.
    ///
    /// # Errors
    /// If the camera shows nothing.
    pub fn draw(
        &mut self,
        surface: &dyn Surface,
        camera: &Camera,
        strokes: &[Stroke],
    ) -> Result<(), RenderError> {
        let view = camera.view(self.size).ok_or(RenderError::BadCamera)?;
        let sight = DepthImage::new(surface, &view);
        for stroke in strokes {
            for (pixel, cover) in covered(stroke, &view, &sight) {
                self.colours[pixel] = mix(self.colours[pixel], stroke.colour, cover);
            }
        }
        Ok(())
    }
}

/// The pixels that a stroke covers, each once, however many of its pieces touch it.
fn covered(stroke: &Stroke, view: &View, sight: &DepthImage) -> HashMap<usize, f32> {
    let mut covers: HashMap<usize, f32> = HashMap::new();
    let mut before: Option<Vec3> = None;
    for point in places(&stroke.points, view) {
        let seen = Some(point).filter(|&point| sight.shows(point));
        if let Some(point) = seen {
            cover(view, [before.unwrap_or(point), point], stroke.width, |pixel, cover| {
                let covered = covers.entry(pixel).or_default();
                *covered = covered.max(cover);
            });
        }
        before = seen;
    }
    covers
}

/// The points of a stroke, and places between them.
fn places(points: &[Vec3], view: &View) -> impl Iterator<Item = Vec3> {
    let between = points.windows(2).flat_map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        let steps = (pixels(view, a, b) / STEP).ceil().clamp(1.0, MOST) as u32;
        (1..=steps).map(move |i| a.lerp(b, f64::from(i) / f64::from(steps)))
    });
    points.first().copied().into_iter().chain(between)
}
