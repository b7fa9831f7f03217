//! What is around the irregular vertices of curvature-continuous parts, in reports.

use ogee::convert::{Node, NodeKind};
use ogee::g2_caps::{self, CapClass, CornerAngle};
use serde::Serialize;

use crate::error::Where;

/// An irregular vertex, for programs.
#[derive(Serialize)]
pub(crate) struct NodeReport {
    #[serde(rename = "where")]
    place: Where,
    kind: &'static str,
    faces: Option<usize>,
    degree: usize,
    level: u32,
    deviation: f64,
    /// Of a cap: the least length of `du x dv`, relative to the greatest.
    regularity: Option<f64>,
}

impl NodeReport {
    pub(crate) fn new(node: &Node) -> NodeReport {
        let (kind, faces, degree) = match node.kind {
            NodeKind::Cap(class) => (kind(class), Some(class.sectors()), g2_caps::DEGREE),
            NodeKind::Smoothed => ("pccm", None, 3),
        };
        let Node { level, deviation, regularity, .. } = *node;
        NodeReport {
            place: Where { place: Some(node.place), ..Where::default() },
            kind,
            faces,
            degree,
            level,
            deviation,
            regularity,
        }
    }

    pub(crate) fn is_cap(&self) -> bool {
        self.degree == g2_caps::DEGREE
    }
}

fn kind(class: CapClass) -> &'static str {
    match class {
        CapClass::Interior { .. } => "interior",
        CapClass::Boundary { .. } => "boundary",
        CapClass::Corner { angle: CornerAngle::Convex, .. } => "convex_corner",
        CapClass::Corner { angle: CornerAngle::Concave, .. } => "concave_corner",
        CapClass::Dart { .. } => "dart",
    }
}
