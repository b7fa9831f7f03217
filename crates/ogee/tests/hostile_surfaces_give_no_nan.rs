//! Whatever a cage looks like, evaluation gives numbers, and normals that are unit vectors or flagged.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ogee::{
    Boundary, ControlMesh, Corner, Crease, Creasing, Derivatives, FaceList, Flags, Level, LimitSurface,
    Location, PatchTable, Scheme, Sharpness, Vec3, shapes,
};
use proptest::collection::vec;
use proptest::prelude::*;

/// Small whole coordinates coincide and line up often.
fn points(count: usize) -> impl Strategy<Value = Vec<Vec3>> {
    let scale = prop_oneof![4 => Just(1.0), 1 => Just(1e150), 1 => Just(1e-150), 1 => Just(0.0)];
    (vec((-2i32..3, -2i32..3, -2i32..3), count), scale, any::<bool>()).prop_map(|(points, scale, flat)| {
        let point = |(x, y, z): (i32, i32, i32)| {
            let z = if flat { 0 } else { z };
            scale * Vec3::new(f64::from(x), f64::from(y), f64::from(z))
        };
        points.into_iter().map(point).collect()
    })
}

fn scheme() -> impl Strategy<Value = Scheme> {
    let boundary = prop_oneof![Just(Boundary::EdgeAndCorner), Just(Boundary::EdgeOnly), Just(Boundary::None)];
    let creasing = prop_oneof![Just(Creasing::Uniform), Just(Creasing::Chaikin)];
    (boundary, creasing).prop_map(|(boundary, creasing)| Scheme { boundary, creasing })
}

fn sharpness() -> impl Strategy<Value = f64> {
    prop_oneof![Just(10.0), Just(1.0), Just(0.5), Just(2.5), Just(9.9), Just(1e-300)]
}

/// Faces thrown together: mostly refused.
fn any_mesh() -> impl Strategy<Value = ControlMesh> {
    (points(9), vec(vec(0u32..9, 3..6), 1..6), scheme()).prop_map(|(points, faces, scheme)| {
        let mut list = FaceList::new();
        faces.iter().for_each(|face| list.push(face));
        ControlMesh { scheme, ..ControlMesh::new(points, list) }
    })
}

/// A wheel: `n` triangles around a vertex, or a fan if it is left open.
fn wheel(n: u32, open: bool) -> ControlMesh {
    let mut list = FaceList::new();
    for k in 0..n - u32::from(open) {
        list.push(&[0, 1 + k, 1 + (k + 1) % n]);
    }
    ControlMesh::new(vec![Vec3::ZERO; n as usize + 1], list)
}

/// Sound connectivity with any points, any tags, some faces taken away.
fn tagged_mesh() -> impl Strategy<Value = ControlMesh> {
    let base = prop_oneof![
        Just(shapes::cube()),
        Just(shapes::grid(3, 3)),
        (3u32..9).prop_map(|n| shapes::disk(n, 1)),
        Just(shapes::disk(3, 2)),
        Just(shapes::torus(3, 3)),
        (3u32..9, any::<bool>()).prop_map(|(n, open)| wheel(n, open)),
    ];
    let tags = || vec((any::<prop::sample::Index>(), sharpness()), 0..7);
    let gone = vec(any::<prop::sample::Index>(), 0..3);
    (base, tags(), tags(), gone, scheme(), points(64), 0..3u8).prop_map(
        |(mut mesh, creases, corners, gone, scheme, moved, kind)| {
            mesh.scheme = scheme;
            let gone: Vec<usize> = gone.iter().map(|face| face.index(mesh.faces.len())).collect();
            match kind {
                0 => mesh.holes = gone.iter().map(|&hole| hole as u32).collect(),
                1 if gone.len() < mesh.faces.len() => {
                    let kept = mesh.faces.iter().enumerate().filter(|(f, _)| !gone.contains(f));
                    let mut faces = FaceList::new();
                    kept.for_each(|(_, face)| faces.push(face));
                    mesh.faces = faces;
                }
                _ => {}
            }
            let edges: Vec<[u32; 2]> = mesh
                .faces
                .iter()
                .flat_map(|face| {
                    (0..face.len()).map(|k| [face[k], face[(k + 1) % face.len()]]).collect::<Vec<_>>()
                })
                .collect();
            for (which, sharpness) in creases {
                let vertices = edges[which.index(edges.len())];
                mesh.creases.push(Crease { vertices, sharpness: Sharpness::from_value(sharpness) });
            }
            for (which, sharpness) in corners {
                let vertex = which.index(mesh.points.len()) as u32;
                mesh.corners.push(Corner { vertex, sharpness: Sharpness::from_value(sharpness) });
            }
            for (point, moved) in mesh.points.iter_mut().zip(moved) {
                *point = moved;
            }
            mesh
        },
    )
}

fn assert_sane(what: &str, mesh: &ControlMesh, normal: Vec3, flags: Flags) {
    let undefined = flags.contains(Flags::NORMAL_UNDEFINED);
    if undefined {
        assert_eq!(normal, Vec3::ZERO, "{what} {mesh:?}");
    } else {
        assert!((normal.length() - 1.0).abs() < 1e-12, "{what}: {normal:?} {flags:?} {mesh:?}");
    }
}

/// Second derivatives grow towards an extraordinary vertex, in the end beyond all numbers.
fn is_sound(second: Vec3, flags: Flags) -> bool {
    let is_number = <[f64; 3]>::from(second).iter().all(|x| !x.is_nan());
    second.is_finite() || is_number && flags.contains(Flags::BEYOND_NMAX)
}

fn try_everything(mesh: &ControlMesh) {
    let Ok(level) = Level::new(mesh) else { return };
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let mut places: Vec<Location> = Vec::new();
    for number in (0..table.len()).filter(|&number| table.is_visible(number)) {
        let face = table.parametric_face(number);
        let one = 1.0 - f64::EPSILON / 2.0;
        for (u, v) in [
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 1.0),
            (0.0, 1.0),
            (0.5, 0.5),
            (0.3, 0.9),
            (0.0, 0.7),
            (1e-9, 1e-8),
            (1e-25, 1e-25),
            (5e-324, 0.0),
            (one, one),
            (1.0, 1e-30),
        ] {
            places.push(table.locate(face.face, face.corner, u, v).unwrap());
        }
    }
    for &place in &places {
        let what = format!("{place:?}");
        let point = surface.eval(place);
        let all = [point.position, point.du, point.dv, point.normal];
        assert!(all.iter().all(|v| v.is_finite()), "{what}: {point:?} {mesh:?}");
        assert_sane(&what, mesh, point.normal, point.flags);
        let full = surface.jet(place);
        let jet = full.jet;
        let all = [jet.position, jet.du, jet.dv, full.normal];
        assert!(all.iter().all(|v| v.is_finite()), "{what}: {full:?} {mesh:?}");
        let seconds = [jet.duu, jet.duv, jet.dvv];
        assert!(seconds.iter().all(|&v| is_sound(v, full.flags)), "{what}: {full:?} {mesh:?}");
        assert_sane(&what, mesh, full.normal, full.flags);
    }
    for what in [Derivatives::None, Derivatives::First, Derivatives::Second] {
        let got = surface.eval_batch(&places, what);
        let lists = [&got.position, &got.du, &got.dv, &got.normal];
        assert!(lists.into_iter().flatten().all(|v| v.is_finite()), "{mesh:?}");
        for seconds in [&got.duu, &got.duv, &got.dvv] {
            assert!(seconds.iter().zip(&got.flags).all(|(&v, &flags)| is_sound(v, flags)), "{mesh:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_faces(mesh in any_mesh()) {
        try_everything(&mesh);
    }

    #[test]
    fn any_tags(mesh in tagged_mesh()) {
        try_everything(&mesh);
    }
}
