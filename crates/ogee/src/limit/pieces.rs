//! What a parametric face is made of, with points: for whoever evaluates the surface by other means than ours, such as a
//! graphics processor.

use super::LimitSurface;
use super::corner::at_corner;
use super::walk::{Walk, add, last_step, narrow, wide};
use crate::math::Vec3;
use crate::patch::{Piece, TURNED, Tail, from_corner};

/// Control points of one bicubic patch, `i + 4 j`, `i` along `u`: a uniform B-spline over the inner cell of a grid.
pub type PatchNet = [Vec3; 16];

/// What a parametric face, or a piece of it, is made of. Every piece has parameters of its own in `[0, 1]`, in the
/// directions of the face.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "most pieces are leaves")]
pub enum FacePiece {
    /// One bicubic patch.
    Leaf(PatchNet),
    /// Four pieces of half its size, from the corner at `(0, 0)` counter-clockwise.
    Split(Box<[FacePiece; 4]>),
    /// Patches around one irregular corner.
    Tail(TailPiece),
}

/// A piece with one irregular corner: a chain of steps, each three bicubic patches of half the size of the step before.
///
/// In the frame of the corner, where it is the origin, patches of step `n` (from 1) lie at `2^-n` times `(1, 0)`, `(1, 1)`
/// and `(0, 1)`, and are `2^-n` wide. Nearer to the corner than the last step the surface is, to all that can be seen, its
/// own limit shape: a step further down shrinks it about the limit by `eigenvalue`.
#[derive(Clone, Debug, PartialEq)]
pub struct TailPiece {
    /// Which corner of the piece is irregular.
    pub corner: u32,
    /// Where the surface is at the corner.
    pub limit: Vec3,
    /// Unit normal at the corner; zero where it is undefined.
    pub normal: Vec3,
    /// By how much a step shrinks the surface in the end.
    pub eigenvalue: f64,
    /// Patches of each step, in the directions of the piece and relative to the limit: absolute points would lose a digit
    /// for every digit that they move together.
    pub steps: Vec<[PatchNet; 3]>,
}

impl LimitSurface<'_> {
    /// What a parametric face is made of. Chains go on until they have shrunk to `least` of the piece, in space and in
    /// parameters, and for as many steps as evaluation takes at most.
    ///
    /// ```
    /// use ogee::{FacePiece, Level, LimitSurface, PatchTable, shapes};
    ///
    /// let mesh = shapes::torus(8, 6);
    /// let table = PatchTable::new(&Level::new(&mesh)?);
    /// let surface = LimitSurface::new(&table, &mesh.points);
    /// assert!(matches!(surface.face_piece(0, 1e-6), FacePiece::Leaf(_)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Panics
    /// If there is no such parametric face.
    pub fn face_piece(&self, face: usize, least: f64) -> FacePiece {
        let root = face as u32;
        if let Some(sources) = self.table().root_leaf(root) {
            return FacePiece::Leaf(self.net(sources));
        }
        self.piece(self.table().root_node(root).piece(), least)
    }

    fn piece(&self, piece: Piece, least: f64) -> FacePiece {
        match piece {
            Piece::Leaf(leaf) => FacePiece::Leaf(self.net(self.table().leaf(leaf))),
            Piece::Tail(number) => {
                let tail = self.table().tail(number);
                match self.table().basis(tail).has_quarters() {
                    true => self.meeting(number, tail, least),
                    false => FacePiece::Tail(self.tail(number, tail, least)),
                }
            }
            Piece::Split(split) => FacePiece::Split(Box::new(
                self.table().split(split).map(|node| self.piece(node.piece(), least)),
            )),
        }
    }

    fn net(&self, sources: &[u32; 16]) -> PatchNet {
        sources.map(|source| self.points()[source as usize])
    }

    fn tail(&self, number: u32, tail: Tail, least: f64) -> TailPiece {
        let (table, points) = (self.table(), self.points());
        let basis = table.basis(tail);
        let mut walk = Walk::default();
        let corner = at_corner(&mut walk, table, points, number, tail);
        let shrinks = basis.eigenvalue.max(0.5);
        let count = (least.ln() / shrinks.ln()).ceil() as i32;
        let count = count.clamp(1, last_step(basis));
        let turned = &TURNED[tail.corner as usize];
        let nets = |step| {
            walk.go(table, points, number, tail, step);
            // Both are large next to what is left of a ring: their difference first.
            let base = narrow(walk.base()) - corner.position;
            [0, 1, 2].map(|tile| {
                let net = walk.control_net(basis, tile);
                std::array::from_fn(|k| narrow(add(net[usize::from(turned[k])], wide(base))))
            })
        };
        TailPiece {
            corner: tail.corner,
            limit: corner.position,
            normal: corner.normal,
            eigenvalue: basis.eigenvalue,
            steps: (1..=count).map(nets).collect(),
        }
    }

    /// A face at a meeting of curves. A tile of its chain is four patches, so it is split again and again; what is left at the
    /// end is taken for a plane.
    fn meeting(&self, number: u32, tail: Tail, least: f64) -> FacePiece {
        let (table, points) = (self.table(), self.points());
        let basis = table.basis(tail);
        let mut walk = Walk::default();
        let corner = at_corner(&mut walk, table, points, number, tail);
        let count = ((least.ln() / 0.5_f64.ln()).ceil() as i32).clamp(1, last_step(basis));
        let turned = &TURNED[tail.corner as usize];
        let from_own = |quarter: usize| (quarter + 4 - tail.corner as usize) % 4;
        let shrunk = 0.5_f64.powi(count);
        let mut inner = FacePiece::Leaf(std::array::from_fn(|k| {
            let (i, j) = ((k % 4) as f64 - 1.0, (k / 4) as f64 - 1.0);
            let (u, v) = from_corner(tail.corner, 0.0, 0.0);
            corner.position + shrunk * ((i - u) * corner.du + (j - v) * corner.dv)
        }));
        for step in (1..=count).rev() {
            walk.go(table, points, number, tail, step);
            let base = walk.base();
            let leaf = |tile: usize| {
                let net = walk.control_net(basis, tile);
                FacePiece::Leaf(std::array::from_fn(|k| narrow(add(net[usize::from(turned[k])], base))))
            };
            let quarters = [0, 1, 2, 3].map(|quarter| match from_own(quarter) {
                0 => std::mem::replace(&mut inner, FacePiece::Leaf([Vec3::ZERO; 16])),
                tile => FacePiece::Split(Box::new(
                    [0, 1, 2, 3].map(|smaller| leaf(4 * (tile - 1) + from_own(smaller))),
                )),
            });
            inner = FacePiece::Split(Box::new(quarters));
        }
        inner
    }
}

#[cfg(test)]
mod tests {
    use super::super::bicubic::basis;
    use super::*;
    use crate::mesh::{Crease, Meeting, Sharpness, shapes};
    use crate::patch::{from_corner, to_corner};
    use crate::rules::Level;
    use crate::{Location, PatchTable, SurfacePoint};

    /// Position and derivatives, by sixteen products.
    fn sum(net: &PatchNet, u: f64, v: f64) -> [Vec3; 3] {
        let (bu, bv) = (basis(u), basis(v));
        [(0, 0), (1, 0), (0, 1)]
            .map(|(i, j)| (0..16).fold(Vec3::ZERO, |sum, k| sum + bu[i][k % 4] * bv[j][k / 4] * net[k]))
    }

    /// The patch at `(u, v)` of a piece, its offset, its parameters and the inverse of its width.
    fn find(piece: &FacePiece, u: f64, v: f64) -> (&PatchNet, Vec3, [f64; 2], f64) {
        match piece {
            FacePiece::Leaf(net) => (net, Vec3::ZERO, [u, v], 1.0),
            FacePiece::Split(children) => {
                let (right, above) = (u >= 0.5, v >= 0.5);
                let child = match (right, above) {
                    (false, false) => 0,
                    (true, false) => 1,
                    (true, true) => 2,
                    (false, true) => 3,
                };
                let half = |x: f64, upper: bool| 2.0 * x - f64::from(u8::from(upper));
                let (net, offset, at, scale) = find(&children[child], half(u, right), half(v, above));
                (net, offset, at, 2.0 * scale)
            }
            FacePiece::Tail(tail) => {
                let (mut x, mut y) = to_corner(tail.corner, u, v);
                let (mut step, mut scale) = (0, 1.0);
                while x.max(y) < 1.0 || step == 0 {
                    (x, y, step, scale) = (2.0 * x, 2.0 * y, step + 1, 2.0 * scale);
                }
                let (tile, dx, dy) = match (x >= 1.0, y >= 1.0) {
                    (true, false) => (0, 1.0, 0.0),
                    (true, true) => (1, 1.0, 1.0),
                    _ => (2, 0.0, 1.0),
                };
                let (u, v) = from_corner(tail.corner, x - dx, y - dy);
                (&tail.steps[step - 1][tile], tail.limit, [u, v], scale)
            }
        }
    }

    #[test]
    fn pieces_are_the_surface() {
        let mut creased = shapes::disk(7, 2);
        creased.creases.push(Crease { vertices: [0, 1], sharpness: Sharpness::Infinite });
        let mut faded = shapes::cube();
        faded.creases.push(Crease { vertices: [0, 1], sharpness: Sharpness::Finite(1.5) });
        let mut met = shapes::disk(6, 2);
        let ports = met.faces.iter().step_by(8).map(|face| face[1]).collect();
        met.meetings.push(Meeting { vertex: 0, ports, t: 0.3 });
        let mut kinds = [0; 3];
        for mesh in [shapes::studded_torus(12, 8, 4), faded, creased, met] {
            let table = PatchTable::new(&Level::new(&mesh).unwrap());
            let surface = LimitSurface::new(&table, &mesh.points);
            for face in 0..table.len() {
                let piece = surface.face_piece(face, 1e-6);
                let kind = match &piece {
                    FacePiece::Leaf(_) => 0,
                    FacePiece::Split(_) => 1,
                    FacePiece::Tail(tail) => {
                        let r = tail.corner;
                        let (u, v) = from_corner(r, 0.0, 0.0);
                        let at = Location { root: face as u32, u, v };
                        let SurfacePoint { position, normal, .. } = surface.eval(at);
                        assert_eq!((position, normal), (tail.limit, tail.normal));
                        assert!(tail.eigenvalue.max(0.5).powi(tail.steps.len() as i32) <= 1e-6);
                        2
                    }
                };
                kinds[kind] += 1;
                for [u, v] in [[0.3, 0.9], [0.01, 0.002], [0.998, 0.003], [0.51, 0.49], [0.9999, 0.9999]] {
                    let at = Location { root: face as u32, u, v };
                    let wanted = surface.eval(at);
                    let (net, offset, [s, t], scale) = find(&piece, u, v);
                    let [position, du, dv] = sum(net, s, t);
                    assert!((offset + position).distance(wanted.position) < 1e-14);
                    assert!((scale * du).distance(wanted.du) < 1e-11 * wanted.du.length());
                    assert!((scale * dv).distance(wanted.dv) < 1e-11 * wanted.dv.length());
                }
            }
        }
        assert!(kinds.iter().all(|&count| count > 0), "{kinds:?}");
    }
}
