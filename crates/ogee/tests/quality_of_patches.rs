//! What the report measures on patches: nothing on a part whose tangent planes agree, and the right number where two
//! patches are made to disagree.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use cages::creased;
use ogee::convert::{Method, Options, Packing, Part, to_part};
use ogee::nurbs::{FaceAddress, KnotVector, NurbsSurface};
use ogee::quality::{
    Cause, Field, JointPlace, PatchView, PlaneLight, Ray, Report, ReportOptions, SectorKind, Surface, Viewer,
};
use ogee::{FaceId, Grid, Vec3, shapes};

const DOWN: Vec3 = Vec3::new(0.0, 0.6, -0.8);

/// Lines of light along `y`, 5 above, seen by parallel rays.
fn light() -> PlaneLight {
    let axes = [Vec3::new(0.8, 0.6, 0.0), Vec3::new(-0.6, 0.8, 0.0)];
    PlaneLight { centre: Vec3::new(0.0, 0.0, 5.0), axes, half: [f64::INFINITY; 2] }
}

fn field() -> Field {
    Field::Plane { light: light(), viewer: Viewer::Parallel(DOWN), ray: Ray::Reflected, axis: 0 }
}

/// A patch of a degree along `u` over face `face`, from its net: rows along `u`.
fn patch(face: u32, degree: usize, rows: &[[Vec3; 2]]) -> (NurbsSurface, Grid<FaceAddress>) {
    let knots =
        |degree: usize| KnotVector::new(degree, [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat());
    let net = Grid::from_fn(rows.len(), 2, |i, j| rows[i][j]);
    let surface = NurbsSurface { u: knots(degree), v: knots(1), net };
    (surface, Grid::from_fn(1, 1, |_, _| FaceAddress::whole(FaceId(face))))
}

/// Along `x` from 0, three wide in `y`: a flat square on the left and a strip on the right through the points of a
/// Bezier curve `(x, z)`.
fn pair(curve: &[[f64; 2]]) -> Vec<(NurbsSurface, Grid<FaceAddress>)> {
    let row = |[x, z]: [f64; 2]| [0.0, 3.0].map(|y| Vec3::new(x, y, z));
    let right: Vec<[Vec3; 2]> = curve.iter().copied().map(row).collect();
    vec![patch(4, 1, &[row([-1.0, 0.0]), row([0.0, 0.0])]), patch(9, curve.len() - 1, &right)]
}

fn report(patches: Vec<(NurbsSurface, Grid<FaceAddress>)>, crease_angle: Option<f64>) -> Report {
    let view = PatchView::new(patches).unwrap();
    Report::new(&view, &ReportOptions { crease_angle, ..ReportOptions::new(field()) }).unwrap()
}

/// The direction of a reflection line on a plane through two vectors: where the light does not change.
fn line_on(first: Vec3, second: Vec3) -> Vec3 {
    let normal = first.cross(second).normalized().unwrap();
    let reflected = DOWN - 2.0 * DOWN.dot(normal) * normal;
    let along = light().axes[0];
    let change = |step: Vec3| step.dot(along) - step.z / reflected.z * reflected.dot(along);
    change(first) * second - change(second) * first
}

#[test]
fn a_bend_is_measured_as_it_was_made() {
    let sides = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    for degrees in [1e-6, 0.01, 1.0, 25.0] {
        let (sine, cosine) = f64::to_radians(degrees).sin_cos();
        let down = Vec3::new(cosine, 0.0, -sine);
        let found = report(pair(&[[0.0, 0.0], [cosine, -sine]]), None).continuity;
        assert_eq!((found.smooth.count, found.sharp.count, found.border), (1, 0, 6));
        let angle = &found.smooth.angle;
        assert_eq!(angle.samples, 5);
        assert!((angle.max - degrees).abs() < 1e-9 && (angle.mean - degrees).abs() < 1e-9, "{angle:?}");
        let kink = line_on(sides[0], sides[1]).angle(line_on(down, sides[1])).to_degrees();
        let kink = kink.min(180.0 - kink);
        let measured = &found.smooth.kink;
        assert!(
            kink > 0.3 * degrees && (measured.max - kink).abs() < 1e-9 * (1.0 + kink),
            "{kink} {measured:?}"
        );
        assert!(found.smooth.gap.max < 1e-15 && found.smooth.curvature.max < 1e-12);
        let JointPlace { at, beside, position, .. } = angle.worst[0];
        assert_eq!([at.face.0, beside.face.0], [4, 9]);
        assert!((at.u, beside.u) == (1.0, 0.0) && (at.v - beside.v).abs() < 1e-15);
        assert!(position.distance(Vec3::new(0.0, 3.0 * at.v, 0.0)) < 1e-14);
    }
}

#[test]
fn a_step_in_curvature_is_measured_as_it_was_made() {
    // A parabola z = k x^2 / 2 from x = 0 to 1 bends by k at its start.
    let curvature = |k: f64| {
        let found = report(pair(&[[0.0, 0.0], [0.5, 0.0], [1.0, k / 2.0]]), None).continuity.smooth;
        assert!(found.angle.max < 1e-12 && found.curvature.samples == 5);
        found.curvature.max
    };
    assert!((curvature(2.0) - 1.0).abs() < 1e-12);
    // Flatter than the surface is large: a share of one over its size.
    let size = (4.0_f64 + 9.0 + 0.05 * 0.05).sqrt();
    assert!((curvature(0.1) - 0.1 * size).abs() < 1e-12, "{}", curvature(0.1));
}

#[test]
fn a_gap_is_measured_as_it_was_made() {
    let mut patches = pair(&[[0.0, 0.0], [1.0, 0.0]]);
    patches[1].0.net = patches[1].0.net.map(|&p| p + Vec3::new(0.0, 0.0, 1e-7));
    let found = report(patches, None).continuity.smooth;
    assert!((found.gap.max - 1e-7).abs() < 1e-15 && (found.gap.mean - 1e-7).abs() < 1e-15);
}

#[test]
fn bends_from_an_angle_on_are_creases() {
    let bent = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let found = report(pair(&[[0.0, 0.0], [cosine, -sine]]), Some(10.0)).continuity;
        [found.smooth.count, found.sharp.count]
    };
    assert_eq!([bent(9.9), bent(10.1)], [[1, 0], [0, 1]]);
}

fn pieces(part: &Part) -> Vec<(NurbsSurface, Grid<FaceAddress>)> {
    let shells = part.bodies.iter().flat_map(|body| body.shells());
    shells.flat_map(|shell| &shell.faces).map(|face| (face.surface.clone(), face.quads.clone())).collect()
}

#[test]
fn parts_agree_with_their_own_report() {
    for mesh in [cages::body(), shapes::cube(), creased(cages::cube(), &cages::TOP, 10.0)] {
        for (method, packing) in [
            (Method::Pccm, Packing::Unpacked),
            (Method::Pccm, Packing::Packed),
            (Method::PccmFirst, Packing::Unpacked),
        ] {
            let part = to_part(&mesh, &Options { method, packing, ..Options::default() }).unwrap();
            let found = report(pieces(&part), Some(10.0));
            let (smooth, own) = (&found.continuity.smooth, &part.report);
            assert!(found.is_closed());
            assert!(smooth.angle.max < 1e-8 && own.max_normal_angle_deg < 1e-8, "{}", smooth.angle.max);
            assert!(smooth.gap.max <= 1e-12 * found.size());
            // Where tangent planes agree and curvature does not, lines kink; on a cube it does, by symmetry.
            let is_kinked = smooth.curvature.max > 0.01 && smooth.kink.max > 0.1;
            assert!(is_kinked || mesh.points == shapes::cube().points);
            if let Packing::Unpacked = packing {
                assert_eq!((smooth.count, found.continuity.sharp.count), (own.smooth_edges, own.sharp_edges));
            }
            // Quadrature over the knots inside patches.
            assert!((found.curvature.area / own.area - 1.0).abs() < 5e-3);
            let found = found.extraordinary;
            assert!(
                found.points.iter().all(|p| p.sector.kind == SectorKind::Interior && p.sector.faces != 4)
            );
            assert_eq!(found.without_plane, []);
        }
    }
}

#[test]
fn a_torn_point_is_named() {
    let part =
        to_part(&cages::body(), &Options { packing: Packing::Unpacked, ..Options::default() }).unwrap();
    let mut patches = pieces(&part);
    let view = PatchView::new(patches.clone()).unwrap();
    let options = ReportOptions::new(field());
    let sound = Report::new(&view, &options).unwrap().extraordinary;
    // Tilt one patch at an extraordinary corner by moving the point inside the corner of its net.
    let torn = sound.points.iter().find(|p| p.sector.at.u == 0.0 && p.sector.at.v == 0.0).unwrap().sector;
    let patch = patches.iter_mut().find(|(_, quads)| quads[(0, 0)].face == torn.at.face).unwrap();
    let net = &mut patch.0.net;
    let (edge, corner) = (net[(1, 0)], net[(0, 0)]);
    net[(1, 0)] = edge + 0.2 * edge.distance(corner) * Vec3::new(0.0, 0.0, 1.0);
    let view = PatchView::new(patches).unwrap();
    let found = Report::new(&view, &options).unwrap();
    let named = &found.extraordinary.without_plane;
    assert!(
        named.iter().any(|p| p.cause == Cause::Measured && p.sector.position.distance(torn.position) < 1e-9),
        "{named:?}"
    );
    assert!(found.continuity.smooth.angle.max > 1.0);
}

#[test]
fn patches_far_from_the_origin_for_their_size_are_laid_side_by_side() {
    let mut patches = pair(&[[0.0, 0.0], [4.0, 0.0]]);
    for (surface, _) in &mut patches {
        let net = &surface.net;
        surface.net = Grid::from_fn(net.rows(), net.cols(), |i, j| net[(i, j)] + Vec3::new(4e14, 0.0, 0.0));
    }
    assert_eq!(PatchView::new(patches).unwrap().layout().joints().len(), 1);
}
