//! PLY files, plain and binary, are read whatever their types and extras, and broken ones are told.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee::Vec3;
use ogee_formats::{CageFile, CageFormat, ReadError, read_cage};

fn read(bytes: &[u8]) -> CageFile {
    read_cage(bytes, CageFormat::Ply).unwrap()
}

fn refuse(bytes: &[u8]) -> ReadError {
    read_cage(bytes, CageFormat::Ply).unwrap_err()
}

const ASCII: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n\
                     property float y\nproperty float z\nelement face 2\n\
                     property list uchar int vertex_indices\nend_header\n\
                     0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n3 0 1 2\n4 0 1 2 3\n";

/// Writes numbers in one byte order.
struct Bytes {
    big: bool,
    all: Vec<u8>,
}

macro_rules! put {
    ($($name:ident: $type:ty),*) => {
        impl Bytes {
            $(fn $name(&mut self, values: &[$type]) {
                for value in values {
                    self.all.extend(if self.big { value.to_be_bytes() } else { value.to_le_bytes() });
                }
            })*
        }
    };
}
put!(i8: i8, u8: u8, i16: i16, u16: u16, i32: i32, u32: u32, f32: f32, f64: f64);

/// The same cage as `ASCII`, with every type of number somewhere and elements nobody asked for.
fn binary(big: bool, line_end: &str) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let header = format!(
        "ply\nformat binary_{order}_endian 1.0\nobj_info nothing\nelement camera 2\nproperty int8 a\n\
         property list uint16 float64 b\nelement nothing 1000000000000\nelement vertex 4\nproperty short a\n\
         property double x\nproperty list uchar ushort b\nproperty int y\nproperty float z\nproperty uint s\n\
         element face 2\nproperty uchar flags\nproperty list int uint vertex_index\n\
         property list uchar float texcoord\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n\
         end_header\n"
    );
    let mut bytes = Bytes { big, all: header.replace('\n', line_end).into_bytes() };
    bytes.i8(&[-1]);
    bytes.u16(&[2]);
    bytes.f64(&[0.5, 0.5]);
    bytes.i8(&[-2]);
    bytes.u16(&[0]);
    for point in [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.25, 2.0, 1.5]] {
        bytes.i16(&[7]);
        bytes.f64(&point[..1]);
        bytes.u8(&[3]);
        bytes.u16(&[1, 2, 3]);
        bytes.i32(&[point[1] as i32]);
        bytes.f32(&[point[2] as f32]);
        bytes.u32(&[9]);
    }
    for face in [&[0, 1, 2][..], &[0, 1, 2, 3]] {
        bytes.u8(&[1]);
        bytes.i32(&[face.len() as i32]);
        bytes.u32(face);
        bytes.u8(&[2]);
        bytes.f32(&[0.0, 1.0]);
    }
    bytes.i32(&[0, 1]);
    bytes.all
}

#[test]
fn plain() {
    let file = read(ASCII.as_bytes());
    assert_eq!(file.mesh.points[3], Vec3::new(0.0, 1.5, 0.0));
    assert_eq!(file.mesh.faces.face(0), [0, 1, 2]);
    assert_eq!(file.mesh.faces.face(1), [0, 1, 2, 3]);
    assert_eq!(file.face_lines, [15, 16]);
    for text in [
        ASCII.replace('\n', "\r\n"),
        ASCII.replace("vertex_indices", "vertex_index"),
        ASCII.replace("float x", "float64 x").replace("uchar int", "uint8 uint32"),
        ASCII.replace("3 0 1 2\n", "\n3 0 1 2 255 0 0\n"),
    ] {
        assert_eq!(read(text.as_bytes()).mesh, file.mesh, "{text}");
    }
}

#[test]
fn plain_with_extras() {
    let text = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int strip\nelement vertex 3\n\
                property float nx\nproperty float z\nproperty float y\nproperty float x\nproperty uchar red\n\
                element face 1\nproperty list uchar uchar other\nproperty list uchar uchar vertex_indices\n\
                end_header\n2 7 7\n9 3 2 1 255\n9 6 5 4 255\n9 9 8 7 255\n2 5 5 3 2 1 0\n";
    let file = read(text.as_bytes());
    assert_eq!(file.mesh.points[0], Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(file.mesh.faces.face(0), [2, 1, 0]);
}

#[test]
fn binary_in_both_orders_with_every_type() {
    for big in [false, true] {
        for line_end in ["\n", "\r\n"] {
            let file = read(&binary(big, line_end));
            assert_eq!(file.mesh.points[3], Vec3::new(0.25, 2.0, 1.5));
            assert_eq!(file.mesh.points[2], Vec3::new(1.0, 1.0, 0.0));
            assert_eq!(file.mesh.faces.face(0), [0, 1, 2]);
            assert_eq!(file.mesh.faces.face(1), [0, 1, 2, 3]);
            assert!(file.face_lines.is_empty());
        }
    }
}

#[test]
fn truncated_binary_is_told_wherever_it_ends() {
    let whole = binary(false, "\n");
    let body = whole.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    for end in body..whole.len() {
        let error = refuse(&whole[..end]);
        assert_eq!(error.faults.last().unwrap().code, "truncated", "{end}");
    }
    for end in 1..body {
        assert!(["bad_header", "truncated"].contains(&refuse(&whole[..end]).faults[0].code), "{end}");
    }
    let error = refuse(&whole[..whole.len() - 60]);
    assert_eq!(error.to_string(), "the file ends within its 2 records `face`");
}

#[test]
fn great_promises_are_not_believed() {
    for format in ["ascii", "binary_little_endian"] {
        for header in [
            "element vertex 1000000000000\nproperty double x\nproperty double y\nproperty double z\n",
            "element vertex 0\nproperty char x\nproperty char y\nproperty char z\nelement face 1000000000000\n\
             property list uchar int vertex_indices\n",
        ] {
            let error = refuse(format!("ply\nformat {format} 1.0\n{header}end_header\n").as_bytes());
            assert_eq!(error.faults[0].code, "truncated");
        }
    }
    let mut list = b"ply\nformat binary_big_endian 1.0\nelement vertex 0\nproperty char x\nproperty char y\n\
                     property char z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
        .to_vec();
    list.extend(u32::MAX.to_be_bytes());
    assert_eq!(refuse(&list).faults[0].code, "truncated");
}

#[test]
fn mistakes_are_told() {
    let replaced = |from: &str, to: &str| refuse(ASCII.replace(from, to).as_bytes());
    for (from, to, line, code, message) in [
        ("ply\n", "plx\n", Some(1), "bad_header", "a PLY file begins with a line `ply`"),
        ("format ascii 1.0\n", "", Some(9), "bad_header", "the header has no line `format`"),
        ("ascii", "utf", Some(2), "bad_header", "unknown format `utf`"),
        ("float x", "half x", Some(5), "bad_header", "`half` is no type of numbers"),
        ("float x", "float", Some(5), "bad_header", "a property needs a type and a name"),
        ("vertex 4", "vertex", Some(4), "bad_header", "an element needs a name and a count"),
        ("vertex 4", "vertex -4", Some(4), "bad_header", "an element needs a name and a count"),
        ("element vertex 4\n", "", Some(4), "bad_header", "a property before the first element"),
        ("comment", "remark", Some(3), "bad_header", "`remark` does not belong in a header"),
        ("float x", "float w", None, "bad_header", "the vertices have no properties x, y and z"),
        ("vertex_indices", "corners", None, "bad_header", "the faces have no list vertex_indices"),
        ("1 1 0\n", "1 1\n", Some(13), "missing_number", "vertex 2 has too few numbers on its line"),
        ("1 1 0\n", "1 one 0\n", Some(13), "bad_number", "vertex 2 has `one`, which is no number"),
        (
            "1 1 0\n",
            "1 nan 0\n",
            Some(13),
            "not_finite",
            "vertex 2 has a coordinate that is no finite number",
        ),
        ("3 0 1 2\n", "3 0 1\n", Some(15), "missing_number", "face 0 has too few numbers on its line"),
        ("3 0 1 2\n", "3.5 0 1 2\n", Some(15), "bad_number", "face 0 has a list of 3.5 numbers"),
        ("3 0 1 2\n", "-3 0 1 2\n", Some(15), "bad_number", "face 0 has a list of -3 numbers"),
        ("3 0 1 2\n", "3 0 1 0.5\n", Some(15), "bad_number", "face 0 has a corner 0.5, no vertex number"),
        ("3 0 1 2\n", "3 0 1 nan\n", Some(15), "bad_number", "face 0 has a corner NaN, no vertex number"),
        ("3 0 1 2\n", "2 0 1\n", Some(15), "face_too_small", "face 0 has 2 corners, fewer than three"),
        ("3 0 1 2\n", "3 0 1 1\n", Some(15), "repeated_vertex", "face 0 uses vertex 1 more than once"),
        ("3 0 1 2\n", "3 0 1 4\n", Some(15), "missing_vertex", "face 0 uses vertex 4, the file has 4"),
        (
            "3 0 1 2\n",
            "3 0 1 -1\n",
            Some(15),
            "missing_vertex",
            "face 0 uses vertex -1, the first has number 0",
        ),
        ("face 2", "face 3", Some(16), "truncated", "the file ends within its 3 records `face`"),
        ("face 2", "face 0", None, "no_faces", "the file has no faces"),
    ] {
        let error = replaced(from, to);
        let first = &error.faults[0];
        assert_eq!((first.line, first.code, &first.message[..]), (line, code, message), "{to:?}");
    }
    assert_eq!(refuse(b"\x00\x01\x02").to_string(), "a PLY file begins with a line `ply`");
}

#[test]
fn a_list_of_negative_length_ends_the_reading_of_a_binary_file() {
    let mut bytes =
        b"ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty char x\nproperty char y\n\
                      property char z\nelement face 2\nproperty list char int vertex_indices\nend_header\n"
            .to_vec();
    bytes.extend([0xff; 40]);
    assert_eq!(refuse(&bytes).to_string(), "face 0 has a list of -1 numbers");
}
