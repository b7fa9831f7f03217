//! A polar cap as faces: one per patch, or two halves of the disk.
//!
//! Nothing is lost in halves: pieces that meet C2 are one B-spline whose inner knots stand two times less than the degree says.

use super::cap::{Cap, CapEdge, CapFace, CapVertex};
use super::polar::PolarCap;
use super::polar_error::{PolarDefect, PolarError};
use super::polar_sector::raised;
use crate::math::{Grid, Vec3};
use crate::mesh::VertexId;
use crate::nurbs::{FaceAddress, KnotVector, NurbsSurface, Side};
use std::ops::Range;

/// How many faces a polar cap becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PolarFaces {
    /// Every patch is a face: per sector a central one and a transition, or a single one.
    PerSector,
    /// Two faces, cut along two meridians that are as nearly opposite as can be.
    #[default]
    Halves,
}

impl PolarCap {
    /// The cap as faces, joined to the cage along the circle 2.
    ///
    /// `circle` are the cage's vertices on that circle, `circle[i]` at the start of sector `i`. `replaced[(k, i)]` is the face of
    /// the cage in sector `i` inside the circle 1 (`k = 0`) and between the circles 1 and 2 (`k = 1`).
    ///
    /// Of every surface `u` is the radius, 0 at the pole and 2 at the circle 2, and `v` goes counter-clockwise, a unit a sector.
    /// The side `U0` of faces at the pole is a single point, all of whose net points are the same bits. The first of
    /// [`Cap::points`] is the pole; with [`PolarFaces::PerSector`] those of the circle of radius 1 follow. Rows of neighbours of
    /// one degree are the same bits.
    ///
    /// # Errors
    /// If there are not as many vertices and columns as sectors, or not two rows.
    pub fn faces(
        &self,
        circle: &[VertexId],
        replaced: &Grid<FaceAddress>,
        faces: PolarFaces,
    ) -> Result<Cap, PolarError> {
        let sectors = self.sectors();
        let (vertices, rows, columns) = (circle.len(), replaced.rows(), replaced.cols());
        if vertices != sectors || rows != 2 || columns != sectors {
            return Err(PolarDefect::Names { sectors, vertices, rows, columns }.into());
        }
        let outline = Outline { circle, replaced };
        let pole = self.pole().position;
        Ok(match faces {
            PolarFaces::Halves => {
                let middle = sectors.div_ceil(2);
                let half = |range: Range<usize>| {
                    let surface = placed(self.joined(range.clone()), pole);
                    outline.face(surface, range, Band::Whole)
                };
                Cap { faces: vec![half(0..middle), half(middle..sectors)], points: vec![pole] }
            }
            PolarFaces::PerSector => {
                let mut cap = Cap { faces: Vec::new(), points: vec![pole] };
                for sector in 0..sectors {
                    let patches = self.patches(sector);
                    let bands: &[Band] =
                        if patches.len() == 1 { &[Band::Whole] } else { &[Band::Central, Band::Transition] };
                    for (patch, &band) in patches.iter().zip(bands) {
                        let surface = placed(patch.clone(), pole);
                        if band == Band::Transition {
                            cap.points.push(surface.net[(0, 0)]);
                        }
                        cap.faces.push(outline.face(surface, sector..sector + 1, band));
                    }
                }
                cap
            }
        })
    }

    /// Sectors next to each other as one surface relative to the pole, over `[0, 2] x [0, count]`.
    fn joined(&self, sectors: Range<usize>) -> NurbsSurface {
        let count = sectors.len();
        let first = self.patches(sectors.start);
        let degree = first[0].v.degree();
        // columns[sector][k]: Bezier points around, of one degree, of which each is a B-spline outwards.
        let columns = sectors.map(|sector| {
            let patches: Vec<Vec<Vec<Vec3>>> =
                self.patches(sector).iter().map(|patch| columns(patch, degree)).collect();
            let column = |k: usize| joined_c2(&patches.iter().map(|patch| &patch[k][..]).collect::<Vec<_>>());
            (0..=degree).map(column).collect::<Vec<_>>()
        });
        let columns: Vec<Vec<Vec<Vec3>>> = columns.collect();
        let rows: Vec<Vec<Vec3>> = (0..columns[0][0].len())
            .map(|i| {
                let pieces: Vec<Vec<Vec3>> =
                    columns.iter().map(|sector| sector.iter().map(|column| column[i]).collect()).collect();
                joined_c2(&pieces.iter().map(Vec::as_slice).collect::<Vec<_>>())
            })
            .collect();
        let mut radii = vec![first[0].u.domain()[0]];
        radii.extend(first.iter().map(|patch| patch.u.domain()[1]));
        NurbsSurface {
            u: knots_c2(first[0].u.degree(), &radii),
            v: knots_c2(degree, &(0..=count).map(|k| k as f64).collect::<Vec<_>>()),
            net: Grid::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]),
        }
    }
}

/// Which part of a sector a face covers, outwards.
#[derive(Clone, Copy, PartialEq)]
enum Band {
    Central,
    Transition,
    Whole,
}

/// What a cap's outline is called in the cage.
struct Outline<'a> {
    circle: &'a [VertexId],
    replaced: &'a Grid<FaceAddress>,
}

impl Outline<'_> {
    /// The face of a surface over some sectors, with what is around it.
    fn face(&self, surface: NurbsSurface, sectors: Range<usize>, band: Band) -> CapFace {
        let count = self.circle.len();
        let outer = |meridian: usize| CapVertex::Cage(self.circle[meridian % count]);
        // After the pole come the points of radius 1.
        let middle = |meridian: usize| CapVertex::Own(1 + (meridian % count) as u32);
        let pole = |_: usize| CapVertex::Own(0);
        let ends: [&dyn Fn(usize) -> CapVertex; 2] = match band {
            Band::Central => [&pole, &middle],
            Band::Transition => [&middle, &outer],
            Band::Whole => [&pole, &outer],
        };
        let ([inner, outside], [from, to]) = (surface.u.domain(), surface.v.domain());
        let (start, end) = (sectors.start, sectors.end);
        let edge = |side, from, to, range| CapEdge { side, from, to, range };
        let mut boundary = vec![edge(Side::V0, ends[0](start), ends[1](start), [inner, outside])];
        for (k, meridian) in sectors.clone().enumerate() {
            let range = [from + k as f64, from + (k + 1) as f64];
            boundary.push(edge(Side::U1, ends[1](meridian), ends[1](meridian + 1), range));
        }
        boundary.push(edge(Side::V1, ends[1](end), ends[0](end), [outside, inner]));
        if band == Band::Transition {
            boundary.push(edge(Side::U0, ends[0](end), ends[0](start), [to, from]));
        }
        let rows = match band {
            Band::Central => 0..1,
            Band::Transition => 1..2,
            Band::Whole => 0..2,
        };
        let pieces =
            Grid::from_fn(rows.len(), sectors.len(), |k, i| self.replaced[(rows.start + k, start + i)]);
        CapFace { surface, boundary, pieces }
    }
}

/// The surface where it belongs.
fn placed(mut surface: NurbsSurface, pole: Vec3) -> NurbsSurface {
    surface.net.cells_mut().iter_mut().for_each(|point| *point += pole);
    surface
}

/// The columns of a Bezier patch, raised to a degree around: `[k][i]`, `k` around and `i` outwards.
fn columns(patch: &NurbsSurface, degree: usize) -> Vec<Vec<Vec3>> {
    let net = &patch.net;
    let rows: Vec<Vec<Vec3>> = (0..net.rows()).map(|i| raised(net.row(i), degree)).collect();
    (0..=degree).map(|k| rows.iter().map(|row| row[k]).collect()).collect()
}

/// The B-spline coefficients of Bezier pieces of one degree, over intervals of one length, that meet C2: those of
/// [`knots_c2`]. Both ends keep their bits.
fn joined_c2(pieces: &[&[Vec3]]) -> Vec<Vec3> {
    let degree = pieces[0].len() - 1;
    let mut out = pieces[0][..2].to_vec();
    for (k, piece) in pieces.iter().enumerate() {
        out.extend_from_slice(&piece[2..=degree - 2]);
        if let Some(next) = pieces.get(k + 1) {
            // The polar form at (last knot, this one .., next knot), from both sides: they differ by rounding.
            let (before, after) = (2.0 * piece[degree - 1] - piece[degree - 2], 2.0 * next[1] - next[2]);
            out.push(before.lerp(after, 0.5));
        } else {
            out.extend_from_slice(&piece[degree - 1..]);
        }
    }
    out
}

/// Clamped, with inner knots that leave C2.
fn knots_c2(degree: usize, knots: &[f64]) -> KnotVector {
    let last = knots.len() - 1;
    let times = |k: usize| if k == 0 || k == last { degree + 1 } else { degree - 2 };
    KnotVector::from_multiplicities(degree, knots.iter().enumerate().map(|(k, &knot)| (knot, times(k))))
}
