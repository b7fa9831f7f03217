//! Where curves meet, the surface has a tangent plane if the curves have one, and normals settle as fast as the eigenvalues
//! say; where they have none, it has none either, and warnings say so. Deep levels are looked at through the surroundings of
//! one vertex, refined and cut out again.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use networks::{cages, octahedron, surface_error, walks};
use ogee::curve_network::{
    Crossing, CurveNetwork, Embedding, NetworkCurve, NetworkOptions, TargetCurve, XMatrix, XRing,
    control_point, default_parameter, embed,
};
use ogee::{ControlMesh, FaceList, Level, Meeting, Topology, Vec3, VertexId, shapes};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

const UP: Vec3 = Vec3::new(0.0, 0.0, 1.0);

/// The faces within so many rings around a vertex, which gets number 0, and what meets there.
fn cut_out(
    topology: &Topology,
    points: &[Vec3],
    center: u32,
    ports: &[u32],
    t: f64,
    rings: usize,
) -> ControlMesh {
    let mut vertices = vec![VertexId(center)];
    let mut faces = BTreeSet::new();
    let mut seen = BTreeSet::from([VertexId(center)]);
    let mut next = 0;
    for _ in 0..rings {
        for &v in &vertices[next..] {
            faces.extend(topology.ring(v).map(|h| topology.face(h)));
        }
        next = vertices.len();
        for &f in &faces {
            for v in topology.halfedges(f).map(|h| topology.origin(h)) {
                if seen.insert(v) {
                    vertices.push(v);
                }
            }
        }
    }
    let own: BTreeMap<VertexId, u32> = vertices.iter().zip(0..).map(|(&v, i)| (v, i)).collect();
    let mut list = FaceList::new();
    for &f in &faces {
        list.push(&topology.halfedges(f).map(|h| own[&topology.origin(h)]).collect::<Vec<u32>>());
    }
    let mut mesh = ControlMesh::new(vertices.iter().map(|v| points[v.index()]).collect(), list);
    if !ports.is_empty() {
        let ports = ports.iter().map(|&v| own[&VertexId(v)]).collect();
        mesh.meetings.push(Meeting { vertex: 0, ports, t });
    }
    mesh
}

/// Three rings around a vertex of a cage.
fn surroundings(mesh: &ControlMesh, center: u32) -> ControlMesh {
    let (ports, t) = match mesh.meetings.iter().find(|meeting| meeting.vertex == center) {
        Some(meeting) => (meeting.ports.clone(), meeting.t),
        None => (Vec::new(), 0.0),
    };
    cut_out(&Topology::new(mesh).unwrap(), &mesh.points, center, &ports, t, 3)
}

/// The same three rings a level further down. What lies beyond has no part in them.
fn deeper(mesh: &ControlMesh) -> ControlMesh {
    let level = Level::new(mesh).unwrap();
    let topology = level.topology();
    let first_edge_point = (topology.vertex_count() + topology.face_count()) as u32;
    let ports = mesh.meetings.first().map(|meeting| meeting.ports.clone()).unwrap_or_default();
    let edge_point = |port: &u32| {
        let h = topology.ring(VertexId(0)).find(|&h| topology.target(h).0 == *port).unwrap();
        first_edge_point + topology.edge(h).0
    };
    let ports: Vec<u32> = ports.iter().map(edge_point).collect();
    let t = mesh.meetings.first().map_or(0.0, |meeting| meeting.t);
    let (finer, points) = level.refine_points(&mesh.points);
    cut_out(finer.topology(), &points, 0, &ports, t, 3)
}

fn at_level(mesh: &ControlMesh, levels: u32) -> ControlMesh {
    (0..levels).fold(mesh.clone(), |mesh, _| deeper(&mesh))
}

/// Unit normals of the faces in the first two rings around vertex 0.
fn normals(mesh: &ControlMesh) -> Vec<Vec3> {
    let topology = Topology::new(mesh).unwrap();
    let near: BTreeSet<VertexId> = topology
        .ring(VertexId(0))
        .flat_map(|h| topology.halfedges(topology.face(h)))
        .map(|h| topology.origin(h))
        .collect();
    let faces: BTreeSet<_> = near.iter().flat_map(|&v| topology.ring(v)).map(|h| topology.face(h)).collect();
    let normal = |f: ogee::FaceId| {
        let p: Vec<Vec3> = topology.halfedges(f).map(|h| mesh.points[topology.origin(h).index()]).collect();
        (0..p.len()).fold(Vec3::ZERO, |sum, i| sum + p[i].cross(p[(i + 1) % p.len()])).normalized().unwrap()
    };
    faces.into_iter().map(normal).collect()
}

/// The largest angle of these normals to a given one, in degrees.
fn deviation(mesh: &ControlMesh, normal: Vec3) -> f64 {
    normals(mesh).into_iter().map(|n| n.angle(normal).to_degrees()).fold(0.0, f64::max)
}

/// The largest angle between any two of these normals, in degrees.
fn spread(mesh: &ControlMesh) -> f64 {
    normals(mesh).into_iter().map(|n| deviation(mesh, n)).fold(0.0, f64::max)
}

/// Curves from the middle of a disk outwards, three legs each, with given first legs and somewhere in space after that.
fn star(legs: &[Vec3]) -> (ControlMesh, CurveNetwork) {
    let mesh = shapes::disk(legs.len() as u32, 4);
    let topology = Topology::new(&mesh).unwrap();
    let mut curves = Vec::new();
    for (j, (h, &leg)) in topology.ring(VertexId(0)).zip(legs).enumerate() {
        // Straight on through three regular vertices.
        let (mut vertices, mut h) = (vec![0, topology.target(h).0], h);
        for _ in 0..2 {
            let twin = topology.twin(topology.next(h)).unwrap();
            h = topology.next(twin);
            vertices.push(topology.target(h).0);
        }
        let a = j as f64;
        let bend =
            |k: f64| Vec3::new(0.2 * (a + k).sin(), 0.1 * (2.0 * a + k).cos(), 0.4 * (1.7 * a + k).sin());
        let control = vec![Vec3::ZERO, leg, 2.0 * leg + bend(1.0), 3.0 * leg + bend(2.0)];
        let name = format!("c{j}");
        curves.push(NetworkCurve { name, vertices, control: Some(control), ..NetworkCurve::default() });
    }
    (mesh, CurveNetwork { curves, ..CurveNetwork::default() })
}

/// Legs in a plane, at uneven angles and of uneven lengths.
fn uneven(count: usize) -> Vec<Vec3> {
    (0..count)
        .map(|j| {
            let a = TAU * (j as f64 + 0.15 * (2.3 * j as f64).sin()) / count as f64;
            (1.0 + 0.3 * (1.9 * j as f64 + 1.0).sin()) * Vec3::new(a.cos(), a.sin(), 0.0)
        })
        .collect()
}

fn codes(embedding: &Embedding) -> BTreeSet<&'static str> {
    embedding.warnings.iter().map(|warning| warning.code()).collect()
}

/// The meeting point in the middle of a star.
fn middle(embedding: &Embedding) -> ControlMesh {
    surroundings(&embedding.mesh, 0)
}

/// Moves the free spokes of the meeting point at vertex 0 off the plane, each by another length.
fn lift_free_spokes(embedding: &mut Embedding, height: f64) {
    let x = embedding.x_configurations.iter().find(|x| x.center == 0).unwrap();
    for (j, &v) in x.ring.iter().skip(1).step_by(2).enumerate() {
        embedding.mesh.points[v as usize].z += height * (1.0 + (2.1 * j as f64).sin());
    }
}

/// The largest distance between the control points of a mesh along its curves and those asked for. Equation (1).
fn curve_error(embedding: &Embedding) -> f64 {
    let mut worst = 0.0_f64;
    for (segment, sides) in embedding.segments.iter().zip(&embedding.sides) {
        let last = segment.vertices.len() - 1;
        for (i, (&v, &[left, right])) in segment.vertices.iter().zip(sides).enumerate() {
            if !((i == 0 && segment.meets[0]) || (i == last && segment.meets[1])) {
                let [l, m, r] = [left, v, right].map(|v| embedding.mesh.points[v as usize]);
                worst = worst.max(control_point(l, m, r).distance(segment.target.control()[i]));
            }
        }
    }
    worst
}

#[test]
fn coplanar_tangents_give_normals_that_settle_by_four_a_level() {
    for count in 2..=6 {
        let legs = if count == 2 {
            vec![Vec3::new(1.0, 0.0, 0.0), Vec3::new(-0.8, 0.1, 0.0)]
        } else {
            uneven(count)
        };
        let (mesh, network) = star(&legs);
        let embedding = embed(&network, &mesh).unwrap();
        let mut cut = at_level(&middle(&embedding), 6);
        let mut before = deviation(&cut, UP);
        for level in 7..=10 {
            cut = deeper(&cut);
            let now = deviation(&cut, UP);
            assert!((3.8..4.2).contains(&(before / now)), "{count}, level {level}: {before:e} {now:e}");
            if level == 8 {
                assert!(now < 0.01, "{count}: {now} degrees at level 8");
            }
            before = now;
        }
    }
}

#[test]
fn free_spokes_off_the_plane_settle_by_their_eigenvalue() {
    for (count, t, wanted) in [(3, default_parameter(3), 0.820), (4, 0.25, 0.820)] {
        let (mesh, mut network) = star(&uneven(count));
        network.options.parameter = Some(t);
        let mut embedding = embed(&network, &mesh).unwrap();
        lift_free_spokes(&mut embedding, 0.3);
        let rate = 2.0 * XMatrix::new(count, t).largest_free_eigenvalue();
        assert!((rate - wanted).abs() < 1e-3, "{count} ports: {rate}");
        let (early, late) = (at_level(&middle(&embedding), 14), at_level(&middle(&embedding), 18));
        let found = (deviation(&late, UP) / deviation(&early, UP)).powf(0.25);
        assert!((found / rate - 1.0).abs() < 0.05, "{count} ports: {found} for {rate}");
        assert!(curve_error(&embedding) < 1e-14, "whatever the free spokes do");
    }
}

#[test]
fn one_half_has_no_tangent_plane_and_is_told_of() {
    for count in [4, 6] {
        let (mesh, mut network) = star(&uneven(count));
        network.options.parameter = Some(0.5);
        let mut embedding = embed(&network, &mesh).unwrap();
        assert!(codes(&embedding).contains("W_T_HALF"), "{:?}", embedding.warnings);
        lift_free_spokes(&mut embedding, 0.3);
        for level in [10, 14, 18] {
            let left = spread(&at_level(&middle(&embedding), level));
            assert!(left > 10.0, "{count} ports, level {level}: {left} degrees");
        }
        assert!(surface_error(&embedding) < 1e-12, "curves are exact all the same");
    }
}

#[test]
fn tangents_out_of_one_plane_make_a_point_and_are_told_of() {
    let mut legs = uneven(4);
    legs[1] = legs[1].length()
        * Vec3::new(legs[1].x, legs[1].y, legs[1].length() * 5_f64.to_radians().tan()).normalized().unwrap();
    let (mesh, network) = star(&legs);
    let embedding = embed(&network, &mesh).unwrap();
    assert!(codes(&embedding).contains("W_TANGENTS_NOT_COPLANAR"));
    let spreads = [8, 12, 16].map(|level| spread(&at_level(&middle(&embedding), level)));
    assert!(spreads[0] > 3.0, "{spreads:?}");
    assert!(spreads.windows(2).all(|pair| (pair[1] / pair[0] - 1.0).abs() < 0.02), "{spreads:?}");
    assert!(surface_error(&embedding) < 1e-12);
    // Turned into one plane they are smooth, and the turns are told.
    let mut flat = network;
    flat.options.flatten = true;
    let embedding = embed(&flat, &mesh).unwrap();
    assert!(!codes(&embedding).contains("W_TANGENTS_NOT_COPLANAR"), "{:?}", embedding.warnings);
    let turned = embedding.warnings.iter().filter(|warning| warning.code() == "W_FLATTENED");
    let turns: Vec<f64> = turned.map(|warning| warning.value().unwrap()).collect();
    assert!(turns.len() == 4 && turns.iter().all(|turn| (0.1..5.0).contains(turn)), "{turns:?}");
    assert!(spread(&at_level(&middle(&embedding), 9)) < 0.01);
    assert!(surface_error(&embedding) < 1e-12);
}

#[test]
fn kinks_are_taken_away_where_that_is_wanted() {
    // One curve through the middle with a kink, two that end there.
    let (mesh, mut network) = star(&[
        Vec3::new(1.0, 0.1, 0.0),
        Vec3::new(0.1, 1.0, 0.0),
        Vec3::new(-1.2, 0.1, 0.2),
        Vec3::new(0.0, -0.9, 0.0),
    ]);
    let other = network.curves.remove(2);
    let through = &mut network.curves[0];
    let control = through.control.as_mut().unwrap();
    for (&v, &p) in other.vertices.iter().zip(other.control.as_ref().unwrap()).skip(1) {
        through.vertices.insert(0, v);
        control.insert(0, p);
    }
    let kink = embed(&network, &mesh).unwrap();
    assert!(codes(&kink).contains("W_CARRY_KINK"));
    network.options.straighten = true;
    network.options.flatten = true;
    let embedding = embed(&network, &mesh).unwrap();
    let told = codes(&embedding);
    assert!(told.contains("W_STRAIGHTENED") && told.contains("W_FLATTENED"), "{told:?}");
    assert!(!told.contains("W_CARRY_KINK") && !told.contains("W_TANGENTS_NOT_COPLANAR"), "{told:?}");
    let legs: Vec<Vec3> = embedding
        .segments
        .iter()
        .filter(|segment| segment.curve == 0)
        .map(|segment| {
            let control = segment.target.control();
            if segment.vertices[0] == 0 {
                control[1] - control[0]
            } else {
                control[control.len() - 2] - control[control.len() - 1]
            }
        })
        .collect();
    assert!(legs[0].angle(-legs[1]).to_degrees() < 1e-6, "{legs:?}");
    assert!(surface_error(&embedding) < 1e-12);
}

#[test]
fn across_a_curve_the_difference_of_normals_halves() {
    let (mesh, network) = star(&uneven(5));
    let embedding = embed(&network, &mesh).unwrap();
    // A vertex of the path away from both ends, and the rows beside it.
    let path = &embedding.segments[0].vertices;
    let mut cut = surroundings(&embedding.mesh, path[path.len() - 2]);
    let spread = |mesh: &ControlMesh| spread(mesh);
    let mut before = spread(&cut);
    for level in 1..=8 {
        cut = deeper(&cut);
        let now = spread(&cut);
        assert!(level < 4 || (1.8..2.2).contains(&(before / now)), "level {level}: {before:e} {now:e}");
        before = now;
    }
}

#[test]
fn great_circles_meet_smoothly_on_a_sphere() {
    let mut mesh = octahedron();
    let topology_of = |mesh: &ControlMesh| Level::new(mesh).unwrap();
    let mut paths: Vec<Vec<u32>> = vec![vec![0, 1, 2, 3], vec![0, 4, 2, 5], vec![1, 4, 3, 5]];
    for _ in 0..2 {
        let level = topology_of(&mesh);
        let topology = level.topology();
        let first = (topology.vertex_count() + topology.face_count()) as u32;
        for path in &mut paths {
            let legs = (0..path.len()).map(|i| (path[i], path[(i + 1) % path.len()]));
            let halved = legs.flat_map(|(a, b)| {
                let h = topology.ring(VertexId(a)).find(|&h| topology.target(h).0 == b).unwrap();
                [a, first + topology.edge(h).0]
            });
            *path = halved.collect();
        }
        let (finer, points) = level.refine_points(&mesh.points);
        let mut faces = FaceList::new();
        for f in (0..finer.topology().face_count() as u32).map(ogee::FaceId) {
            let corners = finer.topology().halfedges(f).map(|h| finer.topology().origin(h).0);
            faces.push(&corners.collect::<Vec<u32>>());
        }
        mesh = ControlMesh::new(points.into_iter().map(|p| p.normalized().unwrap()).collect(), faces);
    }
    // First legs across the radius: the tangents there are those of the circle.
    let curves = paths.iter().enumerate().map(|(number, path)| {
        let at = |i: usize| mesh.points[path[i % 16] as usize];
        let control = (0..16).map(|i| match i % 4 {
            1 => at(i - 1) + (TAU / 16.0).tan() * (at(i + 3) - at(i + 3).dot(at(i - 1)) * at(i - 1)),
            3 => at(i + 1) + (TAU / 16.0).tan() * (at(i + 13) - at(i + 13).dot(at(i + 1)) * at(i + 1)),
            _ => at(i),
        });
        let (name, closed) = (format!("circle {number}"), true);
        let control = Some(control.collect());
        NetworkCurve { name, vertices: path.clone(), closed, control, ..NetworkCurve::default() }
    });
    let network = CurveNetwork { curves: curves.collect(), ..CurveNetwork::default() };
    let embedding = embed(&network, &mesh).unwrap();
    assert!(embedding.warnings.is_empty(), "{:?}", embedding.warnings);
    assert_eq!(embedding.x_configurations.len(), 6);
    for x in &embedding.x_configurations {
        assert_eq!(x.ring.len(), 8);
        let cut = at_level(&surroundings(&embedding.mesh, x.center), 10);
        let normal = mesh.points[x.center as usize];
        assert!(deviation(&cut, normal) < 1e-3, "{} degrees at {}", deviation(&cut, normal), x.center);
    }
    assert!(surface_error(&embedding) < 1e-12);
}

/// A generator of numbers that look random (Lehmer).
fn random(state: &mut u64) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize
}

#[test]
fn random_networks_with_flat_meetings_are_smooth() {
    let mut state = 20;
    let (mut networks, mut meetings, mut worst) = (0, 0, 0.0_f64);
    while networks < 120 {
        let mesh = cages(random(&mut state) % 7);
        let count = 1 + random(&mut state) % 3;
        let seeds: Vec<Vec<usize>> = (0..count)
            .map(|_| (0..2 + random(&mut state) % 5).map(|_| random(&mut state) % 1000).collect())
            .collect();
        let curves = walks(&mesh, &seeds);
        if curves.is_empty() {
            continue;
        }
        networks += 1;
        let options = NetworkOptions { flatten: true, ..NetworkOptions::default() };
        let network = CurveNetwork { curves, options, ..CurveNetwork::default() };
        let embedding = embed(&network, &mesh).unwrap();
        for x in &embedding.x_configurations {
            meetings += 1;
            let early = at_level(&surroundings(&embedding.mesh, x.center), 7);
            let late = at_level(&early, 2);
            let (before, now) = (spread(&early), spread(&late));
            worst = worst.max(now);
            assert!(now < 0.01, "{:?}, vertex {}: {now} degrees", network.curves, x.center);
            // Where all is flat there is nothing to fall.
            assert!(now < 1e-6 || (14.0..18.0).contains(&(before / now)), "{before:e} {now:e}");
        }
    }
    assert!(meetings > 200 && worst > 1e-6, "{meetings} meeting points, {worst}");
}

#[test]
fn without_a_fixed_centre_curves_come_off() {
    // The first row of the 2004 paper: the plain vertex rule for the modified face points.
    let drift = |tangents: &[Vec3]| {
        let ports = tangents.len();
        let (n, t) = (2.0 * ports as f64, default_parameter(ports));
        let ring = XRing::eigen(tangents, t, UP);
        let sum = |list: &[Vec3], from: usize| {
            list.iter().skip(from).step_by(2).fold(Vec3::ZERO, |sum, &p| sum + p)
        };
        let corners = sum(&ring.corners, 0) + sum(&ring.corners, 1);
        // Weights 3 / (2 n^2) on each port, 1 / n^2 on each free spoke, 1 / (4 n^2) on each corner, with n = 2 M.
        let moved = 3.0 / (2.0 * n * n) * sum(&ring.ring, 0) + 1.0 / (n * n) * sum(&ring.ring, 1);
        (moved + 1.0 / (4.0 * n * n) * corners).length()
    };
    let even: Vec<Vec3> =
        (0..3).map(|j| TAU * f64::from(j) / 3.0).map(|a| Vec3::new(a.cos(), a.sin(), 0.0)).collect();
    assert!(drift(&even) < 1e-15);
    assert!(drift(&uneven(3)) > 1e-4, "{}", drift(&uneven(3)));
}

#[test]
fn smooth_crossings_carry_both_curves() {
    let wavy = |mesh: &ControlMesh, vertices: Vec<u32>, closed: bool| {
        let control = vertices.iter().map(|&v| {
            let p = mesh.points[v as usize];
            p + 0.3 * Vec3::new((3.0 * p.y).sin(), (2.0 * p.x).cos(), (p.x + 2.0 * p.y).sin())
        });
        let name = format!("{vertices:?}");
        let control = Some(control.collect());
        NetworkCurve { name, vertices, closed, control, ..NetworkCurve::default() }
    };
    let grid = shapes::grid(6, 6);
    let torus = shapes::torus(6, 5);
    let cases = [
        (
            grid.clone(),
            vec![
                wavy(&grid, (0..7).map(|i| 21 + i).collect(), false),
                wavy(&grid, (0..7).map(|i| 7 * i + 3).collect(), false),
            ],
        ),
        (
            torus.clone(),
            vec![
                wavy(&torus, (0..6).map(|i| 5 * i + 1).collect(), true),
                wavy(&torus, (0..5).map(|i| 10 + i).collect(), true),
            ],
        ),
    ];
    for (mesh, curves) in cases {
        let mut network = CurveNetwork { curves, ..CurveNetwork::default() };
        network.options.crossing = Crossing::Smooth;
        let embedding = embed(&network, &mesh).unwrap();
        assert!(embedding.x_configurations.is_empty());
        assert!(surface_error(&embedding) < 1e-12 * mesh.size(), "{:e}", surface_error(&embedding));
    }
}

#[test]
fn networks_move_with_affine_maps() {
    let map = |p: Vec3| Vec3::new(1.1 * p.x + 0.3 * p.z + 2.0, 0.2 * p.x + p.y - 1.0, p.z - 0.3 * p.y);
    let (mesh, network) = star(&uneven(3));
    let mut network = network;
    network.options.parameter = Some(0.3);
    let mut moved = network.clone();
    for curve in &mut moved.curves {
        curve.control = curve.control.take().map(|control| control.into_iter().map(map).collect());
    }
    let image = ControlMesh { points: mesh.points.iter().copied().map(map).collect(), ..mesh.clone() };
    // The meeting in the middle alone: lengths and directions of dummies are covariant under similarities only.
    let (before, after) = (embed(&network, &mesh).unwrap(), embed(&moved, &image).unwrap());
    let x = before.x_configurations.iter().find(|x| x.center == 0).unwrap();
    assert_eq!(x.parameter, after.x_configurations.iter().find(|y| y.center == 0).unwrap().parameter);
    let dangling: BTreeSet<u32> = surroundings_of_ends(&before);
    let mut compared = 0;
    for (v, (a, b)) in (0..).zip(before.mesh.points.iter().zip(&after.mesh.points)) {
        if !dangling.contains(&v) {
            assert!(map(*a).distance(*b) < 1e-12 * mesh.size(), "vertex {v}");
            compared += 1;
        }
    }
    assert!(compared > 20, "{compared}");
}

/// What lies around the meeting points at the free ends of a star, where dummies are, and the curves' vertices beside it.
fn surroundings_of_ends(embedding: &Embedding) -> BTreeSet<u32> {
    let topology = Topology::new(&embedding.mesh).unwrap();
    let ends = embedding.x_configurations.iter().filter(|x| x.center != 0);
    ends.flat_map(|x| topology.ring(VertexId(x.center)))
        .flat_map(|h| topology.halfedges(topology.face(h)))
        .map(|h| topology.origin(h).0)
        .collect()
}

#[test]
fn both_papers_forms_have_names() {
    let even: Vec<Vec3> =
        (0..3).map(|j| TAU * f64::from(j) / 3.0).map(|a| Vec3::new(a.cos(), a.sin(), 0.0)).collect();
    // An odd number of ports has free spokes opposite, which can be anywhere.
    for (legs, symmetric) in [(even, true), (uneven(3), true), (uneven(4), false)] {
        let (mesh, mut network) = star(&legs);
        network.options = NetworkOptions::abbas_nasri_2004(0.2);
        network.options.parameter = None;
        network
            .meetings
            .insert(0, ogee::curve_network::MeetingOptions { parameter: Some(0.2), ..Default::default() });
        let embedding = embed(&network, &mesh).unwrap();
        let told = embedding.warnings.iter().any(|w| w.code() == "W_NOT_SYMMETRIC" && w.vertex() == 0);
        assert_eq!(told, !symmetric, "{:?}", embedding.warnings);
        let x = embedding.x_configurations.iter().find(|x| x.center == 0).unwrap();
        assert_eq!(x.parameter, 0.2);
        let sum = x.ring.iter().fold(Vec3::ZERO, |sum, &v| sum + embedding.mesh.points[v as usize]);
        assert_eq!(sum.length() < 1e-13, symmetric, "{sum:?}");
        assert!(surface_error(&embedding) < 1e-12);
    }
    let (mesh, mut network) = star(&uneven(3));
    network.options = NetworkOptions::generalised();
    let embedding = embed(&network, &mesh).unwrap();
    assert!(codes(&embedding).contains("W_T_HALF"));
    let x = embedding.x_configurations.iter().find(|x| x.center == 0).unwrap();
    let at = |i: usize| embedding.mesh.points[x.ring[i] as usize];
    let legs: Vec<Vec3> = network.curves.iter().map(|curve| curve.control.as_ref().unwrap()[1]).collect();
    for j in 0..3 {
        let scale = 0.5_f64.powi(embedding.splits as i32);
        assert!(at(2 * j + 1).distance(scale * (legs[j] + legs[(j + 1) % 3])) < 1e-14);
    }
    assert!(surface_error(&embedding) < 1e-12);
}

#[test]
fn choices_for_vertices_where_nothing_meets_are_told_of() {
    let (mesh, mut network) = star(&uneven(3));
    network.meetings.insert(network.curves[0].vertices[1], Default::default());
    network.meetings.insert(0, Default::default());
    network.meetings.insert(9999, Default::default());
    let embedding = embed(&network, &mesh).unwrap();
    let told: Vec<u32> =
        embedding.warnings.iter().filter(|w| w.code() == "W_NO_MEETING").map(|w| w.vertex()).collect();
    assert_eq!(told, [network.curves[0].vertices[1], 9999]);
}

#[test]
fn curves_of_stars_are_the_ones_asked_for() {
    let (mesh, network) = star(&uneven(4));
    let embedding = embed(&network, &mesh).unwrap();
    for segment in &embedding.segments {
        let mut wanted = TargetCurve::open(network.curves[segment.curve].control.clone().unwrap()).unwrap();
        (0..embedding.splits).for_each(|_| wanted = wanted.refined());
        assert_eq!(segment.target, wanted);
    }
}
