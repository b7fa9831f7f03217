//! `Row`: the weights of one mask while they are being gathered.

use crate::mesh::{FaceId, VertexId};

/// The weights of one mask.
///
/// Masks speak of vertices and of face points, as the papers do; [`Row::expand_face_points`] replaces each face
/// point by its own mask, after which only vertices are left.
#[derive(Clone, Debug, Default)]
pub struct Row {
    vertices: Vec<(u32, f64)>,
    faces: Vec<(u32, f64)>,
}

impl Row {
    /// An empty row.
    pub fn new() -> Row {
        Row::default()
    }

    /// An empty row with room for so many weights on vertices.
    pub(crate) fn with_capacity(count: usize) -> Row {
        Row { vertices: Vec::with_capacity(count), faces: Vec::with_capacity(count / 4) }
    }

    /// Forgets all weights; keeps the memory.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.faces.clear();
    }

    /// Adds weight on a vertex.
    #[inline]
    pub fn add(&mut self, v: VertexId, weight: f64) {
        self.vertices.push((v.0, weight));
    }

    /// Adds weight on the face point of a face.
    #[inline]
    pub fn add_face_point(&mut self, f: FaceId, weight: f64) {
        self.faces.push((f.0, weight));
    }

    /// Replaces every face point by its mask, then joins weights on the same vertex. Sources end up in the order
    /// of their numbers.
    pub fn expand_face_points(&mut self, mut mask: impl FnMut(FaceId, f64, &mut Row)) {
        let mut faces = std::mem::take(&mut self.faces);
        for &(f, weight) in &faces {
            mask(FaceId(f), weight, self);
        }
        debug_assert!(self.faces.is_empty(), "the mask of a face point names vertices only");
        faces.clear();
        self.faces = faces;
        join(&mut self.vertices);
    }

    /// Weights on vertices and on face points as the masks named them.
    pub(crate) fn terms(&self) -> [&[(u32, f64)]; 2] {
        [&self.vertices, &self.faces]
    }

    /// The weights on vertices, in the order of their numbers once face points are expanded.
    pub fn weights(&self) -> &[(u32, f64)] {
        debug_assert!(self.faces.is_empty(), "face points are to be expanded first");
        &self.vertices
    }
}

/// Sorts weights by source, and sums those on the same source.
pub(crate) fn join(weights: &mut Vec<(u32, f64)>) {
    if weights.is_sorted_by(|a, b| a.0 < b.0) {
        return;
    }
    // Stable: equal sources are summed in the order in which they were named.
    weights.sort_by_key(|&(source, _)| source);
    weights.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
}
