//! Tokens of Part 21 text.

use super::{Fault, Faults};

/// A token. Texts keep the spelling of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    Reference(u64),
    Keyword(&'a str),
    Integer(i64),
    Real(f64),
    /// What stands between the quotes.
    Text(&'a [u8]),
    Enumeration(&'a str),
    Binary,
    Unset,
    Derived,
    Open,
    Close,
    Comma,
    Semicolon,
    Equals,
    /// Something that is no token; it has been reported.
    Garbage,
}

/// Walks the text once. What is spelt wrongly is reported and passed over.
pub(super) struct Lexer<'a> {
    text: &'a [u8],
    place: usize,
    /// The line of the token read last, from 1.
    pub(super) line: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a [u8]) -> Lexer<'a> {
        Lexer { text, place: 0, line: 1 }
    }

    /// The next token, `None` at the end of the text.
    pub(super) fn next(&mut self, faults: &mut Faults) -> Option<Token<'a>> {
        self.skip_space(faults);
        let first = *self.text.get(self.place)?;
        let start = self.place;
        self.place += 1;
        Some(match first {
            b'(' => Token::Open,
            b')' => Token::Close,
            b',' => Token::Comma,
            b';' => Token::Semicolon,
            b'=' => Token::Equals,
            b'$' => Token::Unset,
            b'*' => Token::Derived,
            b'\'' => self.string(faults),
            b'"' => self.binary(faults),
            b'.' if self.peek().is_some_and(|letter| letter.is_ascii_alphabetic()) => {
                self.enumeration(faults)
            }
            b'#' => {
                self.skip_while(|letter| letter.is_ascii_digit());
                match self.spelling(start + 1).parse() {
                    Ok(id) => Token::Reference(id),
                    Err(_) => self.garbage(faults, start),
                }
            }
            b'0'..=b'9' | b'+' | b'-' | b'.' => self.number(faults, start),
            b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'!' => {
                self.skip_while(|letter| letter.is_ascii_alphanumeric() || matches!(letter, b'_' | b'-'));
                Token::Keyword(self.spelling(start))
            }
            _ => {
                self.skip_while(|letter| !letter.is_ascii());
                self.garbage(faults, start)
            }
        })
    }

    fn peek(&self) -> Option<u8> {
        self.text.get(self.place).copied()
    }

    fn skip_while(&mut self, wanted: impl Fn(u8) -> bool) {
        while self.peek().is_some_and(&wanted) {
            self.place += 1;
        }
    }

    /// The text from `start` to here, which is ASCII by the way it was walked over.
    fn spelling(&self, start: usize) -> &'a str {
        std::str::from_utf8(&self.text[start..self.place]).unwrap_or_default()
    }

    fn fault(&self, faults: &mut Faults, code: &'static str, message: String) {
        faults.push(Fault { code, message, line: Some(self.line), id: None });
    }

    fn garbage(&self, faults: &mut Faults, start: usize) -> Token<'a> {
        let shown = String::from_utf8_lossy(&self.text[start..self.place]);
        self.fault(faults, "syntax", format!("`{shown}` is no token"));
        Token::Garbage
    }

    /// Spaces and comments.
    fn skip_space(&mut self, faults: &mut Faults) {
        while let Some(letter) = self.peek() {
            if letter == b'\n' {
                self.line += 1;
                self.place += 1;
            } else if letter.is_ascii_whitespace() {
                self.place += 1;
            } else if self.text[self.place..].starts_with(b"/*") {
                let comment = &self.text[self.place..];
                let length = comment[2..].windows(2).position(|pair| pair == b"*/").map(|end| end + 4);
                if length.is_none() {
                    self.fault(faults, "truncated", "a comment has no end".to_owned());
                }
                let comment = &comment[..length.unwrap_or(comment.len())];
                self.line += comment.iter().filter(|&&letter| letter == b'\n').count();
                self.place += comment.len();
            } else {
                break;
            }
        }
    }

    fn string(&mut self, faults: &mut Faults) -> Token<'a> {
        let start = self.place;
        loop {
            match self.peek() {
                None => {
                    self.fault(faults, "truncated", "a string has no end".to_owned());
                    return Token::Text(&self.text[start..]);
                }
                Some(b'\'') if self.text.get(self.place + 1) == Some(&b'\'') => self.place += 2,
                Some(b'\'') => {
                    self.place += 1;
                    return Token::Text(&self.text[start..self.place - 1]);
                }
                Some(letter) => {
                    self.line += usize::from(letter == b'\n');
                    self.place += 1;
                }
            }
        }
    }

    fn binary(&mut self, faults: &mut Faults) -> Token<'a> {
        let start = self.place - 1;
        self.skip_while(|letter| letter.is_ascii_hexdigit());
        if self.peek() == Some(b'"') {
            self.place += 1;
            Token::Binary
        } else {
            self.garbage(faults, start)
        }
    }

    fn enumeration(&mut self, faults: &mut Faults) -> Token<'a> {
        let start = self.place;
        self.skip_while(|letter| letter.is_ascii_alphanumeric() || letter == b'_');
        let name = self.spelling(start);
        if self.peek() == Some(b'.') {
            self.place += 1;
            Token::Enumeration(name)
        } else {
            self.garbage(faults, start - 1)
        }
    }

    /// An integer or a real. A real has digits, a point, perhaps digits, perhaps an exponent with a large E.
    fn number(&mut self, faults: &mut Faults, start: usize) -> Token<'a> {
        // A sign inside a number stands after the letter of its exponent only.
        while let Some(letter) = self.peek() {
            let exponent = matches!(self.text[self.place - 1], b'e' | b'E');
            if letter.is_ascii_alphanumeric() || letter == b'.' || (exponent && matches!(letter, b'+' | b'-'))
            {
                self.place += 1;
            } else {
                break;
            }
        }
        let spelling = self.spelling(start);
        let unsigned = spelling.strip_prefix(['+', '-']).unwrap_or(spelling);
        if !unsigned.is_empty() && unsigned.bytes().all(|letter| letter.is_ascii_digit()) {
            return match spelling.parse() {
                Ok(integer) => Token::Integer(integer),
                Err(_) => self.garbage(faults, start),
            };
        }
        let numeric = unsigned.starts_with(|letter: char| letter.is_ascii_digit() || letter == '.');
        let value = spelling.parse::<f64>().ok().filter(|_| numeric);
        let mantissa = unsigned.split(['e', 'E']).next().unwrap_or_default();
        match value {
            None => self.fault(faults, "bad_real", format!("`{spelling}` is no number")),
            Some(value) if !value.is_finite() => {
                self.fault(faults, "bad_real", format!("`{spelling}` is too large"));
            }
            Some(_) if !mantissa.contains('.') => {
                self.fault(faults, "real_without_point", format!("the real `{spelling}` has no point"));
            }
            Some(_) if mantissa.starts_with('.') || unsigned.contains('e') => {
                self.fault(faults, "bad_real", format!("the real `{spelling}` is spelt wrongly"));
            }
            Some(_) => {}
        }
        Token::Real(value.filter(|value| value.is_finite()).unwrap_or(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> (Vec<Token<'_>>, Vec<&'static str>) {
        let mut lexer = Lexer::new(text.as_bytes());
        let mut faults = Vec::new();
        let mut tokens = Vec::new();
        while let Some(token) = lexer.next(&mut faults) {
            tokens.push(token);
        }
        (tokens, faults.iter().map(|fault| fault.code).collect())
    }

    #[test]
    fn every_kind_of_token() {
        let (tokens, faults) =
            tokens("#12 = A_B('it''s',.T.,$,*,-3,1.5E-7,\"0AF\") /* a\n comment */ ; END-ISO-10303-21");
        use Token::*;
        assert!(faults.is_empty());
        let wanted = [
            Reference(12),
            Equals,
            Keyword("A_B"),
            Open,
            Text(b"it''s"),
            Comma,
            Enumeration("T"),
            Comma,
            Unset,
            Comma,
            Derived,
            Comma,
            Integer(-3),
            Comma,
            Real(1.5e-7),
            Comma,
            Binary,
            Close,
            Semicolon,
            Keyword("END-ISO-10303-21"),
        ];
        assert_eq!(tokens, wanted);
    }

    #[test]
    fn reals_are_strict() {
        for good in ["1.", "-0.", "1.5", "1.E20", "1.5E+7", "+2.5E-300"] {
            assert_eq!(tokens(good).1, [""; 0], "{good}");
        }
        for bad in ["1e-7", "1E20", "-3e5"] {
            assert_eq!(tokens(bad).1, ["real_without_point"], "{bad}");
        }
        for bad in ["1.e-7", ".5", "-inf", "-nan", "1.E999", "1.2.3", "1.5E", "+", "1.x"] {
            assert_eq!(tokens(bad).1, ["bad_real"], "{bad}");
        }
    }

    #[test]
    fn lines_are_counted() {
        let mut lexer = Lexer::new(b"A\n/* \n */ B 'x\ny' C");
        let mut faults = Vec::new();
        let mut lines = Vec::new();
        while lexer.next(&mut faults).is_some() {
            lines.push(lexer.line);
        }
        assert_eq!(lines, [1, 3, 4, 4]);
    }
}
