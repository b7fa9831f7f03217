//! Bodies to lay curves on: cages whose limits at the vertices lie on a given shape, and curves over them.

use std::f64::consts::TAU;

use anyhow::Result;
use ogee::curve_network::NetworkCurve;
use ogee::{Boundary, ControlMesh, FaceList, Level, LimitVertex, Vec3, limit_vertices, shapes};

/// Steps that bring limits to where they are wanted.
const STEPS: usize = 60;

/// A cage, and where its vertices end up.
pub(super) struct Body {
    pub(super) mesh: ControlMesh,
    pub(super) limits: Vec<LimitVertex>,
}

impl Body {
    /// The cage as it is.
    pub(super) fn new(mesh: ControlMesh) -> Result<Body> {
        let limits = limit_vertices(&Level::new(&mesh)?, &mesh.points);
        Ok(Body { mesh, limits })
    }

    /// The cage with points moved until its vertices end up where they are now.
    fn through(mut mesh: ControlMesh) -> Result<Body> {
        let wanted = mesh.points.clone();
        let level = Level::new(&mesh)?;
        for _ in 0..STEPS {
            let limits = limit_vertices(&level, &mesh.points);
            for ((point, wanted), limit) in mesh.points.iter_mut().zip(&wanted).zip(limits) {
                *point += *wanted - limit.position;
            }
        }
        Body::new(mesh)
    }

    /// A curve on the body along a path. Where it meets others, at `meetings`, its legs lie in the tangent plane.
    pub(super) fn curve(&self, vertices: &[u32], closed: bool, meetings: &[u32]) -> NetworkCurve {
        let points: Vec<Vec3> = vertices.iter().map(|&v| self.limits[v as usize].position).collect();
        self.curve_through(vertices, &points, closed, meetings)
    }

    /// The same through other points, one for each vertex.
    pub(super) fn curve_through(
        &self,
        vertices: &[u32],
        points: &[Vec3],
        closed: bool,
        meetings: &[u32],
    ) -> NetworkCurve {
        let normals = vertices.iter().map(|v| match meetings.contains(v) {
            true => self.limits[*v as usize].normal,
            false => None,
        });
        let control = control(points, closed, &normals.collect::<Vec<_>>());
        let name = format!("c{}", vertices[0]);
        let vertices = vertices.to_vec();
        NetworkCurve { name, vertices, closed, control: Some(control), ..NetworkCurve::default() }
    }
}

/// Control points of a curve through points. At those with a normal it is cut: it goes through the control point itself, and
/// its legs lie in the plane.
fn control(points: &[Vec3], closed: bool, normals: &[Option<Vec3>]) -> Vec<Vec3> {
    let count = points.len();
    let neighbours = |i: usize| -> [Option<usize>; 2] {
        [
            (i > 0 || closed).then(|| (i + count - 1) % count),
            (i + 1 < count || closed).then(|| (i + 1) % count),
        ]
    };
    let mut control = points.to_vec();
    // Gauss and Seidel: errors are halved at least.
    for _ in 0..STEPS {
        for i in 0..count {
            let [before, after] = neighbours(i);
            let (Some(before), Some(after)) = (before, after) else { continue };
            if normals[i].is_some() {
                continue;
            }
            let met = [before, after].into_iter().find_map(|k| Some((k, normals[k]?)));
            control[i] = match met {
                Some((k, normal)) => {
                    // A curve that goes through has opposite legs.
                    let along = match neighbours(k) {
                        [Some(one), Some(other)] if other == i => points[i] - points[one],
                        [Some(one), Some(other)] if one == i => points[i] - points[other],
                        _ => points[i] - points[k],
                    };
                    let flat = along - normal.dot(along) * normal;
                    points[k] + (points[i].distance(points[k]) / flat.length()) * flat
                }
                None => (6.0 * points[i] - control[before] - control[after]) / 4.0,
            };
        }
    }
    control
}

/// How a sheet falls from its middle to its sides, from 0 to 1. Curves have no curvature where they meet, so the sheet has none
/// there either: in its middle ..
pub(super) fn flat_in_the_middle(s: f64) -> f64 {
    s.abs().powi(3)
}

/// .. or 2/5 of the way to both sides: the second derivative is `1 + cos(pi s / 0.4)`.
pub(super) fn flat_twice(s: f64) -> f64 {
    let k = TAU / 0.8;
    let integral = |s: f64| 0.5 * s * s + (1.0 - (k * s).cos()) / (k * k);
    integral(s) / integral(1.0)
}

/// An open sheet of `n` x `n` quads of side 1 around the origin, bulged.
pub(super) fn sheet(n: u32, fall: fn(f64) -> f64) -> Result<Body> {
    let mut mesh = shapes::grid(n, n);
    let half = f64::from(n) / 2.0;
    for p in &mut mesh.points {
        *p = on_sheet(half, fall, p.x - half, p.y - half);
    }
    Body::through(mesh)
}

/// A point of the sheet.
pub(super) fn on_sheet(half: f64, fall: fn(f64) -> f64, x: f64, y: f64) -> Vec3 {
    let (s, t) = (x / half, y / half);
    Vec3::new(x, y, half * (0.5 - 0.3 * fall(s) - 0.2 * flat_in_the_middle(t)))
}

/// Number of a vertex of the sheet.
pub(super) fn of_sheet(n: u32, i: u32, j: u32) -> u32 {
    j * (n + 1) + i
}

/// A round dome of `n` sectors with `rings` rings of quads, and a rim of radius 1.
pub(super) fn dome(n: u32, rings: u32) -> Result<Body> {
    let mut mesh = shapes::disk(n, rings);
    for sector in 0..n {
        for a in 1..=rings {
            for b in 0..=rings {
                // A square becomes a quarter of a disk, and that a sector.
                let (x, y) = (f64::from(a) / f64::from(rings), f64::from(b) / f64::from(rings));
                let (u, v) = (x * (1.0 - 0.5 * y * y).sqrt(), y * (1.0 - 0.5 * x * x).sqrt());
                let (radius, turn) = (u.hypot(v), v.atan2(u) / (TAU / 4.0));
                let angle = TAU * (f64::from(sector) + turn) / f64::from(n);
                mesh.points[of_dome(n, rings, sector, a, b) as usize] = on_dome(radius, angle);
            }
        }
    }
    mesh.points[0] = on_dome(0.0, 0.0);
    mesh.scheme.boundary = Boundary::EdgeOnly;
    Body::through(mesh)
}

/// A point of the dome, which has no curvature in its middle: there its curves meet.
pub(super) fn on_dome(radius: f64, angle: f64) -> Vec3 {
    let height = 0.4 - 0.34 * radius.powi(3);
    Vec3::new(radius * angle.cos(), radius * angle.sin(), height)
}

/// Number of a vertex of the dome, `a` steps along the spoke of a sector and `b` along the next.
pub(super) fn of_dome(n: u32, rings: u32, sector: u32, a: u32, b: u32) -> u32 {
    let size = rings * rings + rings;
    match (a, b) {
        (0, 0) => 0,
        (0, _) => of_dome(n, rings, sector + 1, b, 0),
        _ => 1 + sector % n * size + (a - 1) * (rings + 1) + b,
    }
}

/// The spoke of a sector from the middle to the rim.
pub(super) fn spoke(n: u32, rings: u32, sector: u32) -> Vec<u32> {
    (0..=rings).map(|a| of_dome(n, rings, sector, a, 0)).collect()
}

/// A torus whose vertices lie on it.
pub(super) fn torus(around: u32, across: u32) -> Result<Body> {
    Body::through(shapes::torus(around, across))
}

/// A flattened ball with triangles at its poles, where it has no curvature: `meridians` half circles, `parallels` circles between
/// the poles. The poles are the last two vertices, north first.
pub(super) fn globe(meridians: u32, parallels: u32) -> Result<Body> {
    let mut points = Vec::new();
    for j in 1..=parallels {
        let [around, height] = on_meridian(TAU / 2.0 * f64::from(j) / f64::from(parallels + 1));
        for i in 0..meridians {
            let angle = TAU * f64::from(i) / f64::from(meridians);
            points.push(Vec3::new(1.25 * around * angle.cos(), around * angle.sin(), 0.85 * height));
        }
    }
    points.extend([0.85, -0.85].map(|z| Vec3::new(0.0, 0.0, z)));
    let at = |i: u32, j: u32| (j - 1) * meridians + i % meridians;
    let (north, south) = (meridians * parallels, meridians * parallels + 1);
    let mut faces = FaceList::new();
    for i in 0..meridians {
        faces.push(&[north, at(i, 1), at(i + 1, 1)]);
        for j in 1..parallels {
            faces.push(&[at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)]);
        }
        faces.push(&[at(i + 1, parallels), at(i, parallels), south]);
    }
    Body::through(ControlMesh::new(points, faces))
}

/// The point of `r^3 + z^2 = 1` at an angle from the pole.
fn on_meridian(angle: f64) -> [f64; 2] {
    let (sine, cosine) = (angle.sin(), angle.cos());
    let (mut inside, mut outside) = (0.0, 2.0);
    for _ in 0..60 {
        let size = 0.5 * (inside + outside);
        let beyond = (size * sine).powi(3) + (size * cosine).powi(2) > 1.0;
        *(if beyond { &mut outside } else { &mut inside }) = size;
    }
    [inside * sine, inside * cosine]
}

/// The closed path over both poles along meridian `i` and the one opposite.
pub(super) fn great_circle(meridians: u32, parallels: u32, i: u32) -> Vec<u32> {
    let (north, south) = (meridians * parallels, meridians * parallels + 1);
    let down = (1..=parallels).map(|j| (j - 1) * meridians + i);
    let up = (1..=parallels).rev().map(|j| (j - 1) * meridians + i + meridians / 2);
    [north].into_iter().chain(down).chain([south]).chain(up).collect()
}

/// A rounded box of `n` x `n` quads a side, `n` even, and its three belts, closed paths through the middles of four sides.
pub(super) fn rounded_box(n: u32) -> Result<(Body, [Vec<u32>; 3])> {
    let steps: Vec<f64> = (0..=n).map(|i| 2.0 * f64::from(i) / f64::from(n) - 1.0).collect();
    let mut points: Vec<Vec3> = Vec::new();
    let mut number = |p: Vec3| -> u32 {
        let found = points.iter().position(|q| q.distance(p) < 1e-9);
        found.unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    // Axis `k` points out of a side, the two after it run along it.
    let turned = |k: usize, x: f64, y: f64, z: f64| {
        let mut p = [0.0; 3];
        (p[(k + 1) % 3], p[(k + 2) % 3], p[k]) = (x, y, z);
        Vec3::from(p)
    };
    let mut faces = FaceList::new();
    for k in 0..3 {
        for side in [-1.0, 1.0] {
            for x in steps.windows(2) {
                for y in steps.windows(2) {
                    let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
                    let mut quad = corners.map(|[x, y]| number(turned(k, x, y, side)));
                    if side < 0.0 {
                        quad.reverse();
                    }
                    faces.push(&quad);
                }
            }
        }
    }
    let belts = [0, 1, 2].map(|k| {
        let forth = steps[..n as usize].iter();
        let back = || forth.clone().map(|x| -x);
        let square = forth.clone().map(|&x| (x, -1.0)).chain(forth.clone().map(|&y| (1.0, y)));
        let square = square.chain(back().map(|x| (x, 1.0))).chain(back().map(|y| (-1.0, y)));
        square.map(|(x, y)| number(turned(k, x, y, 0.0))).collect()
    });
    let rounded = points.iter().map(|p| {
        // Between a ball and the box.
        let size = [p.x, p.y, p.z].map(|x| x.abs().powi(3)).iter().sum::<f64>().powf(1.0 / 3.0);
        let q = *p / size;
        Vec3::new(1.3 * q.x, q.y, 0.8 * q.z)
    });
    Ok((Body::through(ControlMesh::new(rounded.collect(), faces))?, belts))
}
