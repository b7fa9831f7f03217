//! A cage that was written and read again is the same cage, bit for bit.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee::{
    Boundary, ControlMesh, Corner, Crease, Creasing, FaceVarying, FaceVaryingRule, LensShape, Meeting,
    Scheme, Sharpness, Vec3, shapes,
};
use ogee_formats::{CageFormat, MeshFormat, MeshView, Placement, json, obj, read_cage, write_mesh};

/// A cube with something of everything, and numbers that are hard to write.
fn rich_cage() -> ControlMesh {
    let mut cage = shapes::cube();
    cage.points[0] = Vec3::new(1.0 / 3.0, -1e-300, 1e22);
    cage.points[1].x = f64::MIN_POSITIVE / 3.0;
    cage.points[2].y = -0.0;
    let finite = Sharpness::Finite;
    cage.creases = vec![
        Crease { vertices: [0, 2], sharpness: finite(0.1 + 0.2) },
        Crease { vertices: [1, 0], sharpness: Sharpness::Infinite },
    ];
    cage.corners = vec![
        Corner { vertex: 7, sharpness: finite(3.0) },
        Corner { vertex: 0, sharpness: Sharpness::Infinite },
    ];
    cage.holes = vec![5, 2];
    // Whether curves can meet there is not for the file to say.
    cage.meetings = vec![Meeting { vertex: 3, ports: vec![2, 7, 1], t: 1.0 / 3.0 }];
    let lens = LensShape { beta: 1.0 / 3.0, gamma: 0.1 };
    cage.scheme = Scheme { boundary: Boundary::EdgeOnly, creasing: Creasing::Chaikin, lens };
    cage.uv = Some(FaceVarying {
        values: vec![[0.0, 0.1], [1e-7, 0.5], [2.0 / 3.0, 1.0]],
        indices: (0..24).map(|i| i % 3).collect(),
        rule: FaceVaryingRule::CornersPlus2,
    });
    cage
}

fn through_obj(cage: &ControlMesh) -> ControlMesh {
    let mut file = Vec::new();
    obj::write_cage(cage, "a comment\nof two lines", &mut file).unwrap();
    assert!(file.starts_with(b"# a comment\n# of two lines\nv "));
    let read = read_cage(&file, CageFormat::Obj).unwrap();
    assert!(read.warnings.is_empty());
    read.mesh
}

fn through_json(cage: &ControlMesh) -> ControlMesh {
    let mut file = Vec::new();
    json::write_cage(cage, &mut file).unwrap();
    let read = read_cage(&file, CageFormat::Json).unwrap();
    assert!(read.warnings.is_empty());
    read.mesh
}

/// OBJ has no word for meetings and shapes of lenses.
fn without_meetings(cage: &ControlMesh) -> ControlMesh {
    let scheme = Scheme { lens: LensShape::default(), ..cage.scheme };
    ControlMesh { meetings: Vec::new(), scheme, ..cage.clone() }
}

#[test]
fn obj_and_json_keep_everything() {
    let mut cage = rich_cage();
    for boundary in [Boundary::EdgeAndCorner, Boundary::EdgeOnly, Boundary::None] {
        for creasing in [Creasing::Uniform, Creasing::Chaikin] {
            cage.scheme = Scheme { boundary, creasing, ..cage.scheme };
            assert_eq!(through_json(&cage), cage);
            assert_eq!(through_obj(&cage), without_meetings(&cage));
        }
    }
    use FaceVaryingRule::*;
    for rule in [None, CornersOnly, CornersPlus1, CornersPlus2, Boundaries, All] {
        cage.uv.as_mut().unwrap().rule = rule;
        assert_eq!(through_obj(&cage), without_meetings(&cage));
        assert_eq!(through_json(&cage), cage);
    }
    assert!(through_json(&cage).points[2].y.is_sign_negative(), "even the sign of zero");
}

#[test]
fn the_usual_lens_is_not_written() {
    let written = |cage: &ControlMesh| {
        let mut file = Vec::new();
        json::write_cage(cage, &mut file).unwrap();
        String::from_utf8(file).unwrap()
    };
    assert!(!written(&shapes::lens()).contains("lens"));
    assert!(written(&rich_cage()).contains("\"lens\": {\"beta\":0.3333333333333333,\"gamma\":0.1}"));
    let mut endless = shapes::cube();
    endless.scheme.lens.gamma = f64::NAN;
    assert!(json::write_cage(&endless, Vec::new()).is_err());
}

#[test]
fn other_polygons_survive() {
    let mut cage = shapes::disk(5, 2);
    cage.faces.push(&[0, 1, 2]);
    cage.faces.push(&[5, 6, 7, 8, 9, 10, 11]);
    assert_eq!(through_obj(&cage), cage);
    assert_eq!(through_json(&cage), cage);
}

#[test]
fn formats_for_meshes_keep_points_and_faces() {
    let cage = ControlMesh::new(rich_cage().points, shapes::cube().faces);
    for (mesh_format, cage_format) in [
        (MeshFormat::Obj, CageFormat::Obj),
        (MeshFormat::Off, CageFormat::Off),
        (MeshFormat::Ply, CageFormat::Ply),
        (MeshFormat::Json, CageFormat::Json),
    ] {
        let mut file = Vec::new();
        write_mesh(&MeshView::of_cage(&cage, "cube"), mesh_format, Placement::default(), &mut file).unwrap();
        assert_eq!(read_cage(&file, cage_format).unwrap().mesh, cage, "{mesh_format:?}");
    }
}

#[test]
fn what_json_cannot_say_is_refused() {
    let mut cage = shapes::cube();
    cage.points[3].y = f64::NAN;
    assert!(json::write_cage(&cage, &mut Vec::new()).is_err());
    let mut cage = shapes::cube();
    cage.corners.push(Corner { vertex: 0, sharpness: Sharpness::Finite(f64::NAN) });
    assert!(json::write_cage(&cage, &mut Vec::new()).is_err());
}
