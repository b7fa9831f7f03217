//! Where in the first cage the faces of refined cages lie.

use super::chart::{Chart, Scalar};
use crate::mesh::FaceId;
use crate::nurbs::FaceAddress;

/// A square of parameters in a parametric face of the first cage, with a frame of its own: `(s, t)` in `[0, 1]`, which is
/// `origin + s along + t across`, where `across` is `along` after a quarter turn to the left. All numbers are dyadic, so that
/// going down and up loses nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// The parametric face. A polygon that is whole has no corner yet, and no parameters.
    pub(super) address: FaceAddress,
    origin: [f64; 2],
    along: [f64; 2],
}

/// A quarter turn to the left.
fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

impl Piece {
    /// A face of the first cage.
    pub(super) fn whole(face: FaceId) -> Piece {
        Piece { address: FaceAddress::whole(face), origin: [0.0; 2], along: [1.0, 0.0] }
    }

    /// What the face at the corner `corner` is after a refinement; `size` is the number of corners.
    pub(super) fn child(self, corner: u32, size: u32) -> Piece {
        if size != 4 {
            return Piece { address: self.address.quarter(corner), ..self };
        }
        let quarter = self.seen_from(corner);
        Piece { along: quarter.along.map(|x| x / 2.0), ..quarter }
    }

    /// The same square, with another corner for its `(0, 0)`, counted counter-clockwise.
    pub(super) fn seen_from(self, corner: u32) -> Piece {
        (0..corner).fold(self, |Piece { address, origin: [u, v], along: [x, y] }, _| Piece {
            address,
            origin: [u + x, v + y],
            along: turned([x, y]),
        })
    }

    /// `s` and `t` at a point of the parametric face; `None` outside the square.
    pub(super) fn chart(&self, u: f64, v: f64) -> Option<Chart> {
        let offset = [u - self.origin[0], v - self.origin[1]];
        let square = self.along[0] * self.along[0] + self.along[1] * self.along[1];
        let coordinate = |[x, y]: [f64; 2]| {
            let [du, dv] = [x / square, y / square];
            Scalar { value: du * offset[0] + dv * offset[1], du, dv, ..Scalar::default() }
        };
        let chart = Chart { x: coordinate(self.along), y: coordinate(turned(self.along)) };
        let is_inside = |scalar: &Scalar| (0.0..=1.0).contains(&scalar.value);
        (is_inside(&chart.x) && is_inside(&chart.y)).then_some(chart)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_origin_of_a_child_is_the_corner_that_it_came_from() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        for (corner, [u, v]) in (0..4).zip(corners) {
            let child = Piece::whole(FaceId(7)).child(corner, 4);
            let at = |u, v| child.chart(u, v).map(|chart| [chart.x.value, chart.y.value]);
            assert_eq!(at(u, v), Some([0.0, 0.0]));
            assert_eq!(at(0.5, 0.5), Some([1.0, 1.0]));
            assert_eq!(at(1.0 - u, 1.0 - v), None);
            // Of the corner of a child only the frame differs from those of the other three.
            assert_eq!(
                child.seen_from(2).chart(u, v).map(|chart| [chart.x.value, chart.y.value]),
                Some([1.0; 2])
            );
        }
    }
}
