//! `Evaluator`: what gives points at the addresses of a table.

use super::{Derivatives, LimitSurface, Samples};
use crate::patch::{Location, PatchTable};

/// A surface over the parametric faces of a cage: its limit surface, or one that differs from it in places.
pub trait Evaluator: Sync {
    /// The table whose locations are evaluated.
    fn table(&self) -> &PatchTable;

    /// Many points at once, in the order asked, on all cores, into memory that is there already; derivatives are with respect
    /// to the parameters of the locations.
    ///
    /// # Panics
    /// If a location is of a larger table; one of another table of the same size gives a point of no meaning.
    fn eval_into(&self, at: &[Location], what: Derivatives, out: &mut Samples);
}

impl Evaluator for LimitSurface<'_> {
    fn table(&self) -> &PatchTable {
        LimitSurface::table(self)
    }

    fn eval_into(&self, at: &[Location], what: Derivatives, out: &mut Samples) {
        LimitSurface::eval_into(self, at, what, out);
    }
}
