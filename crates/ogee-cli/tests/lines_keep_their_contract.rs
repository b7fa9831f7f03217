//! `ogee lines`: polylines on the exact surface as SVG, OBJ and JSON, and clear words where there are none.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{CUBE, Folder, models};
use serde_json::{Value, json};

/// The name of a group, and the numbers of a line's points.
type Group = (String, Vec<usize>);

/// The coordinates of the vertices and the polylines of an OBJ, from 0, with their groups.
fn obj(text: &str) -> (Vec<[f64; 3]>, Vec<Group>) {
    let (mut vertices, mut lines, mut group) = (Vec::new(), Vec::new(), String::new());
    for line in text.lines() {
        let mut words = line.split(' ');
        match words.next().unwrap() {
            "v" => {
                let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
                vertices.push(numbers.try_into().unwrap());
            }
            "l" => {
                lines.push((group.clone(), words.map(|word| word.parse::<usize>().unwrap() - 1).collect()))
            }
            "g" => group = words.next().unwrap().to_owned(),
            other => panic!("{other}"),
        }
    }
    (vertices, lines)
}

fn text(folder: &Folder, name: &str) -> String {
    String::from_utf8(folder.read(name)).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn a_report_says_what_was_traced() {
    let folder = Folder::with_cube();
    for style in ["reflection", "highlight", "isophote"] {
        let report =
            folder.ogee(&format!("lines cube.obj --style {style} -o out.json --json")).expect(0).json();
        for field in ["values", "closed", "straight", "length", "turning_deg", "inflections", "notes"] {
            assert!(report.get(field).is_some(), "no {field} in {report}");
        }
        for field in ["read", "prepare", "trace", "write"] {
            assert!(report["seconds"][field].is_number(), "no {field} in {report}");
        }
        assert_eq!(report["style"], style);
        assert_eq!(report["file_bytes"], folder.read("out.json").len());
        assert!(number(&report["max_residual"]) < 1e-11, "{report}");
        let file: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
        let lines = file["lines"].as_array().unwrap();
        assert_eq!(report["lines"], lines.len());
        let points: usize = lines.iter().map(|line| line["points"].as_array().unwrap().len()).sum();
        assert_eq!(report["points"], points);
        let closed = lines.iter().filter(|line| line["closed"] == true).count();
        assert_eq!(report["closed"], closed);
        for line in lines {
            let points = line["points"].as_array().unwrap();
            assert_eq!(line["closed"] == true, points[0] == points[points.len() - 1]);
            for point in points {
                assert!(point["face"].is_u64() && point["corner"].is_null());
                for parameter in ["u", "v"] {
                    assert!((0.0..=1.0).contains(&number(&point[parameter])));
                }
            }
        }
        let values: Vec<f64> = lines.iter().map(|line| number(&line["value"])).collect();
        assert!(values.windows(2).all(|pair| pair[0] <= pair[1]));
    }
}

#[test]
fn every_format_has_the_same_lines() {
    let folder = Folder::with_cube();
    let style = "lines cube.obj --style isophote --hidden";
    for format in ["svg", "obj", "json"] {
        folder.ogee(&format!("{style} -o out.{format}")).expect(0);
    }
    let (vertices, lines) = obj(&text(&folder, "out.obj"));
    let file: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
    let records = file["lines"].as_array().unwrap();
    assert_eq!(lines.len(), records.len());
    for ((group, line), record) in lines.iter().zip(records) {
        assert_eq!(*group, format!("line_{}", record["index"]));
        let points = record["points"].as_array().unwrap();
        assert_eq!(line.len(), points.len());
        for (&vertex, point) in line.iter().zip(points) {
            assert_eq!(vertices[vertex], ["x", "y", "z"].map(|key| number(&point[key])));
        }
    }
    // One path for each, whether it is in sight or not, and outlines.
    let svg = text(&folder, "out.svg");
    assert_eq!(svg.matches("data-value=").count(), records.len());
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert!(svg.contains("viewBox=\"0 0 700 700\"") && svg.contains("<title>Isophotes of cube</title>"));
    assert!(svg.contains("<g id=\"edges\""));
}

#[test]
fn places_are_points_of_the_surface() {
    let folder = Folder::new();
    // A triangle, quads and a pentagon.
    folder.write(
        "house.obj",
        "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 3\nv 2 0 3\nv 0 2 3\nf 1 3 2\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n",
    );
    folder.ogee("lines house.obj --style isophote -o lines.json").expect(0);
    let file: Value = serde_json::from_slice(&folder.read("lines.json")).unwrap();
    let points: Vec<&Value> = file["lines"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|line| line["points"].as_array().unwrap())
        .collect();
    assert!(points.iter().any(|point| point["corner"].is_u64()));
    let rows: String = points
        .iter()
        .map(|point| json!({"face": point["face"], "corner": point["corner"], "u": point["u"], "v": point["v"]}))
        .map(|row| format!("{row}\n"))
        .collect();
    folder.write("points.jsonl", rows);
    folder.ogee("eval house.obj --at points.jsonl -o samples.jsonl").expect(0);
    for (row, point) in text(&folder, "samples.jsonl").lines().zip(points) {
        let row: Value = serde_json::from_str(row).unwrap();
        assert_eq!(row["position"], json!([point["x"], point["y"], point["z"]]));
    }
}

#[test]
fn the_front_and_what_is_in_sight_are_parts_of_all() {
    let folder = Folder::new();
    let mug = models().into_iter().find(|path| path.ends_with("mug.obj")).unwrap();
    folder.write("mug.obj", std::fs::read(mug).unwrap());
    let length = |options: &str| {
        let arguments = format!("lines mug.obj --style isophote {options} -o out.obj --json");
        number(&folder.ogee(&arguments).expect(0).json()["length"])
    };
    let (all, front, visible) = (length(""), length("--front"), length("--visible"));
    assert!(visible < 0.95 * front && front < 0.7 * all, "{visible} {front} {all}");
}

#[test]
fn more_lines_and_stripes_are_more_lines() {
    let folder = Folder::with_cube();
    let count = |options: &str| {
        let arguments = format!("lines cube.obj --style highlight {options} -o out.obj --json");
        folder.ogee(&arguments).expect(0).json()["values"].as_u64().unwrap()
    };
    let (usual, twice, stripes) = (count(""), count("--lines 40"), count("--width 0.3"));
    assert!(twice >= 2 * usual - 1 && stripes >= 2 * usual - 1, "{usual} {twice} {stripes}");
    // As many lines as were asked for lie on the plane, give or take the one in the middle.
    assert!(count("--light-plane 1,4 --lines 8") <= 9);
    let isophotes =
        folder.ogee("lines cube.obj --style isophote --step 30 -o out.obj --json").expect(0).json();
    assert_eq!(isophotes["values"], 5);
}

#[test]
fn equal_questions_give_equal_bytes_on_any_number_of_threads() {
    let folder = Folder::with_cube();
    for format in ["svg", "obj", "json"] {
        let on = |threads: u32| {
            folder.ogee(&format!("lines cube.obj --threads {threads} -o out.{format}")).expect(0);
            folder.read(&format!("out.{format}"))
        };
        let one = on(1);
        assert!(one == on(2) && one == on(1), "{format}");
    }
}

#[test]
fn lines_go_to_stdout_if_asked() {
    let folder = Folder::with_cube();
    let run = folder.ogee("lines cube.obj -o - --output-format obj").expect(0);
    assert!(run.stdout.starts_with(b"g line_"));
    folder.ogee("lines cube.obj -o -").expect(2);
    folder.ogee("lines cube.obj -o - --output-format obj --json").expect(2);
}

#[test]
fn a_part_has_lines_too() {
    let folder = Folder::with_cube();
    folder.ogee("convert cube.obj -o part.json").expect(0);
    let report = folder.ogee("lines part.json --style isophote -o out.svg --json").expect(0).json();
    assert!(report["lines"].as_u64().unwrap() > 3, "{report}");
}

#[test]
fn senseless_questions_get_clear_answers() {
    let folder = Folder::with_cube();
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    folder.write("point.obj", CUBE.replace("-1", "1"));
    folder.ogee("convert cube.obj -o part.json").expect(0);
    for (arguments, code, words) in [
        ("cube.obj -o out.png", 2, "unknown format png"),
        ("cube.obj --style zebra -o out.svg", 2, "known are reflection, highlight, isophote"),
        ("cube.obj --eye 1,1,1 --at 1,1,1 -o out.svg", 2, "the same point"),
        ("cube.obj --eye 0,0,9 --at 0,0,0 --up 0,0,1 -o out.svg", 2, "points along the view"),
        ("cube.obj --size 0x700 -o out.svg", 2, "700x500"),
        ("cube.obj --lines 0 -o out.svg", 2, "above 0"),
        ("cube.obj --tolerance 0 -o out.svg", 2, "above 0"),
        ("cube.obj --tolerance nan -o out.svg", 2, "no number"),
        ("cube.obj --visible --hidden -o out.svg", 2, "cannot be used with"),
        ("cube.obj --lines 1e12 -o out.svg", 3, "too many lines"),
        ("flat.obj --light-plane -5 -o out.svg", 3, "no ray from the surface meets the light plane"),
        (
            "flat.obj --style highlight --light-plane -5 -o out.svg",
            3,
            "no normal of the surface meets the light",
        ),
        (
            "flat.obj --style isophote -o out.svg",
            3,
            "turned from the light by 0 to 0 degrees: its faces are flat",
        ),
        ("part.json --boundary none -o out.svg", 2, "has patches"),
        (
            "flat.obj --style highlight --front --eye 0.5,0.4,-9 -o out.obj",
            3,
            "no line is where it was asked for",
        ),
        ("point.obj -o out.svg", 3, "size"),
        ("none.obj -o out.svg", 3, "none.obj"),
    ] {
        let run = folder.ogee(&format!("lines {arguments}")).expect(code);
        assert!(run.stderr.contains(words), "{arguments}: {}", run.stderr);
        assert!(!folder.names().iter().any(|name| name.starts_with("out")), "{arguments}");
    }
    let run = folder.ogee("lines flat.obj --light-plane -5 -o out.svg --json").expect(3);
    assert_eq!(run.json()["error"]["code"], "no_lines");
}

#[test]
fn edges_of_a_drawing_are_drawn_once() {
    let folder = Folder::new();
    let crease = "t crease 2/1/0 0 1 10\n";
    folder.write("cage.obj", format!("{CUBE}{crease}"));
    folder.ogee("lines cage.obj --hidden --style isophote -o out.svg").expect(0);
    let drawing = text(&folder, "out.svg");
    let (_, edges) = drawing.split_once("<g id=\"edges\"").unwrap();
    let (edges, _) = edges.split_once("</g>").unwrap();
    let edges = edges.lines().filter_map(|path| path.strip_prefix("<path d=\"M")?.strip_suffix("\"/>"));
    let ends: Vec<[&str; 2]> =
        edges.map(|path| [path.split('L').next().unwrap(), path.rsplit('L').next().unwrap()]).collect();
    for (k, [start, end]) in ends.iter().enumerate() {
        assert!(!ends[k + 1..].contains(&[end, start]), "{ends:?}");
    }
    assert!(!ends.is_empty());
}

/// Where a wall is upright up to rounding, the isophote of ninety degrees goes round it and leaves it alone.
#[test]
fn walls_have_no_specks() {
    let folder = Folder::new();
    let mug = models().into_iter().find(|path| path.ends_with("mug.obj")).unwrap();
    folder.ogee(&format!("lines {} --style isophote --step 90 -o out.json", mug.display())).expect(0);
    let file: Value = serde_json::from_slice(&folder.read("out.json")).unwrap();
    let lines = file["lines"].as_array().unwrap();
    let shortest = lines.iter().map(|line| number(&line["length"])).fold(f64::INFINITY, f64::min);
    assert!(shortest > 40.0, "a line of {shortest} mm on a mug");
}
