//! The cages of the benchmarks are what their tables say: quads, manifold, with valences from 3 to 6, closed, or open
//! with creases and corners of every sharpness.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ogee::{ControlMesh, Level, Sharpness, VertexId};
use ogee_bench_cages::gyroid;

/// How many interior vertices have each valence.
fn valences(level: &Level) -> [usize; 8] {
    let topology = level.topology();
    let mut counts = [0; 8];
    for v in (0..topology.vertex_count() as u32).map(VertexId).filter(|&v| !topology.is_boundary(v)) {
        counts[topology.valence(v).edges() as usize] += 1;
    }
    counts
}

/// The level of a mesh of quads; that there is one says that the mesh is manifold and faces agree on what is outside.
fn level(mesh: &ControlMesh) -> Level {
    assert!(mesh.faces.iter().all(|face| face.len() == 4));
    Level::new(mesh).unwrap()
}

#[test]
fn closed_cages_have_valences_3_to_6() {
    for (cage, faces) in [(gyroid::SMALL, 1_728), (gyroid::MEDIUM, 106_530)] {
        let mesh = cage.closed();
        assert_eq!(mesh.faces.len(), faces);
        let level = level(&mesh);
        let topology = level.topology();
        assert!(topology.edge_halfedges().all(|h| topology.twin(h).is_some()));
        let counts = valences(&level);
        assert!(counts[3..=6].iter().all(|&count| count > 0), "{counts:?}");
        assert_eq!(counts[3..=6].iter().sum::<usize>(), mesh.points.len());
    }
}

#[test]
fn the_open_cage_has_a_boundary_creases_and_corners() {
    let mesh = gyroid::OPEN.open();
    assert_eq!(mesh.faces.len(), 109_034);
    let level = level(&mesh);
    let topology = level.topology();
    let boundary = topology.edge_halfedges().filter(|&h| topology.twin(h).is_none()).count();
    assert!(boundary > 1_000);
    // One edge in twenty, and a vertex in some hundreds.
    assert!(20 * mesh.creases.len() > topology.edge_count());
    assert!(500 * mesh.corners.len() > mesh.points.len());
    assert!(valences(&level)[3..=6].iter().all(|&count| count > 0));
    for sharpness in [0.5, 1.0, 1.5, 2.0, 3.0].map(Sharpness::Finite).into_iter().chain([Sharpness::Infinite])
    {
        assert!(mesh.creases.iter().any(|crease| crease.sharpness == sharpness), "{sharpness:?}");
        assert!(mesh.corners.iter().any(|corner| corner.sharpness == sharpness), "{sharpness:?}");
    }
}

#[test]
fn the_large_cage_has_its_size() {
    assert_eq!(gyroid::LARGE.closed().faces.len(), 1_124_884);
}

#[test]
fn cages_are_the_same_every_time() {
    assert_eq!(gyroid::SMALL.closed(), gyroid::SMALL.closed());
    assert_eq!(gyroid::SMALL.open(), gyroid::SMALL.open());
}
