//! Curvature combs: hairs along the normal, as long as the curve bends.
//!
//! The curves are those in the middle of faces and those between them. A hair stands where the curve bends away from the
//! outside, and points inward where it bends the other way. Hairs are drawn whole, over whatever is behind or before them,
//! where the surface that they stand on is in sight.

use ogee::quality::{FLAT, Side, Square, Surface, bounding_box};
use ogee::{Derivatives, Location, Samples, SurfaceJet, Vec3};
use rayon::prelude::*;

use crate::canvas::{Canvas, pixels};
use crate::colour::{Colour, decode};
use crate::{DepthImage, View};

/// Steps from hair to hair along a curve across a square.
const MOST: usize = 24;
const LEAST: usize = 4;

/// Thin lines that a step is wide, so that the outline of the hairs is smooth, and that hairs are apart that are drawn.
const STEP: f64 = 2.0;
const APART: f64 = 4.0;

/// Times the usual length, at most: where surfaces turn sharply hairs would hide everything else.
const LONGEST: f64 = 2.0;

/// Where curves are looked at to find how they bend: away from their ends, where curvature need not be bounded.
const INNER: [f64; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];

/// Curves that one task looks at.
const CHUNK: usize = 256;

/// Draws combs over a picture; hairs are `share` of the diagonal of the surface long, where 90 % of all are shorter. They
/// stand where the surface, whose depth along the view each pixel has, is in sight.
pub fn draw(surface: &dyn Surface, view: &View, share: f64, depths: &[f64], colours: &mut [Colour]) {
    let curves = curves(surface);
    let Some(scale) = Scale::new(surface, &curves, share) else { return };
    let thick = view.line_width();
    let sight = DepthImage::of_depths(view, depths.to_vec());
    let combs: Vec<Vec<Option<[Vec3; 2]>>> = curves
        .par_chunks(CHUNK)
        .flat_map_iter(|curves| {
            let steps = steps(surface, view, &scale, curves, STEP * thick);
            let hairs = hairs(surface, curves.iter().zip(steps).map(|(curve, steps)| curve.evenly(steps)));
            let seen = |hair: Option<Hair>| {
                let hair = hair.filter(|hair| sight.shows(hair.root))?;
                Some([hair.root, scale.tip(&hair)])
            };
            hairs.into_iter().map(move |comb| comb.into_iter().map(seen).collect()).collect::<Vec<_>>()
        })
        .collect();
    let mut canvas = Canvas::new(view, colours);
    let (hair, outline) = ([40, 90, 160].map(linear), [190, 40, 30].map(linear));
    for comb in &combs {
        let mut drawn: Option<[Vec3; 2]> = None;
        for &[root, tip] in comb.iter().flatten() {
            let is_near = |[a, b]: [Vec3; 2]| pixels(view, a, root).max(pixels(view, b, tip)) < APART * thick;
            if !drawn.is_some_and(is_near) {
                canvas.line(root, tip, hair, 0.7 * thick);
                drawn = Some([root, tip]);
            }
        }
    }
    for comb in &combs {
        for pair in comb.windows(2) {
            if let [Some([_, one]), Some([_, next])] = *pair {
                canvas.line(one, next, outline, 0.9 * thick);
            }
        }
    }
}

/// Where some hairs of every curve end: what has to be in the picture beside the surface.
pub fn tips(surface: &dyn Surface, share: f64) -> Vec<Vec3> {
    let curves = curves(surface);
    let Some(scale) = Scale::new(surface, &curves, share) else { return Vec::new() };
    let of_chunk = |curves: &[Curve<'_>]| -> Vec<Vec3> {
        let hairs = hairs(surface, curves.iter().map(Curve::inner));
        hairs.iter().flatten().flatten().map(|hair| scale.tip(hair)).collect()
    };
    curves.par_chunks(CHUNK).flat_map_iter(of_chunk).collect()
}

/// A curve across a square: one parameter runs, the other stays.
#[derive(Clone, Copy)]
struct Curve<'a> {
    square: &'a Square,
    along: u8,
    across: f64,
}

impl Curve<'_> {
    fn at(&self, x: f64) -> Location {
        if self.along == 0 { self.square.at(x, self.across) } else { self.square.at(self.across, x) }
    }

    fn evenly(self, steps: usize) -> Places {
        Places { along: self.along, at: (0..=steps).map(|i| self.at(i as f64 / steps as f64)).collect() }
    }

    fn inner(&self) -> Places {
        Places { along: self.along, at: INNER.iter().map(|&x| self.at(x)).collect() }
    }
}

/// Where hairs stand on a curve.
struct Places {
    along: u8,
    at: Vec<Location>,
}

/// The curves in the middle of squares, and those along their edges: one where two squares meet smoothly, one for each
/// where they do not.
fn curves(surface: &dyn Surface) -> Vec<Curve<'_>> {
    let layout = surface.layout();
    let middles =
        layout.squares().iter().flat_map(|square| [0, 1].map(|along| Curve { square, along, across: 0.5 }));
    let shared = layout.joints().iter().flat_map(|joint| &joint.sides[..1 + usize::from(joint.is_sharp)]);
    let edges = shared.copied().chain(layout.border()).filter_map(|Side { square, side }| {
        let square = &layout.squares()[square as usize];
        let [along, across] = [[0, 0], [1, 1], [0, 1], [1, 0]][side as usize];
        square.edges[side as usize].then_some(Curve { square, along, across: f64::from(across) })
    });
    middles.chain(edges).collect()
}

/// How long hairs are.
struct Scale {
    /// The bend than which 90 % are less.
    usual: f64,
    /// The length of a hair there.
    length: f64,
}

impl Scale {
    /// `None` where nothing bends.
    fn new(surface: &dyn Surface, curves: &[Curve<'_>], share: f64) -> Option<Scale> {
        let [lower, upper] = bounding_box(surface)?;
        let diagonal = upper.distance(lower);
        let of_chunk = |curves: &[Curve<'_>]| -> Vec<f64> {
            let hairs = hairs(surface, curves.iter().map(Curve::inner));
            hairs.iter().flatten().flatten().map(|hair| hair.bend.abs()).collect()
        };
        let mut sizes: Vec<f64> = curves.par_chunks(CHUNK).flat_map_iter(of_chunk).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let usual = sizes.get(sizes.len() * 9 / 10).copied().unwrap_or_default();
        (usual > FLAT / diagonal).then_some(Scale { usual, length: share * diagonal })
    }

    fn tip(&self, hair: &Hair) -> Vec3 {
        hair.root - (self.length * (hair.bend / self.usual).clamp(-LONGEST, LONGEST)) * hair.normal
    }
}

/// Where a curve of the surface bends.
#[derive(Clone, Copy)]
struct Hair {
    root: Vec3,
    normal: Vec3,
    /// Negative where the surface bends away from its normal; hairs stand outside there.
    bend: f64,
}

fn linear(byte: u8) -> f32 {
    decode(f32::from(byte) / 255.0)
}

/// How many steps it takes along each curve from hair to hair, if neither their roots nor their tips are to be farther
/// apart than so many pixels.
fn steps(surface: &dyn Surface, view: &View, scale: &Scale, curves: &[Curve<'_>], apart: f64) -> Vec<usize> {
    let enough = |comb: &Vec<Option<Hair>>| {
        let hairs = comb.windows(2).filter_map(|pair| pair[0].zip(pair[1]));
        let lengths =
            hairs.map(|(a, b)| pixels(view, a.root, b.root).max(pixels(view, scale.tip(&a), scale.tip(&b))));
        // They stand on two thirds of the curve.
        ((1.5 * lengths.sum::<f64>() / apart) as usize).clamp(LEAST, MOST)
    };
    hairs(surface, curves.iter().map(Curve::inner)).iter().map(enough).collect()
}

/// The hairs of some curves; `None` where the surface has no curvature.
fn hairs(surface: &dyn Surface, curves: impl Iterator<Item = Places>) -> Vec<Vec<Option<Hair>>> {
    let curves: Vec<Places> = curves.collect();
    let at: Vec<Location> = curves.iter().flat_map(|curve| &curve.at).copied().collect();
    let mut samples = Samples::default();
    surface.evaluate(&at, Derivatives::Second, &mut samples);
    let hair = |along: u8, i: usize| {
        let (position, normal) = (samples.position[i], samples.normal[i]);
        let jet = SurfaceJet {
            position,
            du: samples.du[i],
            dv: samples.dv[i],
            duu: samples.duu[i],
            duv: samples.duv[i],
            dvv: samples.dvv[i],
        };
        let direction = if along == 0 { jet.du } else { jet.dv };
        let bend = jet.normal_curvature(normal, direction).filter(|bend| bend.is_finite())?;
        Some(Hair { root: position, normal, bend })
    };
    let mut first = 0;
    let of_curve = |curve: &Places| {
        let all = first..first + curve.at.len();
        first = all.end;
        all.map(|i| hair(curve.along, i)).collect()
    };
    curves.iter().map(of_curve).collect()
}
