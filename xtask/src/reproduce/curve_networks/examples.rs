//! Networks to be shown: closed and open surfaces, two, three and six curves through a point, and what else a network may have.

use anyhow::{Context, Result};
use ogee::curve_network::{CurveNetwork, Embedding, NetworkCurve, NetworkOptions, PreSplit, embed};
use ogee::{ControlMesh, Topology, Vec3, VertexId};
use ogee_render::Image;

use super::body::{self, Body};
use super::convergence::figure;
use super::forms::stacked;
use super::picture::{Drawing, Shot, pair, polyhedron};
use super::polyhedron::{polyhedron as irregular, walks};

/// A network in a surface.
pub(super) struct Example {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    pub(super) embedding: Embedding,
    pub(super) shot: Shot,
}

/// Pixels of flat surfaces and of bodies.
const FLAT: [u32; 2] = [400, 250];
const SIZE: [u32; 2] = [400, 310];

const ABOVE: Vec3 = Vec3::new(0.45, -0.75, 0.62);

/// An open surface.
fn open() -> Shot {
    Shot { from: ABOVE, ball: None, stripes: (Vec3::new(1.0, 0.25, 0.2), 11.0), size: FLAT }
}

/// A body.
fn closed() -> Shot {
    Shot { from: Vec3::new(0.5, -0.7, 0.7), ball: None, stripes: (Vec3::new(0.3, 0.2, 1.0), 9.0), size: SIZE }
}

fn laid(body: &Body, mut curves: Vec<NetworkCurve>) -> Result<Embedding> {
    curves.iter_mut().enumerate().for_each(|(number, curve)| curve.name = format!("c{number}"));
    Ok(embed(&CurveNetwork { curves, ..CurveNetwork::default() }, &body.mesh)?)
}

/// Curves through one point of an open or closed surface.
pub(super) fn through_one_point() -> Result<Vec<Example>> {
    let n = 8;
    let sheet = body::sheet(n, body::flat_in_the_middle)?;
    let [across, along] = [0, 1].map(|k| -> Vec<u32> {
        (0..=n).map(|i| if k == 0 { body::of_sheet(n, i, 4) } else { body::of_sheet(n, 4, i) }).collect()
    });
    let middle = [body::of_sheet(n, 4, 4)];
    let two = laid(&sheet, vec![sheet.curve(&across, false, &middle), sheet.curve(&along, false, &middle)])?;
    let mut examples = vec![Example {
        name: "two-open",
        title: "Two curves through a point of an open sheet",
        embedding: two,
        shot: open(),
    }];
    for (ports, rings, name, title) in [
        (3, 6, "three-ends", "Three curves that end in one point of an open dome"),
        (6, 5, "three-open", "Three curves through a point of an open dome"),
        (12, 4, "six-open", "Six curves through a point of an open dome"),
    ] {
        let dome = body::dome(ports, rings)?;
        let curves = match ports {
            3 => (0..3).map(|j| dome.curve(&body::spoke(3, rings, j), false, &[0])).collect(),
            _ => (0..ports / 2)
                .map(|j| {
                    let back = body::spoke(ports, rings, j + ports / 2);
                    let there = body::spoke(ports, rings, j);
                    let path: Vec<u32> = back.into_iter().rev().chain(there.into_iter().skip(1)).collect();
                    dome.curve(&path, false, &[0])
                })
                .collect(),
        };
        examples.push(Example { name, title, embedding: laid(&dome, curves)?, shot: open() });
    }
    Ok(examples)
}

/// The same on closed surfaces.
pub(super) fn on_closed_surfaces() -> Result<Vec<Example>> {
    let (around, across) = (24, 16);
    let torus = body::torus(around, across)?;
    // On top, before the viewer.
    let (i, j) = (18, 4);
    let long: Vec<u32> = (0..around).map(|k| k * across + j).collect();
    let short: Vec<u32> = (0..across).map(|k| i * across + k).collect();
    let met = [i * across + j];
    let torus_curves = vec![torus.curve(&long, true, &met), torus.curve(&short, true, &met)];
    let mut examples = vec![Example {
        name: "two-closed",
        title: "Two closed curves through a point of a torus",
        embedding: laid(&torus, torus_curves)?,
        shot: Shot { from: Vec3::new(0.1, -0.75, 0.62), ..closed() },
    }];
    for (curves, parallels, name, title) in [
        (3, 9, "three-closed", "Three closed curves through both poles of a flattened ball"),
        (6, 9, "six-closed", "Six closed curves through both poles of a flattened ball"),
    ] {
        let meridians = 4 * curves;
        let globe = body::globe(meridians, parallels)?;
        let poles = [meridians * parallels, meridians * parallels + 1];
        let step = 2;
        let laid_curves = (0..curves)
            .map(|k| globe.curve(&body::great_circle(meridians, parallels, k * step), true, &poles));
        let embedding = laid(&globe, laid_curves.collect())?;
        examples.push(Example { name, title, embedding, shot: closed() });
    }
    let n = 6;
    let (rounded, belts) = body::rounded_box(n)?;
    let met: Vec<u32> = belts[0]
        .iter()
        .chain(&belts[1])
        .copied()
        .filter(|v| belts.iter().filter(|belt| belt.contains(v)).count() > 1)
        .collect();
    examples.push(Example {
        name: "box",
        title: "Three belts of a rounded box, which meet in the middle of each side",
        embedding: laid(&rounded, belts.iter().map(|belt| rounded.curve(belt, true, &met)).collect())?,
        shot: closed(),
    });
    Ok(examples)
}

/// Tangents that lie in no plane, two meeting points, and an end inside.
pub(super) fn other_networks() -> Result<Vec<Example>> {
    let mut examples = Vec::new();
    let dome = body::dome(3, 6)?;
    let curve = |j: u32| {
        let mut curve = dome.curve(&body::spoke(3, 6, j), false, &[0]);
        let control = curve.control.get_or_insert_default();
        // All legs go down from a point above the dome.
        control[0].z += 0.06;
        curve
    };
    examples.push(Example {
        name: "not-planar",
        title: "Three curves whose tangents lie in no plane: the surface has a point there, and a warning says so",
        embedding: laid(&dome, (0..3).map(curve).collect())?,
        shot: open(),
    });

    let n = 10;
    let sheet = body::sheet(n, body::flat_twice)?;
    let at = |i: u32, j: u32| body::of_sheet(n, i, j);
    let met = [at(3, 5), at(7, 5)];
    let column = |i: u32| -> Vec<u32> { (0..=n).map(|j| at(i, j)).collect() };
    let row = |from: u32, to: u32| -> Vec<u32> { (from..=to).map(|i| at(i, 5)).collect() };
    let on_sheet = |path: &Vec<u32>| sheet.curve(path, false, &met);
    let apart = [column(3), column(7), row(0, 3), row(7, 10)];
    let joined = [column(3), column(7), row(0, 10)];
    for (name, title, paths) in [
        ("two-points", "Two meeting points of three curves each on one sheet", &apart[..]),
        ("two-points-joined", "The same, joined by a curve", &joined[..]),
    ] {
        let embedding = laid(&sheet, paths.iter().map(on_sheet).collect())?;
        examples.push(Example { name, title, embedding, shot: open() });
    }

    let path: Vec<u32> = (0..=7).map(|i| at(i, 5)).collect();
    let wavy = |i: u32| {
        let x = f64::from(i) - 5.0;
        body::on_sheet(5.0, body::flat_twice, x, 0.7 * (0.9 * (x + 5.0)).sin())
    };
    let points: Vec<Vec3> = (0..=7).map(wavy).collect();
    let curve = sheet.curve_through(&path, &points, false, &[at(7, 5)]);
    examples.push(Example {
        name: "dangling",
        title: "A curve that ends inside the surface",
        embedding: laid(&sheet, vec![curve])?,
        shot: open(),
    });
    Ok(examples)
}

/// A network on an irregular polyhedron: the polyhedron, the repaired cage, the surface and its lines.
pub(super) fn repair() -> Result<(Image, Embedding, ControlMesh)> {
    let mesh = irregular(50, 14);
    let body = Body::new(mesh.clone())?;
    let from = Vec3::new(0.5, -0.75, 0.55);
    let topology = Topology::new(&mesh)?;
    let six = (0..mesh.points.len() as u32).filter(|&v| topology.valence(VertexId(v)).edges() == 6);
    let front = six.max_by(|&a, &b| {
        let toward = |v: u32| from.dot(mesh.points[v as usize]);
        toward(a).total_cmp(&toward(b))
    });
    let front = front.context("some vertex has six edges")?;
    let paths = walks(&mesh, front, 2, 3)?;
    let curve = |(number, path): (usize, &Vec<u32>)| {
        let mut curve = body.curve(path, false, &[front]);
        curve.name = format!("c{number}");
        curve
    };
    let options =
        NetworkOptions { flatten: true, pre_split: PreSplit::Fixed(2), ..NetworkOptions::default() };
    let curves = paths.iter().enumerate().map(curve).collect();
    let embedding = embed(&CurveNetwork { curves, options, ..CurveNetwork::default() }, &mesh)?;
    let shot = Shot { from, ..closed() };
    let laid: Vec<Vec<u32>> = embedding.segments.iter().map(|segment| segment.vertices.clone()).collect();
    let before = polyhedron(&mesh, &Drawing::of_paths(&mesh, &paths), &shot)?;
    let after = polyhedron(&embedding.mesh, &Drawing::of_paths(&embedding.mesh, &laid), &shot)?;
    let surface = pair(&embedding.mesh, &Drawing::of(&embedding), &shot)?;
    Ok((stacked(&[before.beside(&after), surface]), embedding, mesh))
}

/// What was measured on a surface, in words.
pub(super) fn figures(embedding: &Embedding) -> Result<String> {
    let figures = embedding.measure().context("the cage is sound")?;
    let off = figures.errors.iter().copied().fold(0.0, f64::max) / embedding.mesh.size();
    let mut words = format!("Curves off by at most {off:.0e} of the size.");
    let mut kinds: Vec<(usize, f64, usize, f64)> = Vec::new();
    for (x, meeting) in embedding.x_configurations.iter().zip(&figures.meetings) {
        let (ports, t) = (x.ring.len() / 2, x.parameter);
        let spread = meeting.normal_spread_deg.context("normals exist")?;
        match kinds.iter_mut().find(|kind| kind.0 == ports && kind.1 == t) {
            Some(kind) => (kind.2, kind.3) = (kind.2 + 1, kind.3.max(spread)),
            None => kinds.push((ports, t, 1, spread)),
        }
    }
    for (ports, t, count, spread) in kinds {
        let points = if count == 1 { "One point".to_owned() } else { format!("{count} points") };
        words += &format!(
            " {points} of {ports} ports, t = {t:.4}, normals 1/256 of a face away within {} degrees.",
            figure(spread)
        );
    }
    let mut warned: Vec<String> = Vec::new();
    for warning in &embedding.warnings {
        let angle = warning.value().map_or(String::new(), |value| format!(" ({value:.2})"));
        warned.push(format!("`{}`{angle}", warning.code()));
    }
    if !warned.is_empty() {
        words += &format!(" Told: {}.", warned.join(", "));
    }
    Ok(words)
}
