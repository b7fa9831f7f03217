//! `Pattern`: the same places on every parametric face.

use std::sync::OnceLock;

use super::Derivatives;
use super::evaluate::Item;
use super::weights::Weights;
use crate::patch::{Location, LocationError, PatchTable, Tail, child};

/// Places in `[0, 1]^2` that are evaluated on one parametric face after the other, by
/// [`LimitSurface::eval_pattern`](crate::LimitSurface::eval_pattern), for any pose of the table's cage.
///
/// Tails of one kind share the weights of the places over their rings. They are worked out when the first such tail is met, in
/// some microseconds and kilobytes a kind, and kept: a pattern is to be used for many faces, and again for the next pose.
/// Of more than 64 places on a tail, and at places deep in one, each is evaluated as [`LimitSurface::eval_batch`] does.
///
/// [`LimitSurface::eval_batch`]: crate::LimitSurface::eval_batch
///
/// ```
/// use ogee::{Derivatives, Level, LimitSurface, PatchTable, Samples, shapes};
///
/// let mesh = shapes::cube();
/// let table = PatchTable::new(&Level::new(&mesh)?);
/// let surface = LimitSurface::new(&table, &mesh.points);
///
/// // The middles of the four quarters of every face, two faces at a time.
/// let places = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]];
/// let pattern = table.pattern(&places, Derivatives::First)?;
/// let mut samples = Samples::default();
/// for first in (0..table.len()).step_by(2) {
///     surface.eval_pattern(&pattern, first..first + 2, &mut samples)?;
///     assert_eq!(samples.normal.len(), 2 * places.len());
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pattern<'a> {
    table: &'a PatchTable,
    what: Derivatives,
    sheet: Sheet,
}

impl PatchTable {
    /// Places `[u, v]` for every parametric face, and how much is wanted there.
    ///
    /// # Errors
    /// [`LocationError::OutsideSquare`] with the first place that is not in `[0, 1]^2`.
    pub fn pattern(&self, places: &[[f64; 2]], what: Derivatives) -> Result<Pattern<'_>, LocationError> {
        let corner = Location { root: 0, u: 0.0, v: 0.0 };
        let mut items = Vec::with_capacity(places.len());
        for (index, &[u, v]) in places.iter().enumerate() {
            corner.at(u, v)?;
            items.push(Item { u, v, index: index as u32 });
        }
        Ok(Pattern { table: self, what, sheet: Sheet::new(items, 0, self) })
    }
}

impl<'a> Pattern<'a> {
    /// The table it was made with.
    pub fn table(&self) -> &'a PatchTable {
        self.table
    }

    /// How many places there are on a face.
    pub fn len(&self) -> usize {
        self.sheet.items.len()
    }

    /// True if there are no places.
    pub fn is_empty(&self) -> bool {
        self.sheet.items.is_empty()
    }

    /// How much is wanted at the places.
    pub fn derivatives(&self) -> Derivatives {
        self.what
    }

    /// The places on a whole face.
    pub(super) fn sheet(&self) -> &Sheet {
        &self.sheet
    }
}

/// The places on a piece of the parameters of a face, and their weights for each kind of tail. What nobody asks for is not
/// made.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// In the parameters of the piece.
    pub(super) items: Vec<Item>,
    /// How often the face was halved.
    pub(super) depth: i32,
    /// By kind, and by the corner that is irregular.
    tails: Vec<[OnceLock<Weights>; 4]>,
    quarters: OnceLock<Box<[Sheet; 4]>>,
}

impl Sheet {
    fn new(items: Vec<Item>, depth: i32, table: &PatchTable) -> Sheet {
        let tails = vec![Default::default(); table.kind_count()];
        Sheet { items, depth, tails, quarters: OnceLock::new() }
    }

    /// True if it has all places of a face, in their order.
    #[inline(always)]
    pub(super) fn is_whole(&self) -> bool {
        self.depth == 0
    }

    /// The weights for a tail.
    #[inline]
    pub(super) fn weights(&self, table: &PatchTable, tail: Tail, what: Derivatives) -> &Weights {
        self.tails[tail.kind as usize][tail.corner as usize]
            .get_or_init(|| Weights::new(table.basis(tail), tail.corner, &self.items, self.depth, what))
    }

    /// The places on the four pieces of a split.
    pub(super) fn quarters(&self, table: &PatchTable) -> &[Sheet; 4] {
        self.quarters.get_or_init(|| {
            let quarter = |corner| {
                let places = self.items.iter().filter_map(|&Item { u, v, index }| {
                    let (quarter, u, v) = child(u, v);
                    (quarter == corner).then_some(Item { u, v, index })
                });
                Sheet::new(places.collect(), self.depth + 1, table)
            };
            Box::new(std::array::from_fn(quarter))
        })
    }
}
