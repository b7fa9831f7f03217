//! A bi-4 lens as finitely many patches: outlines, joints, and how near the closing patches are to the surface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod lens_nets;

use lens_nets::{document, exact_points, single_lens};
use ogee::lens::{
    Biquartic, BiquarticSurface, Cap, CapEdge, CapSite, CapVertex, Entry, Quadrant, QuadraticExpansion,
    regular_net,
};
use ogee::nurbs::{FaceAddress, NurbsSurface, Side};
use ogee::{ControlMesh, Level, SurfaceJet, Vec3, VertexId, limit_vertices};
use std::collections::BTreeMap;

/// The sample net in a wider cage, as a mesh, with the site of its lens.
fn lens() -> (ControlMesh, CapSite, [Vec3; 25]) {
    let net: [Vec3; 25] = exact_points(&document("samples_lens")["net25"]).try_into().unwrap();
    let mut mesh = single_lens(5);
    mesh.points[..25].copy_from_slice(&net);
    let level = Level::new(&mesh).unwrap();
    let around = regular_net(&level, VertexId(0)).unwrap();
    let site = CapSite::new(&around, level.topology(), FaceAddress::whole);
    (mesh, site, net)
}

fn size(net: &[Vec3]) -> f64 {
    net.iter().map(|p| p.length()).fold(0.0, f64::max)
}

fn end(surface: &NurbsSurface, edge: &CapEdge, k: usize) -> Vec3 {
    let (u, v) = surface.on_side(edge.side, edge.range[k]);
    surface.jet(u, v).position
}

#[test]
fn outlines_are_closed_and_every_inner_edge_has_two_faces() {
    let (mesh, site, net) = lens();
    let limit = limit_vertices(&Level::new(&mesh).unwrap(), &mesh.points);
    for (entry, rings) in [(Entry::DegreeRaise, 1), (Entry::Refit, 1), (Entry::Refit, 2), (Entry::Refit, 5)] {
        let cap = Biquartic::from_bicubic(&net, entry).cap(rings, &site);
        assert_eq!(cap.faces.len(), 6 * rings as usize + 2);
        assert_eq!(cap.points.len(), 8 * (rings as usize - 1) + 5);
        let mut uses: BTreeMap<(CapVertex, CapVertex), Vec<(usize, CapEdge)>> = BTreeMap::new();
        for (f, face) in cap.faces.iter().enumerate() {
            let order = [Side::V0, Side::U1, Side::V1, Side::U0];
            let sides: Vec<usize> = face
                .boundary
                .iter()
                .map(|edge| order.iter().position(|&side| side == edge.side).unwrap())
                .collect();
            assert!(sides.is_sorted());
            for (k, edge) in face.boundary.iter().enumerate() {
                assert_eq!(edge.to, face.boundary[(k + 1) % face.boundary.len()].from, "the loop is closed");
                for (k, vertex) in [edge.from, edge.to].into_iter().enumerate() {
                    let point = match vertex {
                        CapVertex::Own(at) => cap.points[at as usize],
                        // Outside is the cage's own surface.
                        CapVertex::Cage(v) => limit[v.index()].position,
                    };
                    assert!(point.distance(end(&face.surface, edge, k)) < 1e-13 * size(&net));
                }
                uses.entry((edge.from.min(edge.to), edge.from.max(edge.to))).or_default().push((f, *edge));
            }
        }
        let mut outline = 0;
        for ((a, b), uses) in &uses {
            match (a, b, &uses[..]) {
                (CapVertex::Cage(a), CapVertex::Cage(b), [_]) => {
                    let at = |v: &VertexId| site.outline.iter().position(|o| o == v).unwrap();
                    assert!([1, 7].contains(&(at(a).abs_diff(at(b)))));
                    outline += 1;
                }
                (_, _, &[(f, one), (g, other)]) => {
                    assert_eq!((one.from, one.to), (other.to, other.from), "in opposite directions");
                    if [one, other].iter().all(|edge| (edge.range[0] - edge.range[1]).abs() == 1.0) {
                        let rows = [(f, one), (g, other)]
                            .map(|(f, edge)| cap.faces[f].surface.side(edge.side).points);
                        // Loops run in opposite directions, and along falling parameters on two sides of four.
                        let falls = [one, other].map(|edge| edge.range[0] > edge.range[1]);
                        let mut last = rows[1].clone();
                        if falls[0] == falls[1] {
                            last.reverse();
                        }
                        assert_eq!(rows[0], last, "the same bits");
                    }
                    for k in 0..=8 {
                        let t = f64::from(k) / 8.0;
                        let at = |f: usize, edge: CapEdge, t: f64| {
                            let surface = &cap.faces[f].surface;
                            let [from, to] = edge.range;
                            let (u, v) = surface.on_side(edge.side, from + t * (to - from));
                            surface.jet(u, v)
                        };
                        let (p, q) = (at(f, one, t), at(g, other, 1.0 - t));
                        assert!(p.position.distance(q.position) < 1e-13 * size(&net));
                        if let (Some(m), Some(n)) = (p.normal(), q.normal()) {
                            // Near the lens the normal of a patch is a quotient of small numbers.
                            assert!(m.angle(n) < 1e-9, "{rings} rings: {:e}", m.angle(n));
                        }
                    }
                }
                _ => panic!("{a:?}-{b:?} is used {} times", uses.len()),
            }
        }
        assert_eq!(outline, 8);
        assert_eq!(uses.len(), 8 + (6 * rings as usize + 2) * 4 / 2 - 4 + 2 * (rings as usize - 1));
        let faces: Vec<FaceAddress> = cap.faces.iter().map(|face| face.pieces[(0, 0)]).collect();
        let centre = [site.pieces[0][0], site.pieces[1][0]];
        assert!(faces[6..].iter().all(|address| centre.contains(address)));
        let mut first: Vec<FaceAddress> = faces[..6].to_vec();
        first.extend(&faces[6 * rings as usize..]);
        first.sort();
        first.dedup();
        assert_eq!(first.len(), 8, "each face of the cage is one patch's");
    }
}

#[test]
fn outer_sides_are_those_of_the_surface_around() {
    let (mesh, site, net) = lens();
    let table = ogee::PatchTable::new(&Level::new(&mesh).unwrap());
    let surface = ogee::LimitSurface::new(&table, &mesh.points);
    let cap = Biquartic::from_bicubic(&net, Entry::Refit).cap(3, &site);
    let level = Level::new(&mesh).unwrap();
    let topology = level.topology();
    let mut compared = 0;
    for face in &cap.faces {
        for edge in &face.boundary {
            let (CapVertex::Cage(a), CapVertex::Cage(b)) = (edge.from, edge.to) else { continue };
            // The face of the cage beyond the edge, which runs from `b` to `a` there.
            let h = topology.ring(b).find(|&h| topology.target(h) == a).unwrap();
            let outside = topology.face(h);
            let corner = topology.halfedges(outside).position(|g| g == h).unwrap();
            for k in 0..=4 {
                let t = f64::from(k) / 4.0;
                let (u, v) =
                    face.surface.on_side(edge.side, edge.range[0] + t * (edge.range[1] - edge.range[0]));
                let inner = face.surface.jet(u, v);
                let s = 1.0 - t;
                let (x, y) = [(s, 0.0), (1.0, s), (1.0 - s, 1.0), (0.0, 1.0 - s)][corner];
                let outer = surface.jet(table.locate(outside, None, x, y).unwrap());
                assert!(inner.position.distance(outer.jet.position) < 1e-12 * size(&net));
                assert!(inner.normal().unwrap().angle(outer.normal) < 1e-12, "faces the same way");
                let curvature = [inner.curvature().unwrap().mean, outer.jet.curvature().unwrap().mean];
                assert!((curvature[0] - curvature[1]).abs() < 1e-9 * curvature[1].abs().max(1e-3));
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 40);
}

/// The patches of the last faces of a cap, which close it.
fn closing(cap: &Cap) -> [&NurbsSurface; 2] {
    let n = cap.faces.len();
    [&cap.faces[n - 2].surface, &cap.faces[n - 1].surface]
}

/// What a cap with so many rings misses, of the size of the net.
#[derive(Debug)]
struct Misses {
    /// Distance of the closing patches from the limit surface.
    distance: f64,
    /// Distance of the lens point from its limit.
    pole: f64,
    /// Angle between the tangent plane at the lens and that of the limit, in radians.
    angle: f64,
    /// Difference of mean curvature near the lens from that of the limit, relative to it.
    curvature: f64,
    /// Jump of first derivatives across the joint of the closing patches, in their own parameters.
    first: f64,
    /// Jump of second derivatives across that joint, in their own parameters.
    second: f64,
    /// Jump of derivatives up to the second between the last ring and the closing patches.
    ring: f64,
    /// Gap that patches made of the quadratic expansion alone would leave.
    expansion_gap: f64,
}

fn misses(net: &[Vec3; 25], site: &CapSite, entry: Entry, rings: u32) -> Misses {
    let bi4 = Biquartic::from_bicubic(net, entry);
    let surface = BiquarticSurface::new(&bi4);
    let cap = bi4.cap(rings, site);
    let patches = closing(&cap);
    let scale = 2.0_f64.powi(1 - rings as i32);
    let size = size(net);
    let QuadraticExpansion { position, .. } = *surface.expansion();
    let mut found = Misses {
        distance: 0.0,
        pole: patches[0].net[(0, 0)].distance(position) / size,
        angle: 0.0,
        curvature: 0.0,
        first: 0.0,
        second: 0.0,
        ring: 0.0,
        expansion_gap: 0.0,
    };
    let limit = surface.expansion().jet();
    let (normal, mean) = (limit.normal().unwrap(), limit.curvature().unwrap().mean);
    for (q, quadrant) in Quadrant::BOTH.into_iter().enumerate() {
        let grow = |most: &mut f64, miss: f64| *most = most.max(miss);
        for k in 0..81 {
            let (u, v) = (f64::from(k / 9) / 8.0, f64::from(k % 9) / 8.0);
            let (near, far) = (patches[q].jet(u, v), surface.jet(quadrant, scale * u, scale * v));
            grow(&mut found.distance, near.position.distance(far.position) / size);
        }
        let [a, b] = [patches[q], patches[1 - q]];
        let ring = [
            &cap.faces[cap.faces.len() - 8 + 3 * q].surface,
            &cap.faces[cap.faces.len() - 6 + 3 * q].surface,
        ];
        for k in 0..=16 {
            let t = f64::from(k) / 16.0;
            // Along u = 0 lies the other patch's v = 0, in the same direction.
            let (p, r) = (a.jet(0.0, t), b.jet(t, 0.0));
            assert!(p.position.distance(r.position) < 1e-14 * size);
            grow(&mut found.first, (p.du + r.dv).length().max((p.dv - r.du).length()) / size);
            grow(&mut found.second, (p.duu - r.dvv).length().max((p.duv + r.duv).length()) / size);
            for (inner, outer) in [(a.jet(1.0, t), ring[0].jet(0.0, t)), (a.jet(t, 1.0), ring[1].jet(t, 0.0))]
            {
                grow(&mut found.ring, difference(&inner, &outer) / size);
            }
            let angle = std::f64::consts::FRAC_PI_2 * t;
            let near = a.jet(1e-2 * angle.cos(), 1e-2 * angle.sin());
            grow(&mut found.angle, near.normal().unwrap().angle(normal));
            grow(&mut found.curvature, (near.curvature().unwrap().mean / mean - 1.0).abs());
            for (u, v) in [(1.0, t), (t, 1.0)] {
                let (x, y) = (u * u - v * v, 2.0 * u * v);
                let sign = [1.0, -1.0][q] * scale * scale;
                let expansion = surface.expansion().at(sign * x, sign * y).position;
                let edge = surface.jet(quadrant, scale * u, scale * v).position;
                grow(&mut found.expansion_gap, expansion.distance(edge) / size);
            }
        }
    }
    found
}

fn difference(a: &SurfaceJet, b: &SurfaceJet) -> f64 {
    let pairs = [
        (a.position, b.position),
        (a.du, b.du),
        (a.dv, b.dv),
        (a.duu, b.duu),
        (a.duv, b.duv),
        (a.dvv, b.dvv),
    ];
    pairs.iter().map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

#[test]
fn closing_patches_leave_no_gap_and_settle_with_the_rings() {
    let (_, site, net) = lens();
    for entry in [Entry::DegreeRaise, Entry::Refit] {
        let found: Vec<Misses> = (1..=6).map(|rings| misses(&net, &site, entry, rings)).collect();
        for (rings, found) in (1..).zip(&found) {
            let Misses { distance, pole, angle, curvature, expansion_gap, .. } = found;
            println!(
                "{entry:?}, {rings} rings: distance {distance:.1e}, lens point {pole:.1e}, angle {angle:.1e}, mean curvature \
                 {curvature:.1e}; gap of the expansion {expansion_gap:.1e}"
            );
            assert!(found.ring < 1e-14, "{found:?}");
            assert!(found.first < 1e-14 && found.second < 1e-14, "{found:?}");
        }
        for pair in found.windows(2) {
            assert!(pair[1].distance < pair[0].distance / 20.0, "{pair:?}");
            assert!(pair[1].angle < pair[0].angle / 3.0, "{pair:?}");
        }
        assert!(found[5].curvature < found[1].curvature / 50.0, "{found:?}");
        // Four rings: the quadratic expansion alone would leave a gap.
        assert!(found[3].distance < 1e-8 && found[3].expansion_gap > 1e-9, "{:?}", found[3]);
        assert!(found[3].expansion_gap < 1e-6, "{:?}", found[3]);
    }
}
