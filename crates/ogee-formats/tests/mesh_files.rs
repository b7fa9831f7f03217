//! Written meshes say what the formats demand, read here byte by byte.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee::{FaceList, FineMesh, Level, Vec3, shapes};
use ogee_formats::{
    CageFormat, Faces, MeshBlocks, MeshFormat, MeshView, Placement, read_cage, write_mesh, write_mesh_blocks,
};

fn write(view: &MeshView<'_>, format: MeshFormat) -> Vec<u8> {
    let mut file = Vec::new();
    write_mesh(view, format, Placement::default(), &mut file).unwrap();
    file
}

/// One square, with everything.
const SQUARE: [Vec3; 4] =
    [Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.5)];
const UP: [Vec3; 4] = [Vec3::new(0.0, 0.0, 1.0); 4];

fn square() -> MeshView<'static> {
    MeshView {
        points: &SQUARE,
        faces: Faces::Quads(&[[0, 1, 2, 3]]),
        normals: Some(&UP),
        uv: Some((&[[0.0, 0.0], [1.0, 0.25]], &[0, 1, 1, 0])),
        name: "a square",
    }
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn f32_at(bytes: &[u8], at: usize) -> f32 {
    f32::from_bits(u32_at(bytes, at))
}

#[test]
fn obj_has_normals_and_texture_coordinates() {
    let text = String::from_utf8(write(&square(), MeshFormat::Obj)).unwrap();
    assert_eq!(
        text,
        "o a_square\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0.25\n\
         vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1/1/1 2/2/2 3/2/3 4/1/4\n"
    );
    let last_line = |view: &MeshView<'_>| {
        String::from_utf8(write(view, MeshFormat::Obj)).unwrap().lines().last().unwrap().to_string()
    };
    assert_eq!(last_line(&MeshView { uv: None, ..square() }), "f 1//1 2//2 3//3 4//4");
    assert_eq!(last_line(&MeshView { normals: None, ..square() }), "f 1/1 2/2 3/2 4/1");
    assert_eq!(last_line(&MeshView { normals: None, uv: None, ..square() }), "f 1 2 3 4");
    assert_eq!(read_cage(text.as_bytes(), CageFormat::Obj).unwrap().mesh.uv.unwrap().indices, [0, 1, 1, 0]);
}

#[test]
fn ply_has_normals() {
    let file = write(&square(), MeshFormat::Ply);
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\n\
                  property double y\nproperty double z\nproperty double nx\nproperty double ny\n\
                  property double nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    assert!(file.starts_with(header.as_bytes()));
    assert_eq!(file.len(), header.len() + 4 * 48 + 1 + 16);
    assert_eq!(file[header.len() + 40..header.len() + 48], 1.0f64.to_le_bytes());
    assert_eq!(read_cage(&file, CageFormat::Ply).unwrap().mesh.points, SQUARE);
}

#[test]
fn ply_counts_many_corners() {
    let points: Vec<Vec3> = (0..300).map(|i| Vec3::new(f64::from(i), f64::from(i * i), 0.0)).collect();
    let mut faces = FaceList::new();
    faces.push(&(0..300).collect::<Vec<u32>>());
    let view =
        MeshView { points: &points, faces: Faces::Polygons(&faces), normals: None, uv: None, name: "" };
    assert_eq!(read_cage(&write(&view, MeshFormat::Ply), CageFormat::Ply).unwrap().mesh.faces, faces);
}

#[test]
fn stl_is_binary_with_facet_normals() {
    let file = write(&square(), MeshFormat::Stl);
    assert!(!file.starts_with(b"solid"));
    assert_eq!((file.len(), u32_at(&file, 80)), (84 + 2 * 50, 2));
    // The diagonal 0-2 is the shorter one: its triangles are 0 1 2 and 0 2 3.
    let vector = |at: usize| [0, 4, 8].map(|i| f32_at(&file, at + i));
    assert_eq!(vector(84), [0.0, 0.0, 1.0]);
    assert_eq!(vector(84 + 12), [0.0, 0.0, 0.0]);
    assert_eq!(vector(84 + 36), [2.0, 1.0, 0.0]);
    let second = vector(84 + 50);
    let tilted = Vec3::new(1.0, -2.0, 4.0).normalized().unwrap();
    for (axis, x) in <[f64; 3]>::from(tilted).into_iter().enumerate() {
        assert!((f64::from(second[axis]) - x).abs() < 1e-7, "{second:?}");
    }
    assert_eq!(vector(84 + 50 + 36), [0.0, 1.0, 0.5]);
}

#[test]
fn stl_of_a_closed_mesh_has_its_volume() {
    let cube = shapes::cube();
    let file = write(&MeshView::of_cage(&cube, "cube"), MeshFormat::Stl);
    let corner = |at: usize| Vec3::from([0, 4, 8].map(|i| f64::from(f32_at(&file, at + i))));
    let volume: f64 = (0..u32_at(&file, 80) as usize)
        .map(|i| 84 + 50 * i)
        .map(|at| corner(at + 12).dot(corner(at + 24).cross(corner(at + 36))) / 6.0)
        .sum();
    assert!((volume - 8.0).abs() < 1e-12, "{volume}");
}

/// The JSON and the binary chunk of a GLB file, after the checks of its frame.
fn chunks(file: &[u8]) -> (serde_json::Value, &[u8]) {
    assert_eq!((&file[..4], u32_at(file, 4), u32_at(file, 8)), (&b"glTF"[..], 2, file.len() as u32));
    let text_length = u32_at(file, 12) as usize;
    assert_eq!((&file[16..20], text_length % 4), (&b"JSON"[..], 0));
    let binary_at = 20 + text_length;
    let binary_length = u32_at(file, binary_at) as usize;
    assert_eq!((&file[binary_at + 4..binary_at + 8], binary_length % 4), (&b"BIN\0"[..], 0));
    assert_eq!(file.len(), binary_at + 8 + binary_length);
    (serde_json::from_slice(&file[20..binary_at]).unwrap(), &file[binary_at + 8..])
}

#[test]
fn glb_holds_one_triangle_mesh() {
    let file = write(&square(), MeshFormat::Glb);
    let (description, binary) = chunks(&file);
    assert_eq!(description["asset"]["version"], "2.0");
    let accessors = &description["accessors"];
    assert_eq!(accessors[0]["min"], serde_json::json!([0.0, 0.0, 0.0]));
    assert_eq!(accessors[0]["max"], serde_json::json!([2.0, 1.0, 0.5]));
    assert_eq!((&accessors[0]["count"], &accessors[2]["count"]), (&4.into(), &6.into()));
    assert_eq!(description["buffers"][0]["byteLength"], binary.len());
    let view = |i: usize| {
        let view = &description["bufferViews"][i];
        let at = view["byteOffset"].as_u64().unwrap() as usize;
        &binary[at..at + view["byteLength"].as_u64().unwrap() as usize]
    };
    assert_eq!((f32_at(view(0), 12), f32_at(view(0), 44)), (2.0, 0.5));
    assert_eq!((f32_at(view(1), 4), f32_at(view(1), 8)), (0.0, 1.0));
    let indices: Vec<u32> = (0..6).map(|i| u32_at(view(2), 4 * i)).collect();
    assert_eq!(indices, [0, 1, 2, 0, 2, 3]);
}

#[test]
fn glb_takes_units_and_axes_into_its_matrix() {
    let matrix = |placement: Placement| {
        let mut file = Vec::new();
        write_mesh(&square(), MeshFormat::Glb, placement, &mut file).unwrap();
        let values: Vec<f64> = serde_json::from_value(chunks(&file).0["nodes"][0]["matrix"].clone()).unwrap();
        // A column-major matrix times a point.
        move |p: [f64; 3]| {
            [0, 1, 2].map(|row| (0..3).map(|k| values[4 * k + row] * p[k]).sum::<f64>() + values[12 + row])
        }
    };
    let plain = matrix(Placement { unit_in_metres: 0.5, z_up: false });
    assert_eq!(plain([1.0, 2.0, 3.0]), [0.5, 1.0, 1.5]);
    let turned = matrix(Placement { unit_in_metres: 1.0, z_up: true });
    assert_eq!(turned([1.0, 2.0, 3.0]), [1.0, 3.0, -2.0]);
    let default = matrix(Placement::default());
    assert_eq!(default([1000.0, 0.0, 0.0]), [1.0, 0.0, 0.0]);
}

#[test]
fn glb_normals_are_unit_even_where_none_is_given() {
    let cube = shapes::cube();
    let mut given = [Vec3::new(0.0, 3.0, 0.0); 8];
    given[1] = Vec3::ZERO;
    for normals in [None, Some(&given[..])] {
        let file = write(&MeshView { normals, ..MeshView::of_cage(&cube, "") }, MeshFormat::Glb);
        let binary = chunks(&file).1;
        for v in 0..8 {
            let normal = Vec3::from([0, 4, 8].map(|i| f64::from(f32_at(binary, 96 + 12 * v + i))));
            assert!((normal.length() - 1.0).abs() < 1e-6);
            if normals.is_none() || v == 1 {
                assert!(normal.dot(cube.points[v]) > 0.5, "outward");
            } else {
                assert_eq!(normal, Vec3::new(0.0, 1.0, 0.0));
            }
        }
    }
}

#[test]
fn json_is_a_cage() {
    let read = read_cage(&write(&square(), MeshFormat::Json), CageFormat::Json).unwrap();
    assert!(read.warnings.is_empty());
    assert_eq!(read.mesh.points, SQUARE);
    assert_eq!(read.mesh.uv.unwrap().indices, [0, 1, 1, 0]);
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let broken = [
        MeshView { points: &SQUARE[..3], normals: None, ..square() },
        MeshView { normals: Some(&UP[..3]), ..square() },
        MeshView { uv: Some((&[[0.0; 2]], &[0, 0, 0])), ..square() },
        MeshView { uv: Some((&[[0.0; 2]], &[0, 0, 0, 1])), ..square() },
        MeshView { points: &[Vec3::new(f64::NAN, 0.0, 0.0); 4], ..square() },
    ];
    for view in broken {
        for format in MeshFormat::ALL {
            let error = write_mesh(&view, format, Placement::default(), Vec::new()).unwrap_err();
            assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput, "{view:?} {format:?}");
        }
    }
    let far = MeshView { points: &[Vec3::new(1e39, 0.0, 0.0); 4], ..square() };
    assert!(write_mesh(&far, MeshFormat::Glb, Placement::default(), Vec::new()).is_err());
    for unit_in_metres in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let placement = Placement { unit_in_metres, z_up: true };
        assert!(write_mesh(&square(), MeshFormat::Glb, placement, Vec::new()).is_err());
    }
    let none = MeshView { faces: Faces::Quads(&[]), uv: None, ..square() };
    assert!(write_mesh(&none, MeshFormat::Glb, Placement::default(), Vec::new()).is_err());
}

/// A mesh in blocks of one, two, three and so on.
struct Blocks<'a> {
    points: &'a [Vec3],
    quads: &'a [[u32; 4]],
    promised: [usize; 2],
}

fn growing<T>(mut rest: &[T], take: &mut dyn FnMut(&[T]) -> std::io::Result<()>) -> std::io::Result<()> {
    for size in 0.. {
        let (block, others) = rest.split_at(size.min(rest.len()));
        take(block)?;
        rest = others;
        if rest.is_empty() {
            break;
        }
    }
    Ok(())
}

impl MeshBlocks for Blocks<'_> {
    fn vertex_count(&self) -> usize {
        self.promised[0]
    }
    fn face_count(&self) -> usize {
        self.promised[1]
    }
    fn points(&self, take: &mut dyn FnMut(&[Vec3]) -> std::io::Result<()>) -> std::io::Result<()> {
        growing(self.points, take)
    }
    fn quads(&self, take: &mut dyn FnMut(&[[u32; 4]]) -> std::io::Result<()>) -> std::io::Result<()> {
        growing(self.quads, take)
    }
}

fn blocks(mesh: &FineMesh) -> Blocks<'_> {
    let promised = [mesh.points.len(), mesh.faces.len()];
    Blocks { points: &mesh.points, quads: &mesh.faces, promised }
}

fn fine_torus() -> FineMesh {
    let torus = shapes::torus(7, 5);
    Level::new(&torus).unwrap().fine_mesh(&torus.points, 2, u64::MAX).unwrap()
}

#[test]
fn a_mesh_in_blocks_gives_the_same_bytes() {
    let torus = fine_torus();
    let none = FineMesh { points: Vec::new(), faces: Vec::new() };
    for (mesh, name) in [(&torus, "a torus"), (&none, "")] {
        let view = MeshView {
            points: &mesh.points,
            faces: Faces::Quads(&mesh.faces),
            normals: None,
            uv: None,
            name,
        };
        for format in MeshFormat::ALL {
            let mut streamed = Vec::new();
            let result = write_mesh_blocks(&blocks(mesh), name, format, &mut streamed);
            if !format.takes_blocks() {
                assert_eq!(result.unwrap_err().kind(), std::io::ErrorKind::InvalidInput);
                continue;
            }
            result.unwrap();
            let mut whole = Vec::new();
            write_mesh(&view, format, Placement::default(), &mut whole).unwrap();
            assert!(streamed == whole, "{}", format.name());
        }
    }
}

#[test]
fn blocks_that_are_not_what_was_promised_are_refused() {
    let torus = fine_torus();
    let [v, f] = [torus.points.len(), torus.faces.len()];
    let mut folded = torus.clone();
    folded.faces[9][2] = v as u32;
    let mut endless = torus.clone();
    endless.points[100].y = f64::NAN;
    for format in [MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Off] {
        let refused = |blocks: Blocks<'_>, why: &str| {
            let error = write_mesh_blocks(&blocks, "x", format, Vec::new()).unwrap_err();
            assert!(error.to_string().contains(why), "{error}");
        };
        refused(Blocks { promised: [v + 1, f], ..blocks(&torus) }, "vertices were promised");
        refused(Blocks { promised: [v, f - 1], ..blocks(&torus) }, "faces were promised");
        refused(blocks(&folded), "missing vertex");
        refused(blocks(&endless), "not finite");
    }
}

#[test]
fn a_disk_that_fills_while_blocks_come_is_an_error() {
    struct Filling(usize);
    impl std::io::Write for Filling {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(std::io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let torus = shapes::torus(40, 30);
    let torus = Level::new(&torus).unwrap().fine_mesh(&torus.points, 3, u64::MAX).unwrap();
    for format in [MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Off] {
        let mut file = Vec::new();
        write_mesh_blocks(&blocks(&torus), "", format, &mut file).unwrap();
        for room in [0, 1, file.len() / 3, file.len() - 1] {
            let error = write_mesh_blocks(&blocks(&torus), "", format, Filling(room)).unwrap_err();
            assert_eq!(error.kind(), std::io::ErrorKind::StorageFull);
        }
        write_mesh_blocks(&blocks(&torus), "", format, Filling(file.len())).unwrap();
    }
}

#[test]
fn a_full_disk_is_an_error() {
    struct Full;
    impl std::io::Write for Full {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::ErrorKind::StorageFull.into())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    for format in MeshFormat::ALL {
        let error = write_mesh(&square(), format, Placement::default(), Full).unwrap_err();
        assert_eq!(error.kind(), std::io::ErrorKind::StorageFull);
    }
}

#[test]
fn formats_are_told_by_name_and_extension() {
    for format in MeshFormat::ALL {
        assert_eq!(MeshFormat::from_name(&format.name().to_uppercase()), Some(format));
        let path = format!("out.v2.{}", format.name());
        assert_eq!(MeshFormat::from_path(path.as_ref()), Some(format));
    }
    for format in CageFormat::ALL {
        assert_eq!(CageFormat::from_name(format.name()), Some(format));
    }
    assert_eq!(MeshFormat::from_path("out.step".as_ref()), None);
    assert_eq!(CageFormat::from_name("stl"), None);
}
