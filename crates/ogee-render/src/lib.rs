//! Pictures of exact surfaces.
//!
//! A picture is made in three passes, as in Yasui and Kanai: which face and parameters each pixel shows, the point of the
//! surface there, and its colour. Points come from the surface itself, so a reflection line in the picture is a reflection
//! line of the surface, not of a mesh near it. Everything is `f64` on all cores, and is the reference for the same pictures
//! made by a graphics processor.
//!
//! | file | holds |
//! | --- | --- |
//! | `camera` | [`Camera`], [`View`]: where a point is in the picture |
//! | `style` | [`Scene`], [`Style`], [`Pattern`]: what is shown |
//! | [`pattern`], [`colour`], [`shade`] | how bright, which colour: functions with twins in shaders |
//! | `image` | [`Image`]: pixels, PNG |

mod camera;
pub mod colour;
mod image;
pub mod pattern;
pub mod shade;
mod style;

pub use camera::{Camera, Projection, View};
pub use image::{Image, ImageError, Light};
pub use style::{Pattern, Quantity, Sampling, Scene, Style, default_light};
