//! The surface between the curves of a network, made fair: it goes through the network's points, and keeps its curves.

use super::defect::{NetworkDefect, NetworkError};
use super::network::CurveNetwork;
use super::plan::NetworkPlan;
use super::warning::NetworkWarning;
use crate::fairing::{Constraint, FairingError, FairingOptions, fair};
use crate::math::Vec3;
use crate::mesh::{ControlMesh, Topology, VertexId};
use std::collections::BTreeSet;

/// The points of the fairest cage with the network in it. X-configurations, `decided`, stay, and so do the border and the
/// rows along curves that want normals or cross curvatures; along other curves equation (1) holds.
pub(super) fn faired(
    room: &ControlMesh,
    network: &CurveNetwork,
    plan: &NetworkPlan,
    sides: &[Vec<[u32; 2]>],
    decided: &[u32],
    warnings: &mut Vec<NetworkWarning>,
) -> Result<Vec<Vec3>, NetworkError> {
    let refuse = |defect| NetworkError { defects: vec![defect] };
    let topology = Topology::new(room).map_err(|error| NetworkError {
        defects: error.defects.into_iter().map(NetworkDefect::Mesh).collect(),
    })?;
    let border = (0..room.points.len() as u32).filter(|&v| topology.is_boundary(VertexId(v)));
    let mut fixed: BTreeSet<u32> = decided.iter().copied().chain(border).collect();
    let mut constraints = Vec::new();
    for (segment, sides) in plan.segments.iter().zip(sides) {
        let curve = &network.curves[segment.curve];
        let is_shaped =
            curve.normals.iter().any(Option::is_some) || curve.cross_curvatures.iter().any(Option::is_some);
        let last = segment.vertices.len() - 1;
        for (i, (&v, &[left, right])) in segment.vertices.iter().zip(sides).enumerate() {
            if is_shaped {
                fixed.extend([v, left, right]);
            } else if !((i == 0 && segment.meets[0]) || (i == last && segment.meets[1])) {
                let terms = vec![(left, 1.0), (v, 4.0), (right, 1.0)];
                constraints.push(Constraint::Sum {
                    vertex: v,
                    terms,
                    value: 6.0 * segment.target.control()[i],
                });
            }
        }
    }
    let rows_of_curves = constraints.len();
    for point in &network.points {
        let vertex = point.vertex;
        constraints.extend(point.position.map(|at| Constraint::Position { vertex, at }));
        constraints.extend(point.normal.map(|normal| Constraint::Normal { vertex, normal }));
    }
    let options = FairingOptions { fixed: fixed.into_iter().collect(), ..FairingOptions::default() };
    let result = fair(room, &constraints, &options).map_err(|error| match error {
        FairingError::Mesh(defects) => {
            NetworkError { defects: defects.into_iter().map(NetworkDefect::Mesh).collect() }
        }
        FairingError::Contradiction { vertex, what, residual, .. } => {
            refuse(NetworkDefect::Contradiction { vertex, what: what.to_owned(), residual })
        }
        FairingError::MissingVertex { vertex, .. } | FairingError::NoSurface { vertex } => {
            refuse(NetworkDefect::ConstraintNotFinite { what: "something", vertex })
        }
        FairingError::NoSolution { residual } => refuse(NetworkDefect::Fairing { residual }),
        FairingError::Splits { .. } => refuse(NetworkDefect::Fairing { residual: f64::INFINITY }),
    })?;
    // That rows of curves follow from one another is no news.
    for &number in result.redundant.iter().filter(|&&number| number >= rows_of_curves) {
        let (vertex, what) = (constraints[number].vertex(), constraints[number].what().to_owned());
        warnings.push(NetworkWarning::ConstraintRedundant { vertex, what });
    }
    for &number in &result.turned_over {
        warnings.push(NetworkWarning::NormalTurnedOver { vertex: constraints[number].vertex() });
    }
    Ok(result.points)
}
