//! An irregular polyhedron: the hull of points on an ellipsoid, some triangles joined in pairs; and walks on it.

use std::collections::BTreeSet;

use ogee::{ControlMesh, FaceList, Topology, TopologyError, Vec3, VertexId};

/// Points on an ellipsoid, about evenly, each a little off.
fn points(count: u32) -> Vec<Vec3> {
    let mut state = 7_u64;
    let mut random = || {
        // Lehmer.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|i| {
            let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
            let (angle, around) = (turn * f64::from(i), (1.0 - z * z).sqrt());
            let off = 0.3 * Vec3::new(random(), random(), random());
            let p = (Vec3::new(around * angle.cos(), around * angle.sin(), z) + off).normalized();
            let p = p.unwrap_or_default();
            Vec3::new(1.3 * p.x, p.y, 0.9 * p.z)
        })
        .collect()
}

/// The hull, with pairs of triangles that are nearest to flat joined, as many as asked for.
pub(super) fn polyhedron(count: u32, joined: usize) -> ControlMesh {
    let points = points(count);
    let at = |i: u32| points[i as usize];
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                let normal = (at(b) - at(a)).cross(at(c) - at(a));
                let side = |i: u32| normal.dot(at(i) - at(a));
                let others = || (0..count).filter(|i| ![a, b, c].contains(i));
                if others().all(|i| side(i) < 0.0) {
                    triangles.push([a, b, c]);
                } else if others().all(|i| side(i) > 0.0) {
                    triangles.push([a, c, b]);
                }
            }
        }
    }
    let normal = |[a, b, c]: [u32; 3]| (at(b) - at(a)).cross(at(c) - at(a));
    let mut pairs: Vec<(f64, usize, usize, [u32; 4])> = Vec::new();
    for (i, one) in triangles.iter().enumerate() {
        for (j, other) in triangles.iter().enumerate().skip(i + 1) {
            for k in 0..3 {
                let (a, b, apex) = (one[k], one[(k + 1) % 3], one[(k + 2) % 3]);
                let back = (0..3).find(|&m| other[m] == b && other[(m + 1) % 3] == a);
                if let Some(m) = back {
                    let bend = normal(*one).angle(normal(*other));
                    pairs.push((bend, i, j, [a, other[(m + 2) % 3], b, apex]));
                }
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut used = BTreeSet::new();
    let mut faces = FaceList::new();
    for (_, i, j, quad) in pairs {
        if faces.len() < joined && !used.contains(&i) && !used.contains(&j) {
            used.extend([i, j]);
            faces.push(&quad);
        }
    }
    for (_, triangle) in triangles.iter().enumerate().filter(|(i, _)| !used.contains(i)) {
        faces.push(triangle);
    }
    ControlMesh::new(points, faces)
}

/// Paths of so many edges from a vertex, one along every `every`-th of its edges, each as straight on as it goes and apart
/// from the others.
pub(super) fn walks(
    mesh: &ControlMesh,
    from: u32,
    every: usize,
    edges: usize,
) -> Result<Vec<Vec<u32>>, TopologyError> {
    let topology = Topology::new(mesh)?;
    let at = |v: VertexId| mesh.points[v.index()];
    let mut taken = BTreeSet::from([VertexId(from)]);
    let starts: Vec<VertexId> =
        topology.ring(VertexId(from)).step_by(every).map(|h| topology.target(h)).collect();
    taken.extend(&starts);
    let mut paths: Vec<Vec<VertexId>> = starts.into_iter().map(|to| vec![VertexId(from), to]).collect();
    for _ in 1..edges {
        for path in &mut paths {
            let (before, here) = (path[path.len() - 2], path[path.len() - 1]);
            let ahead = at(here) - at(before);
            let free = topology.ring(here).map(|h| topology.target(h)).filter(|to| !taken.contains(to));
            let straightest =
                free.min_by(|a, b| ahead.angle(at(*a) - at(here)).total_cmp(&ahead.angle(at(*b) - at(here))));
            if let Some(to) = straightest {
                taken.insert(to);
                path.push(to);
            }
        }
    }
    Ok(paths.into_iter().map(|path| path.into_iter().map(|v| v.0).collect()).collect())
}
