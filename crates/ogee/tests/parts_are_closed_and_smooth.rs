//! What a part promises: closed where the cage is, no gaps, tangent planes shared, volume and deviation as measured by
//! the reference implementation.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and says what it saw"
)]

mod golden;

use golden::{cage, documents};
use ogee::convert::{Body, Method, Options, Packing, Part, to_part};
use ogee::nurbs::Side;
use ogee::{ControlMesh, Vec3, shapes};

fn check(name: &str, mesh: &ControlMesh, part: &Part) {
    let report = &part.report;
    let size = mesh.size();
    println!(
        "{name}: level {}, {} faces, gap {:.1e}, angle {:.1e} deg, jump {:.1e}, deviation {:.2e}",
        report.level,
        report.faces_written,
        report.max_gap / size,
        report.max_normal_angle_deg,
        report.max_curvature_jump,
        report.max_deviation_relative
    );
    assert!(report.max_gap <= 1e-13 * size, "{name}");
    assert!(report.max_normal_angle_deg.to_radians() <= 1e-10, "{name}");
    for shell in part.bodies.iter().flat_map(Body::shells) {
        for edge in &shell.edges {
            let points = &edge.curve.points;
            assert_eq!(points[0], shell.vertices[edge.start as usize], "{name}");
            assert_eq!(points[points.len() - 1], shell.vertices[edge.end as usize], "{name}");
        }
        for face in &shell.faces {
            // The loop runs head to tail.
            let ends: Vec<[u32; 2]> = face
                .boundary
                .iter()
                .map(|used| {
                    let edge = &shell.edges[used.edge as usize];
                    if used.forward { [edge.start, edge.end] } else { [edge.end, edge.start] }
                })
                .collect();
            for (k, end) in ends.iter().enumerate() {
                assert_eq!(end[1], ends[(k + 1) % ends.len()][0], "{name}");
            }
            assert_eq!(face.boundary[0].side, Side::V0, "{name}");
            for used in &face.boundary {
                let edge = &shell.edges[used.edge as usize];
                let [low, high] = edge.curve.knots.domain();
                for k in 0..=8 {
                    let t = f64::from(k) / 8.0;
                    let along = if used.forward { t } else { 1.0 - t };
                    let (u, v) =
                        face.surface.on_side(used.side, used.range[0] + t * (used.range[1] - used.range[0]));
                    let gap = face
                        .surface
                        .jet(u, v)
                        .position
                        .distance(edge.curve.point(low + along * (high - low)));
                    assert!(gap <= 1e-13 * size, "{name}: edge off its face by {gap:e}");
                }
            }
        }
    }
}

#[test]
fn golden_cages_convert() {
    for (name, document) in documents("pccm") {
        let Some(method) = document["method"].as_str() else { continue };
        let mesh = cage(&document["cage"], &serde_json::Value::Null);
        let level = document["options"]["level"].as_u64().map(|level| level as u32);
        let method = match (method, document["options"]["layer"].as_str()) {
            ("bi5", _) => Method::Bi5,
            (_, Some("first")) => Method::PccmFirst,
            _ => Method::Pccm,
        };
        for packing in [Packing::Packed, Packing::Unpacked] {
            let part = to_part(&mesh, &Options { method, level, packing, ..Options::default() }).unwrap();
            check(&name, &mesh, &part);
            let wanted = document["checks"]["max_distance_to_cc_limit"].as_f64();
            if let Some(wanted) = wanted.filter(|_| document["options"]["tangent"] == "cc_limit") {
                let ratio = part.report.max_deviation / wanted;
                println!("    deviation / reference: {ratio:.4}");
                assert!(ratio < 1.5, "{name}: {ratio}");
            }
            if packing == Packing::Unpacked {
                let wanted = document["checks"]["smooth_edges"].as_u64();
                assert!(wanted.is_none_or(|wanted| wanted == part.report.smooth_edges as u64), "{name}");
            }
        }
    }
}

#[test]
fn a_torus_is_one_face_with_two_seams() {
    let mesh = shapes::torus(6, 5);
    let part = to_part(&mesh, &Options::default()).unwrap();
    check("torus", &mesh, &part);
    let report = &part.report;
    assert_eq!((report.faces_written, report.edges, report.vertices, report.solids), (1, 2, 1, 1));
    assert!(report.max_curvature_jump < 1e-9);
}

#[test]
fn volume_and_place_are_right() {
    // An affine map of the cage maps the part: the volume by the determinant.
    let mut mesh = shapes::cube();
    let cube = to_part(&mesh, &Options::default()).unwrap().report;
    for p in &mut mesh.points {
        *p = Vec3::new(2.0 * p.x + 100.0, 3.0 * p.y + 0.5 * p.x, p.z - 7.0);
    }
    let mapped = to_part(&mesh, &Options::default()).unwrap().report;
    assert!((mapped.volume.unwrap() - 6.0 * cube.volume.unwrap()).abs() < 1e-12);
    let centre = mapped.bounding_box[0].lerp(mapped.bounding_box[1], 0.5);
    assert!(centre.distance(Vec3::new(100.0, 0.0, -7.0)) < 1e-12);
}

#[test]
fn hollows_and_directions_are_told_apart() {
    let join = |outer: &ControlMesh, inner: &ControlMesh, scale: f64, flip: bool| {
        let mut mesh = outer.clone();
        let offset = mesh.points.len() as u32;
        mesh.points.extend(inner.points.iter().map(|&p| scale * p));
        for face in inner.faces.iter() {
            let mut corners: Vec<u32> = face.iter().map(|v| v + offset).collect();
            if flip {
                corners.reverse();
            }
            mesh.faces.push(&corners);
        }
        mesh
    };
    let cube = shapes::cube();
    let volume = to_part(&cube, &Options::default()).unwrap().report.volume.unwrap();
    for flip in [true, false] {
        let part = to_part(&join(&cube, &cube, 0.25, flip), &Options::default()).unwrap();
        assert_eq!((part.report.solids, part.report.shells), (1, 2));
        assert!((part.report.volume.unwrap() - volume * (1.0 - 1.0 / 64.0)).abs() < 1e-12);
        assert!(part.report.notes.iter().any(|note| note.code == "void"));
        assert!(matches!(&part.bodies[0], Body::Solid { voids, .. } if voids.len() == 1));
    }
    let mut turned = cube.clone();
    turned.faces = cube.faces.iter().map(|face| [face[3], face[2], face[1], face[0]]).collect();
    let part = to_part(&turned, &Options::default()).unwrap();
    assert!((part.report.volume.unwrap() - volume).abs() < 1e-12);
    assert!(part.report.notes.iter().any(|note| note.code == "inside_out"));
    check("turned", &turned, &part);
    // Beside each other, not inside: two solids.
    let mut two = join(&cube, &cube, 0.25, false);
    for p in &mut two.points[8..] {
        p.x += 5.0;
    }
    assert_eq!(to_part(&two, &Options::default()).unwrap().report.solids, 2);
}

#[test]
fn holes_and_boundaries_left_out_are_no_part_of_the_surface() {
    let mut grid = shapes::grid(5, 5);
    grid.scheme.boundary = ogee::Boundary::None;
    let part = to_part(&grid, &Options::default()).unwrap();
    check("boundary none", &grid, &part);
    assert_eq!((part.report.patches, part.report.faces_written, part.report.shells), (9, 1, 1));
    assert!(!part.report.closed && part.report.volume.is_none());
    // Nothing is said of vertices that are no part of the surface.
    assert_eq!(part.report.notes, []);
    // One bicubic piece after another: exactly the middle of the plane.
    assert!((part.report.area - 9.0).abs() < 1e-12);

    let mut cube = shapes::cube();
    cube.holes = vec![2];
    let part = to_part(&cube, &Options::default()).unwrap();
    check("cube with a hole", &cube, &part);
    assert_eq!((part.report.faces_written, part.report.solids, part.report.smooth_edges), (5, 0, 8));
    // The hole takes part in smoothing: the other five faces are those of the whole cube.
    let whole = to_part(&shapes::cube(), &Options::default()).unwrap();
    assert!((part.report.area - whole.report.area * 5.0 / 6.0).abs() < 1e-10);

    cube.holes = (0..6).collect();
    assert_eq!(to_part(&cube, &Options::default()).unwrap_err().code(), "no_surface");
}

#[test]
fn two_shells_may_touch_in_a_vertex() {
    // Two opposite corners of a grid of 3 x 3 without the middle and two more: faces 0, 4 and 8 touch in vertices.
    let mut grid = shapes::grid(3, 3);
    grid.holes = vec![1, 2, 3, 5, 6, 7];
    let part = to_part(&grid, &Options { packing: Packing::Packed, ..Options::default() }).unwrap();
    check("touching sheets", &grid, &part);
    assert_eq!((part.report.shells, part.report.vertices), (3, 12));
}

#[test]
fn tags_that_leave_no_tangent_plane_are_told() {
    let mut cube = shapes::cube();
    cube.corners = vec![ogee::Corner { vertex: 0, sharpness: ogee::Sharpness::Infinite }];
    let part = to_part(&cube, &Options::default()).unwrap();
    check("cone", &cube, &part);
    assert!(part.report.notes.iter().any(|note| note.code == "cone_point"));
    assert_eq!((part.report.smooth_edges, part.report.sharp_edges), (9, 3));
}

#[test]
fn deviation_on_request_raises_the_level() {
    let mesh = shapes::cube();
    let at_once = to_part(&mesh, &Options::default()).unwrap().report;
    let wanted = at_once.max_deviation / 20.0;
    let raised =
        to_part(&mesh, &Options { max_deviation: Some(wanted), ..Options::default() }).unwrap().report;
    assert!(raised.max_deviation < wanted && raised.level > at_once.level);
    let impossible =
        to_part(&mesh, &Options { max_deviation: Some(1e-12), ..Options::default() }).unwrap_err();
    assert_eq!(impossible.code(), "deviation");
    for level in 2..=6 {
        let part = to_part(&mesh, &Options { level: Some(level), ..Options::default() }).unwrap();
        check(&format!("cube level {level}"), &mesh, &part);
    }
}

#[test]
fn what_has_no_rule_is_refused_by_name() {
    let code = |mesh: &ControlMesh, options: &Options| to_part(mesh, options).unwrap_err().code();
    let pillow = ControlMesh::new(
        shapes::cube().points[..4].to_vec(),
        [[0, 1, 3, 2], [2, 3, 1, 0]].into_iter().collect(),
    );
    assert_eq!(code(&pillow, &Options::default()), "adjacent_lens_vertices");
    let low = Options { level: Some(1), ..Options::default() };
    assert_eq!(code(&shapes::cube(), &low), "level_too_low");
    assert_eq!(code(&shapes::cube(), &Options { level: Some(7), ..Options::default() }), "level_too_high");
    let mut sharp = shapes::cube();
    let crease = ogee::Crease { vertices: [0, 1], sharpness: ogee::Sharpness::Finite(6.5) };
    sharp.creases = vec![crease];
    assert_eq!(code(&sharp, &Options::default()), "too_sharp");
    assert_eq!(code(&sharp, &Options { method: Method::Bi5, ..Options::default() }), "sharp_edge");
    assert_eq!(
        code(&shapes::grid(2, 2), &Options { method: Method::Bi5, ..Options::default() }),
        "sharp_edge"
    );
}

/// A cube refined `steps` times, scaled, faces turned inward if asked, each beginning at another corner.
fn refined_cube(steps: u32, scale: f64, inward: bool, turn: usize) -> ControlMesh {
    let cube = shapes::cube();
    let fine = ogee::Level::new(&cube).unwrap().fine_mesh(&cube.points, steps, u64::MAX).unwrap();
    let faces = fine.faces.into_iter().map(|mut face| {
        if inward {
            face.reverse();
        }
        face.rotate_left(turn);
        face
    });
    ControlMesh::new(fine.points.into_iter().map(|p| scale * p).collect(), faces.collect())
}

fn joined(a: &ControlMesh, b: &ControlMesh) -> ControlMesh {
    let mut mesh = a.clone();
    let offset = mesh.points.len() as u32;
    mesh.points.extend(&b.points);
    b.faces.iter().for_each(|face| mesh.faces.push(&face.iter().map(|v| v + offset).collect::<Vec<_>>()));
    mesh
}

#[test]
fn thin_walls_are_walls() {
    let cube = shapes::cube();
    let outer = to_part(&cube, &Options::default()).unwrap().report.volume.unwrap();
    for scale in [0.95, 0.99, 0.999] {
        for turn in 0..4 {
            let mesh = joined(&cube, &refined_cube(2, scale, true, turn));
            for packing in [Packing::Packed, Packing::Unpacked] {
                let report = to_part(&mesh, &Options { packing, ..Options::default() }).unwrap().report;
                assert_eq!((report.solids, report.shells), (1, 2), "wall {scale}, turn {turn}");
                assert!(report.volume.unwrap() < outer * 0.2, "wall {scale}, turn {turn}");
            }
        }
    }
}

#[test]
fn the_box_holds_the_surface() {
    for (name, document) in documents("pccm") {
        if document["method"].is_null() {
            continue;
        }
        let mesh = cage(&document["cage"], &serde_json::Value::Null);
        let boxes = [Packing::Packed, Packing::Unpacked].map(|packing| {
            let part = to_part(&mesh, &Options { packing, method: Method::PccmFirst, ..Options::default() })
                .unwrap();
            let [low, high] = part.report.bounding_box;
            let slack = 1e-9 * mesh.size();
            let mut reached = [
                Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
                -Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
            ];
            for face in part.bodies.iter().flat_map(Body::shells).flat_map(|shell| &shell.faces) {
                let ([u0, u1], [v0, v1]) = (face.surface.u.domain(), face.surface.v.domain());
                for i in 0..=60 {
                    for j in 0..=60 {
                        let (s, t) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
                        let p = face.surface.jet(u0 + s * (u1 - u0), v0 + t * (v1 - v0)).position;
                        reached = [reached[0].min(p), reached[1].max(p)];
                        assert!(
                            (0..3).all(|k| low[k] - slack <= p[k] && p[k] <= high[k] + slack),
                            "{name}: {p:?}"
                        );
                    }
                }
            }
            // Not too large either: samples come close.
            assert!(reached[0].distance(low) + reached[1].distance(high) < 1e-2 * mesh.size(), "{name}");
            [low, high]
        });
        assert!(
            boxes[0][0].distance(boxes[1][0]) + boxes[0][1].distance(boxes[1][1]) < 1e-7 * mesh.size(),
            "{name}"
        );
    }
}

#[test]
fn curvature_jumps_are_seen_on_every_level() {
    let (_, document) =
        documents("pccm").into_iter().find(|(name, _)| name == "cube_skew_second_l3").unwrap();
    let mesh = cage(&document["cage"], &serde_json::Value::Null);
    for method in [Method::Pccm, Method::PccmFirst] {
        for level in 2..=6 {
            let report =
                to_part(&mesh, &Options { method, level: Some(level), ..Options::default() }).unwrap().report;
            println!("{method:?} level {level}: jump {:.3}", report.max_curvature_jump);
            // The construction is tangent-continuous and no more: a skew corner of three faces shows it.
            assert!(
                report.max_curvature_jump > 0.05,
                "{method:?} level {level}: {}",
                report.max_curvature_jump
            );
        }
    }
}

#[test]
fn figures_are_those_of_what_is_written() {
    let mut far = shapes::studded_torus(12, 12, 6);
    far.points.iter_mut().for_each(|p| *p += Vec3::new(1e9, 0.0, 0.0));
    let report = to_part(&far, &Options::default()).unwrap().report;
    // Coordinates of 1e9 are good to 1e-7.
    assert!(report.max_normal_angle_deg > 1e-8, "{}", report.max_normal_angle_deg);
    let mut flat = shapes::cube();
    flat.points.iter_mut().for_each(|p| p.z = 0.0);
    let report = to_part(&flat, &Options::default()).unwrap().report;
    assert!(report.notes.iter().any(|note| note.code == "no_volume"));
}

#[test]
fn refined_quintics_are_named_by_corner() {
    let part =
        to_part(&shapes::cube(), &Options { method: Method::Bi5, level: Some(1), ..Options::default() })
            .unwrap();
    let mut names: Vec<String> = part
        .bodies
        .iter()
        .flat_map(Body::shells)
        .flat_map(|shell| &shell.faces)
        .map(|face| face.address().to_string())
        .collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 24);
}
