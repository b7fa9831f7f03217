//! OFF files of all headers are read, and every mistake in one is told with its line.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee::Vec3;
use ogee_formats::{CageFile, CageFormat, ReadError, read_cage};

fn read(text: &str) -> CageFile {
    read_cage(text.as_bytes(), CageFormat::Off).unwrap()
}

fn refuse(text: &str) -> ReadError {
    read_cage(text.as_bytes(), CageFormat::Off).unwrap_err()
}

/// A triangle and a quad with a given header.
fn with_header(header: &str) -> String {
    format!("{header}\n0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n3 0 1 2\n4 0 1 2 3\n")
}

#[test]
fn all_headers() {
    let plain = read(&with_header("OFF\n4 2 0"));
    assert_eq!(plain.mesh.points[3], Vec3::new(0.0, 1.5, 0.0));
    assert_eq!(plain.mesh.faces.face(1), [0, 1, 2, 3]);
    assert_eq!(plain.face_lines, [7, 8]);
    for header in
        ["OFF 4 2 0", "4 2 0", "4 2", "OFF\n\n# counts\n4 2 5", "COFF 4 2 0", "STCNOFF # all\n4 2 0"]
    {
        assert_eq!(read(&with_header(header)).mesh, plain.mesh, "{header}");
    }
    let text = with_header("OFF 4 2 0").replace('\n', "\r\n");
    assert_eq!(read(&format!("\u{feff}{text}")).mesh, plain.mesh);
}

#[test]
fn colours_normals_and_comments_are_passed_over() {
    let text = "CNOFF\n3 1 3\n0 0 0 0 0 1 255 0 0 255 # red\n\n1 0 0 0 0 1 0 255 0 255\n\
                0 1 0 0 0 1 0 0 255 255\n3 0 1 2 0.5 0.5 0.5\n";
    let file = read(text);
    assert_eq!(file.mesh.points[2], Vec3::new(0.0, 1.0, 0.0));
    assert_eq!((file.mesh.faces.face(0), &file.face_lines[..]), (&[0, 1, 2][..], &[7][..]));
    assert!(file.warnings.is_empty());
}

#[test]
fn lines_beyond_the_counts_are_warned_about() {
    let file = read(&format!("{}2 0 1\n", with_header("OFF 4 2 0")));
    assert_eq!((file.warnings[0].line, file.warnings[0].code), (Some(8), "trailing_lines"));
}

#[test]
fn mistakes_are_told_with_their_line() {
    for (text, line, code, message) in [
        ("OFFF 1 1 0", 1, "bad_header", "an OFF file begins with OFF, this one with `OFFF`"),
        ("4OFF 1 1 0", 1, "unsupported_header", "`4OFF` cages have other dimensions than three"),
        ("OFF BINARY", 1, "unsupported_header", "binary OFF is not read"),
        ("OFF\n# no more", 1, "bad_header", "the header has no counts of vertices, faces and edges"),
        ("OFF\n3 x", 2, "bad_header", "the header has no counts of vertices, faces and edges"),
        ("OFF\n-3 1 0", 2, "bad_header", "the header has no counts of vertices, faces and edges"),
        ("OFF 3 1 0\n0 0 0\n", 2, "truncated", "the header promises 3 vertices, the file ends after 1"),
        (
            "OFF 999999999999 1 0\n0 0 0\n",
            2,
            "truncated",
            "the header promises 999999999999 vertices, the file ends after 1",
        ),
        ("OFF 1 1 0\n0 0\n3 0 0 0", 2, "missing_number", "vertex 0 has only 2 of 3 coordinates"),
        ("OFF 1 1 0\n0 a 0\n3 0 0 0", 2, "bad_number", "vertex 0 has a coordinate `a`, which is no number"),
        (
            "OFF 1 1 0\n0 inf 0\n3 0 0 0",
            2,
            "not_finite",
            "vertex 0 has a coordinate that is no finite number",
        ),
        (
            "OFF 0 999999999999 0\n",
            1,
            "truncated",
            "the header promises 999999999999 faces, the file ends after 0",
        ),
        ("OFF 0 1 0\n3 0 1", 2, "missing_number", "face 0 promises 3 corners and has 2"),
        (
            "OFF 0 1 0\n999999999999 0 1",
            2,
            "missing_number",
            "face 0 promises 999999999999 corners and has 2",
        ),
        ("OFF 0 1 0\nx 0 1", 2, "bad_number", "face 0 begins with `x`, not a number of corners"),
        ("OFF 0 1 0\n-1 0 1", 2, "bad_number", "face 0 begins with `-1`, not a number of corners"),
        ("OFF 0 1 0\n3 0 1 z", 2, "bad_number", "face 0 has a corner `z`, no vertex number"),
        ("OFF 0 1 0\n2 0 1", 2, "face_too_small", "face 0 has 2 corners, fewer than three"),
        ("OFF 1 1 0\n0 0 0\n3 0 1 2", 3, "missing_vertex", "face 0 uses vertex 1, the file has 1"),
        ("OFF 1 1 0\n0 0 0\n3 0 -1 2", 3, "missing_vertex", "face 0 uses vertex -1, the first has number 0"),
        (
            "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1",
            5,
            "repeated_vertex",
            "face 0 uses vertex 1 more than once",
        ),
    ] {
        let error = refuse(text);
        let first = &error.faults[0];
        assert_eq!((first.line, first.code, &first.message[..]), (Some(line), code, message), "{text:?}");
    }
}

#[test]
fn no_faces_no_text() {
    assert_eq!(refuse("OFF 1 0 0\n0 0 0\n").to_string(), "the file has no faces");
    assert_eq!(refuse("").faults[0].code, "no_faces");
    assert_eq!(refuse("OFF\u{1}").faults[0].code, "not_text");
}
