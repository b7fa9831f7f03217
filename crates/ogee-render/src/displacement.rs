//! How far reflection lines in a picture are from their place.
//!
//! Three ways to a pixel are compared with the exact one: a mesh of some level with its own positions and normals, and the
//! surface at the parameters that such a mesh has there (`surface-interrogation`, the experiment of Yasui and Kanai in
//! numbers).

use ogee::quality::{NormalJet, PlaneLight, Ray, Surface};
use ogee::{Derivatives, Location, Samples, SurfaceJet};

use crate::raster::fragments;
use crate::render::{polygon_of_level, polygon_point};
use crate::shade::{Footprint, Point};
use crate::solve::{Spot, residuals, solve};
use crate::{Camera, RenderError};

/// Of many numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The middle one.
    pub median: f64,
    /// 95 % are below.
    pub p95: f64,
    /// 99 % are below.
    pub p99: f64,
}

impl Spread {
    fn of(mut numbers: Vec<f64>) -> Spread {
        numbers.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| {
            let last = numbers.len().saturating_sub(1);
            numbers.get((share * last as f64).round() as usize).copied().unwrap_or(f64::NAN)
        };
        Spread { median: at(0.5), p95: at(0.95), p99: at(0.99) }
    }
}

/// Displacements at one level, all in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    /// Of the mesh.
    pub level: u32,
    /// Pixels that were compared.
    pub fragments: usize,
    /// Of lines on the mesh.
    pub polygon: Spread,
    /// Of lines on the surface at the parameters of the mesh.
    pub parameters: Spread,
    /// Of the point at the parameters of the mesh from its pixel.
    pub offset: Spread,
    /// The median of what is left of that after one and after two steps of Newton's method.
    pub newton: [f64; 2],
}

/// Steeper views are left out: there a pixel is long on the surface.
const LEAST_COSINE: f64 = 0.2;

/// Compares a mesh of a level with the surface, for the lines across the first axis of a light plane.
///
/// # Errors
/// If the picture would show nothing.
pub fn displacement(
    surface: &dyn Surface,
    camera: &Camera,
    size: [u32; 2],
    light: &PlaneLight,
    level: u32,
) -> Result<Displacement, RenderError> {
    let view = camera.view(size).ok_or(RenderError::BadCamera)?;
    let viewer = view.viewer();
    let polygon = polygon_of_level(surface, level)?;
    let shown = fragments(&polygon, &view);
    if shown.is_empty() {
        return Err(RenderError::EmptyView);
    }
    let spots: Vec<Spot> = shown
        .iter()
        .map(|fragment| {
            let pixel = [fragment.pixel % size[0], fragment.pixel / size[0]].map(|x| f64::from(x) + 0.5);
            Spot { pixel, square: polygon.squares[fragment.place as usize], at: fragment.at }
        })
        .collect();
    let mut exact = spots.clone();
    // What is exact has to be so to far below what is compared.
    for _ in 0..3 {
        solve(surface, &view, &mut exact, Derivatives::First);
    }
    let jets = |spots: &[Spot]| -> Vec<SurfaceJet> {
        let squares = surface.layout().squares();
        let at: Vec<Location> =
            spots.iter().map(|spot| squares[spot.square as usize].at(spot.at[0], spot.at[1])).collect();
        let mut s = Samples::default();
        surface.evaluate(&at, Derivatives::Second, &mut s);
        let jet = |i: usize| SurfaceJet {
            position: s.position[i],
            du: s.du[i],
            dv: s.dv[i],
            duu: s.duu[i],
            duv: s.duv[i],
            dvv: s.dvv[i],
        };
        (0..at.len()).map(jet).collect()
    };
    let (mut of_polygon, mut of_parameters, mut kept) = (Vec::new(), Vec::new(), Vec::new());
    for (i, (exact, near)) in jets(&exact).into_iter().zip(jets(&spots)).enumerate() {
        let (Some(jet), Some(normal)) = (NormalJet::of(&exact), near.normal()) else { continue };
        if viewer.direction(jet.position).0.dot(jet.normal).abs() < LEAST_COSINE {
            continue;
        }
        let facet = polygon_point(&polygon, &shown[i]);
        let hits = (
            light.hit_jet(Ray::Reflected, &viewer, &jet),
            light.hit(Ray::Reflected, &viewer, near.position, normal),
            light.hit(Ray::Reflected, &viewer, facet.position, facet.normal),
        );
        let (Some(truth), Some(near), Some(facet)) = hits else { continue };
        let NormalJet { position, tangents, normal, turns } = jet;
        let point = Point { position, tangents, normal, turns: Some(turns), curvature: None };
        let pixel = Footprint::new(&view, &point);
        let apart = |at: f64| pixel.distance(at - truth.hit.at[0], truth.du[0], truth.dv[0]);
        of_polygon.push(apart(facet.at[0]));
        of_parameters.push(apart(near.at[0]));
        kept.push(spots[i]);
    }
    let mut left = residuals(surface, &view, &kept, 2).into_iter();
    let mut next = || Spread::of(left.next().unwrap_or_default());
    let (offset, once, twice) = (next(), next(), next());
    Ok(Displacement {
        level,
        fragments: kept.len(),
        polygon: Spread::of(of_polygon),
        parameters: Spread::of(of_parameters),
        offset,
        newton: [once.median, twice.median],
    })
}
