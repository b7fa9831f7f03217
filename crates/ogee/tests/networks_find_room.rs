//! After splits and repair every path lies in quads with one vertex to either side, and its surface has the curve that was
//! asked for; Euler number, border and orientation stay.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use golden::{faces, index, list, number, points};
use networks::{along, any_network, cages, cases, curves, walks};
use ogee::curve_network::{
    Crossing, CurveNetwork, Embedding, NetworkCurve, Placing, PreSplit, XMatrix, XRing, control_point, embed,
};
use ogee::{
    ControlMesh, FaceId, FaceList, Level, LimitSurface, PatchTable, Topology, Valence, Vec3, VertexId,
    limit_vertices, shapes,
};
use proptest::prelude::*;
use std::collections::BTreeSet;

fn euler(mesh: &Topology) -> i64 {
    mesh.vertex_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

/// Number of closed border lines.
fn borders(mesh: &Topology) -> usize {
    let mut open: BTreeSet<_> = mesh.edge_halfedges().filter(|&h| mesh.twin(h).is_none()).collect();
    let mut count = 0;
    while let Some(&start) = open.iter().next() {
        count += 1;
        let mut h = start;
        while open.remove(&h) {
            let next = mesh.outgoing(mesh.target(h));
            h = next.expect("a face beside every vertex");
        }
    }
    count
}

/// All that is promised about the mesh and the curves in it.
fn check(name: &str, mesh: &ControlMesh, network: &CurveNetwork, embedding: &Embedding) {
    let before = Topology::new(mesh).unwrap();
    let level = Level::new(&embedding.mesh).unwrap();
    let after = level.topology();
    assert_eq!(euler(&before), euler(after), "{name}");
    assert_eq!(borders(&before), borders(after), "{name}");
    for v in (0..after.vertex_count() as u32).map(VertexId) {
        assert!(after.outgoing(v).is_some(), "{name}: vertex {v} is used");
        assert_ne!(after.valence(v), Valence::Interior(2), "{name}: vertex {v}");
    }
    let size = mesh.size();
    let points = &embedding.mesh.points;
    let limits = limit_vertices(&level, points);
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, points);
    for segment in embedding.segments.iter().filter(|segment| !segment.along_border) {
        let path = &segment.vertices;
        for k in 0..segment.target.spans() {
            for t in [0.004, 0.3, 0.71] {
                let at = along(&level, &table, [path[k], path[(k + 1) % path.len()]], t);
                let distance = surface.eval(at).position.distance(segment.target.point(k as f64 + t));
                assert!(distance < 1e-12 * size, "{name}: the curve is {distance:e} off at {k} + {t}");
            }
        }
    }
    for (segment, sides) in embedding.segments.iter().zip(&embedding.sides) {
        if segment.along_border {
            continue;
        }
        let last = segment.vertices.len() - 1;
        let control = segment.target.control();
        for (i, (&v, &[left, right])) in segment.vertices.iter().zip(sides).enumerate() {
            let around: Vec<u32> = after.ring(VertexId(v)).map(|h| after.target(h).0).collect();
            // Left is what comes next after the way forward, counter-clockwise, or before the way back.
            let step = |to: u32, by: usize| {
                let at = around.iter().position(|&u| u == to).unwrap();
                around[(at + by) % around.len()]
            };
            if !after.is_boundary(VertexId(v)) {
                let back = around.len() - 1;
                let wanted = match segment.vertices.get(i + 1) {
                    Some(&next) => [step(next, 1), step(next, back)],
                    None if segment.target.is_closed() => {
                        [step(segment.vertices[0], 1), step(segment.vertices[0], back)]
                    }
                    None => [step(segment.vertices[i - 1], back), step(segment.vertices[i - 1], 1)],
                };
                assert_eq!([left, right], wanted, "{name}: beside vertex {v}");
            }
            if (i == 0 && segment.meets[0]) || (i == last && segment.meets[1]) {
                assert_eq!(points[v as usize], control[i], "{name}: the centre is interpolated");
                continue;
            }
            let [l, m, r] = [left, v, right].map(|v| points[v as usize]);
            assert!(
                control_point(l, m, r).distance(control[i]) < 1e-12 * size,
                "{name}: equation (1) at {v}"
            );
            let ends = segment.target.is_closed() || (0 < i && i < last);
            let valence = if ends { Valence::Interior(4) } else { Valence::Boundary(2) };
            assert_eq!(after.valence(VertexId(v)), valence, "{name}: vertex {v}");
            for h in after.ring(VertexId(v)) {
                assert_eq!(after.face_size(after.face(h)), 4, "{name}: faces at vertex {v}");
            }
            let distance = limits[v as usize].position.distance(segment.target.limit(i));
            assert!(distance < 1e-12 * size, "{name}: the limit of vertex {v} is {distance:e} off");
        }
    }
    for x in &embedding.x_configurations {
        let around: Vec<u32> = after.ring(VertexId(x.center)).map(|h| after.target(h).0).collect();
        let start = around.iter().position(|&v| v == x.ring[0]).unwrap();
        let turned: Vec<u32> = (0..around.len()).map(|i| around[(start + i) % around.len()]).collect();
        assert_eq!(turned, x.ring, "{name}: the ring of {}", x.center);
        assert!(after.ring(VertexId(x.center)).all(|h| after.face_size(after.face(h)) == 4), "{name}");
        assert!(x.ring.len() % 2 == 0 && x.ring.len() >= 4, "{name}: {x:?}");
        let crowded = embedding.warnings.iter().any(|warning| warning.code() == "W_X_OVERLAP");
        if network.options.placing == Placing::Eigen && !crowded {
            let relative = |v: u32| points[v as usize] - points[x.center as usize];
            let slices = (0..around.len()).map(|i| {
                let slice = after.ring(VertexId(x.center)).find(|&h| after.target(h).0 == x.ring[i]).unwrap();
                relative(after.target(after.next(slice)).0)
            });
            let ring =
                XRing { ring: x.ring.iter().map(|&v| relative(v)).collect(), corners: slices.collect() };
            let next = XMatrix::new(ring.ports(), x.parameter).refine(&ring);
            for (a, b) in ring.ring.iter().chain(&ring.corners).zip(next.ring.iter().chain(&next.corners)) {
                assert!((*a / 2.0).distance(*b) < 1e-12 * size, "{name}: the ring of {} is halved", x.center);
            }
        }
    }
    assert!(network.options.pre_split != PreSplit::Fixed(0) || embedding.splits == 0);
}

#[test]
fn golden_networks_are_embedded() {
    let mut same_mesh = 0;
    for (name, document) in cases() {
        let prepared = &document["prepared"];
        let input = &document["input"];
        let mesh = ControlMesh::new(points(&input["vertices"]), faces(&input["faces"]));
        let mut network = CurveNetwork { curves: curves(input), ..CurveNetwork::default() };
        let options = &input["options"];
        if options["x_mode"] == "parallelogram" {
            network.options.placing = Placing::Parallelogram;
        }
        network.options.parameter = options["t"].as_f64();
        if options["crossing"] == "smooth" {
            network.options.crossing = Crossing::Smooth;
        }
        let embedding = embed(&network, &mesh).unwrap();
        check(&name, &mesh, &network, &embedding);
        assert_eq!(embedding.splits, index(&document["pre_split_used"]), "{name}");
        let wanted = list(&prepared["x_vertices"]);
        assert_eq!(embedding.x_configurations.len(), wanted.len(), "{name}");
        for (x, wanted) in embedding.x_configurations.iter().zip(wanted) {
            assert_eq!((x.center, x.ring.len()), (index(&wanted["center"]), list(&wanted["ring"]).len()));
            assert!((x.parameter - number(&wanted["t"])).abs() < 1e-15, "{name}");
        }
        // Where nothing had to be put in, numbers are the same, and so must all points be.
        let vertices = points(&prepared["vertices"]);
        if vertices.len() == mesh.points.len() {
            same_mesh += 1;
            for (v, (a, b)) in embedding.mesh.points.iter().zip(&vertices).enumerate() {
                assert!(a.distance(*b) < 1e-12 * mesh.size(), "{name}, vertex {v}: {a:?} {b:?}");
            }
        }
    }
    assert!(same_mesh >= 6, "{same_mesh}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn random_networks_are_embedded((kind, seeds, forced) in any_network(6)) {
        let mesh = cages(kind);
        let mut network = CurveNetwork { curves: walks(&mesh, &seeds), ..CurveNetwork::default() };
        network.options.force_ribbons = forced;
        let embedding = embed(&network, &mesh);
        prop_assert!(embedding.is_ok(), "{kind}: {:?}: {}", network.curves, embedding.unwrap_err());
        let embedding = embedding.unwrap();
        prop_assert!(embedding.warnings.iter().all(|warning| warning.code() != "W_X_OVERLAP"));
        check(&format!("{kind}: {:?}", network.curves), &mesh, &network, &embedding);
    }
}

#[test]
fn tags_and_holes_stay_with_their_faces() {
    let mut mesh = shapes::grid(4, 4);
    mesh.holes = vec![0];
    mesh.creases.push(ogee::Crease { vertices: [18, 19], sharpness: ogee::Sharpness::Finite(2.5) });
    let mut network = CurveNetwork::default();
    network.curves.push(NetworkCurve {
        name: "bent".into(),
        vertices: vec![2, 7, 6, 5],
        ..NetworkCurve::default()
    });
    for splits in [0, 1] {
        network.options.pre_split = PreSplit::Fixed(splits);
        let embedding = embed(&network, &mesh).unwrap();
        let level = Level::new(&embedding.mesh).unwrap();
        assert_eq!(level.semi_sharp_edges().count(), 1 << splits);
        assert!(level.semi_sharp_edges().all(|(_, s)| s == 2.5 - f64::from(splits)));
        // Whatever the hole was cut into is a hole: seen from above, it covers the same corner.
        let topology = level.topology();
        for f in (0..topology.face_count() as u32).map(FaceId) {
            let corners: Vec<Vec3> =
                topology.halfedges(f).map(|h| embedding.mesh.points[topology.origin(h).index()]).collect();
            let middle = corners.iter().fold(Vec3::ZERO, |sum, &p| sum + p) / corners.len() as f64;
            let hole = embedding.mesh.holes.contains(&f.0);
            if hole {
                assert!(middle.x < 1.3 && middle.y < 1.3, "face {f} at {middle:?}");
            }
            if middle.x < 0.7 && middle.y < 0.7 {
                assert!(hole, "face {f} at {middle:?}");
            }
        }
    }
}

#[test]
fn texture_coordinates_go_along() {
    // Every face has a square of its own, so that there is a seam along every edge.
    let mut mesh = shapes::grid(6, 6);
    let squares = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let offset = |f: usize| [3.0 * f as f64, 0.0];
    let values = (0..36).flat_map(|f| squares.map(|[u, v]| [u + offset(f)[0], v])).collect();
    mesh.uv =
        Some(ogee::FaceVarying { values, indices: (0..144).collect(), rule: ogee::FaceVaryingRule::All });
    let mut network =
        CurveNetwork { curves: vec![path(&[3, 10, 17, 24, 31, 38, 45])], ..CurveNetwork::default() };
    for splits in [0, 1] {
        network.options.pre_split = PreSplit::Fixed(splits);
        let embedding = embed(&network, &mesh).unwrap();
        let uv = embedding.mesh.uv.as_ref().unwrap();
        let corners = embedding.mesh.faces.iter().flatten();
        assert_eq!(uv.indices.len(), embedding.mesh.faces.corners().len());
        // A flat sheet with flat curves: coordinates are those of the place in its square.
        for (&v, &index) in corners.zip(&uv.indices) {
            let [u, w] = uv.values[index as usize];
            let f = (u / 3.0 + 1e-9).floor();
            let place = [u - 3.0 * f + f % 6.0, w + (f / 6.0).floor()];
            let p = embedding.mesh.points[v as usize];
            let on_border = [p.x, p.y].iter().any(|x| *x < 0.7 || *x > 5.3);
            assert!(
                on_border || ((p.x - place[0]).abs() + (p.y - place[1]).abs()) < 1e-12,
                "{splits} splits, vertex {v}: {p:?} {place:?}"
            );
        }
        assert!(embedding.warnings.is_empty());
    }
    // Ribbons put vertices in, which have none.
    network.options.force_ribbons = true;
    let embedding = embed(&network, &mesh).unwrap();
    assert!(embedding.mesh.uv.is_none());
    assert_eq!(embedding.warnings[0].code(), "W_UV_DROPPED");
}

#[test]
fn meeting_points_that_share_a_vertex_are_told_of() {
    // Two curves end side by side, one edge apart.
    let curve = |name: &str, vertices: &[u32]| NetworkCurve {
        name: name.into(),
        vertices: vertices.to_vec(),
        ..NetworkCurve::default()
    };
    let mesh = shapes::grid(6, 6);
    let mut network = CurveNetwork {
        curves: vec![curve("a", &[2, 9, 16]), curve("b", &[4, 11, 18])],
        ..CurveNetwork::default()
    };
    network.options.pre_split = PreSplit::Fixed(0);
    let crowded = embed(&network, &mesh).unwrap();
    check("crowded", &mesh, &network, &crowded);
    let overlaps = crowded.warnings.iter().filter(|warning| warning.code() == "W_X_OVERLAP");
    assert_eq!(overlaps.map(|warning| warning.vertex()).collect::<Vec<_>>(), [10, 17, 24]);
    network.options.pre_split = PreSplit::Auto;
    let roomy = embed(&network, &mesh).unwrap();
    check("roomy", &mesh, &network, &roomy);
    assert_eq!((roomy.splits, roomy.warnings.len()), (1, 0));
}

#[test]
fn nothing_is_changed_where_nothing_may_be() {
    let mesh = shapes::grid(5, 5);
    let mut network = CurveNetwork::default();
    network.options.repair = false;
    let mut end_inside = |path: &[u32]| {
        network.curves =
            vec![NetworkCurve { name: "a".into(), vertices: path.to_vec(), ..NetworkCurve::default() }];
        embed(&network, &mesh).map(|embedding| embedding.mesh.points.len()).map_err(|error| error.code())
    };
    assert_eq!(end_inside(&[2, 8, 14, 20]), Ok(36));
    // A corner of a path; a third curve's worth of edges is missing at the end of two that meet at a right angle.
    assert_eq!(end_inside(&[2, 8, 9, 10]), Err("E_PATH_VALENCE"));
    network.curves.push(NetworkCurve {
        name: "b".into(),
        vertices: vec![14, 15, 16, 17],
        ..Default::default()
    });
    network.curves[0].vertices = vec![2, 8, 14];
    assert_eq!(embed(&network, &mesh).unwrap_err().code(), "E_PATH_VALENCE");
}

/// A grid in which so many faces right of the middle vertex, 14, are one polygon.
fn grid_with_polygon(merged: u32) -> ControlMesh {
    let mut mesh = shapes::grid(5, 5);
    let gone: Vec<[u32; 4]> = (14..14 + merged).map(|v| [v, v + 1, v + 7, v + 6]).collect();
    let mut faces = FaceList::new();
    mesh.faces.iter().filter(|face| !gone.iter().any(|gone| *face == gone)).for_each(|face| faces.push(face));
    faces.push(&(14..=14 + merged).chain((20..=20 + merged).rev()).collect::<Vec<u32>>());
    mesh.faces = faces;
    mesh
}

fn embedded(mesh: &ControlMesh, curves: Vec<NetworkCurve>) -> Embedding {
    let network = CurveNetwork { curves, ..CurveNetwork::default() };
    let embedding = embed(&network, mesh).unwrap();
    check("by hand", mesh, &network, &embedding);
    embedding
}

fn path(vertices: &[u32]) -> NetworkCurve {
    NetworkCurve { name: format!("{vertices:?}"), vertices: vertices.to_vec(), ..NetworkCurve::default() }
}

#[test]
fn a_ring_with_a_hexagon_is_no_x_configuration_yet() {
    let embedding = embedded(&grid_with_polygon(2), vec![path(&[2, 8, 14])]);
    assert_eq!((embedding.splits, embedding.x_configurations[0].ring.len()), (0, 4));
}

#[test]
fn curves_side_by_side_get_a_row_between_them() {
    let embedding =
        embedded(&shapes::grid(5, 5), vec![path(&[2, 8, 14, 20, 26, 32]), path(&[3, 9, 15, 21, 27, 33])]);
    assert_eq!(embedding.splits, 0);
    assert!(embedding.mesh.points.len() > 36);
}

#[test]
fn two_corners_of_a_chain_in_one_face_get_a_chord_each() {
    // The octagon lies in a sector of 200 degrees, which needs a dummy port.
    let mesh = grid_with_polygon(3);
    let turned = |vertices: &[u32], degrees: f64| {
        let at = |&v: &u32| mesh.points[v as usize];
        let direction = Vec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
        let mut control: Vec<Vec3> = vertices.iter().map(at).collect();
        control[1] = control[0] + direction;
        NetworkCurve { control: Some(control), ..path(vertices) }
    };
    let curves =
        vec![turned(&[14, 15, 9, 3], 0.0), turned(&[14, 20, 26, 32], 200.0), turned(&[14, 13, 12], 280.0)];
    let embedding = embedded(&mesh, curves);
    assert_eq!((embedding.splits, embedding.x_configurations[0].ring.len()), (0, 8));
}
