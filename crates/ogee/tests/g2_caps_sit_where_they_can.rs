//! Sites of G2 caps: every irregular sector has one, or something is in its way; and caps continue the limit surface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cages;

use ogee::g2_caps::{CapClass, CornerAngle, Obstacle, Site, cap_points, knots, nets, site, weights};
use ogee::nurbs::NurbsSurface;
use ogee::{ControlMesh, FaceList, HalfedgeId, Level, Vec3, VertexId, limit_vertices};

/// Refinements of a cage, the cage first.
fn levels(mesh: &ControlMesh, count: usize) -> Vec<(Level, Vec<Vec3>)> {
    let mut levels = vec![(Level::new(mesh).unwrap(), mesh.points.clone())];
    for _ in 0..count {
        let (level, points) = levels.last().unwrap();
        levels.push(level.refine_points(points));
    }
    levels
}

/// What every sector of every vertex has.
fn sites(level: &Level, points: &[Vec3]) -> Vec<(VertexId, Result<Option<Site>, Obstacle>)> {
    let vertices = (0..level.topology().vertex_count() as u32).map(VertexId);
    let of = |v: VertexId| level.sectors(v).into_iter().map(move |s| (v, site(level, points, v, s)));
    vertices.flat_map(of).collect()
}

fn caps(level: &Level, points: &[Vec3]) -> Vec<Site> {
    sites(level, points).into_iter().filter_map(|(_, found)| found.ok().flatten()).collect()
}

/// True if finite sharpness, curves that meet or vertices of valence 2 make it take more steps, or for ever.
fn is_unsettled(found: &Result<Option<Site>, Obstacle>) -> bool {
    matches!(found, Err(Obstacle::SemiSharp { .. } | Obstacle::Meeting { .. }))
}

#[test]
fn two_refinements_are_enough() {
    let mut count = 0;
    for (name, mesh) in cages::all() {
        let levels = levels(&mesh, 2);
        for (v, found) in sites(&levels[2].0, &levels[2].1) {
            match found {
                Ok(None) => {}
                Ok(Some(found)) => {
                    assert!(weights(found.class).is_some() || found.class.sectors() > 6, "{name}: {found:?}");
                    count += 1;
                }
                Err(ref obstacle) if is_unsettled(&found) => assert!(obstacle.code().len() > 3),
                Err(obstacle) => {
                    assert!(!obstacle.is_cured_by_refinement(), "{name}, vertex {v}: {obstacle}")
                }
            }
        }
    }
    assert!(count > 400, "{count}");
}

/// The shipped cages, without their tags.
fn models() -> Vec<(String, ControlMesh)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut models = Vec::new();
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.extension().is_none_or(|extension| extension != "obj") {
            continue;
        }
        let (mut points, mut faces) = (Vec::new(), FaceList::new());
        for line in std::fs::read_to_string(&path).unwrap().lines() {
            let mut words = line.split_whitespace();
            match words.next() {
                Some("v") => {
                    let [x, y, z] = std::array::from_fn(|_| words.next().unwrap().parse().unwrap());
                    points.push(Vec3::new(x, y, z));
                }
                Some("f") => {
                    let corner = |word: &str| word.split('/').next().unwrap().parse::<u32>().unwrap() - 1;
                    faces.push(&words.map(corner).collect::<Vec<_>>());
                }
                _ => {}
            }
        }
        models.push((
            path.file_stem().unwrap().to_string_lossy().into_owned(),
            ControlMesh::new(points, faces),
        ));
    }
    models.sort_by(|a, b| a.0.cmp(&b.0));
    models
}

#[test]
fn shipped_cages_have_caps_wherever_they_are_irregular() {
    let mut count = 0;
    for (name, mesh) in models() {
        let (level, points) = levels(&mesh, 2).pop().unwrap();
        for (v, found) in sites(&level, &points) {
            match found {
                Ok(found) => count += usize::from(found.is_some()),
                Err(Obstacle::ValenceTwo { .. } | Obstacle::ParallelEdges { .. }) => {}
                Err(obstacle) => panic!("{name}, vertex {v}: {obstacle}"),
            }
        }
    }
    assert!(count > 400, "{count}");
}

#[test]
fn caps_come_from_whatever_can_be_seen_to_alone() {
    let found = |mesh: &ControlMesh, refinements: usize| {
        let (level, points) = levels(mesh, refinements).pop().unwrap();
        sites(&level, &points).into_iter().map(|(_, found)| found).collect::<Vec<_>>()
    };
    let classes = |mesh: &ControlMesh, refinements: usize| {
        let sites = found(mesh, refinements).into_iter().filter_map(|found| found.ok().flatten());
        let mut classes: Vec<CapClass> = sites.map(|site| site.class).collect();
        classes.sort_unstable();
        classes
    };
    let codes = |mesh: &ControlMesh, refinements: usize| {
        let obstacles = found(mesh, refinements).into_iter().filter_map(Result::err);
        let mut codes: Vec<&str> = obstacles.map(|obstacle| obstacle.code()).collect();
        codes.sort_unstable();
        codes.dedup();
        codes
    };
    let interior = |valence: u32| CapClass::Interior { valence };

    // A disk of two rings has a cap at once; the vertices of a cube share their faces.
    assert_eq!(classes(&cages::disk(5), 0), [interior(5)]);
    assert_eq!((codes(&cages::cube(), 0), classes(&cages::cube(), 0).len()), (vec!["not_separated"], 0));
    assert_eq!(classes(&cages::cube(), 1), [interior(3); 8]);
    // Polygons next to a fan are in its way for two steps.
    assert!(codes(&cages::prism(5), 0).contains(&"not_quad"));
    assert_eq!((codes(&cages::prism(5), 1), codes(&cages::prism(5), 2)), (vec!["not_separated"], vec![]));
    assert_eq!(classes(&cages::prism(5), 2).len(), 12);
    // Boundaries and corners.
    let concave = CapClass::Corner { faces: 3, angle: CornerAngle::Concave };
    assert_eq!(classes(&cages::l_shape(), 0), [CapClass::Boundary { faces: 3 }]);
    assert_eq!(classes(&cages::sharp_at(cages::l_shape(), &[12], 10.0), 0), [concave]);
    assert_eq!(codes(&cages::with_boundary(cages::grid(4, 3), ogee::Boundary::EdgeOnly), 0), ["one_face"]);
    let straight = cages::sharp_at(ogee::shapes::grid(4, 4), &[2], 10.0);
    assert_eq!(codes(&straight, 1), ["parallel_edges"]);
    // Creases, their ends, cones.
    let both = cages::creased(cages::disk(8), &cages::spokes(&[0, 3], 2), 10.0);
    assert_eq!(classes(&both, 0), [CapClass::Boundary { faces: 3 }, CapClass::Boundary { faces: 5 }]);
    let dart = cages::creased(cages::disk(4), &cages::spokes(&[1], 2), 10.0);
    assert_eq!(classes(&dart, 0), [CapClass::Dart { valence: 4 }]);
    let (level, points) = levels(&dart, 0).pop().unwrap();
    let first = caps(&level, &points)[0].halfedges[0];
    assert!(level.is_sharp(first), "the first halfedge of a dart runs along the crease");
    assert_eq!(codes(&cages::sharp_at(cages::disk(5), &[0], 10.0), 0), ["cone"]);
    // Sharpness fades; valence 2 and very many faces do not.
    let fading = cages::sharp_at(cages::disk(6), &[0], 1.5);
    assert_eq!((codes(&fading, 0), codes(&fading, 2)), (vec!["semi_sharp"], vec![]));
    assert_eq!(classes(&fading, 2), [interior(6)]);
    assert!(codes(&cages::lens_net(3), 0).contains(&"valence_two"));
    assert_eq!(codes(&ogee::shapes::disk(50, 2), 1), ["too_many_faces"]);
    // Curves that meet.
    assert_eq!(codes(&cages::meeting(cages::disk(6), 0, 1, 0.3), 1), ["meeting"]);
    // What is not seen needs no cap.
    let hidden: Vec<u32> = (0..20).collect();
    assert!(classes(&cages::with_holes(cages::disk(5), &hidden), 0).is_empty());
}

/// The limit of the middle of an edge: of its vertex on the next level.
struct Middles {
    limit: Vec<Vec3>,
    first: usize,
}

impl Middles {
    fn new(level: &Level, points: &[Vec3]) -> Middles {
        let (finer, finer_points) = level.refine_points(points);
        let limit = limit_vertices(&finer, &finer_points).iter().map(|limit| limit.position).collect();
        Middles { limit, first: level.topology().vertex_count() + level.topology().face_count() }
    }

    fn at(&self, level: &Level, h: HalfedgeId) -> Vec3 {
        self.limit[self.first + level.topology().edge(h).index()]
    }
}

#[test]
fn caps_end_where_the_limit_surface_goes_on() {
    let mut compared = 0;
    for (name, mesh) in cages::all() {
        for (number, (level, points)) in levels(&mesh, 2).iter().enumerate() {
            let topology = level.topology();
            let (limit, middles) = (limit_vertices(level, points), Middles::new(level, points));
            for found in caps(level, points) {
                let Some(weights) = weights(found.class) else { continue };
                let nets = nets(&weights, &cap_points(level, points, &found));
                let mut see = |sector: usize, (u, v): (f64, f64), expected: Vec3| {
                    let surface = NurbsSurface { u: knots(), v: knots(), net: nets[sector].clone() };
                    let far = surface.jet(u, v).position.distance(expected);
                    assert!(
                        far <= 1e-12 * mesh.size(),
                        "{name}, level {number}, {found:?}: {far:e} at {u}, {v}"
                    );
                    compared += 1;
                };
                for (sector, &h) in found.halfedges.iter().enumerate() {
                    let [side, other] = [topology.next(h), topology.next(topology.next(h))];
                    let at = |h: HalfedgeId| limit[topology.origin(h).index()].position;
                    see(sector, (1.0, 0.0), at(side));
                    see(sector, (1.0, 1.0), at(other));
                    see(sector, (0.0, 1.0), at(topology.prev(h)));
                    see(sector, (1.0, 0.5), middles.at(level, side));
                    see(sector, (0.5, 1.0), middles.at(level, other));
                    let boundary = matches!(found.class, CapClass::Boundary { .. } | CapClass::Corner { .. });
                    if boundary && sector == 0 {
                        see(sector, (0.5, 0.0), middles.at(level, h));
                    }
                    if boundary && sector + 1 == found.halfedges.len() {
                        see(sector, (0.0, 0.5), middles.at(level, topology.prev(h)));
                    }
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

/// Vertices and faces in another order, faces from another corner.
fn renumbered(mesh: &ControlMesh) -> ControlMesh {
    let last = mesh.points.len() as u32 - 1;
    let mut other = mesh.clone();
    other.points.reverse();
    other.faces = FaceList::new();
    for (number, face) in mesh.faces.iter().enumerate().collect::<Vec<_>>().into_iter().rev() {
        let mut face: Vec<u32> = face.iter().map(|v| last - v).collect();
        let corners = face.len();
        face.rotate_left(number % corners);
        other.faces.push(&face);
    }
    let faces = mesh.faces.len() as u32;
    other.holes = mesh.holes.iter().map(|face| faces - 1 - face).collect();
    other.creases.iter_mut().for_each(|crease| crease.vertices = crease.vertices.map(|v| last - v));
    other.corners.iter_mut().for_each(|corner| corner.vertex = last - corner.vertex);
    for meeting in &mut other.meetings {
        meeting.vertex = last - meeting.vertex;
        meeting.ports.iter_mut().for_each(|port| *port = last - *port);
    }
    other
}

#[test]
fn numbers_do_not_matter() {
    for (name, mesh) in cages::all() {
        let told = |mesh: &ControlMesh, of: &dyn Fn(u32) -> u32| {
            let mut all: Vec<(u32, String, Vec3)> = Vec::new();
            let (level, points) = levels(mesh, 1).pop().unwrap();
            // Vertices of the cage keep their numbers.
            for (v, found) in
                sites(&level, &points).into_iter().filter(|(v, _)| v.index() < mesh.points.len())
            {
                let (what, position) = match found {
                    Ok(None) => ("regular".to_owned(), Vec3::ZERO),
                    Ok(Some(found)) => {
                        let cap = weights(found.class);
                        let net =
                            cap.map(|cap| nets(&cap, &cap_points(&level, &points, &found)).swap_remove(0));
                        (format!("{:?}", found.class), net.map_or(Vec3::ZERO, |net| net[(0, 0)]))
                    }
                    Err(obstacle) => (obstacle.code().to_owned(), Vec3::ZERO),
                };
                all.push((of(v.0), what, position));
            }
            all.sort_by(|a, b| (a.0, &a.1).cmp(&(b.0, &b.1)).then(a.2.x.total_cmp(&b.2.x)));
            all
        };
        let last = mesh.points.len() as u32 - 1;
        let (ours, theirs) = (told(&mesh, &|v| v), told(&renumbered(&mesh), &|v| last - v));
        assert_eq!(ours.len(), theirs.len(), "{name}");
        for (a, b) in ours.iter().zip(&theirs) {
            assert_eq!((a.0, &a.1), (b.0, &b.1), "{name}");
            assert!(a.2.distance(b.2) <= 1e-13 * mesh.size(), "{name}, vertex {}", a.0);
        }
    }
}
