//! The golden networks of curves, and places along the edges of a cage.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use super::golden::{documents, faces, index, list, number, points};
use ogee::curve_network::{Embedding, NetworkCurve};
use ogee::{
    Boundary, ControlMesh, Corner, FaceList, HalfedgeId, Level, LimitSurface, Location, Meeting, PatchTable,
    Sharpness, Topology, Vec3, VertexId, shapes,
};
use proptest::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;

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

/// The largest distance of the limit surface from the curves.
pub fn surface_error(embedding: &Embedding) -> f64 {
    let level = Level::new(&embedding.mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &embedding.mesh.points);
    let mut worst = 0.0_f64;
    for segment in &embedding.segments {
        let path = &segment.vertices;
        for k in 0..segment.target.spans() {
            for t in [0.0, 0.013, 0.4, 0.77] {
                let at = along(&level, &table, [path[k], path[(k + 1) % path.len()]], t);
                worst = worst.max(surface.eval(at).position.distance(segment.target.point(k as f64 + t)));
            }
        }
    }
    worst
}

/// The octahedron: eight triangles, six vertices of valence 4.
pub fn octahedron() -> ControlMesh {
    let points = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let points = points.map(|p| Vec3::from(p.map(f64::from))).to_vec();
    let faces = (0..4).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]);
    ControlMesh::new(points, faces.collect())
}

/// A prism over a pentagon with one side cut off by triangles: polygons of three, four and five corners.
fn prism() -> ControlMesh {
    let turn = |i: u32| f64::from(i) * std::f64::consts::TAU / 5.0;
    let ring = |z: f64| (0..5).map(move |i| Vec3::new(turn(i).cos(), turn(i).sin(), z));
    let mut points: Vec<Vec3> = ring(0.0).chain(ring(1.0)).collect();
    points.push(Vec3::new(0.0, 0.0, 1.6));
    let mut faces = FaceList::new();
    faces.push(&[4, 3, 2, 1, 0]);
    for i in 0..5 {
        let j = (i + 1) % 5;
        faces.push(&[i, j, 5 + j, 5 + i]);
        faces.push(&[5 + i, 5 + j, 10]);
    }
    ControlMesh::new(points, faces)
}

/// Seven meshes: closed and open, of quads and others.
pub fn cages(kind: usize) -> ControlMesh {
    match kind {
        0 => shapes::cube(),
        1 => octahedron(),
        2 => shapes::grid(4, 4),
        3 => shapes::torus(5, 4),
        4 => shapes::disk(5, 2),
        5 => shapes::disk(3, 2),
        _ => prism(),
    }
}

/// Paths that never use a vertex or an edge of their own twice, nor an edge of another: each step takes the first free
/// neighbour from a random one on. Inside they may meet; a border vertex ends them.
pub fn walks(mesh: &ControlMesh, seeds: &[Vec<usize>]) -> Vec<NetworkCurve> {
    let topology = Topology::new(mesh).unwrap();
    let mut used = BTreeSet::new();
    let mut ends = BTreeSet::new();
    let mut curves = Vec::new();
    for (number, seed) in seeds.iter().enumerate() {
        let mut path = vec![(seed[0] % topology.vertex_count()) as u32];
        for &choice in &seed[1..] {
            let v = VertexId(path[path.len() - 1]);
            if topology.is_boundary(v) && path.len() > 1 {
                break;
            }
            let ring: Vec<_> = topology.ring(v).collect();
            let taken = |v: VertexId| topology.is_boundary(v) && ends.contains(&v);
            let free = (0..ring.len()).map(|k| ring[(choice + k) % ring.len()]).find(|&h| {
                let (to, edge) = (topology.target(h), topology.edge(h));
                let blocked = taken(v) || taken(to) || used.contains(&edge) || path.contains(&to.0);
                topology.twin(h).is_some() && !blocked
            });
            let Some(h) = free else { break };
            used.insert(topology.edge(h));
            path.push(topology.target(h).0);
        }
        let tips = [path[0], path[path.len() - 1]].map(VertexId);
        if path.len() > 1 {
            ends.extend(tips);
            curves.push(NetworkCurve {
                name: format!("c{number}"),
                vertices: path,
                ..NetworkCurve::default()
            });
        }
    }
    curves
}

/// The number of a cage, random choices for up to so many paths on it, and whether ribbons are forced.
pub fn any_network(paths: usize) -> impl Strategy<Value = (usize, Vec<Vec<usize>>, bool)> {
    let seeds = prop::collection::vec(prop::collection::vec(0usize..1000, 2..7), 1..=paths);
    (0usize..7, seeds, prop::bool::weighted(0.2))
}
