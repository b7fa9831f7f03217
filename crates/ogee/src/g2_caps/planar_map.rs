//! The planar map: the cap of the flat, most symmetric net, in whose image energies are measured.

use faer::c64;

use super::energy::parametric;
use super::fan::{Fan, SECTOR};
use super::solve::solve;
use super::{COEFFICIENTS, CapClass, is_solvable};
use crate::math::Grid;

/// The planar map of a class: the coefficients `(x, y)` of its cap over the natural configuration, the subdominant eigenvector of
/// Catmull-Clark, with the vertex at the origin and its first neighbour at `(1, 0)`.
///
/// A 13 x 13 grid, `i` along the sector's first edge, for each sector; of an interior vertex for sector 0 only, since the next one is the
/// same, turned. Of the coefficients that the conditions leave open those are taken that make the squares of the fourth derivatives by the
/// parameters least (`docs/methods/g2_caps.md`, Energy). `None` for classes that have no cap.
pub fn planar_map(class: CapClass) -> Option<Vec<Grid<[f64; 2]>>> {
    if !is_solvable(class) {
        return None;
    }
    let grid =
        |map: Vec<[f64; 2]>| Grid::from_fn(COEFFICIENTS, COEFFICIENTS, |i, j| map[COEFFICIENTS * i + j]);
    Some(of_class(class)?.into_iter().map(grid).collect())
}

/// The coefficients of the planar map, row by row.
pub(super) fn of_class(class: CapClass) -> Option<Vec<Vec<[f64; 2]>>> {
    let angle = class.sector_angle();
    if class.is_closed() {
        let fan = Fan::mode(angle, angle);
        let weights = solve(&fan.system(), &[parametric()])?.coefficients;
        let weight = |row, column| c64::new(weights[(row, column)], weights[(SECTOR + row, column)]);
        Some(vec![image(&natural_configuration(&fan), weight)])
    } else {
        let fan = Fan::whole(class);
        let weights = solve(&fan.system(), &[parametric()])?.coefficients;
        let points = natural_configuration(&fan);
        let weight = |row, column| c64::new(weights[(row, column)], 0.0);
        Some(
            (0..fan.sectors)
                .map(|sector| image(&points, |row, column| weight(SECTOR * sector + row, column)))
                .collect(),
        )
    }
}

/// The coefficients of a sector from the points of the columns.
fn image(points: &[c64], weight: impl Fn(usize, usize) -> c64) -> Vec<[f64; 2]> {
    let sum = |row| points.iter().enumerate().map(|(column, point)| weight(row, column) * point).sum::<c64>();
    (0..SECTOR).map(sum).map(|point| [point.re, point.im]).collect()
}

/// The natural configuration, a point for each column of a fan.
fn natural_configuration<T>(fan: &Fan<T>) -> Vec<c64> {
    let [middle, on_edge @ .., p11, p21, p12, p22] = natural_ring(fan.angle);
    let turned = |places: usize, points: &[c64]| {
        let angles = (0..places).map(|place| fan.angle * place as f64);
        let turns = angles.map(|angle| c64::new(angle.cos(), angle.sin()));
        turns.flat_map(|turn| points.iter().map(move |point| point * turn)).collect::<Vec<_>>()
    };
    let mut points = vec![middle];
    points.extend(turned(fan.edges, &on_edge));
    points.extend(turned(fan.sectors, &[p11, p21, p12, p22]));
    points
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
    use crate::g2_caps::{CornerAngle, generate, nets};

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
        let classes = [
            CapClass::Interior { valence: 3 },
            CapClass::Interior { valence: 8 },
            CapClass::Boundary { faces: 3 },
            CapClass::Corner { faces: 2, angle: CornerAngle::Convex },
            CapClass::Dart { valence: 3 },
        ];
        for class in classes {
            let angle = class.sector_angle();
            let ring = natural_ring(angle);
            let mut points = vec![Vec3::ZERO; class.columns()];
            let mut put = |node: Node, place: usize, point: c64| {
                let turned = point * c64::new((angle * place as f64).cos(), (angle * place as f64).sin());
                points[class.column(node)] = Vec3::new(turned.re, turned.im, 0.0);
            };
            for edge in 0..class.edges() {
                put(Node::P10(edge), edge, ring[1]);
                put(Node::P20(edge), edge, ring[2]);
            }
            for sector in 0..class.sectors() {
                for (node, point) in [Node::P11, Node::P21, Node::P12, Node::P22].into_iter().zip(&ring[3..])
                {
                    put(node(sector), sector, *point);
                }
            }
            let nets = nets(&generate(class).expect("a class with caps"), &points);
            for (map, net) in planar_map(class).expect("a class with caps").iter().zip(&nets) {
                for (point, &[x, y]) in net.cells().iter().zip(map.cells()) {
                    let distance = point.distance(Vec3::new(x, y, 0.0));
                    assert!(distance < 1e-11, "{class:?}: {distance:e}");
                }
            }
        }
    }
}
