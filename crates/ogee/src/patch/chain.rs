//! `ChainBasis`: how the ring around an irregular corner makes the next ring, and the bicubic tiles beside it.
//!
//! Around a corner that refinement reproduces, a quad is an infinite chain of L-shaped rings of three bicubic tiles,
//! each ring half as large as the one before (Stam 1998; `docs/methods/exact_evaluation.md`). All is decided by the
//! *ring* of the corner:
//!
//! ```text
//!  f .. i  h                 0        the corner itself
//!  |    |  |                 1 + 2i   neighbour e_i, counter-clockwise; e_p and e_(p+1) are the quad's own
//!  d1-- e1-+--g              2 + 2i   diagonal d_i of the face between e_i and e_(i+1)
//!  |    |quad |              then     (2,-1) (2,0) (2,1) (2,2) (1,2) (0,2) (-1,2) in the grid of the quad,
//!  e2 - 0 - e0-+                      without the first or last where a sharp edge ends the surface there
//! ```
//!
//! In a closed ring the quad's face is the first; in a sector between sharp edges its position is counted from the
//! first sharp edge, and there is one neighbour more than diagonals. A [`Kind`] decides the rest, so each kind is worked
//! out once: a model of it is refined by the ordinary masks, and what they say is kept as weights.

use std::f64::consts::{PI, TAU};

use super::dart::Dart;
use super::kind::Kind;
use super::lens::Lens;
use super::surroundings::{Mirrored, Surroundings};
use super::{masks, meeting, smooth};
use crate::curve_network::rule::Slice;
use crate::math::Vec3;
use crate::math::simd::{self, Four};
use crate::mesh::{Boundary, Creasing, EdgeId, FaceId, FaceList, HalfedgeId, Scheme, Topology, VertexId};
use crate::rules::masks as rules;
use crate::rules::{Level, SharpEdge, Sparse};
use crate::stencil::{Row, join};

/// A point with a fourth coordinate of zero: what lanes of four like.
pub(crate) type Wide = [f64; 4];

/// Weighted sums, each a few groups of sources that share a weight: most masks have one or two.
#[derive(Clone, Debug, Default)]
struct Sums {
    /// For each sum the end of its groups.
    ends: Vec<u32>,
    /// Weight and end of sources.
    groups: Vec<(f64, u32)>,
    sources: Vec<u32>,
}

impl Sums {
    fn push(&mut self, mut terms: Vec<(u32, f64)>) {
        join(&mut terms);
        terms.retain(|&(_, weight)| weight != 0.0);
        terms.sort_by(|a, b| b.1.total_cmp(&a.1));
        for group in terms.chunk_by(|a, b| a.1 == b.1) {
            self.sources.extend(group.iter().map(|&(source, _)| source));
            self.groups.push((group[0].1, self.sources.len() as u32));
        }
        self.ends.push(self.groups.len() as u32);
    }

    fn len(&self) -> usize {
        self.ends.len()
    }

    fn terms(&self, row: usize) -> Vec<(usize, f64)> {
        let first = if row == 0 { 0 } else { self.ends[row - 1] as usize };
        let mut start = if first == 0 { 0 } else { self.groups[first - 1].1 as usize };
        let mut out = Vec::new();
        for &(weight, end) in &self.groups[first..self.ends[row] as usize] {
            out.extend(self.sources[start..end as usize].iter().map(|&source| (source as usize, weight)));
            start = end as usize;
        }
        out
    }

    /// The sums over `from`.
    #[inline(always)]
    fn apply<V: Four>(&self, from: &[Wide], out: &mut [Wide]) {
        let (mut group, mut source) = (0, 0);
        for (&end, out) in self.ends.iter().zip(out) {
            let mut value = V::splat(0.0);
            for &(weight, last) in &self.groups[group..end as usize] {
                let mut sum = V::splat(0.0);
                for &point in &self.sources[source..last as usize] {
                    sum = sum.plus(V::load(&from[point as usize]));
                }
                value = value.plus(V::splat(weight).times(sum));
                source = last as usize;
            }
            group = end as usize;
            *out = value.store();
        }
    }
}

/// One step of a chain of one kind, and where it leads.
#[derive(Clone, Debug)]
pub(crate) struct ChainBasis {
    pub(crate) kind: Kind,
    /// Face points, over the ring.
    face_points: Sums,
    /// The next ring, then the other points of the tiles; over the ring and the face points after it.
    fine: Sums,
    /// Nets of the three tiles beside the corner, `i + 4 j`, as numbers of fine points: at `(1,0)`, `(1,1)`, `(0,1)`. Where
    /// curves meet, of the four quarters of each.
    pub(crate) tiles: Vec<[u32; 16]>,
    /// Weights of the limit position over the inner points.
    pub(crate) position: Vec<f64>,
    /// Weights of two vectors that span the tangent plane, along the quad's own edges where the vertex is smooth, along the
    /// first and towards the corner across at a lens; `None` where there is none.
    pub(crate) tangents: Option<[Vec<f64>; 2]>,
    /// By how much a step shrinks the ring in the end.
    pub(crate) eigenvalue: f64,
}

impl ChainBasis {
    pub(crate) fn new(kind: Kind) -> ChainBasis {
        let model = Model::new(kind);
        let count = kind.ring_count();
        let child = model.level.split();
        let surroundings = Surroundings::new(&child);
        // The quad's own corner comes first in its face, so its child there is the quad of the same halfedge.
        let halfedge = model.level.topology().first(model.face);
        let ring = surroundings.ring(HalfedgeId(4 * halfedge.0), kind);
        debug_assert_eq!(ring.len(), count);
        let mut fine_points = ring;
        // Aligned with the quad, not turned with its corner.
        let origins = [1, 2, 3].map(|corner| HalfedgeId(4 * (halfedge.0 + corner) + (4 - corner)));
        let mut tiles = Vec::new();
        let mut quarters = Vec::new();
        if let Kind::Meeting { .. } = kind {
            let below = child.split();
            let surroundings = Surroundings::new(&below);
            for origin in origins {
                let first = child.topology().first(child.topology().face(origin)).0;
                for quarter in 0..4 {
                    let quad = first + (origin.0 - first + quarter) % 4;
                    let net = surroundings.net(HalfedgeId(4 * quad + (4 - quarter) % 4));
                    tiles.push(net.map(|point| (count as u32) + number_of(&mut quarters, point)));
                }
            }
        } else {
            tiles.extend(
                origins
                    .map(|origin| surroundings.net(origin).map(|point| number_of(&mut fine_points, point))),
            );
        }
        let mut terms = Terms { level: &model.level, count, faces: Vec::new(), row: Row::new() };
        let mut fine = Sums::default();
        for point in &fine_points {
            let row = terms.of(point);
            fine.push(row);
        }
        for point in &quarters {
            fine.push(over_ring(&model.level, &child, point, count));
        }
        let mut face_points = Sums::default();
        for &face in &terms.faces {
            let mut row = Row::new();
            rules::face_mask(&model.level, face, &mut row);
            face_points.push(row.weights().to_vec());
        }
        let mut basis = ChainBasis {
            kind,
            face_points,
            fine,
            tiles,
            position: Vec::new(),
            tangents: None,
            eigenvalue: 0.0,
        };
        basis.position = basis.limit_position();
        basis.tangents = tangent_weights(kind);
        basis.eigenvalue = basis.subdominant();
        basis
    }

    /// True if a tile is no patch, but its four quarters are.
    pub(crate) fn has_quarters(&self) -> bool {
        matches!(self.kind, Kind::Meeting { .. })
    }

    /// Where a tile lies in the frame of the corner, in widths of its step, and how wide it is.
    pub(crate) fn tile_cell(&self, tile: usize) -> ([f64; 2], f64) {
        const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        if !self.has_quarters() {
            return (CORNERS[tile + 1], 1.0);
        }
        let ([x, y], [i, j]) = (CORNERS[tile / 4 + 1], CORNERS[tile % 4]);
        ([x + i / 2.0, y + j / 2.0], 1.0 / 2.0)
    }

    /// By how much the surface shrinks about its limit in some steps, and by how much first and second derivatives grow,
    /// far down the chain.
    pub(crate) fn growth(&self, steps: i32) -> [f64; 3] {
        // Beside a boundary vertex of one face it comes close to a line; what bends shrinks by 1/4 then.
        let bending = if let Kind::Crease { faces: 1, .. } = self.kind { 0.25 } else { self.eigenvalue };
        [self.eigenvalue, 2.0 * self.eigenvalue, 4.0 * bending].map(|factor| factor.powi(steps))
    }

    /// Memory in bytes, about.
    pub(crate) fn bytes(&self) -> usize {
        let sums = |sums: &Sums| 4 * sums.ends.len() + 16 * sums.groups.len() + 4 * sums.sources.len();
        size_of::<ChainBasis>()
            + sums(&self.face_points)
            + sums(&self.fine)
            + 8 * self.position.len()
            + self.tangents.as_ref().map_or(0, |[a, b]| 8 * (a.len() + b.len()))
    }

    /// Number of points in a ring.
    pub(crate) fn ring_count(&self) -> usize {
        self.kind.ring_count()
    }

    /// Room that a step needs.
    pub(crate) fn work_count(&self) -> usize {
        (self.ring_count() + self.face_points.len()).max(self.fine.len())
    }

    /// The fine points of a ring, the first of them the next ring. `ring` has room behind it for face points.
    #[inline]
    pub(crate) fn step(&self, ring: &mut [Wide], fine: &mut [Wide]) {
        simd::dispatch(Step { basis: self, ring, fine });
    }

    /// Weights over the ring of a fine point.
    fn step_of(&self, row: usize) -> Vec<(usize, f64)> {
        let count = self.ring_count();
        let mut out: Vec<(usize, f64)> = Vec::new();
        for (source, weight) in self.fine.terms(row) {
            if source < count {
                out.push((source, weight));
            } else {
                let inner = self.face_points.terms(source - count);
                out.extend(inner.into_iter().map(|(source, share)| (source, weight * share)));
            }
        }
        out
    }

    /// Weights over the ring of every fine point.
    pub(crate) fn all_rows(&self) -> Vec<Vec<(usize, f64)>> {
        (0..self.fine.len()).map(|row| self.step_of(row)).collect()
    }

    /// The left eigenvector of the eigenvalue one, over the inner points.
    fn limit_position(&self) -> Vec<f64> {
        let count = self.kind.inner_count();
        match self.kind {
            Kind::Cone { .. } | Kind::Corner { .. } | Kind::Meeting { .. } => unit(count, 0),
            Kind::Smooth { valence } => {
                let n = f64::from(valence);
                let [vertex, edge, diagonal] = [n * n, 4.0, 1.0].map(|weight| weight / (n * (n + 5.0)));
                let weight = |i: usize| if i % 2 == 1 { edge } else { diagonal };
                (0..count).map(|i| if i == 0 { vertex } else { weight(i) }).collect()
            }
            Kind::Crease { .. } => {
                let mut weights = unit(count, 0);
                weights[0] = 4.0 / 6.0;
                weights[1] += 1.0 / 6.0;
                weights[count - 1] += 1.0 / 6.0;
                weights
            }
            Kind::Lens { crease, .. } => Lens::new(self.kind.lens_shape(), crease).position.to_vec(),
            Kind::Dart { valence, crease } => Dart::new(valence as usize).seen_from(crease as usize).0,
        }
    }

    /// The largest eigenvalue below one.
    fn subdominant(&self) -> f64 {
        match self.kind {
            Kind::Smooth { valence } => masks::subdominant(TAU / f64::from(valence)),
            Kind::Lens { crease, .. } => Lens::new(self.kind.lens_shape(), crease).eigenvalue,
            Kind::Dart { valence, .. } => {
                let [along, across] = Dart::new(valence as usize).eigenvalues;
                along.max(across)
            }
            // Edges and diagonals move alike there, with the vertex at rest: l^2 - 3/4 l + 1/16 = 0.
            Kind::Cone { .. } => (3.0 + 5.0_f64.sqrt()) / 8.0,
            Kind::Meeting { .. } => 1.0 / 2.0,
            // Along the sharp edges 1/2.
            Kind::Crease { faces, .. } | Kind::Corner { faces, .. } => {
                masks::subdominant(PI / f64::from(faces)).max(1.0 / 2.0)
            }
        }
    }
}

fn unit(count: usize, at: usize) -> Vec<f64> {
    let mut weights = vec![0.0; count];
    weights[at] = 1.0;
    weights
}

/// Tangent masks where they exist: on a crease with more than three faces, at a corner with more than two, at a cone
/// there is no tangent plane.
fn tangent_weights(kind: Kind) -> Option<[Vec<f64>; 2]> {
    match kind {
        Kind::Smooth { valence } => {
            // Towards the quad's own edges.
            let (sin, cos) = (TAU / f64::from(valence)).sin_cos();
            let mut tangents = [vec![0.0], vec![0.0]];
            for [along, across] in masks::smooth_tangents(valence as usize).flatten() {
                tangents[0].push(along);
                tangents[1].push(cos * along + sin * across);
            }
            Some(tangents)
        }
        Kind::Crease { faces: 1..=3, .. } | Kind::Corner { faces: 2, .. } => {
            Some([0, 1].map(|which| few_weights(kind, which)))
        }
        Kind::Lens { crease, .. } => {
            Lens::new(kind.lens_shape(), crease).tangents.map(|tangents| tangents.map(|mask| mask.to_vec()))
        }
        Kind::Dart { valence, crease } => Dart::new(valence as usize).seen_from(crease as usize).1,
        Kind::Meeting { ports, port_first, t } => {
            Some(meeting::tangents(ports as usize, port_first, f64::from_bits(t)))
        }
        _ => None,
    }
}

/// The weights of a tangent mask of a sector of few faces, one point at a time: the mask is linear.
fn few_weights(kind: Kind, which: usize) -> Vec<f64> {
    let count = kind.inner_count();
    let weight = |source: usize| {
        let value = |at: usize| if at == source { Vec3::new(1.0, 0.0, 0.0) } else { Vec3::ZERO };
        let edges: Vec<Vec3> = (1..count).step_by(2).map(value).collect();
        let diagonals: Vec<Vec3> = (2..count).step_by(2).map(value).collect();
        let frame = match kind {
            Kind::Crease { .. } => masks::crease(value(0), &edges, &diagonals),
            _ => masks::corner(value(0), &edges),
        };
        frame.tangents[which].x
    };
    (0..count).map(weight).collect()
}

/// The number of a fine point; one that is new is added.
fn number_of(points: &mut Vec<Mirrored>, point: Mirrored) -> u32 {
    let number = points.iter().position(|other| *other == point).unwrap_or_else(|| {
        points.push(point);
        points.len() - 1
    });
    number as u32
}

/// A point two steps down in terms of the model's ring.
fn over_ring(level: &Level, child: &Level, point: &Mirrored, count: usize) -> Vec<(u32, f64)> {
    let mut out = Vec::new();
    let (mut outer, mut inner) = (Row::new(), Row::new());
    for &(fine, share) in point {
        outer.clear();
        child.child_mask(fine, &mut outer);
        for &(middle, weight) in outer.weights() {
            inner.clear();
            level.child_mask(middle, &mut inner);
            for &(vertex, last) in inner.weights() {
                debug_assert!((vertex as usize) < count, "the ring decides its tiles");
                out.push((vertex, share * weight * last));
            }
        }
    }
    out
}

/// What a point of the refined model is in terms of the model's ring and its face points.
struct Terms<'a> {
    level: &'a Level,
    count: usize,
    /// Faces whose points are used, in the order of their numbers.
    faces: Vec<FaceId>,
    row: Row,
}

impl Terms<'_> {
    fn of(&mut self, point: &Mirrored) -> Vec<(u32, f64)> {
        let mut out = Vec::new();
        let topology = self.level.topology();
        let (vertices, faces) = (topology.vertex_count() as u32, topology.face_count() as u32);
        for &(fine, share) in point {
            self.row.clear();
            if fine < vertices {
                rules::vertex_terms(self.level, VertexId(fine), &mut self.row);
            } else if fine < vertices + faces {
                self.row.add_face_point(FaceId(fine - vertices), 1.0);
            } else {
                let side = topology.side(EdgeId(fine - vertices - faces));
                rules::edge_terms(self.level, side, &mut self.row);
            }
            let [on_vertices, on_faces] = self.row.terms();
            for &(vertex, weight) in on_vertices {
                debug_assert!((vertex as usize) < self.count, "the ring decides its tiles");
                out.push((vertex, share * weight));
            }
            for &(face, weight) in on_faces {
                let known = self.faces.iter().position(|&other| other.0 == face);
                let number = known.unwrap_or_else(|| {
                    self.faces.push(FaceId(face));
                    self.faces.len() - 1
                });
                out.push(((self.count + number) as u32, share * weight));
            }
        }
        out
    }
}

/// A mesh whose vertices are the points of the ring, with the faces around the corner and those outside the quad.
struct Model {
    level: Level,
    /// The quad; its first corner is the irregular one.
    face: FaceId,
}

impl Model {
    fn new(kind: Kind) -> Model {
        let (faces, position) = (kind.faces(), kind.position());
        let edge = |i: u32| 1 + 2 * if kind.is_closed() { i % faces } else { i };
        let diagonal = |i: u32| 2 + 2 * (i % faces);
        let mut list = FaceList::new();
        for i in 0..faces {
            list.push(&[0, edge(i), diagonal(i), edge(i + 1)]);
        }
        let (first, across, second) = (edge(position), diagonal(position), edge(position + 1));
        // Numbers of the outer points; those that are no part of the ring come after it.
        let mut next = kind.inner_count() as u32;
        let mut number = |exists: bool| {
            next += u32::from(exists);
            if exists { next - 1 } else { u32::MAX }
        };
        let below = number(kind.continues_below());
        let outer = [number(true), number(true), number(true), number(true), number(true)];
        let left = number(kind.continues_left());
        // Beside a dart's crease the surface goes on, though the quad's own net does not need it.
        let open_below = kind.ending_crease().is_some() && below == u32::MAX;
        let open_left = kind.ending_crease().is_some() && left == u32::MAX;
        let below = if open_below { number(true) } else { below };
        let left = if open_left { number(true) } else { left };
        let [right, right_above, corner, above_right, above] = outer;
        let along_first = list.len() as u32;
        list.push(&[first, right, right_above, across]);
        list.push(&[across, right_above, corner, above_right]);
        let along_second = list.len() as u32;
        list.push(&[second, across, above_right, above]);
        if below != u32::MAX {
            list.push(&[diagonal(position + faces - 1), below, right, first]);
        }
        if left != u32::MAX {
            list.push(&[diagonal(position + 1), second, above, left]);
        }
        let topology = Topology::of_part(&list, next as usize);
        let mut creases = Vec::new();
        if let Some(crease) = kind.ending_crease() {
            creases.push(HalfedgeId(4 * crease));
            if open_below {
                creases.push(HalfedgeId(4 * along_first));
            }
            if open_left {
                creases.push(HalfedgeId(4 * along_second + 3));
            }
        }
        let sharp = creases
            .iter()
            .map(|&halfedge| (topology.edge(halfedge).0, SharpEdge { halfedge, sharpness: f64::INFINITY }));
        let sharp = Sparse::new(sharp.collect());
        let stays = matches!(kind, Kind::Cone { .. } | Kind::Corner { .. });
        let corners = if stays { vec![(0, f64::INFINITY)] } else { Vec::new() };
        // The rim of the model is no boundary; on real ones a vertex stays where its kind says so.
        let scheme =
            Scheme { boundary: Boundary::EdgeOnly, creasing: Creasing::Uniform, lens: kind.lens_shape() };
        let mut slices = Vec::new();
        if let Kind::Meeting { port_first, t, .. } = kind {
            slices.extend((0..faces).map(|i| {
                let (halfedge, t) = (HalfedgeId(4 * i), f64::from_bits(t));
                (i, Slice { halfedge, port_first: port_first == i.is_multiple_of(2), t })
            }));
        }
        let level = Level::with_sharpness(topology, scheme, sharp, Sparse::new(corners), Vec::new())
            .with_slices(Sparse::new(slices));
        Model { level, face: FaceId(position) }
    }
}

/// One step, for [`simd::dispatch`].
struct Step<'a> {
    basis: &'a ChainBasis,
    ring: &'a mut [Wide],
    fine: &'a mut [Wide],
}

impl simd::Kernel for Step<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Four>(self) {
        if let Kind::Smooth { valence } = self.basis.kind {
            return smooth::step::<V>(valence as usize, self.ring, self.fine);
        }
        let count = self.basis.kind.ring_count();
        let (ring, face_points) = self.ring.split_at_mut(count);
        self.basis.face_points.apply::<V>(ring, face_points);
        self.basis.fine.apply::<V>(self.ring, self.fine);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::LensShape;

    /// Limits and eigenvalues in closed form are those of the rows that refinement gave.
    #[test]
    fn closed_forms_are_those_of_the_rows() {
        let mut kinds: Vec<Kind> = [3, 5, 8].map(|valence| Kind::Smooth { valence }).to_vec();
        kinds.extend([3, 4, 7].map(|valence| Kind::Cone { valence }));
        kinds.extend([1, 3, 4, 6].map(|faces| Kind::Crease { faces, position: faces / 2 }));
        kinds.extend([2, 3, 5].map(|faces| Kind::Corner { faces, position: 0 }));
        kinds.extend([4, 7].map(|valence| Kind::Dart { valence, crease: 1 }));
        let shapes = [[0.5, 0.125], [0.5, 0.2], [0.3, 0.2]].map(|[beta, gamma]| LensShape { beta, gamma });
        kinds.extend(
            shapes.iter().flat_map(|&shape| [None, Some(0), Some(1)].map(|crease| Kind::lens(shape, crease))),
        );
        for kind in kinds {
            let basis = ChainBasis::new(kind);
            let count = kind.inner_count();
            let rows: Vec<_> = (0..count).map(|row| basis.step_of(row)).collect();
            let mut again = vec![0.0; count];
            for (&weight, row) in basis.position.iter().zip(&rows) {
                for &(source, share) in row {
                    again[source] += weight * share;
                }
            }
            assert!(again.iter().zip(&basis.position).all(|(a, b)| (a - b).abs() < 1e-15), "{kind:?}");
            // Powers of the rows on values of no symmetry.
            let mut values: Vec<f64> = (0..count).map(|i| (i as f64 * 1.7).sin() + 0.1 * i as f64).collect();
            let mut ratio = 0.0;
            for _ in 0..2000 {
                let next: Vec<f64> =
                    rows.iter().map(|row| row.iter().map(|&(source, w)| w * values[source]).sum()).collect();
                let mean: f64 = basis.position.iter().zip(&next).map(|(w, x)| w * x).sum();
                let size = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>().sqrt();
                let next: Vec<f64> = next.iter().map(|x| x - mean).collect();
                ratio = size(&next) / size(&values);
                let scale = 1.0 / size(&next);
                values = next.iter().map(|x| x * scale).collect();
            }
            // Where two modes shrink alike, powers come near like 1/n only.
            assert!((ratio - basis.eigenvalue).abs() < 1e-3, "{kind:?}: {ratio} {}", basis.eigenvalue);
        }
    }

    #[test]
    fn the_quick_step_is_the_general_step() {
        for valence in [3, 4, 5, 6, 7, 12, 50] {
            let basis = ChainBasis::new(Kind::Smooth { valence });
            let mut ring = vec![[0.0; 4]; basis.work_count()];
            for (i, point) in ring.iter_mut().take(basis.ring_count()).enumerate() {
                let t = i as f64;
                *point = [(1.3 * t).sin(), (0.7 * t).cos(), (t * t).sin(), 0.0];
            }
            let mut quick = vec![[0.0; 4]; basis.work_count()];
            smooth::step::<simd::Plain>(valence as usize, &mut ring.clone(), &mut quick);
            let mut general = vec![[0.0; 4]; basis.work_count()];
            let (points, face_points) = ring.split_at_mut(basis.ring_count());
            basis.face_points.apply::<simd::Plain>(points, face_points);
            basis.fine.apply::<simd::Plain>(&ring, &mut general);
            for (a, b) in quick.iter().zip(&general) {
                assert!((0..4).all(|c| (a[c] - b[c]).abs() < 1e-15), "valence {valence}: {a:?} {b:?}");
            }
        }
    }
}
