//! The records of a PLY file, one after the other, as numbers, whatever they are written in.

use super::header::{Element, Encoding, Kind, Scalar};
use crate::text::{Lines, Tokens, real, shown};

/// Why a record could not be read.
pub(super) enum RecordFault {
    /// The file ends before it or within it.
    Truncated,
    /// It is there and makes no sense; the code and what is wrong. What follows can still be read.
    Malformed(&'static str, String),
    /// It makes no sense, and so its end is not known.
    Lost(String),
}

/// Where the reading stands.
pub(super) enum Body<'a> {
    Ascii(Lines<'a>),
    Binary { rest: &'a [u8], encoding: Encoding },
}

impl<'a> Body<'a> {
    /// What follows the header.
    pub(super) fn new(lines: Lines<'a>, encoding: Encoding) -> Body<'a> {
        match encoding {
            Encoding::Ascii => Body::Ascii(lines),
            _ => Body::Binary { rest: lines.rest(), encoding },
        }
    }

    /// The number of the line that was read last.
    pub(super) fn line(&self) -> Option<u32> {
        match self {
            Body::Ascii(lines) => Some(lines.number()),
            Body::Binary { .. } => None,
        }
    }

    /// Reads one record of an element and hands each number to `take`, with the number of its property.
    pub(super) fn record(
        &mut self,
        element: &Element<'_>,
        take: impl FnMut(usize, f64),
    ) -> Result<(), RecordFault> {
        match self {
            Body::Ascii(lines) => {
                let (_, tokens) = lines.next_filled().ok_or(RecordFault::Truncated)?;
                ascii_record(element, tokens, take)
            }
            Body::Binary { rest, encoding } => binary_record(element, rest, *encoding, take),
        }
    }

    /// Steps over all records of an element.
    pub(super) fn skip(&mut self, element: &Element<'_>) -> Result<(), RecordFault> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for _ in 0..element.count {
            match self.record(element, |_, _| {}) {
                // Nobody asked what it says.
                Ok(()) | Err(RecordFault::Malformed(..)) => {}
                Err(fault) => return Err(fault),
            }
        }
        Ok(())
    }
}

fn ascii_record(
    element: &Element<'_>,
    mut tokens: Tokens<'_>,
    mut take: impl FnMut(usize, f64),
) -> Result<(), RecordFault> {
    let mut number = || {
        let missing = || RecordFault::Malformed("missing_number", "has too few numbers on its line".into());
        let token = tokens.next().ok_or_else(missing)?;
        let malformed = || format!("has `{}`, which is no number", shown(token));
        real(token).ok_or_else(|| RecordFault::Malformed("bad_number", malformed()))
    };
    for (i, property) in element.properties.iter().enumerate() {
        match property.kind {
            Kind::Scalar(_) => take(i, number()?),
            Kind::List { .. } => {
                let length = number()?;
                let length = list_length(length)
                    .ok_or_else(|| RecordFault::Malformed("bad_number", bad_length(length)))?;
                for _ in 0..length {
                    take(i, number()?);
                }
            }
        }
    }
    Ok(())
}

fn binary_record(
    element: &Element<'_>,
    rest: &mut &[u8],
    encoding: Encoding,
    mut take: impl FnMut(usize, f64),
) -> Result<(), RecordFault> {
    let mut number = |scalar: Scalar| {
        let (bytes, after) = rest.split_at_checked(scalar.size()).ok_or(RecordFault::Truncated)?;
        *rest = after;
        Ok(scalar.decode(bytes, encoding))
    };
    for (i, property) in element.properties.iter().enumerate() {
        match property.kind {
            Kind::Scalar(scalar) => take(i, number(scalar)?),
            Kind::List { length, item } => {
                let length = number(length)?;
                let length = list_length(length).ok_or_else(|| RecordFault::Lost(bad_length(length)))?;
                for _ in 0..length {
                    take(i, number(item)?);
                }
            }
        }
    }
    Ok(())
}

fn list_length(length: f64) -> Option<u32> {
    let whole = length >= 0.0 && length <= f64::from(u32::MAX) && length.fract() == 0.0;
    whole.then_some(length as u32)
}

fn bad_length(length: f64) -> String {
    format!("has a list of {length} numbers")
}
