//! `CurveNetwork`: the curves a surface is to contain, as plain data over a cage. Nothing is promised about it until
//! [`NetworkPlan::new`](super::NetworkPlan::new) has looked at it.

use crate::math::Vec3;
use std::collections::BTreeMap;

/// Curves along edges of a cage, and how to lay them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveNetwork {
    /// The curves.
    pub curves: Vec<NetworkCurve>,
    /// Choices for all of them.
    pub options: NetworkOptions,
    /// Choices for single meeting points, by vertex of the cage.
    pub meetings: BTreeMap<u32, MeetingOptions>,
}

/// A curve: a path of edges, and the control points that the curve of the surface is to have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetworkCurve {
    /// What messages call it.
    pub name: String,
    /// Vertices of the cage, each joined to the next by an edge. None twice, not even to close the curve.
    pub vertices: Vec<u32>,
    /// True if an edge leads from the last vertex back to the first.
    pub closed: bool,
    /// One control point per vertex; `None` for the vertices' own positions.
    pub control: Option<Vec<Vec3>>,
}

/// Choices for a whole network.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkOptions {
    /// How X-configurations are placed.
    pub placing: Placing,
    /// The parameter `t` of all X-configurations, above 0 and at most 1/2; `None` to choose it at each.
    pub parameter: Option<f64>,
    /// Splits of the cage before the network is laid.
    pub pre_split: PreSplit,
    /// What happens where two curves cross.
    pub crossing: Crossing,
    /// Change the mesh beside all curves, so that quads of like width run along them.
    pub force_ribbons: bool,
    /// Width of such quads, as a part of the faces they are cut from: above 0 and below 1. Narrow ones pull the surface's
    /// curvature to the curve.
    pub ribbon_width: f64,
    /// Whether the mesh beside the curves may be changed where it has to be.
    pub repair: bool,
}

impl Default for NetworkOptions {
    fn default() -> NetworkOptions {
        NetworkOptions {
            placing: Placing::default(),
            parameter: None,
            pre_split: PreSplit::default(),
            crossing: Crossing::default(),
            force_ribbons: false,
            ribbon_width: 0.5,
            repair: true,
        }
    }
}

/// How the free points of an X-configuration are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Placing {
    /// So that refinement only halves it, which settles normals fastest: [`XRing::eigen`](super::XRing::eigen).
    #[default]
    Eigen,
    /// As parallelograms of the tangents: [`XRing::parallelogram`](super::XRing::parallelogram).
    Parallelogram,
    /// They stay where they are.
    Keep,
}

/// Splits of the cage before the network is laid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PreSplit {
    /// As many as meeting points need to keep out of each other's way.
    #[default]
    Auto,
    /// So many.
    Fixed(u32),
}

/// What happens at a vertex where two curves cross.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Crossing {
    /// Both pass through the control point, as four curves that end there.
    #[default]
    Pin,
    /// Both pass through the mean of their limits, and nothing is special about the vertex. It must be regular.
    Smooth,
}

/// Choices for one meeting point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeetingOptions {
    /// How its X-configuration is placed; `None` as in the rest of the network.
    pub placing: Option<Placing>,
    /// Its parameter `t`, above 0 and at most 1/2; `None` as in the rest of the network.
    pub parameter: Option<f64>,
    /// Normal of the surface there; `None` for that of the curves' tangents.
    pub normal: Option<Vec3>,
    /// How far free spokes are lifted along the normal, a length: it bends the surface between the curves.
    pub crown: f64,
}

impl CurveNetwork {
    /// The choices for the meeting point at a vertex, with those of the whole network filled in.
    pub fn meeting(&self, vertex: u32) -> MeetingOptions {
        let own = self.meetings.get(&vertex).cloned().unwrap_or_default();
        MeetingOptions {
            placing: own.placing.or(Some(self.options.placing)),
            parameter: own.parameter.or(self.options.parameter),
            ..own
        }
    }
}

impl NetworkCurve {
    /// The edges of the path, as pairs of vertices.
    pub fn legs(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let back = self.closed.then(|| Some([*self.vertices.last()?, *self.vertices.first()?])).flatten();
        self.vertices.windows(2).map(|pair| [pair[0], pair[1]]).chain(back)
    }

    /// The control points that the curve is to have, before other curves have their say.
    ///
    /// # Panics
    /// If it names a vertex that the points do not have and has no control points of its own.
    pub fn target(&self, points: &[Vec3]) -> Vec<Vec3> {
        match &self.control {
            Some(control) => control.clone(),
            None => self.vertices.iter().map(|&v| points[v as usize]).collect(),
        }
    }
}
