//! Lines in a picture are where the surface has them: against known answers, and against meshes of the surface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ogee::quality::{LimitView, PlaneLight, Viewer, bounding_box};
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Vec3, shapes};
use ogee_render::{
    Camera, Pattern, Picture, Projection, Quantity, RenderError, Sampling, Scene, Style, default_light,
    displacement, render,
};

fn with_view<T>(mesh: &ControlMesh, look: impl FnOnce(&LimitView<'_>) -> T) -> T {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    look(&LimitView::new(&level, &surface))
}

fn bright(picture: &Picture, pixel: usize) -> f32 {
    picture.colours[pixel][1]
}

/// A flat square mirrors a ceiling: what each pixel shows follows from its ray alone.
#[test]
fn a_flat_mirror_shows_lines_where_its_rays_go() {
    let mut mesh = shapes::grid(4, 4);
    let count = mesh.points.len() as f64;
    let middle = mesh.points.iter().fold(Vec3::ZERO, |sum, &p| sum + p) / count;
    mesh.points.iter_mut().for_each(|p| *p = Vec3::new(p.x - middle.x, p.y - middle.y, 0.0));
    let size = [240, 200];
    let light = PlaneLight {
        centre: Vec3::new(0.3, 0.0, 5.0),
        axes: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        half: [f64::INFINITY; 2],
    };
    let (period, width) = (0.7, 0.3);
    for projection in [Projection::Perspective { angle: 35.0 }, Projection::Parallel { height: 4.0 }] {
        let camera = Camera {
            eye: Vec3::new(1.0, -6.0, 7.0),
            at: Vec3::ZERO,
            up: Vec3::new(0.0, 0.0, 1.0),
            projection,
        };
        let style = Style::Reflection { light, pattern: Pattern::Lines { period, width, phase: 0.0 } };
        let scene = Scene { camera, size, style, sampling: Sampling::Exact };
        let picture = with_view(&mesh, |view| render(view, &scene).unwrap());
        let view = camera.view(size).unwrap();
        let [right, up, forward] = view.axes;
        let (mut checked, mut wrong) = (0, 0);
        for pixel in 0..(size[0] * size[1]) as usize {
            let (x, y) = (pixel as u32 % size[0], pixel as u32 / size[0]);
            let across = (f64::from(x) + 0.5 - f64::from(size[0]) / 2.0) / view.scale;
            let along = (f64::from(size[1]) / 2.0 - f64::from(y) - 0.5) / view.scale;
            let (origin, ray) = if view.is_parallel {
                (view.eye + across * right + along * up, forward)
            } else {
                (view.eye, across * right + along * up + forward)
            };
            // Down to z = 0, and up again to the ceiling.
            let floor = origin - (origin.z / ray.z) * ray;
            let inside = floor.x.abs() < 1.4 && floor.y.abs() < 1.4;
            let beyond = floor.x + 5.0 / ray.z.abs() * ray.x - light.centre.x;
            let phase = (beyond / period).rem_euclid(1.0);
            let from_edge = phase.min((phase - width).abs()).min(1.0 - phase);
            if !inside || from_edge < 0.06 {
                continue;
            }
            checked += 1;
            if (bright(&picture, pixel) > 0.5) != (phase < width) {
                wrong += 1;
            }
        }
        assert!(checked > 5_000 && wrong == 0, "{wrong} of {checked} pixels are wrong");
    }
}

/// The experiment of the paper in numbers: exact fragments are several times better than a mesh of the same level, both get
/// better by four a level, and Newton's method leaves nothing.
#[test]
fn lines_of_fragments_are_nearer_than_lines_of_polygons() {
    with_view(&shapes::body(), |view| {
        let bounds = bounding_box(view).unwrap();
        let light = default_light(bounds);
        let size = [560, 400];
        let whole = Camera::fit(bounds, size);
        // The bonnet, four times as near.
        let at = Vec3::new(-2.4, 0.3, 1.0);
        let close = Camera { eye: at + 0.25 * (whole.eye - whole.at), at, ..whole };
        for camera in [whole, close] {
            let levels = [1, 2, 3].map(|level| displacement(view, &camera, size, &light, level).unwrap());
            for at in &levels {
                println!("{at:?}");
                let ratio = at.polygon.median / at.parameters.median;
                assert!(ratio >= 4.0, "level {}: {ratio}", at.level);
                assert!(at.newton[1] < 1e-6, "level {}: {:?}", at.level, at.newton);
            }
            for pair in levels.windows(2) {
                for (coarse, fine) in [
                    (pair[0].polygon.median, pair[1].polygon.median),
                    (pair[0].parameters.median, pair[1].parameters.median),
                ] {
                    let fall = coarse / fine;
                    assert!((3.5..4.6).contains(&fall), "from level {}: {fall}", pair[0].level);
                }
            }
        }
    });
}

#[test]
fn pictures_do_not_depend_on_the_number_of_threads() {
    with_view(&shapes::body(), |view| {
        let [lower, upper] = bounding_box(view).unwrap();
        let period = upper.distance(lower) / 15.0;
        let style = Style::Reflection {
            light: default_light([lower, upper]),
            pattern: Pattern::Circles { period, radius: 0.3 },
        };
        let scene = Scene { style, ..Scene::of(view, [160, 120]) };
        let picture = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(view, &scene).unwrap().colours)
        };
        assert_eq!(picture(1), picture(2));
    });
}

/// Outlines do not move when the scene is drawn with more samples: all of the surface is where it was.
#[test]
fn finer_pictures_show_the_same() {
    with_view(&shapes::body(), |view| {
        let small = render(view, &Scene::of(view, [150, 100])).unwrap();
        let large = render(view, &Scene::of(view, [600, 400])).unwrap().reduced(4);
        let differences = small.colours.iter().zip(&large.colours).map(|(a, b)| (a[1] - b[1]).abs());
        let mean = differences.sum::<f32>() / small.colours.len() as f32;
        assert!(mean < 0.004, "{mean}");
    });
}

#[test]
fn views_of_nothing_are_errors() {
    with_view(&shapes::body(), |view| {
        let bounds = bounding_box(view).unwrap();
        let light = default_light(bounds);
        let usual = Scene::of(view, [40, 30]);
        let error = |scene: Scene| render(view, &scene).unwrap_err();
        assert_eq!(
            error(Scene { size: [0, 30], ..usual.clone() }),
            RenderError::EmptySize { width: 0, height: 30 }
        );
        let large = Scene { size: [1 << 20, 1 << 20], ..usual.clone() };
        assert!(matches!(error(large), RenderError::TooLarge { .. }));
        let camera = usual.camera;
        let with = |camera: Camera| Scene { camera, ..usual.clone() };
        assert_eq!(error(with(Camera { eye: camera.at, ..camera })), RenderError::BadCamera);
        let inside = Camera { eye: Vec3::new(0.0, 0.0, 0.7), at: Vec3::new(1.0, 0.0, 0.7), ..camera };
        assert_eq!(error(with(inside)), RenderError::EyeInside);
        let away = Camera { at: camera.eye + (camera.eye - camera.at), ..camera };
        assert_eq!(error(with(away)), RenderError::EmptyView);
        let below = PlaneLight { half: [0.01; 2], centre: Vec3::new(900.0, 0.0, 9.0), ..light };
        let pattern = Pattern::Lines { period: 1.0, width: 0.3, phase: 0.0 };
        let missed = Style::Reflection { light: below, pattern };
        assert_eq!(error(Scene { style: missed, ..usual.clone() }), RenderError::LightMissed);
        let style = Style::Curvature { quantity: Quantity::Mean, limit: None };
        let facets = Scene { style, sampling: Sampling::Polygon(2), ..usual.clone() };
        assert_eq!(error(facets), RenderError::CurvatureOfPolygon);
        let fine = Scene { sampling: Sampling::Parameters(14), ..usual.clone() };
        assert!(matches!(error(fine), RenderError::TooFine { level: 14, .. }));
    });
}

/// The eye among the parts of an open surface: what is behind it is cut away, and nothing breaks.
#[test]
fn surfaces_around_the_eye_are_cut() {
    with_view(&shapes::disk(5, 4), |view| {
        let camera = Camera {
            eye: Vec3::new(0.0, 0.0, 0.4),
            at: Vec3::new(3.0, 0.5, 0.0),
            up: Vec3::new(0.0, 0.0, 1.0),
            projection: Projection::Perspective { angle: 60.0 },
        };
        let picture = render(view, &Scene { camera, ..Scene::of(view, [120, 90]) }).unwrap();
        // The lower part of the picture is floor, to its border.
        let background = picture.colours[0];
        let floor = picture.colours[120 * 70..].iter().filter(|&&colour| colour != background).count();
        assert_eq!(floor, 120 * 20);
        assert!(picture.colours.iter().flatten().all(|x| x.is_finite()));
        assert_eq!(camera.view([120, 90]).unwrap().viewer(), Viewer::Eye(camera.eye));
    });
}

/// A plane that is flat to rounding is flat: its map has one colour.
#[test]
fn maps_of_planes_have_one_colour() {
    let mut mesh = shapes::grid(5, 4);
    for p in &mut mesh.points {
        *p = Vec3::new(0.6 * p.x - 0.64 * p.y + 0.1, 0.8 * p.x + 0.48 * p.y, 0.6 * p.y + 1e3);
    }
    let size = with_view(&mesh, |view| bounding_box(view).map_or(0.0, |[a, b]| a.distance(b)));
    for (quantity, flat) in [
        (Quantity::Mean, 1e-6 / size),
        (Quantity::Greatest, 1e-6 / size),
        (Quantity::Gauss, 1e-12 / size.powi(2)),
        (Quantity::GaussSign, 1e-12 / size.powi(2)),
    ] {
        let style = Style::Curvature { quantity, limit: None };
        let picture =
            with_view(&mesh, |view| render(view, &Scene { style, ..Scene::of(view, [60, 50]) }).unwrap());
        let limit = picture.limit.unwrap();
        assert!((limit / flat - 1.0).abs() < 0.1, "{quantity:?}: {limit:e}");
        let shown: Vec<_> =
            picture.colours.iter().filter(|c| **c != ogee_render::shade::palette::BACKGROUND).collect();
        let first = shown[0];
        let far = shown.iter().filter(|colour| (0..3).any(|k| (colour[k] - first[k]).abs() > 0.03)).count();
        assert!(shown.len() > 500 && far == 0, "{quantity:?}: {far} of {}", shown.len());
    }
}

/// Combs stand on what is seen, and none where nothing bends.
#[test]
fn combs_stand_where_the_surface_bends_and_is_seen() {
    let size = [120, 100];
    let draw = |mesh: &ControlMesh, style: Style| {
        with_view(mesh, |view| render(view, &Scene { style, ..Scene::of(view, size) }).unwrap())
    };
    let flat = shapes::grid(3, 3);
    let combs = || Style::Combs { share: 0.05 };
    assert_eq!(draw(&flat, combs()).colours, draw(&flat, Style::Shaded).colours);
    let ball = shapes::cube();
    let (plain, combed) = (draw(&ball, Style::Shaded), draw(&ball, combs()));
    let is_behind = |colour: &[f32; 3]| *colour == ogee_render::shade::palette::BACKGROUND;
    let around = |picture: &Picture| picture.colours.iter().filter(|c| is_behind(c)).count();
    assert!(around(&combed) + 100 < around(&plain), "hairs stand out");
    with_view(&ball, |view| {
        let [lower, upper] = bounding_box(view).unwrap();
        let tips = ogee_render::comb::tips(view, 0.05);
        let farthest = tips.iter().map(|tip| tip.length()).fold(0.0, f64::max);
        let radius = 0.5 * (upper.x - lower.x);
        let hair = farthest - radius;
        let usual = 0.05 * upper.distance(lower);
        assert!((0.2 * usual..2.0 * usual).contains(&hair), "{hair} beside {usual}");
    });
}

/// A ball twice as large bends half as much: with the colours of the small one it is half way from grey to the end of the scale.
#[test]
fn a_second_picture_has_the_colours_of_the_first() {
    let small = shapes::cube();
    let large = ControlMesh { points: small.points.iter().map(|&p| 2.0 * p).collect(), ..small.clone() };
    let style = Style::Curvature { quantity: Quantity::Mean, limit: None };
    let (scene, first) = with_view(&small, |view| {
        let scene = Scene { style, ..Scene::of(view, [80, 80]) };
        let first = render(view, &scene).unwrap();
        (scene, first)
    });
    let camera = with_view(&large, |view| Scene::of(view, [80, 80]).camera);
    let limit = first.limit.unwrap();
    let second = with_view(&large, |view| render(view, &Scene { camera, ..scene.beside(&first) }).unwrap());
    let alone = with_view(&large, |view| render(view, &Scene { camera, ..scene }).unwrap());
    assert_eq!(second.limit, Some(limit));
    assert!((alone.limit.unwrap() - limit / 2.0).abs() < 0.01 * limit);
    let middle = 80 * 40 + 40;
    let blue = |picture: &Picture| picture.colours[middle][2] / picture.colours[middle][0];
    assert!(blue(&second) < blue(&alone) - 0.1, "{} {}", blue(&second), blue(&alone));
}
