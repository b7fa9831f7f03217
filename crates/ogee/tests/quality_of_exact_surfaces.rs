//! On the exact limit everything that the report measures over joints vanishes away from creases, and what it says of the
//! surface follows the surface.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a test fails by panicking, and prints figures")]

mod cages;

use cages::{creased, shaken, sharp_at, with_boundary};
use ogee::quality::{
    Behaviour, Cause, Field, LimitView, PlaneLight, Ray, Report, ReportOptions, SectorKind, Surface, Viewer,
};
use ogee::{
    Boundary, ControlMesh, Derivatives, FaceList, Level, LimitSurface, PatchTable, Samples, Vec3, shapes,
};

/// Of the size.
const GAP: f64 = 1e-12;
const ANGLE_DEGREES: f64 = 1e-9;
/// Of the largest curvature there.
const CURVATURE: f64 = 1e-9;
const KINK_DEGREES: f64 = 1e-8;

/// Lines of light above a cage, seen from the front, the right and above.
fn light(mesh: &ControlMesh) -> Field {
    let first = mesh.points[0];
    let (low, high) = mesh.points.iter().fold((first, first), |(a, b), p| (a.min(*p), b.max(*p)));
    let (middle, size) = (0.5 * (low + high), mesh.size());
    let centre = Vec3::new(middle.x, middle.y, high.z + 0.5 * size);
    let axes = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    Field::Plane {
        light: PlaneLight { centre, axes, half: [f64::INFINITY; 2] },
        viewer: Viewer::Eye(middle + size * Vec3::new(1.1, -1.4, 0.9)),
        ray: Ray::Reflected,
        axis: 0,
    }
}

/// Lets somebody look at the limit of a cage.
fn look<T>(mesh: &ControlMesh, look: impl FnOnce(&LimitView<'_>, &PatchTable) -> T) -> T {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    look(&LimitView::new(&level, &surface), &table)
}

fn report(mesh: &ControlMesh, field: Field) -> Report {
    look(mesh, |view, _| Report::new(view, &ReportOptions::new(field)).unwrap())
}

#[test]
fn smooth_joints_are_exact_in_every_cage() {
    let (mut joints, mut kinks, mut creases) = (0, 0, 0);
    let (mut count, mut worst) = (0, [0.0_f64; 4]);
    // The two sides of a pillow lie on each other: no tangent plane along its edges.
    for (name, mesh) in cages::all().into_iter().filter(|(name, _)| name != "pillow") {
        let found = report(&mesh, light(&mesh)).continuity;
        let smooth = &found.smooth;
        assert!(smooth.gap.max <= GAP * mesh.size(), "{name}: {:e}", smooth.gap.max);
        assert!(found.sharp.gap.max <= GAP * mesh.size(), "{name}: {:e}", found.sharp.gap.max);
        assert!(smooth.angle.max <= ANGLE_DEGREES, "{name}: {:e}", smooth.angle.max);
        assert!(smooth.curvature.max <= CURVATURE, "{name}: {:e}", smooth.curvature.max);
        assert!(smooth.kink.max <= KINK_DEGREES, "{name}: {:e}", smooth.kink.max);
        for metric in [&smooth.gap, &smooth.angle, &smooth.curvature] {
            assert_eq!(metric.samples, 5 * smooth.count, "{name}");
        }
        joints += smooth.count;
        kinks += smooth.kink.samples;
        creases += found.sharp.count;
        let largest = [smooth.gap.max / mesh.size(), smooth.angle.max, smooth.curvature.max, smooth.kink.max];
        (0..4).for_each(|k| worst[k] = worst[k].max(largest[k]));
        count += 1;
    }
    let [gap, angle, curvature, kink] = worst;
    println!("{count} cages: gap {gap:.1e}, angle {angle:.1e}, curvature {curvature:.1e}, kink {kink:.1e}");
    assert!(joints > 1500 && kinks > 5000 && creases > 40, "{joints} {kinks} {creases}");
}

#[test]
fn over_a_body_of_mixed_valences() {
    let mesh = cages::body();
    let found = report(&mesh, light(&mesh));
    let smooth = &found.continuity.smooth;
    assert!(found.is_closed() && smooth.kink.samples > 300);
    assert!(smooth.gap.max < GAP * mesh.size() && smooth.angle.max < ANGLE_DEGREES);
    assert!(smooth.curvature.max < CURVATURE && smooth.kink.max < KINK_DEGREES);
    for metric in [&smooth.gap, &smooth.angle, &smooth.curvature, &smooth.kink] {
        assert!(metric.mean <= metric.p95 && metric.p95 <= metric.max && metric.max == metric.worst[0].value);
        assert!(metric.worst.windows(2).all(|pair| pair[0].value >= pair[1].value));
    }
}

/// Two squares side by side, the second turned down by an angle about the crease between them.
fn roof(degrees: f64, columns: u32) -> ControlMesh {
    let flat = shapes::grid(2 * columns, 3);
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let middle = f64::from(columns);
    let bent = flat.points.iter().map(|p| {
        let beyond = (p.x - middle).max(0.0);
        Vec3::new(p.x.min(middle) + cosine * beyond, p.y, -sine * beyond)
    });
    let ridge: Vec<[u32; 2]> =
        (0..3).map(|j| [0, 1].map(|k| (j + k) * (2 * columns + 1) + columns)).collect();
    creased(ControlMesh { points: bent.collect(), ..flat }, &ridge, 10.0)
}

#[test]
fn a_crease_has_the_angle_of_its_cage() {
    for degrees in [0.5, 30.0, 90.0, 150.0] {
        let mesh = roof(degrees, 2);
        let found = report(&mesh, light(&mesh)).continuity;
        assert_eq!((found.sharp.count, found.smooth.count), (3, 14));
        let angle = &found.sharp.angle;
        assert!((angle.max - degrees).abs() < 1e-10 && (angle.mean - degrees).abs() < 1e-10, "{angle:?}");
        assert!(found.smooth.angle.max < ANGLE_DEGREES);
        // The ridge is the line x = 2, between the columns 1 and 2.
        for worst in &angle.worst {
            assert!((worst.position.x - 2.0).abs() < 1e-12);
            assert_eq!([worst.at, worst.beside].map(|at| (at.face.0 % 4, at.u)), [(1, 1.0), (2, 0.0)]);
        }
    }
}

#[test]
fn addresses_lead_back_to_the_places() {
    for mesh in [cages::body(), cages::pyramid(), creased(cages::cube(), &cages::TOP, 10.0)] {
        let found = report(&mesh, light(&mesh));
        look(&mesh, |view, table| {
            let is_at = |at: ogee::quality::Address, position: Vec3| {
                let location = table.locate(at.face, at.corner, at.u, at.v).unwrap();
                let gap = view.surface().eval(location).position.distance(position);
                assert!(gap < 1e-13, "{at:?}: {gap:e}");
            };
            for joints in [&found.continuity.smooth, &found.continuity.sharp] {
                for metric in [&joints.gap, &joints.angle, &joints.curvature, &joints.kink] {
                    for worst in &metric.worst {
                        is_at(worst.at, worst.position);
                        is_at(worst.beside, worst.position);
                    }
                }
            }
            for bend in [&found.curvature.convex, &found.curvature.concave].into_iter().flatten() {
                is_at(bend.at, bend.position);
                let at = table.locate(bend.at.face, bend.at.corner, bend.at.u, bend.at.v).unwrap();
                let curvature = view.surface().jet(at).curvature().unwrap();
                let radius = 1.0 / curvature.k1.abs().max(curvature.k2.abs());
                assert!((radius - bend.radius).abs() < 1e-9 * radius || radius < bend.radius, "{bend:?}");
            }
            for point in &found.extraordinary.points {
                is_at(point.sector.at, point.sector.position);
            }
        });
    }
}

#[test]
fn extraordinary_points_are_those_of_the_cage() {
    let mesh = cages::body();
    let valences = ogee::Statistics::new(&mesh).valences;
    let found = report(&mesh, light(&mesh)).extraordinary;
    for (&valence, &count) in valences.iter().filter(|(valence, _)| **valence != 4) {
        let same = found.points.iter().filter(|point| point.sector.faces == valence as usize);
        assert_eq!(same.count(), count, "valence {valence}");
    }
    assert_eq!(found.found, found.points.len());
    assert!(found.points.iter().all(|point| point.sector.kind == SectorKind::Interior));
    let swings: Vec<f64> = found.points.iter().map(|point| point.rings[2].mean_swing).collect();
    assert!(swings.windows(2).all(|pair| pair[0] >= pair[1]) && swings[0] > 0.1);
    // No more than asked for are examined.
    let few = ReportOptions { points: 3, ..ReportOptions::new(light(&mesh)) };
    let some = look(&mesh, |view, _| Report::new(view, &few).unwrap()).extraordinary;
    assert_eq!((some.found, some.points.len()), (found.found, 3));
}

#[test]
fn curvature_grows_at_two_faces_and_from_five_on_and_stays_bounded_at_three() {
    // Growth of the mean of |H| at each halving, as measured on test nets, and how far nets differ.
    let cases = [(2, 2.15, 0.15), (5, 1.07, 0.02), (6, 1.12, 0.02), (8, 1.20, 0.05), (12, 1.34, 0.1)];
    for (valence, growth, spread) in cases {
        let mesh = if valence == 2 { shaken(cages::lens_net(3), 0.1) } else { cages::disk(valence) };
        let found = report(&mesh, light(&mesh)).extraordinary;
        let point = found.points.iter().find(|point| point.sector.kind == SectorKind::Interior).unwrap();
        assert_eq!((point.sector.faces, point.behaviour), (valence as usize, Behaviour::Growing));
        println!("valence {valence}: growth {:.3}", point.growth);
        assert!((point.growth - growth).abs() < spread, "{valence}: {}", point.growth);
    }
    for mesh in [cages::disk(3), cages::cube()] {
        for point in &report(&mesh, light(&mesh)).extraordinary.points {
            assert_eq!((point.sector.faces, point.behaviour), (3, Behaviour::Bounded), "{}", point.growth);
        }
    }
    let disk = cages::disk(5);
    let flat = ControlMesh { points: disk.points.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect(), ..disk };
    assert!(report(&flat, light(&flat)).extraordinary.points.iter().all(|p| p.behaviour == Behaviour::Flat));
}

#[test]
fn points_without_a_tangent_plane_are_named() {
    let causes = |mesh: &ControlMesh| -> Vec<(SectorKind, usize, Cause)> {
        let found = report(mesh, light(mesh)).extraordinary.without_plane;
        found.iter().map(|point| (point.sector.kind, point.sector.faces, point.cause)).collect()
    };
    use SectorKind::{Border, Crease, Interior};
    // Four faces at the border, and corners of one face, which are sound.
    let border = |k| with_boundary(cages::fan(k), Boundary::EdgeOnly);
    assert_eq!(causes(&border(3)), []);
    assert_eq!(causes(&border(4)), [(Border, 4, Cause::Rules)]);
    assert_eq!(causes(&border(5)), [(Border, 5, Cause::Rules)]);
    // Corners with two faces and with three.
    let corners = sharp_at(cages::l_shape(), &[2, 12], 10.0);
    assert_eq!(causes(&corners), [(Border, 2, Cause::Slow), (Border, 3, Cause::Rules)]);
    // A cone, a pair of faces inside, sound but where it is sharp, and four faces along a crease.
    assert_eq!(causes(&sharp_at(cages::disk(5), &[0], 10.0)), [(Interior, 5, Cause::Rules)]);
    assert_eq!(causes(&cages::valence_two()), []);
    assert_eq!(causes(&sharp_at(cages::valence_two(), &[8], 10.0)), [(Interior, 2, Cause::Rules)]);
    let crease = creased(cages::disk(8), &cages::spokes(&[0, 4], 2), 10.0);
    assert_eq!(causes(&crease), [(Crease, 4, Cause::Rules); 2]);
    assert_eq!(causes(&cages::body()), []);
}

/// A cage and its light, turned, moved and scaled together.
fn moved(mesh: &ControlMesh, scale: f64) -> (ControlMesh, Field) {
    let turn = |p: Vec3| {
        Vec3::new(
            0.36 * p.x + 0.48 * p.y - 0.8 * p.z,
            -0.8 * p.x + 0.6 * p.y,
            0.48 * p.x + 0.64 * p.y + 0.6 * p.z,
        )
    };
    let Field::Plane { light, viewer: Viewer::Eye(eye), ray, axis } = light(mesh) else { panic!("a plane") };
    let there = |p: Vec3| scale * turn(p) + scale * Vec3::new(3.0, -2.0, 1.0);
    let field = Field::Plane {
        light: PlaneLight { centre: there(light.centre), axes: light.axes.map(turn), ..light },
        viewer: Viewer::Eye(there(eye)),
        ray,
        axis,
    };
    (ControlMesh { points: mesh.points.iter().map(|&p| there(p)).collect(), ..mesh.clone() }, field)
}

#[test]
fn turning_and_scaling_change_nothing_but_lengths() {
    let mesh = creased(cages::body(), &[[0, 1]], 10.0);
    let here = report(&mesh, light(&mesh));
    for scale in [1e-60, 1e-6, 1.0, 1e6, 1e60] {
        let (mesh, field) = moved(&mesh, scale);
        let there = report(&mesh, field);
        let near = |a: f64, b: f64, what: &str| {
            assert!((a - b).abs() <= 1e-7 * a.abs().max(b.abs()), "{what} at {scale}: {a} is not {b}");
        };
        near(here.curvature.area * scale * scale, there.curvature.area, "area");
        for (a, b) in [
            (&here.curvature.convex, &there.curvature.convex),
            (&here.curvature.concave, &there.curvature.concave),
        ] {
            near(a.unwrap().radius * scale, b.unwrap().radius, "radius");
        }
        near(here.continuity.sharp.angle.max, there.continuity.sharp.angle.max, "crease");
        near(here.curvature.mean.quantiles[1], there.curvature.mean.quantiles[1] * scale, "mean curvature");
        near(
            here.curvature.gauss.quantiles[2],
            there.curvature.gauss.quantiles[2] * scale * scale,
            "Gauss curvature",
        );
        assert_eq!(here.continuity.smooth.kink.samples, there.continuity.smooth.kink.samples);
        assert!(
            there.continuity.smooth.kink.max < KINK_DEGREES
                && there.continuity.smooth.angle.max < ANGLE_DEGREES
        );
        let swings = |report: &Report| {
            report.extraordinary.points.iter().map(|p| p.rings[2].mean_swing).collect::<Vec<_>>()
        };
        for (a, b) in swings(&here).into_iter().zip(swings(&there)) {
            near(a, b, "swing");
        }
    }
}

#[test]
fn numbering_does_not_matter() {
    let mesh = cages::body();
    let here = report(&mesh, light(&mesh));
    // Faces from last to first, each from its third corner on.
    let mut faces = FaceList::new();
    for face in mesh.faces.iter().collect::<Vec<_>>().into_iter().rev() {
        let mut corners = face.to_vec();
        corners.rotate_left(2);
        faces.push(&corners);
    }
    let other = ControlMesh { faces, ..mesh.clone() };
    let there = report(&other, light(&other));
    assert!((here.curvature.area / there.curvature.area - 1.0).abs() < 1e-13);
    assert_eq!(here.continuity.smooth.count, there.continuity.smooth.count);
    assert_eq!(here.extraordinary.found, there.extraordinary.found);
    let worst = |report: &Report| report.extraordinary.points[0].rings[2].mean_swing;
    assert!((worst(&here) / worst(&there) - 1.0).abs() < 1e-9);
    let [a, b] = [&here, &there].map(|report| report.curvature.convex.unwrap());
    assert!((a.radius / b.radius - 1.0).abs() < 1e-9);
}

#[test]
fn the_area_of_a_flat_sheet_and_of_a_ball() {
    let sheet = shapes::grid(3, 2);
    let found = report(&sheet, light(&sheet));
    assert!((found.curvature.area - 6.0).abs() < 0.5 && !found.is_closed());
    assert_eq!((found.continuity.border, found.curvature.convex.is_none()), (10, true));
    assert!(found.curvature.mean.greatest.abs() < 1e-12);
    // Turned, it is flat to rounding only, which is no bend either.
    let (turned, field) = moved(&sheet, 1.0);
    let found = report(&turned, field).curvature;
    assert!(found.mean.greatest != found.mean.least && found.convex.is_none() && found.concave.is_none());
    // Area and its shares, against a grid of samples fine enough.
    let mesh = cages::body();
    let found = report(&mesh, light(&mesh)).curvature;
    let area = look(&mesh, |view, _| {
        const STEPS: usize = 60;
        let step = |i: usize| (i as f64 + 0.5) / STEPS as f64;
        let places: Vec<_> = view
            .layout()
            .squares()
            .iter()
            .flat_map(|square| (0..STEPS * STEPS).map(|k| square.at(step(k / STEPS), step(k % STEPS))))
            .collect();
        let mut samples = Samples::default();
        view.evaluate(&places, Derivatives::First, &mut samples);
        let areas = samples.du.iter().zip(&samples.dv).map(|(du, dv)| du.cross(*dv).length());
        areas.sum::<f64>() / (STEPS * STEPS) as f64
    });
    assert!((found.area / area - 1.0).abs() < 1e-4, "{} {area}", found.area);
    for spread in [&found.mean, &found.gauss, &found.greatest] {
        let shares: f64 = spread.histogram.shares.iter().chain(&spread.histogram.outside).sum();
        assert!((shares - 1.0).abs() < 1e-12);
        let [low, middle, high] = spread.quantiles;
        assert!(spread.least <= low && low <= middle && middle <= high && high <= spread.greatest);
    }
}

#[test]
fn singular_surfaces_give_numbers_or_nothing() {
    let one_point = ControlMesh { points: vec![Vec3::ZERO; 8], ..shapes::cube() };
    let line = ControlMesh {
        points: shapes::cube().points.iter().map(|p| Vec3::new(p.x, 0.0, 0.0)).collect(),
        ..shapes::cube()
    };
    let flat = ControlMesh {
        points: shapes::cube().points.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect(),
        ..shapes::cube()
    };
    let tiny =
        ControlMesh { points: shapes::cube().points.iter().map(|&p| 1e-150 * p).collect(), ..shapes::cube() };
    let mut pinched = shaken(shapes::grid(3, 3), 0.3);
    let (a, b) = (pinched.points[5], 6);
    pinched.points[b] = a;
    let (_, pillow) = cages::all().into_iter().find(|(name, _)| name == "pillow").unwrap();
    let cages = [
        ("point", one_point),
        ("line", line),
        ("flat", flat),
        ("tiny", tiny),
        ("pinched", pinched),
        ("pillow", pillow),
    ];
    for (name, mesh) in cages {
        let field = light(&shapes::cube());
        let found = report(&mesh, field);
        let Report { continuity, curvature, extraordinary, .. } = &found;
        let mut numbers = vec![curvature.area];
        for joints in [&continuity.smooth, &continuity.sharp] {
            for metric in [&joints.gap, &joints.angle, &joints.curvature, &joints.kink] {
                numbers.extend([metric.max, metric.p95, metric.mean]);
            }
        }
        for spread in [&curvature.mean, &curvature.gauss, &curvature.greatest] {
            numbers.extend([spread.least, spread.greatest, spread.mean]);
            numbers.extend(spread.quantiles);
            numbers.extend(spread.histogram.range);
            numbers.extend(&spread.histogram.shares);
        }
        for point in &extraordinary.points {
            numbers.push(point.growth);
            numbers.extend(point.rings.iter().flat_map(|r| [r.mean, r.mean_swing, r.gauss_swing]));
        }
        assert!(numbers.iter().all(|x| x.is_finite()), "{name}: {found:?}");
        if name == "point" || name == "line" {
            assert_eq!(curvature.undefined_normals, curvature.samples, "{name}");
        }
    }
}
