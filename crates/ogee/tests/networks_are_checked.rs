//! Every defect of a network is found, named with its curve and vertex, and nothing panics.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use ogee::curve_network::{
    Crossing, CurveNetwork, MeetingOptions, NetworkCurve, NetworkError, NetworkPlan, PointConstraint,
    PreSplit, embed,
};
use ogee::{ControlMesh, Corner, Crease, FaceList, Sharpness, Vec3, shapes};
use proptest::prelude::*;

fn curve(name: &str, vertices: &[u32]) -> NetworkCurve {
    NetworkCurve { name: name.into(), vertices: vertices.to_vec(), ..NetworkCurve::default() }
}

fn network(curves: Vec<NetworkCurve>) -> CurveNetwork {
    CurveNetwork { curves, ..CurveNetwork::default() }
}

/// Vertex `(i, j)` is `6 j + i`.
fn grid() -> ControlMesh {
    shapes::grid(5, 5)
}

fn refused(network: &CurveNetwork, mesh: &ControlMesh) -> NetworkError {
    NetworkPlan::new(network, mesh).expect_err("a defect")
}

#[test]
fn cages_have_one_network() {
    let across = network(vec![curve("first", &[8, 14]), curve("second", &[14, 13])]);
    let embedded = embed(&across, &grid()).unwrap().mesh;
    assert!(!embedded.meetings.is_empty());
    let again = network(vec![curve("spine", &[2, 8, 14, 20, 26, 32])]);
    let error = embed(&again, &embedded).unwrap_err();
    assert_eq!(error.code(), "E_MEETING_ALREADY");
    assert!(
        error.to_string().contains(&format!("at vertex {} already", embedded.meetings[0].vertex)),
        "{error}"
    );
}

#[test]
fn curves_along_sharp_edges_are_refused() {
    let along = network(vec![curve("spine", &[2, 8, 14, 20, 26, 32])]);
    let sharp = |a, b, sharpness| {
        let mut mesh = grid();
        mesh.creases.push(Crease { vertices: [a, b], sharpness });
        mesh
    };
    let error = refused(&along, &sharp(14, 8, Sharpness::Infinite));
    assert_eq!(error.code(), "E_CREASE");
    assert!(error.to_string().contains("curve spine meets sharp edge 8-14"), "{error}");
    // Across the curve too: an edge point beside it would obey another rule.
    assert_eq!(refused(&along, &sharp(14, 15, Sharpness::Finite(0.5))).code(), "E_CREASE");
    assert!(NetworkPlan::new(&along, &sharp(15, 21, Sharpness::Infinite)).is_ok());
    assert!(NetworkPlan::new(&along, &sharp(14, 8, Sharpness::Finite(0.0))).is_ok());
    let mut mesh = grid();
    mesh.corners.push(Corner { vertex: 20, sharpness: Sharpness::Infinite });
    assert_eq!(refused(&along, &mesh).code(), "E_CREASE");
    // A curve along the border ends naturally at a corner, and nowhere else.
    let rim = network(vec![curve("rim", &[0, 1, 2, 3, 4, 5])]);
    let mut mesh = grid();
    mesh.corners.push(Corner { vertex: 5, sharpness: Sharpness::Infinite });
    assert!(NetworkPlan::new(&rim, &mesh).is_ok());
    mesh.corners.push(Corner { vertex: 3, sharpness: Sharpness::Infinite });
    assert_eq!(refused(&rim, &mesh).code(), "E_CREASE");
}

#[test]
fn first_legs_without_length_are_refused() {
    let mut dangling = curve("whisker", &[2, 8, 14]);
    let at = Vec3::new(2.0, 2.0, 0.0);
    dangling.control = Some(vec![Vec3::new(2.0, 0.0, 0.0), at, at]);
    let error = refused(&network(vec![dangling.clone()]), &grid());
    assert_eq!(error.code(), "E_ZERO_TANGENT");
    assert!(error.to_string().contains("whisker") && error.to_string().contains("vertex 14"), "{error}");
    // Anywhere else it does no harm.
    let mut through = curve("through", &[2, 8, 14, 20, 26, 32]);
    through.control = Some(vec![at; 6]);
    assert!(NetworkPlan::new(&network(vec![through]), &grid()).is_ok());
}

#[test]
fn borders_take_one_curve_at_a_vertex() {
    let touching = network(vec![curve("bow", &[8, 2, 3, 9])]);
    assert_eq!(refused(&touching, &grid()).code(), "E_BORDER_MIXED");
    // Two inner edges at one border vertex need a fan of three faces.
    let mesh = shapes::disk(3, 1);
    let middle = 0;
    let plan = NetworkPlan::new(&network(vec![curve("spoke", &[middle, 1])]), &mesh);
    assert!(plan.is_ok(), "{plan:?}");
    let faces: FaceList = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]].into_iter().collect();
    let mut fan = ControlMesh::new(shapes::grid(2, 2).points, faces);
    let corner = fan.points.len() as u32;
    // Vertex 1 gets a third face below it: edges 1-4 and 1-2 lead inward.
    fan.points.extend([Vec3::new(1.0, -1.0, 0.0), Vec3::new(2.0, -1.0, 0.0)]);
    fan.faces.push(&[1, corner, corner + 1, 2]);
    let both = network(vec![curve("a", &[1, 4]), curve("b", &[1, 2])]);
    assert_eq!(refused(&both, &fan).code(), "E_BORDER_MEETING");
}

#[test]
fn paths_must_run_straight_where_nothing_may_be_changed() {
    let mut bent = network(vec![curve("bent", &[2, 8, 9, 10, 11])]);
    assert!(NetworkPlan::new(&bent, &grid()).is_ok());
    bent.options.repair = false;
    let error = refused(&bent, &grid());
    assert_eq!(error.code(), "E_PATH_VALENCE");
    assert!(error.to_string().contains("curve bent: vertex 8"), "{error}");
    bent.curves[0].vertices = vec![2, 8, 14, 20];
    assert!(NetworkPlan::new(&bent, &grid()).is_ok());
    let mut around = network(vec![curve("around", &[0, 1, 3, 2])]);
    (around.curves[0].closed, around.options.repair) = (true, false);
    assert_eq!(refused(&around, &shapes::cube()).code(), "E_PATH_VALENCE");
}

#[test]
fn smooth_crossings_need_a_regular_vertex() {
    let rows = |a: &[u32], b: &[u32]| {
        let mut crossing = network(vec![curve("a", a), curve("b", b)]);
        crossing.options.crossing = Crossing::Smooth;
        crossing
    };
    let straight = rows(&[2, 8, 14, 20, 26, 32], &[12, 13, 14, 15, 16, 17]);
    let plan = NetworkPlan::new(&straight, &grid()).unwrap();
    assert_eq!((plan.smooth_crossings, plan.meetings.len(), plan.segments.len()), (vec![14], 0, 2));
    let turning = rows(&[2, 8, 14, 13, 12], &[32, 26, 20, 14, 15, 16, 17]);
    assert_eq!(refused(&turning, &grid()).code(), "E_CROSSING_NOT_REGULAR");
}

#[test]
fn numbers_out_of_range_are_refused() {
    let good = network(vec![curve("spine", &[2, 8, 14])]);
    for t in [0.0, -1.0, 0.6, f64::NAN] {
        let mut bad = good.clone();
        bad.options.parameter = Some(t);
        assert_eq!(refused(&bad, &grid()).code(), "E_PARAMETER");
        let mut bad = good.clone();
        bad.meetings.insert(14, MeetingOptions { parameter: Some(t), ..MeetingOptions::default() });
        assert!(refused(&bad, &grid()).to_string().contains("vertex 14"));
    }
    let mut bad = good.clone();
    bad.options.ribbon_width = 1.0;
    assert_eq!(refused(&bad, &grid()).code(), "E_PARAMETER");
    let mut bad = good.clone();
    bad.curves[0].control = Some(vec![Vec3::new(f64::INFINITY, 0.0, 0.0); 3]);
    assert_eq!(refused(&bad, &grid()).code(), "E_TARGET_NOT_FINITE");
    let mut deep = good;
    deep.options.pre_split = PreSplit::Fixed(60);
    assert_eq!(embed(&deep, &grid()).unwrap_err().code(), "E_PARAMETER");
}

#[test]
fn wishes_that_cannot_be_are_refused() {
    let good = network(vec![curve("spine", &[2, 8, 14, 20, 26, 32])]);
    let with = |change: &dyn Fn(&mut NetworkCurve)| {
        let mut bad = good.clone();
        change(&mut bad.curves[0]);
        refused(&bad, &grid())
    };
    let up = Some(Vec3::new(0.0, 0.0, 1.0));
    let error = with(&|curve| curve.normals = vec![up; 5]);
    assert_eq!(error.code(), "E_CONSTRAINT_LENGTH");
    assert!(error.to_string().contains("curve spine has 5 normals for 6 vertices"), "{error}");
    assert_eq!(with(&|curve| curve.cross_curvatures = vec![None; 7]).code(), "E_CONSTRAINT_LENGTH");
    let error = with(&|curve| curve.normals = vec![up, up, Some(Vec3::ZERO), up, up, up]);
    assert_eq!(error.code(), "E_CONSTRAINT_NOT_FINITE");
    assert!(error.to_string().contains("vertex 14"), "{error}");
    let error = with(&|curve| curve.cross_curvatures = vec![Some(f64::NAN); 6]);
    assert_eq!((error.code(), error.defects.len()), ("E_CONSTRAINT_NOT_FINITE", 6));
    let mut points = good.clone();
    points.points = vec![PointConstraint { vertex: 15, ..PointConstraint::default() }];
    assert_eq!(refused(&points, &grid()).code(), "E_POINTS_WITHOUT_FAIRING");
    points.options.fair = true;
    assert!(NetworkPlan::new(&points, &grid()).is_ok());
    points.points[0].vertex = 36;
    assert_eq!(refused(&points, &grid()).code(), "E_POINT_VERTEX");
    points.points[0] = PointConstraint { vertex: 3, position: None, normal: Some(Vec3::ZERO) };
    assert_eq!(refused(&points, &grid()).code(), "E_CONSTRAINT_NOT_FINITE");
}

#[test]
fn ends_of_curves_along_the_border_are_told_of_where_it_goes_on() {
    let codes = |curves: Vec<NetworkCurve>, mesh: &ControlMesh| {
        let plan = NetworkPlan::new(&network(curves), mesh).unwrap();
        plan.warnings.iter().map(|warning| (warning.code(), warning.vertex())).collect::<Vec<_>>()
    };
    assert_eq!(codes(vec![curve("rim", &[0, 1, 2, 3, 4, 5])], &grid()), []);
    assert_eq!(codes(vec![curve("rim", &[0, 1, 2, 3])], &grid()), [("W_BORDER_END", 3)]);
    let mut mesh = grid();
    mesh.corners.push(Corner { vertex: 3, sharpness: Sharpness::Infinite });
    assert_eq!(codes(vec![curve("rim", &[0, 1, 2, 3])], &mesh), []);
}

#[test]
fn meshes_that_are_not_sound_are_refused() {
    let mut mesh = grid();
    mesh.faces.push(&[0, 1, 20]);
    let error = refused(&network(vec![curve("a", &[2, 8])]), &mesh);
    assert_eq!(error.code(), "E_NONMANIFOLD");
    let bad = ControlMesh::new(vec![Vec3::ZERO], FaceList::new());
    assert_eq!(refused(&network(Vec::new()), &bad).code(), "no_faces");
}

#[test]
fn splits_keep_meeting_points_apart() {
    let splits = |curves: &[&[u32]], closed: bool| {
        let curves = curves
            .iter()
            .enumerate()
            .map(|(i, path)| NetworkCurve { closed, ..curve(&format!("c{i}"), path) });
        NetworkPlan::new(&network(curves.collect()), &grid()).unwrap().pre_split
    };
    // From border to border; one end inside; both ends inside with one, two and three edges.
    assert_eq!(splits(&[&[2, 8, 14, 20, 26, 32]], false), 0);
    assert_eq!(splits(&[&[2, 8]], false), 1);
    assert_eq!(splits(&[&[2, 8, 14]], false), 0);
    assert_eq!(splits(&[&[7, 8]], false), 2);
    assert_eq!(splits(&[&[7, 8, 9]], false), 1);
    assert_eq!(splits(&[&[7, 8, 9, 10]], false), 0);
    assert_eq!(splits(&[&[7, 8, 14, 13]], true), 0);
    let loops = NetworkPlan::new(
        &network(vec![
            NetworkCurve { closed: true, ..curve("loop", &[7, 8, 14, 13]) },
            curve("tail", &[14, 15, 16, 17]),
        ]),
        &grid(),
    );
    let plan = loops.unwrap();
    assert_eq!(plan.segments[0].vertices, [14, 13, 7, 8, 14]);
    assert_eq!((plan.segments.len(), plan.meetings.len(), plan.meetings[0].arrivals.len()), (2, 1, 3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn networks_thrown_together_never_panic(
        paths in prop::collection::vec(
            (prop::collection::vec(0u32..10, 0..6), any::<bool>(), prop::option::of(0usize..6)),
            0..4,
        ),
        smooth in any::<bool>(),
        forced in any::<bool>(),
        splits in prop::option::of(0u32..2),
    ) {
        let curves = paths.into_iter().enumerate().map(|(i, (vertices, closed, control))| NetworkCurve {
            name: format!("c{i}"),
            vertices,
            closed,
            control: control.map(|count| vec![Vec3::new(0.5, 0.5, i as f64); count]),
            ..NetworkCurve::default()
        });
        let mut network = network(curves.collect());
        if smooth {
            network.options.crossing = Crossing::Smooth;
        }
        network.options.force_ribbons = forced;
        network.options.pre_split = splits.map_or(PreSplit::Auto, PreSplit::Fixed);
        for mesh in [shapes::grid(2, 2), shapes::cube()] {
            if let Ok(embedding) = embed(&network, &mesh) {
                prop_assert!(embedding.mesh.points.iter().all(|p| p.is_finite()));
            }
        }
    }
}
