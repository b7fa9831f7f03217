//! Level lines of a [`Field`] on a surface, as curves: reflection lines, highlight lines, isophotes.
//!
//! Each square gets a grid of cells, finer where the field bends; marching squares says through which cells a line goes;
//! every crossing with an edge of a cell is found once, by Newton's method between two ends, so the cells on both sides
//! have the same, and so have the faces on both sides of a joint. Between crossings points are added, on the line
//! themselves, until chords are as close to it as asked.
//!
//! | file | holds |
//! | --- | --- |
//! | `levels` | which values |
//! | `lattice` | places on squares, under names that neighbours share |
//! | `probe` | the field on the surface |
//! | `wanted` | which parts of lines are wanted |
//! | `cells` | where the field bends |
//! | `march` | which cells a line goes through |
//! | `crossing` | crossings with edges of cells |
//! | `chain` | the line between crossings, and where it is wanted |
//! | `join` | pieces into lines |
//! | `fairness` | how evenly lines run |

mod cells;
mod chain;
mod crossing;
mod fairness;
mod join;
mod lattice;
mod levels;
mod march;
mod probe;
mod wanted;

use super::{Field, Surface, Viewer, bounding_box};
use crate::math::{Vec3, par};
use crate::patch::Location;
use cells::{AllCells, Cell, Plan};
use chain::{Piece, Tracer};
use crossing::Node;
pub use fairness::Fairness;
use lattice::{CUTS, Lattice};
pub use levels::Levels;
use march::Segment;
use probe::{Probe, Spot};
use wanted::Wanted;

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    /// Where on the surface; on a side of two faces, in the one that is first.
    pub at: Location,
    /// Where in space.
    pub position: Vec3,
}

/// A line on which a field has one value. What is below the value lies on its left, seen from where normals point.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelLine {
    /// The value.
    pub value: f64,
    /// The number of the value in its [`Levels`].
    pub index: i64,
    /// True if the line comes back to where it starts: then the last point is the first again.
    pub closed: bool,
    /// At least two.
    pub points: Vec<LinePoint>,
}

/// How lines are traced, and which parts of them are wanted.
#[derive(Clone, Copy)]
pub struct LineOptions<'a> {
    /// How far chords may be from the line, in units of the model.
    pub tolerance: f64,
    /// How long chords may be.
    pub longest: f64,
    /// Only where the surface faces this viewer.
    pub front: Option<Viewer>,
    /// Only points that this says yes to: those in sight, say.
    pub visible: Option<&'a (dyn Fn(Vec3) -> bool + Sync)>,
}

impl LineOptions<'_> {
    /// All of the lines to a tolerance in units of the model.
    pub fn new(tolerance: f64) -> Self {
        LineOptions { tolerance, longest: f64::INFINITY, front: None, visible: None }
    }
}

/// Lines, and what tracing them found.
#[derive(Clone, Debug)]
pub struct LevelLines {
    /// By index, then by the first place on the surface.
    pub lines: Vec<LevelLine>,
    /// Crossings with edges of cells.
    pub crossings: usize,
    /// By how much the field at a point of a line misses the line's value at most.
    pub max_residual: f64,
    /// Pieces that could not be followed between crossings, and are straight there.
    pub straight: usize,
    /// The least and the greatest value of the field that was met; `None` if it has no value anywhere.
    pub range: Option<[f64; 2]>,
}

/// Why lines were not traced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinesError {
    /// Values that do not follow one another.
    #[error("lines every {period} are no lines")]
    Period {
        /// What was asked for.
        period: f64,
    },
    /// A list of values that is empty or does not rise.
    #[error("the values of lines have to be finite and rise from one to the next")]
    Listed,
    /// A tolerance that is no length.
    #[error("a tolerance of {tolerance} is no length above 0")]
    Tolerance {
        /// What was asked for.
        tolerance: f64,
    },
    /// A field with numbers that are not finite, or an axis that is not there.
    #[error("the light or the eye has numbers that are not finite, or no directions")]
    Field,
    /// Nothing to trace on.
    #[error("the surface has no faces, no extent, or points that are not finite")]
    NoSurface,
    /// More than memory is meant for.
    #[error("there are too many lines on this surface, of more than {most} pieces or cells: ask for fewer")]
    TooMany {
        /// The most.
        most: usize,
    },
}

impl LinesError {
    /// The name of the kind of error, in snake case.
    pub fn code(&self) -> &'static str {
        match self {
            LinesError::Period { .. } => "bad_period",
            LinesError::Listed => "bad_levels",
            LinesError::Tolerance { .. } => "bad_tolerance",
            LinesError::Field => "bad_field",
            LinesError::NoSurface => "no_surface",
            LinesError::TooMany { .. } => "too_many_lines",
        }
    }
}

/// Cells, and pieces of lines, at most: a gigabyte or so.
const MOST: usize = 1 << 22;

/// Of the size: what the field of a point of a line may be off by.
const RESIDUAL: f64 = 1e-12;

/// Of that: how far below its value a line is looked for. Where the field is a line's value all over a face, up to rounding,
/// all of it counts as above: the line goes round it, and there are no specks in it.
const BELOW: f64 = 0.05;

/// Traces the lines on which a field has the wanted values.
///
/// A bounded light plane cuts lines off where they leave it. On either side of a crease that never fades lines end; they
/// end, too, at borders, and less than a hundredth of a face from where the field has no value, or leaps.
///
/// # Errors
/// If something asked for makes no sense, or would not fit into memory.
pub fn level_lines(
    surface: &dyn Surface,
    field: &Field,
    levels: &Levels,
    options: &LineOptions<'_>,
) -> Result<LevelLines, LinesError> {
    levels.check()?;
    if !(options.tolerance > 0.0 && options.tolerance.is_finite() && options.longest > 0.0) {
        return Err(LinesError::Tolerance { tolerance: options.tolerance });
    }
    let (unbounded, size_of_field) = unbounded(field).ok_or(LinesError::Field)?;
    let [lower, upper] = bounding_box(surface).ok_or(LinesError::NoSurface)?;
    let size = upper.distance(lower);
    if !(size > 0.0 && size.is_finite()) {
        return Err(LinesError::NoSurface);
    }
    let lattice = Lattice::new(surface.layout());
    let half = match field {
        Field::Plane { light, axis, .. } => light.half[*axis],
        _ => f64::INFINITY,
    };
    let leaps = cells::can_leap(field);
    let wanted = Wanted::new(field, options);
    let residual = RESIDUAL * size_of_field.unwrap_or(size);
    // A share of the same size is left for rounding: the residual is that of values which are not lowered.
    let (below, residual) = (BELOW * residual, (1.0 - 2.0 * BELOW) * residual);
    let lowered = levels.lowered(below);
    let range = [-half, half];
    let plan = Plan { lattice: &lattice, levels: &lowered, wanted: &wanted, range, leaps, most: MOST };
    let tracer = Tracer { lattice: &lattice, options, residual, wanted: &wanted };
    let tracing = Tracing { plan: &plan, tracer: &tracer, surface, field: &unbounded };
    let (cells, nodes, traced) = tracing.run()?;

    let pieces: Vec<&Piece> = traced.iter().flat_map(|square| &square.pieces).collect();
    let lines = join::join(&pieces, &nodes, |index| levels.value(index), size);
    let rest = |node: &Node| {
        let (_, spot) = node.found.as_ref()?;
        Some((spot.value? - levels.value(node.key.index)).abs())
    };
    let residuals = pieces.iter().map(|piece| piece.residual + below).chain(nodes.iter().filter_map(rest));
    Ok(LevelLines {
        lines,
        crossings: nodes.iter().filter(|node| node.found.is_some()).count(),
        max_residual: residuals.fold(0.0, f64::max),
        straight: traced.iter().map(|square| square.straight + square.rough.len()).sum(),
        range: cells.range(),
    })
}

/// The field on a plane without an end, and the size of its values where it is not that of the surface. `None` if its
/// numbers make no sense.
fn unbounded(field: &Field) -> Option<(Field, Option<f64>)> {
    let is_sound = |viewer: &Viewer| match viewer {
        Viewer::Eye(eye) => eye.is_finite(),
        Viewer::Parallel(direction) => direction.normalized().is_some(),
    };
    match *field {
        Field::Plane { mut light, viewer, ray, axis } => {
            let is_flat = light.normal().normalized().is_some() && light.centre.is_finite();
            let has_size = light.half.iter().all(|half| *half > 0.0);
            light.half = [f64::INFINITY; 2];
            (axis < 2 && is_flat && has_size && is_sound(&viewer))
                .then_some((Field::Plane { light, viewer, ray, axis }, None))
        }
        Field::Isophote { light } => light.normalized().map(|_| (*field, Some(1.0))),
        Field::Facing { viewer } => is_sound(&viewer).then_some((*field, Some(1.0))),
        Field::Zebra { viewer, axis } => {
            (is_sound(&viewer) && axis.normalized().is_some()).then_some((*field, Some(1.0)))
        }
    }
}

/// What was traced in one square.
#[derive(Default)]
struct Traced {
    /// How many pieces there were, wanted or not.
    segments: usize,
    pieces: Vec<Piece>,
    /// Cells in which a line could not be followed.
    rough: Vec<Cell>,
    straight: usize,
}

/// All that stays the same while lines are traced.
struct Tracing<'a> {
    plan: &'a Plan<'a>,
    tracer: &'a Tracer<'a>,
    surface: &'a dyn Surface,
    field: &'a Field,
}

impl<'a> Tracing<'a> {
    fn probe(&self) -> Probe<'a> {
        Probe::new(self.surface, self.field)
    }

    /// Crossings, and lines from one to the next. Where a line cannot be followed through a cell, cells are cut.
    fn run(&self) -> Result<(AllCells, Vec<Node>, Vec<Traced>), LinesError> {
        let Tracing { plan, tracer, .. } = *self;
        let too_many = LinesError::TooMany { most: plan.most };
        let mut cells = AllCells::new(plan, || self.probe());
        let mut nodes: Vec<Node> = Vec::new();
        let mut traced = Vec::new();
        traced.resize_with(cells.squares.len(), Traced::default);
        for round in 0..=CUTS {
            if cells.are_too_many(plan) {
                return Err(too_many);
            }
            // Most squares stay as they are from one round to the next.
            let news = cells.news();
            let march = |k: usize| march::march(news[k] as u32, &cells.squares[news[k]], plan);
            let segments: Option<Vec<Vec<Segment>>> = par::map(news.len(), march).into_iter().collect();
            let segments = segments.ok_or(too_many.clone())?;
            for (&square, segments) in news.iter().zip(&segments) {
                traced[square].segments = segments.len();
            }
            if traced.iter().map(|square| square.segments).sum::<usize>() > plan.most {
                return Err(too_many);
            }
            let crossings = segments.iter().flatten().flat_map(|segment| segment.ends);
            let value = |index| plan.levels.value(index);
            let probe = || self.probe();
            nodes.extend(crossing::find(crossings, &nodes, plan.lattice, value, tracer.residual, probe));
            // Stable: runs that are sorted are merged.
            nodes.sort_by_key(|node| node.key);
            let new = par::map(news.len(), |k| self.trace(&segments[k], &nodes));
            for (&square, new) in news.iter().zip(new) {
                traced[square] = new;
            }
            let rough = (0..)
                .zip(&traced)
                .flat_map(|(square, traced)| traced.rough.iter().map(move |&cell| (square, cell)));
            let rough: Vec<(u32, Cell)> = rough.collect();
            if rough.is_empty() || round == CUTS {
                return Ok((cells, nodes, traced));
            }
            cells.refine(&rough, plan, || self.probe());
        }
        unreachable!("the last round returns")
    }

    /// The lines through one square.
    fn trace(&self, segments: &[Segment], nodes: &[Node]) -> Traced {
        let (tracer, mut probe) = (self.tracer, self.probe());
        let mut traced = Traced { segments: segments.len(), ..Traced::default() };
        for segment in segments {
            // In the parameters of the cell's own square.
            let spot = |k: usize| -> Option<Spot> {
                let end = &segment.ends[k];
                let place = nodes.binary_search_by_key(&end.key, |node| node.key);
                let (x, spot) = nodes[place.expect("every crossing has its node")].found?;
                let x = if end.is_turned { 1.0 - x } else { x };
                Some(Spot { at: self.plan.lattice.along(end.own, x), ..spot })
            };
            let (Some(from), Some(to)) = (spot(0), spot(1)) else {
                // The field leaps: as small a part of the line is left out as cells can be.
                if segment.cell.size > 1 {
                    traced.rough.push(segment.cell);
                }
                continue;
            };
            let value = self.plan.levels.value(segment.ends[0].key.index);
            let inner = tracer.follow(segment, [&from, &to], value, &mut probe);
            match &inner {
                None if segment.cell.size > 1 => traced.rough.push(segment.cell),
                None => traced.straight += 1,
                Some(_) => {}
            }
            let mut chain = vec![from];
            chain.extend(inner.unwrap_or_default());
            chain.push(to);
            traced.pieces.extend(tracer.clip(segment, &chain, value, &mut probe));
        }
        traced
    }
}
