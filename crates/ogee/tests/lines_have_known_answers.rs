//! Lines against answers from elsewhere, parts of lines, and what is no question.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;
mod views;

use std::f64::consts::TAU;

use ogee::quality::{
    Fairness, Field, Levels, LineOptions, LinesError, PatchView, PlaneLight, Ray, Surface, Viewer,
    level_lines,
};
use ogee::{ControlMesh, Derivatives, FaceId, FaceList, Level, Refinement, Samples, Vec3, convert, shapes};
use proptest::prelude::*;
use views::{TOLERANCE, ceiling, every_field, size, trace, with_view};

/// A ceiling at height `h` with lines across `x`.
fn level_plane(h: f64) -> PlaneLight {
    PlaneLight {
        centre: Vec3::new(0.0, 0.0, h),
        axes: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        half: [f64::INFINITY; 2],
    }
}

#[test]
fn a_flat_mirror_shows_straight_lines_in_known_places() {
    let mesh = shapes::grid(6, 4);
    let (e, h) = (Vec3::new(2.5, -3.0, 5.0), 7.0);
    with_view(&mesh, |view| {
        let field =
            Field::Plane { light: level_plane(h), viewer: Viewer::Eye(e), ray: Ray::Reflected, axis: 0 };
        let found = trace(view, &field, &Levels::Every { first: 0.25, period: 1.5 });
        // The mirrored eye is below the floor: its rays meet the ceiling at e + (x - e) (e.z + h) / e.z.
        let place = |s: f64| e.x + (s - e.x) * e.z / (e.z + h);
        let expected: Vec<f64> = (-9..20)
            .map(|j| 0.25 + 1.5 * f64::from(j))
            .filter(|s| (0.0..=6.0).contains(&place(*s)))
            .collect();
        assert_eq!(found.lines.len(), expected.len());
        for (line, s) in found.lines.iter().zip(expected) {
            assert!((line.value - s).abs() < 1e-12 && !line.closed);
            let worst =
                line.points.iter().map(|point| (point.position.x - place(s)).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-11, "{worst:e}");
            let Fairness { length, turning, inflections, curvature_change } =
                Fairness::of(line, view, &field);
            assert!((length - 4.0).abs() < 1e-12 && turning < 1e-9, "{length} {turning:e}");
            assert!(inflections == 0 && curvature_change < 1e-6);
            // What is below the value lies on the left: lines go towards larger y.
            assert!(line.points[0].position.y < line.points[line.points.len() - 1].position.y);
        }
    });
}

#[test]
fn lines_of_light_straight_above_are_seen_where_they_are() {
    // Lines through the vertices of the grid, too.
    with_view(&shapes::grid(5, 5), |view| {
        for ray in [Ray::Reflected, Ray::Normal] {
            let viewer = Viewer::Parallel(Vec3::new(0.0, 0.0, -1.0));
            let field = Field::Plane { light: level_plane(3.0), viewer, ray, axis: 1 };
            let found = trace(view, &field, &Levels::Every { first: 0.0, period: 0.5 });
            // A line along the lower border has nothing below it.
            assert_eq!(found.lines.len(), 10);
            for line in &found.lines {
                assert!(line.points.iter().all(|point| (point.position.y - line.value).abs() < 1e-12));
            }
        }
    });
}

#[test]
fn an_isophote_turns_by_what_gauss_and_bonnet_say() {
    // The normals along it are a circle around the light, so the curvature within is the cap inside that circle; what is
    // left of a full turn is what the line turns to the right, less what it turns to the left: what is below is outside.
    let mut ball = shapes::cube();
    for _ in 0..2 {
        let refined = Refinement::uniform(&Level::new(&ball).unwrap(), 1).unwrap();
        let points = refined.apply(&ball.points).into_iter().map(|p| p.normalized().unwrap()).collect();
        let topology = refined.finest().topology();
        let mut faces = FaceList::new();
        for face in (0..topology.face_count() as u32).map(FaceId) {
            faces.push(&topology.halfedges(face).map(|h| topology.origin(h).0).collect::<Vec<u32>>());
        }
        ball = ControlMesh::new(points, faces);
    }
    with_view(&ball, |view| {
        let field = Field::Isophote { light: Vec3::new(0.36, 0.48, 0.8) };
        let cosines = vec![0.2, 0.5, 0.7];
        let options = LineOptions::new(1e-5);
        let found = level_lines(view, &field, &Levels::Listed(cosines.clone()), &options).unwrap();
        assert_eq!(found.lines.len(), 3);
        for (line, cosine) in found.lines.iter().zip(cosines) {
            let at: Vec<_> = line.points[1..].iter().map(|point| point.at).collect();
            let mut samples = Samples::default();
            view.evaluate(&at, Derivatives::First, &mut samples);
            let (points, count) = (&samples.position, at.len());
            let turns: Vec<f64> = (0..count)
                .map(|k| {
                    let normal = samples.normal[k];
                    let flat = |chord: Vec3| chord - chord.dot(normal) * normal;
                    let before = flat(points[k] - points[(k + count - 1) % count]);
                    let after = flat(points[(k + 1) % count] - points[k]);
                    normal.dot(before.cross(after)).atan2(before.dot(after))
                })
                .collect();
            let net: f64 = -turns.iter().sum::<f64>();
            assert!((net - TAU * cosine).abs() < 1e-3, "{net} {}", TAU * cosine);
            // The figures, from directions of the line itself, say the same of all turning.
            let all: f64 = turns.iter().map(|turn| turn.abs()).sum();
            let fairness = Fairness::of(line, view, &field);
            assert!((fairness.turning - all).abs() < 0.01 * all, "{} {all}", fairness.turning);
        }
    });
}

#[test]
fn what_is_not_wanted_is_cut_off_where_it_begins() {
    with_view(&cages::disk(5), |view| {
        let (size, light) = (size(view), ceiling(view));
        let viewer = Viewer::Eye(light.centre + size * Vec3::new(0.4, -0.5, 0.2));
        let narrow = PlaneLight { half: [size, 0.3 * size], ..light };
        let field = |light| Field::Plane { light, viewer, ray: Ray::Reflected, axis: 0 };
        let levels = Levels::Every { first: 0.0, period: size / 30.0 };
        let length = |light: PlaneLight, options: &LineOptions<'_>| -> f64 {
            let found = level_lines(view, &field(light), &levels, options).unwrap();
            found.lines.iter().map(|line| Fairness::of(line, view, &field(light)).length).sum()
        };
        let all = LineOptions::new(TOLERANCE * size);
        let whole = length(light, &all);
        assert!(whole > 0.0);

        // The plane's end.
        let inside = level_lines(view, &field(narrow), &levels, &all).unwrap();
        let mut samples = Samples::default();
        let mut farthest = 0.0_f64;
        for line in &inside.lines {
            let at: Vec<_> = line.points.iter().map(|point| point.at).collect();
            view.evaluate(&at, Derivatives::First, &mut samples);
            for (position, normal) in samples.position.iter().zip(&samples.normal) {
                let hit = light.hit(Ray::Reflected, &viewer, *position, *normal).unwrap();
                farthest = farthest.max(hit.at[1].abs());
            }
        }
        assert!(farthest <= 0.3 * size && farthest > 0.2999 * size, "{farthest}");
        assert!(length(narrow, &all) < 0.95 * whole);

        // One half of space and the other are all of it.
        let middle = 0.1 * size;
        let [left, right] = [|p: Vec3, x: f64| p.x <= x, |p: Vec3, x: f64| p.x > x]
            .map(|side| length(light, &LineOptions { visible: Some(&|p| side(p, middle)), ..all }));
        assert!(
            left > 0.0 && right > 0.0 && (left + right - whole).abs() < 1e-3 * whole,
            "{left} {right} {whole}"
        );

        // The front and the back.
        let front = |viewer| length(light, &LineOptions { front: Some(viewer), ..all });
        let down = Vec3::new(0.6, 0.0, -0.8);
        let [near, far] = [down, -down].map(|direction| front(Viewer::Parallel(direction)));
        assert!((near + far - whole).abs() < 1e-3 * whole, "{near} {far} {whole}");
        // Chords no longer than asked.
        let short = LineOptions { longest: 0.01 * size, ..all };
        let found = level_lines(view, &field(light), &levels, &short).unwrap();
        let chords = found.lines.iter().flat_map(|line| line.points.windows(2));
        let longest = chords.map(|pair| pair[0].position.distance(pair[1].position)).fold(0.0, f64::max);
        assert!(longest <= 0.01 * size && longest > 0.004 * size);
    });
}

#[test]
fn lines_on_the_patches_of_a_part_are_lines_of_their_field() {
    let part = convert::to_part(&cages::cube(), &convert::Options::default()).unwrap();
    let patches: Vec<_> = part
        .bodies
        .iter()
        .flat_map(|body| body.shells())
        .flat_map(|shell| shell.faces.iter().map(|face| (face.surface.clone(), face.quads.clone())))
        .collect();
    let view = PatchView::new(patches).unwrap();
    let (_, field, levels) = every_field(&view).swap_remove(2);
    let found = trace(&view, &field, &levels);
    assert!(found.max_residual <= 1e-12);
    assert!(found.lines.iter().all(|line| line.closed) && found.lines.len() == 11);
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let mesh = shapes::studded_torus(12, 9, 3);
    with_view(&mesh, |view| {
        let (_, field, levels) = every_field(view).swap_remove(0);
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| trace(view, &field, &levels).lines)
        };
        let one = on(1);
        assert!(one.len() > 50 && one == on(2) && one == on(5));
    });
}

#[test]
fn senseless_questions_are_refused() {
    with_view(&cages::cube(), |view| {
        let (_, field, levels) = every_field(view).swap_remove(0);
        let options = LineOptions::new(1e-3);
        let code = |field: &Field, levels: &Levels, options: &LineOptions<'_>| {
            level_lines(view, field, levels, options).unwrap_err().code()
        };
        for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(code(&field, &Levels::Every { first: 0.0, period }, &options), "bad_period");
        }
        assert_eq!(code(&field, &Levels::Every { first: f64::NAN, period: 1.0 }, &options), "bad_period");
        for values in [vec![], vec![2.0, 1.0], vec![1.0, 1.0], vec![f64::NAN]] {
            assert_eq!(code(&field, &Levels::Listed(values), &options), "bad_levels");
        }
        for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(code(&field, &levels, &LineOptions::new(tolerance)), "bad_tolerance");
        }
        for period in [1e-9, 1e-300] {
            let error =
                level_lines(view, &field, &Levels::Every { first: 0.0, period }, &options).unwrap_err();
            assert!(matches!(error, LinesError::TooMany { .. }), "{error}");
        }
        let Field::Plane { light, viewer, ray, .. } = field else { panic!("a plane") };
        let senseless = [
            Field::Plane { light, viewer, ray, axis: 2 },
            Field::Plane { light: PlaneLight { axes: [Vec3::ZERO; 2], ..light }, viewer, ray, axis: 0 },
            Field::Plane { light: PlaneLight { half: [f64::NAN; 2], ..light }, viewer, ray, axis: 0 },
            Field::Plane { light, viewer: Viewer::Eye(Vec3::new(f64::NAN, 0.0, 0.0)), ray, axis: 0 },
            Field::Plane { light, viewer: Viewer::Parallel(Vec3::ZERO), ray, axis: 0 },
            Field::Isophote { light: Vec3::ZERO },
            Field::Zebra { viewer, axis: Vec3::new(f64::INFINITY, 0.0, 0.0) },
        ];
        for field in senseless {
            assert_eq!(code(&field, &levels, &options), "bad_field", "{field:?}");
        }
    });
    // Nothing, and a single point.
    let hidden = cages::with_holes(shapes::grid(1, 1), &[0]);
    let mut point = shapes::cube();
    point.points.fill(Vec3::new(1.0, 2.0, 3.0));
    for mesh in [hidden, point] {
        with_view(&mesh, |view| {
            let field = Field::Isophote { light: Vec3::new(0.0, 0.0, 1.0) };
            let levels = Levels::Every { first: 0.0, period: 0.1 };
            let error = level_lines(view, &field, &levels, &LineOptions::new(1e-3)).unwrap_err();
            assert_eq!(error, LinesError::NoSurface);
        });
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_the_cage_lines_are_lines(mesh in cages::tagged(Just(cages::cloud(40)))) {
        let Ok(level) = Level::new(&mesh) else { return Ok(()) };
        let table = ogee::PatchTable::new(&level);
        let surface = ogee::LimitSurface::new(&table, &mesh.points);
        let view = ogee::quality::LimitView::new(&level, &surface);
        if view.layout().squares().is_empty() {
            return Ok(());
        }
        for (kind, field, levels) in every_field(&view) {
            let options = LineOptions::new(1e-3 * size(&view));
            match level_lines(&view, &field, &levels, &options) {
                Ok(found) => {
                    let points = found.lines.iter().flat_map(|line| &line.points);
                    prop_assert!(points.clone().all(|point| point.position.is_finite()), "{}", kind);
                    prop_assert!(found.max_residual <= 1e-12 * size(&view).max(1.0));
                }
                Err(error) => prop_assert!(matches!(error, LinesError::TooMany { .. }), "{}", error),
            }
        }
    }
}
