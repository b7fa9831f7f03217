//! Numbers in text files: read to the nearest `f64`, written with the fewest digits that read back as the same number.

use std::fmt;

/// Displays a finite number with the fewest digits that read back as the same one; very large and very small
/// ones with an exponent. Fit for OBJ, OFF and JSON alike.
pub(crate) struct Shortest(pub(crate) f64);

impl fmt::Display for Shortest {
    #[inline]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-5..1e16).contains(&size) {
            fmt::Display::fmt(&self.0, f)
        } else {
            fmt::LowerExp::fmt(&self.0, f)
        }
    }
}

/// The finite decimal number at the start of a text, to the nearest `f64`, and how many bytes it has.
#[inline]
pub(crate) fn decimal(text: &[u8]) -> Option<(f64, usize)> {
    fast_float2::parse_partial::<f64, _>(text).ok().filter(|(value, _)| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        for (value, text) in [(1.0, "1"), (-0.1, "-0.1"), (1e-20, "1e-20"), (0.0, "0"), (2.5e300, "2.5e300")]
        {
            assert_eq!(Shortest(value).to_string(), text);
        }
        for value in [f64::MIN_POSITIVE, f64::MAX, 1.0 / 3.0, 9.999_999e-6, 5e-324] {
            assert_eq!(Shortest(value).to_string().parse(), Ok(value));
        }
    }
}
