//! Chart sizes and coefficient counts of `testdata/pccm/packing.json`, and packed surfaces against those of each quad.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and says what it saw"
)]

mod golden;

use golden::{cage, documents, index, list};
use ogee::convert::{Method, Options, Packing, Part, to_part};
use ogee::nurbs::{FaceAddress, ShellFace};
use ogee::{ControlMesh, Corner, Crease, Sharpness, Vec3, shapes};

fn faces(part: &Part) -> impl Iterator<Item = &ShellFace> {
    part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces)
}

fn coefficients(part: &Part) -> usize {
    faces(part).map(|face| face.surface.net.cells().len()).sum()
}

fn options(method: Method, packing: Packing) -> Options {
    Options { method, packing, ..Options::default() }
}

/// The boundary of a box of `x * y * z` cells.
fn box_of(x: u32, y: u32, z: u32) -> ControlMesh {
    let size = [x, y, z];
    let mut points: Vec<[u32; 3]> = Vec::new();
    let mut faces = Vec::new();
    let mut vertex = |p: [u32; 3]| match points.iter().position(|&q| q == p) {
        Some(found) => found as u32,
        None => {
            points.push(p);
            points.len() as u32 - 1
        }
    };
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        for i in 0..size[a] {
            for j in 0..size[b] {
                for side in [0, size[axis]] {
                    let mut at = |di: u32, dj: u32| {
                        let mut p = [0; 3];
                        (p[axis], p[a], p[b]) = (side, i + di, j + dj);
                        vertex(p)
                    };
                    let quad = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                    faces.push(if side == 0 { [quad[0], quad[3], quad[2], quad[1]] } else { quad });
                }
            }
        }
    }
    let points = points.into_iter().map(|p| Vec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])));
    ControlMesh::new(points.collect(), faces.into_iter().collect())
}

#[test]
fn counts_match() {
    let (_, document) = documents("pccm").into_iter().find(|(name, _)| name == "packing").unwrap();
    for case in list(&document) {
        let name = &case["name"];
        let mesh = cage(&case["cage"], &serde_json::Value::Null);
        for (method, key) in [(Method::PccmFirst, "first"), (Method::Pccm, "second")] {
            let level = Some(index(&case[key]["level"]));
            let packed = to_part(&mesh, &Options { level, ..options(method, Packing::Packed) }).unwrap();
            let mut sizes: Vec<[usize; 2]> = faces(&packed)
                .map(|face| {
                    let (a, b) = (face.quads.rows(), face.quads.cols());
                    [a.min(b), a.max(b)]
                })
                .collect();
            sizes.sort_unstable();
            let mut wanted: Vec<[usize; 2]> = list(&case["charts"])
                .iter()
                .map(|c| [index(&c[0]) as usize, index(&c[1]) as usize])
                .collect();
            wanted.sort_unstable();
            assert_eq!(sizes, wanted, "{name} {key}");
            assert_eq!(
                coefficients(&packed) as u64,
                case[key]["control_points_packed"].as_u64().unwrap(),
                "{name} {key}"
            );
            let single = to_part(&mesh, &Options { level, ..options(method, Packing::Unpacked) }).unwrap();
            assert_eq!(single.report.faces_written as u64, case["quads"].as_u64().unwrap(), "{name} {key}");
        }
    }
}

#[test]
fn a_closed_box_of_108_quads_is_six_faces() {
    let mesh = box_of(6, 4, 3);
    assert_eq!(mesh.faces.len(), 108);
    let asked = Options { level: Some(2), ..options(Method::PccmFirst, Packing::Packed) };
    let part = to_part(&mesh, &asked).unwrap();
    assert_eq!((part.report.level, part.report.faces_written, coefficients(&part)), (2, 6, 1406));
    assert_eq!((part.report.solids, part.report.edges, part.report.vertices), (1, 12, 8));
}

/// Every face of a packed part, quad by quad, against the surface of that quad alone.
fn agrees_with_single_quads(
    name: &str,
    mesh: &ControlMesh,
    method: Method,
    level: Option<u32>,
    tolerance: f64,
) {
    let packed = to_part(mesh, &Options { level, ..options(method, Packing::Packed) }).unwrap();
    let single = to_part(mesh, &Options { level, ..options(method, Packing::Unpacked) }).unwrap();
    let of = |address: FaceAddress| faces(&single).find(|face| face.address() == address).unwrap();
    let mut worst: f64 = 0.0;
    for face in faces(&packed) {
        for i in 0..face.quads.rows() {
            for j in 0..face.quads.cols() {
                let alone = of(face.quads[(i, j)]);
                // The quad may be turned against the chart: try all four, one must agree everywhere.
                let turned = (0..4).map(|turn| {
                    let mut gap: f64 = 0.0;
                    for (s, t) in
                        [(0.0, 0.0), (0.1, 0.3), (0.3, 0.1), (0.6, 0.7), (0.9, 0.2), (0.4, 0.95), (1.0, 1.0)]
                    {
                        let (u, v) = [(s, t), (t, 1.0 - s), (1.0 - s, 1.0 - t), (1.0 - t, s)][turn];
                        let here = face.surface.jet(i as f64 + s, j as f64 + t).position;
                        gap = gap.max(here.distance(alone.surface.jet(u, v).position));
                    }
                    gap
                });
                worst = worst.max(turned.fold(f64::INFINITY, f64::min));
            }
        }
    }
    println!("{name}: {worst:e}, {} faces from {}", packed.report.faces_written, single.report.faces_written);
    assert!(worst <= tolerance * mesh.size(), "{name}: {worst:e}");
}

#[test]
fn packed_surfaces_are_the_same_surface() {
    let (_, document) = documents("pccm").into_iter().find(|(name, _)| name == "packing").unwrap();
    for case in list(&document) {
        let mesh = cage(&case["cage"], &serde_json::Value::Null);
        for level in 2..=5 {
            let name = format!("{} level {level}", case["name"]);
            agrees_with_single_quads(&name, &mesh, Method::Pccm, Some(level), 1e-13);
        }
        agrees_with_single_quads(&case["name"].to_string(), &mesh, Method::PccmFirst, None, 1e-13);
    }
    agrees_with_single_quads("disk 7", &shapes::disk(7, 4), Method::Pccm, None, 1e-13);
}

#[test]
fn packed_surfaces_keep_what_semi_sharp_creases_leave() {
    for sharpness in [1.0, 2.0, 2.5] {
        let mut mesh = box_of(4, 4, 4);
        // A line across the top, and a semi-sharp vertex away from it.
        let top = |i: u32, j: u32| {
            let wanted = Vec3::new(f64::from(i), f64::from(j), 4.0);
            mesh.points.iter().position(|&p| p == wanted).unwrap() as u32
        };
        let creases: Vec<Crease> = (0..4)
            .map(|i| Crease { vertices: [top(i, 1), top(i + 1, 1)], sharpness: Sharpness::Finite(sharpness) })
            .collect();
        let corner = Corner { vertex: top(2, 3), sharpness: Sharpness::Finite(sharpness) };
        mesh.creases = creases;
        mesh.corners = vec![corner];
        // On a flat top with even spacing a crease would change nothing.
        for (k, p) in mesh.points.iter_mut().enumerate() {
            let shift = |by: usize| ((k * by % 11) as f64 - 5.0) / 40.0;
            *p += Vec3::new(shift(3), shift(5), shift(7));
        }
        agrees_with_single_quads(&format!("semi-sharp {sharpness}"), &mesh, Method::Pccm, None, 1e-13);
    }
}

#[test]
fn sharp_creases_are_edges_of_faces() {
    let mut mesh = box_of(4, 4, 4);
    for k in 0..mesh.points.len() as u32 {
        for h in 0..mesh.points.len() as u32 {
            let (p, q) = (mesh.points[k as usize], mesh.points[h as usize]);
            let on_rim = |p: Vec3| p.z == 4.0 && (p.x == 0.0 || p.x == 4.0 || p.y == 0.0 || p.y == 4.0);
            if k < h && on_rim(p) && on_rim(q) && p.distance(q) == 1.0 {
                mesh.creases.push(Crease { vertices: [k, h], sharpness: Sharpness::Infinite });
            }
        }
    }
    assert_eq!(mesh.creases.len(), 16);
    let part = to_part(&mesh, &Options::default()).unwrap();
    assert!(part.report.sharp_edges >= 4 && part.report.solids == 1);
    agrees_with_single_quads("creased box", &mesh, Method::Pccm, None, 1e-13);
}
