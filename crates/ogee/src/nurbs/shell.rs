//! `Shell`: NURBS faces that share edges and vertices.

use super::{NurbsCurve, NurbsSurface};
use crate::math::{Grid, Vec3};
use crate::mesh::FaceId;

/// Faces sewn along shared edges; connected.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shell {
    /// Positions of the vertices.
    pub vertices: Vec<Vec3>,
    /// Edges, each stored once however many faces use it.
    pub edges: Vec<ShellEdge>,
    /// Faces.
    pub faces: Vec<ShellFace>,
}

/// An edge of a shell.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellEdge {
    /// Vertex where the curve begins.
    pub start: u32,
    /// Vertex where the curve ends.
    pub end: u32,
    /// The curve; its first and last coefficients are the positions of the vertices, bit for bit.
    pub curve: NurbsCurve,
    /// True if the faces on both sides share tangent planes along it by construction. False on creases, along
    /// edges that end in a cone point, and on the boundary.
    pub smooth: bool,
}

/// One face of a shell: an untrimmed surface whose natural boundary is its loop of edges.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellFace {
    /// The surface; `du x dv` points out of the solid.
    pub surface: NurbsSurface,
    /// The edges around it, counter-clockwise, beginning at `(0, 0)` along `v = 0`. More than four where a
    /// neighbour's corner (a T) stands on a side.
    pub boundary: Vec<EdgeUse>,
    /// The pieces of the cage that it covers: `quads[(i, j)]`, `i` along `u`. One cell unless it is packed.
    pub quads: Grid<FaceAddress>,
}

/// A use of an edge by a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeUse {
    /// Index into [`Shell::edges`].
    pub edge: u32,
    /// True if the loop runs along the edge's own direction.
    pub forward: bool,
    /// The side of the surface's parameter rectangle that the edge lies on.
    pub side: Side,
    /// The surface's parameter along that side where the loop enters and leaves the edge: increasing on the
    /// sides `V0` and `U1`, decreasing on `V1` and `U0`.
    pub range: [f64; 2],
}

/// A side of the parameter rectangle, in the order of the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// `v` at its least; the loop runs along growing `u`.
    V0,
    /// `u` at its greatest; the loop runs along growing `v`.
    U1,
    /// `v` at its greatest; the loop runs along falling `u`.
    V1,
    /// `u` at its least; the loop runs along falling `v`.
    U0,
}

/// Which piece of the cage: a whole quad, the quarter at a corner of any face, or a quarter of a quarter.
///
/// Every quarter is numbered by the corner it lies at, which is its own corner 0: `(0, 0)` of its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FaceAddress {
    /// The face of the cage.
    pub face: FaceId,
    /// The corner of that face, `None` if the piece is the whole face.
    pub corner: Option<u32>,
    /// Quarters of the quarter at that corner.
    pub quarters: Quarters,
}

impl FaceAddress {
    /// A whole face.
    pub fn whole(face: FaceId) -> FaceAddress {
        FaceAddress { face, corner: None, quarters: Quarters::default() }
    }

    /// The quarter at a corner of this piece.
    pub fn quarter(self, corner: u32) -> FaceAddress {
        match self.corner {
            None => FaceAddress { corner: Some(corner), ..self },
            Some(_) => FaceAddress { quarters: self.quarters.then(corner), ..self },
        }
    }
}

impl std::fmt::Display for FaceAddress {
    /// `f12`, `f12.3` for a corner, `f12.3.0` for a quarter of that: the name of a face in STEP.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "f{}", self.face)?;
        self.corner.into_iter().chain(self.quarters.iter()).try_for_each(|corner| write!(f, ".{corner}"))
    }
}

/// A way into a quad: a quarter, a quarter of that, and so on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quarters {
    depth: u32,
    /// Two bits a step, the first step highest.
    path: u64,
}

impl Quarters {
    /// The most steps that fit.
    pub const DEEPEST: u32 = 32;

    /// One step more; beyond [`Quarters::DEEPEST`] the first ones are forgotten.
    pub fn then(self, corner: u32) -> Quarters {
        let depth = (self.depth + 1).min(Quarters::DEEPEST);
        Quarters { depth, path: self.path << 2 | u64::from(corner & 3) }
    }

    /// How many steps.
    pub fn depth(self) -> u32 {
        self.depth
    }

    /// The corners of all steps.
    pub fn iter(self) -> impl Iterator<Item = u32> {
        (0..self.depth).rev().map(move |step| (self.path >> (2 * step) & 3) as u32)
    }

    /// Parameters of the quad that a place in the innermost quarter has.
    ///
    /// Quarter `k` has its `(0, 0)` at corner `k` of what it is a quarter of, and its `u` along the side that leaves that corner.
    pub fn outwards(self, place: [f64; 2]) -> [f64; 2] {
        (0..self.depth).fold(place, |[u, v], step| {
            let [u, v] = [u / 2.0, v / 2.0];
            match self.path >> (2 * step) & 3 {
                0 => [u, v],
                1 => [1.0 - v, u],
                2 => [1.0 - u, 1.0 - v],
                _ => [v, 1.0 - u],
            }
        })
    }
}

impl FromIterator<u32> for Quarters {
    fn from_iter<I: IntoIterator<Item = u32>>(corners: I) -> Quarters {
        corners.into_iter().fold(Quarters::default(), Quarters::then)
    }
}

impl ShellFace {
    /// The piece of the cage at the surface's own `(0, 0)`.
    pub fn address(&self) -> FaceAddress {
        self.quads[(0, 0)]
    }
}

impl Shell {
    /// True if every edge is used exactly twice, in opposite directions.
    pub fn is_closed(&self) -> bool {
        let mut uses = vec![[0u32; 2]; self.edges.len()];
        for face in &self.faces {
            for used in &face.boundary {
                uses[used.edge as usize][usize::from(used.forward)] += 1;
            }
        }
        !self.faces.is_empty() && uses.iter().all(|&count| count == [1, 1])
    }

    /// The same shell with every face turned round.
    pub fn reversed(&self) -> Shell {
        let mut reversed = self.clone();
        reversed.reverse();
        reversed
    }

    /// Turns every face round.
    pub(crate) fn reverse(&mut self) {
        for face in &mut self.faces {
            face.boundary.reverse();
            for used in &mut face.boundary {
                used.forward = !used.forward;
                // With `u` and `v` exchanged.
                used.side = match used.side {
                    Side::V0 => Side::U0,
                    Side::U0 => Side::V0,
                    Side::U1 => Side::V1,
                    Side::V1 => Side::U1,
                };
                used.range.reverse();
            }
            face.surface = face.surface.transposed();
            face.quads = face.quads.transposed();
        }
    }

    /// Moves every point of the shell.
    pub(crate) fn translate(&mut self, by: Vec3) {
        for vertex in &mut self.vertices {
            *vertex += by;
        }
        for edge in &mut self.edges {
            for point in &mut edge.curve.points {
                *point += by;
            }
        }
        for face in &mut self.faces {
            for point in face.surface.net.cells_mut() {
                *point += by;
            }
        }
    }
}
