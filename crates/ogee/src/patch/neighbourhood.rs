//! `Neighbourhood`: some faces of a level as a level of their own.

use crate::curve_network::rule::Slice;
use crate::mesh::{FaceId, FaceList, HalfedgeId, Topology, VertexId};
use crate::rules::{Level, SharpEdge, Sparse};

/// Some faces of a level, with their tags, as a small level.
///
/// Its rim is cut: what is computed there from faces that were left behind is meaningless. What depends only on faces
/// that are inside is as on the whole level.
pub(crate) struct Neighbourhood {
    pub(crate) level: Level,
    /// For each of its vertices the one of the whole level.
    pub(crate) vertices: Vec<VertexId>,
}

impl Neighbourhood {
    /// The given faces, in their order.
    pub(crate) fn new(whole: &Level, faces: &[FaceId]) -> Neighbourhood {
        let topology = whole.topology();
        let corners = |f: FaceId| topology.halfedges(f).map(|h| topology.origin(h).0);
        let vertices = in_order(topology.vertex_count(), faces.iter().flat_map(|&f| corners(f)));
        let own = numbers(topology.vertex_count(), &vertices);
        let mut list = FaceList::with_capacity(faces.len(), 4 * faces.len());
        let mut face = Vec::new();
        for &f in faces {
            face.clear();
            face.extend(corners(f).map(&own));
            list.push(&face);
        }
        let own_topology = Topology::of_part(&list, vertices.len());
        let mut sharp = Vec::new();
        for (own_h, h) in faces.iter().flat_map(|&f| topology.halfedges(f)).enumerate() {
            let halfedge = HalfedgeId(own_h as u32);
            let is_first = own_topology.twin(halfedge).is_some_and(|twin| halfedge < twin);
            let sharpness = if is_first { whole.edge_sharpness(h) } else { 0.0 };
            if sharpness > 0.0 {
                sharp.push((own_topology.edge(halfedge).0, SharpEdge { halfedge, sharpness }));
            }
        }
        let tagged = vertices
            .iter()
            .enumerate()
            .filter_map(|(own, &v)| Some((own as u32, whole.sharp_vertices().get(v)?)));
        let sharp_vertices = Sparse::new(tagged.collect());
        let slices = Sparse::new(slices(whole, faces, &own_topology));
        let level = Level::with_sharpness(
            own_topology,
            whole.scheme(),
            Sparse::new(sharp),
            sharp_vertices,
            Vec::new(),
        )
        .with_slices(slices);
        Neighbourhood { level, vertices: vertices.iter().copied().map(VertexId).collect() }
    }

    /// Its vertex for a vertex of the whole level.
    pub(crate) fn own(&self, v: VertexId) -> Option<VertexId> {
        self.vertices.binary_search(&v).ok().map(|own| VertexId(own as u32))
    }

    /// Data of the whole level at its own vertices.
    pub(crate) fn take<T: Clone>(&self, data: &[T]) -> Vec<T> {
        self.vertices.iter().map(|v| data[v.index()].clone()).collect()
    }
}

/// The rules of its faces where curves meet. On the rim the quad across a port may be missing.
fn slices(whole: &Level, faces: &[FaceId], own: &Topology) -> Vec<(u32, Slice)> {
    if !whole.has_slices() {
        return Vec::new();
    }
    let turned = |(number, &f): (u32, &FaceId)| {
        let slice = whole.slice(f)?;
        let corner = slice.halfedge.0 - whole.topology().first(f).0;
        let slice = Slice { halfedge: HalfedgeId(own.first(FaceId(number)).0 + corner), ..slice };
        slice.port_side(own).map(|_| (number, slice))
    };
    (0..).zip(faces).filter_map(turned).collect()
}

/// The given faces and all that touch them, each once, in order.
pub(crate) fn with_ring(level: &Level, faces: &[FaceId]) -> Vec<FaceId> {
    let topology = level.topology();
    let touching = faces
        .iter()
        .flat_map(|&f| topology.halfedges(f))
        .flat_map(|h| topology.ring(topology.origin(h)))
        .map(|h| topology.face(h).0);
    in_order(topology.face_count(), touching).into_iter().map(FaceId).collect()
}

/// Where this share of all elements is wanted, marks beat sorting.
const DENSE: usize = 64;

/// Numbers below a count, each once, in order.
fn in_order(count: usize, numbers: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut out: Vec<u32> = numbers.collect();
    if out.len() < count / DENSE {
        out.sort_unstable();
        out.dedup();
        return out;
    }
    let mut marked = vec![false; count];
    for &number in &out {
        marked[number as usize] = true;
    }
    out.clear();
    out.extend((0..count as u32).filter(|&number| marked[number as usize]));
    out
}

/// For a number in a list that is in order its place there.
fn numbers(count: usize, list: &[u32]) -> impl Fn(u32) -> u32 + '_ {
    let mut places = Vec::new();
    if list.len() >= count / DENSE {
        places.resize(count, 0);
        for (place, &number) in (0..).zip(list) {
            places[number as usize] = place;
        }
    }
    move |number| match places.get(number as usize) {
        Some(&place) => place,
        None => list.partition_point(|&other| other < number) as u32,
    }
}
