//! `Fan`: the patches around a corner that is smoothed, in counter-clockwise order.

use super::net::view;
use crate::math::{Grid, Vec3};
use crate::mesh::{HalfedgeId, VertexId};
use crate::rules::{Level, Sector};

/// What a corner of a patch is (`docs/methods/pccm.md`, Theory).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerClass {
    /// Nothing is to be done.
    Regular,
    /// Faces all round, 3 or at least 5 of them.
    Interior,
    /// On a crease or boundary that runs through, other than two faces on this side.
    Crease,
    /// Between two sharp edges of a corner, two faces or more.
    Corner,
    /// A crease ends here.
    Dart,
    /// A vertex tagged sharp inside a smooth region: left as inserted, without a tangent plane.
    Cone,
    /// Curves meet: there are caps.
    Meeting,
}

/// The patches of one sector around a vertex; all but regular ones.
///
/// Edge `i` leaves the vertex between patch `i - 1` and patch `i`: it is the row `b = 0` of patch `i` and the column
/// `a = 0` of patch `i - 1`. A closed fan has as many edges as patches, an open one one more.
#[derive(Clone, Debug)]
pub(crate) struct Fan {
    pub(crate) vertex: VertexId,
    pub(crate) class: CornerClass,
    /// The base halfedge that leaves the vertex in each patch.
    pub(crate) halfedges: Vec<HalfedgeId>,
    pub(crate) closed: bool,
    /// True if its smooth edges are made tangent-continuous.
    pub(crate) smoothed: bool,
    /// Cosine of the angle between neighbouring tangents.
    pub(crate) c: f64,
    /// `Q_00`.
    pub(crate) apex: Vec3,
    /// `Q_10` of every edge.
    pub(crate) tangents: Vec<Vec3>,
    /// `Q_20` of every smooth edge, variant SECOND (others zero).
    pub(crate) second: Vec<Vec3>,
}

impl Fan {
    /// The class of a sector at vertex `v` of the base level.
    pub(crate) fn classify(base: &Level, v: VertexId, sector: Sector, sharp_edges: usize) -> CornerClass {
        let tagged = base.vertex_sharpness(v).is_infinite();
        match sharp_edges {
            0 | 1 if tagged => CornerClass::Cone,
            0 if sector.faces == 4 => CornerClass::Regular,
            0 => CornerClass::Interior,
            1 => CornerClass::Dart,
            2 if !tagged && sector.faces == 2 => CornerClass::Regular,
            2 if !tagged => CornerClass::Crease,
            _ if sector.faces == 1 => CornerClass::Regular,
            _ => CornerClass::Corner,
        }
    }

    pub(crate) fn patch(&self, i: usize) -> (usize, usize) {
        let h = self.halfedges[i].index();
        (h / 4, h % 4)
    }

    pub(crate) fn edge_count(&self) -> usize {
        self.halfedges.len() + usize::from(!self.closed)
    }

    /// The edges that are made tangent-continuous.
    pub(crate) fn smooth_edges(&self) -> std::ops::Range<usize> {
        if self.closed { 0..self.halfedges.len() } else { 1..self.halfedges.len() }
    }

    /// True if an alternating part around the fan cannot be met.
    pub(crate) fn is_even(&self) -> bool {
        self.closed && self.halfedges.len().is_multiple_of(2)
    }
}

/// The coefficient arrays of all patches, seen from corners.
#[derive(Clone, Debug)]
pub(crate) struct Arrays {
    /// The last place in both directions.
    pub(crate) last: usize,
    pub(crate) patches: Vec<Grid<Vec3>>,
}

impl Arrays {
    /// What patch `i` of the fan has at `(a, b)` of its own view.
    pub(crate) fn get(&self, fan: &Fan, i: usize, a: usize, b: usize) -> Vec3 {
        let (patch, k) = fan.patch(i);
        self.patches[patch][view(k, a, b, self.last)]
    }

    pub(crate) fn set(&mut self, fan: &Fan, i: usize, a: usize, b: usize, value: Vec3) {
        let (patch, k) = fan.patch(i);
        let at = view(k, a, b, self.last);
        self.patches[patch][at] = value;
    }

    /// Coefficient `s` of the curve of edge `i`.
    pub(crate) fn edge(&self, fan: &Fan, i: usize, s: usize) -> Vec3 {
        if i < fan.halfedges.len() { self.get(fan, i, s, 0) } else { self.get(fan, i - 1, 0, s) }
    }

    /// Writes coefficient `s` of the curve of edge `i` on both of its sides.
    pub(crate) fn set_edge(&mut self, fan: &Fan, i: usize, s: usize, value: Vec3) {
        let n = fan.halfedges.len();
        if i < n {
            self.set(fan, i, s, 0, value);
        }
        if i > 0 || fan.closed {
            self.set(fan, (i + n - 1) % n, 0, s, value);
        }
    }

    /// Moves the second rows beside edge `i`, a smooth one, by the same amount on both sides.
    pub(crate) fn move_second_rows(&mut self, fan: &Fan, i: usize, s: usize, by: Vec3) {
        let before = (i + fan.halfedges.len() - 1) % fan.halfedges.len();
        let (here, there) = (self.get(fan, i, s, 1), self.get(fan, before, 1, s));
        self.set(fan, i, s, 1, here + by);
        self.set(fan, before, 1, s, there + by);
    }
}
