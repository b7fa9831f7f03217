//! B-spline curves in files of their own: STEP and OBJ.

mod obj;

use ogee::nurbs::NurbsCurve;

pub use crate::step::write_curves as write_step;
pub use obj::write_obj;

/// A curve with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCurve {
    /// What files call it.
    pub name: String,
    /// The curve.
    pub curve: NurbsCurve,
}
