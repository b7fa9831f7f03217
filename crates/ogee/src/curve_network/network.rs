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
    /// Points that the surface is to go through, and normals it is to have there. They need [`NetworkOptions::fair`].
    pub points: Vec<PointConstraint>,
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
    /// Points that the curve is to go through, one per vertex, in place of control points. Between meeting points, where it ends
    /// naturally, it is the spline with its knots there.
    pub through: Option<Vec<Vec3>>,
    /// Normals that the surface is to have where the vertices end up: one per vertex, `None` where any will do; or empty.
    /// They need not be unit vectors. One that leans along the curve is made perpendicular to it.
    pub normals: Vec<Option<Vec3>>,
    /// Normal curvatures that the surface is to have there, across the curve, one over a length: one per vertex, `None`
    /// where any will do; or empty. Positive where the surface bends towards its normal, so that spheres seen from outside
    /// have negative ones.
    pub cross_curvatures: Vec<Option<f64>>,
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
    /// Turn the first legs of curves that meet into one plane, so that the surface is smooth there. This changes the curves;
    /// warnings say by how much.
    pub flatten: bool,
    /// Turn the first legs of a curve that goes through a meeting point until they are opposite, so that it is smooth there.
    /// This changes the curve; warnings say by how much.
    pub straighten: bool,
    /// Make what curves leave open at a meeting point, dummy ports and the free direction at two ports, as long as the mesh
    /// reaches there, and not as long as the curves' legs: for cages with quads much longer than wide.
    pub fit_mesh: bool,
    /// Move all points that the network does not hold to where the surface between the curves bends least: of all that go
    /// through the network's [points](CurveNetwork::points).
    pub fair: bool,
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
            flatten: false,
            straighten: false,
            fit_mesh: false,
            fair: false,
        }
    }
}

impl NetworkOptions {
    /// The scheme of Abbas and Nasri 2004: symmetric X-configurations, all with the parameter `t`.
    ///
    /// Its curves are exact here in any case; without fixed centres, as in the paper, they are where tangents are symmetric.
    pub fn abbas_nasri_2004(t: f64) -> NetworkOptions {
        NetworkOptions { placing: Placing::Symmetric, parameter: Some(t), ..NetworkOptions::default() }
    }

    /// Abbas and Nasri's generalised scheme: parallelograms, and `t = 1/2` everywhere. With three ports or more the surface
    /// need not have a tangent plane there, of which every such meeting point is told.
    pub fn generalised() -> NetworkOptions {
        NetworkOptions { placing: Placing::Parallelogram, parameter: Some(0.5), ..NetworkOptions::default() }
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
    /// Every quad as the mirror image, through the centre, of the one opposite: [`XRing::symmetric`](super::XRing::symmetric).
    Symmetric,
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
    /// Turn first legs into one plane: [`NetworkOptions::flatten`]; `None` as in the rest of the network.
    pub flatten: Option<bool>,
    /// Make the legs of a curve that goes through opposite: [`NetworkOptions::straighten`]; `None` as in the rest of the
    /// network.
    pub straighten: Option<bool>,
    /// Lengths as those of the mesh: [`NetworkOptions::fit_mesh`]; `None` as in the rest of the network.
    pub fit_mesh: Option<bool>,
}

/// What the surface is to do where a vertex of the cage ends up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointConstraint {
    /// The vertex.
    pub vertex: u32,
    /// The point it is to end up at; `None` for any.
    pub position: Option<Vec3>,
    /// The normal of the surface there, not necessarily a unit vector; `None` for any.
    pub normal: Option<Vec3>,
}

impl CurveNetwork {
    /// The choices for the meeting point at a vertex, with those of the whole network filled in.
    pub fn meeting(&self, vertex: u32) -> MeetingOptions {
        let own = self.meetings.get(&vertex).cloned().unwrap_or_default();
        MeetingOptions {
            placing: own.placing.or(Some(self.options.placing)),
            parameter: own.parameter.or(self.options.parameter),
            flatten: own.flatten.or(Some(self.options.flatten)),
            straighten: own.straighten.or(Some(self.options.straighten)),
            fit_mesh: own.fit_mesh.or(Some(self.options.fit_mesh)),
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
