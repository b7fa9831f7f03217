//! `ogee lens` and `--lens`: the fields of the report, every method and format, every code that input can have.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Folder;
use serde_json::{Value, json};

/// A wing whose two tips are zipped: four lenses, two pairs.
fn with_wing() -> Folder {
    let path = format!("{}/../../testdata/lens/wing.obj", env!("CARGO_MANIFEST_DIR"));
    let folder = Folder::new();
    folder.write("wing.obj", std::fs::read_to_string(path).unwrap());
    folder
}

/// The same, with one edge sharp.
fn with_sharp_edge(a: u32, b: u32, sharpness: f64) -> Folder {
    let folder = with_wing();
    let text = String::from_utf8(folder.read("wing.obj")).unwrap();
    folder.write("wing.obj", format!("{text}t crease 2/1/0 {a} {b} {sharpness}\n"));
    folder
}

fn on_faces(faces: &Value) -> Folder {
    let count = 1 + faces
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|face| face.as_array().unwrap())
        .map(|v| v.as_u64().unwrap())
        .max()
        .unwrap();
    let vertices: Vec<[u64; 3]> = (0..count).map(|v| [v, v * v % 7, v * 3 % 5]).collect();
    let folder = Folder::new();
    folder.write("cage.json", json!({"vertices": vertices, "faces": faces}).to_string());
    folder
}

#[test]
fn the_report_has_its_fields() {
    let folder = with_wing();
    let report = folder.ogee("lens --json wing.obj -o wing.step").expect(0).json();
    for field in "lenses refined part seconds file_bytes notes".split(' ') {
        assert!(report.get(field).is_some(), "no {field} in {report}");
    }
    let lenses = report["lenses"].as_array().unwrap();
    assert_eq!(lenses.len(), 4);
    for lens in lenses {
        assert_eq!(lens["method"], "polar");
        assert_eq!(lens["reason"], "circles go around the pair");
        let back = lenses.iter().find(|other| other["vertex"] == lens["paired_with"]).unwrap();
        assert_eq!(back["paired_with"], lens["vertex"]);
    }
    let part = &report["part"];
    assert_eq!(
        (&part["solids"], &part["closed"], &part["sharp_edges"]),
        (&json!(1), &json!(true), &json!(0))
    );
    assert!(part["max_normal_angle_deg"].as_f64().unwrap() < 1e-6, "{part}");
    assert_eq!(report["file_bytes"], folder.read("wing.step").len());
    folder.ogee("check wing.step").expect(0);

    // The same by the other command.
    let converted = folder.ogee("convert --json wing.obj -o wing.step").expect(0).json();
    assert_eq!(converted["lenses"], report["lenses"]);
    assert_eq!(converted["volume"], part["volume"]);
}

#[test]
fn every_method_writes_what_it_makes() {
    let folder = with_wing();
    for (method, faces) in [("c1", 56), ("auto", 56), ("merge", 48), ("identify", 48), ("remove", 52)] {
        for out in ["out.json", "out.obj"] {
            let report =
                folder.ogee(&format!("lens --json wing.obj --method {method} -o {out}")).expect(0).json();
            assert_eq!((&report["faces"], &report["refined"]), (&json!(faces), &json!(0)), "{method}");
            let info = folder.ogee(&format!("info --json {out}")).expect(0).json();
            assert_eq!(info["faces"], faces);
            let left = info["valence2"].as_array().unwrap().len();
            assert_eq!(left, if matches!(method, "c1" | "auto") { 4 } else { 0 }, "{method}");
        }
    }
    for method in ["c2", "degree-raise", "polar"] {
        let report =
            folder.ogee(&format!("lens --json wing.obj --method {method} -o out.json")).expect(0).json();
        assert_eq!(report["lenses"][0]["method"], method);
        let patches: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
        assert_eq!(
            patches["patches"].as_array().unwrap().len(),
            report["part"]["faces_written"].as_u64().unwrap() as usize
        );
        let refused = folder.ogee(&format!("lens wing.obj --method {method} -o out.obj")).expect(2);
        assert!(refused.stderr.contains("makes patches"), "{}", refused.stderr);
        for format in ["step", "bv"] {
            folder.ogee(&format!("convert wing.obj --lens {method} -o out.{format}")).expect(0);
        }
    }
}

#[test]
fn what_was_refined_is_said() {
    // A vertex in the middle of a quad, joined to two of its corners: neighbours of valence 5.
    let folder = with_wing();
    let text = String::from_utf8(folder.read("wing.obj")).unwrap();
    let (start, face) = text.trim_end().rsplit_once("\nf ").unwrap();
    let corners: Vec<&str> = face.split(' ').collect();
    let vertex = start.lines().filter(|line| line.starts_with("v ")).count() + 1;
    let mut lines: Vec<String> = start.lines().map(str::to_owned).collect();
    let last = lines.iter().rposition(|line| line.starts_with("v ")).unwrap();
    lines.insert(last + 1, "v 0.6 0.01 5.2".to_owned());
    lines.push(format!("f {} {} {} {vertex}", corners[0], corners[1], corners[2]));
    lines.push(format!("f {} {vertex} {} {}", corners[0], corners[2], corners[3]));
    folder.write("doublet.obj", lines.join("\n") + "\n");
    let report = folder.ogee("convert --json doublet.obj -o out.step").expect(0).json();
    let note = report["notes"].as_array().unwrap().iter().find(|note| note["code"] == "lens_refined");
    assert!(note.unwrap()["message"].as_str().unwrap().contains("refined"), "{report}");
    assert_eq!((&report["solids"], &report["sharp_edges"]), (&json!(1), &json!(0)));
}

#[test]
fn what_stands_in_the_way_is_named() {
    // A sharp edge that ends at a lens stays in the way; one that fades does not.
    let folder = with_sharp_edge(0, 1, 10.0);
    for method in ["auto", "merge", "c2", "polar"] {
        let error =
            folder.ogee(&format!("convert --json wing.obj --lens {method} -o out.step")).expect(3).json();
        assert_eq!(error["error"]["code"], "blocked", "{error}");
        let message = error["error"]["message"].as_str().unwrap();
        assert!(message.contains("edge 0-1 is sharp"), "{message}");
    }
    assert_eq!(folder.names(), ["wing.obj"]);
    with_sharp_edge(0, 1, 1.5).ogee("convert wing.obj -o out.step").expect(0);

    let folder = with_wing();
    let error = folder.ogee("convert --json wing.obj --lens c1 -o out.step").expect(3).json();
    assert_eq!(error["error"]["code"], "valence_two");
    assert!(error["error"]["message"].as_str().unwrap().contains("--lens"), "{error}");
    let error = folder.ogee("convert --json wing.obj --lens polar --method bi5 -o out.step").expect(3).json();
    assert_eq!(error["error"]["code"], "cap");
    folder.ogee("convert wing.obj --method bi5 -o out.step").expect(0);
}

#[test]
fn every_code_has_an_input() {
    for (faces, method, code) in [
        (json!([[0, 1, 2, 3], [0, 3, 2, 1]]), "auto", "adjacent_lens_vertices"),
        (json!([[0, 1, 2, 1], [0, 1, 3, 1]]), "auto", "repeated_vertex"),
        (
            json!([[0, 1, 3, 2], [1, 0, 2, 3], [2, 3, 5, 4], [3, 2, 4, 5], [4, 5, 7, 6], [5, 4, 6, 7]]),
            "auto",
            "non_manifold_edge",
        ),
        (json!([[0, 1, 2, 3], [0, 3, 4, 1]]), "polar", "no_partner"),
    ] {
        let folder = on_faces(&faces);
        let error =
            folder.ogee(&format!("lens --json cage.json --method {method} -o out.step")).expect(3).json();
        assert_eq!(error["error"]["code"], code, "{error}");
        assert_eq!(folder.names(), ["cage.json"]);
    }
    let folder = with_wing();
    for shape in ["0.75,0.125", "nan,0", "0.5", "0.5,x"] {
        folder
            .ogee(&format!("refine wing.obj -l 1 -o out.obj --lens-shape {shape}"))
            .expect(if shape.starts_with("0.7") || shape.starts_with("nan") { 3 } else { 2 });
    }
    folder.ogee("refine wing.obj -l 1 -o out.obj --lens-shape 0.5,0.1875").expect(0);
}

#[test]
fn shapes_travel_in_json() {
    let folder = with_wing();
    folder.ogee("lens wing.obj --lens-shape 0.5,0.1875 -o out.json").expect(0);
    let cage: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
    assert_eq!(cage["lens"], json!({"beta": 0.5, "gamma": 0.1875}));
}
