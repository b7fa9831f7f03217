//! Every kind of bad input: the exit code, one clear line, no output, and what was there before stays.

mod common;

use common::{CUBE, Folder, Run};

/// A file, what its refusal is called, and how the first line begins after the file's name.
struct Bad {
    file: &'static str,
    bytes: Vec<u8>,
    code: &'static str,
    line: &'static str,
}

fn bad(file: &'static str, bytes: impl Into<Vec<u8>>, code: &'static str, line: &'static str) -> Bad {
    Bad { file, bytes: bytes.into(), code, line }
}

fn with(text: &str) -> String {
    format!("{CUBE}{text}\n")
}

fn cases() -> Vec<Bad> {
    let binary: Vec<u8> = (0..=255).cycle().take(4096).collect();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    vec![
        bad("empty.obj", "", "no_faces", ": the file is empty"),
        bad("blank.off", "\n  \n", "no_faces", ": the file is empty"),
        bad("empty.json", "", "no_faces", ": the file is empty"),
        bad("binary.obj", binary.clone(), "not_text", ": "),
        bad("binary.off", binary.clone(), "not_text", ": "),
        bad("binary.json", binary.clone(), "not_text", ": "),
        bad("binary.ply", binary, "bad_header", ":1: "),
        bad("no_faces.obj", corners, "no_faces", ": "),
        bad(
            "truncated.obj",
            format!("{corners}v 1 1\nf 1 2 3\n"),
            "missing_number",
            ":5: vertex 4 has only 2",
        ),
        bad("truncated.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1", "missing_number", ":5: vertex 2 has only 2"),
        bad("truncated.json", "{\"vertices\": [[0,0", "bad_json", ":1: "),
        bad("word.obj", format!("{corners}f 1 2 three\n"), "bad_number", ":5: face 0"),
        bad("nan.obj", with("v nan 0 0"), "not_finite", ":15: vertex 8"),
        bad("infinite.obj", with("v 0 -inf 0"), "not_finite", ":15: vertex 8"),
        bad("large.obj", with("v 0 1e999 0"), "not_finite", ":15: vertex 8"),
        bad("range.obj", with("f 1 2 99"), "missing_vertex", ":15: face 6 uses vertex 98, the file has 8"),
        bad("zero.obj", with("f 1 2 0"), "missing_vertex", ":15: face 6"),
        bad("back.obj", with("f 1 2 -99"), "missing_vertex", ":15: face 6"),
        bad("repeated.obj", with("f 1 2 3 2"), "repeated_vertex", ":15: face 6 uses vertex 1 more than once"),
        bad("two.obj", with("f 1 2"), "face_too_small", ":15: face 6 has 2 corners"),
        bad(
            "three.obj",
            format!("{corners}v 0 0 -1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"),
            "non_manifold_edge",
            ":8: edge 0-1 belongs to 3 faces",
        ),
        bad("flipped.obj", CUBE.replace("f 1 5 7 3", "f 3 7 5 1"), "flipped_face", ":13: faces 4 and"),
        bad(
            "tie.obj",
            format!("{corners}v 5 5 5\nf 1 2 3\nf 1 4 5\n"),
            "non_manifold_vertex",
            ":7: vertex 0 joins 2",
        ),
        bad("crease.obj", with("t crease 2/1/0 0 7 3"), "crease_off_edge", ":15: crease 0-7 names no edge"),
        bad("corner.obj", with("t corner 1/1/0 99 3"), "corner_off_vertex", ":15: "),
    ]
}

fn check(folder: &Folder, run: &Run, case: &Bad, what: &str) {
    assert_eq!(run.code, 3, "{what} {}: {}", case.file, run.stderr);
    let wanted = format!("{}{}", case.file, case.line);
    assert!(run.first_line().starts_with(&wanted), "{what}: {} is not {wanted}", run.first_line());
    assert!(folder.names().iter().all(|name| !name.contains("tmp-")), "{:?}", folder.names());
}

#[test]
fn no_file_comes_of_a_bad_cage() {
    for case in cases() {
        let folder = Folder::new();
        folder.write(case.file, &case.bytes);
        for what in ["convert -o out.step", "refine -l 1 -o out.obj"] {
            let run = folder.ogee(&format!("{what} {}", case.file));
            check(&folder, &run, &case, what);
            assert_eq!(run.stdout, b"");
            assert_eq!(folder.names(), [case.file], "{what}");
        }
        folder.write("out.step", "what was there");
        let run = folder.ogee(&format!("convert --json {} -o out.step", case.file));
        check(&folder, &run, &case, "convert --json");
        assert_eq!(folder.read("out.step"), b"what was there");
        let error = &run.json()["error"];
        assert_eq!(error["code"], case.code);
        assert_eq!(error["where"]["file"], case.file);
        let line = case.line.strip_prefix(':').and_then(|rest| rest.split(':').next());
        assert_eq!(error["where"]["line"].as_u64(), line.and_then(|line| line.parse().ok()), "{}", case.file);
    }
}

#[test]
fn info_refuses_the_same_and_describes_what_can_be_described() {
    for case in cases() {
        let folder = Folder::new();
        folder.write(case.file, &case.bytes);
        let run = folder.ogee(&format!("info --json {}", case.file));
        check(&folder, &run, &case, "info");
        let report = run.json();
        if report["defects"].is_null() {
            assert_eq!(report["error"]["code"], case.code);
        } else {
            assert_eq!(report["defects"][0]["code"], case.code);
            assert!(report["faces"].as_u64().unwrap() >= 2);
            assert_eq!(report["components"][0]["genus"], serde_json::Value::Null);
        }
    }
}

#[test]
fn places_are_told_in_json() {
    let folder = Folder::new();
    folder.write("range.obj", with("f 1 2 99"));
    let error = folder.ogee("convert --json range.obj -o out.step").json()["error"].clone();
    assert_eq!(error["message"], "face 6 uses vertex 98, the file has 8");
    assert_eq!(error["where"], serde_json::json!({"file": "range.obj", "line": 15, "face": 6}));
}

#[test]
fn twenty_others_are_listed_then_counted() {
    let folder = Folder::new();
    folder.write("many.obj", with(&"f 1 2 99\n".repeat(50)));
    let run = folder.ogee("convert --json many.obj -o out.step").expect(3);
    assert_eq!(run.stderr.lines().count(), 22);
    assert_eq!(run.stderr.lines().last(), Some("and 29 more"));
    let error = &run.json()["error"];
    assert_eq!((error["others"].as_array().unwrap().len(), &error["more"]), (20, &29.into()));
}

#[test]
fn isolated_vertices_and_unknown_tags_are_notes() {
    let folder = Folder::new();
    folder.write("odd.obj", with("v 9 9 9\nt wibble 1/0/0 3"));
    for what in ["convert odd.obj -o out.step", "refine -l 1 odd.obj -o out.obj", "info odd.obj"] {
        let run = folder.ogee(&format!("{what} --json")).expect(0);
        let notes = run.json()["notes"].clone();
        assert_eq!(notes[0]["code"], "unknown_tag", "{what}");
        assert_eq!(notes[0]["where"]["line"], 16);
        assert_eq!((&notes[1]["code"], &notes[1]["where"]["vertex"]), (&"isolated_vertex".into(), &8.into()));
        assert!(run.stderr.contains("note: odd.obj:16: "), "{}", run.stderr);
    }
}

#[test]
fn a_mesh_that_does_not_fit_is_refused_with_the_depth_that_does() {
    let folder = Folder::with_cube();
    for limit in ["", "--limit"] {
        for level in [20, 100, u32::MAX] {
            let run = folder.ogee(&format!("refine cube.obj --json -l {level} {limit} -o out.ply")).expect(3);
            assert!(run.first_line().starts_with(&format!("cube.obj: {level} levels would make")));
            assert!(run.first_line().contains("levels fit"), "{}", run.first_line());
            assert_eq!(run.json()["error"]["code"], "too_deep");
            assert_eq!(folder.names(), ["cube.obj"]);
        }
    }
}

#[test]
fn what_a_method_has_no_rule_for_is_refused() {
    let folder = Folder::with_cube();
    let pillow = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1\n";
    folder.write("pillow.obj", pillow);
    folder.write("sharp.obj", with("t crease 2/1/0 0 1 9"));
    for (arguments, code, exit) in [
        ("pillow.obj", "adjacent_lens_vertices", 3),
        ("sharp.obj", "too_sharp", 3),
        ("sharp.obj --method bi5", "sharp_edge", 3),
        ("cube.obj --level 1", "level_too_low", 2),
        ("cube.obj --level 7", "level_too_high", 2),
        ("cube.obj --max-deviation 1e-9", "deviation", 1),
        ("cube.obj --level 2 --max-deviation 1e-3", "deviation", 1),
    ] {
        let run = folder.ogee(&format!("convert --json {arguments} -o out.step")).expect(exit);
        assert_eq!(run.json()["error"]["code"], code, "{arguments}");
        assert!(!folder.path("out.step").exists());
    }
    let run = folder.ogee("convert cube.obj --level 1 -o out.step").expect(2);
    assert!(run.first_line().contains("2 is the least"), "{}", run.first_line());
}

#[test]
fn a_missing_file_is_unreadable() {
    let folder = Folder::new();
    for what in
        ["convert none.obj -o out.step", "info none.obj", "check none.step", "refine none.obj -l1 -o a.obj"]
    {
        let run = folder.ogee(&format!("{what} --json")).expect(3);
        assert_eq!(run.json()["error"]["code"], "unreadable");
        assert!(run.first_line().starts_with("none."), "{}", run.first_line());
        assert!(folder.names().is_empty());
    }
}
