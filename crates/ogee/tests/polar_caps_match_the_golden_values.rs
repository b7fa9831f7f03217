//! Solution operators, nets and energies of polar caps of `testdata/lens`.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod poles;

use golden::{documents, index, list, number, point, points};
use ogee::lens::{PolarCap, PolarFaces, PolarOperator, PolarVariant, pair_pole};
use ogee::{Grid, Vec3};
use poles::faces;
use serde_json::Value;

/// Of the largest number compared.
const TOLERANCE: f64 = 1e-12;

fn document(wanted: &str) -> Value {
    let mut documents = documents("lens");
    let found = documents.iter().position(|(name, _)| name == wanted);
    documents.swap_remove(found.unwrap_or_else(|| panic!("there is no {wanted}"))).1
}

fn operators(document: &Value) -> [PolarOperator; 3] {
    let sectors = index(&document["n"]) as usize;
    PolarVariant::ALL.map(|variant| PolarOperator::new(sectors, variant).unwrap())
}

fn assert_points(own: &[Vec3], golden: &[Vec3], what: &str) {
    assert_eq!(own.len(), golden.len(), "{what}");
    let size = golden.iter().fold(0.0_f64, |most, p| most.max(p.length()));
    for (k, (a, b)) in own.iter().zip(golden).enumerate() {
        assert!(a.distance(*b) <= TOLERANCE * size, "{what} {k}: {a:?} is not {b:?}");
    }
}

/// Rings and expansion: rows of the operator, applied to circles and pole.
fn unknowns(operator: &PolarOperator, given: &[Vec3]) -> Vec<Vec3> {
    let weights = operator.weights();
    let row = |i| weights.row(i).iter().zip(given).fold(Vec3::ZERO, |sum, (&w, &p)| sum + w * p);
    (0..weights.rows()).map(row).collect()
}

/// The points of a patch with what goes around first.
fn around_first(net: &Grid<Vec3>) -> Vec<Vec3> {
    net.transposed().cells().to_vec()
}

#[test]
fn operators_match() {
    for sectors in [6, 8, 12] {
        let document = document(&format!("polar_n{sectors}"));
        for operator in operators(&document) {
            let name = operator.variant().name();
            let golden = list(&document[format!("S{name}")]);
            assert_eq!(golden.len(), operator.weights().rows());
            let size = golden.iter().flat_map(list).fold(0.0_f64, |most, w| most.max(number(w).abs()));
            for (i, row) in golden.iter().enumerate() {
                assert_eq!(list(row).len(), operator.weights().cols());
                for (j, golden) in list(row).iter().enumerate() {
                    let miss = (operator.weights()[(i, j)] - number(golden)).abs();
                    assert!(miss <= TOLERANCE * size, "{name}, n = {sectors}: ({i}, {j}) misses by {miss}");
                }
            }
        }
    }
}

#[test]
fn caps_match() {
    let energies = &document("polar_energies")["energies"];
    for sectors in [6, 8] {
        let document = document(&format!("samples_polar_n{sectors}"));
        let circles = ["c1", "c2", "c3"].map(|name| points(&document[name]));
        let pole = point(&document["p0"]);
        let mut given = circles.concat();
        given.push(pole);
        for operator in operators(&document) {
            let name = operator.variant().name();
            let what = format!("n = {sectors}, {name}");
            let own = unknowns(&operator, &given);
            assert_points(&own, &points(&document[format!("U{name}")]), &what);

            let circles = circles.each_ref().map(Vec::as_slice);
            let cap = PolarCap::with(&operator, circles, pole).unwrap();
            assert_eq!(cap, PolarCap::new(circles, pole, operator.variant()).unwrap());
            let energy = number(&energies[format!("n{sectors}_{name}")]);
            assert!((cap.energy() - energy).abs() <= TOLERANCE * energy, "{what}: {} {energy}", cap.energy());

            let faces = faces(&cap, PolarFaces::PerSector).faces;
            let central = points(&document[format!("central_patch_0_{name}")]);
            assert_points(&around_first(&faces[0].surface.net), &central, &what);
            if operator.variant() == PolarVariant::SixFive {
                let transition = points(&document["transition_patch_0"]);
                assert_points(&around_first(&faces[1].surface.net), &transition, &what);
            }
        }
    }
}

#[test]
fn the_pole_between_two_lenses_matches() {
    let document = document("mesh_pair_m4");
    let vertices = points(&document["vertices"]);
    let (slit, circles) = vertices.split_at(5);
    let pole = pair_pole(slit, &circles[..8]).unwrap();
    assert_points(&[pole], &[point(&document["polar_p0"])], "pole");

    let circles: Vec<&[Vec3]> = circles.chunks(8).collect();
    let cap = PolarCap::new([circles[0], circles[1], circles[2]], pole, PolarVariant::SixFive).unwrap();
    let jet = cap.pole();
    let expansion = [jet.du, jet.dv, jet.duu / 2.0, jet.duv, jet.dvv / 2.0];
    assert_points(&expansion, &points(&document["polar65_t1_t2_h"]), "expansion");
    let given = [circles[0], circles[1], circles[2], &[pole]].concat();
    let operator = PolarOperator::new(8, PolarVariant::SixFive).unwrap();
    let first_ring = unknowns(&operator, &given)[..8].to_vec();
    assert_points(&first_ring, &points(&document["polar65_b0"]), "first ring");
}
