//! Unit normals, four at a time and alone, and when their arithmetic is beyond doubt.

use super::out::LANES;
use crate::math::Vec3;
use crate::math::simd::Four;

/// Tangents are parallel where the sine of their angle is below this: some dozen roundings.
const PARALLEL: f64 = 1e-14;

/// Squares of products of derivatives: between these no step has over- or underflown.
const LEAST: f64 = 1e-200;
const GREATEST: f64 = 1e200;

#[inline(always)]
fn square<V: Four>(v: &[V; 3]) -> V {
    v[0].times(v[0]).plus(v[1].times(v[1])).plus(v[2].times(v[2]))
}

/// Unit normals in lanes, and in which of them the arithmetic is beyond doubt: bits, the lowest for the first.
#[inline(always)]
pub(super) fn normals<V: Four>(a: &[V; 3], b: &[V; 3]) -> ([V; 3], u32) {
    let cross = [
        a[1].times(b[2]).minus(a[2].times(b[1])),
        a[2].times(b[0]).minus(a[0].times(b[2])),
        a[0].times(b[1]).minus(a[1].times(b[0])),
    ];
    let length = square(&cross);
    let scale = V::splat(1.0).over(length.root());
    let vectors = [cross[0].times(scale), cross[1].times(scale), cross[2].times(scale)];
    let parallel = V::splat(PARALLEL * PARALLEL).times(square(a)).times(square(b));
    let sure = length.above(parallel) & length.above(V::splat(LEAST)) & V::splat(GREATEST).above(length);
    (vectors, sure)
}

/// All lanes.
pub(super) const SURE: u32 = (1 << LANES) - 1;

/// True if a normal is beyond doubt; `length` is the square of the cross product of two tangents, `first` and `second`
/// are those of the tangents.
#[inline(always)]
pub(super) fn is_sure(length: f64, first: f64, second: f64) -> bool {
    (length > PARALLEL * PARALLEL * first * second) & (length > LEAST) & (length < GREATEST)
}

/// The unit normal of two tangents of any size; nothing where they are parallel or vanish.
pub(super) fn unit_normal(a: Vec3, b: Vec3) -> Option<Vec3> {
    let (a, b) = (a.normalized()?, b.normalized()?);
    let cross = a.cross(b);
    if cross.length() > PARALLEL { cross.normalized() } else { None }
}
