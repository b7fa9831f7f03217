//! `ogee convert --method g2`: what the report says of caps and levels, what there is in each format, what is refused.

mod common;

use std::collections::BTreeSet;

use common::{CUBE, Folder, models};
use serde_json::{Value, json};

/// Above the jumps that rounding makes on shipped cages, and far below those of any other method.
const JUMP: f64 = 1e-7;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("{value} is no list"))
}

fn total(of: &Value, field: &str) -> f64 {
    list(of).iter().map(|one| number(&one[field])).sum()
}

/// A cube with a crease that leaves one face beside it at vertex 1.
fn folder_with_a_fold() -> Folder {
    let folder = Folder::new();
    folder.write("fold.obj", format!("{CUBE}t crease 2/1/0 0 1 10\nt crease 2/1/0 1 3 10\n"));
    folder
}

fn folder_with(model: &str) -> Folder {
    let folder = Folder::new();
    let path = models().into_iter().find(|path| path.ends_with(model)).expect("a shipped model");
    folder.write("cage.obj", std::fs::read(path).expect("a file that can be read"));
    folder
}

#[test]
fn every_cap_is_in_the_report() {
    let folder = Folder::with_cube();
    let report = folder.ogee("convert --json cube.obj -o part.step --method g2").expect(0).json();
    assert_eq!((&report["method"], &report["level"]), (&json!("g2"), &json!(1)));
    assert_eq!((&report["caps"], &report["cap_degree"]), (&json!(8), &json!(7)));
    assert_eq!(report["levels"], json!([{"steps": 1, "level": 0, "faces": 24}]));
    let jumps = ["max_curvature_jump", "max_curvature_jump_absolute"].map(|name| number(&report[name]));
    assert!(jumps[0] <= JUMP && jumps[1] > 0.0, "{jumps:?}");
    let nodes = list(&report["nodes"]);
    let places: BTreeSet<u64> = nodes.iter().filter_map(|node| node["where"]["vertex"].as_u64()).collect();
    assert_eq!(places, (0..8).collect());
    for node in nodes {
        let [kind, faces, degree, level] = ["kind", "faces", "degree", "level"].map(|field| &node[field]);
        assert_eq!([kind, faces, degree, level], [&json!("interior"), &json!(3), &json!(7), &json!(1)]);
        let deviation = number(&node["deviation"]);
        assert!(deviation > 0.0 && deviation <= number(&report["max_deviation"]));
    }
}

#[test]
fn other_methods_have_no_caps_and_jumps() {
    let report = folder_with("hand.obj").ogee("convert --json cage.obj -o part.step").expect(0).json();
    assert_eq!(
        [&report["caps"], &report["cap_degree"], &report["nodes"]],
        [&json!(0), &Value::Null, &json!([])]
    );
    assert!(number(&report["max_curvature_jump"]) > 1.0);
}

#[test]
fn each_kind_of_cap_has_a_name() {
    let kinds = |model: &str| -> BTreeSet<String> {
        let report =
            folder_with(model).ogee("convert --json cage.obj -o a.step --method g2").expect(0).json();
        let kind = |node: &Value| node["kind"].as_str().unwrap().to_owned();
        list(&report["nodes"]).iter().map(kind).collect()
    };
    assert_eq!(kinds("vase.obj"), ["dart", "interior"].map(str::to_owned).into());
    assert_eq!(kinds("hull.obj"), ["convex_corner", "interior"].map(str::to_owned).into());
}

#[test]
fn the_middle_of_a_polygon_is_told_by_its_face() {
    let folder = Folder::new();
    folder.write("tent.obj", "v 0 0 0\nv 2 0 0\nv 1 2 0\nv 1 1 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    let report = folder.ogee("convert --json tent.obj -o part.step --method g2").expect(0).json();
    assert_eq!(report["level"], 2);
    let places: Vec<&Value> = list(&report["nodes"]).iter().map(|node| &node["where"]).collect();
    for number in 0..4 {
        assert!(places.contains(&&json!({"face": number})) && places.contains(&&json!({"vertex": number})));
    }
    assert_eq!(places.len(), 8);
}

#[test]
fn a_vertex_without_a_cap_is_told_with_its_place() {
    let folder = folder_with_a_fold();
    let run = folder.ogee("convert --json fold.obj -o part.step --method g2").expect(0);
    let report = run.json();
    let notes: Vec<&Value> = list(&report["notes"]).iter().filter(|note| note["code"] == "no_cap").collect();
    assert_eq!(notes.len(), 1);
    assert_eq!(notes[0]["where"], json!({"vertex": 1}));
    assert_eq!(report["caps"], 7);
    let left: Vec<&Value> = list(&report["nodes"]).iter().filter(|node| node["kind"] == "pccm").collect();
    assert_eq!(left.len(), 1);
    assert_eq!((&left[0]["where"], &left[0]["degree"]), (&json!({"vertex": 1}), &json!(3)));
    assert_eq!(left[0]["faces"], Value::Null);

    let said = folder.ogee("convert fold.obj -o part.step --method g2").expect(0).stderr;
    assert!(said.lines().any(|line| line.starts_with("note: vertex 1 has no G2 cap: ")), "{said}");
    assert!(said.lines().any(|line| line.ends_with("7 of degree 7, 1 without")), "{said}");
    folder.ogee("check part.step").expect(0);
}

#[test]
fn a_deviation_raises_the_level_of_single_caps() {
    let folder = folder_with("hand.obj");
    let convert = |options: &str| {
        let command = format!("convert --json cage.obj -o part.step --method g2 {options}");
        folder.ogee(&command).expect(0).json()
    };
    let coarsest = convert("");
    let largest = number(&coarsest["max_deviation"]);
    let near = convert(&format!("--max-deviation {}", largest / 2.0));
    assert!(number(&near["max_deviation"]) < largest / 2.0);
    assert_eq!(near["caps"], coarsest["caps"]);
    let levels = |report: &Value| total(&report["nodes"], "level");
    assert!(levels(&near) > levels(&coarsest));
    for node in list(&coarsest["nodes"]).iter().filter(|node| number(&node["deviation"]) < largest / 4.0) {
        let same = list(&near["nodes"]).iter().find(|other| other["where"] == node["where"]).unwrap();
        assert_eq!(same["level"], node["level"], "{node}");
    }
    folder.ogee("check part.step").expect(0);
}

#[test]
fn a_deviation_out_of_reach_leaves_no_file() {
    let folder = Folder::with_cube();
    for options in ["--max-deviation 1e-12", "--max-deviation 1e-4 --level 1"] {
        let run =
            folder.ogee(&format!("convert --json cube.obj -o part.step --method g2 {options}")).expect(1);
        assert_eq!(run.json()["error"]["code"], "deviation");
        assert_eq!(folder.names(), ["cube.obj"]);
    }
    let run = folder.ogee("convert cube.obj -o part.step --method g2 --max-deviation 1e-12").expect(1);
    assert!(run.stderr.contains("at level 6, not below 1.000e-12"), "{}", run.stderr);
}

#[test]
fn a_level_is_the_least_of_all_caps() {
    let folder = Folder::with_cube();
    let mut last = f64::INFINITY;
    for level in 1..4 {
        let command = format!("convert --json cube.obj -o part.step --method g2 --level {level}");
        let report = folder.ogee(&command).expect(0).json();
        assert!(list(&report["nodes"]).iter().all(|node| node["level"] == level));
        assert_eq!(report["level"], level);
        let deviation = number(&report["max_deviation"]);
        assert!(deviation < last / 4.0, "valence 3 comes nearer by six with each level");
        last = deviation;
    }
}

#[test]
fn the_table_tells_of_levels_caps_and_jumps() {
    let folder = folder_with("hand.obj");
    let rows =
        |options: &str| folder.ogee(&format!("convert cage.obj -o part.step {options}")).expect(0).stderr;
    let row = |table: &str, name: &str| {
        let found: Vec<String> = table
            .lines()
            .filter_map(|line| line.trim_start().strip_prefix(name))
            .map(|text| text.trim().to_owned())
            .collect();
        assert!(found.len() <= 1, "{table}");
        found.into_iter().next()
    };
    for table in [rows("--method g2"), rows("--method g2 -v")] {
        let levels = row(&table, "levels").unwrap();
        assert_eq!(levels, "165 faces of the cage, 256 faces refined once, 144 faces refined twice");
        assert_eq!(row(&table, "caps").unwrap(), "34 of degree 7");
        assert!(row(&table, "curvature jump").unwrap().ends_with("at most, times the size"), "{table}");
    }
    let pccm = rows("");
    assert_eq!([row(&pccm, "caps"), row(&pccm, "curvature jump")], [None, None]);
    assert!(row(&rows("-v"), "curvature jump").is_some());
}

#[test]
fn quarters_of_quarters_have_a_path() {
    let folder = folder_with("hand.obj");
    for (options, field) in [("", "path"), ("--pack", "paths")] {
        let command = format!("convert --json cage.obj -o part.json --method g2 {options}");
        let report = folder.ogee(&command).expect(0).json();
        let part: Value = serde_json::from_slice(&folder.read("part.json")).unwrap();
        let patches = list(&part["patches"]);
        assert_eq!(patches.len() as u64, report["faces_written"]);
        let deep: Vec<&Value> = patches.iter().filter(|patch| patch.get(field).is_some()).collect();
        assert!(!deep.is_empty(), "{field}");
        for patch in &deep {
            if field == "path" {
                assert!(patch["corner"].is_u64());
                assert!(!list(&patch["path"]).is_empty());
            } else {
                let lengths = |rows: &Value| list(rows).iter().map(|row| list(row).len()).collect::<Vec<_>>();
                assert_eq!(lengths(&patch["paths"]), lengths(&patch["faces"]));
            }
        }
        let caps = patches.iter().filter(|patch| patch["degree"] == json!([7, 7])).count();
        assert_eq!(caps as f64, total(&report["nodes"], "faces"));

        let read = ogee_formats::patches::read(&folder.read("part.json")).unwrap();
        let names: BTreeSet<String> = read.iter().map(|patch| patch.quads[(0, 0)].to_string()).collect();
        assert_eq!(names.len(), read.len(), "names of patches are their own");
        assert!(names.iter().any(|name| name.split('.').count() == 3));

        let inspected = folder.ogee("inspect part.json --json").expect(0).json();
        assert_eq!(inspected["faces"], report["faces_written"], "{inspected}");
        assert_eq!(inspected["closed"], true);
    }
}

#[test]
fn bezier_pieces_of_caps_have_degree_seven() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.bv --method g2").expect(0);
    let text = String::from_utf8(folder.read("part.bv")).unwrap();
    let degrees = text.lines().filter(|line| line.split(' ').count() == 2).collect::<Vec<_>>();
    // Eight caps of three sectors of four pieces.
    assert_eq!(degrees, ["7 7"; 8 * 3 * 4]);
}

#[test]
fn help_says_what_it_is() {
    let help = String::from_utf8(Folder::new().ogee("convert --help").expect(0).stdout).unwrap();
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("g2 is curvature-continuous, with caps of degree 7"), "{help}");
}

#[test]
fn the_lint_finds_nothing_in_any_model() {
    let folder = Folder::new();
    for model in models() {
        let name = model.file_stem().unwrap().to_string_lossy().into_owned();
        std::fs::copy(&model, folder.path("cage.obj")).unwrap();
        let part = folder.ogee("convert --json cage.obj -o part.step --method g2").expect(0).json();
        let check = folder.ogee("check --json part.step").expect(0).json();
        assert_eq!(check["faults"], json!([]), "{name}");
        assert_eq!((&check["faces"], &check["solids"]), (&part["faces_written"], &part["solids"]), "{name}");
        assert_eq!((&check["edges"], &check["vertices"]), (&part["edges"], &part["vertices"]), "{name}");
        assert!(number(&part["max_curvature_jump"]) <= JUMP, "{name}");
        let size = number(&part["bbox"][1][0]) - number(&part["bbox"][0][0]);
        assert!(number(&part["max_gap"]) <= 1e-12 * size, "{name}");
    }
}
