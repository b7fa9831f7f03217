//! Which sides of squares are the same curve, and cutting squares until every two that meet share whole sides.
//!
//! Faces of a part are of several sizes: beside one of the cage lie two of its first refinement, or four of its second. The
//! larger one is cut across the side that they share, and the cut runs on from square to square until it ends at a corner or at a
//! border. So squares grow no smaller than the least of those that were there, and most stay what they are.

use std::collections::HashMap;

use super::{Joint, Side, Square};
use crate::math::Vec3;
use crate::patch::Location;

/// Sides are the same curve if their ends and middles agree to this share of the size of all.
const SAME: f64 = 1e-6;

/// How often a piece is halved in each direction at most.
const DEEPEST: u32 = 8;

/// Squares cut to share whole sides, in the order of the pieces they come from, and the joints between them.
pub(super) fn matched(squares: Vec<Square>, point: impl Fn(Location) -> Vec3) -> (Vec<Square>, Vec<Joint>) {
    let mut cutting = Cutting::new(squares, point);
    let mut waiting: Vec<usize> = (0..cutting.pieces.len()).rev().collect();
    while let Some(number) = waiting.pop() {
        let Some(axis) = cutting.wants_cut(number) else { continue };
        waiting.extend((0..4).filter_map(|side| cutting.partner(number, side)).map(|(partner, _)| partner));
        waiting.push(cutting.cut(number, axis));
        waiting.push(number);
    }
    cutting.finish()
}

/// A curve as it is recognised: its start, its middle, its end.
type Curve = [Vec3; 3];

/// A square in the making.
struct Piece {
    square: Square,
    sides: [Curve; 4],
    /// The square it was cut from, and how often along each of its axes.
    origin: usize,
    halvings: [u32; 2],
}

struct Cutting<F> {
    point: F,
    pieces: Vec<Piece>,
    tolerance: f64,
    /// Sides by the cell that their middles fall into; a partner is in the same cell or in one beside it.
    cells: HashMap<[i64; 3], Vec<(usize, u32)>>,
}

impl<F: Fn(Location) -> Vec3> Cutting<F> {
    fn new(squares: Vec<Square>, point: F) -> Cutting<F> {
        let mut cutting =
            Cutting { point, pieces: Vec::new(), tolerance: f64::MIN_POSITIVE, cells: HashMap::new() };
        for (origin, square) in squares.into_iter().enumerate() {
            let sides = cutting.sides(&square);
            cutting.pieces.push(Piece { square, sides, origin, halvings: [0; 2] });
        }
        let middles = || cutting.pieces.iter().flat_map(|piece| piece.sides.map(|side| side[1]));
        let lower = middles().reduce(Vec3::min).unwrap_or_default();
        let upper = middles().reduce(Vec3::max).unwrap_or_default();
        cutting.tolerance = (SAME * upper.distance(lower)).max(f64::MIN_POSITIVE);
        (0..cutting.pieces.len()).for_each(|number| cutting.enter(number));
        cutting
    }

    /// The part of a side from one share of its length to another.
    fn curve(&self, square: &Square, side: u32, from: f64, to: f64) -> Curve {
        [from, f64::midpoint(from, to), to].map(|x| (self.point)(square.on_side(side, x)))
    }

    fn sides(&self, square: &Square) -> [Curve; 4] {
        [0, 1, 2, 3].map(|side| self.curve(square, side, 0.0, 1.0))
    }

    fn cell(&self, p: Vec3) -> [i64; 3] {
        [p.x, p.y, p.z].map(|x| (x / self.tolerance / 4.0).round() as i64)
    }

    fn enter(&mut self, number: usize) {
        for side in 0..4 {
            let cell = self.cell(self.pieces[number].sides[side as usize][1]);
            self.cells.entry(cell).or_default().push((number, side));
        }
    }

    fn leave(&mut self, number: usize) {
        for side in 0..4 {
            let cell = self.cell(self.pieces[number].sides[side as usize][1]);
            if let Some(entries) = self.cells.get_mut(&cell) {
                entries.retain(|&entry| entry != (number, side));
            }
        }
    }

    /// True if a curve is no more than a point: the pole of a cap.
    fn is_point(&self, [start, middle, end]: Curve) -> bool {
        start.distance(end) + start.distance(middle) <= self.tolerance
    }

    /// The sides that are a curve, run through the other way.
    fn along(&self, [start, middle, end]: Curve) -> impl Iterator<Item = (usize, u32)> + '_ {
        let [x, y, z] = self.cell(middle);
        let around = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        // Patches that are far from the origin for their size lie in the last cell.
        let beside =
            move |[i, j, k]: [i64; 3]| [x.saturating_add(i), y.saturating_add(j), z.saturating_add(k)];
        let candidates = around.filter_map(move |offset| self.cells.get(&beside(offset))).flatten();
        candidates.copied().filter(move |&(number, side)| {
            let [a, b, c] = self.pieces[number].sides[side as usize];
            start.distance(c).max(middle.distance(b)).max(end.distance(a)) <= self.tolerance
        })
    }

    fn partner(&self, number: usize, side: u32) -> Option<(usize, u32)> {
        let curve = self.pieces[number].sides[side as usize];
        if self.is_point(curve) {
            return None;
        }
        self.along(curve).filter(|&other| other != (number, side)).min()
    }

    /// The axis along which a square is to be halved: that of a side in the middle of which other squares meet.
    fn wants_cut(&self, number: usize) -> Option<usize> {
        let Piece { ref square, ref sides, halvings, .. } = self.pieces[number];
        let is_met = |side: u32| {
            let smaller = (1..=DEEPEST).map(|halvings| 0.5_f64.powi(halvings as i32));
            let mut parts = smaller.flat_map(|length| [[0.5 - length, 0.5], [0.5, 0.5 + length]]);
            parts.any(|[from, to]| {
                let part = self.curve(square, side, from, to);
                !self.is_point(part) && self.along(part).next().is_some()
            })
        };
        let wants = |side: u32| {
            let axis = side as usize % 2;
            let is_open = halvings[axis] < DEEPEST && !self.is_point(sides[side as usize]);
            (is_open && self.partner(number, side).is_none() && is_met(side)).then_some(axis)
        };
        (0..4).find_map(wants)
    }

    /// Halves a square; the half of greater parameters is a new one.
    fn cut(&mut self, number: usize, axis: usize) -> usize {
        self.leave(number);
        let Piece { square, origin, mut halvings, .. } = self.pieces[number];
        halvings[axis] += 1;
        let [mut first, mut second] = [square; 2];
        first.size[axis] /= 2.0;
        second.size[axis] /= 2.0;
        second.corner = if axis == 0 { square.at(0.5, 0.0) } else { square.at(0.0, 0.5) };
        // The new sides lie inside.
        let [end, start] = if axis == 0 { [1, 3] } else { [2, 0] };
        first.edges[end] = false;
        second.edges[start] = false;
        let [first, second] =
            [first, second].map(|square| Piece { square, sides: self.sides(&square), origin, halvings });
        self.pieces[number] = first;
        self.pieces.push(second);
        let new = self.pieces.len() - 1;
        [number, new].into_iter().for_each(|number| self.enter(number));
        new
    }

    fn finish(mut self) -> (Vec<Square>, Vec<Joint>) {
        let place = |piece: &Piece| (piece.origin, piece.square.corner.parameters());
        let mut order: Vec<usize> = (0..self.pieces.len()).collect();
        order.sort_by(|&a, &b| {
            let [(a, [au, av]), (b, [bu, bv])] = [a, b].map(|number| place(&self.pieces[number]));
            a.cmp(&b).then(av.total_cmp(&bv)).then(au.total_cmp(&bu))
        });
        let mut rank = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, &number)| rank[number] = k);
        for entries in self.cells.values_mut() {
            entries.iter_mut().for_each(|entry| entry.0 = rank[entry.0]);
        }
        let mut pieces: Vec<(usize, Piece)> = rank.into_iter().zip(self.pieces).collect();
        pieces.sort_by_key(|(rank, _)| *rank);
        self.pieces = pieces.into_iter().map(|(_, piece)| piece).collect();
        let joints = self.joints();
        (self.pieces.into_iter().map(|piece| piece.square).collect(), joints)
    }

    /// Every side with the first that is the same curve and has no partner yet.
    fn joints(&self) -> Vec<Joint> {
        let mut joined = vec![[false; 4]; self.pieces.len()];
        let mut joints = Vec::new();
        for number in 0..self.pieces.len() {
            for side in 0..4 {
                let curve = self.pieces[number].sides[side as usize];
                if joined[number][side as usize] || self.is_point(curve) {
                    continue;
                }
                let free = |&(other, its): &(usize, u32)| {
                    (other, its) > (number, side) && !joined[other][its as usize]
                };
                let Some((other, its)) = self.along(curve).filter(free).min() else { continue };
                joined[number][side as usize] = true;
                joined[other][its as usize] = true;
                let sides = [(number, side), (other, its)];
                let sides = sides.map(|(square, side)| Side { square: square as u32, side });
                joints.push(Joint { sides, is_sharp: false });
            }
        }
        joints
    }
}
