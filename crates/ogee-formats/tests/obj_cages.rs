//! Every habit of OBJ files is read, and every mistake in one is told with its line.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee::{Boundary, Creasing, FaceVaryingRule, Place, Sharpness, Vec3};
use ogee_formats::{CageFile, CageFormat, Fault, ReadError, read_cage};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn read(text: &str) -> CageFile {
    read_cage(text.as_bytes(), CageFormat::Obj).unwrap()
}

fn refuse(text: &str) -> ReadError {
    read_cage(text.as_bytes(), CageFormat::Obj).unwrap_err()
}

/// The only fault of a triangle with more lines, the first of which is line 5.
fn fault_after_triangle(more: &str) -> Fault {
    let error = refuse(&format!("{TRIANGLE}{more}"));
    assert_eq!(error.faults.len(), 1, "{:?}", error.faults);
    error.faults[0].clone()
}

fn faces(file: &CageFile) -> Vec<Vec<u32>> {
    file.mesh.faces.iter().map(<[u32]>::to_vec).collect()
}

#[test]
fn a_plain_cage() {
    let file = read("# a comment\nv 0 0 0\nv 1.5 -2e-3 +0\nv 0 1 .5\nf 1 2 3\n");
    assert_eq!(file.mesh.points[1], Vec3::new(1.5, -0.002, 0.0));
    assert_eq!(file.mesh.points[2].z, 0.5);
    assert_eq!(faces(&file), [[0, 1, 2]]);
    assert_eq!(file.face_lines, [5]);
    assert!(file.warnings.is_empty() && file.mesh.uv.is_none());
    assert_eq!(file.mesh.scheme.boundary, Boundary::EdgeAndCorner);
}

#[test]
fn every_line_ending_byte_order_mark_and_blank() {
    let plain = read(TRIANGLE);
    for text in [
        TRIANGLE.replace('\n', "\r\n"),
        TRIANGLE.replace('\n', "\r"),
        TRIANGLE.replace(' ', "\t  "),
        TRIANGLE.replace('\n', " # a comment\n"),
        TRIANGLE.trim_end().to_string(),
        format!("\u{feff}{TRIANGLE}"),
        format!("{TRIANGLE}\x1a"),
    ] {
        assert_eq!(read(&text), plain, "{text:?}");
    }
}

#[test]
fn comments_in_any_encoding() {
    let mut bytes = b"# caf\xe9\no b\xfcgel\n".to_vec();
    bytes.extend_from_slice(TRIANGLE.as_bytes());
    assert_eq!(read_cage(&bytes, CageFormat::Obj).unwrap().face_lines, [6]);
}

#[test]
fn joined_lines_keep_the_number_of_the_first() {
    let file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n  2 \\ \n 3\nf 3 2 1\n");
    assert_eq!(faces(&file), [[0, 1, 2], [2, 1, 0]]);
    assert_eq!(file.face_lines, [4, 7]);
    let file = read(&format!("# C:\\models\\\n{TRIANGLE}"));
    assert_eq!(file.mesh.points.len(), 3, "a comment does not go on");
    assert_eq!(read(&format!("{}\\", TRIANGLE.trim_end())).mesh.faces.len(), 1);
}

#[test]
fn relative_numbers_count_back_from_the_last() {
    let file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 -2 1\n");
    assert_eq!(faces(&file), [[0, 1, 2], [3, 2, 0]]);
}

#[test]
fn faces_may_come_before_their_vertices() {
    assert_eq!(faces(&read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n")), [[0, 1, 2]]);
}

#[test]
fn all_forms_of_corners() {
    let texture = "vt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 1\n";
    let points = "v 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.2 0.4 0.6\n";
    for face in ["f 1/3 2/2/ 3/1", "f 1/3/1 2/2/1 3/1/1", "f -3/-1 -2/-2 -1/-3"] {
        let uv = read(&format!("{points}{texture}{face}\n")).mesh.uv.unwrap();
        assert_eq!(uv.indices, [2, 1, 0], "{face}");
        assert_eq!(uv.values, [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]]);
        assert_eq!(uv.rule, FaceVaryingRule::CornersPlus1);
    }
    let file = read(&format!("{points}{texture}f 1//1 2//1 3//1\n"));
    assert!(file.mesh.uv.is_none() && file.warnings.is_empty());
}

#[test]
fn texture_coordinates_at_some_corners_only_are_passed_over() {
    let file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 3/1 2 1/1\n");
    assert!(file.mesh.uv.is_none());
    assert_eq!((file.warnings[0].line, file.warnings[0].code), (Some(6), "partial_texture"));
}

#[test]
fn faces_of_many_corners() {
    let mut text = String::new();
    for i in 0..12 {
        text.push_str(&format!("v {i} {} 0\n", i * i));
    }
    let file = read(&format!("{text}f 1 2 3 4 5 6 7 8 9 10 11 12\n"));
    assert_eq!(file.mesh.faces.face(0).len(), 12);
    let error = refuse(&format!("{text}f 1 2 3 4 5 6 7 8 9 10 11 5\n"));
    assert_eq!(error.to_string(), "face 0 uses vertex 4 more than once");
}

#[test]
fn what_is_no_shape_is_passed_over() {
    let text =
        format!("mtllib a.mtl\no name\ng a b\nusemtl red\ns off\nl 1 2\np 1\nvp 0 0\nvn 0 0 1\n{TRIANGLE}");
    let file = read(&text);
    assert_eq!((file.mesh.faces.len(), file.warnings.len()), (1, 0));
    let file = read(&format!("{TRIANGLE}cstype bspline\ndeg 3 3\nsurf 0 1 0 1 1 2 3\nend\nzz 1\nzz 2\n"));
    let codes: Vec<_> = file.warnings.iter().map(|warning| (warning.line, warning.code)).collect();
    assert_eq!(codes, [(Some(5), "free_form"), (Some(9), "unknown_statement")]);
}

#[test]
fn tags() {
    let file = read(&format!(
        "{TRIANGLE}t crease 2/1/0 0 1 2.5\nt crease 4/1/0 1 2 2 0 10\nt crease 4/2/0 0 1 1 2 1 2\n\
         t corner 1/1/0 0 3\nt corner 2/2/0 1 2 inf -1\nt hole 1/0/0 0\nt interpolateboundary 1/0/0 2\n\
         t facevaryinginterpolateboundary 1/0/0 5\nt creasemethod 0/0/1 chaikin\n\
         t smoothtriangles 0/0/1 catmark\n"
    ));
    let creases: Vec<_> = file.mesh.creases.iter().map(|c| (c.vertices, c.sharpness)).collect();
    let finite = Sharpness::Finite;
    assert_eq!(
        creases,
        [
            ([0, 1], finite(2.5)),
            ([1, 2], Sharpness::Infinite),
            ([2, 0], Sharpness::Infinite),
            ([0, 1], finite(1.0)),
            ([1, 2], finite(2.0)),
        ]
    );
    let corners: Vec<_> = file.mesh.corners.iter().map(|c| (c.vertex, c.sharpness)).collect();
    assert_eq!(corners, [(0, finite(3.0)), (1, Sharpness::Infinite), (2, finite(0.0))]);
    assert_eq!(file.mesh.holes, [0]);
    assert_eq!(file.mesh.scheme.boundary, Boundary::EdgeOnly);
    assert_eq!(file.mesh.scheme.creasing, Creasing::Chaikin);
    assert!(file.warnings.is_empty());
}

#[test]
fn boundary_and_face_varying_numbers() {
    let boundary =
        |k: u32| read(&format!("{TRIANGLE}t interpolateboundary 1/0/0 {k}\n")).mesh.scheme.boundary;
    assert_eq!([0, 1, 2].map(boundary), [Boundary::None, Boundary::EdgeAndCorner, Boundary::EdgeOnly]);
    let rule = |k: u32| {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
        let text = format!("{text}t facevaryinginterpolateboundary 1/0/0 {k}\n");
        read(&text).mesh.uv.unwrap().rule
    };
    use FaceVaryingRule::*;
    assert_eq!(
        [0, 1, 2, 3, 4, 5].map(rule),
        [None, CornersOnly, CornersPlus1, CornersPlus2, Boundaries, All]
    );
}

#[test]
fn tags_that_are_not_followed_are_warned_about() {
    let file = read(&format!(
        "{TRIANGLE}t vertexedit 1/0/0 1\nt edgeedit\nt faceedit 9/9/9\nt sparkle 0/0/0\n\
         t smoothtriangles 0/0/1 smooth\n"
    ));
    let codes: Vec<_> = file.warnings.iter().map(|warning| (warning.line.unwrap(), warning.code)).collect();
    assert_eq!(
        codes,
        [
            (5, "hierarchical_edit"),
            (6, "hierarchical_edit"),
            (7, "hierarchical_edit"),
            (8, "unknown_tag"),
            (9, "smooth_triangles")
        ]
    );
}

#[test]
fn tags_with_wrong_counts_are_faults() {
    for tag in [
        "t",
        "t crease",
        "t crease 2/1 0 1 1",
        "t crease 2/1/x 0 1 1",
        "t crease -2/1/0 0 1 1",
        "t crease 2/1/0 0 1",
        "t crease 2/1/0 0 1 1 7",
        "t crease 3/1/0 0 1 2 1",
        "t crease 2/0/0 0 1",
        "t crease 4/3/0 0 1 1 2 1 1 1",
        "t crease 2/1/0 0 1.5 1",
        "t crease 2/1/0 0 1 soft",
        "t crease 999999999999999999/999999999999999999/0 1",
        "t corner 0/1/0 1",
        "t corner 2/3/0 0 1 1 1 1",
        "t hole 1/1/0 0 1",
        "t hole 0/0/0",
        "t interpolateboundary 1/0/0 3",
        "t interpolateboundary 2/0/0 1 1",
        "t facevaryinginterpolateboundary 1/0/0 6",
        "t creasemethod 0/0/1 smooth",
        "t creasemethod 1/0/0 1",
        "t smoothtriangles 0/0/1 loop",
    ] {
        let fault = fault_after_triangle(tag);
        assert_eq!((fault.code, fault.line), ("bad_tag", Some(5)), "{tag}: {fault}");
    }
}

#[test]
fn tags_that_name_what_is_not_there_are_faults() {
    let with_square = "v 1 1 0\nf 3 2 4\n";
    let fault = fault_after_triangle(&format!("{with_square}t crease 2/1/0 0 3 1\n"));
    assert_eq!((fault.code, fault.line, fault.place), ("crease_off_edge", Some(7), Some(Place::Edge(0, 3))));
    assert_eq!(fault.message, "crease 0-3 names no edge of the cage");
    let fault = fault_after_triangle("t crease 2/1/0 0 9 1");
    assert_eq!(fault.message, "crease 0-9 uses vertex 9, the file has 3");
    let fault = fault_after_triangle("t crease 2/1/0 -1 1 1");
    assert_eq!(fault.message, "crease -1-1 uses vertex -1, the file has 3");
    let fault = fault_after_triangle("t corner 1/1/0 3 1");
    assert_eq!((fault.code, fault.line), ("corner_off_vertex", Some(5)));
    let fault = fault_after_triangle("t hole 1/0/0 1");
    assert_eq!((fault.code, fault.line), ("hole_off_face", Some(5)));
    assert_eq!(fault.message, "hole names face 1, the file has 1");
    let fault = fault_after_triangle("t crease 2/1/0 0 1 nan");
    assert_eq!((fault.code, fault.line), ("sharpness_not_a_number", Some(5)));
    let fault = fault_after_triangle("t corner 1/1/0 0 nan");
    assert_eq!((fault.code, fault.line), ("sharpness_not_a_number", Some(5)));
}

#[test]
fn bad_vertices_are_faults() {
    for (line, code, message) in [
        ("v 1 2", "missing_number", "vertex 3 has only 2 of 3 coordinates"),
        ("v", "missing_number", "vertex 3 has only 0 of 3 coordinates"),
        ("v 1 2 # 3", "missing_number", "vertex 3 has only 2 of 3 coordinates"),
        ("v 1 2,5 3", "bad_number", "vertex 3 has a coordinate `2,5`, which is no number"),
        ("v 1 2 0x3", "bad_number", "vertex 3 has a coordinate `0x3`, which is no number"),
        ("v nan 0 0", "not_finite", "vertex 3 has a coordinate that is no finite number"),
        ("v 0 -inf 0", "not_finite", "vertex 3 has a coordinate that is no finite number"),
        ("v 0 0 1e999", "not_finite", "vertex 3 has a coordinate that is no finite number"),
    ] {
        let fault = fault_after_triangle(line);
        assert_eq!((fault.code, fault.line, &fault.message[..]), (code, Some(5), message));
        assert_eq!(fault.place, Some(Place::Vertex(3)));
    }
    assert_eq!(fault_after_triangle("vt").message, "texture coordinate 0 has only 0 of 1 coordinates");
    assert_eq!(fault_after_triangle("vt 0 nan").code, "not_finite");
}

#[test]
fn bad_faces_are_faults() {
    for (line, code, message) in [
        ("f 1 2", "face_too_small", "face 1 has 2 corners, fewer than three"),
        ("f", "face_too_small", "face 1 has 0 corners, fewer than three"),
        ("f 1 2 1", "repeated_vertex", "face 1 uses vertex 0 more than once"),
        ("f 1 2 100", "missing_vertex", "face 1 uses vertex 99, the file has 3"),
        ("f 1 2 0", "missing_vertex", "face 1 uses vertex number 0 of the file, which counts from 1"),
        (
            "f 1 2 -4",
            "missing_vertex",
            "face 1 uses vertex -4, counted back from the last, but only 3 come before it",
        ),
        ("f 1 2 99999999999", "missing_vertex", "face 1 uses vertex 99999999998, a cage has fewer than 2^32"),
        ("f 1 2 x", "bad_number", "face 1 has a corner `x`, not v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 3/1/1/1", "bad_number", "face 1 has a corner `3/1/1/1`, not v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 3/a", "bad_number", "face 1 has a corner `3/a`, not v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 3//a", "bad_number", "face 1 has a corner `3//a`, not v, v/vt, v//vn or v/vt/vn"),
        ("f 1 2 3.0", "bad_number", "face 1 has a corner `3.0`, not v, v/vt, v//vn or v/vt/vn"),
        (
            "f 1/0 2 3",
            "face_varying",
            "face 1 uses texture coordinate number 0 of the file, which counts from 1",
        ),
    ] {
        let fault = fault_after_triangle(line);
        assert_eq!((fault.code, fault.line, &fault.message[..]), (code, Some(5), message));
        assert_eq!(fault.place, Some(Place::Face(1)));
    }
    let error = refuse("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/7\n");
    assert_eq!(error.to_string(), "face 0 uses texture coordinate 6, the file has 1");
    assert_eq!(error.faults[0].line, Some(5));
}

#[test]
fn many_faults_are_told_at_once_in_order() {
    let error =
        refuse("v 0 0 0\nv 1 0\nv 0 1 nan\nf 1 2 9\nf 1 1 2\nt sparkle\nt corner 1/1/0 9 1\nf 1 2 3\n");
    let lines: Vec<_> = error.faults.iter().map(|fault| fault.line.unwrap()).collect();
    assert_eq!(lines, [2, 3, 4, 5, 7]);
    assert_eq!(error.to_string(), "vertex 1 has only 2 of 3 coordinates");
    let error = refuse(&"f 1 2\n".repeat(5000));
    assert_eq!((error.faults.len(), error.unlisted), (ReadError::MOST_FAULTS, 5000 - ReadError::MOST_FAULTS));
}

#[test]
fn what_is_no_cage_is_told_in_one_line() {
    for text in ["", "  \n", "v 0 0 0\n", "# nothing\n"] {
        let error = refuse(text);
        assert_eq!((error.faults.len(), error.faults[0].code), (1, "no_faces"), "{text:?}");
        assert!(error.to_string().contains("has no faces"));
    }
    let error = refuse("OFF\n8 6 0\n");
    assert_eq!(error.to_string(), "the file has no faces, and `OFF` on line 1 is no statement of OBJ");
    let garbage: Vec<u8> = (0..1000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let error = read_cage(&garbage, CageFormat::Obj).unwrap_err();
    assert_eq!((error.faults.len(), error.faults[0].code), (1, "not_text"));
}

#[test]
fn spot_is_read_whole() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/models/spot/spot_control_mesh.obj");
    let Ok(bytes) = std::fs::read(path) else {
        println!("skipped: no Spot");
        return;
    };
    let file = read_cage(&bytes, CageFormat::Obj).unwrap();
    let faces_of = |corners: usize| file.mesh.faces.iter().filter(|face| face.len() == corners).count();
    assert_eq!((file.mesh.points.len(), file.mesh.faces.len()), (188, 180));
    assert_eq!([3, 4, 5].map(faces_of), [4, 160, 16]);
    assert!(ogee::Topology::new(&file.mesh).is_ok());
}
