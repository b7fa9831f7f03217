//! A rectangular block.

use ogee::Vec3;

use super::builder::{Builder, SHARP};
use super::{Form, Model};

/// Quads along each axis, and the side of each.
const CELLS: [usize; 3] = [6, 4, 3];
const SIDE: f64 = 10.0;

pub(super) fn model() -> Model {
    let [nx, ny, nz] = CELLS;
    let mut b = Builder::default();
    let corner = |x: usize, y: usize, z: usize| Vec3::new(x as f64, y as f64, z as f64) * SIDE;
    let rings: Vec<Vec<u32>> = (0..=nz)
        .map(|z| {
            let south = (0..nx).map(|x| corner(x, 0, z));
            let east = (0..ny).map(|y| corner(nx, y, z));
            let north = (0..nx).map(|x| corner(nx - x, ny, z));
            let west = (0..ny).map(|y| corner(0, ny - y, z));
            b.points(south.chain(east).chain(north).chain(west))
        })
        .collect();
    b.loft(&rings);
    b.cap_grid(&rings[nz], nx);
    let mut bottom: Vec<u32> = rings[0].iter().rev().copied().collect();
    bottom.rotate_right(1);
    b.cap_grid(&bottom, ny);
    b.crease_ring(&rings[0], SHARP);
    b.crease_ring(&rings[nz], SHARP);
    for k in [0, nx, nx + ny, 2 * nx + ny] {
        let upright: Vec<u32> = rings.iter().map(|ring| ring[k]).collect();
        b.crease_path(&upright, SHARP);
        b.corner(upright[0], SHARP);
        b.corner(upright[nz], SHARP);
    }
    Model {
        name: "box",
        about: &[
            "A block, 60 x 40 x 30: six grids of quads between twelve creased edges.",
            "Exercises creases that meet in tagged corners, and packing: the surface is the block itself, six faces.",
        ],
        form: Form::Closed { pieces: 1, genus: 0 },
        mesh: b.finish(),
    }
}
