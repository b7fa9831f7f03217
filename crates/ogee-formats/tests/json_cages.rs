//! The cage in JSON is read key by key, and every mistake in one is told with its line or place.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee::{Boundary, Creasing, FaceVaryingRule, LensShape, Meeting, Place, Sharpness, Vec3};
use ogee_formats::{CageFile, CageFormat, ReadError, read_cage};

const SHAPE: &str = r#""vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1.5,0]], "faces": [[0,1,2],[0,2,3]]"#;

fn read(text: &str) -> CageFile {
    read_cage(text.as_bytes(), CageFormat::Json).unwrap()
}

fn refuse(text: &str) -> ReadError {
    read_cage(text.as_bytes(), CageFormat::Json).unwrap_err()
}

#[test]
fn the_two_mandatory_keys() {
    let file = read(&format!("\u{feff}{{{SHAPE}}}"));
    assert_eq!(file.mesh.points[3], Vec3::new(0.0, 1.5, 0.0));
    assert_eq!(file.mesh.faces.face(1), [0, 2, 3]);
    assert!(file.face_lines.is_empty() && file.warnings.is_empty() && file.mesh.uv.is_none());
}

#[test]
fn every_key() {
    let file = read(&format!(
        r#"{{"face_varying": "boundaries", "face_uvs": [[0,1,2],[2,1,0]], "uvs": [[0,0],[1,0],[0.5,1]],
            "holes": [1], "creasing": "chaikin", "boundary": "edge-only", "lens": {{"gamma":0.1875}},
            "meetings": [{{"vertex":2,"ports":[3,0],"t":0.25}}],
            "corners": [{{"vertex":3,"sharpness":10}}],
            "creases": [{{"vertices":[2,0],"sharpness":2.5}},{{"sharpness":"infinite","vertices":[0,1]}}],
            {SHAPE} }}"#
    ));
    let creases: Vec<_> = file.mesh.creases.iter().map(|c| (c.vertices, c.sharpness)).collect();
    assert_eq!(creases, [([2, 0], Sharpness::Finite(2.5)), ([0, 1], Sharpness::Infinite)]);
    assert_eq!((file.mesh.corners[0].vertex, file.mesh.corners[0].sharpness), (3, Sharpness::Infinite));
    assert_eq!(file.mesh.holes, [1]);
    assert_eq!(file.mesh.meetings, [Meeting { vertex: 2, ports: vec![3, 0], t: 0.25 }]);
    assert_eq!(file.mesh.scheme.boundary, Boundary::EdgeOnly);
    assert_eq!(file.mesh.scheme.creasing, Creasing::Chaikin);
    assert_eq!(file.mesh.scheme.lens, LensShape { beta: 0.5, gamma: 0.1875 });
    let uv = file.mesh.uv.unwrap();
    assert_eq!((uv.indices, uv.rule), (vec![0, 1, 2, 2, 1, 0], FaceVaryingRule::Boundaries));
    assert_eq!(uv.values, [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]);
    assert!(file.warnings.is_empty());
}

#[test]
fn null_is_the_same_as_no_key() {
    let file = read(&format!(
        r#"{{"creases":null,"boundary":null,"uvs":null,"meetings":null,"lens":null,{SHAPE}}}"#
    ));
    assert_eq!(file, read(&format!("{{{SHAPE}}}")));
}

#[test]
fn unknown_keys_are_warned_about() {
    let file = read(&format!(r#"{{"unit": {{"a":[1,2]}}, {SHAPE}}}"#));
    assert_eq!(file.warnings[0].code, "unknown_key");
    assert_eq!(file.warnings[0].message, "unknown key \"unit\", passed over");
}

#[test]
fn a_lens_has_two_numbers_and_no_more() {
    let lens = |text: &str| format!(r#"{{"lens":{text},{SHAPE}}}"#);
    assert_eq!(read(&lens("{}")).mesh.scheme.lens, LensShape::default());
    assert_eq!(read(&lens(r#"{"beta":0.25,"gamma":0.25}"#)).mesh.scheme.lens.beta, 0.25);
    for wrong in ["[]", r#"{"beta":"half"}"#, r#"{"alpha":0.5}"#, "0.5"] {
        let error = refuse(&lens(wrong));
        assert_eq!(error.faults[0].code, "wrong_value", "{wrong}");
    }
}

#[test]
fn mistakes_of_syntax_are_told_with_line_and_column() {
    for (text, line, code, message) in [
        ("{\n\"vertices\": [[0,0,0]\n", 3, "bad_json", "column 0: EOF while parsing a list"),
        ("{\n\"vertices\": [[0,,0]]}", 2, "bad_json", "column 17: expected value"),
        ("{\"vertices\": [[1e999,0,0]]}", 1, "bad_json", "column 20: number out of range"),
        (
            "[1]",
            1,
            "wrong_value",
            "column 0: invalid type: sequence, expected an object with the keys of a cage",
        ),
        (
            "{\"faces\": [[0,1.5,2]]}",
            1,
            "wrong_value",
            "column 17: invalid type: floating point `1.5`, expected i64",
        ),
        ("{\"faces\": [],\n\"faces\": []}", 2, "wrong_value", "column 7: duplicate field `faces`"),
        ("{\"vertices\": [[0,null,0]]}", 1, "wrong_value", "column 21: invalid type: null, expected f64"),
    ] {
        let error = refuse(text);
        let first = &error.faults[0];
        assert_eq!((first.line, first.code, &first.message[..]), (Some(line), code, message), "{text}");
    }
    for sharpness in ["\"soft\"", "[1]", "null"] {
        let text = format!("{{{SHAPE},\n\"corners\":[{{\"vertex\":0,\"sharpness\":{sharpness}}}]}}");
        let error = refuse(&text);
        assert_eq!((error.faults[0].line, error.faults[0].code), (Some(2), "wrong_value"), "{error}");
        assert!(error.to_string().contains("a number or \"infinite\""), "{error}");
    }
    assert_eq!(refuse("").faults[0].code, "no_faces");
    assert_eq!(refuse("\u{1}\u{2}").faults[0].code, "not_text");
    assert_eq!(refuse(&"[".repeat(100_000)).faults.len(), 1);
}

#[test]
fn mistakes_of_content_are_told_with_their_place() {
    let shape = |more: &str| format!("{{{SHAPE},{more}}}");
    let texture = |uvs: &str, faces: &str| shape(&format!("\"uvs\":{uvs},\"face_uvs\":{faces}"));
    for (text, code, place, message) in [
        ("{\"faces\":[[0,1,2]]}".into(), "missing_key", None, "the cage has no key \"vertices\""),
        ("{\"vertices\":[]}".into(), "missing_key", None, "the cage has no key \"faces\""),
        (
            "{\"vertices\":[[0,0]],\"faces\":[]}".into(),
            "wrong_length",
            Some(Place::Vertex(0)),
            "vertex 0 has 2 coordinates, not 3",
        ),
        (
            "{\"vertices\":[[0,0,0,0]],\"faces\":[]}".into(),
            "wrong_length",
            Some(Place::Vertex(0)),
            "vertex 0 has 4 coordinates, not 3",
        ),
        ("{\"vertices\":[],\"faces\":[]}".into(), "no_faces", None, "the file has no faces"),
        (
            "{\"vertices\":[],\"faces\":[[0,1,-1]]}".into(),
            "missing_vertex",
            Some(Place::Face(0)),
            "face 0 uses vertex -1, the first has number 0",
        ),
        (
            SHAPE.replace("[0,2,3]", "[0,2,99]"),
            "missing_vertex",
            Some(Place::Face(1)),
            "face 1 uses vertex 99, the file has 4",
        ),
        (
            shape(r#""creases":[{"vertices":[1,3],"sharpness":1}]"#),
            "crease_off_edge",
            Some(Place::Edge(1, 3)),
            "crease 1-3 names no edge of the cage",
        ),
        (
            shape(r#""corners":[{"vertex":4,"sharpness":1}]"#),
            "corner_off_vertex",
            None,
            "corner names vertex 4, the file has 4",
        ),
        (shape("\"holes\":[2]"), "hole_off_face", None, "hole names face 2, the file has 2"),
        (
            shape("\"meetings\":[{\"vertex\":0,\"ports\":[1,9],\"t\":0.3}]"),
            "meeting_off_vertex",
            None,
            "meeting 0 names vertex 9, the file has 4",
        ),
        (
            shape("\"boundary\":\"both\""),
            "unknown_name",
            None,
            "\"boundary\" is \"both\", which is none of edge-and-corner, edge-only, none",
        ),
        (
            shape("\"creasing\":\"\""),
            "unknown_name",
            None,
            "\"creasing\" is \"\", which is none of uniform, chaikin",
        ),
        (shape("\"uvs\":[[0,0]]"), "missing_key", None, "\"uvs\" without \"face_uvs\""),
        (shape("\"face_uvs\":[[0,0]]"), "missing_key", None, "\"face_uvs\" without \"uvs\""),
        (
            texture("[[0,0,0]]", "[[0,0,0],[0,0,0]]"),
            "wrong_length",
            None,
            "texture coordinate 0 has 3 coordinates, not 2",
        ),
        (texture("[[0,0]]", "[[0,0,0]]"), "face_varying", None, "\"face_uvs\" has 1 faces, \"faces\" has 2"),
        (
            texture("[[0,0]]", "[[0,0,0],[0,0]]"),
            "face_varying",
            Some(Place::Face(1)),
            "face 1 has 2 texture coordinates for 3 corners",
        ),
        (
            texture("[[0,0]]", "[[0,0,0],[0,0,1]]"),
            "face_varying",
            Some(Place::Face(1)),
            "face 1 uses texture coordinate 1, the file has 1",
        ),
        (
            texture("[[0,0]]", "[[0,0,0],[0,0,-1]]"),
            "face_varying",
            Some(Place::Face(1)),
            "face 1 uses texture coordinate -1",
        ),
    ] {
        let text = if text.starts_with('{') { text } else { format!("{{{text}}}") };
        let error = refuse(&text);
        let first = &error.faults[0];
        assert_eq!((first.code, first.place, &first.message[..]), (code, place, message), "{text}");
        assert_eq!(error.faults.len(), 1, "{text}: {:?}", error.faults);
    }
}
