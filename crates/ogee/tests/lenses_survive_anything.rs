//! Cages with lenses and poles in every company: no panic, closed and smooth parts, and reports and errors that speak of the cage
//! that was given.

mod cages;
mod lens_cages;

use std::collections::BTreeSet;

use cages::noise;
use lens_cages::globe;
use ogee::convert::{self, ConvertError, Options, Packing, Part, to_part};
use ogee::lens::{self, LensError, Method, Obstacle, TreatedLens};
use ogee::mesh::{FaceVarying, FaceVaryingRule, Valence};
use ogee::pccm::PccmError;
use ogee::{
    Boundary, ControlMesh, Corner, Crease, FaceId, FaceList, Level, Sharpness, Topology, Vec3, VertexId,
    shapes,
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

    fn point(&mut self) -> Vec3 {
        Vec3::new((self.0)(), (self.0)(), (self.0)())
    }
}

/// A pillow: the square grid modulo `w -> -w` and the translations by `2 (width, 0)` and `2 (shift, height)`. Four lenses, and
/// all else regular. At both ends slits of `width` edges with `height` rows of quads between, turned by `shift`.
fn pillow(width: i32, height: i32, shift: i32) -> ControlMesh {
    let reduced = |i: i32, j: i32| {
        let turns = j.div_euclid(2 * height);
        ((i - 2 * shift * turns).rem_euclid(2 * width), j - 2 * height * turns)
    };
    let name = |i: i32, j: i32| reduced(i, j).min(reduced(-i, -j));
    let mut names = BTreeSet::new();
    let mut quads = Vec::new();
    for j in 0..height {
        for i in 0..2 * width {
            let quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| name(i, j));
            names.extend(quad);
            quads.push(quad);
        }
    }
    let names: Vec<(i32, i32)> = names.into_iter().collect();
    let number = |name: (i32, i32)| names.binary_search(&name).expect("a vertex") as u32;
    let points = names.iter().map(|&(i, j)| {
        // The slits lie along the tube, not across: as flat as the tube is at its ends.
        let turned = f64::from(i) - f64::from(shift) * f64::from(j) / f64::from(height);
        let angle = std::f64::consts::PI * turned / f64::from(width);
        let along = f64::from(j) / f64::from(height);
        let round = 1.0 - (2.0 * along - 1.0).powi(2);
        Vec3::new((0.7 + 0.6 * round) * angle.cos(), 0.7 * round * angle.sin(), 2.0 * along)
    });
    ControlMesh::new(points.collect(), quads.into_iter().map(|quad| quad.map(number)).collect())
}

/// A vertex in the middle of a quad, joined to two opposite corners.
fn split_by_a_doublet(mesh: &mut ControlMesh, face: usize, turn: usize) {
    let corners: Vec<u32> = mesh.faces.iter().nth(face).expect("a face").to_vec();
    if corners.len() != 4 {
        return;
    }
    let at = |k: usize| corners[(k + turn) % 4];
    let x = mesh.points.len() as u32;
    let middle = corners.iter().fold(Vec3::ZERO, |sum, &v| sum + 0.25 * mesh.points[v as usize]);
    mesh.points.push(middle);
    let mut faces = FaceList::new();
    for (number, list) in mesh.faces.iter().enumerate() {
        if number == face {
            faces.push(&[at(0), at(1), at(2), x]);
        } else {
            faces.push(list);
        }
    }
    faces.push(&[at(0), x, at(2), at(3)]);
    mesh.faces = faces;
}

fn without_faces(mesh: &mut ControlMesh, gone: &[usize]) {
    let mut faces = FaceList::new();
    mesh.faces.iter().enumerate().filter(|(f, _)| !gone.contains(f)).for_each(|(_, face)| faces.push(face));
    mesh.faces = faces;
}

/// Two quads become a hexagon, or one becomes two triangles.
fn with_another_polygon(mesh: &mut ControlMesh, face: usize) {
    let corners: Vec<u32> = mesh.faces.iter().nth(face).expect("a face").to_vec();
    if corners.len() != 4 {
        return;
    }
    let mut faces = FaceList::new();
    for (number, list) in mesh.faces.iter().enumerate() {
        if number == face {
            faces.push(&[corners[0], corners[1], corners[2]]);
        } else {
            faces.push(list);
        }
    }
    faces.push(&[corners[0], corners[2], corners[3]]);
    mesh.faces = faces;
}

/// Two or more curves meet at some vertex, where it has an even number of quads around it.
fn curves_meet(mesh: &mut ControlMesh, dice: &mut Dice) {
    let Ok(topology) = Topology::new(mesh) else { return };
    let v = VertexId(dice.below(mesh.points.len()) as u32);
    let is_even = matches!(topology.valence(v), Valence::Interior(n) if n >= 4 && n % 2 == 0);
    if is_even && topology.ring(v).all(|h| topology.face_size(topology.face(h)) == 4) {
        let port = topology.ring(v).next().map_or(0, |h| topology.target(h).0);
        *mesh = cages::meeting(mesh.clone(), v.0, port, 0.5);
    }
}

/// What was rolled.
struct Cage {
    mesh: ControlMesh,
    seams: Vec<[u32; 2]>,
    /// No boundary, no hidden faces.
    closed: bool,
    /// Points where no normal can be expected.
    degenerate: bool,
}

fn base(dice: &mut Dice) -> ControlMesh {
    match dice.below(7) {
        0 => globe(3 + dice.below(10) as u32, 1 + dice.below(6) as u32),
        1..=3 => {
            let width = 2 + dice.below(5) as i32;
            pillow(width, 2 + dice.below(7) as i32, dice.below(width as usize) as i32)
        }
        4 => shapes::torus(3 + dice.below(8) as u32, 3 + dice.below(5) as u32),
        5 => shapes::lens(),
        _ => cages::voxels(&[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1]][..1 + dice.below(4)]),
    }
}

fn roll(seed: u64) -> Cage {
    let dice = &mut Dice::new(seed);
    let mut mesh = base(dice);
    let mut degenerate = false;
    for _ in 0..[0, 0, 1, 2, 5][dice.below(5)] {
        let face = dice.below(mesh.faces.len());
        let turn = dice.below(2);
        split_by_a_doublet(&mut mesh, face, turn);
    }
    if dice.one_in(5) {
        let face = dice.below(mesh.faces.len());
        with_another_polygon(&mut mesh, face);
    }
    for p in &mut mesh.points {
        *p += 0.02 * dice.point();
    }
    let mut closed = true;
    if dice.one_in(4) {
        closed = false;
        let gone = [dice.below(mesh.faces.len()), dice.below(mesh.faces.len())];
        without_faces(&mut mesh, &gone[..1 + dice.below(2)]);
    }
    if dice.one_in(6) {
        closed = false;
        mesh.holes = vec![dice.below(mesh.faces.len()) as u32];
    }
    mesh.scheme.boundary = [Boundary::EdgeAndCorner, Boundary::EdgeOnly, Boundary::None][dice.below(3)];
    let edge = |mesh: &ControlMesh, dice: &mut Dice| {
        let face: Vec<u32> = mesh.faces.iter().nth(dice.below(mesh.faces.len())).expect("a face").to_vec();
        let k = dice.below(face.len());
        [face[k], face[(k + 1) % face.len()]]
    };
    if dice.one_in(3) {
        for _ in 0..1 + dice.below(3) {
            let sharpness = Sharpness::from_value([0.0, 0.3, 1.0, 2.5, 3.5, 10.0][dice.below(6)]);
            let vertices = edge(&mesh, dice);
            mesh.creases.push(Crease { vertices, sharpness });
        }
    }
    if dice.one_in(5) {
        let sharpness = Sharpness::from_value([0.0, 0.7, 2.0, 10.0][dice.below(4)]);
        mesh.corners.push(Corner { vertex: edge(&mesh, dice)[0], sharpness });
    }
    if dice.one_in(4) {
        let values = mesh.points.iter().map(|p| [p.x, p.y]).collect();
        let indices = mesh.faces.corners().to_vec();
        mesh.uv = Some(FaceVarying { values, indices, rule: FaceVaryingRule::default() });
    }
    let seams = if dice.one_in(3) { (0..3).map(|_| edge(&mesh, dice)).collect() } else { Vec::new() };
    if dice.one_in(8) {
        degenerate = true;
        let at = mesh.points[dice.below(mesh.points.len())];
        for _ in 0..1 + dice.below(8) {
            let which = dice.below(mesh.points.len());
            mesh.points[which] = at;
        }
    }
    if dice.one_in(12) {
        degenerate = true;
        mesh.points.iter_mut().for_each(|p| p.z = 0.0);
    }
    if dice.one_in(5) {
        curves_meet(&mut mesh, dice);
    }
    let scale = [1.0, 1.0, 1.0, 1e-9, 1e9, 1e-30, 1e30][dice.below(7)];
    mesh.points.iter_mut().for_each(|p| *p = scale * *p);
    Cage { mesh, seams, closed, degenerate }
}

fn name(seed: u64, options: &Options) -> String {
    let Options { method, packing, lens, .. } = options;
    format!("cage {seed}, {}, {}, {packing:?}", method.name(), lens.method.name())
}

fn check(seed: u64, cage: &Cage, options: &Options) -> Result<(), String> {
    let Ok(topology) = Topology::new(&cage.mesh) else { return Ok(()) };
    match to_part(&cage.mesh, options) {
        Ok(part) => check_part(cage, &topology, &part),
        Err(error) => check_error(cage, &topology, options, &error).map_err(|why| format!("{why}: {error}")),
    }
    .map_err(|why| format!("{}: {why}", name(seed, options)))
}

fn components(topology: &Topology) -> usize {
    let mut label = vec![usize::MAX; topology.face_count()];
    let mut count = 0;
    for start in 0..topology.face_count() {
        if label[start] != usize::MAX {
            continue;
        }
        let mut stack = vec![start];
        label[start] = count;
        while let Some(face) = stack.pop() {
            for h in topology.halfedges(FaceId(face as u32)) {
                let Some(other) = topology.twin(h).map(|twin| topology.face(twin).index()) else { continue };
                if label[other] == usize::MAX {
                    label[other] = count;
                    stack.push(other);
                }
            }
        }
        count += 1;
    }
    count
}

fn lens_vertices(topology: &Topology) -> Vec<VertexId> {
    let vertices = (0..topology.vertex_count() as u32).map(VertexId);
    vertices.filter(|&v| topology.valence(v) == Valence::Interior(2)).collect()
}

fn require(holds: bool, why: impl Fn() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(why()) }
}

fn check_part(cage: &Cage, topology: &Topology, part: &Part) -> Result<(), String> {
    let report = &part.report;
    let extent = cage.mesh.points.iter().flat_map(|p| [p.x.abs(), p.y.abs(), p.z.abs()]).fold(0.0, f64::max);
    require(report.max_gap <= 1e-12 * extent, || format!("gap {}", report.max_gap))?;
    if cage.closed {
        require(report.closed, || "not closed".into())?;
        require(report.shells == components(topology), || format!("{} shells", report.shells))?;
    }
    if !cage.degenerate {
        let angle = report.max_normal_angle_deg;
        require(angle <= 1e-6, || format!("angle {angle}"))?;
    }
    let mut seen = vec![false; cage.mesh.faces.len()];
    for face in part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces) {
        for address in face.quads.cells() {
            let at = address.face.index();
            require(at < seen.len(), || format!("no face {at}"))?;
            let size = topology.face_size(address.face);
            require(address.corner.is_none_or(|corner| corner < size), || format!("no corner {address:?}"))?;
            seen[at] = true;
        }
    }
    let level = Level::new(&cage.mesh).expect("a level");
    let lenses = lens_vertices(topology);
    for (f, seen) in seen.iter().enumerate() {
        let face = FaceId(f as u32);
        let at_lens = topology.halfedges(face).any(|h| lenses.contains(&topology.origin(h)));
        let visible = level.is_visible(face);
        require(*seen || at_lens || !visible, || format!("face {f} is not there"))?;
    }
    check_lenses(&level, topology, &report.lenses)?;
    for note in &report.notes {
        check_note(topology, note)?;
    }
    Ok(())
}

fn check_note(topology: &Topology, note: &ogee::mesh::Note) -> Result<(), String> {
    use ogee::mesh::Place;
    let holds = match note.place {
        Some(Place::Vertex(v)) => (v as usize) < topology.vertex_count(),
        Some(Place::Face(f)) => (f as usize) < topology.face_count(),
        _ => true,
    };
    require(holds, || format!("note {note:?}"))
}

fn check_lenses(level: &Level, topology: &Topology, treated: &[TreatedLens]) -> Result<(), String> {
    let found = lens::detect(level).map_err(|error| error.to_string())?;
    let mut expected: Vec<VertexId> = lens_vertices(topology);
    expected.extend(found.poles.iter().map(|pole| pole.vertex));
    expected.sort_unstable();
    let listed: Vec<VertexId> = treated.iter().map(|lens| lens.vertex).collect();
    require(listed == expected, || format!("listed {listed:?}, there are {expected:?}"))?;
    for lens in treated {
        let partner = lens.paired_with;
        require(partner.is_none_or(|partner| expected.contains(&partner)), || format!("{lens:?}"))?;
        require(lens.method != Method::Auto, || format!("{lens:?}"))?;
        numbers_exist(&lens.reason, topology)?;
    }
    Ok(())
}

/// Vertices and faces that a message names are there.
fn numbers_exist(message: &str, topology: &Topology) -> Result<(), String> {
    let words: Vec<&str> = message.split(|c: char| !c.is_alphanumeric()).collect();
    for pair in words.windows(2) {
        let Ok(number) = pair[1].parse::<usize>() else { continue };
        let count = match pair[0] {
            "vertex" | "edge" => topology.vertex_count(),
            "face" => topology.face_count(),
            _ => continue,
        };
        require(number < count, || format!("no {} {number} in {message:?}", pair[0]))?;
    }
    Ok(())
}

fn is_edge(topology: &Topology, a: VertexId, b: VertexId) -> bool {
    a.index() < topology.vertex_count()
        && b.index() < topology.vertex_count()
        && (topology.ring(a).any(|h| topology.target(h) == b)
            || topology.ring(b).any(|h| topology.target(h) == a))
}

fn check_error(
    cage: &Cage,
    topology: &Topology,
    options: &Options,
    error: &ConvertError,
) -> Result<(), String> {
    numbers_exist(&error.to_string(), topology)?;
    let level = Level::new(&cage.mesh).map_err(|_| "a defect that the cage does not have".to_owned());
    let is_lens = |v: VertexId| lens_vertices(topology).contains(&v);
    match error {
        ConvertError::Topology(_) => level.map_or(Ok(()), |_| Err("a defect of some other cage".into())),
        ConvertError::Lens(LensError::Blocked { vertex, obstacle, .. }) => {
            require(is_lens(*vertex), || "no lens".into())?;
            let exists = match *obstacle {
                Obstacle::SharpEdge { a, b, .. } => is_edge(topology, a, b),
                Obstacle::NotAQuad { face, .. }
                | Obstacle::HiddenFace { face, .. }
                | Obstacle::Meeting { face, .. } => face.index() < topology.face_count(),
                Obstacle::Cap { vertex, .. }
                | Obstacle::Boundary { vertex, .. }
                | Obstacle::OtherLens { vertex, .. }
                | Obstacle::Extraordinary { vertex, .. }
                | Obstacle::SharpVertex { vertex, .. } => vertex.index() < topology.vertex_count(),
                _ => true,
            };
            require(exists, || format!("{obstacle:?}"))?;
            let level = level?;
            let true_of_it = match *obstacle {
                Obstacle::SharpEdge { a, b, .. } => topology
                    .ring(a)
                    .chain(topology.ring(b))
                    .any(|h| [a, b].contains(&topology.target(h)) && level.edge_sharpness(h) > 0.0),
                Obstacle::NotAQuad { face, .. } => topology.face_size(face) != 4,
                Obstacle::HiddenFace { face, .. } => !level.is_visible(face),
                Obstacle::Boundary { vertex, .. } => matches!(topology.valence(vertex), Valence::Boundary(_)),
                Obstacle::OtherLens { vertex, .. } => is_lens(vertex),
                Obstacle::Extraordinary { vertex, valence, .. } => {
                    topology.valence(vertex) == Valence::Interior(valence)
                }
                Obstacle::SharpVertex { vertex, .. } => level.vertex_sharpness(vertex) > 0.0,
                _ => true,
            };
            require(true_of_it, || format!("not so: {obstacle:?}"))
        }
        ConvertError::Lens(LensError::NoPartner { vertex, .. }) => {
            require(is_lens(*vertex), || "no lens".into())
        }
        ConvertError::Pccm(PccmError::Lens { vertex }) => {
            require(is_lens(*vertex) && options.lens.method == Method::C1, || "no lens".into())
        }
        ConvertError::Pccm(PccmError::SharpEdge { a, b }) => {
            require(is_edge(topology, *a, *b), || "no edge".into())
        }
        _ => Ok(()),
    }
}

fn options(cage: &Cage, method: convert::Method, construction: Method, packing: Packing) -> Options {
    let lens = lens::Options { method: construction, rings: 2, ..lens::Options::default() };
    Options { method, packing, lens, seams: cage.seams.clone(), ..Options::default() }
}

/// The conversion that a cage gets, another one for each construction.
fn rolled_options(seed: u64, cage: &Cage) -> Vec<Options> {
    use convert::Method::{Bi5, Pccm, PccmFirst};
    let dice = &mut Dice::new(seed ^ 0x5555);
    let one = |construction| {
        let packing = [Packing::Packed, Packing::Unpacked][dice.below(2)];
        let method = [Pccm, Pccm, Pccm, PccmFirst, Bi5][dice.below(5)];
        options(cage, method, construction, packing)
    };
    Method::ALL.map(one).to_vec()
}

#[test]
fn any_cage_becomes_a_sound_part_or_is_refused_in_its_own_terms() {
    let mut failures = Vec::new();
    for seed in 0..30 {
        let cage = roll(seed);
        failures.extend(
            rolled_options(seed, &cage).iter().filter_map(|options| check(seed, &cage, options).err()),
        );
    }
    assert!(failures.is_empty(), "{} failures: {failures:#?}", failures.len());
}

/// The same cage with other numbers, seen in a mirror; and the new number of each vertex.
fn renumbered(cage: &Cage, dice: &mut Dice) -> (Cage, Vec<u32>) {
    let mesh = &cage.mesh;
    let shuffled = |count: usize, dice: &mut Dice| {
        let mut order: Vec<u32> = (0..count as u32).collect();
        (1..count).for_each(|k| order.swap(k, dice.below(k + 1)));
        order
    };
    let number = shuffled(mesh.points.len(), dice);
    let order = shuffled(mesh.faces.len(), dice);
    let mut points = mesh.points.clone();
    for (p, &new) in mesh.points.iter().zip(&number) {
        points[new as usize] = Vec3::new(-p.x, p.y, p.z);
    }
    let faces: Vec<&[u32]> = mesh.faces.iter().collect();
    let mut list = FaceList::new();
    for &f in &order {
        let turned: Vec<u32> = faces[f as usize].iter().rev().map(|&v| number[v as usize]).collect();
        list.push(&turned);
    }
    let both = |[a, b]: [u32; 2]| [number[a as usize], number[b as usize]];
    let place = |f: u32| order.iter().position(|&g| g == f).expect("a face") as u32;
    let other = ControlMesh {
        points,
        faces: list,
        creases: mesh.creases.iter().map(|tag| Crease { vertices: both(tag.vertices), ..*tag }).collect(),
        corners: mesh
            .corners
            .iter()
            .map(|tag| Corner { vertex: number[tag.vertex as usize], ..*tag })
            .collect(),
        holes: mesh.holes.iter().map(|&f| place(f)).collect(),
        uv: None,
        ..mesh.clone()
    };
    let seams = cage.seams.iter().map(|&seam| both(seam)).collect();
    (Cage { mesh: other, seams, ..*cage }, number)
}

#[test]
fn numbers_and_mirrors_change_nothing() {
    for seed in 200..230 {
        let mut cage = roll(seed);
        // Where curves meet has claims of its own.
        cage.mesh.meetings.clear();
        let (other, number) = renumbered(&cage, &mut Dice::new(seed ^ 0xaaaa));
        for construction in [Method::Auto, Method::C2] {
            let convert = |cage: &Cage| {
                to_part(&cage.mesh, &options(cage, convert::Method::Pccm, construction, Packing::Unpacked))
            };
            let name = format!("cage {seed}, {}", construction.name());
            match (convert(&cage), convert(&other)) {
                (Ok(one), Ok(two)) => {
                    let (one, two) = (one.report, two.report);
                    let done = |lenses: &[TreatedLens], number: &dyn Fn(u32) -> u32| -> BTreeSet<_> {
                        lenses.iter().map(|lens| (number(lens.vertex.0), lens.method.name())).collect()
                    };
                    let renumbered = done(&one.lenses, &|v| number[v as usize]);
                    assert_eq!(renumbered, done(&two.lenses, &|v| v), "{name}");
                    let counts = |report: &convert::Report| {
                        (report.faces_written, report.shells, report.level, report.lens_steps)
                    };
                    assert_eq!(counts(&one), counts(&two), "{name}");
                    assert!(
                        (one.area - two.area).abs() <= 1e-9 * one.area,
                        "{name}: {} {}",
                        one.area,
                        two.area
                    );
                }
                (Err(one), Err(two)) => assert_eq!(one.code(), two.code(), "{name}"),
                (one, two) => panic!("{name}: {:?} but {:?}", one.err(), two.err()),
            }
        }
    }
}

#[test]
fn caps_stay_whole_when_the_cage_is_refined_after_them() {
    // The pairs at the ends have circles; the doublet in the middle needs room first.
    let mut mesh = pillow(4, 12, 0);
    let face = mesh.faces.len() / 2;
    split_by_a_doublet(&mut mesh, face, 0);
    let cage = Cage { mesh, seams: Vec::new(), closed: true, degenerate: false };
    for packing in [Packing::Packed, Packing::Unpacked] {
        let options = options(&cage, convert::Method::Pccm, Method::Auto, packing);
        check(0, &cage, &options).expect("a sound part");
        let report = to_part(&cage.mesh, &options).expect("a part").report;
        let polar = report.lenses.iter().filter(|lens| lens.method == Method::Polar).count();
        assert_eq!((report.lens_steps, polar, report.lenses.len()), (2, 4, 5));
    }
}

#[test]
fn caps_that_overlap_wait_for_room() {
    // Two slits with three rows of quads between: either cap wants two of them.
    let cage = Cage { mesh: pillow(2, 3, 0), seams: Vec::new(), closed: true, degenerate: false };
    for construction in [Method::Auto, Method::Polar, Method::C2] {
        let options = options(&cage, convert::Method::Pccm, construction, Packing::Packed);
        check(0, &cage, &options).expect("a sound part");
        let report = to_part(&cage.mesh, &options).expect("a part").report;
        let expected = if construction == Method::C2 { Method::C2 } else { Method::Polar };
        assert!(report.lenses.iter().all(|lens| lens.method == expected), "{:?}", report.lenses);
        assert_eq!(report.lens_steps, 1);
    }
}

#[test]
fn a_crease_without_sharpness_is_no_crease_beside_caps_either() {
    let mut cage = Cage { mesh: pillow(4, 8, 0), seams: Vec::new(), closed: true, degenerate: false };
    let plain = options(&cage, convert::Method::Pccm, Method::Auto, Packing::Packed);
    let wanted = to_part(&cage.mesh, &plain).expect("a part").report;
    let edges = cage.mesh.faces.iter().map(|face| [face[0], face[1]]);
    let sharpness = Sharpness::Finite(0.0);
    cage.mesh.creases = edges.map(|vertices| Crease { vertices, sharpness }).collect();
    for construction in Method::ALL {
        let options = options(&cage, convert::Method::Pccm, construction, Packing::Packed);
        check(0, &cage, &options).expect("a sound part");
    }
    let report = to_part(&cage.mesh, &plain).expect("a part").report;
    assert_eq!((report.area, report.faces_written), (wanted.area, wanted.faces_written));
}

#[test]
fn what_refinement_brings_to_light_is_told_of_the_cage_that_was_given() {
    // The neighbours of the doublet have valence 5, and move away; the sharp edge at it does not.
    let mut mesh = shapes::torus(8, 6);
    split_by_a_doublet(&mut mesh, 17, 0);
    let lens = VertexId(mesh.points.len() as u32 - 1);
    let neighbour = mesh.faces.iter().nth(17).expect("a face")[0];
    mesh.creases = vec![Crease { vertices: [lens.0, neighbour], sharpness: Sharpness::Infinite }];
    let error = to_part(&mesh, &Options::default()).expect_err("no rule");
    let ConvertError::Lens(LensError::Blocked { vertex, obstacle, refinements }) = error else {
        panic!("{error}");
    };
    let Obstacle::SharpEdge { a, b, layer: 0 } = obstacle else { panic!("{obstacle}") };
    assert_eq!((vertex, refinements), (lens, 2));
    assert_eq!(BTreeSet::from([a, b]), BTreeSet::from([lens, VertexId(neighbour)]));
}

#[test]
fn poles_are_listed_whatever_was_asked_for() {
    let mesh = globe(8, 5);
    for construction in [Method::Merge, Method::C2] {
        let treated = lens::treat(&mesh, &lens::Options { method: construction, ..lens::Options::default() });
        let lenses = treated.expect("a cage").lenses;
        let reason = format!("{} is for lenses alone", construction.name());
        assert!(lenses.len() == 2 && lenses.iter().all(|pole| pole.reason == reason), "{lenses:?}");
    }
}
