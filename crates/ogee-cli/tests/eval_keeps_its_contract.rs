//! `ogee eval`: one row out for each row in, in order, in both formats, in little memory; or nothing at all.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{CUBE, Folder, Run, finish};
use serde_json::{Value, json};

/// Two triangles and three quads, the triangles first.
const PRISM: &str = "\
v 0 0 0
v 2 0 0
v 0 2 0
v 0 0 3
v 2 0 3
v 0 2 3
f 1 3 2
f 4 5 6
f 1 2 5 4
f 2 3 6 5
f 3 1 4 6
";

/// Addresses on a prism, as values of JSON.
fn addresses() -> Vec<[Value; 4]> {
    let parameters = [(0.0, 0.0), (0.25, 0.5), (1.0, 1.0), (1.0 / 3.0, 0.1), (1e-9, 0.7)];
    let faces = [(4, None), (0, Some(2)), (2, None), (1, Some(0)), (0, Some(0))];
    let all = faces.iter().flat_map(|&(face, corner)| parameters.map(|(u, v)| (face, corner, u, v)));
    all.map(|(face, corner, u, v)| [json!(face), json!(corner), json!(u), json!(v)]).collect()
}

fn as_csv(addresses: &[[Value; 4]]) -> String {
    let field = |value: &Value| if value.is_null() { String::new() } else { value.to_string() };
    let rows = addresses.iter().map(|row| row.each_ref().map(field).join(",") + "\n");
    "face,corner,u,v\n".to_owned() + &rows.collect::<String>()
}

fn as_lines(addresses: &[[Value; 4]]) -> String {
    let row = |[face, corner, u, v]: &[Value; 4]| json!({"face": face, "corner": corner, "u": u, "v": v});
    addresses.iter().map(|address| format!("{}\n", row(address))).collect()
}

fn with_prism() -> Folder {
    let folder = Folder::new();
    folder.write("prism.obj", PRISM);
    folder.write("points.csv", as_csv(&addresses()));
    folder.write("points.jsonl", as_lines(&addresses()));
    folder
}

fn lines(folder: &Folder, name: &str) -> Vec<Value> {
    let text = String::from_utf8(folder.read(name)).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Rows of CSV as objects in the manner of JSON lines.
fn rows(folder: &Folder, name: &str) -> Vec<Value> {
    let text = String::from_utf8(folder.read(name)).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    assert_eq!(names[..7], ["face", "corner", "u", "v", "x", "y", "z"]);
    let value = |field: &str| match field {
        "" => Value::Null,
        field => serde_json::from_str(field).unwrap(),
    };
    let object = |fields: Vec<&str>| {
        assert_eq!(fields.len(), names.len());
        let mut object = serde_json::Map::new();
        let mut columns = names.iter().zip(fields);
        while let Some((name, field)) = columns.next() {
            let vector = if *name == "x" { Some("position") } else { name.strip_suffix("_x") };
            let Some(vector) = vector else {
                object.insert((*name).to_owned(), value(field));
                continue;
            };
            let [y, z] = [columns.next().unwrap().1, columns.next().unwrap().1];
            let coordinates = [field, y, z].map(value);
            let is_there = coordinates.iter().all(|coordinate| !coordinate.is_null());
            assert!(is_there || coordinates.iter().all(Value::is_null));
            object.insert(vector.to_owned(), if is_there { json!(coordinates) } else { Value::Null });
        }
        Value::Object(object)
    };
    lines.map(object).collect()
}

fn fed(folder: &Folder, arguments: &str, stdin: impl Into<Vec<u8>>) -> Run {
    let mut command = folder.command(arguments);
    command.write_stdin(stdin);
    finish(command)
}

#[test]
fn a_row_comes_out_for_each_row_that_goes_in() {
    let folder = with_prism();
    for points in ["points.csv", "points.jsonl"] {
        let arguments = format!("eval prism.obj --at {points} -o out.jsonl --json");
        let report = folder.ogee(&arguments).expect(0).json();
        for field in ["at_extraordinary", "normals_undefined", "seconds", "peak_bytes", "notes"] {
            assert!(report.get(field).is_some(), "no {field} in {report}");
        }
        for field in ["read", "prepare", "evaluate", "write"] {
            assert!(report["seconds"][field].is_number(), "no {field} in {report}");
        }
        assert_eq!((&report["samples"], &report["derivatives"]), (&json!(25), &json!(1)));
        assert_eq!(report["parametric_faces"], 9);
        assert_eq!(report["file_bytes"], folder.read("out.jsonl").len());
        let found: Vec<[Value; 4]> = lines(&folder, "out.jsonl")
            .iter()
            .map(|row| ["face", "corner", "u", "v"].map(|key| row[key].clone()))
            .collect();
        let numbers = |rows: &[[Value; 4]]| {
            rows.iter().map(|row| row.each_ref().map(Value::as_f64)).collect::<Vec<_>>()
        };
        assert_eq!(numbers(&found), numbers(&addresses()), "{points}");
    }
}

#[test]
fn fields_are_those_that_were_asked_for() {
    let folder = with_prism();
    let address = "face corner u v";
    for (options, fields) in [
        ("--derivatives 0", "position"),
        ("", "position du dv normal"),
        ("--derivatives 1", "position du dv normal"),
        ("--derivatives 2", "position du dv duu duv dvv normal k1 k2"),
    ] {
        folder.ogee(&format!("eval prism.obj --at points.csv {options} -o out.ndjson")).expect(0);
        folder.ogee(&format!("eval prism.obj --at points.csv {options} -o out.csv")).expect(0);
        let text = String::from_utf8(folder.read("out.ndjson")).unwrap();
        let mut at = 0;
        for field in address.split(' ').chain(fields.split(' ')) {
            let next = text.find(&format!("\"{field}\":")).unwrap_or_else(|| panic!("no {field}: {text}"));
            assert!(next > at, "{field}");
            at = next;
        }
        let found = lines(&folder, "out.ndjson");
        assert!(found.iter().all(|row| row.as_object().unwrap().len() == 4 + fields.split(' ').count()));
        assert!(
            found.iter().all(|row| row["position"].as_array().is_some_and(|position| position.len() == 3))
        );
        // Both formats say the same, to the last bit.
        let numbers = |rows: Vec<Value>| {
            let bits = |value: &Value| match value {
                Value::Array(vector) => vector.iter().map(|x| x.as_f64().unwrap().to_bits()).collect(),
                value => Vec::from_iter(value.as_f64().map(f64::to_bits)),
            };
            let sorted = |row: &Value| {
                let mut all: Vec<_> =
                    row.as_object().unwrap().iter().map(|(key, value)| (key.clone(), bits(value))).collect();
                all.sort();
                all
            };
            rows.iter().map(sorted).collect::<Vec<_>>()
        };
        assert_eq!(numbers(found), numbers(rows(&folder, "out.csv")), "{options}");
    }
}

#[test]
fn points_may_be_written_in_many_ways() {
    let folder = with_prism();
    folder.ogee("eval prism.obj --at points.csv -o wanted.csv").expect(0);
    let wanted = folder.read("wanted.csv");
    let csv = as_csv(&addresses());
    let turned: String = csv
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .map(|f| format!("{}, \"{}\",{},{}\r\n", f[3], f[0], f[2], f[1]))
        .collect();
    let files = [
        ("marked.csv", format!("\u{feff}{csv}\n \n\n")),
        ("return.csv", csv.replace('\n', "\r\n")),
        ("old.csv", csv.replace('\n', "\r")),
        ("cut.csv", csv.trim_end().to_owned()),
        ("turned.csv", turned),
        ("floats.csv", csv.replace("0,2,", "0.0,2.0,")),
        ("marked.ndjson", format!("\u{feff}{}\n", as_lines(&addresses()))),
        ("plain.json", as_lines(&addresses()).replace("\"corner\":null,", "")),
        ("return.jsonl", as_lines(&addresses()).replace('\n', "\r\n")),
    ];
    for (name, text) in files {
        folder.write(name, text);
        folder.ogee(&format!("eval prism.obj --at {name} -o out.csv")).expect(0);
        assert!(folder.read("out.csv") == wanted, "{name}");
    }
    folder.write("named", csv);
    folder.ogee("eval prism.obj --at named --points-format csv -o out.csv").expect(0);
    assert!(folder.read("out.csv") == wanted);
    // Quads have no corners to name.
    folder.write("quads.csv", "face,u,v\n2,0.5,0.5\n");
    folder.ogee("eval prism.obj --at quads.csv -o out.csv").expect(0);
}

#[test]
fn a_grid_covers_every_face_that_is_visible() {
    let folder = with_prism();
    let report = folder.ogee("eval prism.obj --uniform 3 -o out.jsonl --json").expect(0).json();
    assert_eq!((&report["samples"], &report["parametric_faces"]), (&json!(9 * 16), &json!(9)));
    let found = lines(&folder, "out.jsonl");
    assert_eq!(found.len(), 9 * 16);
    let key = |row: &Value| {
        let [v, u] = ["v", "u"].map(|key| (3.0 * row[key].as_f64().unwrap()).round() as u64);
        (row["face"].as_u64(), row["corner"].as_u64(), v, u)
    };
    let keys: Vec<_> = found.iter().map(key).collect();
    assert!(keys.is_sorted() && keys.windows(2).all(|pair| pair[0] != pair[1]), "{keys:?}");
    assert_eq!((keys[0], keys[143]), ((Some(0), Some(0), 0, 0), (Some(4), None, 3, 3)));
    assert_eq!(found[143]["u"], 1.0);

    let threads = ["--threads 1", "--threads 2"].map(|threads| {
        folder.ogee(&format!("eval prism.obj --uniform 60 --derivatives 2 -o out.csv {threads}")).expect(0);
        folder.read("out.csv")
    });
    assert!(threads[0] == threads[1]);
    assert_eq!(threads[0].iter().filter(|&&b| b == b'\n').count(), 1 + 9 * 61 * 61);
}

#[test]
fn stdin_and_stdout_serve_as_files() {
    let folder = with_prism();
    folder.ogee("eval prism.obj --at points.csv -o out.csv").expect(0);
    let wanted = folder.read("out.csv");
    let names = folder.names();
    let run = folder.ogee("eval prism.obj --at points.csv -o - --format csv").expect(0);
    assert!(run.stdout == wanted && run.first_line() == "prism.obj -> stdout");
    let run = folder.ogee("eval prism.obj --at points.csv -o - --output-format csv -q").expect(0);
    assert!(run.stdout == wanted && run.stderr.is_empty());
    for (format, text) in [("csv", as_csv(&addresses())), ("jsonl", as_lines(&addresses()))] {
        let arguments = format!("eval prism.obj --at - --points-format {format} -o - --format csv");
        assert!(fed(&folder, &arguments, text).expect(0).stdout == wanted);
    }
    let run = fed(&folder, "eval - --input-format obj --at points.csv -o - --format csv", PRISM).expect(0);
    assert!(run.stdout == wanted);
    assert_eq!(folder.names(), names);
}

#[test]
fn a_bad_row_is_named_and_nothing_is_written() {
    let cases = [
        ("csv", "9,,0.5,0.5", "missing_face"),
        ("csv", "-1,,0.5,0.5", "bad_number"),
        ("csv", "2.5,,0.5,0.5", "bad_number"),
        ("csv", "5000000000,,0.5,0.5", "missing_face"),
        ("csv", "2,,nan,0.5", "not_finite"),
        ("csv", "2,,0.5,inf", "not_finite"),
        ("csv", "2,,half,0.5", "bad_number"),
        ("csv", "2,,,0.5", "missing_number"),
        ("csv", "2,,0.5", "malformed_line"),
        ("csv", "2,,0.5,0.5,0.5", "malformed_line"),
        ("jsonl", r#"{"face":9,"u":0.5,"v":0.5}"#, "missing_face"),
        ("jsonl", r#"{"face":-1,"u":0.5,"v":0.5}"#, "bad_number"),
        ("jsonl", r#"{"face":"2","u":0.5,"v":0.5}"#, "bad_number"),
        ("jsonl", r#"{"face":2,"u":0.5}"#, "missing_number"),
        ("jsonl", r#"{"face":2,"u":NaN,"v":0.5}"#, "bad_json"),
        ("jsonl", r#"{"face":2,"u":0.5,"v":0.5,"w":1}"#, "unknown_key"),
        ("jsonl", r#"{"face":2,"u":0.5,"v":0.5,"v":1}"#, "malformed_line"),
        ("jsonl", "2,,0.5,0.5", "bad_json"),
    ];
    let folder = with_prism();
    folder.write("out.csv", "what was there");
    for (format, row, code) in cases {
        let (name, good) = match format {
            "csv" => ("bad.csv", as_csv(&addresses())),
            _ => ("bad.jsonl", as_lines(&addresses())),
        };
        let number = good.lines().count() + 1;
        // The last row of many: all blocks before it were good.
        folder.write(name, format!("{good}{row}\n"));
        let names = folder.names();
        let wanted = format!("{name}:{number}: ");
        for output in ["-o out.csv", "-o new.csv"] {
            let run = folder.ogee(&format!("eval prism.obj --at {name} {output} --json")).expect(3);
            assert!(run.first_line().starts_with(&wanted), "{row}: {}", run.stderr);
            assert_eq!(run.stderr.lines().count(), 1);
            let error = &run.json()["error"];
            assert_eq!((&error["code"], &error["where"]["line"]), (&json!(code), &json!(number)), "{row}");
            assert_eq!(error["where"]["file"], name);
        }
        let run = folder.ogee(&format!("eval prism.obj --at {name} -o - --format csv")).expect(3);
        assert_eq!(run.stdout, b"", "{row}");
        assert_eq!(folder.names(), names);
        assert_eq!(folder.read("out.csv"), b"what was there");
    }
}

#[test]
fn a_bad_row_after_many_blocks_leaves_nothing_either() {
    let folder = Folder::with_cube();
    let text = "face,u,v\n".to_owned() + &"0,0.5,0.5\n".repeat(30_000) + "77,0.5,0.5\n";
    folder.write("points.csv", text);
    let run = folder.ogee("eval cube.obj --at points.csv -o out.csv").expect(3);
    assert!(run.first_line().starts_with("points.csv:30002: there is no face 77"), "{}", run.stderr);
    let run = folder.ogee("eval cube.obj --at points.csv -o - --format jsonl").expect(3);
    assert_eq!(run.stdout, b"");
    assert_eq!(folder.names(), ["cube.obj", "points.csv"]);
}

#[test]
fn bad_rows_are_listed_in_order_and_then_counted() {
    let folder = Folder::with_cube();
    let text = "face,u,v\n".to_owned() + &"99,0,0\n0,0,0\n0,x,0\n".repeat(20_000);
    folder.write("points.csv", text);
    let run = folder.ogee("eval cube.obj --at points.csv -o out.csv --json").expect(3);
    assert!(run.first_line().starts_with("points.csv:2: there is no face 99"), "{}", run.first_line());
    assert_eq!(run.stderr.lines().nth(1), Some("points.csv:4: u is `x`, which is no number"));
    assert_eq!((run.stderr.lines().count(), run.stderr.lines().last()), (22, Some("and 39979 more")));
    let error = &run.json()["error"];
    assert_eq!((error["others"].as_array().unwrap().len(), &error["more"]), (20, &json!(39979)));
    assert_eq!(folder.names(), ["cube.obj", "points.csv"]);
}

#[test]
fn a_file_of_points_that_makes_no_sense_is_refused() {
    let folder = Folder::with_cube();
    let long = format!("face,u,v\n0,0,{}0\n", " ".repeat(70_000));
    let cases: [(&str, &[u8], &str, &str); 14] = [
        ("empty.csv", b"", "no_samples", ": "),
        ("empty.jsonl", b"", "no_samples", ": "),
        ("blank.jsonl", b"\n \r\n\n", "no_samples", ": "),
        ("header.csv", b"face,corner,u,v\n", "no_samples", ": "),
        ("column.csv", b"face,corner,u\n0,,0\n", "bad_header", ":1: column v is missing"),
        ("unknown.csv", b"\nface,u,v,w\n0,0,0,0\n", "bad_header", ":2: unknown column `w`"),
        ("twice.csv", b"face,u,v,u\n0,0,0,0\n", "bad_header", ":1: column u is there twice"),
        ("headless.csv", b"0,0.5,0.5\n", "bad_header", ":1: unknown column `0`"),
        ("zero.csv", b"\0\0\0", "not_text", ": "),
        ("wide.csv", b"\xff\xfef\0a\0", "not_text", ": "),
        ("list.json", b"[{\"face\":0,\"u\":0,\"v\":0}]", "bad_json", ":1: every line wants"),
        ("cut.jsonl", b"{\"face\":0,\"u\":0,\"v\"", "bad_json", ":1: "),
        ("long.csv", long.as_bytes(), "malformed_line", ":2: the line is longer than"),
        ("bytes.csv", b"face,u,v\n0,\xff,0\n", "bad_number", ":2: u is `\u{fffd}`"),
    ];
    for (name, bytes, code, said) in cases {
        folder.write(name, bytes);
        let names = folder.names();
        let run = folder.ogee(&format!("eval cube.obj --at {name} -o out.csv --json")).expect(3);
        let wanted = format!("{name}{said}");
        assert!(run.first_line().starts_with(&wanted), "{}", run.first_line());
        assert_eq!(run.json()["error"]["code"], code, "{name}");
        assert_eq!((run.stderr.lines().count(), folder.names()), (1, names));
    }
    let run = fed(&folder, "eval cube.obj --at - --points-format csv -o out.csv", "face,u,v\n0,0,0\n9,0,0\n");
    assert!(run.expect(3).first_line().starts_with("stdin:3: there is no face 9"));
    let run = folder.ogee("eval cube.obj --at none.csv -o out.csv --json").expect(3);
    assert_eq!(run.json()["error"]["code"], "unreadable");
    std::fs::create_dir(folder.path("folder.csv")).unwrap();
    folder.ogee("eval cube.obj --at folder.csv -o out.csv").expect(3);
}

#[test]
fn a_bad_cage_is_refused_as_everywhere() {
    let folder = with_prism();
    folder.write("bad.obj", format!("{PRISM}f 1 2 99\n"));
    let run = folder.ogee("eval bad.obj --uniform 2 -o out.csv").expect(3);
    assert!(run.first_line().starts_with("bad.obj:12: face 5 uses vertex 98"), "{}", run.first_line());
    folder.write("tie.obj", format!("{PRISM}f 1 3 2\n"));
    let run = folder.ogee("eval tie.obj --at points.csv -o out.csv --json").expect(3);
    assert!(run.json()["error"]["where"]["line"].is_number(), "{}", run.stderr);
    folder.write("odd.obj", format!("{PRISM}v 9 9 9\n"));
    let report = folder.ogee("eval odd.obj --uniform 1 -o out.csv --json").expect(0).json();
    assert_eq!(report["notes"][0]["code"], "isolated_vertex");
}

#[test]
fn mistakes_in_typing_are_usage_errors() {
    let folder = with_prism();
    let names = folder.names();
    for (arguments, said) in [
        ("eval prism.obj -o out.csv", "--at"),
        ("eval prism.obj --at points.csv --uniform 2 -o out.csv", "cannot be used with"),
        ("eval prism.obj --at points.csv", "--output"),
        ("eval prism.obj --at points.csv -o -", "--format"),
        ("eval prism.obj --at points.csv -o out", "--format"),
        ("eval prism.obj --at points.csv -o out.json", "unknown format"),
        ("eval prism.obj --at points.csv -o out.csv --format xml", "known are jsonl, ndjson, csv"),
        ("eval prism.obj --at points.csv -o - --format csv --json", "both want stdout"),
        ("eval prism.obj --at prism.obj -o out.csv", "--points-format"),
        ("eval prism.obj --at - -o out.csv", "--points-format"),
        ("eval - --input-format obj --at - --points-format csv -o out.csv", "both want stdin"),
        ("eval prism.obj --uniform 2 --points-format csv -o out.csv", "cannot be used with"),
        ("eval prism.obj --uniform 0 -o out.csv", "--uniform"),
        ("eval prism.obj --uniform 100000 -o out.csv", "--uniform"),
        ("eval prism.obj --uniform 2 --derivatives 3 -o out.csv", "known are 0, 1, 2"),
        ("eval prism.obj --uniform 2 --lens c3 -o out.csv", "known are auto, c1, c2, degree-raise, identify"),
    ] {
        let run = folder.ogee(arguments).expect(2);
        assert!(run.stderr.contains(said), "{arguments}: {}", run.stderr);
        assert_eq!(folder.names(), names);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn devices_and_pipes_take_all_or_nothing() {
    use std::os::unix::fs::FileTypeExt;
    let folder = with_prism();
    let run = folder.ogee("eval prism.obj --uniform 9 -o /dev/full --format csv").expect(4);
    assert_eq!(run.first_line(), "/dev/full: not written: No space left on device");
    assert!(std::fs::metadata("/dev/full").unwrap().file_type().is_char_device());
    folder.ogee("eval prism.obj --uniform 9 -o /dev/null --format csv").expect(0);
    let run = folder.ogee("eval prism.obj --uniform 9 -o nowhere/out.csv").expect(4);
    assert_eq!(run.first_line(), "nowhere/out.csv: not written: the folder nowhere does not exist");
    // A row that is refused reaches no device: its failure would be of the output.
    folder.write("bad.csv", "face,u,v\n2,0,0\n99,0,0\n");
    folder.ogee("eval prism.obj --at bad.csv -o /dev/full --format csv").expect(3);
}

#[test]
fn the_points_may_be_replaced_by_their_samples() {
    let folder = with_prism();
    let names = folder.names();
    folder.ogee("eval prism.obj --at points.csv -o points.csv").expect(0);
    assert_eq!(rows(&folder, "points.csv").len(), 25);
    assert_eq!(folder.names(), names);
}

#[test]
#[cfg(target_os = "linux")]
fn memory_does_not_grow_with_the_number_of_points() {
    let folder = Folder::new();
    folder.write("cube.obj", CUBE);
    let peak = |arguments: &str, samples: u64| {
        let report = folder.ogee(&format!("eval cube.obj {arguments} -o out.csv --json")).expect(0).json();
        assert_eq!(report["samples"], samples);
        report["peak_bytes"].as_f64().unwrap()
    };
    let few = peak("--uniform 57 --derivatives 2", 6 * 58 * 58);
    let many = peak("--uniform 200 --derivatives 2", 6 * 201 * 201);
    assert!(many < 1.25 * few, "{few} bytes, then {many}");
    let points = |count: usize| "face,u,v\n".to_owned() + &"3,0.125,0.75\n".repeat(count);
    folder.write("few.csv", points(20_000));
    folder.write("many.csv", points(2_000_000));
    let few = peak("--at few.csv --derivatives 0", 20_000);
    let many = peak("--at many.csv --derivatives 0", 2_000_000);
    assert!(many < 1.25 * few, "{few} bytes, then {many}");
}

#[test]
fn an_address_off_the_surface_is_refused_with_its_line() {
    let cases = [
        ("2,0,0.5,0.5", "corner_on_quad", "face 2 is a quad, which takes no corner"),
        ("0,,0.5,0.5", "corner_wanted", "face 0 has 3 corners, and one of them has to be named"),
        ("0,3,0.5,0.5", "missing_corner", "face 0 has no corner 3, only 3"),
        ("5,,0.5,0.5", "missing_face", "there is no face 5, only 5"),
        ("2,,1.5,0.2", "outside_square", "the parameters (1.5, 0.2) are not in [0, 1]"),
        ("2,,0.5,-0.0001", "outside_square", "the parameters (0.5, -0.0001) are not in [0, 1]"),
        (
            "2,,1.0000000000000002,0",
            "outside_square",
            "the parameters (1.0000000000000002, 0.0) are not in [0, 1]",
        ),
    ];
    let folder = with_prism();
    let points = as_csv(&addresses());
    let number = points.lines().count() + 1;
    for (row, code, message) in cases {
        folder.write("bad.csv", format!("{points}{row}\n"));
        let names = folder.names();
        let run = folder.ogee("eval prism.obj --at bad.csv -o out.csv --json").expect(3);
        assert_eq!(run.stderr, format!("bad.csv:{number}: {message}\n"));
        let error = &run.json()["error"];
        assert_eq!((&error["code"], &error["message"]), (&json!(code), &json!(message)));
        let face: u32 = row[..1].parse().unwrap();
        let mut place = json!({"file": "bad.csv", "line": number});
        if code != "missing_face" {
            place["face"] = json!(face);
        }
        assert_eq!(error["where"], place, "{row}");
        assert_eq!(folder.names(), names);
    }
}

#[test]
fn faces_that_are_hidden_have_no_samples() {
    let folder = Folder::new();
    folder.write(
        "cage.json",
        r#"{"vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,0]],
        "faces": [[0,1,2,3],[1,4,5,2]], "holes": [0]}"#,
    );
    let report = folder.ogee("eval cage.json --uniform 2 -o out.jsonl --json").expect(0).json();
    assert_eq!((&report["samples"], &report["parametric_faces"]), (&json!(9), &json!(1)));
    assert!(lines(&folder, "out.jsonl").iter().all(|row| row["face"] == 1));
    folder.write("points.csv", "face,u,v\n1,0,0\n0,0,0\n");
    let run = folder.ogee("eval cage.json --at points.csv -o out.csv --json").expect(3);
    assert_eq!(run.first_line(), "points.csv:3: face 0 is no part of the surface");
    assert_eq!(run.json()["error"]["code"], "hidden_face");
    let run = folder.ogee("eval cage.json --boundary none --uniform 2 -o out.csv --json").expect(3);
    assert_eq!(run.json()["error"]["code"], "no_surface");
}

#[test]
fn lenses_are_left_as_they_are_unless_something_is_asked_for() {
    let folder = Folder::with_wing();
    let bytes = ["", "--lens auto", "--lens c1"].map(|lens| {
        let arguments = format!("eval wing.obj --uniform 4 --derivatives 2 {lens} -o out.csv --json");
        let report = folder.ogee(&arguments).expect(0).json();
        assert_eq!((&report["notes"], &report["curvature_unbounded"]), (&json!([]), &json!(8)));
        folder.read("out.csv")
    });
    assert!(bytes[1] == bytes[0] && bytes[2] == bytes[0]);
}

#[test]
fn caps_are_evaluated_at_the_addresses_of_the_cage() {
    let folder = Folder::with_wing();
    let samples = |lens: &str, note: &str, extraordinary: u64| {
        let arguments =
            format!("eval wing.obj --uniform 4 --derivatives 2 --lens {lens} -o {lens}.jsonl --json");
        let report = folder.ogee(&arguments).expect(0).json();
        assert_eq!((&report["parametric_faces"], &report["curvature_unbounded"]), (&json!(56), &json!(0)));
        assert_eq!(report["at_extraordinary"], extraordinary, "{lens}");
        assert_eq!(report["notes"][0]["code"], "lenses_treated");
        assert_eq!(report["notes"][0]["message"], note);
        let rows = lines(&folder, &format!("{lens}.jsonl"));
        for row in &rows {
            // No curvature is missing anywhere, and no normal.
            assert!(row["k1"].is_number() && row["k2"].is_number() && row["normal"].is_array(), "{row}");
        }
        rows
    };
    folder.ogee("eval wing.obj --uniform 4 --derivatives 2 -o plain.jsonl").expect(0);
    let plain = lines(&folder, "plain.jsonl");
    let whose = "addresses are those of the cage in the file";
    // Each lens is a corner of two faces; of polar caps all of a slit is the pole.
    for (lens, extraordinary) in [("c2", 8), ("degree-raise", 8), ("polar", 80)] {
        let rows = samples(lens, &format!("lenses and poles: 4 by {lens}; {whose}"), extraordinary);
        assert_eq!(rows.len(), plain.len());
        let mut same = 0;
        for (row, plain) in rows.iter().zip(&plain) {
            for key in ["face", "corner", "u", "v"] {
                assert_eq!(row[key], plain[key]);
            }
            same += usize::from(row == plain);
        }
        // The bands of faces in the middle have no cap.
        assert!((24 * 25..56 * 25).contains(&same), "{lens}: {same}");
    }
}

#[test]
fn a_cage_that_was_meshed_anew_takes_the_place_of_the_cage() {
    let folder = Folder::with_wing();
    for lens in ["identify", "remove", "merge"] {
        let arguments = format!("eval wing.obj --uniform 4 --derivatives 2 --lens {lens} -o one.csv --json");
        let report = folder.ogee(&arguments).expect(0).json();
        let note =
            format!("lenses and poles: 4 by {lens}; addresses are those of the cage that ogee lens writes");
        assert_eq!(report["notes"][0]["message"], note);
        folder.ogee(&format!("lens wing.obj --method {lens} -o other.json")).expect(0);
        folder.ogee("eval other.json --uniform 4 --derivatives 2 -o two.csv").expect(0);
        assert!(folder.read("one.csv") == folder.read("two.csv"), "{lens}");
    }
}

#[test]
fn what_was_refined_first_is_noted_and_what_cannot_be_is_refused() {
    let folder = with_prism();
    let note = |arguments: &str| {
        let report = folder.ogee(&format!("eval {arguments} --uniform 2 -o out.csv --json")).expect(0).json();
        report["notes"][0]["message"].as_str().unwrap().to_owned()
    };
    let whose = "addresses are those of the cage in the file";
    assert_eq!(note("prism.obj --lens c2"), format!("lenses and poles: none; {whose}"));
    // Two quads in the place of one, beside a vertex of valence 3.
    let doublet = CUBE.replace("f 5 6 8 7\n", "v 0 0 1\nf 5 6 8 9\nf 5 9 8 7\n");
    folder.write("doublet.obj", doublet);
    assert_eq!(
        note("doublet.obj --lens c2"),
        format!("lenses and poles: 1 by c2, refined 2 times first; {whose}")
    );
    let names = folder.names();
    let run = folder.ogee("eval doublet.obj --lens polar --uniform 2 -o no.csv --json").expect(3);
    assert_eq!(run.json()["error"]["code"], "no_partner");
    assert_eq!(folder.names(), names);
}
