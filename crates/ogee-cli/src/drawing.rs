//! Curves on a surface as curves in a picture.

use ogee::quality::{Field, LevelLine, Levels, LineOptions, LinesError, Side, Surface, Viewer, level_lines};
use ogee::{Derivatives, Location, Samples, Vec3};
use ogee_formats::lines::Path;
use ogee_render::View;

/// Of the height of the picture at its depth: what is nearer to the eye is not drawn.
const NEAR: f64 = 1e-3;

/// Lines in pixels, cut where they pass the eye.
pub(crate) fn projected(lines: &[LevelLine], view: &View) -> Vec<Path> {
    lines
        .iter()
        .flat_map(|line| {
            let points = line.points.iter().map(|point| Some(point.position));
            paths(points, line.closed, Some(line.value), view)
        })
        .collect()
}

/// The outline of a surface in pixels, inside its shape too, as far as lines there would be wanted.
pub(crate) fn outline(
    surface: &dyn Surface,
    view: &View,
    options: &LineOptions<'_>,
) -> Result<Vec<Path>, LinesError> {
    // By themselves points on the outline face nobody.
    let options = LineOptions { front: None, ..*options };
    let field = Field::Facing { viewer: view.viewer() };
    let mut paths =
        projected(&level_lines(surface, &field, &Levels::Listed(vec![0.0]), &options)?.lines, view);
    paths.iter_mut().for_each(|path| path.value = None);
    Ok(paths)
}

/// A border or a sharp edge: one side of it, and the other.
type Curve = (Side, Option<Side>);

/// The borders and sharp edges of a surface in pixels, as far as lines there would be wanted.
pub(crate) fn edges(surface: &dyn Surface, view: &View, options: &LineOptions<'_>) -> Vec<Path> {
    const STEPS: usize = 32;
    let layout = surface.layout();
    let sharp = layout.joints().iter().filter(|joint| joint.is_sharp);
    let curves: Vec<Curve> = (layout.border().map(|side| (side, None)))
        .chain(sharp.map(|joint| (joint.sides[0], Some(joint.sides[1]))))
        .collect();
    let samples = |place: &dyn Fn(&Curve, f64) -> Location| {
        let along = |curve| (0..=STEPS).map(move |k| place(curve, k as f64 / STEPS as f64));
        let at: Vec<Location> = curves.iter().flat_map(along).collect();
        let mut samples = Samples::default();
        surface.evaluate(&at, Derivatives::First, &mut samples);
        samples
    };
    let on_side = |Side { square, side }: Side, x| layout.squares()[square as usize].on_side(side, x);
    let here = samples(&|&(side, _), x| on_side(side, x));
    let beside = samples(&|&(side, other), x| other.map_or(on_side(side, x), |side| on_side(side, 1.0 - x)));
    let is_seen = |k: usize| {
        let position = here.position[k];
        let faces = |viewer: Viewer| {
            let (direction, _) = viewer.direction(position);
            [here.normal[k], beside.normal[k]].iter().any(|normal| normal.dot(direction) < 0.0)
        };
        options.front.is_none_or(faces) && options.visible.is_none_or(|visible| visible(position))
    };
    (0..curves.len())
        .flat_map(|curve| {
            let all = curve * (STEPS + 1)..(curve + 1) * (STEPS + 1);
            paths(all.map(|k| is_seen(k).then(|| here.position[k])), false, None, view)
        })
        .collect()
}

/// What can be drawn of a curve, in one piece or several.
fn paths(
    points: impl Iterator<Item = Option<Vec3>>,
    closed: bool,
    value: Option<f64>,
    view: &View,
) -> Vec<Path> {
    let near = if view.is_parallel { f64::NEG_INFINITY } else { NEAR * f64::from(view.size[1]) / view.scale };
    let mut paths = vec![Path { value, closed, points: Vec::new() }];
    for point in points {
        let seen = point.map(|point| view.to_camera(point)).filter(|q| q.z > near);
        match (seen, paths.last_mut()) {
            (Some(q), Some(path)) => path.points.push(view.pixel(q)),
            _ => paths.push(Path { value, closed: false, points: Vec::new() }),
        }
    }
    if let [first, _, ..] = &mut paths[..] {
        first.closed = false;
    }
    paths.retain(|path| path.points.len() > 1);
    paths
}
