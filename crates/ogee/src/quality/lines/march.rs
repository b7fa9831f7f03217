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

#[cfg(test)]
mod tests {
    use super::super::lattice::Lattice;
    use super::super::wanted::Wanted;
    use super::super::{Levels, LineOptions};
    use super::*;
    use crate::mesh::shapes;
    use crate::quality::{Field, LimitView, Surface};
    use crate::{Level, LimitSurface, PatchTable, Vec3};

    /// The sides of a lone cell from which and to which lines of value 0 go; 0 is below, then counter-clockwise.
    fn ways(corners: [f64; 4], middle: f64) -> Vec<[usize; 2]> {
        let mesh = shapes::grid(1, 1);
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let view = LimitView::new(&level, &surface);
        let lattice = Lattice::new(view.layout());
        let levels = Levels::Listed(vec![0.0]);
        let field = Field::Isophote { light: Vec3::new(0.0, 0.0, 1.0) };
        let wanted = Wanted::new(&field, &LineOptions::new(1.0));
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let plan = Plan { lattice: &lattice, levels: &levels, wanted: &wanted, range, leaps: false, most: 9 };
        let cell = Cell { start: [8, 16], size: 4 };
        let side = |crossing: &Crossing| match (crossing.own.axis, crossing.own.start) {
            (0, [8, 16]) => 0,
            (1, [12, 16]) => 1,
            (0, [8, 20]) => 2,
            (1, [8, 16]) => 3,
            other => panic!("{other:?}"),
        };
        let segments = march(0, &Cells::lone(cell, corners, middle), &plan).unwrap();
        segments.iter().map(|segment| segment.ends.each_ref().map(side)).collect()
    }

    #[test]
    fn what_is_below_lies_on_the_left() {
        // The corner at the start is below: the line goes from the side below to that on the left.
        assert_eq!(ways([-1.0, 1.0, 1.0, 1.0], 1.0), [[0, 3]]);
        assert_eq!(ways([-1.0, -1.0, 1.0, 1.0], 0.5), [[1, 3]]);
        assert_eq!(ways([1.0, 1.0, -1.0, -1.0], 0.5), [[3, 1]]);
        // What is at the value is above it.
        assert_eq!(ways([0.0, 0.0, -1.0, -1.0], 0.5), [[3, 1]]);
        assert!(ways([0.0, 0.0, 1.0, 1.0], 0.5).is_empty());
    }

    #[test]
    fn on_a_saddle_the_middle_decides() {
        // Corners 0 and 2 are below. If the middle is above they are cut off, each by itself; else the others are.
        assert_eq!(ways([-1.0, 1.0, -1.0, 1.0], 0.5), [[0, 3], [2, 1]]);
        assert_eq!(ways([-1.0, 1.0, -1.0, 1.0], -0.5), [[0, 1], [2, 3]]);
    }
}
