//! Reading a line as most lines are, number by number as the bytes come: `v`, `vt` and `f` at its start, plain numbers,
//! nothing else. Of any other line nothing is said, and [`super::careful`] reads it.

use super::statements::is_continued;
use crate::builder::repeated;
use crate::number::{decimal, up_to_eight_digits};
use crate::text::measure_line;

/// Reads `N` numbers after a keyword of so many bytes; what more there is on the line, a weight or a colour, is passed over.
/// The numbers, and how many bytes the line has, its end among them.
#[inline]
pub(super) fn numbers<const N: usize>(text: &[u8], keyword: usize) -> Option<([f64; N], usize)> {
    let mut values = [0.0; N];
    let mut at = keyword;
    for value in &mut values {
        let start = after_blanks(text, at)?;
        let length;
        (*value, length) = decimal(&text[start..])?;
        at = start + length;
    }
    Some((values, after_line(text, at).or_else(|| after_more(text, at))?))
}

/// A face that was read.
pub(super) struct Face {
    /// How many corners it has.
    pub(super) corners: usize,
    /// How many of them have a texture coordinate.
    pub(super) textured: usize,
    /// How many bytes the line has, its end among them.
    pub(super) length: usize,
}

/// Reads the corners of a face: vertices counted from 0, and texture coordinates counted from 1, which are not written where
/// there are none. If something is wrong there may be some of them.
#[inline]
pub(super) fn face(text: &[u8], vertices: &mut [u32], texture: &mut [u32]) -> Option<Face> {
    let (mut corners, mut textured) = (0, 0);
    let mut at = 1;
    let length = loop {
        let start = match after_blanks(text, at) {
            Some(start) if text.get(start).is_some_and(u8::is_ascii_digit) => start,
            end => break after_line(text, end.unwrap_or(at))?,
        };
        let vertex;
        (vertex, at) = natural(text, start)?;
        *vertices.get_mut(corners)? = vertex.checked_sub(1)?;
        if text.get(at) == Some(&b'/') {
            at += 1;
            if text.get(at) != Some(&b'/') {
                let coordinate;
                (coordinate, at) = natural(text, at)?;
                if coordinate == 0 {
                    return None;
                }
                *texture.get_mut(corners)? = coordinate;
                textured += 1;
            }
            if text.get(at) == Some(&b'/') {
                (_, at) = natural(text, at + 1)?;
            }
        }
        corners += 1;
    };
    let is_sound = corners >= 3 && are_distinct(&vertices[..corners]);
    is_sound.then_some(Face { corners, textured, length })
}

/// Where the blanks at `at` end; `None` if there are none.
#[inline]
fn after_blanks(text: &[u8], at: usize) -> Option<usize> {
    let is_blank = |at: usize| matches!(text.get(at), Some(b' ' | b'\t'));
    let mut end = at;
    while is_blank(end) {
        end += 1;
    }
    (end > at).then_some(end)
}

/// Where the next line begins; `None` if this one does not end at `at`.
#[inline]
fn after_line(text: &[u8], at: usize) -> Option<usize> {
    match text.get(at..)? {
        [b'\n', ..] => Some(at + 1),
        [b'\r', b'\n', ..] => Some(at + 2),
        _ => None,
    }
}

/// Where the next line begins, if more words follow at `at`; `None` if it belongs to this one.
fn after_more(text: &[u8], at: usize) -> Option<usize> {
    after_blanks(text, at)?;
    let length = measure_line(&text[at..]).length;
    let end = after_line(text, at + length)?;
    (!is_continued(&text[at..at + length])).then_some(end)
}

/// A number without sign, and where it ends.
#[inline]
fn natural(text: &[u8], start: usize) -> Option<(u32, usize)> {
    let (value, count) = up_to_eight_digits(text.get(start..)?);
    // Of eight digits or more it is not said here where they end.
    (1..8).contains(&count).then_some((value as u32, start + count)).or_else(|| long_natural(text, start))
}

/// A number without sign of up to nine digits, which fit into 32 bits, and where it ends.
#[cold]
fn long_natural(text: &[u8], start: usize) -> Option<(u32, usize)> {
    let digits = text[start..].iter().map(|b| b.wrapping_sub(b'0')).take_while(|&digit| digit < 10);
    let count = digits.clone().count();
    let value = || digits.fold(0, |value, digit| 10 * value + u32::from(digit));
    (1..=9).contains(&count).then(|| (value(), start + count))
}

/// True if no vertex is named twice.
#[inline]
fn are_distinct(vertices: &[u32]) -> bool {
    match *vertices {
        [a, b, c] => a != b && b != c && c != a,
        [a, b, c, d] => a != b && a != c && a != d && b != c && b != d && c != d,
        _ => repeated(vertices).is_none(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_lines_are_read_to_their_end() {
        assert_eq!(numbers::<3>(b"v 1 -2.5\t+3e1\nv", 1), Some(([1.0, -2.5, 30.0], 14)));
        assert_eq!(numbers::<3>(b"v 1 2 3 0.5 nan \\#\nv", 1), Some(([1.0, 2.0, 3.0], 19)));
        assert_eq!(numbers::<2>(b"vt  0.5 1\r\n", 2), Some(([0.5, 1.0], 11)));
        let (mut vertices, mut texture) = ([0; 4], [0; 4]);
        let read = face(b"f 1 2/7 3//9 4/8/7 \nf", &mut vertices, &mut texture).unwrap();
        assert_eq!((read.corners, read.textured, read.length), (4, 2, 20));
        assert_eq!((vertices, texture), ([0, 1, 2, 3], [0, 7, 0, 8]));
        let read = face(b"f 1234567 12345678 123456789\nv 1 2 3", &mut vertices, &mut texture).unwrap();
        assert_eq!((read.corners, read.length), (3, 29));
        assert_eq!(vertices[..3], [1_234_566, 12_345_677, 123_456_788]);
    }

    #[test]
    fn nothing_is_said_of_other_lines() {
        for line in [
            "v 1 2\n",
            "v 1 2 3",
            "v 1 2 3 4",
            "v 1 2 3#\n",
            "v 1 2 3 4\\ \n",
            "v 1 2 3\\\n",
            "v 1 2 nan\n",
            "v 1 2 1e999\n",
            "v 1 2 3\r",
        ] {
            assert_eq!(numbers::<3>(line.as_bytes(), 1), None, "{line:?}");
        }
        let (mut vertices, mut texture) = ([0; 4], [0; 4]);
        for line in [
            "f 1 2 3",
            "f 1 2\n",
            "f 1 2 2\n",
            "f 0 1 2\n",
            "f -1 2 3\n",
            "f 1 2 3/0\n",
            "f 1 2 3/\n",
            "f 1 2 3/1/\n",
            "f 1 2 3/1/1/1\n",
            "f 1 2 3 4 5\n",
            "f 1 2 1234567890\n",
            "f 1 2 3#\n",
            "f 1 2 3\\\n",
        ] {
            assert!(face(line.as_bytes(), &mut vertices, &mut texture).is_none(), "{line:?}");
        }
    }
}
