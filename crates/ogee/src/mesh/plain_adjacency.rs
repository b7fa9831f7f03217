//! Adjacency as simply as it can be found: what `adjacency` is tested against.

use super::FaceList;
use super::topology::NONE;

/// The arrays of [`super::Topology`] that say who meets whom.
#[derive(Debug, PartialEq)]
pub(super) struct PlainAdjacency {
    pub(super) twin: Vec<u32>,
    pub(super) edge: Vec<u32>,
    pub(super) first_side: Vec<u32>,
    pub(super) outgoing: Vec<u32>,
    pub(super) lenses: Vec<u32>,
    pub(super) single_fans: bool,
}

impl PlainAdjacency {
    /// Of faces with sound corners; nothing if an edge is no manifold one.
    pub(super) fn new(faces: &FaceList, vertices: usize) -> Option<PlainAdjacency> {
        let twin = pair(faces)?;
        let (edge, first_side) = number_edges(&twin);
        let mut after = vec![NONE; twin.len()];
        for f in 0..faces.len() {
            let (start, end) = (faces.starts()[f], faces.starts()[f + 1]);
            for h in start..end {
                after[h as usize] = twin[if h == start { end - 1 } else { h - 1 } as usize];
            }
        }
        let mut outgoing = vec![NONE; vertices];
        let mut degree = vec![0; vertices];
        for (h, &v) in faces.corners().iter().enumerate() {
            let held = &mut outgoing[v as usize];
            degree[v as usize] += 1;
            if *held == NONE || twin[h] == NONE {
                *held = h as u32;
            }
        }
        let fan = |v: usize| {
            let first = Some(outgoing[v]).filter(|&h| h != NONE);
            let (after, first_of) = (&after, outgoing[v]);
            std::iter::successors(first, move |&h| {
                Some(after[h as usize]).filter(|&h| h != NONE && h != first_of)
            })
        };
        let single_fans = (0..vertices).all(|v| fan(v).count() == degree[v]);
        let is_open = |v: usize| twin[outgoing[v] as usize] == NONE;
        let lenses = (0..vertices).filter(|&v| degree[v] == 2 && !is_open(v)).map(|v| v as u32).collect();
        Some(PlainAdjacency { twin, edge, first_side, outgoing, lenses, single_fans })
    }
}

/// Twins, from a sort of all halfedges by their ends.
fn pair(faces: &FaceList) -> Option<Vec<u32>> {
    let mut sides = Vec::new();
    for (f, face) in faces.iter().enumerate() {
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            sides.push((a.min(b), a.max(b), a, faces.starts()[f] + k as u32));
        }
    }
    sides.sort_unstable();
    let mut twin = vec![NONE; sides.len()];
    for edge in sides.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        match *edge {
            [_] => {}
            [(_, _, a, g), (_, _, b, h)] if a != b => {
                twin[g as usize] = h;
                twin[h as usize] = g;
            }
            _ => return None,
        }
    }
    Some(twin)
}

fn number_edges(twin: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut edge = vec![NONE; twin.len()];
    let mut first_side = Vec::new();
    for (h, &twin) in twin.iter().enumerate() {
        if (twin as usize) < h {
            edge[h] = edge[twin as usize];
        } else {
            edge[h] = first_side.len() as u32;
            first_side.push(h as u32);
        }
    }
    (edge, first_side)
}
