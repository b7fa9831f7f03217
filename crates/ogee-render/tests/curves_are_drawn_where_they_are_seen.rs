//! Curves drawn over a picture: as wide as they are asked to be, where they are, and nowhere that the surface hides.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ogee::quality::LimitView;
use ogee::{ControlMesh, Level, LimitSurface, PatchTable, Vec3, shapes};
use ogee_render::{Camera, Picture, RenderError, Scene, Stroke, View, render};

const RED: [f32; 3] = [1.0, 0.0, 0.0];

/// The picture of a surface from a direction without and with strokes, and how it is seen.
fn drawn(mesh: &ControlMesh, from: Vec3, strokes: &[Stroke]) -> (Picture, Picture, View) {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let limit = LimitSurface::new(&table, &mesh.points);
    let surface = LimitView::new(&level, &limit);
    let size = [300, 240];
    let camera = Camera::fit_from(from, &ogee_render::outline(&surface), 30.0, size);
    let scene = Scene { camera, ..Scene::of(&surface, size) };
    let plain = render(&surface, &scene).unwrap();
    let mut with = plain.clone();
    with.draw(&surface, &camera, strokes).unwrap();
    (plain, with, camera.view(size).unwrap())
}

/// The pixels in which two pictures differ.
fn changed(a: &Picture, b: &Picture) -> Vec<usize> {
    (0..a.colours.len()).filter(|&i| a.colours[i] != b.colours[i]).collect()
}

fn stroke(points: Vec<Vec3>, width: f64) -> Stroke {
    Stroke { points, width, colour: RED }
}

/// A flat sheet, so that what lies on it is known.
fn sheet() -> ControlMesh {
    let mut mesh = shapes::grid(6, 6);
    mesh.points.iter_mut().for_each(|p| p.z = 0.0);
    mesh
}

fn distance([x, y]: [f64; 2], [[x0, y0], [x1, y1]]: [[f64; 2]; 2]) -> f64 {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let part = (((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
    (x - x0 - part * dx).hypot(y - y0 - part * dy)
}

#[test]
fn strokes_are_as_wide_as_asked_and_change_nothing_else() {
    for width in [2.0, 7.5] {
        let ends = [Vec3::new(1.2, 1.4, 0.0), Vec3::new(4.6, 4.1, 0.0)];
        let (plain, with, view) = drawn(&sheet(), Vec3::new(0.4, -0.7, 0.8), &[stroke(ends.to_vec(), width)]);
        let line = ends.map(|point| view.pixel(view.to_camera(point)));
        let far = |pixel: usize| {
            let (x, y) = (pixel as u32 % view.size[0], pixel as u32 / view.size[0]);
            distance([f64::from(x) + 0.5, f64::from(y) + 0.5], line)
        };
        for pixel in 0..plain.colours.len() {
            let distance = far(pixel);
            if distance > 0.5 * width + 0.51 {
                assert_eq!(plain.colours[pixel], with.colours[pixel], "{distance} pixels away");
            }
            if distance < 0.5 * width - 0.51 {
                assert_eq!(with.colours[pixel], RED, "{distance} pixels away");
            }
        }
        assert!(changed(&plain, &with).len() > 200);
    }
}

#[test]
fn how_a_stroke_is_cut_does_not_show() {
    let (a, b) = (Vec3::new(1.2, 1.4, 0.0), Vec3::new(4.6, 4.1, 0.0));
    let cut = |count: usize| {
        let points = (0..=count).map(|i| a.lerp(b, i as f64 / count as f64)).collect();
        drawn(&sheet(), Vec3::new(0.4, -0.7, 0.8), &[stroke(points, 5.0)]).1
    };
    let (whole, pieces) = (cut(1), cut(37));
    for (one, other) in whole.colours.iter().zip(&pieces.colours) {
        assert!((0..3).all(|k| (one[k] - other[k]).abs() < 0.02), "{one:?} {other:?}");
    }
}

#[test]
fn a_point_is_a_disc() {
    let middle = Vec3::new(3.0, 3.0, 0.0);
    let (plain, with, _) = drawn(&sheet(), Vec3::new(0.0, -0.2, 1.0), &[stroke(vec![middle], 21.0)]);
    let found = changed(&plain, &with).into_iter().filter(|&pixel| with.colours[pixel] == RED).count() as f64;
    let wanted = std::f64::consts::PI * 10.0 * 10.0;
    assert!((found / wanted - 1.0).abs() < 0.05, "{found} pixels, not {wanted}");
}

#[test]
fn what_the_surface_hides_is_not_drawn() {
    let ball = shapes::cube();
    let level = Level::new(&ball).unwrap();
    // Limits of corners and of edges lie on the ball.
    let (fine, points) = level.refine_points(&ball.points);
    let on_ball: Vec<Vec3> = ogee::limit_vertices(&fine, &points).iter().map(|v| v.position).collect();
    let from = Vec3::new(0.0, -1.0, 0.0);
    let of_side = |sign: f64| {
        let discs = on_ball.iter().filter(|p| sign * p.y > 0.2).map(|&p| stroke(vec![p], 4.0));
        discs.collect::<Vec<Stroke>>()
    };
    let (near, far) = (of_side(-1.0), of_side(1.0));
    assert!(near.len() == far.len() && near.len() > 8);
    let (plain, with, view) = drawn(&ball, from, &near);
    let red = |stroke: &Stroke| {
        let [x, y] = view.pixel(view.to_camera(stroke.points[0]));
        with.colours[y as usize * view.size[0] as usize + x as usize] == RED
    };
    assert!(near.iter().all(red));
    let hidden = drawn(&ball, from, &far).1;
    assert_eq!(changed(&plain, &hidden), [], "all of it is behind the ball");
    // A line through the ball is seen before it and not inside or behind.
    let piece = |from: f64, to: f64| vec![Vec3::new(0.0, from, 0.1 * from), Vec3::new(0.0, to, 0.1 * to)];
    let pixels = |points: Vec<Vec3>| changed(&plain, &drawn(&ball, from, &[stroke(points, 3.0)]).1);
    assert!(pixels(piece(-3.0, 0.0)).len() > 20);
    assert_eq!(pixels(piece(0.0, 3.0)), []);
    let more = pixels(piece(-3.0, 3.0)).len().abs_diff(pixels(piece(-3.0, 0.0)).len());
    assert!(more < 3, "{more} pixels more or less");
}

#[test]
fn cameras_that_show_nothing_draw_nothing() {
    let mesh = sheet();
    let level = Level::new(&mesh).unwrap();
    let table = PatchTable::new(&level);
    let limit = LimitSurface::new(&table, &mesh.points);
    let surface = LimitView::new(&level, &limit);
    let scene = Scene::of(&surface, [30, 20]);
    let mut picture = render(&surface, &scene).unwrap();
    let camera = Camera { at: scene.camera.eye, ..scene.camera };
    assert_eq!(picture.draw(&surface, &camera, &[]), Err(RenderError::BadCamera));
}
