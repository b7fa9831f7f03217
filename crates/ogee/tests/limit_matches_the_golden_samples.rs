//! Evaluation against `testdata/evaluation`: positions, derivatives, normals, curvatures, and limits at vertices.

mod cages;
mod golden;

use cages::{at_corner, faces_at};
use golden::{cage, documents, index, list, number, point};
use ogee::{FaceId, Flags, Level, LimitSurface, PatchTable, Vec3, VertexId};
use serde_json::Value;

/// Of the size of the cage.
const POSITION: f64 = 1e-12;
/// Of the largest derivative of the same order; the second one where a corner is nearer than [`NEAR`], since the data
/// were computed from absolute points, whose differences lose a digit for every digit they move together.
const DERIVATIVES: f64 = 1e-10;
const DERIVATIVES_NEAR: f64 = 1e-8;
const NEAR: f64 = 1e-4;
const NORMAL: f64 = 1e-9;
/// Of the larger principal curvature, or of one over the size of the cage.
const CURVATURE: f64 = 1e-8;

/// The largest difference of some vectors, of the longest of them.
fn relative<const N: usize>(ours: [Vec3; N], theirs: [&Value; N]) -> f64 {
    let theirs = theirs.map(point);
    let longest = theirs.iter().map(|d| d.length()).fold(f64::MIN_POSITIVE, f64::max);
    ours.iter().zip(theirs).map(|(a, b)| a.distance(b)).fold(0.0, f64::max) / longest
}

#[test]
fn samples_match() {
    let mut count = 0;
    for (name, document) in documents("evaluation") {
        let mesh = cage(&document["mesh"], &Value::Null);
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        // Positions, derivatives and those near a corner, normals, curvatures.
        let mut worst = [0.0f64; 5];
        for sample in list(&document["samples"]) {
            let (u, v) = (number(&sample["u"]), number(&sample["v"]));
            let corner = sample["subface"].as_u64().map(|corner| corner as u32);
            let at = table.locate(FaceId(index(&sample["face"])), corner, u, v).unwrap();
            let near = u.min(1.0 - u).max(v.min(1.0 - v)) < NEAR;
            let got = surface.jet(at);
            let place = format!("{name} face {} {corner:?} ({u}, {v})", sample["face"]);
            let gap = got.jet.position.distance(point(&sample["S"])) / mesh.size();
            assert!(gap <= POSITION, "{place}: position {gap:e}");
            worst[0] = worst[0].max(gap);
            let gap = relative([got.jet.du, got.jet.dv], [&sample["Su"], &sample["Sv"]]).max(relative(
                [got.jet.duu, got.jet.duv, got.jet.dvv],
                [&sample["Suu"], &sample["Suv"], &sample["Svv"]],
            ));
            let (which, tolerance) = if near { (2, DERIVATIVES_NEAR) } else { (1, DERIVATIVES) };
            assert!(gap <= tolerance, "{place}: derivatives {gap:e}");
            worst[which] = worst[which].max(gap);
            let gap = got.normal.distance(point(&sample["n"]));
            assert!(gap <= NORMAL, "{place}: normal {gap:e}");
            worst[3] = worst[3].max(gap);
            assert_eq!(got.flags, Flags::NONE, "{place}");
            count += 1;
            if near {
                // Second derivatives are mostly along the surface there: of the data's digits across it none are left.
                continue;
            }
            let theirs = ["k1", "k2", "mean", "gauss"].map(|name| number(&sample[name]));
            let curvature = got.jet.curvature().unwrap();
            let largest = theirs[0].abs().max(theirs[1].abs()).max(1.0 / mesh.size());
            let ours = [curvature.k1, curvature.k2, curvature.mean, curvature.gauss / largest];
            let theirs = [theirs[0], theirs[1], theirs[2], theirs[3] / largest];
            let gap = ours.iter().zip(theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
            assert!(gap <= CURVATURE, "{place}: curvature {gap:e}");
            worst[4] = worst[4].max(gap);
        }
        let worst = worst.map(|gap| format!("{gap:.1e}"));
        println!("{name}: position, derivatives, near, normals, curvature: {}", worst.join(" "));
    }
    assert!(count > 250, "{count}");
}

#[test]
fn limits_at_vertices_match() {
    let mut count = 0;
    for (name, document) in documents("evaluation") {
        let mesh = cage(&document["mesh"], &Value::Null);
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        for limit in list(&document["limits"]) {
            let v = VertexId(index(&limit["vertex"]));
            let [t1, t2] = [point(&limit["t1"]), point(&limit["t2"])];
            for (face, corner) in faces_at(&level, v) {
                let got = surface.eval(at_corner(&level, &table, face, corner, 0.0, 0.0));
                let gap = got.position.distance(point(&limit["limit"])) / mesh.size();
                assert!(gap <= POSITION, "{name} {v} {face}: {gap:e}");
                let gap = got.normal.distance(point(&limit["normal"]));
                assert!(gap <= NORMAL, "{name} {v} {face}: normal {gap:e}");
                assert!(got.flags.contains(Flags::AT_EXTRAORDINARY), "{name} {v}: {:?}", got.flags);
                // Two vectors that span the same plane, the same way round.
                let [ours, theirs] = [got.du.cross(got.dv), t1.cross(t2)].map(|n| n.normalized().unwrap());
                assert!(ours.distance(theirs) <= NORMAL, "{name} {v} {face}: {ours:?} {theirs:?}");
                count += 1;
            }
        }
    }
    assert!(count > 40, "{count}");
}
