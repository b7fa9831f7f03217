//! What is wanted of a surface, as rows of a linear system over the points of its cage.

use super::energy::{joined, knows};
use super::fair::FairingError;
use crate::limit::Derivatives;
use crate::math::Vec3;
use crate::mesh::VertexId;
use crate::patch::PatchTable;
use crate::rules::Level;
use crate::stencil::StencilTable;

/// Something the surface, or its cage, is to have.
#[derive(Clone, Debug, PartialEq)]
pub enum Constraint {
    /// A vertex of the cage ends up at this point.
    Position {
        /// The vertex.
        vertex: u32,
        /// Where its limit is to be.
        at: Vec3,
    },
    /// The surface has this normal, up to sign, where a vertex of the cage ends up.
    Normal {
        /// The vertex.
        vertex: u32,
        /// Any length but zero.
        normal: Vec3,
    },
    /// A weighted sum of points of the cage is this point.
    Sum {
        /// What messages name.
        vertex: u32,
        /// Vertices and their weights.
        terms: Vec<(u32, f64)>,
        /// The sum.
        value: Vec3,
    },
}

impl Constraint {
    /// The vertex it is about.
    pub fn vertex(&self) -> u32 {
        match *self {
            Constraint::Position { vertex, .. }
            | Constraint::Normal { vertex, .. }
            | Constraint::Sum { vertex, .. } => vertex,
        }
    }

    /// What messages call it.
    pub fn what(&self) -> &'static str {
        match self {
            Constraint::Position { .. } => "the point wanted",
            Constraint::Normal { .. } => "the normal wanted",
            Constraint::Sum { .. } => "the control point of a curve",
        }
    }
}

/// A row over coordinates: `3 v + c` is coordinate `c` of vertex `v`. As a vector its weights have length one.
pub(super) struct Row {
    /// Number of the constraint.
    pub(super) constraint: usize,
    pub(super) terms: Vec<(u32, f64)>,
    pub(super) value: f64,
}

/// The rows of all constraints: three for a point, two for a normal.
pub(super) fn rows(level: &Level, constraints: &[Constraint]) -> Result<Vec<Row>, FairingError> {
    let topology = level.topology();
    let table = PatchTable::new(level);
    let mut out = Vec::new();
    for (constraint, wanted) in constraints.iter().enumerate() {
        let vertex = wanted.vertex();
        if !knows(topology, vertex) {
            return Err(FairingError::MissingVertex { vertex, count: topology.vertex_count() });
        }
        let on_surface = |what: Derivatives| {
            let at =
                table.locate_vertex(topology, VertexId(vertex)).ok_or(FairingError::NoSurface { vertex })?;
            Ok::<StencilTable, FairingError>(table.stencils(&[at], what))
        };
        let mut push = |terms: Vec<(u32, f64)>, value: f64| {
            let length = terms.iter().map(|term| term.1 * term.1).sum::<f64>().sqrt();
            if length > 0.0 && length.is_finite() && value.is_finite() {
                let terms = terms.into_iter().map(|(source, weight)| (source, weight / length)).collect();
                out.push(Row { constraint, terms, value: value / length });
                Ok(())
            } else {
                Err(FairingError::NoSurface { vertex })
            }
        };
        let mut point = |terms: Vec<(u32, f64)>, value: Vec3| {
            <[f64; 3]>::from(value).into_iter().zip(0..).try_for_each(|(value, c)| {
                push(terms.iter().map(|&(v, weight)| (3 * v + c, weight)).collect(), value)
            })
        };
        match wanted {
            Constraint::Position { at, .. } => {
                point(on_surface(Derivatives::None)?.row(0).collect(), *at)?;
            }
            Constraint::Sum { terms, value, .. } => {
                if let Some(&(vertex, _)) = terms.iter().find(|term| !knows(topology, term.0)) {
                    return Err(FairingError::MissingVertex { vertex, count: topology.vertex_count() });
                }
                point(joined(terms.clone()), *value)?;
            }
            Constraint::Normal { normal, .. } => {
                let unit = normal.normalized().ok_or(FairingError::NoSurface { vertex })?;
                let stencils = on_surface(Derivatives::First)?;
                for tangent in [1, 2] {
                    let weights = stencils.row(tangent);
                    let terms = weights.flat_map(|(v, weight)| {
                        let coordinates = <[f64; 3]>::from(unit);
                        [0, 1, 2].map(|c| (3 * v + c, weight * coordinates[c as usize]))
                    });
                    // A coordinate that the normal has none of is no part of the row.
                    push(terms.filter(|term| term.1 != 0.0).collect(), 0.0)?;
                }
            }
        }
    }
    Ok(out)
}
