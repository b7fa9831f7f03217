//! Curvature-continuous parts of cages of every kind: sound and in the terms of the cage that was given, or refused in its terms.

mod cages;
mod lens_cages;

use std::collections::{BTreeMap, BTreeSet};

use cages::noise;
use ogee::convert::{ConvertError, Method, Node, NodeKind, Options, Packing, Part, Report, UpAxis, to_part};
use ogee::mesh::{Note, Place};
use ogee::nurbs::{FaceAddress, NurbsSurface, Shell};
use ogee::{
    Boundary, ControlMesh, Corner, Crease, Creasing, FaceId, FaceList, Grid, Level, Sharpness, Topology,
    Vec3, VertexId, shapes,
};

/// Whole numbers, the same every time.
struct Dice(Box<dyn FnMut() -> f64>);

impl Dice {
    fn new(seed: u64) -> Dice {
        let mut next = noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        next();
        Dice(Box::new(next))
    }

    fn below(&mut self, count: usize) -> usize {
        (((self.0)() + 0.5) * count as f64) as usize
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    fn among<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    fn point(&mut self) -> Vec3 {
        Vec3::new((self.0)(), (self.0)(), (self.0)())
    }
}

/// Cells one after the other, each beside one of those before.
fn blob(cells: usize, dice: &mut Dice) -> ControlMesh {
    let mut filled = vec![[0, 0, 0]];
    while filled.len() < cells {
        let mut cell = dice.among(&filled);
        cell[dice.below(3)] += dice.among(&[-1, 1]);
        if !filled.contains(&cell) {
            filled.push(cell);
        }
    }
    cages::voxels(&filled)
}

fn base(dice: &mut Dice) -> ControlMesh {
    match dice.below(12) {
        0 => shapes::torus(3 + dice.below(5) as u32, 3 + dice.below(3) as u32),
        1 => cages::prism(3 + dice.below(6) as u32),
        2 => cages::octahedron(),
        3 => cages::pyramid(),
        4 => cages::triangles(),
        5 => shapes::disk(dice.among(&[3, 4, 5, 6, 8]), 2),
        6 => cages::fan(1 + dice.below(4) as u32),
        7 | 8 => shapes::grid(2 + dice.below(4) as u32, 2 + dice.below(4) as u32),
        _ => {
            let cells = 1 + dice.below(4);
            blob(cells, dice)
        }
    }
}

fn with_faces(mesh: &mut ControlMesh, faces: &[Vec<u32>]) {
    mesh.faces = FaceList::new();
    faces.iter().for_each(|face| mesh.faces.push(face));
}

/// A polygon cut along a diagonal.
fn cut(mesh: &mut ControlMesh, dice: &mut Dice) {
    let mut faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
    let which = dice.below(faces.len());
    let mut corners = faces[which].clone();
    if corners.len() > 3 {
        let (turn, length) = (dice.below(corners.len()), corners.len());
        corners.rotate_left(turn);
        let end = 2 + dice.below(length - 3);
        faces[which] = corners[..=end].to_vec();
        faces.push([&corners[end..], &corners[..1]].concat());
        with_faces(mesh, &faces);
    }
}

fn edge(mesh: &ControlMesh, dice: &mut Dice) -> [u32; 2] {
    let face = mesh.faces.face(dice.below(mesh.faces.len()));
    let k = dice.below(face.len());
    [face[k], face[(k + 1) % face.len()]]
}

/// A few edges one after the other.
fn path(mesh: &ControlMesh, length: usize, dice: &mut Dice) -> Vec<[u32; 2]> {
    let mut path = vec![edge(mesh, dice)];
    while path.len() < length {
        let [before, end] = path[path.len() - 1];
        let next = mesh.faces.iter().filter_map(|face| {
            let k = face.iter().position(|&v| v == end)?;
            Some(face[(k + 1) % face.len()]).filter(|&next| next != before)
        });
        let next: Vec<u32> = next.collect();
        if next.is_empty() {
            break;
        }
        path.push([end, dice.among(&next)]);
    }
    path
}

fn tagged(mesh: &mut ControlMesh, dice: &mut Dice) {
    mesh.scheme.boundary = dice.among(&[Boundary::EdgeAndCorner, Boundary::EdgeOnly, Boundary::None]);
    mesh.scheme.creasing = dice.among(&[Creasing::Uniform, Creasing::Chaikin]);
    for _ in 0..dice.among(&[0, 0, 1, 2]) {
        let length = 1 + dice.below(4);
        let sharpness = Sharpness::from_value(dice.among(&[10.0, 10.0, 10.0, 0.4, 1.0, 1.7, 2.5]));
        let along = path(mesh, length, dice);
        mesh.creases.extend(along.into_iter().map(|vertices| Crease { vertices, sharpness }));
    }
    if dice.one_in(4) {
        let sharpness = Sharpness::from_value(dice.among(&[10.0, 10.0, 0.7, 2.0]));
        mesh.corners.push(Corner { vertex: edge(mesh, dice)[0], sharpness });
    }
    if dice.one_in(4) {
        let holes = (0..1 + dice.below(2)).map(|_| dice.below(mesh.faces.len()) as u32);
        mesh.holes = holes.collect::<BTreeSet<_>>().into_iter().collect();
    }
}

/// Near the origin, of a size near 1, and no two edges at a vertex parallel.
fn roll(seed: u64) -> ControlMesh {
    let dice = &mut Dice::new(seed);
    let mut mesh = base(dice);
    for _ in 0..dice.among(&[0, 0, 1, 3]) {
        cut(&mut mesh, dice);
    }
    if dice.one_in(5) && mesh.faces.len() > 2 {
        let gone = dice.below(mesh.faces.len());
        let faces: Vec<Vec<u32>> = mesh.faces.iter().map(<[u32]>::to_vec).collect();
        with_faces(&mut mesh, &[&faces[..gone], &faces[gone + 1..]].concat());
    }
    mesh = tidy(mesh);
    mesh.points.iter_mut().for_each(|p| *p += 0.15 * dice.point());
    tagged(&mut mesh, dice);
    if dice.one_in(5) {
        curves_meet(&mut mesh, dice);
    }
    mesh
}

/// Without vertices that no face uses.
fn tidy(mut mesh: ControlMesh) -> ControlMesh {
    let used: BTreeSet<u32> = mesh.faces.corners().iter().copied().collect();
    let used: Vec<u32> = used.into_iter().collect();
    let own = |v: &u32| used.binary_search(v).expect("a corner") as u32;
    let faces: Vec<Vec<u32>> = mesh.faces.iter().map(|face| face.iter().map(own).collect()).collect();
    with_faces(&mut mesh, &faces);
    mesh.points = used.iter().map(|&v| mesh.points[v as usize]).collect();
    mesh
}

/// Two or more curves meet at some vertex that has an even number of quads around it.
fn curves_meet(mesh: &mut ControlMesh, dice: &mut Dice) {
    let Ok(topology) = Topology::new(mesh) else { return };
    let v = VertexId(dice.below(mesh.points.len()) as u32);
    let count = topology.ring(v).count();
    let is_even = !topology.is_boundary(v) && count >= 4 && count.is_multiple_of(2);
    if is_even && topology.ring(v).all(|h| topology.face_size(topology.face(h)) == 4) {
        let port = topology.ring(v).next().map_or(0, |h| topology.target(h).0);
        *mesh = cages::meeting(mesh.clone(), v.0, port, 0.5);
    }
}

fn g2(packing: Packing) -> Options {
    Options { method: Method::G2, packing, ..Options::default() }
}

fn require(holds: bool, why: impl Fn() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(why()) }
}

fn shells(part: &Part) -> impl Iterator<Item = &Shell> {
    part.bodies.iter().flat_map(|body| body.shells())
}

fn is_capped(report: &Report) -> bool {
    report.nodes.iter().all(|node| matches!(node.kind, NodeKind::Cap(_)))
}

/// Loops go round, and every edge has one face or two that run along it in opposite directions.
fn is_sewn(part: &Part) -> Result<(), String> {
    for shell in shells(part) {
        let mut uses: Vec<Vec<bool>> = vec![Vec::new(); shell.edges.len()];
        for face in &shell.faces {
            for (number, used) in face.boundary.iter().enumerate() {
                let next = face.boundary[(number + 1) % face.boundary.len()];
                let [edge, after] = [&shell.edges[used.edge as usize], &shell.edges[next.edge as usize]];
                let end = if used.forward { edge.end } else { edge.start };
                let start = if next.forward { after.start } else { after.end };
                require(end == start, || format!("a loop is broken at edge {}", used.edge))?;
                uses[used.edge as usize].push(used.forward);
            }
        }
        for (edge, uses) in uses.iter().enumerate() {
            let is_two = uses.len() == 2 && uses[0] != uses[1];
            let is_one = uses.len() == 1 && !part.report.closed;
            require(is_two || is_one, || format!("edge {edge} is used {uses:?}"))?;
        }
    }
    Ok(())
}

fn share(address: &FaceAddress, topology: &Topology) -> f64 {
    let corner = address.corner.map_or(1.0, |_| 1.0 / f64::from(topology.face_size(address.face)));
    corner * 0.25f64.powi(address.quarters.depth() as i32)
}

/// Every face of the surface is covered once, and no other.
fn is_covered(mesh: &ControlMesh, part: &Part) -> Result<(), String> {
    let level = Level::new(mesh).expect("a sound cage");
    let topology = level.topology();
    let mut covered = vec![0.0; topology.face_count()];
    let mut seen = BTreeSet::new();
    for address in shells(part).flat_map(|shell| &shell.faces).flat_map(|face| face.quads.cells()) {
        require(address.face.index() < covered.len(), || format!("no {address:?}"))?;
        require(seen.insert(*address), || format!("{address:?} twice"))?;
        covered[address.face.index()] += share(address, topology);
    }
    for (face, covered) in covered.into_iter().enumerate() {
        let wanted = f64::from(u8::from(level.is_visible(FaceId(face as u32))));
        require((covered - wanted).abs() < 1e-12, || format!("{covered} of face {face}"))?;
    }
    let faces: usize = part.report.faces_by_level.iter().map(|level| level.faces).sum();
    require(faces == part.report.patches && faces == seen.len(), || {
        format!("{faces} faces by level, {} patches, {} written", part.report.patches, seen.len())
    })
}

fn exists(topology: &Topology, place: Place) -> bool {
    let is_vertex = |v: u32| (v as usize) < topology.vertex_count();
    match place {
        Place::Vertex(v) => is_vertex(v),
        Place::Edge(a, b) => is_vertex(a) && is_vertex(b),
        Place::Face(face) => (face as usize) < topology.face_count(),
    }
}

/// A note on what has no cap names its place and no other vertex.
fn is_named(topology: &Topology, note: &Note) -> Result<(), String> {
    let Some(place) = note.place else { return Ok(()) };
    require(exists(topology, place), || format!("{note:?}"))?;
    if note.code != "no_cap" {
        return Ok(());
    }
    let words: Vec<&str> = note.message.split(|c: char| !c.is_alphanumeric()).collect();
    for pair in words.windows(2).filter(|pair| pair[0] == "vertex" || pair[0] == "face") {
        let named = format!("{} {}", pair[0], pair[1]);
        let is_other = pair[1].parse::<u32>().is_ok() && named != place.to_string();
        require(!is_other, || format!("{named} in {note:?}"))?;
    }
    Ok(())
}

fn is_sound(mesh: &ControlMesh, part: &Part) -> Result<(), String> {
    let report = &part.report;
    let topology = Topology::new(mesh).expect("a sound cage");
    let extent = mesh.points.iter().map(|p| p.length()).fold(0.0, f64::max);
    require(report.max_gap <= 1e-12 * extent, || format!("gap {:e}", report.max_gap))?;
    let angle = report.max_normal_angle_deg;
    require(angle <= 1e-8, || format!("angle {angle:e}"))?;
    if is_capped(report) {
        require(report.max_curvature_jump <= 1e-8, || format!("jump {:e}", report.max_curvature_jump))?;
    }
    let smoothed = report.nodes.iter().filter(|node| node.kind == NodeKind::Smoothed).count();
    let notes = report.notes.iter().filter(|note| note.code == "no_cap").count();
    require(notes == smoothed, || format!("{notes} notes, {smoothed} without caps"))?;
    for node in &report.nodes {
        require(exists(&topology, node.place), || format!("{node:?}"))?;
    }
    for note in &report.notes {
        is_named(&topology, note)?;
    }
    is_sewn(part)?;
    is_covered(mesh, part)?;
    let level = Level::new(mesh).expect("a sound cage");
    let all_seen = (0..topology.face_count() as u32).all(|face| level.is_visible(FaceId(face)));
    let is_closed = all_seen && topology.edge_halfedges().all(|h| topology.twin(h).is_some());
    require(report.closed == is_closed, || format!("closed: {}", report.closed))?;
    if is_closed {
        let cage = topology.vertex_count() + topology.face_count() - topology.edge_count();
        let own = report.vertices + report.faces_written - report.edges;
        require(own == cage, || format!("Euler's number {own}, the cage's is {cage}"))?;
    }
    Ok(())
}

/// A part if the cage has one.
fn converted(mesh: &ControlMesh, options: &Options) -> Result<Option<Part>, String> {
    match to_part(mesh, options) {
        Ok(part) => Ok(Some(part)),
        Err(ConvertError::NoSurface | ConvertError::Lens(_) | ConvertError::Topology(_)) => Ok(None),
        Err(error) => Err(format!("{}: {error}", error.code())),
    }
}

fn none_fails(seeds: std::ops::Range<u64>, check: impl Fn(u64) -> Result<(), String>) {
    let failures: Vec<String> =
        seeds.filter_map(|seed| check(seed).err().map(|why| format!("cage {seed}: {why}"))).collect();
    assert!(failures.is_empty(), "{} failures: {failures:#?}", failures.len());
}

fn treats_nothing(part: &Part) -> bool {
    part.report.lenses.is_empty()
}

#[test]
fn any_cage_becomes_a_sound_part() {
    none_fails(0..60, |seed| {
        let mesh = roll(seed);
        let Some(whole) = converted(&mesh, &g2(Packing::Unpacked))?.filter(treats_nothing) else {
            return Ok(());
        };
        is_sound(&mesh, &whole)?;
        let dice = &mut Dice::new(seed ^ 0x5555);
        let seams: Vec<[u32; 2]> = (0..3).map(|_| edge(&mesh, dice)).collect();
        let options = Options { seams, up: dice.among(&[UpAxis::Y, UpAxis::Z]), ..g2(Packing::Packed) };
        let Some(packed) = converted(&mesh, &options)? else { return Err("not packed".into()) };
        is_sound(&mesh, &packed).map_err(|why| format!("packed: {why}"))?;
        stay_edges(&mesh, &options.seams, &packed)?;
        let [one, other] = [&whole.report, &packed.report];
        require(other.faces_written <= one.faces_written, || "packed into more".into())?;
        require((one.area - other.area).abs() <= 1e-9 * one.area, || {
            format!("area {} and packed {}", one.area, other.area)
        })?;
        require(same_nodes(&one.nodes, &other.nodes), || "other nodes when packed".into())
    });
}

fn same_nodes(one: &[Node], other: &[Node]) -> bool {
    let named = |nodes: &[Node]| {
        let mut all: Vec<String> =
            nodes.iter().map(|node| format!("{} {:?} {}", node.place, node.kind, node.level)).collect();
        all.sort();
        all
    };
    named(one) == named(other)
}

/// No face of the part has pieces of two faces of the cage that share a seam.
fn stay_edges(mesh: &ControlMesh, seams: &[[u32; 2]], part: &Part) -> Result<(), String> {
    let has = |face: FaceId, [a, b]: [u32; 2]| {
        let face = mesh.faces.face(face.index());
        (0..face.len()).any(|k| {
            let ends = [face[k], face[(k + 1) % face.len()]];
            ends == [a, b] || ends == [b, a]
        })
    };
    for face in shells(part).flat_map(|shell| &shell.faces) {
        let quads = &face.quads;
        for (i, j) in (0..quads.rows()).flat_map(|i| (0..quads.cols()).map(move |j| (i, j))) {
            for next in [(i + 1, j), (i, j + 1)] {
                if next.0 == quads.rows() || next.1 == quads.cols() {
                    continue;
                }
                let (a, b) = (quads[(i, j)].face, quads[next].face);
                let crossed = seams.iter().find(|&&seam| a != b && has(a, seam) && has(b, seam));
                require(crossed.is_none(), || format!("seam {crossed:?} is inside a face"))?;
            }
        }
    }
    Ok(())
}

/// What is beyond the numbers and the place of a cage.
fn like(one: &Report, other: &Report, scale: f64, tolerance: f64) -> Result<(), String> {
    let counts = |report: &Report| {
        (report.faces_written, report.edges, report.vertices, report.shells, report.faces_by_level.clone())
    };
    require(counts(one) == counts(other), || format!("{:?} and {:?}", counts(one), counts(other)))?;
    let areas = [one.area * scale * scale, other.area];
    require((areas[0] - areas[1]).abs() <= tolerance * areas[0], || format!("areas {areas:?}"))?;
    let deviations = [one.max_deviation * scale, other.max_deviation];
    require((deviations[0] - deviations[1]).abs() <= 1e-5 * deviations[0] + tolerance * scale, || {
        format!("deviations {deviations:?}")
    })
}

#[test]
fn size_and_place_change_nothing() {
    none_fails(100..116, |seed| {
        let mesh = roll(seed);
        let Some(first) = converted(&mesh, &g2(Packing::Unpacked))?.filter(treats_nothing) else {
            return Ok(());
        };
        let shift = 1e3 * Dice::new(seed).point();
        for (scale, shift, tolerance) in
            [(1e-30, Vec3::ZERO, 1e-9), (1e30, Vec3::ZERO, 1e-9), (1.0, shift, 1e-9)]
        {
            let mut moved = mesh.clone();
            moved.points.iter_mut().for_each(|p| *p = scale * *p + shift);
            let name = |why: String| format!("times {scale:e} at {shift:?}: {why}");
            let Some(part) = converted(&moved, &g2(Packing::Unpacked))? else {
                return Err(name("none".into()));
            };
            like(&first.report, &part.report, scale, tolerance).map_err(name)?;
            require(same_nodes(&first.report.nodes, &part.report.nodes), || "nodes".into()).map_err(name)?;
            if shift == Vec3::ZERO {
                is_sound(&moved, &part).map_err(name)?;
            }
        }
        Ok(())
    });
}

/// The same cage in a mirror, with other numbers; what vertices and faces are called there.
fn renumbered(mesh: &ControlMesh, dice: &mut Dice) -> (ControlMesh, Vec<u32>, Vec<u32>) {
    let mut shuffled = |count: usize| {
        let mut order: Vec<u32> = (0..count as u32).collect();
        (1..count).for_each(|k| order.swap(k, dice.below(k + 1)));
        order
    };
    let (number, order) = (shuffled(mesh.points.len()), shuffled(mesh.faces.len()));
    let mut points = mesh.points.clone();
    for (p, &new) in mesh.points.iter().zip(&number) {
        points[new as usize] = Vec3::new(-p.x, p.y, p.z);
    }
    let mut place = vec![0; order.len()];
    (0..).zip(&order).for_each(|(new, &old)| place[old as usize] = new);
    let turned = |&old: &u32| {
        let mut face: Vec<u32> =
            mesh.faces.face(old as usize).iter().rev().map(|&v| number[v as usize]).collect();
        let turn = old as usize % face.len();
        face.rotate_left(turn);
        face
    };
    let crease =
        |crease: &Crease| Crease { vertices: crease.vertices.map(|v| number[v as usize]), ..*crease };
    let corner = |corner: &Corner| Corner { vertex: number[corner.vertex as usize], ..*corner };
    let mut other = ControlMesh {
        points,
        creases: mesh.creases.iter().map(crease).collect(),
        corners: mesh.corners.iter().map(corner).collect(),
        holes: mesh.holes.iter().map(|&hole| place[hole as usize]).collect(),
        ..mesh.clone()
    };
    with_faces(&mut other, &order.iter().map(turned).collect::<Vec<_>>());
    (other, number, place)
}

#[test]
fn numbers_and_mirrors_change_nothing() {
    none_fails(200..230, |seed| {
        let mut mesh = roll(seed);
        // Where curves meet has claims of its own.
        mesh.meetings.clear();
        let (other, number, place) = renumbered(&mesh, &mut Dice::new(seed ^ 0xaaaa));
        let options = Options { level: [None, Some(1)][seed as usize % 2], ..g2(Packing::Unpacked) };
        let (Some(one), Some(two)) = (converted(&mesh, &options)?, converted(&other, &options)?) else {
            return Ok(());
        };
        if !treats_nothing(&one) {
            return Ok(());
        }
        like(&one.report, &two.report, 1.0, 1e-9)?;
        let mut nodes = one.report.nodes.clone();
        for node in &mut nodes {
            node.place = match node.place {
                Place::Vertex(v) => Place::Vertex(number[v as usize]),
                Place::Face(face) => Place::Face(place[face as usize]),
                edge @ Place::Edge(..) => edge,
            };
        }
        require(same_nodes(&nodes, &two.report.nodes), || "other nodes".into())
    });
}

/// The refinement of a cage without tags, its hidden faces as holes.
fn refined(mesh: &ControlMesh) -> ControlMesh {
    let cage = Level::new(mesh).expect("a sound cage");
    let (level, points) = cage.refine_points(&mesh.points);
    let topology = level.topology();
    let faces = (0..topology.face_count() as u32).map(FaceId);
    let corners = |face: FaceId| topology.halfedges(face).map(|h| topology.origin(h).0).collect();
    let hidden = faces.clone().filter(|&face| !level.is_visible(face)).map(|face| face.0).collect();
    let mut fine = ControlMesh { points, holes: hidden, ..mesh.clone() };
    with_faces(&mut fine, &faces.map(corners).collect::<Vec<_>>());
    fine
}

fn cap_surfaces(part: &Part) -> Vec<&NurbsSurface> {
    let faces = shells(part).flat_map(|shell| &shell.faces);
    faces.map(|face| &face.surface).filter(|surface| surface.u.degree() == 7).collect()
}

fn distance(one: &Grid<Vec3>, other: &Grid<Vec3>) -> f64 {
    one.cells().iter().zip(other.cells()).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// Refinement of a neighbourhood is that of the whole: also where some of the faces around a cap are hidden.
#[test]
fn caps_are_those_of_the_whole_level() {
    let mut cages: Vec<(String, ControlMesh)> = Vec::new();
    for boundary in [Boundary::EdgeAndCorner, Boundary::EdgeOnly, Boundary::None] {
        let mut disk = cages::disk(5);
        disk.scheme.boundary = boundary;
        cages.push((format!("disk {boundary:?}"), disk.clone()));
        disk.holes = vec![0, 4, 9];
        cages.push((format!("disk with holes {boundary:?}"), disk));
    }
    let mut blob = cages::shaken(cages::voxels(&[[0, 0, 0], [1, 0, 0], [1, 1, 0]]), 0.3);
    cages.push(("blob".to_owned(), blob.clone()));
    blob.holes = vec![2, 7];
    cages.push(("blob with holes".to_owned(), blob));
    for (name, mesh) in cages {
        for level in 1..4 {
            let at = |level: u32| Options { level: Some(level), ..g2(Packing::Unpacked) };
            let one = to_part(&mesh, &at(level)).unwrap();
            let other = to_part(&refined(&mesh), &at(level - 1)).unwrap();
            let (one, other) = (cap_surfaces(&one), cap_surfaces(&other));
            assert_eq!(one.len(), other.len(), "{name}, level {level}");
            for surface in one {
                let nearest =
                    other.iter().map(|other| distance(&surface.net, &other.net)).fold(f64::MAX, f64::min);
                assert!(nearest < 1e-11, "{name}, level {level}: {nearest:e}");
            }
        }
    }
}

/// Every cap is of the coarsest level that is near enough to the limit surface.
#[test]
fn no_cap_is_deeper_than_it_has_to_be() {
    for seed in 1..6 {
        let dice = &mut Dice::new(seed);
        // A dart among faces that come first, which is done at once, and many triangles that are not.
        let mut mesh = shapes::grid(9, 6);
        mesh.points.iter_mut().for_each(|p| *p += 0.4 * dice.point());
        mesh = cages::creased(mesh, &[[4, 14], [14, 24]], 10.0);
        let (whole, halved) = (mesh.faces.iter().take(36), mesh.faces.iter().skip(36));
        let halves = halved.flat_map(|f| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]]);
        let faces: Vec<Vec<u32>> = whole.map(<[u32]>::to_vec).chain(halves).collect();
        with_faces(&mut mesh, &faces);
        let at = |level: u32| -> BTreeMap<String, f64> {
            let part = to_part(&mesh, &Options { level: Some(level), ..g2(Packing::Unpacked) }).unwrap();
            part.report.nodes.iter().map(|node| (node.place.to_string(), node.deviation)).collect()
        };
        let levels: Vec<BTreeMap<String, f64>> = (0..4).map(at).collect();
        let wanted = levels[0].values().fold(0.0, |a, &b| f64::max(a, b)) / 3.0;
        let options = Options { max_deviation: Some(wanted), ..g2(Packing::Unpacked) };
        let report = to_part(&mesh, &options).unwrap().report;
        assert!(report.max_deviation < wanted);
        let least = to_part(&mesh, &g2(Packing::Unpacked)).unwrap().report;
        for node in &report.nodes {
            let place = node.place.to_string();
            let own = least.nodes.iter().find(|other| other.place == node.place).map_or(0, |n| n.level);
            assert!(node.level >= own);
            if node.level > own {
                let before = levels[node.level as usize - 1][&place];
                assert!(before >= wanted, "cage {seed}, {place} at level {}: {before:e}", node.level);
            }
        }
    }
}
