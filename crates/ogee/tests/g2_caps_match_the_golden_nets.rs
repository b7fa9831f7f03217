//! Nets and samples of `testdata/g2_caps`.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;

use golden::{documents, index, list, number, point, points};
use ogee::g2_caps::{CapClass, CornerAngle, knots, nets, weights};
use ogee::nurbs::NurbsSurface;
use ogee::{Grid, Vec3};
use serde_json::Value;

fn class(name: &str, document: &Value) -> CapClass {
    let faces = || index(&document["s"]);
    match name.split('-').next() {
        Some("boundary") => CapClass::Boundary { faces: faces() },
        Some("corner") if document["phi_deg"] == 270 => {
            CapClass::Corner { faces: faces(), angle: CornerAngle::Concave }
        }
        Some("corner") => CapClass::Corner { faces: faces(), angle: CornerAngle::Convex },
        Some("dart") => CapClass::Dart { valence: index(&document["n"]) },
        _ => CapClass::Interior { valence: index(&document["n"]) },
    }
}

fn size(points: &[Vec3]) -> f64 {
    let low = points.iter().fold(points[0], |low, &p| low.min(p));
    points.iter().fold(low, |high, &p| high.max(p)).distance(low)
}

/// Name, class, points and nets of every document.
fn caps() -> Vec<(String, CapClass, Vec<Vec3>, Vec<Grid<Vec3>>, Value)> {
    documents("g2_caps")
        .into_iter()
        .map(|(name, document)| {
            let class = class(&name, &document);
            let points = points(&document["points"]);
            assert_eq!(points.len(), class.columns(), "{name}");
            let nets = nets(&weights(class).unwrap(), &points);
            (name, class, points, nets, document)
        })
        .collect()
}

#[test]
fn nets_match() {
    let mut compared = 0;
    for (name, class, given, nets, document) in caps() {
        let mut worst: f64 = 0.0;
        assert_eq!((list(&document["nets"]).len(), nets.len()), (class.sectors(), class.sectors()));
        for (theirs, ours) in list(&document["nets"]).iter().zip(&nets) {
            let theirs: Vec<Vec3> = list(theirs).iter().flat_map(points).collect();
            assert_eq!(theirs.len(), ours.cells().len());
            worst = theirs.iter().zip(ours.cells()).fold(worst, |worst, (a, b)| worst.max(a.distance(*b)));
        }
        println!("{name}: {:e}", worst / size(&given));
        assert!(worst <= 1e-11 * size(&given), "{name}: {worst:e}");
        compared += 1;
    }
    assert_eq!(compared, 9);
}

#[test]
fn samples_match() {
    for (name, _, given, nets, document) in caps() {
        let size = size(&given);
        let mut worst: f64 = 0.0;
        for sample in list(&document["samples"]) {
            let net = nets[index(&sample["sector"]) as usize].clone();
            let surface = NurbsSurface { u: knots(), v: knots(), net };
            let jet = surface.jet(number(&sample["u"]), number(&sample["v"]));
            let curvature = jet.curvature().unwrap();
            let (mean, gauss) = (number(&sample["H"]), number(&sample["K"]));
            for (difference, unit) in [
                (jet.position.distance(point(&sample["S"])), size),
                (jet.normal().unwrap().distance(point(&sample["N"])), 1.0),
                (curvature.mean - mean, mean.abs().max(1.0 / size)),
                (curvature.gauss - gauss, gauss.abs().max(1.0 / (size * size))),
            ] {
                worst = worst.max(difference.abs() / unit);
            }
        }
        println!("{name}: {worst:e}");
        assert!(worst <= 1e-11, "{name}: {worst:e}");
    }
}
