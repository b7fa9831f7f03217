//! PCCM: one smooth NURBS patch per quad of a Catmull-Clark mesh, tangent-continuous everywhere.
//!
//! After Peters, Patching Catmull-Clark Meshes (SIGGRAPH 2000); the second-layer variant, boundaries, creases, corners
//! and darts are ours. The method's page is `docs/methods/pccm.md`.
//!
//! The recipe, one file per pass: read the layered net of each quad off the refined level and insert knots (`net`),
//! place limit points and tangents at irregular corners (`corner`), then edge curves, second rows and twists (`edge`).
//! Where curves of a network meet the first cells are caps of degree five: where they are and what their spokes are
//! (`meeting`), their rows (`cap`), the conditions around a meeting (`closing`).

mod bi5;
mod blocks;
mod cap;
mod chart_surface;
mod closing;
mod constants;
mod corner;
mod edge;
mod fan;
mod group;
mod meeting;
mod net;
mod packing;
mod part;
mod plan;
mod requirements;

pub use bi5::to_quintic_patches;
pub use fan::CornerClass;
pub use group::to_group_patches;
pub use meeting::Cap;
pub use plan::{Group, Plan, plan};
pub use requirements::{PccmError, Requirement, SHARPEST, least_level};

pub(crate) use blocks::Blocks;
pub(crate) use group::Converted;
pub(crate) use meeting::{CAP_CELLS, meetings};
pub(crate) use net::{Cells, inserted, view};
pub(crate) use packing::{Chart, Placed, curves, pack, unpacked};
pub(crate) use part::Part;
pub(crate) use requirements::irregular_faces;

use crate::math::{Grid, Vec3, par};
use crate::mesh::{FaceId, HalfedgeId, Note, Place, VertexId};
use crate::nurbs::KnotVector;
use crate::rules::Level;
use chart_surface::Pieces;
use edge::FarEnd;
use fan::{Arrays, Fan};
use meeting::MeetingFan;

/// Where an edge curve is quadratic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layer {
    /// In the first cell, as in the slides.
    First,
    /// In the second cell: nearer to the limit surface, and higher saddles survive.
    #[default]
    Second,
}

/// How tangents at an interior extraordinary vertex are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tangents {
    /// In the limit tangent plane, of the length for which nothing moves beyond the first cell, to first order.
    #[default]
    Clamp,
    /// In the limit tangent plane, of the length of the projected inserted tangents.
    Project,
    /// The slides' first form: tangent-continuous, but the normal is not that of the limit.
    Slides,
}

/// Choices of [`to_patches`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Where edge curves are quadratic.
    pub layer: Layer,
    /// Refinements before the conversion; [`least_level`] says what is enough.
    pub level: u32,
    /// Tangents at interior extraordinary vertices.
    pub tangents: Tangents,
    /// Keep the alternating part of the twists at even valence, which preserves saddles.
    pub keep_twist: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options { layer: Layer::Second, level: 2, tangents: Tangents::Clamp, keep_twist: true }
    }
}

/// Bicubic patches, one per quad of the base level.
#[derive(Clone, Debug)]
pub struct Patches {
    /// Refinements before the conversion; a quad holds `2^level` cells a side.
    pub level: u32,
    /// Knots of all patches, in `u` and in `v`, in cells: the domain is `[0, 2^level]`.
    pub knots: KnotVector,
    /// `nets[quad][(i, j)]`, `i` along the quad's first side.
    pub nets: Vec<Grid<Vec3>>,
    /// What each corner of each quad is.
    pub classes: Vec<[CornerClass; 4]>,
    /// What the surface is in the first two cells around meetings of curves, in place of the nets there.
    pub caps: Vec<Cap>,
    /// Base halfedges whose edge is no longer tangent-continuous next to the vertex they leave: at cones, and at
    /// corners too flat to be smoothed.
    pub broken: Vec<HalfedgeId>,
    /// What the user should know.
    pub notes: Vec<Note>,
}

/// Valences above this give large flat zones.
const LARGE_VALENCE: usize = 20;

/// Converts every quad of a level into a bicubic patch; around meetings of curves [`Patches::caps`] take their place.
///
/// `base` must have quads only; `points` are its vertices, best near the origin (recentre first: rounding grows with
/// the distance). Costs about `100` coefficients a quad at level 2.
///
/// # Errors
/// If a vertex of valence 2 has no rule, the level is less than [`least_level`] says, or a face is no quad.
///
/// # Panics
/// If there are fewer points than vertices.
pub fn to_patches(base: &Level, points: &[Vec3], options: &Options) -> Result<Patches, PccmError> {
    let least = least_level(base, options.layer)?;
    if options.level < least.level {
        return Err(PccmError::LevelTooLow {
            level: options.level,
            least: least.level,
            because: least.because,
        });
    }
    let faces: Vec<FaceId> = (0..base.topology().face_count() as u32).map(FaceId).collect();
    Ok(smooth(&Part::new(base, 0, &faces), points, options))
}

/// The patches of a part: those of quads that are not converted have no coefficients.
fn smooth(part: &Part<'_>, points: &[Vec3], options: &Options) -> Patches {
    let base = part.base();
    let (mut fine, mut fine_points) = base.refine_points(points);
    for _ in 1..options.level {
        (fine, fine_points) = fine.refine_points(&fine_points);
    }
    let knots = net::knots(options.layer, options.level);
    let cells = Cells::new(base, &fine, options.level);
    let of_converted = |make: &(dyn Fn(usize) -> Grid<Vec3> + Sync)| {
        let nothing = || Grid::from_fn(0, 0, |_, _| Vec3::ZERO);
        par::map(part.quad_count(), |quad| if part.is_converted(quad) { make(quad) } else { nothing() })
    };
    let nets = of_converted(&|quad| cells.layered_net(quad as u32, &fine_points));
    let insertion = net::Insertion::new(&knots);
    let inserted = Arrays {
        last: knots.coefficients() - 1,
        patches: of_converted(&|quad| insertion.apply(&nets[quad])),
    };

    let meetings = part.meetings();
    let (mut fans, classes) = fans(part, &meetings);
    for fan in &mut fans {
        corner::place(fan, &nets, &inserted, options);
    }
    let mut arrays = inserted.clone();
    for fan in &fans {
        corner::write(fan, &mut arrays);
    }
    match options.layer {
        Layer::First => {
            for fan in fans.iter().filter(|fan| fan.smoothed) {
                edge::smooth_first(fan, options.keep_twist, &inserted, &mut arrays);
            }
        }
        Layer::Second => smooth_second_layer(base, &mut fans, options, &inserted, &mut arrays),
    }
    weld(part, &mut arrays);
    let (caps, kinks) = meeting::caps(base, &meetings, &fine, &fine_points, options.level);
    let (mut broken, mut notes) = findings(base, &fans);
    for kink in kinks {
        broken.extend(base.topology().ring(kink.vertex));
        notes.push(kink.note());
    }
    Patches { level: options.level, knots, nets: arrays.patches, classes, caps, broken, notes }
}

/// All fans that are not regular, and the class of every corner of every quad.
fn fans(part: &Part<'_>, meetings: &[MeetingFan]) -> (Vec<Fan>, Vec<[CornerClass; 4]>) {
    let base = part.base();
    let topology = base.topology();
    let mut fans = Vec::new();
    let mut classes = vec![[CornerClass::Regular; 4]; part.quad_count()];
    for h in meetings.iter().flat_map(|meeting| &meeting.halfedges) {
        classes[h.index() / 4][h.index() % 4] = CornerClass::Meeting;
    }
    for v in (0..topology.vertex_count() as u32).map(VertexId) {
        let sectors = base.sectors(v);
        let closing = usize::from(topology.is_boundary(v));
        let sharp_edges = topology.ring(v).filter(|&h| base.is_sharp(h)).count() + closing;
        for sector in sectors {
            let class = Fan::classify(base, v, sector, sharp_edges);
            let halfedges: Vec<HalfedgeId> = base.sector_halfedges(sector).collect();
            // A fan is converted as a whole or not at all.
            let converted = halfedges.iter().all(|h| part.is_converted(h.index() / 4));
            let is_meeting = |h: &HalfedgeId| classes[h.index() / 4][h.index() % 4] == CornerClass::Meeting;
            if class == CornerClass::Regular || !converted || halfedges.first().is_some_and(is_meeting) {
                continue;
            }
            for h in &halfedges {
                classes[h.index() / 4][h.index() % 4] = class;
            }
            fans.push(Fan {
                vertex: v,
                class,
                halfedges,
                closed: sector.closed,
                smoothed: false,
                c: 0.0,
                apex: Vec3::ZERO,
                tangents: Vec::new(),
                second: Vec::new(),
            });
        }
    }
    (fans, classes)
}

fn smooth_second_layer(
    base: &Level,
    fans: &mut [Fan],
    options: &Options,
    inserted: &Arrays,
    arrays: &mut Arrays,
) {
    // For each base halfedge that leaves a smoothed fan along a smooth edge: the fan and the number of the edge.
    let mut edge_of = vec![None; base.topology().halfedge_count()];
    for (number, fan) in fans.iter().enumerate().filter(|(_, fan)| fan.smoothed) {
        for i in fan.smooth_edges() {
            edge_of[fan.halfedges[i].index()] = Some((number, i));
        }
    }
    let coupled = options.level == 2;
    let far_of = |fans: &[Fan], fan: &Fan, i: usize| -> Option<FarEnd> {
        let twin = base.topology().twin(fan.halfedges[i]).filter(|_| coupled)?;
        let (other, edge) = edge_of[twin.index()]?;
        let other = &fans[other];
        Some(FarEnd {
            tangent: other.tangents[edge],
            second: other.second.get(edge).copied().unwrap_or(Vec3::ZERO),
        })
    };
    let tangents_known = fans.to_vec();
    for fan in fans.iter_mut().filter(|fan| fan.smoothed) {
        let own = fan.clone();
        edge::place_second(fan, inserted, |i| far_of(&tangents_known, &own, i));
    }
    for fan in fans.iter().filter(|fan| fan.smoothed) {
        edge::smooth_second(fan, options.keep_twist, inserted, arrays, |i| far_of(fans, fan, i));
    }
}

/// Makes shared boundary curves and corners equal bit for bit: computed twice they agree to rounding only.
fn weld(part: &Part<'_>, arrays: &mut Arrays) {
    let topology = part.base().topology();
    let last = arrays.last;
    let converted = |h: &HalfedgeId| part.is_converted(h.index() / 4);
    for h in (0..topology.halfedge_count() as u32).map(HalfedgeId).filter(converted) {
        let Some(twin) = topology.twin(h).filter(|twin| h < *twin && converted(twin)) else { continue };
        for s in 1..last {
            let value = arrays.patches[h.index() / 4][view(h.index() % 4, s, 0, last)];
            arrays.patches[twin.index() / 4][view(twin.index() % 4, last - s, 0, last)] = value;
        }
    }
    for v in (0..topology.vertex_count() as u32).map(VertexId) {
        let Some(first) = topology.ring(v).find(converted) else { continue };
        let value = arrays.patches[first.index() / 4][view(first.index() % 4, 0, 0, last)];
        for h in topology.ring(v).filter(converted) {
            arrays.patches[h.index() / 4][view(h.index() % 4, 0, 0, last)] = value;
        }
    }
}

/// Edges that could not be smoothed at one end, and notes about vertices.
fn findings(base: &Level, fans: &[Fan]) -> (Vec<HalfedgeId>, Vec<Note>) {
    let mut broken = Vec::new();
    let mut notes = Vec::new();
    let seen = |fan: &&Fan| fan.halfedges.iter().any(|&h| base.is_visible(base.topology().face(h)));
    for fan in fans.iter().filter(seen) {
        let vertex = fan.vertex;
        let mut note =
            |code, message| notes.push(Note { code, message, place: Some(Place::Vertex(vertex.0)) });
        match fan.class {
            CornerClass::Cone => {
                broken.extend(fan.halfedges.iter().filter(|&&h| !base.is_sharp(h)));
                note(
                    "cone_point",
                    format!(
                        "vertex {vertex} is tagged sharp inside a smooth region: the surface has a cone point there"
                    ),
                );
            }
            CornerClass::Corner if !fan.smoothed => {
                broken.extend(fan.smooth_edges().map(|i| fan.halfedges[i]));
                note(
                    "corner_fallback",
                    format!(
                        "the sharp edges at corner {vertex} are parallel: its inner edges are not smooth next to it"
                    ),
                );
            }
            CornerClass::Crease if fan.halfedges.len() == 1 => note(
                "singular_corner",
                format!(
                    "vertex {vertex} has one face beside a smooth crease: the patch is singular there; tag it as a corner to avoid that"
                ),
            ),
            _ if fan.smoothed && is_singular(fan) => {
                note("singular_vertex", format!("the limit surface has no tangent plane at vertex {vertex}"));
            }
            _ if fan.halfedges.len() > LARGE_VALENCE => {
                note(
                    "large_valence",
                    format!("vertex {vertex} has valence {}: expect a large flat zone", fan.halfedges.len()),
                );
            }
            _ => {}
        }
    }
    (broken, notes)
}

/// Tangents that span no plane: the limit surface itself is singular.
fn is_singular(fan: &Fan) -> bool {
    let tangents = || fan.tangents.iter().map(|&q| q - fan.apex);
    let longest = tangents().map(Vec3::length).fold(0.0, f64::max);
    let normal = tangents().zip(tangents().skip(1)).fold(Vec3::ZERO, |sum, (a, b)| sum + a.cross(b));
    normal.length() <= SINGULAR * longest * longest
}

/// Sine of the angle between tangents below which they count as parallel.
const SINGULAR: f64 = 1e-12;
