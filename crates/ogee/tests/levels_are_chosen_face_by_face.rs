//! A triangle among ten thousand quads, or a semi-sharp crease, costs its neighbourhood and no more
//! (`docs/methods/pccm.md`, How many refinements).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{creased, shaken};
use ogee::pccm::{Group, Layer, PccmError, Plan, least_level, plan};
use ogee::{ControlMesh, FaceId, FaceList, HalfedgeId, Level, Topology, Vec3, shapes};
use std::collections::BTreeSet;

/// A sheet of 10 000 faces, all quads but one triangle: one edge of its boundary is a point.
fn sheet_with_a_triangle() -> ControlMesh {
    let sheet = shaken(shapes::grid(100, 100), 0.3);
    let mut faces = FaceList::new();
    for face in sheet.faces.iter() {
        let mut corners: Vec<u32> = face.iter().map(|&v| if v == 51 { 50 } else { v }).collect();
        corners.dedup();
        faces.push(&corners);
    }
    let used: BTreeSet<u32> = faces.corners().iter().copied().collect();
    assert_eq!(used.len() + 1, sheet.points.len());
    tidy(&ControlMesh::new(sheet.points, faces))
}

/// A torus of 10 000 faces: two quads side by side are a triangle and a pentagon.
fn torus_with_a_triangle() -> ControlMesh {
    let torus = shapes::torus(100, 100);
    let point = |p: Vec3| Vec3::new(p.x, p.y, p.z + 0.1 * (3.0 * p.x).sin());
    let [first, second] = [4020, 4120].map(|f| torus.faces.face(f).to_vec());
    let mut faces = FaceList::new();
    for (f, face) in torus.faces.iter().enumerate() {
        // Quads `a b c d` and `b e f c`.
        match f {
            4020 => faces.push(&[first[0], first[1], second[2], first[2], first[3]]),
            4120 => faces.push(&[second[0], second[1], second[2]]),
            _ => faces.push(face),
        }
    }
    ControlMesh::new(torus.points.into_iter().map(point).collect(), faces)
}

fn tidy(mesh: &ControlMesh) -> ControlMesh {
    let used: BTreeSet<u32> = mesh.faces.corners().iter().copied().collect();
    let used: Vec<u32> = used.into_iter().collect();
    let mut faces = FaceList::new();
    for face in mesh.faces.iter() {
        faces.push(&face.iter().map(|v| used.binary_search(v).unwrap() as u32).collect::<Vec<_>>());
    }
    ControlMesh::new(used.iter().map(|&v| mesh.points[v as usize]).collect(), faces)
}

fn patches(plan: &Plan) -> usize {
    plan.groups.iter().map(|group| group.faces.len()).sum()
}

fn sizes(plan: &Plan) -> Vec<(u32, u32, usize)> {
    plan.groups.iter().map(|group| (group.steps, group.level, group.faces.len())).collect()
}

/// Every face of the cage is in one group, itself or all its quarters.
fn covers_once(name: &str, topology: &Topology, plan: &Plan) {
    let mut times = vec![0; topology.halfedge_count()];
    for Group { steps, faces, .. } in &plan.groups {
        assert!(faces.is_sorted(), "{name}");
        for &f in faces {
            match steps {
                0 => {
                    assert_eq!(topology.face_size(f), 4, "{name}: face {f}");
                    topology.halfedges(f).for_each(|h| times[h.index()] += 1);
                }
                _ => times[f.index()] += 1,
            }
        }
    }
    assert!(times.iter().all(|&times| times == 1), "{name}");
}

#[test]
fn a_triangle_costs_its_neighbourhood() {
    for (name, mesh) in [("sheet", sheet_with_a_triangle()), ("torus", torus_with_a_triangle())] {
        assert_eq!(mesh.faces.len(), 10_000);
        let cage = Level::new(&mesh).unwrap();
        for layer in [Layer::First, Layer::Second] {
            let plan = plan(&cage, layer, None).unwrap();
            covers_once(name, cage.topology(), &plan);
            assert!(patches(&plan) <= 10_100, "{name}: {:?}", sizes(&plan));
        }
    }
}

#[test]
fn a_semi_sharp_crease_costs_its_neighbourhood() {
    // Eight edges in a row; around the nine vertices there are 10 x 2 faces.
    let along: Vec<[u32; 2]> = (0..8).map(|k| [5080 + k, 5081 + k]).collect();
    for sharpness in [3.0, 4.5, 5.0] {
        let mesh = creased(shapes::grid(100, 100), &along, sharpness);
        let cage = Level::new(&mesh).unwrap();
        let plan = plan(&cage, Layer::Second, None).unwrap();
        assert_eq!(sizes(&plan), [(0, 2, 9_980), (0, sharpness.ceil() as u32, 20)]);
    }
}

#[test]
fn the_greatest_level_is_the_least_for_all() {
    for (name, mesh) in cages::all() {
        let Ok(cage) = Level::new(&mesh) else { continue };
        for layer in [Layer::First, Layer::Second] {
            let Ok(chosen) = plan(&cage, layer, None) else {
                if cage.topology().is_quads() {
                    assert_eq!(plan(&cage, layer, None).err(), least_level(&cage, layer).err(), "{name}");
                }
                continue;
            };
            covers_once(&name, cage.topology(), &chosen);
            let greatest = chosen.groups.iter().map(|group| group.level).max().unwrap_or(0);
            if cage.topology().is_quads() {
                assert_eq!(greatest, least_level(&cage, layer).unwrap().level, "{name} {layer:?}");
                assert!(chosen.groups.iter().all(|group| group.steps == 0), "{name}");
            }
            // A level for all: one group for each number of steps, or a refusal.
            let asked = plan(&cage, layer, Some(greatest + 1)).unwrap();
            assert!(asked.groups.iter().all(|group| group.level == greatest + 1), "{name}");
            covers_once(&name, cage.topology(), &asked);
            let low = plan(&cage, layer, Some(greatest - 1)).unwrap_err();
            assert!(
                matches!(low, PccmError::LevelTooLow { least, .. } if least == greatest),
                "{name}: {low}"
            );
        }
    }
}

/// All faces around a vertex that is not regular have one group.
#[test]
fn fans_are_not_divided() {
    for (name, mesh) in cages::all() {
        let Ok(cage) = Level::new(&mesh) else { continue };
        let topology = cage.topology();
        let Ok(chosen) = plan(&cage, Layer::Second, None) else { continue };
        let mut group_of = vec![None; topology.face_count()];
        for (number, group) in chosen.groups.iter().enumerate() {
            for &f in &group.faces {
                let face = if group.steps == 0 { f } else { topology.face(HalfedgeId(f.0)) };
                group_of[face.index()] = Some((group.steps, number));
            }
        }
        for v in (0..topology.vertex_count() as u32).map(ogee::VertexId) {
            let sharp = topology.ring(v).any(|h| cage.is_sharp(h)) || topology.is_boundary(v);
            let faces: Vec<FaceId> = topology.ring(v).map(|h| topology.face(h)).collect();
            if sharp || matches!(faces.len(), 0 | 4) {
                continue;
            }
            let steps = |f: &FaceId| group_of[f.index()].map(|(steps, _)| steps);
            assert!(faces.iter().all(|f| steps(f) == steps(&faces[0])), "{name}: vertex {v}");
            if steps(&faces[0]) == Some(0) {
                let same = faces.iter().all(|f| group_of[f.index()] == group_of[faces[0].index()]);
                assert!(same, "{name}: vertex {v}");
            }
        }
    }
}
