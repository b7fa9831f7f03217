//! How Part 21 spells numbers, strings and lists.

use std::fmt::{self, Display, Formatter, Write};

/// Appends a finite number as a STEP real: the shortest digits that read back as the same number, always with
/// a point (`1.`, `1.5E-7`); zero has no sign.
pub(super) fn push_real(text: &mut Vec<u8>, number: f64) {
    let start = text.len();
    // The digits are those of JSON, found five times as fast as by `Display`; -0.0 + 0.0 is 0.0. Writing to a
    // Vec cannot fail.
    let _ = serde_json::to_writer(&mut *text, &(number + 0.0));
    if text.ends_with(b".0") {
        text.pop();
    } else if let Some(exponent) = text[start..].iter().position(|&letter| letter == b'e') {
        let exponent = start + exponent;
        text[exponent] = b'E';
        if !text[start..exponent].contains(&b'.') {
            text.insert(exponent, b'.');
        }
    }
}

/// A real, for `format_args!`.
pub(super) struct Real(pub(super) f64);

impl Display for Real {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut text = Vec::new();
        push_real(&mut text, self.0);
        f.write_str(std::str::from_utf8(&text).map_err(|_| fmt::Error)?)
    }
}

/// A string with its quotes: `'` and `\` doubled, everything beyond printable ASCII as `\X2\..\X0\`.
pub(super) struct Text<'a>(pub(super) &'a str);

impl Display for Text<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        #[derive(PartialEq)]
        enum Coding {
            Plain,
            TwoBytes,
            FourBytes,
        }
        let mut now = Coding::Plain;
        f.write_char('\'')?;
        for letter in self.0.chars() {
            let wanted = match letter {
                ' '..='~' => Coding::Plain,
                '\0'..='\u{ffff}' => Coding::TwoBytes,
                _ => Coding::FourBytes,
            };
            if wanted != now {
                if now != Coding::Plain {
                    f.write_str("\\X0\\")?;
                }
                f.write_str(match wanted {
                    Coding::Plain => "",
                    Coding::TwoBytes => "\\X2\\",
                    Coding::FourBytes => "\\X4\\",
                })?;
                now = wanted;
            }
            match (&now, letter) {
                (Coding::Plain, '\'' | '\\') => write!(f, "{letter}{letter}")?,
                (Coding::Plain, _) => f.write_char(letter)?,
                (Coding::TwoBytes, _) => write!(f, "{:04X}", u32::from(letter))?,
                (Coding::FourBytes, _) => write!(f, "{:08X}", u32::from(letter))?,
            }
        }
        if now != Coding::Plain {
            f.write_str("\\X0\\")?;
        }
        f.write_char('\'')
    }
}

/// `.T.` or `.F.`
pub(super) struct Logical(pub(super) bool);

impl Display for Logical {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0 { ".T." } else { ".F." })
    }
}

/// A list of anything: `(a,b,c)`.
#[derive(Clone)]
pub(super) struct List<I>(pub(super) I);

impl<I> Display for List<I>
where
    I: IntoIterator<Item: Display> + Clone,
{
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("(")?;
        for (i, item) in self.0.clone().into_iter().enumerate() {
            if i > 0 {
                f.write_str(",")?;
            }
            item.fmt(f)?;
        }
        f.write_str(")")
    }
}

/// The number of an entity: `#12`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Id(pub(super) u64);

impl Display for Id {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        // By hand: a large file names a million points.
        let mut text = [0; 21];
        let mut start = text.len();
        let mut rest = self.0;
        loop {
            start -= 1;
            text[start] = b'0' + (rest % 10) as u8;
            rest /= 10;
            if rest == 0 {
                break;
            }
        }
        text[start - 1] = b'#';
        f.write_str(std::str::from_utf8(&text[start - 1..]).map_err(|_| fmt::Error)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(number: f64) -> String {
        Real(number).to_string()
    }

    #[test]
    fn reals_have_points_and_read_back() {
        assert_eq!(real(1.0), "1.");
        assert_eq!(real(-2.5), "-2.5");
        assert_eq!(real(0.0), "0.");
        assert_eq!(real(-0.0), "0.");
        assert_eq!(real(1e-7), "1.E-7");
        assert_eq!(real(-1.5e-7), "-1.5E-7");
        assert_eq!(real(1e20).parse(), Ok(1e20));
        assert_eq!(real(0.1), "0.1");
        assert_eq!(real(1e15), "1000000000000000.");
        for number in [1.0 / 3.0, f64::MAX, f64::MIN_POSITIVE, 5e-324, 1e16, 123_456_789.123_456_79, -1e-5] {
            let text = real(number);
            assert!(text.contains('.') && !text.contains('e'), "{text}");
            assert_eq!(text.parse::<f64>().unwrap(), number);
        }
    }

    #[test]
    fn strings_are_escaped() {
        assert_eq!(Text("it's").to_string(), "'it''s'");
        assert_eq!(Text("a\\b").to_string(), "'a\\\\b'");
        assert_eq!(Text("é").to_string(), "'\\X2\\00E9\\X0\\'");
        assert_eq!(Text("aéüb").to_string(), "'a\\X2\\00E900FC\\X0\\b'");
        assert_eq!(Text("é😀").to_string(), "'\\X2\\00E9\\X0\\\\X4\\0001F600\\X0\\'");
        assert_eq!(Text("a\nb").to_string(), "'a\\X2\\000A\\X0\\b'");
    }

    #[test]
    fn ids_are_decimal() {
        assert_eq!(Id(7).to_string(), "#7");
        assert_eq!(Id(u64::MAX).to_string(), "#18446744073709551615");
    }

    #[test]
    fn lists_nest() {
        let rows = [[Id(1), Id(2)], [Id(3), Id(4)]];
        assert_eq!(List(rows.map(List)).to_string(), "((#1,#2),(#3,#4))");
    }
}
