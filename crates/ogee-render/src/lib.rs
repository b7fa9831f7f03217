//! Pictures of exact surfaces.
//!
//! A picture is made in three passes, as in Yasui and Kanai: which face and parameters each pixel shows, the point of the
//! surface there, and its colour. Points come from the surface itself, so a reflection line in the picture is a reflection
//! line of the surface, not of a mesh near it. Everything is `f64` on all cores, and is the reference for the same pictures
//! made by a graphics processor.
//!
//! | file | holds |
//! | --- | --- |
//! | `render` | [`render`]: the passes, [`Picture`] |
//! | `polygon`, `raster` | [`Polygon`], [`Fragment`]: which face and parameters a pixel shows |
//! | `solve` | from there to the point that the pixel shows exactly |
//! | `depth` | [`DepthImage`]: what is in sight |
//! | `displacement` | [`displacement`]: how far lines are from their place, in pixels |
//! | `stroke` | [`Stroke`]: curves drawn over a picture |
//! | `comb`, `legend` | combs; the scale of a map |
//! | `canvas` | lines in space, as pixels |
//! | `camera` | [`Camera`], [`View`]: where a point is in the picture |
//! | `sight` | [`seen`]: which points nothing hides |
//! | `style` | [`Scene`], [`Style`], [`Pattern`]: what is shown |
//! | [`pattern`], [`colour`], [`shade`] | how bright, which colour: functions with twins in shaders |
//! | `image` | [`Image`]: pixels, PNG |

mod camera;
mod canvas;
pub mod colour;
pub mod comb;
mod depth;
mod displacement;
mod image;
mod legend;
pub mod pattern;
mod polygon;
mod raster;
mod render;
pub mod shade;
mod sight;
mod solve;
mod stroke;
mod style;

pub use camera::{ANGLE, Camera, Projection, THREE_QUARTER, View};
pub use depth::DepthImage;
pub use displacement::{Displacement, Spread, displacement};
pub use image::{Image, ImageError, Light};
pub use polygon::Polygon;
pub use raster::Fragment;
pub use render::{
    DISPLACEMENT, MOST_PIXELS, Picture, RenderError, Stages, check, limit, outline, polygon, render,
};
pub use sight::seen;
pub use stroke::Stroke;
pub use style::{Pattern, Quantity, Sampling, Scene, Style, default_light};
