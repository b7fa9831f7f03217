//! No bytes make a reader panic or take memory out of proportion, and what it accepts is what it promises.

#![expect(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]

use ogee_formats::{CageFormat, MeshFormat, MeshView, Placement, json, obj, read_cage, write_mesh};
use proptest::prelude::*;

/// Reads, and checks the promises of a file that was accepted and of an error that was given.
fn read_whatever(bytes: &[u8], format: CageFormat) {
    match read_cage(bytes, format) {
        Ok(file) => {
            let mesh = &file.mesh;
            assert!(!mesh.faces.is_empty());
            assert!(mesh.points.iter().all(|p| p.is_finite()));
            assert!(mesh.faces.iter().all(|face| face.len() >= 3));
            assert!(mesh.faces.corners().iter().all(|&v| (v as usize) < mesh.points.len()));
            assert!(mesh.holes.iter().all(|&f| (f as usize) < mesh.faces.len()));
            if let Some(uv) = &mesh.uv {
                assert_eq!(uv.indices.len(), mesh.faces.corners().len());
                assert!(uv.indices.iter().all(|&i| (i as usize) < uv.values.len()));
            }
            assert!(file.face_lines.is_empty() || file.face_lines.len() == mesh.faces.len());
        }
        Err(error) => {
            assert!(!error.faults.is_empty());
            for fault in &error.faults {
                assert!(!fault.message.is_empty() && !fault.message.contains('\n'), "{fault:?}");
                assert!(fault.message.len() < 400, "{fault:?}");
            }
        }
    }
}

/// A valid file of each format, the binary PLY and the plain one among them.
fn valid_files() -> Vec<(CageFormat, Vec<u8>)> {
    let mut cage = ogee::shapes::disk(5, 2);
    let ends = [cage.faces.face(0)[0], cage.faces.face(0)[1]];
    cage.creases.push(ogee::Crease { vertices: ends, sharpness: ogee::Sharpness::Finite(1.5) });
    cage.corners.push(ogee::Corner { vertex: 3, sharpness: ogee::Sharpness::Infinite });
    cage.holes.push(2);
    cage.uv = Some(ogee::FaceVarying {
        values: vec![[0.25, 0.5]; 4],
        indices: (0..cage.faces.corners().len() as u32).map(|i| i % 4).collect(),
        rule: ogee::FaceVaryingRule::All,
    });
    let mut files = Vec::new();
    let mut file = Vec::new();
    obj::write_cage(&cage, "disk", &mut file).unwrap();
    files.push((CageFormat::Obj, file));
    let mut file = Vec::new();
    json::write_cage(&cage, &mut file).unwrap();
    files.push((CageFormat::Json, file));
    for (mesh_format, cage_format) in [(MeshFormat::Off, CageFormat::Off), (MeshFormat::Ply, CageFormat::Ply)]
    {
        let mut file = Vec::new();
        let view = MeshView::of_cage(&cage, "disk");
        write_mesh(&view, mesh_format, Placement::default(), &mut file).unwrap();
        files.push((cage_format, file));
    }
    let plain = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                 0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n";
    files.push((CageFormat::Ply, plain.as_bytes().to_vec()));
    files
}

/// Words that readers know, and what often stands beside them.
fn words() -> impl Strategy<Value = String> {
    let word = prop_oneof![
        prop::sample::select(vec![
            "v",
            "vt",
            "f",
            "t",
            "crease",
            "corner",
            "hole",
            "2/1/0",
            "1/1/0",
            "1/0/0",
            "\\",
            "#",
            "/",
            "1//",
            "OFF",
            "COFF",
            "ply",
            "format",
            "ascii",
            "1.0",
            "binary_big_endian",
            "element",
            "vertex",
            "face",
            "property",
            "list",
            "uchar",
            "int",
            "double",
            "x",
            "y",
            "z",
            "vertex_indices",
            "end_header",
            "{",
            "}",
            "[",
            "]",
            ",",
            ":",
            "\"vertices\"",
            "\"faces\"",
            "\"creases\"",
            "\"sharpness\"",
            "nan",
            "inf",
            "-1",
            "1e999",
            "999999999999",
            "4294967295",
            "4294967296",
            "18446744073709551616",
        ])
        .prop_map(str::to_string),
        (0..12i64).prop_map(|i| i.to_string()),
        any::<f64>().prop_map(|x| x.to_string()),
    ];
    let blank = prop::sample::select(vec![" ", "\n", "\n", "\r\n", "\t", ""]);
    prop::collection::vec((word, blank), 0..120)
        .prop_map(|pairs| pairs.into_iter().flat_map(|(word, blank)| [word, blank.to_string()]).collect())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..600)) {
        for format in CageFormat::ALL {
            read_whatever(&bytes, format);
        }
    }

    #[test]
    fn any_words(text in words()) {
        for format in CageFormat::ALL {
            read_whatever(text.as_bytes(), format);
        }
        for header in ["OFF 3 2 0\n", "ply\nformat ascii 1.0\n", "ply\nformat binary_little_endian 1.0\n"] {
            let format = if header.starts_with("OFF") { CageFormat::Off } else { CageFormat::Ply };
            read_whatever(format!("{header}{text}").as_bytes(), format);
        }
    }

    #[test]
    fn valid_files_cut_and_flipped(
        cut in any::<prop::sample::Index>(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        is_cut in any::<bool>(),
    ) {
        for (format, mut bytes) in valid_files() {
            if is_cut {
                bytes.truncate(cut.index(bytes.len()));
            }
            for (at, mask) in &flips {
                if !bytes.is_empty() {
                    let at = at.index(bytes.len());
                    bytes[at] ^= mask;
                }
            }
            read_whatever(&bytes, format);
        }
    }

    #[test]
    fn valid_files_with_pieces_moved(
        from in any::<prop::sample::Index>(),
        to in any::<prop::sample::Index>(),
        length in 1..40usize,
    ) {
        for (format, mut bytes) in valid_files() {
            let from = from.index(bytes.len());
            let piece: Vec<u8> = bytes[from..bytes.len().min(from + length)].to_vec();
            let to = to.index(bytes.len());
            bytes.splice(to..to, piece);
            read_whatever(&bytes, format);
        }
    }
}

#[test]
fn every_beginning_of_a_valid_file() {
    for (format, bytes) in valid_files() {
        read_whatever(&bytes, format);
        assert!(read_cage(&bytes, format).is_ok(), "{format:?}");
        for end in 0..bytes.len() {
            read_whatever(&bytes[..end], format);
        }
    }
}
