//! A text cut into pieces that can be read one beside the other.

/// Cuts a text into pieces of `size` bytes or a little more, each of them whole statements. A text whose lines do not end with
/// `\n` is one piece.
pub(super) fn cut(text: &[u8], size: usize) -> Vec<&[u8]> {
    let mut pieces = Vec::with_capacity(text.len() / size.max(1) + 1);
    let mut rest = text;
    while let Some(end) = end_of_statement(rest, size) {
        let (piece, after) = rest.split_at(end);
        pieces.push(piece);
        rest = after;
    }
    if !rest.is_empty() {
        pieces.push(rest);
    }
    pieces
}

/// The first end of a statement at `from` or beyond, if something follows.
fn end_of_statement(text: &[u8], from: usize) -> Option<usize> {
    let mut from = from;
    loop {
        let end = from + text.get(from..)?.iter().position(|&b| b == b'\n')? + 1;
        // What ends with a backslash goes on, unless it is a comment; one need not know.
        if !text[..end].trim_ascii_end().ends_with(b"\\") {
            return (end < text.len()).then_some(end);
        }
        from = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_end_where_statements_do() {
        let text = b"v 1\nf 1 \\\n2\\\r\n3\nf 4\r\nf 5";
        let expected: [&[u8]; 4] = [b"v 1\n", b"f 1 \\\n2\\\r\n3\n", b"f 4\r\n", b"f 5"];
        assert_eq!(cut(text, 1), expected);
        assert_eq!(cut(text, 0), expected);
        assert_eq!(cut(text, 5), [&text[..16], &text[16..]]);
        assert_eq!(cut(text, 100), [text]);
        assert_eq!(cut(b"v\rv\r", 1), [b"v\rv\r"]);
        assert!(cut(b"", 1).is_empty());
    }
}
