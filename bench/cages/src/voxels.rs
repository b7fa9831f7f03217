//! Cubes of a lattice, full or empty, and the surface between them, made a manifold.

use ogee::{FaceList, Vec3};

/// A block of cubes of side 1; outside of it all is empty.
pub(crate) struct Voxels {
    size: [usize; 3],
    full: Vec<bool>,
}

/// The two coordinates beside each axis, so that all three turn to the right.
const BESIDE: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Quads between full and empty cubes, and where on the lattice their corners are.
pub(crate) struct Skin {
    pub(crate) faces: FaceList,
    pub(crate) lattice: Vec<[usize; 3]>,
}

impl Voxels {
    /// A block whose cubes are full where their middles say so.
    pub(crate) fn new(size: [usize; 3], is_full: impl Fn(Vec3) -> bool) -> Voxels {
        let middle = |at: usize| at as f64 + 0.5;
        let count = size.iter().product();
        let mut voxels = Voxels { size, full: vec![false; count] };
        for k in 0..count {
            let [x, y, z] = voxels.place(k);
            voxels.full[k] = is_full(Vec3::new(middle(x), middle(y), middle(z)));
        }
        voxels
    }

    fn place(&self, index: usize) -> [usize; 3] {
        let [width, depth, _] = self.size;
        [index % width, index / width % depth, index / (width * depth)]
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// The cube next to one along an axis, if it is in the block.
    fn beside(&self, place: [usize; 3], axis: usize, step: isize) -> Option<[usize; 3]> {
        let mut other = place;
        other[axis] = other[axis].checked_add_signed(step).filter(|&at| at < self.size[axis])?;
        Some(other)
    }

    /// Fills cubes until the surface is a manifold: until no two cubes of a kind meet in an edge alone, or in a
    /// corner alone (Latecki, Eckhardt, Rosenfeld, *Well-composed sets*, 1995). Cubes are filled and never emptied,
    /// so this ends.
    pub(crate) fn repair(&mut self) {
        while self.fill_edges() | self.fill_corners() {}
    }

    /// One pass over the squares of four cubes around an edge; true if it filled one.
    fn fill_edges(&mut self) -> bool {
        let mut filled = false;
        for k in 0..self.full.len() {
            let place = self.place(k);
            for [u, v] in BESIDE {
                let Some(right) = self.beside(place, u, 1) else { continue };
                let Some(above) = self.beside(place, v, 1) else { continue };
                let Some(across) = self.beside(right, v, 1) else { continue };
                let [right, above, across] = [right, above, across].map(|place| self.index(place));
                let [a, b, c, d] = [k, right, above, across].map(|index| self.full[index]);
                if a == d && b == c && a != b {
                    self.full[if a { right } else { k }] = true;
                    filled = true;
                }
            }
        }
        filled
    }

    /// One pass over the cubes of eight around a corner; true if it filled one.
    fn fill_corners(&mut self) -> bool {
        let mut filled = false;
        for k in 0..self.full.len() {
            let first = self.place(k);
            if (0..3).any(|axis| first[axis] + 1 == self.size[axis]) {
                continue;
            }
            let around: [usize; 8] =
                std::array::from_fn(|c| self.index([0, 1, 2].map(|axis| first[axis] + (c >> axis & 1))));
            let count = around.iter().filter(|&&index| self.full[index]).count();
            for c in 0..4 {
                // Opposite corners differ in all three coordinates.
                let pair = [around[c], around[7 - c]].map(|index| self.full[index]);
                match (count, pair) {
                    (2, [true, true]) => self.full[around[c ^ 1]] = true,
                    (6, [false, false]) => self.full[around[c]] = true,
                    _ => continue,
                }
                filled = true;
                break;
            }
        }
        filled
    }

    /// The quads between full and empty cubes, turned outward, those on planes that `is_open` names (axis and
    /// coordinate) left out. Corners are numbered as the quads meet them.
    pub(crate) fn skin(&self, is_open: impl Fn(usize, usize) -> bool) -> Skin {
        let corners = self.size.map(|side| side + 1);
        let mut numbers = vec![u32::MAX; corners.iter().product()];
        let mut skin = Skin { faces: FaceList::new(), lattice: Vec::new() };
        for k in (0..self.full.len()).filter(|&k| self.full[k]) {
            let place = self.place(k);
            for axis in 0..3 {
                for step in [-1, 1] {
                    let is_covered =
                        self.beside(place, axis, step).is_some_and(|other| self.full[self.index(other)]);
                    let plane = place[axis] + usize::from(step == 1);
                    if is_covered || is_open(axis, plane) {
                        continue;
                    }
                    let quad = square(place, axis, step).map(|at| {
                        let number = &mut numbers[at[0] + corners[0] * (at[1] + corners[1] * at[2])];
                        if *number == u32::MAX {
                            *number = skin.lattice.len() as u32;
                            skin.lattice.push(at);
                        }
                        *number
                    });
                    skin.faces.push(&quad);
                }
            }
        }
        skin
    }

    /// How many cubes there are along each axis.
    pub(crate) fn size(&self) -> [usize; 3] {
        self.size
    }
}

/// The corners of a cube's side, counter-clockwise seen from outside.
fn square(cube: [usize; 3], axis: usize, step: isize) -> [[usize; 3]; 4] {
    let [u, v] = BESIDE[axis];
    let mut corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[along, up]| {
        let mut corner = cube;
        corner[axis] += usize::from(step == 1);
        corner[u] += along;
        corner[v] += up;
        corner
    });
    if step == -1 {
        corners.reverse();
    }
    corners
}
