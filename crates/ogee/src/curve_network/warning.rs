//! What a network is told about that is no error: the surface is made, but is not all that was hoped for.

/// Something about a network that the user should know. Vertices are those of the cage after splits and repair, which keeps
/// the numbers of the one that was given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum NetworkWarning {
    #[error(
        "the tangents of the curves at vertex {vertex} leave their common plane by up to {angle_deg:.3} degrees, so the \
         surface has a point or crease there; turn the first control points into one plane"
    )]
    TangentsNotCoplanar { vertex: u32, angle_deg: f64 },
    #[error(
        "the curves leave vertex {vertex} in another order than its edges do: they turn by {turn_deg:.1} degrees in all, \
         not 360, and the surface folds; let each curve leave along the edge that lies in its direction"
    )]
    TangentOrder { vertex: u32, turn_deg: f64 },
    #[error(
        "the surface is expected to fold at vertex {vertex} (smallest sine {sine:.4}); spread the curves' directions, make \
         their first legs more alike, or let the parameter t be chosen"
    )]
    XFold { vertex: u32, sine: f64 },
    #[error(
        "the quads around two meeting points share vertex {vertex}; curves are exact, the surface is less smooth; allow \
         one more split before the network is laid"
    )]
    XOverlap { vertex: u32 },
    #[error(
        "curve {curve} has a kink of {angle_deg:.3} degrees where it meets others at vertex {vertex}; make its two legs \
         there parallel to carry it through smoothly"
    )]
    CarryKink { vertex: u32, curve: String, angle_deg: f64 },
    #[error(
        "the parameter t = {t} at vertex {vertex} is degenerate for {ports} ports: the surface need not have a tangent \
         plane there; choose less than 1/2"
    )]
    THalf { vertex: u32, ports: usize, t: f64 },
    #[error(
        "the end of curve {curve} at border vertex {vertex} was moved by {distance:.6} onto the curve along the border; \
         begin the curve there to keep it"
    )]
    RimEndMoved { vertex: u32, curve: String, distance: f64 },
    #[error(
        "the normal wanted at vertex {vertex} leans along curve {curve} by {angle_deg:.3} degrees and was made perpendicular \
         to it"
    )]
    NormalTilted { vertex: u32, curve: String, angle_deg: f64 },
    #[error(
        "the normal wanted at vertex {vertex} of curve {curve} is missed by {angle_deg:.3} degrees: other curves decide it \
         there; allow more splits, or want none"
    )]
    NormalMissed { vertex: u32, curve: String, angle_deg: f64 },
    #[error(
        "the cross curvature wanted at vertex {vertex} of curve {curve} is missed by {difference:.6}: other curves decide it \
         there; allow more splits, or want none"
    )]
    CrossCurvatureMissed { vertex: u32, curve: String, difference: f64 },
    #[error(
        "curve {curve} was turned by {angle_deg:.3} degrees where it leaves vertex {vertex}, into the plane of the others"
    )]
    Flattened { vertex: u32, curve: String, angle_deg: f64 },
    #[error(
        "a kink of {angle_deg:.3} degrees of curve {curve} at vertex {vertex} was taken away: both legs were turned by half \
         of it or so"
    )]
    Straightened { vertex: u32, curve: String, angle_deg: f64 },
    #[error(
        "curve {curve} ends on the border at vertex {vertex}, where the border goes on: beside its end the border is \
         another curve; make the vertex sharp, or the curves one"
    )]
    BorderEnd { vertex: u32, curve: String },
    #[error("there are choices for vertex {vertex}, but no curves meet there; take them away")]
    NoMeeting { vertex: u32 },
    #[error(
        "a ring mirrored through vertex {vertex} was asked for, but the curves there are not: ports are off by \
         {distance:.6}; place it otherwise"
    )]
    NotSymmetric { vertex: u32, distance: f64 },
    #[error(
        "the surface has the normal wanted at vertex {vertex} with the other sign; look at what is wanted around it"
    )]
    NormalTurnedOver { vertex: u32 },
    #[error("{what} at vertex {vertex} follows from the rest; it may be left out")]
    ConstraintRedundant { vertex: u32, what: String },
    #[error(
        "texture coordinates were left behind where the mesh was changed beside curves, first at vertex {vertex}; allow no \
         repair, or map again"
    )]
    UvDropped { vertex: u32 },
}

impl NetworkWarning {
    /// A stable name.
    pub fn code(&self) -> &'static str {
        match self {
            NetworkWarning::TangentsNotCoplanar { .. } => "W_TANGENTS_NOT_COPLANAR",
            NetworkWarning::TangentOrder { .. } => "W_TANGENT_ORDER",
            NetworkWarning::XFold { .. } => "W_X_FOLD",
            NetworkWarning::XOverlap { .. } => "W_X_OVERLAP",
            NetworkWarning::CarryKink { .. } => "W_CARRY_KINK",
            NetworkWarning::THalf { .. } => "W_T_HALF",
            NetworkWarning::RimEndMoved { .. } => "W_RIM_END_MOVED",
            NetworkWarning::NormalTilted { .. } => "W_NORMAL_TILTED",
            NetworkWarning::NormalMissed { .. } => "W_NORMAL_MISSED",
            NetworkWarning::CrossCurvatureMissed { .. } => "W_CROSS_CURVATURE_MISSED",
            NetworkWarning::Flattened { .. } => "W_FLATTENED",
            NetworkWarning::Straightened { .. } => "W_STRAIGHTENED",
            NetworkWarning::BorderEnd { .. } => "W_BORDER_END",
            NetworkWarning::NoMeeting { .. } => "W_NO_MEETING",
            NetworkWarning::NotSymmetric { .. } => "W_NOT_SYMMETRIC",
            NetworkWarning::NormalTurnedOver { .. } => "W_NORMAL_TURNED_OVER",
            NetworkWarning::ConstraintRedundant { .. } => "W_CONSTRAINT_REDUNDANT",
            NetworkWarning::UvDropped { .. } => "W_UV_DROPPED",
        }
    }

    /// Where.
    pub fn vertex(&self) -> u32 {
        match *self {
            NetworkWarning::TangentsNotCoplanar { vertex, .. }
            | NetworkWarning::TangentOrder { vertex, .. }
            | NetworkWarning::XFold { vertex, .. }
            | NetworkWarning::XOverlap { vertex }
            | NetworkWarning::CarryKink { vertex, .. }
            | NetworkWarning::THalf { vertex, .. }
            | NetworkWarning::RimEndMoved { vertex, .. }
            | NetworkWarning::NormalTilted { vertex, .. }
            | NetworkWarning::NormalMissed { vertex, .. }
            | NetworkWarning::CrossCurvatureMissed { vertex, .. }
            | NetworkWarning::Flattened { vertex, .. }
            | NetworkWarning::Straightened { vertex, .. }
            | NetworkWarning::BorderEnd { vertex, .. }
            | NetworkWarning::NoMeeting { vertex }
            | NetworkWarning::NotSymmetric { vertex, .. }
            | NetworkWarning::NormalTurnedOver { vertex }
            | NetworkWarning::ConstraintRedundant { vertex, .. }
            | NetworkWarning::UvDropped { vertex } => vertex,
        }
    }

    /// How much: an angle in degrees, a sine, a length, a curvature, or `t`; `None` where there is nothing to measure.
    pub fn value(&self) -> Option<f64> {
        match *self {
            NetworkWarning::TangentsNotCoplanar { angle_deg, .. }
            | NetworkWarning::NormalTilted { angle_deg, .. }
            | NetworkWarning::NormalMissed { angle_deg, .. }
            | NetworkWarning::Flattened { angle_deg, .. }
            | NetworkWarning::Straightened { angle_deg, .. }
            | NetworkWarning::CarryKink { angle_deg, .. } => Some(angle_deg),
            NetworkWarning::TangentOrder { turn_deg, .. } => Some(turn_deg),
            NetworkWarning::XFold { sine, .. } => Some(sine),
            NetworkWarning::XOverlap { .. }
            | NetworkWarning::BorderEnd { .. }
            | NetworkWarning::NoMeeting { .. }
            | NetworkWarning::NormalTurnedOver { .. }
            | NetworkWarning::ConstraintRedundant { .. }
            | NetworkWarning::UvDropped { .. } => None,
            NetworkWarning::CrossCurvatureMissed { difference, .. } => Some(difference),
            NetworkWarning::THalf { t, .. } => Some(t),
            NetworkWarning::RimEndMoved { distance, .. } | NetworkWarning::NotSymmetric { distance, .. } => {
                Some(distance)
            }
        }
    }
}
