//! Parts for tests, sewn from surfaces whose boundary rows agree bit for bit.

#![allow(dead_code, reason = "each test takes the parts it wants")]

use ogee::convert::{Body, Part, Report};
use ogee::nurbs::{
    EdgeUse, FaceAddress, KnotVector, NurbsCurve, NurbsSurface, Shell, ShellEdge, ShellFace, Side,
};
use ogee::{FaceId, Grid, Vec3};

/// A face before sewing: its surface and, for each side in the order of the loop, the pieces of its boundary
/// row in the direction of growing parameter.
pub(crate) struct Cloth {
    pub(crate) surface: NurbsSurface,
    pub(crate) sides: [Vec<NurbsCurve>; 4],
}

pub(crate) const SIDES: [Side; 4] = [Side::V0, Side::U1, Side::V1, Side::U0];

pub(crate) fn row(surface: &NurbsSurface, side: Side) -> NurbsCurve {
    let (rows, cols) = (surface.net.rows(), surface.net.cols());
    let along_u = |j: usize| (0..rows).map(|i| surface.net[(i, j)]).collect();
    let (knots, points) = match side {
        Side::V0 => (&surface.u, along_u(0)),
        Side::V1 => (&surface.u, along_u(cols - 1)),
        Side::U0 => (&surface.v, surface.net.row(0).to_vec()),
        Side::U1 => (&surface.v, surface.net.row(rows - 1).to_vec()),
    };
    NurbsCurve { knots: knots.clone(), points }
}

impl Cloth {
    pub(crate) fn new(surface: NurbsSurface) -> Cloth {
        let sides = SIDES.map(|side| vec![row(&surface, side)]);
        Cloth { surface, sides }
    }

    /// The side's row cut in the middle of its domain.
    pub(crate) fn cut(mut self, side: usize) -> Cloth {
        let [a, b] = self.sides[side][0].knots.domain();
        self.sides[side] = self.sides[side][0].with_knot((a + b) / 2.0).bezier_pieces();
        self
    }
}

/// Joins faces where the pieces of their sides have equal coefficients, in either direction.
pub(crate) fn sew(cloths: Vec<Cloth>) -> Shell {
    let mut shell = Shell::default();
    for (f, cloth) in cloths.into_iter().enumerate() {
        let mut boundary = Vec::new();
        for (side, pieces) in SIDES.into_iter().zip(&cloth.sides) {
            let backward = matches!(side, Side::V1 | Side::U0);
            let domain = match side {
                Side::V0 | Side::V1 => cloth.surface.u.domain(),
                Side::U0 | Side::U1 => cloth.surface.v.domain(),
            };
            let mut uses = Vec::new();
            for (k, piece) in pieces.iter().enumerate() {
                let degenerate = piece.points.iter().all(|&point| point == piece.points[0]);
                if degenerate {
                    continue;
                }
                let share = (domain[1] - domain[0]) / pieces.len() as f64;
                let range = [domain[0] + share * k as f64, domain[0] + share * (k + 1) as f64];
                let (edge, along) = shell_edge(&mut shell, piece);
                uses.push(EdgeUse {
                    edge,
                    forward: along != backward,
                    side,
                    range: if backward { [range[1], range[0]] } else { range },
                });
            }
            if backward {
                uses.reverse();
            }
            boundary.extend(uses);
        }
        let address = FaceAddress::whole(FaceId(f as u32));
        shell.faces.push(ShellFace {
            surface: cloth.surface,
            boundary,
            quads: Grid::from_fn(1, 1, |_, _| address),
        });
    }
    shell
}

/// The edge with this curve, and whether the curve runs along it.
fn shell_edge(shell: &mut Shell, curve: &NurbsCurve) -> (u32, bool) {
    let reversed: Vec<Vec3> = curve.points.iter().rev().copied().collect();
    for (i, edge) in shell.edges.iter().enumerate() {
        if edge.curve.points == curve.points || edge.curve.points == reversed {
            let along = edge.curve.points == curve.points;
            return (i as u32, along);
        }
    }
    let mut vertex = |point: Vec3| match shell.vertices.iter().position(|&other| other == point) {
        Some(i) => i as u32,
        None => {
            shell.vertices.push(point);
            shell.vertices.len() as u32 - 1
        }
    };
    let (start, end) = (vertex(curve.points[0]), vertex(curve.points[curve.points.len() - 1]));
    shell.edges.push(ShellEdge { start, end, curve: curve.clone(), smooth: false });
    (shell.edges.len() as u32 - 1, true)
}

pub(crate) fn bezier() -> KnotVector {
    KnotVector::from_multiplicities(3, [(0.0, 4), (1.0, 4)])
}

/// A bicubic patch over a rectangle, its four inner coefficients raised.
pub(crate) fn dome(origin: Vec3, u: Vec3, v: Vec3, raised: Vec3) -> NurbsSurface {
    let net = Grid::from_fn(4, 4, |i, j| {
        let inner = (1..3).contains(&i) && (1..3).contains(&j);
        let flat = Vec3::new(
            step(origin.x, u.x, v.x, i, j),
            step(origin.y, u.y, v.y, i, j),
            step(origin.z, u.z, v.z, i, j),
        );
        if inner { flat + raised } else { flat }
    });
    NurbsSurface { u: bezier(), v: bezier(), net }
}

/// One coordinate; a row is the same bits from whichever side of a box it is seen.
fn step(origin: f64, u: f64, v: f64, i: usize, j: usize) -> f64 {
    let along = |from: f64, by: f64, i: usize| {
        let to = from + by;
        // Symmetric in both ends.
        (from.min(to) * (if by < 0.0 { i } else { 3 - i }) as f64
            + from.max(to) * (if by < 0.0 { 3 - i } else { i }) as f64)
            / 3.0
    };
    if v == 0.0 { along(origin, u, i) } else { along(origin, v, j) }
}

/// The two-patch lens, `size` long: volume `size^2 height / 2`.
pub(crate) fn lens_of(size: f64, height: f64) -> Shell {
    let [o, x, y] = [Vec3::ZERO, Vec3::new(size, 0.0, 0.0), Vec3::new(0.0, size, 0.0)];
    let up = Vec3::new(0.0, 0.0, height);
    sew(vec![Cloth::new(dome(o, x, y, up)), Cloth::new(dome(o, y, x, -up))])
}

/// The six faces of a box with domes of `bulge` on them: volume is that of the box and
/// `bulge * area of the box / 4`.
pub(crate) fn brick_cloths(least: Vec3, greatest: Vec3, bulge: f64) -> Vec<Cloth> {
    let d = greatest - least;
    let [x, y, z] = [Vec3::new(d.x, 0.0, 0.0), Vec3::new(0.0, d.y, 0.0), Vec3::new(0.0, 0.0, d.z)];
    let up = |axis: Vec3| axis * (bulge / axis.length());
    [
        dome(least, y, x, -up(z)),
        dome(Vec3::new(least.x, least.y, greatest.z), x, y, up(z)),
        dome(least, x, z, -up(y)),
        dome(Vec3::new(least.x, greatest.y, least.z), z, x, up(y)),
        dome(least, z, y, -up(x)),
        dome(Vec3::new(greatest.x, least.y, least.z), y, z, up(x)),
    ]
    .into_iter()
    .map(Cloth::new)
    .collect()
}

pub(crate) fn brick(least: Vec3, greatest: Vec3, bulge: f64) -> Shell {
    sew(brick_cloths(least, greatest, bulge))
}

/// A box whose top is cut in two, so that two of its long edges carry a T.
pub(crate) fn brick_with_ts() -> Shell {
    let mut cloths = brick_cloths(Vec3::ZERO, Vec3::new(90.0, 60.0, 30.0), 3.0);
    let top = cloths.remove(1).surface.with_knot_u(0.5).bezier_pieces();
    // Front (u = x, v = z): its top is V1. Back (u = z, v = x): its top is U1.
    let front = cloths.remove(1).cut(2);
    let back = cloths.remove(1).cut(1);
    cloths.extend([front, back]);
    cloths.extend(top.cells().iter().cloned().map(Cloth::new));
    sew(cloths)
}

/// A box whose top carries a knot that its neighbours do not.
pub(crate) fn brick_with_a_knot() -> Shell {
    let mut cloths = brick_cloths(Vec3::ZERO, Vec3::new(90.0, 60.0, 30.0), 3.0);
    let top = cloths.remove(1);
    let surface = top.surface.with_knot_u(0.25).with_knot_v(0.5).with_knot_v(0.5);
    cloths.push(Cloth { surface, sides: top.sides });
    sew(cloths)
}

/// A ring of one face that meets itself along two seams: one vertex, two edges.
pub(crate) fn torus() -> Shell {
    let knots = |n: usize| {
        let inner = (1..n - 3).map(|k| (k as f64, 1));
        KnotVector::from_multiplicities(
            3,
            std::iter::once((0.0, 4)).chain(inner).chain([((n - 3) as f64, 4)]),
        )
    };
    let (n, m) = (9, 7);
    let net = Grid::from_fn(n, m, |i, j| {
        let around = std::f64::consts::TAU * (i % (n - 1)) as f64 / (n - 1) as f64;
        let across = std::f64::consts::TAU * (j % (m - 1)) as f64 / (m - 1) as f64;
        let radius = 30.0 + 10.0 * across.cos();
        Vec3::new(radius * around.cos(), radius * around.sin(), 10.0 * across.sin())
    });
    sew(vec![Cloth::new(NurbsSurface { u: knots(n), v: knots(m), net })])
}

/// A sheet of one patch, 30 x 30.
pub(crate) fn sheet() -> Shell {
    let [x, y] = [Vec3::new(30.0, 0.0, 0.0), Vec3::new(0.0, 30.0, 0.0)];
    sew(vec![Cloth::new(dome(Vec3::new(0.0, 0.0, 50.0), x, y, Vec3::new(0.0, 0.0, 6.0)))])
}

/// A sheet of two patches that share an edge.
pub(crate) fn wide_sheet() -> Shell {
    let [x, y] = [Vec3::new(30.0, 0.0, 0.0), Vec3::new(0.0, 30.0, 0.0)];
    let up = Vec3::new(0.0, 0.0, 6.0);
    sew(vec![Cloth::new(dome(Vec3::ZERO, x, y, up)), Cloth::new(dome(x, x, y, up))])
}

/// A sheet that closes to a point: its side `v = 0` has no length.
pub(crate) fn pole() -> Shell {
    let fan =
        dome(Vec3::ZERO, Vec3::new(30.0, 0.0, 0.0), Vec3::new(0.0, 30.0, 0.0), Vec3::new(0.0, 0.0, 3.0));
    let net = Grid::from_fn(4, 4, |i, j| {
        let point = fan.net[(i, j)];
        Vec3::new(10.0 + (point.x - 10.0) * j as f64 / 3.0, point.y, point.z)
    });
    sew(vec![Cloth::new(NurbsSurface { net, ..fan })])
}

pub(crate) fn solid(shell: Shell) -> Body {
    Body::Solid { outer: shell, voids: Vec::new() }
}

pub(crate) fn hollow() -> Body {
    let outer = brick(Vec3::ZERO, Vec3::new(60.0, 60.0, 60.0), 2.0);
    let inner = brick(Vec3::new(20.0, 20.0, 20.0), Vec3::new(40.0, 40.0, 40.0), 1.0);
    Body::Solid { outer, voids: vec![inner] }
}

pub(crate) fn part(bodies: Vec<Body>) -> Part {
    Part { bodies, report: Report::default() }
}

/// Every kind of body, by name.
pub(crate) fn all_parts() -> Vec<(&'static str, Part)> {
    let one = Vec3::new(1.0, 1.0, 1.0);
    let far = brick(Vec3::new(200.0, 0.0, 0.0), Vec3::new(260.0, 60.0, 60.0), 2.0);
    vec![
        ("lens", part(vec![solid(lens_of(30.0, 6.0))])),
        ("brick", part(vec![solid(brick(Vec3::ZERO, one * 100.0, 5.0))])),
        ("ts", part(vec![solid(brick_with_ts())])),
        ("knot", part(vec![solid(brick_with_a_knot())])),
        ("torus", part(vec![solid(torus())])),
        ("two", part(vec![solid(lens_of(30.0, 6.0)), solid(far.clone())])),
        ("hollow", part(vec![hollow()])),
        ("sheet", part(vec![Body::Sheet(sheet())])),
        ("wide", part(vec![Body::Sheet(wide_sheet())])),
        ("pole", part(vec![Body::Sheet(pole())])),
        ("mixed", part(vec![solid(lens_of(30.0, 6.0)), Body::Sheet(sheet()), hollow_far(), solid(far)])),
        ("empty", part(vec![])),
    ]
}

fn hollow_far() -> Body {
    let outer = brick(Vec3::new(0.0, 100.0, 0.0), Vec3::new(60.0, 160.0, 60.0), 2.0);
    let inner = brick(Vec3::new(20.0, 120.0, 20.0), Vec3::new(40.0, 140.0, 40.0), 1.0);
    Body::Solid { outer, voids: vec![inner] }
}
