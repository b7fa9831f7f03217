//! What evaluation says at vertices and close to them: limits, tangent planes, rates, flags.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{at_corner, creased, disk, faces_at, fan, sharp_at, spokes, turned};
use ogee::{
    Boundary, ControlMesh, FaceId, Flags, Level, LimitJet, LimitSurface, PatchTable, Vec3, VertexId,
    limit_vertices, shapes,
};

/// Evaluates around vertex 0: all its faces, from its corner.
struct Around<'a> {
    level: &'a Level,
    table: &'a PatchTable,
    surface: LimitSurface<'a>,
    faces: Vec<(FaceId, u32)>,
}

impl Around<'_> {
    fn jet(&self, face: usize, x: f64, y: f64) -> LimitJet {
        let (face, corner) = self.faces[face];
        let mut point = self.surface.jet(at_corner(self.level, self.table, face, corner, x, y));
        point.jet = turned(&point.jet, corner);
        point
    }

    fn all(&self) -> Vec<LimitJet> {
        (0..self.faces.len()).map(|face| self.jet(face, 0.0, 0.0)).collect()
    }
}

fn around<R>(mesh: &ControlMesh, vertex: u32, then: impl FnOnce(&Around) -> R) -> R {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let faces = faces_at(&level, VertexId(vertex));
    then(&Around { level: &level, table: &table, surface, faces })
}

fn degrees(a: Vec3, b: Vec3) -> f64 {
    assert!(a.length() > 0.0 && b.length() > 0.0, "nothing to measure");
    a.angle(b).to_degrees()
}

fn lambda(angle: f64) -> f64 {
    let c = angle.cos();
    (5.0 + c + ((c + 9.0) * (c + 1.0)).sqrt()) / 16.0
}

#[test]
fn normals_near_a_smooth_vertex_tend_to_the_mask() {
    for (n, depth, most) in [(3, 25, 1e-4), (5, 25, 1e-4), (6, 40, 1e-3), (8, 60, 1e-2)] {
        around(&disk(n), 0, |around| {
            let wanted = around.jet(0, 0.0, 0.0).normal;
            let x = 0.5f64.powi(depth);
            for face in 0..around.faces.len() {
                let gap = degrees(around.jet(face, x, x).normal, wanted);
                println!("valence {n}, {depth} down: {gap:e} degrees");
                // Beside corners other than the first the parameter is rounded to 1.
                assert!(gap <= most, "valence {n}: {gap:e} degrees");
            }
        });
    }
}

#[test]
fn tangents_at_a_vertex_point_along_its_edges() {
    for n in [3, 5, 6, 9] {
        around(&disk(n), 0, |around| {
            let at = around.jet(0, 0.0, 0.0).jet;
            let x = 0.5f64.powi(24);
            let near = around.jet(0, x, 0.0).jet.position - at.position;
            // The plane is exact, directions in it converge more slowly than the normal.
            let angle = degrees(near, at.du);
            let across = around.jet(0, 0.0, x).jet.position - at.position;
            println!("valence {n}: {angle:e} {:e}", degrees(across, at.dv));
            assert!(at.du.cross(at.dv).dot(near.cross(across)) > 0.0, "valence {n}");
        });
    }
}

#[test]
fn derivatives_grow_by_twice_the_eigenvalue() {
    for n in 3..=8 {
        around(&disk(n), 0, |around| {
            for (x, y) in [(0.9, 0.35), (0.6, 0.6), (1.0, 0.0)] {
                let at = |depth: i32| {
                    let size = 0.5f64.powi(depth);
                    around.jet(0, x * size, y * size).jet
                };
                let wanted = 2.0 * lambda(std::f64::consts::TAU / f64::from(n));
                // Among the steps, from the last to what lies below, and far below.
                for depth in [19, 62, 63, 64, 200] {
                    let [a, b] = [at(depth), at(depth + 1)];
                    for ratio in [b.du.length() / a.du.length(), b.dv.length() / a.dv.length()] {
                        let gap = (ratio / wanted - 1.0).abs();
                        assert!(gap <= 1e-3, "valence {n}, {depth} down: {ratio}, not {wanted}");
                    }
                }
            }
        });
    }
}

#[test]
fn normals_near_a_concave_boundary_tend_to_the_mask() {
    around(&cages::l_shape(), 12, |around| {
        assert_eq!(around.faces.len(), 3);
        let x = 0.5f64.powi(28);
        for face in 0..3 {
            let at = around.jet(face, 0.0, 0.0);
            assert!(!at.flags.contains(Flags::NORMAL_ONE_SIDED), "{:?}", at.flags);
            let gap = degrees(around.jet(face, x, x).normal, at.normal);
            println!("three faces on a boundary, {face}: {gap:e} degrees");
            assert!(gap <= 1e-2, "{gap:e}");
        }
    });
}

/// The crease's tangent, the B-spline's across: two faces on each side.
#[test]
fn two_faces_at_a_crease_are_regular() {
    around(&creased(disk(4), &spokes(&[0, 2], 2), 10.0), 0, |around| {
        for point in around.all() {
            assert_eq!(point.flags, Flags::NONE);
        }
        let [a, b] = [around.jet(0, 0.0, 0.0), around.jet(1, 0.0, 0.0)];
        assert!((a.normal.length() - 1.0).abs() < 1e-12);
        assert!(a.normal.distance(b.normal) < 1e-12);
        let x = 1e-9;
        assert!(a.normal.distance(around.jet(0, x, x).normal) < 1e-7);
    });
}

#[test]
fn positions_at_vertices_are_their_limits() {
    for (name, mesh) in cages::all() {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        for (v, limit) in limit_vertices(&level, &mesh.points).iter().enumerate() {
            for (face, corner) in faces_at(&level, VertexId(v as u32)) {
                let point = surface.eval(at_corner(&level, &table, face, corner, 0.0, 0.0));
                let gap = point.position.distance(limit.position) / mesh.size();
                assert!(gap <= 1e-14, "{name} vertex {v}: {gap:e}");
            }
        }
    }
}

/// The mask of a smooth vertex is wrong at a dart; refinement tells the truth.
#[test]
fn a_dart_ends_where_refinement_takes_it() {
    for n in [3, 4, 5, 7] {
        let smooth = disk(n);
        let dart = creased(smooth.clone(), &spokes(&[1], 2), 10.0);
        let mut here = (Level::new(&dart).unwrap(), dart.points.clone());
        // Few faces are needed, but refining all of them four times is quick enough.
        for _ in 0..4 {
            here = here.0.refine_points(&here.1);
        }
        let wanted = limit_vertices(&here.0, &here.1)[0].position;
        around(&dart, 0, |around| {
            for point in around.all() {
                assert!(point.jet.position.distance(wanted) <= 1e-12);
                assert!(point.normal.is_finite() && (point.normal.length() - 1.0).abs() < 1e-12);
            }
            let by_mask = limit_vertices(around.level, &smooth.points)[0].position;
            let by_smooth_mask = limit_vertices(&Level::new(&smooth).unwrap(), &smooth.points)[0].position;
            println!("dart at valence {n}: smooth mask is off by {:e}", by_smooth_mask.distance(wanted));
            assert!(by_mask.distance(wanted) <= 1e-12 && by_smooth_mask.distance(wanted) > 1e-4);
        });
    }
}

/// All faces at a dart have one tangent plane, and the surface comes to it.
#[test]
fn a_dart_has_one_normal() {
    for n in [3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 50] {
        let mesh = creased(disk(n), &spokes(&[1], 2), 10.0);
        let limit = limit_vertices(&Level::new(&mesh).unwrap(), &mesh.points)[0];
        around(&mesh, 0, |around| {
            let wanted = limit.normal.unwrap();
            let mut largest = [0.0_f64; 5];
            for (face, at) in around.all().iter().enumerate() {
                let expected = Flags::AT_EXTRAORDINARY.with(Flags::UNBOUNDED_CURVATURE);
                assert_eq!(at.flags, expected, "valence {n}");
                let gaps = [20, 25, 30, 60].map(|depth| {
                    let x = 0.5f64.powi(depth);
                    degrees(around.jet(face, x, x).normal, at.normal)
                });
                largest[0] = largest[0].max(degrees(at.normal, wanted));
                for (largest, gap) in largest[1..].iter_mut().zip(gaps) {
                    *largest = largest.max(gap);
                }
            }
            println!("dart at valence {n}: {largest:?} degrees");
            let [same, gaps @ ..] = largest;
            assert!(same <= 1e-12, "valence {n}: {same:e}");
            // It comes as slowly as the third eigenvalue is close to the second.
            let limits = match n {
                3 => [1e-3, 1e-4, 1e-5, 1e-9],
                4 => [1e-2, 1e-3, 1e-4, 1e-9],
                5..=8 => [5.0, 5.0, 1.0, 1e-2],
                9..=12 => [20.0, 20.0, 10.0, 2.0],
                20 => [40.0, 30.0, 20.0, 5.0],
                // At 50 it shrinks by 0.997 a step.
                _ => [180.0, 180.0, 180.0, 60.0],
            };
            for (gap, most) in gaps.into_iter().zip(limits) {
                assert!(gap <= most, "valence {n}: {largest:?}");
            }
        });
    }
}

/// A boundary vertex with one face that is no corner: tangents become parallel, and the normal is there all the same.
#[test]
fn a_smooth_corner_of_the_boundary_has_normals_at_every_depth() {
    let mesh = cages::shaken(cages::with_boundary(cages::grid(2, 2), Boundary::EdgeOnly), 0.25);
    around(&mesh, 0, |around| {
        let at = around.jet(0, 0.0, 0.0);
        // Among the steps, from the last to what lies below, and far below.
        for depth in [16, 30, 34, 35, 36, 37, 40, 60, 200] {
            let x = 0.5f64.powi(depth);
            for (x, y) in [(x, x), (x, 0.0), (0.3 * x, x)] {
                let [point, next] = [around.jet(0, x, y), around.jet(0, x / 2.0, y / 2.0)];
                assert!(!point.flags.contains(Flags::NORMAL_UNDEFINED), "{depth} down");
                // As slowly as one over the step.
                let gap = degrees(point.normal, at.normal);
                assert!(gap <= 25.0 / f64::from(depth.min(36)), "{depth} down: {gap:e} degrees");
                if depth < 30 {
                    continue;
                }
                let (a, b) = (point.jet, next.jet);
                for (a, b, most) in [(a.du, b.du, 1e-7), (a.dv, b.dv, 1e-7), (a.duu, b.duu, 1e-3)] {
                    let gap = a.distance(b) / a.length();
                    assert!(gap <= most, "{depth} down: {gap:e}");
                }
            }
        }
    });
}

#[test]
fn flags_tell_what_kind_of_vertex_it_is() {
    let extraordinary = Flags::AT_EXTRAORDINARY;
    let at = |mesh: &ControlMesh, vertex: u32, face: usize| {
        around(mesh, vertex, |around| around.jet(face, 0.0, 0.0).flags)
    };
    assert_eq!(at(&disk(4), 0, 0), Flags::NONE);
    assert_eq!(at(&cages::grid(3, 3), 1, 0), Flags::NONE);
    assert_eq!(at(&cages::grid(3, 3), 0, 0), Flags::NONE, "a kept corner of one face is a bicubic");
    for n in [3, 5, 6, 7, 8, 12, 20, 50] {
        let flags = at(&disk(n), 0, 0);
        assert!(flags.contains(extraordinary), "{n}: {flags:?}");
        assert_eq!(flags.contains(Flags::UNBOUNDED_CURVATURE), n >= 5, "{n}: {flags:?}");
        for other in [Flags::NORMAL_ONE_SIDED, Flags::BEYOND_NMAX, Flags::NORMAL_UNDEFINED] {
            assert!(!flags.contains(other), "{n}: {flags:?}");
        }
        // Only the vertex itself.
        around(&disk(n), 0, |around| assert_eq!(around.jet(0, 1e-12, 1e-12).flags, Flags::NONE));
    }
    // Corners with sectors of one, two, three and four faces, one after the other.
    let corner = creased(disk(10), &spokes(&[0, 1, 3, 6], 2), 10.0);
    around(&corner, 0, |around| {
        for (face, point) in around.all().iter().enumerate() {
            let (_, from) = around.faces[face];
            assert_eq!(from, 0);
            let sector = [1, 2, 2, 3, 3, 3, 4, 4, 4, 4][around.faces[face].0.index() / 4];
            match sector {
                1 => assert_eq!(point.flags, Flags::NONE),
                2 => assert!(!point.flags.contains(Flags::NORMAL_ONE_SIDED), "{:?}", point.flags),
                _ => assert!(point.flags.contains(Flags::NORMAL_ONE_SIDED), "{sector}: {:?}", point.flags),
            }
            assert!(point.jet.position.distance(corner.points[0]) <= 1e-15);
        }
    });
    // Creases and boundaries: three faces have a tangent plane, four have none.
    for k in [3, 4, 5] {
        let crease = creased(disk(2 * k), &spokes(&[0, k], 2), 10.0);
        for mesh in [crease, fan(k)] {
            let flags = at(&mesh, 0, 0);
            assert!(flags.contains(extraordinary), "{k}: {flags:?}");
            assert_eq!(flags.contains(Flags::NORMAL_ONE_SIDED), k >= 4, "{k}: {flags:?}");
        }
    }
    let smooth_corner = cages::with_boundary(cages::grid(2, 2), Boundary::EdgeOnly);
    assert!(at(&smooth_corner, 0, 0).contains(extraordinary));
    // A cone has no tangent plane.
    assert!(at(&sharp_at(disk(5), &[0], 10.0), 0, 0).contains(Flags::NORMAL_ONE_SIDED));
}

/// Two faces at a corner: their plane, by the mask.
#[test]
fn two_faces_at_a_corner_have_the_plane_of_their_creases() {
    let mesh = creased(disk(7), &spokes(&[0, 2, 4], 2), 10.0);
    around(&mesh, 0, |around| {
        for face in 0..around.faces.len() {
            let number = around.faces[face].0.index() / 4;
            if number >= 4 {
                continue;
            }
            let spoke = |k: usize| mesh.points[1 + 6 * k] - mesh.points[0];
            let first = number / 2 * 2;
            let wanted = spoke(first).cross(spoke(first + 2)).normalized().unwrap();
            let point = around.jet(face, 0.0, 0.0);
            let gap = point.normal.distance(wanted);
            assert!(gap <= 1e-12, "{number}: {gap:e}");
        }
    });
}

#[test]
fn beyond_the_last_tile_nothing_breaks() {
    let mut cases: Vec<(String, ControlMesh)> =
        [3, 5, 6, 8, 12, 20].map(|n| (format!("disk {n}"), disk(n))).to_vec();
    cases.push(("dart".into(), creased(disk(5), &spokes(&[1], 2), 10.0)));
    cases.push(("crease".into(), creased(disk(7), &spokes(&[0, 3], 2), 10.0)));
    cases.push(("corner".into(), creased(disk(7), &spokes(&[0, 2, 5], 2), 10.0)));
    cases.push(("cone".into(), sharp_at(disk(5), &[0], 10.0)));
    cases.push(("boundary".into(), fan(3)));
    for (name, mesh) in cases {
        around(&mesh, 0, |around| {
            for face in 0..around.faces.len() {
                let at = around.jet(face, 0.0, 0.0);
                for (x, y) in
                    [(1e-25, 1e-25), (0.0, 1e-30), (1e-200, 1e-201), (f64::MIN_POSITIVE, 0.0), (5e-324, 0.0)]
                {
                    let point = around.jet(face, x, y);
                    let gap = point.jet.position.distance(at.jet.position) / mesh.size();
                    // A sector of one face, and one of two at a crease, is a bicubic with no tiles at all.
                    if at.flags != Flags::NONE && x.max(y) < 1e-150 {
                        let flagged = point.flags.contains(Flags::BEYOND_NMAX);
                        assert!(flagged, "{name} {face} ({x}, {y}): {:?}", point.flags);
                    }
                    assert!(gap <= 1e-15, "{name} {face} ({x}, {y}): {gap:e}");
                    let length = point.normal.length();
                    assert!((length - 1.0).abs() < 1e-12, "{name} {face} ({x}, {y}): {:?}", point.normal);
                }
            }
        });
    }
}

/// Where all points are one, and where all lie on a line.
#[test]
fn where_tangents_are_parallel_there_is_no_normal() {
    // The second line is one to rounding only.
    let crushed: [fn(Vec3) -> Vec3; 3] =
        [|_| Vec3::ZERO, |p| Vec3::new(p.x, 2.0 * p.x, 0.0), |p| p.x * Vec3::new(0.3, 0.7, -1.1)];
    let creased = creased(disk(6), &spokes(&[0, 1, 3], 2), 10.0);
    for mesh in [disk(5), disk(4), cages::pyramid(), fan(3), creased] {
        for crush in crushed {
            let points = mesh.points.iter().map(|&p| crush(p)).collect();
            around(&ControlMesh { points, ..mesh.clone() }, 0, |around| {
                let places = [(0, (0.0, 0.0)), (0, (0.3, 0.4)), (1, (1e-25, 1e-25)), (1, (1.0, 1.0))];
                for (face, (x, y)) in places {
                    let point = around.jet(face, x, y);
                    assert!(point.flags.contains(Flags::NORMAL_UNDEFINED), "({x}, {y}): {:?}", point.flags);
                    assert_eq!(point.normal, Vec3::ZERO);
                }
            });
        }
    }
}

/// Two sharp edges in line span no plane, but the surface beside them has one.
#[test]
fn a_corner_on_a_straight_side_has_its_normal() {
    let mut mesh = sharp_at(shapes::grid(2, 2), &[1], 10.0);
    for p in &mut mesh.points {
        p.z = 0.0;
    }
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    for (face, corner) in faces_at(&level, VertexId(1)) {
        let point = surface.eval(at_corner(&level, &table, face, corner, 0.0, 0.0));
        assert!(point.flags.contains(Flags::AT_EXTRAORDINARY));
        assert!(point.normal.distance(Vec3::new(0.0, 0.0, 1.0)) < 1e-12, "{face}: {point:?}");
    }
}

/// The zeros that stand for derivatives at an extraordinary vertex are no flat surface.
#[test]
fn there_is_no_curvature_at_an_extraordinary_vertex() {
    let mesh = shapes::cube();
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let surface = LimitSurface::new(&table, &mesh.points);
    let vertex = table.locate(FaceId(0), None, 0.0, 0.0).unwrap();
    let at_vertex = surface.jet(vertex);
    assert!(at_vertex.curvature().is_none() && at_vertex.normal_derivatives().is_none());
    let beside = surface.jet(vertex.at(0.1, 0.2).unwrap());
    assert_eq!(beside.curvature(), beside.jet.curvature());
    assert!(beside.curvature().is_some() && beside.normal_derivatives().is_some());
}
