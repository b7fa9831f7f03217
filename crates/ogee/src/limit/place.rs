//! Where a point of the surface lies: in which bicubic patch, and at which of its parameters.
//!
//! A patch has a *key*, a number: samples of one patch have the same key, and sorted keys go down a chain step by step.

use super::walk::last_step;
use crate::patch::{Location, PatchTable, Piece, Tail, from_corner, to_corner};

/// A patch, or an extraordinary vertex itself.
pub(super) enum Patch<'a> {
    /// A leaf: the numbers of its points, and how often its face was halved.
    Leaf {
        sources: &'a [u32; 16],
        depth: i32,
    },
    Tile(Tile),
    Vertex {
        tail: Tail,
        number: u32,
    },
}

/// A tile of a tail.
#[derive(Clone, Copy)]
pub(super) struct Tile {
    pub(super) tail: Tail,
    /// The number of the tail.
    pub(super) number: u32,
    pub(super) step: i32,
    /// How many steps more the point lies below the last that is taken.
    pub(super) beyond: i32,
    /// Which of the three: at `(1, 0)`, `(1, 1)`, `(0, 1)`.
    pub(super) tile: usize,
    /// How often the face was halved before the tail.
    pub(super) depth: i32,
}

/// Bits of a key below those of the piece: 12 for the step, counted without end, and 2 for the tile. A step of zero is
/// the vertex.
const CHAIN_BITS: u32 = 14;

/// Bits for how often the face was halved.
const DEPTH_BITS: u32 = 5;

/// The key of a point in a parametric face that is not a leaf, and its parameters in the patch.
pub(super) fn key(table: &PatchTable, root: u32, u: f64, v: f64) -> (u64, f64, f64) {
    let (piece, u, v, depth) = table.descend(table.root_node(root), u, v);
    let head = |is_tail: u64, number: u32| {
        ((is_tail << 30 | u64::from(number)) << DEPTH_BITS | depth as u64) << CHAIN_BITS
    };
    match piece {
        Piece::Leaf(number) => (head(0, number), u, v),
        Piece::Tail(number) => {
            let (low, u, v) = in_chain(table.tail(number).corner, u, v);
            (head(1, number) | low, u, v)
        }
        Piece::Split(_) => unreachable!("one descends to a leaf or a tail"),
    }
}

impl Tile {
    /// A quarter of it, counted in the directions of the piece, where that is a patch of its own.
    pub(super) fn quarter(self, quarter: usize) -> Tile {
        // Its number is that in the frame of the corner.
        let own = (quarter + 4 - self.tail.corner as usize) % 4;
        Tile { tile: 4 * self.tile + own, depth: self.depth + 1, ..self }
    }
}

impl<'a> Patch<'a> {
    /// The patch of a key.
    pub(super) fn of(table: &'a PatchTable, key: u64) -> Patch<'a> {
        let head = key >> CHAIN_BITS;
        let depth = (head & ((1 << DEPTH_BITS) - 1)) as i32;
        let number = (head >> DEPTH_BITS & ((1 << 30) - 1)) as u32;
        if head >> (DEPTH_BITS + 30) == 0 {
            return Patch::Leaf { sources: table.leaf(number), depth };
        }
        Patch::of_step(table, table.tail(number), number, key & ((1 << CHAIN_BITS) - 1), depth)
    }

    /// The patch of a tail, from the part of the key that [`in_chain`] gives.
    pub(super) fn of_step(table: &PatchTable, tail: Tail, number: u32, low: u64, depth: i32) -> Patch<'a> {
        let (step, tile) = ((low >> 2) as i32, (low & 3) as usize);
        if step == 0 {
            return Patch::Vertex { tail, number };
        }
        let beyond = (step - last_step(table.basis(tail))).max(0);
        Patch::Tile(Tile { tail, number, step: step - beyond, beyond, tile, depth })
    }

    /// The patch of a location, and the parameters in it.
    pub(super) fn at(table: &'a PatchTable, at: Location) -> (Patch<'a>, f64, f64) {
        if let Some(sources) = table.root_leaf(at.root) {
            return (Patch::Leaf { sources, depth: 0 }, at.u, at.v);
        }
        let (key, x, y) = key(table, at.root, at.u, at.v);
        (Patch::of(table, key), x, y)
    }
}

/// The low part of a key for a point of a piece whose irregular corner is `corner`, and its parameters in the tile, in
/// the directions of the piece. No logarithm: the exponent of the larger parameter says how often it can be doubled.
#[inline]
pub(super) fn in_chain(corner: u32, u: f64, v: f64) -> (u64, f64, f64) {
    let (mut x, mut y) = to_corner(corner, u, v);
    let mut step = 0;
    while larger(x, y) < f64::MIN_POSITIVE {
        if larger(x, y) <= 0.0 {
            return (0, 0.0, 0.0);
        }
        // No exponent to read: doubled by hand.
        (x, y, step) = (2.0 * x, 2.0 * y, step + 1);
    }
    let exponent = (larger(x, y).to_bits() >> 52) as i32;
    let doublings = (1023 - exponent).max(1);
    let scale = power_of_two(doublings);
    (x, y) = (x * scale, y * scale);
    // Which of the tiles at (1, 0), (1, 1), (0, 1); one of the two is 1 at least.
    let (right, above) = (x >= 1.0, y >= 1.0);
    let tile = u64::from(above) << u64::from(!right);
    let (x, y) = (x - f64::from(u8::from(right)), y - f64::from(u8::from(above)));
    let (u, v) = from_corner(corner, x, y);
    (((step + doublings) as u64) << 2 | tile, u, v)
}

#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// `2^e`, for exponents of numbers.
#[inline]
pub(super) fn power_of_two(e: i32) -> f64 {
    f64::from_bits(((1023 + e) as u64) << 52)
}
