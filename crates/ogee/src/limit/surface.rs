//! `LimitSurface`: the limit surface of a cage at any point.

use super::{Derivatives, LimitJet, Samples, SurfacePoint};
use crate::math::Vec3;
use crate::patch::{Location, PatchTable};

/// stub
#[derive(Clone, Debug)]
pub struct LimitSurface<'a> {
    table: &'a PatchTable,
    points: Vec<Vec3>,
}

impl<'a> LimitSurface<'a> {
    /// stub
    pub fn new(table: &'a PatchTable, cage: &'a [Vec3]) -> LimitSurface<'a> {
        LimitSurface { table, points: cage.to_vec() }
    }

    /// The table it was made with.
    pub fn table(&self) -> &'a PatchTable {
        self.table
    }

    /// Position, tangents and normal.
    pub fn eval(&self, at: Location) -> SurfacePoint {
        SurfacePoint { position: self.points[0] + Vec3::new(at.u, at.v, 0.0), ..SurfacePoint::default() }
    }

    /// Second derivatives as well.
    pub fn jet(&self, at: Location) -> LimitJet {
        let mut jet = LimitJet::default();
        jet.jet.position = self.eval(at).position;
        jet
    }

    /// Many points at once.
    pub fn eval_batch(&self, at: &[Location], what: Derivatives) -> Samples {
        let mut samples = Samples::default();
        self.eval_into(at, what, &mut samples);
        samples
    }

    /// Many points at once, into memory that is there already.
    pub fn eval_into(&self, at: &[Location], what: Derivatives, out: &mut Samples) {
        let _ = what;
        out.position = at.iter().map(|&at| self.eval(at).position).collect();
        out.flags = vec![super::Flags::NONE; at.len()];
    }
}
