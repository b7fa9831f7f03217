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

/// A document, and what we make of its points.
struct Golden {
    name: String,
    document: Value,
    class: CapClass,
    size: f64,
    nets: Vec<Grid<Vec3>>,
}

fn caps() -> Vec<Golden> {
    documents("g2_caps")
        .into_iter()
        // Whole meshes are another claim's.
        .filter(|(_, document)| !document["nets"].is_null())
        .map(|(name, document)| {
            let class = class(&name, &document);
            let points = points(&document["points"]);
            assert_eq!(points.len(), class.columns(), "{name}");
            let nets = nets(&weights(class).unwrap(), &points);
            Golden { name, document, class, size: size(&points), nets }
        })
        .collect()
}

#[test]
fn nets_match() {
    let mut compared = 0;
    for Golden { name, document, class, size, nets } in caps() {
        let mut worst: f64 = 0.0;
        assert_eq!((list(&document["nets"]).len(), nets.len()), (class.sectors(), class.sectors()));
        for (theirs, ours) in list(&document["nets"]).iter().zip(&nets) {
            let theirs: Vec<Vec3> = list(theirs).iter().flat_map(points).collect();
            assert_eq!(theirs.len(), ours.cells().len());
            worst = theirs.iter().zip(ours.cells()).fold(worst, |worst, (a, b)| worst.max(a.distance(*b)));
        }
        println!("{name}: {:e}", worst / size);
        assert!(worst <= 1e-11 * size, "{name}: {worst:e}");
        compared += 1;
    }
    assert_eq!(compared, 9);
}

#[test]
fn samples_match() {
    for Golden { name, document, size, nets, .. } in caps() {
        let mut worst: f64 = 0.0;
        for sample in list(&document["samples"]) {
            let net = nets[index(&sample["sector"]) as usize].clone();
            let surface = NurbsSurface { u: knots(), v: knots(), net };
            let jet = surface.jet(number(&sample["u"]), number(&sample["v"]));
            let curvature = jet.curvature().unwrap();
            let (mean, gauss) = (number(&sample["H"]), number(&sample["K"]));
            for (difference, allowed) in [
                (jet.position.distance(point(&sample["S"])), 1e-11 * size),
                (jet.normal().unwrap().distance(point(&sample["N"])), 1e-10),
                (curvature.mean - mean, 1e-9 * mean.abs().max(1.0 / size)),
                (curvature.gauss - gauss, 1e-9 * gauss.abs().max(1.0 / (size * size))),
            ] {
                worst = worst.max(difference.abs() / allowed);
            }
        }
        println!("{name}: {worst:e} of what is allowed");
        assert!(worst <= 1.0, "{name}: {worst:e}");
    }
}
