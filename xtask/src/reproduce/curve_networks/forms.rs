//! The papers' own forms beside the one that is used unless another is asked for, on the same five curves.

use std::f64::consts::TAU;

use anyhow::{Context, Result};
use ogee::Vec3;
use ogee::curve_network::{CurveNetwork, NetworkOptions, Placing, default_parameter, embed};
use ogee_render::Image;

use super::body::{dome, on_dome, spoke};
use super::convergence::figure;
use super::picture::{Drawing, Shot, mirror};
use super::settling::spreads;
use crate::bench::report::Table;

/// Pixels between pictures.
const GAP: u32 = 8;

const PORTS: u32 = 5;
const RINGS: u32 = 5;

/// Rings of faces, by level, whose normals the table has.
const LEVELS: [u32; 3] = [4, 8, 12];

/// Five curves on a dome that leave its middle at uneven angles and reach its rim at even ones.
fn network(options: NetworkOptions) -> Result<(ogee::ControlMesh, CurveNetwork)> {
    let body = dome(PORTS, RINGS)?;
    let turns = [0.0, 0.05, -0.045, 0.04, -0.05];
    let lengths = [1.0, 1.25, 0.8, 1.15, 0.9];
    let curve = |j: u32| {
        let vertices = spoke(PORTS, RINGS, j);
        let point = |a: u32| {
            let part = f64::from(a) / f64::from(RINGS);
            let angle = TAU * (f64::from(j) / f64::from(PORTS) + turns[j as usize] * (1.0 - part));
            let stretch = 1.0 + (lengths[j as usize] - 1.0) * (1.0 - part);
            on_dome(part * stretch, if a == 0 { 0.0 } else { angle })
        };
        let points: Vec<Vec3> = (0..=RINGS).map(point).collect();
        let mut curve = body.curve_through(&vertices, &points, false, &[0]);
        curve.name = format!("c{j}");
        curve
    };
    let curves = (0..PORTS).map(curve).collect();
    Ok((body.mesh.clone(), CurveNetwork { curves, options, ..CurveNetwork::default() }))
}

/// All forms: a picture of what each mirrors around the meeting point, and their figures.
pub(super) fn compared() -> Result<(Image, Table)> {
    let star = default_parameter(PORTS as usize);
    let placed = |placing, t| NetworkOptions { placing, parameter: t, ..NetworkOptions::default() };
    let forms = [
        ("2004: symmetric, t = 0.1".to_owned(), NetworkOptions::abbas_nasri_2004(0.1)),
        ("2004: symmetric, t = 0.25".to_owned(), NetworkOptions::abbas_nasri_2004(0.25)),
        ("2004: symmetric, t = 0.45".to_owned(), NetworkOptions::abbas_nasri_2004(0.45)),
        ("generalised: t = 1/2".to_owned(), NetworkOptions::generalised()),
        (format!("parallelograms, t = {star:.3}"), placed(Placing::Parallelogram, Some(star))),
        ("the mesh's own ring, t found".to_owned(), placed(Placing::Keep, None)),
        ("eigen ring, t = 1/2".to_owned(), placed(Placing::Eigen, Some(0.5))),
        ("eigen ring, t found".to_owned(), NetworkOptions::default()),
    ];
    let mut table = Table::new(&["form", "t", "curve off by", "level 4", "level 8", "level 12", "told"]);
    let mut panels = Vec::new();
    for (name, options) in forms {
        let (mesh, network) = network(options)?;
        let embedding = embed(&network, &mesh)?;
        let shot = Shot {
            from: Vec3::new(0.35, -0.75, 0.75),
            ball: Some((embedding.mesh.points[0], 0.34)),
            stripes: (Vec3::new(1.0, 0.25, 0.2), 15.0),
            size: [396, 300],
        };
        let mut panel = mirror(&embedding.mesh, &Drawing::of(&embedding), &shot)?;
        panel.add_caption(&name);
        panels.push(panel);
        let figures = embedding.measure().context("the cage is sound")?;
        let spread = spreads(&embedding.mesh, 0, &LEVELS, None);
        let spread = |k: usize| spread.as_ref().map_or("no normals".to_owned(), |spread| figure(spread[k]));
        let mut told: Vec<&str> = embedding.warnings.iter().map(|warning| warning.code()).collect();
        told.dedup();
        let off = figures.errors.iter().copied().fold(0.0, f64::max);
        let t = embedding.x_configurations.iter().find(|x| x.center == 0).context("curves meet")?.parameter;
        table.row(&[
            name,
            format!("{t:.4}"),
            format!("{off:.0e}"),
            spread(0),
            spread(1),
            spread(2),
            told.join(", "),
        ]);
    }
    let [width, height] = panels[0].size;
    let white = |size: [u32; 2]| Image::filled(size, [255; 4]);
    let mut rows = Vec::new();
    for row in panels.chunks_exact(2) {
        rows.push(row[0].beside(&white([GAP, height])).beside(&row[1]));
        rows.push(white([2 * width + GAP, GAP]));
    }
    rows.pop();
    Ok((stacked(&rows), table))
}

/// Pictures of the same width, one below the other.
pub(super) fn stacked(rows: &[Image]) -> Image {
    let [width, _] = rows.first().map_or([0, 0], |row| row.size);
    let height = rows.iter().map(|row| row.size[1]).sum();
    Image { size: [width, height], pixels: rows.iter().flat_map(|row| &row.pixels).copied().collect() }
}
