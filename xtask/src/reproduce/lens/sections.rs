//! Catmull and Clark's rule at valence 2 beside the bi-3 rule: section curves nearer and nearer to the vertex, and normal cones.

use ogee::nurbs::NurbsSurface;
use ogee::{LensShape, Vec3};

use super::bicubic::{BicubicNet, CATMULL_CLARK};
use crate::reproduce::plot::{Anchor, COLOURS, INK, Panel, Svg};

/// Rings that are plotted.
const RINGS: u32 = 13;

/// Straight pieces of a patch's border.
const PIECES: usize = 24;

const RULES: [(&str, LensShape, &str); 2] = [
    ("Catmull-Clark", CATMULL_CLARK, COLOURS[1]),
    ("bi-3", LensShape { beta: 0.5, gamma: 0.125 }, COLOURS[0]),
];

/// A net that is symmetric about the plane `y = 0`: the characteristic net with its vertex lifted.
fn lifted() -> BicubicNet {
    let mut points = std::array::from_fn(|number| {
        let (i, j) = ogee::lens::lattice_point(number);
        let (x, y) = (f64::from(i * i - j * j) / 4.0, f64::from(2 * i * j) / 4.0);
        Vec3::new(x, y, 0.12 * x - 0.03 * (x * x + y * y))
    });
    points[0].z += 0.4;
    BicubicNet { points }
}

/// The section with `y = 0`: in the first quadrant `v = 0` where `x > 0`, and `u = 0` where `x < 0`.
fn section(rings: &[Vec<NurbsSurface>]) -> [Vec<Vec3>; 2] {
    let steps = || (0..=PIECES).rev().map(|i| i as f64 / PIECES as f64);
    let border = |patch: usize, at: fn(f64) -> [f64; 2]| {
        rings
            .iter()
            .flat_map(|ring| steps().map(move |t| (at(t), &ring[patch])))
            .map(|([u, v], patch)| patch.jet(u, v).position)
            .collect()
    };
    [border(0, |t| [t, 0.0]), border(2, |t| [0.0, t])]
}

/// The largest angle of a normal of a ring to their mean, in degrees.
pub(super) fn cone(ring: &[NurbsSurface]) -> f64 {
    const SIDE: usize = 9;
    let places = (0..SIDE * SIDE).map(|k| [k / SIDE, k % SIDE].map(|i| i as f64 / (SIDE - 1) as f64));
    let normals: Vec<Vec3> =
        ring.iter().flat_map(|patch| places.clone().filter_map(|[u, v]| patch.jet(u, v).normal())).collect();
    let mean = normals.iter().fold(Vec3::ZERO, |sum, &normal| sum + normal);
    normals.iter().map(|normal| normal.angle(mean)).fold(0.0, f64::max).to_degrees()
}

/// Section curves at three scales, and the cones of rings.
pub(super) fn plot() -> String {
    let mut svg = Svg::new([960.0, 540.0]);
    for (row, (name, shape, colour)) in RULES.into_iter().enumerate() {
        let rings = lifted().rings(shape, RINGS);
        let [right, left] = section(&rings);
        let [Some(&end), Some(_)] = [right.last(), left.last()] else { continue };
        let above = 44.0 + 156.0 * row as f64;
        for (column, steps) in [0, 2, 4].into_iter().enumerate() {
            let scale = 0.25_f64.powi(steps);
            let panel = Panel {
                corner: [20.0 + 312.0 * column as f64, above],
                size: [296.0, 118.0],
                least: [-1.0, -0.56],
                most: [1.0, 0.24],
            };
            panel.axes(&mut svg, &[], &[]);
            for side in [&right, &left] {
                let inside = |p: &&Vec3| p.x.abs() <= scale;
                let places = side.iter().filter(inside).map(|p| [p.x / scale, (p.z - end.z) / scale]);
                svg.line(&panel.places(&places.collect::<Vec<_>>()), colour, 1.8);
            }
            let title = match steps {
                0 => format!("{name}, |x| below 1"),
                _ => format!("{name}, {} times as near", 4_u32.pow(steps as u32)),
            };
            svg.text([panel.corner[0] + 148.0, above - 8.0], Anchor::Middle, 13.0, &title);
        }
    }
    let (most, least) = (2.0, -1.0);
    let panel = Panel {
        corner: [70.0, 376.0],
        size: [870.0, 130.0],
        least: [0.0, least],
        most: [f64::from(RINGS - 1), most],
    };
    let numbers: Vec<f64> = (0..RINGS).map(f64::from).collect();
    panel.axes(&mut svg, &numbers, &[-1.0, 0.0, 1.0, 2.0]);
    for (name, shape, colour) in RULES {
        let rings = lifted().rings(shape, RINGS);
        let cones: Vec<[f64; 2]> =
            (0..).zip(&rings).map(|(k, ring)| [f64::from(k), cone(ring).log10().max(least)]).collect();
        svg.line(&panel.places(&cones), colour, 1.8);
        for &place in &panel.places(&cones) {
            svg.dot(place, 3.0, colour);
        }
        if let Some(&[x, y]) = cones.get(10) {
            let [x, y] = panel.place([x, y]);
            svg.text([x + 6.0, y - 8.0], Anchor::Start, 13.0, name);
        }
    }
    svg.text(
        [70.0, 364.0],
        Anchor::Start,
        13.0,
        "largest angle of a ring's normals to their mean: log10 of degrees, by ring",
    );
    svg.line(&[[20.0, 342.0], [940.0, 342.0]], INK, 0.4);
    svg.finish()
}

/// Normal cones of rings by both rules, for words.
pub(super) fn cones(ring: usize) -> [f64; 2] {
    RULES.map(|(_, shape, _)| cone(&lifted().rings(shape, ring as u32 + 1)[ring]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_bi_3_rule_closes_the_cone() {
        let [[early, slow], [late, closed]] = [cones(8), cones(12)].map(|[plain, lens]| [plain, lens]);
        assert!(late > 0.9 * early, "Catmull-Clark: {early} and {late} degrees");
        assert!(closed < 0.2 * slow, "bi-3: {slow} and {closed} degrees");
    }
}
