//! An address is refused with the reason, or names a point; no parameter outside the square gets in.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{prism, pyramid, with_boundary, with_holes};
use ogee::{Boundary, FaceId, Level, LimitSurface, LocationError, ParametricFace, PatchTable};

#[test]
fn every_reason_is_named() {
    // Faces 0 and 1 are pentagons, the others quads; one of each is a hole.
    let table = PatchTable::new(&Level::new(&with_holes(prism(5), &[1, 3])).unwrap());
    let at = |face: u32, corner: Option<u32>, u: f64, v: f64| table.locate(FaceId(face), corner, u, v);
    let refused = |face: u32, corner: Option<u32>, u: f64, v: f64| at(face, corner, u, v).unwrap_err();

    assert_eq!(refused(7, None, 0.5, 0.5), LocationError::MissingFace { face: FaceId(7), count: 7 });
    assert_eq!(refused(u32::MAX, None, 0.5, 0.5).code(), "missing_face");
    assert_eq!(refused(1, Some(0), 0.5, 0.5), LocationError::HiddenFace { face: FaceId(1) });
    assert_eq!(refused(3, None, 0.5, 0.5), LocationError::HiddenFace { face: FaceId(3) });
    assert_eq!(refused(2, Some(0), 0.5, 0.5), LocationError::CornerOnQuad { face: FaceId(2) });
    assert_eq!(refused(0, None, 0.5, 0.5), LocationError::CornerWanted { face: FaceId(0), corners: 5 });
    let missing = LocationError::MissingCorner { face: FaceId(0), corner: 5, corners: 5 };
    assert_eq!(refused(0, Some(5), 0.5, 0.5), missing);
    assert_eq!(refused(0, Some(u32::MAX), 0.5, 0.5).code(), "missing_corner");

    let above = 1.0 + f64::EPSILON;
    let below = -f64::from_bits(1);
    for bad in [above, below, f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 2.0, -1.0, f64::MAX] {
        for (u, v) in [(bad, 0.5), (0.5, bad), (bad, bad)] {
            for (face, corner) in [(2, None), (0, Some(4))] {
                let error = refused(face, corner, u, v);
                assert_eq!(error.code(), "outside_square", "({u}, {v})");
                assert!(matches!(error, LocationError::OutsideSquare { .. }));
            }
        }
    }
    // Every message says which face, in words.
    assert_eq!(refused(9, None, 0.5, 0.5).to_string(), "there is no face 9, only 7");
    assert!(refused(2, None, 1.5, 0.5).to_string().contains("1.5"));
}

#[test]
fn corners_of_the_square_are_inside() {
    let mesh = pyramid();
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    for (face, corner) in [(0, None), (1, Some(0)), (4, Some(2))] {
        for (u, v) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0 - f64::EPSILON / 2.0, 5e-324)] {
            let at = table.locate(FaceId(face), corner, u, v).unwrap();
            assert_eq!(at.parameters(), [u, v]);
            let wanted = ParametricFace { face: FaceId(face), corner };
            assert_eq!(table.parametric_face(at.parametric_face()), wanted);
        }
        // Zero has two signs and one place.
        for ((u, v), (x, y)) in
            [((-0.0, 0.0), (0.0, 0.0)), ((0.5, -0.0), (0.5, 0.0)), ((-0.0, 1.0), (0.0, 1.0))]
        {
            let [a, b] =
                [(u, v), (x, y)].map(|(u, v)| surface.jet(table.locate(FaceId(face), corner, u, v).unwrap()));
            assert_eq!(a, b);
        }
    }
}

#[test]
fn every_parametric_face_has_an_address() {
    for (name, mesh) in cages::all() {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let corners = |face: &[u32]| if face.len() == 4 { 1 } else { face.len() };
        assert_eq!(table.len(), mesh.faces.iter().map(corners).sum::<usize>(), "{name}");
        assert!(!table.is_empty());
        let mut expected = Vec::new();
        for (f, face) in mesh.faces.iter().enumerate() {
            let face_id = FaceId(f as u32);
            match face.len() {
                4 => expected.push(ParametricFace { face: face_id, corner: None }),
                n => {
                    expected.extend((0..n as u32).map(|k| ParametricFace { face: face_id, corner: Some(k) }))
                }
            }
        }
        for (number, &face) in expected.iter().enumerate() {
            assert_eq!(table.parametric_face(number), face, "{name}");
            assert_eq!(table.is_visible(number), level.is_visible(face.face), "{name}");
            match table.locate(face.face, face.corner, 0.25, 0.75) {
                Ok(at) => assert_eq!((at.parametric_face(), table.is_visible(number)), (number, true)),
                Err(error) => {
                    assert_eq!((error.code(), table.is_visible(number)), ("hidden_face", false), "{name}");
                }
            }
        }
    }
}

/// Without boundary interpolation the faces at the boundary are no part of the surface.
#[test]
fn faces_that_the_scheme_leaves_out_are_hidden() {
    let table = PatchTable::new(&Level::new(&with_boundary(cages::grid(4, 3), Boundary::None)).unwrap());
    let inside: Vec<usize> = cages::visible(&table);
    assert_eq!(inside, [5, 6]);
    assert_eq!(table.locate(FaceId(0), None, 0.5, 0.5).unwrap_err().code(), "hidden_face");
}

/// A location leads to others of its face, under the same check.
#[test]
fn a_location_moves_within_its_face() {
    let mesh = cages::cube();
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let start = table.locate(FaceId(3), None, 0.0, 0.0).unwrap();
    assert_eq!(start.at(0.25, 1.0), table.locate(FaceId(3), None, 0.25, 1.0));
    for (u, v) in [(-0.1, 0.5), (0.5, 1.1), (f64::NAN, 0.5), (0.5, f64::INFINITY)] {
        assert!(matches!(start.at(u, v), Err(LocationError::OutsideSquare { .. })));
    }
}
