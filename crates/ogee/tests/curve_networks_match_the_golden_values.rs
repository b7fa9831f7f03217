//! Curves, plans, X-configurations and their matrices of `testdata/curve-networks`.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use golden::{documents, faces, index, list, number, point, points};
use networks::{cases, curves};
use ogee::curve_network::{
    Crossing, CurveNetwork, NetworkError, NetworkPlan, NetworkWarning, Placing, PreSplit, TargetCurve,
    XMatrix, XRing, least_turn, place, ring_normal,
};
use ogee::{ControlMesh, Level, Topology, Vec3, limit_vertices};
use serde_json::Value;

const TOLERANCE: f64 = 1e-12;
const UP: Vec3 = Vec3::new(0.0, 0.0, 1.0);

fn document(wanted: &str) -> Value {
    let mut documents = documents("curve-networks");
    let found = documents.iter().position(|(name, _)| name == wanted);
    documents.swap_remove(found.unwrap_or_else(|| panic!("there is no {wanted}"))).1
}

fn network(input: &Value, options: &Value) -> CurveNetwork {
    let mut network = CurveNetwork { curves: curves(input), ..CurveNetwork::default() };
    network.options.placing = match options["x_mode"].as_str() {
        Some("parallelogram") => Placing::Parallelogram,
        _ => Placing::Eigen,
    };
    network.options.parameter = options["t"].as_f64();
    network.options.pre_split =
        options["pre_split"].as_u64().map_or(PreSplit::Auto, |k| PreSplit::Fixed(k as u32));
    if options["crossing"] == "smooth" {
        network.options.crossing = Crossing::Smooth;
    }
    network
}

fn case(document: &Value) -> (ControlMesh, CurveNetwork) {
    let input = &document["input"];
    let mesh = ControlMesh::new(points(&input["vertices"]), faces(&input["faces"]));
    (mesh, network(input, &input["options"]))
}

fn flat(value: &Value) -> Vec<Vec3> {
    list(value).iter().map(|p| Vec3::new(number(&p[0]), number(&p[1]), 0.0)).collect()
}

#[test]
fn eigen_rings_and_fold_tests_match() {
    let document = document("eigen-rings");
    for (i, case) in list(&document["cases"]).iter().enumerate() {
        let tangents = flat(&case["T"]);
        let ring = XRing::eigen(&tangents, number(&case["t"]), UP);
        let (free, after, before) = (flat(&case["D"]), flat(&case["P"]), flat(&case["R"]));
        for j in 0..tangents.len() {
            assert!(ring.port(j).distance(tangents[j]) == 0.0);
            assert!(ring.free_spoke(j).distance(free[j]) < TOLERANCE, "case {i}, free spoke {j}");
            assert!(ring.corner_after(j).distance(after[j]) < TOLERANCE, "case {i}, corner after port {j}");
            assert!(
                ring.corner_before(j).distance(before[j]) < TOLERANCE,
                "case {i}, corner before port {j}"
            );
        }
        let turn = least_turn(&ring, UP);
        assert!((turn - number(&case["min_sine"])).abs() < TOLERANCE, "case {i}: {turn}");
        assert_eq!(turn > 0.0, case["regular"].as_bool().unwrap(), "case {i}");
    }
    assert_eq!(list(&document["cases"]).len(), 24);
}

#[test]
fn matrices_and_their_eigenvalues_match() {
    let document = document("x-matrix-eigenvalues");
    for case in list(&document["cases"]) {
        let (ports, t) = (index(&case["ports"]) as usize, number(&case["t"]));
        let matrix = XMatrix::new(ports, t);
        for (i, row) in list(&case["matrix"]).iter().enumerate() {
            for (j, weight) in list(row).iter().enumerate() {
                let difference = matrix.weights()[(i, j)] - number(weight);
                assert!(difference.abs() < 1e-15, "{ports} ports, t = {t}, weight ({i}, {j})");
            }
        }
        let mut wanted: Vec<f64> = list(&case["eigenvalues"]).iter().map(number).collect();
        wanted.sort_by(|a, b| b.total_cmp(a));
        let found = matrix.eigenvalues();
        assert_eq!(found.len(), wanted.len());
        let worst = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-10, "{ports} ports, t = {t}: {worst:e}");
        assert!((matrix.largest_free_eigenvalue() - number(&case["largest_free"])).abs() < 1e-10);
    }
    assert_eq!(list(&document["cases"]).len(), 24);
}

#[test]
fn curves_are_sampled_alike() {
    let mut compared = 0;
    for (name, document) in cases() {
        let size = case(&document).0.size();
        for sample in list(&document["curve_samples"]) {
            let segments = list(&document["prepared"]["segments"]);
            let segment = segments.iter().find(|segment| segment["name"] == sample["segment"]).unwrap();
            let closed = segment["closed"].as_bool().unwrap();
            let curve = TargetCurve::new(points(&segment["control"]), closed).unwrap();
            let found = curve.point(number(&sample["u"]));
            assert!(found.distance(point(&sample["point"])) < TOLERANCE * size.max(1.0), "{name}: {sample}");
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn networks_are_cut_and_split_alike() {
    for (name, document) in cases() {
        let (mesh, network) = case(&document);
        let plan = NetworkPlan::new(&network, &mesh).unwrap();
        let splits = index(&document["pre_split_used"]);
        assert_eq!(plan.pre_split, splits, "{name}");
        let wanted = list(&document["prepared"]["segments"]);
        assert_eq!(plan.segments.len(), wanted.len(), "{name}");
        for (segment, wanted) in plan.segments.iter().zip(wanted) {
            let pieces = plan.segments.iter().filter(|other| other.curve == segment.curve).count();
            let curve = &network.curves[segment.curve].name;
            let called = if pieces > 1 { format!("{curve}#{}", segment.piece) } else { curve.clone() };
            assert_eq!(wanted["name"], called.as_str());
            assert_eq!(wanted["along_border"], segment.along_border);
            assert_eq!(wanted["closed"], segment.target.is_closed());
            let target = (0..splits).fold(segment.target.clone(), |curve, _| curve.refined());
            let control = points(&wanted["control"]);
            assert_eq!(target.control().len(), control.len(), "{name}, {called}");
            for (a, b) in target.control().iter().zip(control) {
                assert!(a.distance(b) < TOLERANCE * mesh.size(), "{name}, {called}: {a:?} {b:?}");
            }
        }
        let moved: Vec<&NetworkWarning> = plan.warnings.iter().collect();
        compare_warnings(&name, &moved, &document, "W_RIM_END_MOVED");
    }
}

/// Warnings of one code with their vertices and values.
fn compare_warnings(name: &str, found: &[&NetworkWarning], document: &Value, code: &str) {
    let wanted: Vec<&Value> = list(&document["warnings"]).iter().filter(|w| w["code"] == code).collect();
    let found: Vec<_> = found.iter().filter(|warning| warning.code() == code).collect();
    assert_eq!(found.len(), wanted.len(), "{name}: {found:?}");
    for (found, wanted) in found.iter().zip(wanted) {
        assert_eq!(found.vertex(), index(&wanted["vertex"]), "{name}");
        assert!((found.value().unwrap() - number(&wanted["value"])).abs() < 1e-10, "{name}: {found:?}");
    }
}

#[test]
fn x_configurations_are_placed_alike() {
    let mut compared = 0;
    for (name, document) in cases() {
        let (mesh, network) = case(&document);
        let topology = Topology::new(&mesh).unwrap();
        let plan = NetworkPlan::new(&network, &mesh).unwrap();
        let prepared = &document["prepared"];
        let vertices = points(&prepared["vertices"]);
        let wanted = list(&prepared["x_vertices"]);
        assert_eq!(plan.meetings.len(), wanted.len(), "{name}");
        let mut warnings = Vec::new();
        for wanted in wanted {
            let center = index(&wanted["center"]);
            let meeting = plan.meetings.iter().find(|meeting| meeting.vertex == center).unwrap();
            let normal = ring_normal(&topology, &mesh.points, center);
            let mut site = plan.site(&network, meeting, normal);
            for arrival in &mut site.arrivals {
                // Splits halve the first leg.
                arrival.tangent = arrival.tangent / 2.0_f64.powi(plan.pre_split as i32);
            }
            let placement = place(&site).unwrap();
            warnings.extend(placement.warnings);
            assert_eq!(placement.ring.ports(), index(&wanted["ports"]) as usize, "{name}");
            assert!((placement.parameter - number(&wanted["t"])).abs() < 1e-15, "{name}");
            let ring: Vec<u32> = list(&wanted["ring"]).iter().map(index).collect();
            let at = |v: u32| vertices[v as usize] - vertices[center as usize];
            let spokes = ring.len();
            let corner = |i: usize| {
                let slice = list(&prepared["faces"]).iter().map(|face| {
                    let face: Vec<u32> = list(face).iter().map(index).collect();
                    let start = face.iter().position(|&v| v == center);
                    start.map(|start| {
                        (0..face.len()).map(|k| face[(start + k) % face.len()]).collect::<Vec<_>>()
                    })
                });
                let slice = slice.flatten().find(|slice| slice[1] == ring[i] && slice.len() == 4).unwrap();
                assert_eq!(slice[3], ring[(i + 1) % spokes]);
                slice[2]
            };
            // Which port comes first is nobody's business.
            let distance = |shift: usize| {
                let ours = &placement.ring;
                let pairs = (0..spokes).flat_map(|i| {
                    let k = (i + 2 * shift) % spokes;
                    // Other rings than the eigen ring do not keep the first control point at the mesh's vertex.
                    let compare_port = k % 2 == 1 || network.options.placing == Placing::Eigen;
                    let spoke = compare_port.then(|| ours.ring[k].distance(at(ring[i])));
                    spoke.into_iter().chain([ours.corners[k].distance(at(corner(i)))])
                });
                pairs.fold(0.0, f64::max)
            };
            let best = (0..spokes / 2).map(distance).fold(f64::INFINITY, f64::min);
            assert!(best < TOLERANCE * mesh.size(), "{name}, vertex {center}: {best:e}");
            compared += 1;
        }
        let warnings: Vec<&NetworkWarning> = warnings.iter().collect();
        compare_warnings(&name, &warnings, &document, "W_TANGENTS_NOT_COPLANAR");
        compare_warnings(&name, &warnings, &document, "W_X_FOLD");
        compare_warnings(&name, &warnings, &document, "W_TANGENT_ORDER");
        // The golden values were made before this warning was.
        let half = warnings.iter().any(|warning| warning.code() == "W_T_HALF");
        assert_eq!(half, name.ends_with("t50"), "{name}");
    }
    assert_eq!(compared, 17);
}

#[test]
fn defects_have_their_codes() {
    let document = document("errors");
    let mesh = ControlMesh::new(points(&document["vertices"]), faces(&document["faces"]));
    for case in list(&document["cases"]) {
        let network = network(case, case);
        let code = NetworkPlan::new(&network, &mesh).as_ref().map_err(NetworkError::code).map(|_| ());
        assert_eq!(code, Err(case["expect"].as_str().unwrap()));
    }
    assert_eq!(list(&document["cases"]).len(), 8);
}

/// A vertex (number 0) in the middle of its faces, or on the border: neighbours, then the vertices opposite in the faces.
fn fan(case: &Value) -> ControlMesh {
    let (edges, diagonals) = (points(&case["e"]), points(&case["f"]));
    let (n, k) = (edges.len() as u32, diagonals.len() as u32);
    let faces = (0..k).map(|i| [0, 1 + i, 1 + n + i, 1 + (i + 1) % n]);
    let all = [point(&case["v"])].into_iter().chain(edges).chain(diagonals);
    ControlMesh::new(all.collect(), faces.collect())
}

#[test]
fn limit_masks_match() {
    let document = document("limit-masks");
    let kinds = [("interior", "t1", "t2", 5), ("border", "t_along", "t_cross", 2)];
    for (kind, first, second, count) in kinds {
        let cases = list(&document[kind]);
        assert_eq!(cases.len(), count);
        for (i, case) in cases.iter().enumerate() {
            let mesh = fan(case);
            let limit = limit_vertices(&Level::new(&mesh).unwrap(), &mesh.points)[0];
            let size = mesh.size();
            assert!(limit.position.distance(point(&case["limit"])) < TOLERANCE * size, "{kind} {i}");
            // Two bases of one plane: ours may be another than the masks'.
            let [t1, t2] = [point(&case[first]), point(&case[second])].map(|t| t.normalized().unwrap());
            let normal = limit.normal.unwrap();
            assert!(normal.dot(t1).abs().max(normal.dot(t2).abs()) < TOLERANCE, "{kind} {i}: {normal:?}");
            assert!(t1.cross(t2).length() > 0.1, "{kind} {i}");
        }
    }
}
