//! One tangent-continuous bi-quintic Bezier patch per quad: no refinement, no inner knots, closed meshes only.
//!
//! Starts from the bicubic patches of Loop and Schaefer, Approximating Catmull-Clark subdivision surfaces with bicubic
//! patches (2008), raised to degree five; boundary curves become quartics, and twists and second rows are set so that
//! both sides of every edge share tangent planes. `docs/methods/pccm.md`, The bi-quintic patch.

use super::PccmError;
use super::constants::Constants;
use super::net::view;
use super::requirements::refuse_valence_two;
use crate::math::circulant::{alternating_mean, first_mode, sign, solve_pair_sums};
use crate::math::{Grid, Vec3};
use crate::mesh::{HalfedgeId, VertexId};
use crate::nurbs::curve::raised;
use crate::rules::Level;
use std::f64::consts::TAU;

/// Bezier nets of degree (5, 5), one per quad: `nets[quad][(i, j)]`, `i` along the quad's first side.
///
/// # Errors
/// If the mesh has a boundary, a crease, a sharp vertex, a vertex of valence 2, or a face that is no quad.
///
/// # Panics
/// If there are fewer points than vertices.
pub fn to_quintic_patches(base: &Level, points: &[Vec3]) -> Result<Vec<Grid<Vec3>>, PccmError> {
    refuse_valence_two(base)?;
    refuse_tags(base)?;
    let topology = base.topology();
    let spokes = spokes(base, points);
    let mut quartics: Vec<[Vec3; 5]> = topology.edge_halfedges().map(|h| quartic(base, &spokes, h)).collect();
    balance(base, &mut quartics);

    let start: Vec<Grid<Vec3>> =
        (0..topology.face_count()).map(|quad| start_net(base, points, quad)).collect();
    let mut nets = start.clone();
    for h in (0..topology.halfedge_count() as u32).map(HalfedgeId) {
        let row: [Vec3; 6] = raised(&along(base, &quartics, h));
        for (k, value) in row.into_iter().enumerate() {
            set(&mut nets, h, k, 0, value);
        }
    }
    // The end of each side is the start of the next: columns are copied from the rows of the neighbours' sides.
    for h in (0..topology.halfedge_count() as u32).map(HalfedgeId) {
        let Some(twin) = topology.twin(h) else { continue };
        for k in 0..6 {
            let value = get(&nets, h.min(twin), if h < twin { k } else { 5 - k }, 0);
            set(&mut nets, h, k, 0, value);
        }
    }
    for v in (0..topology.vertex_count() as u32).map(VertexId) {
        twists(base, v, &quartics, &start, &mut nets);
    }
    second_rows(base, &quartics, &mut nets);
    Ok(nets)
}

fn refuse_tags(base: &Level) -> Result<(), PccmError> {
    let topology = base.topology();
    for h in (0..topology.halfedge_count() as u32).map(HalfedgeId) {
        if base.edge_sharpness(h) > 0.0 {
            return Err(PccmError::SharpEdge { a: topology.origin(h), b: topology.target(h) });
        }
    }
    for vertex in (0..topology.vertex_count() as u32).map(VertexId) {
        if base.vertex_sharpness(vertex) > 0.0 {
            return Err(PccmError::SharpVertex { vertex });
        }
    }
    Ok(())
}

/// Limit point, and cubic tangent leg, at the origin of every halfedge.
struct Spokes {
    limit: Vec<Vec3>,
    tangent: Vec<Vec3>,
}

fn spokes(base: &Level, points: &[Vec3]) -> Spokes {
    let topology = base.topology();
    let mut spokes = Spokes {
        limit: vec![Vec3::ZERO; topology.vertex_count()],
        tangent: vec![Vec3::ZERO; topology.halfedge_count()],
    };
    for v in (0..topology.vertex_count() as u32).map(VertexId) {
        let ring: Vec<HalfedgeId> = topology.ring(v).collect();
        let n = ring.len();
        if n == 0 {
            continue;
        }
        let at = |v: VertexId| points[v.index()];
        let edges: Vec<Vec3> = ring.iter().map(|&h| at(topology.target(h))).collect();
        let diagonals: Vec<Vec3> = ring.iter().map(|&h| at(topology.target(topology.next(h)))).collect();
        let sum = |points: &[Vec3]| points.iter().fold(Vec3::ZERO, |sum, &p| sum + p);
        let valence = n as f64;
        spokes.limit[v.index()] =
            (valence * valence * at(v) + 4.0 * sum(&edges) + sum(&diagonals)) / (valence * (valence + 5.0));
        let constants = Constants::new(n as u32);
        let (alpha, beta) = constants.weights(constants.length_project);
        let pairs: Vec<Vec3> = (0..n).map(|i| diagonals[i] + diagonals[(i + n - 1) % n]).collect();
        for (i, (edge, pair)) in first_mode(&edges).into_iter().zip(first_mode(&pairs)).enumerate() {
            spokes.tangent[ring[i].index()] = alpha * edge + beta * pair;
        }
    }
    spokes
}

/// The cubic between the limit points with their tangents, as a quartic; along the halfedge.
fn quartic(base: &Level, spokes: &Spokes, h: HalfedgeId) -> [Vec3; 5] {
    let topology = base.topology();
    let (a, b) = (spokes.limit[topology.origin(h).index()], spokes.limit[topology.target(h).index()]);
    let back = topology.twin(h).map_or(Vec3::ZERO, |twin| spokes.tangent[twin.index()]);
    let (q1, q2) = (a + spokes.tangent[h.index()], b + back);
    [a, (a + 3.0 * q1) / 4.0, (q1 + q2) / 2.0, (3.0 * q2 + b) / 4.0, b]
}

/// The quartic of a halfedge's edge, along the halfedge.
fn along(base: &Level, quartics: &[[Vec3; 5]], h: HalfedgeId) -> [Vec3; 5] {
    let mut quartic = quartics[base.topology().edge(h).index()];
    if base.topology().twin(h).is_some_and(|twin| twin < h) {
        quartic.reverse();
    }
    quartic
}

/// At even valence of 6 and more the alternating sum of the middle coefficients has to vanish: the smallest change
/// that makes it so at all of them at once, by conjugate gradients on the normal equations.
fn balance(base: &Level, quartics: &mut [[Vec3; 5]]) {
    let topology = base.topology();
    let even: Vec<Vec<usize>> = (0..topology.vertex_count() as u32)
        .map(VertexId)
        .map(|v| topology.ring(v).map(|h| topology.edge(h).index()).collect::<Vec<_>>())
        .filter(|ring| ring.len() >= 6 && ring.len().is_multiple_of(2))
        .collect();
    let residual = |middles: &dyn Fn(usize) -> Vec3| -> Vec<Vec3> {
        let sums = even.iter().map(|ring| {
            ring.iter().enumerate().fold(Vec3::ZERO, |sum, (i, &edge)| sum + sign(i) * middles(edge))
        });
        sums.collect()
    };
    let spread = |multipliers: &[Vec3]| {
        let mut change = vec![Vec3::ZERO; quartics.len()];
        for (ring, &multiplier) in even.iter().zip(multipliers) {
            for (i, &edge) in ring.iter().enumerate() {
                change[edge] += sign(i) * multiplier;
            }
        }
        change
    };
    let right = residual(&|edge| quartics[edge][2]);
    let multipliers = crate::math::sparse::conjugate_gradients(&right, |x| {
        let change = spread(x);
        residual(&|edge| change[edge])
    });
    let change = spread(&multipliers);
    for (quartic, change) in quartics.iter_mut().zip(change) {
        quartic[2] -= change;
    }
}

/// Bernstein coefficients of `D = 2 omega gamma'`, the sum of both cross derivatives along the halfedge's edge.
fn cross_sum(base: &Level, quartics: &[[Vec3; 5]], h: HalfedgeId) -> [Vec3; 6] {
    let topology = base.topology();
    let cosine = |v: VertexId| (TAU / f64::from(topology.valence(v).faces())).cos();
    let (c0, c1) = (cosine(topology.origin(h)), cosine(topology.target(h)));
    let b = along(base, quartics, h);
    let d: [Vec3; 4] = std::array::from_fn(|k| b[k + 1] - b[k]);
    [
        8.0 * c0 * d[0],
        24.0 / 5.0 * c0 * d[1],
        4.0 / 5.0 * (3.0 * c0 * d[2] - c1 * d[0]),
        4.0 / 5.0 * (c0 * d[3] - 3.0 * c1 * d[1]),
        -24.0 / 5.0 * c1 * d[2],
        -8.0 * c1 * d[3],
    ]
}

fn get(nets: &[Grid<Vec3>], h: HalfedgeId, a: usize, b: usize) -> Vec3 {
    nets[h.index() / 4][view(h.index() % 4, a, b, 5)]
}

fn set(nets: &mut [Grid<Vec3>], h: HalfedgeId, a: usize, b: usize, value: Vec3) {
    nets[h.index() / 4][view(h.index() % 4, a, b, 5)] = value;
}

/// `Q_11` of every patch around a vertex.
fn twists(base: &Level, v: VertexId, quartics: &[[Vec3; 5]], start: &[Grid<Vec3>], nets: &mut [Grid<Vec3>]) {
    let ring: Vec<HalfedgeId> = base.topology().ring(v).collect();
    if ring.is_empty() {
        return;
    }
    let right: Vec<Vec3> =
        ring.iter().map(|&h| get(nets, h, 1, 0) + cross_sum(base, quartics, h)[1] / 10.0).collect();
    let mut twists = solve_pair_sums(&right);
    if ring.len().is_multiple_of(2) {
        let kernel = alternating_mean(&ring.iter().map(|&h| get(start, h, 1, 1)).collect::<Vec<_>>());
        for (i, twist) in twists.iter_mut().enumerate() {
            *twist += sign(i) * kernel;
        }
    }
    for (&h, twist) in ring.iter().zip(twists) {
        set(nets, h, 1, 1, twist);
    }
}

/// The two middle coefficients of the second rows beside every edge, moved by the same amount on both sides.
fn second_rows(base: &Level, quartics: &[[Vec3; 5]], nets: &mut [Grid<Vec3>]) {
    let topology = base.topology();
    for h in topology.edge_halfedges() {
        let Some(twin) = topology.twin(h) else { continue };
        let cross = cross_sum(base, quartics, h);
        for k in [2, 3] {
            let (here, there) = (get(nets, h, k, 1), get(nets, twin, 5 - k, 1));
            let by = (2.0 * get(nets, h, k, 0) + cross[k] / 5.0 - here - there) / 2.0;
            set(nets, h, k, 1, here + by);
            set(nets, twin, 5 - k, 1, there + by);
        }
    }
}

/// The bicubic patch of Loop and Schaefer over a quad, raised to degree (5, 5).
fn start_net(base: &Level, points: &[Vec3], quad: usize) -> Grid<Vec3> {
    let topology = base.topology();
    let at = |v: VertexId| points[v.index()];
    let mut net = Grid::from_fn(4, 4, |_, _| Vec3::ZERO);
    for k in 0..4 {
        let h = HalfedgeId((4 * quad + k) as u32);
        let v = topology.origin(h);
        let ring: Vec<HalfedgeId> = topology.ring(v).collect();
        let n = ring.len() as f64;
        let sum = |weight_edge: f64, weight_diagonal: f64| {
            ring.iter().fold(Vec3::ZERO, |sum, &g| {
                sum + weight_edge * at(topology.target(g))
                    + weight_diagonal * at(topology.target(topology.next(g)))
            })
        };
        net[view(k, 0, 0, 3)] = (n * n * at(v) + sum(4.0, 1.0)) / (n * (n + 5.0));
        // Edges i - 1, i, i + 1, i + 2 and diagonals i - 1, i, i + 1 of the ring, i this patch.
        let i = ring.iter().position(|&g| g == h).unwrap_or(0);
        let turn = |by: usize| ring[(i + by + ring.len() - 1) % ring.len()];
        let edge = |by: usize| at(topology.target(turn(by)));
        let diagonal = |by: usize| at(topology.target(topology.next(turn(by))));
        net[view(k, 1, 1, 3)] = (n * at(v) + 2.0 * edge(1) + 2.0 * edge(2) + diagonal(1)) / (n + 5.0);
        let spoke = |edges: [Vec3; 3], diagonals: [Vec3; 2]| {
            (2.0 * n * at(v) + 4.0 * edges[1] + 2.0 * edges[0] + 2.0 * edges[2] + diagonals[0] + diagonals[1])
                / (2.0 * n + 10.0)
        };
        net[view(k, 1, 0, 3)] = spoke([edge(0), edge(1), edge(2)], [diagonal(0), diagonal(1)]);
        net[view(k, 0, 1, 3)] = spoke([edge(1), edge(2), edge(3)], [diagonal(1), diagonal(2)]);
    }
    let quintic = |column: [Vec3; 4]| -> [Vec3; 6] { raised(&raised::<5>(&column)) };
    let columns: Vec<[Vec3; 6]> = (0..4).map(|i| quintic(std::array::from_fn(|j| net[(i, j)]))).collect();
    let rows: Vec<[Vec3; 6]> = (0..6).map(|j| quintic(std::array::from_fn(|i| columns[i][j]))).collect();
    Grid::from_fn(6, 6, |i, j| rows[j][i])
}
