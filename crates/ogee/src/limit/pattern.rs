//! `Pattern`: the same places on every parametric face.

use std::sync::OnceLock;

use super::Derivatives;
use super::evaluate::Item;
use super::weights::Weights;
use crate::patch::{Location, LocationError, PatchTable, Tail, child};

/// Places in `[0, 1]^2` that are evaluated on one parametric face after the other, by
/// [`LimitSurface::eval_pattern`](crate::LimitSurface::eval_pattern). Good for every pose of the table's cage.
///
/// Pieces of one kind share the weights of the places over their points, which are worked out when the first such piece is
/// met and kept, in some kilobytes and microseconds a kind. So evaluation is quickest from some dozen faces on, and many
/// places are dealt with as in [`LimitSurface::eval_batch`](crate::LimitSurface::eval_batch).
#[derive(Clone, Debug)]
pub struct Pattern<'a> {
    table: &'a PatchTable,
    what: Derivatives,
    items: Vec<Item>,
    /// `None` if there are too many places for weights.
    sheet: Option<Sheet>,
}

/// The most places that have weights: those of a kind have to stay in the processor's cache.
const MOST_PLACES: usize = 64;

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
        let sheet = (places.len() <= MOST_PLACES).then(|| Sheet::new(items.clone(), 0, self));
        Ok(Pattern { table: self, what, items, sheet })
    }
}

impl<'a> Pattern<'a> {
    /// The table it was made with.
    pub fn table(&self) -> &'a PatchTable {
        self.table
    }

    /// How many places there are on a face.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// True if there are no places.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// How much is wanted at the places.
    pub fn derivatives(&self) -> Derivatives {
        self.what
    }

    /// The places, by their numbers.
    pub(super) fn items(&self) -> &[Item] {
        &self.items
    }

    /// What pieces share, if the places are few enough.
    pub(super) fn sheet(&self) -> Option<&Sheet> {
        self.sheet.as_ref()
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
