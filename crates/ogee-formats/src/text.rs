//! Text as the readers see it: lines of any ending, tokens between blanks, numbers.
//!
//! Everything works on bytes and borrows: names and comments may be in any encoding, and only what has to be a
//! number is looked at closely.

use crate::error::{Fault, ReadError};

/// How much of a file is looked at to tell text from something else.
const LOOKED_AT: usize = 4096;

/// Refuses what is no text.
///
/// # Errors
/// If there is a zero byte anywhere, or a control character that no text has near the beginning.
pub(crate) fn check_is_text(bytes: &[u8], format: &str) -> Result<(), ReadError> {
    check_begins_as_text(bytes, format)?;
    // Looking whether there is one is quicker than looking where.
    if bytes.contains(&0) { Err(has_zero(bytes, format)) } else { Ok(()) }
}

/// The refusal of bytes among which there is a zero.
pub(crate) fn has_zero(bytes: &[u8], format: &str) -> ReadError {
    let at = bytes.iter().position(|&b| b == 0).unwrap_or_default();
    refusal(&format!("byte {at} is 0x00"), format)
}

/// As [`check_is_text`], for who looks for zero bytes while reading.
pub(crate) fn check_begins_as_text(bytes: &[u8], format: &str) -> Result<(), ReadError> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(refusal("it is UTF-16, save it as UTF-8", format));
    }
    // Ctrl-Z ends text files of old systems.
    let is_control = |&b: &u8| b < 0x20 && !matches!(b, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c | 0x1a);
    let near = &bytes[..bytes.len().min(LOOKED_AT)];
    match near.iter().position(is_control) {
        Some(at) => Err(refusal(&format!("byte {at} is {:#04x}", bytes[at]), format)),
        None => Ok(()),
    }
}

fn refusal(reason: &str, format: &str) -> ReadError {
    ReadError::single(Fault::new("not_text", format!("not a text file, so no {format}: {reason}")))
}

/// The bytes without a byte order mark.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Lines and their numbers from 1. A line ends with `\n`, `\r\n` or `\r`, and with the file.
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    number: u32,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Lines<'a> {
        Lines { rest: bytes, number: 0 }
    }

    /// The number of the line that came last.
    pub(crate) fn number(&self) -> u32 {
        self.number
    }

    /// What has not been read yet.
    pub(crate) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line that has a token, and its number.
    pub(crate) fn next_filled(&mut self) -> Option<(u32, Tokens<'a>)> {
        self.map(|(number, line)| (number, Tokens::new(line))).find(|(_, tokens)| !tokens.is_finished())
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (u32, &'a [u8]);

    #[inline]
    fn next(&mut self) -> Option<(u32, &'a [u8])> {
        if self.rest.is_empty() {
            return None;
        }
        self.number = self.number.saturating_add(1);
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = match rest {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => rest,
        };
        Some((self.number, line))
    }
}

/// What is known of a line when its end is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MeasuredLine {
    /// Bytes without the end.
    pub(crate) length: usize,
    /// How many of them are blanks.
    pub(crate) blanks: usize,
    /// True if it has a zero byte, which no text has.
    pub(crate) has_zero: bool,
}

/// Finds the end of the first line, eight bytes at a time.
#[inline]
pub(crate) fn measure_line(text: &[u8]) -> MeasuredLine {
    const ONES: u64 = 0x0101_0101_0101_0101;
    const HIGH: u64 = 0x80 * ONES;
    let mut measured = MeasuredLine { length: 0, blanks: 0, has_zero: false };
    while let Some(bytes) = text[measured.length..].first_chunk::<8>() {
        let word = u64::from_le_bytes(*bytes);
        // The high bit of each byte tells whether it is below 0x10, as ends of lines are, or 0x21, as all blanks are.
        let low = word & !HIGH;
        let controls = !((low + (0x80 - 0x10) * ONES) | word) & HIGH;
        let blanks = !((low + (0x80 - 0x21) * ONES) | word) & HIGH;
        if controls != 0 {
            let at = controls.trailing_zeros() as usize / 8;
            if matches!(bytes[at], b'\n' | b'\r') {
                let before = blanks & ((1 << (8 * at)) - 1);
                measured.blanks += before.count_ones() as usize;
                measured.length += at;
                return measured;
            }
            break;
        }
        measured.blanks += ((blanks >> 7).wrapping_mul(ONES) >> 56) as usize;
        measured.length += 8;
    }
    for &byte in &text[measured.length..] {
        match byte {
            b'\n' | b'\r' => break,
            0 => measured.has_zero = true,
            _ => {}
        }
        measured.blanks += usize::from(is_blank(byte));
        measured.length += 1;
    }
    measured
}

/// What stands between blanks on a line, up to a comment.
#[derive(Clone)]
pub(crate) struct Tokens<'a> {
    rest: &'a [u8],
}

impl<'a> Tokens<'a> {
    pub(crate) fn new(line: &'a [u8]) -> Tokens<'a> {
        Tokens { rest: line }
    }

    fn is_finished(&self) -> bool {
        self.clone().next().is_none()
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0b | 0x0c | 0x1a)
}

impl<'a> Iterator for Tokens<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.rest.iter().position(|&b| !is_blank(b))?;
        let filled = &self.rest[start..];
        if filled[0] == b'#' {
            self.rest = &[];
            return None;
        }
        let end = filled.iter().position(|&b| is_blank(b)).unwrap_or(filled.len());
        let (token, rest) = filled.split_at(end);
        self.rest = rest;
        Some(token)
    }
}

/// A real number; not-a-number and infinities are numbers here.
#[inline]
pub(crate) fn real(token: &[u8]) -> Option<f64> {
    std::str::from_utf8(token).ok()?.parse().ok()
}

/// A whole number of up to 18 digits.
#[inline]
pub(crate) fn integer(token: &[u8]) -> Option<i64> {
    let (negative, digits) = match token {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0i64;
    for &digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        value = value * 10 + i64::from(digit - b'0');
    }
    Some(if negative { -value } else { value })
}

/// A token for a message: short, on one line, and readable whatever it was.
pub(crate) fn shown(token: &[u8]) -> String {
    const MOST: usize = 32;
    let text = String::from_utf8_lossy(token);
    let mut shown: String = text.chars().take(MOST).flat_map(char::escape_debug).collect();
    if text.chars().nth(MOST).is_some() {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_ending_counts_once() {
        let lines: Vec<_> = Lines::new(b"a\nb\r\nc\rd\n\n\re").collect();
        let expected: [&[u8]; 7] = [b"a", b"b", b"c", b"d", b"", b"", b"e"];
        assert_eq!(lines.len(), expected.len());
        for (i, (number, line)) in lines.iter().enumerate() {
            assert_eq!((*number as usize, *line), (i + 1, expected[i]));
        }
    }

    #[test]
    fn lines_are_measured_wherever_they_end() {
        let measured = |length, blanks, has_zero| MeasuredLine { length, blanks, has_zero };
        for length in 0..40 {
            for end in ["", "\n", "\r", "\r\n", "\nv 1 2\n", "\r1 2 3 4 5 6 7 8 9"] {
                let line: String = "f 12 \u{e9}~".chars().cycle().take(length).collect();
                let blanks = line.bytes().filter(|&b| b == b' ').count();
                let text = format!("{line}{end}");
                assert_eq!(measure_line(text.as_bytes()), measured(line.len(), blanks, false), "{text:?}");
                let text = format!("{line}\t\0\x1a{end}");
                assert_eq!(
                    measure_line(text.as_bytes()),
                    measured(line.len() + 3, blanks + 2, true),
                    "{text:?}"
                );
            }
        }
    }

    #[test]
    fn tokens_end_at_a_comment() {
        let tokens: Vec<_> = Tokens::new(b"\t v  1.5\x0b2 # 3").collect();
        assert_eq!(tokens, [&b"v"[..], b"1.5", b"2"]);
    }

    #[test]
    fn integers_are_whole_and_bounded() {
        assert_eq!(integer(b"-12"), Some(-12));
        assert_eq!(integer(b"+7"), Some(7));
        for wrong in [&b""[..], b"-", b"1.0", b"0x1", b"1234567890123456789", b"1 "] {
            assert_eq!(integer(wrong), None, "{wrong:?}");
        }
    }

    #[test]
    fn shown_tokens_are_short_and_printable() {
        assert_eq!(shown(b"a\x07b"), "a\\u{7}b");
        assert_eq!(shown(&[b'x'; 100]).len(), 35);
    }

    #[test]
    fn text_is_told_from_bytes() {
        assert!(check_is_text("v 1 2 3 # caf\u{e9}\r\n\x1a".as_bytes(), "OBJ").is_ok());
        assert!(check_is_text(b"# caf\xe9", "OBJ").is_ok());
        let error = check_is_text(b"\x7fELF\x02\x01", "OBJ").unwrap_err();
        assert_eq!(error.to_string(), "not a text file, so no OBJ: byte 4 is 0x02");
        let mut late = vec![b' '; 10_000];
        late[9_000] = 0;
        assert!(check_is_text(&late, "OBJ").is_err());
        assert!(check_is_text(b"\xff\xfev\0", "OBJ").unwrap_err().to_string().contains("UTF-16"));
    }
}
