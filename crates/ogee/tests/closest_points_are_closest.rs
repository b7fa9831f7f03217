//! The closest point of the surface is the closest: against dense samples, by its gradient, and where the answer is known.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and says what it saw"
)]

use ogee::{
    Closest, ControlMesh, Corner, Crease, Derivatives, FaceList, Flags, Level, LimitSurface, Location,
    PatchTable, Sharpness, Vec3, shapes,
};
use proptest::prelude::*;

/// Of the size of the cage.
const TOLERANCE: f64 = 1e-12;

/// Numbers that look thrown, in `[0, 1)`.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self, size: f64) -> Vec3 {
        let mut along = || size * (2.0 * self.roll() - 1.0);
        Vec3::new(along(), along(), along())
    }
}

fn mesh(points: &[[f64; 3]], faces: &[&[u32]]) -> ControlMesh {
    let mut list = FaceList::new();
    faces.iter().for_each(|face| list.push(face));
    ControlMesh::new(points.iter().copied().map(Vec3::from).collect(), list)
}

fn pyramid() -> ControlMesh {
    let turn = |i: u32| f64::from(i) * std::f64::consts::TAU / 5.0;
    let mut points: Vec<[f64; 3]> = (0..5).map(|i| [turn(i).cos(), turn(i).sin(), 0.0]).collect();
    points.push([0.1, 0.0, 1.5]);
    mesh(&points, &[&[4, 3, 2, 1, 0], &[0, 1, 5], &[1, 2, 5], &[2, 3, 5], &[3, 4, 5], &[4, 0, 5]])
}

fn creased(sharpness: f64, corner: f64) -> ControlMesh {
    let mut mesh = shapes::cube();
    for vertices in [[0, 1], [1, 3], [3, 2]] {
        mesh.creases.push(Crease { vertices, sharpness: Sharpness::from_value(sharpness) });
    }
    if corner > 0.0 {
        mesh.corners.push(Corner { vertex: 7, sharpness: Sharpness::from_value(corner) });
    }
    mesh
}

fn shaken(mut mesh: ControlMesh, by: f64) -> ControlMesh {
    let mut dice = Dice(mesh.points.len() as u64);
    mesh.points.iter_mut().for_each(|p| *p += dice.point(by));
    mesh
}

fn with_hole(mut mesh: ControlMesh) -> ControlMesh {
    mesh.holes = vec![0];
    mesh
}

fn cages() -> Vec<(&'static str, ControlMesh)> {
    vec![
        ("cube", shapes::cube()),
        ("valence 3", shaken(shapes::disk(3, 2), 0.2)),
        ("valence 5", shaken(shapes::disk(5, 2), 0.2)),
        ("valence 8", shaken(shapes::disk(8, 2), 0.2)),
        ("torus", shapes::torus(6, 5)),
        ("grid", shaken(shapes::grid(3, 2), 0.5)),
        ("pyramid", pyramid()),
        ("semi-sharp", creased(2.5, 1.5)),
        ("sharp", creased(10.0, 10.0)),
        ("hole", with_hole(shapes::cube())),
    ]
}

struct Case {
    mesh: ControlMesh,
    table: PatchTable,
}

impl Case {
    fn new(mesh: ControlMesh) -> Case {
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        Case { mesh, table }
    }

    fn surface(&self) -> LimitSurface<'_> {
        LimitSurface::new(&self.table, &self.mesh.points)
    }

    /// Addresses on a grid over every visible face.
    fn grid(&self, steps: u32) -> Vec<Location> {
        let visible = (0..self.table.len()).filter(|&root| self.table.is_visible(root));
        let at = |root: usize, i: u32| {
            let face = self.table.parametric_face(root);
            let t = |i: u32| f64::from(i) / f64::from(steps);
            self.table.locate(face.face, face.corner, t(i / (steps + 1)), t(i % (steps + 1))).unwrap()
        };
        visible.flat_map(|root| (0..(steps + 1).pow(2)).map(move |i| at(root, i))).collect()
    }
}

/// Samples of a surface, and a bound for the distance of any point of it from the nearest.
struct Dense {
    positions: Vec<Vec3>,
    spacing: f64,
}

impl Dense {
    fn new(case: &Case) -> Dense {
        const STEPS: u32 = 24;
        let positions = case.surface().eval_batch(&case.grid(STEPS), Derivatives::None).position;
        let side = STEPS as usize + 1;
        let mut spacing = 0.0_f64;
        for face in positions.chunks(side * side) {
            for i in 0..side * (side - 1) {
                spacing = spacing.max(face[i].distance(face[i + side]));
                if (i + 1) % side > 0 {
                    spacing = spacing.max(face[i].distance(face[i + 1]));
                }
            }
        }
        Dense { positions, spacing }
    }

    fn distance(&self, point: Vec3) -> f64 {
        self.positions.iter().map(|p| p.distance(point)).fold(f64::INFINITY, f64::min)
    }
}

/// What holds of any closest point: it is on the surface, and inside a face no direction leads closer.
fn check_foot(surface: &LimitSurface<'_>, point: Vec3, found: &Closest, size: f64) {
    let jet = surface.jet(found.location);
    assert!(jet.jet.position.distance(found.position) <= 1e-15 * size);
    assert!((found.position.distance(point) - found.distance).abs() <= 1e-15 * (size + found.distance));
    let inside = found.location.parameters().iter().all(|t| (1e-6..=1.0 - 1e-6).contains(t));
    let regular = |d: Vec3| d.length() > 1e-3 * size;
    if inside && regular(jet.jet.du) && regular(jet.jet.dv) {
        for along in [jet.jet.du, jet.jet.dv] {
            let slope = (found.position - point).dot(along) / along.length();
            assert!(slope.abs() <= 1e-11 * (size + found.distance), "slope {slope:e} at {found:?}");
        }
    }
}

fn check_against_samples(case: &Case, dense: &Dense, points: &[Vec3]) -> f64 {
    let surface = case.surface();
    let closest = surface.closest_points();
    let size = case.mesh.size();
    let mut worst = f64::NEG_INFINITY;
    for (&point, found) in points.iter().zip(closest.closest_batch(points)) {
        let found = found.unwrap();
        assert_eq!(closest.closest(point), Some(found));
        check_foot(&surface, point, &found, size);
        let sampled = dense.distance(point);
        let excess = (found.distance - sampled) / size;
        assert!(excess <= TOLERANCE, "{point:?}: {} instead of {sampled}", found.distance);
        assert!(found.distance >= sampled - 1.5 * dense.spacing, "{point:?}");
        worst = worst.max(excess);
    }
    worst
}

#[test]
fn nothing_sampled_is_closer() {
    for (name, mesh) in cages() {
        let case = Case::new(mesh);
        let (size, dense) = (case.mesh.size(), Dense::new(&case));
        let mut dice = Dice(3);
        let middle = case.mesh.points.iter().fold(Vec3::ZERO, |sum, &p| sum + p);
        let middle = middle / case.mesh.points.len() as f64;
        let near = (0..60).map(|_| middle + dice.point(0.7 * size));
        let far = [1e2, 1e5, 1e9].map(|far| middle + far * size * Vec3::new(0.3, -0.5, 0.8));
        let points: Vec<Vec3> = near.chain(far).chain([middle]).collect();
        let worst = check_against_samples(&case, &dense, &points[..60]);
        println!("{name}: at most {worst:e} of the size beyond the nearest sample");
        for point in &points[60..] {
            let found = case.surface().closest(*point).unwrap();
            let sampled = dense.distance(*point);
            assert!(found.distance <= sampled * (1.0 + 1e-15) + TOLERANCE * size, "{name} {point:?}");
            assert!(found.distance >= sampled - 1.5 * dense.spacing, "{name} {point:?}");
        }
    }
}

#[test]
fn points_of_the_surface_are_their_own() {
    for (name, mesh) in cages() {
        let case = Case::new(mesh);
        let (surface, size) = (case.surface(), case.mesh.size());
        let mut at = case.grid(8);
        // Close to every corner, where extraordinary vertices may be.
        for root in (0..case.table.len()).filter(|&root| case.table.is_visible(root)) {
            let face = case.table.parametric_face(root);
            for depth in [5, 10, 20, 30, 40] {
                let t = 0.5_f64.powi(depth);
                for (u, v) in [(t, 0.3 * t), (1.0 - t, t), (1.0 - 0.7 * t, 1.0), (0.0, 1.0 - t)] {
                    at.push(case.table.locate(face.face, face.corner, u, v).unwrap());
                }
            }
        }
        let points = surface.eval_batch(&at, Derivatives::None).position;
        let mut worst = 0.0_f64;
        for (found, &point) in surface.closest_points().closest_batch(&points).into_iter().zip(&points) {
            let found = found.unwrap();
            assert!(found.distance <= TOLERANCE * size, "{name} {point:?}: {found:?}");
            assert!(surface.eval(found.location).position.distance(point) <= TOLERANCE * size);
            worst = worst.max(found.distance / size);
        }
        println!("{name}: {} points found again to {worst:e} of the size", points.len());
    }
}

#[test]
fn a_little_off_along_the_normal_comes_back() {
    for (name, mesh) in cages() {
        let case = Case::new(mesh);
        let (surface, size) = (case.surface(), case.mesh.size());
        let closest = surface.closest_points();
        let mut worst = 0.0_f64;
        for at in case.grid(7) {
            let foot = surface.eval(at);
            // Beside a crease the other side may be closer.
            let inside = at.parameters().iter().all(|t| (0.1..0.9).contains(t));
            if !inside || foot.flags.contains(Flags::NORMAL_UNDEFINED) {
                continue;
            }
            for offset in [1e-3, -1e-3, 1e-6] {
                let point = foot.position + offset * size * foot.normal;
                let found = closest.closest(point).unwrap();
                let error = found.position.distance(foot.position) / size;
                assert!(error < 1e-11, "{name} {at:?} {offset}: {error:e}");
                worst = worst.max(error);
            }
        }
        println!("{name}: feet found again to {worst:e} of the size");
    }
}

#[test]
fn the_tip_of_a_cone_shaped_corner_is_found_exactly() {
    let case = Case::new(creased(10.0, 10.0));
    let surface = case.surface();
    // Vertex 7 is sharp, so it stays where it is, and sticks out.
    let tip = case.mesh.points[7];
    for far in [0.0, 1e-9, 1e-3, 1.0, 1e3] {
        let found = surface.closest(tip + far * Vec3::new(1.0, 1.0, 1.0)).unwrap();
        assert!(found.position.distance(tip) <= 1e-15, "{far}: {found:?}");
        assert!((found.distance - far * 3.0_f64.sqrt()).abs() <= 1e-15 * (1.0 + far));
    }
}

#[test]
fn size_does_not_matter() {
    let unit = Case::new(creased(1.5, 0.0));
    let mut dice = Dice(5);
    let points: Vec<Vec3> = (0..40).map(|_| dice.point(2.0)).collect();
    for scale in [1e-6, 1e6, 1e-150, 1e100] {
        let mut mesh = unit.mesh.clone();
        mesh.points.iter_mut().for_each(|p| *p = scale * *p);
        let case = Case::new(mesh);
        let surface = case.surface();
        let closest = surface.closest_points();
        for &point in &points {
            let found = closest.closest(scale * point).unwrap();
            let wanted = unit.surface().closest(point).unwrap();
            let (distance, wanted) = (found.distance / scale, wanted.distance);
            assert!((distance - wanted).abs() <= 1e-14, "{scale:e} {point:?}: {distance} {wanted}");
        }
    }
}

#[test]
fn far_from_the_origin_digits_of_the_position_are_all_that_is_lost() {
    let shift = Vec3::new(1e3, -2e3, 5e2);
    let mut mesh = shaken(shapes::disk(5, 2), 0.2);
    mesh.points.iter_mut().for_each(|p| *p += shift);
    let case = Case::new(mesh);
    let (surface, dense) = (case.surface(), Dense::new(&case));
    let mut dice = Dice(9);
    for _ in 0..30 {
        let point = shift + dice.point(2.0);
        let found = surface.closest(point).unwrap();
        assert!(found.distance <= dense.distance(point) + 1e-12);
        assert!(found.distance >= dense.distance(point) - 1.5 * dense.spacing);
    }
}

#[test]
fn no_surface_or_no_point_is_no_answer() {
    let case = Case::new(shapes::cube());
    let surface = case.surface();
    let closest = surface.closest_points();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(closest.closest(Vec3::new(0.0, bad, 0.0)), None);
    }
    let mut mesh = shapes::cube();
    mesh.holes = (0..6).collect();
    let hidden = Case::new(mesh);
    assert_eq!(hidden.surface().closest(Vec3::ZERO), None);
}

/// Cages that have shrunk to a point, to a line, to a plane: an answer all the same, and the right one.
#[test]
fn degenerate_cages_have_closest_points() {
    let shrink = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0)];
    for factors in shrink {
        for base in [shapes::cube(), shapes::disk(5, 2), pyramid()] {
            let mut mesh = base;
            for p in &mut mesh.points {
                *p = Vec3::new(factors.x * p.x, factors.y * p.y, factors.z * p.z);
            }
            let case = Case::new(mesh);
            let (surface, dense) = (case.surface(), Dense::new(&case));
            let closest = surface.closest_points();
            let mut dice = Dice(1);
            let mut points: Vec<Vec3> = (0..20).map(|_| dice.point(2.0)).collect();
            points.extend([Vec3::ZERO, Vec3::new(0.2, 0.0, 0.0)]);
            for point in points {
                let found = closest.closest(point).unwrap();
                let sampled = dense.distance(point);
                assert!(found.distance <= sampled + TOLERANCE, "{factors:?} {point:?}: {found:?} {sampled}");
                assert!(found.distance >= sampled - 1.5 * dense.spacing - TOLERANCE);
            }
        }
    }
}

/// On the axis of a paraboloid a whole circle of points is closest, and no part of it can be left out early.
#[test]
fn a_circle_of_closest_points() {
    let mut mesh = shapes::grid(8, 8);
    for p in &mut mesh.points {
        let (x, y) = ((p.x - 4.0) / 2.0, (p.y - 4.0) / 2.0);
        // A biquadratic polynomial keeps its shape: the limit is x^2 + y^2 plus a constant.
        *p = Vec3::new(x, y, x * x + y * y);
    }
    let case = Case::new(mesh);
    let surface = case.surface();
    let bottom = surface.closest(Vec3::ZERO).unwrap();
    let lowest = surface.eval(case.table.locate(ogee::FaceId(27), None, 1.0, 1.0).unwrap()).position;
    assert!(lowest.x.abs() < 1e-15 && lowest.y.abs() < 1e-15 && (bottom.distance - lowest.z).abs() < 1e-14);
    // Closest to the height h over the bottom: r^2 = h - 1/2 at the distance sqrt(h - 1/4).
    let start = std::time::Instant::now();
    let found = surface.closest(Vec3::new(0.0, 0.0, lowest.z + 1.0)).unwrap();
    println!("a circle took {:?}", start.elapsed());
    assert!((found.distance - 0.75_f64.sqrt()).abs() < 1e-14, "{found:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn on_any_cage(
        which in 0..10usize,
        shake in 0.0..0.6f64,
        points in proptest::collection::vec((-2.0..2.0f64, -2.0..2.0f64, -2.0..2.0f64), 12),
    ) {
        let (_, mesh) = cages().swap_remove(which);
        let size = mesh.size();
        let case = Case::new(shaken(mesh, shake * 0.3 * size));
        let points: Vec<Vec3> =
            points.into_iter().map(|(x, y, z)| 0.5 * size * Vec3::new(x, y, z)).collect();
        check_against_samples(&case, &Dense::new(&case), &points);
    }
}
