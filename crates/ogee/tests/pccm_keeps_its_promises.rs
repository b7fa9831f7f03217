//! The exact properties of PCCM patches (`docs/methods/pccm.md`, Practice), on cages of many valences, with
//! coordinates shaken at random.

mod cages;

use cages::{shaken, voxels};
use ogee::convert::{Method, Options, Packing, to_part};
use ogee::nurbs::{KnotVector, NurbsSurface};
use ogee::pccm::{self, CornerClass, Layer, Patches, to_patches};
use ogee::{
    ControlMesh, Corner, Crease, FaceId, HalfedgeId, Level, Sharpness, Vec3, VertexId, limit_vertices, shapes,
};

/// Two fans of `n` quads, zigzag between them: two vertices of valence `n`, the rest 3.
fn trapezohedron(n: u32) -> ControlMesh {
    let turn = |i: f64| std::f64::consts::TAU * i / f64::from(n);
    let mut points = vec![Vec3::new(0.0, 0.0, 1.2), Vec3::new(0.0, 0.0, -1.2)];
    for i in 0..n {
        let (a, b) = (turn(f64::from(i)), turn(f64::from(i) + 0.5));
        points.push(Vec3::new(a.cos(), a.sin(), 0.3));
        points.push(Vec3::new(b.cos(), b.sin(), -0.3));
    }
    let at = |k: u32| 2 + k % (2 * n);
    let upper = (0..n).map(|i| [0, at(2 * i), at(2 * i + 1), at(2 * i + 2)]);
    let lower = (0..n).map(|i| [1, at(2 * i + 3), at(2 * i + 2), at(2 * i + 1)]);
    ControlMesh::new(points, upper.chain(lower).collect())
}

fn crease(mut mesh: ControlMesh, edges: &[[u32; 2]]) -> ControlMesh {
    mesh.creases =
        edges.iter().map(|&vertices| Crease { vertices, sharpness: Sharpness::Infinite }).collect();
    mesh
}

fn all_cages() -> Vec<(String, ControlMesh)> {
    let mut cages: Vec<(String, ControlMesh)> = Vec::new();
    for n in [3, 5, 6, 7, 8, 10, 12] {
        cages.push((format!("trapezohedron {n}"), shaken(trapezohedron(n), 0.15)));
        cages.push((format!("disk {n}"), shaken(shapes::disk(n, 2), 0.15)));
    }
    let ring: Vec<[i32; 3]> =
        (0..3).flat_map(|i| (0..3).map(move |j| [i, j, 0])).filter(|c| *c != [1, 1, 0]).collect();
    cages.push(("genus 1".into(), shaken(voxels(&ring), 0.15)));
    let mut two_holes = ring.clone();
    two_holes.extend(ring.iter().map(|c| [c[0] + 2, c[1], 0]).filter(|c| c[0] > 2));
    cages.push(("genus 2".into(), shaken(voxels(&two_holes), 0.15)));
    let corner: Vec<[i32; 3]> =
        (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).filter(|c| *c != [1, 1, 1]).collect();
    cages.push(("seven cells".into(), shaken(voxels(&corner), 0.15)));
    cages.push(("torus".into(), shaken(shapes::torus(6, 5), 0.15)));
    cages.push(("grid".into(), shaken(shapes::grid(5, 4), 0.15)));
    // A crease through a regular vertex, one that ends (a dart), three that meet, a tagged corner on a crease.
    let grid = || shaken(shapes::grid(4, 4), 0.2);
    cages.push(("crease".into(), crease(grid(), &[[10, 11], [11, 12], [12, 13], [13, 14]])));
    cages.push(("dart".into(), crease(grid(), &[[12, 13], [13, 14]])));
    cages.push(("three creases".into(), crease(grid(), &[[12, 11], [12, 17], [12, 7]])));
    let mut kink = crease(grid(), &[[10, 11], [11, 12], [12, 17], [17, 22]]);
    kink.corners = vec![Corner { vertex: 12, sharpness: Sharpness::Infinite }];
    cages.push(("kinked crease".into(), kink));
    cages.push(("dart at valence 5".into(), crease(shaken(shapes::disk(5, 2), 0.15), &[[0, 1]])));
    cages.push((
        "crease through valence 6".into(),
        crease(shaken(shapes::disk(6, 2), 0.1), &[[0, 1], [0, 19]]),
    ));
    cages.push(("box top".into(), crease(shaken(shapes::cube(), 0.2), &[[4, 5], [5, 7], [7, 6], [6, 4]])));
    cages
}

fn variants() -> impl Iterator<Item = pccm::Options> {
    [Layer::First, Layer::Second].into_iter().flat_map(|layer| {
        [2, 3].into_iter().map(move |level| pccm::Options { layer, level, ..pccm::Options::default() })
    })
}

fn surfaces(patches: &Patches) -> Vec<NurbsSurface> {
    let knots: &KnotVector = &patches.knots;
    patches
        .nets
        .iter()
        .map(|net| NurbsSurface { u: knots.clone(), v: knots.clone(), net: net.clone() })
        .collect()
}

/// What corner `k` of a quad of side `m` sees at `(a, b)`, in the quad's own parameters.
fn seen(k: usize, a: f64, b: f64, m: f64) -> (f64, f64) {
    [(a, b), (m - b, a), (m - a, m - b), (b, m - a)][k]
}

#[test]
fn pccm_is_tangent_continuous() {
    for (name, mesh) in all_cages() {
        for method in [Method::Pccm, Method::PccmFirst] {
            for level in [2, 3] {
                let options =
                    Options { method, level: Some(level), packing: Packing::Unpacked, ..Options::default() };
                let report = to_part(&mesh, &options).unwrap().report;
                assert!(report.max_gap <= 1e-13, "{name} {method:?} level {level}: gap {:e}", report.max_gap);
                let angle = report.max_normal_angle_deg.to_radians();
                assert!(angle <= 1e-10, "{name} {method:?} level {level}: angle {angle:e}");
            }
        }
    }
}

#[test]
fn outside_the_zone_of_extraordinary_vertices_all_is_c2() {
    for (name, mesh) in all_cages() {
        let level = Level::new(&mesh).unwrap();
        let topology = level.topology();
        for options in variants() {
            let patches = to_patches(&level, &mesh.points, &options).unwrap();
            let surfaces = surfaces(&patches);
            let m = f64::from(1u32 << options.level);
            let zone = if options.layer == Layer::First { 1.0 } else { 2.0 };
            for h in (0..topology.halfedge_count() as u32).map(HalfedgeId) {
                let Some(twin) = topology.twin(h).filter(|_| !level.is_sharp(h)) else { continue };
                let irregular = |h: HalfedgeId| {
                    [h, topology.next(h)]
                        .map(|h| patches.classes[h.index() / 4][h.index() % 4] != CornerClass::Regular)
                };
                let ends = irregular(h);
                let low = if ends[0] { zone } else { 0.0 };
                let high = if ends[1] { m - zone } else { m };
                for k in 0..=8 {
                    let t = low + (high - low) * f64::from(k) / 8.0;
                    let (u, v) = seen(h.index() % 4, t, 0.0, m);
                    let (x, y) = seen(twin.index() % 4, m - t, 0.0, m);
                    let (a, b) = (surfaces[h.index() / 4].jet(u, v), surfaces[twin.index() / 4].jet(x, y));
                    // Across the edge, inward on each side.
                    let across = |k: usize, jet: &ogee::nurbs::SurfaceJet| match k {
                        0 => (jet.dv, jet.dvv),
                        1 => (-jet.du, jet.duu),
                        2 => (-jet.dv, jet.dvv),
                        _ => (jet.du, jet.duu),
                    };
                    let ((first, second), (other_first, other_second)) =
                        (across(h.index() % 4, &a), across(twin.index() % 4, &b));
                    assert!((first + other_first).length() < 1e-10, "{name} {options:?} {h:?} {t}: C1");
                    assert!((second - other_second).length() < 1e-10, "{name} {options:?} {h:?} {t}: C2");
                }
            }
        }
    }
}

#[test]
fn outside_the_changed_cells_it_is_the_limit_surface() {
    for (name, mesh) in all_cages() {
        let level = Level::new(&mesh).unwrap();
        for options in variants() {
            let patches = to_patches(&level, &mesh.points, &options).unwrap();
            let surfaces = surfaces(&patches);
            let m = 1usize << options.level;
            let refinement = ogee::Refinement::uniform(&level, options.level).unwrap();
            let points = refinement.apply(&mesh.points);
            let limits = limit_vertices(refinement.finest(), &points);
            for quad in 0..patches.nets.len() {
                let grid = refinement.grid(FaceId(quad as u32), None);
                for i in 0..=m {
                    for j in 0..=m {
                        let near = (0..4).any(|k| {
                            let (a, b) = [(i, j), (j, m - i), (m - i, m - j), (m - j, i)][k];
                            let zone = a <= 1 && b <= 3 || a <= 3 && b <= 1;
                            zone && patches.classes[quad][k] != CornerClass::Regular
                        });
                        let corner = (i % m == 0) && (j % m == 0);
                        if near && !corner {
                            continue;
                        }
                        let limit = limits[grid[(i, j)].index()];
                        let jet = surfaces[quad].jet(i as f64, j as f64);
                        let class = corner.then(|| {
                            patches.classes[quad][match (i, j) {
                                (0, 0) => 0,
                                (_, 0) => 1,
                                (0, _) => 3,
                                _ => 2,
                            }]
                        });
                        // Position and normal of a dart are those of the smooth rule.
                        if class == Some(CornerClass::Dart) {
                            continue;
                        }
                        let gap = jet.position.distance(limit.position);
                        assert!(gap < 1e-12, "{name} {options:?} quad {quad} ({i}, {j}): {gap:e}");
                        let one_sided =
                            level.topology().halfedges(FaceId(quad as u32)).any(|h| level.is_sharp(h))
                                || matches!(
                                    class,
                                    Some(CornerClass::Crease | CornerClass::Corner | CornerClass::Cone)
                                );
                        if let (false, Some(n), Some(wanted)) = (one_sided, jet.normal(), limit.normal) {
                            assert!(
                                n.distance(wanted) < 1e-9,
                                "{name} {options:?} quad {quad} ({i}, {j}): normal"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn normals_at_boundary_vertices_of_three_faces_and_more_are_those_of_the_limit() {
    // Three quads at vertex 3 of an L: a re-entrant boundary corner.
    let points = [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [0, 2], [1, 2]];
    let height = |x: f64, y: f64| 0.3 * x * x - 0.2 * x * y + 0.1 * y;
    let points =
        points.map(|[x, y]| (f64::from(x), f64::from(y))).map(|(x, y)| Vec3::new(x, y, height(x, y)));
    let faces = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6]];
    let mesh = ControlMesh::new(points.to_vec(), faces.into_iter().collect());
    let level = Level::new(&mesh).unwrap();
    let patches = to_patches(&level, &mesh.points, &pccm::Options::default()).unwrap();
    let (fine, fine_points) = level.refine_points(&mesh.points);
    let wanted = limit_vertices(&fine, &fine_points)[4].normal.unwrap();
    let jet = surfaces(&patches)[0].jet(4.0, 4.0);
    assert!(jet.normal().unwrap().distance(wanted) < 1e-9);
    assert_eq!(patches.classes[0][2], CornerClass::Crease);
}

#[test]
fn boundary_curves_are_the_cubic_splines_of_their_polygons() {
    let mesh = shaken(shapes::disk(7, 2), 0.2);
    let level = Level::new(&mesh).unwrap();
    let topology = level.topology();
    let patches = to_patches(&level, &mesh.points, &pccm::Options::default()).unwrap();
    let surfaces = surfaces(&patches);
    let mut checked = 0;
    for h in (0..topology.halfedge_count() as u32).map(HalfedgeId).filter(|&h| topology.twin(h).is_none()) {
        let at = |v: VertexId| mesh.points[v.index()];
        let regular = |v: VertexId| topology.valence(v).is_regular();
        let (b, c) = (topology.origin(h), topology.target(h));
        if !regular(b) || !regular(c) {
            continue;
        }
        let before = topology.ring(b).last().map(|g| topology.origin(topology.prev(g))).unwrap();
        let after = topology.target(topology.outgoing(c).unwrap());
        for k in 0..=4 {
            let t = f64::from(k) / 4.0;
            let s = 1.0 - t;
            let wanted = (s * s * s * at(before)
                + (3.0 * t * t * t - 6.0 * t * t + 4.0) * at(b)
                + (3.0 * s * s * s - 6.0 * s * s + 4.0) * at(c)
                + t * t * t * at(after))
                / 6.0;
            let (u, v) = seen(h.index() % 4, 4.0 * t, 0.0, 4.0);
            assert!(surfaces[h.index() / 4].jet(u, v).position.distance(wanted) < 1e-12);
            checked += 1;
        }
    }
    assert!(checked > 30);
}

#[test]
fn patches_are_regular() {
    for (name, mesh) in all_cages().into_iter().filter(|(name, _)| name != "box top") {
        let level = Level::new(&mesh).unwrap();
        let patches = to_patches(&level, &mesh.points, &pccm::Options::default()).unwrap();
        for (quad, surface) in surfaces(&patches).iter().enumerate() {
            let areas: Vec<f64> = (0..=16)
                .flat_map(|i| (0..=16).map(move |j| (f64::from(i) / 4.0, f64::from(j) / 4.0)))
                .map(|(u, v)| {
                    let jet = surface.jet(u, v);
                    jet.du.cross(jet.dv).length()
                })
                .collect();
            let (least, most) = areas.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &x| (a.min(x), b.max(x)));
            assert!(least > 1e-3 * most, "{name} quad {quad}: {:e}", least / most);
        }
    }
}

#[test]
fn affine_maps_of_the_cage_map_the_patches() {
    let map = |p: Vec3| Vec3::new(2.0 * p.x - p.y + 3.0, 0.5 * p.y + p.z, p.z - 0.3 * p.x - 8.0);
    for (name, mesh) in all_cages() {
        // Corners and boundaries place tangents by angles and lengths: they follow similarities only.
        if !Level::new(&mesh)
            .unwrap()
            .topology()
            .edge_halfedges()
            .all(|h| !Level::new(&mesh).unwrap().is_sharp(h))
        {
            continue;
        }
        let mut mapped = mesh.clone();
        mapped.points = mesh.points.iter().map(|&p| map(p)).collect();
        let options = pccm::Options::default();
        let a = to_patches(&Level::new(&mesh).unwrap(), &mesh.points, &options).unwrap();
        let b = to_patches(&Level::new(&mapped).unwrap(), &mapped.points, &options).unwrap();
        for (p, q) in a.nets.iter().flat_map(|net| net.cells()).zip(b.nets.iter().flat_map(|net| net.cells()))
        {
            assert!(map(*p).distance(*q) < 1e-12, "{name}");
        }
    }
}

#[test]
fn deviation_falls_with_the_quadratic_eigenvalue() {
    // mu_n of the method's page: order log2(1 / mu_n) a level, up to a quarter.
    for (n, order) in [(5, 1.56), (6, 1.29), (8, 1.0)] {
        let mesh = trapezohedron(n);
        let at = |level| {
            let options = Options { level: Some(level), packing: Packing::Unpacked, ..Options::default() };
            to_part(&mesh, &options).unwrap().report.max_deviation
        };
        let measured = (at(3) / at(5)).log2() / 2.0;
        println!("valence {n}: order {measured:.2}, predicted {order}");
        assert!((measured - order).abs() < 0.25, "valence {n}: {measured}");
    }
}

#[test]
fn a_slit_is_left_as_inserted() {
    // Two sharp edges a thousandth of a radian apart: a fan of tangents between them would grow beyond all measure.
    let mut mesh = crease(shapes::disk(5, 2), &[[0, 1], [0, 7]]);
    mesh.points[7] = Vec3::new(2.0 * 0.001f64.cos(), 2.0 * 0.001f64.sin(), 0.0);
    mesh.corners = vec![Corner { vertex: 0, sharpness: Sharpness::Infinite }];
    let patches = to_patches(&Level::new(&mesh).unwrap(), &mesh.points, &pccm::Options::default()).unwrap();
    assert!(patches.notes.iter().any(|note| note.code == "corner_fallback"), "{:?}", patches.notes);
    assert!(patches.nets.iter().flat_map(|net| net.cells()).all(|p| p.length() < 2.0 * mesh.size()));
}
