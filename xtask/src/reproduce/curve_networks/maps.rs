//! Characteristic maps: the surface of a planar configuration near its meeting point, where all rings are alike.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use ogee::curve_network::{CurveNetwork, Embedding, NetworkCurve, default_parameter, embed};
use ogee::{Derivatives, Level, LimitSurface, Location, PatchTable, Vec3, shapes};

use super::settling::slices;
use crate::reproduce::plot::{Anchor, COLOURS, INK, Panel, Svg};

/// How near to the meeting point: far enough in for one ring to be like the next.
const NEAR: f64 = 1.0 / 4096.0;

/// Lines across a slice, and steps along them.
const LINES: usize = 6;
const STEPS: usize = 7;

/// Curves from the middle of a flat disk to its rim with these first legs, and later `bend`s of them.
pub(super) fn star(legs: &[Vec3], bend: f64) -> (ogee::ControlMesh, CurveNetwork) {
    let rings = 4;
    let ports = legs.len() as u32;
    let mut mesh = shapes::disk(ports, rings);
    mesh.points.iter_mut().for_each(|p| p.z = 0.0);
    let curve = |(j, &leg): (u32, &Vec3)| {
        let off = |k: f64| {
            let a = f64::from(j);
            bend * Vec3::new((a + k).sin(), (2.0 * a + k).cos(), 2.0 * (1.7 * a + k).sin())
        };
        let control = vec![Vec3::ZERO, leg, 2.0 * leg + off(1.0), 3.0 * leg + off(2.0), 4.0 * leg + off(3.0)];
        let vertices = super::body::spoke(ports, rings, j);
        NetworkCurve { name: format!("c{j}"), vertices, control: Some(control), ..NetworkCurve::default() }
    };
    let curves = (0..).zip(legs).map(curve).collect();
    (mesh, CurveNetwork { curves, ..CurveNetwork::default() })
}

/// Legs of length 1 at equal angles.
pub(super) fn even(count: usize) -> Vec<Vec3> {
    (0..count)
        .map(|j| TAU * j as f64 / count as f64)
        .map(|angle| Vec3::new(angle.cos(), angle.sin(), 0.0))
        .collect()
}

/// Legs at uneven angles, of uneven lengths.
pub(super) fn uneven(count: usize) -> Vec<Vec3> {
    (0..count)
        .map(|j| {
            let j = j as f64;
            let angle = TAU * (j + 0.15 * (2.3 * j).sin()) / count as f64;
            (1.0 + 0.3 * (1.9 * j + 1.0).sin()) * Vec3::new(angle.cos(), angle.sin(), 0.0)
        })
        .collect()
}

/// Places along a side of a slice where the Jacobian is looked at.
const FINE: usize = 24;

/// What a line of a map is.
#[derive(Clone, Copy, PartialEq)]
enum Line {
    Port,
    FreeSpoke,
    Inside,
}

/// A map, seen.
struct Map {
    /// Points along lines of equal parameters.
    lines: Vec<(Line, Vec<[f64; 2]>)>,
    /// The smallest Jacobian, of the mean of all.
    least: f64,
    t: f64,
}

fn map(legs: &[Vec3], t: Option<f64>) -> Result<Map> {
    let (mesh, mut network) = star(legs, 0.0);
    network.options.parameter = t;
    let embedding = embed(&network, &mesh)?;
    seen(&embedding).context("the disk has quads around its middle")
}

fn seen(embedding: &Embedding) -> Option<Map> {
    let level = Level::new(&embedding.mesh).ok()?;
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &embedding.mesh.points);
    let slices = slices(level.topology(), 0);
    let middle = embedding.mesh.points[0];
    let at = |i: usize, count: usize| i as f64 / count as f64;
    let mut lines = Vec::new();
    let mut jacobians = Vec::new();
    let ring = &embedding.x_configurations.iter().find(|x| x.center == 0)?.ring;
    for slice in &slices {
        let begins_at_port = ring.iter().step_by(2).any(|&port| port == slice.first);
        let locate = |[s, t]: [f64; 2]| slice.locate(&table, [s * NEAR, t * NEAR]);
        for along in 0..2 {
            for line in 0..=LINES {
                let places: Option<Vec<Location>> = (0..=STEPS)
                    .map(|i| {
                        let (x, y) = (at(i, STEPS), at(line, LINES));
                        locate(if along == 0 { [x, y] } else { [y, x] })
                    })
                    .collect();
                let points = surface.eval_batch(&places?, Derivatives::None).position;
                let flat = |p: &Vec3| [(p.x - middle.x) / NEAR, (p.y - middle.y) / NEAR];
                let kind = match (line, (along == 0) == begins_at_port) {
                    (0, true) => Line::Port,
                    (0, false) => Line::FreeSpoke,
                    _ => Line::Inside,
                };
                lines.push((kind, points.iter().map(flat).collect()));
            }
        }
        // The outer half: what is further in is like it.
        let outer = (0..=FINE).flat_map(|i| (0..=FINE).map(move |j| [at(i, FINE), at(j, FINE)]));
        let places: Option<Vec<Location>> = outer.filter(|[s, t]| s.max(*t) >= 0.5).map(locate).collect();
        let samples = surface.eval_batch(&places?, Derivatives::First);
        jacobians.extend(samples.du.iter().zip(&samples.dv).map(|(du, dv)| du.cross(*dv).z));
    }
    let mean = jacobians.iter().sum::<f64>() / jacobians.len() as f64;
    let least = jacobians.iter().fold(f64::INFINITY, |a, b| a.min(*b)) / mean;
    let t = embedding.x_configurations.iter().find(|x| x.center == 0)?.parameter;
    Some(Map { lines, least, t })
}

fn draw(svg: &mut Svg, map: &Map, corner: [f64; 2], side: f64) {
    let reach = map
        .lines
        .iter()
        .flat_map(|(_, line)| line)
        .fold(0.0_f64, |most, [x, y]| most.max(x.abs()).max(y.abs()));
    let panel = Panel { corner, size: [side; 2], least: [-reach; 2], most: [reach; 2] };
    for (kind, colour, width) in
        [(Line::Inside, COLOURS[0], 0.7), (Line::FreeSpoke, INK, 1.3), (Line::Port, COLOURS[1], 2.4)]
    {
        for (_, line) in map.lines.iter().filter(|line| line.0 == kind) {
            svg.line(&panel.places(line), colour, width);
        }
    }
}

/// Maps of even legs: a row for each number of ports, a column for each `t`.
pub(super) fn plot() -> Result<String> {
    let (side, gap) = (190.0, 26.0);
    let all = [3, 4, 5, 6];
    let mut svg = Svg::new([80.0 + 4.0 * (side + gap), 56.0 + 4.0 * (side + 44.0)]);
    for (row, ports) in all.into_iter().enumerate() {
        let above = 44.0 + row as f64 * (side + 44.0);
        svg.text([12.0, above + side / 2.0], Anchor::Start, 15.0, &format!("M = {ports}"));
        for (column, t) in [0.05, default_parameter(ports), 0.45, 0.5].into_iter().enumerate() {
            let map = map(&even(ports), Some(t))?;
            let left = 80.0 + column as f64 * (side + gap);
            draw(&mut svg, &map, [left, above], side);
            let words = format!("t = {t:.4}, least Jacobian {:.3}", tidy(map.least));
            svg.text([left + side / 2.0, above + side + 18.0], Anchor::Middle, 12.0, &words);
        }
    }
    svg.line(&[[80.0, 20.0], [110.0, 20.0]], COLOURS[1], 2.4);
    svg.text([116.0, 24.0], Anchor::Start, 13.0, "ports");
    svg.line(&[[170.0, 20.0], [200.0, 20.0]], INK, 1.3);
    svg.text([206.0, 24.0], Anchor::Start, 13.0, "free spokes");
    svg.line(&[[296.0, 20.0], [326.0, 20.0]], COLOURS[0], 0.8);
    svg.text([332.0, 24.0], Anchor::Start, 13.0, "equal parameters, sixths of a slice");
    Ok(svg.finish())
}

/// Without a sign where there is nothing.
fn tidy(x: f64) -> f64 {
    if x.abs() < 5e-4 { 0.0 } else { x }
}

/// Uneven legs at `t = 1/2` and at the `t` that the search finds; and both least Jacobians with that `t`.
pub(super) fn plot_of_fold(legs: &[Vec3]) -> Result<(String, [f64; 3])> {
    let side = 330.0;
    let mut svg = Svg::new([2.0 * side + 70.0, side + 60.0]);
    let (half, found) = (map(legs, Some(0.5))?, map(legs, None)?);
    for (column, map) in [&half, &found].into_iter().enumerate() {
        let left = 20.0 + column as f64 * (side + 30.0);
        draw(&mut svg, map, [left, 20.0], side);
        let words = format!("t = {:.4}, least Jacobian {:.3}", map.t, tidy(map.least));
        svg.text([left + side / 2.0, side + 46.0], Anchor::Middle, 14.0, &words);
    }
    Ok((svg.finish(), [half.least, found.least, found.t]))
}
