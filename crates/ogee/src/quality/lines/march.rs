//! Where lines go through the cells of a square: marching squares, on cells whose sides may be cut in pieces.
//!
//! What is at a value counts as above it, so that every corner is on one side. Around a cell, crossings up and down
//! alternate. A piece of line runs from one up to one down: what is below its value lies on its left.

use super::cells::{Cell, Cells, Plan};
use super::lattice::{Edge, Place};

/// A line crosses an edge: the edge under its common name, and the index of the line's value. Nothing else is at the same
/// key. Sorted, crossings of a square stand together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub(super) edge: Edge,
    pub(super) index: i64,
}

/// A crossing, as one cell sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) key: Key,
    /// The edge in the cell's own square.
    pub(super) own: Edge,
    /// The edge runs the other way under its common name.
    pub(super) is_turned: bool,
    /// The field at both ends of the edge as it is named.
    pub(super) ends: [f64; 2],
}

/// A piece of a line, through one cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) cell: Cell,
    /// Where it comes from and goes to.
    pub(super) ends: [Crossing; 2],
}

/// A piece of the border of a cell: an edge, and the field at its start and end, counter-clockwise.
struct Step {
    edge: Edge,
    is_backward: bool,
    values: [f64; 2],
}

/// The pieces of all lines through the cells of a square; `None` if there are more than there may be.
pub(super) fn march(square: u32, cells: &Cells, plan: &Plan<'_>) -> Option<Vec<Segment>> {
    let mut segments = Vec::new();
    for &cell in &cells.leaves {
        if cells.is_far(cell) || cells.leaps(cell, plan) {
            continue;
        }
        let Some(border) = border(square, cell, cells) else { continue };
        let values = border.iter().map(|step| step.values[0]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let (low, high) = (low.max(plan.range[0]), high.min(plan.range[1]));
        if low > high {
            continue;
        }
        // Asked before they are counted out: there may be more than any memory holds.
        if plan.levels.count(low, high) + segments.len() as f64 > plan.most as f64 {
            return None;
        }
        for index in plan.levels.between(low, high) {
            through(index, cell, cells, &border, plan, &mut segments);
        }
    }
    Some(segments)
}

/// The border of a cell, cut wherever a cell beside it has a corner; `None` if the field has no value somewhere.
fn border(square: u32, cell: Cell, cells: &Cells) -> Option<Vec<Step>> {
    let [a, b, _, d] = cell.corners();
    let mut border = Vec::with_capacity(8);
    for (axis, from, is_backward) in [(0, a, false), (1, b, false), (0, d, true), (1, a, true)] {
        let first = border.len();
        pieces(Edge { square, start: from, length: cell.size, axis }, cells, &mut |edge, values| {
            border.push(Step { edge, is_backward, values });
        })?;
        if is_backward {
            border[first..].reverse();
            border[first..].iter_mut().for_each(|step| step.values.reverse());
        }
    }
    Some(border)
}

/// The pieces of an edge, in its direction.
fn pieces(edge: Edge, cells: &Cells, out: &mut impl FnMut(Edge, [f64; 2])) -> Option<()> {
    let at = |x: u16| -> Place {
        let mut place = edge.start;
        place[usize::from(edge.axis)] += x;
        place
    };
    let half = edge.length / 2;
    if half > 0 && cells.sample(at(half)).is_some() {
        pieces(Edge { length: half, ..edge }, cells, out)?;
        return pieces(Edge { start: at(half), length: half, ..edge }, cells, out);
    }
    out(edge, [cells.value(at(0))?, cells.value(at(edge.length))?]);
    Some(())
}

/// The pieces of one line through one cell.
fn through(
    index: i64,
    cell: Cell,
    cells: &Cells,
    border: &[Step],
    plan: &Plan<'_>,
    segments: &mut Vec<Segment>,
) {
    let value = plan.levels.value(index);
    // Ups and downs in turn, beginning with an up.
    let mut crossings: Vec<Crossing> = Vec::with_capacity(2);
    let mut first_is_up = true;
    for step in border {
        let [from, to] = step.values.map(|x| x < value);
        if from == to {
            continue;
        }
        if crossings.is_empty() {
            first_is_up = from;
        }
        let (edge, is_turned) = plan.lattice.named(step.edge);
        let mut ends = step.values;
        if step.is_backward != is_turned {
            ends.reverse();
        }
        crossings.push(Crossing { key: Key { index, edge }, own: step.edge, is_turned, ends });
    }
    if !first_is_up {
        crossings.rotate_left(1);
    }
    // With more than two, what is in the middle is one piece: the corners on the other side are cut off one by one.
    let is_below = crossings.len() > 2
        && cell.centre().and_then(|centre| cells.value(centre)).is_some_and(|middle| middle < value);
    let count = crossings.len();
    for k in (0..count).step_by(2) {
        // An arc above the value starts with the up; an arc below it ends with it.
        let down = if is_below { k + 1 } else { (k + count - 1) % count };
        segments.push(Segment { cell, ends: [crossings[k], crossings[down]] });
    }
}
