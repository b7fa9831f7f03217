//! The planar map: the cap of the flat, most symmetric net, in whose image energies are measured.

use faer::c64;

use super::energy::parametric;
use super::fan::{Fan, SECTOR};
use super::generate::admissible;
use super::{COEFFICIENTS, CapClass, solve};
use crate::math::Grid;

/// The planar map of sector 0 of a class: the coefficients `(x, y)` of its cap over the natural configuration, the subdominant
/// eigenvector of Catmull-Clark, with the vertex at the origin and its first neighbour at `(1, 0)`. The next sector is the same, turned by
/// the angle of a sector.
///
/// The 13 x 13 grid has `i` along the sector's first edge. Of the coefficients that the conditions leave open those are taken that
/// make the squares of the fourth derivatives by the parameters least (`docs/methods/g2_caps.md`, Energy). `None` for classes that
/// have no cap.
pub fn planar_map(class: CapClass) -> Option<Grid<[f64; 2]>> {
    let map = of_sectors(admissible(class)?.sector_angle())?;
    Some(Grid::from_fn(COEFFICIENTS, COEFFICIENTS, |i, j| map[COEFFICIENTS * i + j]))
}

/// The coefficients of the planar map of sectors of some angle, which need not divide a full turn.
pub(super) fn of_sectors(angle: f64) -> Option<Vec<[f64; 2]>> {
    let coefficients = solve::solve(&Fan::mode(angle, angle).system(), &parametric())?.coefficients;
    let ring = natural_ring(angle);
    let point = |row: usize| {
        let weight = |column| c64::new(coefficients[(row, column)], coefficients[(SECTOR + row, column)]);
        let sum = (0..ring.len()).fold(c64::new(0.0, 0.0), |sum, column| sum + weight(column) * ring[column]);
        [sum.re, sum.im]
    };
    Some((0..SECTOR).map(point).collect())
}

/// The natural configuration of sectors of some angle: the two-ring that one step of Catmull-Clark only shrinks, in the order
/// `E P10 P20 P11 P21 P12 P22` of sector 0.
fn natural_ring(angle: f64) -> [c64; 7] {
    let number = |re: f64| c64::new(re, 0.0);
    let turn = c64::new(angle.cos(), angle.sin());
    let (c, half) = (turn.re, (angle / 2.0).cos());
    let kappa = 1.0 + c + half * (2.0 * (9.0 + c)).sqrt();
    let lambda = (kappa + 4.0) / 16.0;
    let diagonal = c64::new(half, (angle / 2.0).sin()) * number(8.0 * half / kappa);
    // Of P20, which is real, and P21:
    //     64 lambda x = 36 + 6 x + 12 Re f + 2 Re y + 2 c,    16 lambda y = 6 (1 + f) + turn + x + y
    let (own_x, own_y) = (64.0 * lambda - 6.0, 16.0 * lambda - 1.0);
    let right_x = 36.0 + 12.0 * diagonal.re + 2.0 * c;
    let right_y = number(6.0) * (number(1.0) + diagonal) + turn;
    let x = (right_x * own_y + 2.0 * right_y.re) / (own_x * own_y - 2.0);
    let y = (right_y + number(x)) * number(1.0 / own_y);
    let beside = turn * y.conj();
    let far = number(36.0) * diagonal
        + number(6.0) * (number(1.0) + turn + y + beside)
        + number(x) * (number(1.0) + turn);
    [number(0.0), number(1.0), number(x), diagonal, y, beside, far * number(1.0 / (64.0 * lambda - 1.0))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;
    use crate::g2_caps::columns::Node;
    use crate::g2_caps::{generate, nets};

    #[test]
    fn the_plane_of_a_regular_vertex_is_its_grid() {
        let points = natural_ring(std::f64::consts::FRAC_PI_2);
        let wanted = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 1.0], [1.0, 2.0], [2.0, 2.0]];
        for (point, [x, y]) in points.into_iter().zip(wanted) {
            assert!((point.re - x).hypot(point.im - y) < 1e-14, "{point}");
        }
    }

    #[test]
    fn the_cap_of_the_natural_configuration_is_the_map() {
        for valence in [3, 5, 8] {
            let class = CapClass::Interior { valence };
            let angle = class.sector_angle();
            let ring = natural_ring(angle);
            let mut points = vec![Vec3::ZERO; class.columns()];
            for sector in 0..class.sectors() {
                let nodes = [Node::P10, Node::P20, Node::P11, Node::P21, Node::P12, Node::P22];
                for (node, point) in nodes.into_iter().zip(&ring[1..]) {
                    let turned =
                        point * c64::new((angle * sector as f64).cos(), (angle * sector as f64).sin());
                    points[class.column(node(sector))] = Vec3::new(turned.re, turned.im, 0.0);
                }
            }
            let net = &nets(&generate(class).expect("a class with caps"), &points)[0];
            let map = planar_map(class).expect("a class with caps");
            for (point, &[x, y]) in net.cells().iter().zip(map.cells()) {
                let distance = point.distance(Vec3::new(x, y, 0.0));
                assert!(distance < 1e-11, "{valence}: {distance:e}");
            }
        }
    }
}
