//! The pictures of a page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use ogee::Vec3;
use ogee::quality::{PlaneLight, Surface};
use ogee_render::{
    ANGLE, Camera, Pattern, Quantity, RenderError, Sampling, Scene, Style, THREE_QUARTER, outline, render,
    seen,
};

use super::marks::Mark;

/// A picture on the page.
pub(super) struct Picture {
    pub(super) title: &'static str,
    pub(super) caption: &'static str,
    /// The address of the picture: all of it.
    pub(super) source: String,
    /// That of the second surface, if there is one, or why it is not to be seen.
    pub(super) beside: Option<Result<String, RenderError>>,
    /// Number and place of each mark that is seen, in pixels.
    pub(super) marks: Vec<(usize, [f64; 2])>,
    /// Where the colours of a map end.
    pub(super) limit: Option<f64>,
}

/// Width and height on the page; the view whose eye sees the lines that are measured.
pub(crate) const SIZE: [u32; 2] = [720, 540];

/// Samples along a side of a pixel.
const SAMPLES: u32 = 2;

/// Where else one may look from. The one that shows most of what the front hides is taken.
const OTHER_SIDES: [(Vec3, &str); 6] = [
    (Vec3::new(-0.6, 0.75, 0.28), "From behind"),
    (Vec3::new(-0.6, 0.75, -0.45), "From behind and below"),
    (Vec3::new(0.55, -0.7, -0.6), "From the front and below"),
    (Vec3::new(-0.55, -0.7, 0.46), "From the left"),
    (Vec3::new(0.2, -0.3, 0.93), "From above"),
    (Vec3::new(0.2, -0.3, -0.93), "From below"),
];

/// Towards the light of isophotes.
const LAMP: Vec3 = Vec3::new(0.36, -0.48, 0.8);

/// The axis around which zebra stripes run.
const ACROSS: Vec3 = Vec3::new(1.0, 0.0, 0.0);

/// Lines of light over the diagonal of the surface, and the bright share of each.
const LINES: f64 = 10.0;
const WIDTH: f64 = 0.3;

/// All pictures, each of a second surface too if there is one; the reflection lines are those that were measured under `light`.
pub(super) fn pictures(
    surface: &dyn Surface,
    beside: Option<&dyn Surface>,
    size: f64,
    light: PlaneLight,
    marks: &[Mark],
) -> Result<Vec<Picture>, RenderError> {
    let points = outline(surface);
    let places: Vec<Vec3> = marks.iter().map(|mark| mark.position).collect();
    let look = |from: Vec3| {
        let camera = Camera::fit_from(from, &points, ANGLE, SIZE);
        let shown = camera.view(SIZE).map(|view| seen(surface, &view, &places));
        (camera, shown.unwrap_or_default())
    };
    let (front, in_front) = look(THREE_QUARTER);
    let mut other = (look(OTHER_SIDES[0].0), OTHER_SIDES[0].1);
    let hidden = |shown: &[Option<[f64; 2]>]| {
        shown.iter().zip(&in_front).filter(|(here, there)| here.is_some() && there.is_none()).count()
    };
    for (from, title) in OTHER_SIDES.into_iter().skip(1).filter(|_| in_front.contains(&None)) {
        let side = look(from);
        if hidden(&side.1) > hidden(&other.0.1) {
            other = (side, title);
        }
    }
    let ((back, behind), other_side) = other;
    let pattern = Pattern::Lines { period: size / LINES, width: WIDTH, phase: 0.0 };
    let none = Vec::new();
    let wanted = [
        (front, Style::Shaded, &in_front, "From the front", "The numbers are those of the table below."),
        (
            back,
            Style::Shaded,
            &behind,
            other_side,
            "What the front hides. Marks that neither shows are left out.",
        ),
        (
            front,
            Style::Reflection { light, pattern },
            &none,
            "Reflection lines",
            "Tubes of light above, mirrored in the surface. Lines break off where faces meet at an angle and kink where \
             curvature jumps; where it is dark, no tube is seen.",
        ),
        (
            front,
            Style::Zebra { axis: ACROSS, count: 12.0 },
            &none,
            "Zebra",
            "Stripes of a world far away, mirrored: they reach every side, also those that the tubes of light do not.",
        ),
        (
            front,
            Style::Isophote { light: LAMP, step: 10.0 },
            &none,
            "Isophotes",
            "Bands of equal angle between the normal and a light from the front and above, 10 degrees for a dark and a \
             bright one together. They do not move with the eye.",
        ),
        (
            front,
            Style::Curvature { quantity: Quantity::Mean, limit: None },
            &none,
            "Mean curvature",
            "Blue where the surface bulges, red where it is hollow, grey where it is flat or bends both ways alike.",
        ),
    ];
    wanted
        .into_iter()
        .map(|(camera, style, shown, title, caption)| {
            let fine = SIZE.map(|side| SAMPLES * side);
            let scene = Scene { camera, size: fine, style, sampling: Sampling::Exact };
            let picture = render(surface, &scene)?;
            let beside =
                beside.map(|second| render(second, &scene.beside(&picture)).map(|second| address(&second)));
            let marks = (1..).zip(shown).filter_map(|(number, at)| Some((number, (*at)?))).collect();
            Ok(Picture { title, caption, source: address(&picture), beside, marks, limit: picture.limit })
        })
        .collect()
}

/// A kind of picture of several surfaces, side by side.
pub(super) struct Row {
    pub(super) title: &'static str,
    pub(super) caption: &'static str,
    /// The address of each picture, or why it is not there.
    pub(super) sources: Vec<Result<String, RenderError>>,
    /// Where the colours of a map end, in all of them.
    pub(super) limit: Option<f64>,
}

/// Surfaces of one cage side by side, as the camera sees the first and with the colours of the first.
pub(super) fn rows(surfaces: &[&dyn Surface], size: f64) -> Result<Vec<Row>, RenderError> {
    let camera = Camera::fit_from(THREE_QUARTER, &outline(surfaces[0]), ANGLE, SIZE);
    let light = lamps_behind(&camera, size);
    let pattern = Pattern::Lines { period: size / LAMPS, width: 0.5, phase: 0.0 };
    let wanted = [
        (
            Style::Highlight { light, pattern },
            "Highlight lines",
            "Stripes where normals meet parallel lamps on the side of the eye. They kink where curvature jumps.",
        ),
        (
            Style::Curvature { quantity: Quantity::Mean, limit: None },
            "Mean curvature",
            "One scale of colours for all. Blue where the surface bulges, red where it is hollow.",
        ),
    ];
    wanted
        .into_iter()
        .map(|(style, title, caption)| {
            let fine = SIZE.map(|side| SAMPLES * side);
            let scene = Scene { camera, size: fine, style, sampling: Sampling::Exact };
            let first = render(surfaces[0], &scene)?;
            let others = surfaces[1..]
                .iter()
                .map(|&surface| render(surface, &scene.beside(&first)).map(|picture| address(&picture)));
            let limit = first.limit;
            let sources = std::iter::once(Ok(address(&first))).chain(others).collect();
            Ok(Row { title, caption, sources, limit })
        })
        .collect()
}

/// Lamps over the diagonal, where they are on the side of the eye.
const LAMPS: f64 = 5.0;

/// Upright lamps on a plane that faces what is seen, by the size of it away: they meet the normal of every point in sight.
fn lamps_behind(camera: &Camera, size: f64) -> PlaneLight {
    let towards = (camera.eye - camera.at).normalized().unwrap_or(ACROSS);
    let right = camera.up.cross(towards).normalized().unwrap_or(ACROSS);
    let axes = [right, towards.cross(right)];
    PlaneLight { centre: camera.at + size * towards, axes, half: [f64::INFINITY; 2] }
}

/// A picture as an address that holds all of it.
fn address(picture: &ogee_render::Picture) -> String {
    let mut png = Vec::new();
    // Writing into memory does not fail.
    let _ = picture.reduced(SAMPLES).image().write_png(&mut png);
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}
