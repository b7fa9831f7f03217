//! Splits of a cage before a network is laid: curves keep their shape, meeting points move apart.

use super::defect::{NetworkDefect, NetworkError};
use super::plan::{NetworkPlan, Segment};
use crate::mesh::{ControlMesh, FaceVarying, VertexId};
use crate::rules::Level;

impl NetworkPlan {
    /// The cage after the plan's splits, and the plan for it, which asks for no more. Vertices keep their numbers, so
    /// meeting points do; paths take in the points of their edges, and curves are the same curves, refined. Tags fade as
    /// refinement says, and texture coordinates go along.
    ///
    /// # Errors
    /// If the cage is not the one of the plan, or there would be too many faces.
    pub fn split(&self, mesh: &ControlMesh) -> Result<(ControlMesh, NetworkPlan), NetworkError> {
        let refuse = |defects| NetworkError { defects };
        let mut level = Level::new(mesh)
            .map_err(|error| refuse(error.defects.into_iter().map(NetworkDefect::Mesh).collect()))?;
        level.check_depth(self.pre_split, u64::MAX).map_err(|_| {
            let (what, value) = ("the number of splits".into(), f64::from(self.pre_split));
            refuse(vec![NetworkDefect::Parameter { what, value, remedy: "choose fewer" }])
        })?;
        let mut points = mesh.points.clone();
        let mut texture = mesh.uv.as_ref().map(|uv| level.face_varying(uv));
        let mut plan = NetworkPlan { pre_split: 0, ..self.clone() };
        for _ in 0..self.pre_split {
            plan.segments = plan.segments.iter().map(|segment| refined(segment, &level)).collect();
            (level, points) = level.refine_points(&points);
            texture = texture.map(|(level, values)| level.refine_points(&values));
        }
        if self.pre_split == 0 {
            return Ok((mesh.clone(), plan));
        }
        let mut cage = level.to_cage(points);
        let rule = mesh.uv.as_ref().map(|uv| uv.rule).unwrap_or_default();
        cage.uv = texture.map(|(level, values)| {
            let indices = level.topology().origin.to_vec();
            FaceVarying { values, indices, rule }
        });
        Ok((cage, plan))
    }
}

/// The same segment on the next level.
fn refined(segment: &Segment, level: &Level) -> Segment {
    let topology = level.topology();
    let first_edge_point = (topology.vertex_count() + topology.face_count()) as u32;
    let target = segment.target.refined();
    let path = &segment.vertices;
    let vertices = (0..target.control().len()).map(|i| {
        let (from, to) = (path[i / 2], path[(i / 2 + 1) % path.len()]);
        if i % 2 == 0 {
            return from;
        }
        let edge = super::incidence::edge_between(topology, VertexId(from), VertexId(to));
        edge.map_or(from, |edge| first_edge_point + edge.0)
    });
    Segment { vertices: vertices.collect(), target, ..segment.clone() }
}
