//! Pieces into lines.

use super::chain::Piece;
use super::crossing::Node;
use super::march::Key;
use super::{LevelLine, LinePoint};
use crate::patch::Location;

/// Points of a line nearer to each other than this share of the size are one.
const SAME: f64 = 1e-12;

/// Joins pieces where one ends and another begins: at the same crossing. Lines come by index, then by their first place
/// on the surface, whatever the order of the pieces.
pub(super) fn join(
    pieces: &[&Piece],
    nodes: &[Node],
    value: impl Fn(i64) -> f64,
    size: f64,
) -> Vec<LevelLine> {
    let number = |key: Key| nodes.binary_search_by_key(&key, |node| node.key).ok();
    let ends: Vec<[Option<usize>; 2]> =
        pieces.iter().map(|piece| piece.ends.map(|end| end.and_then(number))).collect();
    let mut after = vec![None; nodes.len()];
    let mut has_before = vec![false; nodes.len()];
    for (piece, [start, end]) in ends.iter().enumerate() {
        if let Some(start) = *start {
            after[start] = Some(piece);
        }
        if let Some(end) = *end {
            has_before[end] = true;
        }
    }
    let point = |node: usize| {
        let found = nodes[node].found.as_ref();
        found.map(|(_, spot)| LinePoint { at: spot.at, position: spot.position })
    };
    let mut is_done = vec![false; pieces.len()];
    let mut walk = |first: usize| {
        let mut points: Vec<LinePoint> = ends[first][0].and_then(point).into_iter().collect();
        let mut next = Some(first);
        while let Some(piece) = next.filter(|&piece| !is_done[piece]) {
            is_done[piece] = true;
            points.extend(&pieces[piece].inner);
            points.extend(ends[piece][1].and_then(point));
            next = ends[piece][1].and_then(|end| after[end]);
        }
        (points, next.is_some())
    };
    let open = (0..pieces.len()).filter(|&piece| ends[piece][0].is_none_or(|start| !has_before[start]));
    let mut lines: Vec<LevelLine> = Vec::new();
    // What has no beginning is closed.
    for first in open.chain(0..pieces.len()) {
        let (mut points, closed) = walk(first);
        points.dedup_by(|a, b| a.position.distance(b.position) <= SAME * size);
        if closed {
            start_at_first(&mut points);
        }
        if points.len() > 1 {
            let index = pieces[first].index;
            lines.push(LevelLine { value: value(index), index, closed, points });
        }
    }
    lines.sort_by(|a, b| {
        let key = |line: &LevelLine| line.points.iter().map(|point| place(point.at)).min_by(compare);
        a.index.cmp(&b.index).then_with(|| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal))
    });
    lines
}

/// Turns a closed line so that it begins, and ends, at its first place on the surface.
fn start_at_first(points: &mut Vec<LinePoint>) {
    points.pop();
    let first = (0..points.len()).min_by(|&a, &b| compare(&place(points[a].at), &place(points[b].at)));
    if let Some(first) = first {
        points.rotate_left(first);
        points.push(points[0]);
    }
}

fn place(at: Location) -> (u32, f64, f64) {
    (at.root, at.u, at.v)
}

fn compare(a: &(u32, f64, f64), b: &(u32, f64, f64)) -> std::cmp::Ordering {
    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
}
