//! Cages with meetings of curves are refined as the golden data say, to rounding; meetings never move.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod golden;
mod networks;

use std::collections::HashMap;

use golden::{index, list, points};
use networks::{cases, prepared};
use ogee::{FaceId, HalfedgeId, Level, Topology, Vec3, VertexId};

/// The faces of the next level in the numbers of the golden data: vertices, edges in the order of first meeting them, faces.
fn split(faces: &[Vec<u32>], vertices: u32) -> (Vec<Vec<u32>>, u32) {
    let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
    let mut of = Vec::new();
    for face in faces {
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            let next = vertices + edges.len() as u32;
            of.push(*edges.entry([a.min(b), a.max(b)]).or_insert(next));
        }
    }
    let middle = vertices + edges.len() as u32;
    let mut out = Vec::new();
    for (f, face) in (0..).zip(faces) {
        let own = of[..face.len()].to_vec();
        of.drain(..face.len());
        for (k, &corner) in face.iter().enumerate() {
            out.push(vec![corner, own[k], middle + f, own[(k + face.len() - 1) % face.len()]]);
        }
    }
    (out, middle + faces.len() as u32)
}

/// The greatest distance between corners of faces that are the same.
fn farthest(topology: &Topology, ours: &[Vec3], faces: &[Vec<u32>], theirs: &[Vec3]) -> f64 {
    let mut worst = 0.0_f64;
    for (f, face) in (0..).zip(faces) {
        let first = topology.first(FaceId(f)).0;
        for (k, &v) in (0..).zip(face) {
            let own = topology.origin(HalfedgeId(first + k));
            worst = worst.max(ours[own.index()].distance(theirs[v as usize]));
        }
    }
    worst
}

#[test]
fn steps_are_the_golden_ones() {
    let mut compared = 0;
    for (name, document) in cases() {
        let mesh = prepared(&document["prepared"]);
        let tolerance = 1e-12 * mesh.size().max(1.0);
        let mut level = Level::new(&mesh).unwrap();
        let mut faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
        let (mut quick, mut vertices) = (mesh.points.clone(), mesh.points.len() as u32);
        for step in list(&document["steps"]) {
            // Both ways of refining.
            let refined = level.refine();
            let by_table = refined.stencils.apply(&quick);
            (level, quick) = level.refine_points(&quick);
            (faces, vertices) = split(&faces, vertices);
            let between = by_table.iter().zip(&quick).fold(0.0, |most: f64, (a, b)| most.max(a.distance(*b)));
            assert!(between <= 1e-14 * mesh.size(), "{name}: {between:e}");
            assert_eq!(vertices, index(&step["vertex_count"]), "{name}");
            assert_eq!(faces.len() as u32, index(&step["face_count"]), "{name}");
            for meeting in &mesh.meetings {
                let v = meeting.vertex as usize;
                assert_eq!(<[f64; 3]>::from(quick[v]), <[f64; 3]>::from(mesh.points[v]), "{name}");
                assert_eq!(level.topology().ring(VertexId(meeting.vertex)).count(), 2 * meeting.ports.len());
            }
            let theirs = points(&step["vertices"]);
            if !theirs.is_empty() {
                let error = farthest(level.topology(), &quick, &faces, &theirs);
                assert!(error <= tolerance, "{name}, level {}: {error:e}", step["level"]);
                compared += 1;
            }
        }
    }
    assert!(compared >= 30, "{compared} levels");
}
