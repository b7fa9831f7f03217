//! How much of a pixel is bright: patterns averaged over the width of the pixel in them.
//!
//! `spread` is that width: how far the pattern's coordinate moves from one side of the pixel to the other, along both sides
//! together. Widths come from derivatives, so no neighbour pixel is asked, and stripes fade to an even grey where they are
//! finer than pixels.

/// The share of a stripe pattern that is bright within `spread` around `x`, all in periods; `width` is the bright share.
#[inline]
pub fn stripe(x: f64, spread: f64, width: f64) -> f64 {
    // Half a period and more would need no filter of this kind; beyond a hundred all is grey.
    let spread = spread.clamp(1e-9, 1e2);
    let before = |x: f64| x.floor() * width + (x - x.floor()).min(width);
    ((before(x + 0.5 * spread) - before(x - 0.5 * spread)) / spread).clamp(0.0, 1.0)
}

/// The bright share of discs of radius `radius` in the middles of unit cells at `(x, y)`.
#[inline]
pub fn disc(x: f64, y: f64, spread: f64, radius: f64) -> f64 {
    let (dx, dy) = (x - x.floor() - 0.5, y - y.floor() - 0.5);
    let near = ((radius - dx.hypot(dy)) / spread.max(1e-9) + 0.5).clamp(0.0, 1.0);
    // From a pixel of half a cell to one of a whole cell the single disc gives way to the average of many.
    let part = (2.0 * spread - 1.0).clamp(0.0, 1.0);
    near + part * (std::f64::consts::PI * radius * radius - near)
}

/// The bright share of stripes both ways.
#[inline]
pub fn lattice(at: [f64; 2], spread: [f64; 2], width: f64) -> f64 {
    let (a, b) = (stripe(at[0], spread[0], width), stripe(at[1], spread[1], width));
    a + b - a * b
}

/// The bright share of a line of `width` pixels at a distance of `distance` pixels.
#[inline]
pub fn line(distance: f64, width: f64) -> f64 {
    (0.5 * width + 0.5 - distance).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stripes_are_the_average_of_what_they_cover() {
        for (x, spread, width) in
            [(0.1, 0.05, 0.3), (0.29, 0.1, 0.3), (7.93, 0.7, 0.4), (-3.2, 2.6, 0.1), (0.5, 40.3, 0.3)]
        {
            let count = 200_000;
            let bright = (0..count).filter(|&i| {
                let y: f64 = x + spread * ((f64::from(i) + 0.5) / f64::from(count) - 0.5);
                y - y.floor() < width
            });
            let average = bright.count() as f64 / f64::from(count);
            assert!((stripe(x, spread, width) - average).abs() < 1e-4);
        }
        assert!((stripe(0.37, 1e9, 0.3) - 0.3).abs() < 1e-2, "far away all is an even grey");
    }

    #[test]
    fn discs_are_bright_inside_and_average_far_away() {
        assert_eq!(disc(3.5, -2.5, 0.01, 0.3), 1.0);
        assert_eq!(disc(3.0, -2.0, 0.01, 0.3), 0.0);
        assert!((disc(0.8, 0.5, 0.01, 0.3) - 0.5).abs() < 1e-9, "half on its rim");
        assert!((disc(0.1, 0.9, 5.0, 0.3) - std::f64::consts::PI * 0.09).abs() < 1e-12);
    }
}
