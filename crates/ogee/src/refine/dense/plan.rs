//! `DenseRefinement`: what there is to know before points come, and the steps.

use std::borrow::Cow;

use super::grids::{Frame, Grids};
use super::numbering::Numbering;
use super::{corners, interiors, levels, sides};
use crate::math::{Components, pages, par};
use crate::mesh::connectivity::{Connectivity, Quads};
use crate::mesh::{FaceId, HalfedgeId};
use crate::refine::TooDeep;
use crate::refine::split::child_quad;
use crate::rules::Level;

/// Refinement by several steps with neither tables nor levels in between: set-up is this plan alone, for cages that move as
/// well as for those that are refined once.
///
/// The base of the grids is the cage if all of its faces are quads, otherwise its first level. Over every quad of the base stands
/// a grid of `side` x `side` quads, `side = 2^depth` or half of that. With `V` vertices, `F` faces and `E` edges of the base, and
/// `M = side - 1`, the vertices are
///
/// - `0 .. V`: the corners of grids, numbered as in the base level;
/// - from `V + f M^2`: inside quad `f`, `(i, j)` at `(i - 1) M + (j - 1)`, `i` along u, `j` along v;
/// - from `V + F M^2 + e M`: inside edge `e`, from the origin of its smaller halfedge;
///
/// and the quads over quad `f` are `f side^2 ..`, cell `(i, j)` at `i side + j`, each from its corner `(i, j)` on along u. Those
/// over hidden faces are left out.
///
/// Beside the results the last step holds the points of the level before, a quarter as many. Where curves meet, and where Chaikin's rule spreads
/// sharpness along edges, levels are made after all.
#[derive(Clone, Debug)]
pub struct DenseRefinement<'a> {
    pub(super) cage: &'a Level,
    pub(super) way: Way<'a>,
}

#[derive(Clone, Debug)]
pub(super) enum Way<'a> {
    /// One step of a cage with other polygons, whose first level is nobody's base.
    Step,
    /// Grids over a level of quads.
    Grids {
        base: Cow<'a, Level>,
        numbering: Numbering,
        steps: u32,
        /// The base level as the steps after the first find its rules; where there are fewer, they do not change any more.
        rules: Vec<Level>,
    },
    /// The same numbering, over levels.
    Levels { base: Cow<'a, Level>, numbering: Numbering, levels: Vec<Level> },
}

impl Level {
    /// Plans `depth` steps of refinement.
    ///
    /// # Errors
    /// If the last level would have `2^32 - 1` vertices or more, or its points, of three numbers each, and faces would need more
    /// than `memory` bytes.
    ///
    /// # Panics
    /// If `depth` is 0: a cage is no mesh of quads.
    pub fn dense(&self, depth: u32, memory: u64) -> Result<DenseRefinement<'_>, TooDeep> {
        assert!(depth > 0, "a fine mesh is at least one step away");
        self.check_fine_mesh(depth, memory)?;
        let quads = self.topology().is_quads();
        if depth == 1 && !quads {
            return Ok(DenseRefinement { cage: self, way: Way::Step });
        }
        let (base, steps) =
            if quads { (Cow::Borrowed(self), depth) } else { (Cow::Owned(self.split()), depth - 1) };
        let numbering = Numbering::new(base.topology(), 1 << steps);
        let way = if base.spreads() {
            let mut levels = vec![base.split()];
            for _ in 1..steps {
                let next = levels[levels.len() - 1].split();
                levels.push(next);
            }
            Way::Levels { base, numbering, levels }
        } else {
            let mut rules: Vec<Level> = Vec::new();
            for step in 1..steps {
                let last = rules.last().unwrap_or(&base);
                if last.semi_sharp_edges().next().is_none() && last.semi_sharp_vertices().next().is_none() {
                    break;
                }
                rules.push(base.faded(step));
            }
            Way::Grids { base, numbering, steps, rules }
        };
        Ok(DenseRefinement { cage: self, way })
    }
}

impl DenseRefinement<'_> {
    /// Number of vertices of the last level.
    pub fn vertex_count(&self) -> usize {
        match &self.way {
            Way::Step => {
                let topology = self.cage.topology();
                topology.vertex_count() + topology.face_count() + topology.edge_count()
            }
            Way::Grids { numbering, .. } | Way::Levels { numbering, .. } => numbering.count(),
        }
    }

    /// Number of quads of the last level, hidden ones left out.
    pub fn face_count(&self) -> usize {
        match &self.way {
            Way::Step => {
                let topology = self.cage.topology();
                let hidden = self.cage.hidden_faces().iter().map(|&f| topology.face_size(f) as usize);
                topology.halfedge_count() - hidden.sum::<usize>()
            }
            Way::Grids { base, numbering, .. } | Way::Levels { base, numbering, .. } => {
                (numbering.faces - base.hidden_faces().len()) * numbering.side * numbering.side
            }
        }
    }

    /// The points of the last level, or other data there, from those of the cage. They go into the memory that `out` has: fresh
    /// memory costs more than the arithmetic.
    ///
    /// # Panics
    /// If there are fewer values than vertices of the cage.
    pub fn points<T: Components>(&self, cage: &[T], out: &mut Vec<T>) {
        if T::COUNT == 0 {
            out.resize(self.vertex_count(), T::zero());
            return;
        }
        match &self.way {
            Way::Step => {
                pages::resize(out, self.vertex_count());
                self.cage.child_points(cage, out);
            }
            Way::Grids { base, numbering, steps, rules } => {
                let values = self.base_values(base, cage);
                if *steps == 1 {
                    pages::resize(out, numbering.count());
                    base.child_points(&values, out);
                } else if let Some(quads) = base.topology().as_quads() {
                    refine(base, &quads, numbering, rules, &values, out);
                }
            }
            Way::Levels { base, levels, .. } => {
                let mut values = self.base_values(base, cage).into_owned();
                let mut level: &Level = base;
                for next in levels {
                    let mut refined = Vec::new();
                    level.child_points(&values, &mut refined);
                    (values, level) = (refined, next);
                }
                levels::in_grids(base, level, &values, out);
            }
        }
    }

    /// The cage.
    pub(crate) fn cage(&self) -> &Level {
        self.cage
    }

    /// Number of steps from the cage.
    pub(crate) fn depth(&self) -> u32 {
        match &self.way {
            Way::Step => 1,
            Way::Grids { base, numbering, .. } | Way::Levels { base, numbering, .. } => {
                numbering.side.ilog2() + u32::from(matches!(base, Cow::Owned(_)))
            }
        }
    }

    /// The base with its rules after the last step, and the grids that points make which are there already; `None` where there are no
    /// grids but levels.
    pub(crate) fn grids<'g, T>(
        &'g self,
        points: &'g [T],
    ) -> Option<(Cow<'g, Level>, Grids<'g, Quads<'g>, T>)> {
        let Way::Grids { base, numbering, steps, .. } = &self.way else { return None };
        let [corners, interiors, sides] = numbering.parts(points);
        let frame = Frame { base: base.topology().as_quads()?, side: numbering.side, corners, sides };
        let is_settled =
            base.semi_sharp_edges().next().is_none() && base.semi_sharp_vertices().next().is_none();
        let rules = if is_settled { Cow::Borrowed(&**base) } else { Cow::Owned(base.faded(*steps)) };
        Some((rules, Grids { frame, interiors }))
    }

    /// Values at the vertices of the last level in the order of grids, from those in the order of levels. `finest` is that level, as
    /// [`Refinement`](crate::Refinement) and [`Level::refine_points`] make it.
    ///
    /// # Panics
    /// If `finest` is another level.
    pub fn from_levels<T: Copy + Send + Sync>(&self, finest: &Level, values: &[T]) -> Vec<T> {
        let mut out = Vec::new();
        match &self.way {
            Way::Step => out.extend_from_slice(&values[..self.vertex_count()]),
            Way::Grids { base, .. } | Way::Levels { base, .. } => {
                levels::in_grids(base, finest, values, &mut out)
            }
        }
        out
    }

    /// Values at the vertices of the base from those of the cage.
    pub(super) fn base_values<'v, T: Components>(&self, base: &Level, cage: &'v [T]) -> Cow<'v, [T]> {
        if std::ptr::eq(base, self.cage) {
            return Cow::Borrowed(cage);
        }
        let mut values = Vec::new();
        self.cage.child_points(cage, &mut values);
        Cow::Owned(values)
    }

    /// The quads of the last level, into the memory that `out` has.
    pub fn quads(&self, out: &mut Vec<[u32; 4]>) {
        let (base, numbering) = match &self.way {
            Way::Step => {
                let topology = self.cage.topology();
                out.clear();
                par::extend(out, topology.halfedge_count(), |h| child_quad(topology, HalfedgeId(h as u32)));
                self.cage.retain_visible(out);
                return;
            }
            Way::Grids { base, numbering, .. } | Way::Levels { base, numbering, .. } => (base, numbering),
        };
        let Some(quads) = base.topology().as_quads() else { return };
        let visible: Vec<u32> = match base.hidden_faces() {
            [] => Vec::new(),
            _ => (0..numbering.faces as u32).filter(|&f| base.is_visible(FaceId(f))).collect(),
        };
        pages::resize(out, self.face_count());
        par::chunks(out, numbering.side * numbering.side, Default::default, |rows, f, out| {
            let f = visible.get(f).copied().unwrap_or(f as u32);
            numbering.quads(&quads, FaceId(f), rows, out);
        });
    }
}

pub(super) fn refine<C: Connectivity + Copy, T: Components>(
    base: &Level,
    quads: &C,
    numbering: &Numbering,
    rules: &[Level],
    values: &[T],
    out: &mut Vec<T>,
) {
    pages::resize(out, numbering.count());
    let mut points = Vec::new();
    pages::resize(&mut points, numbering.vertices + numbering.faces + numbering.edges);
    base.child_points(values, &mut points);
    let mut faded = rules.iter();
    let mut rules = base;
    for side in (1..).map(|step| 1 << step).take_while(|&side| side < numbering.side) {
        let level = Numbering { side, ..*numbering };
        let [corners, interiors, sides] = level.parts(&points);
        let grids = Grids { frame: Frame { base: *quads, side, corners, sides }, interiors };
        rules = faded.next().unwrap_or(rules);
        if 2 * side == numbering.side {
            refine_once(rules, &grids, numbering, out);
        } else {
            let next = Numbering { side: 2 * side, ..*numbering };
            let mut next_points = Vec::new();
            pages::resize(&mut next_points, next.count());
            refine_once(rules, &grids, &next, &mut next_points);
            points = next_points;
        }
    }
}

fn refine_once<C: Connectivity, T: Components>(
    rules: &Level,
    grids: &Grids<'_, C, T>,
    numbering: &Numbering,
    out: &mut [T],
) {
    let (corners, rest) = out.split_at_mut(numbering.vertices);
    let (interiors, sides) = rest.split_at_mut(numbering.faces * numbering.per_face());
    corners::refine(rules, grids, corners);
    sides::refine(rules, grids, sides);
    interiors::refine(grids, interiors);
}
