//! `ogee network`: the fields of its report, every format, every code that its input can have.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{CUBE, Folder};
use serde_json::{Value, json};

fn golden(name: &str) -> Value {
    let path = format!("{}/../../testdata/curve-networks/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// A folder with the input of a golden network in it.
fn with_network(name: &str) -> Folder {
    let folder = Folder::new();
    folder.write("net.json", golden(name)["input"].to_string());
    folder
}

/// A flat grid of six by six quads, vertex `7 j + i` at `(i, j, 0)`, and curves on it.
fn on_grid(curves: &Value, more: &Value) -> Folder {
    let errors = golden("errors");
    let mut input = json!({"vertices": errors["vertices"], "faces": errors["faces"], "curves": curves});
    input.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    let folder = Folder::new();
    folder.write("net.json", input.to_string());
    folder
}

#[test]
fn the_report_has_its_fields() {
    let folder = with_network("x6-repaired");
    let report = folder.ogee("network --json net.json -o out.json").expect(0).json();
    for field in "curves meetings splits inserted_vertices warnings seconds file_bytes notes".split(' ') {
        assert!(report.get(field).is_some(), "no {field} in {report}");
    }
    assert_eq!(report["curves"].as_array().unwrap().len(), 6);
    for curve in report["curves"].as_array().unwrap() {
        let error = curve["max_error"].as_f64().unwrap();
        assert!(error > 0.0 && error < 1e-14, "{curve}");
        assert_eq!(
            (curve["closed"].as_bool(), curve["vertices"].as_array().unwrap().len()),
            (Some(false), 3)
        );
    }
    let meeting = &report["meetings"][0];
    assert_eq!(
        (&meeting["vertex"], &meeting["ports"], &meeting["mode"]),
        (&json!(0), &json!(6), &json!("eigen"))
    );
    assert!((meeting["t"].as_f64().unwrap() - 0.267_95).abs() < 1e-5);
    assert!(meeting["coplanarity_deg"].as_f64().unwrap() < 1e-9);
    assert!(meeting["normal_spread_deg"].as_f64().unwrap() < 1e-2);
    assert_eq!((&report["splits"], &report["inserted_vertices"]), (&json!(0), &json!(18)));
    assert_eq!(report["file_bytes"], folder.read("out.json").len());

    let info = folder.ogee("info --json out.json").expect(0).json();
    assert_eq!((&info["meetings"], &info["notes"]), (&json!(1), &json!([])));
    let error = folder.ogee("network --json out.json -o again.json").expect(3).json();
    assert_eq!(error["error"]["code"], "E_MEETING_ALREADY");
}

#[test]
fn lines_of_obj_are_curves() {
    let folder = with_network("dangling");
    let first = folder.ogee("network --json net.json -o one.obj").expect(0).json();
    let text = String::from_utf8(folder.read("one.obj")).unwrap();
    assert!(text.contains("\ng c\nl 3 9 15 21\n#curve-control c "), "{text}");
    // OBJ has no meetings, and its curves make them again.
    let second = folder.ogee("network --json one.obj -o two.obj").expect(0).json();
    assert_eq!(first["curves"][0]["vertices"], second["curves"][0]["vertices"]);
    assert_eq!(second["meetings"][0]["vertex"], 20);
    assert!(second["curves"][0]["max_error"].as_f64().unwrap() < 1e-14);
    let tail = |name: &str| {
        String::from_utf8(folder.read(name)).unwrap().split("\ng c\n").nth(1).unwrap().to_owned()
    };
    assert_eq!(tail("one.obj"), tail("two.obj"));

    // A closed one, in a file of its own.
    folder.write("cube.obj", CUBE);
    folder.write("belt.obj", "o belt\nl 1 2 4 3 1\n");
    let belt = folder.ogee("network --json cube.obj --curves belt.obj -o belt.json").expect(0).json();
    let curve = &belt["curves"][0];
    assert_eq!((&curve["name"], &curve["closed"]), (&json!("belt"), &json!(true)));
    assert_eq!(curve["vertices"], json!([0, 1, 3, 2]));
    let out: Value = serde_json::from_slice(&folder.read("belt.json")).unwrap();
    assert_eq!(out["curves"][0]["name"], "belt");
}

#[test]
fn curves_are_written_as_splines() {
    let folder = with_network("x6-repaired");
    folder.ogee("network net.json -o out.json --save-curves curves.step").expect(0);
    folder.ogee("check curves.step").expect(0);
    let text = String::from_utf8(folder.read("curves.step")).unwrap();
    assert_eq!(text.matches("=B_SPLINE_CURVE_WITH_KNOTS('").count(), 6);
    assert!(
        text.contains("GEOMETRIC_CURVE_SET('curves',(#") && text.contains("_WIREFRAME_SHAPE_REPRESENTATION(")
    );

    folder.ogee("network net.json -o out.json --save-curves curves.obj").expect(0);
    let text = String::from_utf8(folder.read("curves.obj")).unwrap();
    // Three control points are two spans, five points with clamped ends.
    assert_eq!(
        (text.matches("\ncstype bspline\ndeg 3\ncurv 0 2 ").count(), text.matches("\nend").count()),
        (6, 6)
    );
    assert!(text.contains("\nparm u 0 0 0 0 1 2 2 2 2\n"), "{text}");

    let refused = folder.ogee("network net.json -o out2.json --save-curves curves.iges").expect(2);
    assert!(refused.stderr.contains("this build does not have the format iges"), "{}", refused.stderr);
    assert_eq!(folder.names(), ["curves.obj", "curves.step", "net.json", "out.json"]);
}

#[test]
fn options_are_heard() {
    let folder = with_network("crossing-pinned");
    let pinned = folder.ogee("network --json net.json -o out.json").expect(0).json();
    assert_eq!(pinned["meetings"].as_array().unwrap().len(), 1);
    let smooth = folder.ogee("network --json net.json --crossing smooth -o out.json").expect(0).json();
    assert_eq!(smooth["meetings"], json!([]));
    let other =
        folder.ogee("network --json net.json --t 0.2 --x-mode parallelogram -o out.json").expect(0).json();
    assert_eq!(
        (&other["meetings"][0]["t"], &other["meetings"][0]["mode"]),
        (&json!(0.2), &json!("parallelogram"))
    );
    let split = folder.ogee("network --json net.json --pre-split 2 -o out.json").expect(0).json();
    assert_eq!(split["splits"], 2);
    let dangling = with_network("dangling");
    for (arguments, inserted) in [("", 0), ("--force-ribbons", 9), ("--force-ribbons --theta 0.3", 9)] {
        let run = dangling.ogee(&format!("network --json net.json -o out.json {arguments}")).expect(0);
        assert_eq!(run.json()["inserted_vertices"], inserted, "{arguments}");
    }

    // The file's own options; those that are typed come first.
    let mut input = golden("crossing-pinned")["input"].clone();
    input["options"]["t"] = json!(0.25);
    let vertex = pinned["meetings"][0]["vertex"].to_string();
    input["meeting"] = json!({});
    folder.write("net.json", input.to_string());
    let t = |arguments: &str| {
        let report =
            folder.ogee(&format!("network --json net.json -o out.json {arguments}")).expect(0).json();
        report["meetings"][0]["t"].as_f64().unwrap()
    };
    assert_eq!((t(""), t("--t 0.1")), (0.25, 0.1));
    input["meeting"] = json!({ vertex: {"t": 0.15, "crown": 0.01} });
    folder.write("net.json", input.to_string());
    assert_eq!(t(""), 0.15);
}

#[test]
fn warnings_stand_in_the_report() {
    let folder = with_network("x3-not-coplanar");
    let run = folder.ogee("network --json net.json -o out.json").expect(0);
    let warning = &run.json()["warnings"][0];
    assert_eq!(
        (&warning["code"], &warning["where"]["vertex"]),
        (&json!("W_TANGENTS_NOT_COPLANAR"), &json!(0))
    );
    assert!(run.stderr.contains("note: the tangents of the curves at vertex 0"), "{}", run.stderr);
    let quiet = folder.ogee("network --json --quiet net.json --t 0.5 -o out.json").expect(0).json();
    let codes: Vec<&str> =
        quiet["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str()).collect();
    assert!(codes.contains(&"W_T_HALF") && codes.contains(&"W_TANGENTS_NOT_COPLANAR"), "{codes:?}");
}

#[test]
fn networks_with_errors_write_nothing() {
    let errors = golden("errors");
    let cases = errors["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 8);
    for case in cases {
        let folder = on_grid(&case["curves"], &json!({"options": {"pre_split": case["pre_split"]}}));
        let run = folder.ogee("network --json net.json -o out.json --save-curves out.step").expect(3);
        assert_eq!(run.json()["error"]["code"], case["expect"], "{case}");
        assert!(run.first_line().starts_with("net.json: "), "{}", run.stderr);
        assert_eq!(folder.names(), ["net.json"]);
    }
    let more = [
        (json!([{"vertices": [17, 24], "control": [[3, 2, 0], [3, 2, 0]]}]), json!({}), "E_ZERO_TANGENT"),
        (
            json!([{"vertices": [17, 24, 31]}]),
            json!({"creases": [{"vertices": [24, 25], "sharpness": 1}]}),
            "E_CREASE",
        ),
        (json!([{"vertices": [3, 10, 17]}, {"vertices": [8, 9, 3]}]), json!({}), "E_NOT_AN_EDGE"),
        (json!([{"vertices": [1, 8, 15, 22, 29]}]), json!({"options": {"t": 0.7}}), "E_PARAMETER"),
        (json!([{"vertices": [22, 23, 30]}]), json!({"options": {"repair": false}}), "E_PATH_VALENCE"),
        (
            json!([{"vertices": [17, 24, 25]}, {"vertices": [23, 24, 31]}]),
            json!({"options": {"crossing": "smooth"}}),
            "E_CROSSING_NOT_REGULAR",
        ),
    ];
    for (curves, more, code) in more {
        let folder = on_grid(&curves, &more);
        let run = folder.ogee("network --json net.json -o out.json");
        assert_eq!(run.code, 3, "{code}: {}", run.stderr);
        assert_eq!(run.json()["error"]["code"], code);
        assert_eq!(folder.names(), ["net.json"]);
    }
}

#[test]
fn an_octahedron_without_splits_has_too_little_room() {
    let points = json!([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]);
    let faces: Vec<[u32; 3]> = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect();
    let folder = Folder::new();
    let lay = |curves: Value, splits: &Value| {
        let options = json!({"pre_split": splits});
        let input = json!({"vertices": points, "faces": faces, "curves": curves, "options": options});
        folder.write("net.json", input.to_string());
        folder.ogee("network --json net.json -o out.json")
    };
    let ring = json!([{"vertices": [5, 3, 0, 4]}, {"vertices": [5, 2, 4]}]);
    let run = lay(ring.clone(), &json!(0)).expect(3);
    assert_eq!(run.json()["error"]["code"], "E_REPAIR");
    assert!(run.first_line().contains("allow one more split"), "{}", run.stderr);
    assert_eq!(folder.names(), ["net.json"]);
    assert_eq!(lay(ring, &json!("auto")).expect(0).json()["warnings"], json!([]));
    let arc = json!([{"vertices": [3, 4, 1]}]);
    let report = lay(arc.clone(), &json!(0)).expect(0).json();
    assert_eq!(report["warnings"][0]["code"], "W_X_OVERLAP");
    assert!(report["curves"][0]["max_error"].as_f64().unwrap() < 1e-14);
    assert_eq!(lay(arc, &json!("auto")).expect(0).json()["warnings"], json!([]));
}

#[test]
fn files_that_are_no_networks_are_refused() {
    let folder = Folder::with_cube();
    for (name, text, code, line) in [
        ("none.json", "{\"curves\": []}", "no_curves", "none.json: the file has no curves"),
        ("typo.json", "{\"curves\":\n [{\"vertice\": [1, 2]}]}", "wrong_value", "typo.json:2: column "),
        (
            "mode.json",
            "{\"curves\": [], \"options\": {\"x_mode\": \"best\"}}",
            "wrong_value",
            "mode.json:1: ",
        ),
        (
            "both.json",
            "{\"curves\": [{\"vertices\": [0, 1], \"control\": [], \"through\": []}]}",
            "bad_curve",
            "both.json: curve curve1: it has",
        ),
        (
            "vertex.json",
            "{\"curves\": [{\"vertices\": [0, -1]}]}",
            "bad_curve",
            "vertex.json: curve curve1: -1 is no vertex",
        ),
        (
            "meeting.json",
            "{\"curves\": [{\"vertices\": [0, 1]}], \"meeting\": {\"x\": {}}}",
            "bad_curve",
            "meeting.json: \"meeting\" has a key",
        ),
        ("word.obj", "l 1 two\n", "bad_curve", "word.obj:1: the line names `two`"),
        ("zero.obj", "\nl 0 1\n", "bad_curve", "zero.obj:2: the line names `0`"),
        (
            "control.obj",
            "#curve-control a 1 2\nl 1 2\n",
            "bad_curve",
            "control.obj:1: #curve-control: curve a needs three",
        ),
        ("none.obj", "v 0 0 0\n", "no_curves", "none.obj: the file has no curves"),
        (
            "other.obj",
            "v 0 0 0\nv 1 0 0\nl 1 2\n",
            "other_cage",
            "other.obj: the curves belong to 2 vertices",
        ),
    ] {
        folder.write(name, text);
        let run = folder.ogee(&format!("network --json cube.obj --curves {name} -o out.json")).expect(3);
        assert_eq!(run.json()["error"]["code"], code, "{name}");
        assert!(run.first_line().starts_with(line), "{}", run.stderr);
        assert!(!folder.path("out.json").exists());
    }
    folder.ogee("network cube.obj -o out.json").expect(3);
    folder.ogee("network cube.obj --curves none.ply -o out.json").expect(2);
    folder.ogee("network cube.obj --curves missing.json -o out.json").expect(3);
}

#[test]
fn curves_may_be_given_by_points_or_fitted() {
    let path = json!([21, 22, 23, 24, 25, 26, 27]);
    let points: Vec<Value> = (0..7).map(|i| json!([i, 3, f64::from(i * i) / 20.0])).collect();
    let folder = on_grid(&json!([{"name": "arc", "vertices": path, "through": points}]), &json!({}));
    let report = folder.ogee("network --json net.json -o out.json").expect(0).json();
    assert!(report["curves"][0]["max_error"].as_f64().unwrap() < 1e-14);
    // The limit of each vertex is its point.
    folder.ogee("refine out.json -l 0 --limit -o limit.json").expect(0);
    let limit: Value = serde_json::from_slice(&folder.read("limit.json")).unwrap();
    for (i, point) in points.iter().enumerate() {
        for k in 0..3 {
            let distance = limit["vertices"][21 + i][k].as_f64().unwrap() - point[k].as_f64().unwrap();
            assert!(distance.abs() < 1e-14, "{i}: {distance}");
        }
    }
    // Four control points refined once are seven.
    let control = json!([[0, 3, 0], [2, 3, 1], [4, 3, 1], [6, 3, 0]]);
    let refit = |control: &Value| {
        let folder = on_grid(
            &json!([{"name": "arc", "vertices": path, "control": control, "refit": true}]),
            &json!({}),
        );
        folder.ogee("network --json net.json -o out.json").expect(0).json()
    };
    assert_eq!(refit(&control)["notes"], json!([]));
    let five = json!([[0, 3, 0], [1, 3, 1], [3, 3, 1], [5, 3, 1], [6, 3, 0]]);
    assert_eq!(refit(&five)["notes"][0]["code"], "refitted");
}

#[test]
fn curves_alone_get_a_cage() {
    let cube = golden("cube-wireframe")["input"].clone();
    let folder = Folder::new();
    let bare = json!({"vertices": cube["vertices"], "curves": cube["curves"], "options": {"flatten": true}});
    folder.write("lines.json", bare.to_string());
    let report = folder.ogee("network --json lines.json -o out.json").expect(0).json();
    assert_eq!(
        (report["curves"].as_array().unwrap().len(), report["meetings"].as_array().unwrap().len()),
        (12, 8)
    );
    let off = |report: &Value| {
        let errors =
            report["curves"].as_array().unwrap().iter().map(|curve| curve["max_error"].as_f64().unwrap());
        errors.fold(0.0, f64::max)
    };
    assert!(off(&report) < 1e-14);
    let info = folder.ogee("info --json out.json").expect(0).json();
    assert_eq!(info["components"][0]["closed"], true);

    // The same as lines of OBJ, and fair.
    let points = cube["vertices"].as_array().unwrap().iter();
    let mut text: String = points.map(|p| format!("v {} {} {}\n", p[0], p[1], p[2])).collect();
    for curve in cube["curves"].as_array().unwrap() {
        let ids = curve["vertices"].as_array().unwrap().iter().map(|v| (v.as_u64().unwrap() + 1).to_string());
        text += &format!("l {}\n", ids.collect::<Vec<_>>().join(" "));
    }
    folder.write("lines.obj", &text);
    let fair = folder.ogee("network --json lines.obj --flatten --fair -o fair.json").expect(0).json();
    assert!(off(&fair) < 1e-13);
    assert_eq!((&fair["vertices"], &fair["faces"]), (&report["vertices"], &report["faces"]));

    // Three edges in a row enclose nothing.
    folder.write("open.obj", text.split("l ").take(4).collect::<Vec<_>>().join("l "));
    let run = folder.ogee("network --json open.obj -o none.json").expect(3);
    assert_eq!(run.json()["error"]["code"], "E_CURVE_ALONE");
    // Loops are given where they cannot be seen.
    let mut given = bare.clone();
    given["loops"] = json!([[0, 1, 99]]);
    folder.write("lines.json", given.to_string());
    let run = folder.ogee("network --json lines.json -o none.json").expect(3);
    assert_eq!(run.json()["error"]["code"], "E_LOOP_BROKEN");
    assert!(!folder.path("none.json").exists());
}

#[test]
fn wishes_are_read_from_files() {
    let path = json!([21, 22, 23, 24, 25, 26, 27]);
    let tilted = json!([null, null, null, [0, 1, 1], null, null, null]);
    let folder = on_grid(
        &json!([{"name": "ridge", "vertices": path, "normals": tilted}]),
        &json!({
            "options": {"fair": true, "pre_split": 1},
            "points": [{"vertex": 9, "position": [2, 1, 0.4], "normal": [0, 0, 1]}]
        }),
    );
    // Without the split both rows beside the point are held.
    let run = folder.ogee("network --json net.json --pre-split 0 -o out.json").expect(3);
    assert_eq!(run.json()["error"]["code"], "E_CONTRADICTION");
    let report = folder.ogee("network --json net.json -o out.json").expect(0).json();
    assert_eq!(report["warnings"], json!([]));
    assert!(report["curves"][0]["max_error"].as_f64().unwrap() < 1e-13);
    let at = |vertex: usize| {
        let out: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
        let faces = out["faces"].as_array().unwrap();
        let corner_of = |face: &Value| face.as_array().unwrap().iter().position(|v| v == vertex);
        let (face, corner) =
            faces.iter().enumerate().find_map(|(f, face)| Some((f, corner_of(face)?))).unwrap();
        let (u, v) = [(0, 0), (1, 0), (1, 1), (0, 1)][corner];
        folder.write("at.csv", format!("face,corner,u,v\n{face},,{u},{v}\n"));
        folder.ogee("eval out.json --at at.csv -o at.jsonl").expect(0);
        let sample: Value = serde_json::from_slice(&folder.read("at.jsonl")).unwrap();
        let vector = |key: &str| [0, 1, 2].map(|k| sample[key][k].as_f64().unwrap());
        (vector("position"), vector("normal"))
    };
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-10);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    assert!(near(at(24).1, [0.0, half, half]), "{:?}", at(24));
    assert!(near(at(9).0, [2.0, 1.0, 0.4]) && near(at(9).1, [0.0, 0.0, 1.0]), "{:?}", at(9));

    // The papers' own forms by name.
    let folder = with_network("x6-repaired");
    let codes = |arguments: &str| -> Vec<String> {
        let report =
            folder.ogee(&format!("network --json net.json -o out.json {arguments}")).expect(0).json();
        let warnings = report["warnings"].as_array().unwrap().iter();
        warnings.map(|warning| warning["code"].as_str().unwrap().to_owned()).collect()
    };
    assert!(codes("--scheme generalised").contains(&"W_T_HALF".to_owned()));
    assert!(!codes("--scheme abbas-nasri-2004 --t 0.25").contains(&"W_T_HALF".to_owned()));
    folder.ogee("network net.json -o none.json --scheme abbas-nasri-2004").expect(2);
}

#[test]
fn parts_keep_curves_on_edges() {
    // Row 2 of a grid meets nothing: without its path packing would lay a face across it.
    let folder = on_grid(&json!([{"name": "row", "vertices": [14, 15, 16, 17, 18, 19, 20]}]), &json!({}));
    let report = folder.ogee("network --json net.json -o part.step").expect(0).json();
    assert_eq!(report["part"]["faces_written"], 2);
    assert!(report["max_edge_error"].as_f64().unwrap() < 1e-13);
    folder.ogee("check part.step").expect(0);
    folder.ogee("network net.json -o out.json").expect(0);
    let part = folder.ogee("convert --json out.json -o again.step").expect(0).json();
    assert_eq!(part["faces_written"], 2);
    // Where curves meet, caps.
    let folder = with_network("x6-repaired");
    let report = folder.ogee("network --json net.json -o part.step").expect(0).json();
    assert!(report["max_edge_error"].as_f64().unwrap() < 1e-13);
    assert!(report["part"]["max_normal_angle_deg"].as_f64().unwrap() < 1e-9);
    assert_eq!(report["part"]["sharp_edges"], 0);
}
