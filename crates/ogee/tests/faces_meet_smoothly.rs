//! Neighbouring faces share their points along edges; across smooth edges the tangent plane and the curvature as well.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::{at_corner, faces_at, turned, visible};
use ogee::{
    ControlMesh, Flags, HalfedgeId, Level, LimitJet, LimitSurface, Location, PatchTable, Vec3, VertexId,
};

/// Of the size of the cage.
const POSITION: f64 = 1e-12;
const NORMAL_DEGREES: f64 = 1e-9;
/// Of the largest curvature there.
const CURVATURE: f64 = 1e-9;
/// Radians between the tangents along a crease.
const ALONG: f64 = 1e-12;

/// A place on the edge of a face.
struct Side {
    at: Location,
    /// By how many corners its frame is turned against the face.
    corner: u32,
    /// The edge runs against the second parameter of that frame, not along the first.
    against_second: bool,
}

/// The place at `t` along a halfedge, in its face.
fn side(level: &Level, table: &PatchTable, h: HalfedgeId, t: f64) -> Side {
    let topology = level.topology();
    let face = topology.face(h);
    let corners = topology.face_size(face);
    let k = h.0 - topology.first(face).0;
    if corners == 4 {
        return Side { at: at_corner(level, table, face, k, t, 0.0), corner: k, against_second: false };
    }
    let (k, x, y) = if t <= 0.5 { (k, 2.0 * t, 0.0) } else { ((k + 1) % corners, 0.0, 2.0 * (1.0 - t)) };
    Side { at: at_corner(level, table, face, k, x, y), corner: 0, against_second: t > 0.5 }
}

fn tangent(jet: &LimitJet, side: &Side) -> Vec3 {
    let frame = turned(&jet.jet, side.corner);
    if side.against_second { -frame.dv } else { frame.du }
}

/// Principal curvatures, larger first.
fn principal(point: &LimitJet) -> [f64; 2] {
    let jet = &point.jet;
    let (e, f, g) = (jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv));
    let [l, m, n] = [jet.duu, jet.duv, jet.dvv].map(|d| d.dot(point.normal));
    let determinant = e * g - f * f;
    let gauss = (l * n - m * m) / determinant;
    let mean = (e * n - 2.0 * f * m + g * l) / (2.0 * determinant);
    let root = (mean * mean - gauss).max(0.0).sqrt();
    [mean + root, mean - root]
}

#[derive(Default, Debug)]
struct Worst {
    position: f64,
    degrees: f64,
    curvature: f64,
    along: f64,
    smooth: usize,
    sharp: usize,
    vertices: usize,
}

impl Worst {
    fn position(&mut self, place: &str, size: f64, a: Vec3, b: Vec3) {
        let gap = a.distance(b) / size;
        assert!(gap <= POSITION, "{place}: {gap:e}");
        self.position = self.position.max(gap);
    }

    fn normal(&mut self, place: &str, a: Vec3, b: Vec3) {
        assert!((a.length() - 1.0).abs() < 1e-12, "{place}: no normal");
        let degrees = a.angle(b).to_degrees();
        assert!(degrees <= NORMAL_DEGREES, "{place}: {degrees:e} degrees");
        self.degrees = self.degrees.max(degrees);
    }

    fn curvature(&mut self, place: &str, size: f64, a: &LimitJet, b: &LimitJet) {
        // Bending in three directions of space says all about curvature, at umbilics too.
        let along = a.jet.du.normalized().unwrap();
        let across = a.normal.cross(along);
        let [ours, theirs] = [a, b].map(|point| {
            [along, across, along + across]
                .map(|direction| point.jet.normal_curvature(point.normal, direction).unwrap())
        });
        let largest = ours.iter().fold(1.0 / size, |largest: f64, k| largest.max(k.abs()));
        for (k, l) in ours.iter().zip(theirs) {
            let gap = (k - l).abs() / largest;
            assert!(gap <= CURVATURE, "{place}: curvature {gap:e}");
            self.curvature = self.curvature.max(gap);
        }
        let [[k1, k2], [l1, l2]] = [principal(a), principal(b)];
        // Near an umbilic a root of rounding errors is all there is between the two.
        if k1 - k2 > 1e-3 * largest {
            let gap = (k1 - l1).abs().max((k2 - l2).abs()) / largest;
            assert!(gap <= CURVATURE, "{place}: principal curvature {gap:e}");
        }
    }
}

fn walk(name: &str, mesh: &ControlMesh) -> Worst {
    let level = Level::new(mesh).unwrap();
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    let topology = level.topology();
    let size = mesh.size();
    let mut worst = Worst::default();
    for h in topology.edge_halfedges() {
        let Some(twin) = topology.twin(h) else { continue };
        if ![h, twin].iter().all(|&h| level.is_visible(topology.face(h))) {
            continue;
        }
        for t in [0.07, 0.21, 0.43, 0.5, 0.64, 0.86, 0.97] {
            let sides = [side(&level, &table, h, t), side(&level, &table, twin, 1.0 - t)];
            let [a, b] = [0, 1].map(|k| surface.jet(sides[k].at));
            let place = format!("{name}, {h} at {t}");
            worst.position(&place, size, a.jet.position, b.jet.position);
            if level.is_sharp(h) {
                let angle = tangent(&a, &sides[0]).angle(-tangent(&b, &sides[1]));
                assert!(angle <= ALONG, "{place}: tangents along the crease are {angle:e} apart");
                worst.along = worst.along.max(angle);
                worst.sharp += 1;
            } else {
                worst.normal(&place, a.normal, b.normal);
                worst.curvature(&place, size, &a, &b);
                worst.smooth += 1;
            }
        }
    }
    // Inside a face that is no quad the pieces of neighbouring corners meet.
    for number in visible(&table) {
        let face = table.parametric_face(number);
        let Some(corner) = face.corner else { continue };
        let next = (corner + 1) % topology.face_size(face.face);
        for t in [0.03, 0.5, 0.8] {
            let [a, b] = [(corner, 1.0, t), (next, t, 1.0)]
                .map(|(k, u, v)| surface.jet(table.locate(face.face, Some(k), u, v).unwrap()));
            let place = format!("{name}, {face:?} inside at {t}");
            worst.position(&place, size, a.jet.position, b.jet.position);
            worst.normal(&place, a.normal, b.normal);
            worst.curvature(&place, size, &a, &b);
        }
    }
    for v in (0..mesh.points.len() as u32).map(VertexId) {
        let faces = faces_at(&level, v);
        let points: Vec<_> =
            faces.iter().map(|&(f, k)| surface.eval(at_corner(&level, &table, f, k, 0.0, 0.0))).collect();
        let sharp = topology.ring(v).any(|h| level.is_sharp(h)) || topology.is_boundary(v);
        for pair in points.windows(2) {
            let place = format!("{name}, vertex {v}");
            worst.position(&place, size, pair[0].position, pair[1].position);
            // Two faces alone have a normal, but masks that say nothing about it.
            let masks = topology.valence(v).faces() > 2;
            let one_sided = pair.iter().any(|point| point.flags.contains(Flags::NORMAL_ONE_SIDED));
            if masks && !sharp && !one_sided {
                worst.normal(&place, pair[0].normal, pair[1].normal);
                worst.vertices += 1;
            }
        }
    }
    worst
}

#[test]
fn over_a_body_of_mixed_valences() {
    let mesh = cages::body();
    assert!(mesh.faces.len() > 100);
    let worst = walk("body", &mesh);
    println!("{worst:?}");
    assert!(worst.smooth > 1500 && worst.vertices > 300);
}

#[test]
fn in_every_cage() {
    let (mut smooth, mut sharp) = (0, 0);
    // The two sides of a pillow lie on each other: no tangent plane along its edges.
    for (name, mesh) in cages::all().into_iter().filter(|(name, _)| name != "pillow") {
        let worst = walk(&name, &mesh);
        println!("{name}: {worst:?}");
        smooth += worst.smooth;
        sharp += worst.sharp;
    }
    assert!(smooth > 5000 && sharp > 300, "{smooth} {sharp}");
}
