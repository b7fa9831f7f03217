//! What a stencil can carry.

use super::Vec3;

/// A quantity that affine combinations make sense for: points, uv, colours, weights.
///
/// Two operations are enough, so any type can join.
pub trait Interpolate: Clone + Send + Sync {
    /// The neutral element of addition.
    fn zero() -> Self;
    /// `self += weight * value`.
    fn add_scaled(&mut self, weight: f64, value: &Self);
}

impl Interpolate for f64 {
    fn zero() -> f64 {
        0.0
    }
    #[inline]
    fn add_scaled(&mut self, weight: f64, value: &f64) {
        *self += weight * value;
    }
}

impl<const N: usize> Interpolate for [f64; N] {
    fn zero() -> [f64; N] {
        [0.0; N]
    }
    #[inline]
    fn add_scaled(&mut self, weight: f64, value: &[f64; N]) {
        for (own, other) in self.iter_mut().zip(value) {
            *own += weight * other;
        }
    }
}

impl Interpolate for Vec3 {
    fn zero() -> Vec3 {
        Vec3::ZERO
    }
    #[inline]
    fn add_scaled(&mut self, weight: f64, value: &Vec3) {
        *self += weight * *value;
    }
}

/// What is numbers in a row, so that many of them are one long row: points, uv, weights. Inner loops run over the numbers.
pub trait Components: Interpolate + bytemuck::Pod {
    /// How many numbers one is.
    const COUNT: usize = size_of::<Self>() / size_of::<f64>();
}

impl Components for f64 {}
impl<const N: usize> Components for [f64; N] where [f64; N]: bytemuck::Pod {}
impl Components for Vec3 {}
