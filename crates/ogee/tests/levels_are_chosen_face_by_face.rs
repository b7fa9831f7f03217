//! A triangle among ten thousand quads, or a semi-sharp crease, costs its neighbourhood and no more
//! (`docs/methods/pccm.md`, How many refinements).
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{chaikin, creased, shaken, sharp_at, with_boundary, with_holes};
use ogee::convert::{Body, Options, Packing, Part, to_part};
use ogee::nurbs::Shell;
use ogee::pccm::{
    self, Group, Layer, Patches, PccmError, Plan, least_level, plan, to_group_patches, to_patches,
};
use ogee::{Boundary, ControlMesh, FaceId, FaceList, Grid, HalfedgeId, Level, Topology, Vec3, shapes};
use std::collections::{BTreeMap, BTreeSet};

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

/// Cages whose faces want several levels, or only some of which are split.
fn mixed() -> Vec<(&'static str, ControlMesh)> {
    let grid = || cages::grid(12, 12);
    let row =
        |from: u32, length: u32| -> Vec<[u32; 2]> { (0..length).map(|k| [from + k, from + k + 1]).collect() };
    // Along row 6 of thirteen vertices each.
    let crease = || creased(grid(), &row(81, 3), 4.0);
    let bent = |mesh: ControlMesh| creased(creased(mesh, &row(81, 2), 4.4), &[[83, 96], [96, 109]], 2.3);
    // With Chaikin's rule the edge in the middle stays sharp for the sake of both of its neighbours.
    let uneven = |mesh: ControlMesh| {
        creased(creased(creased(mesh, &row(81, 1), 3.0), &row(82, 1), 0.8), &row(83, 1), 4.4)
    };
    let studs = || shaken(shapes::studded_torus(16, 12, 4), 0.05);
    let stud = studs();
    let edge = |f: usize| -> [u32; 2] { [stud.faces.face(f)[0], stud.faces.face(f)[1]] };
    let mut cut = grid();
    let mut faces = FaceList::new();
    for (f, face) in cut.faces.iter().enumerate() {
        if f == 66 {
            faces.push(&[face[0], face[1], face[2]]);
            faces.push(&[face[0], face[2], face[3]]);
        } else {
            faces.push(face);
        }
    }
    cut.faces = faces;
    vec![
        ("crease", crease()),
        ("crease of three", creased(crease(), &[[83, 96]], 3.0)),
        ("bent crease", bent(grid())),
        ("Chaikin crease", chaikin(crease())),
        ("bent Chaikin crease", chaikin(bent(grid()))),
        ("uneven Chaikin crease", chaikin(uneven(grid()))),
        ("meeting beside a crease", creased(cages::meeting(grid(), 84, 85, 0.4), &row(99, 2), 4.0)),
        ("meeting across a crease", creased(cages::meeting(grid(), 84, 97, 0.3), &row(99, 2), 4.0)),
        ("semi-sharp corner", sharp_at(grid(), &[84], 3.5)),
        ("crease on studs", creased(studs(), &[edge(3), edge(40)], 3.0)),
        ("two triangles", cut.clone()),
        ("two triangles, crease", creased(cut.clone(), &row(44, 3), 4.0)),
        ("two triangles, cone", sharp_at(cut.clone(), &[72], 10.0)),
        ("two triangles, corner of creases", creased(cut.clone(), &[[71, 72], [72, 73]], 10.0)),
        ("two triangles, holes", with_holes(cut.clone(), &[54, 65, 66])),
        ("two triangles, boundary left out", with_boundary(cut.clone(), Boundary::None)),
        ("two triangles, crease through them", creased(cut, &[[70, 71], [71, 84]], 4.0)),
    ]
}

fn shells(part: &Part) -> impl Iterator<Item = &Shell> {
    part.bodies.iter().flat_map(Body::shells)
}

/// Both faces of every edge have the same curve, and the same tangent planes where they should.
fn is_sewn(name: &str, part: &Part) {
    let report = &part.report;
    assert!(report.max_gap <= 1e-13, "{name}: gap {:e}", report.max_gap);
    let angle = report.max_normal_angle_deg.to_radians();
    assert!(angle <= 1e-10, "{name}: angle {angle:e}");
}

/// Every face of the cage is in the part once, whole or with all of its corners.
fn is_whole(name: &str, mesh: &ControlMesh, part: &Part) {
    let cage = Level::new(mesh).unwrap();
    let mut corners: BTreeMap<u32, Vec<Option<u32>>> = BTreeMap::new();
    for face in shells(part).flat_map(|shell| &shell.faces) {
        for address in face.quads.cells() {
            corners.entry(address.face.0).or_default().push(address.corner);
        }
    }
    for (f, face) in (0..).zip(mesh.faces.iter()) {
        let mut found = corners.remove(&f).unwrap_or_default();
        if !cage.is_visible(FaceId(f)) {
            assert!(found.is_empty(), "{name}: face {f} is a hole");
            continue;
        }
        found.sort_unstable();
        let split: Vec<Option<u32>> = (0..face.len() as u32).map(Some).collect();
        assert!(found == [None] || found == split, "{name}: face {f}: {found:?}");
    }
}

#[test]
fn ten_thousand_quads_with_a_triangle_become_as_many_faces() {
    for (name, mesh) in [("sheet", sheet_with_a_triangle()), ("torus", torus_with_a_triangle())] {
        let part = to_part(&mesh, &Options { packing: Packing::Unpacked, ..Options::default() }).unwrap();
        let report = &part.report;
        assert!(report.patches <= 10_100, "{name}: {}", report.patches);
        assert_eq!(report.faces_written, report.patches, "{name}");
        assert_eq!((report.shells, report.closed), (1, name == "torus"), "{name}");
        is_sewn(name, &part);
        let faces: usize = report.faces_by_level.iter().map(|level| level.faces).sum();
        assert_eq!(faces, report.patches, "{name}");
    }
}

#[test]
fn faces_of_all_levels_are_sewn() {
    for (name, mesh) in mixed() {
        for method in [ogee::convert::Method::Pccm, ogee::convert::Method::PccmFirst] {
            for packing in [Packing::Packed, Packing::Unpacked] {
                let part = to_part(&mesh, &Options { method, packing, ..Options::default() }).unwrap();
                let levels = &part.report.faces_by_level;
                assert!(levels.len() > 1, "{name}: {levels:?}");
                is_sewn(name, &part);
                is_whole(name, &mesh, &part);
            }
        }
    }
}

fn largest(grid: &Grid<Vec3>) -> f64 {
    grid.cells().iter().map(|p| p.length()).fold(0.0, f64::max)
}

/// The patches of a group against those of the whole level: the same bits but on sides, where rounding may differ.
fn agrees(name: &str, group: &Group, own: &Patches, whole: &Patches) {
    assert_eq!(own.knots, whole.knots, "{name}");
    for (place, &f) in group.faces.iter().enumerate() {
        let (a, b) = (&own.nets[place], &whole.nets[f.index()]);
        assert_eq!(own.classes[place], whole.classes[f.index()], "{name}: {f}");
        assert_eq!((a.rows(), a.cols()), (b.rows(), b.cols()), "{name}: {f}");
        let (last, size) = (a.rows() - 1, largest(b));
        for (i, j) in (0..=last).flat_map(|i| (0..=last).map(move |j| (i, j))) {
            let on_side = i == 0 || j == 0 || i == last || j == last;
            let gap = a[(i, j)].distance(b[(i, j)]);
            assert!(gap == 0.0 || on_side && gap <= 1e-15 * size, "{name}: {f} at {i} {j}: {gap:e}");
        }
    }
}

#[test]
fn groups_are_as_on_the_whole_level() {
    let mut partial = 0;
    let all = cages::all();
    let all = all.iter().map(|(name, mesh)| (name.as_str(), mesh.clone()));
    for (name, mesh) in mixed().into_iter().chain(all) {
        let Ok(cage) = Level::new(&mesh) else { continue };
        let (refined, refined_points) = cage.refine_points(&mesh.points);
        for layer in [Layer::First, Layer::Second] {
            let Ok(chosen) = plan(&cage, layer, None) else { continue };
            let greatest = chosen.groups.iter().map(|group| group.level).max().unwrap_or(0);
            for group in &chosen.groups {
                // A quad beside a polygon has patches on no whole level, so that there is nothing to compare it with.
                let (base, points) = match group.steps {
                    0 if cage.topology().is_quads() => (&cage, &mesh.points),
                    0 => continue,
                    _ => (&refined, &refined_points),
                };
                // All levels from the greatest on are right for all faces.
                let group = Group { level: greatest.max(group.level), ..group.clone() };
                let options = pccm::Options { layer, level: group.level, ..pccm::Options::default() };
                let Ok(whole) = to_patches(base, points, &options) else { continue };
                let own = to_group_patches(&cage, &mesh.points, &group, &options).unwrap();
                partial += usize::from(group.faces.len() < base.topology().face_count());
                agrees(name, &group, &own, &whole);
            }
        }
    }
    assert!(partial > 20, "{partial}");
}

#[test]
fn a_crease_costs_the_coefficients_of_its_neighbourhood() {
    let along: Vec<[u32; 2]> = (0..8).map(|k| [5080 + k, 5081 + k]).collect();
    let mesh = creased(shaken(shapes::grid(100, 100), 0.3), &along, 5.0);
    let cage = Level::new(&mesh).unwrap();
    let chosen = plan(&cage, Layer::Second, None).unwrap();
    let coefficients = |group: &Group| -> usize {
        let patches = to_group_patches(&cage, &mesh.points, group, &pccm::Options::default()).unwrap();
        patches.nets.iter().map(|net| net.cells().len()).sum()
    };
    let counts: Vec<usize> = chosen.groups.iter().map(coefficients).collect();
    // Ten a side, and thirty-nine.
    assert_eq!(counts, [9_980 * 10 * 10, 20 * 39 * 39]);
}

/// The same cage with vertices and faces in another order, and faces that begin elsewhere.
fn renumbered(mesh: &ControlMesh) -> (ControlMesh, Vec<u32>) {
    let shuffled = |count: usize, seed: u64| -> Vec<u32> {
        let mut next = cages::noise(seed);
        let mut keys: Vec<(f64, u32)> = (0..count as u32).map(|i| (next(), i)).collect();
        keys.sort_by(|a, b| a.0.total_cmp(&b.0));
        keys.into_iter().map(|(_, i)| i).collect()
    };
    let vertices = shuffled(mesh.points.len(), 3);
    let mut place = vec![0; vertices.len()];
    (0..).zip(&vertices).for_each(|(new, &old)| place[old as usize] = new);
    let order = shuffled(mesh.faces.len(), 5);
    let mut faces = FaceList::new();
    for &f in &order {
        let mut corners: Vec<u32> = mesh.faces.face(f as usize).iter().map(|&v| place[v as usize]).collect();
        let turn = f as usize % corners.len();
        corners.rotate_left(turn);
        faces.push(&corners);
    }
    let mut other = ControlMesh { faces, ..mesh.clone() };
    other.points = vertices.iter().map(|&v| mesh.points[v as usize]).collect();
    let moved = |f: &mut u32| *f = order.iter().position(|&old| old == *f).unwrap() as u32;
    other.holes.iter_mut().for_each(moved);
    other.creases.iter_mut().for_each(|crease| crease.vertices = crease.vertices.map(|v| place[v as usize]));
    for meeting in &mut other.meetings {
        meeting.vertex = place[meeting.vertex as usize];
        meeting.ports.iter_mut().for_each(|port| *port = place[*port as usize]);
    }
    other.corners.iter_mut().for_each(|corner| corner.vertex = place[corner.vertex as usize]);
    (other, order)
}

#[test]
fn numbers_do_not_matter() {
    for (name, mesh) in mixed() {
        let (other, order) = renumbered(&mesh);
        let of_faces = |mesh: &ControlMesh| -> Vec<Vec<(u32, u32)>> {
            let cage = Level::new(mesh).unwrap();
            let topology = cage.topology();
            let mut found = vec![Vec::new(); topology.face_count()];
            for Group { steps, level, faces } in plan(&cage, Layer::Second, None).unwrap().groups {
                for f in faces {
                    let face = if steps == 0 { f } else { topology.face(HalfedgeId(f.0)) };
                    found[face.index()].push((steps, level));
                }
            }
            found
        };
        let (first, second) = (of_faces(&mesh), of_faces(&other));
        for (new, &old) in order.iter().enumerate() {
            let sorted = |levels: &Vec<(u32, u32)>| levels.iter().copied().collect::<BTreeSet<_>>();
            assert_eq!(sorted(&first[old as usize]), sorted(&second[new]), "{name}: face {old}");
        }
        let report = |mesh: &ControlMesh| {
            to_part(mesh, &Options { packing: Packing::Unpacked, ..Options::default() }).unwrap().report
        };
        let (first, second) = (report(&mesh), report(&other));
        assert_eq!(first.faces_by_level, second.faces_by_level, "{name}");
        assert!(
            (first.area - second.area).abs() <= 1e-12 * first.area,
            "{name}: {} {}",
            first.area,
            second.area
        );
        // Closest points are sought until no more than a millionth of the distance is to be won.
        let [a, b] = [&first, &second].map(|report| report.max_deviation);
        assert!((a - b).abs() <= 1e-5 * a, "{name}: {a:e} {b:e}");
    }
}
