//! Bi-4 lenses: golden nets, joints, curvature that settles, and the quadratic expansion at the lens.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod lens_nets;

use golden::list;
use lens_nets::{document, exact, exact_points, mirrored};
use ogee::lens::{
    Biquartic, BiquarticSurface, Entry, MATRIX_DENOMINATOR, Quadrant, QuadraticExpansion, Symmetry,
    biquartic_matrix, degree_raising, lattice_index, lattice_point, refit_operator,
};
use ogee::nurbs::{KnotVector, NurbsSurface};
use ogee::{SurfaceJet, Vec3};
use proptest::prelude::*;
use serde_json::Value;

const ENTRIES: [Entry; 2] = [Entry::DegreeRaise, Entry::Refit];

fn sample_net() -> [Vec3; 25] {
    exact_points(&document("samples_lens")["net25"]).try_into().unwrap()
}

fn size(points: &[Vec3]) -> f64 {
    let low = points.iter().fold(points[0], |low, &p| low.min(p));
    points.iter().fold(0.0, |most: f64, &p| most.max(low.distance(p)))
}

fn worst(found: &[Vec3], wanted: &Value) -> f64 {
    let wanted = exact_points(wanted);
    assert_eq!(found.len(), wanted.len());
    found.iter().zip(&wanted).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

fn patch(net: &Biquartic, quadrant: Quadrant, cell: [usize; 2]) -> NurbsSurface {
    let found = net.ring_patches().into_iter().find(|p| p.quadrant == quadrant && p.cell == cell).unwrap();
    let knots = || KnotVector::from_multiplicities(4, [(0.0, 5), (1.0, 5)]);
    NurbsSurface { u: knots(), v: knots(), net: found.net }
}

/// The largest difference of positions and of derivatives up to the second.
fn difference(a: &SurfaceJet, b: &SurfaceJet) -> f64 {
    let pairs = [
        (a.position, b.position),
        (a.du, b.du),
        (a.dv, b.dv),
        (a.duu, b.duu),
        (a.duv, b.duv),
        (a.dvv, b.dvv),
    ];
    pairs.iter().map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// A jet in other parameters: `du` is the sum of `along_u[0] du` and `along_u[1] dv`, and so on.
fn turned(jet: &SurfaceJet, along_u: [f64; 2], along_v: [f64; 2]) -> SurfaceJet {
    let first = |[a, b]: [f64; 2]| a * jet.du + b * jet.dv;
    let second =
        |[a, b]: [f64; 2], [c, d]: [f64; 2]| a * c * jet.duu + (a * d + b * c) * jet.duv + b * d * jet.dvv;
    SurfaceJet {
        position: jet.position,
        du: first(along_u),
        dv: first(along_v),
        duu: second(along_u, along_u),
        duv: second(along_u, along_v),
        dvv: second(along_v, along_v),
    }
}

#[test]
fn nets_and_masks_are_those_of_the_samples() {
    let samples = document("samples_lens");
    let net = sample_net();
    let tolerance = 1e-12 * size(&net);
    for (entry, ring, step, masks) in [
        (Entry::DegreeRaise, "bi4_raised60", "bi4_raised60_step1", "bi4_raised_masks"),
        (Entry::Refit, "fig10_ring60", "fig10_ring60_step1", "fig10_masks"),
    ] {
        let bi4 = Biquartic::from_bicubic(&net, entry);
        assert!(worst(&bi4.points, &samples[ring]) < tolerance);
        assert!(worst(&bi4.step().points, &samples[step]) < tolerance);
        let QuadraticExpansion { position, first: [d1, d2], second: [d11, d12, d22] } = bi4.expansion();
        for (found, name) in
            [position, d1, d2, d11, d12, d22].into_iter().zip(["1", "f1", "f2", "f1f1", "f1f2", "f2f2"])
        {
            let wanted = [0, 1, 2].map(|k| exact(&samples[masks][name][k]));
            assert!(found.distance(Vec3::from(wanted)) < tolerance, "{entry:?} {name}");
        }
    }
    let raised = Biquartic::from_bicubic(&net, Entry::DegreeRaise);
    let wanted = &samples["bi4_raised_patch_q0_10"];
    let flat: Vec<Value> = match wanted[0][0].is_array() {
        true => list(wanted).iter().flat_map(|row| list(row).to_vec()).collect(),
        false => list(wanted).to_vec(),
    };
    let found = patch(&raised, Quadrant::First, [1, 0]).net;
    assert!(worst(found.cells(), &Value::Array(flat)) < tolerance);
}

#[test]
fn the_refit_operator_is_the_least_squares_solution() {
    let golden = document("remesh_fig10");
    let operator = refit_operator();
    let (matrix, raising) = (biquartic_matrix(), degree_raising());
    let weight = |row: &[(usize, i64)], number: usize, below: i64| {
        row.iter().find(|term| term.0 == number).map_or(0.0, |term| term.1 as f64 / below as f64)
    };
    let step = |k: usize, j: usize| weight(&matrix[12 + k], j + 1, MATRIX_DENOMINATOR);
    for (k, rows) in (0..48).zip(list(&golden["D_numerators"])) {
        assert_eq!(weight(&raising[12 + k], 0, 144), 0.0, "the lens vertex has no influence");
        for (j, numerator) in list(rows).iter().enumerate() {
            assert_eq!(weight(&raising[12 + k], j + 1, 1), exact(numerator));
        }
    }
    for i in 0..24 {
        assert!((operator.row(i).iter().sum::<f64>() - 1.0).abs() < 1e-13);
        for j in 0..24 {
            let residual: f64 = (0..48)
                .map(|k| {
                    let product: f64 = (0..24).map(|l| step(k, l) * operator[(l, j)]).sum();
                    step(k, i) * (product - weight(&raising[12 + k], j + 1, 144))
                })
                .sum();
            assert!(residual.abs() < 1e-12, "normal equation ({i}, {j}): {residual:e}");
        }
    }
    for (i, row) in list(&golden["Q_float"]).iter().enumerate() {
        for (j, wanted) in list(row).iter().enumerate() {
            assert!((operator[(i, j)] - exact(wanted)).abs() < 1e-12, "Q({i}, {j})");
        }
    }
    assert_eq!((list(&golden["Q_float"]).len(), list(&golden["ring_float"]).len()), (24, 60));
    // The ring's operator, column by column.
    for column in 0..24 {
        let net = std::array::from_fn(|k| Vec3::new(f64::from(u8::from(k == column + 1)), 0.0, 0.0));
        let ring = Biquartic::from_bicubic(&net, Entry::Refit);
        for (row, point) in list(&golden["ring_float"]).iter().zip(&ring.points) {
            assert!((point.x - exact(&row[column])).abs() < 1e-12);
        }
    }
}

/// `z = w^2` and a linear map of it, on a bi-3 net.
fn characteristic_net() -> [Vec3; 25] {
    std::array::from_fn(|k| {
        let (i, j) = lattice_point(k);
        Vec3::new(f64::from(i * i - j * j), f64::from(2 * i * j), 0.0)
    })
}

#[test]
fn both_entries_reproduce_the_square() {
    let nets = ENTRIES.map(|entry| Biquartic::from_bicubic(&characteristic_net(), entry));
    for (a, b) in nets[0].points.iter().zip(&nets[1].points) {
        assert!(a.distance(*b) < 1e-12);
    }
    for net in nets {
        let expansion = net.expansion();
        assert!(expansion.position.length() < 1e-12);
        for (found, wanted) in
            [(expansion.first[0], Vec3::new(1.0, 0.0, 0.0)), (expansion.first[1], Vec3::new(0.0, 1.0, 0.0))]
        {
            assert!(found.distance(wanted) < 1e-12);
        }
        let surface = BiquarticSurface::new(&net);
        for (quadrant, sign) in [(Quadrant::First, 1.0), (Quadrant::Second, -1.0)] {
            for (u, v) in [(2.0, 0.3), (0.7, 1.4), (0.3, 0.01), (0.001, 0.0007), (1e-9, 0.0)] {
                let jet = surface.jet(quadrant, u, v);
                let wanted = SurfaceJet {
                    position: sign * Vec3::new(u * u - v * v, 2.0 * u * v, 0.0),
                    du: sign * Vec3::new(2.0 * u, 2.0 * v, 0.0),
                    dv: sign * Vec3::new(-2.0 * v, 2.0 * u, 0.0),
                    duu: sign * Vec3::new(2.0, 0.0, 0.0),
                    duv: sign * Vec3::new(0.0, 2.0, 0.0),
                    dvv: sign * Vec3::new(-2.0, 0.0, 0.0),
                };
                assert!(jet.position.distance(wanted.position) < 1e-14 * 10.0);
                assert!(difference(&jet, &wanted) < 1e-8, "({u}, {v}): {:e}", difference(&jet, &wanted));
            }
        }
    }
}

#[test]
fn steps_lead_to_the_limit_point() {
    let net = Biquartic::from_bicubic(&sample_net(), Entry::DegreeRaise);
    let limit = net.expansion().position;
    let last = (0..12).fold(net, |net, _| net.step());
    for point in last.points {
        assert!(point.distance(limit) < 1e-6 * size(&sample_net()));
    }
}

#[test]
fn joints_of_rings_and_quadrants_are_of_second_order() {
    let tolerance = 1e-12 * size(&sample_net());
    for entry in ENTRIES {
        let mut net = Biquartic::from_bicubic(&sample_net(), entry);
        for _ in 0..4 {
            let next = net.step();
            for quadrant in Quadrant::BOTH {
                let other = if quadrant == Quadrant::First { Quadrant::Second } else { Quadrant::First };
                let [beside, corner, above] =
                    [[1, 0], [1, 1], [0, 1]].map(|cell| patch(&net, quadrant, cell));
                let [inner_beside, inner_corner, inner_above] =
                    [[1, 0], [1, 1], [0, 1]].map(|cell| patch(&next, quadrant, cell));
                let beyond = patch(&net, other, [1, 0]);
                let halved = |jet: &SurfaceJet| turned(jet, [2.0, 0.0], [0.0, 2.0]);
                for t in (0..=16).map(|k| f64::from(k) / 16.0) {
                    let joints = [
                        (beside.jet(t, 1.0), corner.jet(t, 0.0)),
                        (corner.jet(0.0, t), above.jet(1.0, t)),
                        // From the next quadrant, which is turned by 90 degrees: its u is this one's v.
                        (above.jet(0.0, t), turned(&beyond.jet(t, 0.0), [0.0, -1.0], [1.0, 0.0])),
                        (beside.jet(0.0, t / 2.0), halved(&inner_beside.jet(1.0, t))),
                        (beside.jet(0.0, 0.5 + t / 2.0), halved(&inner_corner.jet(1.0, t))),
                        (above.jet(t / 2.0, 0.0), halved(&inner_above.jet(t, 1.0))),
                        (above.jet(0.5 + t / 2.0, 0.0), halved(&inner_corner.jet(t, 1.0))),
                    ];
                    for (k, (a, b)) in joints.iter().enumerate() {
                        assert!(difference(a, b) < tolerance, "joint {k} at {t}: {:e}", difference(a, b));
                    }
                }
            }
            net = next;
        }
    }
}

/// The bicubic spline of an even function on the grid.
fn bicubic(net: &[Vec3; 25], quadrant: Quadrant, [a, b]: [i32; 2], s: f64, t: f64) -> SurfaceJet {
    let basis = |x: f64| {
        let y = 1.0 - x;
        [
            [
                y * y * y / 6.0,
                (3.0 * x * x * x - 6.0 * x * x + 4.0) / 6.0,
                (3.0 * y * y * y - 6.0 * y * y + 4.0) / 6.0,
                x * x * x / 6.0,
            ],
            [-y * y / 2.0, (3.0 * x * x - 4.0 * x) / 2.0, -(3.0 * y * y - 4.0 * y) / 2.0, x * x / 2.0],
            [y, 3.0 * x - 2.0, 3.0 * y - 2.0, x],
        ]
    };
    let (along_u, along_v) = (basis(s), basis(t));
    let sum = |p: usize, q: usize| {
        let places = (0..4).flat_map(|k| (0..4).map(move |l| (k, l)));
        places.fold(Vec3::ZERO, |sum, (k, l)| {
            let (i, j) = quadrant.point(a + k as i32 - 1, b + l as i32 - 1);
            sum + along_u[p][k] * along_v[q][l] * net[lattice_index(i, j)]
        })
    };
    SurfaceJet {
        position: sum(0, 0),
        du: sum(1, 0),
        dv: sum(0, 1),
        duu: sum(2, 0),
        duv: sum(1, 1),
        dvv: sum(0, 2),
    }
}

#[test]
fn the_surface_outside_is_met_to_second_order() {
    let net = sample_net();
    let tolerance = 1e-12 * size(&net);
    let [raised, refit] = ENTRIES.map(|entry| Biquartic::from_bicubic(&net, entry));
    let mut moved: f64 = 0.0;
    for quadrant in Quadrant::BOTH {
        for cell in [[1, 0], [1, 1], [0, 1]] {
            let (plain, fair) = (patch(&raised, quadrant, cell), patch(&refit, quadrant, cell));
            let [a, b] = cell.map(|x| x as i32);
            for (s, t) in (0..5).flat_map(|i| (0..5).map(move |j| (f64::from(i) / 4.0, f64::from(j) / 4.0))) {
                let outside = bicubic(&net, quadrant, [a, b], s, t);
                assert!(difference(&plain.jet(s, t), &outside) < tolerance);
                if (a == 1 && s == 1.0) || (b == 1 && t == 1.0) {
                    assert!(difference(&fair.jet(s, t), &outside) < tolerance);
                }
                moved = moved.max(fair.jet(s, t).position.distance(outside.position));
            }
        }
    }
    assert!(moved > 1e-4 * size(&net), "the inside is another one");
}

#[test]
fn mean_curvature_settles_at_that_of_the_masks() {
    let mut net = Biquartic::from_bicubic(&sample_net(), Entry::DegreeRaise);
    let limit = net.expansion().jet().curvature().unwrap();
    assert!((limit.mean.abs() - 0.012002538).abs() < 1e-8, "{}", limit.mean);
    for (ring, wanted) in [(0, None), (4, Some(8.2e-2)), (6, Some(6.3e-3)), (8, Some(5.2e-4))] {
        let wanted: Option<f64> = wanted;
        let at = (0..ring).fold(net.clone(), |net, _| net.step());
        let patches =
            Quadrant::BOTH.into_iter().flat_map(|q| [[1, 0], [1, 1], [0, 1]].map(|cell| patch(&at, q, cell)));
        let mean: Vec<f64> = patches
            .flat_map(|patch| {
                (0..81).map(move |k| {
                    let jet = patch.jet(f64::from(k / 9) / 8.0, f64::from(k % 9) / 8.0);
                    jet.curvature().unwrap().mean
                })
            })
            .collect();
        let (low, high) =
            mean.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
        let spread = (high - low) / ((high + low) / 2.0).abs();
        if let Some(wanted) = wanted {
            assert!((spread / wanted - 1.0).abs() < 0.05, "ring {ring}: {spread:e}, not {wanted:e}");
        }
    }
    net = net.step();
    let again = net.expansion().jet().curvature().unwrap();
    assert!((again.mean / limit.mean - 1.0).abs() < 1e-10, "one step changes parameters, not curvature");
}

#[test]
fn evaluation_is_one_surface() {
    for entry in ENTRIES {
        let net = Biquartic::from_bicubic(&sample_net(), entry);
        let surface = BiquarticSurface::new(&net);
        let size = size(&sample_net());
        for quadrant in Quadrant::BOTH {
            // Derivatives are those of positions.
            for (u, v) in [(1.3, 0.4), (0.9, 0.95), (0.4, 1.9), (0.2, 0.03), (0.011, 0.013)] {
                let h = 1e-5 * f64::max(u, v);
                let at = |du: f64, dv: f64| surface.jet(quadrant, u + du, v + dv);
                let jet = at(0.0, 0.0);
                let slope = |a: Vec3, b: Vec3| (a - b) / (2.0 * h);
                for (found, wanted) in [
                    (slope(at(h, 0.0).position, at(-h, 0.0).position), jet.du),
                    (slope(at(0.0, h).position, at(0.0, -h).position), jet.dv),
                    (slope(at(h, 0.0).du, at(-h, 0.0).du), jet.duu),
                    (slope(at(0.0, h).du, at(0.0, -h).du), jet.duv),
                    (slope(at(0.0, h).dv, at(0.0, -h).dv), jet.dvv),
                ] {
                    assert!(found.distance(wanted) < 1e-6 * size, "{quadrant:?} ({u}, {v})");
                }
            }
            // The expansion takes over without a step: at the outline of the eighth ring both are at hand.
            let edge = 2.0_f64.powi(-6);
            for t in [0.0, 0.3, 0.8, 1.0] {
                for (u, v) in [(edge, t * edge), (t * edge, edge)] {
                    let (outer, inner) = (
                        surface.jet(quadrant, u, v),
                        surface.jet(quadrant, u * (1.0 - 1e-12), v * (1.0 - 1e-12)),
                    );
                    assert!(outer.position.distance(inner.position) < 1e-10 * size);
                    assert!(outer.normal().unwrap().angle(inner.normal().unwrap()) < 1e-6);
                    let curvatures = [outer, inner].map(|jet| jet.curvature().unwrap().mean);
                    assert!((curvatures[0] / curvatures[1] - 1.0).abs() < 1e-2);
                }
            }
            // At the lens derivatives vanish, and the expansion says what there is.
            let centre = surface.jet(quadrant, 0.0, 0.0);
            assert_eq!(centre.position, surface.expansion().position);
            assert_eq!((centre.du, centre.dv), (Vec3::ZERO, Vec3::ZERO));
        }
        assert!(surface.expansion().jet().normal().is_some());
    }
}

#[test]
fn symmetric_nets_stay_symmetric() {
    for symmetry in [Symmetry::Rotation, Symmetry::MirrorX, Symmetry::MirrorY] {
        let net = sample_net();
        let net = std::array::from_fn(|k| (net[k] + mirrored(symmetry, net[symmetry.image(k)])) / 2.0);
        for entry in ENTRIES {
            let mut bi4 = Biquartic::from_bicubic(&net, entry);
            for _ in 0..3 {
                for number in 1..=60 {
                    let image = mirrored(symmetry, bi4.point(symmetry.image(number)));
                    assert!(image.distance(bi4.point(number)) < 1e-13 * size(&net), "{entry:?} {symmetry:?}");
                }
                bi4 = bi4.step();
            }
        }
    }
}

#[test]
fn a_singular_lens_has_a_point_but_no_normal() {
    let flat = characteristic_net().map(|p| Vec3::new(p.x, 0.0, 3.0));
    for entry in ENTRIES {
        let surface = BiquarticSurface::new(&Biquartic::from_bicubic(&flat, entry));
        assert!(surface.expansion().position.distance(Vec3::new(0.0, 0.0, 3.0)) < 1e-12);
        assert_eq!(surface.expansion().jet().normal(), None);
        assert!(surface.expansion().jet().curvature().is_none());
    }
}

proptest! {
    #[test]
    fn bi4_surfaces_are_affine_invariant(
        coordinates in prop::collection::vec(-10.0..10.0, 75),
        matrix in prop::array::uniform9(-2.0..2.0_f64),
        shift in prop::array::uniform3(-50.0..50.0_f64),
        u in 0.0..2.0_f64,
        v in 0.0..2.0_f64,
    ) {
        let net: [Vec3; 25] = std::array::from_fn(|k| {
            Vec3::new(coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2])
        });
        let [a, b, c] = [0, 3, 6].map(|k| Vec3::new(matrix[k], matrix[k + 1], matrix[k + 2]));
        let linear = |p: Vec3| Vec3::new(a.dot(p), b.dot(p), c.dot(p));
        let moved = |p: Vec3| linear(p) + Vec3::from(shift);
        for entry in ENTRIES {
            let before = BiquarticSurface::new(&Biquartic::from_bicubic(&net, entry));
            let after = BiquarticSurface::new(&Biquartic::from_bicubic(&net.map(moved), entry));
            for quadrant in Quadrant::BOTH {
                let (p, q) = (before.jet(quadrant, u, v), after.jet(quadrant, u, v));
                prop_assert!(moved(p.position).distance(q.position) < 1e-11);
                prop_assert!(linear(p.du).distance(q.du) < 1e-10);
                prop_assert!(linear(p.duv).distance(q.duv) < 1e-9);
            }
            let (p, q) = (before.expansion(), after.expansion());
            prop_assert!(moved(p.position).distance(q.position) < 1e-11);
            prop_assert!(linear(p.second[1]).distance(q.second[1]) < 1e-10);
        }
    }
}
