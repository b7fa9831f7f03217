//! Bicubic polar subdivision: eigenvalues, limits and tangents, and how it agrees with Catmull-Clark around it; the pole between
//! two lenses on the limit surface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod poles;

use ogee::lens::{PolarNet, RadialRule, pair_pole};
use ogee::{ControlMesh, FaceId, FaceList, Level, LimitSurface, PatchTable, Vec3, limit_vertices};
use poles::{Numbers, circles};
use std::f64::consts::TAU;

const RULES: [RadialRule; 2] = [RadialRule::Half, RadialRule::FiveEighths];
const POLE: Vec3 = Vec3::new(0.1, -0.2, 0.3);

fn net(sectors: usize, count: usize) -> PolarNet {
    let mut numbers = Numbers(sectors as u64);
    let circle = |radius: usize| -> Vec<Vec3> {
        let point = |i: usize| {
            let (sine, cosine) = (TAU * i as f64 / sectors as f64).sin_cos();
            radius as f64 * Vec3::new(cosine, sine, 0.1 * radius as f64) + 0.2 * numbers.point()
        };
        (0..sectors).map(point).collect()
    };
    PolarNet { pole: POLE, circles: (1..=count).map(circle).collect() }
}

/// A net of numbers: pole and innermost circle in the coordinate `x`.
fn mode(pole: f64, sectors: usize, value: impl Fn(f64) -> f64) -> PolarNet {
    let circle = (0..sectors).map(|i| Vec3::new(value(TAU * i as f64 / sectors as f64), 0.0, 0.0)).collect();
    PolarNet { pole: Vec3::new(pole, 0.0, 0.0), circles: vec![circle] }
}

#[test]
fn eigenvalues_are_those_of_a_smooth_surface() {
    // Pole and innermost circle: the constant, one radial mode, and waves around; these are as many as there are points.
    for sectors in 6..=20 {
        for rule in RULES {
            let check = |net: PolarNet, value: f64| {
                let next = net.refined(rule).unwrap();
                assert!((next.pole - value * net.pole).length() < 1e-9);
                for (a, b) in next.circles[0].iter().zip(&net.circles[0]) {
                    assert!((*a - value * *b).length() < 1e-9, "n = {sectors}, {rule:?}, {value}");
                }
            };
            check(mode(1.0, sectors, |_| 1.0), 1.0);
            let beta = rule.beta();
            check(mode(beta - 0.25, sectors, |_| beta - 1.0), 0.25);
            for wave in 1..=sectors / 2 {
                let value = match (wave, sectors) {
                    (1, _) => 0.5,
                    (2, _) => 0.25,
                    (3, 6) => 0.125,
                    (3, _) => 0.0625,
                    _ => 0.0,
                };
                check(mode(0.0, sectors, |angle| (wave as f64 * angle).cos()), value);
                check(mode(0.0, sectors, |angle| (wave as f64 * angle).sin()), value);
            }
        }
    }
}

#[test]
fn the_characteristic_net_halves() {
    for sectors in [6, 7, 12] {
        let circle = |radius: usize| -> Vec<Vec3> {
            let angle = |i: usize| TAU * i as f64 / sectors as f64;
            (0..sectors).map(|i| radius as f64 * Vec3::new(angle(i).cos(), angle(i).sin(), 0.0)).collect()
        };
        let net = PolarNet { pole: Vec3::ZERO, circles: (1..=4).map(circle).collect() };
        for rule in RULES {
            let next = net.refined(rule).unwrap();
            assert_eq!(next.circles.len(), 7);
            for (k, circle_after) in next.circles.iter().enumerate() {
                for (a, b) in circle_after.iter().zip(circle(k + 1)) {
                    assert!(a.distance(0.5 * b) < 1e-14);
                }
            }
            let [t1, t2] = net.tangents().unwrap();
            assert!(t1.distance(Vec3::new(1.0, 0.0, 0.0)) < 1e-14);
            assert!(t2.distance(Vec3::new(0.0, 1.0, 0.0)) < 1e-14);
        }
    }
}

#[test]
fn few_sectors_are_doubled_first() {
    for sectors in [3, 4, 5] {
        let net = net(sectors, 3);
        assert_eq!(net.refined(RadialRule::Half).unwrap_err().code(), "polar_too_few_sectors");
        let doubled = net.doubled().unwrap();
        assert_eq!(doubled.circles[2].len(), 2 * sectors);
        assert!(doubled.refined(RadialRule::Half).is_ok());
        for rule in RULES {
            assert!(net.limit(rule).unwrap().distance(doubled.limit(rule).unwrap()) < 1e-15);
        }
        let ([a, b], [c, d]) = (net.tangents().unwrap(), doubled.tangents().unwrap());
        let factor = c.length() / a.length();
        assert!((factor * a).distance(c) < 1e-14 && (factor * b).distance(d) < 1e-14);
    }
}

#[test]
fn limits_and_tangents_are_what_many_steps_come_to() {
    for sectors in [3, 4, 5, 6, 7, 8, 12, 20] {
        for rule in RULES {
            let mut net = net(sectors, 1);
            let limit = net.limit(rule).unwrap();
            if sectors < 6 {
                net = net.doubled().unwrap();
            }
            let [t1, t2] = net.tangents().unwrap();
            let mut near = net.clone();
            for _ in 0..24 {
                near = near.refined(rule).unwrap();
            }
            let n = near.circles[0].len();
            for (i, &point) in near.circles[0].iter().enumerate() {
                let (sine, cosine) = (TAU * i as f64 / n as f64).sin_cos();
                let direction = f64::from(1 << 24) * (point - limit);
                assert!(direction.distance(cosine * t1 + sine * t2) < 1e-6, "n = {sectors}, {rule:?}");
            }
            for _ in 24..60 {
                near = near.refined(rule).unwrap();
            }
            assert!(near.pole.distance(limit) < 1e-14, "n = {sectors}, {rule:?}");
        }
    }
}

fn fan(net: &PolarNet) -> ControlMesh {
    let (n, count) = (net.circles[0].len() as u32, net.circles.len() as u32);
    let mut points = vec![net.pole];
    points.extend(net.circles.iter().flatten());
    let id = |k: u32, i: u32| 1 + k * n + i % n;
    let mut faces = FaceList::new();
    (0..n).for_each(|i| faces.push(&[0, id(0, i), id(0, i + 1)]));
    for k in 1..count {
        (0..n).for_each(|i| faces.push(&[id(k - 1, i), id(k, i), id(k, i + 1), id(k - 1, i + 1)]));
    }
    ControlMesh::new(points, faces)
}

#[test]
fn circles_meet_the_refined_cage() {
    for sectors in [3, 5, 6, 8] {
        let net = net(sectors, 5);
        let mesh = fan(&net);
        let (mut level, mut points) = (Level::new(&mesh).unwrap(), mesh.points.clone());
        // The innermost circle that only regular rules have made, after one step and after two.
        for (steps, first) in [(1, 3), (2, 7)] {
            (level, points) = level.refine_points(&points);
            let polar = net.refined_with_cage(RadialRule::FiveEighths, steps).unwrap();
            assert_eq!(polar.circles[0].len(), sectors << steps);
            for circle in &polar.circles[first - 1..] {
                for point in circle {
                    let miss = points.iter().map(|p| p.distance(*point)).fold(f64::INFINITY, f64::min);
                    assert!(miss < 1e-13, "n = {sectors}, {steps} steps: {miss:e}");
                }
            }
        }
    }
}

#[test]
fn what_is_no_polar_net_is_refused() {
    let good = net(6, 3);
    let code = |net: &PolarNet| net.limit(RadialRule::Half).unwrap_err().code();
    assert_eq!(code(&PolarNet::default()), "polar_too_few_circles");
    assert_eq!(code(&net(2, 2)), "polar_too_few_sectors");
    let mut short = good;
    short.circles[2].pop();
    assert_eq!(code(&short), "polar_unequal_circles");
    assert_eq!(pair_pole(&[POLE; 2], &[POLE; 2]).unwrap_err().code(), "polar_slit");
    assert_eq!(pair_pole(&[POLE; 4], &[POLE; 8]).unwrap_err().code(), "polar_slit");
    assert_eq!(pair_pole(&[], &[]).unwrap_err().code(), "polar_slit");
}

/// The pole between two lenses is where the limit surface is, in the middle of the slit: at a vertex or on an edge.
#[test]
fn the_pole_of_a_pair_lies_on_the_limit_surface() {
    for edges in 2..=7_usize {
        let n = 2 * edges;
        let circles = circles(n, 0.3);
        let mut numbers = Numbers(edges as u64);
        let slit: Vec<Vec3> = (0..=edges)
            .map(|k| Vec3::new(1.0 - 2.0 * k as f64 / edges as f64, 0.0, 0.0) + 0.2 * numbers.point())
            .collect();
        let pole = pair_pole(&slit, &circles[0]).unwrap();
        let points: Vec<Vec3> = slit.iter().chain(circles.iter().flatten()).copied().collect();
        let id = |x: usize, y: usize| match y {
            0 => (x % n).min(n - x % n) as u32,
            _ => (edges + 1 + (y - 1) * n + x % n) as u32,
        };
        let quads = (0..3)
            .flat_map(|y| (0..n).map(move |x| [id(x, y), id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)]));
        let mesh = ControlMesh::new(points, quads.collect());
        let level = Level::new(&mesh).unwrap();
        let limit = if edges.is_multiple_of(2) {
            limit_vertices(&level, &mesh.points)[edges / 2].position
        } else {
            let table = PatchTable::new(&level);
            let middle = table.locate(FaceId((edges / 2) as u32), None, 0.5, 0.0).unwrap();
            LimitSurface::new(&table, &mesh.points).eval(middle).position
        };
        assert!(pole.distance(limit) < 1e-13, "m = {edges}: {:e}", pole.distance(limit));
    }
}
