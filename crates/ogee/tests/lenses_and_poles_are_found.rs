//! Lenses, pairs, poles and corners, and what is in their way: `testdata/lens/detection_cases` and cages of our own.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod lens_nets;

use golden::{faces, index, list};
use lens_nets::{document, fan, mesh, pair, single_lens};
use ogee::lens::{
    Detection, LensError, LensKind, LensNet, Obstacle, Symmetry, detect, lattice_index, lattice_point,
    regular_net,
};
use ogee::{
    ControlMesh, Corner, Crease, Defect, FaceId, FaceList, Level, Meeting, Sharpness, Topology, Vec3,
    VertexId,
};
use serde_json::Value;

fn find(mesh: &ControlMesh) -> Detection {
    detect(&Level::new(mesh).unwrap()).unwrap()
}

fn ids(value: &Value) -> Vec<VertexId> {
    list(value).iter().map(|v| VertexId(index(v))).collect()
}

#[test]
fn every_case_is_as_expected() {
    let document = document("detection_cases");
    for case in list(&document["cases"]) {
        let (name, expected) = (case["name"].as_str().unwrap(), &case["expected"]);
        let found = Level::new(&mesh(faces(&case["faces"])));
        if expected["error"].is_string() {
            let (code, vertices) = match found {
                Err(error) => {
                    let vertices = match error.defects[0] {
                        Defect::RepeatedVertex { vertex, .. } => vec![vertex],
                        Defect::NonManifoldEdge { a, b, .. } => vec![a, b],
                        _ => panic!("{name}: {error}"),
                    };
                    (error.defects[0].code(), vertices)
                }
                Ok(level) => match detect(&level).unwrap_err() {
                    error @ LensError::AdjacentLensVertices { vertices } => (error.code(), vertices.to_vec()),
                    error => panic!("{name}: {error}"),
                },
            };
            assert_eq!(code, expected["error"], "{name}");
            assert_eq!(vertices, ids(&expected["vertices"]), "{name}");
            continue;
        }
        let found = detect(&found.unwrap()).unwrap();
        let lenses: Vec<VertexId> = found.lenses.iter().map(|lens| lens.vertex).collect();
        assert_eq!(lenses, ids(&expected["lenses"]), "{name}");
        assert_eq!(found.corners, ids(&expected["corners"]), "{name}");
        assert_eq!(found.ambiguous().collect::<Vec<_>>(), ids(&expected["ambiguous"]), "{name}");
        let isolated: Vec<VertexId> = found.isolated().map(|lens| lens.vertex).collect();
        assert_eq!(isolated, ids(&expected["isolated"]), "{name}");
        let needing: Vec<VertexId> = found.needing_refinement().map(|(vertex, _)| vertex).collect();
        assert_eq!(needing, ids(&expected["needs_refinement"]), "{name}");
        let pairs: Vec<[u32; 3]> = found
            .pairs
            .iter()
            .map(|pair| [pair.slit[0].0, pair.slit[pair.slit.len() - 1].0, pair.slit.len() as u32 - 1])
            .collect();
        let wanted: Vec<[u32; 3]> =
            list(&expected["pairs"]).iter().map(|p| [0, 1, 2].map(|k| index(&p[k]))).collect();
        assert_eq!(pairs, wanted, "{name}");
        for lens in &found.lenses {
            let partner = found.pairs.iter().find(|pair| pair.slit.contains(&lens.vertex));
            assert_eq!(matches!(lens.kind, LensKind::Paired { .. }), partner.is_some(), "{name}");
        }
        if name == "lens_with_triangles" {
            assert_eq!(found.lenses[0].net, Err(Obstacle::NotAQuad { face: FaceId(0), layer: 1 }));
        }
    }
    assert_eq!(list(&document["cases"]).len(), 13);
}

#[test]
fn numbers_faces_and_symmetries_are_those_of_the_layout() {
    let layout = document("layout");
    let ij = |value: &Value| (value[0].as_i64().unwrap() as i32, value[1].as_i64().unwrap() as i32);
    for (number, point) in list(&layout["bi3_ij"]).iter().enumerate() {
        assert_eq!((lattice_point(number), lattice_index(ij(point).0, ij(point).1)), (ij(point), number));
    }
    for (k, point) in list(&layout["bi4_ij"]).iter().enumerate() {
        assert_eq!(lattice_point(k + 1), ij(point));
    }
    let stencils = document("bi4_stencils");
    let permutations = &stencils["permutations"];
    let named = [
        ("id", Symmetry::Identity),
        ("rot", Symmetry::Rotation),
        ("mirror_x", Symmetry::MirrorX),
        ("mirror_y", Symmetry::MirrorY),
    ];
    for (name, symmetry) in named {
        let images: Vec<u32> = (1..=24).map(|k| symmetry.image(k) as u32).collect();
        assert_eq!(images, list(&permutations[name]).iter().map(index).collect::<Vec<_>>());
    }
    // The walk finds back the numbers that a mesh was made with, and all its faces.
    let listed = mesh(faces(&layout["bi3_faces"]));
    let wider = single_lens(4);
    for mesh in [&listed, &wider] {
        let topology = Topology::new(mesh).unwrap();
        let net = LensNet::new(&topology, VertexId(0)).unwrap().unwrap();
        assert_eq!(net.vertices.map(|v| v.0 as usize), std::array::from_fn(|k| k));
        let mut seen: Vec<FaceId> = (1..=3).flat_map(|k| net.faces(&topology, k)).collect();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 18);
        assert_eq!(net.disk(&topology).len(), 8);
    }
}

#[test]
fn pairs_have_their_circles() {
    let document = document("mesh_pair_m4");
    let listed = ControlMesh::new(golden::points(&document["vertices"]), faces(&document["faces"]));
    let found = find(&listed);
    for (k, name) in [(0, "net25_of_0"), (1, "net25_of_4")] {
        assert_eq!(found.lenses[k].net.as_ref().unwrap().vertices.to_vec(), ids(&document[name]));
    }
    for (mesh, m) in [(listed, 4), (pair(2, 3), 2), (pair(3, 3), 3), (pair(5, 4), 5)] {
        let found = find(&mesh);
        let slit: Vec<u32> = found.pairs[0].slit.iter().map(|v| v.0).collect();
        assert_eq!(slit, (0..=m).collect::<Vec<_>>());
        let around = found.pairs[0].neighbourhood.as_ref().unwrap();
        for (y, circle) in (1..).zip(&around.circles) {
            // Columns of the golden data run the other way round.
            let wanted: Vec<u32> =
                (0..2 * m).map(|x| m + 1 + (y - 1) * 2 * m + (2 * m - x) % (2 * m)).collect();
            assert_eq!(circle.iter().map(|v| v.0).collect::<Vec<_>>(), wanted);
        }
        let mut disk: Vec<u32> = around.disk.iter().map(|f| f.0).collect();
        disk.sort_unstable();
        assert_eq!(disk, (0..4 * m).collect::<Vec<_>>());
        assert_counter_clockwise(&mesh, &around.circles[0], &around.circles[1]);
    }
    // The third circle is not there.
    let short = find(&pair(4, 2));
    assert!(matches!(short.pairs[0].neighbourhood, Err(Obstacle::Boundary { layer: 2, .. })));
}

/// Some face has an edge of the outer circle, followed by a step inward: it lies on the left of the outer circle.
fn assert_counter_clockwise(mesh: &ControlMesh, inner: &[VertexId], outer: &[VertexId]) {
    let wanted = [outer[0], outer[1], inner[1], inner[0]].map(|v| v.0);
    let matches = |face: &[u32]| (0..4).any(|k| (0..4).all(|c| face.get((c + k) % 4) == Some(&wanted[c])));
    assert!(mesh.faces.iter().any(matches), "{wanted:?}");
}

#[test]
fn poles_have_their_circles() {
    for n in [3, 4, 5, 8, 13] {
        let mesh = fan(n, 3);
        let found = find(&mesh);
        assert_eq!((found.poles.len(), found.poles[0].vertex), (1, VertexId(0)));
        let around = found.poles[0].neighbourhood.as_ref().unwrap();
        assert_eq!((around.columns(), around.disk.len()), (n as usize, 2 * n as usize));
        let first = around.circles[0][0].0;
        for (y, circle) in (0..).zip(&around.circles) {
            let wanted: Vec<u32> = (0..n).map(|x| 1 + y * n + (first - 1 + x) % n).collect();
            assert_eq!(circle.iter().map(|v| v.0).collect::<Vec<_>>(), wanted);
        }
        assert_counter_clockwise(&mesh, &around.circles[0], &around.circles[1]);
    }
    let short = find(&fan(6, 2));
    assert_eq!(short.poles[0].neighbourhood.as_ref().unwrap_err().code(), "boundary");
    assert!(find(&fan(6, 1)).poles.is_empty(), "its triangles end at the boundary");
    // One more quad at a vertex of the ring, which touches no triangle.
    let mut faces = FaceList::new();
    for face in fan(6, 2).faces.iter() {
        let from_the_last_column = face.contains(&6) && face.contains(&1) && face.len() == 4;
        faces.push(
            &face.iter().map(|&v| if from_the_last_column && v == 7 { 13 } else { v }).collect::<Vec<_>>(),
        );
    }
    faces.push(&[1, 13, 14, 7]);
    assert!(find(&mesh(faces)).poles.is_empty());
    let upper = (0..4).map(|x| [0, 1 + x, 1 + (x + 1) % 4]);
    let lower = (0..4).map(|x| [5, 1 + (x + 1) % 4, 1 + x]);
    let octahedron = mesh(upper.chain(lower).collect());
    // Triangles all round the next vertices as well: no pole.
    assert!(find(&octahedron).poles.is_empty());
}

#[test]
fn tags_in_what_is_replaced_are_in_the_way() {
    let crease = |a: u32, b: u32| Crease { vertices: [a, b], sharpness: Sharpness::Infinite };
    let with = |crease: Crease| ControlMesh { creases: vec![crease], ..single_lens(5) };
    let obstacle = |mesh: &ControlMesh| find(mesh).lenses[0].net.clone().err();
    assert_eq!(obstacle(&single_lens(5)), None);
    let sharp =
        |a: u32, b: u32, layer: u32| Some(Obstacle::SharpEdge { a: VertexId(a), b: VertexId(b), layer });
    assert_eq!(obstacle(&with(crease(0, 1))), sharp(0, 1, 0));
    assert_eq!(obstacle(&with(crease(6, 2))), sharp(2, 6, 1));
    assert_eq!(obstacle(&with(crease(13, 5))), sharp(5, 13, 2));
    assert_eq!(obstacle(&with(crease(13, 14))), None);
    let cornered = |vertex: u32| ControlMesh {
        corners: vec![Corner { vertex, sharpness: Sharpness::Finite(0.5) }],
        ..single_lens(5)
    };
    assert_eq!(obstacle(&cornered(7)), Some(Obstacle::SharpVertex { vertex: VertexId(7), layer: 2 }));
    assert_eq!(obstacle(&cornered(16)), None);
    let net = regular_net(&Level::new(&single_lens(5)).unwrap(), VertexId(0)).unwrap();
    let topology = Topology::new(&single_lens(5)).unwrap();
    let hidden = |face: FaceId| ControlMesh { holes: vec![face.0], ..single_lens(5) };
    for k in [1, 2] {
        let face = net.faces(&topology, k)[0];
        assert_eq!(obstacle(&hidden(face)), Some(Obstacle::HiddenFace { face, layer: k as u32 }));
    }
    assert_eq!(obstacle(&hidden(net.faces(&topology, 3)[0])), None);

    let mut slit = pair(4, 4);
    slit.creases.push(crease(2, 3));
    assert_eq!(find(&slit).pairs[0].neighbourhood.as_ref().unwrap_err().code(), "sharp_edge");
    let mut pole = fan(6, 4);
    pole.creases.push(crease(7, 13));
    assert_eq!(find(&pole).poles[0].neighbourhood.as_ref().unwrap_err().code(), "sharp_edge");
    pole.creases.clear();
    pole.holes = vec![0];
    assert_eq!(find(&pole).poles[0].neighbourhood.as_ref().unwrap_err().code(), "hidden_face");
}

#[test]
fn refinement_moves_obstacles_away() {
    let plain = single_lens(7);
    let sharp = |a: u32, b: u32| {
        let creases = vec![Crease { vertices: [a, b], sharpness: Sharpness::Infinite }];
        ControlMesh { creases, ..plain.clone() }
    };
    let corner = |vertex: u32| {
        let corners = vec![Corner { vertex, sharpness: Sharpness::Infinite }];
        ControlMesh { corners, ..plain.clone() }
    };
    let net = regular_net(&Level::new(&plain).unwrap(), VertexId(0)).unwrap();
    let topology = Topology::new(&plain).unwrap();
    let face = |k: usize| net.faces(&topology, k)[0].0;
    let hidden = |k: usize| ControlMesh { holes: vec![face(k)], ..plain.clone() };
    let meeting = |vertex: u32| {
        let ports =
            [0, 2].map(|k| topology.target(topology.ring(VertexId(vertex)).nth(k).unwrap()).0).to_vec();
        ControlMesh { meetings: vec![Meeting { vertex, ports, t: 0.3 }], ..plain.clone() }
    };
    // The two faces at an edge made one, with six corners.
    let dissolved = |a: u32, b: u32| {
        let after = |face: &[u32], a: u32, b: u32| {
            let at = (0..face.len()).find(|&k| face[k] == a && face[(k + 1) % face.len()] == b)?;
            Some((1..face.len()).map(|k| face[(at + k) % face.len()]).collect::<Vec<u32>>())
        };
        let mut faces = FaceList::new();
        let mut hexagon = Vec::new();
        for face in plain.faces.iter() {
            match after(face, a, b).or_else(|| after(face, b, a)) {
                Some(rest) => hexagon.extend(rest),
                None => faces.push(face),
            }
        }
        faces.push(&hexagon);
        mesh(faces)
    };
    let cases = [
        (single_lens(2), "boundary", Some(1)),
        (pair(2, 4), "other_lens", Some(1)),
        (sharp(0, 1), "sharp_edge", None),
        (sharp(2, 6), "sharp_edge", Some(2)),
        (sharp(5, 6), "sharp_edge", Some(1)),
        (corner(0), "sharp_vertex", None),
        (corner(4), "sharp_vertex", Some(2)),
        (corner(9), "sharp_vertex", Some(1)),
        (hidden(1), "hidden_face", None),
        (hidden(2), "hidden_face", Some(1)),
        (meeting(4), "meeting", Some(2)),
        (meeting(9), "meeting", Some(1)),
        (meeting(16), "meeting", Some(1)),
        (dissolved(1, 2), "not_a_quad", Some(3)),
        (dissolved(2, 6), "extraordinary", Some(2)),
        (dissolved(6, 7), "not_a_quad", Some(1)),
        (dissolved(5, 13), "extraordinary", Some(1)),
    ];
    for (mesh, code, wanted) in cases {
        let mut level = Level::new(&mesh).unwrap();
        let mut points = mesh.points.clone();
        let first = detect(&level).unwrap().lenses[0].net.clone().unwrap_err();
        assert_eq!((first.code(), first.refinements()), (code, wanted));
        let steps = wanted.unwrap_or(3);
        for step in 0..steps {
            let still = detect(&level).unwrap().lenses[0].net.clone().unwrap_err();
            assert!(still.code() == code || step > 0 || wanted.is_none(), "{code} {step}: {still}");
            (level, points) = refined(&level, &points);
        }
        let last = detect(&level).unwrap().lenses[0].net.clone();
        assert!(last.is_ok() == wanted.is_some(), "{code}, {steps} steps: {last:?}");
        assert!(points.iter().all(|p| p.is_finite()));
    }
}

fn refined(level: &Level, points: &[Vec3]) -> (Level, Vec<Vec3>) {
    let refinement = ogee::Refinement::uniform(level, 1).unwrap();
    (refinement.finest().clone(), refinement.apply(points))
}

#[test]
fn what_is_no_lens_is_said() {
    let level = Level::new(&single_lens(3)).unwrap();
    for vertex in [1, 25, 999].map(VertexId) {
        assert_eq!(regular_net(&level, vertex), Err(LensError::NotALens { vertex }));
    }
    let level = Level::new(&single_lens(2)).unwrap();
    assert!(matches!(regular_net(&level, VertexId(0)), Err(LensError::Blocked { .. })));
}
