//! Curves without a cage get one: its loops are found, filled and look outward, and the surface contains the curves.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use networks::along;
use ogee::curve_network::{BareNetwork, CurveNetwork, NetworkCurve, NetworkOptions, Skin, embed, skin};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Topology, Vec3, shapes};
use std::f64::consts::TAU;

fn curve(vertices: &[u32]) -> NetworkCurve {
    NetworkCurve { name: format!("{vertices:?}"), vertices: vertices.to_vec(), ..NetworkCurve::default() }
}

fn closed(vertices: &[u32]) -> NetworkCurve {
    NetworkCurve { closed: true, ..curve(vertices) }
}

fn volume(mesh: &ControlMesh) -> f64 {
    let fan = |face: &[u32]| {
        let p = |i: usize| mesh.points[face[i] as usize];
        (1..face.len() - 1).map(|i| p(0).dot(p(i).cross(p(i + 1)))).sum::<f64>()
    };
    mesh.faces.iter().map(fan).sum::<f64>() / 6.0
}

/// The cage is a surface with this Euler number and so many border edges, and contains the curves, fair or not.
fn check(name: &str, network: &BareNetwork, euler: i64, border: usize) -> Skin {
    let made = skin(network).unwrap();
    let topology = Topology::new(&made.mesh).unwrap();
    let used: std::collections::BTreeSet<u32> = made.mesh.faces.corners().iter().copied().collect();
    let found = used.len() as i64 - topology.edge_count() as i64 + topology.face_count() as i64;
    assert_eq!(found, euler, "{name}: Euler number");
    let open = topology.edge_halfedges().filter(|&h| topology.twin(h).is_none()).count();
    assert_eq!(open, border, "{name}: border edges");
    for fair in [false, true] {
        let options = NetworkOptions { fair, ..NetworkOptions::default() };
        let laid = CurveNetwork { curves: made.curves.clone(), options, ..CurveNetwork::default() };
        let embedding = embed(&laid, &made.mesh).unwrap();
        let level = Level::new(&embedding.mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &embedding.mesh.points);
        for segment in &embedding.segments {
            let path = &segment.vertices;
            for k in 0..segment.target.spans() {
                for t in [0.0, 0.02, 0.5, 0.77] {
                    let at = along(&level, &table, [path[k], path[(k + 1) % path.len()]], t);
                    let off = surface.eval(at).position.distance(segment.target.point(k as f64 + t));
                    assert!(off < 1e-12 * made.mesh.size(), "{name}, fair {fair}: {off:e}");
                }
            }
        }
    }
    made
}

fn cube() -> BareNetwork {
    let pairs =
        [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];
    let curves = pairs.iter().map(|pair| curve(pair)).collect();
    BareNetwork { points: shapes::cube().points, curves, loops: vec![] }
}

#[test]
fn the_edges_of_a_cube_make_a_cube() {
    let made = check("cube", &cube(), 2, 0);
    assert_eq!((made.mesh.faces.len(), made.mesh.points.len()), (6, 8));
    assert!((volume(&made.mesh) - 8.0).abs() < 1e-12);
    // Inside out, or with other numbers, it is the same cube.
    let mut turned = cube();
    turned.points.iter_mut().for_each(|p| *p = Vec3::new(-p.x, p.y, p.z));
    assert!((volume(&skin(&turned).unwrap().mesh) - 8.0).abs() < 1e-12);
}

#[test]
fn tetrahedra_and_octahedra_are_closed_and_look_outward() {
    let points = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let curves = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]].iter().map(|pair| curve(pair)).collect();
    let network = BareNetwork { points: points.map(Vec3::from).to_vec(), curves, loops: vec![] };
    let made = check("tetrahedron", &network, 2, 0);
    assert_eq!(made.mesh.faces.len(), 12);
    assert!(volume(&made.mesh) > 1.0);
    let points = networks::octahedron().points;
    let curves = vec![closed(&[0, 1, 2, 3]), closed(&[0, 4, 2, 5]), closed(&[1, 4, 3, 5])];
    let made = check("octahedron", &BareNetwork { points, curves, loops: vec![] }, 2, 0);
    assert_eq!(made.mesh.faces.len(), 24);
    assert!(volume(&made.mesh) > 1.0);
}

/// Stations and waterlines of half a hull: curves across and along, all of them bent.
fn hull(stations: u32, lines: u32, legs: u32) -> BareNetwork {
    let (columns, rows) = (stations * legs + 1, lines * legs + 1);
    let at = |i: u32, j: u32| j * columns + i;
    let points = (0..rows).flat_map(|j| {
        (0..columns).map(move |i| {
            let (u, v) = (f64::from(i) / f64::from(columns - 1), f64::from(j) / f64::from(rows - 1));
            Vec3::new(6.0 * u, 1.5 * (TAU * u / 2.0).sin() * (0.3 + v.sqrt()), 2.0 * v)
        })
    });
    let across = (0..=stations).map(|k| curve(&(0..rows).map(|j| at(k * legs, j)).collect::<Vec<u32>>()));
    let along = (0..=lines).map(|k| curve(&(0..columns).map(|i| at(i, k * legs)).collect::<Vec<u32>>()));
    BareNetwork { points: points.collect(), curves: across.chain(along).collect(), loops: vec![] }
}

#[test]
fn hulls_are_open_sheets() {
    let network = hull(4, 3, 3);
    let made = check("hull", &network, 1, 2 * (12 + 9));
    assert_eq!(made.mesh.faces.len(), 12 * 9);
    assert_eq!(
        made.curves.iter().map(|curve| &curve.vertices).collect::<Vec<_>>(),
        network.curves.iter().map(|curve| &curve.vertices).collect::<Vec<_>>()
    );
}

#[test]
fn legs_are_halved_where_opposite_sides_differ() {
    // One long side of a square has two legs.
    let points = [[0.0, 0.0], [1.0, -0.1], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
        .map(|[x, y]| Vec3::new(x, y, 0.1 * x * y));
    let curves = vec![curve(&[0, 1, 2]), curve(&[2, 3]), curve(&[3, 4]), curve(&[4, 0])];
    let made = check(
        "square",
        &BareNetwork { points: points.to_vec(), curves: curves.clone(), loops: vec![] },
        1,
        6,
    );
    assert_eq!((made.mesh.faces.len(), made.curves[2].vertices.len()), (2, 3));
    // Two and three legs have no common number: a ring and a polygon.
    let mut points = points.to_vec();
    points.extend([Vec3::new(1.4, 2.2, 0.2), Vec3::new(0.7, 2.1, 0.3)]);
    let curves = vec![curve(&[0, 1, 2]), curve(&[2, 3]), curve(&[3, 5, 6, 4]), curve(&[4, 0])];
    let made = check("trapezium", &BareNetwork { points, curves, loops: vec![] }, 1, 7);
    assert_eq!(made.mesh.faces.len(), 8);
}

#[test]
fn loops_of_any_number_of_sides_are_filled() {
    for sides in [2_u32, 3, 5, 6] {
        let count = 4 * sides;
        let points = (0..count)
            .map(|i| TAU * f64::from(i) / f64::from(count))
            .map(|a| Vec3::new(2.0 * a.cos(), 1.5 * a.sin(), 0.3 * (2.0 * a).sin()));
        let curves = (0..sides).map(|k| curve(&(0..=4).map(|i| (4 * k + i) % count).collect::<Vec<u32>>()));
        let network = BareNetwork { points: points.collect(), curves: curves.collect(), loops: vec![] };
        let made = check(&format!("{sides} sides"), &network, 1, count as usize);
        assert!(made.mesh.faces.iter().all(|face| face.len() == 4));
        let turn = |face: &[u32]| {
            let p = |i: usize| made.mesh.points[face[i] as usize];
            (p(2) - p(0)).cross(p(3) - p(1)).z
        };
        assert!(made.mesh.faces.iter().all(|face| turn(face) > 0.0), "all look up");
    }
}

#[test]
fn boxes_without_a_lid_are_given_by_their_loops() {
    // Its rim is one curve, on which four others end.
    let mut open = cube();
    let on_rim = |curve: &NetworkCurve| curve.vertices.iter().all(|&v| v >= 4);
    open.curves.retain(|curve| !on_rim(curve));
    open.curves.push(closed(&[4, 5, 7, 6]));
    open.loops =
        vec![vec![0, 2, 3, 1], vec![0, 1, 5, 4], vec![2, 6, 7, 3], vec![0, 4, 6, 2], vec![1, 3, 7, 5]];
    let made = check("box", &open, 1, 4);
    assert_eq!(made.mesh.faces.len(), 5);
    let code = |network: &BareNetwork| skin(network).unwrap_err().code();
    let mut twisted = open.clone();
    twisted.loops[1].reverse();
    assert_eq!(code(&twisted), "E_LOOP_TWICE");
    open.loops[0] = vec![0, 3, 2, 1];
    assert_eq!(code(&open), "E_LOOP_BROKEN");
}

#[test]
fn what_cannot_be_skinned_is_named() {
    let refused = |network: &BareNetwork| skin(network).unwrap_err();
    let mut dangling = cube();
    dangling.curves.pop();
    let last = dangling.points.len() as u32;
    dangling.points.push(Vec3::new(3.0, 3.0, 3.0));
    dangling.curves.push(curve(&[3, 7]));
    dangling.curves.push(curve(&[7, last]));
    let error = refused(&dangling);
    assert_eq!(error.code(), "E_CURVE_ALONE");
    assert!(error.to_string().contains(&format!("vertex {last}")), "{error}");
    // A circle on its own.
    let points = (0..8).map(|i| TAU * f64::from(i) / 8.0).map(|a| Vec3::new(a.cos(), a.sin(), 0.0)).collect();
    let circle = BareNetwork { points, curves: vec![closed(&[0, 1, 2, 3, 4, 5, 6, 7])], loops: vec![] };
    assert_eq!(refused(&circle).code(), "E_CURVE_ALONE");
    // Two curves that leave a point in one direction.
    let mut twice = cube();
    twice.points.extend([Vec3::new(0.0, -1.0, -1.0), Vec3::new(-0.2, 1.0, -1.0)]);
    twice.curves.push(curve(&[0, 8, 9, 3]));
    twice.curves[0] = curve(&[0, 1]);
    assert_eq!(refused(&twice).code(), "E_LOOP_AMBIGUOUS");
    // A saddle as steep as it is wide.
    let mut saddle = BareNetwork { points: vec![Vec3::ZERO], ..BareNetwork::default() };
    for k in 0..8_u32 {
        let a = TAU * f64::from(k) / 8.0;
        saddle.points.push(Vec3::new(a.cos(), a.sin(), 1.2 * (2.0 * a).cos()));
        saddle.curves.push(curve(&[k + 1, (k + 1) % 8 + 1]));
    }
    saddle.curves.extend([1, 3, 5, 7].map(|v| curve(&[0, v])));
    let error = refused(&saddle);
    assert!(error.to_string().contains("at vertex 0 "), "{error}");
    let mut bad = cube();
    bad.curves[0].vertices = vec![0, 99];
    assert_eq!(refused(&bad).code(), "E_POINT_VERTEX");
    assert_eq!(refused(&BareNetwork::default()).code(), "E_NO_CURVES");
    let mut apart = cube();
    apart.curves[0].control = Some(vec![Vec3::ZERO, Vec3::new(1.0, -1.0, -1.0)]);
    assert_eq!(refused(&apart).code(), "E_MEETING_POINT_MISMATCH");
}

#[test]
fn random_wireframes_are_closed() {
    // Edges of cages as curves of several legs, bent.
    for seed in 0..12_u32 {
        let cage = match seed % 3 {
            0 => shapes::cube(),
            1 => shapes::torus(10, 9),
            _ => networks::octahedron(),
        };
        let topology = Topology::new(&cage).unwrap();
        let mut points: Vec<Vec3> = cage.points.clone();
        let legs = 2 << (seed % 2);
        let mut curves = Vec::new();
        for h in topology.edge_halfedges() {
            let [a, b] = [topology.origin(h), topology.target(h)];
            let mut path = vec![a.0];
            for k in 1..legs {
                let s = f64::from(k) / f64::from(legs);
                let wobble = 0.04
                    * Vec3::new(
                        f64::from(seed + 7 * a.0 + k).sin(),
                        f64::from(seed + 5 * b.0 + k).cos(),
                        f64::from(3 * seed + a.0 + b.0).sin(),
                    );
                path.push(points.len() as u32);
                points.push(cage.points[a.index()].lerp(cage.points[b.index()], s) + wobble);
            }
            path.push(b.0);
            curves.push(curve(&path));
        }
        let euler = if seed % 3 == 1 { 0 } else { 2 };
        let made = skin(&BareNetwork { points, curves, loops: vec![] }).unwrap();
        let topology = Topology::new(&made.mesh).unwrap();
        let found =
            topology.vertex_count() as i64 - topology.edge_count() as i64 + topology.face_count() as i64;
        assert_eq!(found, euler, "seed {seed}");
        assert!(volume(&made.mesh) > 0.0, "seed {seed}");
        assert!(topology.edge_halfedges().all(|h| topology.twin(h).is_some()), "seed {seed}");
    }
}
