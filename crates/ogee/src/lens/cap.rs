//! `Cap`: polynomial faces that stand in for faces of a cage, and how they are joined to it and to each other.

use crate::math::{Grid, Vec3};
use crate::mesh::VertexId;
use crate::nurbs::{FaceAddress, NurbsSurface, Side};

/// Faces that together replace a disk of faces of a cage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cap {
    /// The faces.
    pub faces: Vec<CapFace>,
    /// Positions of the vertices that the cap does not share with the cage.
    pub points: Vec<Vec3>,
}

/// One face of a cap.
#[derive(Clone, Debug, PartialEq)]
pub struct CapFace {
    /// The surface; `du x dv` points as the cage's faces do.
    pub surface: NurbsSurface,
    /// Its boundary, counter-clockwise, beginning at `(0, 0)` along `v = 0`: pieces of sides between two vertices, more than one
    /// on a side where a neighbour's corner stands in its middle (a T). A side that is a single point has none.
    pub boundary: Vec<CapEdge>,
    /// The faces of the cage in whose place it stands, as far as that can be said.
    pub pieces: Grid<FaceAddress>,
}

/// A piece of a side of a face of a cap. Two pieces between the same two vertices are the same edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapEdge {
    /// The side that it lies on.
    pub side: Side,
    /// Where it begins, in the direction of the loop.
    pub from: CapVertex,
    /// Where it ends.
    pub to: CapVertex,
    /// The surface's parameter along that side at its ends: increasing on the sides `V0` and `U1`, decreasing on `V1` and
    /// `U0`.
    pub range: [f64; 2],
}

/// A vertex of a cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CapVertex {
    /// The limit point of a vertex of the cage, regular, with the cage's own surface on the other side. Two of them next to each
    /// other in a boundary are the ends of an edge of the cage.
    Cage(VertexId),
    /// A point of [`Cap::points`].
    Own(u32),
}
