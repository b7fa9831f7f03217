//! The cells of a square: fine where the field bends.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::Levels;
use super::lattice::{COARSE, Lattice, Place, WHOLE, on_side, side_of};
use super::probe::{Probe, Sample};
use super::wanted::Wanted;
use crate::math::par;
use crate::quality::Field;
use crate::quality::layout::Side;

/// What decides on how fine cells are.
pub(super) struct Plan<'a> {
    pub(super) lattice: &'a Lattice<'a>,
    pub(super) levels: &'a Levels,
    pub(super) wanted: &'a Wanted<'a>,
    /// Lines beyond these values are not wanted.
    pub(super) range: [f64; 2],
    /// The field may leap within a cell whose corners all have values.
    pub(super) leaps: bool,
    /// Cells there may be in all, and pieces of lines.
    pub(super) most: usize,
}

/// Of the distance between lines: what the field may differ by from its bilinear interpolation.
const BENT: f64 = 0.1;

/// Lines through one cell at most, where they may be of a leap and not of the field.
const STEEP: f64 = 8.0;

/// A cell of a square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub(super) start: Place,
    pub(super) size: u16,
}

impl Cell {
    pub(super) fn at(self, i: u16, j: u16) -> Place {
        let half = self.size / 2;
        [self.start[0] + i * half, self.start[1] + j * half]
    }

    pub(super) fn corners(self) -> [Place; 4] {
        let ([i, j], size) = (self.start, self.size);
        [[i, j], [i + size, j], [i + size, j + size], [i, j + size]]
    }

    pub(super) fn centre(self) -> Option<Place> {
        (self.size > 1).then(|| self.at(1, 1))
    }

    fn quarters(self) -> [Cell; 4] {
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| Cell { start: self.at(i, j), size: self.size / 2 })
    }

    /// The places at a quarter and three quarters of its sides: cells beside it are too fine if they have a corner there.
    fn far_too_fine(self) -> impl Iterator<Item = Place> {
        let ([i, j], size, quarter) = (self.start, self.size, self.size / 4);
        let offsets = if quarter > 0 { vec![quarter, size - quarter] } else { Vec::new() };
        offsets.into_iter().flat_map(move |x| [[i + x, j], [i + size, j + x], [i + x, j + size], [i, j + x]])
    }
}

/// The cells of one square.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    pub(super) leaves: Vec<Cell>,
    /// The field at the corners of all cells, and in the middle of those that may be cut.
    samples: HashMap<Place, Sample>,
    /// Where on each side there are samples.
    on_sides: [Vec<u16>; 4],
}

impl Cells {
    /// One cell with these values at its corners, counter-clockwise, and in its middle.
    #[cfg(test)]
    pub(super) fn lone(cell: Cell, corners: [f64; 4], middle: f64) -> Cells {
        let places = cell.corners().into_iter().chain(cell.centre());
        let sample = |value| Sample { value: Some(value), is_near: true };
        let samples = places.zip(corners.into_iter().chain([middle]).map(sample)).collect();
        Cells { leaves: vec![cell], samples, on_sides: Default::default() }
    }

    /// The field at a place, if it was asked for.
    pub(super) fn sample(&self, place: Place) -> Option<&Sample> {
        self.samples.get(&place)
    }

    /// The value of the field at a place, if it was asked for and has one.
    pub(super) fn value(&self, place: Place) -> Option<f64> {
        self.sample(place)?.value
    }

    /// The field at the corners of a cell, and in its middle if it may be cut; `None` if it has no value in one of them.
    fn values(&self, cell: Cell) -> Option<([f64; 4], Option<f64>)> {
        let at = |place: Place| self.value(place);
        let [a, b, c, d] = cell.corners().map(at);
        let corners = [a?, b?, c?, d?];
        match cell.centre() {
            Some(centre) => Some((corners, Some(at(centre)?))),
            None => Some((corners, None)),
        }
    }

    /// True if no line is wanted in a cell.
    pub(super) fn is_far(&self, cell: Cell) -> bool {
        let mut all = cell.corners().into_iter().chain(cell.centre());
        all.all(|place| self.sample(place).is_none_or(|sample| !sample.is_near))
    }

    /// True if what crosses the sides of a cell that is not cut any more need not be lines of the field.
    pub(super) fn leaps(&self, cell: Cell, plan: &Plan<'_>) -> bool {
        let Some((corners, centre)) = self.values(cell) else { return true };
        let (low, high) = extent(&corners);
        let count = plan.levels.count(low, high);
        plan.leaps
            && count > STEEP
            // More is no leap but a question that asks too much.
            && count < plan.most as f64
            && centre.is_none_or(|centre| bend(&corners, centre) > BENT * plan.levels.spacing(low, high))
    }

    /// True if a cell has to be cut.
    fn is_rough(&self, cell: Cell, plan: &Plan<'_>) -> bool {
        let levels = plan.levels;
        if self.is_far(cell) {
            return false;
        }
        let Some((corners, Some(centre))) = self.values(cell) else {
            // Around the end of what the field is defined on, unless it is all beyond the lines.
            let all = cell.corners().into_iter().chain(cell.centre());
            let (low, high) = extent(&all.filter_map(|place| self.value(place)).collect::<Vec<_>>());
            return cell.size > 1 && low <= high && high >= plan.range[0] && low <= plan.range[1];
        };
        let (low, high) = extent(&corners);
        let bend = bend(&corners, centre);
        let (least, most) = (low.min(centre) - bend, high.max(centre) + bend);
        let (least, most) = (least.max(plan.range[0]), most.min(plan.range[1]));
        if least > most || levels.between(least, most).is_empty() {
            return false;
        }
        // A line that the corners do not know of, or one that may run otherwise than they say.
        !levels.between(low.min(centre), low).is_empty()
            || !levels.between(high, high.max(centre)).is_empty()
            || bend > BENT * levels.spacing(least, most)
    }

    /// Evaluates the field wherever these cells want it.
    fn fill(&mut self, square: u32, cells: &[Cell], plan: &Plan<'_>, probe: &mut Probe<'_>) {
        let places = cells.iter().flat_map(|cell| cell.corners().into_iter().chain(cell.centre()));
        self.evaluate(square, places.collect(), plan, probe);
    }

    fn evaluate(&mut self, square: u32, mut places: Vec<Place>, plan: &Plan<'_>, probe: &mut Probe<'_>) {
        places.retain(|place| !self.samples.contains_key(place));
        places.sort_unstable();
        places.dedup();
        let at: Vec<_> = places.iter().map(|&place| plan.lattice.location(square, place)).collect();
        let is_near = |position, normal| plan.wanted.is_near(position, normal);
        for (place, sample) in places.into_iter().zip(probe.values(&at, is_near)) {
            self.samples.insert(place, sample);
            // Corners of the square are always there.
            if let Some((side, x)) = side_of(place) {
                self.on_sides[side as usize].push(x);
            }
        }
    }

    /// Cuts cells until none is rough, nor twice as large as one beside it or more.
    fn settle(
        &mut self,
        square: u32,
        mut open: Vec<Cell>,
        plan: &Plan<'_>,
        probe: &mut Probe<'_>,
        count: &AtomicUsize,
    ) {
        while !open.is_empty() {
            while !open.is_empty() {
                self.fill(square, &open, plan, probe);
                let is_full = count.fetch_add(open.len(), Ordering::Relaxed) > plan.most;
                let (rough, smooth): (Vec<Cell>, Vec<Cell>) =
                    open.into_iter().partition(|&cell| !is_full && self.is_rough(cell, plan));
                self.leaves.extend(smooth);
                open = rough.into_iter().flat_map(Cell::quarters).collect();
            }
            open =
                self.cut(|cells, cell| cell.far_too_fine().any(|place| cells.samples.contains_key(&place)));
        }
    }

    /// Takes out the leaves that are chosen, cut in four.
    fn cut(&mut self, chosen: impl Fn(&Cells, Cell) -> bool) -> Vec<Cell> {
        let leaves = std::mem::take(&mut self.leaves);
        let (cut, kept): (Vec<Cell>, Vec<Cell>) = leaves.into_iter().partition(|&leaf| chosen(self, leaf));
        self.leaves = kept;
        cut.into_iter().flat_map(Cell::quarters).collect()
    }
}

/// The cells of all squares, none of them twice as large as one beside it or more, over smooth joints too.
pub(super) struct AllCells {
    pub(super) squares: Vec<Cells>,
    /// Squares whose cells are not as they were when somebody last asked.
    changed: Vec<bool>,
    count: AtomicUsize,
}

impl AllCells {
    /// Cells as fine as the field asks for.
    pub(super) fn new<'a>(plan: &Plan<'_>, probe: impl Fn() -> Probe<'a> + Sync + Send) -> AllCells {
        let squares = plan.lattice.layout.squares().len();
        let along = coarse(squares, plan.most);
        let size = WHOLE / along;
        let coarse: Vec<Cell> = (0..along)
            .flat_map(|j| (0..along).map(move |i| Cell { start: [i * size, j * size], size }))
            .collect();
        let count = AtomicUsize::new(0);
        let squares = par::map(squares, |square| {
            let mut cells = Cells::default();
            cells.settle(square as u32, coarse.clone(), plan, &mut probe(), &count);
            cells
        });
        let changed = vec![true; squares.len()];
        let mut all = AllCells { squares, changed, count };
        all.share(plan, &probe);
        all
    }

    /// Cuts some cells, named by square and rising, and whatever has to be cut with them.
    pub(super) fn refine<'a>(
        &mut self,
        rough: &[(u32, Cell)],
        plan: &Plan<'_>,
        probe: impl Fn() -> Probe<'a> + Sync + Send,
    ) {
        self.change(plan, &probe, |square, _| {
            let of =
                |end: bool| rough.partition_point(|&(other, _)| other < square || end && other == square);
            (rough[of(false)..of(true)].iter().map(|&(_, cell)| cell).collect(), Vec::new())
        });
        self.share(plan, &probe);
    }

    /// The squares whose cells have changed since this was last asked, all of them at first.
    pub(super) fn news(&mut self) -> Vec<usize> {
        (0..self.changed.len()).filter(|&square| std::mem::take(&mut self.changed[square])).collect()
    }

    /// The least and the greatest value that the field was seen to have.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        let values =
            self.squares.iter().flat_map(|cells| cells.samples.values().filter_map(|sample| sample.value));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        (low <= high).then_some([low, high])
    }

    /// True if there are more than there may be.
    pub(super) fn are_too_many(&self, plan: &Plan<'_>) -> bool {
        self.count.load(Ordering::Relaxed) > plan.most
    }

    /// Tells squares of the places on their sides that their neighbours have, until all have the same.
    fn share<'a>(&mut self, plan: &Plan<'_>, probe: &(impl Fn() -> Probe<'a> + Sync + Send)) {
        let news = |square: u32, all: &[Cells]| {
            let mine = &all[square as usize];
            let sides = (0..4).filter_map(|side| Some((side, plan.lattice.across(Side { square, side })?)));
            let there = sides.flat_map(|(side, other)| {
                let other = &all[other.square as usize].on_sides[other.side as usize];
                other.iter().map(move |x| on_side(side, WHOLE - x))
            });
            let mut news: Vec<Place> = there.filter(|place| !mine.samples.contains_key(place)).collect();
            news.sort_unstable();
            news
        };
        while !self.are_too_many(plan)
            && self.change(plan, probe, |square, all| (Vec::new(), news(square, all)))
        {}
    }

    /// Cuts cells of each square and evaluates the field at more of its places; false if there was nothing to do.
    fn change<'a>(
        &mut self,
        plan: &Plan<'_>,
        probe: &(impl Fn() -> Probe<'a> + Sync + Send),
        wanted: impl Fn(u32, &[Cells]) -> (Vec<Cell>, Vec<Place>) + Sync + Send,
    ) -> bool {
        let AllCells { squares, count, .. } = self;
        let new = par::map(squares.len(), |number| {
            let square = number as u32;
            let (cut, places) = wanted(square, squares);
            if cut.is_empty() && places.is_empty() {
                return None;
            }
            let (mut cells, mut probe) = (squares[number].clone(), probe());
            cells.evaluate(square, places, plan, &mut probe);
            let is_too_coarse = |cells: &Cells, cell: Cell| {
                cell.far_too_fine().any(|place| cells.samples.contains_key(&place))
            };
            let open = cells.cut(|cells, cell| cut.contains(&cell) || is_too_coarse(cells, cell));
            cells.settle(square, open, plan, &mut probe, count);
            Some(cells)
        });
        let mut is_changed = false;
        for (number, new) in new.into_iter().enumerate() {
            if let Some(new) = new {
                squares[number] = new;
                self.changed[number] = true;
                is_changed = true;
            }
        }
        is_changed
    }
}

/// Cells along a side of a square to begin with: fewer where there are so many squares that these alone would be half of
/// the most cells. There faces are small, and cells are cut where the field bends as ever.
fn coarse(squares: usize, most: usize) -> u16 {
    let mut along = COARSE;
    while along > 1 && squares * usize::from(along).pow(2) > most / 2 {
        along /= 2;
    }
    along
}

/// The least and the greatest; the wrong way round if there are none.
fn extent(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)))
}

/// How far the field in the middle is from what the corners of a cell say.
fn bend(corners: &[f64; 4], centre: f64) -> f64 {
    (0.25 * corners.iter().sum::<f64>() - centre).abs()
}

/// True if a field can leap from one end of numbers to the other: where rays run along the plane.
pub(super) fn can_leap(field: &Field) -> bool {
    matches!(field, Field::Plane { .. })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::{LimitView, LineOptions, Surface};
    use crate::{Level, LimitSurface, PatchTable, Vec3, shapes};

    #[test]
    fn many_squares_begin_with_few_cells() {
        assert_eq!([100, 1000, 10_000, 100_000].map(|most| coarse(400, most)), [1, 1, 2, 8]);
        let mesh = shapes::torus(10, 8);
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let limit = LimitSurface::new(&table, &mesh.points);
        let surface = LimitView::new(&level, &limit);
        let lattice = Lattice::new(surface.layout());
        let field = Field::Isophote { light: Vec3::new(0.0, 0.6, 0.8) };
        let levels = Levels::Listed(vec![0.5]);
        let wanted = Wanted::new(&field, &LineOptions::new(1e-3));
        // Less than eight by eight in each of the squares.
        let most = 60 * surface.layout().squares().len();
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let plan = Plan { lattice: &lattice, levels: &levels, wanted: &wanted, range, leaps: false, most };
        let cells = AllCells::new(&plan, || Probe::new(&surface, &field));
        assert!(!cells.are_too_many(&plan));
        let area = |cells: &Cells| cells.leaves.iter().map(|cell| u32::from(cell.size).pow(2)).sum::<u32>();
        assert!(cells.squares.iter().all(|cells| area(cells) == u32::from(WHOLE).pow(2)));
    }
}
