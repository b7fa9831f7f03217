//! Cages for the claims about evaluation, and the way from the corner of a face to an address.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use ogee::{
    Boundary, ControlMesh, Corner, Crease, Creasing, FaceId, FaceList, LensShape, Level, Location, Meeting,
    PatchTable, Scheme, Sharpness, SurfaceJet, Vec3, VertexId, shapes,
};
use proptest::collection::vec;
use proptest::prelude::*;

/// The boundary of the unit cells of `filled`: a closed surface with valences 3 to 6.
pub fn voxels(filled: &[[i32; 3]]) -> ControlMesh {
    let mut points: Vec<[i32; 3]> = Vec::new();
    let mut faces = Vec::new();
    for &cell in filled {
        for axis in 0..3 {
            for side in 0..2 {
                let mut neighbour = cell;
                neighbour[axis] += 2 * side - 1;
                if filled.contains(&neighbour) {
                    continue;
                }
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| {
                    let mut p = cell;
                    p[axis] += side;
                    p[a] += i;
                    p[b] += j;
                    points.iter().position(|&q| q == p).unwrap_or_else(|| {
                        points.push(p);
                        points.len() - 1
                    }) as u32
                });
                if side == 0 {
                    corners.reverse();
                }
                faces.push(corners);
            }
        }
    }
    let points = points.iter().map(|p| Vec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])));
    ControlMesh::new(points.collect(), faces.into_iter().collect())
}

/// Numbers between -1/2 and 1/2, the same every time.
pub fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 31) - 0.5
    }
}

/// Makes curves meet at a vertex, one of them along the edge to `port` and the others along every second edge.
pub fn meeting(mut mesh: ControlMesh, vertex: u32, port: u32, t: f64) -> ControlMesh {
    let mut spokes = vec![port];
    loop {
        let last = spokes[spokes.len() - 1];
        let next = mesh.faces.iter().find_map(|face| {
            let k = face.iter().position(|&v| v == vertex)?;
            (face[(k + 1) % face.len()] == last).then(|| face[(k + face.len() - 1) % face.len()])
        });
        match next.unwrap() {
            next if next == port => break,
            next => spokes.push(next),
        }
    }
    mesh.meetings.push(Meeting { vertex, ports: spokes.into_iter().step_by(2).collect(), t });
    mesh
}

/// Moves every point a little, the same every time, so that nothing is right by symmetry alone.
pub fn shaken(mut mesh: ControlMesh, by: f64) -> ControlMesh {
    let mut next = noise(7);
    for p in &mut mesh.points {
        *p += by * Vec3::new(next(), next(), next());
    }
    mesh
}

/// Points of no order at all, the same every time.
pub fn cloud(count: usize) -> Vec<Vec3> {
    let mut next = noise(11);
    (0..count).map(|_| Vec3::new(next(), next(), next())).collect()
}

pub fn polygons(points: &[[f64; 3]], faces: &[&[u32]]) -> ControlMesh {
    let mut list = FaceList::new();
    faces.iter().for_each(|face| list.push(face));
    ControlMesh::new(points.iter().map(|&p| Vec3::from(p)).collect(), list)
}

pub fn creased(mut mesh: ControlMesh, edges: &[[u32; 2]], sharpness: f64) -> ControlMesh {
    let sharpness = Sharpness::from_value(sharpness);
    mesh.creases.extend(edges.iter().map(|&vertices| Crease { vertices, sharpness }));
    mesh
}

pub fn sharp_at(mut mesh: ControlMesh, vertices: &[u32], sharpness: f64) -> ControlMesh {
    let sharpness = Sharpness::from_value(sharpness);
    mesh.corners.extend(vertices.iter().map(|&vertex| Corner { vertex, sharpness }));
    mesh
}

pub fn chaikin(mut mesh: ControlMesh) -> ControlMesh {
    mesh.scheme.creasing = Creasing::Chaikin;
    mesh
}

pub fn with_boundary(mut mesh: ControlMesh, boundary: Boundary) -> ControlMesh {
    mesh.scheme.boundary = boundary;
    mesh
}

pub fn with_holes(mut mesh: ControlMesh, holes: &[u32]) -> ControlMesh {
    mesh.holes = holes.to_vec();
    mesh
}

/// Without some of its faces; their points stay.
pub fn without(mut mesh: ControlMesh, gone: &[usize]) -> ControlMesh {
    let mut faces = FaceList::new();
    mesh.faces.iter().enumerate().filter(|(f, _)| !gone.contains(f)).for_each(|(_, face)| faces.push(face));
    mesh.faces = faces;
    mesh
}

/// A disk of two rings of quads around vertex 0.
pub fn disk(n: u32) -> ControlMesh {
    shaken(shapes::disk(n, 2), 0.25)
}

/// The edges of a [`disk`] from its middle along some of its spokes, `length` edges each.
pub fn spokes(which: &[u32], length: usize) -> Vec<[u32; 2]> {
    let along = |&k: &u32| [[0, 1 + 6 * k], [1 + 6 * k, 4 + 6 * k]].into_iter().take(length);
    which.iter().flat_map(along).collect()
}

pub const TOP: [[u32; 2]; 4] = [[4, 5], [5, 7], [7, 6], [6, 4]];

pub fn cube() -> ControlMesh {
    shaken(shapes::cube(), 0.4)
}

pub fn grid(columns: u32, rows: u32) -> ControlMesh {
    shaken(shapes::grid(columns, rows), 0.4)
}

pub fn pyramid() -> ControlMesh {
    let points = [[1.0, 0.1, 0.0], [0.0, 1.2, 0.0], [-1.0, 0.0, 0.2], [0.1, -1.0, 0.0], [0.0, 0.2, 1.0]];
    polygons(&points, &[&[3, 2, 1, 0], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]])
}

/// A prism over a polygon of `n` sides.
pub fn prism(n: u32) -> ControlMesh {
    let ring = |z: f64| {
        (0..n).map(move |k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
            Vec3::new(angle.cos(), angle.sin(), z)
        })
    };
    let mut faces = FaceList::new();
    faces.push(&(0..n).rev().collect::<Vec<u32>>());
    faces.push(&(n..2 * n).collect::<Vec<u32>>());
    for k in 0..n {
        let next = (k + 1) % n;
        faces.push(&[k, next, n + next, n + k]);
    }
    shaken(ControlMesh::new(ring(0.0).chain(ring(1.0)).collect(), faces), 0.2)
}

pub fn octahedron() -> ControlMesh {
    let points = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let faces: [&[u32]; 8] =
        [&[0, 2, 4], &[2, 1, 4], &[1, 3, 4], &[3, 0, 4], &[2, 0, 5], &[1, 2, 5], &[3, 1, 5], &[0, 3, 5]];
    shaken(polygons(&points, &faces), 0.3)
}

/// An open grid of squares, each cut along a diagonal.
pub fn triangles() -> ControlMesh {
    let square = grid(3, 3);
    let mut faces = FaceList::new();
    for face in square.faces.iter() {
        faces.push(&[face[0], face[1], face[2]]);
        faces.push(&[face[0], face[2], face[3]]);
    }
    ControlMesh::new(square.points, faces)
}

/// A grid of which a quarter is gone: three faces meet at the boundary vertex 12.
pub fn l_shape() -> ControlMesh {
    without(grid(4, 4), &[10, 11, 14, 15])
}

/// `k` faces of a disk around its middle, which then lies on the boundary.
pub fn fan(k: u32) -> ControlMesh {
    let whole = disk(k + 2);
    let gone: Vec<usize> = (4 * k as usize..4 * (k as usize + 2)).collect();
    tidy(without(whole, &gone))
}

/// Without points that no face uses.
fn tidy(mesh: ControlMesh) -> ControlMesh {
    let used: Vec<u32> = (0..mesh.points.len() as u32).filter(|v| mesh.faces.corners().contains(v)).collect();
    let own = |v: &u32| used.binary_search(v).unwrap() as u32;
    let mut faces = FaceList::new();
    mesh.faces.iter().for_each(|face| faces.push(&face.iter().map(own).collect::<Vec<_>>()));
    let points = used.iter().map(|&v| mesh.points[v as usize]).collect();
    ControlMesh { points, faces, ..mesh }
}

/// A cube whose top is cut in two by a bent line, whose middle then has two faces.
pub fn valence_two() -> ControlMesh {
    let mut mesh = cube();
    let mut faces = FaceList::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        if f == 1 {
            faces.push(&[face[0], face[1], face[2], 8]);
            faces.push(&[face[0], 8, face[2], face[3]]);
        } else {
            faces.push(face);
        }
    }
    mesh.faces = faces;
    mesh.points.push(Vec3::new(0.1, 0.05, 1.3));
    mesh
}

/// A cube whose top is cut in three by two bent lines: two lenses on the diagonal of one face.
pub fn stacked_lenses() -> ControlMesh {
    let mut mesh = valence_two();
    let mut faces = FaceList::new();
    for face in mesh.faces.iter() {
        if face.contains(&8) && face[1] == 8 {
            faces.push(&[face[0], 8, face[2], 9]);
            faces.push(&[face[0], 9, face[2], face[3]]);
        } else {
            faces.push(face);
        }
    }
    mesh.faces = faces;
    mesh.points.push(Vec3::new(-0.2, 0.1, 1.4));
    mesh
}

/// A cube whose top is cut in three by a straight line and a bent one: a lens of a triangle and a quad, or of a pentagon.
pub fn lens_of_polygons() -> ControlMesh {
    let mut mesh = cube();
    let mut faces = FaceList::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        if f == 1 {
            faces.push(&[face[0], face[1], face[2]]);
            faces.push(&[face[0], face[2], 8]);
            faces.push(&[face[0], 8, face[2], 9, face[3]]);
        } else if face.contains(&mesh.faces.face(1)[2]) && face.contains(&mesh.faces.face(1)[3]) {
            let at = face.iter().position(|&v| v == mesh.faces.face(1)[3]).unwrap();
            let mut corners = face.to_vec();
            corners.rotate_left(at);
            corners.insert(1, 9);
            faces.push(&corners);
        } else {
            faces.push(face);
        }
    }
    mesh.faces = faces;
    mesh.points.extend([Vec3::new(0.1, 0.05, 1.3), Vec3::new(0.1, 1.2, 0.9)]);
    mesh
}

/// The number of a point of a lens net at `(i, j)` of the w-plane, where it is the same as `(-i, -j)`.
pub fn in_lens_net(mut i: i32, mut j: i32) -> u32 {
    if j < 0 || j == 0 && i < 0 {
        (i, j) = (-i, -j);
    }
    let k = i.abs().max(j.abs());
    let along = |i: i32, j: i32| if i == k { j } else { 2 * k - i };
    let t = match (i > 0, k) {
        (_, 0) => return 0,
        (true, _) => along(i, j),
        (false, _) => 2 * k + along(j, -i),
    };
    (1 + 2 * k * (k - 1) + t) as u32
}

/// A lens, vertex 0, in so many layers of quads, slightly domed: its points are squares of complex numbers. Faces 0 and 1
/// are the two at the lens.
pub fn lens_net(layers: i32) -> ControlMesh {
    let mut points = vec![Vec3::ZERO; (1 + 2 * layers * (layers + 1)) as usize];
    let (mut faces, mut outer) = (FaceList::new(), Vec::new());
    for j in -layers..=layers {
        for i in -layers..=layers {
            let [x, y] = [f64::from(i * i - j * j), f64::from(2 * i * j)];
            let number = in_lens_net(i, j) as usize;
            points[number] = Vec3::new(x, y, -0.02 * (x * x + y * y) / f64::from(layers)) / 4.0;
        }
    }
    let mut quadrant = |turn: &dyn Fn(i32, i32) -> u32| {
        for (i, j) in (0..layers).flat_map(|j| (0..layers).map(move |i| (i, j))) {
            let corners = [turn(i, j), turn(i + 1, j), turn(i + 1, j + 1), turn(i, j + 1)];
            if i == 0 && j == 0 { faces.push(&corners) } else { outer.push(corners) }
        }
    };
    quadrant(&|i, j| in_lens_net(i, j));
    quadrant(&|i, j| in_lens_net(-j, i));
    outer.iter().for_each(|corners| faces.push(corners));
    ControlMesh::new(points, faces)
}

/// Two lenses, vertices 0 and `length`, joined by a straight path of so many edges, within circles of quads.
pub fn paired_lenses(length: u32, circles: u32) -> ControlMesh {
    let around = 2 * length;
    let id = move |x: u32, y: u32| match (x % around, y) {
        (x, 0) => x.min(around - x),
        (x, y) => length + 1 + (y - 1) * around + x,
    };
    let mut points = vec![Vec3::ZERO; (length + 1 + circles * around) as usize];
    let mut faces = FaceList::new();
    let step = std::f64::consts::TAU / f64::from(around);
    for (x, y) in (0..=circles).flat_map(|y| (0..around).map(move |x| (x, y))) {
        let (s, t) = (step * f64::from(x), step * f64::from(y));
        let p = [t.cosh() * s.cos(), t.sinh() * s.sin()];
        points[id(x, y) as usize] = Vec3::new(p[0], p[1], -0.1 * (p[0] * p[0] + p[1] * p[1]));
        if y < circles {
            faces.push(&[id(x, y), id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)]);
        }
    }
    ControlMesh::new(points, faces)
}

/// Another shape of the rule at vertices of valence 2.
pub fn with_lens(mut mesh: ControlMesh, beta: f64, gamma: f64) -> ControlMesh {
    mesh.scheme.lens = LensShape { beta, gamma };
    mesh
}

/// The edges of a lens net from the lens along its first neighbour, then along its second, `length` edges each.
pub fn lens_spokes(which: &[u32], length: i32) -> Vec<[u32; 2]> {
    let at = |spoke: u32, i: i32| if spoke == 0 { in_lens_net(i, 0) } else { in_lens_net(0, i) };
    which.iter().flat_map(|&spoke| (0..length).map(move |i| [at(spoke, i), at(spoke, i + 1)])).collect()
}

/// Lenses in every kind of neighbourhood.
pub fn lenses() -> Vec<(String, ControlMesh)> {
    let net = |layers| shaken(lens_net(layers), 0.1);
    let mut cages = vec![
        ("lens".to_owned(), net(3)),
        ("lens at a boundary".to_owned(), net(1)),
        ("lens at a boundary, edges".to_owned(), with_boundary(net(1), Boundary::EdgeOnly)),
        ("lens one face from a boundary".to_owned(), with_boundary(net(2), Boundary::None)),
        ("stacked lenses".to_owned(), stacked_lenses()),
        ("lens of a triangle and a pentagon".to_owned(), lens_of_polygons()),
        ("built-in lenses".to_owned(), shaken(shapes::lens(), 0.1)),
        ("lens, another shape".to_owned(), with_lens(net(2), 0.3, 0.2)),
        ("lens, bounded".to_owned(), with_lens(net(2), 0.5, 0.25)),
        ("hole beside a lens".to_owned(), with_holes(net(2), &[1])),
        ("sharp lens".to_owned(), sharp_at(net(2), &[0], 10.0)),
        ("semi-sharp lens".to_owned(), sharp_at(net(2), &[0], 1.6)),
        ("crease into a lens".to_owned(), creased(net(2), &lens_spokes(&[0], 2), 10.0)),
        (
            "crease into another lens".to_owned(),
            creased(with_lens(net(2), 0.3, 0.2), &lens_spokes(&[1], 2), 10.0),
        ),
        ("crease into a lens without a plane".to_owned(), {
            creased(with_lens(net(2), 0.8, 0.04), &lens_spokes(&[0], 2), 10.0)
        }),
        ("crease through a lens".to_owned(), creased(net(2), &lens_spokes(&[0, 1], 2), 10.0)),
    ];
    for length in [2, 3, 4] {
        cages.push((format!("paired lenses {length}"), shaken(paired_lenses(length, 2), 0.1)));
    }
    for s in [0.4, 1.7, 3.0] {
        let dart = creased(net(2), &lens_spokes(&[0], 2), s);
        let through = creased(creased(net(2), &lens_spokes(&[0], 1), s), &lens_spokes(&[1], 2), s + 0.8);
        cages.push((format!("Chaikin crease into a lens {s}"), chaikin(dart.clone())));
        cages.push((format!("Chaikin crease through a lens {s}"), chaikin(through.clone())));
        cages.push((format!("semi-sharp crease into a lens {s}"), dart));
        cages.push((format!("semi-sharp crease through a lens {s}"), through));
    }
    cages
}

/// A closed body of about a hundred quads with valences 3, 4 and 5.
pub fn body() -> ControlMesh {
    shaken(shapes::studded_torus(12, 8, 4), 0.2)
}

/// Every kind of neighbourhood there is, each in a cage as small as it can be.
pub fn all() -> Vec<(String, ControlMesh)> {
    let mut cages: Vec<(String, ControlMesh)> = Vec::new();
    let mut add = |name: &str, mesh: ControlMesh| cages.push((name.to_owned(), mesh));
    // Smooth.
    add("cube", cube());
    for n in [3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20] {
        add(&format!("disk {n}"), disk(n));
    }
    add("disk 50", shaken(shapes::disk(50, 1), 0.02));
    add("valence two", valence_two());
    add(
        "pillow",
        polygons(
            &[[0.0, 0.0, 0.3], [1.0, 0.1, 0.0], [1.2, 1.0, 0.2], [0.0, 1.0, 0.1]],
            &[&[0, 1, 2, 3], &[0, 3, 2, 1]],
        ),
    );
    lenses().into_iter().for_each(|(name, mesh)| add(&name, mesh));
    add("seven cells", {
        let cells: Vec<[i32; 3]> =
            (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).filter(|c| *c != [1, 1, 1]).collect();
        shaken(voxels(&cells), 0.3)
    });
    // Faces that are no quads.
    add("pyramid", pyramid());
    add("pentagon prism", prism(5));
    add("nine-gon prism", prism(9));
    add("octahedron", octahedron());
    add("open triangles", triangles());
    // Boundaries.
    for (name, rule) in
        [("corners", Boundary::EdgeAndCorner), ("edges", Boundary::EdgeOnly), ("none", Boundary::None)]
    {
        add(&format!("open grid, {name}"), with_boundary(grid(4, 3), rule));
        add(&format!("open triangles, {name}"), with_boundary(triangles(), rule));
    }
    add("one quad", grid(1, 1));
    add("one quad, edges", with_boundary(grid(1, 1), Boundary::EdgeOnly));
    add("L", l_shape());
    for k in [1, 3, 4, 5] {
        add(&format!("fan {k}"), fan(k));
        add(&format!("fan {k}, edges"), with_boundary(fan(k), Boundary::EdgeOnly));
    }
    add("sharp vertex on a boundary", sharp_at(l_shape(), &[2, 12], 10.0));
    // Semi-sharp creases.
    for s in [0.3, 1.0, 1.5, 2.7, 9.5] {
        let loops = creased(cube(), &TOP, s);
        add(&format!("crease loop {s}"), loops.clone());
        add(&format!("Chaikin loop {s}"), chaikin(loops));
    }
    let uneven = creased(creased(creased(cube(), &TOP[..1], 1.7), &TOP[1..2], 2.3), &TOP[2..3], 0.4);
    add("uneven crease", uneven.clone());
    add("uneven Chaikin crease", chaikin(uneven));
    let branches = creased(creased(disk(5), &spokes(&[0, 1], 2), 2.2), &spokes(&[3], 2), 0.7);
    add("semi-sharp branches", branches.clone());
    add("Chaikin branches", chaikin(branches));
    add("semi-sharp dart", creased(disk(5), &spokes(&[2], 2), 1.5));
    add("semi-sharp dart at a regular vertex", creased(disk(4), &spokes(&[2], 2), 2.5));
    add("semi-sharp n-gons", creased(prism(5), &[[5, 6], [6, 7], [0, 5]], 1.3));
    add("semi-sharp triangles", creased(octahedron(), &[[0, 2], [2, 4]], 2.4));
    add("semi-sharp edge at a boundary", creased(grid(3, 3), &[[1, 5], [5, 9], [4, 5]], 1.6));
    // Infinite creases.
    add("sharp loop", creased(cube(), &TOP, 10.0));
    add("sharp Chaikin loop", chaikin(creased(cube(), &TOP, 10.0)));
    add("sharp line through a grid", creased(grid(4, 4), &[[10, 11], [11, 12], [12, 13], [13, 14]], 10.0));
    add("sharp line beside a semi-sharp one", {
        creased(creased(grid(4, 4), &[[10, 11], [11, 12], [12, 13]], 10.0), &[[12, 17], [17, 22]], 1.4)
    });
    for (a, n) in [(1, 6), (2, 6), (3, 6), (4, 8)] {
        add(&format!("crease with {a} and {} faces", n - a), creased(disk(n), &spokes(&[0, a], 2), 10.0));
    }
    add("sectors of 1 to 4", creased(disk(10), &spokes(&[0, 1, 3, 6], 2), 10.0));
    add("three creases", creased(cube(), &[[4, 5], [4, 6], [4, 0]], 10.0));
    add("kinked crease", sharp_at(creased(grid(4, 4), &[[7, 12], [12, 13]], 10.0), &[12], 10.0));
    add("triangles with a sharp line", creased(octahedron(), &[[0, 2], [2, 1], [1, 3], [3, 0]], 10.0));
    // Darts and cones.
    add("dart", creased(disk(4), &spokes(&[1], 2), 10.0));
    for n in [3, 5, 7] {
        add(&format!("dart at valence {n}"), creased(disk(n), &spokes(&[1], 2), 10.0));
    }
    add("sharp edge with two ends", creased(cube(), &[[4, 5]], 10.0));
    for n in [3, 4, 5] {
        add(&format!("cone at valence {n}"), sharp_at(disk(n), &[0], 10.0));
    }
    add("semi-sharp vertex", sharp_at(disk(4), &[0], 1.5));
    add("semi-sharp extraordinary vertex", sharp_at(disk(6), &[0, 7], 2.6));
    add("tags on a cube", {
        let sharp = creased(cube(), &[[4, 5], [4, 6], [4, 0]], 10.0);
        sharp_at(sharp_at(sharp, &[7], 10.0), &[3], 1.5)
    });
    // A crease goes on among hidden faces, which decide how it fades at the last visible vertex.
    let right: Vec<u32> = (0..25).filter(|face| face % 5 > 1).collect();
    let hidden = with_holes(grid(5, 5), &right);
    let hidden = creased(creased(hidden, &[[14, 15]], 1.2), &[[15, 21], [15, 16]], 0.3);
    add("crease among holes", hidden.clone());
    add("Chaikin crease among holes", chaikin(hidden));
    // Meetings of curves.
    for (n, t) in [(4, 0.5), (4, 0.3), (6, 1.0 / 3.0), (8, 0.1), (10, 0.27)] {
        add(&format!("meeting of {} curves", n / 2), meeting(disk(n), 0, 1, t));
    }
    add("meetings beside each other", {
        let grid = meeting(meeting(grid(7, 5), 18, 19, 0.5), 20, 21, 0.4);
        creased(meeting(grid, 34, 42, 0.3), &[[29, 30], [30, 31]], 1.3)
    });
    add("meeting beside polygons", {
        let mut mesh = meeting(disk(6), 0, 1, 0.3);
        let faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
        mesh.faces = FaceList::new();
        for face in faces {
            if face.contains(&0) {
                mesh.faces.push(&face);
            } else {
                mesh.faces.push(&face[..3]);
                mesh.faces.push(&[face[0], face[2], face[3]]);
            }
        }
        mesh
    });
    // Holes.
    add("grid with holes", with_holes(grid(4, 4), &[0, 5, 6]));
    add("prism without lid", with_holes(prism(5), &[1]));
    cages
}

/// The address at `(x, y)` seen from corner `k` of a face: `x` runs along the edge to the next corner, over half of
/// it on a face that is no quad.
pub fn at_corner(level: &Level, table: &PatchTable, face: FaceId, k: u32, x: f64, y: f64) -> Location {
    if level.topology().face_size(face) != 4 {
        return table.locate(face, Some(k), x, y).unwrap();
    }
    let (u, v) = match k {
        0 => (x, y),
        1 => (1.0 - y, x),
        2 => (1.0 - x, 1.0 - y),
        _ => (y, 1.0 - x),
    };
    table.locate(face, None, u, v).unwrap()
}

/// Every visible face at a vertex, counter-clockwise, with the number of its corner there.
pub fn faces_at(level: &Level, v: VertexId) -> Vec<(FaceId, u32)> {
    let topology = level.topology();
    let ring = topology.ring(v).map(|h| (topology.face(h), h.0 - topology.first(topology.face(h)).0));
    ring.filter(|&(face, _)| level.is_visible(face)).collect()
}

/// Numbers of the parametric faces that are part of the surface.
pub fn visible(table: &PatchTable) -> Vec<usize> {
    (0..table.len()).filter(|&number| table.is_visible(number)).collect()
}

/// The address of parameters in a parametric face.
pub fn locate(table: &PatchTable, number: usize, u: f64, v: f64) -> Location {
    let face = table.parametric_face(number);
    table.locate(face.face, face.corner, u, v).unwrap()
}

/// The derivatives along the parameters that begin at a corner of a quad, from those along the face's own.
pub fn turned(jet: &SurfaceJet, corner: u32) -> SurfaceJet {
    let SurfaceJet { position, du, dv, duu, duv, dvv } = *jet;
    match corner {
        0 => *jet,
        1 => SurfaceJet { position, du: dv, dv: -du, duu: dvv, duv: -duv, dvv: duu },
        2 => SurfaceJet { position, du: -du, dv: -dv, duu, duv, dvv },
        _ => SurfaceJet { position, du: -dv, dv: du, duu: dvv, duv: -duv, dvv: duu },
    }
}

pub fn scheme() -> impl Strategy<Value = Scheme> {
    let boundary = prop_oneof![Just(Boundary::EdgeAndCorner), Just(Boundary::EdgeOnly), Just(Boundary::None)];
    let creasing = prop_oneof![Just(Creasing::Uniform), Just(Creasing::Chaikin)];
    let lens = prop_oneof![3 => Just([0.5, 0.125]), 1 => Just([0.3, 0.2]), 1 => Just([0.8, 0.04])];
    (boundary, creasing, lens).prop_map(|(boundary, creasing, [beta, gamma])| Scheme {
        boundary,
        creasing,
        lens: LensShape { beta, gamma },
    })
}

fn sharpness() -> impl Strategy<Value = f64> {
    prop_oneof![Just(10.0), Just(1.0), Just(0.5), Just(2.5), Just(9.9), Just(1e-300)]
}

/// Tags for some edges and vertices, chosen by chance.
pub type Tags = Vec<(prop::sample::Index, f64)>;

/// Makes some edges and vertices of a mesh sharp.
pub fn tag(mesh: &mut ControlMesh, creases: Tags, corners: Tags) {
    let edges: Vec<[u32; 2]> = mesh
        .faces
        .iter()
        .flat_map(|face| (0..face.len()).map(|k| [face[k], face[(k + 1) % face.len()]]).collect::<Vec<_>>())
        .collect();
    for (which, sharpness) in creases {
        let vertices = edges[which.index(edges.len())];
        mesh.creases.push(Crease { vertices, sharpness: Sharpness::from_value(sharpness) });
    }
    for (which, sharpness) in corners {
        let vertex = which.index(mesh.points.len()) as u32;
        mesh.corners.push(Corner { vertex, sharpness: Sharpness::from_value(sharpness) });
    }
}

/// A wheel: `n` triangles around a vertex, or a fan if it is left open.
pub fn wheel(n: u32, open: bool) -> ControlMesh {
    let mut list = FaceList::new();
    for k in 0..n - u32::from(open) {
        list.push(&[0, 1 + k, 1 + (k + 1) % n]);
    }
    ControlMesh::new(vec![Vec3::ZERO; n as usize + 1], list)
}

/// Sound connectivity with the given points, any tags, some faces taken away or hidden.
pub fn tagged(points: impl Strategy<Value = Vec<Vec3>>) -> impl Strategy<Value = ControlMesh> {
    let base = prop_oneof![
        Just(shapes::cube()),
        Just(shapes::grid(3, 3)),
        (3u32..9).prop_map(|n| shapes::disk(n, 1)),
        Just(shapes::disk(3, 2)),
        Just(shapes::torus(3, 3)),
        Just(valence_two()),
        Just(stacked_lenses()),
        Just(lens_of_polygons()),
        (1i32..4).prop_map(lens_net),
        (2u32..4).prop_map(|length| paired_lenses(length, 1)),
        Just(octahedron()),
        (3u32..7).prop_map(prism),
        (1u32..6).prop_map(fan),
        (3u32..9, any::<bool>()).prop_map(|(n, open)| wheel(n, open)),
    ];
    let tags = || vec((any::<prop::sample::Index>(), sharpness()), 0..7);
    let gone = vec(any::<prop::sample::Index>(), 0..3);
    (base, tags(), tags(), gone, scheme(), points, 0..3u8).prop_map(
        |(mut mesh, creases, corners, gone, scheme, moved, kind)| {
            mesh.scheme = scheme;
            let gone: Vec<usize> = gone.iter().map(|face| face.index(mesh.faces.len())).collect();
            match kind {
                0 => mesh.holes = gone.iter().map(|&hole| hole as u32).collect(),
                1 if gone.len() < mesh.faces.len() => {
                    let kept = mesh.faces.iter().enumerate().filter(|(f, _)| !gone.contains(f));
                    let mut faces = FaceList::new();
                    kept.for_each(|(_, face)| faces.push(face));
                    mesh.faces = faces;
                }
                _ => {}
            }
            tag(&mut mesh, creases, corners);
            for (point, moved) in mesh.points.iter_mut().zip(moved) {
                *point = moved;
            }
            mesh
        },
    )
}
