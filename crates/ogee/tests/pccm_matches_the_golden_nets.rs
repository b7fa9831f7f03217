//! Control nets, knots and constants of `testdata/pccm`.

mod golden;

use golden::{cage, documents, index, list, number, points};
use ogee::Level;
use ogee::pccm::{Layer, Options, Tangents, to_patches, to_quintic_patches};

const TOLERANCE: f64 = 1e-11;

#[test]
fn control_nets_match() {
    let mut compared = 0;
    for (name, document) in documents("pccm") {
        if document["method"].as_str() != Some("pccm") {
            continue;
        }
        let options = &document["options"];
        let mesh = cage(&document["cage"], options);
        let level = Level::new(&mesh).unwrap();
        let options = Options {
            layer: if options["layer"] == "first" { Layer::First } else { Layer::Second },
            level: index(&options["level"]),
            tangents: if options["tangent"] == "slide_star" { Tangents::Slides } else { Tangents::Clamp },
            keep_twist: options["keep_twist"].as_bool().unwrap(),
        };
        let patches = to_patches(&level, &mesh.points, &options).unwrap();
        let knots: Vec<f64> = list(&document["knots"]).iter().map(number).collect();
        assert_eq!(patches.knots.knots(), knots, "{name}");
        let mut worst: f64 = 0.0;
        for theirs in list(&document["patches"]) {
            let ours = &patches.nets[index(&theirs["face"]) as usize];
            for (i, row) in list(&theirs["control"]).iter().enumerate() {
                for (j, p) in points(row).into_iter().enumerate() {
                    worst = worst.max(p.distance(ours[(i, j)]));
                }
                assert_eq!(list(row).len(), ours.cols());
            }
            assert_eq!(list(&theirs["control"]).len(), ours.rows());
        }
        println!("{name}: {:e}", worst / mesh.size());
        assert!(worst <= TOLERANCE * mesh.size(), "{name}: {worst:e}");
        compared += 1;
    }
    assert_eq!(compared, 16);
}

#[test]
fn quintic_nets_match() {
    let mut compared = 0;
    for (name, document) in documents("pccm") {
        if document["method"].as_str() != Some("bi5") {
            continue;
        }
        let mesh = cage(&document["cage"], &serde_json::Value::Null);
        let nets = to_quintic_patches(&Level::new(&mesh).unwrap(), &mesh.points).unwrap();
        let mut worst: f64 = 0.0;
        for theirs in list(&document["patches"]) {
            for (i, row) in list(&theirs["bezier"]).iter().enumerate() {
                for (j, p) in points(row).into_iter().enumerate() {
                    worst = worst.max(p.distance(nets[index(&theirs["face"]) as usize][(i, j)]));
                }
            }
        }
        println!("{name}: {:e}", worst / mesh.size());
        assert!(worst <= TOLERANCE * mesh.size(), "{name}: {worst:e}");
        compared += 1;
    }
    assert_eq!(compared, 2);
}
