//! Patches in JSON and BezierView files.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::*;
use ogee::nurbs::FaceAddress;
use ogee::{FaceId, Grid};
use ogee_formats::{bv, patches};

#[test]
fn patches_read_back_bit_for_bit() {
    for (name, part) in all_parts() {
        let mut text = Vec::new();
        patches::write(&part, &mut text).unwrap();
        let read = patches::read(&text).unwrap();
        let faces: Vec<_> =
            part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces).collect();
        assert_eq!(read.len(), faces.len(), "{name}");
        for (patch, face) in read.iter().zip(faces) {
            assert_eq!((&patch.surface, &patch.quads), (&face.surface, &face.quads), "{name}");
        }
    }
}

#[test]
fn packed_patches_list_faces_and_corners() {
    let mut shell = sheet();
    shell.faces[0].quads = Grid::from_fn(2, 3, |i, j| FaceAddress::whole(FaceId((10 * i + j) as u32)));
    let mut text = Vec::new();
    patches::write(&part(vec![ogee::convert::Body::Sheet(shell.clone())]), &mut text).unwrap();
    let value: serde_json::Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(value["patches"][0]["faces"], serde_json::json!([[0, 1, 2], [10, 11, 12]]));
    assert_eq!(value["patches"][0]["corner"], serde_json::Value::Null);
    assert!(value["patches"][0].get("corners").is_none());
    assert_eq!(patches::read(&text).unwrap()[0].quads, shell.faces[0].quads);

    shell.faces[0].quads = shell.faces[0].quads.map(|piece| FaceAddress { corner: Some(2), ..*piece });
    let mut text = Vec::new();
    patches::write(&part(vec![ogee::convert::Body::Sheet(shell.clone())]), &mut text).unwrap();
    let value: serde_json::Value = serde_json::from_slice(&text).unwrap();
    assert_eq!(value["patches"][0]["corners"], serde_json::json!([[2, 2, 2], [2, 2, 2]]));
    assert_eq!(patches::read(&text).unwrap()[0].quads, shell.faces[0].quads);
}

#[test]
fn patches_that_make_no_surface_are_refused() {
    let good = r#"{"patches":[{"face":0,"corner":null,"degree":[1,1],"knots_u":[0,0,1,1],"knots_v":[0,0,1,1],
        "points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]}]}"#;
    assert_eq!(patches::read(good.as_bytes()).unwrap().len(), 1);
    for (from, to) in [
        (r#""degree":[1,1]"#, r#""degree":[2,1]"#),
        (r#""degree":[1,1]"#, r#""degree":[0,1]"#),
        (r#""degree":[1,1]"#, r#""degree":[18446744073709551615,1]"#),
        ("[0,0,1,1]", "[0,0,1,0]"),
        ("[0,0,1,1]", "[0,0,0,0]"),
        ("[0,0,1,1]", "[0,1,2,3]"),
        ("[0,0,1,1]", "[]"),
        ("[0,1,0]],", "[0,1,0],[0,2,0]],"),
        ("[[[0,0,0],[0,1,0]],", "["),
        (r#""face":0"#, r#""face":0,"faces":[[0],[1,2]]"#),
        (r#""face":0"#, r#""face":0,"faces":[[0,1]],"corners":[[0]]"#),
    ] {
        let error = patches::read(good.replacen(from, to, 1).as_bytes()).unwrap_err();
        assert_eq!(error.code(), "bad_patch", "{to}: {error}");
    }
    assert_eq!(patches::read(b"{").unwrap_err().code(), "bad_json");
}

#[test]
fn bezier_view_lists_every_piece() {
    let (_, part) = all_parts().remove(3);
    let mut out = Vec::new();
    bv::write(&part, &mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "Group 0 shell0");
    // Five faces of one piece, one of 2 x 2.
    assert_eq!(lines.iter().filter(|line| **line == "3 3").count(), 9);
    assert_eq!(lines.len(), 1 + 9 * (2 + 16));
    assert_eq!(lines[3], "0 0 0");
}
