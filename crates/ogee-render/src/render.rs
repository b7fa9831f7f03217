//! `render`: a surface and a scene become a picture.

use std::time::Instant;

use ogee::quality::{FLAT, Layout, Ray, Surface};
use ogee::{Derivatives, Flags, Location, Samples, SurfaceJet, Vec3};
use rayon::prelude::*;

use crate::camera::{ANGLE, THREE_QUARTER, extent};
use crate::colour::{self, Colour, scaled};
use crate::comb;
use crate::polygon::Polygon;
use crate::raster::{Fragment, fragments};
use crate::shade::{self, Footprint, Point};
use crate::solve::{Spot, solve};
use crate::{Camera, Image, Quantity, Sampling, Scene, Style, View};

/// A picture in linear colours, and how it was made.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// Linear colours, row by row from the top left.
    pub colours: Vec<Colour>,
    /// Pixels that show the surface.
    pub fragments: usize,
    /// The level of the mesh that said what each pixel shows.
    pub level: u32,
    /// Where the colours of a map end.
    pub limit: Option<f64>,
    /// How long each stage took.
    pub seconds: Stages,
}

/// Seconds of wall time. Points and colours are made together; their time is shared out as their work was.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stages {
    /// Points of the mesh, and which face and parameters each pixel shows.
    pub ids: f64,
    /// Points of the surface.
    pub position: f64,
    /// Colours.
    pub colour: f64,
}

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A side of no pixels.
    #[error("a picture of {width} x {height} pixels has none; give both sides at least 1")]
    EmptySize {
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
    },
    /// More pixels than memory is meant for.
    #[error("a picture of {width} x {height} pixels is too large; {most} pixels are the most")]
    TooLarge {
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
        /// The most pixels.
        most: u64,
    },
    /// Nothing can be projected.
    #[error(
        "the camera shows nothing: the eye must differ from what it looks at, up must not be along the view, and the angle of view must be between 0 and 180 degrees"
    )]
    BadCamera,
    /// A closed surface hides all.
    #[error("the eye is inside the surface; move it away")]
    EyeInside,
    /// All of it is beside the picture or behind the eye.
    #[error("no part of the surface covers a pixel of the picture; move the eye or what it looks at")]
    EmptyView,
    /// No pattern to be seen.
    #[error("no ray from the visible surface meets the light plane; move it to where rays go, or turn it")]
    LightMissed,
    /// A mesh has no curvature.
    #[error("a mesh of facets has no curvature; maps of it want exact points")]
    CurvatureOfPolygon,
    /// A mesh finer than memory is meant for.
    #[error("a mesh of level {level} has more than {most} faces; ask for a lower level")]
    TooFine {
        /// The level.
        level: u32,
        /// The most faces.
        most: usize,
    },
}

impl RenderError {
    /// A stable name in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            RenderError::EmptySize { .. } => "empty_size",
            RenderError::TooLarge { .. } => "picture_too_large",
            RenderError::BadCamera => "bad_camera",
            RenderError::EyeInside => "eye_inside",
            RenderError::EmptyView => "empty_view",
            RenderError::LightMissed => "light_missed",
            RenderError::CurvatureOfPolygon => "curvature_of_polygon",
            RenderError::TooFine { .. } => "mesh_too_fine",
        }
    }
}

/// Pixels of a picture, at most.
pub const MOST_PIXELS: u64 = 1 << 28;

/// Faces of a mesh that was asked for, at most.
const MOST_FACES: usize = 1 << 24;

/// Fragments that one task evaluates at a time.
const CHUNK: usize = 4096;

/// Where colours of a displacement end, in pixels.
pub const DISPLACEMENT: f64 = 8.0;

/// Makes a picture, on all cores.
///
/// # Errors
/// If it would show nothing, or nothing of what was asked for.
pub fn render(surface: &dyn Surface, scene: &Scene) -> Result<Picture, RenderError> {
    let view = check(surface, scene)?;
    let start = Instant::now();
    let polygon = polygon(surface, scene, &view)?;
    let shown = fragments(&polygon, &view);
    if shown.is_empty() {
        return Err(RenderError::EmptyView);
    }
    let mut seconds = Stages { ids: start.elapsed().as_secs_f64(), ..Stages::default() };
    let pixels = scene.size[0] as usize * scene.size[1] as usize;
    let mut picture = Picture {
        size: scene.size,
        colours: vec![shade::palette::BACKGROUND; pixels],
        fragments: shown.len(),
        level: polygon.cells.trailing_zeros(),
        limit: None,
        seconds,
    };
    // Side by side, pixels of one face are evaluated together.
    let mut shown = shown;
    shown.par_chunks_mut(16 * CHUNK).for_each(|chunk| chunk.sort_unstable_by_key(|f| (f.place, f.pixel)));
    let start = Instant::now();
    let painter = Painter { surface, scene, view, polygon: &polygon };
    let looked: Vec<Looked> = shown.par_chunks(CHUNK).map(|chunk| painter.look(chunk)).collect();
    let values = looked.iter().flat_map(|looked| &looked.looks).filter_map(Look::value);
    picture.limit = limit(&scene.style, values).map(|limit| limit.max(least_limit(&scene.style, &polygon)));
    let is_missed = looked.iter().all(|looked| looked.hits == 0);
    if is_missed
        && matches!(scene.style, Style::Reflection { .. } | Style::Highlight { .. } | Style::Error { .. })
    {
        return Err(RenderError::LightMissed);
    }
    let fragments = shown.iter().zip(looked.iter().flat_map(|looked| &looked.looks));
    for (fragment, look) in fragments {
        picture.colours[fragment.pixel as usize] = painter.finished(look, picture.limit);
    }
    let all = start.elapsed().as_secs_f64();
    let [points, colours] = [0, 1].map(|part| looked.iter().map(|looked| looked.seconds[part]).sum::<f64>());
    seconds.position = all * points / (points + colours);
    let start = Instant::now();
    if let Style::Combs { share } = scene.style {
        let mut depths = vec![f64::INFINITY; pixels];
        for (fragment, &depth) in shown.iter().zip(looked.iter().flat_map(|looked| &looked.depths)) {
            depths[fragment.pixel as usize] = depth;
        }
        comb::draw(surface, &view, share, &depths, &mut picture.colours);
    }
    seconds.colour = all - seconds.position + start.elapsed().as_secs_f64();
    picture.seconds = seconds;
    Ok(picture)
}

/// What can be known before the first point: the camera in pixels.
///
/// # Errors
/// If the picture would show nothing.
pub fn check(surface: &dyn Surface, scene: &Scene) -> Result<View, RenderError> {
    let [width, height] = scene.size;
    if width == 0 || height == 0 {
        return Err(RenderError::EmptySize { width, height });
    }
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(RenderError::TooLarge { width, height, most: MOST_PIXELS });
    }
    if matches!((&scene.style, scene.sampling), (Style::Curvature { .. }, Sampling::Polygon(_))) {
        return Err(RenderError::CurvatureOfPolygon);
    }
    let view = scene.camera.view(scene.size).ok_or(RenderError::BadCamera)?;
    if !view.is_parallel && is_inside(surface, scene.camera.eye) {
        return Err(RenderError::EyeInside);
    }
    Ok(view)
}

/// True if a closed surface is around a point: by the solid angle of a mesh of it.
fn is_inside(surface: &dyn Surface, eye: Vec3) -> bool {
    let layout = surface.layout();
    if layout.border().next().is_some() {
        return false;
    }
    let all: Vec<u32> = (0..layout.squares().len() as u32).collect();
    let mesh = Polygon::new(surface, &all, 1, false);
    let [lower, upper] = extent(&mesh.points);
    let within = |low: f64, x: f64, high: f64| low < x && x < high;
    if !(within(lower.x, eye.x, upper.x)
        && within(lower.y, eye.y, upper.y)
        && within(lower.z, eye.z, upper.z))
    {
        return false;
    }
    let mut angle = 0.0;
    for place in 0..mesh.squares.len() {
        let grid = mesh.grid(place);
        for k in [0, 1, 3, 4] {
            for [a, b, c] in [[k, k + 1, k + 4], [k, k + 4, k + 3]] {
                let [a, b, c] = [grid[a] - eye, grid[b] - eye, grid[c] - eye];
                let (la, lb, lc) = (a.length(), b.length(), c.length());
                let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
                angle += 2.0 * a.dot(b.cross(c)).atan2(below);
            }
        }
    }
    angle.abs() > 2.0 * std::f64::consts::PI
}

/// The mesh that says what each pixel of a scene shows.
///
/// # Errors
/// If it was asked to be finer than memory is meant for.
pub fn polygon(surface: &dyn Surface, scene: &Scene, view: &View) -> Result<Polygon, RenderError> {
    let level = match (&scene.style, scene.sampling) {
        (Style::Error { level, .. }, _) => *level,
        (_, Sampling::Parameters(level) | Sampling::Polygon(level)) => level,
        (_, Sampling::Exact) => return Ok(Polygon::for_view(surface, view)),
    };
    polygon_of_level(surface, level)
}

/// The mesh with the points of the cage refined `level` times, moved to the limit, and their normals.
pub(crate) fn polygon_of_level(surface: &dyn Surface, level: u32) -> Result<Polygon, RenderError> {
    let squares = surface.layout().squares();
    // Where squares are halves of faces, one step is taken already.
    let steps = if is_cut(surface.layout()) { level.saturating_sub(1) } else { level };
    if steps > 15 || squares.len() << (2 * steps) > MOST_FACES {
        return Err(RenderError::TooFine { level, most: MOST_FACES });
    }
    let all: Vec<u32> = (0..squares.len() as u32).collect();
    Ok(Polygon::new(surface, &all, steps, true))
}

fn is_cut(layout: &Layout) -> bool {
    layout.squares().iter().any(|square| square.edges != [true; 4])
}

/// What is known of a pixel before the limits of maps are.
#[derive(Clone, Copy)]
enum Look {
    /// All.
    Colour(Colour),
    /// The number that a map shows, and how bright the body is.
    Value(Option<f64>, f32),
}

impl Look {
    /// The number that a map shows.
    fn value(&self) -> Option<f64> {
        match *self {
            Look::Value(value, _) => value,
            Look::Colour(_) => None,
        }
    }
}

struct Looked {
    looks: Vec<Look>,
    /// How many rays met the light plane.
    hits: usize,
    /// Of what is shown, for combs: a coarse mesh lies elsewhere.
    depths: Vec<f64>,
    /// Time for points and for colours.
    seconds: [f64; 2],
}

struct Painter<'a> {
    surface: &'a dyn Surface,
    scene: &'a Scene,
    view: View,
    polygon: &'a Polygon,
}

impl Painter<'_> {
    fn look(&self, chunk: &[Fragment]) -> Looked {
        let start = Instant::now();
        let mut spots: Vec<Spot> = chunk.iter().map(|fragment| self.spot(fragment)).collect();
        let is_error = matches!(self.scene.style, Style::Error { .. });
        let points: Vec<Point> = match self.scene.sampling {
            Sampling::Polygon(_) if !is_error => {
                chunk.iter().map(|fragment| polygon_point(self.polygon, fragment)).collect()
            }
            Sampling::Parameters(_) if !is_error => self.points(&self.at_parameters(&spots)),
            _ => self.points(&solve(self.surface, &self.view, &mut spots, self.wanted())),
        };
        let solved = start.elapsed().as_secs_f64();
        let depths = match self.scene.style {
            Style::Combs { .. } => points.iter().map(|point| self.view.to_camera(point.position).z).collect(),
            _ => Vec::new(),
        };
        let mut hits = 0;
        let looks = spots
            .iter()
            .zip(chunk)
            .zip(&points)
            .map(|((spot, fragment), point)| {
                hits += usize::from(self.meets_light(point));
                self.colour(spot, fragment, point)
            })
            .collect();
        Looked { looks, hits, depths, seconds: [solved, start.elapsed().as_secs_f64() - solved] }
    }

    fn spot(&self, fragment: &Fragment) -> Spot {
        let width = self.view.size[0];
        let pixel = [fragment.pixel % width, fragment.pixel / width].map(|x| f64::from(x) + 0.5);
        Spot { pixel, square: self.polygon.squares[fragment.place as usize], at: fragment.at }
    }

    fn wanted(&self) -> Derivatives {
        match self.scene.style {
            Style::Shaded | Style::Wireframe | Style::Combs { .. } => Derivatives::First,
            _ => Derivatives::Second,
        }
    }

    fn at_parameters(&self, spots: &[Spot]) -> Samples {
        let squares = self.surface.layout().squares();
        let at: Vec<Location> =
            spots.iter().map(|spot| squares[spot.square as usize].at(spot.at[0], spot.at[1])).collect();
        let mut samples = Samples::default();
        self.surface.evaluate(&at, self.wanted(), &mut samples);
        samples
    }

    /// Points of the surface itself.
    fn points(&self, samples: &Samples) -> Vec<Point> {
        let bends = self.wanted() == Derivatives::Second;
        let is_map = matches!(self.scene.style, Style::Curvature { .. });
        (0..samples.position.len())
            .map(|i| {
                let (position, normal) = (samples.position[i], samples.normal[i]);
                let tangents = [samples.du[i], samples.dv[i]];
                let flags = samples.flags[i];
                let is_bent = bends
                    && !flags.contains(Flags::AT_EXTRAORDINARY)
                    && !flags.contains(Flags::NORMAL_UNDEFINED);
                let jet = is_bent.then(|| SurfaceJet {
                    position,
                    du: tangents[0],
                    dv: tangents[1],
                    duu: samples.duu[i],
                    duv: samples.duv[i],
                    dvv: samples.dvv[i],
                });
                Point {
                    position,
                    tangents,
                    normal,
                    turns: jet.as_ref().filter(|_| !is_map).and_then(SurfaceJet::normal_derivatives),
                    curvature: jet.as_ref().filter(|_| is_map).and_then(SurfaceJet::curvature),
                }
            })
            .collect()
    }

    fn meets_light(&self, point: &Point) -> bool {
        let ray = match self.scene.style {
            Style::Highlight { .. } => Ray::Normal,
            _ => Ray::Reflected,
        };
        match &self.scene.style {
            Style::Reflection { light, .. } | Style::Highlight { light, .. } | Style::Error { light, .. } => {
                light.hit(ray, &self.view.viewer(), point.position, point.normal).is_some()
            }
            _ => true,
        }
    }

    /// The number that a map shows.
    fn value(&self, fragment: &Fragment, point: &Point) -> Option<f64> {
        match &self.scene.style {
            Style::Curvature { quantity, .. } => shade::curvature(*quantity, point),
            Style::Error { light, .. } => {
                let viewer = self.view.viewer();
                let other = polygon_point(self.polygon, fragment);
                let seen = light.hit(Ray::Reflected, &viewer, other.position, other.normal)?;
                let exact =
                    shade::normal_jet(point).and_then(|jet| light.hit_jet(Ray::Reflected, &viewer, &jet))?;
                let pixel = Footprint::new(&self.view, point);
                Some(pixel.distance(seen.at[0] - exact.hit.at[0], exact.du[0], exact.dv[0]))
            }
            _ => None,
        }
    }

    fn colour(&self, spot: &Spot, fragment: &Fragment, point: &Point) -> Look {
        let view = &self.view;
        let pixel = || Footprint::new(view, point);
        Look::Colour(match &self.scene.style {
            Style::Shaded | Style::Combs { .. } => shade::body(view, point.position, point.normal),
            Style::Wireframe => {
                let square = &self.surface.layout().squares()[spot.square as usize];
                let at = [spot.at[0] * square.size[0], spot.at[1] * square.size[1]];
                shade::wire(view, at, square.size, square.edges, point, &pixel())
            }
            Style::Reflection { light, pattern } => {
                shade::lit(view, light, Ray::Reflected, pattern, point, &pixel())
            }
            Style::Highlight { light, pattern } => {
                shade::lit(view, light, Ray::Normal, pattern, point, &pixel())
            }
            Style::Isophote { light, step } => shade::isophote(view, *light, *step, point, &pixel()),
            Style::Zebra { axis, count } => shade::zebra(view, *axis, *count, point, &pixel()),
            Style::Curvature { .. } | Style::Error { .. } => {
                let value = self.value(fragment, point);
                return Look::Value(value, shade::body_light(view, point.position, point.normal));
            }
        })
    }

    fn finished(&self, look: &Look, limit: Option<f64>) -> Colour {
        match (*look, &self.scene.style) {
            (Look::Colour(colour), _) => colour,
            (Look::Value(value, light), Style::Curvature { quantity, .. }) => {
                scaled(shade::map(*quantity, value, limit.unwrap_or_default()), light)
            }
            (Look::Value(value, light), _) => {
                scaled(shade::displacement(value, limit.unwrap_or(DISPLACEMENT)), light)
            }
        }
    }
}

/// A point of the mesh itself: position and normal interpolated over its triangle.
pub(crate) fn polygon_point(polygon: &Polygon, fragment: &Fragment) -> Point {
    let n = polygon.cells as usize;
    let scale = n as f64;
    let [s, t] = fragment.at.map(|x| x * scale);
    let (i, j) = ((s as usize).min(n - 1), (t as usize).min(n - 1));
    let (x, y) = (s - i as f64, t - j as f64);
    let first = i + (n + 1) * j;
    let [a, b, c, d] = [first, first + 1, first + n + 2, first + n + 1];
    // The two triangles of a cell meet from its first corner to its third.
    let (points, normals) =
        (polygon.grid(fragment.place as usize), polygon.grid_normals(fragment.place as usize));
    let slopes = |list: &[Vec3]| {
        if x >= y { [list[b] - list[a], list[c] - list[b]] } else { [list[c] - list[d], list[d] - list[a]] }
    };
    let [du, dv] = slopes(points);
    let [nu, nv] = slopes(normals);
    let mean = normals[a] + x * nu + y * nv;
    let length = mean.length();
    let normal = mean.normalized().unwrap_or_default();
    let turn = |slope: Vec3| (slope - normal.dot(slope) * normal) / length;
    Point {
        position: points[a] + x * du + y * dv,
        tangents: [scale * du, scale * dv],
        normal,
        turns: (length > 0.0).then(|| [scale * turn(nu), scale * turn(nv)]),
        curvature: None,
    }
}

/// Where the colours of a map end; `values` is what its pixels show.
pub fn limit(style: &Style, values: impl Iterator<Item = f64>) -> Option<f64> {
    match style {
        Style::Curvature { limit: Some(limit), .. } => Some(*limit),
        Style::Error { .. } => Some(DISPLACEMENT),
        Style::Curvature { quantity: Quantity::GaussSign, limit: None } => {
            values.map(f64::abs).reduce(f64::max)
        }
        Style::Curvature { limit: None, .. } => {
            let mut sizes: Vec<f64> = values.map(f64::abs).collect();
            sizes.sort_unstable_by(f64::total_cmp);
            let last = sizes.len().checked_sub(1)?;
            Some(sizes[(0.95 * last as f64) as usize])
        }
        _ => None,
    }
}

/// Where the colours of a map end at least, unless that was asked for: less is the curvature of a plane, and rounding.
fn least_limit(style: &Style, polygon: &Polygon) -> f64 {
    let Style::Curvature { quantity, limit: None } = style else { return 0.0 };
    let [lower, upper] = extent(&polygon.points);
    let flat = FLAT / upper.distance(lower);
    match quantity {
        Quantity::Gauss | Quantity::GaussSign => flat * flat,
        Quantity::Mean | Quantity::K1 | Quantity::K2 | Quantity::Greatest => flat,
    }
}

impl Picture {
    /// As many pixels in one, along both sides; linear light is averaged. Pixels that are left over are dropped.
    #[must_use]
    pub fn reduced(&self, times: u32) -> Picture {
        let size = self.size.map(|side| side / times);
        let one = |x: u32, y: u32| -> Colour {
            let mut sum = [0.0; 3];
            for j in 0..times {
                for i in 0..times {
                    let colour = self.colours[((y * times + j) * self.size[0] + x * times + i) as usize];
                    (0..3).for_each(|k| sum[k] += colour[k].clamp(0.0, 1.0));
                }
            }
            sum.map(|x| x / (times * times) as f32)
        };
        let colours =
            (0..size[1]).into_par_iter().flat_map_iter(|y| (0..size[0]).map(move |x| one(x, y))).collect();
        Picture { size, colours, ..self.clone() }
    }

    /// As screens and files want it.
    pub fn image(&self) -> Image {
        let pixel = |colour: &Colour| {
            let [red, green, blue] = colour::bytes(*colour);
            [red, green, blue, 255]
        };
        Image { size: self.size, pixels: self.colours.par_iter().flat_map_iter(pixel).collect() }
    }
}

/// Points of a surface: those of a mesh with four cells along a side of each square.
pub fn outline(surface: &dyn Surface) -> Vec<Vec3> {
    let all: Vec<u32> = (0..surface.layout().squares().len() as u32).collect();
    Polygon::new(surface, &all, 2, false).points
}

impl Scene {
    /// A shaded picture from a three-quarter view in which the surface fits.
    pub fn of(surface: &dyn Surface, size: [u32; 2]) -> Scene {
        let camera = Camera::fit_from(THREE_QUARTER, &outline(surface), ANGLE, size);
        Scene { camera, size, style: Style::Shaded, sampling: Sampling::Exact }
    }

    /// The scene of a second surface beside the picture of a first: the same colours for the same curvature.
    #[must_use]
    pub fn beside(&self, first: &Picture) -> Scene {
        let style = match self.style {
            Style::Curvature { quantity, .. } => Style::Curvature { quantity, limit: first.limit },
            ref style => style.clone(),
        };
        Scene { style, ..self.clone() }
    }
}
