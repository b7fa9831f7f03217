//! The surface of a cage with caps in it is evaluated at the cage's own addresses: the caps where they stand, the limit surface
//! elsewhere, and C2 where they meet.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod lens_cages;

use lens_cages::{globe, pouch, with_doublets};
use ogee::lens::{Cap, Method, Options, PolarFaces, PolarVariant, Treated, TreatedSurface, treat};
use ogee::nurbs::FaceAddress;
use ogee::quality::{LimitView, Surface};
use ogee::{
    ControlMesh, Derivatives, Evaluator, FaceId, FaceList, Flags, Level, LimitJet, LimitSurface, Location,
    PatchTable, Samples, SurfaceJet, Vec3, shapes,
};

/// A cage under a treatment, and how often that refines it.
struct Case {
    name: &'static str,
    mesh: ControlMesh,
    method: Method,
    steps: u32,
}

fn cases() -> Vec<Case> {
    let case = |name, mesh, method, steps| Case { name, mesh, method, steps };
    vec![
        case("wing, c2", shapes::lens(), Method::C2, 0),
        case("wing, degree-raise", shapes::lens(), Method::DegreeRaise, 0),
        case("wing, polar", shapes::lens(), Method::Polar, 0),
        case("pouch, c2", pouch(4, 8), Method::C2, 0),
        case("short pouch, c2", pouch(2, 6), Method::C2, 1),
        case("odd pouch, polar", pouch(5, 9), Method::Polar, 0),
        case("globe", globe(8, 7), Method::Polar, 0),
        case("globe of three", globe(3, 4), Method::Polar, 0),
        case("torus with doublets", with_doublets(&shapes::torus(8, 6), 11), Method::C2, 2),
    ]
}

fn options(method: Method) -> Options {
    Options { method, ..Options::default() }
}

/// The surface of a cage after a treatment.
fn with_surface<T>(
    mesh: &ControlMesh,
    options: &Options,
    look: impl FnOnce(&TreatedSurface<'_>, &Treated, &Level) -> T,
) -> T {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let limit = LimitSurface::new(&table, &mesh.points);
    let treated = treat(mesh, options).unwrap();
    let surface = TreatedSurface::new(&limit, &treated).unwrap();
    look(&surface, &treated, &level)
}

fn size(mesh: &ControlMesh) -> f64 {
    let box_of = |pick: fn(Vec3, Vec3) -> Vec3| mesh.points.iter().copied().reduce(pick).unwrap();
    box_of(Vec3::max).distance(box_of(Vec3::min))
}

/// Every place of a grid on every face.
fn grid(table: &PatchTable, cells: u32) -> Vec<Location> {
    let mut places = Vec::new();
    for number in 0..table.len() {
        let face = table.parametric_face(number);
        for i in 0..=cells {
            for j in 0..=cells {
                let [u, v] = [i, j].map(|i| f64::from(i) / f64::from(cells));
                places.push(table.locate(face.face, face.corner, u, v).unwrap());
            }
        }
    }
    places
}

fn parts(jet: &SurfaceJet) -> [Vec3; 6] {
    [jet.position, jet.du, jet.dv, jet.duu, jet.duv, jet.dvv]
}

fn farthest(a: [Vec3; 6], b: [Vec3; 6]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| a.distance(b)).fold(0.0, f64::max)
}

/// A jet in the frame that is turned `quarters` times to the left.
fn turned(jet: &SurfaceJet, quarters: u32) -> SurfaceJet {
    (0..quarters).fold(*jet, |jet, _| SurfaceJet {
        position: jet.position,
        du: jet.dv,
        dv: -jet.du,
        duu: jet.dvv,
        duv: -jet.duv,
        dvv: jet.duu,
    })
}

/// Where `(s, t)` of a square is that begins at a corner of the unit square.
fn seen_from(corner: u32, [s, t]: [f64; 2]) -> [f64; 2] {
    match corner {
        0 => [s, t],
        1 => [1.0 - t, s],
        2 => [1.0 - s, 1.0 - t],
        _ => [t, 1.0 - s],
    }
}

#[test]
fn outside_the_caps_it_is_the_limit_surface_to_the_bit() {
    for Case { name, mesh, method, steps } in cases() {
        with_surface(&mesh, &options(method), |surface, treated, _| {
            assert_eq!(treated.steps, steps, "{name}");
            let places = grid(surface.table(), 8);
            let (on_caps, outside): (Vec<_>, Vec<_>) =
                places.into_iter().partition(|&at| surface.is_on_cap(at));
            assert!(!on_caps.is_empty() && !outside.is_empty(), "{name}");
            for at in outside {
                assert_eq!(surface.jet(at), surface.limit().jet(at), "{name}, {at:?}");
            }
        });
    }
}

#[test]
fn every_point_of_a_grid_has_a_position_and_a_normal() {
    for Case { name, mesh, method, .. } in cases() {
        with_surface(&mesh, &options(method), |surface, treated, _| {
            let places = grid(surface.table(), 16);
            let mut samples = Samples::default();
            surface.eval_into(&places, Derivatives::Second, &mut samples);
            for (i, &at) in places.iter().enumerate() {
                let LimitJet { jet, normal, flags } = surface.jet(at);
                let found = [
                    samples.position[i],
                    samples.du[i],
                    samples.dv[i],
                    samples.duu[i],
                    samples.duv[i],
                    samples.dvv[i],
                ];
                assert_eq!(found, parts(&jet), "{name}");
                assert_eq!((samples.normal[i], samples.flags[i]), (normal, flags), "{name}");
                assert!(parts(&jet).iter().all(|part| part.is_finite()), "{name}, {at:?}: {jet:?}");
                assert!((normal.length() - 1.0).abs() < 1e-12, "{name}, {at:?}");
                assert!(!flags.contains(Flags::UNBOUNDED_CURVATURE) || !surface.is_on_cap(at), "{name}");
                assert!(surface.curvature(at).is_some() || !surface.is_on_cap(at), "{name}, {at:?}");
            }
            // What was left as it is would be told.
            assert!(treated.lenses.iter().all(|lens| lens.method == method), "{name}");
        });
    }
}

#[test]
fn fewer_derivatives_are_the_same_points() {
    with_surface(&globe(8, 7), &options(Method::Polar), |surface, _, _| {
        let places = grid(surface.table(), 4);
        let [mut none, mut first, mut second] = [Samples::default(), Samples::default(), Samples::default()];
        surface.eval_into(&places, Derivatives::None, &mut none);
        surface.eval_into(&places, Derivatives::First, &mut first);
        surface.eval_into(&places, Derivatives::Second, &mut second);
        assert!(none.du.is_empty() && first.duu.is_empty());
        assert_eq!((&none.position, &first.position), (&second.position, &second.position));
        assert_eq!((&first.du, &first.normal), (&second.du, &second.normal));
    });
}

#[test]
fn joints_are_curvature_continuous() {
    for Case { name, mesh, method, .. } in cases() {
        let size = size(&mesh);
        with_surface(&mesh, &options(method), |surface, _, level| {
            let view = LimitView::new(level, surface);
            let layout = view.layout();
            let mut worst = 0.0_f64;
            let mut compared = 0;
            for joint in layout.joints() {
                for x in [0.0, 0.125, 0.4, 0.75, 1.0] {
                    let [(first, a), (second, b)] = [(0, x), (1, 1.0 - x)].map(|(k, x)| {
                        let side = joint.sides[k];
                        let square = &layout.squares()[side.square as usize];
                        let at = square.on_side(side.side, x);
                        let jet = surface.jet(at);
                        // Along the side, and into the square.
                        (turned(&jet.jet, side.side), (at, jet))
                    });
                    if ![a.0, b.0].iter().any(|&at| surface.is_on_cap(at)) {
                        continue;
                    }
                    let gap = first.position.distance(second.position);
                    assert!(gap < 1e-12 * size, "{name}, {joint:?} at {x}: {gap}");
                    assert!(a.1.normal.distance(b.1.normal) < 1e-11, "{name}, {joint:?} at {x}");
                    let is_special = [a.1, b.1].iter().any(|jet| jet.flags != Flags::NONE);
                    let is_quad = |at: Location| {
                        let face = surface.table().parametric_face(at.parametric_face());
                        face.corner.is_none()
                    };
                    if is_special {
                        continue;
                    }
                    if is_quad(a.0) && is_quad(b.0) {
                        // Across, both directions change their signs.
                        let [p, du, dv, duu, duv, dvv] = parts(&second);
                        worst = worst.max(farthest(parts(&first), [p, -du, -dv, duu, duv, dvv]));
                        compared += 1;
                    }
                    let [k, l] = [a.0, b.0].map(|at| surface.curvature(at).unwrap());
                    let bend = 1.0 + size * k.k1.abs().max(k.k2.abs());
                    assert!(
                        size * (k.k1 - l.k1).abs() < 1e-9 * bend,
                        "{name}, {joint:?} at {x}: {k:?} {l:?}"
                    );
                    assert!(
                        size * (k.k2 - l.k2).abs() < 1e-9 * bend,
                        "{name}, {joint:?} at {x}: {k:?} {l:?}"
                    );
                }
            }
            assert!(compared > 10, "{name}: {compared}");
            assert!(worst < 1e-12 * size, "{name}: {worst}");
        });
    }
}

#[test]
fn pieces_of_a_face_meet_to_second_order() {
    for Case { name, mesh, method, .. } in cases() {
        let size = size(&mesh);
        with_surface(&mesh, &options(method), |surface, _, _| {
            let quads = mesh.faces.iter().enumerate().filter(|(_, corners)| corners.len() == 4);
            for face in quads.map(|(number, _)| FaceId(number as u32)) {
                // Where a face is in pieces, they are eighths, quarters or halves.
                for u in (1..8).map(|i| f64::from(i) / 8.0) {
                    let before = f64::from_bits(u.to_bits() - 1);
                    for v in (0..=20).map(|j| f64::from(j) / 20.0) {
                        let jet = |u: f64, v: f64| {
                            surface.jet(surface.table().locate(face, None, u, v).unwrap()).jet
                        };
                        for [a, b] in [[jet(before, v), jet(u, v)], [jet(v, before), jet(v, u)]] {
                            let gap = farthest(parts(&a), parts(&b));
                            assert!(gap < 1e-12 * size, "{name}, face {face} at {u}, {v}: {gap}");
                        }
                    }
                }
            }
        });
    }
}

/// The places in a face of the cage that a place in a face of a cap may be, which has a frame of its own.
fn candidates(table: &PatchTable, at: FaceAddress, inside: [f64; 2]) -> Vec<Location> {
    let FaceAddress { face, corner, .. } = at;
    let is_whole = table.locate(face, None, 0.0, 0.0).is_ok();
    (0..4)
        .map(|frame| {
            let [u, v] = seen_from(frame, inside);
            // Of a quad with a corner the piece is a quarter.
            let (corner, [u, v]) = match (is_whole, corner) {
                (true, Some(k)) => (None, seen_from(k, [u / 2.0, v / 2.0])),
                (_, corner) => (corner, [u, v]),
            };
            table.locate(face, corner, u, v).unwrap()
        })
        .collect()
}

/// The largest distance between points of a cap and of the surface, in the frame that fits best.
fn misfit(surface: &TreatedSurface<'_>, piece: FaceAddress, points: &[([f64; 2], Vec3)]) -> f64 {
    let gaps = points.iter().map(|&(inside, point)| {
        let places = candidates(surface.table(), piece, inside).into_iter();
        places.map(|at| surface.jet(at).jet.position.distance(point)).collect::<Vec<_>>()
    });
    let most = gaps.fold([0.0_f64; 4], |most, gaps| std::array::from_fn(|k| most[k].max(gaps[k])));
    most.into_iter().fold(f64::INFINITY, f64::min)
}

const PLACES: [[f64; 2]; 5] = [[0.0, 0.0], [0.25, 0.125], [0.9, 0.3], [0.4, 1.0], [0.7, 0.8]];

#[test]
fn polar_caps_are_the_faces_that_are_exported() {
    for (name, mesh) in [("wing", shapes::lens()), ("pouch", pouch(5, 9)), ("globe", globe(7, 5))] {
        for faces in [PolarFaces::PerSector, PolarFaces::Halves] {
            for variant in [PolarVariant::SixFive, PolarVariant::FiveFive, PolarVariant::SixSix] {
                let options = Options { faces, variant, ..options(Method::Polar) };
                with_surface(&mesh, &options, |surface, treated, _| {
                    let size = size(&mesh);
                    assert_eq!(treated.caps.len(), 2);
                    for face in treated.caps.iter().flat_map(|cap| &cap.faces) {
                        let (pieces, [r0, r1], [a0, _]) =
                            (&face.pieces, face.surface.u.domain(), face.surface.v.domain());
                        for row in 0..pieces.rows() {
                            for column in 0..pieces.cols() {
                                let piece = pieces[(row, column)];
                                if surface.table().locate(piece.face, piece.corner, 0.0, 0.0).is_err() {
                                    // Triangles have places of their own.
                                    continue;
                                }
                                let width = (r1 - r0) / pieces.rows() as f64;
                                let point = |[s, t]: [f64; 2]| {
                                    let radius = r0 + (row as f64 + s) * width;
                                    let jet = face.surface.jet(radius, a0 + column as f64 + t);
                                    ([s, t], jet.position)
                                };
                                let gap = misfit(surface, piece, &PLACES.map(point));
                                assert!(gap < 1e-13 * size, "{name}, {faces:?}, {variant:?}: {gap:e}");
                            }
                        }
                    }
                });
            }
        }
    }
}

#[test]
fn fans_are_radius_and_direction_in_barycentric_coordinates() {
    let mesh = globe(7, 5);
    with_surface(&mesh, &options(Method::Polar), |surface, treated, level| {
        let topology = level.topology();
        for cap in &treated.caps {
            let half = &cap.faces[0];
            let pole = half.surface.jet(0.0, 0.0).position;
            for column in 0..half.pieces.cols() {
                let face = half.pieces[(0, column)].face;
                // The corner at the pole is 0 in both fans.
                let corners = topology.halfedges(face).map(|h| topology.origin(h)).collect::<Vec<_>>();
                assert!(corners[0].0 < 2);
                for corner in 0..3_u32 {
                    for [u, v] in [[0.0, 0.0], [0.5, 0.25], [1.0, 0.0], [0.3, 0.9], [1.0, 1.0]] {
                        let mut shares = [0.0; 3];
                        let middle = u * v / 3.0;
                        shares[corner as usize] =
                            (1.0 - u) * (1.0 - v) + (u * (1.0 - v) + v * (1.0 - u)) / 2.0 + middle;
                        shares[(corner as usize + 1) % 3] = u * (1.0 - v) / 2.0 + middle;
                        shares[(corner as usize + 2) % 3] = v * (1.0 - u) / 2.0 + middle;
                        let radius = shares[1] + shares[2];
                        let around = if radius > 0.0 { shares[2] / radius } else { 0.0 };
                        let at = surface.table().locate(face, Some(corner), u, v).unwrap();
                        let expected = half.surface.jet(radius, column as f64 + around).position;
                        let found = surface.jet(at);
                        assert!(found.jet.position.distance(expected) < 1e-13, "{at:?}");
                        if radius == 0.0 {
                            assert!(found.flags.contains(Flags::AT_EXTRAORDINARY));
                            assert!(found.jet.position.distance(pole) < 1e-15);
                        }
                    }
                }
            }
        }
    });
}

/// Rings of a cap, in the order of its faces.
fn ring_faces(cap: &Cap) -> impl Iterator<Item = (usize, usize, &ogee::lens::CapFace)> {
    let rings = (cap.faces.len() - 2) / 6;
    cap.faces[..6 * rings].iter().enumerate().map(|(k, face)| (k / 6, k % 3, face))
}

#[test]
fn rings_are_the_faces_that_are_exported() {
    for Case { name, mesh, method, steps } in cases() {
        if method == Method::Polar || steps > 1 {
            continue;
        }
        let size = size(&mesh);
        with_surface(&mesh, &options(method), |surface, treated, _| {
            for cap in &treated.caps {
                for (ring, cell, face) in ring_faces(cap) {
                    let [a, b] = [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][cell];
                    let point = |[s, t]: [f64; 2]| {
                        let position = face.surface.jet(s, t).position;
                        let scale = 0.5_f64.powi(ring as i32);
                        let inside = if ring == 0 { [s, t] } else { [scale * (a + s), scale * (b + t)] };
                        (inside, position)
                    };
                    let gap = misfit(surface, face.pieces[(0, 0)], &PLACES.map(point));
                    assert!(gap < 1e-13 * size, "{name}, ring {ring}: {gap:e}");
                }
                for face in &cap.faces[cap.faces.len() - 2..] {
                    let scale = 0.5_f64.powi((cap.faces.len() as i32 - 2) / 6 - 1);
                    let point = |[s, t]: [f64; 2]| ([scale * s, scale * t], face.surface.jet(s, t).position);
                    let gap = misfit(surface, face.pieces[(0, 0)], &PLACES.map(point));
                    // The faces in the middle are not exact.
                    assert!(gap < 1e-8 * size, "{name}: {gap:e}");
                }
            }
        });
    }
}

/// The refined cage, as one that was never coarser.
fn refined(mesh: &ControlMesh) -> ControlMesh {
    let (level, points) = Level::new(mesh).unwrap().refine_points(&mesh.points);
    let topology = level.topology();
    let mut faces = FaceList::new();
    for face in (0..topology.face_count() as u32).map(FaceId) {
        faces.push(&topology.halfedges(face).map(|h| topology.origin(h).0).collect::<Vec<_>>());
    }
    ControlMesh::new(points, faces)
}

#[test]
fn addresses_of_the_first_cage_lead_down_to_the_refined_one() {
    let cages = [
        ("short pouch", pouch(2, 6), Method::C2),
        ("torus with doublets", with_doublets(&shapes::torus(8, 6), 11), Method::C2),
        ("torus with other doublets", with_doublets(&shapes::torus(8, 6), 9), Method::DegreeRaise),
    ];
    for (name, mesh, method) in cages {
        let fine = refined(&mesh);
        with_surface(&mesh, &options(method), |surface, treated, level| {
            assert!(treated.steps > 0, "{name}");
            let topology = level.topology();
            with_surface(&fine, &options(method), |below, refined, _| {
                assert_eq!(refined.steps + 1, treated.steps, "{name}");
                let mut on_caps = 0;
                for face in (0..topology.face_count() as u32).map(FaceId) {
                    for corner in 0..4 {
                        // The quad at the corner of a halfedge has the number of the halfedge.
                        let child = FaceId(topology.first(face).0 + corner);
                        for i in 0..=12 {
                            for j in 0..=12 {
                                let inside = [i, j].map(|i| f64::from(i) / 12.0);
                                let [u, v] = seen_from(corner, inside.map(|x| x / 2.0));
                                let at = surface.table().locate(face, None, u, v).unwrap();
                                let there = below.table().locate(child, None, inside[0], inside[1]).unwrap();
                                let (coarse, fine) = (surface.jet(at), below.jet(there));
                                if !surface.is_on_cap(at) || !below.is_on_cap(there) {
                                    continue;
                                }
                                on_caps += 1;
                                assert_eq!(coarse.flags, fine.flags, "{name}, {at:?}");
                                if coarse.flags != Flags::NONE {
                                    assert!(coarse.normal.distance(fine.normal) < 1e-12);
                                    continue;
                                }
                                let jet = turned(&coarse.jet, corner);
                                let halved = [
                                    jet.position,
                                    0.5 * jet.du,
                                    0.5 * jet.dv,
                                    0.25 * jet.duu,
                                    0.25 * jet.duv,
                                    0.25 * jet.dvv,
                                ];
                                let gap = farthest(halved, parts(&fine.jet));
                                assert!(gap < 1e-12 * size(&mesh), "{name}, {at:?}: {gap}");
                            }
                        }
                    }
                }
                assert!(on_caps > 1000, "{name}: {on_caps}");
            });
        });
    }
}

#[test]
fn derivatives_in_fans_match_differences() {
    const STEP: f64 = 1e-4;
    let mesh = globe(7, 5);
    with_surface(&mesh, &options(Method::Polar), |surface, _, _| {
        let table = surface.table();
        for number in 0..table.len() {
            let face = table.parametric_face(number);
            let Some(corner) = face.corner else { continue };
            for [u, v] in [[0.4, 0.3], [0.7, 0.2], [0.35, 0.85]] {
                let jet = |u, v| surface.jet(table.locate(face.face, Some(corner), u, v).unwrap()).jet;
                let at = jet(u, v);
                let [left, right] = [jet(u - STEP, v), jet(u + STEP, v)];
                let [down, up] = [jet(u, v - STEP), jet(u, v + STEP)];
                let difference = |a: Vec3, b: Vec3| (b - a) / (2.0 * STEP);
                let found = [
                    difference(left.position, right.position),
                    difference(down.position, up.position),
                    difference(left.du, right.du),
                    difference(down.du, up.du),
                    difference(left.dv, right.dv),
                    difference(down.dv, up.dv),
                ];
                let expected = [at.du, at.dv, at.duu, at.duv, at.duv, at.dvv];
                let gap = farthest(found, expected);
                assert!(gap < 1e-5, "{face:?} at {u}, {v}: {gap}");
            }
        }
    });
}

#[test]
fn curvature_runs_into_lenses_and_poles() {
    for Case { name, mesh, method, .. } in cases() {
        let size = size(&mesh);
        with_surface(&mesh, &options(method), |surface, _, level| {
            let mut centres = 0;
            let view = LimitView::new(level, surface);
            for square in view.layout().squares() {
                for corner in 0..4 {
                    let at = square.on_side(corner, 0.0);
                    if !surface.is_on_cap(at) || !surface.jet(at).flags.contains(Flags::AT_EXTRAORDINARY) {
                        continue;
                    }
                    centres += 1;
                    let there = surface.curvature(at).unwrap();
                    let normal = surface.jet(at).normal;
                    let gaps = (4..46).step_by(6).map(|k| {
                        let near = 0.5_f64.powi(k);
                        let [s, t] = seen_from(corner, [near, 0.7 * near]);
                        let at = square.at(s, t);
                        let angle = normal.angle(surface.jet(at).normal);
                        let here = surface.curvature(at).unwrap();
                        (size * (here.mean - there.mean).abs(), angle)
                    });
                    let gaps: Vec<(f64, f64)> = gaps.collect();
                    let bend = 1.0 + size * there.mean.abs();
                    // Wherever one is on the way the distance from the end is less than it was.
                    assert!(
                        gaps.windows(2).all(|pair| pair[1].0 < pair[0].0.max(1e-5 * bend)),
                        "{name}: {gaps:?}"
                    );
                    assert!(gaps.last().unwrap().0 < 1e-4 * bend, "{name}: {gaps:?}");
                    assert!(gaps.last().unwrap().1 < 1e-9, "{name}: {gaps:?}");
                }
            }
            assert!(centres > 0, "{name}");
        });
    }
}

#[test]
fn rings_of_all_depths_meet_to_second_order() {
    for method in [Method::C2, Method::DegreeRaise] {
        let mesh = shapes::lens();
        let size = size(&mesh);
        with_surface(&mesh, &options(method), |surface, _, _| {
            // Vertex 0 is a lens, and corner 0 of face 0.
            for depth in 0..40 {
                let u = 0.5_f64.powi(depth);
                let beside = f64::from_bits(u.to_bits() - 1);
                for v in [0.0, 0.3, 0.9] {
                    let jet = |u: f64, v: f64| {
                        surface.jet(surface.table().locate(FaceId(0), None, u, v).unwrap()).jet
                    };
                    for [a, b] in [[jet(u, v * u), jet(beside, v * u)], [jet(v * u, u), jet(v * u, beside)]] {
                        let gap = farthest(parts(&a), parts(&b));
                        assert!(gap < 1e-12 * size, "{}, depth {depth}: {gap}", method.name());
                    }
                }
            }
        });
    }
}

#[test]
fn cages_that_were_meshed_anew_have_a_surface_of_their_own() {
    let mesh = shapes::lens();
    let table = PatchTable::new(&Level::new(&mesh).unwrap());
    let limit = LimitSurface::new(&table, &mesh.points);
    for method in [Method::Identify, Method::Remove, Method::Merge] {
        assert!(TreatedSurface::new(&limit, &treat(&mesh, &options(method)).unwrap()).is_none());
    }
    let treated = treat(&mesh, &options(Method::C1)).unwrap();
    let surface = TreatedSurface::new(&limit, &treated).unwrap();
    for at in grid(&table, 3) {
        assert!(!surface.is_on_cap(at));
        assert_eq!(surface.jet(at), limit.jet(at));
    }
    // Of another cage there may be no such faces.
    let cube = shapes::cube();
    let table = PatchTable::new(&Level::new(&cube).unwrap());
    let limit = LimitSurface::new(&table, &cube.points);
    let treated = treat(&mesh, &options(Method::C2)).unwrap();
    assert!(TreatedSurface::new(&limit, &treated).is_none());
}
