//! Lines of a file of any size, one at a time, with a bound on their length.

use std::io::{self, BufRead};

use crate::text::without_mark;

/// The longest line that is kept. An address takes less than a hundred bytes.
pub(super) const LONGEST: usize = 64 * 1024;

/// Reads lines and numbers them from 1. A line ends with `\n`, `\r\n` or `\r`, and with the file.
pub(super) struct LineReader<R> {
    source: R,
    line: Vec<u8>,
    is_too_long: bool,
    number: u32,
    /// The line before ended with `\r`, to which a `\n` may belong.
    is_after_return: bool,
}

impl<R: BufRead> LineReader<R> {
    pub(super) fn new(source: R) -> LineReader<R> {
        LineReader { source, line: Vec::new(), is_too_long: false, number: 0, is_after_return: false }
    }

    /// What comes next, as far as it is there already; empty at the end of the file.
    pub(super) fn peek(&mut self) -> io::Result<&[u8]> {
        self.source.fill_buf()
    }

    /// Goes to the next line that is not blank; false if there is none.
    pub(super) fn advance(&mut self) -> io::Result<bool> {
        while self.advance_by_one()? {
            if self.line().is_none_or(|line| !line.is_empty()) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The line, without a byte order mark and blanks around it; `None` if it is too long.
    pub(super) fn line(&self) -> Option<&[u8]> {
        let line = if self.number == 1 { without_mark(&self.line) } else { &self.line };
        (!self.is_too_long).then_some(line.trim_ascii())
    }

    /// The number of the line.
    pub(super) fn number(&self) -> u32 {
        self.number
    }

    fn advance_by_one(&mut self) -> io::Result<bool> {
        self.line.clear();
        self.is_too_long = false;
        let mut has_begun = false;
        loop {
            let buffer = self.source.fill_buf()?;
            if buffer.is_empty() {
                break;
            }
            if std::mem::take(&mut self.is_after_return) && buffer[0] == b'\n' {
                self.source.consume(1);
                continue;
            }
            if !has_begun {
                has_begun = true;
                self.number = self.number.saturating_add(1);
            }
            let end = buffer.iter().position(|&b| b == b'\n' || b == b'\r');
            let piece = &buffer[..end.unwrap_or(buffer.len())];
            self.is_too_long |= self.line.len() + piece.len() > LONGEST;
            if !self.is_too_long {
                self.line.extend_from_slice(piece);
            }
            let Some(end) = end else {
                let length = buffer.len();
                self.source.consume(length);
                continue;
            };
            self.is_after_return = buffer[end] == b'\r';
            self.source.consume(end + 1);
            break;
        }
        Ok(has_begun)
    }
}

#[cfg(test)]
mod tests {
    use std::io::BufReader;

    use super::*;

    #[test]
    fn every_line_ending_counts_once_wherever_the_buffer_ends() {
        for capacity in 1..8 {
            let text = "\u{feff}a\nb\r\nc\rd\n\n\re\r\n \n".as_bytes();
            let mut lines = LineReader::new(BufReader::with_capacity(capacity, text));
            for (number, text) in [(1, "a"), (2, "b"), (3, "c"), (4, "d"), (7, "e")] {
                assert!(lines.advance().unwrap());
                assert_eq!((lines.number(), lines.line()), (number, Some(text.as_bytes())), "{capacity}");
            }
            assert!(!lines.advance().unwrap());
        }
    }

    #[test]
    fn long_lines_are_not_kept() {
        let text = format!("{}\n{}\nend", "x".repeat(LONGEST), "y".repeat(2 * LONGEST));
        let mut lines = LineReader::new(text.as_bytes());
        assert!(lines.advance().unwrap() && lines.line().unwrap().len() == LONGEST);
        assert!(lines.advance().unwrap() && lines.line().is_none());
        assert!(lines.advance().unwrap() && lines.line() == Some(b"end") && lines.number() == 3);
        assert!(lines.line.capacity() <= 2 * LONGEST);
    }
}
