//! Finds every defect of a network that can be seen before the mesh is changed.

use super::defect::NetworkDefect;
use super::incidence::{Incidence, Role, edge_between, is_border};
use super::network::{Crossing, CurveNetwork, NetworkCurve, PreSplit};
use crate::math::Vec3;
use crate::mesh::{ControlMesh, Topology, VertexId};
use std::collections::BTreeMap;

/// How far control points at a common vertex may be apart, of the size of the mesh.
const SAME_POINT: f64 = 1e-9;

/// Below this length a first leg has no direction, of the size of the mesh.
const NO_LENGTH: f64 = 1e-12;

/// Everything about single curves and numbers; the rest of the checks is made of curves without such defects.
pub(super) fn check_curves(
    network: &CurveNetwork,
    mesh: &ControlMesh,
    topology: &Topology,
) -> Vec<NetworkDefect> {
    let mut defects = Vec::new();
    for curve in &network.curves {
        check_path(curve, mesh, topology, &mut defects);
        check_shape(curve, &mut defects);
        check_wants(curve, &mut defects);
    }
    check_points(network, mesh, &mut defects);
    let options = &network.options;
    let parameters = network.meetings.iter().map(|(vertex, own)| (Some(vertex), own.parameter));
    for (vertex, parameter) in parameters.chain([(None, options.parameter)]) {
        if let Some(value) = parameter.filter(|t| !(*t > 0.0 && *t <= 0.5)) {
            let what = vertex.map_or("the parameter t".into(), |v| format!("the parameter t at vertex {v}"));
            let remedy = "choose more than 0 and at most 1/2, or let it be chosen";
            defects.push(NetworkDefect::Parameter { what, value, remedy });
        }
    }
    if !(options.ribbon_width > 0.0 && options.ribbon_width < 1.0) {
        let (what, value) = ("the width of ribbons".into(), options.ribbon_width);
        defects.push(NetworkDefect::Parameter { what, value, remedy: "choose between 0 and 1" });
    }
    defects
}

fn check_path(
    curve: &NetworkCurve,
    mesh: &ControlMesh,
    topology: &Topology,
    defects: &mut Vec<NetworkDefect>,
) {
    let name = || curve.name.clone();
    let (vertices, least) = (curve.vertices.len(), if curve.closed { 3 } else { 2 });
    if vertices < least {
        defects.push(NetworkDefect::CurveShort { curve: name(), vertices, least });
        return;
    }
    let mut sorted = curve.vertices.clone();
    sorted.sort_unstable();
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        defects.push(NetworkDefect::CurveRepeats { curve: name(), vertex: pair[0] });
        return;
    }
    let count = mesh.points.len() as u32;
    for [from, to] in curve.legs() {
        let joined =
            from < count && to < count && edge_between(topology, VertexId(from), VertexId(to)).is_some();
        if !joined {
            defects.push(NetworkDefect::NotAnEdge { curve: name(), from, to });
        }
    }
}

/// Control points, or points to go through: one kind, one per vertex, finite.
pub(super) fn check_shape(curve: &NetworkCurve, defects: &mut Vec<NetworkDefect>) {
    let name = || curve.name.clone();
    if curve.control.is_some() && curve.through.is_some() {
        defects.push(NetworkDefect::TwoShapes { curve: name() });
    }
    for points in curve.control.iter().chain(&curve.through) {
        let (given, vertices) = (points.len(), curve.vertices.len());
        if given != vertices {
            defects.push(NetworkDefect::TargetLength { curve: name(), points: given, vertices });
        } else if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            defects.push(NetworkDefect::TargetNotFinite { curve: name(), index });
        }
    }
}

/// Normals and cross curvatures: one per vertex or none, finite, with a direction.
fn check_wants(curve: &NetworkCurve, defects: &mut Vec<NetworkDefect>) {
    let vertices = curve.vertices.len();
    let lengths = [("normals", curve.normals.len()), ("cross curvatures", curve.cross_curvatures.len())];
    for (what, given) in lengths {
        if given != 0 && given != vertices {
            let curve = curve.name.clone();
            defects.push(NetworkDefect::ConstraintLength { curve, what, given, vertices });
        }
    }
    for (&vertex, normal) in curve.vertices.iter().zip(&curve.normals) {
        if normal.is_some_and(|normal| !has_direction(normal)) {
            defects.push(NetworkDefect::ConstraintNotFinite { what: "a normal", vertex });
        }
    }
    for (&vertex, curvature) in curve.vertices.iter().zip(&curve.cross_curvatures) {
        if curvature.is_some_and(|curvature| !curvature.is_finite()) {
            defects.push(NetworkDefect::ConstraintNotFinite { what: "a cross curvature", vertex });
        }
    }
}

fn has_direction(normal: Vec3) -> bool {
    normal.is_finite() && normal.normalized().is_some()
}

/// Points that are wanted: at vertices of the cage, finite, and only where fairing gives them.
fn check_points(network: &CurveNetwork, mesh: &ControlMesh, defects: &mut Vec<NetworkDefect>) {
    let count = mesh.points.len();
    if let Some(first) = network.points.first().filter(|_| !network.options.fair) {
        defects.push(NetworkDefect::PointsWithoutFairing { vertex: first.vertex });
    }
    for point in &network.points {
        let vertex = point.vertex;
        if vertex as usize >= count {
            defects.push(NetworkDefect::PointVertex { vertex, count });
        }
        if point.position.is_some_and(|position| !position.is_finite()) {
            defects.push(NetworkDefect::ConstraintNotFinite { what: "a point", vertex });
        }
        if point.normal.is_some_and(|normal| !has_direction(normal)) {
            defects.push(NetworkDefect::ConstraintNotFinite { what: "a normal", vertex });
        }
    }
    let normals = network.meetings.iter().filter_map(|(&vertex, own)| Some((vertex, own.normal?)));
    for (vertex, _) in normals.filter(|(_, normal)| !has_direction(*normal)) {
        defects.push(NetworkDefect::ConstraintNotFinite { what: "a normal", vertex });
    }
}

/// What curves do to each other and to the mesh. All legs are edges.
pub(super) fn check_together(
    network: &CurveNetwork,
    mesh: &ControlMesh,
    topology: &Topology,
    incidence: &Incidence,
) -> Vec<NetworkDefect> {
    let mut defects = Vec::new();
    check_edges(network, topology, &mut defects);
    check_sharpness(network, mesh, topology, incidence, &mut defects);
    let size = mesh.size();
    let targets: Vec<Vec<Vec3>> = network.curves.iter().map(|curve| curve.target(&mesh.points)).collect();
    let name = |curve: usize| network.curves[curve].name.clone();
    for (&v, edges) in &incidence.vertices {
        let vertex = v.0;
        let inward: Vec<_> = edges.iter().filter(|edge| !edge.border).collect();
        if topology.is_boundary(v) && inward.len() > 1 {
            let curve = name(inward[0].curve);
            defects.push(NetworkDefect::BorderMeeting { curve, vertex, edges: inward.len() });
            continue;
        }
        let role = incidence.role(v, topology, network.options.crossing);
        if role == Role::Meeting {
            for edge in edges {
                let control = &targets[edge.curve];
                let step = if edge.forward { 1 } else { control.len() - 1 };
                let leg = control[(edge.position + step) % control.len()] - control[edge.position];
                if leg.length() <= NO_LENGTH * size {
                    defects.push(NetworkDefect::ZeroTangent { curve: name(edge.curve), vertex });
                }
            }
        }
        // A curve that starts on one along the border is moved there; others must agree.
        let agreeing = edges.iter().filter(|edge| edge.border || !topology.is_boundary(v));
        let mut agreeing = agreeing.map(|edge| (edge.curve, targets[edge.curve][edge.position]));
        if let Some((curve, point)) = agreeing.next().filter(|_| role != Role::SmoothCrossing) {
            let farthest = agreeing.map(|(other, p)| (other, p.distance(point)));
            let worst = farthest.max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((other, distance)) = worst.filter(|worst| worst.1 > SAME_POINT * size) {
                let (curve, other) = (name(curve), name(other));
                defects.push(NetworkDefect::MeetingPointMismatch { curve, other, vertex, distance });
            }
        }
        let curve = || name(edges[0].curve);
        if role == Role::Path && !network.options.repair && !incidence.runs_straight(v, topology) {
            defects.push(NetworkDefect::PathValence { curve: curve(), vertex });
        }
    }
    defects
}

/// Edges of two curves, and curves that leave the border on their way.
fn check_edges(network: &CurveNetwork, topology: &Topology, defects: &mut Vec<NetworkDefect>) {
    let mut owners: BTreeMap<_, usize> = BTreeMap::new();
    for (number, curve) in network.curves.iter().enumerate() {
        let mut before = None;
        for [from, to] in curve.legs() {
            let Some(edge) = edge_between(topology, VertexId(from), VertexId(to)) else { continue };
            if let Some(other) = owners.insert(edge, number) {
                let (curve, other) = (curve.name.clone(), network.curves[other].name.clone());
                defects.push(NetworkDefect::SharedEdge { curve, other, from, to });
            }
            let border = is_border(topology, edge);
            if before.replace(border).is_some_and(|before| before != border) {
                defects.push(NetworkDefect::BorderMixed { curve: curve.name.clone(), vertex: from });
            }
        }
    }
}

/// Sharp edges that a curve follows or meets, sharp vertices that it goes through: rules along it are smooth ones.
fn check_sharpness(
    network: &CurveNetwork,
    mesh: &ControlMesh,
    topology: &Topology,
    incidence: &Incidence,
    defects: &mut Vec<NetworkDefect>,
) {
    let name = |curve: usize| network.curves[curve].name.clone();
    // If an edge or vertex is named twice the last one counts.
    let mut creases = BTreeMap::new();
    for crease in &mesh.creases {
        let [from, to] = crease.vertices;
        creases.insert((from.min(to), from.max(to)), crease.sharpness.value());
    }
    for ((from, to), _) in creases.into_iter().filter(|crease| crease.1 > 0.0) {
        let (a, b) = (VertexId(from), VertexId(to));
        if edge_between(topology, a, b).is_none_or(|e| is_border(topology, e)) {
            continue;
        }
        if let Some(edge) = incidence.at(a).iter().chain(incidence.at(b)).next() {
            defects.push(NetworkDefect::Crease { curve: name(edge.curve), from, to });
        }
    }
    let corners: BTreeMap<u32, f64> =
        mesh.corners.iter().map(|corner| (corner.vertex, corner.sharpness.value())).collect();
    for (vertex, _) in corners.into_iter().filter(|corner| corner.1 > 0.0) {
        // A curve along the border may end at a corner: it ends naturally there.
        let v = VertexId(vertex);
        let edges = incidence.at(v);
        let ends_there = |curve: usize| edges.iter().filter(|edge| edge.curve == curve).count() == 1;
        if let Some(edge) = edges.iter().find(|edge| !edge.border || !ends_there(edge.curve)) {
            defects.push(NetworkDefect::SharpVertex { curve: name(edge.curve), vertex });
        }
    }
}

/// Crossings that are to be smooth and cannot be.
pub(super) fn check_crossings(
    network: &CurveNetwork,
    topology: &Topology,
    incidence: &Incidence,
    splits: u32,
) -> Vec<NetworkDefect> {
    if network.options.crossing == Crossing::Pin {
        return Vec::new();
    }
    let quads = |v: VertexId| topology.ring(v).all(|h| topology.face_size(topology.face(h)) == 4);
    let bad = incidence.vertices.keys().filter_map(|&v| {
        let curves = incidence.crossing_curves(v).filter(|_| !topology.is_boundary(v))?;
        let regular = incidence.crosses_straight(v, topology) && (splits > 0 || quads(v));
        let [curve, other] = curves.map(|curve| network.curves[curve].name.clone());
        (!regular).then_some(NetworkDefect::CrossingNotRegular { curve, other, vertex: v.0 })
    });
    bad.collect()
}

/// Numbers of splits given by hand that leave two meeting points side by side.
pub(super) fn x_adjacent(pre_split: PreSplit, legs: usize, meets: [bool; 2]) -> bool {
    pre_split == PreSplit::Fixed(0) && legs == 1 && meets == [true, true]
}
