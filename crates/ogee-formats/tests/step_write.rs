//! The STEP writer: structure, names, units, determinism.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::*;
use ogee_formats::step::{self, Options, Schema, Unit};

fn text(part: &ogee::convert::Part, options: &Options) -> String {
    let mut out = Vec::new();
    step::write(part, options, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

fn count(text: &str, entity: &str) -> usize {
    text.matches(&format!("={entity}(")).count()
}

#[test]
fn helper_shells_are_closed() {
    for shell in [lens_of(30.0, 6.0), brick_with_ts(), brick_with_a_knot(), torus()] {
        assert!(shell.is_closed());
    }
    assert!(!sheet().is_closed());
}

#[test]
fn lens_has_the_entities_of_the_worked_example() {
    let text = text(&part(vec![solid(lens_of(30.0, 6.0))]), &Options::default());
    for (entity, times) in [
        ("CARTESIAN_POINT", 20),
        ("VERTEX_POINT", 4),
        ("EDGE_CURVE", 4),
        ("B_SPLINE_CURVE_WITH_KNOTS", 4),
        ("B_SPLINE_SURFACE_WITH_KNOTS", 2),
        ("ORIENTED_EDGE", 8),
        ("EDGE_LOOP", 2),
        ("FACE_OUTER_BOUND", 2),
        ("ADVANCED_FACE", 2),
        ("CLOSED_SHELL", 1),
        ("MANIFOLD_SOLID_BREP", 1),
        ("ADVANCED_BREP_SHAPE_REPRESENTATION", 1),
        ("SHAPE_DEFINITION_REPRESENTATION", 1),
    ] {
        assert_eq!(count(&text, entity), times, "{entity}");
    }
    assert!(text.contains("=ADVANCED_FACE('f0',("));
    assert!(text.contains("=MANIFOLD_SOLID_BREP('part',#"));
    assert!(text.contains(",(4,4),(4,4),(0.,1.),(0.,1.),.UNSPECIFIED.)"));
    assert!(text.ends_with("ENDSEC;\nEND-ISO-10303-21;\n"));
}

#[test]
fn bodies_are_numbered_and_voids_turned() {
    let options = Options { name: "h".to_owned(), ..Options::default() };
    let text = text(&all_parts().remove(10).1, &options);
    for name in ["MANIFOLD_SOLID_BREP('h.1'", "SHELL_BASED_SURFACE_MODEL('h.2'", "BREP_WITH_VOIDS('h.3'"] {
        assert!(text.contains(name), "{name}");
    }
    assert!(text.contains("=ORIENTED_CLOSED_SHELL('',*,#"));
    assert_eq!(count(&text, "SHAPE_REPRESENTATION_RELATIONSHIP"), 2);
}

#[test]
fn units_and_schemas_are_said() {
    let part = part(vec![solid(lens_of(30.0, 6.0))]);
    let with = |unit, schema| text(&part, &Options { unit, schema, ..Options::default() });
    let inch = with(Unit::Inch, Schema::Ap242);
    assert!(inch.contains("CONVERSION_BASED_UNIT('INCH',#"));
    assert!(inch.contains("LENGTH_MEASURE(25.4)"));
    assert!(inch.contains("LENGTH_MEASURE(3.9370078740157"));
    assert!(inch.contains("AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }"));
    assert!(with(Unit::Metre, Schema::Ap214).contains("SI_UNIT($,.METRE.)"));
    assert!(with(Unit::Metre, Schema::Ap214).contains("LENGTH_MEASURE(1.E-9)"));
    assert!(with(Unit::Centimetre, Schema::Ap214).contains("SI_UNIT(.CENTI.,.METRE.)"));
}

#[test]
fn names_are_escaped() {
    let options = Options { name: "d'été \\ 1".to_owned(), ..Options::default() };
    let text = text(&part(vec![solid(lens_of(30.0, 6.0))]), &options);
    assert!(text.contains("MANIFOLD_SOLID_BREP('d''\\X2\\00E9\\X0\\t\\X2\\00E9\\X0\\ \\\\ 1',"));
}

#[test]
fn equal_parts_give_equal_bytes() {
    for (name, part) in all_parts() {
        assert_eq!(text(&part, &Options::default()), text(&part, &Options::default()), "{name}");
    }
}

#[test]
fn numbers_that_are_none_are_refused_before_the_first_byte() {
    let mut shell = lens_of(30.0, 6.0);
    shell.faces[0].surface.net[(1, 1)].z = f64::NAN;
    let mut out = Vec::new();
    let error = step::write(&part(vec![solid(shell)]), &Options::default(), &mut out).unwrap_err();
    assert_eq!(error.kind(), std::io::ErrorKind::InvalidData);
    assert!(out.is_empty());
}
