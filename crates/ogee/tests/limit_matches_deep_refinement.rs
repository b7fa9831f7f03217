//! Evaluation against uniform refinement with limit masks, at every parameter that refinement reaches, and along 42
//! levels towards a vertex.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{at_corner, disk, faces_at, locate, spokes, tagged, visible};
use ogee::{
    ControlMesh, Corner, Crease, FaceList, HalfedgeId, Level, LimitSurface, PatchTable, Refinement,
    Sharpness, Vec3, VertexId, limit_vertices, shapes,
};
use proptest::prelude::*;

/// Of the size of the cage.
const POSITION: f64 = 1e-12;

fn compare(name: &str, mesh: &ControlMesh, depth: u32, every: usize) -> f64 {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let refinement = Refinement::uniform(&level, depth).unwrap();
    let limits = limit_vertices(refinement.finest(), &refinement.apply(&mesh.points));
    let mut worst: f64 = 0.0;
    for number in visible(&table).into_iter().step_by(every) {
        let face = table.parametric_face(number);
        let grid = refinement.grid(face.face, face.corner);
        let side = grid.rows() - 1;
        for (i, j) in (0..=side).flat_map(|j| (0..=side).map(move |i| (i, j))) {
            let at = locate(&table, number, i as f64 / side as f64, j as f64 / side as f64);
            let wanted = limits[grid[(i, j)].index()].position;
            let gap = surface.eval(at).position.distance(wanted) / mesh.size();
            assert!(gap <= POSITION, "{name}: {face:?} ({i}, {j}) of {side}: {gap:e} {}", described(mesh));
            worst = worst.max(gap);
        }
    }
    worst
}

/// What a random cage was, if there is little of it.
fn described(mesh: &ControlMesh) -> String {
    let tags = (&mesh.faces, &mesh.creases, &mesh.corners, &mesh.holes, mesh.scheme);
    if mesh.faces.len() < 40 { format!("{tags:?}") } else { String::new() }
}

#[test]
fn every_point_of_the_third_level_agrees() {
    let mut worst: (f64, String) = (0.0, String::new());
    let cages = cages::all();
    let count = cages.len();
    for (name, mesh) in cages {
        let gap = compare(&name, &mesh, 3, 1);
        println!("{name}: {gap:.1e}");
        if gap > worst.0 {
            worst = (gap, name);
        }
    }
    println!("{count} cages, the worst: {worst:?}");
    assert!(count > 15);
}

#[test]
fn high_valence_agrees() {
    println!("{:e}", compare("disk 200", &cages::shaken(shapes::disk(200, 1), 0.005), 2, 7));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// Tags thrown on cages, so that creases meet, end, cross holes and boundaries in every way.
    #[test]
    fn any_tags_agree(mesh in tagged(Just(cages::cloud(64)))) {
        if Level::new(&mesh).is_ok() {
            compare("any tags", &mesh, 2, 1);
        }
    }
}

/// Two rings of faces around a vertex, those that touch it first, in the order of its ring and beginning with it.
fn two_rings(level: &Level, points: &[Vec3], v: VertexId) -> (ControlMesh, VertexId) {
    let topology = level.topology();
    let own: Vec<HalfedgeId> = topology.ring(v).collect();
    let mut faces: Vec<_> = own.iter().map(|&h| topology.face(h)).collect();
    for &h in &own {
        for corner in topology.halfedges(topology.face(h)) {
            faces.extend(topology.ring(topology.origin(corner)).map(|h| topology.face(h)));
        }
    }
    let mut seen = std::collections::HashSet::new();
    faces.retain(|&face| seen.insert(face));
    let mut numbers: Vec<VertexId> = Vec::new();
    let mut list = FaceList::new();
    let mut mesh = ControlMesh { scheme: level.scheme(), ..ControlMesh::default() };
    for (k, &face) in faces.iter().enumerate() {
        let first = own.get(k).copied().unwrap_or(topology.first(face));
        let around = std::iter::successors(Some(first), |&h| Some(topology.next(h)));
        let halfedges: Vec<_> = around.take(topology.face_size(face) as usize).collect();
        let mut number = |v: VertexId| {
            numbers.iter().position(|&other| other == v).unwrap_or_else(|| {
                numbers.push(v);
                numbers.len() - 1
            }) as u32
        };
        list.push(&halfedges.iter().map(|&h| number(topology.origin(h))).collect::<Vec<_>>());
        for &h in &halfedges {
            let sharpness = level.edge_sharpness(h);
            if sharpness > 0.0 {
                let vertices = [number(topology.origin(h)), number(topology.target(h))];
                mesh.creases.push(Crease { vertices, sharpness: Sharpness::from_value(sharpness) });
            }
        }
    }
    for (own, &v) in numbers.iter().enumerate() {
        let sharpness = level.vertex_sharpness(v);
        if sharpness > 0.0 {
            mesh.corners.push(Corner { vertex: own as u32, sharpness: Sharpness::from_value(sharpness) });
        }
    }
    mesh.faces = list;
    mesh.points = numbers.iter().map(|v| points[v.index()]).collect();
    (mesh, VertexId(0))
}

/// Follows a vertex down: the neighbours and diagonals of every level, and the normal at the diagonals. Returns the
/// worst gap of positions and of normals, the latter times the size of the quads.
fn descend(name: &str, mesh: &ControlMesh, v: u32) -> [f64; 2] {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let own = faces_at(&level, VertexId(v));
    let (mut ring, mut middle) = two_rings(&level, &mesh.points, VertexId(v));
    let mut worst = [0.0f64; 2];
    for depth in 1..=42 {
        let level_here = Level::new(&ring).unwrap();
        let (finer, points) = level_here.refine_points(&ring.points);
        (ring, middle) = two_rings(&finer, &points, middle);
        let here = Level::new(&ring).unwrap();
        let settled = here.semi_sharp_edges().next().is_none() && here.semi_sharp_vertices().next().is_none();
        let limits = limit_vertices(&here, &ring.points);
        for (f, &(face, corner)) in own.iter().enumerate() {
            let steps = depth - i32::from(level.topology().face_size(face) != 4);
            let x = 0.5f64.powi(steps);
            let quad = ring.faces.face(f);
            for (vertex, x, y) in [(quad[0], 0.0, 0.0), (quad[1], x, 0.0), (quad[2], x, x), (quad[3], 0.0, x)]
            {
                let point = surface.eval(at_corner(&level, &table, face, corner, x, y));
                let wanted = limits[vertex as usize];
                let gap = point.position.distance(wanted.position) / mesh.size();
                assert!(gap <= POSITION, "{name}, vertex {v}, {depth} down, {face} at ({x}, {y}): {gap:e}");
                worst[0] = worst[0].max(gap);
                // Refinement knows points to rounding only, so its normals are worse the smaller and thinner the quad.
                let [origin, right, top] = [0, 1, 3].map(|k| ring.points[quad[k] as usize]);
                let (a, b) = (right - origin, top - origin);
                let size = a.cross(b).length() / a.length().max(b.length()) / mesh.size();
                if vertex == quad[2] && steps > 0 && settled && size > 1e-8 {
                    let gap = point.normal.distance(wanted.normal.unwrap()) * size;
                    assert!(gap <= 1e-13, "{name}, vertex {v}, {depth} down, {face}: normal {gap:e}");
                    worst[1] = worst[1].max(gap);
                }
            }
        }
    }
    worst
}

#[test]
fn forty_two_levels_down_a_vertex_agree() {
    let mut cases: Vec<(String, ControlMesh, u32)> = Vec::new();
    for n in [3, 4, 5, 6, 8, 12, 20] {
        cases.push((format!("disk {n}"), disk(n), 0));
    }
    cases.push(("cube".into(), cages::cube(), 3));
    cases.push(("pyramid".into(), cages::pyramid(), 4));
    cases.push(("pyramid".into(), cages::pyramid(), 1));
    cases.push(("octahedron".into(), cages::octahedron(), 2));
    cases.push(("prism".into(), cages::prism(5), 7));
    cases.push(("valence two".into(), cages::valence_two(), 8));
    for (name, mesh) in cages::lenses() {
        cases.push((name, mesh, 0));
    }
    cases.push(("stacked lenses".into(), cages::stacked_lenses(), 9));
    cases.push(("lens of a triangle and a pentagon".into(), cages::lens_of_polygons(), 8));
    for k in [3, 4, 5] {
        cases.push((format!("fan {k}"), cages::fan(k), 0));
    }
    cases.push(("L".into(), cages::l_shape(), 12));
    for which in [vec![0, 1], vec![0, 2], vec![0, 3], vec![0, 1, 3], vec![0, 1, 2, 3]] {
        cases.push((format!("creases {which:?}"), cages::creased(disk(6), &spokes(&which, 2), 10.0), 0));
    }
    for n in [3, 4, 5] {
        cases.push((format!("dart {n}"), cages::creased(disk(n), &spokes(&[1], 2), 10.0), 0));
        cases.push((format!("cone {n}"), cages::sharp_at(disk(n), &[0], 10.0), 0));
    }
    for s in [0.3, 1.5, 3.0, 7.7] {
        let mesh = cages::creased(disk(5), &spokes(&[0, 2], 2), s);
        cases.push((format!("semi-sharp {s}"), mesh, 0));
        cases.push((format!("semi-sharp vertex {s}"), cages::sharp_at(disk(5), &[0], s), 0));
        cases.push((format!("semi-sharp dart {s}"), cages::creased(disk(4), &spokes(&[0], 2), s), 0));
    }
    for (name, mesh, v) in cases {
        let [position, normal] = descend(&name, &mesh, v);
        println!("{name}, vertex {v}: {position:.1e}, normal times quad {normal:.1e}");
    }
}
