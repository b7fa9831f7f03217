//! `Emitter`: lines of a STEP file, numbered in the order of writing, with every point written once.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt::Arguments;
use std::hash::{BuildHasherDefault, Hasher};
use std::io::{self, Write};

use ogee::Vec3;

use super::syntax::{Id, push_real};

/// Text is handed on in pieces of about this size.
const BUFFER: usize = 1 << 16;

/// Writes entities and numbers them.
pub(super) struct Emitter<'a, W: Write> {
    out: &'a mut W,
    text: Vec<u8>,
    last: u64,
    points: HashMap<[u64; 3], Id, BuildHasherDefault<PointHasher>>,
}

impl<'a, W: Write> Emitter<'a, W> {
    /// An emitter with room for so many points.
    pub(super) fn new(out: &'a mut W, points: usize) -> Self {
        let points = HashMap::with_capacity_and_hasher(points, BuildHasherDefault::default());
        Emitter { out, text: Vec::with_capacity(2 * BUFFER), last: 0, points }
    }

    /// A line without a number.
    pub(super) fn line(&mut self, line: Arguments<'_>) -> io::Result<()> {
        self.text.write_fmt(line)?;
        self.text.push(b'\n');
        self.hand_on(BUFFER)
    }

    /// An entity; its number is returned.
    pub(super) fn entity(&mut self, entity: Arguments<'_>) -> io::Result<Id> {
        self.last += 1;
        let id = Id(self.last);
        self.line(format_args!("{id}={entity};"))?;
        Ok(id)
    }

    /// The number of the point, which is written if it is new. Points are equal if their bits are; zeros have
    /// no sign.
    pub(super) fn point(&mut self, point: Vec3) -> io::Result<Id> {
        let key = <[f64; 3]>::from(point).map(|coordinate| (coordinate + 0.0).to_bits());
        let place = match self.points.entry(key) {
            Entry::Occupied(place) => return Ok(*place.get()),
            Entry::Vacant(place) => place,
        };
        self.last += 1;
        let id = *place.insert(Id(self.last));
        write!(self.text, "{id}=CARTESIAN_POINT('',(")?;
        push_real(&mut self.text, point.x);
        self.text.push(b',');
        push_real(&mut self.text, point.y);
        self.text.push(b',');
        push_real(&mut self.text, point.z);
        self.text.extend_from_slice(b"));\n");
        self.hand_on(BUFFER)?;
        Ok(id)
    }

    /// Hands on what is left.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.hand_on(0)?;
        self.out.flush()
    }

    fn hand_on(&mut self, limit: usize) -> io::Result<()> {
        if self.text.len() > limit {
            self.out.write_all(&self.text)?;
            self.text.clear();
        }
        Ok(())
    }
}

/// Multiplies and folds: the keys are our own coordinates, and there are millions of them.
#[derive(Default)]
struct PointHasher(u64);

impl Hasher for PointHasher {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_ne_bytes(word));
        }
    }

    fn write_u64(&mut self, word: u64) {
        let product = u128::from(self.0.rotate_left(23) ^ word) * u128::from(0x9e37_79b9_7f4a_7c15_u64);
        self.0 = (product as u64) ^ ((product >> 64) as u64);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}
