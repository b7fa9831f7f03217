//! The weights of G2 caps follow from their class alone: made again they are the shipped ones, and where none are shipped the
//! conditions hold as well.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;

use golden::{documents, index, list, number};
use ogee::g2_caps::{
    CapClass, CornerAngle, Weights, generate, knots, nets, planar_map, residuals, shipped_classes, weights,
};
use ogee::nurbs::NurbsSurface;
use ogee::{Grid, SurfaceJet, Vec3};

fn interior(valence: u32) -> CapClass {
    CapClass::Interior { valence }
}

fn boundary(faces: u32) -> CapClass {
    CapClass::Boundary { faces }
}

fn corner(faces: u32, angle: CornerAngle) -> CapClass {
    CapClass::Corner { faces, angle }
}

fn dart(valence: u32) -> CapClass {
    CapClass::Dart { valence }
}

/// The sum of the absolute weights of a row, over all rows.
fn row_sums(weights: &Weights) -> impl Iterator<Item = f64> {
    let rows = weights.sectors.iter().flat_map(|sector| sector.cells().chunks(sector.cols()));
    rows.map(|row| row.iter().map(|weight| weight.abs()).sum())
}

/// Points of no shape at all, between -1 and 1.
fn points(count: usize) -> Vec<Vec3> {
    let mut state = 7_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    };
    (0..count).map(|_| Vec3::new(next(), next(), next())).collect()
}

fn surface(net: &Grid<Vec3>) -> NurbsSurface {
    NurbsSurface { u: knots(), v: knots(), net: net.clone() }
}

/// Both sides of an edge at a place: the sector after it, and the one before with its parameters exchanged.
fn both_sides(after: &NurbsSurface, before: &NurbsSurface, t: f64) -> [SurfaceJet; 2] {
    let b = before.jet(0.0, t);
    let exchanged = SurfaceJet { du: b.dv, dv: b.du, duu: b.dvv, dvv: b.duu, ..b };
    [after.jet(t, 0.0), exchanged]
}

#[test]
fn weights_made_again_are_the_shipped_ones() {
    let classes = [
        interior(3),
        interior(5),
        interior(6),
        boundary(3),
        corner(2, CornerAngle::Convex),
        corner(2, CornerAngle::Concave),
        dart(3),
    ];
    for class in classes {
        assert!(shipped_classes().any(|shipped| shipped == class), "{class:?}");
        let (made, shipped) = (generate(class).unwrap(), weights(class).unwrap());
        assert_eq!(made.sectors.len(), shipped.sectors.len(), "{class:?}");
        let cells = |weights: &Weights| {
            weights.sectors.iter().flat_map(|sector| sector.cells().to_vec()).collect::<Vec<_>>()
        };
        let (made, shipped) = (cells(&made), cells(&shipped));
        let worst = made.iter().zip(&shipped).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs()));
        println!("{class:?}: {worst:e}");
        assert!(made.len() == shipped.len() && worst < 1e-9, "{class:?}: {worst:e}");
    }
}

#[test]
fn planar_maps_match() {
    for (name, document) in documents("g2_caps/planar-maps") {
        let map = planar_map(interior(index(&document["n"]))).unwrap().remove(0);
        let golden = list(&document["map"]).iter().flat_map(list).map(|p| [number(&p[0]), number(&p[1])]);
        let difference = |([x, y], [a, b]): (&[f64; 2], [f64; 2])| (x - a).abs().max((y - b).abs());
        let worst = map.cells().iter().zip(golden).map(difference).fold(0.0, f64::max);
        println!("{name}: {worst:e}");
        assert!(worst < 1e-9, "{name}: {worst:e}");
    }
}

#[test]
fn planar_maps_do_not_fold() {
    let known = [(3, 0.72, 2.02), (5, 0.64, 1.04), (8, 0.31, 0.83), (12, 0.19, 0.60), (32, 0.065, 0.24)];
    for (valence, least, greatest) in known {
        let map = planar_map(interior(valence)).unwrap().remove(0);
        let surface = surface(&map.map(|&[x, y]| Vec3::new(x, y, 0.0)));
        let areas = (0..=40 * 40).map(|k| {
            let jet = surface.jet(f64::from(k % 41) / 40.0, f64::from(k / 41) / 40.0);
            jet.du.cross(jet.dv).z
        });
        let (low, high) =
            areas.fold((f64::MAX, 0.0_f64), |(low, high), area| (low.min(area), high.max(area)));
        println!("{valence}: {low} .. {high}");
        assert!(low > 0.0 && (low / least - 1.0).abs() < 0.05, "{valence}: {low}");
        assert!((high / greatest - 1.0).abs() < 0.05, "{valence}: {high}");
    }
}

#[test]
fn conditions_hold_where_no_table_is_shipped() {
    for class in [interior(11), interior(14), boundary(7), corner(5, CornerAngle::Concave), dart(6)] {
        assert!(shipped_classes().all(|shipped| shipped != class), "{class:?}");
        let made = generate(class).unwrap();
        let [values, tangents, curvatures] = residuals(&made);
        println!("{class:?}: {values:e} {tangents:e} {curvatures:e}");
        assert!(values < 5e-15 && tangents < 1e-13 && curvatures < 3e-12, "{class:?}");
    }
}

#[test]
fn residuals_see_what_is_wrong() {
    let class = interior(5);
    let mut wrong = generate(class).unwrap();
    let [values, tangents, curvatures] = residuals(&wrong);
    assert!(values < 5e-15 && tangents < 1e-13 && curvatures < 3e-12);
    wrong.sectors[0][(11, 3)] += 1e-9;
    assert!(residuals(&wrong)[2] > 1e-9);
}

/// The conditions as the method's page has them, on surfaces of any points, by the derivatives of B-splines.
#[test]
fn sectors_fulfil_the_conditions() {
    for (class, angle) in
        [(interior(11), std::f64::consts::TAU / 11.0), (boundary(3), std::f64::consts::PI / 3.0)]
    {
        let nets = nets(&generate(class).unwrap(), &points(class.columns()));
        let surfaces: Vec<NurbsSurface> = nets.iter().map(surface).collect();
        let first = usize::from(matches!(class, CapClass::Boundary { .. }));
        let mut worst = [0.0_f64; 3];
        for edge in first..surfaces.len() {
            let before = (edge + surfaces.len() - 1) % surfaces.len();
            for k in 0..=64 {
                let t = f64::from(k) / 64.0;
                let [a, b] = both_sides(&surfaces[edge], &surfaces[before], t);
                let lean = 2.0 * angle.cos() * (2.0 * (1.0 - t).powi(3) - (1.0 - 2.0 * t).max(0.0).powi(3));
                let left = [
                    a.position - b.position,
                    a.dv + b.dv - lean * a.du,
                    a.dvv - b.dvv - lean * (a.duv - b.duv),
                ];
                worst = [0, 1, 2].map(|order| worst[order].max(left[order].length()));
            }
        }
        println!("{class:?}: {worst:?}");
        assert!(worst[0] == 0.0 && worst[1] < 1e-12 && worst[2] < 1e-10, "{class:?}: {worst:?}");
    }
}

#[test]
fn rows_are_exact_means_and_tame() {
    for (valence, greatest) in [(3, 1.02), (5, 1.04), (8, 1.09), (12, 1.37)] {
        let made = generate(interior(valence)).unwrap();
        for row in made.sectors[0].cells().chunks(made.sectors[0].cols()) {
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-14, "{valence}");
        }
        let found = row_sums(&made).fold(0.0, f64::max);
        println!("{valence}: {found}");
        assert!((found - greatest).abs() < 0.01, "{valence}: {found}");
    }
}
