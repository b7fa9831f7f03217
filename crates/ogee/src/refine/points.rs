//! The fast path: points of the next level straight from the points of this one.
//!
//! The four common masks (smooth face, edge and vertex, and the boundary) are stated here a second time, without
//! rows; everything a tag touches asks the rule table. The test `fast_path_equals_the_table` holds the two together.

use crate::math::{Interpolate, par};
use crate::mesh::connectivity::Connectivity;
use crate::mesh::{Boundary, EdgeId, FaceId, HalfedgeId, VertexId};
use crate::rules::{Level, masks};
use crate::stencil::Row;

impl Level {
    /// One step of refinement of points or other data, with no table kept: the next level and its points.
    ///
    /// # Panics
    /// If there are fewer points than vertices, or the next level would be too large.
    pub fn refine_points<T: Interpolate>(&self, points: &[T]) -> (Level, Vec<T>) {
        let mut out = Vec::new();
        self.child_points(points, &mut out);
        (self.split(), out)
    }

    /// The points of the next level: vertex points, face points, edge points. They go into memory that is there
    /// already: fresh memory costs more than the arithmetic.
    pub(crate) fn child_points<T: Interpolate>(&self, points: &[T], out: &mut Vec<T>) {
        let (edge_rules, vertex_rules) = self.tagged_rules();
        let tagged_vertex = |v: VertexId| {
            let tagged = !vertex_rules.is_empty() && vertex_rules.get(v.0).is_some();
            tagged.then(|| by_table(points, |row| masks::vertex_mask(self, v, row)))
        };
        let tagged_edge = |e: EdgeId| {
            let tagged = !edge_rules.is_empty() && edge_rules.get(e.0).is_some();
            tagged.then(|| by_table(points, |row| masks::edge_mask(self, self.topology().side(e), row)))
        };
        let tagged_face = |f: FaceId| {
            let tagged = self.has_slices() && self.slice(f).is_some();
            tagged.then(|| by_table(points, |row| masks::face_mask(self, f, row)))
        };
        let tagged = Tagged { face: tagged_face, vertex: tagged_vertex, edge: tagged_edge };
        let boundary = self.scheme().boundary;
        match self.topology().as_quads() {
            Some(quads) => refine(&quads, boundary, points, out, tagged),
            None => refine(self.topology(), boundary, points, out, tagged),
        }
    }
}

/// The points of elements that have a rule of their own.
struct Tagged<F, V, E> {
    face: F,
    vertex: V,
    edge: E,
}

fn refine<T: Interpolate>(
    topology: &impl Connectivity,
    boundary: Boundary,
    points: &[T],
    out: &mut Vec<T>,
    tagged: Tagged<
        impl Fn(FaceId) -> Option<T> + Sync + Send,
        impl Fn(VertexId) -> Option<T> + Sync + Send,
        impl Fn(EdgeId) -> Option<T> + Sync + Send,
    >,
) {
    let (vertices, faces, edges) = (topology.vertex_count(), topology.face_count(), topology.edge_count());
    let points = &points[..vertices];
    out.resize(vertices + faces + edges, T::zero());
    let (vertex_points, rest) = out.split_at_mut(vertices);
    let (face_points, edge_points) = rest.split_at_mut(faces);
    par::fill(face_points, |f| {
        let f = FaceId(f as u32);
        (tagged.face)(f).unwrap_or_else(|| face_point(topology, f, points))
    });
    let face_points = &*face_points;
    par::fill(vertex_points, |v| {
        let v = VertexId(v as u32);
        (tagged.vertex)(v).unwrap_or_else(|| vertex_point(topology, boundary, v, points, face_points))
    });
    par::fill(edge_points, |e| {
        let e = EdgeId(e as u32);
        (tagged.edge)(e).unwrap_or_else(|| edge_point(topology, topology.side(e), points, face_points))
    });
}

fn by_table<T: Interpolate>(points: &[T], write: impl Fn(&mut Row)) -> T {
    let mut row = Row::new();
    write(&mut row);
    let mut value = T::zero();
    for &(source, weight) in row.weights() {
        value.add_scaled(weight, &points[source as usize]);
    }
    value
}

#[inline]
fn face_point<T: Interpolate>(topology: &impl Connectivity, f: FaceId, points: &[T]) -> T {
    let (first, size) = (topology.first(f).0, topology.face_size(f));
    let share = 1.0 / f64::from(size);
    let mut value = T::zero();
    for h in first..first + size {
        value.add_scaled(share, &points[topology.origin(HalfedgeId(h)).index()]);
    }
    value
}

#[inline]
fn edge_point<T: Interpolate>(
    topology: &impl Connectivity,
    h: HalfedgeId,
    points: &[T],
    face_points: &[T],
) -> T {
    let ends = [&points[topology.origin(h).index()], &points[topology.target(h).index()]];
    let mut value = T::zero();
    let Some(twin) = topology.twin(h) else {
        value.add_scaled(1.0 / 2.0, ends[0]);
        value.add_scaled(1.0 / 2.0, ends[1]);
        return value;
    };
    value.add_scaled(1.0 / 4.0, ends[0]);
    value.add_scaled(1.0 / 4.0, ends[1]);
    value.add_scaled(1.0 / 4.0, &face_points[topology.face(h).index()]);
    value.add_scaled(1.0 / 4.0, &face_points[topology.face(twin).index()]);
    value
}

#[inline]
fn vertex_point<T: Interpolate>(
    topology: &impl Connectivity,
    boundary: Boundary,
    v: VertexId,
    points: &[T],
    face_points: &[T],
) -> T {
    let own = &points[v.index()];
    let Some(first) = topology.outgoing(v) else { return own.clone() };
    let mut around = T::zero();
    let mut n = 0.0;
    let mut h = first;
    loop {
        around.add_scaled(1.0, &points[topology.target(h).index()]);
        around.add_scaled(1.0, &face_points[topology.face(h).index()]);
        n += 1.0;
        match topology.twin(topology.prev(h)) {
            Some(next) if next != first => h = next,
            Some(_) => break,
            None => return boundary_point(topology, boundary, [first, h], own, points),
        }
    }
    let mut value = T::zero();
    value.add_scaled((n - 2.0) / n, own);
    value.add_scaled(1.0 / (n * n), &around);
    value
}

/// `ends`: the first and the last halfedge that leave the vertex.
fn boundary_point<T: Interpolate>(
    topology: &impl Connectivity,
    boundary: Boundary,
    [first, last]: [HalfedgeId; 2],
    own: &T,
    points: &[T],
) -> T {
    if first == last && boundary == Boundary::EdgeAndCorner {
        return own.clone();
    }
    let mut value = T::zero();
    value.add_scaled(6.0 / 8.0, own);
    value.add_scaled(1.0 / 8.0, &points[topology.target(first).index()]);
    value.add_scaled(1.0 / 8.0, &points[topology.origin(topology.prev(last)).index()]);
    value
}
