//! Evaluation against the limit samples of `testdata/opensubdiv`, derivatives included.

mod golden;

use golden::{cage, documents, index, list, number, point};
use ogee::{FaceId, Flags, Level, LimitSurface, PatchTable, Vec3};
use serde_json::Value;

/// Largest differences, as the notes of the data give them.
const POSITION: f64 = 1e-12;
const FIRST: f64 = 1e-10;
/// Of the longest second derivative.
const SECOND: f64 = 1e-8;
const NORMAL: f64 = 1e-9;
const NORMAL_AT_SINGULAR: f64 = 1e-8;

fn gap<const N: usize>(ours: [Vec3; N], theirs: [&Value; N]) -> f64 {
    ours.iter().zip(theirs).map(|(a, b)| a.distance(point(b))).fold(0.0, f64::max)
}

#[test]
fn samples_match() {
    let (mut regular, mut singular) = (0, 0);
    for (name, document) in documents("opensubdiv") {
        let mesh = cage(&document["cage"], &document["options"]);
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let mut worst = [0.0f64; 4];
        for sample in list(&document["limit"]) {
            let ptex = &document["ptex_faces"][index(&sample["ptex"]) as usize];
            let corner = ptex[1].as_i64().unwrap();
            let (u, v) = (number(&sample["u"]), number(&sample["v"]));
            let face = FaceId(index(&ptex[0]));
            let at = table.locate(face, (corner >= 0).then_some(corner as u32), u, v).unwrap();
            let got = surface.jet(at);
            let place = format!("{name} {ptex} ({u}, {v})");
            let mut check = |which: usize, gap: f64, tolerance: f64| {
                assert!(gap <= tolerance, "{place}: {gap:e} in {}", ["p", "d", "dd", "n"][which]);
                worst[which] = worst[which].max(gap);
            };
            check(0, gap([got.jet.position], [&sample["p"]]), POSITION);
            if sample["singular"].as_bool() == Some(true) {
                if !sample["n"].is_null() && !got.flags.contains(Flags::NORMAL_ONE_SIDED) {
                    check(3, gap([got.normal], [&sample["n"]]), NORMAL_AT_SINGULAR);
                    singular += 1;
                }
                continue;
            }
            check(1, gap([got.jet.du, got.jet.dv], [&sample["du"], &sample["dv"]]), FIRST);
            let theirs = [&sample["duu"], &sample["duv"], &sample["dvv"]];
            let longest = theirs.iter().map(|d| point(d).length()).fold(1.0, f64::max);
            let seconds = gap([got.jet.duu, got.jet.duv, got.jet.dvv], theirs) / longest;
            check(2, seconds, SECOND);
            check(3, gap([got.normal], [&sample["n"]]), NORMAL);
            regular += 1;
        }
        let [p, d, dd, n] = worst;
        println!("{name}: {p:.1e}, first {d:.1e}, second {dd:.1e}, normals {n:.1e}");
    }
    println!("{regular} samples, {singular} normals at singular corners");
    assert!(regular > 350 && singular > 20);
}
