//! The header of a PLY file: which elements follow, and what each of them is made of.

use crate::error::Fault;
use crate::text::{Lines, Tokens, integer, shown};

/// What a header says.
pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element<'a>>,
}

/// How the body is written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// So many records of the same kind.
pub(super) struct Element<'a> {
    pub(super) name: &'a [u8],
    pub(super) count: usize,
    pub(super) properties: Vec<Property<'a>>,
}

/// One number or one list of each record.
pub(super) struct Property<'a> {
    pub(super) name: &'a [u8],
    pub(super) kind: Kind,
}

/// A number, or a list of numbers behind its length.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { length: Scalar, item: Scalar },
}

/// The types of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn from_name(name: &[u8]) -> Option<Scalar> {
        Some(match name {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// Bytes in binary files.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    /// The number in the first [`Scalar::size`] bytes, of which there are enough. Every type fits a double.
    pub(super) fn decode(self, bytes: &[u8], encoding: Encoding) -> f64 {
        fn first<const N: usize>(bytes: &[u8], encoding: Encoding) -> [u8; N] {
            let mut array = [0; N];
            array.copy_from_slice(&bytes[..N]);
            if encoding == Encoding::BigEndian {
                array.reverse();
            }
            array
        }
        match self {
            Scalar::I8 => f64::from(i8::from_le_bytes(first(bytes, encoding))),
            Scalar::U8 => f64::from(u8::from_le_bytes(first(bytes, encoding))),
            Scalar::I16 => f64::from(i16::from_le_bytes(first(bytes, encoding))),
            Scalar::U16 => f64::from(u16::from_le_bytes(first(bytes, encoding))),
            Scalar::I32 => f64::from(i32::from_le_bytes(first(bytes, encoding))),
            Scalar::U32 => f64::from(u32::from_le_bytes(first(bytes, encoding))),
            Scalar::F32 => f64::from(f32::from_le_bytes(first(bytes, encoding))),
            Scalar::F64 => f64::from_le_bytes(first(bytes, encoding)),
        }
    }
}

impl Element<'_> {
    /// The least one record takes: bytes in binary files, characters in others.
    pub(super) fn least_size(&self, encoding: Encoding) -> usize {
        self.properties
            .iter()
            .map(|property| match (encoding, property.kind) {
                (Encoding::Ascii, _) => 2,
                (_, Kind::Scalar(scalar) | Kind::List { length: scalar, .. }) => scalar.size(),
            })
            .sum()
    }
}

/// Reads lines up to and with `end_header`.
pub(super) fn read<'a>(lines: &mut Lines<'a>) -> Result<Header<'a>, Fault> {
    let bad = |line: u32, reason: String| Err(Fault::new("bad_header", reason).on_line(line));
    if lines.next().is_none_or(|(_, line)| line.trim_ascii_end() != b"ply") {
        return bad(1, "a PLY file begins with a line `ply`".into());
    }
    let mut encoding = None;
    let mut elements: Vec<Element<'a>> = Vec::new();
    for (number, line) in lines.by_ref() {
        let mut tokens = Tokens::new(line);
        let Some(keyword) = tokens.next() else { continue };
        match keyword {
            b"comment" | b"obj_info" => {}
            b"format" => {
                let name = tokens.next().unwrap_or_default();
                encoding = Some(match name {
                    b"ascii" => Encoding::Ascii,
                    b"binary_little_endian" => Encoding::LittleEndian,
                    b"binary_big_endian" => Encoding::BigEndian,
                    _ => return bad(number, format!("unknown format `{}`", shown(name))),
                });
            }
            b"element" => match element(tokens) {
                Some(element) => elements.push(element),
                None => return bad(number, "an element needs a name and a count".into()),
            },
            b"property" => match (property(tokens), elements.last_mut()) {
                (Ok(property), Some(element)) => element.properties.push(property),
                (Ok(_), None) => return bad(number, "a property before the first element".into()),
                (Err(reason), _) => return bad(number, reason),
            },
            b"end_header" => {
                return match encoding {
                    Some(encoding) => Ok(Header { encoding, elements }),
                    None => bad(number, "the header has no line `format`".into()),
                };
            }
            _ => return bad(number, format!("`{}` does not belong in a header", shown(keyword))),
        }
    }
    bad(lines.number(), "the file ends within its header".into())
}

fn element<'a>(mut tokens: Tokens<'a>) -> Option<Element<'a>> {
    let name = tokens.next()?;
    let count = usize::try_from(integer(tokens.next()?)?).ok()?;
    Some(Element { name, count, properties: Vec::new() })
}

fn property<'a>(mut tokens: Tokens<'a>) -> Result<Property<'a>, String> {
    let mut word = || tokens.next().ok_or_else(|| "a property needs a type and a name".to_string());
    let scalar = |name: &[u8]| {
        Scalar::from_name(name).ok_or_else(|| format!("`{}` is no type of numbers", shown(name)))
    };
    let first = word()?;
    let kind = if first == b"list" {
        Kind::List { length: scalar(word()?)?, item: scalar(word()?)? }
    } else {
        Kind::Scalar(scalar(first)?)
    };
    Ok(Property { name: word()?, kind })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_decoded_in_both_orders() {
        let bytes = (-2i16).to_be_bytes();
        assert_eq!(Scalar::I16.decode(&bytes, Encoding::BigEndian), -2.0);
        assert_eq!(Scalar::U32.decode(&4_000_000_000u32.to_le_bytes(), Encoding::LittleEndian), 4e9);
        assert_eq!(Scalar::F32.decode(&0.5f32.to_be_bytes(), Encoding::BigEndian), 0.5);
        assert_eq!(Scalar::F64.decode(&1e-300f64.to_le_bytes(), Encoding::LittleEndian), 1e-300);
    }
}
