//! The pole between two lenses: the middle of the slit that joins them.

use super::polar_error::{PolarDefect, PolarError};
use crate::math::Vec3;

/// The limit point at the middle of the slit between a pair of lenses: a pole for the cap inside the circles around them.
///
/// `slit` are the `m + 1` vertices from one lens to the other, `circle` the `2 m` of the innermost circle around them: `circle[x]`
/// beside `slit[x]` on one side for `0 <= x <= m`, and `circle[2 m - x]` on the other.
///
/// # Errors
/// If the slit has fewer than two edges, or the circle not two points an edge.
pub fn pair_pole(slit: &[Vec3], circle: &[Vec3]) -> Result<Vec3, PolarError> {
    let (edges, points) = (slit.len().saturating_sub(1), circle.len());
    if edges < 2 || points != 2 * edges {
        return Err(PolarDefect::Slit { edges, points }.into());
    }
    // The cubic across the slit at x, on the slit.
    let cubic = |x: usize| (circle[x] + 4.0 * slit[x] + circle[(points - x) % points]) / 6.0;
    let middle = edges / 2;
    Ok(if edges.is_multiple_of(2) {
        (cubic(middle - 1) + 4.0 * cubic(middle) + cubic(middle + 1)) / 6.0
    } else {
        // The middle of a span of the cubic along the slit.
        let inner = cubic(middle) + cubic(middle + 1);
        (cubic(middle - 1) + 23.0 * inner + cubic(middle + 2)) / 48.0
    })
}
