//! Figures 11 and 12: connectivity, points and tags after re-meshing.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod lens_nets;

use golden::{faces, index, list};
use lens_nets::{document, exact_points, mirrored, pair, single_lens};
use ogee::lens::{
    Averaging, LensNet, Remesh, Remeshed, Symmetry, detect, lattice_index, lattice_point, remesh,
};
use ogee::{
    ControlMesh, Corner, Crease, FaceId, FaceVarying, FaceVaryingRule, Level, Sharpness, Topology, Valence,
    Vec3, VertexId,
};
use proptest::prelude::*;
use serde_json::Value;

const ALL: [Remesh; 4] = [
    Remesh::RemoveCentre,
    Remesh::Identify,
    Remesh::Merge(Averaging::Axis),
    Remesh::Merge(Averaging::Cluster),
];

/// The name of the new points among the samples.
fn sample(how: Remesh) -> Option<&'static str> {
    match how {
        Remesh::RemoveCentre => None,
        Remesh::Identify => Some("fig11_left_new"),
        Remesh::Merge(Averaging::Axis) => Some("fig12_axis_new"),
        Remesh::Merge(Averaging::Cluster) => Some("fig12_cluster_new"),
    }
}

fn net25() -> [Vec3; 25] {
    exact_points(&document("samples_lens")["net25"]).try_into().unwrap()
}

/// The faces, each beginning at its least vertex, in order.
fn normalized<'a>(faces: impl Iterator<Item = &'a [u32]>) -> Vec<Vec<u32>> {
    let mut list: Vec<Vec<u32>> = faces
        .map(|face| {
            let least = (0..face.len()).min_by_key(|&k| face[k]).unwrap();
            (0..face.len()).map(|k| face[(least + k) % face.len()]).collect()
        })
        .collect();
    list.sort();
    list
}

/// The faces of a new cage in the ids of the old one; of two that became one vertex the one with the lower id counts.
fn in_old_ids(result: &Remeshed) -> Vec<Vec<u32>> {
    let mut old = vec![u32::MAX; result.mesh.points.len()];
    for (v, new) in result.vertices.iter().enumerate() {
        if let Some(new) = new {
            old[new.index()] = old[new.index()].min(v as u32);
        }
    }
    let faces: Vec<Vec<u32>> =
        result.mesh.faces.iter().map(|face| face.iter().map(|&v| old[v as usize]).collect()).collect();
    normalized(faces.iter().map(Vec::as_slice))
}

fn listed(value: &Value) -> Vec<Vec<u32>> {
    let faces = faces(value);
    normalized(faces.iter())
}

fn new_id(result: &Remeshed, old: u32) -> VertexId {
    result.vertices[old as usize].unwrap()
}

#[test]
fn faces_valences_and_points_are_those_of_the_tables() {
    let (connectivity, samples) = (document("remesh_connectivity"), document("samples_lens"));
    let mesh = ControlMesh::new(net25().to_vec(), faces(&connectivity["original_faces"]));
    for how in ALL {
        let result = remesh(&mesh, &[VertexId(0)], how).unwrap();
        let name = if how == Remesh::RemoveCentre { "remove_centre" } else { "merge" };
        assert_eq!(in_old_ids(&result), listed(&connectivity[format!("{name}_faces")]), "{how:?}");
        let topology = Topology::new(&result.mesh).unwrap();
        for (old, valence) in connectivity[format!("{name}_valence")].as_object().unwrap() {
            let v = new_id(&result, old.parse().unwrap());
            assert_eq!(topology.valence(v), Valence::Interior(index(valence)), "{how:?}, vertex {old}");
        }
        for old in 5..25 {
            let (new, point) = (new_id(&result, old), mesh.points[old as usize]);
            assert_eq!(result.mesh.points[new.index()], point, "layers 2 and 3 stay, bit for bit");
        }
        let wanted = sample(how).map_or(Value::Null, |name| samples[name].clone());
        for (old, point) in wanted.as_object().into_iter().flatten() {
            let found = result.mesh.points[new_id(&result, old.parse().unwrap()).index()];
            let wanted = exact_points(&Value::Array(vec![point.clone()]))[0];
            assert!(found.distance(wanted) < 1e-12 * mesh.size(), "{how:?}, point {old}");
        }
        let moved = (1..5)
            .filter(|&old| result.mesh.points[new_id(&result, old).index()] != mesh.points[old as usize]);
        assert_eq!(
            moved.count(),
            [0, 2, 4]
                [usize::from(how != Remesh::RemoveCentre) + usize::from(matches!(how, Remesh::Merge(_)))]
        );
    }
}

#[test]
fn two_lenses_of_a_pair_are_merged_at_once() {
    let document = document("mesh_pair_m4");
    let mesh = ControlMesh::new(golden::points(&document["vertices"]), faces(&document["faces"]));
    let result = remesh(&mesh, &[VertexId(0), VertexId(4)], Remesh::Merge(Averaging::Axis)).unwrap();
    assert_eq!(in_old_ids(&result), listed(&document["fig12_axis_faces"]));
    let changed = document["fig12_axis_changed"].as_object().unwrap();
    for (old, point) in changed {
        let found = result.mesh.points[new_id(&result, old.parse().unwrap()).index()];
        assert!(found.distance(golden::point(point)) < 1e-12 * mesh.size(), "point {old}");
    }
    let deleted: Vec<u32> = list(&document["fig12_axis_deleted"]).iter().map(index).collect();
    for (v, new) in (0..).zip(&result.vertices) {
        // The two that were identified have the number of the one that stays.
        let expected = match v {
            0 | 4 => None,
            5 => result.vertices[1],
            9 => result.vertices[3],
            _ => Some(VertexId(v - deleted.iter().filter(|&&d| d < v).count() as u32)),
        };
        assert_eq!(*new, expected, "vertex {v}");
        if !changed.contains_key(&v.to_string()) && !deleted.contains(&v) {
            assert_eq!(result.mesh.points[new.unwrap().index()], mesh.points[v as usize]);
        }
    }
    let topology = Topology::new(&result.mesh).unwrap();
    let count = |n: u32| {
        let vertices = (0..topology.vertex_count() as u32).map(VertexId);
        vertices.filter(|&v| topology.valence(v) == Valence::Interior(n)).count()
    };
    let valences = &document["fig12_axis_interior_valences"];
    assert_eq!(
        [count(3), count(4), count(2)],
        [index(&valences["3"]) as usize, index(&valences["4"]) as usize, 0]
    );
}

#[test]
fn tags_and_faces_follow_their_vertices() {
    let mut mesh = single_lens(6);
    let sharp = |a: u32, b: u32| Crease { vertices: [a, b], sharpness: Sharpness::Finite(2.0) };
    mesh.creases = vec![sharp(30, 29), Crease { vertices: [0, 1], sharpness: Sharpness::Finite(0.0) }];
    mesh.corners = vec![Corner { vertex: 40, sharpness: Sharpness::Infinite }];
    mesh.holes = vec![50];
    for how in ALL {
        let result = remesh(&mesh, &[VertexId(0)], how).unwrap();
        let renamed = |v: u32| new_id(&result, v).0;
        assert_eq!(result.mesh.creases, [sharp(renamed(30), renamed(29))], "{how:?}");
        assert_eq!(result.mesh.corners[0].vertex, renamed(40));
        assert_eq!(result.mesh.holes, [result.faces[50].unwrap().0]);
        for (f, face) in mesh.faces.iter().enumerate() {
            let renamed: Option<Vec<u32>> =
                face.iter().map(|&v| result.vertices[v as usize].map(|new| new.0)).collect();
            match (result.faces[f], renamed) {
                (Some(new), Some(renamed)) => assert_eq!(result.mesh.faces.face(new.index()), renamed),
                (Some(_), None) => assert_eq!(how, Remesh::RemoveCentre),
                (None, _) => assert!(how != Remesh::RemoveCentre && face.contains(&0)),
            }
        }
    }
}

#[test]
fn texture_coordinates_follow_the_points() {
    let mut mesh = single_lens(4);
    // Texture coordinates that are a linear map of the points stay one, as long as there is no seam.
    let texture = |p: Vec3| [0.25 * p.x - p.y + 0.5, p.z + 2.0 * p.y];
    let values: Vec<[f64; 2]> = mesh.points.iter().map(|&p| texture(p)).collect();
    let uv = FaceVarying { values, indices: mesh.faces.corners().to_vec(), rule: FaceVaryingRule::None };
    mesh.uv = Some(uv);
    for how in ALL {
        let result = remesh(&mesh, &[VertexId(0)], how).unwrap();
        let uv = result.mesh.uv.as_ref().unwrap();
        assert_eq!(uv.indices.len(), result.mesh.faces.corners().len());
        for (&v, &i) in result.mesh.faces.corners().iter().zip(&uv.indices) {
            let (wanted, found) = (texture(result.mesh.points[v as usize]), uv.values[i as usize]);
            assert!((0..2).all(|k| (wanted[k] - found[k]).abs() < 1e-12), "{how:?}, vertex {v}");
        }
        Level::new(&result.mesh).unwrap();
    }
    // A seam: one corner of one face has a value of its own.
    let mut cut = mesh.clone();
    let uv = cut.uv.as_mut().unwrap();
    uv.values.push([7.0, 7.0]);
    let corner = cut.faces.corners().iter().rposition(|&v| v == 2).unwrap();
    uv.indices[corner] = uv.values.len() as u32 - 1;
    let result = remesh(&cut, &[VertexId(0)], Remesh::default()).unwrap();
    let values = &result.mesh.uv.as_ref().unwrap().values;
    assert_eq!(values.len(), cut.points.len() + 1, "no value is made");
}

#[test]
fn what_cannot_be_done_is_refused() {
    let code = |mesh: &ControlMesh, lenses: &[u32]| {
        let lenses: Vec<VertexId> = lenses.iter().map(|&v| VertexId(v)).collect();
        ALL.map(|how| remesh(mesh, &lenses, how).unwrap_err().code())
    };
    assert_eq!(code(&single_lens(4), &[1]), ["not_a_lens"; 4]);
    assert_eq!(code(&single_lens(4), &[400]), ["not_a_lens"; 4]);
    assert_eq!(code(&single_lens(2), &[0]), ["blocked"; 4]);
    assert_eq!(code(&single_lens(4), &[0, 0]), ["named_twice"; 4]);
    let mut sharp = single_lens(4);
    sharp.creases = vec![Crease { vertices: [2, 6], sharpness: Sharpness::Infinite }];
    assert_eq!(code(&sharp, &[0]), ["blocked"; 4]);
    sharp.creases[0].vertices = [2, 16];
    assert_eq!(code(&sharp, &[0]), ["crease_off_edge"; 4]);
    // Both ends of a slit of three edges can go; at two they share a vertex, and are in each other's way.
    for how in ALL {
        let result = remesh(&pair(3, 4), &[VertexId(0), VertexId(3)], how).unwrap();
        assert!(detect(&Level::new(&result.mesh).unwrap()).unwrap().lenses.is_empty());
    }
    assert_eq!(code(&pair(2, 4), &[0, 2]), ["blocked"; 4]);
}

#[test]
fn symmetric_nets_stay_symmetric() {
    for symmetry in [Symmetry::Rotation, Symmetry::MirrorX, Symmetry::MirrorY] {
        let image = |p| mirrored(symmetry, p);
        let net = net25();
        let net = std::array::from_fn(|k| (net[k] + image(net[symmetry.image(k)])) / 2.0);
        for how in ALL {
            let values = how.new_values(&net);
            let at = |k: usize| values.iter().find(|value| value.0 == k).map(|value| value.1);
            for &(number, value) in &values {
                // Point 3 has become point 1.
                let partner = if number == 1 { 1 } else { symmetry.image(number) };
                assert!(image(at(partner).unwrap()).distance(value) < 1e-13 * 300.0, "{how:?} {symmetry:?}");
            }
        }
    }
}

proptest! {
    #[test]
    fn new_points_are_affine_combinations(
        coordinates in prop::collection::vec(-10.0..10.0, 75),
        matrix in prop::array::uniform9(-2.0..2.0_f64),
        shift in prop::array::uniform3(-50.0..50.0_f64),
    ) {
        let net: [Vec3; 25] = std::array::from_fn(|k| {
            Vec3::new(coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2])
        });
        let [a, b, c] = [0, 3, 6].map(|k| Vec3::new(matrix[k], matrix[k + 1], matrix[k + 2]));
        let moved = |p: Vec3| Vec3::new(a.dot(p), b.dot(p), c.dot(p)) + Vec3::from(shift);
        for how in ALL {
            let direct = how.new_values(&net.map(moved));
            for ((number, value), (_, after)) in how.new_values(&net).into_iter().zip(direct) {
                prop_assert!(moved(value).distance(after) < 1e-11, "{:?} {}", how, number);
            }
        }
    }

    #[test]
    fn numbering_does_not_matter(keys in prop::collection::vec(any::<u32>(), 61), turn in 0..4_usize) {
        let mesh = single_lens(5);
        let count = mesh.points.len();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&v| (keys[v % keys.len()].wrapping_mul(v as u32 + 1), v));
        let mut new = vec![0_u32; count];
        for (at, &v) in order.iter().enumerate() {
            new[v] = at as u32;
        }
        let renumbered = ControlMesh::new(
            order.iter().map(|&v| mesh.points[v]).collect(),
            mesh.faces.iter().map(|f| std::array::from_fn::<u32, 4, _>(|k| new[f[(k + turn) % 4] as usize])).collect(),
        );
        let topology = Topology::new(&renumbered).unwrap();
        let net = LensNet::new(&topology, VertexId(new[0])).unwrap().unwrap();
        // Up to half a turn, which the lower of two ids decides.
        let turned = new[3] < new[1];
        for (number, v) in net.vertices.iter().enumerate() {
            let (i, j) = lattice_point(number);
            let original = if turned { lattice_index(-j, i) } else { number };
            prop_assert_eq!(v.0, new[original]);
        }
        for how in ALL {
            let plain = remesh(&mesh, &[VertexId(0)], how).unwrap();
            let other = remesh(&renumbered, &[VertexId(new[0])], how).unwrap();
            prop_assert_eq!(plain.mesh.faces.len(), other.mesh.faces.len());
            for v in 1..count {
                let (a, b) = (new_id(&plain, v as u32), new_id(&other, new[v]));
                let distance = plain.mesh.points[a.index()].distance(other.mesh.points[b.index()]);
                prop_assert!(distance < 1e-11, "{:?}, vertex {}: {}", how, v, distance);
            }
            let map = |f: usize| (plain.faces[f].is_some(), other.faces[f].is_some());
            prop_assert!((0..mesh.faces.len()).all(|f| map(f).0 == map(f).1));
            prop_assert!(other.faces.iter().flatten().all(|f| *f <= FaceId(other.mesh.faces.len() as u32)));
        }
    }
}
