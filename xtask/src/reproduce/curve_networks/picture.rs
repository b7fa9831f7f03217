//! Pictures of surfaces with their curves.

use anyhow::Result;
use ogee::curve_network::Embedding;
use ogee::quality::{LimitView, Surface};
use ogee::{ControlMesh, Corner, Crease, Level, LimitSurface, PatchTable, Sharpness, Topology, Vec3};
use ogee_render::colour::decode;
use ogee_render::{Camera, Image, Sampling, Scene, Stroke, Style, outline, render};

/// Samples along each side of a pixel.
const SAMPLES: u32 = 3;

/// Straight pieces of a span of a curve.
const PIECES: usize = 48;

/// Pixels.
const CURVE: f64 = 3.2;
const THIN: f64 = 1.5;
const DISC: f64 = 8.0;
const RIM: f64 = 1.6;

/// How a picture is taken.
#[derive(Clone, Copy)]
pub(super) struct Shot {
    /// Where the viewer is.
    pub(super) from: Vec3,
    /// What is in the picture; all of the surface if there is none.
    pub(super) ball: Option<(Vec3, f64)>,
    /// Around what stripes far away run, and how many pairs there are from pole to pole.
    pub(super) stripes: (Vec3, f64),
    /// Pixels.
    pub(super) size: [u32; 2],
}

/// Lines to be drawn on a surface, and points.
#[derive(Default)]
pub(super) struct Drawing {
    pub(super) lines: Vec<Vec<Vec3>>,
    pub(super) points: Vec<Vec3>,
}

impl Drawing {
    /// The curves of a network, and where they meet.
    pub(super) fn of(embedding: &Embedding) -> Drawing {
        let line = |curve: &ogee::curve_network::TargetCurve| {
            (0..=PIECES * curve.spans()).map(|i| curve.point(i as f64 / PIECES as f64)).collect()
        };
        let center = |v: u32| embedding.mesh.points[v as usize];
        Drawing {
            lines: embedding.segments.iter().map(|segment| line(&segment.target)).collect(),
            points: embedding.x_configurations.iter().map(|x| center(x.center)).collect(),
        }
    }

    /// Edges of a mesh.
    pub(super) fn of_paths(mesh: &ControlMesh, paths: &[Vec<u32>]) -> Drawing {
        let line = |path: &Vec<u32>| path.iter().map(|&v| mesh.points[v as usize]).collect();
        Drawing { lines: paths.iter().map(line).collect(), points: Vec::new() }
    }

    /// Broad lines with rims.
    fn broad(&self) -> Vec<Stroke> {
        let discs: Vec<Vec<Vec3>> = self.points.iter().map(|&point| vec![point]).collect();
        let layer = |rim: f64, colour: [u8; 3]| {
            let lines = self.lines.iter().map(move |line| stroke(line, CURVE + rim, colour));
            lines.chain(discs.iter().map(move |disc| stroke(disc, DISC + rim, colour)))
        };
        layer(RIM, [40, 16, 0]).chain(layer(0.0, [255, 122, 0])).collect()
    }

    /// Thin lines, which leave what is mirrored to be seen.
    fn thin(&self) -> Vec<Stroke> {
        self.lines.iter().map(|line| stroke(line, THIN, [255, 112, 0])).collect()
    }
}

fn stroke(points: &[Vec3], pixels: f64, colour: [u8; 3]) -> Stroke {
    let colour = colour.map(|byte| decode(f32::from(byte) / 255.0));
    Stroke { points: points.to_vec(), width: pixels * f64::from(SAMPLES), colour }
}

/// The surface with its curves, and what it mirrors beside it.
pub(super) fn pair(mesh: &ControlMesh, drawing: &Drawing, shot: &Shot) -> Result<Image> {
    with_surface(mesh, |surface| {
        let left = drawn(surface, shot, Style::Shaded, &drawing.broad())?;
        Ok(left.beside(&drawn(surface, shot, mirrored(shot.stripes), &drawing.thin())?))
    })
}

/// What the surface mirrors.
pub(super) fn mirror(mesh: &ControlMesh, drawing: &Drawing, shot: &Shot) -> Result<Image> {
    with_surface(mesh, |surface| drawn(surface, shot, mirrored(shot.stripes), &drawing.thin()))
}

/// A mesh as a polyhedron, its edges drawn, with lines on it.
pub(super) fn polyhedron(mesh: &ControlMesh, drawing: &Drawing, shot: &Shot) -> Result<Image> {
    let topology = Topology::new(mesh)?;
    let mut sharp = ControlMesh { meetings: Vec::new(), ..mesh.clone() };
    let crease =
        |h| Crease { vertices: [topology.origin(h).0, topology.target(h).0], sharpness: Sharpness::Infinite };
    sharp.creases = topology.edge_halfedges().map(crease).collect();
    let corner = |vertex| Corner { vertex, sharpness: Sharpness::Infinite };
    sharp.corners = (0..mesh.points.len() as u32).map(corner).collect();
    with_surface(&sharp, |surface| drawn(surface, shot, Style::Wireframe, &drawing.broad()))
}

fn with_surface<T>(mesh: &ControlMesh, look: impl FnOnce(&LimitView<'_>) -> Result<T>) -> Result<T> {
    let level = Level::new(mesh)?;
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    look(&LimitView::new(&level, &surface))
}

fn drawn(surface: &dyn Surface, shot: &Shot, style: Style, strokes: &[Stroke]) -> Result<Image> {
    let shown = match shot.ball {
        None => outline(surface),
        Some((middle, radius)) => around(middle, radius),
    };
    let camera = Camera::fit_from(shot.from, &shown, 26.0, shot.size);
    let size = shot.size.map(|side| side * SAMPLES);
    let mut picture = render(surface, &Scene { camera, size, style, sampling: Sampling::Exact })?;
    picture.draw(surface, &camera, strokes)?;
    Ok(picture.reduced(SAMPLES).image())
}

fn around(middle: Vec3, radius: f64) -> Vec<Vec3> {
    let steps = [-radius, radius];
    let corner = |x: f64, y: f64, z: f64| middle + Vec3::new(x, y, 0.3 * z);
    steps
        .iter()
        .flat_map(|&x| steps.map(|y| (x, y)))
        .flat_map(|(x, y)| steps.map(|z| corner(x, y, z)))
        .collect()
}

fn mirrored((axis, count): (Vec3, f64)) -> Style {
    Style::Zebra { axis: axis.normalized().unwrap_or_default(), count }
}
