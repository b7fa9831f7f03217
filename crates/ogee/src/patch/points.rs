//! Points of levels below the cage, as weights on the cage; only those that patches use are worked out.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Neighbourhood;
use super::surroundings::Mirrored;
use crate::math::par;
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
    /// What has got a number, in that order: vertices, and the places of mirrored points among `terms`, counted on.
    new: Vec<u32>,
    terms: Vec<Mirrored>,
}

/// Marks that one thread takes in one go: those of so many times 64 vertices.
const WORDS: usize = 64;

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

    /// Gives numbers to all that is marked, in order, on all cores. Nothing has a number yet.
    pub(super) fn number_marked(&mut self, marks: Marks) {
        debug_assert!(self.new.is_empty(), "marked vertices come first");
        let words: Vec<u64> = marks.0.into_iter().map(AtomicU64::into_inner).collect();
        let count = |words: &[u64]| words.iter().map(|word| word.count_ones() as usize).sum();
        // Zeros that no one has touched yet cost nothing.
        self.new = vec![0; count(&words)];
        let (mut new, mut first) = (&mut self.new[..], 0);
        let mut shares = Vec::new();
        for (words, vertices) in words.chunks(WORDS).zip(self.vertices.chunks_mut(64 * WORDS)) {
            let (own, later) = new.split_at_mut(count(words));
            let next = self.next;
            self.next += own.len() as u32;
            shares.push((words, vertices, own, first, next));
            (new, first) = (later, first + 64 * WORDS as u32);
        }
        par::each(shares, |(words, vertices, new, first, next)| {
            let places = words.iter().zip((0..).step_by(64)).flat_map(|(&word, start)| {
                (0..64).filter(move |bit| word >> bit & 1 != 0).map(move |bit| start + bit)
            });
            for ((place, new), number) in places.zip(new).zip(next..) {
                *new = first + place;
                vertices[place as usize] = number + 1;
            }
        });
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
            self.new.push(vertex);
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
            self.new.push((self.vertices.len() + self.terms.len()) as u32);
            self.terms.push(point);
            self.next += 1;
            self.next - 1
        })
    }

    /// The new points as rows; `write` adds a vertex, times a share.
    pub(super) fn rows(&self, write: impl Fn(u32, f64, &mut Row) + Sync + Send) -> StencilTable {
        StencilTable::from_rows(self.new.len(), |i, row| {
            match (self.new[i] as usize).checked_sub(self.vertices.len()) {
                None => write(self.new[i], 1.0, row),
                Some(terms) => {
                    self.terms[terms].iter().for_each(|&(vertex, share)| write(vertex, share, row))
                }
            }
            row.expand_face_points(|_, _, _| ());
        })
    }
}
