//! Statements of OBJ: lines, joined where one ends with a backslash, and what their first word says.

use std::borrow::Cow;

use crate::text::{Tokens, measure_line};

/// Statements that change nothing of the shape.
const PASSED_OVER: [&[u8]; 17] = [
    b"vn",
    b"vp",
    b"o",
    b"g",
    b"s",
    b"mg",
    b"l",
    b"p",
    b"usemtl",
    b"mtllib",
    b"usemap",
    b"maplib",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"lod",
    b"shadow_obj",
];

/// What a statement is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    TextureCoordinate,
    Face,
    /// Nothing of the shape, or nothing at all.
    Nothing,
    /// A tag, or something to be warned about.
    Other,
}

impl Kind {
    /// The kind of a statement.
    #[inline]
    pub(super) fn of(text: &[u8]) -> Kind {
        match text {
            [b'v', b' ', ..] => Kind::Vertex,
            [b'f', b' ', ..] => Kind::Face,
            [b'v', b't', b' ', ..] => Kind::TextureCoordinate,
            [b'v', b'n', b' ', ..] => Kind::Nothing,
            _ => Kind::of_keyword(Tokens::new(text).next()),
        }
    }

    fn of_keyword(keyword: Option<&[u8]>) -> Kind {
        match keyword {
            Some(b"v") => Kind::Vertex,
            Some(b"vt") => Kind::TextureCoordinate,
            Some(b"f" | b"fo") => Kind::Face,
            None => Kind::Nothing,
            Some(keyword) if PASSED_OVER.contains(&keyword) => Kind::Nothing,
            Some(_) => Kind::Other,
        }
    }
}

/// A statement.
pub(super) struct Statement<'a> {
    /// The line on which it begins, counted from 0.
    pub(super) line: usize,
    /// All of it, on one line.
    pub(super) text: Cow<'a, [u8]>,
    /// At least as many as it has words after the first.
    pub(super) blanks: usize,
}

/// The statements of a text, empty ones and comments among them.
pub(super) struct Statements<'a> {
    rest: &'a [u8],
    lines: usize,
    has_zero: bool,
}

impl<'a> Statements<'a> {
    pub(super) fn new(text: &'a [u8]) -> Statements<'a> {
        Statements { rest: text, lines: 0, has_zero: false }
    }

    /// What has not been read yet.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// How many lines have been read.
    pub(super) fn lines(&self) -> usize {
        self.lines
    }

    /// True if there was a zero byte, which no text has.
    pub(super) fn has_zero(&self) -> bool {
        self.has_zero
    }

    /// Steps over a line of so many bytes, the end of the line among them, that was read by someone else.
    #[inline]
    pub(super) fn step(&mut self, length: usize) {
        self.rest = &self.rest[length..];
        self.lines += 1;
    }

    /// The next line, and how many blanks it has.
    #[inline]
    fn line(&mut self) -> Option<(&'a [u8], usize)> {
        if self.rest.is_empty() {
            return None;
        }
        let measured = measure_line(self.rest);
        self.has_zero |= measured.has_zero;
        let (line, rest) = self.rest.split_at(measured.length);
        self.rest = match rest {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => rest,
        };
        self.lines += 1;
        Some((line, measured.blanks))
    }

    /// A line and those that continue it.
    #[cold]
    fn joined(&mut self, first: &[u8], blanks: usize) -> (Vec<u8>, usize) {
        let mut text = Vec::new();
        let (mut line, mut blanks) = (first, blanks);
        loop {
            let part = line.trim_ascii_end();
            match part.strip_suffix(b"\\") {
                Some(part) => text.extend_from_slice(part),
                None => {
                    text.extend_from_slice(part);
                    break;
                }
            }
            text.push(b' ');
            let Some((next, more)) = self.line() else { break };
            line = next;
            // The backslash counts as one.
            blanks += 1 + more;
        }
        (text, blanks)
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = Statement<'a>;

    #[inline]
    fn next(&mut self) -> Option<Statement<'a>> {
        let line = self.lines;
        let (text, blanks) = self.line()?;
        if is_continued(text) && !text.trim_ascii_start().starts_with(b"#") {
            let (text, blanks) = self.joined(text, blanks);
            return Some(Statement { line, text: Cow::Owned(text), blanks });
        }
        Some(Statement { line, text: Cow::Borrowed(text), blanks })
    }
}

/// True if the next line belongs to this one, unless it is a comment: one that ends with a folder's name does not go on.
#[inline]
pub(super) fn is_continued(line: &[u8]) -> bool {
    match line {
        [.., b'\\'] => true,
        [.., last] if !last.is_ascii_whitespace() => false,
        line => line.trim_ascii_end().ends_with(b"\\"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statements(text: &str) -> Vec<(usize, String)> {
        let text_of = |statement: Statement<'_>| String::from_utf8_lossy(&statement.text).into_owned();
        Statements::new(text.as_bytes()).map(|statement| (statement.line, text_of(statement))).collect()
    }

    #[test]
    fn lines_are_joined_at_a_backslash() {
        let expected =
            [(0, "f 1  2 3"), (3, "# a\\"), (4, "v"), (5, "")].map(|(n, text)| (n, text.to_string()));
        assert_eq!(statements("f 1\\\n 2\\ \r\n3\n# a\\\nv\r\r"), expected);
        assert_eq!(statements("f 1 \\"), [(0, "f 1  ".to_string())]);
    }

    #[test]
    fn there_are_blanks_for_all_words() {
        for text in
            ["f 1 2 3", "f\t1\x0b2  3", "f 1\\\n2\\\r\n\\\n3", "  f 1 2 3 4 5 6 7 8 9 10 # 11", "f 1\\"]
        {
            for statement in Statements::new(text.as_bytes()) {
                let words = Tokens::new(&statement.text).skip(1).count();
                assert!(statement.blanks >= words, "{text:?}: {} of {words}", statement.blanks);
            }
        }
    }

    #[test]
    fn kinds_are_told_by_the_first_word() {
        for (text, kind) in [
            ("v 1 2 3", Kind::Vertex),
            ("\tv\t1", Kind::Vertex),
            ("vt", Kind::TextureCoordinate),
            ("vt 1", Kind::TextureCoordinate),
            ("fo 1 2 3", Kind::Face),
            ("f", Kind::Face),
            ("vn 1 2 3", Kind::Nothing),
            (" # v 1 2 3", Kind::Nothing),
            ("", Kind::Nothing),
            ("usemtl f", Kind::Nothing),
            ("t hole 1/0/0 0", Kind::Other),
            ("v#", Kind::Other),
        ] {
            assert_eq!(Kind::of(text.as_bytes()), kind, "{text:?}");
        }
    }
}
