//! Reading addresses, line after line, each fault with the number of its line.

use std::fmt;
use std::io::{self, BufRead};

use ogee::Place;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::Value;

use super::lines::{LONGEST, LineReader};
use super::{ADDRESS, Address, SampleFormat};
use crate::error::{Fault, ReadError};
use crate::text::{check_is_text, real, shown};

/// Why no addresses can be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AddressesError {
    /// The source cannot be read.
    #[error(transparent)]
    Unreadable(#[from] io::Error),
    /// The file as a whole is not what it should be.
    #[error(transparent)]
    Refused(#[from] ReadError),
}

/// Reads addresses, one line at a time.
///
/// ```
/// use ogee_formats::samples::{AddressReader, SampleFormat};
///
/// let mut reader = AddressReader::new(&b"u,v,face\n0.5,0.25,7\n0.5,,7\n"[..], SampleFormat::Csv)?;
/// let next = reader.next_address()?;
/// assert!(matches!(next, Some(Ok((2, address))) if address.face == 7 && address.corner.is_none()));
/// let next = reader.next_address()?;
/// assert!(matches!(next, Some(Err(fault)) if fault.line == Some(3) && fault.code == "missing_number"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct AddressReader<R> {
    lines: LineReader<R>,
    /// For CSV: which part of an address each column holds.
    columns: Option<Vec<usize>>,
}

impl<R: BufRead> AddressReader<R> {
    /// Begins to read.
    ///
    /// # Errors
    /// If the source cannot be read or is no text, or if a CSV file does not begin with the names of its columns.
    pub fn new(source: R, format: SampleFormat) -> Result<AddressReader<R>, AddressesError> {
        let mut lines = LineReader::new(source);
        let name = match format {
            SampleFormat::JsonLines => "JSON lines",
            SampleFormat::Csv => "CSV",
        };
        check_is_text(lines.peek()?, name)?;
        let mut columns = None;
        // An empty file has no header, and no addresses either.
        if format == SampleFormat::Csv && lines.advance()? {
            let found = lines.line().ok_or_else(too_long).and_then(header);
            columns = Some(found.map_err(|fault| ReadError::single(fault.on_line(lines.number())))?);
        }
        Ok(AddressReader { lines, columns })
    }

    /// The next address and its line, from 1; or what is wrong with that line, after which reading may go on. `None`
    /// at the end. Blank lines are passed over.
    ///
    /// # Errors
    /// Those of the source.
    pub fn next_address(&mut self) -> io::Result<Option<Result<(u32, Address), Fault>>> {
        if !self.lines.advance()? {
            return Ok(None);
        }
        let number = self.lines.number();
        let address = self.lines.line().ok_or_else(too_long).and_then(|line| match &self.columns {
            Some(columns) => from_csv(line, columns),
            None => from_json(line),
        });
        Ok(Some(address.map(|address| (number, address)).map_err(|fault| fault.on_line(number))))
    }
}

fn too_long() -> Fault {
    Fault::new("malformed_line", format!("the line is longer than {LONGEST} bytes"))
}

/// A part of an address, as a file has it.
#[derive(Clone, Default)]
enum Given {
    #[default]
    Missing,
    Whole(u64),
    Real(f64),
    /// What is there instead, for a message.
    NoNumber(String),
}

/// An address from its parts, in the order of [`ADDRESS`].
fn address([face, corner, u, v]: [Given; 4]) -> Result<Address, Fault> {
    let face = number(face, "face")?
        .ok_or_else(|| Fault::new("missing_number", "the address has no face".to_owned()))?;
    let of_face = |fault: Fault| fault.at(Place::Face(face));
    let parameter = |given: Given, name: &str| match given {
        Given::Whole(whole) => Ok(whole as f64),
        Given::Real(real) if real.is_finite() => Ok(real),
        Given::Real(real) => Err(Fault::new("not_finite", format!("{name} is {real}, which is not finite"))),
        Given::Missing => Err(Fault::new("missing_number", format!("the address has no {name}"))),
        Given::NoNumber(text) => Err(no_number(name, &text)),
    };
    Ok(Address {
        face,
        corner: number(corner, "corner").map_err(of_face)?,
        u: parameter(u, "u").map_err(of_face)?,
        v: parameter(v, "v").map_err(of_face)?,
    })
}

/// The number of a face or of a corner. Tables in which some are missing often hold `1.0` for `1`.
fn number(given: Given, name: &str) -> Result<Option<u32>, Fault> {
    let missing = |number: &dyn fmt::Display| {
        let code = if name == "face" { "missing_face" } else { "missing_corner" };
        Fault::new(code, format!("there is no {name} {number}"))
    };
    match given {
        Given::Missing => Ok(None),
        Given::Whole(whole) => u32::try_from(whole).map(Some).map_err(|_| missing(&whole)),
        Given::Real(real) if real >= 0.0 && real.fract() == 0.0 => {
            if real <= f64::from(u32::MAX) {
                Ok(Some(real as u32))
            } else {
                Err(missing(&real))
            }
        }
        Given::Real(real) if !real.is_finite() => {
            Err(Fault::new("not_finite", format!("{name} is {real}, which is not finite")))
        }
        Given::Real(real) => {
            Err(Fault::new("bad_number", format!("{name} is {real}, which is no whole number from 0")))
        }
        Given::NoNumber(text) => Err(no_number(name, &text)),
    }
}

fn no_number(name: &str, text: &str) -> Fault {
    Fault::new("bad_number", format!("{name} is {text}, which is no number"))
}

/// The fields of a line. None of them holds a comma or a quote: they are numbers.
fn fields(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|&b| b == b',').map(|field| match field.trim_ascii() {
        [b'"', inner @ .., b'"'] => inner.trim_ascii(),
        field => field,
    })
}

/// What each column holds.
fn header(line: &[u8]) -> Result<Vec<usize>, Fault> {
    let refuse = |what: String| {
        Err(Fault::new("bad_header", format!("{what}; the columns are face, corner, u and v")))
    };
    let mut columns = Vec::new();
    for field in fields(line) {
        let Some(part) = ADDRESS.iter().position(|name| name.as_bytes().eq_ignore_ascii_case(field)) else {
            return refuse(format!("unknown column `{}`", shown(field)));
        };
        if columns.contains(&part) {
            return refuse(format!("column {} is there twice", ADDRESS[part]));
        }
        columns.push(part);
    }
    // Cages of nothing but quads have no corners to name.
    match ADDRESS.iter().enumerate().find(|(part, name)| **name != "corner" && !columns.contains(part)) {
        Some((_, name)) => refuse(format!("column {name} is missing")),
        None => Ok(columns),
    }
}

fn from_csv(line: &[u8], columns: &[usize]) -> Result<Address, Fault> {
    let mut parts: [Given; 4] = Default::default();
    let mut count = 0;
    for field in fields(line) {
        if let Some(&part) = columns.get(count) {
            parts[part] = given(field);
        }
        count += 1;
    }
    if count != columns.len() {
        let message = format!("the line has {count} fields, the header {}", columns.len());
        return Err(Fault::new("malformed_line", message));
    }
    address(parts)
}

fn given(field: &[u8]) -> Given {
    if field.is_empty() {
        return Given::Missing;
    }
    let is_whole = field.iter().all(u8::is_ascii_digit);
    let whole = std::str::from_utf8(field).ok().filter(|_| is_whole).and_then(|digits| digits.parse().ok());
    match (whole, real(field)) {
        (Some(whole), _) => Given::Whole(whole),
        (None, Some(real)) => Given::Real(real),
        (None, None) => Given::NoNumber(format!("`{}`", shown(field))),
    }
}

fn from_json(line: &[u8]) -> Result<Address, Fault> {
    if line.first() != Some(&b'{') {
        let message = r#"every line wants an object of its own, as {"face": 0, "u": 0.5, "v": 0.5}"#;
        return Err(Fault::new("bad_json", message));
    }
    let keys: Keys = serde_json::from_slice(line).map_err(|error| syntax(&error))?;
    if let Some(key) = keys.unknown {
        let message = format!("unknown key `{}`; the keys are face, corner, u and v", shown(key.as_bytes()));
        return Err(Fault::new("unknown_key", message));
    }
    if let Some(part) = keys.repeated {
        return Err(Fault::new("malformed_line", format!("key {} is there twice", ADDRESS[part])));
    }
    address(keys.parts.map(Option::unwrap_or_default))
}

/// The line that the parser names is always the first.
fn syntax(error: &serde_json::Error) -> Fault {
    let text = error.to_string();
    let reason = text.rfind(" at line ").map_or(&text[..], |end| &text[..end]);
    Fault::new("bad_json", format!("{reason}, at byte {}", error.column()))
}

/// What stands at the keys of a line.
#[derive(Default)]
struct Keys {
    parts: [Option<Given>; 4],
    repeated: Option<usize>,
    unknown: Option<String>,
}

/// A key by its place in [`ADDRESS`], or one that does not belong there.
enum Key {
    Part(usize),
    Unknown(String),
}

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Key, D::Error> {
        struct Text;
        impl Visitor<'_> for Text {
            type Value = Key;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a key")
            }

            fn visit_str<E>(self, key: &str) -> Result<Key, E> {
                let part = ADDRESS.iter().position(|name| *name == key);
                Ok(part.map_or_else(|| Key::Unknown(key.to_owned()), Key::Part))
            }
        }
        deserializer.deserialize_str(Text)
    }
}

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Keys, D::Error> {
        struct Object;
        impl<'de> Visitor<'de> for Object {
            type Value = Keys;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object with face, corner, u and v")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
                let mut keys = Keys::default();
                while let Some(key) = map.next_key()? {
                    let given = map.next_value::<Value>().map(of_json)?;
                    match key {
                        Key::Unknown(key) => keys.unknown = keys.unknown.or(Some(key)),
                        Key::Part(part) => {
                            if keys.parts[part].replace(given).is_some() {
                                keys.repeated = Some(part);
                            }
                        }
                    }
                }
                Ok(keys)
            }
        }
        deserializer.deserialize_map(Object)
    }
}

fn of_json(value: Value) -> Given {
    let kind = match value {
        Value::Null => return Given::Missing,
        Value::Number(number) => {
            let real = number.as_f64().map_or(Given::Missing, Given::Real);
            return number.as_u64().map_or(real, Given::Whole);
        }
        Value::Bool(_) => "a truth value",
        Value::String(_) => "a string",
        Value::Array(_) => "a list",
        Value::Object(_) => "an object",
    };
    Given::NoNumber(kind.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An address and its line, or the line and the code of a fault.
    type Found = Result<(u32, Address), (Option<u32>, &'static str)>;

    fn all(text: &str, format: SampleFormat) -> Vec<Found> {
        let mut reader = AddressReader::new(text.as_bytes(), format).unwrap();
        let mut out = Vec::new();
        while let Some(next) = reader.next_address().unwrap() {
            out.push(next.map_err(|fault| (fault.line, fault.code)));
        }
        out
    }

    fn at(face: u32, corner: Option<u32>, u: f64, v: f64) -> Address {
        Address { face, corner, u, v }
    }

    #[test]
    fn both_formats_say_the_same() {
        let expected =
            [(2, at(0, None, 0.5, 0.25)), (3, at(7, Some(2), 0.0, 1.0)), (5, at(3, None, 1e-9, 0.0))];
        let expected: Vec<_> = expected.into_iter().map(Ok).collect();
        let csv = "face,corner,u,v\n0,,0.5,0.25\r\n7,2,0,1\n  \n3, , 1e-9 ,\"0\"\n\n\n";
        assert_eq!(all(csv, SampleFormat::Csv), expected);
        let other = "\u{feff}V, Corner ,\"u\",face\n.25,,0.5,0\n1,2.0,0,7\n\n-0,,1E-9,3.0";
        assert_eq!(all(other, SampleFormat::Csv), expected);
        let json = "\n{\"face\":0,\"u\":0.5,\"v\":0.25}\r\n{ \"v\": 1, \"corner\": 2.0, \"face\": 7, \"u\": 0 }\n\n\
                    {\"face\":3,\"corner\":null,\"\\u0075\":1e-9,\"v\":-0.0}\n";
        assert_eq!(all(json, SampleFormat::JsonLines), expected);
    }

    #[test]
    fn each_bad_line_is_named_and_the_next_is_read() {
        let cases = [
            ("1.5,,0,0", "bad_number"),
            ("-1,,0,0", "bad_number"),
            (",,0,0", "missing_number"),
            ("x,,0,0", "bad_number"),
            ("nan,,0,0", "not_finite"),
            ("5000000000,,0,0", "missing_face"),
            ("99999999999999999999999,,0,0", "missing_face"),
            ("0,5000000000,0,0", "missing_corner"),
            ("0,-1,0,0", "bad_number"),
            ("0,,nan,0", "not_finite"),
            ("0,,0,-inf", "not_finite"),
            ("0,,1e999,0", "not_finite"),
            ("0,,,0", "missing_number"),
            ("0,,0,0 0", "bad_number"),
            ("0,,0", "malformed_line"),
            ("0,,0,0,", "malformed_line"),
            ("0;0;0;0", "malformed_line"),
        ];
        for (line, code) in cases {
            let found = all(&format!("face,corner,u,v\n0,,0,0\n{line}\n1,,0,0\n"), SampleFormat::Csv);
            let [first, second] = [(2, at(0, None, 0.0, 0.0)), (4, at(1, None, 0.0, 0.0))];
            assert_eq!(found, [Ok(first), Err((Some(3), code)), Ok(second)], "{line}");
        }
        let cases = [
            (r#"{"face":0,"u":0.5}"#, "missing_number"),
            (r#"{"face":0,"u":0.5,"v":null}"#, "missing_number"),
            (r#"{"u":0.5,"v":0.5}"#, "missing_number"),
            (r#"{"face":"0","u":0.5,"v":0}"#, "bad_number"),
            (r#"{"face":0,"u":[0.5],"v":0}"#, "bad_number"),
            (r#"{"face":0,"u":true,"v":0}"#, "bad_number"),
            (r#"{"face":-1,"u":0,"v":0}"#, "bad_number"),
            (r#"{"face":0.5,"u":0,"v":0}"#, "bad_number"),
            (r#"{"face":5000000000,"u":0,"v":0}"#, "missing_face"),
            (r#"{"face":0,"corner":-1,"u":0,"v":0}"#, "bad_number"),
            (r#"{"face":0,"u":0,"v":0,"u":0}"#, "malformed_line"),
            (r#"{"face":0,"u":0,"v":0,"w\n":0}"#, "unknown_key"),
            (r#"{"face":0,"u":NaN,"v":0}"#, "bad_json"),
            (r#"{"face":0,"u":1e999,"v":0}"#, "bad_json"),
            (r#"{"face":0,"u":0,"v":0"#, "bad_json"),
            (r#"{"face":0,"u":0,"v":0} {}"#, "bad_json"),
            ("[0, null, 0, 0]", "bad_json"),
            ("0,,0,0", "bad_json"),
        ];
        for (line, code) in cases {
            let good = r#"{"face":0,"u":0,"v":0}"#;
            let found = all(&format!("{good}\n{line}\n{good}"), SampleFormat::JsonLines);
            let [first, second] = [(1, at(0, None, 0.0, 0.0)), (3, at(0, None, 0.0, 0.0))];
            assert_eq!(found, [Ok(first), Err((Some(2), code)), Ok(second)], "{line}");
        }
        let long = format!("face,u,v\n0,{},0\n0,0,0", " ".repeat(LONGEST));
        assert_eq!(all(&long, SampleFormat::Csv)[0], Err((Some(2), "malformed_line")));
    }

    #[test]
    fn a_file_without_sense_is_refused_at_once() {
        let cases = [
            ("face,u\n", "bad_header"),
            ("face,u,v,w\n", "bad_header"),
            ("face,u,v,u\n", "bad_header"),
            ("0,,0.5,0.5\n", "bad_header"),
            ("\u{1}\u{2}", "not_text"),
        ];
        for (text, code) in cases {
            match AddressReader::new(text.as_bytes(), SampleFormat::Csv) {
                Err(AddressesError::Refused(error)) => assert_eq!(error.faults[0].code, code),
                _ => panic!("{text:?} was read"),
            }
        }
        for text in ["", "\n\n", "face,u,v\n"] {
            assert!(all(text, SampleFormat::Csv).is_empty());
        }
        assert!(all("", SampleFormat::JsonLines).is_empty());
    }

    #[test]
    fn faults_say_what_to_do() {
        let mut reader =
            AddressReader::new(&b"{\"face\":0,\"u\":0.5,}"[..], SampleFormat::JsonLines).unwrap();
        let fault = reader.next_address().unwrap().unwrap().unwrap_err();
        assert_eq!(fault.to_string(), "trailing comma, at byte 19");
        let fault = from_csv(b"4,,0.5,half", &[0, 1, 2, 3]).unwrap_err();
        assert_eq!(
            (fault.to_string().as_str(), fault.place),
            ("v is `half`, which is no number", Some(Place::Face(4)))
        );
    }
}
