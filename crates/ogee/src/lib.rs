//! Catmull-Clark control meshes to exact, smooth, measurable surfaces.
//!
//! A *control mesh*, or cage, is a handful of polygons. Refinement rounds it: every step replaces each face by
//! smaller ones and moves the points a little, and the steps lead to a smooth *limit surface*. This crate knows the
//! rules of refinement, evaluates its limit at any point, and knows how to write that surface as NURBS faces that share
//! tangent planes, sewn into solids. Files are the business of the crate `ogee-formats`.
//!
//! # The main path
//!
//! Data that one can build by hand goes through one gate; behind it there is nothing left to go wrong.
//!
//! ```
//! use ogee::{ControlMesh, FaceId, FaceList, Level, LimitSurface, PatchTable, Refinement, Vec3};
//! use ogee::limit_vertices;
//!
//! // A pyramid: plain points and faces, counter-clockwise seen from outside.
//! let points = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
//! let mut faces = FaceList::new();
//! faces.push(&[3, 2, 1, 0]);
//! for [a, b] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
//!     faces.push(&[a, b, 4]);
//! }
//! let mesh = ControlMesh::new(points.map(Vec3::from).to_vec(), faces);
//!
//! // The gate: connectivity, and the rule of every vertex and edge. A bad mesh is refused here and nowhere else.
//! let level = Level::new(&mesh)?;
//!
//! // Refinement gives weights, not points ..
//! let refined = Refinement::uniform(&level, 3)?;
//!
//! // .. which serve any data: positions, another pose, colours.
//! let fine = refined.apply(&mesh.points);
//! assert_eq!(fine.len(), refined.finest().topology().vertex_count());
//!
//! // Where all this leads to: the exact limit of each vertex, with its normal ..
//! let limit = limit_vertices(refined.finest(), &fine);
//! assert!(limit[4].position.z < 1.0 && limit[4].normal.is_some_and(|n| n.z > 0.999));
//!
//! // .. and of every point between them, with no refinement: here the apex, the third corner of a triangle.
//! let table = PatchTable::new(&level);
//! let surface = LimitSurface::new(&table, &mesh.points);
//! let apex = surface.eval(table.locate(FaceId(1), Some(2), 0.0, 0.0)?);
//! assert!(apex.position.distance(limit[4].position) < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! And the other journey, to a part that CAD programs take for their own:
//!
//! ```
//! use ogee::{convert, shapes};
//!
//! let part = convert::to_part(&shapes::cube(), &convert::Options::default())?;
//! let report = &part.report;
//! assert_eq!((report.solids, report.faces_written, report.closed), (1, 6, true));
//! // Tangent planes agree along all edges; the distance from the limit surface is measured.
//! assert!(report.max_normal_angle_deg < 1e-9 && report.max_deviation_relative < 2e-3);
//! # Ok::<(), convert::ConvertError>(())
//! ```
//!
//! # Rooms
//!
//! | room | holds |
//! | --- | --- |
//! | [`math`] | [`Vec3`], [`Grid`], [`Interpolate`], [`SurfaceJet`]: what everything is spoken in |
//! | [`mesh`] | [`ControlMesh`], ids, [`Topology`], every [`Defect`] a mesh can have, built-in [`shapes`] |
//! | `stencil` | [`Row`] and [`StencilTable`]: weights, and the one loop that applies them |
//! | `catmull_clark`, `crease` | the masks |
//! | `rules` | [`Level`]: a topology with its rules; [`Sector`]; the rule table |
//! | `refine` | the one-to-four split, [`Step`], [`Refinement`], [`DenseRefinement`], [`FineMesh`] |
//! | `patch` | [`PatchTable`]: what each face's surface is made of; [`Location`]; limit masks; pieces of a level, taken out |
//! | `limit` | [`LimitSurface`]: the surface at any point; [`Pattern`]: at the same places on every face; [`ClosestPoints`]; [`limit_vertices`] |
//! | [`fairing`] | the cage that bends least, of all whose surface goes through given points |
//! | [`nurbs`] | knots, curves, surfaces of any degree, shells |
//! | [`stam`] | the limit surface a second time, by eigenvectors, at smooth interior vertices |
//! | [`pccm`] | one smooth patch per quad, and packing them into few |
//! | [`curve_network`] | curves that the surface is to contain: which can be, where they meet, room for them in the cage |
//! | [`lens`] | vertices of valence 2 and poles: detection, re-meshing, C2 caps |
//! | [`quality`] | measuring instruments: reflected rays, lines on the surface, continuity |
//! | [`convert`] | the whole journey from a cage to a part, with its figures |
//!
//! Each room imports only from those above it in this table. What is exported at the top of the crate is what most
//! programs need; the rest is reached through its room.
//!
//! # Habits
//!
//! - Points are passed beside a level, never hidden inside it: one level serves every pose of an animated cage.
//! - Faces, vertices, edges and halfedges have [ids](FaceId) of their own types, numbered from 0 in the order of the
//!   mesh; [`Grid`]s are indexed `(i, j)`, `i` along `u`.
//! - Functions that can fail say so with an error of their own; wrong input never panics. Ids out of range do.
//! - All arithmetic is `f64`. Results depend neither on the number of threads nor on how wide the processor's registers
//!   are; the feature `rayon`, on by default, brings threads.
//!
//! The methods have pages of their own, with formulas, in `docs/methods` of the repository.

mod catmull_clark;
pub mod convert;
mod crease;
pub mod curve_network;
pub mod fairing;
pub mod g2_caps;
pub mod lens;
mod limit;
pub mod math;
pub mod mesh;
pub mod nurbs;
mod patch;
pub mod pccm;
pub mod quality;
mod refine;
mod rules;
pub mod stam;
mod stencil;

pub use limit::{
    Closest, ClosestPoints, Derivatives, Evaluator, FacePiece, Flags, LimitJet, LimitSurface, LimitVertex,
    PatchNet, Pattern, Samples, SurfacePoint, TailPiece, limit_vertices,
};
pub use math::{Curvature, Grid, Interpolate, SurfaceJet, Vec3};
pub use mesh::{
    Boundary, ControlMesh, Corner, Crease, Creasing, Defect, EdgeId, FaceId, FaceList, FaceVarying,
    FaceVaryingRule, HalfedgeId, LensShape, Meeting, Note, Place, Scheme, Sharpness, Statistics, Topology,
    TopologyError, Valence, VertexId, shapes,
};
pub use patch::{Location, LocationError, ParametricFace, PatchStatistics, PatchTable};
pub use refine::{DenseRefinement, FineMesh, Refinement, Step, TooDeep};
pub use rules::{EdgeRule, Level, Sector, VertexMask, VertexRule};
pub use stencil::{Row, StencilTable};

/// The method pages: their programs are tests.
#[cfg(doctest)]
mod doctests {
    #[doc = include_str!("../../../docs/methods/catmull_clark.md")]
    struct CatmullClark;

    #[doc = include_str!("../../../docs/methods/dense_refinement.md")]
    struct DenseRefinement;

    #[doc = include_str!("../../../docs/methods/exact_evaluation.md")]
    struct ExactEvaluation;

    #[doc = include_str!("../../../docs/methods/reflection_lines.md")]
    struct ReflectionLines;

    #[doc = include_str!("../../../docs/methods/pccm.md")]
    struct Pccm;

    #[doc = include_str!("../../../docs/methods/g2_caps.md")]
    struct G2Caps;

    #[doc = include_str!("../../../docs/methods/packing.md")]
    struct Packing;
}
