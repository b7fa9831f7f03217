//! Faces of polar caps: the same surface in many pieces and in two, rows that are the same bits, outlines that close.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod poles;

use ogee::lens::{Cap, CapFace, CapVertex, PolarCap, PolarFaces, PolarVariant};
use ogee::nurbs::Side;
use ogee::{Grid, SurfaceJet, Vec3, VertexId};
use poles::{SECTORS, circles, faces};
use std::collections::BTreeMap;

const POLE: Vec3 = Vec3::new(0.1, -0.2, 0.3);

fn all_caps() -> impl Iterator<Item = (String, PolarCap)> {
    SECTORS.into_iter().flat_map(|sectors| {
        PolarVariant::ALL.map(|variant| {
            let circles = circles(sectors, 0.2);
            let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), POLE, variant).unwrap();
            (format!("{}, n = {sectors}", variant.name()), cap)
        })
    })
}

fn bits(p: Vec3) -> [u64; 3] {
    [p.x, p.y, p.z].map(f64::to_bits)
}

fn parts(jet: &SurfaceJet) -> [Vec3; 6] {
    [jet.position, jet.du, jet.dv, jet.duu, jet.duv, jet.dvv]
}

/// Where a vertex of the cap is, by the cap's points or by the limit of circle 2.
fn position(cap: &Cap, polar: &PolarCap, vertex: CapVertex) -> Vec3 {
    match vertex {
        CapVertex::Own(i) => cap.points[i as usize],
        CapVertex::Cage(v) => polar.jet(v.index(), 0.0, 2.0).position,
    }
}

#[test]
fn halves_are_the_same_surface_as_its_patches() {
    for (what, cap) in all_caps() {
        let n = cap.sectors();
        let halves = faces(&cap, PolarFaces::Halves);
        let patches = faces(&cap, PolarFaces::PerSector);
        assert_eq!(halves.faces.len(), 2);
        let per_sector = if cap.variant() == PolarVariant::SixSix { 1 } else { 2 };
        assert_eq!(patches.faces.len(), per_sector * n);
        let mut sector = 0;
        for half in &halves.faces {
            let count = half.pieces.cols();
            assert_eq!(half.surface.v.domain(), [0.0, count as f64]);
            assert_eq!(half.surface.u.domain(), [0.0, 2.0]);
            for k in 0..count {
                for (s, radius) in [(0.0, 0.0), (0.0, 0.3), (0.5, 0.9), (0.25, 1.0), (0.9, 1.5), (0.5, 2.0)] {
                    let whole = half.surface.jet(radius, k as f64 + s);
                    let patch = cap.jet(sector, s, radius);
                    let band = if radius < 1.0 { 0 } else { per_sector - 1 };
                    let single = patches.faces[per_sector * sector + band].surface.jet(radius, s);
                    for other in [patch, single] {
                        for (a, b) in parts(&whole).into_iter().zip(parts(&other)) {
                            assert!(a.distance(b) < 1e-12, "{what}, sector {sector}: {:e}", a.distance(b));
                        }
                    }
                }
                sector += 1;
            }
        }
        assert_eq!(sector, n, "{what}");
    }
}

#[test]
fn halves_have_no_more_coefficients_than_two_derivatives_ask_for() {
    for (what, cap) in all_caps() {
        let [first, second] = &faces(&cap, PolarFaces::Halves).faces[..] else { panic!("two halves") };
        assert_eq!(first.pieces.cols() + second.pieces.cols(), cap.sectors());
        assert!(first.pieces.cols() - second.pieces.cols() <= 1, "{what}");
        for half in [first, second] {
            let (u, v) = (half.surface.u.multiplicities(), half.surface.v.multiplicities());
            let (around, inner) = match cap.variant() {
                PolarVariant::FiveFive => (5, 3),
                PolarVariant::SixFive | PolarVariant::SixSix => (6, 4),
            };
            assert_eq!(half.surface.v.degree(), around);
            assert!(v[1..v.len() - 1].iter().all(|knot| knot.1 == inner), "{what}");
            match cap.variant() {
                PolarVariant::SixSix => assert_eq!(u, [(0.0, 7), (2.0, 7)]),
                PolarVariant::SixFive | PolarVariant::FiveFive => {
                    assert_eq!(u, [(0.0, 6), (1.0, 3), (2.0, 6)]);
                }
            }
        }
    }
}

#[test]
fn the_pole_is_one_point_and_rows_are_shared_bit_for_bit() {
    for (what, cap) in all_caps() {
        for kind in [PolarFaces::PerSector, PolarFaces::Halves] {
            let cap = faces(&cap, kind);
            assert_eq!(cap.points[0], POLE);
            let mut rows: BTreeMap<[CapVertex; 2], Vec<Vec<[u64; 3]>>> = BTreeMap::new();
            for face in &cap.faces {
                let net = &face.surface.net;
                if !face.boundary.iter().any(|edge| edge.side == Side::U0) {
                    assert!(net.row(0).iter().all(|&p| bits(p) == bits(POLE)), "{what}");
                }
                for edge in face.boundary.iter().filter(|edge| matches!(edge.side, Side::V0 | Side::V1)) {
                    let mut ends = [edge.from, edge.to];
                    ends.sort();
                    let row = face.surface.side(edge.side).points.into_iter().map(bits).collect();
                    rows.entry(ends).or_default().push(row);
                }
            }
            for shared in rows.values() {
                let [a, b] = &shared[..] else { panic!("{what}: two faces on a meridian") };
                assert_eq!(a, b, "{what}");
            }
        }
    }
}

/// The outline of a face is a loop of increasing corners, and its vertices are where its surface is.
fn assert_outline(cap: &Cap, polar: &PolarCap, face: &CapFace, what: &str) {
    let edges = &face.boundary;
    for (k, edge) in edges.iter().enumerate() {
        assert_eq!(edge.to, edges[(k + 1) % edges.len()].from, "{what}");
        let grows = matches!(edge.side, Side::V0 | Side::U1);
        assert_eq!(edge.range[0] < edge.range[1], grows, "{what}");
        for (vertex, t) in [(edge.from, edge.range[0]), (edge.to, edge.range[1])] {
            let (u, v) = face.surface.on_side(edge.side, t);
            let place = face.surface.jet(u, v).position;
            assert!(place.distance(position(cap, polar, vertex)) < 1e-13, "{what}: {vertex:?}");
        }
    }
    let order =
        |side: Side| [Side::V0, Side::U1, Side::V1, Side::U0].iter().position(|&s| s == side).unwrap();
    assert!(edges.windows(2).all(|pair| order(pair[0].side) <= order(pair[1].side)), "{what}");
    assert_eq!((edges[0].side, edges[0].range[0]), (Side::V0, face.surface.u.domain()[0]));
}

#[test]
fn outlines_close_and_every_inner_edge_has_two_faces() {
    for (what, polar) in all_caps() {
        let n = polar.sectors();
        for kind in [PolarFaces::PerSector, PolarFaces::Halves] {
            let cap = faces(&polar, kind);
            let mut uses: BTreeMap<[CapVertex; 2], usize> = BTreeMap::new();
            let mut replaced = Vec::new();
            for face in &cap.faces {
                assert_outline(&cap, &polar, face, &what);
                face.boundary.iter().for_each(|edge| *uses.entry([edge.from, edge.to]).or_default() += 1);
                replaced.extend(face.pieces.cells().iter().map(|address| address.face.index()));
            }
            replaced.sort_unstable();
            assert!(replaced.into_iter().eq(0..2 * n), "{what}");
            for (&[from, to], &count) in &uses {
                assert_eq!(count, 1, "{what}");
                let outside = matches!((from, to), (CapVertex::Cage(_), CapVertex::Cage(_)));
                assert_eq!(uses.contains_key(&[to, from]), !outside, "{what}: {from:?} {to:?}");
            }
            for i in 0..n as u32 {
                let [from, to] = [i, (i + 1) % n as u32].map(|i| CapVertex::Cage(VertexId(i)));
                assert!(uses.contains_key(&[from, to]), "{what}: outer edge {i}");
            }
        }
    }
}

#[test]
fn outer_rows_are_the_limit_curve_of_the_second_circle() {
    for sectors in SECTORS {
        let circles = circles(sectors, 0.2);
        let limit = |i: usize| {
            let [a, b, c] = circles.each_ref().map(|circle| circle[i % sectors]);
            (a + 4.0 * b + c) / 6.0
        };
        for variant in PolarVariant::ALL {
            let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), POLE, variant).unwrap();
            for sector in 0..sectors {
                let [a, b, c, d] = [sectors - 1, 0, 1, 2].map(|k| limit(sector + k));
                for s in [0.0_f64, 0.3, 1.0] {
                    let t = 1.0 - s;
                    let spline = t.powi(3) * a
                        + (3.0 * s.powi(3) - 6.0 * s * s + 4.0) * b
                        + (3.0 * t.powi(3) - 6.0 * t * t + 4.0) * c
                        + s.powi(3) * d;
                    let miss = cap.jet(sector, s, 2.0).position.distance(spline / 6.0);
                    assert!(miss < 1e-14, "{} n = {sectors}: {miss:e}", variant.name());
                }
            }
        }
    }
}

#[test]
fn faces_look_to_the_side_where_circles_are_counter_clockwise() {
    for sectors in SECTORS {
        let circles = circles(sectors, 0.0);
        for variant in PolarVariant::ALL {
            let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), Vec3::ZERO, variant).unwrap();
            for kind in [PolarFaces::PerSector, PolarFaces::Halves] {
                for face in &faces(&cap, kind).faces {
                    let ([a, b], [c, d]) = (face.surface.u.domain(), face.surface.v.domain());
                    for (x, y) in [(0.1, 0.2), (0.5, 0.5), (1.0, 0.9)] {
                        let jet = face.surface.jet(a + x * (b - a), c + y * (d - c));
                        assert!(jet.normal().unwrap().z > 0.5, "{} n = {sectors}", variant.name());
                    }
                }
            }
        }
    }
}

#[test]
fn names_that_do_not_fit_are_refused() {
    let circles = circles(6, 0.1);
    let cap = PolarCap::new(circles.each_ref().map(Vec::as_slice), POLE, PolarVariant::SixFive).unwrap();
    let address = ogee::nurbs::FaceAddress::whole(ogee::FaceId(0));
    let circle: Vec<VertexId> = (0..6).map(VertexId).collect();
    for (vertices, rows, columns) in [(5, 2, 6), (6, 1, 6), (6, 2, 5)] {
        let replaced = Grid::from_fn(rows, columns, |_, _| address);
        let error = cap.faces(&circle[..vertices], &replaced, PolarFaces::Halves).unwrap_err();
        assert_eq!(error.code(), "polar_names");
    }
}
