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

/// Powers of ten; as `f64` they are exact, and so is each whole number below the last.
const TENS: [u64; 16] = {
    let mut tens = [1; 16];
    let mut k = 1;
    while k < tens.len() {
        tens[k] = 10 * tens[k - 1];
        k += 1;
    }
    tens
};

/// The finite decimal number at the start of a text, to the nearest `f64`, and how many bytes it has.
#[inline]
pub(crate) fn decimal(text: &[u8]) -> Option<(f64, usize)> {
    short_decimal(text)
        .or_else(|| fast_float2::parse_partial::<f64, _>(text).ok().filter(|(value, _)| value.is_finite()))
}

/// As [`decimal`], if the number has few digits, no exponent and a blank after it: the quotient of two whole numbers, both of them
/// `f64` exactly, is the nearest.
#[inline]
fn short_decimal(text: &[u8]) -> Option<(f64, usize)> {
    let is_negative = text.first() == Some(&b'-');
    let sign = usize::from(is_negative);
    let (mut digits, whole) = up_to_eight_digits(text.get(sign..)?);
    let mut end = sign + whole;
    let mut decimals = 0;
    if text.get(end) == Some(&b'.') {
        end += 1;
        // Twice eight digits are one more than fit.
        for _ in 0..2 {
            let (more, count) = up_to_eight_digits(&text[end..]);
            decimals += count;
            end += count;
            digits = digits.wrapping_mul(TENS[count]).wrapping_add(more);
            if count < 8 {
                break;
            }
        }
    }
    let is_ended = matches!(text.get(end), Some(b' ' | b'\n' | b'\r' | b'\t'));
    if !is_ended || !(1..TENS.len()).contains(&(whole + decimals)) {
        return None;
    }
    let size = digits as f64 / TENS[decimals] as f64;
    Some((if is_negative { -size } else { size }, end))
}

/// The digits at the start of a text, eight at most, as a number, and how many they are.
#[inline]
pub(crate) fn up_to_eight_digits(text: &[u8]) -> (u64, usize) {
    const ONES: u64 = 0x0101_0101_0101_0101;
    let Some(bytes) = text.first_chunk::<8>() else {
        let digits = text.iter().map(|b| b.wrapping_sub(b'0')).take_while(|&digit| digit < 10);
        return digits.fold((0, 0), |(value, count), digit| (10 * value + u64::from(digit), count + 1));
    };
    let digits = u64::from_le_bytes(*bytes) ^ (u64::from(b'0') * ONES);
    // The high bit of each byte tells whether it is no digit.
    let others = (((digits & (0x7f * ONES)) + (0x80 - 10) * ONES) | digits) & (0x80 * ONES);
    let count = others.trailing_zeros() as usize / 8;
    // Zeros in front, then pairs of digits, of pairs, of fours side by side.
    let digits = digits.checked_shl(64 - 8 * count as u32).unwrap_or(0);
    let pairs = (digits.wrapping_mul(10) + (digits >> 8)) & 0x00ff_00ff_00ff_00ff;
    let fours = (pairs.wrapping_mul(100) + (pairs >> 16)) & 0x0000_ffff_0000_ffff;
    let eight = (fours.wrapping_mul(10_000) + (fours >> 32)) & 0xffff_ffff;
    (eight, count)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

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

    #[test]
    fn digits_are_counted_and_read() {
        for (text, value, count) in [
            ("", 0, 0),
            ("7", 7, 1),
            ("12 45", 12, 2),
            ("1234567/", 1_234_567, 7),
            ("12345678", 12_345_678, 8),
            ("99999999999", 99_999_999, 8),
            ("0000000123456", 1, 8),
            ("/1234567", 0, 0),
            (":1234567", 0, 0),
            ("09\u{e9}34567", 9, 2),
            ("1\u{b0}\u{b1}2345", 1, 1),
            ("00120000 ", 120_000, 8),
        ] {
            assert_eq!(up_to_eight_digits(text.as_bytes()), (value, count), "{text}");
        }
    }

    proptest! {
        #[test]
        fn numbers_are_the_nearest(
            sign in "[-+]?",
            digits in "[0-9]{0,18}(\\.[0-9]{0,20})?",
            exponent in "([eE][-+]?[0-9]{0,3})?",
            end in "[ \t\n\r]|x|",
        ) {
            let number = format!("{sign}{digits}{exponent}");
            let read = decimal(format!("{number}{end}").as_bytes());
            match number.parse::<f64>() {
                Ok(value) if value.is_finite() => {
                    let (read, length) = read.unwrap();
                    prop_assert_eq!((read.to_bits(), length), (value.to_bits(), number.len()));
                }
                // A number may be followed by something that makes another word of it.
                _ => prop_assert!(read.is_none_or(|(_, length)| length < number.len())),
            }
        }
    }
}
