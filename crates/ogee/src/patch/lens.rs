//! Masks at a lens, an interior vertex of valence 2, and where one infinitely sharp edge ends at one.
//!
//! The rule is that of Karciauskas and Peters (`lens/rule.rs`), so masks depend on its shape. The five points around a
//! lens make themselves anew in every step; their left eigenvectors are the masks (`docs/methods/lens.md`, The rule;
//! with a crease `docs/methods/exact_evaluation.md`, At a lens).

use super::masks::Frame;
use crate::math::Vec3;
use crate::mesh::LensShape;

/// Weights on the vertex, then the two neighbours and the two opposite corners by turns, counter-clockwise.
pub(crate) type LensMask = [f64; 5];

/// What is known about the limit at a lens.
#[derive(Clone, Debug)]
pub(crate) struct Lens {
    pub(crate) position: LensMask,
    /// Along the first neighbour, and a quarter turn from it on the surface: towards the first corner. `None` where
    /// another mode shrinks as slowly as these two.
    pub(crate) tangents: Option<[LensMask; 2]>,
    /// The larger of the eigenvalues of the two tangents: 1/4 across a crease and where there is none.
    pub(crate) eigenvalue: f64,
}

/// The tangent across: the same with a crease along the neighbours and without one.
const ACROSS: LensMask = [0.0, 0.0, 1.0 / 4.0, 0.0, -1.0 / 4.0];

impl Lens {
    /// Without a sharp edge, or with one: `crease` is the number of its neighbour, 0 or 1.
    pub(crate) fn new(shape: LensShape, crease: Option<u32>) -> Lens {
        match crease {
            None => Lens::smooth(shape),
            Some(crease) => Lens::dart(shape).seen_from(crease),
        }
    }

    /// The paper's equation (2), and the dual of its characteristic map.
    fn smooth(LensShape { beta, gamma }: LensShape) -> Lens {
        let whole = 14.0 * beta + 16.0 * gamma + 5.0;
        let [edges, corners] = [12.0 * beta + 8.0 * gamma, 2.0 * beta + 8.0 * gamma].map(|sum| sum / whole);
        let [edge, corner] = [edges / 2.0, corners / 2.0];
        Lens {
            position: [1.0 - edges - corners, edge, corner, edge, corner],
            tangents: Some([[0.0, 1.0 / 2.0, 0.0, -1.0 / 2.0, 0.0], ACROSS]),
            eigenvalue: 1.0 / 4.0,
        }
    }

    /// With the first neighbour on the crease. A step is the same in a mirror along the crease; what is odd shrinks by 1/4,
    /// what is even and not constant by the roots of a cubic, one of which lies between 1/4 and 1/2.
    fn dart(shape: LensShape) -> Lens {
        let mut position = even(shape, 1.0);
        let sum: f64 = position.iter().sum();
        position.iter_mut().for_each(|weight| *weight /= sum);
        let eigenvalue = largest_root(shape);
        let tangents = others_are_smaller(shape, eigenvalue).then(|| [even(shape, eigenvalue), ACROSS]);
        Lens { position, tangents, eigenvalue }
    }

    /// Turned half round if the crease runs to the second neighbour.
    fn seen_from(mut self, crease: u32) -> Lens {
        if crease == 1 {
            self.position[1..].rotate_left(2);
            for mask in self.tangents.iter_mut().flatten() {
                mask[1..].rotate_left(2);
                mask.iter_mut().for_each(|weight| *weight = -*weight);
            }
        }
        self
    }

    /// Position and tangents; neighbours and corners counter-clockwise. Where there is no tangent plane, tangents are zero.
    pub(crate) fn frame(&self, vertex: Vec3, edges: &[Vec3], corners: &[Vec3]) -> Frame {
        let sum = |mask: &LensMask| {
            let around = mask[1..].chunks_exact(2).zip(edges.iter().zip(corners));
            let own = mask[0] * vertex;
            around.fold(own, |sum, (pair, (&edge, &corner))| sum + pair[0] * edge + pair[1] * corner)
        };
        let tangents =
            self.tangents.as_ref().map_or([Vec3::ZERO; 2], |tangents| tangents.each_ref().map(sum));
        Frame { position: sum(&self.position), tangents }
    }
}

/// The cubic `x^3 + a x^2 + b x + c` of the even modes at a dart: `[a, b, c]`.
fn cubic(LensShape { beta, gamma }: LensShape) -> [f64; 3] {
    [beta + gamma - 9.0 / 8.0, 3.0 / 8.0 - 9.0 / 16.0 * beta - 3.0 / 8.0 * gamma, beta / 16.0 - 1.0 / 32.0]
}

/// Its root between 1/4 and 1/2, at which it is `(1 - 2 beta - 4 gamma) / 128` and `(beta + 2 gamma) / 32`.
fn largest_root(shape: LensShape) -> f64 {
    let [a, b, c] = cubic(shape);
    let [mut low, mut high] = [1.0 / 4.0, 1.0 / 2.0];
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            return middle;
        }
        if ((middle + a) * middle + b) * middle + c > 0.0 { high = middle } else { low = middle }
    }
}

/// True if the other two roots are below 1/4 in modulus: Jury's conditions on the quotient, `x` in quarters.
fn others_are_smaller(shape: LensShape, root: f64) -> bool {
    let [a, b, _] = cubic(shape);
    let linear = 4.0 * (a + root);
    let constant = 16.0 * (b + root * (a + root));
    constant.abs() < 1.0 && 1.0 + linear + constant > 0.0 && 1.0 - linear + constant > 0.0
}

/// The left eigenvector to an eigenvalue of the even modes, 1 on the vertex.
fn even(LensShape { beta, gamma }: LensShape, value: f64) -> LensMask {
    let determinant = (value - 1.0 / 2.0) * (value - 1.0 / 8.0);
    let far = (beta / 2.0 * (value - 1.0 / 4.0) + gamma / 4.0) / determinant;
    let corners = ((value - 3.0 / 8.0) * gamma + beta / 16.0) / determinant;
    let near = (beta / 2.0 + far / 8.0 + corners / 4.0) / (value - 1.0 / 2.0);
    let corner = corners / 2.0;
    [1.0, near, corner, far, corner]
}

#[cfg(test)]
mod tests {
    use super::super::chain::ChainBasis;
    use super::super::kind::Kind;
    use super::*;

    const SHAPES: [[f64; 2]; 8] = [
        [0.5, 0.125],
        [0.5, 0.1875],
        [0.5, 0.25],
        [0.3, 0.2],
        [0.7, 0.15],
        [0.4, 0.06],
        [0.05, 0.9],
        [0.8, 0.04],
    ];

    /// The largest difference of a mask times the step and `value` times the mask.
    fn failure(mask: &[f64], rows: &[Vec<(usize, f64)>], value: f64) -> f64 {
        let mut gaps: Vec<f64> = mask.iter().map(|weight| -value * weight).collect();
        for (&weight, row) in mask.iter().zip(rows) {
            row.iter().for_each(|&(source, share)| gaps[source] += weight * share);
        }
        gaps.iter().fold(0.0, |most, gap| gap.abs().max(most))
    }

    #[test]
    fn masks_are_left_eigenvectors() {
        for [beta, gamma] in SHAPES {
            let shape = LensShape { beta, gamma };
            for crease in [None, Some(0), Some(1)] {
                let basis = ChainBasis::new(Kind::lens(shape, crease));
                let mut rows = basis.all_rows();
                rows.truncate(basis.kind.inner_count());
                let lens = Lens::new(shape, crease);
                assert!(failure(&lens.position, &rows, 1.0) < 1e-15, "{shape:?}, {crease:?}");
                assert!((lens.position.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                let Some([along, across]) = lens.tangents else {
                    assert!(crease.is_some() && (beta == 0.05 || beta == 0.8), "{shape:?}");
                    continue;
                };
                assert!(failure(&along, &rows, lens.eigenvalue) < 1e-14, "{shape:?}, {crease:?}");
                assert!(failure(&across, &rows, 0.25) < 1e-15);
                // Both lead where their names say.
                assert!(along[1] > 0.0 && along[3] < 0.0 && across[2] > 0.0, "{along:?} {across:?}");
            }
        }
    }

    #[test]
    fn the_usual_dart_has_small_numbers() {
        let Lens { position, tangents, eigenvalue } = Lens::new(LensShape::default(), Some(0));
        let close = |a: LensMask, b: LensMask| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
        assert!(close(position.map(|weight| 20.0 * weight), [8.0, 6.0, 1.0, 4.0, 1.0]));
        assert!(close(tangents.unwrap()[0].map(|weight| 2.0 * weight), [2.0, 4.0, -1.0, -4.0, -1.0]));
        assert!((eigenvalue - 3.0 / 8.0).abs() < 1e-15);
    }
}
