//! The weights of common classes, shipped as tables, and of all others, generated when they are first asked for.
//!
//! A table has a block for each sector that does not follow from another by the mirror. A block has a byte for every column but
//! the vertex's, which says how many bits a number of that column takes, and then the numbers, column by column, packed from the
//! lowest bit of the first byte on and filled up to a whole byte. Rows are those of `(i, j)`, `i` slower, only `j <= i` where a
//! sector is its own mirror image. Numbers are multiples of `2^-57` in two's complement. What the vertex weighs is what is
//! missing from 1.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::{CapClass, CornerAngle, INNER, Weights, generate};
use crate::math::Grid;

/// Weights in tables are multiples of the inverse of this: half an ulp of the greatest ones, a fraction of rounding in use.
const ONE: f64 = (1u64 << 57) as f64;

macro_rules! table {
    ($name:literal) => {
        include_bytes!(concat!("tables/", $name, ".bin"))
    };
}

const fn interior(valence: u32) -> CapClass {
    CapClass::Interior { valence }
}

const fn boundary(faces: u32) -> CapClass {
    CapClass::Boundary { faces }
}

const fn convex(faces: u32) -> CapClass {
    CapClass::Corner { faces, angle: CornerAngle::Convex }
}

const fn concave(faces: u32) -> CapClass {
    CapClass::Corner { faces, angle: CornerAngle::Concave }
}

const fn dart(valence: u32) -> CapClass {
    CapClass::Dart { valence }
}

/// The tables that are shipped; names as [`table_name`] has them.
static SHIPPED: [(CapClass, &[u8]); 21] = [
    (interior(3), table!("interior-3")),
    (interior(5), table!("interior-5")),
    (interior(6), table!("interior-6")),
    (interior(7), table!("interior-7")),
    (interior(8), table!("interior-8")),
    (interior(9), table!("interior-9")),
    (interior(10), table!("interior-10")),
    (interior(12), table!("interior-12")),
    (boundary(3), table!("boundary-3")),
    (boundary(4), table!("boundary-4")),
    (boundary(5), table!("boundary-5")),
    (boundary(6), table!("boundary-6")),
    (convex(2), table!("corner-2-convex")),
    (convex(3), table!("corner-3-convex")),
    (convex(4), table!("corner-4-convex")),
    (concave(2), table!("corner-2-concave")),
    (concave(3), table!("corner-3-concave")),
    (concave(4), table!("corner-4-concave")),
    (dart(3), table!("dart-3")),
    (dart(4), table!("dart-4")),
    (dart(5), table!("dart-5")),
];

/// The classes whose tables are shipped.
pub fn shipped_classes() -> impl ExactSizeIterator<Item = CapClass> {
    SHIPPED.iter().map(|&(class, _)| class)
}

/// What the table of a class is called, without the ending `.bin`.
pub fn table_name(class: CapClass) -> String {
    match class {
        CapClass::Interior { valence } => format!("interior-{valence}"),
        CapClass::Boundary { faces } => format!("boundary-{faces}"),
        CapClass::Corner { faces, angle: CornerAngle::Convex } => format!("corner-{faces}-convex"),
        CapClass::Corner { faces, angle: CornerAngle::Concave } => format!("corner-{faces}-concave"),
        CapClass::Dart { valence } => format!("dart-{valence}"),
    }
}

/// True if there are caps of a class: regular vertices need none, and solutions are known up to some valence only.
pub fn is_solvable(class: CapClass) -> bool {
    match class {
        CapClass::Interior { valence } => (3..=32).contains(&valence) && valence != 4,
        CapClass::Boundary { faces } => (3..=8).contains(&faces),
        CapClass::Corner { faces, .. } => (2..=6).contains(&faces),
        CapClass::Dart { valence } => (3..=6).contains(&valence),
    }
}

/// The weights of a class: from a shipped table, or else generated, which takes a while. Both are done once and kept.
///
/// `None` if [`is_solvable`] says no.
pub fn weights(class: CapClass) -> Option<Arc<Weights>> {
    static KNOWN: Mutex<Option<HashMap<CapClass, Arc<Weights>>>> = Mutex::new(None);
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = known().get_or_insert_default().get(&class) {
        return Some(found.clone());
    }
    // Not under the lock: others need not wait, and who comes second finds what the first has made.
    let made = Arc::new(shipped(class).or_else(|| generate(class))?);
    Some(known().get_or_insert_default().entry(class).or_insert(made).clone())
}

fn shipped(class: CapClass) -> Option<Weights> {
    let (_, table) = SHIPPED.iter().find(|(shipped, _)| *shipped == class)?;
    decode(class, table)
}

/// How many sectors a table has: around an interior vertex one, else every one that is not the mirror image of an earlier one.
fn blocks(class: CapClass) -> usize {
    if class.is_closed() { 1 } else { class.sectors().div_ceil(2) }
}

/// The inner coefficients whose weights a block has.
fn block_rows(class: CapClass, sector: usize) -> Vec<(usize, usize)> {
    let halved = class.mirrored_sector(sector) == sector;
    let last = |i: usize| if halved { i } else { INNER - 1 };
    (0..INNER).flat_map(|i| (0..=last(i)).map(move |j| (i, j))).collect()
}

/// The table of some weights. What follows by the mirror is left out.
pub fn encode(weights: &Weights) -> Vec<u8> {
    let class = weights.class;
    let mut out = Vec::new();
    for sector in 0..blocks(class) {
        let rows = block_rows(class, sector);
        let columns: Vec<Vec<i64>> = (1..class.columns())
            .map(|column| {
                let number =
                    |&(i, j): &(usize, usize)| (weights.row(sector, i, j)[column] * ONE).round() as i64;
                rows.iter().map(number).collect()
            })
            .collect();
        let width = |column: &Vec<i64>| column.iter().map(|&number| bits(number)).max().unwrap_or(0);
        let widths: Vec<u32> = columns.iter().map(width).collect();
        out.extend(widths.iter().map(|&width| width as u8));
        let mut writer = BitWriter { out: &mut out, waiting: 0, count: 0 };
        for (column, &width) in columns.iter().zip(&widths) {
            for &number in column {
                writer.write(number, width);
            }
        }
        writer.finish();
    }
    out
}

/// How many bits a number takes in two's complement, its sign among them.
fn bits(number: i64) -> u32 {
    65 - number.unsigned_abs().max((number + 1).unsigned_abs()).leading_zeros()
}

/// The weights of a table; `None` if it is too short or too long.
fn decode(class: CapClass, table: &[u8]) -> Option<Weights> {
    let mirrored = class.mirrored_columns();
    let columns = class.columns();
    let count = if class.is_closed() { 1 } else { class.sectors() };
    let mut sectors = vec![Grid::from_fn(INNER * INNER, columns, |_, _| 0.0); count];
    let mut rest = table;
    for sector in 0..blocks(class) {
        let rows = block_rows(class, sector);
        let (widths, packed) = rest.split_at_checked(columns - 1)?;
        let mut reader = BitReader { bytes: packed, position: 0 };
        let mut numbers = Grid::from_fn(rows.len(), columns, |_, _| 0i64);
        for (column, &width) in (1..).zip(widths) {
            for row in 0..rows.len() {
                numbers[(row, column)] = reader.read(u32::from(width))?;
            }
        }
        rest = packed.get(reader.position.div_ceil(8)..)?;
        let image = if class.is_closed() { 0 } else { class.mirrored_sector(sector) };
        for (row, &(i, j)) in rows.iter().enumerate() {
            numbers[(row, 0)] =
                numbers.row(row).iter().fold(ONE as i64, |left, number| left.wrapping_sub(*number));
            for column in 0..columns {
                let weight = numbers[(row, column)] as f64 / ONE;
                sectors[sector][(INNER * i + j, column)] = weight;
                sectors[image][(INNER * j + i, mirrored[column])] = weight;
            }
        }
    }
    rest.is_empty().then_some(Weights { class, sectors })
}

/// Numbers of a few bits each, into bytes.
struct BitWriter<'a> {
    out: &'a mut Vec<u8>,
    waiting: u128,
    count: u32,
}

impl BitWriter<'_> {
    fn write(&mut self, number: i64, width: u32) {
        let mask = (1u128 << width) - 1;
        self.waiting |= (number as u128 & mask) << self.count;
        self.count += width;
        while self.count >= 8 {
            self.out.push(self.waiting as u8);
            self.waiting >>= 8;
            self.count -= 8;
        }
    }

    fn finish(self) {
        if self.count > 0 {
            self.out.push(self.waiting as u8);
        }
    }
}

/// Numbers of a few bits each, out of bytes.
struct BitReader<'a> {
    bytes: &'a [u8],
    /// In bits.
    position: usize,
}

impl BitReader<'_> {
    /// `None` at the end, or if no number is so wide.
    fn read(&mut self, width: u32) -> Option<i64> {
        let shift = 64u32.checked_sub(width)?;
        let start = self.position / 8;
        self.position += width as usize;
        let window = self.bytes.get(start..self.position.div_ceil(8))?;
        let mut held = [0; 16];
        held[..window.len()].copy_from_slice(window);
        let inside = (self.position - width as usize) % 8;
        let number = (u128::from_le_bytes(held) >> inside) as u64;
        // To the top and back again, which keeps the sign; nothing is left of a number of no bits.
        Some(number.checked_shl(shift).map_or(0, |top| top as i64 >> shift))
    }
}
