//! Cages with vertices of valence 2 and with poles are converted to one solid each, smooth across everything that was put
//! in their place.

use ogee::convert::{Options, Packing, Part, to_part};
use ogee::lens::{self, Method};
use ogee::{ControlMesh, FaceList, Vec3, shapes};

/// A globe: two fans of `around` triangles with `rings` circles between.
fn globe(around: u32, rings: u32) -> ControlMesh {
    let mut points = vec![Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -1.1)];
    for ring in 1..=rings {
        let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings + 1);
        for x in 0..around {
            let angle = std::f64::consts::TAU * f64::from(x) / f64::from(around);
            let wobble = 1.0 + 0.1 * (3.0 * angle).sin();
            points.push(Vec3::new(
                wobble * polar.sin() * angle.cos(),
                0.8 * polar.sin() * angle.sin(),
                polar.cos(),
            ));
        }
    }
    let at = |ring: u32, x: u32| 2 + ring * around + x % around;
    let mut faces = FaceList::new();
    for x in 0..around {
        faces.push(&[0, at(0, x), at(0, x + 1)]);
        faces.push(&[1, at(rings - 1, x + 1), at(rings - 1, x)]);
        for ring in 1..rings {
            faces.push(&[at(ring - 1, x), at(ring, x), at(ring, x + 1), at(ring - 1, x + 1)]);
        }
    }
    ControlMesh::new(points, faces)
}

/// A flat tube whose two ends are slits of `length` edges: four lenses.
fn pouch(length: u32, rows: u32) -> ControlMesh {
    let around = 2 * length;
    let mut points = Vec::new();
    for y in 0..=rows {
        let height = f64::from(y) / f64::from(rows) - 0.5;
        let round = 1.0 - (2.0 * height).powi(2);
        for x in 0..around {
            let angle = std::f64::consts::TAU * f64::from(x) / f64::from(around);
            points.push(Vec3::new(
                angle.cos() * (0.6 + 0.6 * round),
                0.7 * angle.sin() * round,
                2.0 * height,
            ));
        }
    }
    let at = |y: u32, x: u32| {
        let x = x % around;
        y * around + if y == 0 || y == rows { x.min(around - x) } else { x }
    };
    let mut faces = FaceList::new();
    for y in 0..rows {
        for x in 0..around {
            faces.push(&[at(y, x), at(y, x + 1), at(y + 1, x + 1), at(y + 1, x)]);
        }
    }
    // Columns that were sewn onto their partners are left out.
    let mut number = vec![u32::MAX; points.len()];
    let mut kept = Vec::new();
    let mut list = FaceList::new();
    for face in faces.iter() {
        let face: Vec<u32> = face
            .iter()
            .map(|&v| {
                if number[v as usize] == u32::MAX {
                    number[v as usize] = kept.len() as u32;
                    kept.push(points[v as usize]);
                }
                number[v as usize]
            })
            .collect();
        list.push(&face);
    }
    ControlMesh::new(kept, list)
}

/// The same cage with a vertex in the middle of some quads, joined to two opposite corners.
fn with_doublets(mesh: &ControlMesh, every: usize) -> ControlMesh {
    let mut points = mesh.points.clone();
    let mut faces = FaceList::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        if f % every != 0 || face.len() != 4 {
            faces.push(face);
            continue;
        }
        let middle = face.iter().fold(Vec3::ZERO, |sum, &v| sum + 0.25 * mesh.points[v as usize]);
        let x = points.len() as u32;
        points.push(middle);
        faces.push(&[face[0], face[1], face[2], x]);
        faces.push(&[face[0], x, face[2], face[3]]);
    }
    ControlMesh::new(points, faces)
}

fn convert(mesh: &ControlMesh, method: Method, packing: Packing) -> Part {
    let lens = lens::Options { method, ..lens::Options::default() };
    to_part(mesh, &Options { lens, packing, ..Options::default() }).expect("a part")
}

fn is_one_smooth_solid(name: &str, part: &Part) {
    let report = &part.report;
    assert_eq!((report.solids, report.shells, report.sharp_edges), (1, 1, 0), "{name}");
    assert!(report.closed && report.volume.is_some_and(|volume| volume > 0.0), "{name}");
    assert!(report.max_normal_angle_deg < 1e-6, "{name}: {}", report.max_normal_angle_deg);
    assert!(report.max_gap < 1e-13, "{name}: {}", report.max_gap);
}

/// The methods that see to every lens.
const METHODS: [Method; 6] =
    [Method::Auto, Method::Merge, Method::Identify, Method::Remove, Method::C2, Method::DegreeRaise];

fn cages() -> Vec<(&'static str, ControlMesh)> {
    vec![
        ("globe", globe(8, 7)),
        ("globe of three", globe(3, 4)),
        ("odd globe", globe(7, 5)),
        ("pouch", pouch(4, 8)),
        ("short pouch", pouch(2, 6)),
        ("odd pouch", pouch(5, 9)),
        ("wing", shapes::lens()),
        ("torus with doublets", with_doublets(&shapes::torus(8, 6), 11)),
    ]
}

#[test]
fn every_method_makes_one_smooth_solid() {
    for (name, mesh) in &cages() {
        for packing in [Packing::Packed, Packing::Unpacked] {
            for method in METHODS {
                let part = convert(mesh, method, packing);
                is_one_smooth_solid(&format!("{name}, {}, {packing:?}", method.name()), &part);
            }
        }
    }
}

#[test]
fn packing_loses_nothing_of_caps() {
    for (name, mesh) in &cages() {
        for method in METHODS {
            let [packed, single] =
                [Packing::Packed, Packing::Unpacked].map(|packing| convert(mesh, method, packing));
            let of = |part: &Part| part.report.volume.unwrap_or_default();
            assert!((of(&packed) - of(&single)).abs() < 1e-13 * of(&single), "{name}, {}", method.name());
            assert_eq!(packed.report.patches, single.report.patches, "{name}, {}", method.name());
        }
    }
}

#[test]
fn where_all_else_is_regular_caps_leave_no_jump_of_curvature() {
    for (name, mesh) in &cages()[..7] {
        let polar = convert(mesh, Method::Auto, Packing::Packed);
        assert!(polar.report.max_curvature_jump < 1e-9, "{name}: {}", polar.report.max_curvature_jump);
        // A cap is two faces, and a band goes between two of them.
        assert_eq!(polar.report.faces_written, 5, "{name}");
        assert!(polar.report.max_deviation < 1e-14, "{name}");
        let is_globe = name.contains("globe");
        for method in [Method::C2, Method::DegreeRaise] {
            let jump = convert(mesh, method, Packing::Packed).report.max_curvature_jump;
            // Patches at a lens are some hundredths of the cage: what is rounding of points is that of curvature, too.
            assert!(is_globe || jump < 1e-5, "{name}, {}: {jump}", method.name());
        }
        // What it is measured against: vertices of valence 3.
        let merged = convert(mesh, Method::Merge, Packing::Packed);
        assert!(merged.report.max_curvature_jump > 0.1, "{name}");
    }
}

#[test]
fn every_piece_of_the_cage_has_its_name() {
    use std::collections::BTreeSet;
    for (name, mesh) in &cages()[..7] {
        for packing in [Packing::Packed, Packing::Unpacked] {
            let part = convert(mesh, Method::Auto, packing);
            let faces = part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces);
            let named: BTreeSet<u32> =
                faces.flat_map(|face| face.quads.cells()).map(|piece| piece.face.0).collect();
            assert!(named.iter().copied().eq(0..mesh.faces.len() as u32), "{name}, {packing:?}");
        }
    }
}

#[test]
fn a_pole_is_one_point_of_its_faces() {
    let part = convert(&globe(8, 7), Method::Auto, Packing::Unpacked);
    let shell = part.bodies.iter().flat_map(|body| body.shells()).next().expect("a shell");
    let poles: Vec<_> = shell.faces.iter().filter(|face| face.boundary.len() == 3).collect();
    assert_eq!(poles.len(), 16);
    for face in poles {
        let net = &face.surface.net;
        assert!((1..net.cols()).all(|j| net[(0, j)] == net[(0, 0)]));
        assert!(shell.vertices.contains(&net[(0, 0)]));
    }
}
