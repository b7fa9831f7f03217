//! What a piece of a parametric face can be, and walking down to it.

/// A reference to a piece: two bits for what it is, the rest for which.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Node(u32);

/// What a [`Node`] refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Piece {
    /// One bicubic patch: a block of 16 sources.
    Leaf(u32),
    /// Four pieces, each in the directions of the parent.
    Split(u32),
    /// A chain of rings around one irregular corner.
    Tail(u32),
}

impl Node {
    /// Stands for nothing yet.
    pub(crate) const NONE: Node = Node(u32::MAX);

    const SHIFT: u32 = 30;
    const INDEX: u32 = (1 << Node::SHIFT) - 1;

    pub(crate) fn new(piece: Piece) -> Node {
        let (tag, index) = match piece {
            Piece::Leaf(index) => (0, index),
            Piece::Split(index) => (1, index),
            Piece::Tail(index) => (2, index),
        };
        assert!(index <= Node::INDEX, "fewer than 2^30 pieces of a kind");
        Node(tag << Node::SHIFT | index)
    }

    #[inline]
    pub(crate) fn piece(self) -> Piece {
        let index = self.0 & Node::INDEX;
        match self.0 >> Node::SHIFT {
            0 => Piece::Leaf(index),
            1 => Piece::Split(index),
            2 => Piece::Tail(index),
            _ => unreachable!("every node of a finished table is one of three"),
        }
    }

    pub(crate) fn from_bits(bits: u32) -> Node {
        Node(bits)
    }

    pub(crate) fn bits(self) -> u32 {
        self.0
    }
}

/// A chain of rings: where its ring is, of what kind it is, and which corner of the piece is irregular.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tail {
    /// The first of its ring among the sources of all tails.
    pub(crate) first: u32,
    pub(crate) kind: u32,
    pub(crate) corner: u32,
}

/// The child of a piece that holds `(u, v)`, and the parameters in it: `(u', v') = 2 (u, v) - q`.
#[inline]
pub(crate) fn child(u: f64, v: f64) -> (usize, f64, f64) {
    let (right, upper) = (u >= 0.5, v >= 0.5);
    let corner = match (right, upper) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    (corner, 2.0 * u - f64::from(u8::from(right)), 2.0 * v - f64::from(u8::from(upper)))
}

/// Parameters of a piece in the frame of its corner `r`, that corner at the origin.
#[inline]
pub(crate) fn to_corner(r: u32, u: f64, v: f64) -> (f64, f64) {
    match r {
        0 => (u, v),
        1 => (v, 1.0 - u),
        2 => (1.0 - u, 1.0 - v),
        _ => (1.0 - v, u),
    }
}

/// Parameters of a piece from those in the frame of its corner `r`.
#[inline]
pub(crate) fn from_corner(r: u32, x: f64, y: f64) -> [f64; 2] {
    match r {
        0 => [x, y],
        1 => [1.0 - y, x],
        2 => [1.0 - x, 1.0 - y],
        _ => [y, 1.0 - x],
    }
}
