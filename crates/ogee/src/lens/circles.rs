//! Circles: closed rows of vertices around a slit or a pole, and how one leads to the next.

use super::Obstacle;
use super::layout::{irregularity, require_quad};
use crate::mesh::{FaceId, HalfedgeId, Topology, VertexId};

/// A closed row of edges with a face outside each: halfedge `x` runs from vertex `x + 1` to vertex `x`, counter-clockwise as seen
/// from outside the surface, and has that face on its left. On a slit the two sides of an edge are two of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Circle {
    /// The halfedges by column.
    pub halfedges: Vec<HalfedgeId>,
}

impl Circle {
    /// Both sides of a path of edges, one after the other. Column `x` stands at path vertex `min(x, 2 m - x)` for a path of `m`
    /// edges. `None` if an edge lies on the boundary.
    pub(super) fn around_slit(topology: &Topology, path: &[HalfedgeId]) -> Option<Circle> {
        let mut halfedges: Vec<HalfedgeId> = path.iter().map(|&h| topology.twin(h)).collect::<Option<_>>()?;
        halfedges.extend(path.iter().rev());
        Some(Circle { halfedges })
    }

    /// The outer edges of the triangles around a vertex. `None` if one of them lies on the boundary.
    pub(super) fn around_pole(topology: &Topology, pole: VertexId) -> Option<Circle> {
        let halfedges = topology.ring(pole).map(|spoke| topology.twin(topology.next(spoke)));
        Some(Circle { halfedges: halfedges.collect::<Option<_>>()? })
    }

    /// Number of columns.
    pub fn len(&self) -> usize {
        self.halfedges.len()
    }

    /// True if there is no column.
    pub fn is_empty(&self) -> bool {
        self.halfedges.is_empty()
    }

    /// The vertices by column.
    pub fn vertices(&self, topology: &Topology) -> Vec<VertexId> {
        self.halfedges.iter().map(|&h| topology.target(h)).collect()
    }

    /// The faces outside the circle by column: face `x` lies between the columns `x` and `x + 1`.
    pub fn faces(&self, topology: &Topology) -> Vec<FaceId> {
        self.halfedges.iter().map(|&h| topology.face(h)).collect()
    }

    /// The vertices of the next circle by column, if the faces between are quads that follow one another. `layer` is that of
    /// those faces and vertices.
    ///
    /// # Errors
    /// What is in the way.
    pub fn next_vertices(&self, topology: &Topology, layer: u32) -> Result<Vec<VertexId>, Obstacle> {
        let columns = self.len();
        for &h in &self.halfedges {
            require_quad(topology, h, layer)?;
        }
        for x in 0..columns {
            let rung = topology.next(self.halfedges[x]);
            let before = topology.prev(self.halfedges[(x + columns - 1) % columns]);
            if topology.twin(rung) != Some(before) {
                let vertex = topology.origin(rung);
                let irregular = irregularity(topology, vertex, layer - 1);
                return Err(irregular.unwrap_or(Obstacle::Boundary { vertex, layer: layer - 1 }));
            }
        }
        Ok(self.halfedges.iter().map(|&h| topology.target(topology.next(h))).collect())
    }

    /// The next circle: that of [`Circle::next_vertices`], all of them inner vertices of valence 4.
    ///
    /// # Errors
    /// What is in the way.
    pub fn next(&self, topology: &Topology, layer: u32) -> Result<Circle, Obstacle> {
        let vertices = self.next_vertices(topology, layer)?;
        if let Some(obstacle) = vertices.iter().find_map(|&v| irregularity(topology, v, layer)) {
            return Err(obstacle);
        }
        let outward = |&h: &HalfedgeId| topology.twin(topology.next(topology.next(h)));
        let boundary = Obstacle::Boundary { vertex: vertices[0], layer };
        let halfedges = self.halfedges.iter().map(outward).collect::<Option<_>>().ok_or(boundary)?;
        Ok(Circle { halfedges })
    }
}

/// What a polar cap is made of: the three circles around a slit or a pole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PolarNeighbourhood {
    /// The circles from inside to outside: vertices by column, counter-clockwise, all three aligned.
    pub circles: [Vec<VertexId>; 3],
    /// The faces inside the second circle, which the cap stands in for: those at the slit or pole by column, then the next row.
    /// At a slit face `x` of a row lies between the columns `x` and `x + 1`; at a pole so does triangle `x`.
    pub disk: Vec<FaceId>,
}

impl PolarNeighbourhood {
    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.circles[0].len()
    }
}
