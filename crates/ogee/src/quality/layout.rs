//! `Layout`: squares of parameters that share whole sides.
//!
//! A quad beside a triangle shares one side with two corners of it, and a face of a part one with two smaller faces. Where that
//! happens the larger squares are cut, so that whoever walks over joints or lays grids on faces never meets half a side.

use crate::patch::Location;

/// A square of parameters: a face, or a quarter of it. `(s, t)` in it runs from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Square {
    /// Its `(0, 0)`.
    pub corner: Location,
    /// The lengths of its sides in the parameters of the face.
    pub size: [f64; 2],
    /// The same of the piece that it was cut from for the sake of smaller neighbours; its own where it was not cut.
    pub piece: [f64; 2],
    /// Which of its sides lie on an edge of the cage, or on the border of a patch.
    pub edges: [bool; 4],
}

impl Square {
    /// A square that is a piece of its own.
    pub(super) fn whole(corner: Location, size: [f64; 2], edges: [bool; 4]) -> Square {
        Square { corner, size, piece: size, edges }
    }

    /// The place of `(s, t)`, both in `[0, 1]`.
    #[inline]
    pub fn at(&self, s: f64, t: f64) -> Location {
        let [u, v] = self.corner.parameters();
        self.corner.clamped(u + s * self.size[0], v + t * self.size[1])
    }

    /// The place on side `side` (0 along `t = 0`, then counter-clockwise) at `x` from its start.
    #[inline]
    pub fn on_side(&self, side: u32, x: f64) -> Location {
        let [s, t] = side_point(side, x);
        self.at(s, t)
    }
}

/// Parameters in a square of the point at `x` on a side, counter-clockwise; exact at both ends.
#[inline]
pub(crate) fn side_point(side: u32, x: f64) -> [f64; 2] {
    match side {
        0 => [x, 0.0],
        1 => [1.0, x],
        2 => [1.0 - x, 1.0],
        _ => [0.0, 1.0 - x],
    }
}

/// A side of a square: 0 along `t = 0`, then counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Side {
    /// The square.
    pub square: u32,
    /// Which of its sides.
    pub side: u32,
}

/// Two sides that are one curve: the point at `x` on the first is that at `1 - x` on the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Joint {
    /// The sides, the smaller first.
    pub sides: [Side; 2],
    /// True where the surface has a crease that never fades.
    pub is_sharp: bool,
}

/// Squares and the joints between them.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    squares: Vec<Square>,
    joints: Vec<Joint>,
    /// For each side of each square the joint, or [`Layout::NONE`].
    of_sides: Vec<[u32; 4]>,
}

impl Layout {
    const NONE: u32 = u32::MAX;

    pub(crate) fn new(squares: Vec<Square>, mut joints: Vec<Joint>) -> Layout {
        for joint in &mut joints {
            joint.sides.sort_unstable();
        }
        joints.sort_unstable_by_key(|joint| joint.sides);
        let mut of_sides = vec![[Layout::NONE; 4]; squares.len()];
        for (number, joint) in (0..).zip(&joints) {
            for Side { square, side } in joint.sides {
                of_sides[square as usize][side as usize] = number;
            }
        }
        Layout { squares, joints, of_sides }
    }

    /// The squares, in the order of the faces.
    pub fn squares(&self) -> &[Square] {
        &self.squares
    }

    /// The joints, in the order of their first sides.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The number of the joint on a side; `None` on the border of the surface.
    #[inline]
    pub fn joint_of(&self, Side { square, side }: Side) -> Option<usize> {
        let joint = self.of_sides[square as usize][side as usize];
        (joint != Layout::NONE).then_some(joint as usize)
    }

    /// The side across a joint; `None` on the border of the surface.
    #[inline]
    pub fn across(&self, side: Side) -> Option<Side> {
        let [first, second] = self.joints[self.joint_of(side)?].sides;
        Some(if first == side { second } else { first })
    }

    /// The point at `x` on a side as the square across sees it; `None` on the border of the surface.
    #[inline]
    pub fn cross(&self, side: Side, x: f64) -> Option<(u32, [f64; 2])> {
        let Side { square, side } = self.across(side)?;
        Some((square, side_point(side, 1.0 - x)))
    }

    /// The sides without a neighbour, in order.
    pub fn border(&self) -> impl Iterator<Item = Side> + '_ {
        let sides =
            (0..self.squares.len() as u32).flat_map(|square| (0..4).map(move |side| Side { square, side }));
        sides.filter(|&side| self.joint_of(side).is_none())
    }
}
