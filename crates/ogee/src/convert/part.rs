//! `Part`: what is exported, with the figures that prove it.

use crate::g2_caps::CapClass;
use crate::lens::TreatedLens;
use crate::math::Vec3;
use crate::mesh::{Note, Place};
use crate::nurbs::Shell;

/// Solids and sheets, and the report of their making.
#[derive(Clone, Debug)]
pub struct Part {
    /// The bodies, in the order of their first cage face.
    pub bodies: Vec<Body>,
    /// The figures.
    pub report: Report,
}

/// A connected piece of a part.
#[derive(Clone, Debug)]
pub enum Body {
    /// A closed shell and the closed shells inside it. All are oriented outward as closed shells of their own:
    /// a void's normals point away from the void, into the material.
    Solid {
        /// The outer shell.
        outer: Shell,
        /// Hollows.
        voids: Vec<Shell>,
    },
    /// An open shell.
    Sheet(Shell),
}

impl Body {
    /// All shells of this body, the outer one first.
    pub fn shells(&self) -> impl Iterator<Item = &Shell> + '_ {
        let (first, voids): (&Shell, &[Shell]) = match self {
            Body::Solid { outer, voids } => (outer, voids),
            Body::Sheet(shell) => (shell, &[]),
        };
        std::iter::once(first).chain(voids)
    }

    pub(super) fn shells_mut(&mut self) -> impl Iterator<Item = &mut Shell> + '_ {
        let (first, voids): (&mut Shell, &mut [Shell]) = match self {
            Body::Solid { outer, voids } => (outer, voids),
            Body::Sheet(shell) => (shell, &mut []),
        };
        std::iter::once(first).chain(voids)
    }
}

/// The construction that makes patches from a cage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// PCCM, quadratic boundary in the second cell: bicubic, tangent-continuous. The default.
    #[default]
    Pccm,
    /// PCCM as in the slides, quadratic boundary in the first cell.
    PccmFirst,
    /// One bi-quintic Bezier patch per quad; closed cages without creases.
    Bi5,
    /// G2 caps around irregular vertices: curvature-continuous everywhere.
    G2,
}

impl Method {
    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Method::Pccm => "pccm",
            Method::PccmFirst => "pccm-first",
            Method::Bi5 => "bi5",
            Method::G2 => "g2",
        }
    }
}

/// An irregular vertex of a part that is curvature-continuous.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// The vertex of the cage, or the polygon whose middle it is.
    pub place: Place,
    /// What is around it.
    pub kind: NodeKind,
    /// Refinements before that.
    pub level: u32,
    /// Largest distance of sampled points of the limit surface there.
    pub deviation: f64,
    /// Of a cap the least length of `du x dv`, relative to the greatest: small where the cage is nearly folded.
    pub regularity: Option<f64>,
}

/// What is around an irregular vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// A G2 cap of degree 7.
    Cap(CapClass),
    /// Patches of PCCM: tangent-continuous. A note says why.
    Smoothed,
}

/// How many faces were converted on a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelFaces {
    /// 0 for faces of the cage, 1 for those of its refinement, and so on.
    pub steps: u32,
    /// Refinements of each of these faces before the conversion.
    pub level: u32,
    /// How many they are, hidden ones left out.
    pub faces: usize,
}

/// The figures of a conversion. Lengths are in the unit of the cage.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The construction.
    pub method: Method,
    /// Refinements before the conversion, the most of all faces.
    pub level: u32,
    /// How many faces were refined how often before the conversion; by steps, then by level.
    pub faces_by_level: Vec<LevelFaces>,
    /// Faces of the cage.
    pub cage_faces: usize,
    /// Patches before packing: one per visible quad that was converted.
    pub patches: usize,
    /// Faces in the part.
    pub faces_written: usize,
    /// Edges in the part.
    pub edges: usize,
    /// Vertices in the part.
    pub vertices: usize,
    /// Solids.
    pub solids: usize,
    /// Shells, voids and sheets included.
    pub shells: usize,
    /// True if every shell is closed.
    pub closed: bool,
    /// Enclosed volume, exact for the patches; `None` unless all is closed.
    pub volume: Option<f64>,
    /// Surface area.
    pub area: f64,
    /// Bounding box of the surface, `[least, greatest]`.
    pub bounding_box: [Vec3; 2],
    /// Largest angle between the normals of both sides over smooth shared edges, in degrees.
    pub max_normal_angle_deg: f64,
    /// Largest distance between the two sides of a shared edge.
    pub max_gap: f64,
    /// Largest distance of sampled points of the limit surface from the patches.
    pub max_deviation: f64,
    /// The same, divided by the diagonal of the cage's bounding box.
    pub max_deviation_relative: f64,
    /// Largest difference of the normal curvature across smooth shared edges, perpendicular to the edge, times
    /// the diagonal of the bounding box.
    pub max_curvature_jump: f64,
    /// The same difference itself, in one over the unit of length.
    pub max_curvature_jump_absolute: f64,
    /// Shared edges that are smooth by construction.
    pub smooth_edges: usize,
    /// Shared edges that are not.
    pub sharp_edges: usize,
    /// Of the method G2: every irregular vertex, by level.
    pub nodes: Vec<Node>,
    /// What was done at vertices of valence 2 and at poles, by vertex.
    pub lenses: Vec<TreatedLens>,
    /// How often the cage was refined to make room around them.
    pub lens_steps: u32,
    /// The most bytes that the conversion holds, the cage that was given left out; known from counts before patches are made.
    pub memory: u64,
    /// What the user should know.
    pub notes: Vec<Note>,
}
