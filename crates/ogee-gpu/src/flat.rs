//! `Flat`: the trees of all faces as arrays, the way shaders read them.

use ogee::{FacePiece, LimitSurface, PatchNet, TailPiece, Vec3};

use crate::frame::Frame;
use crate::layout::{Face, Tail, node};

/// Chains are stored until they have shrunk to this share of their face; below, numbers of 32 bits see the limit shape.
const LEAST: f64 = 1.0 / 32768.0;

/// Faces, nodes, tails and control points of a surface.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flat {
    pub(crate) faces: Vec<Face>,
    /// Four children each.
    pub(crate) nodes: Vec<[u32; 4]>,
    pub(crate) tails: Vec<Tail>,
    /// Sixteen for each net, relative to what the face or tail says; the fourth number is zero.
    pub(crate) points: Vec<[f32; 4]>,
}

impl Flat {
    /// The visible faces of a surface; hidden ones are there, but empty.
    pub(crate) fn new(surface: &LimitSurface<'_>, frame: &Frame) -> Flat {
        let mut flat = Flat::default();
        let table = surface.table();
        for face in 0..table.len() {
            if !table.is_visible(face) {
                flat.faces.push(Face::default());
                continue;
            }
            let piece = surface.face_piece(face, LEAST);
            let origin = frame.point(origin(&piece));
            let root = flat.piece(&piece, frame, origin);
            flat.faces.push(Face { origin: narrow(origin), root });
        }
        flat
    }

    fn piece(&mut self, piece: &FacePiece, frame: &Frame, origin: Vec3) -> u32 {
        match piece {
            FacePiece::Leaf(net) => {
                let origin = Vec3::from(narrow(origin).map(f64::from));
                reference(node::LEAF, self.net(net, |point| frame.point(point) - origin))
            }
            FacePiece::Tail(tail) => self.tail(tail, frame),
            FacePiece::Split(children) => {
                let number = self.nodes.len();
                self.nodes.push([0; 4]);
                self.nodes[number] = children.each_ref().map(|child| self.piece(child, frame, origin));
                reference(node::SPLIT, number)
            }
        }
    }

    fn tail(&mut self, tail: &TailPiece, frame: &Frame) -> u32 {
        let first = self.net_count() as u32;
        for net in tail.steps.iter().flatten() {
            self.net(net, |point| frame.vector(point));
        }
        self.tails.push(Tail {
            limit: narrow(frame.point(tail.limit)),
            first,
            normal: narrow(tail.normal),
            steps: tail.steps.len() as u32,
            eigenvalue: tail.eigenvalue as f32,
            corner: tail.corner,
            unused: [0; 2],
        });
        reference(node::TAIL, self.tails.len() - 1)
    }

    /// Stores a net and gives its number.
    fn net(&mut self, net: &PatchNet, place: impl Fn(Vec3) -> Vec3) -> usize {
        let number = self.net_count();
        self.points.extend(net.iter().map(|&point| {
            let [x, y, z] = narrow(place(point));
            [x, y, z, 0.0]
        }));
        number
    }

    fn net_count(&self) -> usize {
        self.points.len() / 16
    }
}

/// A point of the face itself, which its leaves are relative to.
fn origin(piece: &FacePiece) -> Vec3 {
    match piece {
        FacePiece::Leaf(net) => net[5],
        FacePiece::Tail(tail) => tail.limit,
        FacePiece::Split(children) => origin(&children[0]),
    }
}

fn reference(kind: u32, number: usize) -> u32 {
    debug_assert!(number < 1 << node::SHIFT, "fewer than 2^30 pieces of a kind");
    kind << node::SHIFT | number as u32
}

/// In single precision.
pub(crate) fn narrow(v: Vec3) -> [f32; 3] {
    <[f64; 3]>::from(v).map(|x| x as f32)
}
