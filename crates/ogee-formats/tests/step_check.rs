//! The lint: good files pass, each damage is found by its name, no input makes it panic.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::*;
use ogee::Vec3;
use ogee::convert::Part;
use ogee_formats::step::{self, CheckReport, Options, Schema, Unit, check};
use proptest::prelude::*;

/// The worked example of a minimal solid; not written by our writer.
const LENS: &str = include_str!("data/lens.step");

fn text(part: &Part, options: &Options) -> String {
    let mut out = Vec::new();
    step::write(part, options, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

fn written(name: &str) -> String {
    let (_, part) = all_parts().into_iter().find(|(other, _)| *other == name).unwrap();
    text(&part, &Options::default())
}

fn codes(text: &str) -> Vec<&'static str> {
    let mut codes: Vec<_> = check(text.as_bytes()).faults.iter().map(|fault| fault.code).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}

fn assert_clean(report: &CheckReport, what: &str) {
    let faults: Vec<String> = report.faults.iter().map(|f| format!("{} {f}", f.code)).collect();
    assert!(report.is_clean(), "{what}: {faults:#?}");
}

/// The text with one replacement, which must be possible.
fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "`{from}` is not in the file");
    text.replacen(from, to, 1)
}

/// The line of the entity with this number.
fn entity(text: &str, id: u64) -> &str {
    let begin = format!("#{id}=");
    text.lines().find(|line| line.starts_with(&begin)).unwrap()
}

/// The number of the first entity of this kind.
fn first(text: &str, kind: &str) -> u64 {
    let line = text.lines().find(|line| line.contains(&format!("={kind}("))).unwrap();
    line[1..line.find('=').unwrap()].parse().unwrap()
}

#[test]
fn the_worked_example_is_clean() {
    let report = check(LENS.as_bytes());
    assert_clean(&report, "lens.step");
    let counts = report.counts;
    assert_eq!((counts.solids, counts.shells, counts.faces, counts.edges, counts.vertices), (1, 1, 2, 4, 4));
    assert_eq!(counts.entities, 69);
    assert_eq!(report.schema.as_deref(), Some("AUTOMOTIVE_DESIGN"));
    assert_eq!(report.unit_in_millimetres, Some(1.0));
    assert_eq!(report.uncertainty, Some(1e-6));
    assert!((report.volume.unwrap() - 2700.0).abs() < 1e-9);
}

#[test]
fn everything_we_write_is_clean() {
    for (name, part) in all_parts() {
        for unit in [Unit::Millimetre, Unit::Centimetre, Unit::Metre, Unit::Inch] {
            for schema in [Schema::Ap214, Schema::Ap242] {
                let options = Options { unit, schema, name: "é'\\".to_owned(), ..Options::default() };
                let report = check(text(&part, &options).as_bytes());
                assert_clean(&report, name);
                assert!((report.unit_in_millimetres.unwrap() - unit.in_millimetres()).abs() < 1e-12);
                let faces: usize =
                    part.bodies.iter().flat_map(|body| body.shells()).map(|shell| shell.faces.len()).sum();
                assert_eq!(report.counts.faces, faces);
            }
        }
    }
}

#[test]
fn volumes_are_exact() {
    for (name, volume) in [
        ("lens", 2700.0),
        ("brick", 1_075_000.0),
        ("ts", 176_850.0),
        ("knot", 176_850.0),
        ("two", 229_500.0),
        ("hollow", 218_200.0),
    ] {
        let report = check(written(name).as_bytes());
        assert!((report.volume.unwrap() / volume - 1.0).abs() < 1e-12, "{name}: {:?}", report.volume);
    }
    assert_eq!(check(written("sheet").as_bytes()).volume, None);
}

#[test]
fn small_and_large_and_far_parts_are_clean() {
    for size in [1e-6, 1e-3, 1e3, 1e9] {
        let part = part(vec![solid(lens_of(size, size / 5.0))]);
        assert_clean(&check(text(&part, &Options::default()).as_bytes()), &format!("size {size}"));
    }
    let far = Vec3::new(1e6, 1e6, 1e6);
    let brick = brick(far, far + Vec3::new(128.0, 64.0, 32.0), 2.0);
    assert_clean(&check(text(&part(vec![solid(brick)]), &Options::default()).as_bytes()), "far");
}

// Damages to the text as such.

#[test]
fn syntax_is_strict() {
    for (from, to, code) in [
        ("ISO-10303-21;", "ISO-10303;", "not_step"),
        ("HEADER;", "", "syntax"),
        ("1.E-6", "1e-6", "real_without_point"),
        ("1.E-6", "1.e-6", "bad_real"),
        ("LENGTH_MEASURE(1.E-6)", "LENGTH_MEASURE(1)", "real_without_point"),
        ("(30.,0.,0.)", "(30,0.,0.)", "real_without_point"),
        ("(30.,0.,0.)", "(nan,0.,0.)", "bad_real"),
        ("(30.,0.,0.)", "(-inf,0.,0.)", "bad_real"),
        ("(30.,0.,0.)", "(1.E400,0.,0.)", "bad_real"),
        ("(30.,0.,0.)", "(30.,0.,0.", "syntax"),
        ("(0.,1.),.UNSPECIFIED.", "(0,1),.UNSPECIFIED.", "real_without_point"),
        ("(30.,0.,0.)", "('30',0.,0.)", "bad_argument"),
        ("#17=", "#16=", "duplicate_id"),
        ("#17=", "#1017=", "dangling_reference"),
        ("ENDSEC;\nEND-ISO", "END-ISO", "missing_endsec"),
        ("ENDSEC;\nDATA;", "DATA;", "missing_endsec"),
        ("END-ISO-10303-21;\n", "", "missing_end"),
        ("END-ISO-10303-21;\n", "END-ISO-10303-21;\nmore", "syntax"),
        ("'top'", "'top", "syntax"),
        ("#5=", "5=", "syntax"),
        ("#50=ADVANCED_FACE", "#50 ADVANCED_FACE", "syntax"),
        ("ADVANCED_FACE('top'", "ADVANCED_FACE(;'top'", "syntax"),
        ("DATA;", "DATA;/*", "truncated"),
        ("(#49)", "((((((((((((((((((((#49))))))))))))))))))))", "syntax"),
    ] {
        let codes = codes(&replaced(LENS, from, to));
        assert!(codes.contains(&code), "{from} -> {to}: {codes:?}");
    }
}

#[test]
fn a_truncated_file_is_found_wherever_it_ends() {
    for length in 0..LENS.len() - 1 {
        assert!(!check(&LENS.as_bytes()[..length]).is_clean(), "cut after {length} bytes");
    }
}

#[test]
fn a_fault_says_where() {
    let report = check(replaced(LENS, "(30.,0.,0.)", "(30,0.,0.)").as_bytes());
    let fault = &report.faults[0];
    assert_eq!((fault.line, fault.id), (Some(23), Some(16)));
    assert_eq!(fault.to_string(), "line 23: #16: the real `30` has no point");
}

#[test]
fn the_header_is_strict() {
    let people = "('author'),('organisation')";
    let schema = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }";
    for (from, to, code) in [
        (",'originating system',''", ",'originating system'", "file_name_arity"),
        (people, "(('author')),('organisation')", "file_name_argument"),
        (people, "'author',('organisation')", "file_name_argument"),
        (people, "(),('organisation')", "file_name_argument"),
        ("'2026-01-01T00:00:00'", "'yesterday'", "file_name_argument"),
        ("'2;1'", "2", "file_description"),
        ("'2;1'", "'two'", "file_description"),
        ("(('SubD converted to NURBS'),'2;1')", "('SubD converted to NURBS','2;1')", "file_description"),
        ("FILE_DESCRIPTION", "FILE_POPULATION", "missing_header_record"),
        (schema, "ISO-10303-042", "unknown_schema"),
        (schema, "AUTOMOTIVE_DESIGN { 2 7 18 }", "unknown_schema"),
        (schema, "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1", "unknown_schema"),
        ("(('AUTO", "('AUTO", "syntax"),
        (&format!("(('{schema}'))"), &format!("('{schema}')"), "file_schema"),
    ] {
        let codes = codes(&replaced(LENS, from, to));
        assert!(codes.contains(&code), "{from} -> {to}: {codes:?}");
    }
}

#[test]
fn units_are_needed() {
    for (from, to, code) in [
        ("GLOBAL_UNIT_ASSIGNED_CONTEXT((#10,#11,#12)) ", "", "missing_unit"),
        ("((#10,#11,#12))", "((#11,#12))", "missing_unit"),
        ("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.MILLI.,.GRAM.)", "missing_unit"),
        ("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#13)) ", "", "missing_uncertainty"),
        ("1.E-6", "-1.E-6", "bad_uncertainty"),
        ("GEOMETRIC_REPRESENTATION_CONTEXT(3) ", "", "missing_unit"),
    ] {
        let codes = codes(&replaced(LENS, from, to));
        assert!(codes.contains(&code), "{from} -> {to}: {codes:?}");
    }
}

#[test]
fn entities_have_their_arguments() {
    for (from, to, code) in [
        ("EDGE_CURVE('',#19,#20,#25,.T.)", "EDGE_CURVE('',#19,#20,#25)", "wrong_argument_count"),
        ("EDGE_CURVE('',#19,", "EDGE_CURVE('',#15,", "wrong_type"),
        ("EDGE_CURVE('',#19,#20,#25", "EDGE_CURVE('',#19,#20,#15", "wrong_type"),
        ("EDGE_CURVE('',#19,", "EDGE_CURVE('',19,", "bad_argument"),
        (".T.", "$", "bad_argument"),
        ("(#44,#45,#46,#47)", "(#26,#30,#34,#38)", "wrong_type"),
        ("(#44,#45,#46,#47)", "()", "bad_argument"),
        ("(#49),#43", "(#48),#43", "wrong_type"),
        ("MANIFOLD_SOLID_BREP('lens',#63)", "MANIFOLD_SOLID_BREP('lens',#62)", "wrong_type"),
        ("CLOSED_SHELL('',(#50,#62))", "OPEN_SHELL('',(#50,#62))", "wrong_type"),
        ("('',(#67,#64),#14)", "('',(#67),#14)", "unused_body"),
        ("#69=SHAPE_DEFINITION_REPRESENTATION(#9,#68);\n", "", "missing_shape"),
        ("#27,#28,#17)),.UNSP", "#27,#28)),.UNSP", "bad_argument"),
    ] {
        let codes = codes(&replaced(LENS, from, to));
        assert!(codes.contains(&code), "{from} -> {to}: {codes:?}");
    }
}

#[test]
fn knots_go_with_poles() {
    let curve = ".UNSPECIFIED.,.F.,.F.,(4,4),(0.,1.)";
    let surface = ".F.,.F.,.F.,(4,4),(4,4),(0.,1.),(0.,1.)";
    for (from, to, code) in [
        (curve, ".UNSPECIFIED.,.F.,.F.,(4,3),(0.,1.)", "knots_mismatch"),
        (curve, ".UNSPECIFIED.,.F.,.F.,(4,4),(0.,1.,2.)", "knots_mismatch"),
        (curve, ".UNSPECIFIED.,.F.,.F.,(4,4),(1.,0.)", "knots_not_increasing"),
        (curve, ".UNSPECIFIED.,.F.,.F.,(4,4),(1.,1.)", "knots_not_increasing"),
        (curve, ".UNSPECIFIED.,.F.,.F.,(2,4,2),(0.,0.5,1.)", "knot_multiplicity"),
        (curve, ".UNSPECIFIED.,.F.,.F.,(3,5),(0.,1.)", "knot_multiplicity"),
        (curve, ".UNSPECIFIED.,.F.,.F.,(4,0,4),(0.,0.5,1.)", "bad_argument"),
        (surface, ".F.,.F.,.F.,(4,5),(4,4),(0.,1.),(0.,1.)", "knots_mismatch"),
        (surface, ".F.,.F.,.F.,(4,4),(4,4),(0.,1.),(0.,0.)", "knots_not_increasing"),
        ("WITH_KNOTS('',3", "WITH_KNOTS('',2", "knots_mismatch"),
        ("WITH_KNOTS('top',3,3", "WITH_KNOTS('top',3,5", "knots_mismatch"),
        ("WITH_KNOTS('top',3,3", "WITH_KNOTS('top',3,9223372036854775807", "knots_mismatch"),
        ("WITH_KNOTS('top',3,3", "WITH_KNOTS('top',0,3", "bad_argument"),
    ] {
        let codes = codes(&replaced(LENS, from, to));
        assert!(codes.contains(&code), "{from} -> {to}: {codes:?}");
    }
}

// Damages that a kernel repairs in silence.

#[test]
fn a_flipped_edge_is_found() {
    for name in ["lens", "brick", "ts", "hollow"] {
        let text = written(name);
        let id = first(&text, "ORIENTED_EDGE");
        let line = entity(&text, id);
        let flipped =
            if line.contains(".T.") { line.replace(".T.", ".F.") } else { line.replace(".F.", ".T.") };
        let codes = codes(&replaced(&text, line, &flipped));
        assert_eq!(codes, ["edge_same_direction", "open_loop"], "{name}");
    }
    // A closed edge has no head and tail to tell.
    let text = written("torus");
    let flipped = replaced(&text, &entity_with(&text, "ORIENTED_EDGE", ".F."), "");
    assert!(codes(&flipped).contains(&"dangling_reference"));
    let line = entity_with(&text, "ORIENTED_EDGE", ".F.");
    let codes = codes(&replaced(&text, &line, &line.replace(".F.", ".T.")));
    assert!(codes.contains(&"edge_same_direction"), "{codes:?}");
}

fn entity_with(text: &str, kind: &str, part: &str) -> String {
    let line = text.lines().find(|line| line.contains(&format!("={kind}(")) && line.contains(part));
    line.unwrap().to_owned()
}

#[test]
fn an_edge_against_its_curve_is_found() {
    let line = entity(LENS, 26);
    assert_eq!(codes(&replaced(LENS, line, &line.replace(".T.", ".F."))), ["edge_against_curve"]);
}

#[test]
fn a_flipped_face_is_found() {
    for name in ["lens", "brick", "ts", "knot", "torus", "hollow", "sheet", "pole"] {
        let text = written(name);
        // Its sense.
        let line = entity(&text, first(&text, "ADVANCED_FACE"));
        let found = codes(&replaced(&text, line, &line.replace(".T.", ".F.")));
        assert!(found.contains(&"loop_clockwise"), "{name}: {found:?}");
        // The sense of its bound.
        let line = entity(&text, first(&text, "FACE_OUTER_BOUND"));
        let found = codes(&replaced(&text, line, &line.replace(".T.", ".F.")));
        assert!(found.contains(&"loop_clockwise"), "{name}: {found:?}");
    }
    // Both: the face agrees with itself, and not with its neighbours.
    let text = replaced(LENS, "(#49),#43,.T.", "(#49),#43,.F.");
    assert_eq!(codes(&replaced(&text, "('',#48,.T.)", "('',#48,.F.)")), ["edge_same_direction"]);
}

#[test]
fn a_face_whose_poles_are_exchanged_is_found() {
    // u and v of the poles swapped, loop left as it was.
    let mut shell = lens_of(30.0, 6.0);
    shell.faces[0].surface.net = shell.faces[0].surface.net.transposed();
    assert_eq!(codes(&text(&part(vec![solid(shell)]), &Options::default())), ["loop_clockwise"]);
}

#[test]
fn a_shell_inside_out_is_found() {
    // Every flag turned.
    for name in ["lens", "brick", "ts", "torus"] {
        let text = written(name);
        let inside: Vec<String> = text
            .lines()
            .map(|line| match line.contains("=ADVANCED_FACE(") || line.contains("=FACE_OUTER_BOUND(") {
                true => line.replace(".T.", ".F."),
                false => line.to_owned(),
            })
            .collect();
        assert_eq!(codes(&inside.join("\n")), ["inside_out"], "{name}");
    }
    // Every surface and every loop turned, no flag: a mirrored lens.
    let inverted = part(vec![solid(lens_of(30.0, -6.0))]);
    assert_eq!(codes(&text(&inverted, &Options::default())), ["inside_out"]);
    // A hollow that is not turned.
    let text = written("hollow");
    let line = entity(&text, first(&text, "ORIENTED_CLOSED_SHELL"));
    assert_eq!(codes(&replaced(&text, line, &line.replace(".F.", ".T."))), ["void_inside_out"]);
}

/// The brick with one pole of one surface moved, its edges left as they were.
fn moved(face: usize, i: usize, j: usize, by: Vec3) -> Vec<&'static str> {
    let mut shell = brick(Vec3::ZERO, Vec3::new(100.0, 80.0, 60.0), 5.0);
    shell.faces[face].surface.net[(i, j)] += by;
    codes(&text(&part(vec![solid(shell)]), &Options::default()))
}

#[test]
fn a_moved_pole_is_found() {
    let amounts = [0.017, 2.0];
    for amount in amounts {
        for axis in [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1.0)] {
            for face in 0..6 {
                for (i, j) in [(0, 0), (0, 1), (0, 2), (3, 1), (1, 0), (2, 3), (3, 3)] {
                    let found = moved(face, i, j, axis * amount);
                    let off = found.contains(&"edge_off_boundary") || found.contains(&"edge_off_surface");
                    assert!(off, "face {face}, pole {i} {j} by {amount}: {found:?}");
                }
            }
        }
    }
    // What no text can tell.
    assert_eq!(moved(0, 1, 1, Vec3::new(0.0, 0.0, 0.017)), [""; 0]);
}

#[test]
fn a_moved_pole_of_an_edge_is_found() {
    for (pole, code) in [(0, "vertex_off_curve"), (1, "edge_off_boundary"), (3, "vertex_off_curve")] {
        let mut shell = brick(Vec3::ZERO, Vec3::new(100.0, 80.0, 60.0), 5.0);
        shell.edges[4].curve.points[pole] += Vec3::new(0.01, 0.01, 0.01);
        let found = codes(&text(&part(vec![solid(shell)]), &Options::default()));
        assert!(found.contains(&code), "pole {pole}: {found:?}");
    }
}

#[test]
fn a_moved_pole_beside_a_t_is_found() {
    for pole in 0..4 {
        let mut shell = brick_with_ts();
        // The front: its top is cut in two.
        let front = shell.faces.iter().position(|face| face.boundary.len() == 5).unwrap();
        shell.faces[front].surface.net[(pole, 3)] += Vec3::new(0.0, 0.017, 0.0);
        let found = codes(&text(&part(vec![solid(shell)]), &Options::default()));
        assert!(found.contains(&"edge_off_boundary"), "pole {pole}: {found:?}");
    }
}

#[test]
fn a_moved_vertex_is_found() {
    let mut shell = brick(Vec3::ZERO, Vec3::new(100.0, 80.0, 60.0), 5.0);
    shell.vertices[3] += Vec3::new(0.0, 0.017, 0.0);
    assert!(codes(&text(&part(vec![solid(shell)]), &Options::default())).contains(&"vertex_off_curve"));
}

#[test]
fn coincident_edges_are_found() {
    for name in ["lens", "brick", "ts"] {
        let (_, mut part) = all_parts().into_iter().find(|(other, _)| *other == name).unwrap();
        let ogee::convert::Body::Solid { outer, .. } = &mut part.bodies[0] else { panic!("a solid") };
        let copy = outer.edges[0].clone();
        outer.edges.push(copy);
        let last = outer.edges.len() as u32 - 1;
        let mut uses = outer.faces.iter_mut().flat_map(|face| &mut face.boundary);
        uses.find(|used| used.edge == 0).unwrap().edge = last;
        let codes = codes(&text(&part, &Options::default()));
        assert_eq!(codes, ["coincident_edges", "edge_used_once"], "{name}");
    }
}

#[test]
fn an_open_loop_is_found() {
    let found = codes(&replaced(LENS, "(#44,#45,#46,#47)", "(#44,#46,#45,#47)"));
    assert!(found.contains(&"open_loop"));
    let found = codes(&replaced(LENS, "(#44,#45,#46,#47)", "(#44,#45,#46)"));
    assert!(found.contains(&"open_loop") && found.contains(&"edge_used_once"), "{found:?}");
}

#[test]
fn a_missing_face_is_found() {
    assert!(codes(&replaced(LENS, "('',(#50,#62))", "('',(#50))")).contains(&"edge_used_once"));
    assert!(codes(&replaced(LENS, "('',(#50,#62))", "('',(#50,#62,#50))")).contains(&"edge_used_too_often"));
}

#[test]
fn a_shell_in_pieces_is_found() {
    let mut one = lens_of(30.0, 6.0);
    let shift = Vec3::new(100.0, 0.0, 0.0);
    let other = brick(shift, shift + Vec3::new(10.0, 10.0, 10.0), 1.0);
    let (vertices, edges) = (one.vertices.len() as u32, one.edges.len() as u32);
    one.vertices.extend(other.vertices);
    one.edges.extend(other.edges.into_iter().map(|mut edge| {
        edge.start += vertices;
        edge.end += vertices;
        edge
    }));
    one.faces.extend(other.faces.into_iter().map(|mut face| {
        face.boundary.iter_mut().for_each(|used| used.edge += edges);
        face
    }));
    assert_eq!(codes(&text(&part(vec![solid(one)]), &Options::default())), ["shell_not_connected"]);
}

// Foreign files.

#[test]
fn foreign_entities_are_passed_over() {
    // Comments, complex entities, a typed value, a binary, an entity nobody knows, a string over two lines.
    let more = "#70=SOMETHING_ELSE('it''s\n',\"0F\",*,$,.MAYBE.,(1,2.,(#15)),LENGTH_MEASURE(2.));\n\
                #71=(A() B(#15) C('',$));\n/* a comment; #72=( */ENDSEC;\nEND-ISO";
    assert_clean(&check(replaced(LENS, "ENDSEC;\nEND-ISO", more).as_bytes()), "foreign entities");
    assert_clean(&check(LENS.replace('\n', "\r\n").as_bytes()), "CRLF");
    let rational = "(BOUNDED_CURVE() B_SPLINE_CURVE(3,(#15,#23,#24,#16),.UNSPECIFIED.,.F.,.F.) \
        B_SPLINE_CURVE_WITH_KNOTS((4,4),(0.,1.),.UNSPECIFIED.) CURVE() GEOMETRIC_REPRESENTATION_ITEM() \
        RATIONAL_B_SPLINE_CURVE((1.,2.,2.,1.)) REPRESENTATION_ITEM(''))";
    let line = entity(LENS, 25);
    let rational = replaced(LENS, line, &format!("#25={rational};"));
    assert_clean(&check(rational.as_bytes()), "rational curve");
    assert_eq!(codes(&replaced(&rational, "WITH_KNOTS((4,4)", "WITH_KNOTS((4,5)")), ["knots_mismatch"]);
}

/// A square of 30 x 30 on a plane: straight lines for edges.
fn planar(sense: &str) -> String {
    let line = entity(LENS, 55);
    let plane = "#55=PLANE('',#80);\n#80=AXIS2_PLACEMENT_3D('',#15,#81,#66);\n#81=DIRECTION('',(0.,0.,-1.));";
    let mut text = replaced(LENS, line, plane);
    for id in [25, 29, 33, 37] {
        let curve = entity(&text, id).to_owned();
        text = replaced(&text, &curve, &format!("#{id}=LINE('',#15,#82);"));
    }
    text = replaced(&text, "#55=PLANE", "#82=VECTOR('',#66,1.);\n#55=PLANE");
    replaced(&text, "(#61),#55,.T.)", &format!("(#61),#55,{sense})"))
}

#[test]
fn planes_and_lines_are_understood() {
    assert_clean(&check(planar(".T.").as_bytes()), "plane");
    assert_eq!(codes(&planar(".F.")), ["loop_clockwise"]);
}

/// A flat face of 30 x 30 trimmed by straight edges from corner to corner of a polygon.
fn trimmed(corners: &[[f64; 2]]) -> ogee::nurbs::Shell {
    let [x, y] = [Vec3::new(30.0, 0.0, 0.0), Vec3::new(0.0, 30.0, 0.0)];
    let mut shell = sew(vec![Cloth::new(dome(Vec3::ZERO, x, y, Vec3::ZERO))]);
    let used = shell.faces[0].boundary[0];
    shell.vertices = corners.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect();
    shell.edges.clear();
    shell.faces[0].boundary.clear();
    for k in 0..corners.len() {
        let next = (k + 1) % corners.len();
        let points =
            (0..4).map(|i| shell.vertices[k].lerp(shell.vertices[next], f64::from(i) / 3.0)).collect();
        let curve = ogee::nurbs::NurbsCurve { knots: bezier(), points };
        let (start, end) = (k as u32, next as u32);
        shell.edges.push(ogee::nurbs::ShellEdge { start, end, curve, smooth: false });
        shell.faces[0].boundary.push(ogee::nurbs::EdgeUse { edge: k as u32, ..used });
    }
    shell
}

#[test]
fn trimmed_faces_are_passed_over() {
    for corners in [
        // Half of the surface, a corner cut off, much of it, little of it, a strip from one side, a notch.
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0]][..],
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [20.0, 30.0], [0.0, 30.0]],
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 29.5], [29.5, 30.0], [0.0, 30.0]],
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 29.5], [20.0, 30.0], [0.0, 30.0]],
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 28.0], [0.0, 28.0]],
        &[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0], [20.0, 30.0], [15.0, 29.0], [10.0, 30.0], [0.0, 30.0]],
    ] {
        let part = part(vec![ogee::convert::Body::Sheet(trimmed(corners))]);
        assert_clean(&check(text(&part, &Options::default()).as_bytes()), &format!("{corners:?}"));
    }
}

#[test]
fn an_edge_through_the_air_is_found() {
    let mut shell = trimmed(&[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0]]);
    shell.edges[2].curve.points[1].z += 5.0;
    let part = part(vec![ogee::convert::Body::Sheet(shell)]);
    assert_eq!(codes(&text(&part, &Options::default())), ["edge_off_surface"]);
}

// Any input.

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        check(&bytes);
        let mut file = b"ISO-10303-21;HEADER;ENDSEC;DATA;".to_vec();
        file.extend(bytes);
        check(&file);
    }

    #[test]
    fn shuffled_tokens_never_panic(picks in prop::collection::vec((0..69_usize, 0..69_usize, 0..12_usize), 1..6)) {
        let mut lines: Vec<String> = LENS.lines().map(str::to_owned).collect();
        for (one, other, what) in picks {
            let (one, other) = (6 + one, 6 + other);
            match what {
                0 => lines.swap(one, other),
                1 => lines[one] = lines[one].replacen(&format!("#{}", other - 5), "#15", 1),
                2 => lines[one] = lines[one].replacen("30.", "1.E300", 1),
                3 => lines[one] = lines[one].replacen("(4,4)", "(1,1,1,1,1,1,1,1)", 1),
                4 => lines[one] = lines[one].replacen("(0.,1.)", "(0.,1.,2.,3.,4.,5.,6.,7.)", 1),
                5 => lines[one] = lines[one].replacen(".T.", ".F.", 1),
                6 => lines[one] = lines[one].replacen("10.,", "1.E-310,", 1),
                7 => lines[one] = lines[one].replacen("#1", "#6", 1),
                8 => lines[one] = lines[one].replacen('(', "((", 1),
                9 => lines[one] = lines[one].replacen(",#", ",(#", 1),
                10 => lines[one] = lines[one].replacen("#4", "#3", 2),
                _ => lines[one] = String::new(),
            }
        }
        check(lines.join("\n").as_bytes());
    }

    #[test]
    fn changed_bytes_never_panic(changes in prop::collection::vec((0..LENS.len(), any::<u8>()), 1..8)) {
        let mut bytes = LENS.as_bytes().to_vec();
        for (place, byte) in changes {
            bytes[place] = byte;
        }
        check(&bytes);
    }
}

#[test]
fn a_part_far_from_the_origin_is_not_inside_out() {
    let mut cage = ogee::shapes::cube();
    let near =
        ogee::convert::to_part(&cage, &ogee::convert::Options::default()).unwrap().report.volume.unwrap();
    for point in &mut cage.points {
        *point += Vec3::new(1e8, 1e8, 1e8);
    }
    let part = ogee::convert::to_part(&cage, &ogee::convert::Options::default()).unwrap();
    let mut text = Vec::new();
    step::write(&part, &Options::default(), &mut text).unwrap();
    let report = check(&text);
    assert!(report.is_clean(), "{:?}", report.faults);
    // Coordinates of 1e8 are good to 1e-8.
    assert!((report.volume.unwrap() / near - 1.0).abs() < 1e-6);
}
