//! `ogee inspect`: a table, one object of JSON, a page that opens without a network; an exit code for angles.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{CUBE, Folder, finish};
use serde_json::{Value, json};

/// Two squares that meet at an angle of 30 degrees, as patches.
fn bent() -> String {
    let (sine, cosine) = 30_f64.to_radians().sin_cos();
    let patch = |face: u32, from: [f64; 2], to: [f64; 2]| {
        let row = |[x, z]: [f64; 2]| json!([[x, 0.0, z], [x, 1.0, z]]);
        json!({"face": face, "corner": null, "degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
            "points": [row(from), row(to)]})
    };
    json!({"patches": [patch(0, [-1.0, 0.0], [0.0, 0.0]), patch(1, [0.0, 0.0], [cosine, -sine])]}).to_string()
}

fn close(value: &Value, wanted: f64) {
    let value = value.as_f64().unwrap();
    assert!((value - wanted).abs() <= 1e-9 * wanted.abs(), "{value} is not {wanted}");
}

#[test]
fn a_table_for_people_and_an_object_for_programs() {
    let folder = Folder::with_cube();
    let run = folder.ogee("inspect cube.obj").expect(0);
    assert!(run.stdout.is_empty() && run.first_line() == "cube.obj");
    for label in
        ["surface", "gap G0", "angle G1", "curvature G2", "smallest radius", "extraordinary", "seconds"]
    {
        assert!(
            run.stderr.lines().any(|line| line.trim_start().starts_with(label)),
            "{label}: {}",
            run.stderr
        );
    }
    let report = folder.ogee("inspect cube.obj --json").expect(0).json();
    assert_eq!(
        (&report["kind"], &report["faces"], &report["closed"]),
        (&json!("cage"), &json!(6), &json!(true))
    );
    let smooth = &report["continuity"]["smooth"];
    assert_eq!((&smooth["joints"], &smooth["gap"]["samples"]), (&json!(12), &json!(60)));
    for (metric, most) in
        [("gap", 1e-12), ("angle_deg", 1e-9), ("curvature_relative", 1e-9), ("kink_deg", 1e-8)]
    {
        let found = &smooth[metric];
        for key in ["max", "p95", "mean"] {
            assert!(found[key].as_f64().unwrap() < most, "{metric} {key}: {found}");
        }
        let worst = &found["worst"][0];
        assert!(
            worst["at"]["face"].is_u64()
                && worst["at"]["corner"].is_null()
                && worst["beside"]["v"].is_number()
        );
        assert_eq!(worst["position"].as_array().unwrap().len(), 3);
    }
    let extraordinary = &report["extraordinary"];
    assert_eq!((&extraordinary["found"], &extraordinary["examined"]), (&json!(8), &json!(8)));
    assert_eq!(extraordinary["by_valence"][0]["faces"], 3);
    let mut vertices: Vec<u64> =
        extraordinary["points"].as_array().unwrap().iter().map(|p| p["vertex"].as_u64().unwrap()).collect();
    vertices.sort_unstable();
    assert_eq!(vertices, (0..8).collect::<Vec<u64>>());
    for key in ["min", "p5", "p50", "p95", "max", "mean"] {
        assert!(report["curvature"]["gauss"][key].is_number());
    }
    assert_eq!(report["curvature"]["mean"]["histogram"]["shares"].as_array().unwrap().len(), 48);
    assert!(report["curvature"]["smallest_radius"]["convex"]["radius"].as_f64().unwrap() > 0.1);
    assert_eq!((&report["max_angle_deg"], &report["passed"]), (&Value::Null, &Value::Null));
    assert!(report["seconds"]["measure"].is_number() && report["lines"]["eye"].is_array());
    assert_eq!(folder.names(), ["cube.obj"]);
}

#[test]
fn an_angle_that_is_too_large_fails() {
    let folder = Folder::with_cube();
    folder.write("bent.json", bent());
    let run = folder.ogee("inspect bent.json --crease-angle 90 --max-angle 29.9 --json").expect(1);
    let report = run.json();
    assert_eq!((&report["passed"], &report["max_angle_deg"]), (&json!(false), &json!(29.9)));
    close(&report["continuity"]["smooth"]["angle_deg"]["max"], 30.0);
    assert!(run.stderr.contains("bent.json: two faces meet at 30 degrees"), "{}", run.stderr);
    let passed = folder.ogee("inspect bent.json --crease-angle 90 --max-angle 30.1 --json").expect(0).json();
    assert_eq!(passed["passed"], true);
    assert!(folder.ogee("inspect cube.obj --max-angle 0.01 -q").expect(0).stderr.is_empty());
    assert!(folder.ogee("inspect cube.obj --max-angle 1e-18 -q").expect(1).stderr.lines().count() == 1);
}

#[test]
fn patches_are_told_by_what_is_in_them() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.json").expect(0);
    let report = folder.ogee("inspect part.json --json --max-angle 1e-6").expect(0).json();
    assert_eq!((&report["kind"], &report["faces"]), (&json!("patches"), &json!(6)));
    assert_eq!(report["continuity"]["smooth"]["joints"], 12);
    assert!(report["extraordinary"]["points"][0]["vertex"].is_null());
    // The angle of a crease is a note, since nothing else tells it from a fault.
    folder.write("bent.json", bent());
    let report = folder.ogee("inspect bent.json --json --max-angle 1").expect(0).json();
    close(&report["continuity"]["sharp"]["angle_deg"]["max"], 30.0);
    assert_eq!(report["notes"][0]["code"], "creases_by_angle");
    // A cage in JSON is a cage.
    folder.write("cage.json", r#"{"vertices":[[0,0,0],[1,0,0],[1,1,0],[0,1,0]],"faces":[[0,1,2,3]]}"#);
    let report = folder.ogee("inspect cage.json --json").expect(0).json();
    assert_eq!((&report["kind"], &report["continuity"]["border_sides"]), (&json!("cage"), &json!(4)));
    let mut command = folder.command("inspect - --input-format json --json");
    command.write_stdin(bent());
    assert_eq!(finish(command).expect(0).json()["kind"], "patches");
}

#[test]
fn creases_are_apart() {
    let folder = Folder::new();
    folder.write(
        "top.obj",
        CUBE.to_owned()
            + "t crease 2/1/0 4 5 10\nt crease 2/1/0 5 7 10\nt crease 2/1/0 7 6 10\nt crease 2/1/0 6 4 10\n",
    );
    let report = folder.ogee("inspect top.obj --json").expect(0).json();
    let found = &report["continuity"];
    assert_eq!((&found["smooth"]["joints"], &found["sharp"]["joints"]), (&json!(8), &json!(4)));
    assert!(found["sharp"]["angle_deg"]["max"].as_f64().unwrap() > 60.0);
    assert!(found["smooth"]["angle_deg"]["max"].as_f64().unwrap() < 1e-9);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = Folder::with_cube();
    folder.write("bent.json", bent());
    for (arguments, what) in [
        ("inspect cube.obj --max-angle -1", "not an angle"),
        ("inspect cube.obj --max-angle nan", "not an angle"),
        ("inspect cube.obj --html - --json", "both want stdout"),
        ("inspect bent.json --max-angle 20", "--crease-angle"),
        ("inspect bent.json --boundary none", "for cages"),
        ("inspect cube.step", "unknown format"),
    ] {
        assert!(folder.ogee(arguments).expect(2).stderr.contains(what), "{arguments}");
    }
    folder.write("bad.json", r#"{"patches":[{"face":0}]}"#);
    folder.write("none.json", r#"{"patches":[]}"#);
    folder.write("broken.json", r#"{"patches":["#);
    folder.write("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3 4\n");
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    for arguments in [
        "inspect bad.json",
        "inspect none.json",
        "inspect broken.json",
        "inspect missing.obj",
        "inspect point.obj",
        "inspect open.obj --boundary none",
    ] {
        let run = folder.ogee(&format!("{arguments} --html page.html --json")).expect(3);
        assert!(run.json()["error"]["code"].is_string(), "{arguments}");
    }
    assert!(!folder.names().contains(&"page.html".to_owned()));
    folder.ogee("inspect cube.obj --html missing/page.html").expect(4);
}

/// Fails unless every element is closed in turn; what has no end is passed over.
fn assert_well_formed(page: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        let name = tag.trim_start_matches('/').split([' ', '/']).next().unwrap();
        assert!(!tag.contains('<'), "{tag}");
        match tag {
            _ if name.starts_with('!') || ["meta", "br", "img"].contains(&name) || tag.ends_with('/') => {}
            _ if tag.starts_with('/') => assert_eq!(open.pop(), Some(name), "near {rest:.60}"),
            _ => open.push(name),
        }
        if name == "style" && !tag.starts_with('/') {
            rest = &rest[rest.find("</style>").unwrap()..];
        }
    }
    assert_eq!(open, Vec::<&str>::new());
    for (k, _) in page.match_indices('&') {
        let entity = &page[k + 1..k + 1 + page[k + 1..].find(';').unwrap()];
        assert!(["amp", "lt", "gt", "quot", "#39"].contains(&entity), "&{entity};");
    }
}

#[test]
fn the_page_opens_without_a_network_and_is_well_formed() {
    let folder = Folder::new();
    folder.write("a & b.obj", CUBE);
    folder.write("bent.json", bent());
    let page = |arguments: &[&str]| {
        let mut command = folder.command("inspect --html page.html");
        command.args(arguments);
        finish(command).expect(0);
        String::from_utf8(folder.read("page.html")).unwrap()
    };
    let pages = [page(&["a & b.obj", "--max-angle", "0.1"]), page(&["bent.json"])];
    for page in &pages {
        assert!(page.starts_with("<!DOCTYPE html>"));
        assert_well_formed(page);
        for outside in ["http", "url(", "<link", "<script", "@import", "src=\"/"] {
            assert!(!page.contains(outside), "{outside}");
        }
        let words: String = page.split('"').filter(|part| !part.starts_with("data:")).collect();
        assert!(!words.contains("NaN") && !words.contains("inf "));
        assert_eq!(page.matches("<img src=\"data:image/png;base64,iVBOR").count(), 6);
        assert_eq!(page.matches("class=\"chart\"").count(), 3);
    }
    assert!(pages[0].contains("<h1>a &amp; b.obj</h1>") && pages[0].contains("<b>Passed.</b>"));
    assert!(pages[1].contains("joint on a crease") && pages[1].contains("2 patches"));
    // What is marked in pictures stands in the table.
    for page in &pages {
        for bubble in page.match_indices("text-anchor=\"middle\">").map(|(k, found)| &page[k + found.len()..])
        {
            let label = &bubble[..bubble.find('<').unwrap()];
            let is_zero_of_axis = label == "0";
            assert!(
                is_zero_of_axis || page.contains(&format!("<span class=\"no\">{label}</span>")),
                "{label}"
            );
        }
    }
    // Equal input gives equal bytes.
    assert!(page(&["bent.json"]) == pages[1]);
}

#[test]
fn the_limit_stands_beside_the_patches_in_every_picture() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.json").expect(0);
    let page = |arguments: &str, code| {
        let run = folder.ogee(&format!("inspect {arguments} --html page.html --json")).expect(code);
        let page = String::from_utf8(folder.read("page.html")).unwrap();
        assert_well_formed(&page);
        (page, run.json())
    };
    let sources = |page: &str| -> Vec<String> {
        let parts = page.split("<img src=\"").skip(1);
        parts.map(|part| part[..part.find('"').unwrap()].to_owned()).collect()
    };
    let (alone, measured) = page("part.json", 0);
    let (both, report) = page("part.json --beside cube.obj --boundary edge-only", 0);
    assert_eq!(report["continuity"], measured["continuity"]);
    let (alone, seen) = (sources(&alone), sources(&both));
    assert_eq!((alone.len(), seen.len()), (6, 12));
    for (k, first) in alone.iter().enumerate() {
        assert!(*first == seen[2 * k] && *first != seen[2 * k + 1], "{k}");
    }
    // Beside itself a surface looks the same: camera, light and colours are those of the first.
    let (twice, _) = page("part.json --beside part.json", 0);
    assert!(sources(&twice).chunks(2).all(|pair| pair[0] == pair[1]));
    for label in ["part.json, patches", "cube.obj, the limit surface"] {
        assert_eq!(both.matches(label).count(), 6, "{label}");
    }
    assert_eq!(twice.matches("part.json, patches").count(), 12);
    // What is elsewhere is not in these pictures.
    folder.write("far.obj", CUBE.replace("v 1 ", "v 901 ").replace("v -1 ", "v 899 "));
    let (without, report) = page("part.json --beside far.obj", 0);
    assert_eq!(sources(&without), alone);
    assert_eq!(without.matches("no part of the surface covers a pixel").count(), 6);
    let codes: Vec<&Value> = report["notes"].as_array().unwrap().iter().map(|note| &note["code"]).collect();
    assert!(codes.contains(&&json!("empty_view")), "{codes:?}");
}

#[test]
fn one_cage_by_several_methods_stands_side_by_side() {
    // Wider above: on a cube, and on what a linear map makes of it, curvature is continuous by symmetry.
    let folder = Folder::new();
    let above = ["v -1 -1 1", "v 1 -1 1", "v -1 1 1", "v 1 1 1"];
    let wider = |text: String, vertex: &str| {
        let wide = vertex[..vertex.len() - 2].replace('1', "2") + " 1";
        text.replace(&format!("{vertex}\n"), &format!("{wide}\n"))
    };
    folder.write("stump.obj", above.into_iter().fold(CUBE.to_owned(), wider));
    let arguments = "inspect stump.obj --methods limit,pccm,g2 --html page.html --json";
    let report = folder.ogee(arguments).expect(0).json();
    let surfaces = report["surfaces"].as_array().unwrap();
    let methods: Vec<&Value> = surfaces.iter().map(|surface| &surface["method"]).collect();
    assert_eq!(methods, ["limit", "pccm", "g2"]);
    assert_eq!([&surfaces[0]["kind"], &surfaces[1]["kind"]], ["cage", "patches"]);
    let jump = |k: usize| surfaces[k]["continuity"]["smooth"]["curvature_relative"]["max"].as_f64().unwrap();
    assert!(jump(0) < 1e-9 && jump(1) > 0.01 && jump(2) < 1e-9, "{} {} {}", jump(0), jump(1), jump(2));
    // Every corner, by every method.
    let points = report["points"].as_array().unwrap();
    assert_eq!(points.len(), 8);
    for point in points {
        assert!(point["vertex"].is_u64() && point["faces"] == 3);
        let ranges = point["ranges"].as_array().unwrap();
        assert_eq!(ranges.len(), 3);
        for (range, reach) in ranges.iter().zip([0.5, 0.5, 1.0]) {
            // Caps lie on faces of the first refinement: the same area.
            close(&range["reach"], reach);
            let [least, greatest] = [0, 1].map(|k| range["mean"][k].as_f64().unwrap());
            assert!(greatest - least > 0.05 && greatest < 0.5, "{range}");
        }
    }
    // What a surface is measured as beside others it is measured as by itself.
    let alone = folder.ogee("inspect stump.obj --json").expect(0).json();
    assert_eq!(alone["continuity"], surfaces[0]["continuity"]);
    let range = &alone["extraordinary"]["points"][0]["range"];
    assert!(points.iter().any(|point| point["ranges"][0] == *range));
    let page = String::from_utf8(folder.read("page.html")).unwrap();
    assert_well_formed(&page);
    assert_eq!(page.matches("<img src=\"data:image/png;base64,iVBOR").count(), 6);
    for method in ["limit", "pccm", "g2"] {
        assert_eq!(page.matches(&format!("<p class=\"which\">{method}</p>")).count(), 2);
    }
    assert!(page.contains("Highlight lines") && page.contains("vertex 7, 3 faces"));
    // People see the same.
    let table = folder.ogee("inspect stump.obj --methods limit,pccm").expect(0).stderr;
    assert!(table.contains("pccm: angle") && table.contains("vertex 0, 3 faces: limit"), "{table}");
}

#[test]
fn methods_are_for_cages() {
    let folder = Folder::with_cube();
    folder.write("bent.json", bent());
    for (arguments, says) in [
        ("inspect bent.json --methods limit", "for cages"),
        ("inspect cube.obj --methods limit,nurbs", "unknown value 'nurbs'"),
        ("inspect cube.obj --methods limit --max-angle 1", "cannot be used"),
    ] {
        let run = folder.ogee(arguments).expect(2);
        assert!(run.stderr.contains(says), "{arguments}: {}", run.stderr);
    }
}

#[test]
fn what_is_beside_is_refused_as_what_is_inspected() {
    let folder = Folder::with_cube();
    for (arguments, code, says) in [
        ("inspect cube.obj --beside cube.obj", 2, "--html"),
        ("inspect cube.obj --beside missing.json --html page.html", 3, "missing.json"),
        ("inspect cube.obj --beside cube.step --html page.html", 2, "unknown format"),
    ] {
        let run = folder.ogee(arguments).expect(code);
        assert!(run.stderr.contains(says), "{arguments}: {}", run.stderr);
    }
    assert!(!folder.names().contains(&"page.html".to_owned()));
}

#[test]
fn the_page_goes_to_stdout_too() {
    let folder = Folder::new();
    folder.write("bent.json", bent());
    let run = folder.ogee("inspect bent.json --html -").expect(0);
    assert!(String::from_utf8(run.stdout).unwrap().ends_with("</html>\n"));
    let json = folder.ogee("inspect bent.json --html page.html --json").expect(0).json();
    assert!(json["seconds"]["draw"].is_number());
}
