//! Any list of faces is either refused with every defect named, or can be refined and converted; nothing panics and
//! no NaN comes out.

mod cages;

use cages::{scheme, tag};
use ogee::convert::{ConvertError, Method, Options, Packing, to_part};
use ogee::{ControlMesh, FaceList, Level, Vec3, limit_vertices, shapes};
use proptest::collection::vec;
use proptest::prelude::*;

fn points(count: usize) -> impl Strategy<Value = Vec<Vec3>> {
    vec((-4i32..5, -4i32..5, -4i32..5), count).prop_map(|points| {
        points.into_iter().map(|(x, y, z)| Vec3::new(f64::from(x), f64::from(y), f64::from(z))).collect()
    })
}

/// Faces thrown together: mostly refused.
fn any_mesh() -> impl Strategy<Value = ControlMesh> {
    (points(9), vec(vec(0u32..10, 0..6), 0..8)).prop_map(|(points, faces)| {
        let mut list = FaceList::new();
        faces.iter().for_each(|face| list.push(face));
        ControlMesh::new(points, list)
    })
}

/// Sound connectivity with any points (so degenerate geometry), any tags, some faces taken away.
fn tagged_mesh() -> impl Strategy<Value = ControlMesh> {
    let base = prop_oneof![
        Just(shapes::cube()),
        Just(shapes::grid(3, 3)),
        Just(shapes::disk(3, 2)),
        Just(shapes::disk(5, 1)),
        Just(shapes::disk(6, 1)),
        Just(shapes::torus(3, 3)),
    ];
    let sharpness = prop_oneof![Just(10.0), Just(1.0), Just(0.5), Just(2.5), Just(0.0)];
    let tags = vec((any::<prop::sample::Index>(), sharpness), 0..6);
    (base, tags.clone(), tags, vec(any::<prop::sample::Index>(), 0..3), scheme(), points(64), 0..3u8)
        .prop_map(|(mut mesh, creases, corners, holes, scheme, moved, kind)| {
            tag(&mut mesh, creases, corners);
            mesh.scheme = scheme;
            match kind {
                0 => mesh.holes = holes.iter().map(|hole| hole.index(mesh.faces.len()) as u32).collect(),
                1 => {
                    let gone: Vec<usize> = holes.iter().map(|hole| hole.index(mesh.faces.len())).collect();
                    let kept = mesh.faces.iter().enumerate().filter(|(f, _)| !gone.contains(f));
                    let mut faces = FaceList::new();
                    kept.for_each(|(_, face)| faces.push(face));
                    mesh.faces = faces;
                    mesh.creases.clear();
                }
                _ => {
                    let count = mesh.points.len().min(moved.len());
                    mesh.points[..count].copy_from_slice(&moved[..count]);
                }
            }
            mesh
        })
}

fn try_everything(mesh: &ControlMesh) {
    let level = match Level::new(mesh) {
        Ok(level) => level,
        Err(error) => {
            assert!(!error.defects.is_empty());
            return;
        }
    };
    let refined = level.refine().stencils.apply(&mesh.points);
    let (finer, by_points) = level.refine_points(&mesh.points);
    for (a, b) in refined.iter().zip(&by_points) {
        assert!(a.distance(*b) <= 1e-12 && a.is_finite());
    }
    for limit in limit_vertices(&finer, &by_points) {
        assert!(limit.position.is_finite() && limit.normal.is_none_or(Vec3::is_finite));
    }
    for method in [Method::Pccm, Method::PccmFirst, Method::Bi5] {
        for packing in [Packing::Packed, Packing::Unpacked] {
            match to_part(mesh, &Options { method, packing, ..Options::default() }) {
                Ok(part) => {
                    let report = &part.report;
                    assert!(report.area.is_finite() && report.max_deviation.is_finite());
                    assert!(report.max_gap <= 1e-11 * mesh.size().max(1.0), "gap {:e}", report.max_gap);
                    let points =
                        part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces);
                    assert!(points.flat_map(|face| face.surface.net.cells()).all(|p| p.is_finite()));
                }
                Err(ConvertError::Topology(_)) => panic!("a level could be built"),
                Err(_) => {}
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_faces(mesh in any_mesh()) {
        try_everything(&mesh);
    }

    #[test]
    fn any_tags(mesh in tagged_mesh()) {
        try_everything(&mesh);
    }
}
