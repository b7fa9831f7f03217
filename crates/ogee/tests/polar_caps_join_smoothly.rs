//! Polar caps are C2 in themselves, at the pole, and where they meet the limit surface around them; whatever the circles.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod poles;

use ogee::lens::{PolarCap, PolarFaces, PolarOperator, PolarVariant};
use ogee::{ControlMesh, FaceId, Level, LimitSurface, PatchTable, SurfaceJet, Vec3};
use poles::{Numbers, SECTORS, circles, faces};
use std::f64::consts::TAU;

const POLE: Vec3 = Vec3::new(0.1, -0.2, 0.3);

/// Circles reach from -3 to 3.
const SIZE: f64 = 6.0;

/// Of the size: joints.
const JOINT: f64 = 1e-12;

/// Of the size: the expansion at the pole, symmetry.
const EXACT: f64 = 1e-13;

fn cap_of(circles: &[Vec<Vec3>; 3], variant: PolarVariant) -> PolarCap {
    PolarCap::new(circles.each_ref().map(Vec::as_slice), POLE, variant).unwrap()
}

fn all_caps() -> impl Iterator<Item = (String, PolarCap, [Vec<Vec3>; 3])> {
    SECTORS.into_iter().flat_map(|sectors| {
        PolarVariant::ALL.map(|variant| {
            let circles = circles(sectors, 0.3);
            (format!("{}, n = {sectors}", variant.name()), cap_of(&circles, variant), circles)
        })
    })
}

fn parts(jet: &SurfaceJet) -> [Vec3; 6] {
    [jet.position, jet.du, jet.dv, jet.duu, jet.duv, jet.dvv]
}

fn assert_jets(a: &SurfaceJet, b: &SurfaceJet, tolerance: f64, what: &str) {
    for (k, (a, b)) in parts(a).into_iter().zip(parts(b)).enumerate() {
        assert!(a.distance(b) <= tolerance, "{what}: derivative {k} jumps by {:e}", a.distance(b));
    }
}

fn steps(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| f64::from(k) / f64::from(count))
}

/// Coordinates of the unit loop: the periodic cubic over the corners of a regular polygon.
fn unit(sectors: usize, sector: usize, s: f64) -> [f64; 2] {
    let basis = [
        (1.0 - s).powi(3),
        3.0 * s.powi(3) - 6.0 * s * s + 4.0,
        -3.0 * s.powi(3) + 3.0 * s * s + 3.0 * s + 1.0,
        s.powi(3),
    ];
    let angle = |k: usize| TAU * (sector + k + sectors - 1) as f64 / sectors as f64;
    let sum = |f: fn(f64) -> f64| (0..4).map(|k| basis[k] / 6.0 * f(angle(k))).sum();
    [sum(f64::cos), sum(f64::sin)]
}

#[test]
fn sectors_meet_with_two_derivatives() {
    for (what, cap, _) in all_caps() {
        let n = cap.sectors();
        for sector in 0..n {
            for radius in steps(12).map(|t| 2.0 * t) {
                let (before, after) = (cap.jet(sector, 1.0, radius), cap.jet((sector + 1) % n, 0.0, radius));
                assert_jets(&before, &after, JOINT * SIZE, &format!("{what}, after sector {sector}"));
            }
        }
    }
}

#[test]
fn central_patches_and_transitions_meet_with_two_derivatives() {
    for (what, cap, _) in all_caps() {
        if cap.variant() == PolarVariant::SixSix {
            continue;
        }
        for bands in faces(&cap, PolarFaces::PerSector).faces.chunks(2) {
            for s in steps(8) {
                let [inside, outside] = [0, 1].map(|k| bands[k].surface.jet(1.0, s));
                assert_jets(&inside, &outside, JOINT * SIZE, &what);
            }
        }
    }
}

#[test]
fn caps_meet_the_limit_surface_with_two_derivatives() {
    for (what, cap, circles) in all_caps() {
        let n = cap.sectors();
        let mut points = circles.concat();
        points.extend(circles[2].iter().map(|&p| 1.4 * p));
        // Outwards, then around: the parameters of the cap.
        let id = |k: usize, i: usize| (k * n + i % n) as u32;
        let quads = (0..3)
            .flat_map(|k| (0..n).map(move |i| [id(k, i), id(k + 1, i), id(k + 1, i + 1), id(k, i + 1)]));
        let mesh = ControlMesh::new(points, quads.collect());
        let table = PatchTable::new(&Level::new(&mesh).unwrap());
        let surface = LimitSurface::new(&table, &mesh.points);
        for sector in 0..n {
            for s in steps(4) {
                let face = FaceId((n + sector) as u32);
                let outside = surface.jet(table.locate(face, None, 0.0, s).unwrap());
                let inside = cap.jet(sector, s, 2.0);
                assert_jets(&inside, &outside.jet, JOINT * SIZE, &format!("{what}, sector {sector}"));
            }
        }
    }
}

#[test]
fn the_pole_has_a_quadratic_expansion() {
    for (what, cap, _) in all_caps() {
        let (n, pole) = (cap.sectors(), cap.pole());
        assert_eq!(pole.position, POLE);
        for sector in 0..n {
            for s in steps(8) {
                let ([x, y], jet) = (unit(n, sector, s), cap.jet(sector, s, 0.0));
                let linear = x * pole.du + y * pole.dv;
                let bend = x * x * pole.duu + 2.0 * x * y * pole.duv + y * y * pole.dvv;
                assert_eq!(jet.position, POLE);
                assert!(jet.du.distance(linear) <= EXACT * SIZE, "{what}: linear part");
                if cap.variant() != PolarVariant::FiveFive {
                    assert!(jet.duu.distance(bend) <= EXACT * SIZE, "{what}: quadratic part");
                }
            }
        }
    }
}

#[test]
fn degree_five_misses_the_expansion_by_what_the_method_page_says() {
    // Of the coefficients, for these numbers of sectors.
    for (sectors, most) in [(3, 5e-2), (4, 1e-2), (8, 7e-5), (12, 1e-5), (16, 2e-6)] {
        let cap = cap_of(&circles(sectors, 0.3), PolarVariant::FiveFive);
        let pole = cap.pole();
        let size = [pole.duu, pole.duv, pole.dvv].map(Vec3::length).into_iter().fold(0.0, f64::max);
        let mut miss = 0.0_f64;
        for (sector, s) in (0..sectors).flat_map(|sector| steps(16).map(move |s| (sector, s))) {
            let [x, y] = unit(sectors, sector, s);
            let bend = x * x * pole.duu + 2.0 * x * y * pole.duv + y * y * pole.dvv;
            miss = miss.max(cap.jet(sector, s, 0.0).duu.distance(bend) / size);
        }
        assert!(miss <= 2.0 * most && miss >= most / 10.0, "n = {sectors}: {miss:e}");
    }
}

/// How much mean curvature varies on a circle around the pole, relative to that at the pole.
fn spread(cap: &PolarCap, radius: f64) -> f64 {
    let places = (0..cap.sectors()).flat_map(|sector| steps(8).map(move |s| (sector, s)));
    let mean: Vec<f64> =
        places.map(|(sector, s)| cap.jet(sector, s, radius).curvature().unwrap().mean).collect();
    let [least, most] = [f64::min, f64::max].map(|f| mean.iter().copied().reduce(f).unwrap());
    (most - least) / cap.pole().curvature().unwrap().mean.abs()
}

#[test]
fn curvature_settles_in_proportion_to_the_radius() {
    for variant in PolarVariant::ALL {
        let cap = cap_of(&circles(8, 0.1), variant);
        let spreads = [1e-2, 1e-3, 1e-4].map(|radius| spread(&cap, radius));
        if variant == PolarVariant::FiveFive {
            // It comes to a stop: the expansion at the pole is not quite quadratic.
            assert!(spreads[2] > 0.5 * spreads[1] && spreads[2] < 1e-2, "{spreads:?}");
            continue;
        }
        for pair in spreads.windows(2) {
            assert!((pair[1] / pair[0] - 0.1).abs() < 0.01, "{}: {spreads:?}", variant.name());
        }
        // Curvature at the pole is what curvature around it comes to.
        let near = cap.jet(3, 0.4, 1e-5).curvature().unwrap();
        let pole = cap.pole().curvature().unwrap();
        for (a, b) in [(near.mean, pole.mean), (near.gauss, pole.gauss)] {
            assert!((a - b).abs() < 1e-3 * b.abs(), "{}: {a} is not {b}", variant.name());
        }
    }
}

#[test]
fn circles_that_are_turned_by_a_sector_give_the_same_cap_turned() {
    for (what, cap, mut circles) in all_caps() {
        circles.iter_mut().for_each(|circle| circle.rotate_left(1));
        let turned = cap_of(&circles, cap.variant());
        let n = cap.sectors();
        for sector in 0..n {
            for (s, radius) in [(0.0, 0.4), (0.3, 0.9), (0.8, 1.2), (0.5, 1.9)] {
                let (a, b) = (cap.jet((sector + 1) % n, s, radius), turned.jet(sector, s, radius));
                assert_jets(&a, &b, EXACT * SIZE, &what);
            }
        }
    }
}

#[test]
fn mirrored_circles_give_the_mirrored_cap() {
    let mirror = |p: Vec3| Vec3::new(p.x, -p.y, p.z);
    for (what, cap, circles) in all_caps() {
        let n = cap.sectors();
        let mirrored = circles
            .each_ref()
            .map(|circle| -> Vec<Vec3> { (0..n).map(|i| mirror(circle[(n - i) % n])).collect() });
        let other =
            PolarCap::new(mirrored.each_ref().map(Vec::as_slice), mirror(POLE), cap.variant()).unwrap();
        for sector in 0..n {
            for (s, radius) in [(0.0, 0.4), (0.3, 0.9), (0.8, 1.2), (0.5, 1.9)] {
                let (a, b) = (cap.jet(n - 1 - sector, 1.0 - s, radius), other.jet(sector, s, radius));
                for (a, b, sign) in [
                    (a.position, b.position, 1.0),
                    (a.du, b.du, 1.0),
                    (a.dv, b.dv, -1.0),
                    (a.duu, b.duu, 1.0),
                    (a.duv, b.duv, -1.0),
                    (a.dvv, b.dvv, 1.0),
                ] {
                    assert!(mirror(a).distance(sign * b) <= EXACT * SIZE, "{what}");
                }
            }
        }
    }
}

#[test]
fn affine_maps_of_the_circles_are_maps_of_the_cap() {
    let linear =
        |p: Vec3| Vec3::new(0.8 * p.x - 0.6 * p.y, 3.0 * (0.6 * p.x + 0.8 * p.y), 0.5 * p.x + 0.25 * p.z);
    let shift = Vec3::new(50.0, -20.0, 7.0);
    for (what, cap, circles) in all_caps() {
        let moved =
            circles.each_ref().map(|circle| circle.iter().map(|&p| linear(p) + shift).collect::<Vec<_>>());
        let pole = linear(POLE) + shift;
        let other = PolarCap::new(moved.each_ref().map(Vec::as_slice), pole, cap.variant()).unwrap();
        for sector in 0..cap.sectors() {
            for (s, radius) in [(0.2, 0.0), (0.0, 0.4), (0.8, 1.2), (0.5, 1.9)] {
                let (a, b) = (cap.jet(sector, s, radius), other.jet(sector, s, radius));
                for (k, (a, b)) in parts(&a).into_iter().zip(parts(&b)).enumerate() {
                    let image = if k == 0 { linear(a) + shift } else { linear(a) };
                    assert!(image.distance(b) <= 1e-11, "{what}: {:e}", image.distance(b));
                }
            }
        }
    }
}

#[test]
fn a_cap_far_away_keeps_its_digits() {
    // Coordinates of 24 bits stay what they are a million away.
    let rough = |p: Vec3| {
        let bits = |x: f64| (x * f64::from(1 << 24)).round() / f64::from(1 << 24);
        Vec3::new(bits(p.x), bits(p.y), bits(p.z))
    };
    let far = Vec3::new(f64::from(1 << 20), -f64::from(1 << 20), f64::from(1 << 19));
    let near = circles(8, 0.3).map(|circle| circle.into_iter().map(rough).collect::<Vec<_>>());
    let away = near.each_ref().map(|circle| circle.iter().map(|&p| p + far).collect::<Vec<_>>());
    for variant in PolarVariant::ALL {
        let pole = rough(POLE);
        let cap = PolarCap::new(near.each_ref().map(Vec::as_slice), pole, variant).unwrap();
        let other = PolarCap::new(away.each_ref().map(Vec::as_slice), pole + far, variant).unwrap();
        for radius in [1e-3, 0.5, 1.5] {
            let (a, b) = (cap.jet(2, 0.3, radius), other.jet(2, 0.3, radius));
            assert_eq!(parts(&a)[1..], parts(&b)[1..]);
            assert!((a.position + far).distance(b.position) < 1e-9);
        }
    }
}

#[test]
fn rows_of_operators_sum_to_one_or_zero() {
    for sectors in SECTORS {
        for variant in PolarVariant::ALL {
            let operator = PolarOperator::new(sectors, variant).unwrap();
            let weights = operator.weights();
            let rings = variant.unknown_rings() * sectors;
            assert_eq!((weights.rows(), weights.cols()), (rings + 5, 3 * sectors + 1));
            for i in 0..weights.rows() {
                let sum: f64 = weights.row(i).iter().sum();
                let wanted = if i < rings { 1.0 } else { 0.0 };
                assert!((sum - wanted).abs() < 1e-12, "{} n = {sectors}, row {i}: {sum}", variant.name());
            }
        }
    }
}

#[test]
fn flat_circles_give_their_plane_facing_their_side() {
    for sectors in SECTORS {
        for variant in PolarVariant::ALL {
            let circles = circles(sectors, 0.0)
                .map(|circle| circle.into_iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect::<Vec<_>>());
            let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), Vec3::ZERO, variant).unwrap();
            let up = Vec3::new(0.0, 0.0, 1.0);
            assert!(cap.pole().normal().unwrap().distance(up) < 1e-12);
            for sector in 0..sectors {
                for (s, radius) in [(0.0, 1e-3), (0.7, 0.4), (0.2, 1.2), (1.0, 2.0)] {
                    let jet = cap.jet(sector, s, radius);
                    assert!(jet.normal().unwrap().distance(up) < 1e-12, "{} n = {sectors}", variant.name());
                    assert!(jet.curvature().unwrap().mean.abs() < 1e-9);
                }
            }
        }
    }
}

#[test]
fn what_is_no_pole_is_refused() {
    let good = circles(6, 0.1);
    let code = |circles: &[Vec<Vec3>; 3], pole: Vec3| {
        let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), pole, PolarVariant::SixFive);
        cap.unwrap_err().code()
    };
    let mut short = good.clone();
    short[1].pop();
    assert_eq!(code(&short, POLE), "polar_unequal_circles");
    assert_eq!(code(&circles(2, 0.1), POLE), "polar_too_few_sectors");
    assert_eq!(code(&Default::default(), POLE), "polar_too_few_sectors");
    for bad in [f64::NAN, f64::INFINITY, 1e200, f64::MAX] {
        let mut wild = good.clone();
        wild[2][3].x = bad;
        assert_eq!(code(&wild, POLE), "polar_not_finite");
    }
    assert_eq!(code(&good, Vec3::new(f64::NAN, 0.0, 0.0)), "polar_not_finite");
    // On a line, and in a point.
    let mut numbers = Numbers(5);
    let direction = numbers.point();
    let line = good.each_ref().map(|circle| circle.iter().map(|p| p.x * direction).collect::<Vec<_>>());
    assert_eq!(code(&line, Vec3::ZERO), "polar_singular");
    assert_eq!(code(&good.each_ref().map(|circle| vec![POLE; circle.len()]), POLE), "polar_singular");

    let error =
        PolarCap::new(line.each_ref().map(Vec::as_slice), Vec3::ZERO, PolarVariant::SixSix).unwrap_err();
    let message = error.at(ogee::VertexId(7)).to_string();
    assert!(message.starts_with("the pole at vertex 7: it has no tangent plane"), "{message}");
}
