//! Whatever a cage looks like, evaluation gives numbers, and normals that are unit vectors or flagged.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{scheme, tagged};
use ogee::{ControlMesh, Derivatives, FaceList, Flags, Level, LimitSurface, Location, PatchTable, Vec3};
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

/// Faces thrown together: mostly refused.
fn any_mesh() -> impl Strategy<Value = ControlMesh> {
    (points(9), vec(vec(0u32..9, 3..6), 1..6), scheme()).prop_map(|(points, faces, scheme)| {
        let mut list = FaceList::new();
        faces.iter().for_each(|face| list.push(face));
        ControlMesh { scheme, ..ControlMesh::new(points, list) }
    })
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
    fn any_tags(mesh in tagged(points(64))) {
        try_everything(&mesh);
    }
}
