//! `PatchTable`: what every parametric face is made of.

use std::ops::Range;
use std::sync::OnceLock;

use super::chain::ChainBasis;
use super::tree::{Node, Piece, Tail};
use super::users::Users;
use super::{Location, LocationError, ParametricFace, build};
use crate::math::{Vec3, par, simd};
use crate::mesh::{FaceId, Topology, VertexId};
use crate::rules::Level;
use crate::stencil::StencilTable;

/// What every parametric face is made of: bicubic leaves, chains around irregular corners, and splits into four.
///
/// No points are inside: one table serves every pose of a cage. It costs 64 bytes per quad, and `8 n + 44` more per quad
/// at an irregular corner of valence `n`, so memory around a pole grows with the square of its valence; a semi-sharp crease
/// costs as many small leaves as it takes to fade. The page is `docs/methods/exact_evaluation.md`.
///
/// ```
/// use ogee::{FaceId, Level, LimitSurface, PatchTable, shapes};
///
/// let mesh = shapes::cube();
/// let table = PatchTable::new(&Level::new(&mesh)?);
/// let surface = LimitSurface::new(&table, &mesh.points);
/// let point = surface.eval(table.locate(FaceId(0), None, 0.25, 0.0)?);
/// assert!((point.normal.length() - 1.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PatchTable {
    pub(super) cage_count: usize,
    /// For each face its first parametric face, and their number at the end; empty where all faces are quads.
    pub(super) starts: Vec<u32>,
    /// For each parametric face that is not visible its number, in order.
    pub(super) hidden: Vec<u32>,
    /// For each parametric face its net, or [`NO_LEAF`], a node, and the tail if it is one.
    pub(super) roots: Vec<Sources>,
    /// Nets of leaves below splits.
    pub(super) leaves: Vec<Sources>,
    pub(super) splits: Vec<[Node; 4]>,
    pub(super) tails: Vec<Tail>,
    pub(super) rings: Vec<u32>,
    pub(super) kinds: Vec<ChainBasis>,
    /// Points that splits bring and points mirrored at sharp edges, over the cage; numbered after the cage's.
    pub(super) local: StencilTable,
    /// What depends on a vertex; made when it is first asked for.
    pub(super) users: OnceLock<Users>,
}

/// Numbers of the points of a net, `i + 4 j`; one line of the processor's cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Sources(pub(crate) [u32; 16]);

impl Sources {
    /// A root that is no leaf: [`NO_LEAF`], then its node.
    pub(super) fn node(node: Node) -> Sources {
        let mut slot = [0; 16];
        slot[..2].copy_from_slice(&[NO_LEAF, node.bits()]);
        Sources(slot)
    }

    /// A root that is a tail: the tail follows its node.
    pub(super) fn tail(node: Node, Tail { first, kind, corner }: Tail) -> Sources {
        let mut root = Sources::node(node);
        root.0[2..5].copy_from_slice(&[first, kind, corner]);
        root
    }
}

/// Stands first in a root that is not a leaf; no point has this number.
pub(super) const NO_LEAF: u32 = u32::MAX;

/// How many pieces a [`PatchTable`] has, and what they cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PatchStatistics {
    /// Squares of parameters: a quad counts one, any other polygon one per corner.
    pub parametric_faces: usize,
    /// Bicubic patches.
    pub leaves: usize,
    /// Chains around irregular corners.
    pub tails: usize,
    /// Pieces cut in four.
    pub splits: usize,
    /// Kinds of chains.
    pub kinds: usize,
    /// Points beside those of the cage.
    pub local_points: usize,
    /// Memory in bytes.
    pub bytes: usize,
}

impl PatchTable {
    /// The table of a level.
    ///
    /// Costs some 0.1 microseconds a quad with at most one extraordinary vertex, and some two where there are several;
    /// other polygons, creases and boundaries cost some microseconds. Runs on all cores.
    pub fn new(level: &Level) -> PatchTable {
        par::stay(level.topology().face_count(), || build::table(level))
    }

    /// Number of parametric faces, hidden ones included: a quad counts one, any other polygon one per corner, in the
    /// order of the mesh.
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// True if there are none; a level always has some.
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// The parametric face of a number below [`PatchTable::len`].
    ///
    /// # Panics
    /// If there is none.
    pub fn parametric_face(&self, number: usize) -> ParametricFace {
        assert!(number < self.len(), "there are {} parametric faces", self.len());
        if self.starts.is_empty() {
            return ParametricFace { face: FaceId(number as u32), corner: None };
        }
        let number = number as u32;
        let face = self.starts.partition_point(|&start| start <= number) - 1;
        let corner = (self.starts[face + 1] - self.starts[face] > 1).then(|| number - self.starts[face]);
        ParametricFace { face: FaceId(face as u32), corner }
    }

    /// False if the parametric face is no part of the surface: in a hole, or at a boundary that the scheme leaves out.
    #[inline]
    pub fn is_visible(&self, number: usize) -> bool {
        let is_hidden = || self.hidden.binary_search(&(number as u32)).is_ok();
        number < self.len() && (self.hidden.is_empty() || !is_hidden())
    }

    /// Checks an address: `corner` is `None` on a quad and a corner's number on any other polygon, `u` and `v` are in
    /// `[0, 1]`, `(0, 0)` at the face's first vertex, or at the corner named, and `u` runs along the edge that leaves it.
    ///
    /// # Errors
    /// If it names no point of the surface.
    #[inline]
    pub fn locate(
        &self,
        face: FaceId,
        corner: Option<u32>,
        u: f64,
        v: f64,
    ) -> Result<Location, LocationError> {
        let count = if self.starts.is_empty() { self.len() } else { self.starts.len() - 1 };
        if face.index() >= count {
            return Err(LocationError::MissingFace { face, count });
        }
        let (first, corners) = match self.starts.get(face.index()..face.index() + 2) {
            Some(&[first, end]) => (first, end - first),
            _ => (face.0, 1),
        };
        let root = match corner {
            None if corners == 1 => first,
            None => return Err(LocationError::CornerWanted { face, corners }),
            Some(_) if corners == 1 => return Err(LocationError::CornerOnQuad { face }),
            Some(corner) if corner >= corners => {
                return Err(LocationError::MissingCorner { face, corner, corners });
            }
            Some(corner) => first + corner,
        };
        let location = Location { root, u: 0.0, v: 0.0 }.at(u, v)?;
        if !self.is_visible(root as usize) {
            return Err(LocationError::HiddenFace { face });
        }
        Ok(location)
    }

    /// The corner of some visible face at a vertex of the level that this table was made of; `None` if it has none.
    pub(crate) fn locate_vertex(&self, topology: &Topology, v: VertexId) -> Option<Location> {
        topology.ring(v).find_map(|h| {
            let face = topology.face(h);
            let corner = h.0 - topology.first(face).0;
            let at = if topology.face_size(face) == 4 {
                let [u, v] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][corner as usize];
                self.locate(face, None, u, v)
            } else {
                self.locate(face, Some(corner), 0.0, 0.0)
            };
            at.ok()
        })
    }

    /// How many pieces there are, and what they cost.
    pub fn statistics(&self) -> PatchStatistics {
        let root_leaves = self.roots.iter().filter(|net| net.0[0] != NO_LEAF).count();
        let rows = self.local.len();
        let weights: usize = (0..rows).map(|row| self.local.row(row).len()).sum();
        PatchStatistics {
            parametric_faces: self.len(),
            leaves: root_leaves + self.leaves.len(),
            tails: self.tails.len(),
            splits: self.splits.len(),
            kinds: self.kinds.len(),
            local_points: rows,
            bytes: size_of_val(&self.roots[..])
                + size_of_val(&self.leaves[..])
                + size_of_val(&self.splits[..])
                + size_of_val(&self.tails[..])
                + size_of_val(&self.rings[..])
                + size_of_val(&self.starts[..])
                + size_of_val(&self.hidden[..])
                + 4 * rows
                + 12 * weights
                + self.kinds.iter().map(ChainBasis::bytes).sum::<usize>(),
        }
    }

    /// The net of a parametric face that is one leaf.
    #[inline]
    pub(crate) fn root_leaf(&self, root: u32) -> Option<&[u32; 16]> {
        let net = &self.roots[root as usize].0;
        (net[0] != NO_LEAF).then_some(net)
    }

    /// The node of a parametric face that is not a leaf.
    #[inline]
    pub(crate) fn root_node(&self, root: u32) -> Node {
        Node::from_bits(self.roots[root as usize].0[1])
    }

    /// The tail of a parametric face that is one.
    #[inline]
    pub(crate) fn root_tail(&self, root: u32) -> Tail {
        let [_, _, first, kind, corner, ..] = self.roots[root as usize].0;
        Tail { first, kind, corner }
    }

    /// The first parametric face of a range that is not visible.
    pub(crate) fn first_hidden(&self, faces: Range<usize>) -> Option<usize> {
        let first = self.hidden.partition_point(|&hidden| (hidden as usize) < faces.start);
        self.hidden.get(first).map(|&hidden| hidden as usize).filter(|hidden| faces.contains(hidden))
    }

    /// Number of kinds of chains.
    pub(crate) fn kind_count(&self) -> usize {
        self.kinds.len()
    }

    /// Asks for what is stored about a parametric face, long before it is needed.
    #[inline(always)]
    pub(crate) fn prefetch_root(&self, root: u32) {
        simd::prefetch(&self.roots[root as usize]);
    }

    /// Asks for the points of a parametric face, or for the numbers of its ring, before they are needed.
    #[inline(always)]
    pub(crate) fn prefetch_points(&self, root: u32, points: &[Vec3]) {
        let sources = &self.roots[root as usize].0;
        if sources[0] != NO_LEAF {
            // Neighbours along the net mostly share a line.
            for &source in sources {
                simd::prefetch(&points[source as usize]);
            }
        } else if let Piece::Tail(_) = self.root_node(root).piece() {
            let ring = self.ring(self.root_tail(root));
            for line in ring.chunks(16) {
                simd::prefetch(&line[0]);
            }
        }
    }

    /// Asks for the points of a ring whose numbers are there.
    #[inline(always)]
    pub(crate) fn prefetch_ring(&self, root: u32, points: &[Vec3]) {
        if self.roots[root as usize].0[0] == NO_LEAF
            && let Piece::Tail(_) = self.root_node(root).piece()
        {
            for &source in self.ring(self.root_tail(root)) {
                simd::prefetch(&points[source as usize]);
            }
        }
    }

    #[inline]
    pub(crate) fn leaf(&self, index: u32) -> &[u32; 16] {
        &self.leaves[index as usize].0
    }

    #[inline]
    pub(crate) fn split(&self, index: u32) -> &[Node; 4] {
        &self.splits[index as usize]
    }

    #[inline]
    pub(crate) fn tail(&self, index: u32) -> Tail {
        self.tails[index as usize]
    }

    #[inline]
    pub(crate) fn basis(&self, tail: Tail) -> &ChainBasis {
        &self.kinds[tail.kind as usize]
    }

    /// The ring of a tail: numbers of points.
    #[inline]
    pub(crate) fn ring(&self, tail: Tail) -> &[u32] {
        let first = tail.first as usize;
        &self.rings[first..first + self.basis(tail).ring_count()]
    }

    /// Weights of the points beside the cage's.
    pub(crate) fn local(&self) -> &StencilTable {
        &self.local
    }

    /// Number of points of the cage.
    pub(crate) fn cage_count(&self) -> usize {
        self.cage_count
    }

    /// The leaf or tail that holds a point, the parameters in it, and how often it was halved.
    #[inline]
    pub(crate) fn descend(&self, mut node: Node, mut u: f64, mut v: f64) -> (Piece, f64, f64, i32) {
        let mut depth = 0;
        loop {
            match node.piece() {
                Piece::Split(index) => {
                    let corner;
                    (corner, u, v) = super::tree::child(u, v);
                    node = self.split(index)[corner];
                    depth += 1;
                }
                piece => return (piece, u, v, depth),
            }
        }
    }
}
