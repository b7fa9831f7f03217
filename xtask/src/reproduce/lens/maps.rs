//! The w-plane and the characteristic ring in it, and the conformal maps that layouts of parameter lines follow.

use std::f64::consts::{FRAC_PI_4, TAU};

use ogee::Vec3;
use ogee::lens::lattice_point;

use super::bicubic::BicubicNet;
use crate::reproduce::plot::{Anchor, COLOURS, FAINT, Panel, Svg};

/// Straight pieces of a line of equal parameters.
const PIECES: usize = 32;

/// Lines of equal parameters across a patch, borders included.
const LINES: usize = 5;

/// The net of `z = w^2 / 4`.
fn characteristic() -> BicubicNet {
    BicubicNet {
        points: std::array::from_fn(|number| {
            let (i, j) = lattice_point(number);
            Vec3::new(f64::from(i * i - j * j) / 4.0, f64::from(2 * i * j) / 4.0, 0.0)
        }),
    }
}

/// Left the grid of the w-plane, of which the upper half is the whole surface; right the rings that come of its points.
pub(super) fn characteristic_ring() -> String {
    let mut svg = Svg::new([940.0, 480.0]);
    let plane = Panel { corner: [20.0, 40.0], size: [420.0, 420.0], least: [-2.1, -2.1], most: [2.1, 2.1] };
    let image =
        Panel { corner: [490.0, 40.0], size: [430.0, 420.0], least: [-2.15, -2.1], most: [2.15, 2.1] };
    let at = |k: usize| k as f64 / PIECES as f64;
    // Lower half of the w-plane: the same points again.
    for k in -2..=2 {
        let across = f64::from(k);
        svg.line(&plane.places(&[[across, -2.0], [across, 2.0]]), FAINT, 1.0);
        svg.line(&plane.places(&[[-2.0, across], [2.0, across]]), FAINT, 1.0);
    }
    for step in 0..4_usize {
        let size = 0.5_f64.powi(step as i32);
        let colour = COLOURS[[0, 1, 2, 3][step]];
        let squares = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for turned in [false, true] {
            for [a, b] in squares {
                for line in 0..LINES {
                    let share = line as f64 / (LINES - 1) as f64;
                    let width = if line == 0 || line == LINES - 1 { 1.8 } else { 0.6 };
                    let turn = |[u, v]: [f64; 2]| if turned { [-v, u] } else { [u, v] };
                    let along_u = [[a, b + share], [a + 1.0, b + share]];
                    let along_v = [[a + share, b], [a + share, b + 1.0]];
                    for ends in [along_u, along_v] {
                        let ends = ends.map(|[u, v]| turn([size * u, size * v]));
                        svg.line(&plane.places(&ends), colour, width);
                    }
                }
            }
        }
    }
    for (step, ring) in characteristic().rings(ogee::LensShape::default(), 4).iter().enumerate() {
        for patch in ring {
            for line in 0..LINES {
                let share = line as f64 / (LINES - 1) as f64;
                let width = if line == 0 || line == LINES - 1 { 1.8 } else { 0.6 };
                let point = |u: f64, v: f64| {
                    let p = patch.jet(u, v).position;
                    [p.x, p.y]
                };
                let along_u: Vec<_> = (0..=PIECES).map(|k| point(at(k), share)).collect();
                let along_v: Vec<_> = (0..=PIECES).map(|k| point(share, at(k))).collect();
                svg.line(&image.places(&along_u), COLOURS[step], width);
                svg.line(&image.places(&along_v), COLOURS[step], width);
            }
        }
    }
    svg.text([230.0, 26.0], Anchor::Middle, 14.0, "the w-plane: w and -w are the same point");
    svg.text([705.0, 26.0], Anchor::Middle, 14.0, "rings 0 to 3 of the characteristic net: z = w² / 4");
    svg.finish()
}

/// Layouts and the maps that they follow.
pub(super) fn conformal() -> String {
    const SIDE: f64 = 300.0;
    let mut svg = Svg::new([980.0, 700.0]);
    let mut framed = |column: usize, row: usize, half: f64, title: &str, sheets: &[(Domain, Map<'_>)]| {
        let corner = [20.0 + (SIDE + 20.0) * column as f64, 40.0 + (SIDE + 40.0) * row as f64];
        let panel = Panel { corner, size: [SIDE; 2], least: [-half; 2], most: [half; 2] };
        for (domain, map) in sheets {
            parameter_lines(&mut svg, panel, *domain, map);
        }
        panel.axes(&mut svg, &[], &[]);
        svg.text([corner[0] + SIDE / 2.0, corner[1] - 12.0], Anchor::Middle, 14.0, title);
    };
    let square = |[x, y]: [f64; 2]| [x * x - y * y, 2.0 * x * y];
    let cosine = |[x, y]: [f64; 2]| {
        let [x, y] = [x * FRAC_PI_4, y * FRAC_PI_4];
        [y.cosh() * x.cos(), y.sinh() * x.sin()]
    };
    let exponential = |[x, y]: [f64; 2]| {
        let (radius, angle) = (y.exp(), x * FRAC_PI_4);
        [radius * angle.cos(), radius * angle.sin()]
    };
    framed(0, 0, 4.0, "lens: z = w²", &[([[-3.0, 3.0], [0.0, 3.0]], &square)]);
    framed(1, 0, 2.4, "pair of lenses: z = cos w", &[([[0.0, 8.0], [0.0, 3.0]], &cosine)]);
    framed(2, 0, 2.4, "pole: z = exp w", &[([[0.0, 8.0], [-3.0, 2.0]], &exponential)]);
    for (column, n) in [3_u32, 5, 6].into_iter().enumerate() {
        let power = 4.0 / f64::from(n);
        let sectors: Vec<_> = (0..n)
            .map(|sector| {
                let turn = TAU * f64::from(sector) / f64::from(n);
                move |[x, y]: [f64; 2]| {
                    let (radius, angle) = (x.hypot(y).powf(power), turn + y.atan2(x) * power);
                    [radius * angle.cos(), radius * angle.sin()]
                }
            })
            .collect();
        let domain = [[0.0, 4.0], [0.0, 4.0]];
        let sheets: Vec<(Domain, Map<'_>)> = sectors.iter().map(|map| (domain, map as Map<'_>)).collect();
        framed(column, 1, 2.8_f64.powf(power), &format!("valence {n}: z = w^(4/{n})"), &sheets);
    }
    svg.finish()
}

/// A rectangle of the w-plane: from where to where along both axes.
type Domain = [[f64; 2]; 2];

/// A map of the plane.
type Map<'a> = &'a dyn Fn([f64; 2]) -> [f64; 2];

/// Lines of equal parameters of a rectangle, as a map has them, as far as they are inside a panel.
fn parameter_lines(svg: &mut Svg, panel: Panel, [[x0, x1], [y0, y1]]: Domain, map: Map<'_>) {
    /// From one line to the next.
    const STEP: f64 = 0.5;
    /// Straight pieces of a unit.
    const FINE: f64 = 12.0;
    let mut line = |from: [f64; 2], to: [f64; 2], colour: &str| {
        let count = ((to[0] - from[0]).abs().max((to[1] - from[1]).abs()) * FINE) as usize;
        let points: Vec<[f64; 2]> = (0..=count)
            .map(|k| {
                let t = k as f64 / count as f64;
                map([0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis])))
            })
            .collect();
        for run in inside(&panel, &points) {
            svg.line(&panel.places(&run), colour, 1.1);
        }
    };
    let lines =
        |from: f64, to: f64| (0..=((to - from) / STEP).round() as usize).map(move |k| from + k as f64 * STEP);
    for x in lines(x0, x1) {
        line([x, y0], [x, y1], COLOURS[0]);
    }
    for y in lines(y0, y1) {
        line([x0, y], [x1, y], COLOURS[1]);
    }
}

/// The pieces of a line that a panel shows, up to its frame.
fn inside(panel: &Panel, points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let is_inside = |p: [f64; 2]| (0..2).all(|k| p[k] >= panel.least[k] && p[k] <= panel.most[k]);
    // Where the way from a point inside to one outside crosses the frame.
    let crossing = |own: [f64; 2], other: [f64; 2]| {
        let share = (0..2).fold(1.0_f64, |share, k| {
            let limit = if other[k] > own[k] { panel.most[k] } else { panel.least[k] };
            let whole = other[k] - own[k];
            if whole == 0.0 { share } else { share.min((limit - own[k]) / whole) }
        });
        [0, 1].map(|k| own[k] + share * (other[k] - own[k]))
    };
    let mut runs: Vec<Vec<[f64; 2]>> = Vec::new();
    for ends in points.windows(2) {
        let (a, b) = (ends[0], ends[1]);
        match (is_inside(a), is_inside(b)) {
            (true, true) => match runs.last_mut() {
                Some(run) if run.last() == Some(&a) => run.push(b),
                _ => runs.push(vec![a, b]),
            },
            (true, false) => match runs.last_mut() {
                Some(run) if run.last() == Some(&a) => run.push(crossing(a, b)),
                _ => runs.push(vec![a, crossing(a, b)]),
            },
            (false, true) => runs.push(vec![crossing(b, a), b]),
            (false, false) => {}
        }
    }
    runs
}
