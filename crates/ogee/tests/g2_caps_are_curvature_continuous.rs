//! G2 caps keep their promises: the weights fulfil the conditions, and caps of any points join with equal curvature, inside,
//! to the surface around them, and to boundaries (`docs/methods/g2_caps.md`, sections 3 and 12).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;
mod cap_fans;

use cages::noise;
use cap_fans::{Fan, angle, uniform_cubic};
use ogee::g2_caps::{CapClass, Weights, encode, knots, nets, shipped_classes, table_name, weights};
use ogee::nurbs::{NurbsCurve, NurbsSurface};
use ogee::{SurfaceJet, Vec3};

fn sectors(weights: &Weights, points: &[Vec3]) -> Vec<NurbsSurface> {
    nets(weights, points).into_iter().map(|net| NurbsSurface { u: knots(), v: knots(), net }).collect()
}

/// The edges with a sector on both sides along which the cap is smooth, each with the sectors after and before it.
fn smooth_edges(class: CapClass) -> impl Iterator<Item = (usize, usize)> {
    let count = class.sectors();
    let first = usize::from(!matches!(class, CapClass::Interior { .. }));
    (first..count).map(move |edge| (edge, (edge + count - 1) % count))
}

/// How much the parameters turn across an edge.
fn turning(class: CapClass, t: f64) -> f64 {
    let alpha = 2.0 * (1.0 - t).powi(3) - (1.0 - 2.0 * t).max(0.0).powi(3);
    2.0 * angle(class).cos() * alpha
}

const PARAMETERS: usize = 29;

fn parameters() -> impl Iterator<Item = f64> {
    (0..PARAMETERS).map(|k| k as f64 / (PARAMETERS - 1) as f64)
}

fn size(points: &[Vec3]) -> f64 {
    let low = points.iter().fold(points[0], |low, &p| low.min(p));
    points.iter().fold(low, |high, &p| high.max(p)).distance(low)
}

fn shaken_fan(class: CapClass, seed: u64) -> Fan {
    let mut next = noise(seed);
    // 12 percent of the edge length to both sides.
    Fan::natural(class).map(|p| p + 0.24 * Vec3::new(next(), next(), next()))
}

/// The three conditions at an edge, of the surfaces after it and before it at `t`.
fn residuals(after: &SurfaceJet, before: &SurfaceJet, a: f64) -> [Vec3; 3] {
    [
        after.position - before.position,
        after.dv + before.du - a * after.du,
        after.dvv - before.duu - a * (after.duv - before.duv),
    ]
}

#[test]
fn weights_fulfil_the_conditions() {
    for class in shipped_classes() {
        let weights = weights(class).unwrap();
        // Three columns at a time, one to a coordinate; sums of absolute values over all columns, by edge and parameter.
        let edges: Vec<(usize, usize)> = smooth_edges(class).collect();
        let mut sums = vec![[0.0; 3]; edges.len() * PARAMETERS];
        let mut at_crease = [0.0; 3];
        for first in (0..class.columns()).step_by(3) {
            let unit = |column: usize| {
                let one = |k: usize| if column == first + k { 1.0 } else { 0.0 };
                Vec3::new(one(0), one(1), one(2))
            };
            let points: Vec<Vec3> = (0..class.columns()).map(unit).collect();
            let sectors = sectors(&weights, &points);
            let add = |sums: &mut [f64; 3], residuals: [Vec3; 3]| {
                for (sum, r) in sums.iter_mut().zip(residuals) {
                    *sum += r.x.abs() + r.y.abs() + r.z.abs();
                }
            };
            for (number, &(after, before)) in edges.iter().enumerate() {
                for (k, t) in parameters().enumerate() {
                    let jets = [sectors[after].jet(t, 0.0), sectors[before].jet(0.0, t)];
                    add(&mut sums[number * PARAMETERS + k], residuals(&jets[0], &jets[1], turning(class, t)));
                }
            }
            if let CapClass::Dart { .. } = class {
                let (a, last) = (turning(class, 0.0), sectors.len() - 1);
                let (after, before) = (sectors[0].jet(0.0, 0.0), sectors[last].jet(0.0, 0.0));
                let [_, first, second] = residuals(&after, &before, a);
                add(&mut at_crease, [first, after.duv + before.duv - a * after.duu, second]);
            }
        }
        let worst = |k: usize| sums.iter().map(|sum| sum[k]).fold(0.0, f64::max);
        let worst = [worst(0), worst(1), worst(2)];
        println!("{class:?}: {worst:?} at the crease {at_crease:?}");
        assert!(worst[0] <= 5e-15 && worst[1] <= 1e-13 && worst[2] <= 3e-12, "{class:?}: {worst:?}");
        assert!(at_crease.iter().all(|&r| r <= 3e-12), "{class:?}: {at_crease:?}");
    }
}

#[test]
fn both_sides_of_an_edge_agree_before_they_are_made_equal() {
    for class in shipped_classes() {
        let weights = weights(class).unwrap();
        for (after, before) in smooth_edges(class) {
            let differences: Vec<Vec<f64>> = (0..10)
                .map(|j| {
                    let (own, mut other) = match class {
                        CapClass::Interior { .. } => (weights.row(0, j, 0), weights.row(0, 0, j).to_vec()),
                        _ => (weights.row(after, j, 0), weights.row(before, 0, j).to_vec()),
                    };
                    if let CapClass::Interior { .. } = class {
                        // The sector before has its own points in front.
                        other[1..].rotate_left(6);
                    }
                    own.iter().zip(&other).map(|(a, b)| a - b).collect()
                })
                .collect();
            let gap = |column: usize, t: f64| {
                let coefficient = |j: usize| differences.get(j).map_or(0.0, |row| row[column]);
                let points = (0..13).map(|j| Vec3::new(coefficient(j), 0.0, 0.0)).collect();
                NurbsCurve { knots: knots(), points }.point(t).x.abs()
            };
            for t in parameters() {
                let sum: f64 = (0..class.columns()).map(|column| gap(column, t)).sum();
                assert!(sum <= 5e-15, "{class:?}: {sum:e}");
            }
        }
    }
}

#[test]
fn weights_sum_to_one() {
    for class in shipped_classes() {
        let weights = weights(class).unwrap();
        for sector in &weights.sectors {
            for row in (0..sector.rows()).map(|row| sector.row(row)) {
                assert!((row.iter().sum::<f64>() - 1.0).abs() <= 1e-14, "{class:?}");
            }
        }
    }
}

/// The embedded shape operator: a matrix that maps a vector to minus the change of the normal along it.
fn shape_operator(jet: &SurfaceJet) -> [Vec3; 3] {
    let [nu, nv] = jet.normal_derivatives().unwrap();
    let (e, f, g) = (jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv));
    let determinant = e * g - f * f;
    let dual_u = (g * jet.du - f * jet.dv) / determinant;
    let dual_v = (e * jet.dv - f * jet.du) / determinant;
    std::array::from_fn(|k| -(dual_u[k] * nu + dual_v[k] * nv))
}

fn norm(columns: &[Vec3; 3]) -> f64 {
    columns.iter().map(|c| c.dot(*c)).sum::<f64>().sqrt()
}

/// What two jets at the same place disagree in, over what is allowed: position, normal, shape operator.
fn disagreement(a: &SurfaceJet, b: &SurfaceJet, size: f64) -> [f64; 3] {
    let (s, t) = (shape_operator(a), shape_operator(b));
    let peak = norm(&s).max(norm(&t));
    let difference: [Vec3; 3] = std::array::from_fn(|k| s[k] - t[k]);
    let sine = a.normal().unwrap().cross(b.normal().unwrap()).length();
    [
        a.position.distance(b.position) / size / 1e-12,
        sine / 1e-10,
        norm(&difference) * size / (1e-9 * (peak * size).max(1.0)),
    ]
}

/// The worst disagreement along all smooth edges and around the vertex.
fn joints(weights: &Weights, points: &[Vec3]) -> [f64; 3] {
    let (sectors, size) = (sectors(weights, points), size(points));
    let mut worst = [0.0; 3];
    let mut see = |a: &SurfaceJet, b: &SurfaceJet| {
        for (worst, found) in worst.iter_mut().zip(disagreement(a, b, size)) {
            *worst = found.max(*worst);
        }
    };
    for (after, before) in smooth_edges(weights.class) {
        for t in parameters() {
            see(&sectors[after].jet(t, 0.0), &sectors[before].jet(0.0, t));
        }
    }
    for sector in &sectors[1..] {
        see(&sectors[0].jet(0.0, 0.0), &sector.jet(0.0, 0.0));
    }
    worst
}

#[test]
fn sectors_join_with_equal_curvature() {
    for class in shipped_classes() {
        let weights = weights(class).unwrap();
        for seed in 0..4 {
            let worst = joints(&weights, &shaken_fan(class, seed).columns());
            println!("{class:?}: {worst:?} of what is allowed");
            assert!(worst.iter().all(|&share| share <= 1.0), "{class:?}: {worst:?}");
        }
    }
}

#[test]
fn a_weight_that_is_a_little_wrong_is_seen() {
    for class in shipped_classes() {
        let mut weights = (*weights(class).unwrap()).clone();
        // Beside the first edge of the last sector there is, which is smooth.
        let last = weights.sectors.len() - 1;
        let points = shaken_fan(class, 1).columns();
        weights.sectors[last][(10 * 2 + 1, 1)] += 1e-8;
        let worst = joints(&weights, &points);
        assert!(worst[1].max(worst[2]) > 1.0, "{class:?}: {worst:?}");
    }
}

/// Position and derivatives of the bicubic with given points, whose cell is that of a sector.
fn bicubic(node: impl Fn(i32, i32) -> Vec3, u: f64, v: f64) -> SurfaceJet {
    let (along_u, along_v) = (uniform_cubic(u), uniform_cubic(v));
    let sum = |p: usize, q: usize| {
        let mut out = Vec3::ZERO;
        for (i, a) in along_u[p].iter().enumerate() {
            for (j, b) in along_v[q].iter().enumerate() {
                if a * b != 0.0 {
                    out += a * b * node(i as i32 - 1, j as i32 - 1);
                }
            }
        }
        out
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

fn jet_difference(a: &SurfaceJet, b: &SurfaceJet) -> f64 {
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

#[test]
fn borders_continue_the_surface_around() {
    for class in shipped_classes() {
        let fan = shaken_fan(class, 5);
        let points = fan.columns();
        let mut worst: f64 = 0.0;
        for (sector, surface) in sectors(&weights(class).unwrap(), &points).iter().enumerate() {
            for t in parameters() {
                for (u, v) in [(1.0, t), (t, 1.0)] {
                    let around = bicubic(|i, j| fan.node(sector, i, j), u, v);
                    worst = worst.max(jet_difference(&surface.jet(u, v), &around));
                }
            }
        }
        println!("{class:?}: {worst:e}");
        assert!(worst <= 1e-10, "{class:?}: {worst:e}");
    }
}

#[test]
fn boundaries_are_those_of_catmull_and_clark() {
    for class in shipped_classes() {
        let fan = shaken_fan(class, 6);
        let (first, last) = (fan.edges[0], fan.edges[class.edges() - 1]);
        let [before_first, before_last] = match class {
            CapClass::Interior { .. } | CapClass::Dart { .. } => continue,
            CapClass::Boundary { .. } => [last[0], first[0]],
            CapClass::Corner { .. } => [first, last].map(|edge| 2.0 * fan.vertex - edge[0]),
        };
        let sectors = sectors(&weights(class).unwrap(), &fan.columns());
        for t in parameters() {
            let curve = |before: Vec3, edge: [Vec3; 2]| {
                let points = [before, fan.vertex, edge[0], edge[1]];
                uniform_cubic(t)[0].iter().zip(points).fold(Vec3::ZERO, |sum, (&w, p)| sum + w * p)
            };
            let found = [sectors[0].jet(t, 0.0), sectors[class.sectors() - 1].jet(0.0, t)];
            assert!(found[0].position.distance(curve(before_first, first)) <= 1e-13, "{class:?}");
            assert!(found[1].position.distance(curve(before_last, last)) <= 1e-13, "{class:?}");
        }
    }
}

#[test]
fn shared_coefficients_are_the_same_bit_for_bit() {
    for class in shipped_classes() {
        let nets = nets(&weights(class).unwrap(), &shaken_fan(class, 8).columns());
        let crease = matches!(class, CapClass::Dart { .. }).then_some((0, class.sectors() - 1));
        for (after, before) in smooth_edges(class).chain(crease) {
            assert!((0..13).all(|j| nets[after][(j, 0)] == nets[before][(0, j)]), "{class:?}");
        }
        assert!(nets.iter().all(|net| net[(0, 0)] == nets[0][(0, 0)]), "{class:?}");
    }
}

#[test]
fn caps_are_affine_invariant() {
    let map = |p: Vec3| Vec3::new(2.0 * p.x - p.y + 3.0, 0.5 * p.y + p.z - 1.0, p.x + p.y - 0.3 * p.z + 2.0);
    for class in shipped_classes() {
        let weights = weights(class).unwrap();
        let fan = shaken_fan(class, 9);
        let (before, after) = (nets(&weights, &fan.columns()), nets(&weights, &fan.map(map).columns()));
        for (before, after) in before.iter().zip(&after) {
            for (p, q) in before.cells().iter().zip(after.cells()) {
                assert!(map(*p).distance(*q) <= 1e-13, "{class:?}: {:e}", map(*p).distance(*q));
            }
        }
    }
}

#[test]
fn mirrored_and_turned_points_give_the_same_cap() {
    for class in shipped_classes() {
        let weights = weights(class).unwrap();
        let fan = shaken_fan(class, 10);
        let found = nets(&weights, &fan.columns());
        let mirrored = nets(&weights, &fan.mirrored().columns());
        for (sector, net) in found.iter().enumerate() {
            let image = mirrored[class.sectors() - 1 - sector].transposed();
            let far = net.cells().iter().zip(image.cells()).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
            assert!(far <= 1e-14, "{class:?}: {far:e}");
        }
        if let CapClass::Interior { .. } = class {
            let turned = nets(&weights, &fan.turned(2).columns());
            for (sector, net) in turned.iter().enumerate() {
                let own = &found[(sector + 2) % class.sectors()];
                let far =
                    net.cells().iter().zip(own.cells()).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
                assert!(far <= 1e-14, "{class:?}: {far:e}");
            }
        }
    }
}

#[test]
fn the_natural_configuration_stays_flat_and_regular() {
    for class in shipped_classes() {
        for surface in sectors(&weights(class).unwrap(), &Fan::natural(class).columns()) {
            for (u, v) in parameters().flat_map(|u| parameters().map(move |v| (u, v))) {
                let jet = surface.jet(u, v);
                assert!(jet.position.z == 0.0 && jet.du.cross(jet.dv).z > 0.0, "{class:?} at {u}, {v}");
            }
        }
    }
}

#[test]
fn tables_are_small_and_made_again_from_their_weights() {
    let mut total = 0;
    for class in shipped_classes() {
        let file = format!("{}/src/g2_caps/tables/{}.bin", env!("CARGO_MANIFEST_DIR"), table_name(class));
        let table = std::fs::read(file).unwrap();
        assert!(encode(&weights(class).unwrap()) == table, "{class:?}");
        total += table.len();
    }
    println!("{total} bytes");
    assert!(total < 600_000);
}

#[test]
fn regular_vertices_have_no_weights() {
    for class in [
        CapClass::Interior { valence: 0 },
        CapClass::Interior { valence: 2 },
        CapClass::Interior { valence: 4 },
        CapClass::Interior { valence: u32::MAX },
        CapClass::Boundary { faces: 1 },
        CapClass::Boundary { faces: 2 },
        CapClass::Dart { valence: 2 },
    ] {
        assert!(weights(class).is_none(), "{class:?}");
    }
}
