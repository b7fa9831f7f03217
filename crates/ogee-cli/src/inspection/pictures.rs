//! The pictures of a page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use ogee::Vec3;
use ogee::quality::{PlaneLight, Surface};
use ogee_render::{
    ANGLE, Camera, Pattern, Quantity, RenderError, Sampling, Scene, Style, THREE_QUARTER, outline, render, seen,
};

use super::marks::Mark;

/// A picture on the page.
pub(super) struct Picture {
    pub(super) title: &'static str,
    pub(super) caption: &'static str,
    /// The address of the picture: all of it.
    pub(super) source: String,
    /// Number and place of each mark that is seen, in pixels.
    pub(super) marks: Vec<(usize, [f64; 2])>,
    /// Where the colours of a map end.
    pub(super) limit: Option<f64>,
}

/// Width and height on the page; the view whose eye sees the lines that are measured.
pub(crate) const SIZE: [u32; 2] = [720, 540];

/// Samples along a side of a pixel.
const SAMPLES: u32 = 2;

/// Behind the surface, a little below the usual view.
const BACK: Vec3 = Vec3::new(-0.6, 0.75, 0.28);

/// Lines of light over the diagonal of the surface, and the bright share of each.
const LINES: f64 = 20.0;
const WIDTH: f64 = 0.3;

/// All pictures; `eye` is that whose reflection lines were measured under `light`.
pub(super) fn pictures(
    surface: &dyn Surface,
    size: f64,
    light: PlaneLight,
    marks: &[Mark],
) -> Result<Vec<Picture>, RenderError> {
    let points = outline(surface);
    let [front, back] = [THREE_QUARTER, BACK].map(|from| Camera::fit_from(from, &points, ANGLE, SIZE));
    let pattern = Pattern::Lines { period: size / LINES, width: WIDTH, phase: 0.0 };
    let up = Vec3::new(0.0, 0.0, 1.0);
    let wanted = [
        (front, Style::Shaded, true, "From the front", "The numbers are those of the table below."),
        (back, Style::Shaded, true, "From behind", "What the front hides. Marks on hidden places are left out."),
        (
            front,
            Style::Reflection { light, pattern },
            false,
            "Reflection lines",
            "Tubes of light above, mirrored in the surface. Lines break at a gap, kink at an angle, and bend \
             suddenly where curvature jumps.",
        ),
        (
            front,
            Style::Isophote { light: up, step: 10.0 },
            false,
            "Isophotes",
            "Bands of equal angle to the vertical, 10° for a dark and a bright one together. They do not move with \
             the eye.",
        ),
        (
            front,
            Style::Curvature { quantity: Quantity::Mean, limit: None },
            false,
            "Mean curvature",
            "Blue where the surface bends away from you, red where it bends towards you, grey where it is flat.",
        ),
    ];
    let places: Vec<Vec3> = marks.iter().map(|mark| mark.position).collect();
    wanted
        .into_iter()
        .map(|(camera, style, is_marked, title, caption)| {
            let fine = SIZE.map(|side| SAMPLES * side);
            let scene = Scene { camera, size: fine, style, sampling: Sampling::Exact };
            let picture = render(surface, &scene)?;
            let mut png = Vec::new();
            // Writing into memory does not fail.
            let _ = picture.reduced(SAMPLES).image().write_png(&mut png);
            let mut shown = Vec::new();
            if let Some(view) = camera.view(SIZE).filter(|_| is_marked) {
                let pixels = seen(surface, &view, &places);
                shown.extend((1..).zip(pixels).filter_map(|(number, at)| Some((number, at?))));
            }
            let source = format!("data:image/png;base64,{}", STANDARD.encode(png));
            Ok(Picture { title, caption, source, marks: shown, limit: picture.limit })
        })
        .collect()
}
