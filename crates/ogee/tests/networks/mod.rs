//! The golden networks of curves, and places along the edges of a cage.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use super::golden::{documents, faces, index, list, number, points};
use ogee::curve_network::NetworkCurve;
use ogee::{
    Boundary, ControlMesh, Corner, HalfedgeId, Level, Location, Meeting, PatchTable, Sharpness, VertexId,
};
use serde_json::Value;

/// The documents that have a mesh and its preparation.
pub fn cases() -> Vec<(String, Value)> {
    let mut cases = documents("curve-networks");
    cases.retain(|(_, document)| !document["prepared"].is_null());
    assert_eq!(cases.len(), 15);
    cases
}

/// The curves of an input.
pub fn curves(input: &Value) -> Vec<NetworkCurve> {
    let curve = |curve: &Value| NetworkCurve {
        name: curve["name"].as_str().unwrap().to_owned(),
        vertices: list(&curve["vertices"]).iter().map(index).collect(),
        closed: curve["closed"].as_bool().unwrap(),
        control: (!curve["control"].is_null()).then(|| points(&curve["control"])),
        ..NetworkCurve::default()
    };
    list(&input["curves"]).iter().map(curve).collect()
}

/// The cage of `prepared`, with its meetings.
pub fn prepared(cage: &Value) -> ControlMesh {
    let mut mesh = ControlMesh::new(points(&cage["vertices"]), faces(&cage["faces"]));
    mesh.scheme.boundary = Boundary::EdgeOnly;
    let corner = |vertex| Corner { vertex: index(vertex), sharpness: Sharpness::Infinite };
    mesh.corners = list(&cage["corners"]).iter().map(corner).collect();
    let meeting = |x: &Value| Meeting {
        vertex: index(&x["center"]),
        ports: list(&x["ring"]).iter().step_by(2).map(index).collect(),
        t: number(&x["t"]),
    };
    mesh.meetings = list(&cage["x_vertices"]).iter().map(meeting).collect();
    mesh
}

/// Where the edge from `a` to `b` is, `t` along it, on a quad beside it.
pub fn along(level: &Level, table: &PatchTable, [a, b]: [u32; 2], t: f64) -> Location {
    let topology = level.topology();
    let between = |a: u32, b: u32| topology.ring(VertexId(a)).find(|&h| topology.target(h).0 == b);
    let (h, t): (HalfedgeId, f64) =
        between(a, b).map(|h| (h, t)).or_else(|| Some((between(b, a)?, 1.0 - t))).unwrap();
    let face = topology.face(h);
    assert_eq!(topology.face_size(face), 4, "faces at curves are quads");
    let (u, v) = match h.0 - topology.first(face).0 {
        0 => (t, 0.0),
        1 => (1.0, t),
        2 => (1.0 - t, 1.0),
        _ => (0.0, 1.0 - t),
    };
    table.locate(face, None, u, v).unwrap()
}
