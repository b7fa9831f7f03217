//! Limit positions and normals at the vertices of refined cages, against the limit samples of `testdata/opensubdiv`
//! that stand at dyadic parameters.

mod golden;

use golden::{cage, documents, index, list, number, point};
use ogee::{FaceId, Level, Refinement, limit_vertices};

const POSITION: f64 = 1e-12;
const NORMAL: f64 = 1e-8;

#[test]
fn limit_masks_match() {
    let (mut positions, mut normals) = (0, 0);
    for (name, document) in documents("opensubdiv") {
        let mesh = cage(&document["cage"], &document["options"]);
        let level = Level::new(&mesh).unwrap();
        let tags = || list(&document["cage"]["creases"]).iter().chain(list(&document["cage"]["corners"]));
        // Sharpness in binary32 on their side.
        let slack = if tags().any(|tag| number(&tag["sharpness"]).fract() != 0.0) { 1e5 } else { 1.0 };
        let refinement = Refinement::uniform(&level, 3).unwrap();
        let points = refinement.apply(&mesh.points);
        let limits = limit_vertices(refinement.finest(), &points);
        for sample in list(&document["limit"]) {
            let ptex = &document["ptex_faces"][index(&sample["ptex"]) as usize];
            let corner = ptex[1].as_i64().unwrap();
            let grid = refinement.grid(FaceId(index(&ptex[0])), (corner >= 0).then_some(corner as u32));
            let side = (grid.rows() - 1) as f64;
            let (i, j) = (number(&sample["u"]) * side, number(&sample["v"]) * side);
            if i.fract() != 0.0 || j.fract() != 0.0 {
                continue;
            }
            let ours = limits[grid[(i as usize, j as usize)].index()];
            let gap = ours.position.distance(point(&sample["p"]));
            assert!(gap <= POSITION * slack, "{name} {ptex} ({i}, {j}): {gap:e}");
            positions += 1;
            // On a crease ours is the mean of both sides.
            let tagged = tags().next().is_some();
            if let (false, false, Some(normal)) = (tagged, sample["n"].is_null(), ours.normal) {
                let gap = normal.distance(point(&sample["n"]));
                assert!(gap <= NORMAL, "{name} {ptex} ({i}, {j}): normal {gap:e}");
                normals += 1;
            }
        }
    }
    println!("{positions} positions, {normals} normals");
    assert!(positions > 100 && normals > 50);
}
