//! What the models promise.

use std::collections::BTreeSet;

use ogee::mesh::check;
use ogee::{ControlMesh, Topology, Valence, Vec3, VertexId};

use super::{Form, Model, all, folder, networks, write};

/// Valences at inner vertices.
fn valences(model: &Model) -> BTreeSet<u32> {
    let t = Topology::new(&model.mesh).unwrap();
    let valence = |v| match t.valence(VertexId(v)) {
        Valence::Interior(n) => Some(n),
        Valence::Boundary(_) => None,
    };
    (0..t.vertex_count() as u32).filter_map(valence).collect()
}

/// The connected pieces, as the lowest vertex of each vertex's piece.
fn pieces(mesh: &ControlMesh) -> Vec<u32> {
    let mut piece: Vec<u32> = (0..mesh.points.len() as u32).collect();
    loop {
        let before = piece.clone();
        for face in mesh.faces.iter() {
            let least = face.iter().map(|&v| piece[v as usize]).min().unwrap();
            face.iter().for_each(|&v| piece[v as usize] = least);
        }
        if piece == before {
            return piece;
        }
    }
}

/// Signed volume of the cage, faces cut into fans; of one piece, or of all.
fn volume(mesh: &ControlMesh, of: impl Fn(u32) -> bool) -> f64 {
    let at = |v: u32| mesh.points[v as usize];
    let cone = |a: Vec3, b: Vec3, c: Vec3| a.dot(b.cross(c)) / 6.0;
    let faces = mesh.faces.iter().filter(|face| of(face[0]));
    faces.flat_map(|face| (2..face.len()).map(|k| cone(at(face[0]), at(face[k - 1]), at(face[k])))).sum()
}

#[test]
fn no_model_has_a_defect() {
    for model in all() {
        assert_eq!(check(&model.mesh), [], "{}", model.name);
    }
}

#[test]
fn files_are_what_the_generator_writes() {
    for model in all() {
        let path = folder().join(model.name).with_extension("obj");
        let file = std::fs::read_to_string(&path).unwrap();
        assert!(file == write::to_obj(&model).unwrap(), "{}: run `cargo run -p xtask -- models`", model.name);
    }
    for model in networks() {
        let path = folder().join(model.name).with_extension("json");
        let file = std::fs::read_to_string(&path).unwrap();
        assert!(
            file == write::to_json(&model).unwrap(),
            "{}: run `cargo run -p xtask -- models`",
            model.name
        );
        let read = ogee_formats::network::read(file.as_bytes(), ogee_formats::network::NetworkFormat::Json);
        assert_eq!(read.unwrap().network, model.network, "{}", model.name);
    }
    let files = std::fs::read_dir(folder()).unwrap().count();
    assert_eq!(files, all().len() + networks().len(), "files that no model writes");
}

#[test]
fn curves_of_models_lie_on_their_surfaces() {
    for model in networks() {
        let embedding = ogee::curve_network::embed(&model.network, &model.mesh).unwrap();
        let figures = embedding.measure().unwrap();
        let size = model.mesh.size();
        assert!(figures.errors.iter().all(|&error| error < 1e-12 * size), "{}", model.name);
        assert!(
            figures.meetings.iter().all(|meeting| meeting.normal_spread_deg < Some(0.01)),
            "{}",
            model.name
        );
        // The lines are turned where they meet, by little.
        let worst = embedding.warnings.iter().filter_map(|warning| warning.value()).fold(0.0, f64::max);
        assert!(worst < 3.0, "{}: {:?}", model.name, embedding.warnings);
    }
}

#[test]
fn forms_are_as_promised() {
    for model in all() {
        let t = Topology::new(&model.mesh).unwrap();
        let open = (0..t.vertex_count() as u32).any(|v| t.is_boundary(VertexId(v)));
        let piece = pieces(&model.mesh);
        let roots: BTreeSet<u32> = piece.iter().copied().collect();
        match model.form {
            Form::Open => assert!(open, "{}", model.name),
            Form::Closed { pieces, genus } => {
                assert!(!open, "{}", model.name);
                assert_eq!(roots.len(), pieces, "{}", model.name);
                let euler = t.vertex_count() + t.face_count();
                assert_eq!(euler + 2 * genus, t.edge_count() + 2 * pieces, "{}", model.name);
                assert!(volume(&model.mesh, |_| true) > 0.0, "{}", model.name);
            }
        }
    }
}

#[test]
fn valences_are_what_the_converter_takes() {
    for model in all() {
        let valences = valences(&model);
        let least = if model.name == "urchin" { 2 } else { 3 };
        assert!(valences.first() >= Some(&least), "{}: {valences:?}", model.name);
    }
}

#[test]
fn sharpness_is_whole() {
    for model in all() {
        for crease in &model.mesh.creases {
            let value = crease.sharpness.value();
            assert!([1.0, 2.0, 3.0, f64::INFINITY].contains(&value), "{}: {value}", model.name);
        }
    }
}

fn named(name: &str) -> Model {
    all().into_iter().find(|model| model.name == name).unwrap()
}

#[test]
fn the_knot_is_regular() {
    assert_eq!(valences(&named("knot")), BTreeSet::from([4]));
}

#[test]
fn the_stars_have_every_valence() {
    assert_eq!(valences(&named("stars")), (3..=12).collect());
}

#[test]
fn extraordinary_vertices_of_the_hand_touch() {
    let hand = named("hand");
    assert_eq!(valences(&hand), (3..=6).collect());
    let t = Topology::new(&hand.mesh).unwrap();
    let is_six = |v: VertexId| t.valence(v) == Valence::Interior(6);
    let touching = t.edge_halfedges().filter(|&h| is_six(t.origin(h)) && is_six(t.target(h)));
    // Three between fingers, four along their roots in front and behind.
    assert_eq!(touching.count(), 7);
}

#[test]
fn the_hollow_of_the_bauble_faces_inward() {
    let mesh = named("bauble").mesh;
    let piece = pieces(&mesh);
    let volumes: Vec<f64> = BTreeSet::from_iter(piece.iter().copied())
        .into_iter()
        .map(|root| volume(&mesh, |v| piece[v as usize] == root))
        .collect();
    assert!(volumes.len() == 2 && volumes[0] > -volumes[1] && volumes[1] < 0.0, "{volumes:?}");
}

#[test]
fn the_box_is_exact() {
    let mesh = named("box").mesh;
    assert_eq!(mesh.faces.len(), 108);
    assert!((volume(&mesh, |_| true) - 72_000.0).abs() < 1e-9);
}
