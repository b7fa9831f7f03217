//! Points of levels below the cage, as weights on the cage; only those that patches use are worked out.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Neighbourhood;
use super::surroundings::Mirrored;
use crate::mesh::VertexId;
use crate::rules::Level;
use crate::stencil::{Row, StencilTable};

/// A level below the cage.
pub(super) struct Below {
    pub(super) level: Level,
    /// What it is the refinement of.
    part: Neighbourhood,
    /// The points of `part` as weights on the cage; `None` where they are the cage's.
    above: Option<StencilTable>,
}

impl Below {
    /// The refinement of some faces of a level, which itself lies below the cage or is the cage.
    pub(super) fn new(part: Neighbourhood, parent: Option<&Below>) -> Below {
        let above = parent.map(|parent| {
            StencilTable::from_rows(part.vertices.len(), |i, row| {
                parent.write(part.vertices[i].0, 1.0, row);
                row.expand_face_points(|_, _, _| ());
            })
        });
        Below { level: part.level.split(), part, above }
    }

    /// Adds a vertex of the level as weights on the cage.
    pub(super) fn write(&self, vertex: u32, share: f64, row: &mut Row) {
        let mut mask = Row::with_capacity(32);
        self.part.level.child_mask(vertex, &mut mask);
        for &(source, weight) in mask.weights() {
            match &self.above {
                None => row.add(self.part.vertices[source as usize], share * weight),
                Some(above) => {
                    for (cage, inner) in above.row(source as usize) {
                        row.add(VertexId(cage), share * weight * inner);
                    }
                }
            }
        }
    }
}

/// Gives points of a level their numbers, as they are asked for.
pub(super) struct Points {
    /// The number of the next point.
    next: u32,
    /// One more than the numbers given so far, by vertex; empty for the cage, whose vertices keep theirs.
    vertices: Vec<u32>,
    /// Numbers of mirrored points, by their terms.
    mirrored: HashMap<Vec<(u32, i32)>, u32>,
    /// What has got a number, in that order.
    new: Vec<New>,
    terms: Vec<Mirrored>,
}

/// A point that has got a number.
#[derive(Clone, Copy)]
enum New {
    Vertex(u32),
    /// The place of its terms.
    Mirrored(u32),
}

/// Vertices that are to get numbers. Any thread may mark any of them: the set is the same whoever comes first.
pub(super) struct Marks(Vec<AtomicU64>);

impl Marks {
    pub(super) fn new(count: usize) -> Marks {
        Marks((0..count.div_ceil(64)).map(|_| AtomicU64::new(0)).collect())
    }

    #[inline]
    pub(super) fn mark(&self, vertex: u32) {
        let (word, bit) = (&self.0[vertex as usize / 64], 1 << (vertex % 64));
        // Most are marked already, and reading is free of quarrels.
        if word.load(Ordering::Relaxed) & bit == 0 {
            word.fetch_or(bit, Ordering::Relaxed);
        }
    }

    /// What is marked, in order.
    fn into_vertices(self) -> impl Iterator<Item = u32> {
        self.0.into_iter().zip((0..).step_by(64)).flat_map(|(word, first)| {
            let mut bits = word.into_inner();
            std::iter::from_fn(move || {
                let bit = (bits != 0).then(|| bits.trailing_zeros())?;
                bits &= bits - 1;
                Some(first + bit)
            })
        })
    }
}

impl Points {
    /// `count` vertices get numbers from `next` on; all others keep theirs.
    pub(super) fn new(count: usize, next: u32) -> Points {
        // Zeros that no one has touched yet cost nothing.
        let (vertices, mirrored) = (vec![0; count], HashMap::new());
        Points { next, vertices, mirrored, new: Vec::new(), terms: Vec::new() }
    }

    /// Room for marks on all vertices that get numbers.
    pub(super) fn marks(&self) -> Marks {
        Marks::new(self.vertices.len())
    }

    /// Gives numbers to vertices that have none, in their order.
    pub(super) fn number_marked(&mut self, marks: Marks) {
        for vertex in marks.into_vertices() {
            self.vertex(vertex);
        }
    }

    /// The number of a vertex that has one.
    #[inline]
    pub(super) fn of(&self, vertex: u32) -> u32 {
        self.vertices[vertex as usize] - 1
    }

    #[inline]
    pub(super) fn vertex(&mut self, vertex: u32) -> u32 {
        let Some(number) = self.vertices.get_mut(vertex as usize) else { return vertex };
        if *number == 0 {
            self.next += 1;
            *number = self.next;
            self.new.push(New::Vertex(vertex));
        }
        *number - 1
    }

    pub(super) fn number(&mut self, point: Mirrored) -> u32 {
        if let [(vertex, _)] = point[..] {
            return self.vertex(vertex);
        }
        // Weights of mirrored points are small whole numbers.
        let key = point.iter().map(|&(vertex, weight)| (vertex, weight as i32)).collect();
        *self.mirrored.entry(key).or_insert_with(|| {
            self.new.push(New::Mirrored(self.terms.len() as u32));
            self.terms.push(point);
            self.next += 1;
            self.next - 1
        })
    }

    /// The new points as rows; `write` adds a vertex, times a share.
    pub(super) fn rows(&self, write: impl Fn(u32, f64, &mut Row) + Sync + Send) -> StencilTable {
        StencilTable::from_rows(self.new.len(), |i, row| {
            match self.new[i] {
                New::Vertex(vertex) => write(vertex, 1.0, row),
                New::Mirrored(terms) => {
                    self.terms[terms as usize].iter().for_each(|&(vertex, share)| write(vertex, share, row));
                }
            }
            row.expand_face_points(|_, _, _| ());
        })
    }
}
