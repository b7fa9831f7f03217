//! Whole-numbered places on squares, and the one name of those that several squares share.
//!
//! Where squares meet smoothly, a point of a side belongs to the first of them: whoever asks evaluates it there, in the
//! same parameters, and gets the same bits. So what two squares find on a side that they share is the same.

use crate::patch::Location;
use crate::quality::layout::{Layout, Side, side_point};

/// Cells along a side of a square that is not refined.
pub(super) const COARSE: u16 = 8;

/// How often cells are cut in four at most.
const DEPTH: u16 = 5;

/// Places along a side of a square: 0 to this.
pub(super) const WHOLE: u16 = COARSE << DEPTH;

/// How often a whole square can be cut in four.
pub(super) const CUTS: u32 = WHOLE.ilog2();

/// A place of a square.
pub(super) type Place = [u16; 2];

/// A piece of a line of the lattice, in the direction in which places are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    /// The square.
    pub(super) square: u32,
    /// Where it starts.
    pub(super) start: Place,
    /// How long it is.
    pub(super) length: u16,
    /// Along which parameter, 0 or 1.
    pub(super) axis: u8,
}

/// Squares with the names of their places.
#[derive(Debug)]
pub(super) struct Lattice<'a> {
    pub(super) layout: &'a Layout,
    /// For each corner of each square the first corner that is the same point, seen from the same side of any crease.
    corners: Vec<[(u32, u8); 4]>,
}

impl<'a> Lattice<'a> {
    pub(super) fn new(layout: &'a Layout) -> Lattice<'a> {
        let count = layout.squares().len();
        // Corner k of square n is 4 n + k; each leads to a smaller one that is the same.
        let mut leads: Vec<u32> = (0..4 * count as u32).collect();
        fn first(leads: &mut [u32], mut corner: u32) -> u32 {
            while leads[corner as usize] != corner {
                leads[corner as usize] = leads[leads[corner as usize] as usize];
                corner = leads[corner as usize];
            }
            corner
        }
        for joint in layout.joints().iter().filter(|joint| !joint.is_sharp) {
            let [a, b] = joint.sides;
            let start = |side: Side| 4 * side.square + side.side;
            let end = |side: Side| 4 * side.square + (side.side + 1) % 4;
            for (one, other) in [(start(a), end(b)), (end(a), start(b))] {
                let (one, other) = (first(&mut leads, one), first(&mut leads, other));
                leads[one.max(other) as usize] = one.min(other);
            }
        }
        let mut named = |corner: u32| {
            let first = first(&mut leads, corner);
            (first / 4, (first % 4) as u8)
        };
        let corners = (0..count as u32).map(|n| [0, 1, 2, 3].map(|k| named(4 * n + k))).collect();
        Lattice { layout, corners }
    }

    /// The side across a smooth joint.
    pub(super) fn across(&self, side: Side) -> Option<Side> {
        let joint = self.layout.joint_of(side)?;
        (!self.layout.joints()[joint].is_sharp).then(|| self.layout.across(side))?
    }

    /// The side that names what is on this one: the first of the two that meet.
    fn naming(&self, side: Side) -> Side {
        self.across(side).map_or(side, |other| other.min(side))
    }

    /// The point of the surface at a place, in the parameters of the square that names it.
    pub(super) fn location(&self, square: u32, place: Place) -> Location {
        let (square, [i, j]) = match corner_of(place) {
            Some(corner) => {
                let (square, corner) = self.corners[square as usize][corner as usize];
                (square, on_side(u32::from(corner), 0))
            }
            None => match side_of(place) {
                Some((side, x)) => {
                    let mine = Side { square, side };
                    let first = self.naming(mine);
                    let x = if first == mine { x } else { WHOLE - x };
                    (first.square, on_side(first.side, x))
                }
                None => (square, place),
            },
        };
        self.layout.squares()[square as usize].at(share(i), share(j))
    }

    /// The name of an edge, and whether it runs the other way there.
    pub(super) fn named(&self, edge: Edge) -> (Edge, bool) {
        let Some((side, from, to)) = side_of_edge(edge) else { return (edge, false) };
        let mine = Side { square: edge.square, side };
        let first = self.naming(mine);
        if first == mine {
            return (edge, false);
        }
        let [a, b] = [from, to].map(|x| on_side(first.side, WHOLE - x));
        let axis = u8::from(a[0] == b[0]);
        let is_turned = a[usize::from(axis)] > b[usize::from(axis)];
        let start = if is_turned { b } else { a };
        (Edge { square: first.square, start, length: edge.length, axis }, is_turned)
    }

    /// The point at `x` along an edge, 0 to 1, in the parameters of its own square.
    pub(super) fn along(&self, edge: Edge, x: f64) -> Location {
        let mut at = edge.start.map(share);
        let axis = usize::from(edge.axis);
        at[axis] = (f64::from(edge.start[axis]) + x * f64::from(edge.length)) / f64::from(WHOLE);
        self.layout.squares()[edge.square as usize].at(at[0], at[1])
    }

    /// How the parameters of a location change along an edge, per unit of `x`.
    pub(super) fn pace(&self, edge: Edge) -> f64 {
        let size = self.layout.squares()[edge.square as usize].size[usize::from(edge.axis)];
        size * f64::from(edge.length) / f64::from(WHOLE)
    }
}

fn share(x: u16) -> f64 {
    f64::from(x) / f64::from(WHOLE)
}

fn corner_of(place: Place) -> Option<u8> {
    match place {
        [0, 0] => Some(0),
        [WHOLE, 0] => Some(1),
        [WHOLE, WHOLE] => Some(2),
        [0, WHOLE] => Some(3),
        _ => None,
    }
}

/// The side on which a place is that is no corner, and where on it.
pub(super) fn side_of([i, j]: Place) -> Option<(u32, u16)> {
    match (i, j) {
        (i, 0) => Some((0, i)),
        (WHOLE, j) => Some((1, j)),
        (i, WHOLE) => Some((2, WHOLE - i)),
        (0, j) => Some((3, WHOLE - j)),
        _ => None,
    }
}

/// The side on which an edge is, and where on it the edge starts and ends.
fn side_of_edge(Edge { start: [i, j], length, axis, .. }: Edge) -> Option<(u32, u16, u16)> {
    match (axis, i, j) {
        (0, i, 0) => Some((0, i, i + length)),
        (1, WHOLE, j) => Some((1, j, j + length)),
        (0, i, WHOLE) => Some((2, WHOLE - i, WHOLE - i - length)),
        (1, 0, j) => Some((3, WHOLE - j, WHOLE - j - length)),
        _ => None,
    }
}

/// The place at `x` on a side.
pub(super) fn on_side(side: u32, x: u16) -> Place {
    side_point(side, share(x)).map(|x| (x * f64::from(WHOLE)) as u16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes;
    use crate::quality::{LimitView, Surface};
    use crate::{Level, LimitSurface, PatchTable};

    #[test]
    fn both_squares_give_a_point_of_their_side_one_name() {
        let mesh = shapes::cube();
        let level = Level::new(&mesh).unwrap();
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &mesh.points);
        let view = LimitView::new(&level, &surface);
        let lattice = Lattice::new(view.layout());
        for joint in view.layout().joints() {
            let [a, b] = joint.sides;
            for x in [0, 1, 77, 128, WHOLE] {
                let [p, q] = [(a, x), (b, WHOLE - x)].map(|(side, x)| {
                    let place = on_side(side.side, x);
                    if let Some((side, found)) = side_of(place).filter(|_| corner_of(place).is_none()) {
                        assert_eq!(on_side(side, found), place);
                    }
                    lattice.location(side.square, place)
                });
                assert_eq!(p, q);
            }
            // The edge from 64 to 80 on one side, and the same on the other.
            let [one, other] = [(a, 64), (b, WHOLE - 80)].map(|(side, from)| {
                let [p, q] = [from, from + 16].map(|x| on_side(side.side, x));
                let axis = u8::from(p[0] == q[0]);
                Edge { square: side.square, start: p.min(q), length: 16, axis }
            });
            let (named, is_turned) = lattice.named(other);
            assert_eq!((lattice.named(one), named), ((one, false), one));
            let x = if is_turned { 0.75 } else { 0.25 };
            let gap = surface.eval(lattice.along(one, x)).position
                - surface.eval(lattice.along(other, 0.25)).position;
            assert!(gap.length() < 1e-14);
        }
    }
}
