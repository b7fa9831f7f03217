//! Lines on a surface, as curves: OBJ for programs that model, SVG for paper, JSON for everything else.

mod json;
mod obj;
mod svg;

pub use json::write_json;
pub use obj::write_obj;
pub use svg::{Drawing, Path, write_svg};

/// How lines are written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineFormat {
    /// A drawing.
    Svg,
    /// Vertices and polylines in space.
    Obj,
    /// Everything: places on the surface as well.
    Json,
}
