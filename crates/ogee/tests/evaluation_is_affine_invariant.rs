//! Moving the cage moves the surface; numbering its parts otherwise only renames the addresses.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{at_corner, turned};
use ogee::{ControlMesh, FaceId, FaceList, Flags, Level, LimitSurface, PatchTable, SurfaceJet, Vec3};

const POSITION: f64 = 1e-13;
/// Of the longest derivative of the order, or of the size if that is more.
const FIRST: f64 = 1e-12;
/// Where a crease has faded pieces are a thousandth of a face wide, and rounding counts a million times.
const SECOND: f64 = 1e-9;

const PLACES: [(f64, f64); 7] =
    [(0.0, 0.0), (0.3, 0.6), (0.5, 0.5), (0.0, 0.31), (1.0, 0.2), (0.01, 0.003), (0.99, 0.96)];

fn assert_same(place: &str, size: f64, ours: &SurfaceJet, wanted: &SurfaceJet) {
    let gap = ours.position.distance(wanted.position) / size;
    assert!(gap <= POSITION, "{place}: {gap:e}");
    let longest = |all: &[Vec3]| all.iter().map(|d| d.length()).fold(0.0, f64::max);
    let first = longest(&[ours.du - wanted.du, ours.dv - wanted.dv]);
    assert!(first <= FIRST * longest(&[wanted.du, wanted.dv]).max(size), "{place}: {first:e}");
    let second = longest(&[ours.duu - wanted.duu, ours.duv - wanted.duv, ours.dvv - wanted.dvv]);
    let measure = longest(&[wanted.duu, wanted.duv, wanted.dvv]).max(size);
    assert!(second <= SECOND * measure, "{place}: second {second:e}");
}

fn every_corner(mesh: &ControlMesh) -> impl Iterator<Item = (FaceId, u32)> + '_ {
    let hidden = |f: usize| mesh.holes.contains(&(f as u32));
    mesh.faces
        .iter()
        .enumerate()
        .filter(move |&(f, _)| !hidden(f))
        .flat_map(|(f, face)| (0..face.len() as u32).map(move |k| (FaceId(f as u32), k)))
}

fn jet(
    level: &Level,
    table: &PatchTable,
    surface: &LimitSurface,
    corner: (FaceId, u32),
    x: f64,
    y: f64,
) -> SurfaceJet {
    let (face, k) = corner;
    let turn = if level.topology().face_size(face) == 4 { k } else { 0 };
    turned(&surface.jet(at_corner(level, table, face, k, x, y)).jet, turn)
}

#[test]
fn affine_maps_carry_the_surface_along() {
    let rows = [Vec3::new(1.1, 0.4, -0.3), Vec3::new(-0.2, 0.9, 0.7), Vec3::new(0.5, -0.6, 1.3)];
    let linear = |p: Vec3| Vec3::new(rows[0].dot(p), rows[1].dot(p), rows[2].dot(p));
    let shift = Vec3::new(3.0, -2.0, 5.0);
    for (name, mesh) in cages::all() {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let moved: Vec<Vec3> = mesh.points.iter().map(|&p| linear(p) + shift).collect();
        let [here, there] = [&mesh.points, &moved].map(|points| LimitSurface::new(&table, points));
        for number in cages::visible(&table) {
            for (u, v) in PLACES {
                let at = cages::locate(&table, number, u, v);
                let [mut a, mut b] = [&here, &there].map(|surface| surface.jet(at));
                // There tangents are any that span the plane.
                if a.flags.contains(Flags::AT_EXTRAORDINARY) {
                    [a.jet, b.jet] = [a.jet, b.jet]
                        .map(|jet| SurfaceJet { position: jet.position, ..SurfaceJet::default() });
                }
                let [a, b] = [a.jet, b.jet];
                let wanted = SurfaceJet {
                    position: linear(a.position) + shift,
                    du: linear(a.du),
                    dv: linear(a.dv),
                    duu: linear(a.duu),
                    duv: linear(a.duv),
                    dvv: linear(a.dvv),
                };
                let size = mesh.size() + shift.length();
                assert_same(
                    &format!("{name} {:?} ({u}, {v})", table.parametric_face(number)),
                    size,
                    &b,
                    &wanted,
                );
            }
        }
    }
}

/// Constant data give the constant, so the weights of a position sum to one and those of derivatives to nothing.
#[test]
fn weights_sum_to_one() {
    for (name, mesh) in cages::all() {
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let one = Vec3::new(1.0, -2.0, 0.5);
        let constant = vec![one; mesh.points.len()];
        let surface = LimitSurface::new(&table, &constant);
        for number in cages::visible(&table) {
            for (u, v) in PLACES {
                let point = surface.jet(cages::locate(&table, number, u, v));
                let jet = point.jet;
                assert!(jet.position.distance(one) <= 1e-14, "{name} ({u}, {v}): {:?}", jet.position);
                if point.flags.contains(Flags::AT_EXTRAORDINARY) {
                    continue;
                }
                // Second derivatives are differences of points over the square of a tile, here 1/1024 or more.
                let first = jet.du.length().max(jet.dv.length());
                let second = jet.duu.length().max(jet.duv.length()).max(jet.dvv.length());
                assert!(first <= 1e-11 && second <= 1e-8, "{name} ({u}, {v}): {first:e} {second:e}");
            }
        }
    }
}

/// The same cage with its faces in another order, each begun at another corner, and its points renumbered.
fn renumbered(mesh: &ControlMesh) -> (ControlMesh, Vec<FaceId>, Vec<u32>) {
    let (count, points) = (mesh.faces.len(), mesh.points.len() as u32);
    // A step that shares no divisor with the number visits every one.
    let step = |count: usize| {
        (2 * count / 3..)
            .find(|&s| s > 0 && (1..=s).filter(|d| s % d == 0 && count.is_multiple_of(*d)).count() == 1)
            .unwrap()
    };
    let vertex = |v: u32| (v * step(points as usize) as u32 + 1) % points;
    let mut other = mesh.clone();
    for v in 0..points {
        other.points[vertex(v) as usize] = mesh.points[v as usize];
    }
    let mut where_to = vec![FaceId(0); count];
    let mut turns = vec![0; count];
    other.faces = FaceList::new();
    for k in 0..count {
        let f = (k * step(count) + 2) % count;
        let mut face: Vec<u32> = mesh.faces.face(f).iter().map(|&v| vertex(v)).collect();
        let turn = (f * 7 + 1) % face.len();
        face.rotate_left(turn);
        other.faces.push(&face);
        where_to[f] = FaceId(k as u32);
        turns[f] = turn as u32;
    }
    other.creases.iter_mut().for_each(|crease| crease.vertices = crease.vertices.map(vertex));
    other.corners.iter_mut().for_each(|corner| corner.vertex = vertex(corner.vertex));
    for meeting in &mut other.meetings {
        meeting.vertex = vertex(meeting.vertex);
        meeting.ports.iter_mut().for_each(|port| *port = vertex(*port));
    }
    other.holes.iter_mut().for_each(|hole| *hole = where_to[*hole as usize].0);
    (other, where_to, turns)
}

#[test]
fn numbering_does_not_matter() {
    for (name, mesh) in cages::all() {
        let (other, where_to, turns) = renumbered(&mesh);
        let levels = [&mesh, &other].map(|mesh| Level::new(mesh).unwrap());
        let tables = [0, 1].map(|k| PatchTable::new(&levels[k]));
        let here = LimitSurface::new(&tables[0], &mesh.points);
        let there = LimitSurface::new(&tables[1], &other.points);
        for (face, k) in every_corner(&mesh).filter(|&(face, _)| levels[0].is_visible(face)) {
            let f = face.index();
            let corners = mesh.faces.face(f).len() as u32;
            let same = (where_to[f], (k + corners - turns[f]) % corners);
            // Tangents at an extraordinary vertex are any that span the plane.
            for (x, y) in PLACES.into_iter().skip(1) {
                let a = jet(&levels[0], &tables[0], &here, (face, k), x, y);
                let b = jet(&levels[1], &tables[1], &there, same, x, y);
                assert_same(&format!("{name} {face} {k} ({x}, {y})"), mesh.size(), &b, &a);
            }
        }
    }
}
