//! Parts whose faces are of several sizes are laid out in squares that share whole sides, and measured as the same surface in
//! faces of one size is; places are named in terms of the cage whatever pieces they come in.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use ogee::convert::{Method, Options, Packing, to_part};
use ogee::nurbs::{FaceAddress, KnotVector, NurbsSurface};
use ogee::quality::{
    CurvatureRange, ExtraordinaryPoint, Field, PatchView, Report, ReportOptions, Surface, bounding_box,
};
use ogee::{ControlMesh, Derivatives, Grid, Samples, Vec3, shapes};

type Patch = (NurbsSurface, Grid<FaceAddress>);

/// Patches of a cage, one to a quad, in quads' own frames.
fn patches(mesh: &ControlMesh) -> Vec<Patch> {
    patches_by(mesh, Method::Pccm)
}

fn patches_by(mesh: &ControlMesh, method: Method) -> Vec<Patch> {
    let part = to_part(mesh, &Options { method, packing: Packing::Unpacked, ..Options::default() }).unwrap();
    let shells = part.bodies.iter().flat_map(|body| body.shells());
    shells.flat_map(|shell| &shell.faces).map(|face| (face.surface.clone(), face.quads.clone())).collect()
}

/// Knots up to the middle of their domain and from there on, and how many coefficients the first have.
fn halves(knots: &KnotVector) -> ([KnotVector; 2], usize) {
    let ([from, to], degree) = (knots.domain(), knots.degree());
    let middle = f64::midpoint(from, to);
    let below: Vec<f64> = knots.knots().iter().copied().filter(|&knot| knot < middle).collect();
    let above: Vec<f64> = knots.knots().iter().copied().filter(|&knot| knot > middle).collect();
    let count = below.len();
    let ends = vec![middle; degree + 1];
    let first = KnotVector::new(degree, [below, ends.clone()].concat());
    ([first, KnotVector::new(degree, [ends, above].concat())], count)
}

/// A surface seen from its corner 1: turned by one side.
fn turned(surface: &NurbsSurface) -> NurbsSurface {
    let [from, to] = surface.u.domain();
    let backwards: Vec<f64> = surface.u.knots().iter().rev().map(|knot| from + to - knot).collect();
    let rows = surface.net.rows();
    NurbsSurface {
        u: surface.v.clone(),
        v: KnotVector::new(surface.u.degree(), backwards),
        net: Grid::from_fn(surface.net.cols(), rows, |i, j| surface.net[(rows - 1 - j, i)]),
    }
}

/// The four quarters of a patch, each with its `(0, 0)` at the corner it lies at.
fn quartered(patch: &Patch) -> Vec<Patch> {
    let mut surface = patch.0.clone();
    let times = |knots: &KnotVector| {
        let [from, to] = knots.domain();
        knots.knots().iter().filter(|&&knot| knot == f64::midpoint(from, to)).count()
    };
    while times(&surface.u) < surface.u.degree() {
        surface = surface.with_knot_u(surface.u.domain().iter().sum::<f64>() / 2.0);
    }
    while times(&surface.v) < surface.v.degree() {
        surface = surface.with_knot_v(surface.v.domain().iter().sum::<f64>() / 2.0);
    }
    let ((u, rows), (v, cols)) = (halves(&surface.u), halves(&surface.v));
    let quarter = |k: usize| {
        let (right, upper) = ([0, 1, 1, 0][k], [0, 0, 1, 1][k]);
        let (u, v) = (u[right].clone(), v[upper].clone());
        let first = (right * (rows - 1), upper * (cols - 1));
        let net =
            Grid::from_fn(u.coefficients(), v.coefficients(), |i, j| surface.net[(first.0 + i, first.1 + j)]);
        let own = (0..k).fold(NurbsSurface { u, v, net }, |surface, _| turned(&surface));
        (own, Grid::from_fn(1, 1, |_, _| patch.1[(0, 0)].quarter(k as u32)))
    };
    (0..4).map(quarter).collect()
}

/// Some patches whole, some in quarters, some in quarters of quarters, and of some a single quarter in quarters.
fn of_several_sizes(patches: &[Patch]) -> Vec<Patch> {
    let pieces = patches.iter().enumerate().flat_map(|(number, patch)| match number % 7 {
        0 | 3 => quartered(patch),
        4 => quartered(patch).iter().flat_map(quartered).collect(),
        5 => {
            let quarters = quartered(patch);
            let last = quartered(&quarters[3]);
            quarters[..3].iter().cloned().chain(last).collect()
        }
        _ => vec![patch.clone()],
    });
    pieces.collect()
}

fn report(view: &PatchView) -> Report {
    let field = Field::Isophote { light: Vec3::new(0.36, -0.48, 0.8) };
    let options = ReportOptions { crease_angle: Some(10.0), ..ReportOptions::new(field) };
    Report::new(view, &options).unwrap()
}

fn cages_with_patches() -> [ControlMesh; 3] {
    [cages::body(), shapes::cube(), cages::creased(cages::cube(), &cages::TOP, 10.0)]
}

#[test]
fn squares_of_several_sizes_share_whole_sides() {
    for mesh in cages_with_patches() {
        let whole = patches(&mesh);
        let view = PatchView::new(of_several_sizes(&whole)).unwrap();
        let layout = view.layout();
        assert_eq!(layout.border().count(), 0);
        assert_eq!(2 * layout.joints().len(), 4 * layout.squares().len());
        // Cut where needed, and not to the smallest size throughout.
        assert!(layout.squares().len() > view.patches().len());
        assert!(layout.squares().len() < 16 * whole.len());
        let mut samples = Samples::default();
        let size = bounding_box(&view).map(|[low, high]| low.distance(high)).unwrap();
        for joint in layout.joints() {
            let [a, b] = joint.sides;
            for x in [0.0, 0.3, 0.75, 1.0] {
                let places = [
                    layout.squares()[a.square as usize].on_side(a.side, x),
                    layout.squares()[b.square as usize].on_side(b.side, 1.0 - x),
                ];
                view.evaluate(&places, Derivatives::None, &mut samples);
                assert!(samples.position[0].distance(samples.position[1]) < 1e-13 * size, "{joint:?} at {x}");
            }
        }
    }
}

#[test]
fn a_part_is_measured_alike_in_faces_of_any_size() {
    for mesh in cages_with_patches() {
        let whole = patches(&mesh);
        let one = report(&PatchView::new(whole.clone()).unwrap());
        let several = report(&PatchView::new(of_several_sizes(&whole)).unwrap());
        assert!(several.is_closed());
        let [a, b] = [&one.continuity, &several.continuity];
        assert!(b.smooth.angle.max < 1e-8 && b.smooth.gap.max < 1e-12 * several.size());
        assert_eq!(a.sharp.count > 0, b.sharp.count > 0);
        assert!((several.curvature.area / one.curvature.area - 1.0).abs() < 5e-3);
        let [a, b] = [&one.extraordinary, &several.extraordinary];
        assert_eq!((a.found, b.without_plane.len()), (b.found, a.without_plane.len()));
        let known = |at: Vec3| a.points.iter().find(|point| point.sector.position.distance(at) < 1e-9);
        for point in &b.points {
            let first = known(point.sector.position).unwrap();
            assert_eq!((first.sector.faces, first.sector.kind), (point.sector.faces, point.sector.kind));
        }
    }
}

#[test]
fn rings_and_ranges_keep_their_size_where_neighbours_are_small() {
    let whole = patches(&cages::body());
    let one = report(&PatchView::new(whole.clone()).unwrap()).extraordinary.points;
    let chosen = one[0].sector.position;
    // Everything in quarters of quarters, but for the patches around one point.
    let touches = |patch: &Patch| {
        let net = &patch.0.net;
        let (rows, cols) = (net.rows() - 1, net.cols() - 1);
        [(0, 0), (rows, 0), (rows, cols), (0, cols)].iter().any(|&at| net[at].distance(chosen) < 1e-9)
    };
    let pieces = whole.iter().flat_map(|patch| match touches(patch) {
        true => vec![patch.clone()],
        false => quartered(patch).iter().flat_map(quartered).collect(),
    });
    let several = report(&PatchView::new(pieces.collect()).unwrap()).extraordinary.points;
    let same: Vec<&ExtraordinaryPoint> =
        several.iter().filter(|point| point.sector.position.distance(chosen) < 1e-9).collect();
    let [same] = same[..] else { panic!("{} points for one", same.len()) };
    for (a, b) in one[0].rings.iter().zip(&same.rings) {
        assert!((a.mean - b.mean).abs() < 1e-9 * a.mean && (a.mean_swing - b.mean_swing).abs() < 1e-9);
    }
    let (a, b) = (one[0].range, same.range);
    assert_eq!(a.reach, b.reach);
    assert!((a.mean_span() - b.mean_span()).abs() < 1e-9 * a.mean_span(), "{a:?} {b:?}");
    assert!((a.gauss_span() - b.gauss_span()).abs() < 1e-9 * a.gauss_span(), "{a:?} {b:?}");
}

#[test]
fn quarters_have_the_ranges_of_the_halves_of_faces() {
    // Without knots inside, at which curvature may jump and quarters have it from the other side.
    let whole = patches_by(&shapes::cube(), Method::Bi5);
    let quarters: Vec<Patch> = whole.iter().flat_map(quartered).collect();
    let ranges = |patches: Vec<Patch>| -> Vec<CurvatureRange> {
        let points = report(&PatchView::new(patches).unwrap()).extraordinary.points;
        points.into_iter().map(|point| point.range).collect()
    };
    let (halves, all) = (ranges(whole), ranges(quarters));
    assert_eq!((halves.len(), all.len()), (8, 8));
    for (a, b) in halves.iter().zip(&all) {
        assert_eq!([a.reach, b.reach], [0.5, 1.0]);
        assert!(a.mean_span() > 0.1, "{a:?}");
        assert!(
            (a.mean_span() - b.mean_span()).abs() < 1e-9 && (a.gauss_span() - b.gauss_span()).abs() < 1e-9
        );
    }
}

#[test]
fn quarters_of_quarters_are_named_in_the_frame_of_the_cage() {
    let whole = patches(&cages::body());
    let view = PatchView::new(of_several_sizes(&whole)).unwrap();
    let mut samples = Samples::default();
    let mut depths = [0; 3];
    for square in view.layout().squares() {
        let at = square.at(0.3, 0.8);
        let address = view.address(at);
        // From the quarter at a corner to the whole quad.
        let [u, v] = [address.u, address.v].map(|x| if address.corner.is_some() { x / 2.0 } else { x });
        let [u, v] = match address.corner {
            None | Some(0) => [u, v],
            Some(1) => [1.0 - v, u],
            Some(2) => [1.0 - u, 1.0 - v],
            _ => [v, 1.0 - u],
        };
        let quad = whole.iter().find(|(_, quads)| quads[(0, 0)].face == address.face).unwrap();
        view.evaluate(&[at], Derivatives::None, &mut samples);
        let ([u0, u1], [v0, v1]) = (quad.0.u.domain(), quad.0.v.domain());
        let there = quad.0.jet(u0 + u * (u1 - u0), v0 + v * (v1 - v0)).position;
        assert!(samples.position[0].distance(there) < 1e-12, "{address:?}");
        let piece = view.patches()[at.parametric_face()].1[(0, 0)];
        depths[piece.corner.map_or(0, |_| 1 + piece.quarters.depth() as usize)] += 1;
    }
    assert!(depths.iter().all(|&count| count > 0), "{depths:?}");
}

#[test]
fn curvature_continuous_parts_are_seen_to_be_so() {
    let plate = cages::voxels(&[
        [0, 0, 0],
        [1, 0, 0],
        [2, 0, 0],
        [0, 1, 0],
        [2, 1, 0],
        [0, 2, 0],
        [1, 2, 0],
        [2, 2, 0],
    ]);
    let corner: Vec<[i32; 3]> = (1..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    for mesh in [plate, cages::voxels(&corner)] {
        let view = PatchView::new(patches_by(&mesh, Method::G2)).unwrap();
        // Faces of two levels of refinement.
        let depths: Vec<bool> =
            view.patches().iter().map(|(_, quads)| quads[(0, 0)].corner.is_some()).collect();
        assert!(depths.contains(&true) && depths.contains(&false));
        let found = report(&view);
        assert!(found.is_closed());
        let smooth = &found.continuity.smooth;
        assert!(smooth.gap.max < 1e-12 * found.size() && smooth.angle.max < 1e-9, "{}", smooth.angle.max);
        assert!(smooth.curvature.max < 1e-9 && smooth.kink.max < 1e-6, "{}", smooth.curvature.max);
        // Every extraordinary vertex of the cage, on one of its faces, and none besides.
        let level = ogee::Level::new(&mesh).unwrap();
        let limits = ogee::limit_vertices(&level, &mesh.points);
        let valence = |vertex: u32| level.topology().ring(ogee::VertexId(vertex)).count();
        let mut named: Vec<u32> = Vec::new();
        for point in &found.extraordinary.points {
            let corners = mesh.faces.face(point.sector.at.face.index());
            let at = point.sector.at;
            let corner = match (at.corner, [at.u, at.v]) {
                (Some(corner), [0.0, 0.0]) => corner,
                (None, [0.0, 0.0]) => 0,
                (None, [1.0, 0.0]) => 1,
                (None, [1.0, 1.0]) => 2,
                (None, [0.0, 1.0]) => 3,
                _ => panic!("{at:?} is no corner"),
            };
            let vertex = corners[corner as usize];
            assert_eq!(valence(vertex), point.sector.faces);
            let distance = limits[vertex as usize].position.distance(point.sector.position);
            assert!(distance < 0.02 * found.size(), "{at:?} is {distance} off");
            named.push(vertex);
        }
        named.sort_unstable();
        let wanted: Vec<u32> = (0..mesh.points.len() as u32).filter(|&vertex| valence(vertex) != 4).collect();
        assert_eq!(named, wanted);
    }
}
